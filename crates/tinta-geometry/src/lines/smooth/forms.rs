//! Form lines: lines on the smooth surface that a mesh stands for, found from its curvature.
//!
//! In: a scene's objects with their [`Curvatures`], the eye, [`FormSettings`]. Out: pieces of lines, one for each face that a line
//! runs through, whose visibility is decided like that of any other line that runs through faces.
//!
//! - **Suggestive contours** (DeCarlo et al. 2003): where the curvature along the view is 0 and grows towards the eye.
//! - **Ridges and valleys** (Ohtake et al. 2004): where the larger principal curvature is largest along its own direction; whatever
//!   the view.
//! - **Apparent ridges** (Judd et al. 2007): the same of the curvature that the eye sees, which is larger the more the surface turns
//!   away.
//!
//! What is found at a vertex is mixed linearly along each side of a face, and both faces at a side find the same point of it, bit for
//! bit: so the pieces hang together. They end at creases, where the surface does, and where a line is weaker than its threshold.

mod apparent;
mod settings;
#[cfg(test)]
mod stiff_tests;
#[cfg(test)]
mod tests;
mod trace;
#[cfg(test)]
mod visible_tests;

pub use settings::FormSettings;

use crate::bvh::NO_GROUP;
use crate::curvature::{Curvature, Curvatures};
use crate::edges::{Class, ClassCounts, ClassSet, Eye, SilhouetteRule};
use crate::lines::LineSettings;
use crate::lines::input::feature::Feature;
use crate::lines::input::object_edges::{Edges, ObjectEdges};
use crate::lines::visible::faces::{Faces, Own};
use crate::lines::visible::space::Space;
use crate::mesh::{Mesh, NONE};
use crate::scene::Scene;
use crate::threads::{cores, filled, in_chunks, threads_for};
use glam::DVec3;
use std::sync::Arc;
use trace::{Corners, Crest, crests, zero_set};

/// The curvature of a part.
pub(in crate::lines) fn curvatures(scene: &Scene, part: &ObjectEdges<'_>, settings: &LineSettings) -> Arc<Curvatures> {
    let &FormSettings { crease_angle, smoothing, .. } = &settings.forms;
    match &part.edges {
        Edges::OfScene(_) => scene.curvatures(part.object, crease_angle, smoothing),
        Edges::Repaired(_) => {
            let edges = part.edges.get();
            Arc::new(Curvatures::new(edges.mesh(), edges.list(), crease_angle, smoothing))
        }
    }
}

/// The form lines that are wanted, by object and face; each class's pieces are counted.
pub(in crate::lines) fn form_features(
    scene: &Scene,
    space: &Space,
    faces: &Faces,
    parts: &[ObjectEdges<'_>],
    settings: &LineSettings,
    counts: &mut ClassCounts,
) -> Vec<Feature> {
    let mut places = vec![NONE; parts.iter().map(|part| part.shape().triangles.len()).sum()];
    faces.numbers.iter().enumerate().for_each(|(place, number)| places[*number as usize] = place as u32);
    let mut features = Vec::new();
    let (mut first_position, mut first_face) = (0, 0);
    for (number, part) in parts.iter().enumerate() {
        let (mesh, curvatures) = (part.edges.get().mesh(), curvatures(scene, part, settings));
        let eye = scene.eye(part.object, SilhouetteRule::Exact);
        let forms = Forms::new(mesh, &curvatures, eye, settings);
        const FACES: usize = 2048;
        let pieces = in_chunks(mesh.triangles.len(), FACES, cores(), |range| {
            let mut pieces = Vec::new();
            for face in range {
                let place = places[(first_face + part.whole_face(face as u32)) as usize];
                if place != NONE {
                    let view = mesh.triangles[face].map(|corner| faces.positions[(corner + first_position) as usize]);
                    let normal = (view[1] - view[0]).cross(view[2] - view[0]);
                    let is_front = normal.dot(space.to_eye(view[0])) >= 0.0;
                    forms.trace(face, view, is_front, |class, ends| pieces.push((class, place, ends)));
                }
            }
            pieces
        });
        for (class, place, ends) in pieces.concat() {
            *counts.of(class) += 1;
            features.push(Feature {
                class: Some(class),
                occludes: false,
                object: number as u32,
                own: Own::Faces([place; 2]),
                ends,
                weld: faces.weld(first_position),
                planes: [faces.plane(faces.numbers[place as usize]); 2],
                plane: NO_GROUP,
                edge: None,
                angle_degrees: None,
            });
        }
        first_position += mesh.positions.len() as u32;
        first_face += part.shape().triangles.len() as u32;
    }
    features
}

/// What is known at each vertex of an object's surface, seen by an eye. Lists of what is not wanted are empty.
struct Forms<'a> {
    mesh: &'a Mesh,
    curvatures: &'a Curvatures,
    classes: ClassSet,
    /// The cosine of the angle between normal and view.
    cosines: Vec<f64>,
    radial: Vec<Radial>,
    /// For ridges; for valleys all strengths have the other sign.
    crests: Vec<Crest>,
    apparent: Vec<Crest>,
    /// The least strength of a ridge or valley, and of an apparent ridge, 1 / length.
    least: [f64; 2],
}

/// The curvature along the view.
#[derive(Debug, Clone, Copy, Default)]
struct Radial {
    /// Times the square of the sine of the angle between normal and view.
    curvature: f64,
    /// Above 0 where it grows towards the eye by more than the threshold.
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
        let least = forms.suggestive_threshold / (size * size);
        let depends_on_view = count(&[Class::Suggestive, Class::ApparentRidge]);
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
            apparent: match is_wanted(&[Class::ApparentRidge]) {
                true => apparent::crests(mesh, curvatures, &cosines, to_eye, threads),
                false => Vec::new(),
            },
            least: [forms.ridge_threshold / size, forms.apparent_ridge_threshold / size],
            cosines,
        }
    }

    /// The pieces of lines in a face whose corners are here in the eye's space, and whose front is seen or not.
    fn trace(&self, face: usize, view: [DVec3; 3], is_front: bool, mut add: impl FnMut(Class, [DVec3; 2])) {
        let vertices = self.curvatures.corners()[face].map(|vertex| vertex as usize);
        let corners = Corners { numbers: vertices, view };
        // Seen from behind a surface has the other normal, and all curvatures the other sign.
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
                crests(&corners, place, at, self.least[0], |ends| add(class, ends));
            }
        }
        if self.classes.contains(Class::ApparentRidge)
            && vertices.iter().all(|vertex| side * self.cosines[*vertex] > apparent::LEAST_COSINE)
        {
            let at = vertices.map(|vertex| self.apparent[vertex]);
            crests(&corners, place, at, self.least[1], |ends| add(Class::ApparentRidge, ends));
        }
    }
}

/// The curvature along the view at a vertex: with the unit vector to the eye v, its part w in the tangent plane and the angle a
/// between v and the normal it is II(w, w) / sin² a, and grows along w, per sin a of w, by C(w, w, w) / sin² a - 2 cos a t², where t
/// is the torsion along w (DeCarlo et al. 2004). The growth counts the more the farther the surface turns away: it must be more
/// than `least` times cos a.
fn radial(at: &Curvature, to_eye: DVec3, least: f64) -> Radial {
    let cosine = to_eye.dot(at.normal);
    let across = at.directions.map(|direction| direction.dot(to_eye));
    let sine_squared = across[0] * across[0] + across[1] * across[1];
    // Head on there is no direction along the view.
    if sine_squared < HEAD_ON {
        return Radial { curvature: at.second([to_eye; 2]), growth: -1.0 };
    }
    let torsion = (at.principal[1] - at.principal[0]) * across[0] * across[1] / sine_squared;
    let growth = at.third(to_eye) / sine_squared - 2.0 * cosine * torsion * torsion;
    Radial { curvature: at.second([to_eye; 2]), growth: growth - least * cosine }
}

/// Square of the sine of the angle between normal and view below which a surface is seen head on.
const HEAD_ON: f64 = 1e-12;
