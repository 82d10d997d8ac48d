//! The styles' shading of a ray's hit, in f64: the shaders' formulas on the same textures, with the intended coordinates.

use glam::{DVec2, DVec3};
use std::sync::Arc;
use tinta::error::Result;
use tinta::picture::{Picture, material_pictures};
use tinta::scene::Scene;
use tinta::styles::{CetCoordinate, CetFilter, Charcoal, ContrastOperator, Noise, Style, Tones};

/// The surface at a pixel.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Surface {
    /// Point and interpolated normal of any length, eye space, scene radii.
    pub point: DVec3,
    pub normal: DVec3,
    /// The corners' diffuse and specular light of the first article, interpolated, in [0, 1].
    pub light: [f64; 2],
    /// Red, green, blue, of 1.
    pub color: DVec3,
    /// Texture coordinate, origin at the lower left, and the object and material it belongs to.
    pub texture: Option<(DVec2, usize, usize)>,
    /// In the picture, from 0 to 1, y up.
    pub place: DVec2,
}

/// How a style shades.
pub(super) enum Shading<'a> {
    /// In tones: a pixel has one of them.
    Tones(&'a Tones),
    Phong,
    /// Noise, contrast-enhanced texture and paper; for sand each object's material pictures.
    Charcoal {
        charcoal: &'a Charcoal,
        noise: Arc<Picture>,
        cet: Arc<Picture>,
        paper: Arc<Picture>,
        sand: Option<Sand>,
    },
}

/// Each object's materials' pictures.
pub(super) type Sand = Vec<Vec<Option<Arc<Picture>>>>;

impl<'a> Shading<'a> {
    /// A style's shading; `None` for a style not computed here: charcoal read through mipmaps, with noise on the object, another
    /// contrast operator or improvements beyond the text's flaws, tones by a far light, and styles without shading.
    pub(super) fn of(style: &'a Style, scene: &Scene) -> Result<Option<Self>> {
        Ok(match style {
            Style::ThreePass(cartoon) | Style::TwoPass(cartoon) => Some(Self::Tones(&cartoon.tones)),
            Style::Mrt(mrt) => Some(Self::Tones(&mrt.0.tones)),
            Style::Ink(ink) => ink.tone_light.is_none().then_some(Self::Tones(&ink.tones)),
            Style::Phong(_) => Some(Self::Phong),
            Style::Charcoal(charcoal) | Style::Sand(charcoal) => {
                let is_computed = charcoal.operator == ContrastOperator::Power
                    && !charcoal.improve.go_beyond_the_text()
                    && charcoal.noise == Noise::Screen
                    && charcoal.cet_filter == CetFilter::Linear;
                if !is_computed {
                    return Ok(None);
                }
                let sand = match style {
                    Style::Sand(_) => {
                        let pictures = scene.objects.iter().map(|object| material_pictures(&object.mesh.materials));
                        Some(pictures.collect::<Result<Sand>>()?)
                    }
                    _ => None,
                };
                let [noise, cet, paper] = charcoal.textures()?;
                Some(Self::Charcoal { charcoal, noise, cet, paper, sand })
            }
            _ => None,
        })
    }

    /// Whether it has tones, which makes each pixel's tone right or wrong.
    pub(super) fn is_of_tones(&self) -> bool {
        matches!(self, Self::Tones(_))
    }

    /// The colour at a surface, of 1, clamped.
    pub(super) fn color(&self, surface: &Surface) -> DVec3 {
        let color = match self {
            Self::Tones(tones) => {
                let [diffuse, specular] = surface.light;
                surface.color * f64::from(tones.tone(diffuse as f32, specular as f32))
            }
            Self::Phong => phong(surface),
            Self::Charcoal { charcoal, noise, cet, paper, sand } => {
                let drawing = self::charcoal(charcoal, [noise, cet, paper], surface);
                match sand {
                    None => drawing,
                    Some(pictures) => drawing * 0.4 + sepia(charcoal, pictures, surface) * 0.6,
                }
            }
        };
        color.clamp(DVec3::ZERO, DVec3::ONE)
    }
}

/// With the numbers of `phong.frag`.
fn phong(surface: &Surface) -> DVec3 {
    let normal = surface.normal.normalize_or_zero();
    let to_light = (DVec3::ONE - surface.point).normalize_or_zero();
    let to_eye = (-surface.point).normalize_or_zero();
    let diffuse = to_light.dot(normal).max(0.0);
    let reflected = 2.0 * to_light.dot(normal) * normal - to_light;
    let highlight = match diffuse > 0.0 {
        true => reflected.dot(to_eye).max(0.0).powf(24.0),
        false => 0.0,
    };
    surface.color * (0.25 + 0.75 * diffuse) + 0.35 * highlight
}

/// Valente 2007, section 3.3.
fn charcoal(charcoal: &Charcoal, [noise, cet, paper]: [&Picture; 3], surface: &Surface) -> DVec3 {
    let normal = surface.normal.normalize_or_zero();
    let lights =
        charcoal.lights.iter().flatten().map(|light| DVec3::from_array(light.map(f64::from)).normalize_or_zero());
    let light: f64 = lights.map(|light| light.dot(normal).max(0.0)).sum();
    let original = light.powf(f64::from(charcoal.contrast_exponent));
    let mut cem = original * f64::from(charcoal.saturation);
    if charcoal.improve.clamp {
        cem = cem.clamp(0.0, 1.0);
    }
    let mut row = if charcoal.cet_coordinate == CetCoordinate::Saturated { cem } else { original };
    if charcoal.improve.wrap {
        let half_texel = 0.5 / f64::from(cet.size.height);
        row = row.clamp(half_texel, 1.0 - half_texel);
    }
    let random = sample(noise, surface.place).element_sum() / 3.0;
    let smudge = if charcoal.smudge { cem } else { 1.0 };
    sample(cet, DVec2::new(random, row)) * cem * smudge - (DVec3::ONE - sample(paper, surface.place))
}

/// The model's own texture in sepia (section 4).
fn sepia(charcoal: &Charcoal, pictures: &Sand, surface: &Surface) -> DVec3 {
    let own = surface.texture.and_then(|(coordinate, object, material)| {
        let picture = pictures.get(object)?.get(material)?.as_ref()?;
        Some(sample(picture, coordinate))
    });
    let (weights, constant) = match charcoal.improve.luminance {
        true => (DVec3::new(0.2126, 0.7152, 0.0722), 0.0),
        // The published weights add the texture's alpha.
        false => (DVec3::new(0.1125, 0.0154, 0.0721), 1.0),
    };
    let luminance = weights.dot(own.unwrap_or(DVec3::ONE)) + constant;
    DVec3::new(luminance * 1.2, luminance, luminance * 0.8)
}

/// GL_LINEAR with GL_REPEAT, of 1; y counts from the lowest row.
fn sample(picture: &Picture, place: DVec2) -> DVec3 {
    let (width, height) = (i64::from(picture.size.width), i64::from(picture.size.height));
    let at = place * DVec2::new(width as f64, height as f64) - 0.5;
    let (low, share) = (at.floor(), at - at.floor());
    let texel = |dx: i64, dy: i64| {
        let (x, y) = ((low.x as i64 + dx).rem_euclid(width), (low.y as i64 + dy).rem_euclid(height));
        let [red, green, blue, _] = picture.pixel(x, height - 1 - y).map(f64::from);
        DVec3::new(red, green, blue) / 255.0
    };
    let row = |dy| texel(0, dy).lerp(texel(1, dy), share.x);
    row(0).lerp(row(1), share.y)
}
