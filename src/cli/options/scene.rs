//! What a scene is besides its models: size, background, colours, copies.

use tinta::{Background, CameraSettings, Color, SceneSettings, Size};

#[derive(clap::Args)]
#[command(next_help_heading = "Scene")]
pub struct SceneArguments {
    /// Size in pixels, or one number for a square [default: 512x512]
    #[arg(long, value_name = "WxH", default_value = "512x512", hide_default_value = true, allow_hyphen_values = true)]
    pub size: Size,

    /// Colour behind the scene: a CSS name, #rrggbb or rgb(r,g,b) [default: white]
    #[arg(long, value_name = "COLOUR", default_value = "white", hide_default_value = true)]
    background: Color,

    /// No background: alpha 0 where nothing is drawn [default: off]
    #[arg(long, conflicts_with = "background")]
    pub transparent: bool,

    /// One colour for all surfaces [default: the model's own, #edbd85 where it has none]
    #[arg(long, value_name = "COLOUR")]
    color: Option<Color>,

    /// Repeat the models on a square grid, up to 10000 times [default: 1]
    #[arg(long, value_name = "N", default_value = "1", hide_default_value = true, allow_hyphen_values = true)]
    pub copies: u32,
}

impl SceneArguments {
    pub fn settings(&self, camera: CameraSettings) -> SceneSettings {
        SceneSettings {
            copies: self.copies,
            camera,
            size: self.size,
            background: if self.transparent { Background::Transparent } else { Background::Color(self.background) },
            color: self.color,
        }
    }
}
