//! Places along silhouettes where visibility begins or ends, and their reasons: how often it breaks without one.
//!
//! On a smooth surface a visible contour ends only in three places: at a *crossing*, where something comes in front
//! of it; at a *cusp*, where it turns away into the surface; and where the surface ends. Any other end is an
//! *inconsistency*: the faces differ from the smooth surface. Both silhouette rules are classified by the same
//! criteria:
//!
//! - a crossing, if the face that hides the line behind the place is more than two edges away from it, or belongs to
//!   another shell;
//! - a cusp, if the smooth contour has one within two edges. It must bend away from the eye for more than two edges
//!   before the cusp, and towards the eye for more than two after it;
//! - otherwise an inconsistency.
//!
//! The length of an edge is the longest side of the faces there. Ends at sharp edges, open rims and the picture's
//! border do not count.

use crate::edges::Class;
use crate::error::Result;
use crate::lines::LineSegment;
use crate::lines::input::feature::Own;
use crate::lines::progress::Progress;
use crate::lines::smooth::contour_visibility::{ContourIntervals, ContourLines};
use crate::lines::smooth::contours::Link;
use crate::lines::smooth::cusps::REACH;
use crate::lines::visible::contact::Probe;
use crate::lines::visible::interval::Interval;
use glam::{DVec2, DVec3};
use serde::Serialize;
use std::collections::{BTreeMap, HashMap, HashSet};

/// The number of places along silhouettes where visibility begins or ends, by reason.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct VisibilityChanges {
    /// Something nearer starts or stops hiding the line.
    pub crossings: usize,
    /// The contour turns away from the eye.
    pub cusps: usize,
    /// Without such a reason.
    pub inconsistencies: usize,
    /// The places of the inconsistencies, each once.
    pub places: Vec<Inconsistency>,
}

/// A place where a visible silhouette ends without a reason on the smooth surface.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Inconsistency {
    /// Pixels from the upper left corner, y down.
    pub px: [f64; 2],
    /// The kind of inconsistency.
    pub kind: InconsistencyKind,
}

/// What happens where a silhouette ends without a reason.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum InconsistencyKind {
    /// Faces within two edges hide the line, without a cusp there.
    Near,
    /// The contour changes its bend, but one of the two bends lasts for less than two edges.
    Turn,
}

#[derive(Clone, Copy)]
enum Reason {
    Crossing,
    Cusp,
    None(InconsistencyKind),
}

impl VisibilityChanges {
    fn count(&mut self, reason: Reason, px: DVec2) {
        match reason {
            Reason::Crossing => self.crossings += 1,
            Reason::Cusp => self.cusps += 1,
            Reason::None(kind) => {
                self.inconsistencies += 1;
                self.places.push(Inconsistency { px: px.to_array(), kind });
            }
        }
    }
}

pub(in crate::lines) struct Cusps {
    /// Places in eye space, and the reach of each.
    places: Vec<(DVec3, f64)>,
    /// Their indices in the list of links.
    pub links: HashSet<usize>,
}

impl Cusps {
    /// Whether a cusp is within two edges of a place.
    fn are_near(&self, place: DVec3, longest: f64) -> bool {
        self.places.iter().any(|(cusp, reach)| cusp.distance(place) <= reach.max(REACH * longest))
    }
}

impl ContourLines<'_> {
    /// Adds the contours' segments, if the settings want them; counts where visibility changes, if they ask.
    ///
    /// # Errors
    ///
    /// Those of [`Progress::go_on`].
    pub(in crate::lines) fn add(
        &self,
        segments: &mut Vec<LineSegment>,
        progress: &Progress,
    ) -> Result<Option<VisibilityChanges>> {
        let settings = &self.input.settings;
        if !settings.has_smooth_contours() {
            progress.go_on()?;
            return Ok(Some(self.changes_of_edges(segments)));
        }
        let decided = self.decided(progress);
        progress.go_on()?;
        segments.extend(self.segments(&decided));
        Ok(settings.counts_changes.then(|| self.changes(&decided)))
    }

    /// The changes along smooth contours.
    pub(in crate::lines) fn changes(&self, decided: &[ContourIntervals]) -> VisibilityChanges {
        let cusps = self.cusps();
        let mut changes = VisibilityChanges::default();
        let mut by_piece: Vec<Option<&ContourIntervals>> = vec![None; self.contours.pieces.len()];
        for decided in decided {
            by_piece[decided.piece] = Some(decided);
            for pair in decided.intervals.windows(2).filter(|pair| pair[0].is_visible != pair[1].is_visible) {
                let hidden = if pair[0].is_visible { pair[1] } else { pair[0] };
                changes.count(self.reason(decided, hidden, &cusps), decided.image.at(pair[0].to));
            }
        }
        for (number, Link { ends, .. }) in self.contours.links.iter().enumerate() {
            let [Some(first), Some(second)] = ends.map(|(piece, end)| at_end(by_piece[piece]?, end)) else { continue };
            if first.1.is_visible == second.1.is_visible {
                continue;
            }
            let hidden = if first.1.is_visible { second } else { first };
            let [a, b] = ends.map(|(piece, _)| self.contours.pieces[piece].bends_away);
            let reason = match a == b {
                false if cusps.links.contains(&number) => Reason::Cusp,
                false => Reason::None(InconsistencyKind::Turn),
                true => self.reason(hidden.0, hidden.1, &cusps),
            };
            let place = if ends[0].1 == 0 { first.1.from } else { first.1.to };
            changes.count(reason, first.0.image.at(place));
        }
        changes
    }

    /// The changes along silhouettes that are mesh edges, except sharp ones; `segments` must include hidden ones.
    pub(in crate::lines) fn changes_of_edges(&self, segments: &[LineSegment]) -> VisibilityChanges {
        let cusps = self.cusps();
        let features: HashMap<(u32, Option<[u32; 2]>), usize> =
            self.lines.features.iter().enumerate().map(|(index, of)| ((of.object, of.edge), index)).collect();
        let mut meetings: BTreeMap<(u32, [u64; 2]), Vec<usize>> = BTreeMap::new();
        for (index, segment) in segments.iter().enumerate() {
            for end in segment.ends_px {
                meetings.entry((segment.object, bits(end))).or_default().push(index);
            }
        }
        // For each segment its feature and the longest adjacent side, if it is a silhouette of a smooth surface.
        let smooth: Vec<Option<(usize, f64)>> = segments
            .iter()
            .map(|segment| {
                let feature =
                    features.get(&(segment.object, segment.edge)).filter(|_| segment.class == Class::Silhouette)?;
                Some((*feature, self.longest_at_edge(*feature)?))
            })
            .collect();
        let mut changes = VisibilityChanges::default();
        for ((_, place), meeting) in &meetings {
            let seen = meeting.iter().filter(|index| segments[**index].is_visible).count();
            let hidden: Vec<usize> = meeting.iter().copied().filter(|index| !segments[*index].is_visible).collect();
            let is_smooth = meeting.iter().all(|index| smooth[*index].is_some());
            if seen.is_multiple_of(2) || hidden.is_empty() || !is_smooth {
                continue;
            }
            let reasons = hidden.iter().filter_map(|index| {
                let (feature, longest) = smooth[*index]?;
                let image = self.lines.images[feature]?;
                let [a, b] = segments[*index].ends_px;
                let probe = self.lines.probe(feature, &image, image.place_of((a + b) * 0.5));
                Some(self.reason_of(&probe, segments[*index].object, longest, &cusps))
            });
            let reasons: Vec<Reason> = reasons.collect();
            let found = reasons.iter().find(|reason| !matches!(reason, Reason::None(_)));
            let none = Reason::None(InconsistencyKind::Near);
            changes.count(*found.unwrap_or(&none), DVec2::from_array(place.map(f64::from_bits)));
        }
        changes
    }

    /// The reason why a stretch of a segment is hidden.
    fn reason(&self, decided: &ContourIntervals, hidden: Interval, cusps: &Cusps) -> Reason {
        let piece = &self.contours.pieces[decided.piece];
        let probe = self.probe(piece, &decided.image, (hidden.from + hidden.to) * 0.5);
        self.reason_of(
            &probe,
            piece.object,
            self.contours.surfaces[piece.object as usize].longest_side(&self.lines.faces.positions, piece.face),
            cusps,
        )
    }

    /// The reason why a point is hidden.
    fn reason_of(&self, probe: &Probe, object: u32, longest: f64, cusps: &Cusps) -> Reason {
        let mut is_hidden = false;
        let is_far = self.any_hider(probe, |place, distance| {
            is_hidden = true;
            distance > REACH * longest || self.is_of_another_shell(probe, object, place)
        });
        // A point that no face hides is covered by a nearer line.
        if is_far || !is_hidden {
            return Reason::Crossing;
        }
        if cusps.are_near(probe.view, longest) { Reason::Cusp } else { Reason::None(InconsistencyKind::Near) }
    }

    /// Whether a face, by its index, is not connected to a probe's line.
    fn is_of_another_shell(&self, probe: &Probe, object: u32, place: u32) -> bool {
        let surface = &self.contours.surfaces[object as usize].surface;
        let first = self.contours.surfaces[object as usize].first_position;
        let Own::Edge([own, _]) = probe.line.own else { return false };
        let position = self.lines.faces.triangles[place as usize][0];
        let shell = |position: u32| surface.position_shells.get(position.checked_sub(first)? as usize).copied();
        shell(own) != shell(position)
    }

    /// The longest side of the faces at an edge that is not sharp.
    fn longest_at_edge(&self, feature: usize) -> Option<f64> {
        let feature = &self.lines.features[feature];
        let Own::Edge(ends) = feature.own else { return None };
        let curved = &self.contours.surfaces[feature.object as usize];
        let list = self.input.objects[feature.object as usize].edges.get().list();
        let ends = ends.map(|end| end - curved.first_position);
        let start = list.positions().partition_point(|[low, _]| *low < ends[0]);
        let edge = start + list.positions()[start..].iter().position(|positions| *positions == ends)?;
        if curved.surface.is_sharp[edge] {
            return None;
        }
        let sides = list.faces(edge as u32).iter().map(|face| curved.longest_side(&self.lines.faces.positions, *face));
        Some(sides.fold(0.0, f64::max))
    }

    /// The cusps with contours of sufficient length on both sides.
    fn cusps(&self) -> Cusps {
        let pieces = &self.contours.pieces;
        let mut runs: Vec<usize> = (0..pieces.len()).collect();
        let root = |runs: &mut Vec<usize>, mut number: usize| {
            while runs[number] != number {
                runs[number] = runs[runs[number]];
                number = runs[number];
            }
            number
        };
        for Link { ends: [(a, _), (b, _)], .. } in &self.contours.links {
            if pieces[*a].bends_away == pieces[*b].bends_away {
                let (a, b) = (root(&mut runs, *a), root(&mut runs, *b));
                runs[a.max(b)] = a.min(b);
            }
        }
        let mut lengths = vec![0.0; pieces.len()];
        for (number, piece) in pieces.iter().enumerate() {
            lengths[root(&mut runs, number)] += piece.ends[0].distance(piece.ends[1]);
        }
        let mut cusps = Cusps { places: Vec::new(), links: HashSet::new() };
        for (number, Link { object, ends: [(a, end), (b, _)] }) in self.contours.links.iter().enumerate() {
            let longest_side = |piece: usize| {
                self.contours.surfaces[*object as usize].longest_side(&self.lines.faces.positions, pieces[piece].face)
            };
            let longest = longest_side(*a).max(longest_side(*b));
            let least = lengths[root(&mut runs, *a)].min(lengths[root(&mut runs, *b)]);
            if pieces[*a].bends_away != pieces[*b].bends_away && least > REACH * longest {
                cusps.places.push((pieces[*a].ends[*end], REACH * longest));
                cusps.links.insert(number);
            }
        }
        cusps
    }
}

/// The stretch at an end of a segment, if that end is in the picture.
fn at_end(decided: &ContourIntervals, end: usize) -> Option<(&ContourIntervals, Interval)> {
    let interval = match end {
        0 => decided.intervals.first().filter(|interval| interval.from == 0.0),
        _ => decided.intervals.last().filter(|interval| interval.to == 1.0),
    };
    Some((decided, *interval?))
}

fn bits(px: DVec2) -> [u64; 2] {
    // Adding 0 turns -0 into 0.
    (px + 0.0).to_array().map(f64::to_bits)
}
