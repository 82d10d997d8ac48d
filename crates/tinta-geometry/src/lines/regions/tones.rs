//! Regions of one tone: the cartoon's light of Evangelista et al. 2005 (appendix 1), without pixels.
//!
//! The article computes light at vertices and interpolates it with perspective. So the border of the diffuse tone is a straight line
//! in each face. The border of the specular tone is a curve; it is followed from side to side of a fine division of the face, at
//! most a pixel apart, with each point on the curve. Of a light from a direction all tones have straight borders.

use super::cut::cut;
use super::region::{Regions, SeenFace};
use super::snap::Segment;
use super::view::{Sides, View};
use crate::error::Result;
use crate::lines::progress::Progress;
use crate::mesh::NONE;
use crate::scene::Scene;
use crate::threads::{cores, in_chunks};
use glam::{DVec2, DVec3};

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

/// Halvings of a side that find where a curve crosses it.
const HALVINGS: usize = 40;

struct Shading<'a> {
    view: &'a View<'a>,
    rule: &'a ToneRule,
}

/// What a vertex shader hands to the interpolation, at a face's corners.
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

impl Shading<'_> {
    fn surface(&self, SeenFace { object, face }: SeenFace, tone: u8) -> TonedSurface {
        let materials = &self.view.scene.objects[object as usize].mesh.triangle_materials;
        TonedSurface { object, material: materials.get(face as usize).copied().unwrap_or(NONE), tone }
    }

    /// What is seen at a place of the picture.
    fn at(&self, px: DVec2) -> Option<TonedSurface> {
        let hit = self.view.first_hit(px)?;
        let seen = SeenFace { object: hit.object, face: hit.face };
        Some(self.surface(seen, self.tone(&self.lights(seen), hit.weights)))
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

    /// How far the diffuse light is above its threshold.
    fn diffuse(&self, corners: &[NearLight; 3], weights: [f64; 3]) -> f64 {
        mixed(corners, weights, |light| light.diffuse) - self.rule.thresholds[0]
    }

    /// How far the specular light is above its threshold.
    fn specular(&self, corners: &[NearLight; 3], weights: [f64; 3]) -> f64 {
        let (mirrored, to_eye) =
            (mixed(corners, weights, |light| light.mirrored), mixed(corners, weights, |light| light.to_eye));
        let lengths = mirrored.length() * to_eye.length();
        let cosine = if lengths > 0.0 { mirrored.dot(to_eye) / lengths } else { 0.0 };
        cosine.max(0.0) - self.rule.thresholds[1]
    }

    fn tone(&self, lights: &Lights, weights: [f64; 3]) -> u8 {
        match lights {
            Lights::Near(corners) if self.specular(corners, weights) > 0.0 => 2,
            Lights::Near(corners) => u8::from(self.diffuse(corners, weights) >= 0.0),
            Lights::Far(corners) => {
                let light = mixed(corners, weights, |light| *light);
                self.rule.thresholds.iter().map(|threshold| u8::from(light >= *threshold)).sum()
            }
        }
    }

    /// The surface of a face, `None` where it has several tones, and the borders between these.
    fn face(&self, place: u32) -> (Option<TonedSurface>, Vec<Segment>) {
        let seen = self.view.face(place);
        let lights = self.lights(seen);
        let points = self.view.faces.corners(place);
        let mut lines = Vec::new();
        match &lights {
            Lights::Far(corners) => {
                for threshold in self.rule.thresholds {
                    let is_above = |weights| mixed(corners, weights, |light| *light) >= threshold;
                    self.add_borders(points, 1, is_above, &mut lines);
                }
            }
            Lights::Near(corners) => {
                self.add_borders(points, 1, |weights| self.diffuse(corners, weights) >= 0.0, &mut lines);
                if self.rule.thresholds[1] < 1.0 {
                    let [low, high] = self.view.faces.tree.boxes()[place as usize].corners();
                    let longest_px = (high - low).truncate().min(self.view.space.size).max_element();
                    let parts = (longest_px.ceil() as usize).clamp(1, MOST_PARTS);
                    self.add_borders(points, parts, |weights| self.specular(corners, weights) > 0.0, &mut lines);
                }
            }
        }
        match lines.is_empty() {
            true => (Some(self.surface(seen, self.tone(&lights, [1.0 / 3.0; 3]))), Vec::new()),
            false => (None, lines.into_iter().flat_map(|line| self.view.across(line)).collect()),
        }
    }

    /// Adds the lines between the inside and the outside of a tone in a triangle, whose sides are divided into so many parts.
    fn add_borders(
        &self,
        corners: [DVec3; 3],
        parts: usize,
        is_inside: impl Fn([f64; 3]) -> bool,
        lines: &mut Vec<[DVec3; 2]>,
    ) {
        let weights = |[i, j]: [usize; 2]| {
            let [a, b] = [i, j].map(|steps| steps as f64 / parts as f64);
            [(1.0 - a - b).max(0.0), a, b]
        };
        let rows: Vec<Vec<bool>> =
            (0..=parts).map(|i| (0..=parts - i).map(|j| is_inside(weights([i, j]))).collect()).collect();
        let point = |weights: [f64; 3]| corners[0] * weights[0] + corners[1] * weights[1] + corners[2] * weights[2];
        let between = |inside: [usize; 2], outside: [usize; 2]| {
            let (mut inside, mut outside) = (weights(inside), weights(outside));
            for _ in 0..HALVINGS {
                let middle = [0, 1, 2].map(|corner| (inside[corner] + outside[corner]) * 0.5);
                *(if is_inside(middle) { &mut inside } else { &mut outside }) = middle;
            }
            point(inside)
        };
        let mut add = |triangle: [[usize; 2]; 3]| {
            let is_in = triangle.map(|[i, j]| rows[i][j]);
            let Some(single) = (0..3).find(|corner| {
                let others = [is_in[(corner + 1) % 3], is_in[(corner + 2) % 3]];
                others == [!is_in[*corner]; 2]
            }) else {
                return;
            };
            let ends = [1, 2].map(|step| {
                let (one, other) = (triangle[single], triangle[(single + step) % 3]);
                if is_in[single] { between(one, other) } else { between(other, one) }
            });
            lines.push(ends);
        };
        for i in 0..parts {
            for j in 0..parts - i {
                add([[i, j], [i + 1, j], [i, j + 1]]);
                if i + j + 1 < parts {
                    add([[i + 1, j], [i + 1, j + 1], [i, j + 1]]);
                }
            }
        }
    }

    /// Whether what is seen may differ on both sides of an edge. Sides of faces with several tones count: their borders end there.
    fn is_border(&self, sides: &Sides, surfaces: &[Option<TonedSurface>]) -> bool {
        let [(_, first), (_, second)] = *sides.of_edge else { return true };
        let [one, other] = [first, second].map(|place| surfaces[place as usize]);
        one.is_none() || one != other || !self.view.goes_on(sides)
    }
}
