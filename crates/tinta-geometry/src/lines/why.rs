//! Why a line is visible or hidden at a place of the picture.

use crate::edges::Class;
use crate::error::{Error, Result};
use crate::lines::LineSegment;
use crate::lines::eye::image::Image;
use crate::lines::input::candidates::Candidates;
use crate::lines::input::line_input::LineInput;
use crate::lines::progress::Progress;
use crate::lines::settings::LineSettings;
use crate::lines::sight::Sight;
use crate::lines::visible::interval::Interval;
use crate::lines::visible::line_index::LineIndex;
use crate::lines::visible_lines::VisibleLines;
use crate::mesh::{Mesh, triangle_normal};
use crate::scene::Scene;
use crate::tolerances::JOINED_PX;
use glam::DVec2;
use serde::Serialize;
use std::sync::Arc;
use std::time::Duration;

/// The line nearest to a place of the picture, where it is visible, and what hides it elsewhere.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Why {
    /// The place asked about, pixels from the upper left corner, y down.
    pub asked_px: [f64; 2],
    /// The line nearest to it.
    pub line: WhyLine,
    /// The line's nearest place, pixels.
    pub nearest_px: [f64; 2],
    /// Distance between the two, pixels.
    pub distance_px: f64,
    /// Whether the line is visible there.
    pub is_visible: bool,
    /// What hides it there; empty where it is visible.
    pub hidden_by: Vec<Hider>,
    /// All of the line that is in the picture, from one end to the other. What is drawn as another line in the same place is left out.
    pub pieces: Vec<WhyPiece>,
    /// Whether the drawing shows a hidden piece or hides a visible one: a fault of the search for lines, which decides with fewer
    /// tests than this answer. False also where the search takes more than two seconds.
    pub is_drawn_otherwise: bool,
}

/// A line of the drawing.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct WhyLine {
    /// Its class by name.
    pub class: &'static str,
    /// Its object's number in the scene.
    pub object: u32,
    /// The object's name: that of its file.
    pub name: String,
    /// Two vertices by their numbers in the file, from 0; `None` for a line that runs through faces.
    pub edge: Option<[u32; 2]>,
    /// The angle between its two faces' normals, degrees; `None` for an edge without exactly two faces with area.
    pub angle_degrees: Option<f64>,
}

/// A piece of a line that is visible or hidden as a whole.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct WhyPiece {
    /// Where it begins, pixels.
    pub from_px: [f64; 2],
    /// Where it ends, pixels.
    pub to_px: [f64; 2],
    /// Whether it is visible.
    pub is_visible: bool,
    /// What hides it in its middle; empty where it is visible.
    pub hidden_by: Vec<Hider>,
}

/// What hides a line at a place; the nearest to the eye comes first.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(tag = "kind", rename_all = "kebab-case")]
pub enum Hider {
    /// A face in front of it. The line is hidden where faces hide both of its sides.
    Face {
        /// Its object's number in the scene.
        object: u32,
        /// The object's name.
        name: String,
        /// The triangle's number in the object, from 0; `None` for one that came about where the mesh was repaired.
        face: Option<u32>,
        /// Its three vertices by their numbers in the file, from 0.
        vertices: [u32; 3],
        /// How much nearer to the eye it is in depth, file units.
        in_front: f64,
        /// Whether it hides the left side of the line, seen from the end where the first piece begins.
        left: bool,
        /// Whether it hides the right side.
        right: bool,
    },
    /// A line that lies on it in the picture.
    Line {
        /// Which.
        line: WhyLine,
        /// How much nearer to the eye it is in depth, file units; 0 for one in the same place, which is drawn for both.
        in_front: f64,
    },
}

impl Hider {
    /// How much nearer to the eye it is in depth, file units.
    pub fn in_front(&self) -> f64 {
        let (Self::Face { in_front, .. } | Self::Line { in_front, .. }) = self;
        *in_front
    }
}

impl VisibleLines {
    /// Tells why the line nearest to a place of the picture is visible or hidden. Of lines equally near to the place it is a visible one,
    /// then the nearest to the eye. The line is decided by all faces and lines, as [`LineSettings::reference`] says.
    ///
    /// # Errors
    ///
    /// [`Error::Setting`] for a place outside of the picture, for a scene without lines there, and as in [`VisibleLines::of`]; for smooth
    /// silhouettes, too.
    pub fn why(scene: &Scene, settings: &LineSettings, px: DVec2) -> Result<Why> {
        let size = DVec2::new(f64::from(scene.size.width), f64::from(scene.size.height));
        if !(px.cmpge(DVec2::ZERO).all() && px.cmple(size).all()) {
            let problem = format!(
                "this is outside of the picture; choose x from 0 to {} and y from 0 to {}",
                scene.size.width, scene.size.height
            );
            return Err(Error::value("place", format!("{},{}", px.x, px.y), problem));
        }
        let by_rules = LineSettings { reference: true, ..settings.clone() };
        let sight = Sight::of(scene);
        let (input, search, progress) = (LineInput::of(&sight, &by_rules)?, Arc::default(), Progress::default());
        let candidates = Candidates::of(&input, &search, &progress)?;
        let lines = LineIndex::new(&input, &candidates, &search, &progress)?;
        let mut why = NamedLines { lines: &lines, input: &input }.nearest(px).ok_or_else(|| {
            Error::setting("classes", "the picture has no line of these classes; name others, or move the camera")
        })?;
        let settings = LineSettings { finds_hidden: true, reference: false, ..settings.clone() };
        let drawn = Self::with_progress(scene, &settings, &Progress::within(SEARCH))
            .map_or_else(|_| Vec::new(), |it| it.segments);
        why.is_drawn_otherwise = why.pieces.iter().any(|piece| piece.is_drawn_otherwise(&why.line, &drawn));
        Ok(why)
    }
}

/// The longest search that an answer is compared with.
const SEARCH: Duration = Duration::from_secs(2);

impl WhyPiece {
    /// Whether a drawing of the line's edge differs in the middle of this piece.
    fn is_drawn_otherwise(&self, line: &WhyLine, drawn: &[LineSegment]) -> bool {
        let middle = DVec2::from(self.from_px).midpoint(DVec2::from(self.to_px));
        let is_there = |segment: &&LineSegment| {
            let [a, b] = segment.ends_px;
            let share = (middle - a).dot(b - a) / a.distance_squared(b);
            line.edge.is_some()
                && (segment.edge, segment.object) == (line.edge, line.object)
                && segment.class.name() == line.class
                && (0.0..=1.0).contains(&share)
                && a.lerp(b, share).distance(middle) < JOINED_PX
        };
        let mut there = drawn.iter().filter(is_there).peekable();
        there.peek().is_some() && there.all(|segment| segment.is_visible != self.is_visible)
    }
}

/// A scene's lines with the names of their objects and parts.
struct NamedLines<'a> {
    lines: &'a LineIndex<'a>,
    input: &'a LineInput<'a>,
}

/// A line that may be the nearest.
struct Candidate {
    index: usize,
    image: Image,
    place: f64,
    pieces: Vec<Interval>,
}

impl NamedLines<'_> {
    fn nearest(&self, px: DVec2) -> Option<Why> {
        let lines = self.lines;
        let near = |index: usize| {
            let (image, [from, to]) = lines.wanted(index)?;
            let place = image.place_of(px).clamp(from, to);
            Some((index, image, place, image.at(place).distance(px)))
        };
        let mut all: Vec<_> = (0..lines.features.len()).filter_map(near).collect();
        all.sort_by(|a, b| a.3.total_cmp(&b.3));
        let mut best: Option<(Candidate, f64)> = None;
        for (index, image, place, distance) in all {
            let is_tie = |best: &(Candidate, f64)| distance <= best.1 + image.touch_px(lines.space);
            if best.as_ref().is_some_and(|best| !is_tie(best)) {
                break;
            }
            let candidate = Candidate { index, image, place, pieces: lines.pieces(index) };
            let is_better = |best: &(Candidate, f64)| {
                let rank = |candidate: &Candidate| (!candidate.is_visible(), candidate.image.key(candidate.place));
                let (own, other) = (rank(&candidate), rank(&best.0));
                own.0.cmp(&other.0).then(own.1.total_cmp(&other.1)).is_lt()
            };
            // A line that others stand for everywhere is none.
            if !candidate.pieces.is_empty() && best.as_ref().is_none_or(is_better) {
                let nearest = best.map_or(distance, |best| best.1);
                best = Some((candidate, nearest));
            }
        }
        best.map(|(candidate, _)| self.why(px, &candidate))
    }

    fn why(&self, px: DVec2, candidate: &Candidate) -> Why {
        let Candidate { index, image, place, pieces } = candidate;
        let pieces: Vec<WhyPiece> = pieces
            .iter()
            .map(|&Interval { from, to, is_visible, .. }| WhyPiece {
                from_px: image.at(from).to_array(),
                to_px: image.at(to).to_array(),
                is_visible,
                hidden_by: if is_visible { Vec::new() } else { self.hiders(*index, image, (from + to) * 0.5) },
            })
            .collect();
        let is_visible = candidate.is_visible();
        let mut hidden_by = if is_visible { Vec::new() } else { self.hiders(*index, image, *place) };
        // Just where a piece ends what hides it may end, too.
        if let Some(piece) = candidate.piece().filter(|_| hidden_by.is_empty()) {
            hidden_by.clone_from(&pieces[piece].hidden_by);
        }
        let nearest = image.at(*place);
        Why {
            asked_px: px.to_array(),
            line: self.line(*index),
            nearest_px: nearest.to_array(),
            distance_px: nearest.distance(px),
            is_visible,
            hidden_by,
            pieces,
            is_drawn_otherwise: false,
        }
    }

    fn line(&self, index: usize) -> WhyLine {
        let feature = &self.lines.features[index];
        WhyLine {
            class: feature.class.map_or("", Class::name),
            object: feature.object,
            name: self.name(feature.object as usize),
            edge: feature.edge,
            angle_degrees: feature.angle_degrees,
        }
    }

    /// The name of an object.
    fn name(&self, object: usize) -> String {
        self.input.scene.objects[object].mesh.name.clone()
    }

    /// The faces that hide a line at a place, on one side at least, and the nearer lines that lie on it; the nearest first.
    fn hiders(&self, index: usize, image: &Image, place: f64) -> Vec<Hider> {
        let LineIndex { space, faces, .. } = *self.lines;
        let probe = self.lines.probe(index, image, place);
        let depth = -probe.view.z;
        let face = |face: u32| {
            let [left, right] = faces.hides(space, face, &probe);
            let (object, number) = faces.in_object(faces.numbers[face as usize]);
            let corners = faces.corners(face);
            let normal = triangle_normal(corners).filter(|_| left || right)?;
            let (number, vertices) = self.in_file(object, number as usize);
            Some(Hider::Face {
                object: object as u32,
                name: self.name(object),
                face: number,
                vertices,
                in_front: depth - faces.hit_depth(space, [corners[0], normal], &probe),
                left,
                right,
            })
        };
        let nearer = self.lines.nearer_lines(index, image, place).into_iter();
        let line = nearer.map(|(other, in_front)| Hider::Line { line: self.line(other), in_front });
        let mut hiders: Vec<Hider> = self.lines.all_faces().filter_map(face).chain(line).collect();
        hiders.sort_by(|a, b| b.in_front().total_cmp(&a.in_front()));
        hiders
    }

    /// A face's number among the object's own triangles, which repeated ones belong to as well, and its vertices in the file.
    fn in_file(&self, object: usize, face: usize) -> (Option<u32>, [u32; 3]) {
        let (shape, whole) = (self.input.objects[object].shape(), &self.input.objects[object].object.mesh);
        let corners = |mesh: &Mesh, face: usize| mesh.triangles[face].map(|corner| mesh.positions[corner as usize]);
        let wanted = corners(shape, face);
        let is_it = |face: &usize| corners(whole, *face) == wanted;
        let number = Some(face).filter(|face| *face < whole.triangles.len() && is_it(face));
        let number = number.or_else(|| (0..whole.triangles.len()).find(is_it));
        let vertices = shape.triangles[face].map(|corner| shape.file_vertices[corner as usize]);
        (number.map(|number| number as u32), vertices)
    }
}

impl Candidate {
    /// The number of the piece in which the nearest place is.
    fn piece(&self) -> Option<usize> {
        // At a place between two a visible one counts.
        let at = |piece: &Interval| (piece.from..=piece.to).contains(&self.place);
        let visible = self.pieces.iter().position(|piece| piece.is_visible && at(piece));
        visible.or_else(|| self.pieces.iter().position(at))
    }

    fn is_visible(&self) -> bool {
        self.piece().is_some_and(|piece| self.pieces[piece].is_visible)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::SceneSettings;
    use crate::{LoadOptions, load};
    use std::sync::Arc;

    #[test]
    fn the_drawing_shows_what_is_told_and_a_fault_of_the_search_is_found() {
        let meshes = ["open-box", "gear"].map(|name| {
            let path = format!("{}/../../models/{name}.obj", env!("CARGO_MANIFEST_DIR"));
            Arc::new(load(&path, &LoadOptions::default()).unwrap().mesh)
        });
        let scene = Scene::new(meshes.to_vec(), &SceneSettings::default()).unwrap();
        let settings = LineSettings { finds_hidden: true, ..LineSettings::default() };
        let drawn = VisibleLines::of(&scene, &settings).unwrap().segments;
        let is_flipped = |segment: &LineSegment| LineSegment { is_visible: !segment.is_visible, ..segment.clone() };
        let faulty: Vec<LineSegment> = drawn.iter().map(is_flipped).collect();
        let mut found = 0;
        for place in 0..49 {
            let px = DVec2::new(f64::from(place % 7), f64::from(place / 7)) * 64.0 + 64.0;
            let why = VisibleLines::why(&scene, &LineSettings::default(), px).unwrap();
            assert!(!why.is_drawn_otherwise, "{px}: {why:?}");
            found += usize::from(why.pieces.iter().any(|piece| piece.is_drawn_otherwise(&why.line, &faulty)));
        }
        assert!(found > 30, "only {found} of 49");
    }
}
