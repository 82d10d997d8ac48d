//! Regions of one tone: the cartoon's light of Evangelista et al. 2005 (appendix 1), without pixels.
//!
//! The article computes light at vertices and interpolates it with perspective. So the border of the diffuse tone is a straight line
//! in each face. The border of the specular tone is a curve; it is followed from side to side of a fine division of the face, at
//! most a pixel apart, with each point on the curve. Of a light from a direction all tones have straight borders.

use super::cut::cut;
use super::region::{Regions, SeenFace};
use super::snap::Segment;
use super::tone_borders::{Tone, add_borders};
use super::view::{Sides, View};
use crate::error::Result;
use crate::lines::progress::Progress;
use crate::mesh::NONE;
use crate::scene::Scene;
use crate::threads::{cores, in_chunks};
use crate::tolerances::ANGLE_OF_COSINE;
use glam::{DVec2, DVec3};
use std::f64::consts::PI;

/// How light becomes tones.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ToneRule {
    /// The light.
    pub light: ToneLight,
    /// With a near light, the diffuse value from which the second tone begins, and the specular value above which the third does,
    /// in [0, 1]. With a far one, the cosines from which the second and the third begin, ascending. Values above 1 are never
    /// reached.
    pub thresholds: [f64; 2],
}

/// A light in the eye's space.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ToneLight {
    /// At a point, in the scene's radii from the eye.
    Near(DVec3),
    /// So far away that its direction, a unit vector, is the same everywhere. It lights the side of a face that is seen.
    Far(DVec3),
}

/// A surface of one tone.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct TonedSurface {
    /// The object in the scene.
    pub object: u32,
    /// The material in the object's mesh, or [`NONE`].
    pub material: u32,
    /// 0 is the darkest.
    pub tone: u8,
}

impl ToneRule {
    /// The number of the brightest tone that is reached.
    pub(in crate::lines) fn brightest(&self) -> u8 {
        self.thresholds.iter().map(|threshold| u8::from(*threshold <= 1.0)).sum()
    }

    /// How far the diffuse light is above its threshold.
    fn diffuse(&self, corners: &[NearLight; 3], weights: [f64; 3]) -> f64 {
        mixed(corners, weights, |light| light.diffuse) - self.thresholds[0]
    }

    /// How far the specular light is above its threshold.
    fn specular(&self, corners: &[NearLight; 3], weights: [f64; 3]) -> f64 {
        let [mirrored, to_eye] = directions(corners, weights);
        let lengths = mirrored.length() * to_eye.length();
        let cosine = if lengths > 0.0 { mirrored.dot(to_eye) / lengths } else { 0.0 };
        cosine.max(0.0) - self.thresholds[1]
    }
}

impl Regions<Option<TonedSurface>> {
    /// Cuts a view into regions of one object, material and tone; `None` is background.
    ///
    /// # Errors
    ///
    /// Those of [`Regions::with_progress`].
    pub fn toned(scene: &Scene, rule: &ToneRule, progress: &Progress) -> Result<Self> {
        let label = |SeenFace { object, face }: SeenFace, tone: u8| {
            let materials = &scene.objects[object as usize].mesh.triangle_materials;
            TonedSurface { object, material: materials.get(face as usize).copied().unwrap_or(NONE), tone }
        };
        Self::labelled_tones(scene, rule, label, progress)
    }
}

impl<T: Copy + PartialEq + Send + Sync> Regions<Option<T>> {
    /// Cuts a view into regions of one label; `label` gives that of a face where it has a tone.
    pub(in crate::lines) fn labelled_tones(
        scene: &Scene,
        rule: &ToneRule,
        label: impl Fn(SeenFace, u8) -> T + Sync,
        progress: &Progress,
    ) -> Result<Self> {
        let view = View::of(scene, progress)?;
        let shading = Shading { view: &view, rule, label };
        let chunks = in_chunks(view.seen.len(), CHUNK, cores(), |range| {
            let places = view.seen[range].iter().take_while(|_| !progress.is_over());
            places.map(|place| shading.face(*place)).collect::<Vec<_>>()
        });
        progress.go_on()?;
        let mut surfaces = vec![None; view.faces.triangles.len()];
        let mut borders = Vec::new();
        for (place, (surface, of_face)) in view.seen.iter().zip(chunks.into_iter().flatten()) {
            surfaces[*place as usize] = surface;
            borders.extend(of_face);
        }
        borders.extend(view.borders(|sides| shading.is_border(sides, &surfaces)));
        cut(&view, borders, |px| shading.at(px), progress)
    }
}

/// Faces that a thread takes at once.
const CHUNK: usize = 512;

/// Most parts into which a face's side is divided to follow a curve.
const MOST_PARTS: usize = 512;

struct Shading<'a, L> {
    view: &'a View<'a>,
    rule: &'a ToneRule,
    label: L,
}

/// The vertex shader's results at the corners of a face.
#[derive(Debug, Clone, Copy)]
enum Lights {
    Near([NearLight; 3]),
    /// The light on the side that is seen.
    Far([f64; 3]),
}

#[derive(Debug, Clone, Copy)]
struct NearLight {
    diffuse: f64,
    /// The mirrored direction of the light, and the direction to the eye.
    mirrored: DVec3,
    to_eye: DVec3,
}

impl NearLight {
    fn of(light: DVec3, point: DVec3, normal: DVec3) -> Self {
        let (to_light, to_eye) = ((light - point).normalize_or_zero(), (-point).normalize_or_zero());
        let normal = normal.normalize_or_zero();
        let cosine = to_light.dot(normal);
        Self { diffuse: ((cosine + 1.0) * 0.5).max(0.0), mirrored: normal * (2.0 * cosine) - to_light, to_eye }
    }
}

fn mixed<T, U: std::ops::Mul<f64, Output = U> + std::iter::Sum>(
    corners: &[T; 3],
    weights: [f64; 3],
    of: impl Fn(&T) -> U,
) -> U {
    corners.iter().zip(weights).map(|(corner, weight)| of(corner) * weight).sum()
}

impl<T: PartialEq + Copy, L: Fn(SeenFace, u8) -> T> Shading<'_, L> {
    /// The label at a place of the picture.
    fn at(&self, px: DVec2) -> Option<T> {
        let hit = self.view.first_hit(px)?;
        let seen = SeenFace { object: hit.object, face: hit.face };
        Some((self.label)(seen, self.tone(&self.lights(seen), hit.weights)))
    }

    /// The light at a face's corners.
    fn lights(&self, SeenFace { object, face }: SeenFace) -> Lights {
        let space = &self.view.space;
        let object = &self.view.scene.objects[object as usize];
        let mesh = &object.mesh;
        let normal = |normal: u32| space.direction(mesh.normals[normal as usize].as_dvec3());
        let normals = mesh.triangle_normals[face as usize].map(normal);
        let points =
            mesh.triangles[face as usize].map(|position| space.view(mesh.positions[position as usize] + object.offset));
        match self.rule.light {
            ToneLight::Far(direction) => {
                let [a, b, c] = points;
                let side = if space.turn(a, b, c).0 < 0.0 { -1.0 } else { 1.0 };
                Lights::Far(normals.map(|normal| direction.dot(normal) * side))
            }
            ToneLight::Near(light) => Lights::Near(
                [0, 1, 2].map(|corner| NearLight::of(light, points[corner] / self.view.scene.radius, normals[corner])),
            ),
        }
    }

    fn tone(&self, lights: &Lights, weights: [f64; 3]) -> u8 {
        match lights {
            Lights::Near(corners) if self.rule.specular(corners, weights) > 0.0 => 2,
            Lights::Near(corners) => u8::from(self.rule.diffuse(corners, weights) >= 0.0),
            Lights::Far(corners) => {
                let light = mixed(corners, weights, |light| *light);
                self.rule.thresholds.iter().map(|threshold| u8::from(light >= *threshold)).sum()
            }
        }
    }

    /// The label of a face, `None` where it has several tones, and the borders between these.
    fn face(&self, place: u32) -> (Option<T>, Vec<Segment>) {
        let seen = self.view.face(place);
        let lights = self.lights(seen);
        let points = self.view.faces.corners(place);
        let mut lines = Vec::new();
        match &lights {
            Lights::Far(lights) => {
                for threshold in self.rule.thresholds {
                    add_borders(points, 1, &Linear { lights: *lights, threshold }, &mut lines);
                }
            }
            Lights::Near(corners) => {
                let lights = corners.map(|corner| corner.diffuse);
                add_borders(points, 1, &Linear { lights, threshold: self.rule.thresholds[0] }, &mut lines);
                if self.rule.thresholds[1] < 1.0 {
                    let [low, high] = self.view.faces.tree.boxes()[place as usize].corners();
                    let longest_px = (high - low).truncate().min(self.view.space.size).max_element();
                    let parts = (longest_px.ceil() as usize).clamp(1, MOST_PARTS);
                    add_borders(points, parts, &Specular { rule: self.rule, corners }, &mut lines);
                }
            }
        }
        match lines.is_empty() {
            true => (Some((self.label)(seen, self.tone(&lights, [1.0 / 3.0; 3]))), Vec::new()),
            false => (None, lines.into_iter().flat_map(|line| self.view.across(line)).collect()),
        }
    }

    /// Whether what is seen may differ on both sides of an edge. Sides of faces with several tones count: their borders end there.
    fn is_border(&self, sides: &Sides, surfaces: &[Option<T>]) -> bool {
        let [(_, first), (_, second)] = *sides.of_edge else { return true };
        let [one, other] = [first, second].map(|place| surfaces[place as usize]);
        one.is_none() || one != other || !self.view.goes_on(sides)
    }
}

/// The tone of a face where a light that is interpolated between its corners reaches a threshold.
struct Linear {
    lights: [f64; 3],
    threshold: f64,
}

impl Tone for Linear {
    fn is_inside(&self, weights: [f64; 3]) -> bool {
        mixed(&self.lights, weights, |light| *light) >= self.threshold
    }

    // Its border is straight: the triangle is not divided.
    fn is_even(&self, _: &[[f64; 3]; 4]) -> bool {
        false
    }
}

/// The specular tone of a face.
struct Specular<'a> {
    rule: &'a ToneRule,
    corners: &'a [NearLight; 3],
}

impl Tone for Specular<'_> {
    fn is_inside(&self, weights: [f64; 3]) -> bool {
        self.rule.specular(self.corners, weights) > 0.0
    }

    /// Whether the angle between the two directions stays on one side of the threshold's, as far as both turn.
    fn is_even(&self, corners: &[[f64; 3]; 4]) -> bool {
        let around = corners.map(|weights| directions(self.corners, weights));
        let cone = |which: usize| {
            let middle: DVec3 = around.iter().map(|directions| directions[which]).sum();
            (middle, around.iter().map(|directions| angle(middle, directions[which])).fold(0.0, f64::max))
        };
        let ((mirrored, turn), (to_eye, turn_to_eye)) = (cone(0), cone(1));
        let limit = self.rule.thresholds[1].clamp(0.0, 1.0).acos();
        // Directions in a cone wider than half a space may turn farther, or vanish.
        let is_narrow = turn.max(turn_to_eye) < 1.5;
        is_narrow && (angle(mirrored, to_eye) - limit).abs() > turn + turn_to_eye + ANGLE_OF_COSINE
    }
}

/// The mirrored direction of the light and the direction to the eye at a place of a face.
fn directions([a, b, c]: &[NearLight; 3], [of_a, of_b, of_c]: [f64; 3]) -> [DVec3; 2] {
    let mirrored = a.mirrored * of_a + b.mirrored * of_b + c.mirrored * of_c;
    [mirrored, a.to_eye * of_a + b.to_eye * of_b + c.to_eye * of_c]
}

/// The angle between two vectors, radians; that of no direction to any is half a turn.
fn angle(one: DVec3, other: DVec3) -> f64 {
    let is_none = one == DVec3::ZERO || other == DVec3::ZERO;
    if is_none { PI } else { one.cross(other).length().atan2(one.dot(other)) }
}
