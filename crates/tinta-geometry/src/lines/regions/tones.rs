//! Regions of one tone: the cartoon's light of Evangelista et al. 2005 (appendix 1), without pixels.
//!
//! The article computes light at vertices and interpolates it with perspective. So the border of the diffuse tone is a straight line
//! in each face. The border of the specular tone is a curve; it is followed from side to side of a fine division of the face, at
//! most a pixel apart, with each point on the curve. Of a light from a direction all tones have straight borders.

use super::cut::cut;
use super::region::{Regions, SeenFace};
use super::tone_borders::{Tone, add_borders};
use super::view::View;
use crate::error::Result;
use crate::lines::eye::cast::Hit;
use crate::lines::input::line_input::LineInput;
use crate::lines::progress::Progress;
use crate::lines::sight::Sight;
use crate::memory::TONES;
use crate::mesh::NONE;
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

    /// The longest stretch of a face without a border of tone in its middle, pixels: of straight borders any.
    pub(in crate::lines) fn longest_part_px(&self) -> f64 {
        match self.light {
            ToneLight::Near(_) if self.thresholds[1] < 1.0 => 1.0,
            _ => f64::INFINITY,
        }
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
    pub fn toned(sight: &Sight<'_>, rule: &ToneRule, progress: &Progress) -> Result<Self> {
        let (view, scene) = (View::of(sight, TONES, progress)?, sight.scene);
        let label = |SeenFace { object, face }: SeenFace, tone: u8| {
            let materials = &scene.objects[object as usize].mesh.triangle_materials;
            TonedSurface { object, material: materials.get(face as usize).copied().unwrap_or(NONE), tone }
        };
        let numbers = &view.input.faces.numbers;
        let chunks = in_chunks(numbers.len(), CHUNK, cores(), |range| {
            let places = range.take_while(|_| !progress.is_over());
            places.map(|place| rule.of_face(&view, place as u32)).collect::<Vec<_>>()
        });
        progress.go_on()?;
        let mut surfaces = vec![None; scene.triangle_count()];
        let mut inside = Vec::new();
        for ((place, number), (tone, of_face)) in (0..).zip(numbers).zip(chunks.into_iter().flatten()) {
            surfaces[*number as usize] = tone.map(|tone| label(view.face(place), tone));
            inside.extend(of_face.into_iter().map(|line| (place, line)));
        }
        // Sides of faces with several tones count: their borders end there.
        let is_border = |sides: [u32; 2]| {
            let [one, other] = sides.map(|number| surfaces[number as usize]);
            one.is_none() || one != other
        };
        let at = |px: DVec2| {
            let Hit { object, face, weights, .. } = view.first_hit(px)?;
            let seen = SeenFace { object, face };
            Some(label(seen, rule.tone(&rule.lights(&view, seen), weights)))
        };
        cut(&view, view.borders(inside, is_border, progress)?, at, progress)
    }
}

/// Faces that a thread takes at once.
const CHUNK: usize = 512;

/// Most parts into which a face's side is divided to follow a curve.
const MOST_PARTS: usize = 512;

/// The vertex shader's results at the corners of a face.
#[derive(Debug, Clone, Copy)]
pub(in crate::lines) enum Lights {
    Near([NearLight; 3]),
    /// The light on the side that is seen.
    Far([f64; 3]),
}

#[derive(Debug, Clone, Copy)]
pub(in crate::lines) struct NearLight {
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

impl ToneRule {
    /// The light at a face's corners.
    pub(in crate::lines) fn lights(&self, view: &View, SeenFace { object, face }: SeenFace) -> Lights {
        let LineInput { space, scene, .. } = &view.input;
        let object = &scene.objects[object as usize];
        let mesh = &object.mesh;
        let normal = |normal: u32| space.direction(mesh.normals[normal as usize].as_dvec3());
        let normals = mesh.triangle_normals[face as usize].map(normal);
        let points =
            mesh.triangles[face as usize].map(|position| space.view(mesh.positions[position as usize] + object.offset));
        match self.light {
            ToneLight::Far(direction) => {
                let [a, b, c] = points;
                let side = if space.turn(a, b, c).0 < 0.0 { -1.0 } else { 1.0 };
                Lights::Far(normals.map(|normal| direction.dot(normal) * side))
            }
            ToneLight::Near(light) => Lights::Near(
                [0, 1, 2].map(|corner| NearLight::of(light, points[corner] / scene.radius, normals[corner])),
            ),
        }
    }

    /// The tone at a place of a face.
    pub(in crate::lines) fn tone(&self, lights: &Lights, weights: [f64; 3]) -> u8 {
        match lights {
            Lights::Near(corners) if self.specular(corners, weights) > 0.0 => 2,
            Lights::Near(corners) => u8::from(self.diffuse(corners, weights) >= 0.0),
            Lights::Far(corners) => self.tone_of(mixed(corners, weights, |light| *light)),
        }
    }

    /// The tone of a far light.
    fn tone_of(&self, light: f64) -> u8 {
        self.thresholds.iter().map(|threshold| u8::from(light >= *threshold)).sum()
    }

    /// A tone that no place of a face is darker than: its darkest under a far light, which is linear there.
    pub(in crate::lines) fn least_tone(&self, lights: &Lights) -> u8 {
        match lights {
            Lights::Near(_) => 0,
            Lights::Far(corners) => corners.map(|light| self.tone_of(light)).into_iter().min().unwrap_or(0),
        }
    }

    /// The tone of a face, `None` where it has several, and the borders between these.
    fn of_face(&self, view: &View, place: u32) -> (Option<u8>, Vec<[DVec3; 2]>) {
        let LineInput { space, faces, .. } = &view.input;
        let lights = self.lights(view, view.face(place));
        let points = faces.corners(place);
        let mut lines = Vec::new();
        match &lights {
            Lights::Far(lights) => {
                for threshold in self.thresholds {
                    add_borders(points, 1, &Linear { lights: *lights, threshold }, &mut lines);
                }
            }
            Lights::Near(corners) => {
                let lights = corners.map(|corner| corner.diffuse);
                add_borders(points, 1, &Linear { lights, threshold: self.thresholds[0] }, &mut lines);
                if self.thresholds[1] < 1.0 {
                    let [low, high] = faces.tree.boxes()[place as usize].corners();
                    let longest_px = (high - low).truncate().min(space.size).max_element();
                    let parts = (longest_px.ceil() as usize).clamp(1, MOST_PARTS);
                    add_borders(points, parts, &Specular { rule: self, corners }, &mut lines);
                }
            }
        }
        (lines.is_empty().then(|| self.tone(&lights, [1.0 / 3.0; 3])), lines)
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
