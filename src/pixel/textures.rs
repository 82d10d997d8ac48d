//! The textures of a draw, read as GL reads them: the buffers that earlier steps left, and the plan's own pictures.

use super::recomputation::Filtering;
use crate::error::{Error, Result};
use crate::picture::{MaterialPictures, Picture};
use crate::plan::{Draw, Plan, PlanTable, Sampling, Step, Target, Texture};
use crate::renderer::StepValues;
use crate::scene::{Rectangle, Scene, Size};
use std::sync::Arc;
use tinta_glsl::{Sample, Texel};

/// A texture as numbers.
enum Image<'a> {
    /// What the driver read back of a target's colour.
    Colors(Rectangle, &'a [[f32; 4]]),
    /// The same of its depth.
    Depth(Rectangle, &'a [f32]),
    Table(&'a PlanTable),
    /// Linear filter, repeated, or else the nearest texel, clamped.
    Picture(Arc<Picture>, bool),
    /// The texture of a triangle's material.
    Material,
}

/// A draw's textures, in the order of its units.
pub(super) struct Images<'a> {
    images: Vec<Image<'a>>,
    surface: Size,
    filtering: Filtering,
    scene: &'a Scene,
    materials: MaterialPictures,
}

/// The textures as one triangle reads them.
pub(super) struct OfTriangle<'a> {
    pub(super) images: &'a Images<'a>,
    /// The triangle's object and material.
    pub(super) object: Option<usize>,
    pub(super) material: u32,
}

impl<'a> Images<'a> {
    /// Finds the textures of the draw that is this step of the plan; `values` are those after each step.
    pub(super) fn of(
        scene: &'a Scene,
        plan: &'a Plan,
        values: &'a [StepValues],
        (step, draw): (usize, &Draw),
        filtering: Filtering,
    ) -> Result<Self> {
        let before: Vec<(Target, &Step)> =
            plan.passes.iter().flat_map(|pass| pass.steps.iter().map(|step| (pass.target, step))).take(step).collect();
        let last = |is_it: &dyn Fn(&(Target, &Step)) -> bool| before.iter().rposition(is_it);
        let missing = || Error::gl("explaining a pixel", "a plan reads a texture before it is made");
        let image = |texture: &Texture| -> Result<Image<'a>> {
            Ok(match *texture {
                Texture::BorderMap => {
                    let StepValues { part, colors, .. } =
                        &values[last(&|(_, step)| **step == Step::CopyFramebuffer).ok_or_else(missing)?];
                    Image::Colors(*part, &colors[0])
                }
                Texture::DepthMap => {
                    let StepValues { part, depth, .. } =
                        &values[last(&|(_, step)| **step == Step::CopyDepth).ok_or_else(missing)?];
                    if depth.is_empty() {
                        let problem =
                            "it reads depth, which browsers do not give back; the command tinta why explains it";
                        return Err(Error::setting("style", problem));
                    }
                    Image::Depth(*part, depth)
                }
                Texture::Drawn(name) => {
                    let number = |target: Target| match target {
                        Target::Framebuffer => None,
                        Target::Textures(to) => to.colors.iter().position(|color| color.name == name),
                    };
                    let place = last(&|(target, _)| number(*target).is_some()).ok_or_else(missing)?;
                    let StepValues { part, colors, .. } = &values[place];
                    Image::Colors(*part, &colors[number(before[place].0).unwrap_or_default()])
                }
                Texture::Table(number) => Image::Table(plan.tables.get(number).ok_or_else(missing)?),
                Texture::Picture(number) => {
                    let found = plan.pictures.get(number).ok_or_else(missing)?;
                    if found.sampling == Sampling::MipmapRepeated {
                        let problem = "its smaller copies are the driver's own and cannot be explained; use linear";
                        return Err(Error::value("cet-filter", "mipmap", problem));
                    }
                    Image::Picture(found.picture.clone(), found.sampling == Sampling::LinearRepeated)
                }
                Texture::Material { .. } => Image::Material,
            })
        };
        let images = draw.textures.iter().map(|(_, texture)| image(texture)).collect::<Result<_>>()?;
        let mut materials = MaterialPictures::default();
        if let Some((_, is_averaged)) = draw.material_unit() {
            materials.prepare(scene, is_averaged.then_some(scene.size))?;
        }
        Ok(Self { images, surface: scene.size, filtering, scene, materials })
    }
}

impl tinta_glsl::Textures for OfTriangle<'_> {
    fn read(&self, sampler: usize, at: [f64; 2]) -> Option<Sample> {
        let surface = self.images.surface;
        match self.images.images.get(sampler)? {
            Image::Colors(part, values) => {
                let place = nearest(at, surface);
                let value = values[within(*part, place)?].map(f64::from);
                Some(Sample { value, texels: vec![Texel { place, weight: 1.0, value }] })
            }
            Image::Depth(part, values) => {
                let place = nearest(at, surface);
                let depth = f64::from(values[within(*part, place)?]);
                let value = [depth, depth, depth, 1.0];
                Some(Sample { value, texels: vec![Texel { place, weight: 1.0, value }] })
            }
            Image::Table(table) => {
                let size = Size { width: table.texels.len() as u32, height: 1 };
                let place = nearest(at, size);
                let [luminance, alpha] = table.texels[place[0] as usize].map(|byte| f64::from(byte) / 255.0);
                let value = [luminance, luminance, luminance, alpha];
                Some(Sample { value, texels: vec![Texel { place, weight: 1.0, value }] })
            }
            Image::Picture(picture, true) => Some(linear(picture, at, self.images.filtering)),
            Image::Picture(picture, false) => {
                let place = nearest(at, picture.size);
                let value = texel(picture, place).map(|byte| byte / 255.0);
                Some(Sample { value, texels: vec![Texel { place, weight: 1.0, value }] })
            }
            Image::Material => {
                let object = self.images.scene.objects.get(self.object?)?;
                match self.images.materials.of(object, self.material) {
                    Some(picture) => Some(linear(picture, at, self.images.filtering)),
                    None => Some(Sample { value: [1.0; 4], texels: Vec::new() }),
                }
            }
        }
    }
}

/// Returns the texel at a coordinate, from the lower left; those beyond the edge are the edge's.
fn nearest(at: [f64; 2], size: Size) -> [u32; 2] {
    let texel = |at: f64, count: u32| {
        // In 32 bits, as drivers multiply.
        let place = f64::from(at as f32 * count as f32);
        place.floor().clamp(0.0, f64::from(count - 1)) as u32
    };
    [texel(at[0], size.width), texel(at[1], size.height)]
}

/// Returns a pixel's number within the part read back.
fn within(part: Rectangle, [x, y]: [u32; 2]) -> Option<usize> {
    let (x, y) = (x.checked_sub(part.x)?, y.checked_sub(part.y)?);
    (x < part.width && y < part.height).then(|| (y * part.width + x) as usize)
}

/// Returns a texel of a picture, from its lower left, opaque, in 1/255.
fn texel(picture: &Picture, [x, y]: [u32; 2]) -> [f64; 4] {
    let row = picture.size.height - 1 - y;
    let place = (row as usize * picture.size.width as usize + x as usize) * 4;
    let [red, green, blue] = [0, 1, 2].map(|channel| f64::from(picture.pixels[place + channel]));
    [red, green, blue, 255.0]
}

/// Reads between texels, GL_LINEAR and GL_REPEAT.
fn linear(picture: &Picture, at: [f64; 2], filtering: Filtering) -> Sample {
    let sides = [picture.size.width, picture.size.height];
    // The lower left texel's middle of the four, and the share of the ones right and above.
    let mut first = [0_i64; 2];
    let mut share = [0.0; 2];
    for axis in 0..2 {
        let side = f64::from(sides[axis]);
        match filtering {
            Filtering::Exact => {
                let place = at[axis] * side - 0.5;
                (first[axis], share[axis]) = (place.floor() as i64, place - place.floor());
            }
            Filtering::Bytes => {
                // In 1/256 of a texel, rounded, from a coordinate of 32 bits.
                let place = f64::from((at[axis] as f32 * side as f32 - 0.5) * 256.0).round() as i64;
                (first[axis], share[axis]) = (place.div_euclid(256), place.rem_euclid(256) as f64);
            }
        }
    }
    let texels = [[0, 0], [1, 0], [0, 1], [1, 1]].map(|step: [i64; 2]| {
        let place = [0, 1].map(|axis| (first[axis] + step[axis]).rem_euclid(i64::from(sides[axis])) as u32);
        (step, place, texel(picture, place))
    });
    let [a, b, c, d] = texels.map(|(_, _, value)| value);
    let value = [0, 1, 2, 3].map(|channel| {
        let mixed = |first: f64, second: f64, share: f64| match filtering {
            Filtering::Exact => first + (second - first) * share,
            Filtering::Bytes => first + ((share * (second - first) + 128.0) / 256.0).floor(),
        };
        let (below, above) = (mixed(a[channel], b[channel], share[0]), mixed(c[channel], d[channel], share[0]));
        mixed(below, above, share[1]) / 255.0
    });
    let whole = if filtering == Filtering::Bytes { 256.0 } else { 1.0 };
    let weight = |step: [i64; 2]| {
        let along = |axis: usize| if step[axis] == 1 { share[axis] / whole } else { 1.0 - share[axis] / whole };
        along(0) * along(1)
    };
    let texels =
        texels.map(|(step, place, value)| Texel { place, weight: weight(step), value: value.map(|v| v / 255.0) });
    Sample { value, texels: texels.to_vec() }
}
