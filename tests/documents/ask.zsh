# Asks zsh's completion what may follow the words in $1, and prints an answer a line. zsh completes only where a line is
# edited, so one is edited in a terminal of its own; its answers come between marks.
zmodload zsh/zpty
zpty ask zsh -f -i
tell() { zpty -w ask "$1" }
tell 'PROMPT=; RPROMPT=; stty -echo; unset zle_bracketed_paste; unsetopt prompt_cr prompt_sp'
tell 'fpath=($PWD $fpath); autoload -U compinit; compinit -u -D; bindkey -e'
# Every answer is caught on its way to the menu.
tell 'compadd() {
    local -a caught
    if [[ -n ${(M)@:#-(O|A|D)} ]]; then builtin compadd "$@"; return; fi
    builtin compadd -A caught "$@"
    answers+=($caught)
    builtin compadd "$@"
}'
tell 'typeset -ga answers
show() { _main_complete; compstate[insert]=; compstate[list]=; }
zle -C ask-it complete-word show
tell-it() { answers=(); zle ask-it; zle -I; print -r -- "<begin>"; print -rl -- $answers; print -r -- "<end>"; BUFFER= }
zle -N tell-it; bindkey "^T" tell-it; print "<rea""dy>"'
local line
while zpty -r ask line && [[ $line != *"<ready>"* ]]; do :; done
zpty -n -w ask "$1"$'\C-T'
while zpty -r ask line && [[ $line != *"<begin>"* ]]; do :; done
while zpty -r ask line && [[ $line != *"<end>"* ]]; do
    print -r -- ${line%$'\r\n'}
done
zpty -d ask
