//! The toy soldier's skin: a picture painted by rules, a place for each part.
//!
//! Out: where each part lies on the skin, and the picture as PCX. Across a
//! place lies a part's turn, from his right (0) over the front (a quarter) and
//! the left (a half) to the back; upwards its length from the lower end (0) to
//! the upper (1).

use crate::pcx::{self, Color};

/// Texels a side.
pub const SIZE: usize = 256;

/// A part's place: its upper left texel, texels across and down.
#[derive(Clone, Copy)]
pub struct Rect([usize; 4]);

impl Rect {
    /// The texel at a share of the turn and of the length; a texel away from the neighbouring places, which the filter would mix in.
    pub fn at(self, turn: f64, length: f64) -> [i16; 2] {
        let Rect([left, top, width, height]) = self;
        let texel =
            |first: usize, size: usize, share: f64| (first as f64 + 1.0 + share * (size as f64 - 2.0) + 0.5) as i16;
        [texel(left, width, turn), texel(top, height, 1.0 - length)]
    }
}

pub const TORSO: Rect = Rect([0, 0, 160, 72]);
pub const HEAD: Rect = Rect([160, 0, 96, 72]);
pub const HAT: Rect = Rect([0, 72, 128, 72]);
pub const LEG: Rect = Rect([128, 72, 64, 96]);
pub const ARM: Rect = Rect([192, 72, 64, 96]);
pub const STAND: Rect = Rect([0, 144, 128, 64]);
pub const PLUME: Rect = Rect([128, 168, 32, 32]);
pub const NOSE: Rect = Rect([160, 168, 32, 32]);
pub const HAIR: Rect = Rect([192, 168, 32, 32]);
pub const SHOULDER: Rect = Rect([224, 168, 32, 32]);

const RED: Color = [178, 40, 38];
const DARK_RED: Color = [132, 26, 30];
const WHITE: Color = [236, 230, 214];
const CREAM: Color = [214, 204, 180];
const GOLD: Color = [224, 172, 60];
const DARK_GOLD: Color = [168, 118, 34];
const BLACK: Color = [30, 30, 38];
const GLOSS: Color = [66, 66, 80];
const SKIN: Color = [232, 186, 148];
const ROSE: Color = [222, 140, 112];
const LIPS: Color = [176, 70, 60];
const BROWN: Color = [92, 56, 32];
const DARK_BROWN: Color = [60, 36, 22];
const BLUE: Color = [40, 62, 120];
const WOOD: Color = [150, 104, 62];
const DARK_WOOD: Color = [122, 80, 46];
const GREEN: Color = [62, 104, 62];
const DARK_GREEN: Color = [48, 84, 52];

/// A rule: the colour at a share of the turn and of the length.
type Paint = fn(f64, f64) -> Color;

const PLACES: [(Rect, Paint); 10] = [
    (TORSO, torso),
    (HEAD, head),
    (HAT, hat),
    (LEG, leg),
    (ARM, arm),
    (STAND, stand),
    (PLUME, plume),
    (NOSE, nose),
    (HAIR, hair),
    (SHOULDER, shoulder),
];

/// The picture's file.
pub fn file() -> Result<Vec<u8>, String> {
    let mut pixels = vec![DARK_GREEN; SIZE * SIZE];
    for (Rect([left, top, width, height]), paint) in PLACES {
        for y in 0..height {
            for x in 0..width {
                let (turn, length) = ((x as f64 + 0.5) / width as f64, 1.0 - (y as f64 + 0.5) / height as f64);
                pixels[(top + y) * SIZE + left + x] = paint(turn, length);
            }
        }
    }
    pcx::bytes(SIZE, &pixels)
}

/// How far round the turn a place is from the middle of the front, or of the back, whichever is nearer, with its sign.
fn aside(turn: f64) -> f64 {
    if turn < 0.5 { turn - 0.25 } else { turn - 0.75 }
}

fn is_front(turn: f64) -> bool {
    turn < 0.5
}

/// Whether a place lies in an ellipse.
fn within(turn: f64, length: f64, middle: [f64; 2], radii: [f64; 2]) -> bool {
    let (x, y) = ((turn - middle[0]) / radii[0], (length - middle[1]) / radii[1]);
    x * x + y * y < 1.0
}

/// Stripes of one width, alternating.
fn is_stripe(share: f64, count: f64) -> bool {
    (share * count).rem_euclid(2.0) < 1.0
}

fn torso(turn: f64, length: f64) -> Color {
    let side = aside(turn);
    let is_button =
        (0..5).any(|n| is_front(turn) && within(turn, length, [0.25, 0.47 + 0.075 * f64::from(n)], [0.012, 0.02]));
    // Two belts that cross on chest and back: how far a place is from their middles.
    let from_belt = ((length - 0.6).abs() - side.abs() * 1.3).abs();
    match length {
        l if l > 0.9 => GOLD,
        l if l > 0.83 => BLUE,
        l if (0.36..0.41).contains(&l) && is_front(turn) && side.abs() < 0.035 => GOLD,
        l if (0.345..0.42).contains(&l) => BLACK,
        // The skirt, its corners turned back.
        l if l < 0.345 && is_front(turn) && side.abs() < (0.345 - l) * 0.5 => CREAM,
        l if (0.19..0.215).contains(&l) => GOLD,
        l if l < 0.345 && is_stripe(turn, 20.0) => DARK_RED,
        _ if is_button => GOLD,
        l if l > 0.42 && from_belt < 0.032 && side.abs() < 0.2 => WHITE,
        l if l > 0.42 && from_belt < 0.046 && side.abs() < 0.2 => DARK_RED,
        _ if is_front(turn) && side.abs() < 0.006 => DARK_RED,
        _ => RED,
    }
}

fn head(turn: f64, length: f64) -> Color {
    // Both halves of the face are alike.
    let side = (turn - 0.25).abs();
    let at = |x: f64, y: f64, width: f64, height: f64| within(side, length, [x, y], [width, height]);
    match () {
        () if at(0.066, 0.55, 0.014, 0.036) => BLACK,
        () if at(0.07, 0.55, 0.032, 0.045) => WHITE,
        () if at(0.07, 0.552, 0.038, 0.056) => DARK_BROWN,
        // Brows that rise outwards.
        () if (0.03..0.12).contains(&side) && (length - 0.625 - (side - 0.03) * 0.25).abs() < 0.014 => DARK_BROWN,
        () if at(0.125, 0.46, 0.04, 0.055) => ROSE,
        () if at(0.0, 0.325, 0.04, 0.022) => LIPS,
        // Hair behind, whiskers before the ears.
        () if side > 0.23 && length > 0.34 => {
            if is_stripe(turn, 60.0) {
                BROWN
            } else {
                DARK_BROWN
            }
        }
        () if side > 0.185 && (0.4..0.8).contains(&length) => BROWN,
        () if length < 0.2 => BLUE,
        () => SKIN,
    }
}

fn hat(turn: f64, length: f64) -> Color {
    let side = aside(turn);
    // A cord that hangs in a bow from side to side.
    let cord = 0.69 - 0.1 * (1.0 - (side / 0.25) * (side / 0.25));
    match length {
        l if l > 0.8 => GLOSS,
        l if l > 0.755 => GOLD,
        l if is_front(turn) && within(turn, l, [0.25, 0.53], [0.022, 0.035]) => WHITE,
        l if is_front(turn) && within(turn, l, [0.25, 0.53], [0.06, 0.09]) => GOLD,
        l if (l - cord).abs() < 0.014 => WHITE,
        l if (0.36..0.4).contains(&l) => GOLD,
        l if l < 0.3 => GLOSS,
        _ => BLACK,
    }
}

fn leg(turn: f64, length: f64) -> Color {
    let outside = (turn.min(1.0 - turn)).min((turn - 0.5).abs());
    match length {
        l if (0.53..0.56).contains(&l) => GOLD,
        l if l < 0.53 && is_front(turn) && aside(turn).abs() < 0.05 && l > 0.3 => GLOSS,
        l if l < 0.18 => BROWN,
        l if l < 0.53 => BLACK,
        _ if outside < 0.035 => RED,
        _ => CREAM,
    }
}

fn arm(turn: f64, length: f64) -> Color {
    let side = aside(turn).abs();
    match length {
        l if l < 0.17 => WHITE,
        l if l < 0.19 => DARK_GOLD,
        l if l < 0.25 => GOLD,
        l if l < 0.27 => DARK_RED,
        // Two chevrons.
        l if [0.66, 0.73].iter().any(|middle| (l - middle - (0.25 - side) * 0.4 + 0.04).abs() < 0.013) => GOLD,
        _ => RED,
    }
}

fn stand(turn: f64, length: f64) -> Color {
    let spots = is_stripe(turn + length * 0.6, 26.0) != is_stripe(length, 40.0);
    match length {
        l if l < 0.44 => DARK_WOOD,
        l if l < 0.57 => {
            if is_stripe(l, 46.0) {
                WOOD
            } else {
                DARK_WOOD
            }
        }
        l if l < 0.6 => WOOD,
        _ if spots => GREEN,
        _ => DARK_GREEN,
    }
}

fn plume(turn: f64, length: f64) -> Color {
    match length < 0.55 {
        true if is_stripe(turn + length, 10.0) => RED,
        true => DARK_RED,
        false if is_stripe(turn + length, 10.0) => WHITE,
        false => CREAM,
    }
}

fn nose(_: f64, length: f64) -> Color {
    if (0.3..0.6).contains(&length) { ROSE } else { SKIN }
}

fn hair(turn: f64, length: f64) -> Color {
    if is_stripe(turn + length * 1.5, 12.0) { BROWN } else { DARK_BROWN }
}

fn shoulder(turn: f64, length: f64) -> Color {
    match length {
        l if l < 0.62 && is_stripe(turn, 24.0) => DARK_GOLD,
        l if (0.62..0.7).contains(&l) => DARK_GOLD,
        _ => GOLD,
    }
}
