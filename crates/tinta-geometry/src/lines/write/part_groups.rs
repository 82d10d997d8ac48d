//! The paths of a layer by parts, which let a page find and style each part of a drawing.
//!
//! Input: a drawing and a layer of it. Output: for each named part its paths; those of several parts are split where the part changes.

use crate::lines::drawing::chain::LinePath;
use crate::lines::drawing::drawn_layers::{Drawing, DrawnLayer};
use crate::lines::parts::scene_parts::ScenePart;
use crate::mesh::SECTION;
use std::borrow::Cow;
use std::collections::{BTreeMap, BTreeSet};

/// The name of each part: its own, after its model's where there are several. All are empty in a drawing of one part.
pub(super) fn names(parts: &[ScenePart]) -> Vec<String> {
    let own: BTreeSet<&str> =
        parts.iter().map(|part| &*part.name).filter(|name| !["", SECTION].contains(name)).collect();
    let models: BTreeSet<&str> = parts.iter().map(|part| &*part.model).collect();
    let name = |part: &ScenePart| match (models.len(), own.len()) {
        (2.., _) => format!("{} {}", part.model, part.name).trim_end().to_owned(),
        (_, 2..) => part.name.clone(),
        _ => String::new(),
    };
    parts.iter().map(name).collect()
}

/// The paths of a layer by these names of parts; strokes and a sheet's own lines have none.
pub(super) fn by_part<'d>(
    drawing: &'d Drawing<'_>,
    layer: &'d DrawnLayer,
    names: &'d [String],
) -> BTreeMap<&'d str, Vec<Cow<'d, LinePath>>> {
    let name = |segment: &usize| names.get(drawing.lines.segments[*segment].part as usize).map_or("", String::as_str);
    let mut parts: BTreeMap<&str, Vec<Cow<'_, LinePath>>> = BTreeMap::new();
    for path in &layer.paths {
        let mut whole = Cow::Borrowed(path);
        let change = path.segments.windows(2).position(|pair| name(&pair[0]) != name(&pair[1]));
        let Some(change) = change else {
            parts.entry(path.segments.first().map_or("", name)).or_default().push(whole);
            continue;
        };
        if path.is_closed {
            let opened = whole.to_mut();
            opened.rotate(change + 1);
            opened.points_px.push(opened.points_px[0]);
        }
        let mut from = 0;
        for segments in whole.segments.chunk_by(|one, next| name(one) == name(next)) {
            let points_px = whole.points_px[from..=from + segments.len()].to_vec();
            from += segments.len();
            let piece = LinePath { points_px, segments: segments.to_vec(), is_closed: false, ..*path };
            parts.entry(name(&segments[0])).or_default().push(Cow::Owned(piece));
        }
    }
    parts
}

/// A name as part of an id, other letters by their numbers as in `_x0020_`. Different names have different ids.
pub(super) fn in_id(name: &str) -> String {
    let is_plain = |letter: char| letter.is_ascii_alphanumeric() || "-_.".contains(letter);
    let by_number =
        |letter: char| if is_plain(letter) { letter.to_string() } else { format!("_x{:04X}_", letter as u32) };
    name.replace("_x", "_x005F_x").chars().map(by_number).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn different_names_have_different_ids_of_plain_letters() {
        for (name, id) in [
            ("bolt_2", "bolt_2"),
            ("bolt 2", "bolt_x0020_2"),
            ("bolt_x0020_2", "bolt_x005F_x0020_2"),
            ("Größe <\"", "Gr_x00F6__x00DF_e_x0020__x003C__x0022_"),
        ] {
            assert_eq!(in_id(name), id);
        }
    }
}
