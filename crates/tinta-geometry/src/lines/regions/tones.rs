//! Regions of one tone: the cartoon's light of Evangelista et al. 2005 (appendix 1), without pixels.
//!
//! The article computes light at vertices and interpolates it with perspective. So the border of the diffuse tone is a straight line
//! in each face. The border of the specular tone is a curve; it is followed from side to side of a fine division of the face, at
//! most a pixel apart, with each point on the curve.

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
    /// The diffuse value from which the second tone begins, and the specular value above which the third does, in [0, 1]; larger
    /// ones are never reached.
    pub thresholds: [f64; 2],
}

/// A light in the eye's space.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ToneLight {
    /// At a point, in the scene's radii from the eye.
    Near(DVec3),
    /// So far away, as the eye, that its direction, a unit vector, is the same everywhere.
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

impl Regions<Option<TonedSurface>> {
    /// Cuts a view into regions of one object, material and tone; `None` is background.
    ///
    /// # Errors
    ///
    /// Those of [`Regions::with_progress`].
    pub fn toned(scene: &Scene, rule: &ToneRule, progress: &Progress) -> Result<Self> {
        let view = View::of(scene, progress)?;
        let shading = Shading { view: &view, rule };
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

struct Shading<'a> {
    view: &'a View<'a>,
    rule: &'a ToneRule,
}

/// What a vertex shader hands to the interpolation.
#[derive(Debug, Clone, Copy)]
struct Light {
    diffuse: f64,
    /// The mirrored direction of the light, and the direction to the eye.
    mirrored: DVec3,
    to_eye: DVec3,
}

impl Shading<'_> {
    fn surface(&self, SeenFace { object, face }: SeenFace, tone: u8) -> TonedSurface {
        let materials = &self.view.scene.objects[object as usize].mesh.triangle_materials;
        TonedSurface { object, material: materials.get(face as usize).copied().unwrap_or(NONE), tone }
    }

    /// What is seen at a place of the picture.
    fn at(&self, px: DVec2) -> Option<TonedSurface> {
        let hit = self.view.first_hit(px)?;
        let seen = SeenFace { object: hit.object, face: hit.face };
        Some(self.surface(seen, self.tone(&self.corners(seen), hit.weights)))
    }

    /// The light at a face's corners.
    fn corners(&self, SeenFace { object, face }: SeenFace) -> [Light; 3] {
        let space = &self.view.space;
        let object = &self.view.scene.objects[object as usize];
        let mesh = &object.mesh;
        let positions = mesh.triangles[face as usize];
        let normals = mesh.triangle_normals[face as usize];
        [0, 1, 2].map(|corner| {
            let normal = space.direction(mesh.normals[normals[corner] as usize].as_dvec3()).normalize_or_zero();
            let (to_light, to_eye) = match self.rule.light {
                ToneLight::Far(direction) => (direction, DVec3::Z),
                ToneLight::Near(light) => {
                    let world = mesh.positions[positions[corner] as usize] + object.offset;
                    let point = space.view(world) / self.view.scene.radius;
                    ((light - point).normalize_or_zero(), (-point).normalize_or_zero())
                }
            };
            let cosine = to_light.dot(normal);
            Light { diffuse: ((cosine + 1.0) * 0.5).max(0.0), mirrored: normal * (2.0 * cosine) - to_light, to_eye }
        })
    }

    /// How far the diffuse light is above its threshold.
    fn diffuse(&self, corners: &[Light; 3], weights: [f64; 3]) -> f64 {
        let light: f64 = corners.iter().zip(weights).map(|(corner, weight)| corner.diffuse * weight).sum();
        light - self.rule.thresholds[0]
    }

    /// How far the specular light is above its threshold.
    fn specular(&self, corners: &[Light; 3], weights: [f64; 3]) -> f64 {
        let [mirrored, to_eye] = directions(corners, weights);
        let lengths = mirrored.length() * to_eye.length();
        let cosine = if lengths > 0.0 { mirrored.dot(to_eye) / lengths } else { 0.0 };
        cosine.max(0.0) - self.rule.thresholds[1]
    }

    fn tone(&self, corners: &[Light; 3], weights: [f64; 3]) -> u8 {
        if self.specular(corners, weights) > 0.0 { 2 } else { u8::from(self.diffuse(corners, weights) >= 0.0) }
    }

    /// The surface of a face, `None` where it has several tones, and the borders between these.
    fn face(&self, place: u32) -> (Option<TonedSurface>, Vec<Segment>) {
        let seen = self.view.face(place);
        let corners = self.corners(seen);
        let points = self.view.faces.corners(place);
        let mut lines = Vec::new();
        add_borders(points, 1, &Diffuse { shading: self, corners: &corners }, &mut lines);
        if self.rule.thresholds[1] < 1.0 {
            let [low, high] = self.view.faces.tree.boxes()[place as usize].corners();
            let longest_px = (high - low).truncate().min(self.view.space.size).max_element();
            let parts = (longest_px.ceil() as usize).clamp(1, MOST_PARTS);
            add_borders(points, parts, &Specular { shading: self, corners: &corners }, &mut lines);
        }
        match lines.is_empty() {
            true => (Some(self.surface(seen, self.tone(&corners, [1.0 / 3.0; 3]))), Vec::new()),
            false => (None, lines.into_iter().flat_map(|line| self.view.across(line)).collect()),
        }
    }

    /// Whether what is seen may differ on both sides of an edge. Sides of faces with several tones count: their borders end there.
    fn is_border(&self, sides: &Sides, surfaces: &[Option<TonedSurface>]) -> bool {
        let [(_, first), (_, second)] = *sides.of_edge else { return true };
        let [one, other] = [first, second].map(|place| surfaces[place as usize]);
        one.is_none() || one != other || !self.view.goes_on(sides)
    }
}

/// The diffuse tone of a face.
struct Diffuse<'a> {
    shading: &'a Shading<'a>,
    corners: &'a [Light; 3],
}

impl Tone for Diffuse<'_> {
    fn is_inside(&self, weights: [f64; 3]) -> bool {
        self.shading.diffuse(self.corners, weights) >= 0.0
    }

    // Its border is straight: the triangle is not divided.
    fn is_even(&self, _: &[[f64; 3]; 4]) -> bool {
        false
    }
}

/// The specular tone of a face.
struct Specular<'a> {
    shading: &'a Shading<'a>,
    corners: &'a [Light; 3],
}

impl Tone for Specular<'_> {
    fn is_inside(&self, weights: [f64; 3]) -> bool {
        self.shading.specular(self.corners, weights) > 0.0
    }

    /// Whether the angle between the two directions stays on one side of the threshold's, as far as both turn.
    fn is_even(&self, corners: &[[f64; 3]; 4]) -> bool {
        let around = corners.map(|weights| directions(self.corners, weights));
        let cone = |which: usize| {
            let middle: DVec3 = around.iter().map(|directions| directions[which]).sum();
            (middle, around.iter().map(|directions| angle(middle, directions[which])).fold(0.0, f64::max))
        };
        let ((mirrored, turn), (to_eye, turn_to_eye)) = (cone(0), cone(1));
        let limit = self.shading.rule.thresholds[1].clamp(0.0, 1.0).acos();
        // Directions in a cone wider than half a space may turn farther, or vanish.
        let is_narrow = turn.max(turn_to_eye) < 1.5;
        is_narrow && (angle(mirrored, to_eye) - limit).abs() > turn + turn_to_eye + ANGLE_OF_COSINE
    }
}

/// The mirrored direction of the light and the direction to the eye at a place of a face.
fn directions([a, b, c]: &[Light; 3], [of_a, of_b, of_c]: [f64; 3]) -> [DVec3; 2] {
    let mirrored = a.mirrored * of_a + b.mirrored * of_b + c.mirrored * of_c;
    [mirrored, a.to_eye * of_a + b.to_eye * of_b + c.to_eye * of_c]
}

/// The angle between two vectors, radians; that of no direction to any is half a turn.
fn angle(one: DVec3, other: DVec3) -> f64 {
    let is_none = one == DVec3::ZERO || other == DVec3::ZERO;
    if is_none { PI } else { one.cross(other).length().atan2(one.dot(other)) }
}
