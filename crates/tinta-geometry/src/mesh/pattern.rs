//! Patterns for names: `bolt*` names parts and models, `material:steel*` materials.

use super::{Mesh, NONE};
use crate::choice::meant_or;

/// How patterns for materials begin.
const MATERIAL: &str = "material:";

/// Names that an error lists.
const LISTED: usize = 6;

/// A pattern for names of parts, models or materials.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Pattern(pub String);

/// What of a mesh a pattern names.
pub(crate) struct PatternMatches {
    /// The whole model.
    pub model: bool,
    /// Each part, by its number; a part is named if the one that holds it is.
    pub parts: Vec<bool>,
    /// Each material, by its number.
    pub materials: Vec<bool>,
}

impl PatternMatches {
    /// Whether it names anything.
    pub(crate) fn is_any(&self) -> bool {
        self.model || self.parts.contains(&true) || self.materials.contains(&true)
    }

    /// Whether it names triangles of a part and a material, by their numbers or [`NONE`].
    pub(crate) fn holds(&self, [part, material]: [u32; 2]) -> bool {
        let is_named = |list: &[bool], number: u32| list.get(number as usize).copied().unwrap_or(false);
        self.model || is_named(&self.parts, part) || is_named(&self.materials, material)
    }
}

impl Pattern {
    /// The parts and materials of a mesh that it names.
    pub(crate) fn named(&self, mesh: &Mesh) -> PatternMatches {
        if let Some(pattern) = self.0.strip_prefix(MATERIAL) {
            let materials = mesh.materials.iter().map(|material| matches(pattern, &material.name)).collect();
            return PatternMatches { model: false, parts: Vec::new(), materials };
        }
        let mut parts: Vec<bool> = Vec::with_capacity(mesh.parts.len());
        for part in &mesh.parts {
            let is_within = part.within != NONE && parts.get(part.within as usize) == Some(&true);
            parts.push(is_within || matches(&self.0, &part.name));
        }
        PatternMatches { model: matches(&self.0, file_name(&mesh.name)), parts, materials: Vec::new() }
    }

    /// The sentence for a pattern that names nothing in these meshes.
    pub(crate) fn names_nothing<'a>(&self, meshes: impl Iterator<Item = &'a Mesh>) -> String {
        let (word, is_material) = match self.0.strip_prefix(MATERIAL) {
            Some(word) => (word, true),
            None => (self.0.as_str(), false),
        };
        let mut names: Vec<&str> = Vec::new();
        for mesh in meshes {
            let own: Vec<&str> = match is_material {
                true => mesh.materials.iter().map(|material| material.name.as_str()).collect(),
                false => [file_name(&mesh.name)]
                    .into_iter()
                    .chain(mesh.parts.iter().map(|part| part.name.as_str()))
                    .collect(),
            };
            names.extend(own.into_iter().filter(|name| !name.is_empty()));
        }
        names.sort_unstable();
        names.dedup();
        let what = if is_material { "material" } else { "part or model" };
        let listed = names.iter().take(LISTED).copied().collect::<Vec<_>>().join(", ");
        let more = if names.len() > LISTED { format!(" and {} more", names.len() - LISTED) } else { String::new() };
        let there_are =
            if names.is_empty() { "none has a name".to_owned() } else { format!("there are {listed}{more}") };
        format!("no {what} has this name; {}", meant_or(word.trim_matches(['*', '?']), &names, &there_are))
    }
}

/// A model's name without its folder.
fn file_name(name: &str) -> &str {
    name.rsplit(['/', '\\']).next().unwrap_or(name)
}

/// Whether a name fits a pattern: `*` stands for any letters, `?` for one.
fn matches(pattern: &str, name: &str) -> bool {
    let (pattern, name): (Vec<char>, Vec<char>) = (pattern.chars().collect(), name.chars().collect());
    let (mut at, mut of_name) = (0, 0);
    // The last star, and where the letters that it stands for end.
    let mut star: Option<(usize, usize)> = None;
    while of_name < name.len() {
        match pattern.get(at) {
            Some('*') => {
                star = Some((at, of_name));
                at += 1;
            }
            Some(letter) if *letter == '?' || *letter == name[of_name] => {
                at += 1;
                of_name += 1;
            }
            _ => {
                let Some((place, end)) = star else { return false };
                star = Some((place, end + 1));
                (at, of_name) = (place + 1, end + 1);
            }
        }
    }
    pattern[at..].iter().all(|letter| *letter == '*')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stars_and_question_marks_stand_for_letters() {
        for (pattern, name) in [
            ("", ""),
            ("*", ""),
            ("*", "bolt"),
            ("bolt*", "bolt"),
            ("bolt*", "bolt12"),
            ("*lt?2", "bolt12"),
            ("b*l*2", "bolt.2"),
            ("bo?t", "bolt"),
            ("*a*ab", "aaab"),
            ("größe-?", "größe-3"),
        ] {
            assert!(matches(pattern, name), "{pattern} {name}");
        }
        for (pattern, name) in [
            ("", "b"),
            ("bolt", "bolt1"),
            ("bolt?", "bolt"),
            ("*2", "bolt1"),
            ("a*b*c", "acb"),
            ("Bolt", "bolt"),
            ("?", ""),
        ] {
            assert!(!matches(pattern, name), "{pattern} {name}");
        }
    }

    #[test]
    fn many_stars_take_no_time() {
        assert!(!matches(&"*a".repeat(200), &"a".repeat(199)));
    }

    #[test]
    fn a_pattern_that_names_nothing_is_told_what_there_is() {
        let mut mesh = Mesh::triangle();
        mesh.name = "models/plate.glb".to_owned();
        mesh.parts = ["bracket", "bolt0", "bolt1"]
            .map(|name| crate::mesh::NamedPart { name: name.to_owned(), within: NONE })
            .to_vec();
        let sentence = |pattern: &str| Pattern(pattern.to_owned()).names_nothing([&mesh].into_iter());
        assert_eq!(sentence("brackett"), "no part or model has this name; did you mean bracket?");
        assert_eq!(sentence("screw*"), "no part or model has this name; there are bolt0, bolt1, bracket, plate.glb");
        assert_eq!(sentence("material:steel"), "no material has this name; none has a name");
    }

    #[test]
    fn a_part_is_named_with_the_one_that_holds_it() {
        let part = |name: &str, within: u32| crate::mesh::NamedPart { name: name.to_owned(), within };
        let mesh = Mesh { parts: vec![part("arm", NONE), part("hand", 0), part("leg", NONE)], ..Mesh::triangle() };
        let named = |pattern: &str| Pattern(pattern.to_owned()).named(&mesh).parts;
        assert_eq!(named("arm"), [true, true, false]);
        assert_eq!(named("hand"), [false, true, false]);
        assert_eq!(named("*"), [true; 3]);
    }
}
