//! The workflows name runners that are still offered, actions by a commit, and scripts that exist.

use crate::support::root;

/// The runners in use. Those of withdrawn systems, such as macos-13, wait for ever.
const RUNNERS: [&str; 6] =
    ["ubuntu-latest", "ubuntu-24.04-arm", "windows-latest", "macos-latest", "macos-15-intel", "${{ matrix.os }}"];

/// Every workflow by its name, and the steps that several share.
fn workflows() -> Vec<(String, String)> {
    let files = std::fs::read_dir(root().join(".github/workflows")).unwrap().map(|file| file.unwrap().path());
    let shared = [root().join(".github/actions/prepare/action.yml")];
    files.chain(shared).map(|path| (path.display().to_string(), std::fs::read_to_string(path).unwrap())).collect()
}

/// What follows this key, in every line that has it.
fn values<'a>(text: &'a str, key: &'a str) -> impl Iterator<Item = &'a str> {
    text.lines().filter_map(move |line| line.trim_start().trim_start_matches("- ").strip_prefix(key)).map(str::trim)
}

/// Whether an action is named by a commit, with the release that it is of.
fn is_pinned(action: &str) -> bool {
    let Some((name, release)) = action.split_once(" # v") else { return false };
    let commit = name.split_once('@').map(|(_, commit)| commit).unwrap_or_default();
    let is_commit = commit.len() == 40 && commit.bytes().all(|byte| matches!(byte, b'0'..=b'9' | b'a'..=b'f'));
    is_commit && release.split('.').count() == 3
}

#[test]
fn every_job_runs_where_it_can() {
    let mut count = 0;
    for (name, text) in workflows() {
        let listed = values(&text, "os: [").flat_map(|list| list.trim_end_matches(']').split(", "));
        for runner in values(&text, "runs-on:").chain(listed) {
            assert!(RUNNERS.contains(&runner), "{name}: {runner} is no known runner");
            count += 1;
        }
    }
    assert!(count >= 8, "{count} runners");
}

#[test]
fn every_action_is_pinned_by_a_commit() {
    let mut count = 0;
    for (name, text) in workflows() {
        for action in values(&text, "uses:") {
            match action.strip_prefix("./") {
                Some(own) => assert!(root().join(own).exists(), "{name}: there is no {own}"),
                None => assert!(is_pinned(action), "{name}: {action}"),
            }
            count += 1;
        }
    }
    assert!(count >= 8, "{count} actions");
    assert!(!is_pinned("actions/checkout@v4") && !is_pinned("actions/checkout@v4 # v4.2.2"));
}

#[test]
fn the_scripts_of_every_job_exist_and_features_and_the_oldest_rust_have_jobs() {
    let mut scripts = Vec::new();
    for (name, text) in workflows() {
        for script in values(&text, "run:").filter_map(|command| command.split(' ').next()) {
            if script.starts_with("scripts/") {
                assert!(root().join(script).is_file(), "{name}: there is no {script}");
                scripts.push(script.to_owned());
            }
        }
    }
    for needed in [
        "scripts/features",
        "scripts/oldest-rust",
        "scripts/python",
        "scripts/test",
        "scripts/test-elsewhere",
        "scripts/web",
    ] {
        assert!(scripts.iter().any(|script| script == needed), "no job runs {needed}");
    }
}

/// The project's files of Rust.
fn sources() -> Vec<String> {
    let mut folders = ["src", "crates", "tests"].map(|folder| root().join(folder)).to_vec();
    let mut sources = Vec::new();
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()) {
            if entry.is_dir() {
                folders.push(entry);
            } else if entry.extension().is_some_and(|extension| extension == "rs") {
                sources.push(std::fs::read_to_string(entry).unwrap());
            }
        }
    }
    sources
}

#[test]
fn tests_that_are_left_out_by_name_run_at_night_or_have_an_exhaustive_twin() {
    let script = std::fs::read_to_string(root().join("scripts/test")).unwrap();
    assert!(script.contains("--skip _briefly --skip _nightly"));
    let mut counts = [0; 2];
    for text in sources() {
        let tests: Vec<&str> = text.split("#[test]\n").skip(1).collect();
        let is_exhaustive = |test: &&str| test.trim_start().starts_with("#[ignore = \"exhaustive: ");
        for test in &tests {
            let Some((_, name)) = test.split_once("fn ") else { continue };
            let name = name.split('(').next().unwrap();
            let is_nightly = test.trim_start().starts_with("#[ignore = \"nightly: ");
            assert_eq!(name.ends_with("_nightly"), is_nightly, "{name}");
            counts[0] += usize::from(is_nightly);
            if name.ends_with("_briefly") {
                assert!(tests.iter().any(is_exhaustive), "{name} has no exhaustive twin in its file");
                counts[1] += 1;
            }
        }
    }
    assert!(counts.iter().all(|count| *count > 2), "{counts:?}");
}
