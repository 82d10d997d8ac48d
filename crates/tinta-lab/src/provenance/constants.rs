//! Fixed values, and their origins.

use tinta::settings::Provenance;
use tinta::styles::StyleName::{
    self, BackFaces, Charcoal, Dietrich, Ink, Inking, Mrt, Phong, Sand, ThreePass, TwoPass,
};

/// A value that no setting changes.
#[derive(Debug, Clone, Copy)]
pub struct Constant {
    /// The styles that draw with it.
    pub styles: &'static [StyleName],
    /// Its description.
    pub name: &'static str,
    /// Its value.
    pub value: &'static str,
    /// Its origin.
    pub provenance: Provenance,
    /// Its effect, and the change if it were otherwise.
    pub otherwise: &'static str,
}

const CARTOONS: &[StyleName] = &[ThreePass, TwoPass, Mrt];
const IMAGE_SPACE: &[StyleName] = &[ThreePass, TwoPass, Mrt, Ink];
const VALENTE: &[StyleName] = &[Charcoal, Sand];
const LIT_AT_A_POINT: &[StyleName] = &[Phong, ThreePass, TwoPass, Mrt, Ink];

/// A row of the list.
const fn constant(
    styles: &'static [StyleName],
    name: &'static str,
    value: &'static str,
    provenance: Provenance,
    otherwise: &'static str,
) -> Constant {
    Constant { styles, name, value, provenance, otherwise }
}

/// All of them, by text.
pub const CONSTANTS: &[Constant] = &[
    constant(
        LIT_AT_A_POINT,
        "place of the light",
        "(1, 1, 1) in eye space",
        Provenance::printed("E, appendices 1 and 2: const vec3 lightPos"),
        "Tones lie elsewhere on the model; it moves with the camera",
    ),
    constant(
        LIT_AT_A_POINT,
        "unit of the light's place",
        "the scene's radius: half the diagonal of its bounding box",
        Provenance::ours("the paper gives no unit, and a model must look the same in millimetres and in miles (E11)"),
        "A light nearer to the model bends the borders of its tones",
    ),
    constant(
        CARTOONS,
        "bits of depth in the map",
        "8",
        Provenance::printed("E, section 4.1: depth in the alpha of an RGBA texture, at most 8 bits"),
        "More bits find smaller steps in depth (--map-encoding float)",
    ),
    constant(
        CARTOONS,
        "bits of the normal in the map",
        "8 for each of three parts",
        Provenance::deduced(
            "E, section 4.1: the normal is in the red, green and blue of the texture whose alpha has 8 bits",
        ),
        "More bits find smaller steps between normals (--map-encoding float)",
    ),
    constant(
        CARTOONS,
        "normal and depth of the background square in the map",
        "(0, 0, 1) and 1, the far plane",
        Provenance::ours("the paper draws a square of the background's colour and says no more (E10)"),
        "The outline's ink hangs on it: with the gear from the front it is 30 % less than without the square",
    ),
    constant(
        CARTOONS,
        "empty map, where the square is left out",
        "(0, 0, 0) and 1",
        Provenance::ours("no normal at all, and the farthest depth"),
        "The outline's ink hangs on it",
    ),
    constant(
        CARTOONS,
        "level of one tone",
        "0.65",
        Provenance::deduced("E, section 3.2: the first two tones are diffuse; the listing's lowest is 0.65 (E13)"),
        "At 1 the model would have its own colour in figures 5b and 14",
    ),
    constant(
        CARTOONS,
        "tones of the background square",
        "none, its own colour",
        Provenance::deduced("E, section 5: it has the background's colour, which its tone would darken (E13)"),
        "The background would be a tone darker with one or two tones",
    ),
    constant(
        &[ThreePass, Mrt],
        "blending of the border",
        "GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA",
        Provenance::deduced(
            "E, section 4.1 has blending enabled and the border as alpha of black; D prints this function for its lines",
        ),
        "The border would be added to the colours below it, or would replace them",
    ),
    constant(
        IMAGE_SPACE,
        "filtering and wrapping of the map",
        "nearest, clamped to the edge",
        Provenance::ours("the paper gives neither; samples fall on texel centres (E12)"),
        "With wrapping, the opposite rim would draw borders at the picture's edge",
    ),
    constant(
        &[ThreePass, TwoPass],
        "place of the filter's square",
        "the near plane, parallel projection",
        Provenance::printed("E, section 4.1"),
        "Nothing, as long as it covers the picture",
    ),
    constant(
        &[ThreePass, TwoPass],
        "picture size of the figures",
        "512 x 512",
        Provenance::printed("E, section 5; TEXTURE_UNIT 0.001953125 is 1/512"),
        "A border is about two pixels wide in any size, so finer in a larger picture",
    ),
    constant(
        &[Inking],
        "direction of the light",
        "(0, 1, 1)",
        Provenance::printed("D, Painting: lightDir"),
        "Tones lie elsewhere on the model",
    ),
    constant(
        &[Inking],
        "space of the light's direction",
        "eye space",
        Provenance::deduced("D, Painting prints \"Worldspace\", but its matrix leads to eye space (D7)"),
        "In world space the tones would stay on the model when the camera moves",
    ),
    constant(
        &[Inking],
        "range of the light",
        "0.1 to 0.9",
        Provenance::printed("D, Painting: light < 0.1, light > 0.9f"),
        "The ends of the ramp would be read, where a texture that wraps mixes dark and bright",
    ),
    constant(
        &[Inking],
        "gradients in a ramp",
        "4, one above the other",
        Provenance::printed("D, Painting: four gradients of three steps"),
        "More materials could have their own colours",
    ),
    constant(
        &[Inking],
        "colours and steps of the built-in ramp",
        "clay, rust, umber, slate; base colour from 0.45, highlight from 0.82",
        Provenance::ours("the text's texture was on its disk and is not at hand"),
        "Other colours, larger shadows or highlights (--ramp)",
    ),
    constant(
        &[Inking],
        "filtering of the ramp",
        "nearest, clamped to the edge",
        Provenance::ours("the text's class for textures is not printed"),
        "Linear filtering would soften the steps by a texel",
    ),
    constant(
        &[Inking],
        "largest product of a silhouette",
        "0.00000001",
        Provenance::printed("D, Inking: (dot1*dot2) <= 0.00000001f"),
        "More takes edges between faces that are nearly edge-on (D4)",
    ),
    constant(
        &[Inking],
        "size of the points",
        "that of the lines",
        Provenance::printed("D, Inking: glPointSize( 2 ) beside glLineWidth( 2 )"),
        "Smaller points leave gaps where lines meet",
    ),
    constant(
        &[Inking],
        "depth test of lines and points",
        "GL_LESS",
        Provenance::printed("D, Inking: glDepthFunc( GL_LESS )"),
        "With GL_LEQUAL points would close the gaps that smoothed lines leave (D11)",
    ),
    constant(
        &[Inking],
        "precedence of the classes of an edge",
        "boundary, non-manifold, silhouette, crease",
        Provenance::ours("the listing only asks whether an edge is drawn"),
        "Edges of two classes would have the other's colour (--class-colors)",
    ),
    constant(
        &[Dietrich],
        "sides of a face",
        "both",
        Provenance::ours("the text is silent; open models show their insides"),
        "Insides would be black",
    ),
    constant(
        &[BackFaces],
        "depth of the lines",
        "tested by GL_LESS, not written",
        Provenance::ours("E, section 2, names the method without its calls"),
        "GL_LEQUAL would add lines within surfaces that an open model shows from behind",
    ),
    constant(
        VALENTE,
        "material and light",
        "white, diffuse alone",
        Provenance::printed("V, section 2.1.1"),
        "Colours of the model would darken the drawing",
    ),
    constant(
        VALENTE,
        "wrapping of all textures",
        "GL_REPEAT on both axes",
        Provenance::printed("V, section 3"),
        "Without it light beyond 1 would stay in the lightest row (V3)",
    ),
    constant(
        VALENTE,
        "column of the grain's texture",
        "the mean of the noise's red, green and blue",
        Provenance::printed("V, section 3.3: (random.r+random.g+random.b)/3.0"),
        "A mean of three gathers in the middle columns; one channel would use all of them alike",
    ),
    constant(
        VALENTE,
        "place of a grain within its pixel",
        "random",
        Provenance::ours("from the pixels' middles t^m leaves rows without any grain, which are stripes (V9)"),
        "Stripes in the lights",
    ),
    constant(
        VALENTE,
        "blur at the texture's edges",
        "repeats along s, ends along t",
        Provenance::ours("the darkest row is no neighbour of the lightest (V11)"),
        "Specks in the lights",
    ),
    constant(
        VALENTE,
        "relief, tooth, fibres and clouds of the paper",
        "standard deviations 3.6, 1.5, 1 and 1.1 of 255 about (245, 242, 233)",
        Provenance::ours("the report shows no paper that one could be made from (V7)"),
        "Smoother or rougher paper, whiter or yellower (--paper)",
    ),
    constant(
        &[Sand],
        "sepia",
        "luminance times 1.2, 1 and 0.8; a share of 0.6",
        Provenance::printed("V, section 4"),
        "Redder or greyer sand; more or less of the drawing",
    ),
];
