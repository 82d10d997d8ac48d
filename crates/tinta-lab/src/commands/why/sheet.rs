//! The sheet of a pixel: the picture, the pixel's neighbourhood, its lines beside the exact ones, and every step with its taps, variables,
//! comparisons and blending.

use crate::canvas::{Canvas, FRAME, Face, SOFT, TEXT, fitted};
use tinta::glam::DVec2;
use tinta::picture::Picture;
use tinta::pixel::{Base, Comparison, Event, Explanation, Fragment, PixelStep, Sample, What, tap};
use tinta::plan::Blend;
use tinta::scene::{Scene, Size};
use tinta::{LineSettings, Renderer, Result, Show, Style, VisibleLines};

/// Around the sheet, and between its panels, pixels.
const MARGIN: u32 = 32;
const GAP: u32 = 24;

/// Pixels of the neighbourhood along a side, and the side of each on the sheet.
const NEAR: u32 = 23;
const ENLARGED: u32 = 16;
const SIDE: u32 = NEAR * ENLARGED;

const WIDTH: u32 = 3 * SIDE + 2 * GAP + 2 * MARGIN;

/// From a row of text to the next.
const ROW: u32 = 19;

/// Columns of a step's rows, from the left margin: the statement, its value, its taps.
const SOURCE: u32 = 36;
const VALUE: u32 = 470;
const TAPS: u32 = 872;

/// A tap's square, and the cell that holds it with its numbers.
const TAP: u32 = 40;
const CELL: [u32; 2] = [93, 78];

/// The scale of a comparison.
const SCALE: Size = Size { width: 150, height: 8 };
const SCALE_LEFT: u32 = 200;

/// Marks of the pixel and of values; exact lines.
const MARK: [u8; 3] = [213, 94, 0];
const EXACT: [u8; 3] = [0, 114, 178];

/// Events shown of a step.
const MOST_EVENTS: usize = 60;

/// Draws the sheet of a pixel that was explained.
pub(super) fn sheet(why: &Explanation, style: &Style, scene: &Scene, renderer: &mut Renderer) -> Result<Picture> {
    let picture = renderer.draw(scene, &style.plan(scene, Show::Final)?)?;
    let lines = match &why.lines {
        Some(_) => Some((
            renderer.draw(scene, &style.plan(scene, Show::Borders)?)?,
            VisibleLines::of(scene, &LineSettings::default())?,
        )),
        None => None,
    };
    let mut sheet = Sheet::new(why);
    sheet.heading(scene.size);
    sheet.panels(&picture, lines.as_ref());
    why.steps.iter().for_each(|step| sheet.step(step));
    sheet.canvas.reach(sheet.top + MARGIN);
    Ok(sheet.canvas.picture)
}

/// A sheet that grows downwards.
struct Sheet<'a> {
    why: &'a Explanation,
    canvas: Canvas,
    /// Where the next thing is painted.
    top: u32,
    title: Face,
    bold: Face,
    text: Face,
    code: Face,
    small: Face,
}

impl<'a> Sheet<'a> {
    fn new(why: &'a Explanation) -> Self {
        Self {
            why,
            canvas: Canvas::new(Size { width: WIDTH, height: MARGIN }),
            top: MARGIN,
            title: Face::new(dejavu::sans::bold(), 22.0),
            bold: Face::new(dejavu::sans::bold(), 15.0),
            text: Face::new(dejavu::sans::regular(), 14.0),
            code: Face::new(dejavu::sans_mono::regular(), 12.0),
            small: Face::new(dejavu::sans_mono::regular(), 10.0),
        }
    }

    /// Makes room for this many pixels below the top.
    fn room(&mut self, height: u32) {
        self.canvas.reach(self.top + height);
    }

    fn line(&mut self, text: &str, color: [u8; 3]) {
        self.room(ROW);
        self.canvas.write(MARGIN, self.top, text, &self.text, color);
        self.top += ROW;
    }

    fn heading(&mut self, size: Size) {
        let Explanation { style, pixel: [x, y], color, renderer, objects, lines, .. } = self.why;
        self.room(32);
        self.canvas.write(MARGIN, self.top, &format!("Pixel {x},{y} of {style}"), &self.title, TEXT);
        self.top += 32;
        let objects = objects.join(", ");
        let [red, green, blue, _] = color;
        self.line(
            &format!("{objects}, {size} pixels; red {red}, green {green}, blue {blue} of 255; drawn by {renderer}"),
            SOFT,
        );
        if let Some(lines) = lines {
            lines.to_string().lines().for_each(|line| self.line(line, TEXT));
        }
        self.top += ROW / 2;
    }

    fn panels(&mut self, picture: &Picture, lines: Option<&(Picture, VisibleLines)>) {
        let size = Size { width: SIDE, height: SIDE };
        self.room(ROW + SIDE + GAP);
        let left = |number: u32| MARGIN + number * (SIDE + GAP);
        let titles = ["the picture", "around the pixel, 16 times", "its lines alone; exact visible lines in blue"];
        let count = if lines.is_some() { 3 } else { 2 };
        for (number, title) in (0..count).zip(titles) {
            self.canvas.write(left(number), self.top, title, &self.text, SOFT);
        }
        self.top += ROW + 4;
        let [x, y] = self.why.pixel.map(|at| f64::from(at) + 0.5);
        let (fitted, scale) = fitted(picture, SIDE);
        self.canvas.paste(left(0), self.top, &fitted);
        self.cross(left(0), &fitted, [x * scale, y * scale]);
        self.canvas.paste(left(1), self.top, &self.near(picture));
        if let Some((alone, exact)) = lines {
            self.canvas.paste(left(2), self.top, &self.near(alone));
            self.exact_lines(exact, left(2));
        }
        for number in 1..count {
            let middle = NEAR / 2 * ENLARGED;
            let size = Size { width: ENLARGED, height: ENLARGED };
            self.canvas.outline(left(number) + middle, self.top + middle, size, 2, opaque(MARK));
        }
        for number in 0..count {
            let size = if number == 0 { fitted.size } else { size };
            self.canvas.outline(left(number), self.top, size, 1, FRAME);
        }
        self.top += SIDE + GAP;
    }

    /// Lines from the edges of a picture towards a place, and a gap around it.
    fn cross(&mut self, left: u32, picture: &Picture, place: [f64; 2]) {
        const GAP_PX: f64 = 9.0;
        let at = |[x, y]: [f64; 2]| DVec2::new(f64::from(left) + x, f64::from(self.top) + y);
        let [x, y] = place;
        let (right, bottom) = (f64::from(picture.size.width), f64::from(picture.size.height));
        let bars = [
            [[0.0, y], [x - GAP_PX, y]],
            [[x + GAP_PX, y], [right, y]],
            [[x, 0.0], [x, y - GAP_PX]],
            [[x, y + GAP_PX], [x, bottom]],
        ];
        let within = ([left, self.top], picture.size);
        for [from, to] in bars.into_iter().filter(|[from, to]| from[0] < to[0] || from[1] < to[1]) {
            self.canvas.segment([at(from), at(to)], 1.5, MARK, within);
        }
    }

    /// The pixels around the explained one, enlarged; beyond the picture grey.
    fn near(&self, picture: &Picture) -> Picture {
        let first = self.why.pixel.map(|at| i64::from(at) - i64::from(NEAR / 2));
        let within = |at: i64, count: u32| (0..i64::from(count)).contains(&at);
        let mut pixels = Vec::with_capacity((SIDE * SIDE * 4) as usize);
        for y in 0..SIDE {
            for x in 0..SIDE {
                let [x, y] = [first[0] + i64::from(x / ENLARGED), first[1] + i64::from(y / ENLARGED)];
                let is_within = within(x, picture.size.width) && within(y, picture.size.height);
                pixels.extend(if is_within { picture.pixel(x, y) } else { FRAME });
            }
        }
        Picture { size: Size { width: SIDE, height: SIDE }, pixels }
    }

    /// The exact visible lines over an enlarged neighbourhood.
    fn exact_lines(&mut self, lines: &VisibleLines, left: u32) {
        let first = DVec2::from(self.why.pixel.map(|at| f64::from(at) - f64::from(NEAR / 2)));
        let corner = DVec2::new(f64::from(left), f64::from(self.top));
        let on_sheet = |place: DVec2| corner + (place - first) * f64::from(ENLARGED);
        let within = ([left, self.top], Size { width: SIDE, height: SIDE });
        for segment in lines.segments.iter().filter(|segment| segment.is_visible) {
            self.canvas.segment(segment.ends_px.map(on_sheet), 2.0, EXACT, within);
        }
    }

    /// A step: what it did to the pixel, and the statements of the triangle that decides.
    fn step(&mut self, step: &PixelStep) {
        self.room(2 * ROW);
        let name = format!("{}, {}", step.pass, step.step);
        self.canvas.write(MARGIN, self.top, &name, &self.bold, TEXT);
        let right = MARGIN + self.bold.width(&name) + 12;
        if let Some(program) = &step.program {
            self.canvas.write(right, self.top, program, &self.text, SOFT);
        }
        self.top += ROW + 3;
        if let Some(fragment) = step.decisive() {
            let start = self.top;
            for event in fragment.events.iter().take(MOST_EVENTS) {
                self.event(event);
            }
            if fragment.events.len() > MOST_EVENTS {
                let more = fragment.events.len() - MOST_EVENTS;
                self.line(&format!("and {more} more; --json lists all"), SOFT);
            }
            self.taps(fragment, start);
        }
        self.written(step);
        self.top += ROW / 2;
    }

    fn event(&mut self, event: &Event) {
        self.room(ROW);
        let (source, value) = (MARGIN + SOURCE, MARGIN + VALUE);
        self.canvas.write(MARGIN, self.top, &format!("{:>4}", event.line), &self.code, SOFT);
        self.canvas.write(source, self.top, &self.why.source(event), &self.code, SOFT);
        let swatch = match &event.what {
            What::Set { value, .. } if value.of.base == Base::Float && !value.of.is_matrix() => {
                color_of(value.numbers())
            }
            What::Read { sample, .. } => color_of(&sample.value),
            _ => None,
        };
        let text = match &event.what {
            What::Read { texture, sample, .. } => of_sample(texture, sample, self.why.place_in_textures),
            What::Branched { compared: Some(compared), is_taken } => format!("{} is {is_taken}", compared.in_words(4)),
            _ => self.why.in_words(event),
        };
        if let Some(color) = swatch {
            self.swatch(value, color);
        }
        self.canvas.write(value + ROW, self.top, &text, &self.code, TEXT);
        if let What::Branched { compared: Some(compared), .. } = &event.what {
            self.scale(value + ROW + SCALE_LEFT, *compared);
        }
        self.top += ROW;
    }

    fn swatch(&mut self, left: u32, color: [u8; 3]) {
        let size = Size { width: ROW - 5, height: ROW - 5 };
        self.canvas.fill(left, self.top + 1, size, opaque(color));
        self.canvas.outline(left, self.top + 1, size, 1, FRAME);
    }

    /// A comparison: the threshold as a bar, the value as a mark, on a scale that holds 0, 1 and both.
    fn scale(&mut self, left: u32, Comparison { left: value, right: threshold, .. }: Comparison) {
        let (low, high) = (value.min(threshold).min(0.0), value.max(threshold).max(1.0));
        if !(low.is_finite() && high.is_finite()) {
            return;
        }
        let middle = self.top + ROW / 2 - 1;
        self.canvas.fill(left, middle - SCALE.height / 2, SCALE, FRAME);
        let at = |number: f64| left + ((number - low) / (high - low) * f64::from(SCALE.width - 3)).round() as u32;
        let bar = Size { width: 3, height: ROW - 4 };
        self.canvas.fill(at(threshold), middle - bar.height / 2, bar, opaque(TEXT));
        let dot = Size { width: 7, height: 7 };
        self.canvas.fill(at(value).saturating_sub(2), middle - dot.height / 2, dot, opaque(MARK));
        let ends =
            [low, high].map(|number| format!("{number:.3}").trim_end_matches('0').trim_end_matches('.').to_owned());
        let before = left.saturating_sub(self.small.width(&ends[0]) + 4);
        self.canvas.write(before, self.top + 2, &ends[0], &self.small, SOFT);
        self.canvas.write(left + SCALE.width + 4, self.top + 2, &ends[1], &self.small, SOFT);
    }

    /// The texels that a filter reads around the pixel, in their places, with their numbers.
    fn taps(&mut self, fragment: &Fragment, start: u32) {
        let mut taps: Vec<([u32; 2], [f64; 4])> = Vec::new();
        for event in &fragment.events {
            if let What::Read { sample: Sample { texels, .. }, .. } = &event.what
                && let [texel] = texels.as_slice()
                && !taps.iter().any(|(place, _)| *place == texel.place)
            {
                taps.push((texel.place, texel.value));
            }
        }
        let mut axes = [0, 1].map(|axis| taps.iter().map(|(place, _)| place[axis]).collect::<Vec<u32>>());
        for axis in &mut axes {
            axis.sort_unstable();
            axis.dedup();
        }
        let [columns, rows] = &axes;
        if taps.len() < 2 || columns.len() > 3 || rows.len() > 3 {
            return;
        }
        let height = CELL[1] * rows.len() as u32;
        self.canvas.reach(start + height + ROW);
        for (place, value) in &taps {
            let column = columns.iter().position(|x| *x == place[0]).unwrap_or_default() as u32;
            // The highest row of texels first.
            let row = rows.iter().rev().position(|y| *y == place[1]).unwrap_or_default() as u32;
            let (left, top) = (MARGIN + TAPS + column * CELL[0], start + row * CELL[1]);
            let size = Size { width: TAP, height: TAP };
            self.canvas.fill(left, top, size, opaque(color_of(value).unwrap_or_default()));
            self.canvas.outline(left, top, size, 1, FRAME);
            let name = tap(*place, self.why.place_in_textures).map_or_else(String::new, String::from);
            self.canvas.write(left + TAP + 4, top, &name, &self.bold, TEXT);
            for (number, pair) in (0..).zip(value.as_chunks::<2>().0) {
                let text = format!("{:.4} {:.4}", pair[0], pair[1]);
                self.canvas.write(left, top + TAP + 2 + number * 13, &text, &self.small, TEXT);
            }
        }
        self.top = self.top.max(start + height);
    }

    /// What was there, what the shader gives, how they are combined, and what is left.
    fn written(&mut self, step: &PixelStep) {
        let drawn: Vec<[f64; 4]> = step.drawn.iter().map(|color| color.map(f64::from)).collect();
        for (number, after) in drawn.iter().enumerate() {
            self.room(ROW);
            let mut left = MARGIN;
            let before = step.before.get(number).map(|color| color.map(f64::from));
            let given = step.decisive().filter(|given| given.is_written()).and_then(|given| given.colors.get(number));
            let how = match step.blend {
                Some(Blend::Over) => "over it by alpha",
                Some(Blend::Multiply) => "multiplied with it",
                Some(Blend::Replace) | None => "in its place",
            };
            let parts = [("before", before), ("shader", given.copied())];
            for (name, color) in parts.into_iter().filter_map(|(name, color)| Some((name, color?))) {
                left = self.named_color(left, name, color);
            }
            if given.is_some() {
                self.canvas.write(left, self.top, how, &self.text, TEXT);
                left += self.text.width(how) + 24;
            }
            left = self.named_color(left, "after", *after);
            let recomputed = match step.difference {
                Some(difference) if difference < 0.01 => "as recomputed".to_owned(),
                Some(difference) => format!("{difference:.2} steps of 255 from the recomputed"),
                None => step.remark.unwrap_or_default().to_owned(),
            };
            self.canvas.write(left, self.top, &recomputed, &self.text, SOFT);
            self.top += ROW;
        }
    }

    /// A colour with its name before it and its numbers behind; returns where it ends.
    fn named_color(&mut self, left: u32, name: &str, color: [f64; 4]) -> u32 {
        self.canvas.write(left, self.top, name, &self.text, TEXT);
        let left = left + self.text.width(name) + 6;
        self.swatch(left, color_of(&color).unwrap_or_default());
        let numbers = color.map(|number| format!("{number:.3}")).join(" ");
        self.canvas.write(left + ROW, self.top, &numbers, &self.code, TEXT);
        left + ROW + self.code.width(&numbers) + 20
    }
}

/// A read in short: the taps stand beside it.
fn of_sample(texture: &str, sample: &Sample, at: [u32; 2]) -> String {
    let numbers = sample.value.map(|number| format!("{number:.4}")).join(", ");
    let from = match sample.texels.as_slice() {
        [texel] => tap(texel.place, at).map_or_else(String::new, |letter| format!(" tap {letter}")),
        texels => format!(" {} texels", texels.len()),
    };
    format!("{texture}{from} ({numbers})")
}

/// The colour of numbers as GL would store them: one is grey, of more than three the first three count; two have none.
fn color_of(numbers: &[f64]) -> Option<[u8; 3]> {
    let byte = |number: f64| (number.clamp(0.0, 1.0) * 255.0).round() as u8;
    match numbers {
        [grey] => Some([byte(*grey); 3]),
        [red, green, blue, ..] => Some([byte(*red), byte(*green), byte(*blue)]),
        _ => None,
    }
}

fn opaque([red, green, blue]: [u8; 3]) -> [u8; 4] {
    [red, green, blue, u8::MAX]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_the_colours_that_gl_stores() {
        assert_eq!(color_of(&[0.5]), Some([128; 3]));
        assert_eq!(color_of(&[-0.5, 0.25, 7.0, 0.0]), Some([0, 64, 255]));
        assert_eq!(color_of(&[0.5, 0.5]), None);
        assert_eq!(color_of(&[f64::NAN, 0.0, 0.0]), Some([0, 0, 0]));
    }
}
