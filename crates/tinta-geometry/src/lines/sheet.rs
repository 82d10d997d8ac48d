//! A sheet of views: front, top, side and isometric, to one scale, with a scale bar.
//!
//! Input: a scene, [`LineSettings`], a [`ProjectionAngle`]. Output: the [`VisibleLines`] of all views on one picture of the scene's
//! size, which all writers take like those of one view.

use crate::camera::CameraSettings;
use crate::edges::Class;
use crate::error::{Error, Result};
use crate::lines::{Label, LineSegment, LineSettings, Progress, VisibleLines};
use crate::scene::{Scene, Size};
use glam::{BVec3, DMat3, DVec2, DVec3};

crate::choices! {
    /// Where the other views lie around the front view (ISO 5456-2).
    pub enum ProjectionAngle {
        /// The view from above lies above the front view, that from the right on its right.
        Third = "third",
        /// The view from above lies below the front view, that from the left on its right.
        First = "first",
    }
}

/// The views of a sheet, each with its column, 0 or 1, and whether it lies in the front view's row.
type Views = [(&'static str, usize, bool); 4];

impl ProjectionAngle {
    fn views(self) -> Views {
        let side = match self {
            Self::Third => "right",
            Self::First => "left",
        };
        [("front", 0, true), ("top", 0, false), (side, 1, true), ("iso", 1, false)]
    }
}

/// Free border and gap between views, as shares of the sheet's shorter side.
const BORDER: f64 = 0.05;
const GAP: f64 = 0.08;

/// Height of the strip that holds the scale bar, likewise, and half the height of the bar's ends.
const STRIP: f64 = 0.08;
const TICK: f64 = 0.01;

/// Height of its number, likewise.
const DIGIT: f64 = 0.03;

/// Most of the sheet's width that the scale bar takes.
const BAR: f64 = 0.2;

/// Pixels around a view that its own picture holds, for lines on its border.
const PAD_PX: f64 = 8.0;

/// Least room for the views, pixels.
const LEAST_PX: f64 = 32.0;

/// A view before its lines are found.
struct View {
    settings: CameraSettings,
    /// Width and height of the scene in it, file units.
    extent: DVec2,
    column: usize,
    is_in_front_row: bool,
}

impl VisibleLines {
    /// Finds the lines of a scene in the views of a sheet, in place of those of its camera.
    ///
    /// # Errors
    ///
    /// Those of [`VisibleLines::with_progress`], and [`Error::Setting`] for a sheet too small for four views.
    pub fn on_sheet(
        scene: &Scene,
        settings: &LineSettings,
        angle: ProjectionAngle,
        progress: &Progress,
    ) -> Result<Self> {
        let corners = corners(scene);
        let (low, high) = crate::mesh::bounds(&corners);
        let centre = (low + high) * 0.5;
        let mut views = Vec::new();
        for (name, column, is_in_front_row) in angle.views() {
            let settings = CameraSettings {
                view: name.parse().map_err(|problem| Error::value("sheet", name, problem))?,
                parallel: true,
                target: Some(centre),
                ..CameraSettings::default()
            };
            let camera = settings.fit(scene.centre, scene.radius, 1.0, corners.iter().copied())?;
            let axes = DMat3::from_mat4(camera.view_from_world());
            let reach = corners.iter().map(|corner| (axes * (*corner - centre)).truncate().abs());
            let extent = 2.0 * reach.fold(DVec2::ZERO, DVec2::max);
            views.push(View { settings, extent, column, is_in_front_row });
        }
        let layout = Layout::new(&views, scene, angle)?;
        let settings = LineSettings { counts_changes: false, ..settings.clone() };
        let mut sheet = Self::none(scene.size);
        for view in &views {
            let px = (view.extent * layout.px_per_unit + 2.0 * PAD_PX).ceil();
            let size = Size { width: px.x as u32, height: px.y as u32 };
            let camera = CameraSettings { height: Some(px.y / layout.px_per_unit), ..view.settings.clone() };
            let camera = camera.fit(scene.centre, scene.radius, size.aspect(), corners.iter().copied())?;
            let seen = Scene { camera, size, ..scene.clone() };
            let lines = Self::with_progress(&seen, &settings, progress)?;
            sheet.put(lines, layout.middle_px(view) - px * 0.5);
        }
        sheet.put_bar(&layout, scene.size);
        Ok(sheet)
    }

    /// Adds the lines of a view, moved to its place. All views of a sheet have the same parts.
    pub fn put(&mut self, view: Self, to_px: DVec2) {
        let moved = |segment: LineSegment| LineSegment { ends_px: segment.ends_px.map(|end| end + to_px), ..segment };
        self.segments.extend(view.segments.into_iter().map(moved));
        self.labels.extend(view.labels.into_iter().map(|label| Label { px: label.px + to_px, ..label }));
        (self.parts, self.looks) = (view.parts, view.looks);
        let mut edges = view.edges;
        Class::ALL.into_iter().for_each(|(_, class)| *self.edges.of(class) += *edges.of(class));
        self.covered_triangles = view.covered_triangles;
        self.times.topology_ms += view.times.topology_ms;
        self.times.silhouette_ms += view.times.silhouette_ms;
        self.times.visibility_ms += view.times.visibility_ms;
        self.times.compared += view.times.compared;
    }

    /// Adds the scale bar, with its length in the model's units in strokes, which a pen and a picture of pixels draw too.
    fn put_bar(&mut self, layout: &Layout, size: Size) {
        let side = f64::from(size.width.min(size.height));
        let length = round_below(BAR * f64::from(size.width) / layout.px_per_unit);
        let from = DVec2::new(layout.origin_px.x, f64::from(size.height) - (BORDER + STRIP * 0.5) * side);
        let to = from + DVec2::X * (length * layout.px_per_unit);
        let tick = DVec2::Y * (TICK * side);
        let text = strokes(&length.to_string(), to + DVec2::new(0.5, -0.5) * (DIGIT * side), DIGIT * side);
        for ends_px in [[from - tick, from + tick], [from, to], [to - tick, to + tick]].into_iter().chain(text) {
            self.segments.push(LineSegment::new(Class::Curve, ends_px, [DVec3::ZERO; 2]));
        }
    }
}

/// Returns a number in strokes, from its upper left corner: digits of two squares, one above the other.
fn strokes(number: &str, from: DVec2, height: f64) -> Vec<[DVec2; 2]> {
    /// The corners of each digit's one line: x in halves of the height, y from the top in tenths of it.
    const DIGITS: [&[[i8; 2]]; 10] = [
        &[[0, 0], [1, 0], [1, 10], [0, 10], [0, 0]],
        &[[0, 2], [1, 0], [1, 10]],
        &[[0, 0], [1, 0], [1, 5], [0, 5], [0, 10], [1, 10]],
        &[[0, 0], [1, 0], [1, 5], [0, 5], [1, 5], [1, 10], [0, 10]],
        &[[0, 0], [0, 5], [1, 5], [1, 0], [1, 10]],
        &[[1, 0], [0, 0], [0, 5], [1, 5], [1, 10], [0, 10]],
        &[[1, 0], [0, 0], [0, 10], [1, 10], [1, 5], [0, 5]],
        &[[0, 0], [1, 0], [1, 10]],
        &[[0, 5], [0, 0], [1, 0], [1, 10], [0, 10], [0, 5], [1, 5]],
        &[[1, 5], [0, 5], [0, 0], [1, 0], [1, 10], [0, 10]],
    ];
    const POINT: &[[i8; 2]] = &[[0, 9], [0, 10]];
    let mut left = 0.0;
    let mut all = Vec::new();
    for sign in number.chars() {
        // The number is written without an exponent.
        let digit = sign.to_digit(10).map(|digit| DIGITS[digit as usize]);
        let at = |[x, y]: [i8; 2]| from + DVec2::new(left + f64::from(x) * 0.5, f64::from(y) * 0.1) * height;
        all.extend(digit.unwrap_or(POINT).windows(2).map(|ends| [at(ends[0]), at(ends[1])]));
        left += if digit.is_some() { 0.75 } else { 0.25 };
    }
    all
}

/// The places of the views on a sheet.
struct Layout {
    px_per_unit: f64,
    /// The upper left corner of all views.
    origin_px: DVec2,
    gap_px: f64,
    /// Widths of both columns, and heights of both rows from the top, file units.
    columns: [f64; 2],
    rows: [f64; 2],
    /// Which row holds the front view.
    front_row: usize,
}

impl Layout {
    fn new(views: &[View], scene: &Scene, angle: ProjectionAngle) -> Result<Self> {
        let front_row = usize::from(angle == ProjectionAngle::Third);
        let (mut columns, mut rows) = ([0.0_f64; 2], [0.0_f64; 2]);
        for view in views {
            let row = if view.is_in_front_row { front_row } else { 1 - front_row };
            columns[view.column] = columns[view.column].max(view.extent.x);
            rows[row] = rows[row].max(view.extent.y);
        }
        let sheet = DVec2::new(f64::from(scene.size.width), f64::from(scene.size.height));
        let side = sheet.min_element();
        let gap_px = GAP * side;
        let room = sheet - DVec2::splat(2.0 * BORDER * side + gap_px) - DVec2::Y * (STRIP * side);
        if room.min_element() < LEAST_PX {
            let problem = format!("four views do not fit a sheet of {}; give a larger --size", scene.size);
            return Err(Error::setting("sheet", problem));
        }
        let units = DVec2::new(columns[0] + columns[1], rows[0] + rows[1]);
        let px_per_unit = (room / units).min_element();
        let origin_px = DVec2::splat(BORDER * side) + (room - units * px_per_unit) * 0.5;
        Ok(Self { px_per_unit, origin_px, gap_px, columns, rows, front_row })
    }

    /// The middle of a view, pixels.
    fn middle_px(&self, view: &View) -> DVec2 {
        let row = if view.is_in_front_row { self.front_row } else { 1 - self.front_row };
        let middle = |number: usize, lengths: [f64; 2]| match number {
            0 => lengths[0] * 0.5 * self.px_per_unit,
            _ => (lengths[0] + lengths[1] * 0.5) * self.px_per_unit + self.gap_px,
        };
        self.origin_px + DVec2::new(middle(view.column, self.columns), middle(row, self.rows))
    }
}

/// The corners of the boxes around all objects.
fn corners(scene: &Scene) -> Vec<DVec3> {
    let mut corners = Vec::with_capacity(8 * scene.objects.len());
    for object in &scene.objects {
        let (low, high) = object.mesh.extent();
        for k in 0..8 {
            let is_high = BVec3::new(k & 1 > 0, k & 2 > 0, k & 4 > 0);
            corners.push(DVec3::select(is_high, high, low) + object.offset);
        }
    }
    corners
}

/// The largest of 1, 2 and 5 times a power of ten that is no larger than a number above 0.
fn round_below(number: f64) -> f64 {
    let power = 10_f64.powf(number.log10().floor());
    let digit = [5.0, 2.0].into_iter().find(|digit| digit * power <= number).unwrap_or(1.0);
    // In decimal, so that it is written with few digits.
    format!("{digit}e{}", power.log10().round()).parse().unwrap_or(number)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::SceneSettings;
    use std::sync::Arc;

    fn scene(size: Size) -> Scene {
        let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../models/ant.obj");
        let mesh = crate::mesh::load(path, &Default::default()).unwrap().mesh;
        Scene::new([Arc::new(mesh)], &SceneSettings { size, ..SceneSettings::default() }).unwrap()
    }

    fn found(angle: ProjectionAngle) -> (VisibleLines, Layout, Vec<View>, Scene) {
        let scene = scene(Size { width: 900, height: 600 });
        let lines = VisibleLines::on_sheet(&scene, &LineSettings::default(), angle, &Progress::default()).unwrap();
        let view = |(name, column, is_in_front_row): (&str, usize, bool)| {
            let corners = corners(&scene);
            let settings = CameraSettings { view: name.parse().unwrap(), parallel: true, ..CameraSettings::default() };
            let camera = settings.fit(scene.centre, scene.radius, 1.0, corners.iter().copied()).unwrap();
            let (low, high) = crate::mesh::bounds(&corners);
            let axes = DMat3::from_mat4(camera.view_from_world());
            let reach = corners.iter().map(|corner| (axes * (*corner - (low + high) * 0.5)).truncate().abs());
            View { settings, extent: 2.0 * reach.fold(DVec2::ZERO, DVec2::max), column, is_in_front_row }
        };
        let views: Vec<View> = angle.views().into_iter().map(view).collect();
        let layout = Layout::new(&views, &scene, angle).unwrap();
        (lines, layout, views, scene)
    }

    #[test]
    fn every_point_lies_where_its_view_shows_it_to_one_scale() {
        for angle in ProjectionAngle::ALL.map(|(_, angle)| angle) {
            let (lines, layout, views, scene) = found(angle);
            lines.check().unwrap();
            let (low, high) = crate::mesh::bounds(&corners(&scene));
            let centre = (low + high) * 0.5;
            let mut counts = [0; 4];
            let of_views = |segment: &&LineSegment| segment.ends_world != [DVec3::ZERO; 2];
            for segment in lines.segments.iter().filter(of_views) {
                for (px, world) in segment.ends_px.into_iter().zip(segment.ends_world) {
                    let from = world - centre;
                    let side = if angle == ProjectionAngle::Third { -from.z } else { from.z };
                    let (half, third) = (0.5_f64.sqrt(), 6.0_f64.sqrt().recip());
                    let iso = DVec2::new((from.x - from.z) * half, -(2.0 * from.y - from.x - from.z) * third);
                    let flat =
                        [DVec2::new(from.x, -from.y), DVec2::new(from.x, from.z), DVec2::new(side, -from.y), iso];
                    let is_there =
                        |k: &usize| (layout.middle_px(&views[*k]) + flat[*k] * layout.px_per_unit).distance(px) < 1e-6;
                    let view = (0..4).find(is_there);
                    counts[view.unwrap_or_else(|| panic!("{angle}: {world} at {px}"))] += 1;
                }
            }
            assert!(counts.iter().all(|count| *count > 100), "{angle}: {counts:?}");
        }
    }

    #[test]
    fn the_scale_bar_has_the_length_it_says() {
        let (lines, layout, ..) = found(ProjectionAngle::Third);
        let bar = lines.segments.iter().position(|segment| segment.ends_world == [DVec3::ZERO; 2]).unwrap();
        let drawn: Vec<_> = lines.segments[bar..].iter().map(|segment| segment.ends_px).collect();
        let length = drawn[1][0].distance(drawn[1][1]) / layout.px_per_unit;
        let said = format!("{}", (length * 1e9).round() * 1e-9);
        let height = drawn[3..].iter().flatten().map(|end| end.y - drawn[3][0].y).fold(0.0, f64::max);
        assert!(height > 5.0);
        let corner = drawn[1][1] + DVec2::new(0.5, -0.5) * height;
        let expected = strokes(&said, corner, height);
        assert_eq!(expected.len(), drawn.len() - 3, "{said}");
        let ends = expected.iter().flatten().zip(drawn[3..].iter().flatten());
        assert!(ends.into_iter().all(|(expected, drawn)| expected.distance(*drawn) < 1e-6), "{said}");
        for (number, round) in [(7.3, 5.0), (4.99, 2.0), (1.0, 1.0), (0.034, 0.02), (99.0, 50.0), (1e-7, 1e-7)] {
            assert_eq!(round_below(number), round);
        }
    }

    #[test]
    fn a_sheet_without_room_is_refused() {
        let scene = scene(Size { width: 300, height: 30 });
        let refused =
            VisibleLines::on_sheet(&scene, &LineSettings::default(), ProjectionAngle::First, &Progress::default());
        assert!(refused.unwrap_err().to_string().contains("larger --size"));
    }
}
