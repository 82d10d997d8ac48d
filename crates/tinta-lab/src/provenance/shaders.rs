//! The numbers in shaders other than 0 and 1, and their origins.

use tinta::settings::Provenance;

/// Numbers of a shader with one provenance.
#[derive(Debug, Clone, Copy)]
pub struct ShaderNumbers {
    /// Below `glsl/`.
    pub path: &'static str,
    /// As written there, without suffix.
    pub numbers: &'static [&'static str],
    /// Their origin.
    pub provenance: Provenance,
}

const fn printed(path: &'static str, numbers: &'static [&'static str], place: &'static str) -> ShaderNumbers {
    ShaderNumbers { path, numbers, provenance: Provenance::printed(place) }
}

const fn deduced(path: &'static str, numbers: &'static [&'static str], from: &'static str) -> ShaderNumbers {
    ShaderNumbers { path, numbers, provenance: Provenance::deduced(from) }
}

const fn ours(path: &'static str, numbers: &'static [&'static str], reason: &'static str) -> ShaderNumbers {
    ShaderNumbers { path, numbers, provenance: Provenance::ours(reason) }
}

/// All of them; a test compares them with the files.
pub const SHADERS: &[ShaderNumbers] = &[
    printed("dachsbacher/ramp.vert", &["0.1", "0.9"], "D, Painting: the light's range"),
    ours("dietrich/dietrich.vert", &["3"], "the element of a matrix that tells parallel projection"),
    printed("evangelista/border.frag", &["0.2", "4"], "E, appendix 1, step 3"),
    ours(
        "evangelista/filter-gaussian.frag",
        &["2.0", "3.0", "4.0"],
        "the paper names a Gaussian filter (section 4.1) and no weights; here the pixel less its mean under 1, 2, 1",
    ),
    printed("evangelista/filter-laplacian4.frag", &["4.0"], "E, figure 11"),
    printed("evangelista/filter-laplacian8.frag", &["8.0"], "E, figure 10, left"),
    deduced("evangelista/filter-sobel.frag", &["2.0"], "E, section 4.1 names Sobel, whose weights are 1, 2, 1"),
    printed("evangelista/toon.frag", &["0.65", "0.8", "0.95"], "E, appendix 1, step 2"),
    printed("evangelista/toon.vert", &["0.5"], "E, appendix 1, step 2: (dot + 1) * 0.5"),
    printed("evangelista/two-pass.frag", &["0.2", "0.65", "0.8", "0.95", "4"], "E, appendix 2"),
    printed("evangelista/two-pass.vert", &["0.5"], "E, appendix 2: (dot + 1) * 0.5"),
    ours(
        "fixed/smooth-line.frag",
        &["0.5"],
        "half a line, half the pixel that it fades over, and from -1 to 1 into 0 to 1",
    ),
    ours("fixed/smooth-point.frag", &["0.5"], "half a disc"),
    ours("improved/box-filter.frag", &["0.5", "4"], "the middle of a texel; up to 4 x 4 samples a pixel"),
    ours("improved/map-biased.vert", &["0.5"], "normals from -1 to 1 into 0 to 1"),
    ours("improved/map-numbers.vert", &["0.5"], "normals from -1 to 1 into 0 to 1"),
    ours("improved/numbers-differ.frag", &["0.5", "255.0"], "half a step of the numbers, which 8 bits store"),
    ours("improved/ink-depth-map.frag", &["1.5"], "rounding of two depths of 16 bits"),
    ours("improved/ink-depth-map.frag", &["255.0", "65280.0", "65535.0"], "how plane-map.frag stores depth"),
    ours("improved/plane-ink.frag", &["2.0"], "how plane-map.frag stores slopes"),
    ours("improved/plane-map.frag", &["0.5", "255.0", "256.0", "65535.0"], "slope and depth of 16 bits in bytes"),
    ours("improved/plane-map.frag", &["0.99"], "a slope must differ from the background's 0"),
    ours("improved/slope-threshold.frag", &["2.0"], "the second difference 1, -2, 1"),
    ours("improved/specks.frag", &["0.5", "1.5"], "between whole numbers of pixels, which the listing distinguishes"),
    ours(
        "improved/specks.frag",
        &["16", "2"],
        "the widest speck looked for; a box grows by a pixel on one side at least",
    ),
    ours("improved/texel-biased.frag", &["2.0"], "normals from 0 to 1 into -1 to 1"),
    ours("improved/texel-depth-texture.frag", &["2.0"], "normals from 0 to 1 into -1 to 1"),
    ours("improved/tones-far.frag", &["0.5"], "the pixel's middle on the border: half of it is above"),
    ours(
        "improved/tones-far.frag",
        &["0.00001"],
        "light that changes less from pixel to pixel is a flat face's, rounded",
    ),
    printed("improved/two-targets.frag", &["0.65", "0.8", "0.95"], "E, appendix 1, step 2"),
    printed("improved/two-targets.vert", &["0.5"], "E, appendix 1, step 2: (dot + 1) * 0.5"),
    printed("valente/charcoal.vert", &["0.5"], "V, section 3.2: paperCoord"),
    deduced("valente/charcoal-object.vert", &["0.5"], "V, section 3.2: paperCoord"),
    printed("valente/charcoal.frag", &["3.0"], "V, section 3.3: the mean of the noise"),
    printed("valente/charcoal-parts.frag", &["3.0"], "V, section 3.3: the mean of the noise"),
    printed("valente/finish-sand.frag", &["0.6", "0.8", "1.2"], "V, section 4"),
    ours("valente/grain-pixel.frag", &["0.5"], "the middle of a pixel"),
    printed("valente/luminance-published.frag", &["0.0154", "0.0721", "0.1125"], "V, section 4"),
    ours(
        "valente/luminance-rec709.frag",
        &["0.0721", "0.2125", "0.7154"],
        "Rec. 709, which the printed digits resemble (V5)",
    ),
    deduced("valente/paper.vert", &["0.5"], "V, section 3.2: coordinates from 0 to 1 over the screen"),
    printed("valente/sand.frag", &["0.0154", "0.0721", "0.1125", "0.6", "0.8", "1.2"], "V, section 4"),
    printed("valente/sand.frag", &["3.0"], "V, section 3.3: the mean of the noise"),
    printed("valente/sand.vert", &["0.5"], "V, section 3.2: paperCoord"),
    ours(
        "valente/strokes-hand.frag",
        &["0.2", "1.5", "4.0"],
        "how much strokes and pressure change the light, looked at",
    ),
    ours(
        "valente/strokes-hand.frag",
        &["84.0", "6.0"],
        "strokes across and along a picture: some pixels wide, looked at",
    ),
    ours("valente/strokes-hand.frag", &["0.80", "0.60"], "a slant of 37 degrees, as a right hand draws"),
    ours(
        "valente/strokes-hand.frag",
        &["0.05", "7.5", "31.5", "53.5"],
        "how far strokes bend; places apart in the noise",
    ),
    ours("valente/strokes-hand.frag", &["0.5", "2.0", "3.0"], "smooth noise: middles of texels and Hermite's step"),
    ours(
        "valente/tooth-paper.frag",
        &["0.5", "2.0"],
        "heights from 0 to 1 into -1 to 1; half as much where all is black",
    ),
    ours("valente/wrap-edge.frag", &["0.5"], "the middle of the last row (V3)"),
];
