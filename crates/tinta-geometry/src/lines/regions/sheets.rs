//! Leaves out faces that nearer ones hide, sheet by sheet.
//!
//! A sheet is a set of faces that continue one another in the picture. Visibility changes only where the image of an edge at which
//! a surface ends or turns away passes, of a line in which faces pass through one another, or of a cut by a plane. So all faces of
//! a sheet that no such image touches are visible, or all are hidden, and one ray decides.

use super::view::View;
use crate::bvh::{Box3, BoxTree};
use crate::disjoint_sets::DisjointSets;
use crate::threads::{filled, threads_for_items};
use glam::{DVec2, DVec3};
use std::collections::HashMap;

impl View<'_> {
    /// Keeps the faces that may be seen, without sheets that are hidden for sure.
    pub(super) fn leave_out_hidden_sheets(&mut self) {
        let is_kept = self.kept();
        self.seen = self.seen.iter().zip(&is_kept).filter(|(_, is_kept)| **is_kept).map(|(place, _)| *place).collect();
        let seen = &self.seen;
        self.sides.retain(|(_, place)| seen.binary_search(place).is_ok());
    }

    /// For each of the faces that may be seen, whether its sheet is.
    fn kept(&self) -> Vec<bool> {
        let folds = self.borders(|sides| !self.goes_on(sides));
        let around = |segment: &super::snap::Segment| {
            let [from, to] = segment.map(|point| self.grid.px(point.as_dvec2()));
            Box3::new(from.min(to).extend(f64::NEG_INFINITY), from.max(to).extend(f64::INFINITY))
        };
        let (tree, _) = BoxTree::new(&folds.iter().map(around).collect::<Vec<_>>());
        let boxes = self.faces.tree.boxes();
        let is_touched = |index: usize| {
            let around = &boxes[self.seen[index] as usize];
            let [low, high] = around.corners().map(DVec3::truncate);
            let leaves = low.cmple(DVec2::ZERO).any() || high.cmpge(self.space.size).any();
            leaves || tree.any(around, |_| true)
        };
        let is_touched = filled(self.seen.len(), threads_for_items(self.seen.len()), true, is_touched);
        let index = |place: u32| self.seen.binary_search(&place).ok().filter(|index| !is_touched[*index]);
        let mut sheets = DisjointSets::new(self.seen.len());
        for of_edge in self.sides.chunk_by(|a, b| a.0 == b.0) {
            if let [(_, first), (_, second)] = *of_edge
                && let (Some(first), Some(second)) = (index(first), index(second))
            {
                sheets.join([first as u32, second as u32]);
            }
        }
        let mut is_sheet_seen: HashMap<u32, bool> = HashMap::new();
        let is_kept = |(index, place): (usize, &u32)| {
            is_touched[index] || {
                let sheet = sheets.root(index as u32);
                *is_sheet_seen.entry(sheet).or_insert_with(|| {
                    let middle = self.faces.corners(*place).iter().sum::<DVec3>() / 3.0;
                    self.is_seen(*place, self.space.project(middle).0)
                })
            }
        };
        self.seen.iter().enumerate().map(is_kept).collect()
    }
}
