//! The labels of points: texts that are visible where their points are.
//!
//! Input: decided segments, and the labels of a scene's [`Curves`](crate::mesh::Curves). Output: [`Label`]s, which the SVG and PDF
//! writers place beside the points as text.

use crate::edges::Class;
use crate::lines::LineSegment;
use crate::scene::Scene;
use glam::DVec2;
use std::collections::HashMap;

/// The label of a point.
#[derive(Debug, Clone, PartialEq)]
pub struct Label {
    /// Its text.
    pub text: String,
    /// Its point in the picture, pixels, y down.
    pub px: DVec2,
    /// Whether its point is visible.
    pub is_visible: bool,
    /// The number of its object in the scene.
    pub object: u32,
}

/// The labels of the points among the segments.
pub(in crate::lines) fn labels(scene: &Scene, segments: &[LineSegment]) -> Vec<Label> {
    if scene.objects.iter().all(|object| object.mesh.curves.labels.is_empty()) {
        return Vec::new();
    }
    let texts: Vec<HashMap<u32, &str>> = scene
        .objects
        .iter()
        .map(|object| {
            let curves = &object.mesh.curves;
            let vertex = |point: u32| curves.file_vertices[curves.points[point as usize] as usize];
            curves.labels.iter().map(|(point, text)| (vertex(*point), text.as_str())).collect()
        })
        .collect();
    let label = |segment: &LineSegment| {
        let [vertex, _] = segment.edge.filter(|_| segment.class == Class::Point)?;
        let text = (*texts.get(segment.object as usize)?.get(&vertex)?).to_owned();
        Some(Label { text, px: segment.ends_px[0], is_visible: segment.is_visible, object: segment.object })
    };
    segments.iter().filter_map(label).collect()
}
