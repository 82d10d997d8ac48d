//! Files shipped with the program: completions tried in the shells themselves, manual pages by man's own checks, and the Debian
//! package's list of files and of packages it needs.

use crate::support::{root, skip};
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

fn tinta(words: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_tinta")).args(words).output().unwrap()
}

/// The script for a shell, in a file.
fn script(folder: &Path, shell: &str) -> PathBuf {
    let output = tinta(&["generate", shell]);
    assert!(output.status.success() && output.stdout.len() > 10_000, "{shell}: {output:?}");
    let file = folder.join(shell);
    std::fs::write(&file, output.stdout).unwrap();
    file
}

fn is_there(program: &str) -> bool {
    let is_there = Command::new(program).arg("--version").output().is_ok();
    if !is_there {
        skip(&format!("{program} is not installed, so nothing is tried in it"));
    }
    is_there
}

/// Runs a program in a folder and gives the lines it writes.
fn lines(program: &str, words: &[&str], folder: &Path) -> Vec<String> {
    let output = Command::new(program).args(words).current_dir(folder).env("HOME", folder).output().unwrap();
    assert!(output.status.success(), "{program} {words:?}: {}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap().lines().map(str::to_owned).collect()
}

/// Words typed before the tab, the expected answers, and one that must be absent.
const TYPED: [(&str, &[&str], &str); 6] = [
    ("tinta ren", &["render"], "measure"),
    ("tinta render --st", &["--style"], "--filter"),
    ("tinta render --style ", &["two-pass", "ink", "lines"], "builtin:bust"),
    ("tinta render --style tw", &["two-pass"], "ink"),
    ("tinta info c", &["cow.obj"], "builtin:bust"),
    ("tinta generate ", &["bash", "zsh", "fish", "powershell"], "cow.obj"),
];

/// Checks answers; some shells omit the part already on the line.
fn check(shell: &str, typed: &str, answers: &[String], expected: &[&str], not: &str) {
    let word = typed.rsplit([' ', '=']).next().unwrap();
    let answers: Vec<&str> = answers.iter().map(|line| line.split('\t').next().unwrap().trim_end()).collect();
    let is_among = |name: &str| {
        let with_option = format!("--style={name}");
        answers.iter().any(|answer| *answer == name || *answer == with_option)
    };
    for name in expected {
        assert!(is_among(name), "{shell}: {typed:?} gives {answers:?}, not {name}");
        assert!(name.starts_with(word));
    }
    assert!(!is_among(not), "{shell}: {typed:?} gives {not}");
}

#[test]
fn bash_completes_commands_options_names_and_files() {
    if !is_there("bash") {
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("cow.obj"), "").unwrap();
    script(folder.path(), "bash");
    // Like readline: without an answer it offers files.
    let complete = r#"
        source ./bash 2>/dev/null
        read -r _ function _ < <(complete -p tinta | sed 's/.*-F \([^ ]*\).*/x \1 x/')
        COMP_WORDS=("$@") COMP_CWORD=$(($# - 1)) COMPREPLY=()
        last=${COMP_WORDS[COMP_CWORD]}
        "$function" tinta "$last" "${COMP_WORDS[COMP_CWORD - 1]}" 2>/dev/null
        [[ ${COMPREPLY[*]} ]] || COMPREPLY=($(compgen -f -- "$last"))
        printf '%s\n' "${COMPREPLY[@]}"
    "#;
    let answers = |words: &[&str]| lines("bash", &[&["--norc", "-c", complete, "bash"], words].concat(), folder.path());
    for (typed, expected, not) in TYPED {
        let words: Vec<&str> = typed.split(' ').collect();
        check("bash", typed, &answers(&words), expected, not);
    }
    let mut files = answers(&["tinta", "render", "--fov", ""]);
    files.sort_unstable();
    assert_eq!(files, ["bash", "cow.obj"], "nothing is known of a number");
}

#[test]
fn fish_completes_commands_options_names_and_files() {
    if !is_there("fish") {
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("cow.obj"), "").unwrap();
    script(folder.path(), "fish");
    for (typed, expected, not) in TYPED {
        let complete = format!("source ./fish; complete -C '{typed}'");
        check("fish", typed, &lines("fish", &["--no-config", "-c", &complete], folder.path()), expected, not);
    }
}

#[test]
fn zsh_completes_commands_options_names_and_files() {
    if !is_there("zsh") {
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("cow.obj"), "").unwrap();
    let file = script(folder.path(), "zsh");
    std::fs::rename(file, folder.path().join("_tinta")).unwrap();
    std::fs::write(folder.path().join("ask.zsh"), include_str!("ask.zsh")).unwrap();
    for (typed, expected, not) in TYPED {
        check("zsh", typed, &lines("zsh", &["-f", "ask.zsh", typed], folder.path()), expected, not);
    }
}

#[test]
fn manual_pages_have_no_warnings() {
    let folder = tempfile::tempdir().unwrap();
    let pages = folder.path().join("man");
    assert!(tinta(&["generate", "man", "-o", pages.to_str().unwrap()]).status.success());
    let mut files: Vec<PathBuf> = std::fs::read_dir(&pages).unwrap().map(|file| file.unwrap().path()).collect();
    files.sort();
    assert!(files.len() > 10 && files.contains(&pages.join("tinta.1")), "{files:?}");
    if !is_there("groff") {
        return;
    }
    for file in files {
        let output = Command::new("groff").args(["-man", "-Tutf8", "-ww", "-z"]).arg(&file).output().unwrap();
        let said = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.success() && said.is_empty(), "{}: {said}", file.display());
    }
}

/// The lines of [package.metadata.deb] in the program's Cargo.toml, paths from the top folder.
fn deb() -> String {
    let text = std::fs::read_to_string(root().join("crates/tinta-cli/Cargo.toml")).unwrap();
    let rest = text.split_once("\n[package.metadata.deb]\n").unwrap().1;
    rest.split_once("\n[").unwrap().0.replace("../../", "")
}

#[test]
fn the_debian_package_holds_what_there_is() {
    let package = std::fs::read_to_string(root().join("scripts/package")).unwrap();
    let deb = deb();
    let mut targets = Vec::new();
    for asset in deb.lines().filter_map(|line| line.strip_prefix("    [\"")) {
        let [from, to] = [0, 2].map(|place| asset.split('"').nth(place).unwrap());
        // The file is built, made by scripts/package, or present here.
        let is_made = from.strip_prefix("target/deb/").is_some_and(|name| {
            let name = name.trim_end_matches("/*.1");
            package.contains(&format!("\"$made/{name}\""))
        });
        assert!(is_made || from == "target/release/tinta" || root().join(from).is_file(), "{from} is not there");
        targets.push(to);
    }
    for needed in [
        "usr/bin/",
        "usr/share/man/man1/",
        "usr/share/bash-completion/completions/tinta",
        "usr/share/zsh/vendor-completions/_tinta",
        "usr/share/fish/vendor_completions.d/tinta.fish",
    ] {
        assert!(targets.contains(&needed), "{needed}");
    }
}

#[test]
fn the_debian_package_needs_what_the_scripts_set_up() {
    let set_up = std::fs::read_to_string(root().join("scripts/set-up")).unwrap();
    let deb = deb();
    let list = |key: &str| {
        let line = deb.lines().find_map(|line| line.strip_prefix(&format!("{key} = \""))).unwrap();
        line.trim_end_matches('"').split(", ").map(str::to_owned).collect::<Vec<_>>()
    };
    let (depended, recommended) = (list("depends"), list("recommends"));
    assert_eq!(depended[0], "$auto");
    // Those beginning with lib but the C library's headers: the ones that are opened while it runs.
    let words = set_up.lines().filter(|line| !line.trim_start().starts_with('#')).flat_map(str::split_whitespace);
    let mut needed: Vec<&str> = words
        .map(|word| word.trim_end_matches(';'))
        .filter(|word| word.starts_with("lib") && *word != "libc6-dev")
        .collect();
    let mut named: Vec<&str> = depended[1..].iter().chain(&recommended).map(String::as_str).collect();
    needed.sort_unstable();
    // OSMesa's package is checked before it is installed.
    needed.dedup();
    named.sort_unstable();
    assert_eq!(named, needed);
}
