//! Draws lines as pixels: the same picture as the SVG, at any size, without an external rasteriser.
//!
//! Input: [`VisibleLines`] and [`DrawingSettings`], or [`Strokes`]. Output: [`Raster`]. All lines have round ends and corners, so the
//! distance of a pixel's centre from the nearest line, and its direction, give the pixel's share on the line's side of each border.
//! Within a layer lines of one colour that cross do not add up, as in the SVG. Layers are composited over one another.

use crate::error::{Error, Result};
use crate::lines::VisibleLines;
use crate::lines::drawing::chain::{LinePath, chain};
use crate::lines::drawing::drawn_layers::Drawing;
use crate::lines::drawing::fills::FillGroup;
use crate::lines::drawing::settings::DrawingSettings;
use crate::lines::drawing::taper;
use crate::lines::write::strokes::{Polyline, Strokes, strokes_of};
use crate::scene::{Background, Color, Size};
use glam::{DVec2, Vec2};
use std::f64::consts::FRAC_1_SQRT_2;

/// The pixels of a drawing.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Raster {
    /// Width and height.
    pub size: Size,
    /// Red, green, blue and alpha, not premultiplied, row by row from the top.
    pub pixels: Vec<u8>,
}

/// Returns the lines as pixels, without spurs and specks.
///
/// # Errors
///
/// Those of [`crate::lines::svg`], and [`Error::Setting`] for a page that is not the whole picture.
pub fn raster(lines: &VisibleLines, settings: &DrawingSettings) -> Result<Raster> {
    let lines = lines.without_specks(settings)?;
    raster_of_paths(&lines, chain(&lines.segments), settings)
}

/// Returns the given lines as pixels, with the paths that [`chain`] made of them.
///
/// # Errors
///
/// Those of [`raster`].
pub fn raster_of_paths(lines: &VisibleLines, paths: Vec<LinePath>, settings: &DrawingSettings) -> Result<Raster> {
    let drawing = Drawing::new(lines, paths, None, settings)?;
    let [width, height] = [lines.size.width, lines.size.height].map(f64::from);
    if drawing.page.extent_px != DVec2::new(width, height) || drawing.page.origin_px != DVec2::ZERO {
        return Err(Error::setting("page", "a picture is as large as --size; leave it out, or write a .svg or .pdf"));
    }
    Ok(raster_of_strokes(&strokes_of(&drawing), lines.size, settings.background))
}

/// Returns strokes as pixels on a background, from the lowest layer to the highest.
pub fn raster_of_strokes(strokes: &[Strokes], size: Size, background: Background) -> Raster {
    let mut pixels = background.clear_color().map(byte).repeat(size.pixel_count());
    lay_strokes(strokes, size, &mut pixels);
    Raster { size, pixels }
}

/// Lays strokes over a picture of this size, from the lowest layer to the highest.
pub fn lay_strokes(strokes: &[Strokes], size: Size, pixels: &mut [u8]) {
    lay_strokes_by(strokes, size, pixels, |_| 1.0);
}

/// Lays strokes over a picture as [`lay_strokes`] does, each pixel with a share of its ink: `share` is given the pixel's number,
/// row by row from the top, and returns 0 to 1.
pub fn lay_strokes_by(strokes: &[Strokes], size: Size, pixels: &mut [u8], share: impl Fn(usize) -> f32) {
    let mut cover = Cover::new(size);
    for layer in strokes {
        for Polyline { points_px, is_closed } in &layer.polylines {
            let closing = is_closed.then(|| points_px.last().zip(points_px.first())).flatten();
            let pairs = points_px.windows(2).map(|pair| (&pair[0], &pair[1])).chain(closing);
            pairs.for_each(|(a, b)| cover.line([*a, *b], [layer.width_px; 2]));
        }
        for tip in &layer.tips {
            for (pair, shares) in tip.windows(2).zip(taper::shares(tip).windows(2)) {
                cover.line([pair[0], pair[1]], [shares[0], shares[1]].map(|share| share * layer.width_px));
            }
        }
        cover.blend_into(pixels, layer.color, |pixel| layer.opacity * share(pixel));
    }
}

/// Lays painted areas over a picture of this size, each with its colour below those that meet it later.
pub fn lay_fills(groups: &[FillGroup], size: Size, pixels: &mut [u8]) {
    /// The width of that colour along their border, pixels: all pixels that the border crosses.
    const TRAP_PX: f64 = 1.5;
    let mut cover = Cover::new(size);
    for fill in groups.iter().flat_map(|group| &group.fills) {
        lay_area(&fill.loops, fill.color, size, pixels);
        let sides = fill.trap.iter().flat_map(|stretch| stretch.windows(2));
        sides.for_each(|side| cover.line([side[0], side[1]], [TRAP_PX; 2]));
        cover.blend_into(pixels, fill.color, |_| 1.0);
    }
}

/// Lays an area over a picture of this size: closed polygons, and their holes, which run the other way.
fn lay_area(loops: &[Vec<DVec2>], color: Color, size: Size, pixels: &mut [u8]) {
    let width = size.width as usize;
    let rows = loops.iter().flatten().map(|corner| corner.y.clamp(0.0, f64::from(size.height)));
    let (low, high) = rows.fold((f64::INFINITY, 0.0f64), |(low, high), y| (low.min(y), high.max(y)));
    let (first, last) = (low.floor(), high.ceil());
    if last <= first {
        return;
    }
    // What each pixel covers more than the one to its left.
    let mut steps = vec![0.0f32; (width + 2) * (last - first) as usize];
    let (above, part) = (DVec2::new(0.0, first), Size { height: (last - first) as u32, ..size });
    for corners in loops {
        for (from, to) in corners.iter().zip(corners.iter().cycle().skip(1)) {
            add_side([*from - above, *to - above], part, &mut steps);
        }
    }
    let rows = pixels.chunks_exact_mut(width * 4).skip(first as usize);
    for (row, steps) in rows.zip(steps.chunks_exact(width + 2)) {
        let mut covered = 0.0;
        for (pixel, step) in row.chunks_exact_mut(4).zip(steps) {
            covered += step;
            if covered.abs() > 1e-4 {
                lay_over(pixel, color, covered.abs().min(1.0));
            }
        }
    }
}

/// Adds the area between a side and the picture's right edge.
fn add_side([from, to]: [DVec2; 2], size: Size, steps: &mut [f32]) {
    let sign = if from.y < to.y { 1.0 } else { -1.0 };
    let [low, high] = if from.y < to.y { [from, to] } else { [to, from] };
    let slope = (high.x - low.x) / (high.y - low.y);
    let width = f64::from(size.width);
    let [first, last] = [low.y, high.y].map(|y| y.clamp(0.0, f64::from(size.height)));
    for row in first.floor() as usize..last.ceil() as usize {
        let [top, bottom] = [first.max(row as f64), last.min(row as f64 + 1.0)];
        let at = |y: f64| (low.x + (y - low.y) * slope).clamp(0.0, width);
        let [left, right] = [at(top).min(at(bottom)), at(top).max(at(bottom))];
        let (mut passed, mut last_share) = (0.0, 0.0);
        let place = |column: usize| row * (size.width as usize + 2) + column;
        let height = sign * (bottom - top);
        for column in left.floor() as usize..=right.floor() as usize {
            let [enter, leave] = [left.max(column as f64), right.min(column as f64 + 1.0)];
            let here = if right > left { (leave - enter) / (right - left) } else { 1.0 };
            // Of the pixel, all is to the right of what the side passed before.
            let share = passed + here * (column as f64 + 1.0 - (enter + leave) * 0.5);
            steps[place(column)] += (height * (share - last_share)) as f32;
            (passed, last_share) = (passed + here, share);
        }
        steps[place(right.floor() as usize + 1)] += (height * (1.0 - last_share)) as f32;
    }
}

fn byte(channel: f32) -> u8 {
    (channel * 255.0).round() as u8
}

/// Composites a colour with this opacity over a pixel: red, green, blue and alpha, not premultiplied.
pub fn lay_over(pixel: &mut [u8], Color(color): Color, opacity: f32) {
    let below = f32::from(pixel[3]) / 255.0 * (1.0 - opacity);
    let alpha = opacity + below;
    for (channel, color) in pixel.iter_mut().zip(color) {
        *channel = byte((color * opacity + f32::from(*channel) / 255.0 * below) / alpha);
    }
    pixel[3] = byte(alpha);
}

/// The share of a pixel on the near side of a straight border with this unit normal, `depth` pixels behind it.
fn share_inside(depth: f64, normal: DVec2) -> f64 {
    let (long, short) = (normal.abs().max_element(), normal.abs().min_element());
    let beyond = (long + short) * 0.5 - depth.abs();
    let outside = match beyond {
        ..=0.0 => 0.0,
        // A corner is cut off.
        beyond if beyond < short => beyond * beyond / (2.0 * long * short),
        beyond => (beyond - short * 0.5) / long,
    };
    if depth < 0.0 { outside } else { 1.0 - outside }
}

/// The share of a pixel that two lines cover, given each one's share and the direction away from it. Of lines on one side of the
/// pixel the larger share counts; those of lines on opposite sides add up.
fn united((one, from_one): (f32, Vec2), (other, from_other): (f32, Vec2)) -> f32 {
    if one == 0.0 || one == 1.0 || other == 1.0 {
        return one.max(other);
    }
    let apart = one + other - one * other;
    let (along, limit) = match from_one.dot(from_other) {
        along if along > 0.0 => (along, one.max(other)),
        along => (-along, (one + other).min(1.0)),
    };
    apart + (limit - apart) * along.min(1.0)
}

/// How much of each pixel a layer covers.
struct Cover {
    size: Size,
    shares: Vec<f32>,
    /// The direction away from the last line that covered a part of the pixel, a unit vector.
    directions: Vec<Vec2>,
    /// Rows with lines in them.
    is_used: Vec<bool>,
}

impl Cover {
    fn new(size: Size) -> Self {
        let (shares, directions) = (vec![0.0; size.pixel_count()], vec![Vec2::ZERO; size.pixel_count()]);
        Self { size, shares, directions, is_used: vec![false; size.height as usize] }
    }

    /// Raises each pixel's coverage to that of a line with round ends and a width at each, where that is more.
    fn line(&mut self, [a, b]: [DVec2; 2], widths_px: [f64; 2]) {
        let radii = widths_px.map(|width| width * 0.5);
        // Coverage ends half a pixel's diagonal beyond the line's border.
        let reach = radii[0].max(radii[1]) + FRAC_1_SQRT_2;
        let along = b - a;
        let across = along.perp().try_normalize().unwrap_or(DVec2::X);
        let squared = along.length_squared();
        let pixels = |low: f64, high: f64, side: u32| {
            let first = (low - 0.5).ceil().max(0.0) as usize;
            first..((high - 0.5).floor() + 1.0).clamp(0.0, f64::from(side)) as usize
        };
        for row in pixels(a.y.min(b.y) - reach, a.y.max(b.y) + reach, self.size.height) {
            let y = row as f64 + 0.5;
            // The stretch of the line that is close enough to this row.
            let at = |y: f64| if along.y == 0.0 { 0.0 } else { ((y - a.y) / along.y).clamp(0.0, 1.0) };
            let ends = match along.y == 0.0 {
                true => [a.x, b.x],
                false => [at(y - reach), at(y + reach)].map(|share| a.x + along.x * share),
            };
            for column in pixels(ends[0].min(ends[1]) - reach, ends[0].max(ends[1]) + reach, self.size.width) {
                let from_a = DVec2::new(column as f64 + 0.5, y) - a;
                let share = if squared > 0.0 { (from_a.dot(along) / squared).clamp(0.0, 1.0) } else { 0.0 };
                let from_line = from_a - along * share;
                let distance = from_line.length();
                if distance >= reach {
                    continue;
                }
                let direction = if distance > 0.0 { from_line / distance } else { across };
                let radius = radii[0] + (radii[1] - radii[0]) * share;
                let covered = share_inside(radius - distance, direction) - share_inside(-radius - distance, direction);
                let place = row * self.size.width as usize + column;
                let direction = direction.as_vec2();
                self.shares[place] = united((self.shares[place], self.directions[place]), (covered as f32, direction));
                self.directions[place] = direction;
            }
            self.is_used[row] = true;
        }
    }

    /// Lays the layer over the pixels, and empties it.
    fn blend_into(&mut self, pixels: &mut [u8], color: Color, opacity: impl Fn(usize) -> f32) {
        let width = self.size.width as usize;
        let rows = pixels.chunks_exact_mut(width * 4).zip(self.shares.chunks_exact_mut(width)).enumerate();
        for ((number, (row, shares)), _) in rows.zip(&mut self.is_used).filter(|(_, is_used)| **is_used) {
            for (column, (pixel, share)) in row.chunks_exact_mut(4).zip(shares).enumerate() {
                let share = std::mem::take(share);
                if share > 0.0 {
                    lay_over(pixel, color, share * opacity(number * width + column));
                }
            }
        }
        self.is_used.fill(false);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::edges::Class;
    use crate::lines::Layer;

    const SIZE: Size = Size { width: 40, height: 30 };

    fn covered(ends: [[f64; 2]; 2], width_px: f64) -> Vec<f32> {
        let mut cover = Cover::new(SIZE);
        cover.line(ends.map(DVec2::from_array), [width_px; 2]);
        cover.shares
    }

    #[test]
    fn a_line_covers_its_area_whatever_its_direction() {
        for ends in [[[10.0, 15.0], [30.0, 15.0]], [[20.0, 6.0], [20.0, 24.0]], [[9.0, 8.0], [29.0, 22.0]]] {
            for width_px in [1.0, 2.0, 5.0] {
                let length = DVec2::from_array(ends[0]).distance(DVec2::from_array(ends[1]));
                // The ends are half-disks.
                let area = length * width_px + std::f64::consts::PI * width_px * width_px / 4.0;
                let sum: f64 = covered(ends, width_px).iter().map(|cover| f64::from(*cover)).sum();
                assert!((sum / area - 1.0).abs() < 0.06, "{ends:?} {width_px}: {sum} {area}");
            }
        }
    }

    #[test]
    fn an_area_covers_what_it_has_of_each_pixel() {
        let area = |loops: &[&[[f64; 2]]]| {
            let loops: Vec<Vec<DVec2>> =
                loops.iter().map(|ring| ring.iter().map(|c| DVec2::from_array(*c)).collect()).collect();
            let mut pixels = vec![0; SIZE.pixel_count() * 4];
            lay_area(&loops, Color([0.0; 3]), SIZE, &mut pixels);
            pixels.chunks_exact(4).map(|pixel| f64::from(pixel[3]) / 255.0).collect::<Vec<_>>()
        };
        let slanted: &[[f64; 2]] = &[[3.2, 4.7], [30.4, 9.1], [21.0, 25.3]];
        let sum: f64 = area(&[slanted]).iter().sum();
        let exact = DVec2::new(27.2, 4.4).perp_dot(DVec2::new(17.8, 20.6)) * 0.5;
        assert!((sum - exact).abs() < 0.3, "{sum} {exact}");
        let square = area(&[&[[2.5, 3.25], [6.0, 3.25], [6.0, 8.0], [2.5, 8.0]]]);
        let at = |x: usize, y: usize| square[y * SIZE.width as usize + x];
        let near = |a: f64, b: f64| (a - b).abs() < 0.005;
        assert!(
            near(at(2, 5), 0.5) && near(at(4, 3), 0.75) && near(at(5, 7), 1.0) && at(6, 5) == 0.0 && at(4, 8) == 0.0
        );
        // A hole, and a part beyond the picture.
        let holed: f64 = area(&[
            &[[-9.0, -9.0], [99.0, -9.0], [99.0, 99.0], [-9.0, 99.0]],
            &[[5.0, 5.0], [5.0, 9.0], [9.0, 9.0], [9.0, 5.0]],
        ])
        .iter()
        .sum();
        assert!(near(holed, 40.0 * 30.0 - 16.0), "{holed}");
    }

    #[test]
    fn a_pixels_share_is_the_area_on_one_side_of_a_border() {
        let samples = |depth: f64, normal: DVec2| {
            let steps = 400;
            let at = |step: i32| (f64::from(step) + 0.5) / f64::from(steps) - 0.5;
            let inside = |x: i32, y: i32| DVec2::new(at(x), at(y)).dot(normal) < depth;
            let count = (0..steps * steps).filter(|place| inside(place % steps, place / steps)).count();
            count as f64 / f64::from(steps * steps)
        };
        for angle in [0.0, 10.0, 45.0, 80.0, 90.0, 200.0f64] {
            let normal = DVec2::from_angle(angle.to_radians());
            for depth in [-0.8, -0.6, -0.3, 0.0, 0.2, 0.55, 0.9] {
                let (share, area) = (share_inside(depth, normal), samples(depth, normal));
                assert!((share - area).abs() < 0.004, "{angle} {depth}: {share} {area}");
            }
        }
    }

    #[test]
    fn a_line_on_rows_of_pixels_covers_them_and_no_others() {
        let cover = covered([[10.0, 15.0], [30.0, 15.0]], 2.0);
        let at = |x: usize, y: usize| cover[y * SIZE.width as usize + x];
        assert_eq!([at(20, 13), at(20, 14), at(20, 15), at(20, 16)], [0.0, 1.0, 1.0, 0.0]);
        // Lines outside the picture have no effect.
        assert!(covered([[-50.0, -60.0], [-5.0, -9.0]], 3.0).iter().all(|cover| *cover == 0.0));
        assert_eq!(covered([[5.5, 5.5], [5.5, 5.5]], 1.0)[5 * 40 + 5], 1.0, "a point is a dot");
    }

    fn square(is_closed: bool) -> Strokes {
        let corners = [[10.0, 5.0], [30.0, 5.0], [30.0, 25.0], [10.0, 25.0]];
        Strokes {
            layer: Layer::Visible(Class::Crease),
            color: Color([0.0; 3]),
            width_px: 2.0,
            width_mm: None,
            opacity: 1.0,
            polylines: vec![Polyline { points_px: corners.map(DVec2::from_array).to_vec(), is_closed }],
            tips: Vec::new(),
        }
    }

    #[test]
    fn strokes_that_cross_or_close_do_not_add_up_and_opacity_is_the_layers() {
        let ink = |strokes: Strokes| raster_of_strokes(&[strokes], SIZE, Background::Transparent);
        let alphas = |raster: &Raster| raster.pixels.chunks_exact(4).map(|pixel| pixel[3]).collect::<Vec<_>>();
        let area = |raster: &Raster| alphas(raster).into_iter().map(|alpha| f64::from(alpha) / 255.0).sum::<f64>();
        let closed = ink(square(true));
        // 20 pixels of two, without the quarter discs and squares of the ends.
        let added = area(&closed) - area(&ink(square(false)));
        assert!((added - (40.0 - 2.0 * (1.0 + std::f64::consts::PI / 4.0))).abs() < 0.5, "{added}");
        let mut twice = square(true);
        twice.polylines.extend(square(true).polylines);
        assert_eq!(ink(twice.clone()), closed);
        let faint = ink(Strokes { opacity: 0.3, ..twice });
        assert_eq!(alphas(&faint).into_iter().max(), Some(77));
    }

    #[test]
    fn a_colour_lies_over_another_and_over_nothing() {
        let red = Color([1.0, 0.0, 0.0]);
        let mut white = [255; 4];
        lay_over(&mut white, red, 0.5);
        assert_eq!(white, [255, 128, 128, 255]);
        let mut nothing = [0; 4];
        lay_over(&mut nothing, red, 0.25);
        assert_eq!(nothing, [255, 0, 0, 64]);
    }
}
