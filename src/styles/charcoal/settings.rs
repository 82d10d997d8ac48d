//! The settings of `charcoal` and `sand`: names, ranges and help, as every command has them.

use super::{Charcoal, CharcoalRecipe};
use crate::settings::{Kind, ON_OFF, Setting, Value as _, names_of, under};
use crate::styles::{ALL_STYLES, CHARCOAL, Supersample, cull};

impl Charcoal {
    /// Its settings.
    pub(in crate::styles) fn settings() -> Vec<Setting<Self>> {
        let common = vec![
            cull(|charcoal: &mut Self| &mut charcoal.cull_back_faces),
            Supersample::setting(|charcoal: &mut Self| &mut charcoal.supersample),
        ];
        let recipe = Setting::of(
            "charcoal",
            "RECIPE",
            Kind::Recipe(names_of::<CharcoalRecipe>()),
            "Recipe: plain (the unchanged listing), darker (density 85, contrast exponent 1.2, smudged), closure (density 35, contrast \
             exponent 2, saturation 1.4); options given beside it override it",
            |_: &Self| CharcoalRecipe::default().text(),
            |charcoal, text| {
                let recipe = Self::recipe(CharcoalRecipe::parse(text)?);
                (charcoal.density_percent, charcoal.contrast_exponent) =
                    (recipe.density_percent, recipe.contrast_exponent);
                (charcoal.smudge, charcoal.saturation) = (recipe.smudge, recipe.saturation);
                Ok(())
            },
        )
        // The old name made our values look like the text's.
        .formerly(&[("published", "plain")]);
        let grain = vec![
            recipe,
            Setting::field(
                "seed",
                "N",
                "Seed of the random numbers; the same seed gives the same textures",
                |charcoal: &mut Self| &mut charcoal.seed,
            )
            .range(0.0, 1000.0, 0),
            Setting::field(
                "random",
                "GENERATOR",
                "Random numbers: splitmix, or rand() as C libraries of the report's time had it: msvc, glibc",
                |charcoal: &mut Self| &mut charcoal.random,
            )
            .labelled("random numbers"),
            Setting::field(
                "density",
                "PERCENT",
                "Percentage of black pixels in the grain's texture, before --cet-exponent moves them; more is darker",
                |charcoal: &mut Self| &mut charcoal.density_percent,
            )
            .inside("grain")
            .range(0.0, 100.0, 0),
            Setting::field(
                "cet-exponent",
                "M",
                "Exponent m that moves black pixels along t to t^m; more leaves fewer grains in light tones",
                |charcoal: &mut Self| &mut charcoal.cet_exponent,
            )
            .inside("grain")
            .range(1.0, 20.0, 1)
            .labelled("grain exponent"),
            Setting::field(
                "cet-blur",
                "PIXELS",
                "Standard deviation of the blur of the grain's texture, in pixels; more makes the grain softer",
                |charcoal: &mut Self| &mut charcoal.cet_blur_px,
            )
            .inside("grain")
            .range(0.0, 5.0, 2)
            .labelled("grain blur"),
        ];
        let drawing = vec![
            Setting::field(
                "contrast",
                "M",
                "Exponent of the light's contrast; more darkens everything except the brightest parts",
                |charcoal: &mut Self| &mut charcoal.contrast_exponent,
            )
            .range(0.1, 6.0, 2),
            Setting::field(
                "saturation",
                "FACTOR",
                "Factor for the light; above 1 faint lines vanish (closure)",
                |charcoal: &mut Self| &mut charcoal.saturation,
            )
            .range(0.0, 3.0, 2),
            Setting::field("smudge", ON_OFF, "Smudge the drawing, on or off; on is darker", |charcoal: &mut Self| {
                &mut charcoal.smudge
            }),
            light(
                "light-1",
                "Direction towards the first light, in eye space, or none for the second light alone",
                |charcoal| &mut charcoal.lights[0],
            )
            .labelled("first light")
            .inside("light"),
            light(
                "light-2",
                "Direction towards the second light, or none for the first light alone",
                |charcoal| &mut charcoal.lights[1],
            )
            .labelled("second light")
            .inside("light"),
            Setting::field(
                "cet",
                "FILE",
                "Picture of the grain's texture, the darkest tone in its lowest row; replaces --density, --cet-exponent and \
                 --cet-blur",
                |charcoal: &mut Self| &mut charcoal.cet,
            )
            .inside("texture")
            .said("made from the seed")
            .labelled("grain"),
            Setting::field(
                "noise-texture",
                "FILE",
                "Picture of the noise that chooses the grain: the mean of red, green and blue is its place along the width",
                |charcoal: &mut Self| &mut charcoal.noise_texture,
            )
            .inside("texture")
            .said("made from the seed"),
            Setting::field(
                "paper",
                "FILE",
                "Picture of the paper, stretched over the whole drawing; replaces --background",
                |charcoal: &mut Self| &mut charcoal.paper,
            )
            .inside("texture")
            .said("made from the seed"),
            Setting::field(
                "texture-size",
                "WxH",
                "Size of grain, noise and paper, stretched over the drawing; more is finer",
                |charcoal: &mut Self| &mut charcoal.texture_size,
            )
            .inside("grain"),
            Setting::field(
                "cet-filter",
                "FILTER",
                "Filter of the grain's texture: linear, mipmap (blurs the grain away)",
                |charcoal: &mut Self| &mut charcoal.cet_filter,
            )
            .inside("grain")
            .labelled("grain filter"),
            Setting::field(
                "cet-coordinate",
                "LIGHT",
                "Light that chooses the grain: original, saturated",
                |charcoal: &mut Self| &mut charcoal.cet_coordinate,
            )
            .inside("grain")
            .labelled("grain chosen by"),
            Setting::field(
                "contrast-operator",
                "OPERATOR",
                "Operator that enhances contrast: power (as published), sigmoid, bias",
                |charcoal: &mut Self| &mut charcoal.operator,
            )
            .inside("contrast"),
            Setting::field(
                "noise",
                "WHERE",
                "The noise is fixed to: screen (as published), object (turns with the model)",
                |charcoal: &mut Self| &mut charcoal.noise,
            )
            .inside("grain"),
            Setting::field(
                "improve",
                "WHAT",
                "What to draw better: flaws of the text (clamp, wrap, paper-coordinate, luminance; together: all) and more \
                 (proportion, tooth, two-sided, strokes; with all: everything); separated by commas",
                |charcoal: &mut Self| &mut charcoal.improve,
            )
            .labelled("improved"),
        ];
        under(ALL_STYLES, common).chain(under(CHARCOAL, grain)).chain(under(CHARCOAL, drawing)).collect()
    }
}

/// Returns the setting of a light that may be left out.
fn light(
    name: &'static str,
    help: &'static str,
    field: fn(&mut Charcoal) -> &mut Option<[f32; 3]>,
) -> Setting<Charcoal> {
    let mut light = Setting::open_field(name, "X,Y,Z|none", "none", help, field).range(-1.0, 1.0, 2);
    // The default is a direction, as the help says.
    light.said_default = None;
    light
}
