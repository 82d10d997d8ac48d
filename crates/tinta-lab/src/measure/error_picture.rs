//! A picture of where a drawing's ink is right, and where not.

use super::ink::{Ink, Verdict};
use super::reference::Reference;
use tinta::picture::Picture;

/// Agreed ink black, missed lines red, invented ink blue, ink that does not count grey.
pub(crate) fn error_picture(ink: &Ink, reference: &Reference, tolerance_px: f64) -> Picture {
    const AGREED: [u8; 4] = [0, 0, 0, 255];
    const INVENTED: [u8; 4] = [30, 90, 230, 255];
    const IGNORED: [u8; 4] = [190, 190, 190, 255];
    const MISSED: [u8; 4] = [225, 25, 25, 255];
    let verdicts = ink.verdicts(reference, tolerance_px);
    let color = |verdict: &Option<Verdict>| match verdict {
        None => [u8::MAX; 4],
        Some(Verdict::Agreed) => AGREED,
        Some(Verdict::Invented) => INVENTED,
        Some(Verdict::Ignored) => IGNORED,
    };
    let mut pixels: Vec<u8> = verdicts.pixels.iter().flat_map(color).collect();
    for place in verdicts.missed {
        let (x, y) = (place.x.floor() as usize, place.y.floor() as usize);
        if x < ink.size.width as usize && y < ink.size.height as usize {
            let first = (y * ink.size.width as usize + x) * 4;
            pixels[first..first + 4].copy_from_slice(&MISSED);
        }
    }
    Picture { size: ink.size, pixels }
}
