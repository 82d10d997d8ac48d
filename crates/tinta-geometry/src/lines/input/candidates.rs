//! All lines that a drawing may have, before their visibility is decided: the one list of where lines come from.
//!
//! In: a [`LineInput`]. Out: [`Candidates`]. A new source of lines is added in [`Candidates::of`].

use crate::clock::{Instant, milliseconds_since};
use crate::edges::ClassCounts;
use crate::error::Result;
use crate::lines::input::feature::Feature;
use crate::lines::input::line_input::LineInput;
use crate::lines::progress::Progress;
use crate::lines::sight::Intersections;
use crate::lines::smooth::contours::Contours;
use crate::lines::visible::intersections::intersections;
use crate::lines::visible::search::Search;
use glam::DVec3;
use std::collections::HashMap;
use std::sync::Arc;

/// Lines to decide, with the places where edges pass through faces.
pub(in crate::lines) struct Candidates {
    pub features: Vec<Feature>,
    /// Smooth contours; other rules decide them.
    pub contours: Option<Contours>,
    /// The points where edges pass through faces.
    pub piercings: HashMap<[u32; 2], Vec<DVec3>>,
    /// Number of lines in each class.
    pub counts: ClassCounts,
    /// Wall-clock time of edges and contours, and the count of tested boxes.
    pub silhouette_ms: f64,
    pub compared: u64,
}

impl Candidates {
    /// Finds the lines. Unless the settings want hidden lines, the search may leave out some.
    ///
    /// # Errors
    ///
    /// Those of [`Progress::go_on`], and [`Error::Setting`](crate::Error::Setting) for more lines than memory holds.
    pub(in crate::lines) fn of(input: &LineInput<'_>, search: &Arc<Search>, progress: &Progress) -> Result<Self> {
        let clock = Instant::now();
        let LineInput { scene, settings, space, objects, faces, .. } = input;
        let has_contours = settings.has_smooth_contours();
        let contours = (has_contours || settings.counts_changes).then(|| {
            let is_cut = !faces.cut_by_near.is_empty();
            Contours::new(scene, space, &faces.positions, is_cut, objects, settings.crease_angle)
        });
        let (mut features, mut counts) = input.edge_features(contours.as_ref().filter(|_| has_contours));
        counts.silhouette += contours.as_ref().filter(|_| has_contours).map_or(0, |contours| contours.pieces.len());
        let silhouette_ms = milliseconds_since(clock);
        progress.go_on()?;
        let found = intersections(input, search, progress);
        progress.go_on()?;
        features.extend(input.intersection_features(&found.lines, &mut counts));
        features.extend(input.form_features(&mut counts));
        features.extend(input.free_features(&mut counts)?);
        features.extend(input.near_plane_features());
        Ok(Self { contours, counts, silhouette_ms, ..Self::without_contours(features, &found) })
    }

    /// The same of lines and intersections that are known, without counts.
    pub(in crate::lines) fn without_contours(features: Vec<Feature>, found: &Intersections) -> Self {
        let mut piercings: HashMap<[u32; 2], Vec<DVec3>> = HashMap::new();
        found.piercings.iter().for_each(|piercing| piercings.entry(piercing.edge).or_default().push(piercing.point));
        let counts = ClassCounts::default();
        Self { features, contours: None, piercings, counts, silhouette_ms: 0.0, compared: found.compared }
    }
}
