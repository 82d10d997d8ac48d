//! The label of each of two pictures side by side, in a corner of its pane: a look, a style with its text's settings, or neither.

use crate::styles::{Origin, Style};
use crate::window::values::event::{Layout, Side};
use crate::window::values::state::{Content, ViewerState};
use egui::{Align2, Color32, FontId, Pos2, Rect, Ui, Vec2};

/// From a pane's corner to the text, points.
const MARGIN: f32 = 8.0;

/// Around the text, points.
const PADDING: f32 = 3.0;

/// The label of a side: the look's name, or the style's and the origin of its settings.
pub(in crate::window) fn label(state: &ViewerState, side: Side) -> String {
    let name = state.drawn_name(side);
    if let Some(look) = state.look_of(side).filter(|look| look.has_settings()) {
        return format!("look {}", look.name);
    }
    let style = state.style(side);
    match style.style_name().info().origin {
        _ if *style != Style::named(style.style_name()) => format!("{name}, changed settings"),
        Origin::Published(year) => format!("{name}, as published, {year}"),
        Origin::Named | Origin::Own => format!("{name}, default settings"),
    }
}

/// Paints the labels of two sides; a single one needs none. `corner` is the drawing area's in points, `scale` the number of
/// pixels per point.
pub(in crate::window) fn show(ui: &Ui, state: &ViewerState, area: Rect, scale: f32) {
    if state.layout == Layout::Single {
        return;
    }
    for pane in state.panes() {
        let left = area.left() + pane.left as f32 / scale;
        match pane.content {
            Content::Picture(side) => paint(ui, &label(state, side), Pos2::new(left, area.top()), Align2::LEFT_TOP),
            Content::Cut(_) => {
                paint(ui, &label(state, Side::Left), area.left_top(), Align2::LEFT_TOP);
                paint(ui, &label(state, Side::Right), area.right_top(), Align2::RIGHT_TOP);
            }
            Content::Difference => paint(ui, "difference", Pos2::new(left, area.top()), Align2::LEFT_TOP),
        }
    }
}

fn paint(ui: &Ui, text: &str, corner: Pos2, align: Align2) {
    let text = ui.painter().layout_no_wrap(text.to_owned(), FontId::proportional(12.0), Color32::from_gray(30));
    let inwards = Vec2::new(if align == Align2::RIGHT_TOP { -MARGIN } else { MARGIN }, MARGIN);
    let place = align.anchor_size(corner + inwards, text.size());
    ui.painter().rect_filled(place.expand(PADDING), 2.0, Color32::from_white_alpha(215));
    ui.painter().galley(place.min, text, Color32::from_gray(30));
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::window::values::event::ViewerEvent;

    fn labels(events: &[ViewerEvent]) -> [String; 2] {
        let mut state = ViewerState::default();
        events.iter().cloned().for_each(|event| drop(state.update(event)));
        [Side::Left, Side::Right].map(|side| label(&state, side))
    }

    #[test]
    fn a_side_is_called_by_its_look_or_by_whose_its_settings_are() {
        let style = |side, name: &str| ViewerEvent::Style(side, name.to_owned());
        let look = |name: &str| ViewerEvent::Look(name.to_owned());
        assert_eq!(labels(&[]), ["three-pass, as published, 2005", "inking, as published, 2001"]);
        assert_eq!(labels(&[look("print")]), ["look print", "inking, as published, 2001"], "a look is one side's");
        let width = ViewerEvent::Set(Side::Right, "--line-width".to_owned(), "5".to_owned());
        assert_eq!(labels(&[width, look("print")]), ["look print", "inking, changed settings"], "what was set stays");
        assert_eq!(labels(&[look("technical"), ViewerEvent::Turn([0.3, 0.1])])[0], "look technical");
        assert_eq!(labels(&[style(Side::Right, "mrt")])[1], "mrt, default settings");
        assert_eq!(labels(&[style(Side::Left, "lines")])[0], "lines, default settings");
        let tones = ViewerEvent::Set(Side::Left, "--tones".to_owned(), "2".to_owned());
        assert_eq!(labels(&[tones])[0], "three-pass, changed settings");
    }
}
