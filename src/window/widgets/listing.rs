//! The listing over the picture: the shader of one step at the pixel under the pointer, each line with its values.

use crate::pixel::{Explanation, LineState, ListedLine, PixelStep};
use crate::window::threads::viewer::Viewer;
use egui::{Align2, Color32, Context, RichText, Ui, Vec2};

/// Colours of lines that ran, of conditions that were false, and of statements that did not run.
const RAN: Color32 = Color32::from_gray(225);
const NOT_TAKEN: Color32 = Color32::from_rgb(230, 150, 90);
const SKIPPED: Color32 = Color32::from_gray(140);

/// Colour of values.
const VALUE: Color32 = Color32::from_rgb(140, 200, 255);

/// Size of the text, points, and of its rows.
const TEXT: f32 = 10.5;
const ROW: f32 = 15.0;

/// Letters of a line of the listing, and of a value.
const LETTERS: usize = 62;

/// Height of what is around the rows, points.
const AROUND: f32 = 150.0;

/// Width of the listing, points.
const WIDTH: f32 = 560.0;

/// Shows it in the half of the picture that the pointer is not in. The pointer goes through it.
pub(in crate::window) fn show(context: &Context, viewer: &Viewer) {
    let state = &viewer.state;
    let Some((side, [x, _])) = state.pointed.filter(|_| state.explains) else {
        return place(context, Align2::LEFT_TOP, |ui| text(ui, "Point at a pixel. N: next pass, W: close."));
    };
    let is_right = f64::from(x) * 2.0 > f64::from(state.picture_size().width);
    let corner = if is_right { Align2::LEFT_TOP } else { Align2::RIGHT_TOP };
    place(context, corner, |ui| match viewer.explained.answer() {
        Some(Ok(explained)) => listing(ui, explained, state.passes_on),
        Some(Err(problem)) => text(ui, problem),
        None if state.style(side).style_name().draws_lines() => {
            text(ui, "Exact lines have no shaders; choose another style.")
        }
        None => text(ui, "..."),
    });
}

fn place(context: &Context, corner: Align2, content: impl FnOnce(&mut Ui)) {
    let inwards = if corner == Align2::LEFT_TOP { 8.0 } else { -8.0 };
    // Beside the panel, not over it.
    let within = context.available_rect();
    let at = corner.pos_in_rect(&within) + Vec2::new(inwards, 8.0);
    let area = egui::Area::new("why".into()).pivot(corner).fixed_pos(at).interactable(false);
    area.constrain_to(within).show(context, |ui| {
        egui::Frame::popup(ui.style()).show(ui, |ui| {
            ui.style_mut().interaction.selectable_labels = false;
            ui.set_max_width(WIDTH.min(within.width() - 40.0));
            content(ui);
        });
    });
}

fn text(ui: &mut Ui, text: &str) {
    ui.add(egui::Label::new(text).wrap());
}

/// The step so many after the last, counted round.
fn chosen(explained: &Explanation, passes_on: i32) -> Option<(usize, &PixelStep)> {
    let drawing: Vec<usize> = explained
        .steps
        .iter()
        .enumerate()
        .filter(|(_, step)| step.program.is_some())
        .map(|(number, _)| number)
        .collect();
    let last = i64::try_from(drawing.len()).ok()? - 1;
    let place = (last + i64::from(passes_on)).checked_rem_euclid(last + 1)?;
    let number = *drawing.get(usize::try_from(place).ok()?)?;
    Some((number, explained.steps.get(number)?))
}

fn listing(ui: &mut Ui, explained: &Explanation, passes_on: i32) {
    let [x, y] = explained.pixel;
    ui.strong(format!("Pixel {x},{y} of {}", explained.style));
    let Some((number, step)) = chosen(explained, passes_on) else {
        return text(ui, "No pass of this style has shaders of its own here.");
    };
    ui.spacing_mut().item_spacing.y = 1.0;
    ui.label(format!("{}, {}   (N: next pass)", step.pass, step.step));
    colors(ui, "before", &step.before);
    let room = ((ui.ctx().content_rect().height() - AROUND) / ROW).max(4.0) as usize;
    let shaders = explained.listing(number);
    if shaders.is_empty() {
        text(ui, "No triangle of this pass reaches the pixel.");
    }
    let rows: Vec<(Option<String>, ListedLine)> = shaders
        .into_iter()
        .flat_map(|(path, lines)| {
            let mut path = Some(path);
            lines.into_iter().map(move |line| (path.take(), line))
        })
        .filter(|(_, line)| !line.text.trim().is_empty())
        .collect();
    let mut height = 0;
    let fitting = rows.iter().take_while(|(path, line)| {
        height += 1 + usize::from(path.is_some()) + usize::from(!line.values.is_empty());
        height <= room
    });
    let fitting = fitting.count();
    let left_out = rows.len() - fitting;
    for (path, line) in rows.into_iter().take(fitting) {
        if let Some(path) = path {
            ui.label(RichText::new(path).weak());
        }
        listed(ui, &line);
    }
    if left_out > 0 {
        ui.label(format!("and {left_out} lines more; tinta why prints all"));
    }
    colors(ui, "after", &step.drawn);
}

fn listed(ui: &mut Ui, line: &ListedLine) {
    let color = match line.state {
        LineState::Ran | LineState::Other => RAN,
        LineState::NotTaken => NOT_TAKEN,
        LineState::Skipped => SKIPPED,
    };
    let shortened = |text: &str| text.chars().take(LETTERS).collect::<String>();
    let code = |text: String, color| egui::Label::new(RichText::new(text).monospace().size(TEXT).color(color)).extend();
    ui.add(code(format!("{:>3} {}", line.number, shortened(&line.text)), color));
    for value in line.values.iter().rev().take(1) {
        ui.add(code(
            format!("        {}", shortened(value)),
            if line.state == LineState::NotTaken { NOT_TAKEN } else { VALUE },
        ));
    }
}

/// Colours of the step's targets, each as a square and as numbers.
fn colors(ui: &mut Ui, name: &str, colors: &[[f32; 4]]) {
    for color in colors {
        ui.horizontal(|ui| {
            let (square, _) = ui.allocate_exact_size(Vec2::splat(10.0), egui::Sense::hover());
            let byte = |channel: f32| (channel.clamp(0.0, 1.0) * 255.0).round() as u8;
            ui.painter().rect_filled(square, 1.0, Color32::from_rgb(byte(color[0]), byte(color[1]), byte(color[2])));
            ui.label(
                RichText::new(format!("{name} {:.4} {:.4} {:.4} {:.4}", color[0], color[1], color[2], color[3]))
                    .size(TEXT),
            );
        });
    }
}
