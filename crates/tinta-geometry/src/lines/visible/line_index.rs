//! All lines with their images, and the trees that find every face that hides a line and every line that crosses it.

use crate::bvh::{Box3, Exclusion, NO_GROUP, Walk};
use crate::edges::Class;
use crate::error::Result;
use crate::lines::eye::faces::Faces;
use crate::lines::eye::image::Image;
use crate::lines::eye::pieces::{PieceTree, Pieces};
use crate::lines::eye::space::Space;
use crate::lines::input::candidates::Candidates;
use crate::lines::input::feature::{Feature, Own};
use crate::lines::input::line_input::LineInput;
use crate::lines::progress::Progress;
use crate::lines::visible::bundles::Bundles;
use crate::lines::visible::contact::{Probe, ProbedLine};
use crate::lines::visible::search::Search;
use crate::memory;
use crate::threads::{cores, in_chunks};
use crate::thresholds::THRESHOLDS;
use crate::tolerances::{MARGIN_PX, SHORTEST_LINE};
use glam::{DVec2, DVec3};
use std::collections::HashMap;

/// All lines with their images, ready for a decision on each.
pub(in crate::lines) struct LineIndex<'a> {
    pub(in crate::lines) space: &'a Space,
    pub(in crate::lines) faces: &'a Faces,
    pub(in crate::lines) features: &'a [Feature],
    /// The image of each line's stretch between the near and the far plane.
    pub(in crate::lines) images: Vec<Option<Image>>,
    /// The points where edges pass through faces.
    pub(in crate::lines) piercings: &'a HashMap<[u32; 2], Vec<DVec3>>,
    /// The rims, where surfaces end: they may cross any line.
    pub(in crate::lines) rims: PieceTree,
    /// The rims that are hidden for sure, if outlines are found: they change no visible line.
    pub(in crate::lines) hidden_rims: PieceTree,
    /// The faces that may hide lines, in pieces; `None` where the faces' own tree serves.
    occluders: Option<&'a PieceTree>,
    /// The wanted lines, with the direction of their images as the third coordinate: the candidates for overlapping lines.
    pub(in crate::lines) overlapping: PieceTree,
    /// Bundles of many overlapping lines.
    pub(in crate::lines) bundles: Bundles,
    pub(in crate::lines) shortest_px: f64,
    pub(in crate::lines) finds_outline: bool,
    pub(in crate::lines) finds_hidden: bool,
    /// See [`LineSettings::on_surface`](crate::lines::LineSettings::on_surface).
    on_surface: f64,
}

/// Most bytes that a stretch of a line takes while its tree is built: box, nodes, numbers, and the builder's memory.
const BYTES_A_PART: usize = 320;

/// Lines whose stretches a thread finds at once.
const MADE_AT_ONCE: usize = 4096;

/// Lines whose stretches are found between two checks of the time.
const LINES_A_GLANCE: usize = 64;

impl<'a> LineIndex<'a> {
    pub(in crate::lines) fn new(
        LineInput { space, faces, settings, asked, .. }: &'a LineInput<'_>,
        Candidates { features, piercings, .. }: &'a Candidates,
        search: &'a Search,
        progress: &Progress,
    ) -> Result<Self> {
        let (finds_outline, finds_hidden) = (settings.finds_outline, settings.finds_hidden);
        let pyramid = search.pyramid.as_ref();
        // A lifted line is cut off where it would be without the lift.
        let lifted = [space.near, space.far].map(|depth| -space.lifted(DVec3::NEG_Z * depth, settings.on_surface).z);
        let image = |feature: &Feature| match feature.own {
            Own::Free => Image::between(space, feature.ends, lifted),
            _ => Image::of(space, feature.ends),
        };
        let images: Vec<Option<Image>> = features.iter().map(image).collect();
        let side = space.size.max_element();
        let high_valence = high_valence(features);
        let stretches = in_chunks(features.len(), MADE_AT_ONCE, cores(), |range| {
            let [mut rims, mut hidden_rims, mut overlapping] = <[Pieces; 3]>::default();
            for index in range {
                if index % LINES_A_GLANCE == 0 && progress.is_over() {
                    break;
                }
                let (feature, image) = (&features[index], images[index]);
                let Some((image, range)) = image.and_then(|image| Some((image, image.inside(space.size, MARGIN_PX)?)))
                else {
                    continue;
                };
                let is_hidden = |stretch: [f64; 2]| {
                    let ends = stretch.map(|place| (image.at(place), image.key(place)));
                    pyramid.is_some_and(|pyramid| pyramid.hides_line(ends))
                };
                for stretch in image.stretches(range, side / THRESHOLDS.pieces).filter(|_| feature.occludes) {
                    let is_hidden = is_hidden(stretch);
                    if finds_outline || !is_hidden {
                        let around = image.box_around(stretch, image.noise_px, stretch.map(|place| image.key(place)));
                        let rims = if is_hidden { &mut hidden_rims } else { &mut rims };
                        rims.add_of_groups(around, index, [feature.plane, vertex_of(&high_valence, feature.own)]);
                    }
                }
                if feature.overlaps() && (finds_hidden || !is_hidden(range)) {
                    for directions in image.directions(image.touch_px(space)) {
                        overlapping.add(image.box_around(range, image.noise_px, directions), index);
                    }
                }
            }
            [rims, hidden_rims, overlapping]
        });
        let mut all = <[Pieces; 3]>::default();
        for some in stretches {
            all.iter_mut().zip(some).for_each(|(all, some)| all.append(some));
        }
        let [rims, hidden_rims, overlapping] = all;
        progress.go_on()?;
        asked.check((rims.len() + hidden_rims.len() + overlapping.len()) * BYTES_A_PART, memory::free())?;
        let is_wanted = |index: usize| features[index].overlaps();
        let bundles = Bundles::new(&images, is_wanted, space.size * 0.5, 2.0 * space.touch_px());
        Ok(Self {
            space,
            faces,
            features,
            images,
            piercings,
            rims: rims.tree(progress),
            hidden_rims: hidden_rims.tree(progress),
            occluders: search.occluders.as_ref(),
            overlapping: overlapping.tree(progress),
            bundles,
            shortest_px: SHORTEST_LINE * side,
            finds_outline,
            finds_hidden,
            on_surface: settings.on_surface,
        })
    }

    /// The image of a wanted line and from where to where it is inside the picture; `None` where nothing of it is drawn.
    pub(in crate::lines) fn wanted(&self, index: usize) -> Option<(Image, [f64; 2])> {
        self.features[index].class?;
        let image = self.images[index]?;
        let inside = image.inside(self.space.size, 0.0);
        // A line on the picture's rim is inside, to whichever side it is rounded.
        let beside = image.inside(self.space.size, (4.0 * image.noise_px).min(self.shortest_px));
        let length = |stretch: Option<[f64; 2]>| stretch.map_or(0.0, |[from, to]| image.length() * (to - from));
        let inside = if length(beside) - length(inside) > self.shortest_px { beside } else { inside };
        let is_drawn = self.features[index].class == Some(Class::Point) || length(inside) > self.shortest_px;
        inside.filter(|_| is_drawn).map(|inside| (image, inside))
    }

    /// The ends in the world of a line's stretch between two places of its image: of a free line as it is, not lifted.
    pub(in crate::lines) fn ends_world(&self, index: usize, image: &Image, places: [f64; 2]) -> [DVec3; 2] {
        match self.features[index].own {
            Own::Free => places.map(|place| {
                let view = self.space.point(image.at(place), image.key(place));
                self.space.world(self.space.lowered(view, self.on_surface))
            }),
            _ => image.ends_world(self.space, places),
        }
    }

    /// Returns the places where a stretch of a line begins, is cut and ends. A piece below the shortest length joins its neighbour.
    pub(in crate::lines) fn places(&self, image: &Image, [from, to]: [f64; 2], mut cuts: Vec<f64>) -> Vec<f64> {
        let shortest = self.shortest_px / image.length();
        cuts.retain(|cut| *cut > from + shortest && *cut < to - shortest);
        cuts.sort_unstable_by(f64::total_cmp);
        let mut places = vec![from];
        places.extend(cuts);
        places.dedup_by(|next, kept| *next - *kept <= shortest);
        places.push(to);
        places
    }

    /// Calls `visit` with each face that may hide something and whose box overlaps, perhaps several times, until it returns true.
    /// Leaves out faces in these planes where whole leaves lie in them.
    pub(in crate::lines) fn any_occluder(
        &self,
        query: &Box3,
        planes: [u32; 2],
        visit: impl FnMut(u32) -> bool,
    ) -> bool {
        self.any_but(query, Exclusion::planes(planes), visit)
    }

    pub(in crate::lines) fn any_but(
        &self,
        query: &Box3,
        excluded: Exclusion,
        mut visit: impl FnMut(u32) -> bool,
    ) -> bool {
        match self.occluders {
            Some(occluders) => occluders.any_but(query, excluded, |face| visit(face as u32)),
            None => self.faces.tree.any_but(query, excluded, visit),
        }
    }

    /// Shows a walk the faces that may hide something, perhaps several times. Leaves out whole nodes of excluded groups.
    pub(in crate::lines) fn walk_occluders(&self, excluded: Exclusion, walk: &mut impl Walk) {
        match self.occluders {
            Some(occluders) => occluders.walk(excluded, walk),
            None => self.faces.tree.walk(excluded, walk),
        }
    }

    /// Returns the probe that tests faces at a place of a line.
    pub(in crate::lines) fn probe(&self, index: usize, image: &Image, place: f64) -> Probe {
        let (px, key) = (image.at(place), image.key(place));
        let feature = &self.features[index];
        // A point has no direction: any will do.
        let along = (image.b - image.a).try_normalize().unwrap_or(DVec2::X);
        Probe {
            view: self.space.point(px, key),
            px,
            key,
            // Down in the picture is up in the eye's space.
            aside: DVec3::new(along.y, along.x, 0.0),
            line: ProbedLine::new(self.faces, feature.own, feature.ends, feature.weld),
        }
    }
}

/// Counts the rims that end in each position; keeps those that form a group.
fn high_valence(features: &[Feature]) -> HashMap<u32, u32> {
    let mut counts: HashMap<u32, u32> = HashMap::new();
    for feature in features.iter().filter(|feature| feature.occludes) {
        if let Own::Edge(ends) = feature.own {
            ends.into_iter().for_each(|end| *counts.entry(end).or_default() += 1);
        }
    }
    counts.retain(|_, count| *count as usize >= THRESHOLDS.group);
    counts
}

/// Returns the high-valence vertex at an end of an edge, if any; of two, the one with more rims.
fn vertex_of(high_valence: &HashMap<u32, u32>, own: Own) -> u32 {
    let Own::Edge(ends) = own else { return NO_GROUP };
    let known = ends.into_iter().filter_map(|end| Some((*high_valence.get(&end)?, end)));
    known.max().map_or(NO_GROUP, |(_, end)| end)
}
