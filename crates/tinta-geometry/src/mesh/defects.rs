//! Counts of a model file's defects.
//!
//! Readers and `soup` fill the counts; the command line reports them once, and `--strict` makes them an error.

use serde::Serialize;
use std::fmt;

/// Counts of defects that a reader left out or worked around; all zero for a clean file.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize)]
pub struct Defects {
    /// Triangles without area (also faces of fewer than three corners), left out.
    pub degenerate_triangles: usize,
    /// Triangles of parts so small that welding leaves nothing of them.
    pub vanished_triangles: usize,
    /// Polygons with too many corners to triangulate, left out: [`limits`](crate::limits).
    pub long_polygons: usize,
    /// Polygons that cross themselves: which parts of them are filled is chance.
    pub crossing_polygons: usize,
    /// Triangles that repeat another with the same orientation, left out.
    pub duplicate_triangles: usize,
    /// Pairs of triangles on each other's backs: surfaces written twice, once for each side, along any diagonal. Readers keep both.
    pub doubled_triangles: usize,
    /// Vertices with a coordinate that is NaN or infinite; the faces that use them are left out.
    pub non_finite_vertices: usize,
    /// Faces, lines and points that name a vertex the file does not hold, left out.
    pub out_of_range_faces: usize,
    /// Vertices that no face uses, left out.
    pub unused_vertices: usize,
    /// Corners whose normal is missing, zero or not finite; a computed one replaces it.
    pub unusable_normals: usize,
    /// Corners that take a normal from the file which stands more than 45 degrees off their face, if these are more than a tenth of
    /// the file's or have as much of the surface; otherwise 0. They blur tones at sharp edges, but the file may mean it: ignored by
    /// `is_empty`.
    pub averaged_normals: usize,
    /// Corners whose texture coordinates are missing or not finite.
    pub unusable_texture_coordinates: usize,
    /// Polygons that repeat a corner in a row, which then counts once; harmless, and ignored by `is_empty`.
    pub repeated_corners: usize,
    /// Triangles that coplanar triangles cover, as in models made to be seen from both sides. Readers keep them;
    /// [`VisibleLines`](crate::VisibleLines) counts them and leaves them out. Harmless, too.
    pub covered_triangles: usize,
    /// Colours of materials that are not three finite numbers from 0 to 1; they are brought there, or left out.
    pub unusable_colors: usize,
    /// Missing material files and materials; their faces get the default colour.
    pub missing_materials: usize,
    /// Faces and others that a file holds beyond its header's count; what follows them unread counts as one.
    pub unpromised: usize,
}

impl Defects {
    /// Whether the file is clean; harmless defects do not count.
    pub fn is_empty(&self) -> bool {
        let Self { repeated_corners, covered_triangles, averaged_normals, .. } = *self;
        *self == Self { repeated_corners, covered_triangles, averaged_normals, ..Self::default() }
    }

    /// Without those that readers name or styles weigh, which report them.
    #[must_use]
    pub fn others(&self) -> Self {
        Self { missing_materials: 0, unpromised: 0, doubled_triangles: 0, averaged_normals: 0, ..self.clone() }
    }

    /// Returns the defects' effect on the picture and what to do; `None` if nothing changes.
    pub fn consequence(&self) -> Option<&'static str> {
        Some(if self.long_polygons + self.non_finite_vertices + self.out_of_range_faces > 0 {
            "parts of the model are missing; export it again"
        } else if self.vanished_triangles > 0 {
            "those parts are gone; --weld 0 keeps them"
        } else if self.unusable_normals + self.unusable_texture_coordinates > 0 {
            "shading or textures may be wrong there; export the model again"
        } else if self.crossing_polygons > 0 {
            "what such polygons fill is chance; split them into triangles"
        } else if self.unusable_colors > 0 {
            "those materials have other colours; correct the material file"
        } else {
            return None;
        })
    }
}

impl<'a> std::iter::Sum<&'a Self> for Defects {
    fn sum<I: Iterator<Item = &'a Self>>(all: I) -> Self {
        all.cloned().fold(Self::default(), |mut sum, mut one| {
            sum.counts().into_iter().zip(one.counts()).for_each(|((sum, ..), (one, ..))| *sum += *one);
            sum
        })
    }
}

impl Defects {
    /// The counts, each with its name for one and for several.
    fn counts(&mut self) -> [(&mut usize, &'static str, &'static str); 17] {
        [
            (&mut self.degenerate_triangles, "degenerate triangle", "degenerate triangles"),
            (&mut self.vanished_triangles, "triangle that welding erases", "triangles that welding erases"),
            (&mut self.long_polygons, "polygon of too many corners", "polygons of too many corners"),
            (&mut self.crossing_polygons, "polygon that crosses itself", "polygons that cross themselves"),
            (&mut self.duplicate_triangles, "duplicate triangle", "duplicate triangles"),
            (&mut self.doubled_triangles, "triangle written for both sides", "triangles written for both sides"),
            (&mut self.non_finite_vertices, "vertex that is not finite", "vertices that are not finite"),
            (&mut self.out_of_range_faces, "face with an index out of range", "faces with an index out of range"),
            (&mut self.unused_vertices, "unused vertex", "unused vertices"),
            (&mut self.unusable_normals, "corner without a usable normal", "corners without a usable normal"),
            (
                &mut self.averaged_normals,
                "corner whose normal stands far off its face (harmless)",
                "corners whose normals stand far off their faces (harmless)",
            ),
            (
                &mut self.unusable_texture_coordinates,
                "corner without usable texture coordinates",
                "corners without usable texture coordinates",
            ),
            (
                &mut self.repeated_corners,
                "polygon that names a corner twice in a row (harmless)",
                "polygons that name a corner twice in a row (harmless)",
            ),
            (
                &mut self.covered_triangles,
                "triangle that others cover (harmless)",
                "triangles that others cover (harmless)",
            ),
            (&mut self.unusable_colors, "material without a usable colour", "materials without a usable colour"),
            (&mut self.missing_materials, "missing material", "missing materials"),
            (&mut self.unpromised, "part beyond what the header promises", "parts beyond what the header promises"),
        ]
    }
}

impl fmt::Display for Defects {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut own = self.clone();
        let found = own.counts().into_iter().filter(|(count, ..)| **count > 0);
        let told = found.map(|(count, one, several)| format!("{count} {}", if *count == 1 { one } else { several }));
        let told = told.collect::<Vec<_>>().join(", ");
        out.write_str(if told.is_empty() { "no defects" } else { &told })
    }
}
