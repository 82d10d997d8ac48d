//! The charcoal drawing's settings, those of its textures in a group that `tinta textures` shares.

use super::{parse_switch, parse_triple};
use std::path::PathBuf;
use tinta::styles::{CetCoordinate, CetFilter, Charcoal, ContrastOperator, Improvements, Noise, Paper, Recipe};
use tinta::{Result, Size};

/// What the contrast-enhanced texture and all random numbers follow from.
#[derive(clap::Args)]
#[command(next_help_heading = "Styles charcoal and sand (the defaults are the text's where it gives them)")]
pub struct GrainArguments {
    /// Where the random numbers begin; the same seed gives the same textures [default: 0]
    #[arg(long, value_name = "N", default_value = "0", hide_default_value = true, allow_hyphen_values = true)]
    pub seed: u64,

    /// Share of black pixels in the grain's texture before they are moved, percent; more is darker [default: 60]
    #[arg(long, value_name = "PERCENT", allow_hyphen_values = true)]
    pub density: Option<f64>,

    /// Exponent m that moves black pixels along t to t^m; more leaves fewer grains in light tones [default: 5.5]
    #[arg(long, value_name = "M", allow_hyphen_values = true)]
    pub cet_exponent: Option<f64>,
}

#[derive(clap::Args)]
#[command(next_help_heading = "Styles charcoal and sand (the defaults are the text's where it gives them)")]
pub struct CharcoalArguments {
    /// Recipe: published, darker (density 85, contrast exponent 1.2, smudged), closure (density 35, contrast exponent 2, saturation 1.4); options given beside it count more [default: published]
    #[arg(long, value_name = "RECIPE", default_value = "published", hide_default_value = true)]
    charcoal: Recipe,

    #[command(flatten)]
    grain: GrainArguments,

    /// Exponent of the light's contrast; more darkens all but the lights [default: 1.5]
    #[arg(long, value_name = "M", allow_hyphen_values = true)]
    contrast_exponent: Option<f32>,

    /// What the light is multiplied by; above 1 faint lines vanish (closure) [default: 1]
    #[arg(long, value_name = "FACTOR", allow_hyphen_values = true)]
    saturation: Option<f32>,

    /// Smudge the drawing, on or off; on is darker [default: off]
    #[arg(long, value_name = "ON|OFF", action = clap::ArgAction::Set, value_parser = parse_switch)]
    smudge: Option<bool>,

    /// Direction towards the first light, seen from the eye [default: 0.26,0.9,0.35]
    #[arg(long = "light-1", value_name = "X,Y,Z", value_parser = parse_triple, default_value = "0.26,0.9,0.35", hide_default_value = true, allow_hyphen_values = true)]
    first_light: [f32; 3],

    /// Direction towards the second light [default: -0.7,-0.56,0.45]
    #[arg(long = "light-2", value_name = "X,Y,Z", value_parser = parse_triple, default_value = "-0.7,-0.56,0.45", hide_default_value = true, allow_hyphen_values = true)]
    second_light: [f32; 3],

    /// Picture of the paper, stretched over the whole drawing in place of --background [default: made from the seed]
    #[arg(long, value_name = "FILE")]
    paper: Option<PathBuf>,

    /// Size of grain, noise and paper, stretched over the drawing; more is finer [default: 512x512]
    #[arg(long, value_name = "WxH", default_value = "512x512", hide_default_value = true)]
    texture_size: Size,

    /// Filter of the grain's texture: linear, mipmap (blurs the grain away) [default: linear]
    #[arg(long, value_name = "FILTER", default_value = "linear", hide_default_value = true)]
    cet_filter: CetFilter,

    /// Light that chooses the grain: original, saturated [default: original]
    #[arg(long, value_name = "LIGHT", default_value = "original", hide_default_value = true)]
    cet_coordinate: CetCoordinate,

    /// What enhances contrast: power (as published), sigmoid, bias [default: power]
    #[arg(long, value_name = "OPERATOR", default_value = "power", hide_default_value = true)]
    contrast_operator: ContrastOperator,

    /// Where the noise lies: screen (as published), object (turns with the model) [default: screen]
    #[arg(long, value_name = "WHERE", default_value = "screen", hide_default_value = true)]
    noise: Noise,

    /// Flaws of the text to mend: clamp, wrap, paper-coordinate, luminance with commas between, or all [default: none]
    #[arg(long, value_name = "FLAWS", default_value = "none", hide_default_value = true)]
    improve: Improvements,
}

impl CharcoalArguments {
    pub fn settings(&self, cull_back_faces: bool) -> Result<Charcoal> {
        let recipe = Charcoal::recipe(self.charcoal);
        Ok(Charcoal {
            contrast_exponent: self.contrast_exponent.unwrap_or(recipe.contrast_exponent),
            saturation: self.saturation.unwrap_or(recipe.saturation),
            smudge: self.smudge.unwrap_or(recipe.smudge),
            lights: [self.first_light, self.second_light],
            density_percent: self.grain.density.unwrap_or(recipe.density_percent),
            cet_exponent: self.grain.cet_exponent.unwrap_or(recipe.cet_exponent),
            seed: self.grain.seed,
            texture_size: self.texture_size,
            paper: self.paper.as_deref().map_or(Ok(Paper::Made), Paper::read)?,
            cet_filter: self.cet_filter,
            cet_coordinate: self.cet_coordinate,
            operator: self.contrast_operator,
            noise: self.noise,
            improve: self.improve,
            cull_back_faces,
            pictures: recipe.pictures,
        })
    }
}
