//! The nearest face at samples of the picture, for scenes with many overlapping faces.
//!
//! Of all faces that hide a place, the nearest is the likeliest to hide its surroundings, too. A depth buffer of face numbers
//! finds it at once, while a hierarchy of boxes returns candidates one by one. The buffer decides nothing: the sure rule tests
//! whether the face hides a line.

use crate::bvh::NO_GROUP;
use crate::lines::eye::faces::Faces;
use crate::lines::eye::image::Image;
use crate::lines::eye::projected_face::ProjectedFace;
use crate::lines::eye::space::Space;
use crate::lines::progress::Progress;
use crate::lines::visible::contact::ProbedLine;
use crate::lines::visible::occluder_probe::{OccluderProbe, SearchDepth};
use crate::ranges::gaps;
use crate::threads::{cores, in_chunks};
use crate::thresholds::THRESHOLDS;
use glam::{DVec2, DVec3};

/// Rows of samples that a thread fills at once.
const ROWS_AT_ONCE: usize = 32;

/// Faces between two checks of the time.
const FACES_A_GLANCE: u32 = 1024;

/// The nearest faces.
pub(in crate::lines) struct NearestFaces {
    sample_px: f64,
    columns: usize,
    /// Row by row; [`NO_GROUP`] marks an empty sample.
    nearest: Vec<u32>,
}

impl NearestFaces {
    /// Finds the nearest faces. Some faces are missing if time runs out.
    pub(in crate::lines) fn new(space: &Space, faces: &Faces, progress: &Progress) -> Self {
        let sample_px = space.size.max_element() / f64::from(1u32 << THRESHOLDS.cells);
        let [columns, rows] = (space.size / sample_px).ceil().to_array().map(|count| count as usize);
        let nearest_faces = Self { sample_px, columns, nearest: Vec::new() };
        let bands = in_chunks(rows, ROWS_AT_ONCE, cores(), |rows| nearest_faces.band(space, faces, rows, progress));
        Self { nearest: bands.concat(), ..nearest_faces }
    }

    /// Returns some rows of samples.
    fn band(&self, space: &Space, faces: &Faces, rows: std::ops::Range<usize>, progress: &Progress) -> Vec<u32> {
        let mut nearest = vec![(f64::INFINITY, NO_GROUP); rows.len() * self.columns];
        let [top_px, bottom_px] = [rows.start, rows.end].map(|row| row as f64 * self.sample_px);
        let is_cut = |face: u32| !faces.cut_by_near.is_empty() && faces.cut_by_near.binary_search(&face).is_ok();
        for (face, around) in (0..).zip(faces.tree.boxes()) {
            if face % FACES_A_GLANCE == 0 && progress.is_over() {
                break;
            }
            let [low, high] = around.corners();
            if high.y < top_px || low.y > bottom_px || is_cut(face) || faces.is_ghost(face) {
                continue;
            }
            let image = ProjectedFace::of(space, faces, face);
            // The samples whose middles lie between two places.
            let sample = |px: f64| (px / self.sample_px - 0.5).ceil().max(0.0) as usize;
            for row in sample(low.y).max(rows.start)..sample(high.y).min(rows.end) {
                let y = (row as f64 + 0.5) * self.sample_px;
                let Some([left, right]) = image.inside_at(y) else { continue };
                let cells = &mut nearest[(row - rows.start) * self.columns..][..self.columns];
                let range = sample(left)..sample(right).min(self.columns);
                for (column, cell) in range.clone().zip(cells.get_mut(range).into_iter().flatten()) {
                    let key = image.key(DVec2::new((column as f64 + 0.5) * self.sample_px, y));
                    if key < cell.0 {
                        *cell = (key, face);
                    }
                }
            }
        }
        nearest.into_iter().map(|(_, face)| face).collect()
    }

    /// Returns the nearest face at about a pixel.
    fn at(&self, px: DVec2) -> Option<u32> {
        let [column, row] = (px / self.sample_px).max(DVec2::ZERO).to_array().map(|at| at as usize);
        let face = *self.nearest.get(row * self.columns + column.min(self.columns - 1))?;
        (face != NO_GROUP).then_some(face)
    }

    /// Whether the nearest faces hide all of an intersection. Tests each open stretch at its middle and its ends.
    pub(in crate::lines) fn hide(&self, space: &Space, faces: &Faces, line: ProbedLine, ends: [DVec3; 2]) -> bool {
        let Some(image) = Image::of(space, ends) else { return false };
        let length = |stretch: &[f64; 2]| stretch[1] - stretch[0];
        let mut open = vec![[0.0, 1.0]];
        while let Some(stretch) = open.pop() {
            let asked = OccluderProbe::new(space, (line, ends), &image, stretch, SearchDepth::Nearer);
            let (mut best, mut known): (Option<[f64; 2]>, _) = (None, [NO_GROUP; 3]);
            for (number, share) in [0.5, 1.0, 0.0].into_iter().enumerate() {
                let Some(face) = self.at(asked.px[0].lerp(asked.px[1], share)).filter(|face| !known.contains(face))
                else {
                    continue;
                };
                known[number] = face;
                let sure = faces.hidden_ranges(space, face, &ProjectedFace::of(space, faces, face), &asked)[0];
                if sure.is_some_and(|sure| best.is_none_or(|best| length(&sure) > length(&best))) {
                    best = sure;
                }
                if best == Some(stretch) {
                    break;
                }
            }
            let Some(sure) = best else { return false };
            open.extend(gaps(stretch, &[sure]));
        }
        true
    }
}

impl ProjectedFace {
    /// Returns the range of a horizontal line inside the image.
    fn inside_at(&self, y: f64) -> Option<[f64; 2]> {
        let mut range = [f64::NEG_INFINITY, f64::INFINITY];
        for (inwards, start) in self.sides() {
            let at_zero = start - inwards.y * y;
            match inwards.x {
                x if x > 0.0 => range[0] = range[0].max(at_zero / x),
                x if x < 0.0 => range[1] = range[1].min(at_zero / x),
                _ if at_zero > 0.0 => return None,
                // Level, or without length.
                _ => {}
            }
        }
        (range[0] < range[1] && range[0].is_finite() && range[1].is_finite()).then_some(range)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lines::LineSettings;
    use crate::lines::eye::cast::{first_hit, nearest_hits};
    use crate::lines::input::feature::Own;
    use crate::lines::input::line_input::LineInput;
    use crate::lines::sight::Sight;
    use crate::lines::visible::intersections::intersections;
    use crate::mesh::Mesh;
    use crate::scene::{Scene, SceneSettings};
    use std::sync::Arc;

    /// Random triangles as large as the scene, about sixty behind one another.
    fn soup() -> Scene {
        let mut state = 7u64;
        let mut number = || {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (state >> 40) as f64 / f64::from(1 << 23) - 1.0
        };
        let positions: Vec<DVec3> = (0..900).map(|_| DVec3::new(number(), number(), number())).collect();
        let triangles = (0..300).map(|face| [face * 3, face * 3 + 1, face * 3 + 2]).collect();
        let file_vertices = (0..900).collect();
        let (normals, triangle_normals) = (Vec::new(), Vec::new());
        let mesh = Mesh { positions, triangles, file_vertices, normals, triangle_normals, ..Mesh::triangle() };
        Scene::new(vec![Arc::new(mesh)], &SceneSettings::default()).unwrap()
    }

    #[test]
    fn the_nearest_face_is_what_a_ray_meets_first() {
        let scene = soup();
        let space = Space::of(&scene);
        let faces = Faces::of(&space, &scene);
        let nearest_faces = NearestFaces::new(&space, &faces, &Progress::default());
        assert_eq!((nearest_faces.sample_px, nearest_faces.columns), (1.0, 512), "samples are the pixels' middles");
        let pixels = (0..512).flat_map(|y| (0..512).map(move |x| DVec2::new(f64::from(x), f64::from(y)) + 0.5));
        let mut covered = 0;
        for (px, face) in pixels.zip(&nearest_faces.nearest) {
            let hits = nearest_hits(&space, &faces, None, px);
            let first = hits.iter().min_by(|a, b| a.depth.total_cmp(&b.depth)).map_or(NO_GROUP, |hit| hit.place);
            assert_eq!(first, *face, "at {px}");
            covered += usize::from(first != NO_GROUP);
        }
        assert!(covered > 50_000, "hardly anything is covered");
    }

    #[test]
    fn an_intersection_that_the_nearest_faces_hide_lies_behind_a_face_everywhere() {
        let scene = soup();
        let sight = Sight::of(&scene);
        let input = LineInput::of(&sight, &LineSettings::default()).unwrap();
        let (space, faces) = (&input.space, &input.faces);
        let nearest_faces = NearestFaces::new(space, faces, &Progress::default());
        let all = &intersections(&input, &Arc::default(), &Progress::default()).lines;
        let (mut hidden, mut points) = (0, 0);
        for line in all {
            let own = Own::Faces(line.faces);
            if !nearest_faces.hide(space, faces, ProbedLine::new(faces, own, line.ends, 1e-7), line.ends) {
                continue;
            }
            hidden += 1;
            for step in 0..=20 {
                let view = line.ends[0].lerp(line.ends[1], f64::from(step) / 20.0);
                let px = space.project(view).0;
                if px.cmpge(DVec2::ZERO).all() && px.cmplt(space.size).all() {
                    let hit = first_hit(space, faces, None, px).unwrap();
                    // Up to the tip, where an edge passes through a face.
                    assert!(hit.depth < -view.z + 1e-9, "{line:?} at {step}: {} of {}", hit.depth, -view.z);
                    points += 1;
                }
            }
        }
        assert!(hidden * 4 > all.len() * 3 && points > 50_000, "{hidden} of {}, {points} points", all.len());
    }
}
