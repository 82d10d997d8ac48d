//! Every number that decides "near enough", with its unit and its reason.
//!
//! ```
//! // The cosine of the angle between equal normals, rounded, still counts as parallel.
//! assert!(1.0 - tinta_geometry::tolerances::PARALLEL_COSINE < 1.0);
//! ```

/// Default of `--weld`, a share of the model's bounding-box diagonal: one unit in the last place of an f32 file.
pub const WELD: f64 = 1e-7;

/// How near each other open edges are taken for a crack, a share of the model's bounding-box diagonal: less than a tenth of a pixel of a
/// picture a thousand wide, and far more than welding closes.
pub const CRACK: f64 = 1e-4;

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

/// The same of what is seen of a scene where that is centred: a margin of 6 % on each side, as on a page.
pub const OUTLINE_FILL: f64 = 0.88;

/// Share of the scene's depth added before the nearest and behind the farthest point: the map's 8-bit depth (errata E8)
/// has 255 steps for all of it, so the margin is kept small.
pub const DEPTH_MARGIN: f64 = 0.01;

/// Smallest near distance as a share of the far distance, and smallest extent as a share of the scene's radius: with the
/// eye inside the scene the depth buffer's 24 bits then still separate thousandths of the radius.
pub const NEAREST_FRACTION: f64 = 1e-3;

/// Largest distance of the eye from the scene's centre in a picture by GL, scene radii: beyond it f32 depth in eye space has fewer
/// than a thousand steps for the whole scene.
pub const LARGEST_DISTANCE: f64 = 2e4;

/// The same for exact lines: f64 then still places a point to a ten-thousandth of a pixel of 512.
pub const LARGEST_EXACT_DISTANCE: f64 = 1e8;

/// Least steps of a 24-bit depth buffer from the scene's nearest point to its farthest: with fewer, what is behind shows through
/// what is in front of it.
pub const LEAST_DEPTH_STEPS: f64 = 256.0;

/// Distance of the background square from the eye, scene radii: so far that light, view and normal are parallel on all of
/// it and the article's highlight tone, 1, leaves its colour as given.
pub const BACKGROUND_DISTANCE: f32 = 1000.0;

/// Distance, in rows, from the edge of two texture rows at which a grain counts as lying on it: far more than a platform's
/// `pow` is off by, far less than a grain.
pub const ROW_EDGE: f64 = 1e-9;

/// What rounding may take from the cosine between two equal unit normals: without it a crease angle of 0 would make creases
/// of flat surfaces.
pub const PARALLEL_COSINE: f64 = 8.0 * f64::EPSILON;

/// What the six digits of a file may take from the cosine between the faces of a prism with twelve sides, which is that of the
/// crease angle of drawings.
pub const CREASE_DIGITS: f64 = 1e-5;

/// What six printed digits may move a coordinate by, as a share of the model's bounding-box diagonal: corners of one polygon may lie
/// that far from its plane.
pub const PRINTED_DIGITS: f64 = 5e-6;

/// Distance of a point from a face, as a share of the shorter of the face's longest side and the line's length, below which
/// they touch: then the face does not hide the line, and does not pass through its neighbour. Models that stand on one
/// another meet as well as six printed digits let them.
pub const CONTACT: f64 = 1e-5;

/// Distance of a point from the image of a line, as a share of the picture's larger side, below which it lies on it: what is
/// exactly behind the rim of something nearer is hidden on that thing's side only, whatever the last digit says.
pub const TIE: f64 = 2e-11;

/// Distance between the images of two lines, as a share of the picture's larger side, below which they lie on one another: both
/// are cut where one ends or they are equally near, and only the nearest is seen. A cut too many costs a ray, one too few an
/// error.
pub const TOUCH: f64 = 1e-7;

/// Distance beside a line, as a share of the picture's larger side, at which background makes it outline: a twentieth of a pixel at
/// 512 x 512. Far more than a file's six digits move a line by, so that a face which is edge-on but for these hides no outline.
pub const BESIDE: f64 = 1e-4;

/// Distance along a line from a corner in which it ends, as a share of the picture's larger side, up to which a face with that
/// corner hides it that does from there on: by the rule for contact alone it would be seen again beside the corner.
pub const NEAR_CORNER: f64 = 4e-5;

/// Distance along an intersection of faces from its end, as a share of the picture's larger side, up to which a face hides it that does
/// from there on: twenty times [`TOUCH`], and at 512 x 512 a fifth of [`JOINED_PX`].
pub const TIP: f64 = 2e-6;

/// Length, as a share of the picture's larger side, below which a line or a piece of one is a point: an edge seen end-on.
pub const SHORTEST_LINE: f64 = 1e-7;

/// What rounding may take from a coordinate as a share of the largest one in the scene: a few of f64's last places.
pub const COORDINATE_NOISE: f64 = 16.0 * f64::EPSILON;

/// Sine of the angle between a face and the view below which the face is seen edge-on: all its sides are then places where
/// a surface may end, and those it shares with a face that is not edge-on are silhouette. One too many costs a ray.
pub const EDGE_ON: f64 = 1e-9;

/// Distance between a face's unit normal and those of the smooth surface at its corners up to which the face is flat: what six
/// printed digits leave of it, and far below any angle that is drawn.
pub const FLAT: f64 = 1e-6;

/// Sine of the angle to straight across a line below which a face's side runs across it: a point moved aside from the line then
/// stays on that side, which hides what is on either face at it.
pub const ACROSS: f64 = 1e-9;

/// How far a drawn line may pass by a point it leaves out, pixels: one step of the numbers in an SVG, which have three decimals.
pub const STRAIGHT_PX: f64 = 1e-3;

/// How far beyond the picture or between the planes a point must be, as a share of its distance, before f32 matrices agree
/// that it is: some hundred of f32's last places.
pub const CLIP_ROUNDING: f64 = 1e-5;

/// How far a vertex can be drawn from where its coordinates say, pixels: f32 in the largest pictures is off by a hundredth, and
/// GL's own sub-pixels may be sixteenths.
pub const WINDOW_ROUNDING_PX: f64 = 0.125;

/// Light that no surface reaches: diffuse and specular values are cosines of unit vectors, which rounding leaves below it.
pub const UNREACHED_LIGHT: f32 = 1.001;

/// How far from the middle between two steps of 8 bits a colour must be, steps, before every driver rounds it to the same one.
pub const EIGHT_BIT_TIE: f64 = 0.02;

/// How far GL may move a vertex sideways before it fills a face, in steps of its sub-pixel grid: half a step by rounding, as
/// much again for safety and for f32.
pub const SUBPIXEL_STEPS: f64 = 1.0;

/// Length of a sum of unit normals up to which its direction is nothing but rounding: a million of them lose less.
pub const CANCELLED_NORMALS: f64 = 1e-9;

/// How far from the end of its model a place may lie that touches the ground there, as a share of the model's length along that axis.
pub const BASE_DEPTH: f64 = 0.02;

/// Least height of a model above such an end, as a share of its largest extent: slabs and reliefs may well face z.
pub const BASE_HEIGHT: f64 = 0.5;

/// Share of the bounding box's side from which on what touches the ground is a base. Of the models tried that stand on one end, the least
/// are 0.13, a doll's shoes, and 0.19, a bust's foot; ends on which they would fall have up to 0.09.
pub const BASE_SHARE: f64 = 0.1;

/// How far from the rim of its base a model's middle must be to stand firmly, as a share of the side's geometric mean. The doll's is 0.03.
pub const BASE_MARGIN: f64 = 0.02;

/// How far corners of two faces may lie apart, as a share of the longest side, where both are the two sides of one thin part:
/// some steps of the bytes that Quake 2 models have for coordinates, on a wing of a quarter of the model.
pub const DOUBLED: f64 = 1.0 / 12.0;

/// Least area of such a face, as a share of its model's: in a picture of 512 pixels a dozen or so.
pub const DOUBLED_AREA: f64 = 5e-4;

/// Distance between an end of a line and another line below which they touch in a drawing, pixels: some steps of the numbers in
/// an SVG, so that what looks joined is.
pub const JOINED_PX: f64 = 5e-3;

/// Area of a triangle, as a share of its longest side's square, below which its corners' differences say nothing of a surface:
/// what a file's six digits leave of a triangle that has none.
pub const NEEDLE: f64 = 1e-6;

/// The length in which the thresholds of form lines are measured, as a share of the radius of curvature that a tenth of all
/// principal curvatures is flatter than, as the authors of suggestive contours have it in their viewer.
pub const FEATURE_SHARE: f64 = 0.01;

/// Most of that length, in the mesh's radii: where much of a model is flat.
pub const LARGEST_FEATURE: f64 = 0.05;

/// Distance from an end of a face's side, as a share of the side, within which a form line that crosses the side runs through that
/// end: far less than the line may be off, far more than the shortest line.
pub const THROUGH_VERTEX: f64 = 1e-4;

/// How fast a curvature must fall beside its crest, as a share of its own third power, for the crest to be one: on pipes and balls
/// it is constant but for the mesh's error.
pub const CREST_SHARPNESS: f64 = 0.05;
