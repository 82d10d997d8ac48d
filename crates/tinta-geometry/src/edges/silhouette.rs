//! The silhouette for an eye: inner edges between a face seen from the front and one that is not.
//!
//! The exact rule decides each face's side once, in f32 with an error bound. Exact arithmetic decides the few uncertain faces.
//! The text's rule multiplies two products with one view vector (errata D3, D4).

use super::{EdgeList, Eye, Incidence, Side, side_of_face};
use crate::mesh::{Mesh, triangle_normal};
use crate::settings::Setting;
use crate::threads::{filled, in_parallel, ranges, threads_for};
use glam::{DVec3, Vec3, Vec4};

crate::choices! {
    /// The rule that decides whether an edge is silhouette.
    #[derive(Default)]
    pub enum SilhouetteRule {
        /// The listing's: the product of both normals' components along the camera's axis is at most 1e-8, for every edge the
        /// same axis. In perspective that misses edges and invents others.
        #[default]
        Published = "paper",
        /// The eye sees one face's front and the other's back, by exact arithmetic.
        Exact = "exact",
        /// The contour of the curved surface that the faces approximate: it crosses faces, and follows edges only where they
        /// are sharp, see [`crate::lines::smooth_silhouettes`]. For edges alone it equals [`SilhouetteRule::Exact`].
        Smooth = "smooth",
    }
}

impl SilhouetteRule {
    /// Declares a style's setting.
    pub fn setting<T: Clone + 'static>(field: fn(&mut T) -> &mut Self) -> Setting<T> {
        Setting::field(
            "silhouette",
            "RULE",
            "Rule for silhouettes: paper (one view vector for all edges), exact (one for each edge) or smooth (of \
             the curved surface that the facets approximate)",
            field,
        )
        .said("paper; style lines: exact")
    }
}

/// The listing's bound on the product of two normals' components along the view.
const PUBLISHED_BOUND: f32 = 0.000_000_01;

/// Bound on the f32 error of a face's distance from the eye, as a share of the numbers it is computed from: four products
/// and three sums, and the roundings of plane and eye before.
const PLANE_ERROR: f32 = 8.0 * f32::EPSILON;

/// A mesh's faces as planes, to find silhouettes from many eyes.
#[derive(Debug, Clone)]
pub struct Silhouettes {
    frame: Frame,
    /// Each face's unit normal and, in the fourth place, minus its plane's distance from the origin, or NaN where f32 is too
    /// imprecise.
    planes: Vec<[f32; 4]>,
    /// The edges whose faces are wound against each other, ascending.
    reversed: Vec<u32>,
}

/// The coordinates of the planes, precise enough for f32: the mesh's middle is the origin and its radius 1.
#[derive(Debug, Clone, Copy)]
struct Frame {
    centre: DVec3,
    radius: f64,
}

/// An eye in the planes' coordinates: position with 1, or direction with 0, and the error its products may have.
#[derive(Debug, Clone, Copy)]
struct LocalEye {
    homogeneous: Vec4,
    error: f32,
}

impl Frame {
    fn of(mesh: &Mesh) -> Self {
        let (low, high) = mesh.bounds();
        let radius = (high * 0.5 - low * 0.5).length();
        let radius = if radius.is_finite() && radius > 0.0 { radius } else { 1.0 };
        Self { centre: low * 0.5 + high * 0.5, radius }
    }

    fn local(&self, point: DVec3) -> Vec3 {
        ((point - self.centre) / self.radius).as_vec3()
    }

    fn eye(&self, eye: Eye) -> LocalEye {
        let homogeneous = match eye {
            Eye::Point(eye) => self.local(eye).extend(1.0),
            Eye::Direction(direction) => direction.normalize_or_zero().as_vec3().extend(0.0),
        };
        LocalEye { homogeneous, error: PLANE_ERROR * homogeneous.abs().element_sum() }
    }
}

impl Silhouettes {
    /// Computes the planes.
    pub fn new(mesh: &Mesh, edges: &EdgeList) -> Self {
        let frame = Frame::of(mesh);
        let plane = |face: usize| {
            mesh.corners(&mesh.triangles[face]).map_or(Vec4::NAN, |corners| plane(&frame, corners)).to_array()
        };
        let count = mesh.triangles.len();
        let is_reversed = |edge: &u32| edges.incidence[*edge as usize] == Incidence::InnerReversed;
        let reversed = (0..edges.len() as u32).filter(is_reversed).collect();
        Self { frame, planes: filled(count, threads_for(count), [0.0; 4], plane), reversed }
    }

    /// Returns the eye for a rule. The listing's rule looks along one vector for every edge; for an eye at a point, that vector
    /// starts at the mesh's middle.
    fn local_eye(&self, eye: Eye, rule: SilhouetteRule) -> LocalEye {
        let local = self.frame.eye(eye);
        match rule {
            SilhouetteRule::Exact | SilhouetteRule::Smooth => local,
            SilhouetteRule::Published => {
                let axis = local.homogeneous.truncate().normalize_or_zero();
                LocalEye { homogeneous: axis.extend(0.0), error: PLANE_ERROR * axis.abs().element_sum() }
            }
        }
    }

    /// Returns the silhouette edges, ascending. It tests every face and every edge on as many threads as are worth it. `mesh`
    /// and `edges` are those this was made from.
    pub fn find(&self, mesh: &Mesh, edges: &EdgeList, eye: Eye, rule: SilhouetteRule) -> Vec<u32> {
        self.find_with_threads(mesh, edges, eye, rule, threads_for(self.planes.len()))
    }

    /// Like [`Silhouettes::find`] with a number of threads, which does not affect the result.
    pub fn find_with_threads(
        &self,
        mesh: &Mesh,
        edges: &EdgeList,
        eye: Eye,
        rule: SilhouetteRule,
        threads: usize,
    ) -> Vec<u32> {
        let local = self.local_eye(eye, rule);
        let faces = &edges.faces;
        // Every face once, then every edge: a face is shared by three.
        let parts = match rule {
            SilhouetteRule::Exact | SilhouetteRule::Smooth => {
                let fronts = filled(self.planes.len(), threads, 0u8, |face| {
                    let exactly = || self.is_front_exactly(mesh, face, eye);
                    u8::from(is_front(self.planes[face], &local).unwrap_or_else(exactly))
                });
                in_parallel(faces.len(), threads, |range| {
                    select(range, |edge| {
                        let [first, second] = faces[edge];
                        fronts[first as usize] != fronts[second as usize]
                    })
                })
            }
            SilhouetteRule::Published => {
                let along_view = filled(self.planes.len(), threads, 0f32, |face| along_view(self.planes[face], &local));
                in_parallel(faces.len(), threads, |range| {
                    select(range, |edge| {
                        let [first, second] = faces[edge];
                        let dots = (along_view[first as usize], along_view[second as usize]);
                        (first != second) & is_published_silhouette(dots.0, dots.1)
                    })
                })
            }
        };
        let mut found = parts.concat();
        if rule != SilhouetteRule::Published && !self.reversed.is_empty() {
            found.retain(|edge| self.reversed.binary_search(edge).is_err());
            self.add_reversed(mesh, edges, eye, rule, &mut found);
        }
        found
    }

    /// Adds the silhouette edges among those whose faces are wound against each other. The exact rule reverses one face; the
    /// listing's rule, which knows no such edges, tests them unchanged.
    fn add_reversed(&self, mesh: &Mesh, edges: &EdgeList, eye: Eye, rule: SilhouetteRule, found: &mut Vec<u32>) {
        let local = self.local_eye(eye, rule);
        let along_view = |face: u32| along_view(self.planes[face as usize], &local);
        let side = |face: u32| {
            let corners = mesh.corners(&mesh.triangles[face as usize]);
            corners.map_or(Side::Edge, |corners| side_of_face(corners, eye))
        };
        let is_silhouette = |edge: &u32| {
            let [first, second] = edges.faces[*edge as usize];
            match rule {
                SilhouetteRule::Exact | SilhouetteRule::Smooth => {
                    (side(first) == Side::Front) != (side(second) == Side::Back)
                }
                SilhouetteRule::Published => is_published_silhouette(along_view(first), along_view(second)),
            }
        };
        let before = found.len();
        found.extend(self.reversed.iter().copied().filter(is_silhouette));
        if found.len() > before {
            found.sort_unstable();
        }
    }

    /// Whether the eye sees a face's front, by exact arithmetic; `mesh` is the one the planes were made from.
    #[cold]
    fn is_front_exactly(&self, mesh: &Mesh, face: usize, eye: Eye) -> bool {
        let corners = mesh.corners(&mesh.triangles[face]);
        corners.is_some_and(|corners| side_of_face(corners, eye) == Side::Front)
    }
}

/// Whether the eye is certainly in front of a plane, or certainly not; `None` if f32 cannot decide.
#[inline(always)]
fn is_front([x, y, z, w]: [f32; 4], eye: &LocalEye) -> Option<bool> {
    let [eye_x, eye_y, eye_z, eye_w] = eye.homogeneous.to_array();
    let distance = x * eye_x + y * eye_y + z * eye_z + w * eye_w;
    // A NaN is neither.
    let is_clear = distance > eye.error || distance < -eye.error;
    is_clear.then_some(distance > 0.0)
}

/// A normal's component along the view.
#[inline(always)]
fn along_view([x, y, z, _]: [f32; 4], eye: &LocalEye) -> f32 {
    x * eye.homogeneous.x + y * eye.homogeneous.y + z * eye.homogeneous.z
}

/// The listing's test of two normals' components along the view, in its own precision.
#[inline(always)]
fn is_published_silhouette(first: f32, second: f32) -> bool {
    first * second <= PUBLISHED_BOUND
}

/// Returns the numbers of a range for which `holds` is true.
fn select(range: std::ops::Range<usize>, holds: impl Fn(usize) -> bool) -> Vec<u32> {
    // Without a branch: every number is written, and the next one overwrites it unless it counts.
    const BLOCK: usize = 4096;
    let mut selected = Vec::new();
    let mut block = [0u32; BLOCK];
    let blocks = ranges(range.len(), range.len().div_ceil(BLOCK));
    for piece in blocks {
        let mut count = 0;
        for number in range.start + piece.start..range.start + piece.end {
            block[count] = number as u32;
            count += usize::from(holds(number));
        }
        selected.extend_from_slice(&block[..count]);
    }
    selected
}

/// Returns a face's plane in the frame. Its last number is NaN if its normal is too uncertain for f32's error bound; all are
/// NaN if it has none.
fn plane(frame: &Frame, corners: [DVec3; 3]) -> Vec4 {
    // Sides come before any rounding: small faces far from the middle keep their normals.
    let (u, v) = ((corners[1] - corners[0]) / frame.radius, (corners[2] - corners[0]) / frame.radius);
    let product = u.cross(v);
    let length = product.length();
    // The product's own error is a few f64 epsilons of |u||v|. Exact arithmetic handles needles for which that is not far below
    // f32's error, and underflow.
    let is_certain = length > u.length() * v.length() * 1e-7 && length > f64::MIN_POSITIVE / f64::EPSILON;
    if is_certain {
        let normal = product / length;
        return normal.extend(-normal.dot((corners[0] - frame.centre) / frame.radius)).as_vec4();
    }
    triangle_normal(corners).map_or(Vec4::NAN, |normal| normal.as_vec3().extend(f32::NAN))
}
