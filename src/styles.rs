//! The styles: settings with the papers' values as defaults, and the plan each makes of a scene. No GL here.
//!
//! | style | source |
//! |---|---|
//! | `phong` | the realistic rendering the first paper compares with |
//! | `three-pass` | Evangelista et al. 2005, appendix 1 |
//! | `two-pass` | Evangelista et al. 2005, section 4.2 and appendix 2 |

mod border;
mod cartoon;
mod phong;
mod tones;

pub use border::{Border, Filter};
pub use cartoon::Cartoon;
pub use phong::Phong;
pub use tones::{ToneLookup, Tones};

use crate::error::Result;
use crate::names::find;
use crate::plan::Plan;
use crate::scene::Scene;
use serde::Serialize;
use std::str::FromStr;

/// A style with its settings.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(tag = "name", rename_all = "kebab-case")]
pub enum Style {
    /// Smooth shading per pixel.
    Phong(Phong),
    /// Map, tones, border blended on top.
    ThreePass(Cartoon),
    /// Map, then tones and border in one.
    TwoPass(Cartoon),
}

/// Which of a style's pictures is wanted.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Show {
    /// The finished picture.
    #[default]
    Final,
    /// The normal map: red, green, blue of the map (figure 9, left).
    Normals,
    /// The depth map: alpha of the map as grey, near is dark (figure 9, right).
    Depth,
    /// The map itself, four channels.
    Map,
    /// The borders alone (figure 12).
    Borders,
    /// The tones alone (figure 5).
    Tones,
}

impl Style {
    /// The style of this name with the paper's settings.
    pub fn named(name: StyleName) -> Self {
        match name {
            StyleName::Phong => Self::Phong(Phong::default()),
            StyleName::ThreePass => Self::ThreePass(Cartoon::default()),
            StyleName::TwoPass => Self::TwoPass(Cartoon::default()),
        }
    }

    /// What GL has to do for this scene.
    ///
    /// # Errors
    ///
    /// [`crate::Error::Setting`] when a setting is nonsense, by itself or with this scene or `show`.
    pub fn plan(&self, scene: &Scene, show: Show) -> Result<Plan> {
        match self {
            Self::Phong(phong) => phong.plan(scene, show),
            Self::ThreePass(cartoon) => cartoon.three_pass(scene, show),
            Self::TwoPass(cartoon) => cartoon.two_pass(scene, show),
        }
    }
}

/// The styles' names.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum StyleName {
    /// `phong`
    Phong,
    /// `three-pass`
    ThreePass,
    /// `two-pass`
    TwoPass,
}

impl StyleName {
    /// All of them, as the user writes them.
    pub const ALL: [(&'static str, Self); 3] =
        [("phong", Self::Phong), ("three-pass", Self::ThreePass), ("two-pass", Self::TwoPass)];
}

impl FromStr for StyleName {
    type Err = String;

    fn from_str(text: &str) -> std::result::Result<Self, String> {
        find(&Self::ALL, text)
    }
}

impl Show {
    /// All of them, as the user writes them.
    pub const ALL: [(&'static str, Self); 6] = [
        ("final", Self::Final),
        ("normals", Self::Normals),
        ("depth", Self::Depth),
        ("map", Self::Map),
        ("borders", Self::Borders),
        ("tones", Self::Tones),
    ];
}

impl FromStr for Show {
    type Err = String;

    fn from_str(text: &str) -> std::result::Result<Self, String> {
        find(&Self::ALL, text)
    }
}
