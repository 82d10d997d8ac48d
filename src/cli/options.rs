//! Options that more than one command takes, in groups: camera, cartoon settings, models.

use glam::DVec3;
use std::path::PathBuf;
use tinta::mesh::{ModelFrame, Normals, UpAxis};
use tinta::styles::{Border, Cartoon, Filter, ToneLookup, Tones};
use tinta::{CameraSettings, LoadOptions, Show, View};

#[derive(clap::Args)]
#[command(next_help_heading = "Camera")]
pub struct CameraArguments {
    /// View from iso, front, back, left, right, top, bottom or AZIMUTH,ELEVATION in degrees [default: 30,15]
    #[arg(long, value_name = "VIEW", default_value = "30,15", hide_default_value = true, allow_hyphen_values = true)]
    view: View,

    /// Vertical field of view in degrees [default: 30]
    #[arg(long, value_name = "DEGREES", default_value = "30", hide_default_value = true, allow_hyphen_values = true)]
    fov: f64,

    /// Parallel projection instead of perspective [default: off]
    #[arg(long)]
    parallel: bool,

    /// Position of the eye, model units [default: where --view shows the whole scene]
    #[arg(long, value_name = "X,Y,Z", value_parser = parse_vector, allow_hyphen_values = true, conflicts_with = "view")]
    eye: Option<DVec3>,

    /// Point in the middle of the picture [default: the scene's centre]
    #[arg(long, value_name = "X,Y,Z", value_parser = parse_vector, allow_hyphen_values = true)]
    target: Option<DVec3>,

    /// Direction that is up in the picture [default: 0,1,0]
    #[arg(long, value_name = "X,Y,Z", value_parser = parse_vector, allow_hyphen_values = true)]
    up: Option<DVec3>,

    /// Distance of the near plane from the eye, model units [default: fitted]
    #[arg(long, value_name = "LENGTH", allow_hyphen_values = true)]
    near: Option<f64>,

    /// Distance of the far plane from the eye, model units [default: fitted]
    #[arg(long, value_name = "LENGTH", allow_hyphen_values = true)]
    far: Option<f64>,
}

#[derive(clap::Args)]
#[command(next_help_heading = "Cartoon styles (the defaults are the paper's; phong uses none of these)")]
pub struct CartoonArguments {
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

    /// No borders, tones alone [default: off]
    #[arg(long)]
    no_borders: bool,

    /// Edge filter: laplacian4, laplacian8, mitchell, sobel, roberts [default: laplacian4]
    #[arg(long, value_name = "FILTER", default_value = "laplacian4", hide_default_value = true)]
    filter: Filter,

    /// What the edge filter's response is multiplied by; more darkens faint edges [default: 0.2]
    #[arg(long, value_name = "FACTOR", default_value = "0.2", hide_default_value = true, allow_hyphen_values = true)]
    detection_factor: f32,

    /// Draw a square behind the scene, on or off; off loses outer borders [default: on]
    #[arg(long, value_name = "ON|OFF", action = clap::ArgAction::Set, value_parser = parse_switch, default_value = "on", hide_default_value = true)]
    background_quad: bool,

    /// Which picture: final, normals, depth, map, borders, tones [default: final]
    #[arg(long, value_name = "PICTURE", default_value = "final", hide_default_value = true)]
    pub show: Show,
}

#[derive(clap::Args)]
#[command(next_help_heading = "Models")]
pub struct ModelArguments {
    /// Axis that points up in the file: auto (z in MD2 and 3DS, else y), x, y, z, -x, -y, -z [default: auto]
    #[arg(long, value_name = "AXIS", default_value = "auto", hide_default_value = true, allow_hyphen_values = true)]
    up_axis: UpAxis,

    /// Join vertices nearer than this share of the model's size [default: 1e-7]
    #[arg(long, value_name = "SHARE", default_value = "1e-7", hide_default_value = true, allow_hyphen_values = true)]
    weld: f64,

    /// Normals: file (computed where it has none), smooth, flat [default: file]
    #[arg(long, value_name = "WHERE", default_value = "file", hide_default_value = true)]
    normals: Normals,

    /// Largest angle between faces that computed normals round off, degrees [default: 60]
    #[arg(long, value_name = "DEGREES", default_value = "60", hide_default_value = true, allow_hyphen_values = true)]
    smooth_angle: f64,

    /// Refuse models with defects [default: off, defects are counted and left out]
    #[arg(long)]
    strict: bool,

    /// Picture for all surfaces (PCX, PNG, TGA, BMP, JPEG, PPM) [default: what the model names, found beside it]
    #[arg(long, value_name = "FILE")]
    skin: Option<PathBuf>,

    /// Frame of an animated model (MD2), from 0; 1.5 lies between two [default: 0]
    #[arg(long, value_name = "N|NAME", default_value = "0", hide_default_value = true, allow_hyphen_values = true)]
    model_frame: ModelFrame,
}

impl CameraArguments {
    pub fn settings(&self) -> CameraSettings {
        CameraSettings {
            view: self.view,
            eye: self.eye,
            target: self.target,
            up: self.up,
            fov_y_degrees: self.fov,
            parallel: self.parallel,
            near: self.near,
            far: self.far,
        }
    }
}

impl CartoonArguments {
    pub fn settings(&self, cull_back_faces: bool) -> Cartoon {
        let [diffuse_threshold, specular_threshold] = self.tone_thresholds;
        let border = Border { filter: self.filter, detection_factor: self.detection_factor };
        Cartoon {
            tones: Tones {
                count: self.tones,
                diffuse_threshold,
                specular_threshold,
                levels: self.tone_levels,
                lookup: self.tone_lookup,
            },
            border: (!self.no_borders).then_some(border),
            background_square: self.background_quad,
            cull_back_faces,
        }
    }
}

impl ModelArguments {
    pub fn options(&self) -> LoadOptions {
        LoadOptions {
            weld: self.weld,
            normals: self.normals,
            smooth_angle_degrees: self.smooth_angle,
            up_axis: self.up_axis,
            strict: self.strict,
            model_frame: self.model_frame.clone(),
            skin: self.skin.clone(),
        }
    }
}

fn parse_vector(text: &str) -> std::result::Result<DVec3, String> {
    parse_numbers::<f64, 3>(text).map(DVec3::from_array)
}

fn parse_pair(text: &str) -> std::result::Result<[f32; 2], String> {
    parse_numbers(text)
}

fn parse_triple(text: &str) -> std::result::Result<[f32; 3], String> {
    parse_numbers(text)
}

fn parse_numbers<T: std::str::FromStr, const N: usize>(text: &str) -> std::result::Result<[T; N], String> {
    let numbers: Vec<T> = text.split(',').map_while(|number| number.trim().parse().ok()).collect();
    let whole = numbers.len() == text.split(',').count();
    numbers
        .try_into()
        .ok()
        .filter(|_| whole)
        .ok_or_else(|| format!("give {N} numbers with commas between them and no blanks"))
}

pub fn parse_cull(text: &str) -> std::result::Result<bool, String> {
    match text {
        "none" => Ok(false),
        "back" => Ok(true),
        _ => Err("choose none or back".to_owned()),
    }
}

fn parse_switch(text: &str) -> std::result::Result<bool, String> {
    match text {
        "on" => Ok(true),
        "off" => Ok(false),
        _ => Err("choose on or off".to_owned()),
    }
}
