//! Form lines: lines on the smooth surface that a mesh approximates, found from its curvature.
//!
//! Input: a scene's objects with their [`Curvatures`], the eye, [`FormSettings`]. Output: a line segment for each
//! face that a line passes through. Their visibility is decided like that of other lines through faces.
//!
//! - **Suggestive contours** (DeCarlo et al. 2003): where the curvature along the view is 0 and grows towards the
//!   eye.
//! - **Ridges and valleys** (Ohtake et al. 2004): where the larger principal curvature is greatest along its own
//!   direction, in any view.
//!
//! Values at the vertices are interpolated linearly along each side of a face. Both faces at a side compute
//! bit-identical points on it, so the segments connect. Lines end at creases, where the surface ends, and where they
//! are weaker than their threshold.

pub(in crate::lines) mod settings;
#[cfg(test)]
mod stiff_tests;
#[cfg(test)]
mod tests;
mod trace;
#[cfg(test)]
mod visible_tests;

pub use settings::FormSettings;

use crate::curvature::{Curvature, Curvatures};
use crate::edges::{Class, ClassCounts, ClassSet, Eye, SilhouetteRule};
use crate::lines::LineSettings;
use crate::lines::input::feature::{Feature, Own};
use crate::lines::input::line_input::LineInput;
use crate::mesh::{Mesh, NONE};
use crate::threads::{cores, filled, in_chunks, threads_for};
use glam::DVec3;
use trace::{Corners, Crest, crests, zero_set};

impl LineInput<'_> {
    /// The selected form lines, by object and face; counts the segments of each class.
    pub(in crate::lines) fn form_features(&self, counts: &mut ClassCounts) -> Vec<Feature> {
        let Self { scene, settings, space, objects, scene_parts, faces, .. } = self;
        if settings.classes.and(ClassSet::FORMS).is_empty() {
            return Vec::new();
        }
        let mut places = vec![NONE; objects.iter().map(|object| object.shape().triangles.len()).sum()];
        faces.numbers.iter().enumerate().for_each(|(place, number)| places[*number as usize] = place as u32);
        let mut features = Vec::new();
        for (number, object) in objects.iter().enumerate() {
            let (mesh, curvatures) = (object.edges.get().mesh(), object.curvatures(scene, &settings.forms));
            let forms = Forms::new(mesh, &curvatures, scene.eye(object.object, SilhouetteRule::Exact), settings);
            const FACES: usize = 2048;
            let pieces = in_chunks(mesh.triangles.len(), FACES, cores(), |range| {
                let mut pieces = Vec::new();
                for face in range {
                    let place = places[(object.first_face + object.whole_face(face as u32)) as usize];
                    if place != NONE {
                        let position = |corner: u32| faces.positions[(corner + object.first_position) as usize];
                        let view = mesh.triangles[face].map(position);
                        let normal = (view[1] - view[0]).cross(view[2] - view[0]);
                        let is_front = normal.dot(space.to_eye(view[0])) >= 0.0;
                        let part = scene_parts.of_face(number, mesh, face as u32);
                        let wanted = scene_parts.classes(part);
                        forms.trace(face, view, is_front, |class, ends| {
                            if wanted.contains(class) {
                                pieces.push((class, part, place, ends));
                            }
                        });
                    }
                }
                pieces
            });
            for (class, part, place, ends) in pieces.concat() {
                *counts.of(class) += 1;
                features.push(Feature {
                    class: Some(class),
                    object: number as u32,
                    part,
                    is_ghost: scene_parts.is_ghost(part),
                    weld: faces.weld(object.first_position),
                    planes: [faces.plane(faces.numbers[place as usize]); 2],
                    ..Feature::new(Own::Faces([place; 2]), ends)
                });
            }
        }
        features
    }
}

/// The values at each vertex of an object's surface, for one eye. Lists of unused values are empty.
struct Forms<'a> {
    mesh: &'a Mesh,
    curvatures: &'a Curvatures,
    classes: ClassSet,
    /// The cosine of the angle between normal and view.
    cosines: Vec<f64>,
    radial: Vec<Radial>,
    /// For ridges; valleys use strengths of the opposite sign.
    crests: Vec<Crest>,
    /// The least strength of a ridge or valley, 1 / length.
    least: f64,
}

/// The curvature along the view.
#[derive(Debug, Clone, Copy, Default)]
struct Radial {
    /// Times the squared sine of the angle between normal and view.
    curvature: f64,
    /// Above 0 where the curvature grows towards the eye by more than the threshold.
    growth: f64,
}

impl<'a> Forms<'a> {
    fn new(mesh: &'a Mesh, curvatures: &'a Curvatures, eye: Eye, settings: &LineSettings) -> Self {
        let forms = &settings.forms;
        let classes = settings.classes.and(ClassSet::FORMS);
        let (all, size) = (curvatures.all(), curvatures.feature_size());
        let threads = threads_for(mesh.triangles.len());
        let is_wanted = |classes: &[Class]| !settings.classes.and(ClassSet::of(classes)).is_empty();
        let count = |classes: &[Class]| if is_wanted(classes) { all.len() } else { 0 };
        let to_eye = |vertex: usize| match eye {
            Eye::Point(eye) => (eye - mesh.positions[curvatures.positions()[vertex] as usize]).normalize_or_zero(),
            Eye::Direction(direction) => direction.normalize_or_zero(),
        };
        let least = 0.01 * forms.strength / (size * size);
        let depends_on_view = count(&[Class::Suggestive]);
        let cosines = filled(depends_on_view, threads, 0.0, |vertex| to_eye(vertex).dot(all[vertex].normal));
        Self {
            mesh,
            curvatures,
            classes,
            radial: filled(count(&[Class::Suggestive]), threads, Radial::default(), |vertex| {
                radial(&all[vertex], to_eye(vertex), least)
            }),
            crests: filled(count(&[Class::Ridge, Class::Valley]), threads, Crest::default(), |vertex| {
                let at = &all[vertex];
                Crest { strength: at.principal[0], direction: at.directions[0], growth: at.derivative[0] }
            }),
            least: 0.1 * forms.strength / size,
            cosines,
        }
    }

    /// Adds the line segments in a face, given its corners in eye space and whether its front is visible.
    fn trace(&self, face: usize, view: [DVec3; 3], is_front: bool, mut add: impl FnMut(Class, [DVec3; 2])) {
        let vertices = self.curvatures.corners()[face].map(|vertex| vertex as usize);
        let corners = Corners { numbers: vertices, view };
        // From behind, a surface has the opposite normal, and all curvatures change sign.
        let side = if is_front { 1.0 } else { -1.0 };
        if self.classes.contains(Class::Suggestive) {
            let radial = vertices.map(|vertex| self.radial[vertex]);
            let tests = [radial.map(|radial| side * radial.growth), vertices.map(|vertex| side * self.cosines[vertex])];
            if let Some(ends) = zero_set(&corners, radial.map(|radial| radial.curvature), tests) {
                add(Class::Suggestive, ends);
            }
        }
        let place = || self.mesh.triangles[face].map(|corner| self.mesh.positions[corner as usize]);
        for (class, sign) in [(Class::Ridge, 1.0), (Class::Valley, -1.0)] {
            if self.classes.contains(class) {
                let at = vertices.map(|vertex| self.crests[vertex].times(sign));
                crests(&corners, place, at, self.least, |ends| add(class, ends));
            }
        }
    }
}

/// The curvature along the view at a vertex. Let v be the unit vector to the eye, w its part in the tangent plane and
/// a the angle between v and the normal. The curvature is II(w, w) / sin² a. Its growth along w, per sin a of w, is
/// C(w, w, w) / sin² a - 2 cos a t², where t is the torsion along w (DeCarlo et al. 2004). The growth must exceed
/// `least` times cos a, so it counts more the farther the surface turns away.
fn radial(at: &Curvature, to_eye: DVec3, least: f64) -> Radial {
    let cosine = to_eye.dot(at.normal);
    let across = at.directions.map(|direction| direction.dot(to_eye));
    let sine_squared = across[0] * across[0] + across[1] * across[1];
    // Head on, the view has no direction in the tangent plane.
    if sine_squared < HEAD_ON {
        return Radial { curvature: at.second([to_eye; 2]), growth: -1.0 };
    }
    let torsion = (at.principal[1] - at.principal[0]) * across[0] * across[1] / sine_squared;
    let growth = at.third(to_eye) / sine_squared - 2.0 * cosine * torsion * torsion;
    Radial { curvature: at.second([to_eye; 2]), growth: growth - least * cosine }
}

/// Squared sine of the angle between normal and view below which a surface is seen head on.
const HEAD_ON: f64 = 1e-12;
