//! Options that more than one command takes, in groups: camera, styles, models.

mod charcoal;
pub mod ignored;
mod scene;
mod style;

pub use charcoal::GrainArguments;
pub use scene::SceneArguments;
pub use style::{CreaseArguments, StyleArguments};

use glam::DVec3;
use std::path::PathBuf;
use tinta::mesh::{ModelFrame, Normals, UpAxis};
use tinta::{CameraSettings, LoadOptions, View};

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

    /// Height of what a parallel projection shows, model units; less is nearer [default: fitted]
    #[arg(long, value_name = "LENGTH", allow_hyphen_values = true)]
    height: Option<f64>,

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

    /// Follow material files, data and pictures that the model names outside its folder [default: off, said and not followed]
    #[arg(long)]
    allow_external: bool,

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
            height: self.height,
            near: self.near,
            far: self.far,
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
            allow_external: self.allow_external,
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

fn parse_switch(text: &str) -> std::result::Result<bool, String> {
    match text {
        "on" => Ok(true),
        "off" => Ok(false),
        _ => Err("choose on or off".to_owned()),
    }
}
