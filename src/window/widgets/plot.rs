//! Times and errors of the shown picture, as numbers and a small plot.

use crate::window::threads::cost::{Costs, Point};
use crate::window::threads::viewer::Viewer;
use crate::window::values::line_style::LinesShown;
use egui::{Align2, Color32, FontId, Pos2, Rect, Stroke, Ui, Vec2};

/// Size of the plot, points.
const SIZE: Vec2 = Vec2::new(290.0, 150.0);

/// Room for its labels, points.
const MARGIN: f32 = 16.0;

/// Between labels one above the other, points.
const LABEL_STEP: f32 = 13.0;

/// Between a point and its label, points.
const LABEL_GAP: f32 = 6.0;

/// The least error that the axis reaches to.
const LEAST_RANGE: f64 = 0.05;

/// Shows times and errors.
pub(in crate::window) fn show(ui: &mut Ui, viewer: &Viewer) {
    for side in viewer.state.sides() {
        if viewer.state.lines_shown(*side) == LinesShown::Alone {
            ui.strong(viewer.state.style(*side).name());
            ui.label("exact lines have no passes to time");
            continue;
        }
        let style = viewer.state.style(*side).name();
        let Some(side_cost) = viewer.costs.sides.iter().find(|side_cost| side_cost.side == *side) else {
            ui.strong(style);
            ui.label("timing frames and passes");
            continue;
        };
        ui.strong(format!("{style}: {:.1} ms a frame", side_cost.frame_ms));
        for pass in &side_cost.passes {
            ui.label(format!("{}  {:.2} ms", pass.name, pass.cpu_ms));
        }
        match &side_cost.error {
            Some(error) => {
                let distance = error.mean_px.map_or("-".to_owned(), |mean| format!("{mean:.2} px"));
                ui.label(format!(
                    "lines: F1 {:.3}, found {:.0} %, right {:.0} %, off by {distance}",
                    error.f1,
                    error.recall * 100.0,
                    error.precision * 100.0
                ));
            }
            None if !side_cost.has_lines => drop(ui.label("draws no lines")),
            None if viewer.costs.is_measuring() => drop(ui.label("finding the exact lines")),
            None => {}
        }
    }
    if !viewer.costs.history.is_empty() {
        plot(ui, &viewer.costs);
    }
}

/// Error over time, a point for each style measured in this view.
fn plot(ui: &mut Ui, costs: &Costs) {
    let (response, painter) = ui.allocate_painter(SIZE, egui::Sense::hover());
    let area = response.rect.shrink(MARGIN);
    let axis = Stroke::new(1.0, Color32::GRAY);
    painter.line_segment([area.left_top(), area.left_bottom()], axis);
    painter.line_segment([area.left_bottom(), area.right_bottom()], axis);
    let font = FontId::proportional(10.0);
    let color = ui.visuals().text_color();
    let slowest = costs.history.iter().map(|point| point.ms).fold(f64::MIN_POSITIVE, f64::max);
    let worst = costs.history.iter().map(|point| point.error).fold(LEAST_RANGE, f64::max);
    let axis_labels = [
        (area.left_top(), Align2::LEFT_BOTTOM, format!("error (1 - F1): {worst:.2}")),
        (area.right_bottom(), Align2::RIGHT_TOP, format!("{slowest:.1} ms a frame")),
    ];
    let places: Vec<Pos2> = costs.history.iter().map(|point| place(point, [slowest, worst], area)).collect();
    let mut taken: Vec<Rect> = places.iter().map(|place| Rect::from_center_size(*place, Vec2::splat(7.0))).collect();
    taken.extend(axis_labels.map(|(place, align, text)| painter.text(place, align, text, font.clone(), color)));
    let last = places.len() - 1;
    for (index, (point, place)) in costs.history.iter().zip(&places).enumerate() {
        let fill = if index == last { Color32::from_rgb(220, 90, 60) } else { Color32::from_rgb(90, 140, 200) };
        painter.circle_filled(*place, 3.5, fill);
        // The last point of a style bears its name.
        if costs.history[index + 1..].iter().any(|later| later.style == point.style) {
            continue;
        }
        let text = painter.layout_no_wrap(point.style.to_owned(), font.clone(), color);
        let label = free_place(*place, text.size(), area.expand(MARGIN), &taken);
        taken.push(label);
        if label.distance_to_pos(*place) > LABEL_GAP * 2.0 {
            let nearest = label.clamp(*place);
            painter.line_segment([*place, nearest], Stroke::new(0.5, Color32::GRAY));
        }
        painter.galley(label.min, text, color);
    }
}

/// A free place for a label beside a point: right or left of it, higher and higher.
fn free_place(point: Pos2, size: Vec2, area: Rect, taken: &[Rect]) -> Rect {
    let at = |right: bool, step: i32| {
        let left = if right { point.x + LABEL_GAP } else { point.x - LABEL_GAP - size.x };
        Rect::from_min_size(Pos2::new(left, point.y - size.y / 2.0 - step as f32 * LABEL_STEP), size)
    };
    let is_free = |label: &Rect| area.contains_rect(*label) && !taken.iter().any(|other| other.intersects(*label));
    let steps = [0, 1, -1, 2, -2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12];
    let all = steps.into_iter().flat_map(|step| [at(true, step), at(false, step)]);
    // Without any free place they overlap.
    all.into_iter().find(is_free).unwrap_or_else(|| at(true, 0))
}

/// The place of a point, the largest time at the right and the largest error at the top.
fn place(point: &Point, [slowest, worst]: [f64; 2], area: Rect) -> Pos2 {
    let share = |value: f64| value.clamp(0.0, 1.0) as f32;
    Pos2::new(
        area.left() + area.width() * share(point.ms / slowest),
        area.bottom() - area.height() * share(point.error / worst),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_slowest_is_at_the_right_and_the_worst_at_the_top() {
        let area = Rect::from_min_max(Pos2::new(10.0, 20.0), Pos2::new(110.0, 70.0));
        let at = |ms: f64, error: f64| place(&Point { style: "ink", ms, error }, [8.0, 0.5], area);
        assert_eq!(at(8.0, 0.0), Pos2::new(110.0, 70.0));
        assert_eq!(at(0.0, 0.5), Pos2::new(10.0, 20.0));
        assert_eq!(at(4.0, 0.25), Pos2::new(60.0, 45.0));
    }

    #[test]
    fn labels_of_neighbours_lie_on_nothing() {
        let area = Rect::from_min_max(Pos2::ZERO, SIZE.to_pos2());
        let points: Vec<Pos2> = (0..9).map(|index| Pos2::new(200.0 + 3.0 * index as f32, 120.0)).collect();
        let mut taken: Vec<Rect> =
            points.iter().map(|place| Rect::from_center_size(*place, Vec2::splat(7.0))).collect();
        for point in points {
            let label = free_place(point, Vec2::new(44.0, 12.0), area, &taken);
            assert!(area.contains_rect(label), "{label:?}");
            assert!(!taken.iter().any(|other| other.intersects(label)), "{label:?}");
            taken.push(label);
        }
    }
}
