//! The visibility of smooth contours.
//!
//! A point of a smooth contour lies inside a face that may be turned away from the eye. Adjacent faces, up to the
//! polygons' own silhouette, then hide the point, although the smooth surface would not. Therefore another point is
//! tested in its place. The plane through the eye, the point and the smooth normal cuts the faces in a line. The
//! *summit* is the point on this line that lies farthest out in the picture, in the direction of the normal.
//!
//! The search for the summit runs both ways from the point, at least for the length of one edge. It then ends where a
//! face's side agrees with its smooth normals (n . v at all corners has the face's sign), or where n . v along the
//! line changes its sign, which is another contour. A sharp edge always ends it. The point is visible if no face
//! hides the summit, by the rule for all other lines. Faces that hide the summit also cut the plane, so the faces
//! passed on the way cannot hide it.
//!
//! A segment on a sharp edge where only the smooth normals turn away is tested in the same way, from the edge into
//! both its faces.
//!
//! Where the surface bends towards the eye on the normal's side, the normal is reversed. Such a place is visible only
//! from the surface's inner side; on a closed shell it is hidden without a test.
//!
//! A segment is cut where its image crosses nearer edges at which a surface ends or turns away, and where it passes
//! through a face. Its midpoint decides each piece.

use crate::bvh::{NO_GROUP, steps};
use crate::edges::Class;
use crate::lines::LineSegment;
use crate::lines::eye::image::Image;
use crate::lines::eye::touch::{key_slack, piercing};
use crate::lines::input::feature::Own;
use crate::lines::input::line_input::LineInput;
use crate::lines::progress::{Phase, Progress};
use crate::lines::smooth::contours::{ContourPiece, Contours, between};
use crate::lines::visible::contact::{Probe, ProbedLine};
use crate::lines::visible::interval::Interval;
use crate::lines::visible::line_index::LineIndex;
use crate::mesh::NONE;
use crate::threads::{cores, spread_chunks};
use glam::{DVec2, DVec3};

/// A segment of a contour in the picture, with its visible and hidden pieces.
#[derive(Debug, Clone)]
pub(in crate::lines) struct ContourIntervals {
    /// Its index among the contours' segments.
    pub piece: usize,
    pub image: Image,
    pub intervals: Vec<Interval>,
}

/// Most faces that the search for a summit passes in one direction: far more than lie between a contour and a
/// silhouette.
pub(in crate::lines) const MOST_FACES: usize = 64;

/// Contours per batch of a thread.
const CHUNK: usize = 32;

/// The data for deciding the visibility of smooth contours.
pub(in crate::lines) struct ContourLines<'a> {
    pub lines: &'a LineIndex<'a>,
    pub contours: &'a Contours,
    pub input: &'a LineInput<'a>,
}

impl ContourLines<'_> {
    /// Decides every segment inside the picture, in the contours' order.
    pub(in crate::lines) fn decided(&self, progress: &Progress) -> Vec<ContourIntervals> {
        progress.begin(Phase::Contours, self.contours.pieces.len());
        let chunks = spread_chunks(self.contours.pieces.len(), CHUNK, cores(), |range| {
            if progress.is_over() {
                return Vec::new();
            }
            let (count, before) = (range.len(), steps());
            let decided = range.filter_map(|piece| self.decide(piece)).collect::<Vec<_>>();
            progress.advance(count, steps().wrapping_sub(before));
            decided
        });
        chunks.concat()
    }

    /// The segments to draw.
    pub(in crate::lines) fn segments(&self, decided: &[ContourIntervals]) -> Vec<LineSegment> {
        let mut segments = Vec::new();
        for ContourIntervals { piece, image, intervals } in decided {
            let part = self.part_of(&self.contours.pieces[*piece]);
            if !self.input.scene_parts.classes(part).contains(Class::Silhouette) {
                continue;
            }
            let drawn = intervals.iter().filter(|interval| interval.is_visible || self.lines.finds_hidden);
            segments.extend(drawn.map(|interval| {
                let ends_world = image.ends_world(self.lines.space, [interval.from, interval.to]);
                LineSegment {
                    edge: self.edge_in_file(&self.contours.pieces[*piece]),
                    object: self.contours.pieces[*piece].object,
                    part,
                    ..interval.segment(Class::Silhouette, image, ends_world)
                }
            }));
        }
        segments
    }

    /// The part in the scene that a segment belongs to.
    fn part_of(&self, piece: &ContourPiece) -> u32 {
        let object = piece.object as usize;
        self.input.scene_parts.of_face(object, self.input.objects[object].edges.get().mesh(), piece.face)
    }

    /// The edge that a segment lies on, by its vertices in the file.
    fn edge_in_file(&self, piece: &ContourPiece) -> Option<[u32; 2]> {
        let edges = self.input.objects[piece.object as usize].edges.get();
        let ends = edges.list().positions()[piece.on_edge? as usize];
        Some(ends.map(|position| edges.mesh().file_vertices[position as usize]))
    }

    fn decide(&self, number: usize) -> Option<ContourIntervals> {
        let (lines, piece) = (self.lines, &self.contours.pieces[number]);
        let image = Image::of(lines.space, piece.ends)?;
        let inside = image.inside(lines.space.size, 0.0)?;
        if image.a == image.b || inside[0] == inside[1] {
            return None;
        }
        let whole = |intervals| Some(ContourIntervals { piece: number, image, intervals });
        let [from, to] = inside;
        let is_ghost = self.input.scene_parts.is_ghost(self.part_of(piece));
        if self.contours.is_inside(piece) && !is_ghost {
            return whole(vec![Interval { from, to, is_visible: false, background: [false; 2] }]);
        }
        let places = lines.places(&image, inside, self.cuts(piece, &image, inside));
        let has_outline = lines.finds_outline && !is_ghost;
        let mut intervals: Vec<Interval> = Vec::new();
        for place in places.windows(2).map(|place| [place[0], place[1]]) {
            let is_visible = self.is_seen(&self.probe(piece, &image, (place[0] + place[1]) * 0.5));
            let cuts = if has_outline && is_visible { self.outline_cuts(&image, place) } else { Vec::new() };
            for part in lines.places(&image, place, cuts).windows(2) {
                let middle = (part[0] + part[1]) * 0.5;
                let background = match has_outline && is_visible {
                    true => self.background(&image, &self.probe(piece, &image, middle)),
                    false => [false; 2],
                };
                Interval { from: part[0], to: part[1], is_visible, background }.add_to(&mut intervals);
            }
        }
        whole(intervals)
    }

    /// Whether there is background beyond a segment's summit, on its right and on its left.
    fn background(&self, image: &Image, summit: &Probe) -> [bool; 2] {
        let lines = self.lines;
        let outwards = DVec2::new(summit.aside.x, -summit.aside.y);
        let px = summit.px + outwards * lines.beside_px();
        let beside = Probe { px, view: lines.space.point(px, summit.key), ..*summit };
        let touch_px = image.touch_px(lines.space);
        if lines.faces.is_covered(lines.space, &beside, touch_px, |column, visit| lines.faces.tree.any(column, visit)) {
            return [false; 2];
        }
        let is_right = (image.b - image.a).perp().dot(outwards) > 0.0;
        [is_right, !is_right]
    }

    /// The places where a segment's visibility may change.
    fn cuts(&self, piece: &ContourPiece, image: &Image, inside: [f64; 2]) -> Vec<f64> {
        let lines = self.lines;
        let touch_px = image.touch_px(lines.space);
        let keys = inside.map(|place| image.key(place));
        let farthest = keys[0].max(keys[1]);
        let nearer = [f64::NEG_INFINITY, farthest + key_slack(farthest)];
        let mut cuts = Vec::new();
        lines.rims.any(&image.box_around(inside, touch_px, nearer), |other_index| {
            if let Some(other) = &lines.images[other_index] {
                lines.add_crossings(image, other, true, &mut cuts);
            }
            false
        });
        lines.any_occluder(&image.box_around(inside, touch_px, keys), [NO_GROUP; 2], |face| {
            let point = piercing(piece.ends, lines.faces.corners(face));
            cuts.extend(point.map(|point| image.place_of(lines.space.project(point).0)));
            false
        });
        cuts
    }

    /// The places where background may begin or end beside a visible stretch: rims at any depth.
    fn outline_cuts(&self, image: &Image, stretch: [f64; 2]) -> Vec<f64> {
        let lines = self.lines;
        let mut cuts = Vec::new();
        let around = image.box_around(stretch, image.touch_px(lines.space), [f64::NEG_INFINITY, f64::INFINITY]);
        for rims in [&lines.rims, &lines.hidden_rims] {
            rims.any(&around, |other_index| {
                cuts.extend(lines.images[other_index].iter().flat_map(|other| image.meetings(other, lines.space)));
                false
            });
        }
        cuts
    }

    /// Whether no face hides a point.
    pub(in crate::lines) fn is_seen(&self, probe: &Probe) -> bool {
        let lines = self.lines;
        lines.faces.leave_open(lines.space, probe, |column, visit| lines.any_occluder(column, [NO_GROUP; 2], visit))
    }

    /// The summit of a place of a segment, as a probe for the visibility test.
    pub(in crate::lines) fn probe(&self, piece: &ContourPiece, image: &Image, place: f64) -> Probe {
        let lines = self.lines;
        let start = lines.space.point(image.at(place), image.key(place));
        let normal = between(piece.normals[0], piece.normals[1], place);
        let outwards = lines.space.image_direction(start, normal).normalize_or_zero();
        let outwards = if piece.bends_away { outwards } else { -outwards };
        let curved = &self.contours.surfaces[piece.object as usize];
        let (summit, edge) = self.summit(piece, start, normal, outwards);
        let ends = self.input.objects[piece.object as usize].edges.get().list().positions()[edge as usize];
        let own = ends.map(|position| position + curved.first_position);
        let ends = own.map(|position| lines.faces.positions[position as usize]);
        let (px, key) = lines.space.project(summit);
        Probe {
            view: summit,
            px,
            key,
            // The picture's y axis points down, that of eye space up.
            aside: DVec3::new(outwards.x, -outwards.y, 0.0),
            line: ProbedLine::new(lines.faces, Own::Edge(own), ends, lines.faces.weld(curved.first_position))
                .without_ends(),
        }
    }

    /// The summit, and the edge that it lies on.
    fn summit(&self, piece: &ContourPiece, start: DVec3, normal: DVec3, outwards: DVec2) -> (DVec3, u32) {
        let space = self.lines.space;
        let plane = space.to_eye(start).cross(normal);
        let start_px = space.project(start).0;
        let curved = &self.contours.surfaces[piece.object as usize];
        let list = self.input.objects[piece.object as usize].edges.get().list();
        let near = curved.longest_side(&self.lines.faces.positions, piece.face);
        let to_eye = space.to_eye(start);
        // From inside a face in both directions, from an edge into both its faces.
        let ways = match piece.on_edge {
            None => [(piece.face, NONE, 1.0), (piece.face, NONE, -1.0)],
            Some(edge) => {
                let faces = list.faces(edge);
                [(faces[0], edge, 1.0), (faces[faces.len() - 1], edge, 1.0)]
            }
        };
        let own = if piece.edges[0] == NONE { piece.edges[1] } else { piece.edges[0] };
        let mut best = (if piece.on_edge.is_some() { 0.0 } else { f64::NEG_INFINITY }, start, own);
        for (mut face, mut came, way) in ways {
            for _ in 0..MOST_FACES {
                let positions = &self.lines.faces.positions;
                let Some(exit) = curved.exit(positions, face, came, [start, plane], to_eye * way) else { break };
                let is_towards = to_eye.dot(exit.point - start) > 0.0;
                if -exit.point.z < space.near {
                    break;
                }
                let height = (space.project(exit.point).0 - start_px).dot(outwards);
                if height > best.0 {
                    best = (height, exit.point, exit.edge);
                }
                // Where the smooth surface bends away, its side towards the eye is its front; otherwise it is its
                // back.
                let is_on_its_side = (exit.towards > 0.0) == (is_towards == piece.bends_away);
                let is_near = exit.point.distance(start) < near;
                if (!is_near && !is_on_its_side) || curved.surface.is_sharp[exit.edge as usize] {
                    break;
                }
                let Some(next) = list.faces(exit.edge).iter().find(|other| **other != face) else { break };
                if !is_near && self.agrees(piece.object, *next) {
                    break;
                }
                (face, came) = (*next, exit.edge);
            }
        }
        (best.1, best.2)
    }

    /// Whether a face's side agrees with its smooth normals.
    fn agrees(&self, object: u32, face: u32) -> bool {
        let curved = &self.contours.surfaces[object as usize];
        let is_front = curved.is_front_face(self.lines.space, &self.lines.faces.positions, face);
        curved.of_face(face).iter().all(|towards| (*towards >= 0.0) == is_front)
    }

    /// Calls `visit` with each face that hides a probe and its distance before the probe, until it returns true.
    pub(in crate::lines) fn any_hider(&self, probe: &Probe, mut visit: impl FnMut(u32, f64) -> bool) -> bool {
        let (space, faces) = (self.lines.space, self.lines.faces);
        self.lines.any_occluder(&probe.column(space), [NO_GROUP; 2], |face| {
            if faces.hides(space, face, probe) == [false; 2] {
                return false;
            }
            let [a, b, c] = faces.corners(face);
            let depth = faces.hit_depth(space, [a, (b - a).cross(c - a)], probe);
            let slant = if space.is_perspective() { probe.view.length() / -probe.view.z } else { 1.0 };
            visit(face, (-probe.view.z - depth) * slant)
        })
    }
}
