# bash takes words apart at : and =, so that the function above would know neither builtin:bust nor --style=ink. Here they are
# put together again, and what of an answer stands on the line already is left out.
_tinta_words() {
    local words=() word last open=''
    for word in "${COMP_WORDS[@]:0:COMP_CWORD + 1}"; do
        last=$((${#words[@]} - 1))
        if [[ $word == = && ${words[last]} == --* ]]; then
            words+=("")
            open=yes
        elif [[ $word == [:=] ]]; then
            words[last]+=$word
            open=yes
        elif [[ $open ]]; then
            words[last]+=$word
            open=''
        else
            words+=("$word")
        fi
    done
    local COMP_CWORD=$((${#words[@]} - 1))
    local COMP_WORDS=("${words[@]}")
    local cur=${words[COMP_CWORD]} prev='' names='' is_model=''
    if [[ $COMP_CWORD -gt 0 ]]; then
        prev=${words[COMP_CWORD - 1]}
    fi

    # A model or a preset is a built-in one or a file.
    case $prev in
        --preset)
            names="@presets@"
            ;;
        @with-value@) ;;
        *)
            if [[ $COMP_CWORD -gt 1 && $cur != -* ]]; then
                case ${words[1]} in
                    @with-models@)
                        names="@models@"
                        is_model=yes
                        ;;
                esac
            fi
            ;;
    esac
    if [[ $names ]]; then
        names=$(compgen -W "$names" -- "$cur")
    fi
    if [[ $names ]]; then
        COMPREPLY=()
        while IFS= read -r word; do
            [[ $word ]] && COMPREPLY+=("$word")
        done <<<"$names"$'\n'"$(compgen -f -- "$cur")"
    elif [[ $is_model ]]; then
        # Nothing is said, so bash offers files.
        COMPREPLY=()
    else
        _tinta "$1" "$cur" "$prev"
    fi
    if [[ $cur == *:* && $COMP_WORDBREAKS == *:* ]]; then
        local before=${cur%"${cur##*:}"}
        COMPREPLY=("${COMPREPLY[@]#"$before"}")
    fi
}
