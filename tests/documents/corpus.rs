//! Every file of the fuzz corpus through the function that the fuzz target runs, with an ordinary compiler.

#[path = "../../fuzz/src/readers.rs"]
mod readers;
#[path = "../../fuzz/src/scenes.rs"]
mod scenes;
#[path = "../../fuzz/src/words.rs"]
mod words;

use crate::support::root;

/// A target's function of any bytes.
type Target = fn(&[u8]);

#[test]
fn every_file_of_the_corpus_is_read_or_refused_as_it_should_be() {
    let targets: [(&str, Target); 16] = [
        ("obj", readers::obj),
        ("ply", readers::ply),
        ("stl", readers::stl),
        ("md2", readers::md2),
        ("three_ds", readers::three_ds),
        ("three_mf", readers::three_mf),
        ("gltf", readers::gltf),
        ("load", readers::load),
        ("picture", readers::picture),
        ("ramp", readers::ramp),
        ("rows", readers::rows),
        ("batch", readers::batch),
        ("preset", readers::preset),
        ("recipe", readers::recipe),
        ("command_line", words::command_line),
        ("drawing", scenes::drawing),
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
