//! Charcoal's drawings of a ball, and its variants.

use super::shapes::{icosphere, shaded};
use tinta::styles::{CetCoordinate, Charcoal, CharcoalRecipe, Improvements};
use tinta::{CameraSettings, Picture, Renderer, Scene, SceneSettings, Show, Size, Style};

/// The drawing or one of its stages.
pub fn draw(renderer: &mut Renderer, scene: &Scene, charcoal: &Charcoal, show: Show) -> Picture {
    renderer.draw(scene, &Style::Charcoal(charcoal.clone()).plan(scene, show).unwrap()).unwrap()
}

/// A ball in parallel projection, where the listing's coordinate of the paper and the intended one are the same.
pub fn ball() -> Scene {
    ball_from(CameraSettings { parallel: true, ..CameraSettings::default() })
}

/// The same ball by another camera.
pub fn ball_from(camera: CameraSettings) -> Scene {
    let settings = SceneSettings { camera, size: Size { width: 120, height: 120 }, ..SceneSettings::default() };
    Scene::new([shaded(&icosphere(3))], &settings).unwrap()
}

/// Textures of the picture's size, as 512 x 512 is by default: noise and paper are then read in the middle of their texels,
/// where the filter's precision, which GL leaves open (Mesa's software renderer has 8 bits), does not count.
pub fn variants() -> Vec<(&'static str, Charcoal)> {
    let base = || Charcoal { texture_size: Size { width: 120, height: 120 }, ..Charcoal::default() };
    let bright = [Some([-0.55, 0.75, 0.55]), Some([0.9, -0.15, 0.35])];
    vec![
        ("plain", base()),
        ("sheet-3", Charcoal { seed: 3, ..base() }),
        ("darker", Charcoal { texture_size: base().texture_size, ..Charcoal::recipe(CharcoalRecipe::Darker) }),
        ("closure", Charcoal { texture_size: base().texture_size, ..Charcoal::recipe(CharcoalRecipe::Closure) }),
        ("figure-8", Charcoal { cet_coordinate: CetCoordinate::Saturated, saturation: 1.2, ..base() }),
        ("one-light", Charcoal { lights: [None, Some([-0.7, -0.56, 0.45])], ..base() }),
        ("bright", Charcoal { lights: bright, ..base() }),
        ("bright-improved", Charcoal { lights: bright, saturation: 1.5, improve: Improvements::ALL, ..base() }),
    ]
}
