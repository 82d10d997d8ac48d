//! The styles' settings, in one group for every command that draws.

use super::charcoal::CharcoalArguments;
use super::{parse_pair, parse_switch, parse_triple};
use std::path::PathBuf;
use tinta::edges::{Class, ClassSet, CreaseAngle, SilhouetteRule};
use tinta::plan::LineDrawing;
use tinta::styles::{
    Border, Cartoon, ClassColors, Dietrich, Filter, Ink, Inking, LightOn, MapEncoding, MapTarget, Mrt, PaintMode,
    Phong, Quality, Ramp, RampRow, Supersample, ToneLookup, Tones,
};
use tinta::{Error, LineSettings, Result, Show, Style, StyleName};

#[derive(clap::Args)]
#[command(next_help_heading = "All styles")]
pub struct StyleArguments {
    /// Which picture: final, borders, tones; three-pass, two-pass and mrt also normals, depth, map, ink also map; charcoal and sand final, diffuse, cem, cet, paper [default: final]
    #[arg(long, value_name = "PICTURE", default_value = "final", hide_default_value = true)]
    pub show: Show,

    /// No lines, tones or paint alone [default: off]
    #[arg(long)]
    pub no_borders: bool,

    /// Leave out faces turned away: none, back; faster, and nearly the same picture of closed models (inking: a few more pixels) [default: none]
    #[arg(long, value_name = "FACES", action = clap::ArgAction::Set, value_parser = parse_cull, default_value = "none", hide_default_value = true)]
    cull: bool,

    #[command(flatten)]
    cartoon: CartoonArguments,

    #[command(flatten)]
    crease: CreaseArguments,

    #[command(flatten)]
    inking: InkingArguments,

    #[command(flatten)]
    dietrich: DietrichArguments,

    #[command(flatten)]
    image_space: ImageSpaceArguments,

    #[command(flatten)]
    ink: InkArguments,

    #[command(flatten)]
    charcoal: CharcoalArguments,
}

#[derive(clap::Args)]
#[command(next_help_heading = "Styles three-pass, two-pass and mrt (the defaults are the paper's)")]
struct CartoonArguments {
    /// Number of tones, 1 to 3; fewer leave out the brightest [default: 3]
    #[arg(long, value_name = "N", default_value = "3", hide_default_value = true)]
    tones: u8,

    /// Diffuse and specular light from which the second and third tone hold [default: 0.8,0.65]
    #[arg(long, value_name = "D,S", value_parser = parse_pair, default_value = "0.8,0.65", hide_default_value = true, allow_hyphen_values = true)]
    tone_thresholds: [f32; 2],

    /// What the tones multiply the colour by [default: 0.65,0.95,1]
    #[arg(long, value_name = "A,B,C", value_parser = parse_triple, default_value = "0.65,0.95,1", hide_default_value = true, allow_hyphen_values = true)]
    tone_levels: [f32; 3],

    /// Find tones by comparing (steps) or in a 1-D texture (texture) [default: steps]
    #[arg(long, value_name = "HOW", default_value = "steps", hide_default_value = true)]
    tone_lookup: ToneLookup,

    /// Edge filter: laplacian4, laplacian8, mitchell, sobel, roberts [default: laplacian4]
    #[arg(long, value_name = "FILTER", default_value = "laplacian4", hide_default_value = true)]
    filter: Filter,

    /// What the edge filter's response is multiplied by; more darkens faint edges [default: 0.2]
    #[arg(long, value_name = "FACTOR", default_value = "0.2", hide_default_value = true, allow_hyphen_values = true)]
    detection_factor: f32,

    /// Draw a square behind the scene, on or off; off loses outer borders [default: on]
    #[arg(long, value_name = "ON|OFF", action = clap::ArgAction::Set, value_parser = parse_switch, default_value = "on", hide_default_value = true)]
    background_quad: bool,

    /// How normals and depth are kept: paper, biased (0.5 n + 0.5), float16, float, depth-texture (biased, depth from the depth buffer); mrt has paper only [default: paper]
    #[arg(long, value_name = "ENCODING", default_value = "paper", hide_default_value = true)]
    map_encoding: MapEncoding,

    /// Let depth answer by a threshold that knows the surface's slope, on or off; off: by the filter [default: off]
    #[arg(long, value_name = "ON|OFF", action = clap::ArgAction::Set, value_parser = parse_switch, default_value = "off", hide_default_value = true)]
    slope_threshold: bool,
}

/// What the image-space styles share.
#[derive(clap::Args)]
#[command(next_help_heading = "Styles three-pass, two-pass, mrt and ink")]
struct ImageSpaceArguments {
    /// Width of the borders, pixels, 1 to 64; paper is as the filter draws them, about 2; ink has 2 [default: paper]
    #[arg(long, value_name = "PIXELS", value_parser = parse_border_width, default_value = "paper", hide_default_value = true)]
    border_width: BorderWidth,

    /// Draw 1, 2 or 4 times as wide and high and shrink; the largest picture shrinks by as much (tinta info has it) [default: 1; ink --quality best 2]
    #[arg(long, value_name = "N")]
    supersample: Option<Supersample>,

    /// Copy the map into its texture (copy) or draw it there by a framebuffer object (texture), the same picture but for rounding; mrt always does [default: copy]
    #[arg(long, value_name = "HOW", default_value = "copy", hide_default_value = true)]
    map_target: MapTarget,
}

/// A width in pixels, or the published one.
#[derive(Clone, Copy)]
struct BorderWidth(Option<u32>);

/// What the edge list is asked.
#[derive(clap::Args)]
#[command(next_help_heading = "Style inking: lines from the model's edges (the defaults are the text's)")]
pub struct CreaseArguments {
    /// Least angle between faces that makes their edge a crease, degrees; style lines too [default: 66.4, a cosine of 0.4]
    #[arg(long, value_name = "DEGREES", allow_hyphen_values = true)]
    crease_angle: Option<f64>,

    /// Find silhouettes with one view vector for all edges (paper) or exactly (exact) [default: paper; style lines: exact]
    #[arg(long, value_name = "RULE")]
    silhouette: Option<SilhouetteRule>,
}

#[derive(clap::Args)]
#[command(next_help_heading = "Style inking: lines from the model's edges (the defaults are the text's)")]
struct InkingArguments {
    /// Edges to draw: boundary, non-manifold, silhouette, crease, material, texture, normal, in style lines also intersection, with commas between, or all [default: boundary,silhouette,crease; style lines: all but texture and normal]
    #[arg(long, value_name = "CLASSES", value_parser = parse_classes)]
    classes: Option<ClassChoice>,

    /// Colours of the lines, style lines too: CLASS=COLOUR with commas between, names or #rrggbb, or figure-6 (outer red, inner blue) [default: black]
    #[arg(long, value_name = "COLOURS")]
    class_colors: Option<ClassColors>,

    /// Width of the lines, pixels, above 0 to 16384, style lines too [default: 2]
    #[arg(long, value_name = "PIXELS", default_value = "2", hide_default_value = true, allow_hyphen_values = true)]
    line_width: f32,

    /// Smooth and blend the lines, on or off; quads are never smoothed [default: on]
    #[arg(long, value_name = "ON|OFF", action = clap::ArgAction::Set, value_parser = parse_switch, default_value = "on", hide_default_value = true)]
    smooth: bool,

    /// Join lines by points at their ends, on or off; thin lines hardly need it [default: on]
    #[arg(long, value_name = "ON|OFF", action = clap::ArgAction::Set, value_parser = parse_switch, default_value = "on", hide_default_value = true)]
    joints: bool,

    /// Draw edges both of whose faces are turned away, on or off; on closed models hardly any of them shows [default: on]
    #[arg(long, value_name = "ON|OFF", action = clap::ArgAction::Set, value_parser = parse_switch, default_value = "on", hide_default_value = true)]
    back_edges: bool,

    /// Draw lines as GL lines (gl) or as quads of exactly their width (quads) [default: gl]
    #[arg(long, value_name = "HOW", default_value = "gl", hide_default_value = true)]
    line_drawing: LineDrawing,

    /// Lines write depth as in the text (write), which leaves gaps between smoothed lines, or only test it (test) [default: write]
    #[arg(long, value_name = "HOW", action = clap::ArgAction::Set, value_parser = parse_ink_depth, default_value = "write", hide_default_value = true)]
    ink_depth: bool,

    /// How far faces are pushed behind the lines: glPolygonOffset's factor and units [default: 1,5]
    #[arg(long, value_name = "F,U", value_parser = parse_pair, default_value = "1,5", hide_default_value = true, allow_hyphen_values = true)]
    polygon_offset: [f32; 2],

    /// Paint faces in the background's colour (none), their own (flat), or by light and ramp (ramp) [default: ramp]
    #[arg(long, value_name = "HOW", default_value = "ramp", hide_default_value = true)]
    paint: PaintMode,

    /// Picture of four gradients, one above the other, dark at the left [default: built in]
    #[arg(long, value_name = "FILE")]
    ramp: Option<PathBuf>,

    /// Which gradient: material (the nearest to its colour), object (one after the other), or 0 to 3 [default: material]
    #[arg(long, value_name = "ROW", default_value = "material", hide_default_value = true)]
    ramp_row: RampRow,

    /// Compute the light on the cpu or in a vertex-shader [default: cpu]
    #[arg(long, value_name = "WHERE", default_value = "cpu", hide_default_value = true)]
    light: LightOn,

    /// Multiply the model's own picture in, on or off [default: off]
    #[arg(long, value_name = "ON|OFF", action = clap::ArgAction::Set, value_parser = parse_switch, default_value = "off", hide_default_value = true)]
    texture: bool,
}

#[derive(clap::Args)]
#[command(next_help_heading = "Style dietrich")]
struct DietrichArguments {
    /// Cosine between normal and view below which a pixel is ink, 0 to 1; more makes wider lines [default: 0.25]
    #[arg(long, value_name = "COSINE", default_value = "0.25", hide_default_value = true, allow_hyphen_values = true)]
    ink_threshold: f32,
}

#[derive(clap::Args)]
#[command(next_help_heading = "Style ink (tones as three-pass, --crease-angle as inking)")]
struct InkArguments {
    /// Time for the ink: standard (no more than three-pass) or best (drawn larger, and shrunk) [default: standard]
    #[arg(long, value_name = "QUALITY", default_value = "standard", hide_default_value = true)]
    quality: Quality,
}

impl StyleArguments {
    /// The style of this name with these settings; what belongs to other styles is left alone.
    pub fn style(&self, name: StyleName) -> Result<Style> {
        Ok(match name {
            StyleName::Phong => Style::Phong(Phong { cull_back_faces: self.cull, ..Phong::default() }),
            StyleName::ThreePass => Style::ThreePass(self.cartoon.settings(self)),
            StyleName::TwoPass => Style::TwoPass(self.cartoon.settings(self)),
            StyleName::Mrt => Style::Mrt(self.mrt()?),
            StyleName::Inking => Style::Inking(self.inking.settings(self)?),
            StyleName::Dietrich => Style::Dietrich(Dietrich {
                threshold: if self.no_borders { 0.0 } else { self.dietrich.ink_threshold },
                cull_back_faces: self.cull,
                ..Dietrich::default()
            }),
            StyleName::Ink => Style::Ink(self.ink.settings(self)?),
            StyleName::Charcoal => Style::Charcoal(self.charcoal.settings(self.cull)?),
            StyleName::Sand => Style::Sand(self.charcoal.settings(self.cull)?),
        })
    }
}

impl StyleArguments {
    fn mrt(&self) -> Result<Mrt> {
        let Cartoon { tones, border, background_square, cull_back_faces, map_encoding, supersample, .. } =
            self.cartoon.settings(self);
        if map_encoding != MapEncoding::Paper {
            return Err(Error::Setting {
                setting: "--map-encoding".to_owned(),
                problem: "style mrt keeps its map as published; leave it out, or draw --style three-pass".to_owned(),
            });
        }
        Ok(Mrt { tones, border, background_square, cull_back_faces, supersample })
    }

    /// What the style lines draws.
    pub fn line_settings(&self) -> Result<LineSettings> {
        // Given explicitly, for lines know no other rule than the exact one.
        if self.crease.silhouette == Some(SilhouetteRule::Paper) {
            return Err(Error::Setting {
                setting: "--silhouette paper".to_owned(),
                problem: "style lines finds silhouettes exactly; leave it out, or draw --style inking into a .png"
                    .to_owned(),
            });
        }
        let classes = match self.inking.classes {
            None => LineSettings::default().classes,
            Some(ClassChoice::All) => ClassSet::ALL,
            Some(ClassChoice::These(classes)) => classes,
        };
        Ok(LineSettings { classes, crease_angle: self.crease.crease_angle()? })
    }

    /// Colour and width of lines, which the style lines has in common with inking.
    pub fn line_look(&self) -> (ClassColors, f32) {
        (self.inking.class_colors.unwrap_or_default(), self.inking.line_width)
    }
}

impl CartoonArguments {
    fn tones(&self) -> Tones {
        let [diffuse_threshold, specular_threshold] = self.tone_thresholds;
        Tones {
            count: self.tones,
            diffuse_threshold,
            specular_threshold,
            levels: self.tone_levels,
            lookup: self.tone_lookup,
        }
    }

    fn settings(&self, common: &StyleArguments) -> Cartoon {
        let border = Border {
            filter: self.filter,
            detection_factor: self.detection_factor,
            width_px: common.image_space.border_width.0,
            slope_threshold: self.slope_threshold,
        };
        Cartoon {
            tones: self.tones(),
            border: (!common.no_borders).then_some(border),
            background_square: self.background_quad,
            cull_back_faces: common.cull,
            map_encoding: self.map_encoding,
            map_target: common.image_space.map_target,
            supersample: common.image_space.supersample.unwrap_or_default(),
        }
    }
}

impl InkArguments {
    fn settings(&self, common: &StyleArguments) -> Result<Ink> {
        Ok(Ink {
            quality: self.quality,
            is_inked: !common.no_borders,
            crease_angle: common.crease.crease_angle()?,
            tones: common.cartoon.tones(),
            cull_back_faces: common.cull,
            line_width_px: common.image_space.border_width.0.unwrap_or(Ink::default().line_width_px),
            supersample: common.image_space.supersample,
            map_target: common.image_space.map_target,
            ..Ink::default()
        })
    }
}

impl CreaseArguments {
    pub fn crease_angle(&self) -> Result<CreaseAngle> {
        self.crease_angle.map_or(Ok(CreaseAngle::default()), CreaseAngle::from_degrees)
    }

    /// The rule for silhouettes.
    pub fn silhouette(&self) -> SilhouetteRule {
        self.silhouette.unwrap_or(SilhouetteRule::Paper)
    }
}

impl InkingArguments {
    fn settings(&self, common: &StyleArguments) -> Result<Inking> {
        Ok(Inking {
            is_inked: !common.no_borders,
            classes: match self.classes {
                None => Inking::default().classes,
                Some(ClassChoice::All) => ClassSet::EDGES,
                Some(ClassChoice::These(classes)) => classes,
            },
            crease_angle: common.crease.crease_angle()?,
            silhouette: common.crease.silhouette(),
            line_width_px: self.line_width,
            is_smooth: self.smooth,
            has_joints: self.joints,
            back_edges: self.back_edges,
            line_drawing: self.line_drawing,
            writes_depth: self.ink_depth,
            colors: self.class_colors.unwrap_or_default(),
            polygon_offset: self.polygon_offset,
            paint: self.paint,
            ramp: self.ramp.as_deref().map_or_else(|| Ok(Ramp::default()), Ramp::read)?,
            ramp_row: self.ramp_row,
            light: self.light,
            has_texture: self.texture,
            cull_back_faces: common.cull,
        })
    }
}

/// Classes as the user names them; what all are depends on the style.
#[derive(Clone, Copy)]
enum ClassChoice {
    All,
    These(ClassSet),
}

fn parse_classes(text: &str) -> std::result::Result<ClassChoice, String> {
    if text == "all" {
        return Ok(ClassChoice::All);
    }
    let classes: std::result::Result<Vec<Class>, String> = text.split(',').map(|name| name.trim().parse()).collect();
    classes.map(|classes| ClassChoice::These(ClassSet::of(&classes))).map_err(|error| format!("{error}, or all"))
}

fn parse_cull(text: &str) -> std::result::Result<bool, String> {
    match text {
        "none" => Ok(false),
        "back" => Ok(true),
        _ => Err("choose none or back".to_owned()),
    }
}

fn parse_border_width(text: &str) -> std::result::Result<BorderWidth, String> {
    match text {
        "paper" => Ok(BorderWidth(None)),
        _ => text.parse().map(|width| BorderWidth(Some(width))).map_err(|_| "give whole pixels, or paper".to_owned()),
    }
}

fn parse_ink_depth(text: &str) -> std::result::Result<bool, String> {
    match text {
        "write" => Ok(true),
        "test" => Ok(false),
        _ => Err("choose write or test".to_owned()),
    }
}
