//! Tolerances, each with its unit and its reason.
//!
//! ```
//! // Two coordinates of an f32 file that differ in their last place become one.
//! assert!(tinta_geometry::tolerances::WELD >= f64::from(f32::EPSILON) / 2.0);
//! ```

/// Default of `--weld`, a share of the model's bounding-box diagonal: one unit in the last place of an f32 file.
pub const WELD: f64 = 1e-7;

/// Largest distance between open edges that count as a crack, a share of the model's bounding-box diagonal: less than a tenth
/// of a pixel of a picture a thousand wide, and far more than welding closes.
pub(crate) const CRACK: f64 = 1e-4;

/// Distance from a section's plane within which a vertex lies on it, a share of the bounding-box diagonal: a hundred thousand
/// roundings of f64, and far less than a picture shows.
pub(crate) const ON_PLANE: f64 = 1e-11;

/// Largest `--weld`: a tenth of the model would no longer be a model.
pub(crate) const LARGEST_WELD: f64 = 0.1;

/// Largest rounding error of a projection in the welding sweep, as a share of its size: a few of f64's last places.
pub(crate) const SWEEP_ROUNDING: f64 = 4.0 * f64::EPSILON;

/// Largest coordinate of a model, eye or target, file units: fourth powers of lengths stay finite f64 numbers.
pub(crate) const LARGEST_COORDINATE: f64 = 1e60;

/// Smallest and largest scene radius drawn, file units: fourth powers of lengths stay finite f64 numbers and above 0.
pub(crate) const SCENE_RADIUS: std::ops::RangeInclusive<f64> = 1e-60..=2e60;

/// Distance between eye and target, as a share of their coordinates, below which they count as the same point.
pub(crate) const SAME_POINT: f64 = 1e-12;

/// Sine of the angle below which an up vector counts as being along the view: rounding then turns the picture.
pub(crate) const CAMERA_ALIGNMENT: f64 = 1e-6;

/// By how much rounding moves an angle whose cosine is compared, radians: the root of a cosine's rounding near 1, thirtyfold.
pub(crate) const ANGLE_OF_COSINE: f64 = 1e-6;

/// Share of the picture's half-width and half-height that the fitted scene fills; the rest is margin for ink.
pub const FRAME_FILL: f64 = 0.92;

/// Share of the picture's half-width and half-height that the visible part of a scene fills when it is centred: a margin of 6 %
/// on each side, as on a page.
pub(crate) const OUTLINE_FILL: f64 = 0.88;

/// Share of the scene's depth added before the nearest and behind the farthest point: the map's 8-bit depth (errata E8)
/// has 255 steps for all of it, so the margin is kept small.
pub(crate) const DEPTH_MARGIN: f64 = 0.01;

/// Smallest near distance as a share of the far distance, and smallest extent as a share of the scene's radius: with the
/// eye inside the scene the depth buffer's 24 bits then still separate thousandths of the radius.
pub(crate) const NEAREST_FRACTION: f64 = 1e-3;

/// Smallest near distance, as a share of the far distance, for an eye among faces that a farther plane would cut off: the farther
/// half of the scene then still has 512 of the depth buffer's steps.
pub(crate) const LEAST_NEAR_FRACTION: f64 = 1.0 / 32_768.0;

/// Largest distance of the eye from the scene's centre in a picture by GL, scene radii: beyond it f32 depth in eye space has fewer
/// than a thousand steps for the whole scene.
pub(crate) const LARGEST_DISTANCE: f64 = 2e4;

/// Width over height of a picture below which that, not the eye, is why the eye is so far away.
pub(crate) const NARROW: f64 = 1e-2;

/// Largest distance of the eye for exact lines, scene radii: f64 then still places a point to a ten-thousandth of a pixel of
/// 512.
pub(crate) const LARGEST_EXACT_DISTANCE: f64 = 1e8;

/// Least steps of a 24-bit depth buffer from the scene's nearest point to its farthest: with fewer, hidden surfaces show
/// through nearer ones.
pub(crate) const LEAST_DEPTH_STEPS: f64 = 256.0;

/// Distance of the background square from the eye, scene radii: so far that light, view and normal are parallel on all of
/// it and the article's highlight tone, 1, leaves its colour as given.
pub const BACKGROUND_DISTANCE: f32 = 1000.0;

/// Distance, in rows, from the edge between two texture rows at which a grain counts as lying on the edge: far more than the
/// error of a platform's `pow`, far less than a grain.
pub const ROW_EDGE: f64 = 1e-9;

/// Largest rounding error of the cosine between two equal unit normals: without it a crease angle of 0 would make creases of
/// flat surfaces.
pub(crate) const PARALLEL_COSINE: f64 = 8.0 * f64::EPSILON;

/// Largest error that a file's six digits cause in the cosine between neighbouring faces of a twelve-sided prism. That angle is
/// the crease angle of drawings.
pub const CREASE_DIGITS: f64 = 1e-5;

/// Largest error of a coordinate with six printed digits, as a share of the model's bounding-box diagonal: corners of one
/// polygon may lie that far from its plane, and from a straight side that they divide.
pub(crate) const PRINTED_DIGITS: f64 = 5e-6;

/// Distance between a point and a face below which they touch, as a share of the shorter of the face's longest side and the
/// line's length. A face that touches a line neither hides it nor passes through its neighbour. Models that stand on one
/// another touch only as closely as six printed digits allow.
pub const CONTACT: f64 = 1e-5;

/// Distance between a point and the image of a line, as a share of the picture's larger side, below which the point lies on the
/// line. A line exactly behind a nearer rim is then hidden on one side only, whatever the last digit.
pub(crate) const TIE: f64 = 2e-11;

/// Distance between the images of two lines, as a share of the picture's larger side, below which the lines overlap. Both are
/// cut where one ends or where they are equally near, and only the nearer stays visible. An unnecessary cut costs a ray; a
/// missing one causes an error.
pub const TOUCH: f64 = 1e-7;

/// Distance beside a line, as a share of the picture's larger side, at which background makes the line outline: a twentieth of
/// a pixel at 512 x 512. A file's six digits move lines far less, so a face that is edge-on within those digits hides no
/// outline.
pub const BESIDE: f64 = 1e-4;

/// Distance along an intersection of faces from its end, as a share of the picture's larger side. A face that hides the
/// intersection beyond this distance hides it up to the end. Twenty times [`TOUCH`], and at 512 x 512 a fifth of [`JOINED_PX`].
pub(crate) const TIP: f64 = 2e-6;

/// Largest angle that rounding turns a line's image by, radians, and much more: lines whose directions differ more do not overlap.
pub(crate) const TURNED: f64 = 1e-6;

/// Largest rounding error of a distance in the picture, as a share of the largest coordinate: some thousand of f64's last places.
pub(crate) const IMAGE_ROUNDING: f64 = 1e-12;

/// How far beyond a face's side a line may pass and still be cut there, as a share of the face: some rounding. An unnecessary cut costs
/// a ray.
pub(crate) const PIERCED: f64 = 1e-9;

/// Resolution of the ends of intersections, as a share of the contact distance of a line without length: spokes that end in one axis have
/// one line there, not one for each two.
pub(crate) const SAME_PLACE: f64 = 0.01;

/// Distance beyond the picture's border up to which faces and lines are kept, pixels: far more than rounding moves an image by.
pub(crate) const MARGIN_PX: f64 = 1.0;

/// Length, as a share of the picture's larger side, below which a line or a piece of one is a point: an edge seen end-on.
pub const SHORTEST_LINE: f64 = 1e-7;

/// Largest rounding error of a coordinate, as a share of the largest one in the scene: a few of f64's last places.
pub(crate) const COORDINATE_NOISE: f64 = 16.0 * f64::EPSILON;

/// Rounding of coordinates far from the origin, pixels, above which exact lines are not called exact: an end of a line may be off
/// by as much elsewhere.
pub(crate) const LOST_PX: f64 = 0.05;

/// Sine of the angle between a face and the view below which the face is edge-on. A surface may end at each side of such a
/// face, and a side shared with a face that is not edge-on is silhouette. An unnecessary one costs a ray.
pub const EDGE_ON: f64 = 1e-9;

/// Largest distance between a flat face's unit normal and the smooth surface's normals at its corners: the error of six printed
/// digits, and far below any visible angle.
pub const FLAT: f64 = 1e-6;

/// Least cosine between triangles of one flat face: half a degree, as exported planes keep.
pub(crate) const FLAT_FACE: f64 = 0.99996;

/// Largest share of its surface that a figure has in flat faces of several triangles. Of measured figures and scans
/// all but a rabbit of coarse spheres have up to 0.65, parts and turned shapes 0.84 and more.
pub(crate) const MOST_OF_FIGURES: f64 = 0.7;

/// A face's side crosses a line when the sine of its angle to the line's perpendicular is below this: a point moved aside from
/// the line then stays on that side, which hides both faces' points at it.
pub(crate) const ACROSS: f64 = 1e-9;

/// Largest distance between a drawn line and a point it leaves out, pixels: one step of an SVG's numbers, which have three
/// decimals.
pub(crate) const STRAIGHT_PX: f64 = 1e-3;

/// Distance of a point beyond the picture or between the planes, as a share of its distance from the eye, above which f32
/// matrices agree with f64: some hundred of f32's last places.
pub(crate) const CLIP_ROUNDING: f64 = 1e-5;

/// Largest distance between a vertex as drawn and its coordinates, pixels: f32 in the largest pictures is off by a hundredth,
/// and GL's own sub-pixels may be sixteenths.
pub(crate) const WINDOW_ROUNDING_PX: f64 = 0.125;

/// Light that no surface reaches: diffuse and specular values are cosines of unit vectors, which rounding leaves below it.
pub const UNREACHED_LIGHT: f32 = 1.001;

/// Least distance of a colour from the middle between two 8-bit steps, in steps, for every driver to round it alike.
pub const EIGHT_BIT_TIE: f64 = 0.02;

/// Largest distance that GL moves a vertex sideways before it fills a face, in steps of its sub-pixel grid: half a step by
/// rounding, as much again for safety and for f32.
pub(crate) const SUBPIXEL_STEPS: f64 = 1.0;

/// Length of a sum of unit normals up to which its direction is mere rounding: the error of a million of them is smaller.
pub(crate) const CANCELLED_NORMALS: f64 = 1e-9;

/// Cosine of the angle between a face and a file's normal at its corner above which the normal is averaged over sharp edges: 45
/// degrees. At the corners of a cube such normals stand 55 off, on a ball of 20 triangles 37.
pub(crate) const AVERAGED_NORMAL: f64 = std::f64::consts::FRAC_1_SQRT_2;

/// Share of the corners, or of the surface, with averaged normals above which a file's normals are not to be believed. In strangers' models with
/// melted edges it is 0.11 to 0.67.
pub(crate) const AVERAGED_SHARE: f64 = 0.1;

/// Largest distance between the end of a model and a place that touches the ground there, as a share of the model's length
/// along that axis.
pub(crate) const BASE_DEPTH: f64 = 0.02;

/// Least height of a model above such an end, as a share of its largest extent: slabs and reliefs may well face z, and
/// their shadows are slivers.
pub(crate) const BASE_HEIGHT: f64 = 0.5;

/// Least share of the bounding box's side that touches the ground at a base. Among the tested models that stand on one end, the
/// smallest shares are 0.13, a doll's shoes, and 0.19, a bust's foot; ends on which they would fall have up to 0.09.
pub(crate) const BASE_SHARE: f64 = 0.1;

/// Least distance of a model's middle from the rim of its base, for the model to stand firmly, as a share of the side's
/// geometric mean. The doll's is 0.03.
pub(crate) const BASE_MARGIN: f64 = 0.02;

/// Distance between an end of a line and another line below which they touch in a drawing, pixels: some steps of an SVG's
/// numbers.
pub(crate) const JOINED_PX: f64 = 5e-3;

/// Area of a triangle, as a share of its longest side's square, below which its corners carry no information about the surface:
/// a file's six digits can give a triangle of no area this much.
pub(crate) const NEEDLE: f64 = 1e-6;

/// The unit length of form lines' thresholds, as a share of a radius of curvature. One tenth of all principal curvatures is
/// flatter than that radius, as in the viewer by the authors of suggestive contours.
pub(crate) const FEATURE_SHARE: f64 = 0.01;

/// Largest unit length of form lines' thresholds, in the mesh's radii, for models that are mostly flat.
pub(crate) const LARGEST_FEATURE: f64 = 0.05;

/// Distance from an end of a face's side, as a share of the side, within which a form line across the side runs through that
/// end: far less than the line may be off, far more than the shortest line.
pub(crate) const THROUGH_VERTEX: f64 = 1e-4;

/// Least rate at which a curvature falls beside a crest, as a share of the curvature's third power. On pipes and balls the
/// curvature is constant except for the mesh's error.
pub(crate) const CREST_SHARPNESS: f64 = 0.05;
