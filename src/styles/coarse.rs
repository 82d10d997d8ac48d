//! Styles while the model moves: faster, with nearly the same picture.

use super::{Style, StyleName};
use crate::settings::HasSettings;

/// Returns the style without the faces that look away, without larger pictures to shrink, and the three passes' picture by `mrt`, with
/// one pass over the geometry.
pub fn coarse(style: &Style) -> Style {
    let of_mrt = || Style::with_options(StyleName::Mrt, &style.to_options().ok()?).ok();
    let mut coarse = match style.style_name() {
        StyleName::ThreePass => of_mrt().unwrap_or_else(|| style.clone()),
        _ => style.clone(),
    };
    for (name, value) in [("cull", "back"), ("supersample", "1")] {
        if let Some(setting) = Style::table().find(&coarse, name) {
            let mut changed = coarse.clone();
            // Where it cannot be coarser it does not change.
            if setting.set(&mut changed, value).is_ok() {
                coarse = changed;
            }
        }
    }
    coarse
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_style_has_a_coarse_form_and_the_three_passes_are_drawn_at_once() {
        for (name, of) in StyleName::of_passes() {
            let once = coarse(&Style::named(of));
            let is_other = of == StyleName::ThreePass;
            assert_eq!(once.name(), if is_other { "mrt" } else { name });
            assert_eq!(coarse(&once), once, "{name}");
        }
        let mut tones = Style::named(StyleName::ThreePass);
        Style::table().find(&tones, "tones").unwrap().set(&mut tones, "2").unwrap();
        let Style::Mrt(mrt) = coarse(&tones) else { panic!("mrt") };
        assert_eq!((mrt.0.tones.count, mrt.0.cull_back_faces), (2, true));
    }
}
