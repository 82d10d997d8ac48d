//! The parts of an OBJ file: its objects (`o`) and their groups (`g`).

use super::super::soup::Soup;
use super::super::{NONE, NamedPart};
use super::chunk::Naming;
use std::collections::HashMap;

/// Gives faces their parts: the last group before them, within the last object before them.
pub(super) fn put_on(soup: &mut Soup, namings: &[(usize, Naming)]) {
    let mut numbers: HashMap<(u32, &str), u32> = HashMap::new();
    let mut parts: Vec<NamedPart> = Vec::new();
    let mut of_faces: Vec<u32> = Vec::new();
    let (mut object, mut current) = (NONE, NONE);
    for (before, naming) in namings {
        let (within, name) = match naming {
            Naming::Object(name) => (NONE, name),
            Naming::Group(name) => (object, name),
            Naming::Use(_) | Naming::Library(_) => continue,
        };
        of_faces.resize(*before, current);
        // A group without a name ends the one before it.
        current = match name.as_str() {
            "" => within,
            name => *numbers.entry((within, name)).or_insert_with(|| {
                parts.push(NamedPart { name: name.to_owned(), within });
                parts.len() as u32 - 1
            }),
        };
        if matches!(naming, Naming::Object(_)) {
            object = current;
        }
    }
    if !parts.is_empty() {
        of_faces.resize(soup.polygon_count(), current);
        (soup.parts, soup.polygon_parts) = (parts, of_faces);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn faces_have_the_last_group_of_the_last_object_before_them() {
        let soup = || Soup { polygon_sizes: vec![3; 6], ..Soup::default() };
        let object = |before, name: &str| (before, Naming::Object(name.to_owned()));
        let group = |before, name: &str| (before, Naming::Group(name.to_owned()));
        let namings = [
            object(1, "arm"),
            group(2, "a b"),
            (2, Naming::Use("steel".to_owned())),
            group(3, ""),
            object(4, "leg"),
            group(4, "a b"),
            object(5, "arm"),
        ];
        let mut read = soup();
        put_on(&mut read, &namings);
        let part = |name: &str, within| NamedPart { name: name.to_owned(), within };
        assert_eq!(read.parts, [part("arm", NONE), part("a b", 0), part("leg", NONE), part("a b", 2)]);
        assert_eq!(read.polygon_parts, [NONE, 0, 1, 0, 3, 0]);
        let mut without = soup();
        put_on(&mut without, &[(0, Naming::Use("steel".to_owned()))]);
        assert!(without.parts.is_empty() && without.polygon_parts.is_empty());
    }
}
