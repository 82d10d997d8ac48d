//! The text of an SVG file: numbers, colours, and strings that XML allows.

use crate::lines::drawing::curves::Step;
use crate::scene::Color;
use glam::{DVec2, I64Vec2};

/// Decimals of a coordinate: a thousandth of a pixel.
const DECIMALS: u32 = 3;

/// A point in the steps of a file's coordinates.
pub(in crate::lines) fn in_steps(point_px: DVec2) -> I64Vec2 {
    (point_px * f64::from(10_u32.pow(DECIMALS))).round().as_i64vec2()
}

/// A number with at most `decimals` decimals, without trailing zeros, never `-0`.
pub(in crate::lines) fn decimal(value: f64, decimals: u32) -> String {
    let scale = 10_i64.pow(decimals);
    // Exact in f64 up to a picture's largest size and its decimals.
    let scaled = (value * scale as f64).round() as i64;
    let (whole, part) = (scaled.unsigned_abs() / scale as u64, scaled.unsigned_abs() % scale as u64);
    let sign = if scaled < 0 { "-" } else { "" };
    let text = format!("{sign}{whole}.{part:0width$}", width = decimals as usize);
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// A coordinate as text.
pub(in crate::lines) fn number(value: f64) -> String {
    decimal(value, DECIMALS)
}

/// The points of a polyline as text; equal neighbours are written once.
pub(in crate::lines) fn written_points(points_px: &[DVec2], is_closed: bool) -> Vec<[String; 2]> {
    let mut written: Vec<[String; 2]> = Vec::with_capacity(points_px.len());
    for (index, point) in points_px.iter().enumerate() {
        let text = point.to_array().map(number);
        let is_needed = index == points_px.len() - 1 && written.len() == 1 && !is_closed;
        if is_needed || written.last() != Some(&text) {
            written.push(text);
        }
    }
    written
}

/// A polyline as path data, with the points of [`written_points`].
pub(in crate::lines) fn path_data(points_px: &[DVec2], is_closed: bool) -> String {
    let mut data = String::new();
    for (index, [x, y]) in written_points(points_px, is_closed).iter().enumerate() {
        data.push_str(match index {
            0 => "M",
            1 => "L",
            _ => " ",
        });
        data.push_str(x);
        data.push(' ');
        data.push_str(y);
    }
    if is_closed {
        data.push('Z');
    }
    data
}

/// A point as text.
pub(in crate::lines) fn written_point(point_px: DVec2) -> [String; 2] {
    point_px.to_array().map(number)
}

/// A path of lines and curves as path data.
pub(in crate::lines) fn curve_data((first, steps): &(DVec2, Vec<Step>), is_closed: bool) -> String {
    let mut data = format!("M{}", written_point(*first).join(" "));
    for (index, step) in steps.iter().enumerate() {
        match step {
            // Closing the path draws it.
            Step::Line(to) if is_closed && index == steps.len() - 1 && to == first => {}
            Step::Line(to) => data.push_str(&format!("L{}", written_point(*to).join(" "))),
            Step::Curve(points) => {
                data.push('C');
                data.push_str(&points.map(|point| written_point(point).join(" ")).join(" "));
            }
        }
    }
    if is_closed {
        data.push('Z');
    }
    data
}

/// A colour as #rrggbb.
pub(in crate::lines) fn hexadecimal(Color(channels): Color) -> String {
    let [red, green, blue] = channels.map(|channel| (channel.clamp(0.0, 1.0) * 255.0).round() as u8);
    format!("#{red:02x}{green:02x}{blue:02x}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short_and_never_minus_zero() {
        let cases = [
            (0.0, "0"),
            (-0.0, "0"),
            (-0.0004, "0"),
            (-0.0006, "-0.001"),
            (1.0, "1"),
            (100.0, "100"),
            (12.3456, "12.346"),
            (0.1 + 0.2, "0.3"),
            (2.05, "2.05"),
            (4_294_967_295.0, "4294967295"),
        ];
        for (value, text) in cases {
            assert_eq!(number(value), text);
        }
        assert_eq!(decimal(512.0 / 96.0, 6), "5.333333");
    }

    #[test]
    fn paths_are_compact() {
        let points = [[1.0, 2.0], [3.0, 4.0], [3.0001, 4.0], [5.0, 6.0]].map(DVec2::from_array);
        assert_eq!(path_data(&points, true), "M1 2L3 4 5 6Z");
        let dot = [[1.0, 2.0], [1.0001, 2.0]].map(DVec2::from_array);
        assert_eq!(path_data(&dot, false), "M1 2L1 2");
    }

    #[test]
    fn curves_and_lines_follow_one_another() {
        let [a, b, c] = [[1.0, 2.0], [3.0, 4.0], [5.0, 6.25]].map(DVec2::from_array);
        let steps = vec![Step::Curve([b, b, c]), Step::Line(a)];
        assert_eq!(curve_data(&(a, steps.clone()), true), "M1 2C3 4 3 4 5 6.25Z");
        assert_eq!(curve_data(&(a, steps), false), "M1 2C3 4 3 4 5 6.25L1 2");
    }

    #[test]
    fn colours_are_six_digits() {
        assert_eq!(hexadecimal(Color([1.0, 0.5, 0.0])), "#ff8000");
    }
}
