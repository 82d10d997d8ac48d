//! Figure 13 as SVG: frames per second over triangles, both axes logarithmic, two curves a plot.

use super::numbers::Numbers;
use plotters::prelude::*;
use tinta::error::{Error, Result};

/// Width and height of a plot, its own units.
pub(crate) const PLOT_SIZE: (u32, u32) = (460, 380);

const TWO_PASSES: RGBColor = RGBColor(200, 60, 30);
const THREE_PASSES: RGBColor = RGBColor(30, 90, 170);

/// The plot of one number of tones, two and three passes.
///
/// # Errors
///
/// [`Error::Gl`] without measurements, or with a rate that is not finite.
pub fn plot(numbers: &Numbers, tones: u8) -> Result<String> {
    let rates = |passes| numbers.curve(tones, passes).map(|row| (row.triangles as f64, row.series.frames_per_second()));
    // All plots have the same axes for comparison.
    let all = || numbers.frames.iter().map(|row| (row.triangles as f64, row.series.frames_per_second()));
    let failed = |what: String| Error::gl("plotting figure 13", what);
    if all().next().is_none() || all().any(|(_, rate)| !rate.is_finite()) {
        return Err(failed("no times to plot".to_owned()));
    }
    let triangles: Vec<f64> = numbers.scenes.iter().map(|scene| scene.mix.triangles as f64).collect();
    let range = |values: &mut dyn Iterator<Item = f64>| {
        let (low, high) = values.fold((f64::INFINITY, 0.0f64), |(low, high), x| (low.min(x), high.max(x)));
        (low * 0.75)..(high * 1.35)
    };
    let (x, y) = (range(&mut all().map(|(x, _)| x)), range(&mut all().map(|(_, y)| y)));
    let mut text = String::new();
    {
        let area = SVGBackend::with_string(&mut text, PLOT_SIZE).into_drawing_area();
        draw(&area, [x, y], triangles, [rates(3).collect(), rates(2).collect()], tones)
            .map_err(|error| failed(error.to_string()))?;
    }
    Ok(text)
}

type Area<'a> = DrawingArea<SVGBackend<'a>, plotters::coord::Shift>;

fn draw(
    area: &Area<'_>,
    [x, y]: [std::ops::Range<f64>; 2],
    triangles: Vec<f64>,
    curves: [Vec<(f64, f64)>; 2],
    tones: u8,
) -> std::result::Result<(), Box<dyn std::error::Error>> {
    let font = |size: i32| ("sans-serif", size).into_font();
    area.fill(&WHITE)?;
    let mut chart = ChartBuilder::on(area)
        .caption(title(tones), font(20))
        .margin(12)
        .x_label_area_size(46)
        .y_label_area_size(58)
        .build_cartesian_2d(
            x.log_scale().with_key_points(triangles),
            y.clone().log_scale().with_key_points(ticks(&y)),
        )?;
    let thousands = |x: &f64| if *x < 1e4 { format!("{:.1} k", x / 1e3) } else { format!("{:.0} k", x / 1e3) };
    chart
        .configure_mesh()
        .x_desc("triangles")
        .y_desc("frames per second")
        .axis_desc_style(font(16))
        .label_style(font(14))
        .x_label_formatter(&thousands)
        .y_label_formatter(&|y| format!("{y}"))
        .x_labels(12)
        .y_labels(24)
        .light_line_style(RGBColor(238, 238, 238))
        .bold_line_style(RGBColor(215, 215, 215))
        .draw()?;
    for (points, color, name) in curves
        .into_iter()
        .zip([(THREE_PASSES, "three passes"), (TWO_PASSES, "two passes")])
        .map(|(p, (c, n))| (p, c, n))
    {
        let is_filled = color == THREE_PASSES;
        let mark = move |place: (f64, f64)| Circle::new(place, 4, mark_style(color, is_filled));
        chart
            .draw_series(LineSeries::new(points.iter().copied(), color.stroke_width(2)))?
            .label(name)
            .legend(move |(x, y)| PathElement::new([(x, y), (x + 22, y)], color.stroke_width(2)));
        chart.draw_series(points.into_iter().map(mark))?;
    }
    chart
        .configure_series_labels()
        .position(SeriesLabelPosition::LowerLeft)
        .label_font(font(15))
        .background_style(WHITE)
        .border_style(RGBColor(200, 200, 200))
        .draw()?;
    area.present()?;
    Ok(())
}

/// How many tones, in words.
pub fn title(tones: u8) -> &'static str {
    ["no tones", "one tone", "two tones", "three tones"][usize::from(tones.min(3))]
}

/// 1, 2 and 5 times the powers of ten within a range; plotters would draw those beyond it too.
fn ticks(range: &std::ops::Range<f64>) -> Vec<f64> {
    let all = (-3..7).flat_map(|power| [1.0, 2.0, 5.0].map(|digit| digit * 10f64.powi(power)));
    all.filter(|tick| range.contains(tick)).collect()
}

fn mark_style(color: RGBColor, is_filled: bool) -> ShapeStyle {
    if is_filled { color.filled() } else { color.stroke_width(2) }
}
