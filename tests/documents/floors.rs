//! The floors of both libraries: their `lib.rs` list the modules from the ground up, and each uses only those before it. And within
//! every crate no files use one another in a circle.

mod imports;

use crate::support::root;
use imports::{Uses, circles, uses};
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

/// The names of the crate's root that a source uses, outside comments and tests.
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

/// The files that make a scene: the place where every drawing begins, and those that draw no request. The laboratory may make its own.
const SCENE_MAKERS: [(&str, &str); 4] = [
    ("src/request/resolve.rs", "every drawing begins here"),
    ("src/cli/info.rs", "counts the edges of a model"),
    ("src/drivers.rs", "draws a known model by every driver"),
    ("src/renderer.rs", "draws a triangle, so that the driver compiles its shaders"),
];

#[test]
fn scenes_are_made_where_drawings_begin_and_nowhere_else() {
    let mut files = Vec::new();
    ["src", "python/src", "web/src"].iter().for_each(|folder| sources(&root().join(folder), &mut files));
    let makes_one = |file: &&PathBuf| {
        let text = std::fs::read_to_string(file).unwrap();
        let code = text.split("#[cfg(test)]\nmod tests {").next().unwrap();
        code.lines().any(|line| !line.trim_start().starts_with("//") && line.contains("Scene::new("))
    };
    let found: Vec<String> =
        files.iter().filter(makes_one).map(|file| file.strip_prefix(root()).unwrap().display().to_string()).collect();
    let mut expected = SCENE_MAKERS.map(|(file, _)| file.to_owned()).to_vec();
    expected.sort();
    let mut sorted = found;
    sorted.sort();
    assert_eq!(sorted, expected, "begin with Request::resolve, still, moving or placed");
}

/// The crates, and how many uses each has at least: fewer mean that its texts are read wrong.
const CRATES: [(&str, usize); 5] = [
    ("crates/tinta-geometry/src", 1000),
    ("src", 1300),
    ("crates/tinta-lab/src", 300),
    ("python/src", 50),
    ("web/src", 8),
];

/// The names that tie a circle, file by file.
fn ties(uses: &Uses, circle: &[String]) -> String {
    let mut text = String::new();
    for file in circle {
        for (other, names) in uses[file].iter().filter(|(other, _)| circle.contains(other)) {
            text.push_str(&format!("\n  {file} uses {names:?} of {other}"));
        }
    }
    text
}

#[test]
fn no_files_use_one_another_in_a_circle() {
    let mut problems = String::new();
    for (folder, least) in CRATES {
        let (uses, count) = uses(&|file| std::fs::read_to_string(root().join(folder).join(file)).ok());
        assert!(count >= least, "only {count} uses found in {folder}");
        for circle in circles(&uses) {
            problems.push_str(&format!("\na circle in {folder}:{}", ties(&uses, &circle)));
        }
    }
    assert!(problems.is_empty(), "{problems}\nmove what they share into a file below them");
}

/// The circles of a crate of these texts.
fn circles_of(texts: &[(&str, &str)]) -> Vec<Vec<String>> {
    circles(&uses(&|file| Some(texts.iter().find(|(name, _)| *name == file)?.1.to_owned())).0)
}

#[test]
fn a_circle_is_found_through_re_exports_and_every_way_of_naming_a_file() {
    let made_up = |inner| {
        circles_of(&[
            ("lib.rs", "pub mod a; mod b; pub use a::A as First; // mod c;"),
            ("a.rs", "use super::b::{self, Kind::{self, One}};\npub struct A(b::B);"),
            ("b.rs", "mod inner;\npub use inner::*;"),
            ("b/inner.rs", inner),
        ])
    };
    let tied = vec![vec!["a.rs".to_owned(), "b/inner.rs".to_owned()]];
    for text in [
        "use crate::First; pub enum Kind { One(Box<First>) } pub struct B;",
        "pub struct B; pub fn kind() { crate::a::A::new(); }",
        "pub struct B; fn kind() { use super::super::a::{A}; A::new(); }",
        "use crate::a; pub struct B(a::A);",
        "use crate::*; pub struct B(First);",
    ] {
        assert_eq!(made_up(text), tied, "{text}");
    }
    for text in [
        "pub struct B; // crate::a::A",
        "pub struct B(&'static str); const TEXT: &str = \"crate::a::A\"; const RAW: &str = r#\"crate::a::A\"#;",
        "pub struct B; #[cfg(test)] mod tests { use crate::First; }",
        "pub struct B; #[cfg(test)] use crate::First; #[cfg(test)] #[allow(unused)] fn first() -> First { todo!() }",
        "pub(in crate::a) struct B;",
    ] {
        assert!(made_up(text).is_empty(), "{text}");
    }
    // A parent and its child.
    let parent = [
        ("lib.rs", "mod a;"),
        ("a.rs", "mod b; struct A; fn f() { b::g() }"),
        ("a/b.rs", "use super::A; pub fn g() {}"),
    ];
    assert_eq!(circles_of(&parent), [["a.rs", "a/b.rs"]]);
}

#[test]
fn a_circle_is_found_through_a_file_that_hands_a_name_on() {
    let facade = |code| {
        [
            ("lib.rs", "mod a; mod b;"),
            ("a.rs", "use super::b::C; pub struct A;"),
            ("b.rs", code),
            ("b/c.rs", "pub struct C;"),
        ]
    };
    assert_eq!(circles_of(&facade("mod c; pub use c::C; fn f(a: super::a::A) {}")), [["a.rs", "b.rs"]]);
    assert!(circles_of(&facade("mod c; pub use c::C;")).is_empty());
}
