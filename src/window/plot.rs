//! Times and errors of what is shown, as numbers and a small plot.

use super::price::{Point, Price};
use super::viewer::Viewer;
use egui::{Align2, Color32, FontId, Pos2, Rect, Stroke, Ui, Vec2};

/// Size of the plot, points.
const SIZE: Vec2 = Vec2::new(250.0, 110.0);

/// Room for its labels, points.
const MARGIN: f32 = 16.0;

/// Height of a label, points.
const LABEL_STEP: f32 = 10.0;

/// Shows times and errors.
pub fn show(ui: &mut Ui, viewer: &Viewer) {
    for side in viewer.state.sides() {
        let Some(drawing) = viewer.drawing(*side) else { continue };
        let style = viewer.state.style(*side).name();
        ui.strong(format!("{style}: {:.1} ms a frame", drawing.frame_ms));
        let Some(priced) = viewer.price.sides.iter().find(|priced| priced.side == *side) else {
            ui.label("timing the passes");
            continue;
        };
        for pass in &priced.passes {
            ui.label(format!("{}  {:.2} ms", pass.name, pass.cpu_ms));
        }
        match &priced.error {
            Some(error) => {
                let distance = error.ink_to_reference_px.map_or("-".to_owned(), |[mean, _]| format!("{mean:.2} px"));
                ui.label(format!(
                    "lines: F1 {:.3}, found {:.0} %, right {:.0} %, off by {distance}",
                    error.f1,
                    error.recall * 100.0,
                    error.precision * 100.0
                ));
            }
            None if !priced.has_lines => drop(ui.label("draws no lines")),
            None if viewer.price.is_measuring() => drop(ui.label("finding the exact lines")),
            None => {}
        }
    }
    if !viewer.price.history.is_empty() {
        plot(ui, &viewer.price);
    }
}

/// Error over time, a point for each style measured in this view.
fn plot(ui: &mut Ui, price: &Price) {
    let (response, painter) = ui.allocate_painter(SIZE, egui::Sense::hover());
    let area = response.rect.shrink(MARGIN);
    let axis = Stroke::new(1.0, Color32::GRAY);
    painter.line_segment([area.left_top(), area.left_bottom()], axis);
    painter.line_segment([area.left_bottom(), area.right_bottom()], axis);
    let font = FontId::proportional(10.0);
    let color = ui.visuals().text_color();
    let slowest = price.history.iter().map(|point| point.ms).fold(f64::MIN_POSITIVE, f64::max);
    painter.text(area.left_top(), Align2::LEFT_BOTTOM, "error (1 - F1): 1", font.clone(), color);
    painter.text(area.right_bottom(), Align2::RIGHT_TOP, format!("{slowest:.1} ms"), font.clone(), color);
    for (index, point) in price.history.iter().enumerate() {
        let place = place(point, slowest, area);
        let is_last = index + 1 == price.history.len();
        let fill = if is_last { Color32::from_rgb(220, 90, 60) } else { Color32::from_rgb(90, 140, 200) };
        painter.circle_filled(place, 3.5, fill);
        let (align, beside) =
            if place.x > area.center().x { (Align2::RIGHT_BOTTOM, -5.0) } else { (Align2::LEFT_BOTTOM, 5.0) };
        // Neighbours' names one above the other.
        let above = -LABEL_STEP * (index % 4) as f32;
        painter.text(place + Vec2::new(beside, above), align, point.style, font.clone(), color);
    }
}

/// Where a point stands.
fn place(point: &Point, slowest: f64, area: Rect) -> Pos2 {
    let share = |value: f64| value.clamp(0.0, 1.0) as f32;
    Pos2::new(
        area.left() + area.width() * share(point.ms / slowest),
        area.bottom() - area.height() * share(point.error),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_slowest_is_at_the_right_and_the_worst_at_the_top() {
        let area = Rect::from_min_max(Pos2::new(10.0, 20.0), Pos2::new(110.0, 70.0));
        let at = |ms: f64, error: f64| place(&Point { style: "ink", ms, error }, 8.0, area);
        assert_eq!(at(8.0, 0.0), Pos2::new(110.0, 70.0));
        assert_eq!(at(0.0, 1.0), Pos2::new(10.0, 20.0));
        assert_eq!(at(4.0, 0.5), Pos2::new(60.0, 45.0));
    }
}
