//! Builds a [`Mesh`] from a [`Soup`], in the same way for all formats.
//!
//! It drops and counts bad faces, welds vertices, cuts polygons into triangles, computes missing normals and leaves out unused
//! vertices.

use super::other_diagonals::drop_duplicates;
use super::pieces::Pieces;
use super::soup::{Corner, Soup};
use super::{Curves, Cut, Defects, LoadOptions, LoadStage, Mesh, NONE, SectionPlane, SectionPlanes, options, weld};
use crate::error::{Error, Result};
use crate::limits::{CONCAVE_CORNERS, CROSSING_CORNERS};
use crate::tolerances::LARGEST_COORDINATE;
use glam::{DVec3, Vec3};
use std::borrow::Cow;

impl Mesh {
    /// Builds a mesh from a program's triangles, counter-clockwise seen from outside, over positions in any unit.
    ///
    /// The mesh is treated like a file's: vertices are welded, triangles without area dropped and counted, normals computed.
    ///
    /// # Errors
    ///
    /// [`crate::Error::File`] if a triangle names an unknown position, coordinates are too large, or no triangle is left to
    /// draw; [`crate::Error::Strict`] and [`crate::Error::Setting`] as in [`load()`](super::load()).
    pub fn of_triangles(
        name: &str,
        positions: Vec<DVec3>,
        triangles: &[[u32; 3]],
        options: &LoadOptions,
    ) -> crate::Result<Self> {
        Self::of_polygons(name, positions, triangles.as_flattened(), Vec::new(), options)
    }

    /// Builds a mesh from polygons, which are cut into triangles as a file's are. `corners` lists all their corners in order,
    /// `sizes` each polygon's number of corners, at least 3; without sizes all are triangles.
    ///
    /// ```
    /// # fn main() -> tinta_geometry::Result<()> {
    /// use glam::DVec3;
    /// use tinta_geometry::{LoadOptions, Mesh};
    ///
    /// let corners = vec![DVec3::ZERO, DVec3::X, DVec3::ONE, DVec3::Y];
    /// let square = Mesh::of_polygons("a square", corners, &[0, 1, 2, 3], vec![4], &LoadOptions::default())?;
    /// assert_eq!(square.triangles.len(), 2);
    /// # Ok(())
    /// # }
    /// ```
    ///
    /// # Errors
    ///
    /// As for [`Mesh::of_triangles`], and [`crate::Error::File`] if the sizes do not match the corners.
    pub fn of_polygons(
        name: &str,
        positions: Vec<DVec3>,
        corners: &[u32],
        sizes: Vec<u32>,
        options: &LoadOptions,
    ) -> crate::Result<Self> {
        options::check(options)?;
        if corners.iter().any(|index| *index as usize >= positions.len()) {
            let problem = format!("a face uses a position that does not exist; there are {}", positions.len());
            return Err(crate::Error::model(name, problem));
        }
        let counted: u64 = sizes.iter().map(|size| u64::from(*size)).sum();
        let is_even = if sizes.is_empty() { corners.len().is_multiple_of(3) } else { counted == corners.len() as u64 };
        if !is_even || sizes.iter().any(|size| *size < 3) {
            let problem = format!("its faces do not have {} corners together, and 3 or more each", corners.len());
            return Err(crate::Error::model(name, problem));
        }
        let corners = corners.iter().map(|index| Corner::at(*index)).collect();
        let soup = Soup { positions, corners, polygon_sizes: sizes, ..Soup::default() };
        soup.into_mesh(name, options)
    }
}

impl Soup {
    /// Makes the mesh. Fails if no triangle is left to draw, or with `options.strict` on any defect.
    pub(super) fn into_mesh(self, name: &str, options: &LoadOptions) -> Result<Mesh> {
        self.into_mesh_watched(name, options, &mut Vec::new(), &|_| {})
    }

    /// Makes the mesh, with remarks on its section, and reports when only the normals remain.
    pub(super) fn into_mesh_watched(
        mut self,
        name: &str,
        options: &LoadOptions,
        remarks: &mut Vec<String>,
        watch: &dyn Fn(LoadStage),
    ) -> Result<Mesh> {
        for position in &mut self.positions {
            *position = options.up_axis.to_y_up(*position);
        }
        let finite: Vec<bool> = self.positions.iter().map(|position| position.is_finite()).collect();
        let mut defects = std::mem::take(&mut self.defects);
        defects.non_finite_vertices += finite.iter().filter(|finite| !**finite).count();

        self.drop_unusable(&mut defects);
        let used = self.used(&finite);
        let welded = self.welded(&used, options.weld, name)?;
        let mut pieces = Pieces::of(&self, &finite, &welded);
        drop_duplicates(&mut pieces, &self.positions);
        pieces.count(self.positions.len(), &mut defects);
        let curves = Curves::of(&self, &finite);
        check_coordinates(&curves.positions, name)?;
        if pieces.triangles.is_empty() && curves.is_empty() {
            return Err(nothing_to_draw(name, &self, &defects));
        }
        // A large model's corners are most of its soup.
        self.corners = Vec::new();
        self.polygon_parts = Vec::new();
        let mut unused: Vec<bool> = finite.iter().zip(&used).map(|(finite, used)| *finite && !*used).collect();
        curves.file_vertices.iter().for_each(|vertex| unused[*vertex as usize] = false);
        defects.unused_vertices += unused.into_iter().filter(|unused| *unused).count();

        let (positions, file_vertices) = compact(&self.positions, &mut pieces.triangles);
        let color = |vertex: &u32| self.colors.get(*vertex as usize).copied();
        let mut mesh = Mesh {
            name: name.to_owned(),
            position_colors: file_vertices.iter().filter_map(color).collect(),
            positions,
            marked: self.marked_edges(&file_vertices, &welded),
            file_vertices,
            triangles: pieces.triangles,
            normals: Vec::new(),
            triangle_normals: pieces.normals,
            texture_coordinates: std::mem::take(&mut self.texture_coordinates),
            triangle_texture_coordinates: pieces.texture_coordinates,
            materials: std::mem::take(&mut self.materials),
            triangle_materials: pieces.materials,
            file_faces: pieces.polygons,
            parts: std::mem::take(&mut self.parts),
            triangle_parts: pieces.parts,
            weld: options.weld,
            curves,
            defects,
        };
        mesh.clear_unused();
        watch(LoadStage::Normals);
        mesh.take_normals(&self.normals, &pieces.face_normals, options, remarks);
        if options.strict && !mesh.defects.is_empty() {
            return Err(Error::Strict { path: name.into(), defects: mesh.defects.to_string() });
        }
        let turn = |axis| options.up_axis.to_y_up(self.turn.map_or(axis, |turn| turn(axis)));
        cut_open(mesh, (name, options), turn, remarks)
    }

    /// The marked edges between positions, each once, ascending. A position's file vertex is the one that others are welded to.
    fn marked_edges(&self, file_vertices: &[u32], welded: &[u32]) -> Vec<[u32; 2]> {
        let position = |vertex: u32| file_vertices.binary_search(&welded[vertex as usize]).ok().map(|at| at as u32);
        let edge = |[a, b]: &[u32; 2]| {
            let (a, b) = (position(*a)?, position(*b)?);
            (a != b).then_some([a.min(b), a.max(b)])
        };
        let mut marked: Vec<[u32; 2]> = self.marked.iter().filter_map(edge).collect();
        marked.sort_unstable();
        marked.dedup();
        marked
    }

    /// Returns for each vertex the one it is welded to, by a tolerance relative to the used vertices' bounding-box diagonal;
    /// unused vertices stay alone and do not count.
    fn welded(&self, used: &[bool], tolerance: f64, name: &str) -> Result<Vec<u32>> {
        let alone = DVec3::NAN;
        let points: Cow<'_, [DVec3]> = match used.contains(&false) {
            false => Cow::Borrowed(&self.positions),
            true => {
                let points = self.positions.iter().zip(used);
                points.map(|(point, used)| if *used { *point } else { alone }).collect()
            }
        };
        let (low, high) = check_coordinates(&points, name)?;
        let diagonal = if low.cmple(high).all() { (high - low).length() } else { 0.0 };
        Ok(weld::weld(&points, tolerance * diagonal))
    }

    /// Removes normals without a direction and texture coordinates that are not finite from their corners.
    fn drop_unusable(&mut self, defects: &mut Defects) {
        let has_direction = |normal: &Vec3| normal.is_finite() && *normal != Vec3::ZERO;
        if !self.normals.iter().all(has_direction) {
            for corner in &mut self.corners {
                if self.normals.get(corner.normal as usize).is_some_and(|normal| !has_direction(normal)) {
                    corner.normal = NONE;
                    defects.unusable_normals += 1;
                }
            }
        }
        if !self.texture_coordinates.iter().all(|pair| pair.is_finite()) {
            for corner in &mut self.corners {
                if self.texture_coordinates.get(corner.texture as usize).is_some_and(|pair| !pair.is_finite()) {
                    corner.texture = NONE;
                    defects.unusable_texture_coordinates += 1;
                }
            }
        }
    }

    /// Returns which vertices are finite and used by a polygon.
    fn used(&self, finite: &[bool]) -> Vec<bool> {
        let mut used = vec![false; self.positions.len()];
        for corner in &self.corners {
            used[corner.position as usize] = finite[corner.position as usize];
        }
        used
    }
}

/// Returns the bounding box of the points that are numbers; rejects coordinates too large.
fn check_coordinates(points: &[DVec3], name: &str) -> Result<(DVec3, DVec3)> {
    let (low, high) = points.iter().fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), point| {
        if point.is_nan() { (low, high) } else { (low.min(*point), high.max(*point)) }
    });
    if low.abs().max(high.abs()).max_element() > LARGEST_COORDINATE && low.cmple(high).all() {
        let problem = format!("its coordinates reach beyond {LARGEST_COORDINATE:e}; scale it down");
        return Err(Error::model(name, problem));
    }
    Ok((low, high))
}

/// Renumbers the triangles to the positions they use, in the file's order; returns those and their file vertices.
fn compact(all: &[DVec3], triangles: &mut [[u32; 3]]) -> (Vec<DVec3>, Vec<u32>) {
    let mut number = vec![NONE; all.len()];
    for index in triangles.as_flattened() {
        number[*index as usize] = 0;
    }
    let count = number.iter().filter(|slot| **slot == 0).count();
    let (mut positions, mut file_vertices) = (Vec::with_capacity(count), Vec::with_capacity(count));
    for (index, slot) in number.iter_mut().enumerate().filter(|(_, slot)| **slot == 0) {
        *slot = positions.len() as u32;
        positions.push(all[index]);
        file_vertices.push(index as u32);
    }
    for index in triangles.as_flattened_mut() {
        *index = number[*index as usize];
    }
    (positions, file_vertices)
}

fn nothing_to_draw(name: &str, soup: &Soup, defects: &Defects) -> Error {
    // Other defects are not the reason for an empty mesh.
    let of_faces = Defects {
        unused_vertices: 0,
        missing_materials: 0,
        unusable_normals: 0,
        unusable_texture_coordinates: 0,
        unusable_colors: 0,
        ..defects.clone()
    };
    let problem = if !of_faces.is_empty() {
        let wanted = if defects.long_polygons > 0 {
            format!(
                "its faces cut into triangles, for one that is not convex may have {CONCAVE_CORNERS} corners, and {CROSSING_CORNERS} if it crosses itself"
            )
        } else if defects.degenerate_triangles + defects.vanished_triangles > 0 {
            "faces that have area".to_owned()
        } else {
            "faces whose vertices exist and are finite".to_owned()
        };
        format!("nothing is left to draw ({of_faces}); export it again with {wanted}")
    } else if soup.positions.is_empty() {
        "it holds no vertices and no faces; is it the right file?".to_owned()
    } else {
        let vertices = if soup.positions.len() == 1 { "vertex" } else { "vertices" };
        format!("it holds {} {vertices} but no faces; export it with its faces", soup.positions.len())
    };
    Error::model(name, problem)
}

impl Mesh {
    /// Clears lists in which nothing is given.
    fn clear_unused(&mut self) {
        if self.triangle_texture_coordinates.as_flattened().iter().all(|index| *index == NONE) {
            self.triangle_texture_coordinates.clear();
        }
        if self.triangle_materials.iter().all(|index| *index == NONE) {
            self.triangle_materials.clear();
        }
        if self.position_colors.len() != self.positions.len() {
            self.position_colors.clear();
        }
    }
}

/// Cuts a mesh open at the options' planes, if they have any, with remarks; `turn` turns the file's axes into the world's.
fn cut_open(
    mesh: Mesh,
    (name, options): (&str, &LoadOptions),
    turn: impl Fn(DVec3) -> DVec3,
    remarks: &mut Vec<String>,
) -> Result<Mesh> {
    let Some(SectionPlanes(planes)) = &options.section else { return Ok(mesh) };
    let is_of_file = planes.iter().any(|plane| plane.is_of_file);
    let hatching = if is_of_file { options.section_hatch } else { Some(0.0) };
    let planes: Vec<SectionPlane> = planes.iter().map(|plane| plane.in_world(&turn)).collect();
    let (mesh, cut) = mesh.section_except(&planes, hatching, &options.uncut)?;
    match cut {
        Cut::Closed => {}
        Cut::Gone => remarks.push(format!("{name}: it lies wholly in front of the section's plane, which cuts it away")),
        Cut::Missed => remarks.push(format!("{name}: the section's plane meets nothing to cut away; move the plane")),
        Cut::Open => remarks.push(format!(
            "{name}: the surface is open, or its faces disagree on the outside, where --section cuts it; no faces close the cut there"
        )),
    }
    Ok(mesh)
}

#[cfg(test)]
mod tests;
