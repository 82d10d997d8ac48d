//! Every file of the fuzz corpus through the function that the fuzz target runs, with an ordinary compiler.

#[path = "../fuzz/src/readers.rs"]
mod readers;
#[path = "../fuzz/src/words.rs"]
mod words;

use crate::support::root;

/// What a target does with any bytes.
type Target = fn(&[u8]);

#[test]
fn every_file_of_the_corpus_is_read_or_refused_as_it_should_be() {
    let targets: [(&str, Target); 14] = [
        ("obj", readers::obj),
        ("ply", readers::ply),
        ("stl", readers::stl),
        ("md2", readers::md2),
        ("three_ds", readers::three_ds),
        ("gltf", readers::gltf),
        ("load", readers::load),
        ("picture", readers::picture),
        ("ramp", readers::ramp),
        ("rows", readers::rows),
        ("batch", readers::batch),
        ("preset", readers::preset),
        ("recipe", readers::recipe),
        ("command_line", words::command_line),
    ];
    let fuzz = root().join("fuzz");
    let count = |folder: &str| std::fs::read_dir(fuzz.join(folder)).unwrap().count();
    assert_eq!((count("corpus"), count("fuzz_targets")), (targets.len(), targets.len()), "a target without a corpus");
    for (name, target) in targets {
        let mut files = 0;
        for entry in std::fs::read_dir(fuzz.join("corpus").join(name)).unwrap() {
            let path = entry.unwrap().path();
            println!("{}", path.display());
            target(&std::fs::read(&path).unwrap());
            files += 1;
        }
        assert!(files >= 4, "{name}: only {files} files");
    }
}

#[test]
fn the_corpus_is_small() {
    let folders = std::fs::read_dir(root().join("fuzz/corpus")).unwrap();
    let files = folders.flat_map(|folder| std::fs::read_dir(folder.unwrap().path()).unwrap());
    let bytes: u64 = files.map(|file| file.unwrap().metadata().unwrap().len()).sum();
    assert!((10_000..600_000).contains(&bytes), "{bytes} bytes");
}

#[test]
fn the_fuzz_targets_name_every_crate_that_the_program_uses() {
    let dependencies = |file: &str| -> Vec<String> {
        let text = std::fs::read_to_string(root().join(file)).unwrap();
        let sections = text.split("\n[").filter(|section| section.lines().next().unwrap().ends_with("dependencies]"));
        let lines = sections.filter(|section| !section.starts_with("dev-")).flat_map(|section| section.lines().skip(1));
        lines.filter_map(|line| line.split_once(" = ")).map(|(name, _)| name.to_owned()).collect()
    };
    let fuzz = dependencies("fuzz/Cargo.toml");
    let mut folders = vec![root().join("src/cli")];
    let mut text = std::fs::read_to_string(root().join("src/cli.rs")).unwrap();
    while let Some(folder) = folders.pop() {
        for path in std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()) {
            match path.is_dir() {
                true => folders.push(path),
                // Tests are not built into the targets, neither those in files of their own nor those at a file's end.
                false
                    if ["tests.rs", "documents.rs", "option_pictures.rs", "round_trip.rs"]
                        .iter()
                        .any(|name| path.ends_with(name)) => {}
                false => {
                    let source = std::fs::read_to_string(path).unwrap();
                    text.push_str(source.split("#[cfg(test)]\nmod tests {").next().unwrap());
                }
            }
        }
    }
    let used = |name: &String| {
        let name = name.replace('-', "_");
        text.lines().any(|line| {
            let line = line.trim_start().strip_prefix("pub ").unwrap_or(line.trim_start());
            line.starts_with(&format!("use {name}::"))
                || (!line.starts_with("//") && line.contains(&format!(" {name}::")))
        })
    };
    let wanted: Vec<String> = dependencies("Cargo.toml").into_iter().filter(used).collect();
    assert!(wanted.len() >= 8, "{wanted:?}");
    for name in wanted {
        assert!(fuzz.contains(&name), "fuzz/Cargo.toml does not name {name}, which src/cli/ uses");
    }
}
