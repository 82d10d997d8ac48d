//! The uses among a crate's files, from the texts alone: imports and paths, resolved to the file that defines each name.
//!
//! Takes a crate's texts and returns, for each file, the files it uses, with the names. Re-exports are followed: a file that only
//! declares and re-exports its children uses none of them. Comments, literals and tests do not count. Names of standard or
//! foreign crates, and those made by macros of other files, have no file here and are left out.

use std::collections::{BTreeMap, BTreeSet};

/// For each file the files that it uses, and the names it takes from each.
pub type Uses = BTreeMap<String, BTreeMap<String, BTreeSet<String>>>;

/// The uses of a crate with the root `lib.rs`, whose texts `read` returns by their paths below it; and their number.
pub fn uses(read: &dyn Fn(&str) -> Option<String>) -> (Uses, usize) {
    let mut modules = Modules(Vec::new());
    modules.add("lib.rs", "", None, read);
    let (mut uses, mut count) = (Uses::new(), 0);
    for own in 0..modules.0.len() {
        for (other, name) in modules.used_by(own) {
            if other != own {
                let of_file = uses.entry(modules.0[own].file.clone()).or_default();
                of_file.entry(modules.0[other].file.clone()).or_default().insert(name);
                count += 1;
            }
        }
    }
    (uses, count)
}

/// The circles of files that use one another, each by its files.
pub fn circles(uses: &Uses) -> Vec<Vec<String>> {
    let reached = |from: &str| {
        let (mut reached, mut waiting) = (BTreeSet::new(), vec![from.to_owned()]);
        while let Some(file) = waiting.pop() {
            for next in uses.get(&file).into_iter().flat_map(BTreeMap::keys) {
                if reached.insert(next.clone()) {
                    waiting.push(next.clone());
                }
            }
        }
        reached
    };
    let reached: BTreeMap<&str, BTreeSet<String>> = uses.keys().map(|file| (file.as_str(), reached(file))).collect();
    let is_between = |a: &str, b: &str| reached[a].contains(b) && reached.get(b).is_some_and(|of_b| of_b.contains(a));
    let mut circles: Vec<Vec<String>> = Vec::new();
    for file in uses.keys().filter(|file| is_between(file, file)) {
        match circles.iter_mut().find(|circle| is_between(file, &circle[0])) {
            Some(circle) => circle.push(file.clone()),
            None => circles.push(vec![file.clone()]),
        }
    }
    circles
}

/// A name that a module takes over from elsewhere.
struct Import {
    path: Vec<String>,
    /// The imported name; `*` for all names of a module.
    name: String,
    is_public: bool,
    /// Whether it holds for the whole module, not for one function.
    is_of_module: bool,
}

#[derive(Default)]
struct Module {
    file: String,
    parent: Option<usize>,
    children: BTreeMap<String, usize>,
    definitions: BTreeSet<String>,
    imports: Vec<Import>,
    /// All other text, as tokens.
    code: Vec<String>,
}

struct Modules(Vec<Module>);

impl Modules {
    /// Adds a file and those it declares, which lie in `folder`.
    fn add(
        &mut self,
        file: &str,
        folder: &str,
        parent: Option<usize>,
        read: &dyn Fn(&str) -> Option<String>,
    ) -> Option<usize> {
        let own = self.0.len();
        let (mut module, declared) = parsed(&tokens(&read(file)?));
        (module.file, module.parent) = (file.to_owned(), parent);
        self.0.push(module);
        for name in declared {
            let inner = format!("{folder}{name}/");
            let child = self
                .add(&format!("{folder}{name}.rs"), &inner, Some(own), read)
                .or_else(|| self.add(&format!("{inner}mod.rs"), &inner, Some(own), read));
            if let Some(child) = child {
                self.0[own].children.insert(name, child);
            }
        }
        Some(own)
    }

    /// The modules that one uses, with the names.
    fn used_by(&self, own: usize) -> Vec<(usize, String)> {
        let module = &self.0[own];
        let words: BTreeSet<&str> = module.code.iter().map(String::as_str).collect();
        let mut used = Vec::new();
        let mut add = |path: &[String]| {
            if let Some((other, name)) = self.resolve(own, path, &mut Vec::new()) {
                let name = name.unwrap_or_else(|| "itself".to_owned());
                // A file with code of its own that hands the name on is used, too.
                let through = self.named_by(own, path);
                if through != other && !self.is_above(through, own) && !self.0[through].definitions.is_empty() {
                    used.push((through, name.clone()));
                }
                used.push((other, name));
            }
        };
        let mut of_modules = BTreeMap::new();
        for import in &module.imports {
            let (last, before) = import.path.split_last().unwrap();
            if last == "*" {
                let Some((other, None)) = self.resolve(own, before, &mut Vec::new()) else { continue };
                let is_theirs = |word: &&&str| self.0[other].names(word) && !module.names(word);
                if !import.is_public {
                    words.iter().filter(is_theirs).for_each(|word| add(&[before, &[(*word).to_owned()]].concat()));
                }
            } else if let Some((_, None)) = self.resolve(own, &import.path, &mut Vec::new()) {
                of_modules.insert(import.name.as_str(), &import.path);
            } else if !import.is_public || words.contains(import.name.as_str()) {
                add(&import.path);
            }
        }
        for path in paths(&module.code) {
            let first = path[0].as_str();
            if ["crate", "self", "super"].contains(&first) || module.children.contains_key(first) {
                add(&path);
            } else if let Some(imported) = of_modules.get(first) {
                add(&[imported.as_slice(), &path[1..]].concat());
            }
        }
        used
    }

    /// The last module that a path names.
    fn named_by(&self, own: usize, path: &[String]) -> usize {
        let mut module = own;
        for part in path {
            module = match part.as_str() {
                "crate" => 0,
                "self" => module,
                "super" => self.0[module].parent.unwrap_or_default(),
                name => match self.0[module].children.get(name) {
                    Some(child) => *child,
                    None => break,
                },
            };
        }
        module
    }

    /// Whether a module is another, or declares it or a module above it.
    fn is_above(&self, module: usize, other: usize) -> bool {
        std::iter::successors(Some(other), |below| self.0[*below].parent).any(|above| above == module)
    }

    /// The module at the end of a path, and the name that it defines; no name if the path is the module itself.
    fn resolve(
        &self,
        from: usize,
        path: &[String],
        seen: &mut Vec<(usize, Vec<String>)>,
    ) -> Option<(usize, Option<String>)> {
        let Some((first, rest)) = path.split_first() else { return Some((from, None)) };
        if seen.contains(&(from, path.to_vec())) {
            return None;
        }
        seen.push((from, path.to_vec()));
        let module = &self.0[from];
        match first.as_str() {
            "crate" => return self.resolve(0, rest, seen),
            "self" => return self.resolve(from, rest, seen),
            "super" => return self.resolve(module.parent?, rest, seen),
            _ => {}
        }
        if let Some(child) = module.children.get(first) {
            return self.resolve(*child, rest, seen);
        }
        if module.definitions.contains(first) {
            return Some((from, Some(first.clone())));
        }
        let of_module = || module.imports.iter().filter(|import| import.is_of_module);
        for import in of_module().filter(|import| import.name == *first) {
            match self.resolve(from, &import.path, seen) {
                Some((other, None)) => return self.resolve(other, rest, seen),
                Some(found) => return Some(found),
                None => {}
            }
        }
        let globs = of_module().filter(|import| import.name == "*");
        globs.into_iter().find_map(|import| match self.resolve(from, &import.path[..import.path.len() - 1], seen) {
            Some((other, None)) if other != from => self.resolve(other, path, seen),
            _ => None,
        })
    }
}

impl Module {
    /// Whether it defines, declares or takes over a name.
    fn names(&self, name: &str) -> bool {
        let is_imported = || self.imports.iter().any(|import| import.name == name);
        self.definitions.contains(name) || self.children.contains_key(name) || is_imported()
    }
}

/// Names, numbers and signs of a text; `::` is one. Comments and literals are left out, visibilities are `pub` alone.
fn tokens(text: &str) -> Vec<String> {
    let characters: Vec<char> = text.chars().collect();
    let is_word = |c: char| c.is_alphanumeric() || c == '_';
    let at = |place: usize| characters.get(place).copied().unwrap_or('\0');
    let (mut tokens, mut place): (Vec<String>, usize) = (Vec::new(), 0);
    while place < characters.len() {
        let from = place;
        match at(place) {
            '/' if at(place + 1) == '/' => place += characters[place..].iter().take_while(|c| **c != '\n').count(),
            '/' if at(place + 1) == '*' => {
                place += 2;
                while place < characters.len() && [at(place), at(place + 1)] != ['*', '/'] {
                    place += 1;
                }
                place += 2;
            }
            '"' => place = after_text(&characters, place),
            'r' if at(place + 1) == '"' || (at(place + 1) == '#' && ['#', '"'].contains(&at(place + 2))) => {
                let marks = characters[place + 1..].iter().take_while(|c| **c == '#').count();
                let end: String = std::iter::once('"').chain(std::iter::repeat_n('#', marks)).collect();
                let rest: String = characters[place + marks + 2..].iter().collect();
                let length = rest.find(&end).map_or(rest.chars().count(), |byte| rest[..byte].chars().count());
                place += marks + 2 + length + end.len();
            }
            '\'' if at(place + 1) == '\\' => {
                place += 3;
                place += characters[place..].iter().take_while(|c| **c != '\'').count() + 1;
            }
            '\'' if at(place + 2) == '\'' => place += 3,
            ':' if at(place + 1) == ':' => {
                tokens.push("::".to_owned());
                place += 2;
            }
            c if is_word(c) => {
                place += characters[place..].iter().take_while(|c| is_word(**c)).count();
                tokens.push(characters[from..place].iter().collect());
            }
            c => {
                tokens.extend((!c.is_whitespace()).then(|| c.to_string()));
                place += 1;
            }
        }
    }
    // `pub(in crate::lines)` does not use that module.
    let mut plain: Vec<String> = Vec::with_capacity(tokens.len());
    let mut rest = tokens.as_slice();
    while let [token, after @ ..] = rest {
        plain.push(token.clone());
        let is_limited = token == "pub"
            && after.first().is_some_and(|next| next == "(")
            && after.get(1).is_some_and(|next| ["crate", "super", "self", "in"].contains(&next.as_str()));
        rest = if is_limited { &after[after.iter().position(|next| next == ")").unwrap() + 1..] } else { after };
    }
    plain
}

/// Where a text literal that begins here ends.
fn after_text(characters: &[char], start: usize) -> usize {
    let mut place = start + 1;
    while place < characters.len() && characters[place] != '"' {
        place += if characters[place] == '\\' { 2 } else { 1 };
    }
    place + 1
}

/// A file's module, and the modules that it declares.
fn parsed(tokens: &[String]) -> (Module, Vec<String>) {
    const DEFINING: [&str; 9] = ["fn", "struct", "enum", "trait", "type", "const", "static", "union", "macro_rules"];
    let (mut module, mut declared) = (Module::default(), Vec::new());
    let (mut place, mut depth) = (0, 0usize);
    let text = |place: usize| tokens.get(place).map_or("", String::as_str);
    // Whether the braces around are those of a macro, as of one that makes an enum.
    let mut is_in_macro = false;
    while place < tokens.len() {
        match text(place) {
            "#" if text(place + 1) == "[" && is_of_tests(&tokens[place + 2..]) => {
                place = after_item(tokens, place);
                continue;
            }
            "use" if text(place + 1) != "<" => {
                let end = place + tokens[place..].iter().position(|token| token == ";").unwrap();
                let is_public = place > 0 && text(place - 1) == "pub";
                for (path, name) in tree(&tokens[place + 1..end], &[]) {
                    module.imports.push(Import { path, name, is_public, is_of_module: depth == 0 });
                }
                place = end;
            }
            "mod" if depth == 0 && text(place + 2) == ";" => {
                declared.push(text(place + 1).to_owned());
                place += 2;
            }
            "mod" if depth == 0 => drop(module.definitions.insert(text(place + 1).to_owned())),
            "{" => {
                is_in_macro = if depth == 0 { place > 0 && text(place - 1) == "!" } else { is_in_macro };
                depth += 1;
                module.code.push("{".to_owned());
            }
            "}" => depth = depth.saturating_sub(1),
            word => {
                if DEFINING.contains(&word) && (depth == 0 || (is_in_macro && depth == 1)) {
                    let name = if text(place + 1) == "!" { place + 2 } else { place + 1 };
                    module.definitions.insert(text(name).to_owned());
                }
                module.code.push(word.to_owned());
            }
        }
        place += 1;
    }
    (module, declared)
}

/// Whether an attribute, starting at its bracket, marks tests.
fn is_of_tests(attribute: &[String]) -> bool {
    let begins = |with: &[&str]| attribute.iter().zip(with).filter(|(a, b)| a == *b).count() == with.len();
    begins(&["cfg", "(", "test"]) || begins(&["cfg", "(", "all", "(", "test"])
}

/// Where the item ends that the attribute here belongs to.
fn after_item(tokens: &[String], attribute: usize) -> usize {
    let (mut place, mut depth) = (attribute, 0i32);
    let mut is_in_attribute = false;
    while place < tokens.len() {
        match tokens[place].as_str() {
            "#" if depth == 0 => is_in_attribute = true,
            "[" | "(" | "{" => depth += 1,
            "]" | ")" => {
                depth -= 1;
                is_in_attribute &= depth > 0;
            }
            "}" => {
                depth -= 1;
                if depth == 0 {
                    return place + 1;
                }
            }
            ";" if depth == 0 && !is_in_attribute => return place + 1,
            _ => {}
        }
        place += 1;
    }
    place
}

/// The paths of a tree of imports, each with the name it gets.
fn tree(tokens: &[String], before: &[String]) -> Vec<(Vec<String>, String)> {
    match tokens {
        [open, inner @ .., close] if open == "{" && close == "}" => {
            let mut depth = 0;
            let parts = inner.split(|token| {
                depth += i32::from(token == "{") - i32::from(token == "}");
                depth == 0 && token == ","
            });
            parts.flat_map(|part| tree(part, before)).collect()
        }
        [sign, rest @ ..] if sign == "::" => tree(rest, before),
        [name, sign, rest @ ..] if sign == "::" => tree(rest, &[before, std::slice::from_ref(name)].concat()),
        [name, rest @ ..] => {
            let path = if name == "self" && !before.is_empty() {
                before.to_vec()
            } else {
                [before, std::slice::from_ref(name)].concat()
            };
            let alias = rest.get(1).unwrap_or(path.last().unwrap()).clone();
            vec![(path, alias)]
        }
        [] => Vec::new(),
    }
}

/// The paths of two names or more in some code.
fn paths(code: &[String]) -> Vec<Vec<String>> {
    let is_name = |token: &String| token.starts_with(|c: char| c.is_alphabetic() || c == '_');
    let (mut found, mut place) = (Vec::new(), 0);
    while place < code.len() {
        let mut path = Vec::new();
        while code.get(place).is_some_and(is_name) {
            path.push(code[place].clone());
            place += 1;
            if code.get(place).is_none_or(|sign| sign != "::") {
                break;
            }
            place += 1;
        }
        if path.len() > 1 {
            found.push(path);
        } else if path.is_empty() {
            place += 1;
        }
    }
    found
}
