//! Times that grow: a straight line through them, and a plot on logarithmic axes.

use plotters::prelude::*;
use std::path::Path;

/// Times over sizes, under a name.
pub struct Curve {
    /// The contestant's name.
    pub name: String,
    /// Size and milliseconds.
    pub points: Vec<(f64, f64)>,
}

impl Curve {
    /// The milliseconds that size 0 would take and those of each more, by least squares of relative errors: a straight line
    /// that is as true for the small sizes as for the large.
    pub fn line(&self) -> [f64; 2] {
        let sums = self.points.iter().fold([0.0; 5], |[w, x, y, xx, xy], (size, ms)| {
            let weight = 1.0 / (ms * ms);
            [w + weight, x + weight * size, y + weight * ms, xx + weight * size * size, xy + weight * size * ms]
        });
        let [w, x, y, xx, xy] = sums;
        let slope = (w * xy - x * y) / (w * xx - x * x);
        [(y - slope * x) / w, slope]
    }

    /// The worst relative deviation from that line.
    pub fn worst_miss(&self) -> f64 {
        let [start, slope] = self.line();
        self.points.iter().map(|(size, ms)| ((start + slope * size) / ms - 1.0).abs()).fold(0.0, f64::max)
    }
}

/// Draws the curves to an SVG file, under these words: a title, the axis of sizes, and the axis of times.
pub fn plot(curves: &[Curve], [title, sizes, times]: [&str; 3], path: &Path) -> Result<(), Box<dyn std::error::Error>> {
    // Twice as many curves have them once more, thinner.
    const COLORS: [RGBColor; 7] = [
        RGBColor(30, 90, 170),
        RGBColor(200, 60, 30),
        RGBColor(40, 130, 60),
        RGBColor(120, 120, 120),
        RGBColor(160, 110, 20),
        RGBColor(110, 60, 150),
        RGBColor(60, 160, 170),
    ];
    let range = |pick: fn(&(f64, f64)) -> f64, below: f64, above: f64| {
        let values = || curves.iter().flat_map(|curve| curve.points.iter().map(pick));
        values().fold(f64::INFINITY, f64::min) * below..values().fold(0.0, f64::max) * above
    };
    let area = SVGBackend::new(path, (760, 460)).into_drawing_area();
    area.fill(&WHITE)?;
    // With more curves than colours, each curve has its name at its end.
    let has_legend = curves.len() <= COLORS.len();
    let (beyond, above) = if has_legend { (1.25, 4.0) } else { (2.2, 1.7) };
    let (x, y) = (range(|point| point.0, 0.8, beyond), range(|point| point.1, 0.6, above));
    let mut chart = ChartBuilder::on(&area)
        .caption(title, ("sans-serif", 17))
        .margin(12)
        .x_label_area_size(44)
        .y_label_area_size(62)
        .build_cartesian_2d(x.log_scale(), y.log_scale())?;
    let short = |x: &f64| match *x {
        x if x >= 1e6 => format!("{} M", x / 1e6),
        x if x >= 1e3 => format!("{} k", x / 1e3),
        x => format!("{x}"),
    };
    chart
        .configure_mesh()
        .x_desc(sizes)
        .y_desc(times)
        .x_label_formatter(&short)
        .y_label_formatter(&|y| format!("{y}"))
        .light_line_style(RGBColor(240, 240, 240))
        .draw()?;
    for (number, curve) in curves.iter().enumerate() {
        let style = match number / COLORS.len() {
            0 => COLORS[number].stroke_width(2),
            _ => COLORS[number % COLORS.len()].mix(0.6).stroke_width(1),
        };
        chart
            .draw_series(LineSeries::new(curve.points.iter().copied(), style).point_size(3))?
            .label(&curve.name)
            .legend(move |(x, y)| PathElement::new([(x, y), (x + 22, y)], style));
    }
    if has_legend {
        chart
            .configure_series_labels()
            .position(SeriesLabelPosition::UpperLeft)
            .background_style(WHITE)
            .border_style(RGBColor(200, 200, 200))
            .draw()?;
    } else {
        let ends = curves.iter().filter_map(|curve| Some((curve.name.as_str(), curve.points.last()?)));
        let ends = ends.map(|(name, end)| (name, chart.plotting_area().map_coordinate(end))).collect();
        for (name, place) in apart(ends) {
            area.draw(&Text::new(name, place, ("sans-serif", 12)))?;
        }
    }
    area.present()?;
    Ok(())
}

/// Names beside the ends of their curves, pixels, moved down to avoid overlaps.
fn apart(mut ends: Vec<(&str, (i32, i32))>) -> Vec<(&str, (i32, i32))> {
    const ASIDE: i32 = 8;
    const UP: i32 = 6;
    const HEIGHT: i32 = 12;
    const WIDTH: i32 = 70;
    ends.sort_by_key(|(_, (_, y))| *y);
    let mut placed: Vec<(&str, (i32, i32))> = Vec::new();
    for (name, (x, y)) in ends {
        let (x, mut y) = (x + ASIDE, y - UP);
        for (_, (other_x, other_y)) in &placed {
            if (x - other_x).abs() < WIDTH && (*other_y..other_y + HEIGHT).contains(&y) {
                y = other_y + HEIGHT;
            }
        }
        placed.push((name, (x, y)));
    }
    placed
}
