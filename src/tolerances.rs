//! Every number that decides "near enough", with its unit and its reason.

/// Default of `--weld`, a share of the model's bounding-box diagonal: one unit in the last place of an f32 file.
pub const WELD: f64 = 1e-7;

/// Largest `--weld`: a tenth of the model would no longer be a model.
pub const LARGEST_WELD: f64 = 0.1;

/// What rounding may move a projection by when vertices are swept for welding, as a share of its size: a few of f64's last
/// places.
pub const SWEEP_ROUNDING: f64 = 4.0 * f64::EPSILON;

/// Largest coordinate of a model, eye or target, file units: fourth powers of lengths stay finite f64 numbers.
pub const LARGEST_COORDINATE: f64 = 1e60;

/// Smallest and largest scene radius drawn, file units, for the same reason at both ends.
pub const SCENE_RADIUS: std::ops::RangeInclusive<f64> = 1e-60..=2e60;

/// Distance of eye and target, as a share of their coordinates, below which they count as the same point.
pub const SAME_POINT: f64 = 1e-12;

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

/// Largest distance of the eye from the scene's centre, scene radii: beyond it f32 depth in eye space has fewer than a
/// thousand steps for the whole scene.
pub const LARGEST_DISTANCE: f64 = 2e4;

/// Distance of the background square from the eye, scene radii: so far that light, view and normal are parallel on all of
/// it and the paper's highlight tone, 1, leaves its colour as given.
pub const BACKGROUND_DISTANCE: f32 = 1000.0;

/// Distance, in rows, from the edge of two texture rows at which a grain counts as lying on it: far more than a platform's
/// `pow` is off by, far less than a grain.
pub const ROW_EDGE: f64 = 1e-9;

/// What rounding may take from the cosine between two equal unit normals: without it a crease angle of 0 would make creases
/// of flat surfaces.
pub const PARALLEL_COSINE: f64 = 8.0 * f64::EPSILON;

/// How far a drawn line may pass by a point it leaves out, pixels: one step of the numbers in an SVG, which have three decimals.
pub const STRAIGHT_PX: f64 = 1e-3;
