//! Names of earlier versions, and what took their place.

use crate::choice::Choice;
use crate::error::ParseError;
use crate::styles::StyleName;

/// What took the place of the style `suggestive` and of its options.
const CONTOURS: &str = "--style lines --classes silhouette,boundary,crease,suggestive draws suggestive contours";

/// What took the place of the options of `phong`.
const PHONG: &str = "glsl/phong/phong.frag has it; --glsl takes yours";

/// What took the place of the thresholds of form lines.
const STRENGTH: &str = "--form-lines has the strength of form lines, in multiples of the usual";

/// Options of earlier versions, and what took their place.
pub(super) const GONE: [(&str, &str); 18] = [
    ("ambient", PHONG),
    ("apparent-ridge-threshold", "apparent ridges are gone; --classes ridge,valley draws ridges in any view"),
    ("clip", "--near and --far cut the view"),
    ("contrast-exponent", "--contrast has the exponent"),
    ("crease-by", "--exact-lines draws the lines that print drew by it, with --lasting-creases those of scans"),
    ("gap-per-slope", "glsl/improved/plane-ink.frag has it; --glsl takes yours"),
    ("provenance", "-o drawing.json has each line's class, object, edge and angle"),
    ("remove-specks", "--quality best removes specks, and exact lines have none"),
    ("ridge-threshold", STRENGTH),
    ("shading", PHONG),
    ("shininess", PHONG),
    ("specular", PHONG),
    ("suggestive-threshold", STRENGTH),
    ("surface-crease-angle", "form lines end at creases above 66.4 degrees"),
    ("transparent", "--background transparent leaves the background out"),
    ("valley-depth", CONTOURS),
    ("valley-radius", CONTOURS),
    ("valley-share", CONTOURS),
];

/// The style of this name, as the option names it.
///
/// # Errors
///
/// What took the place of a style of earlier versions; otherwise those of [`Choice::of_name`].
pub(super) fn style_of(name: &str) -> std::result::Result<StyleName, ParseError> {
    match name {
        "suggestive" => Err(format!("this style is gone; {CONTOURS}").into()),
        name => StyleName::of_name(name),
    }
}
