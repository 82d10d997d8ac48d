//! A light so far away that it has a direction alone.

use crate::error::{Error, Result};
use crate::lines::SeenNormals;
use crate::scene::Scene;
use crate::settings::{Kind, Problem, Value};
use glam::DVec3;

/// The direction of a far light.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum FarLight {
    /// Chosen for the view, from above, so that a fair share is dark and hangs together.
    Auto,
    /// Towards it, eye space, of any length.
    Towards([f32; 3]),
}

impl FarLight {
    /// Its direction for a scene, of any length.
    pub(crate) fn towards(self, scene: &Scene, thresholds: [f32; 2]) -> [f32; 3] {
        self.known().unwrap_or_else(|| SeenNormals::of(scene).best_light(thresholds.map(f64::from)))
    }

    /// Its direction, unless it is chosen for a view.
    pub(crate) fn known(self) -> Option<[f32; 3]> {
        if let Self::Towards(direction) = self { Some(direction) } else { None }
    }

    pub(super) fn check(self) -> Result<()> {
        match self {
            Self::Towards(light) if !light.iter().all(|x| x.is_finite()) || light == [0.0; 3] => {
                Err(Error::setting("tone-light", "a direction is three finite numbers, not all 0"))
            }
            _ => Ok(()),
        }
    }
}

/// The unit vector in a direction, which is finite and not 0; in f64 the length of any three f32 numbers is finite.
pub(super) fn unit(direction: [f32; 3]) -> DVec3 {
    DVec3::from_array(direction.map(f64::from)).normalize_or_zero()
}

impl Value for FarLight {
    fn kind() -> Kind {
        Kind::Text { offered: &["auto"], example: "-0.4,1,0.6" }
    }

    fn text(&self) -> String {
        match self {
            Self::Auto => "auto".to_owned(),
            Self::Towards(direction) => direction.text(),
        }
    }

    fn parse(text: &str) -> std::result::Result<Self, Problem> {
        if text == "auto" { Ok(Self::Auto) } else { <[f32; 3]>::parse(text).map(Self::Towards) }
    }
}
