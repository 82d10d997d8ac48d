//! The borders of a view: where one label may give way to another, as far as that is seen.
//!
//! In: a scene's given faces without repairs. Out: segments of the grid that bound cells of one label each. The deciders of
//! lines say which pieces of borders are visible. A piece that ends on another one is drawn a little beyond it, so cells close wherever
//! rounding moves either; a piece too many does no harm.
//!
//! Of faces that touch, the one with the lowest number is seen. So of faces in one plane a line counts only where no face with a lower
//! number covers it, although it is visible: many have few borders, and one of two that overlap has strokes.

use super::grid::Grid;
use super::region::SeenFace;
use super::snap::{Point, Segment};
use crate::bvh::NO_GROUP;
use crate::edges::{Class, ClassCounts};
use crate::error::Result;
use crate::lines::eye::cast::{Hit, first_hit};
use crate::lines::eye::face_pair::FacePlane;
use crate::lines::eye::image::Image;
use crate::lines::eye::projected_face::ProjectedFace;
use crate::lines::eye::space::at_depth;
use crate::lines::eye::touch::key_slack;
use crate::lines::input::candidates::Candidates;
use crate::lines::input::feature::{Feature, Own};
use crate::lines::input::line_input::LineInput;
use crate::lines::input::object_edges::ObjectEdges;
use crate::lines::progress::{Phase, Progress};
use crate::lines::sight::{Intersections, Sight};
use crate::lines::visible::contact::ProbedLine;
use crate::lines::visible::intersections::intersections;
use crate::lines::visible::interval::Interval;
use crate::lines::visible::line_index::LineIndex;
use crate::lines::visible::occluder_probe::{OccluderProbe, SearchDepth};
use crate::lines::visible::search::Search;
use crate::memory::DrawingWork;
use crate::ranges::{gaps, united};
use crate::threads::{cores, in_chunks, spread_chunks};
use glam::{DVec2, DVec3};
use std::collections::HashSet;
use std::sync::Arc;

/// How far a piece is drawn beyond its end, grid steps: at angles above a hundredth of a degree it then crosses the border there.
const BEYOND: f64 = 8192.0;

/// The class of borders: any will do.
const BORDER: Class = Class::Boundary;

/// Edges and lines that a thread takes at once.
const CHUNK: usize = 16;
const EDGES: usize = 4096;

/// The faces of a scene in the eye's space.
pub(in crate::lines) struct View<'a> {
    pub input: LineInput<'a>,
    search: Arc<Search>,
    pub(super) grid: Grid,
}

/// A line that may be a border, with the lowest number of the faces that it lies in.
type Line = (Feature, u32);

/// Lines with their images, and the visible pieces: each line's number and a range along it.
struct DecidedLines {
    features: Vec<Feature>,
    images: Vec<Option<Image>>,
    pieces: Vec<(usize, [f64; 2])>,
}

impl<'a> View<'a> {
    /// Collects the faces.
    ///
    /// # Errors
    ///
    /// Those of [`LineInput::as_given`] and [`Progress::go_on`].
    pub(in crate::lines) fn of(sight: &'a Sight<'_>, asked: DrawingWork, progress: &Progress) -> Result<Self> {
        progress.begin(Phase::Areas, 0);
        let input = LineInput::as_given(sight, asked)?;
        progress.go_on()?;
        let search = sight.search(&input.space, &input.faces, progress);
        Ok(Self { grid: Grid::over(input.space.size), search, input })
    }

    /// The first face that the ray through a place of the picture hits.
    pub(super) fn first_hit(&self, px: DVec2) -> Option<Hit> {
        first_hit(&self.input.space, &self.input.faces, self.search.occluders.as_ref(), px)
    }

    /// The object and the face in it at a place of the hierarchy.
    pub(in crate::lines) fn face(&self, place: u32) -> SeenFace {
        let (object, face) = self.input.faces.in_object(self.input.faces.numbers[place as usize]);
        SeenFace { object: object as u32, face }
    }

    /// The visible pieces of all lines at which one label may give way to another, and the picture's frame. These are lines inside faces,
    /// which come with the faces' places; sides of faces where a surface ends, turns away, or has a border by the numbers of its two
    /// faces; intersections, and cuts by planes.
    ///
    /// # Errors
    ///
    /// Those of [`LineIndex::new`] and [`Progress::go_on`].
    pub(super) fn borders(
        &self,
        inside: impl IntoIterator<Item = (u32, [DVec3; 2])>,
        is_border: impl Fn([u32; 2]) -> bool + Sync,
        progress: &Progress,
    ) -> Result<Vec<Segment>> {
        let found = intersections(&self.input, &self.search, progress);
        progress.go_on()?;
        let crossings = self.input.intersection_features(&found.lines, &mut ClassCounts::default()).into_iter();
        let near_cuts = self.input.near_plane_features().map(|cut| Feature { class: Some(BORDER), ..cut });
        let mut lines: Vec<Line> = crossings.chain(near_cuts).map(|feature| (feature, 0)).collect();
        lines.extend(inside.into_iter().chain(self.far_cuts()).map(|(place, ends)| self.within(place, ends)));
        // Of lines in one place the first one stays: that of the face that is seen.
        lines.sort_by_key(|(_, lowest)| *lowest);
        lines.extend(self.edges(is_border));
        Ok(self.drawn(&self.decided(lines, &found, progress)?))
    }

    /// The visible pieces of lines inside faces, which come with the faces' places: each piece with the number of its line, its range and
    /// the line's image.
    ///
    /// # Errors
    ///
    /// Those of [`View::borders`].
    pub(in crate::lines) fn visible(
        &self,
        inside: impl Iterator<Item = (u32, [DVec3; 2])>,
        progress: &Progress,
    ) -> Result<Vec<(usize, [f64; 2], Image)>> {
        let mut lines: Vec<Line> = inside.map(|(place, ends)| self.within(place, ends)).collect();
        let rims = self.edges(|_| false).into_iter().map(|(rim, lowest)| (Feature { class: None, ..rim }, lowest));
        lines.extend(rims.chain(self.input.near_plane_features().map(|cut| (cut, 0))));
        let DecidedLines { images, pieces, .. } = self.decided(lines, &Intersections::default(), progress)?;
        Ok(pieces.into_iter().filter_map(|(line, range)| Some((line, range, images[line]?))).collect())
    }

    /// Decides which pieces of lines are visible.
    fn decided(&self, lines: Vec<Line>, found: &Intersections, progress: &Progress) -> Result<DecidedLines> {
        let (features, lowest): (Vec<Feature>, Vec<u32>) = lines.into_iter().unzip();
        let candidates = Candidates::without_contours(features, found);
        let index = LineIndex::new(&self.input, &candidates, &self.search, progress)?;
        progress.begin(Phase::Areas, lowest.len());
        let pieces = spread_chunks(lowest.len(), CHUNK, cores(), |range| {
            let mut pieces = Vec::new();
            for line in range.clone().take_while(|_| !progress.is_over()) {
                let visible = index.decided(line, progress).into_iter();
                let seen = visible
                    .flat_map(|Interval { from, to, .. }| self.uncovered(&index, line, lowest[line], [from, to]));
                pieces.extend(seen.map(|piece| (line, piece)));
            }
            progress.advance(range.len(), 0);
            pieces
        });
        progress.go_on()?;
        let LineIndex { images, .. } = index;
        Ok(DecidedLines { features: candidates.features, images, pieces: pieces.concat() })
    }

    /// The edges of all objects that may be borders or hide others.
    fn edges(&self, is_border: impl Fn([u32; 2]) -> bool + Sync) -> Vec<Line> {
        let of_object = |object: &ObjectEdges| {
            in_chunks(object.edges.get().list().len(), EDGES, cores(), |range| {
                range.filter_map(|edge| self.edge(object, edge as u32, &is_border)).collect::<Vec<_>>()
            })
        };
        self.input.objects.iter().flat_map(of_object).flatten().collect()
    }

    /// An edge of an object, if it may be a border or hide others.
    fn edge(&self, object: &ObjectEdges, edge: u32, is_border: impl Fn([u32; 2]) -> bool) -> Option<Line> {
        let LineInput { space, faces, .. } = &self.input;
        let list = object.edges.get().list();
        let own = list.positions()[edge as usize].map(|position| position + object.first_position);
        let ends @ [from, to] = own.map(|position| faces.positions[position as usize]);
        let numbers = || list.faces(edge).iter().map(|face| face + object.first_face);
        let is_edge_on = |number: u32| faces.edge_on.binary_search(&number).is_ok();
        // Positive where a face lies left of the edge in the picture.
        let side = |face: u32| {
            let corners = object.shape().triangles[face as usize].map(|corner| corner + object.first_position);
            let third = corners.into_iter().find(|corner| !own.contains(corner));
            third.map_or(0.0, |third| space.turn(from, to, faces.positions[third as usize]).0)
        };
        let sides = match *list.faces(edge) {
            [first, second] => [side(first), side(second)],
            _ => [0.0; 2],
        };
        let goes_on = sides[0] > 0.0 && sides[1] < 0.0 || sides[0] < 0.0 && sides[1] > 0.0;
        let occludes = !goes_on || (!faces.edge_on.is_empty() && numbers().any(is_edge_on));
        let is_border = !goes_on || is_border([0, 1].map(|side| list.faces(edge)[side] + object.first_face));
        let mut planes = numbers().map(|number| faces.plane(number));
        let two = [planes.next().unwrap_or(NO_GROUP), planes.next().unwrap_or(NO_GROUP)];
        let is_flat = list.faces(edge).len() == 1 || two[0] == two[1] && planes.all(|plane| plane == two[0]);
        let feature = || Feature {
            class: is_border.then_some(BORDER),
            occludes,
            weld: faces.weld(object.first_position),
            planes: two,
            plane: if is_flat { two[0] } else { NO_GROUP },
            ..Feature::new(Own::Edge(own), ends)
        };
        (is_border || occludes).then(|| (feature(), numbers().min().unwrap_or(0)))
    }

    /// A line inside the face at a place.
    fn within(&self, place: u32, ends: [DVec3; 2]) -> Line {
        let faces = &self.input.faces;
        let number = faces.numbers[place as usize];
        let (weld, plane) = (faces.weld(faces.triangles[place as usize][0]), faces.plane(number));
        let feature = Feature {
            class: Some(BORDER),
            weld,
            planes: [plane; 2],
            plane,
            ..Feature::new(Own::Faces([place; 2]), ends)
        };
        (feature, number)
    }

    /// The lines where the far plane cuts faces, with their places.
    fn far_cuts(&self) -> impl Iterator<Item = (u32, [DVec3; 2])> + '_ {
        let LineInput { space, faces, .. } = &self.input;
        (0..faces.triangles.len() as u32).filter_map(|place| {
            let corners = faces.corners(place);
            let mut points = (0..3).filter_map(|side| at_depth([corners[side], corners[(side + 1) % 3]], space.far));
            Some((place, [points.next()?, points.next()?]))
        })
    }

    /// The parts of a visible piece of a line that no face in the same plane with a lower number covers.
    fn uncovered(&self, lines: &LineIndex, line: usize, lowest: u32, piece: [f64; 2]) -> Vec<[f64; 2]> {
        let LineInput { space, faces, .. } = &self.input;
        let Feature { own, ends, weld, plane, .. } = lines.features[line];
        let around = if let Own::Faces([place, _]) = own { Some(FacePlane::exact(faces, place)) } else { None };
        let Some(image) = lines.images[line].filter(|_| around.is_some() || plane != NO_GROUP) else {
            return vec![piece];
        };
        let is_in_plane = |place: u32| match &around {
            Some(around) => ends.iter().all(|end| FacePlane::exact(faces, place).touches(space, around, *end)),
            None => faces.plane(faces.numbers[place as usize]) == plane,
        };
        let probed = (ProbedLine::new(faces, own, ends, weld), ends);
        let probe = OccluderProbe::new(space, probed, &image, piece, SearchDepth::Any);
        let [from, to] = piece.map(|place| image.key(place));
        let (nearest, farthest) = (from.min(to), from.max(to));
        let keys = [nearest - key_slack(nearest), farthest + key_slack(farthest)];
        let mut covered = Vec::new();
        faces.tree.any(&image.box_around(piece, 0.0, keys), |place| {
            if faces.numbers[place as usize] < lowest && is_in_plane(place) {
                covered.extend(faces.hidden_ranges(space, place, &ProjectedFace::of(space, faces, place), &probe)[0]);
            }
            false
        });
        gaps(piece, &united(covered))
    }

    /// The segments of visible pieces of lines, and the picture's frame. Where all borders at a vertex begin, nothing goes beyond it.
    fn drawn(&self, DecidedLines { features, images, pieces }: &DecidedLines) -> Vec<Segment> {
        let LineInput { space, faces, .. } = &self.input;
        let mut missing = vec![0i32; faces.positions.len()];
        let vertices = features.iter().filter(|feature| feature.class.is_some());
        vertices.flat_map(|feature| feature.own.corners(faces)).for_each(|vertex| {
            if let Some(missing) = missing.get_mut(vertex as usize) {
                *missing += 1;
            }
        });
        let vertex = |number: usize, end: usize| {
            let Feature { own: Own::Edge(vertices), ends, .. } = features[number] else { return None };
            (space.near..=space.far).contains(&-ends[end].z).then_some(vertices[end] as usize)
        };
        let begins = |(number, piece): &(usize, [f64; 2])| {
            [0, 1].map(|end| if piece[end] == end as f64 { vertex(*number, end) } else { None })
        };
        pieces.iter().flat_map(begins).flatten().for_each(|vertex| missing[vertex] -= 1);
        let whole = pieces.iter().flat_map(begins).flatten().filter(|vertex| missing[*vertex] == 0);
        let px = |vertex: usize| space.project(faces.positions[vertex]).0;
        let closed: HashSet<Point> = whole.map(|vertex| self.grid.point(px(vertex))).collect();
        let mut segments = Vec::with_capacity(pieces.len());
        for (number, range) in pieces {
            let Some(Image { a, b, .. }) = images[*number] else { continue };
            let [from, to] = range.map(|place| if place == 1.0 { b } else { a + (b - a) * place });
            let beyond = self.grid.px((b - a).normalize_or_zero() * BEYOND);
            let [is_open, is_open_at_end] = [from, to].map(|px| !closed.contains(&self.grid.point(px)));
            let parts =
                [Some([from, to]), is_open.then(|| [from - beyond, from]), is_open_at_end.then(|| [to, to + beyond])];
            segments.extend(parts.into_iter().flatten().filter_map(|part| self.grid.segment(part)));
        }
        segments.extend(self.grid.frame());
        segments
    }
}
