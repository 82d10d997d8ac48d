//! The floors of both libraries: their `lib.rs` list the modules from the ground up, and each uses only those before it.

use crate::support::root;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// The modules in the order of a library's `lib.rs`, and of each name it re-exports the module it is of.
fn floors(library: &Path) -> (Vec<String>, BTreeMap<String, String>) {
    let text = std::fs::read_to_string(library.join("lib.rs")).unwrap();
    let mut modules = Vec::new();
    let mut names = BTreeMap::new();
    // A re-export may go over several lines.
    for statement in text.lines().filter(|line| !line.trim_start().starts_with("//")).collect::<String>().split(';') {
        let words: Vec<&str> = statement.split_whitespace().collect();
        match words.as_slice() {
            [.., "mod", module] => modules.push((*module).to_owned()),
            _ if words.contains(&"use") => {
                let Some((module, list)) = statement.split("pub use ").nth(1).and_then(|use_| use_.split_once("::"))
                else {
                    continue;
                };
                let list = list.trim_matches(|c: char| "{} ".contains(c));
                names.extend(list.split(',').map(|name| (name.trim().to_owned(), module.trim().to_owned())));
            }
            _ => {}
        }
    }
    (modules, names)
}

fn sources(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).into_iter().flatten() {
        let path = entry.unwrap().path();
        let name = path.file_stem().unwrap().to_str().unwrap();
        if path.is_dir() && name != "tests" {
            sources(&path, found);
        } else if path.extension().is_some_and(|end| end == "rs") && name != "tests" && !name.ends_with("_tests") {
            found.push(path);
        }
    }
}

/// What a source names of the crate's root, outside comments and tests.
fn named(text: &str) -> Vec<String> {
    let code = text.split("#[cfg(test)]\nmod tests {").next().unwrap();
    let code: String =
        code.lines().filter(|line| !line.trim_start().starts_with("//")).map(|line| format!("{line} ")).collect();
    let mut found = Vec::new();
    for rest in code.split("crate::").skip(1) {
        let list = rest.strip_prefix('{').map_or(rest, |rest| rest.split('}').next().unwrap());
        let items = if rest.starts_with('{') { list.split(',').collect() } else { vec![list] };
        for item in items {
            let name: String = item.trim().chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect();
            found.extend((!name.is_empty()).then_some(name));
        }
    }
    found
}

/// Asserts it of the library in this folder, which has at least so many modules and uses.
fn check(folder: &str, least_modules: usize, least_uses: usize) {
    let library = root().join(folder);
    let (modules, names) = floors(&library);
    assert!(modules.len() >= least_modules && names.len() > 10, "{folder}/lib.rs is read wrong: {modules:?} {names:?}");
    let floor = |module: &str| modules.iter().position(|known| known == module);
    let (mut seen, mut upwards) = (0, Vec::new());
    for (own, module) in modules.iter().enumerate() {
        let mut files = vec![library.join(format!("{module}.rs"))];
        sources(&library.join(module), &mut files);
        for file in files {
            for name in named(&std::fs::read_to_string(&file).unwrap()) {
                let used = names.get(&name).unwrap_or(&name);
                let Some(other) = floor(used) else { continue };
                seen += 1;
                if other > own {
                    upwards.push(format!("{} uses {used}", file.strip_prefix(root()).unwrap().display()));
                }
            }
        }
    }
    assert!(seen > least_uses, "only {seen} uses found in {folder}");
    assert!(upwards.is_empty(), "upwards: {upwards:#?}");
}

#[test]
fn modules_use_only_those_below_them() {
    check("src", 20, 150);
    check("crates/tinta-geometry/src", 15, 100);
}
