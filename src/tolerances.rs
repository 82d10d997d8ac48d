//! Every number that decides "near enough", with its unit and its reason.

/// Sine of the angle below which an up vector counts as being along the view: rounding then turns the picture.
pub const CAMERA_ALIGNMENT: f64 = 1e-6;

/// Share of the picture's half-width and half-height that the fitted scene fills; the rest is margin for ink.
pub const FRAME_FILL: f64 = 0.92;

/// Share of the scene's depth added before the nearest and behind the farthest point: the map's 8-bit depth (errata E8)
/// has 255 steps for all of it, so the margin is kept small.
pub const DEPTH_MARGIN: f64 = 0.01;

/// Smallest near distance as a share of the far distance, and smallest extent as a share of the scene's radius: with the
/// eye inside the scene the depth buffer's 24 bits then still separate thousandths of the radius.
pub const NEAREST_FRACTION: f64 = 1e-3;

/// Smallest and largest scene radius drawn, file units: squares of lengths stay normal f64 numbers with room to spare.
pub const SCENE_RADIUS: std::ops::RangeInclusive<f64> = 1e-120..=1e120;

/// Distance of the background square from the eye, scene radii: so far that light, view and normal are parallel on all of
/// it and the paper's highlight tone, 1, leaves its colour as given.
pub const BACKGROUND_DISTANCE: f32 = 1000.0;

/// Clip-space depth of the background square: behind everything else, but nearer than the cleared depth of 1 in a 24-bit
/// buffer, where one step is 1.2e-7.
pub const BACKGROUND_DEPTH: f32 = 1.0 - 1.0 / 65536.0;
