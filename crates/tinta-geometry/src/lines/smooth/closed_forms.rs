//! Surfaces in closed form: the ground truth for the contours of their meshes.
//!
//! Input: a [`ClosedForm`] and a [`Scene`] of its mesh. Output: the visible contour of the exact surface, in pixels.
//! It comes from formulas in f64, independent of faces, edges and the code that finds lines. A ray that touches a
//! torus has a double root there, and the rest of its quartic is a quadratic, so visibility has a closed form too.
//! Ellipsoids and superquadrics are convex and hide none of their contour. A [`Patch`] leaves a quartic.
//!
//! ```
//! # fn main() -> tinta_geometry::Result<()> {
//! use std::sync::Arc;
//! use tinta_geometry::lines::closed_forms::ClosedForm;
//! use tinta_geometry::{Scene, SceneSettings};
//!
//! let sphere = ClosedForm::ellipsoid(1.0, 1.0, 1.0);
//! let scene = Scene::new(vec![Arc::new(sphere.mesh(10_000, 0.0)?)], &SceneSettings::default())?;
//! assert_eq!(sphere.visible_contour(&scene).len(), 1, "a circle");
//! # Ok(())
//! # }
//! ```

mod curve;
mod patch;
mod superquadric;

pub use patch::Patch;

use curve::{Curve, HALVINGS};
use patch::quad;

use crate::edges::{Eye, SilhouetteRule};
use crate::error::Result;
use crate::lines::eye::space::Space;
use crate::mesh::{LoadOptions, Mesh};
use crate::scene::Scene;
use glam::{DVec2, DVec3};
use std::f64::consts::{PI, TAU};

/// A surface around the origin.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ClosedForm {
    /// A convex superquadric: the sum of the coordinates, each divided by its half axis and raised to an even power,
    /// is 1. From the fourth power on it is flat at its axes.
    Superquadric {
        /// Half axes along x, y and z.
        half_axes: DVec3,
        /// The power: even, at least 2.
        power: u32,
    },
    /// An open bicubic patch.
    Patch(Patch),
    /// An ellipsoid.
    Ellipsoid {
        /// Half axes along x, y and z.
        half_axes: DVec3,
    },
    /// A torus around the y axis.
    Torus {
        /// Distance of the tube's centre from the axis.
        ring: f64,
        /// The tube's radius, less than `ring`.
        tube: f64,
    },
}

/// Samples along a contour, before bisection finds the ends of its visible parts.
const STEPS: usize = 16_384;

/// Distance between compared points of lines, pixels.
const STEP_PX: f64 = 0.25;

impl ClosedForm {
    /// An ellipsoid with these half axes.
    pub fn ellipsoid(x: f64, y: f64, z: f64) -> Self {
        Self::Ellipsoid { half_axes: DVec3::new(x, y, z) }
    }

    /// Returns a mesh with about this many triangles and its vertices on the surface. `jitter` moves the vertices on
    /// the surface at random, by at most this share of the distance between neighbours: 0 gives a regular mesh, 0.2
    /// one like a scan; from 0.25 on, triangles may lose all area. An ellipsoid is an inflated cube; the vertices on
    /// the cube's edges stay.
    ///
    /// # Errors
    ///
    /// Those of [`Mesh::of_triangles`].
    pub fn mesh(&self, triangles: usize, jitter: f64) -> Result<Mesh> {
        self.mesh_with(triangles, jitter, &LoadOptions::default())
    }

    /// Like [`ClosedForm::mesh`], with the options for loading a model.
    ///
    /// # Errors
    ///
    /// Those of [`Mesh::of_triangles`].
    pub fn mesh_with(&self, triangles: usize, jitter: f64, options: &LoadOptions) -> Result<Mesh> {
        let mut random = Random(0x9e37_79b9_7f4a_7c15);
        let (positions, faces) = match self {
            Self::Ellipsoid { half_axes } => {
                let (directions, faces) = cube_sphere(triangles, jitter, &mut random);
                (directions.into_iter().map(|direction| direction * *half_axes).collect(), faces)
            }
            Self::Superquadric { half_axes, power } => {
                let (directions, faces) = cube_sphere(triangles, jitter, &mut random);
                (
                    directions
                        .into_iter()
                        .map(|direction| superquadric::unit_point(direction, *power) * *half_axes)
                        .collect(),
                    faces,
                )
            }
            Self::Patch(patch) => patch.mesh(triangles, jitter, || random.next()),
            Self::Torus { ring, tube } => {
                // Nearly square cells.
                let slices = (triangles as f64 * 0.5 * (tube / ring)).sqrt().round().max(3.0) as u32;
                let columns = (triangles as f64 * 0.5 / f64::from(slices)).round().max(3.0) as u32;
                let mut positions = Vec::new();
                for column in 0..columns {
                    for slice in 0..slices {
                        let [u, v] = [(column, columns), (slice, slices)].map(|(number, count)| {
                            TAU * (f64::from(number) + jitter * random.next()) / f64::from(count)
                        });
                        positions.push(torus_point(*ring, *tube, u, v));
                    }
                }
                let at = |column: u32, slice: u32| column % columns * slices + slice % slices;
                let faces = (0..columns).flat_map(|u| {
                    (0..slices).flat_map(move |v| quad([at(u, v), at(u, v + 1), at(u + 1, v + 1), at(u + 1, v)]))
                });
                (positions, faces.collect())
            }
        };
        Mesh::of_triangles("a closed form", positions, &faces, options)
    }

    /// Returns the visible contour of the exact surface, in a scene whose first object is its mesh. The polylines are
    /// in pixels, y down, with points at most a quarter of a pixel apart.
    pub fn visible_contour(&self, scene: &Scene) -> Vec<Vec<DVec2>> {
        let Some(object) = scene.objects.first() else { return Vec::new() };
        let (space, eye) = (Space::of(scene), scene.eye(object, SilhouetteRule::Exact));
        let px = |point: DVec3| space.project(space.view(point + object.offset)).0;
        let mut lines = Vec::new();
        if let Self::Patch(patch) = self {
            lines.extend(patch.visible_pieces(eye).into_iter().map(|ends| ends.map(px).to_vec()));
        }
        for curve in self.contours(eye) {
            for [from, to] in visible_ranges(|place| self.is_seen(curve(place), eye)) {
                let ends = [from, to];
                let points =
                    (0..=STEPS).map(|step| px(curve(ends[0] + (ends[1] - ends[0]) * step as f64 / STEPS as f64)));
                lines.push(thinned(points));
            }
        }
        lines
    }

    /// The closed curves along which the surface turns away from an eye outside it.
    fn contours(&self, eye: Eye) -> Vec<Curve> {
        match *self {
            Self::Ellipsoid { half_axes } => {
                // On the unit sphere the contour is a circle.
                let (axis, distance) = match eye {
                    Eye::Point(eye) => ((eye / half_axes).normalize(), 1.0 / (eye / half_axes).length()),
                    Eye::Direction(direction) => ((direction / half_axes).normalize(), 0.0),
                };
                let (first, second) = axis.any_orthonormal_pair();
                let radius = (1.0 - distance * distance).max(0.0).sqrt();
                let point = move |place: f64| {
                    let (sine, cosine) = (place * TAU).sin_cos();
                    (axis * distance + (first * cosine + second * sine) * radius) * half_axes
                };
                vec![Box::new(point)]
            }
            Self::Superquadric { half_axes, power } => vec![superquadric::contour(half_axes, power, eye)],
            Self::Torus { ring, tube } => torus_contours(ring, tube, eye),
            // Its contour is not made of closed curves.
            Self::Patch(_) => Vec::new(),
        }
    }

    /// Whether an eye outside the surface sees a point of its contour.
    fn is_seen(&self, point: DVec3, eye: Eye) -> bool {
        let Self::Torus { ring, tube } = *self else { return true };
        let way = match eye {
            Eye::Point(eye) => eye - point,
            Eye::Direction(direction) => direction,
        };
        // The quartic along the ray without its double root at the point.
        let (a, b) = (way.length_squared(), point.dot(way));
        let k = point.length_squared() + ring * ring - tube * tube;
        let flat = way.x * way.x + way.z * way.z;
        let constant = 4.0 * b * b + 2.0 * a * k - 4.0 * ring * ring * flat;
        let half = 2.0 * a * b;
        let discriminant = half * half - a * a * constant;
        discriminant < 0.0 || discriminant.sqrt() - half < 0.0
    }
}

fn torus_point(ring: f64, tube: f64, u: f64, v: f64) -> DVec3 {
    let from_axis = ring + tube * v.cos();
    DVec3::new(from_axis * u.cos(), tube * v.sin(), from_axis * u.sin())
}

/// At each angle u around the ring, the contour is at up to two angles v with a cos v + b sin v = c.
fn torus_contours(ring: f64, tube: f64, eye: Eye) -> Vec<Curve> {
    let (x, y, z, c, minus) = match eye {
        Eye::Point(eye) => (eye.x, eye.y, eye.z, tube, ring),
        Eye::Direction(direction) => (direction.x, direction.y, direction.z, 0.0, 0.0),
    };
    let a = move |u: f64| x * u.cos() + z * u.sin() - minus;
    let point = move |u: f64, sign: f64| {
        let (a, b) = (a(u), y);
        let v = b.atan2(a) + sign * (c / a.hypot(b)).clamp(-1.0, 1.0).acos();
        torus_point(ring, tube, u, v)
    };
    let exists = move |u: f64| a(u).hypot(y) >= c;
    let first_gap = (0..STEPS).map(|step| TAU * step as f64 / STEPS as f64).find(|u| !exists(*u));
    let Some(gap) = first_gap else {
        return [1.0, -1.0].map(|sign| Box::new(move |place: f64| point(place * TAU, sign)) as Curve).into();
    };
    // Between two gaps both branches form one closed curve; the cosine passes its ends smoothly.
    let ranges = visible_ranges(|place| exists(gap + place * TAU));
    let curve = |[from, to]: [f64; 2]| {
        let (middle, half) = (gap + (from + to) * 0.5 * TAU, (to - from) * 0.5 * TAU);
        Box::new(move |place: f64| {
            let angle = place * TAU;
            point(middle - half * angle.cos(), if angle <= PI { 1.0 } else { -1.0 })
        }) as Curve
    };
    ranges.into_iter().map(curve).collect()
}

/// The ranges of a periodic condition from 0 to 1; the last may run beyond 1.
fn visible_ranges(holds: impl Fn(f64) -> bool) -> Vec<[f64; 2]> {
    let at = |step: usize| step as f64 / STEPS as f64;
    let Some(start) = (0..STEPS).find(|step| !holds(at(*step))) else { return vec![[0.0, 1.0]] };
    let change = |mut before: f64, mut after: f64| {
        let is_before = holds(before);
        for _ in 0..HALVINGS {
            let middle = (before + after) * 0.5;
            if holds(middle) == is_before { before = middle } else { after = middle }
        }
        if is_before { before } else { after }
    };
    let (mut ranges, mut begin) = (Vec::new(), None);
    for step in start..start + STEPS {
        match (begin, holds(at(step)), holds(at(step + 1))) {
            (None, false, true) => begin = Some(change(at(step), at(step + 1))),
            (Some(from), true, false) => {
                ranges.push([from, change(at(step), at(step + 1))]);
                begin = None;
            }
            _ => {}
        }
    }
    ranges
}

/// Thins points to as few as possible without a gap wider than [`STEP_PX`]; the first and last stay.
fn thinned(points: impl Iterator<Item = DVec2>) -> Vec<DVec2> {
    let mut kept: Vec<DVec2> = Vec::new();
    let mut last = None;
    for point in points {
        if kept.last().is_none_or(|kept| kept.distance(point) >= STEP_PX * 0.5) {
            kept.push(point);
        }
        last = Some(point);
    }
    kept.extend(last);
    kept
}

/// A sphere as an inflated cube: directions and triangles.
fn cube_sphere(triangles: usize, jitter: f64, random: &mut Random) -> (Vec<DVec3>, Vec<[u32; 3]>) {
    let cells = (triangles as f64 / 12.0).sqrt().round().max(1.0) as u32;
    let axes = [DVec3::X, DVec3::Y, DVec3::Z];
    let mut known = std::collections::BTreeMap::new();
    let (mut positions, mut faces) = (Vec::new(), Vec::new());
    for side in 0..6u32 {
        let (out, right) = (axes[side as usize / 2], axes[(side as usize / 2 + 1) % 3]);
        let out = if side.is_multiple_of(2) { out } else { -out };
        let up = out.cross(right);
        let mut at = |column: u32, row: u32| {
            // Twice the place on the cube's grid, as integers: the same from each side of an edge.
            let [s, t] = [column, row].map(|number| 2.0 * f64::from(number) - f64::from(cells));
            let place = out * f64::from(cells) + right * s + up * t;
            *known.entry(place.to_array().map(|number| number as i64)).or_insert_with(|| {
                let is_inner = place.abs().to_array().iter().filter(|number| **number == f64::from(cells)).count() == 1;
                let shift = DVec3::new(random.next(), random.next(), random.next()) * (2.0 * jitter);
                let shift = if is_inner { shift } else { DVec3::ZERO };
                // Equal angles instead of equal lengths.
                let angle = |number: f64| (number / f64::from(cells) * (PI / 4.0)).tan();
                let on_cube = place + shift - out * shift.dot(out);
                positions.push(DVec3::new(angle(on_cube.x), angle(on_cube.y), angle(on_cube.z)).normalize());
                positions.len() as u32 - 1
            })
        };
        for column in 0..cells {
            for row in 0..cells {
                let corners = [at(column, row), at(column + 1, row), at(column + 1, row + 1), at(column, row + 1)];
                faces.extend(quad(corners));
            }
        }
    }
    (positions, faces)
}

/// Numbers from -1 to 1 (xorshift).
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TORUS: ClosedForm = ClosedForm::Torus { ring: 1.0, tube: 0.4 };
    const SUPERQUADRIC: ClosedForm = ClosedForm::Superquadric { half_axes: DVec3::new(1.0, 0.6, 1.4), power: 4 };

    fn eyes() -> [Eye; 5] {
        [
            Eye::Point(DVec3::new(3.0, 2.0, 4.0)),
            // From slightly above the ring's plane, the contour falls into parts around it.
            Eye::Point(DVec3::new(2.5, 0.1, 1.0)),
            Eye::Point(DVec3::new(0.3, 5.0, -0.2)),
            Eye::Direction(DVec3::new(1.0, 0.4, -2.0)),
            Eye::Direction(DVec3::new(0.1, 1.0, 0.2)),
        ]
    }

    /// Negative inside.
    fn implicit(form: ClosedForm, point: DVec3) -> f64 {
        match form {
            ClosedForm::Ellipsoid { half_axes } => (point / half_axes).length_squared() - 1.0,
            ClosedForm::Superquadric { half_axes, power } => {
                (point / half_axes).to_array().iter().map(|number| number.powi(power as i32)).sum::<f64>() - 1.0
            }
            ClosedForm::Patch(_) => point.y,
            ClosedForm::Torus { ring, tube } => {
                let flat = DVec2::new(point.x, point.z).length() - ring;
                flat * flat + point.y * point.y - tube * tube
            }
        }
    }

    #[test]
    fn contours_lie_on_the_surface_where_it_turns_away() {
        for form in [TORUS, SUPERQUADRIC, ClosedForm::ellipsoid(1.0, 0.6, 1.4)] {
            for eye in eyes() {
                let curves = form.contours(eye);
                assert!(!curves.is_empty());
                for point in curves.iter().flat_map(|curve| (0..97).map(move |k| curve(f64::from(k) / 97.0))) {
                    assert!(implicit(form, point).abs() < 1e-12, "{point}");
                    let step = 1e-5;
                    let slope = [DVec3::X, DVec3::Y, DVec3::Z]
                        .map(|axis| implicit(form, point + axis * step) - implicit(form, point - axis * step));
                    let to_eye = match eye {
                        Eye::Point(eye) => (eye - point).normalize(),
                        Eye::Direction(direction) => direction.normalize(),
                    };
                    let cosine = DVec3::from_array(slope).normalize().dot(to_eye);
                    assert!(cosine.abs() < 1e-7, "{point}: {cosine}");
                }
            }
        }
    }

    #[test]
    fn a_torus_hides_what_small_steps_along_the_ray_find_hidden() {
        let mut hidden = 0;
        for eye in eyes() {
            for point in TORUS.contours(eye).iter().flat_map(|curve| (0..61).map(move |k| curve(f64::from(k) / 61.0))) {
                let way = match eye {
                    Eye::Point(eye) => eye - point,
                    Eye::Direction(direction) => direction.normalize() * 4.0,
                };
                let inside = (1..=40_000).map(|k| implicit(TORUS, point + way * (f64::from(k) / 40_000.0)));
                let deepest = inside.fold(f64::INFINITY, f64::min);
                // Grazes shallower than this are below the sampling's resolution.
                if !(-1e-6..0.0).contains(&deepest) {
                    assert_eq!(TORUS.is_seen(point, eye), deepest >= 0.0, "{point}: {deepest}");
                    hidden += u32::from(deepest < 0.0);
                }
            }
        }
        assert!(hidden > 50, "{hidden}");
    }

    #[test]
    fn meshes_are_closed_have_about_so_many_triangles_and_lie_on_the_surface() {
        for form in [TORUS, SUPERQUADRIC, ClosedForm::ellipsoid(1.0, 0.6, 1.4)] {
            for (triangles, jitter) in [(1_000, 0.0), (10_000, 0.2)] {
                let mesh = form.mesh(triangles, jitter).unwrap();
                assert!(mesh.triangles.len().abs_diff(triangles) < triangles / 10, "{}", mesh.triangles.len());
                assert!(mesh.positions.iter().all(|point| implicit(form, *point).abs() < 1e-12));
                let edges = crate::EdgeList::new(&mesh);
                assert!(edges.incidence().iter().all(|of| *of == crate::edges::Incidence::Inner));
                let volume = |[a, b, c]: &[u32; 3]| {
                    let [a, b, c] = [a, b, c].map(|position| mesh.positions[*position as usize]);
                    a.dot(b.cross(c))
                };
                assert!(mesh.triangles.iter().map(volume).sum::<f64>() > 0.0, "its fronts are outside");
            }
        }
    }
}
