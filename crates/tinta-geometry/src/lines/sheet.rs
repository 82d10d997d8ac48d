//! A sheet of views: front, top, side and isometric, to one scale, with a scale bar.
//!
//! Input: a scene, [`LineSettings`], a [`ProjectionAngle`]. Output: the [`VisibleLines`] of all views on one picture of the scene's
//! size, which all writers take like those of one view.

use crate::camera::CameraSettings;
use crate::edges::Class;
use crate::error::{Error, Result};
use crate::lines::drawing::scale::round_below;
use crate::lines::drawing::settings::DrawingSettings;
use crate::lines::sheet_text::{strokes, width_of};
use crate::lines::{Label, LineSegment, LineSettings, PartStyle, Progress, VisibleLines};
use crate::scene::{Scene, Size};
use crate::settings::Value;
use glam::{BVec3, DMat3, DVec2, DVec3};
use std::f64::consts::TAU;

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

/// Height of the numbers, and of the views' names, likewise.
const DIGIT: f64 = 0.03;
const NAME: f64 = 0.018;

/// Sides of a ring in the symbol of the projection.
const SIDES: u32 = 48;

/// Most of the sheet's width that the scale bar takes.
const BAR: f64 = 0.2;

/// Pixels around a view that its own picture holds, for lines on its border.
const PAD_PX: f64 = 8.0;

/// Least room for the views, pixels.
const LEAST_PX: f64 = 32.0;

/// A view before its lines are found.
struct View {
    name: &'static str,
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
        (angle, drawing): (ProjectionAngle, &DrawingSettings),
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
            views.push(View { name, settings, extent, column, is_in_front_row });
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
        // Labels and scale bars have a layer.
        sheet.looks.resize_with(sheet.looks.len().max(1), PartStyle::default);
        sheet.looks.push(PartStyle { name: "sheet".to_owned(), ..PartStyle::default() });
        sheet.put_names(&layout, &views);
        let right_px = sheet.put_bar(&layout, &drawing.units.text(), scene.size);
        sheet.put_scale(&layout, right_px, drawing)?;
        sheet.put_symbol(&layout, angle);
        Ok(sheet)
    }

    /// Adds the name of each view below it.
    fn put_names(&mut self, layout: &Layout, views: &[View]) {
        let height = NAME * layout.side;
        for view in views {
            let name = view.name.to_uppercase();
            let below = DVec2::Y * (view.extent.y * 0.5 * layout.px_per_unit + height);
            let left = DVec2::X * (width_of(&name) * 0.5 * height);
            self.put_strokes(strokes(&name, layout.middle_px(view) + below - left, height));
        }
    }

    /// Puts the sheet to the scale of its settings, or on paper to the largest round one that fits, and writes it.
    fn put_scale(&mut self, layout: &Layout, left_px: f64, drawing: &DrawingSettings) -> Result<()> {
        let scale = drawing.scale.or_else(|| self.round_scale(layout.px_per_unit, drawing));
        let Some(scale) = scale else { return Ok(()) };
        let to_scale = DrawingSettings { scale: Some(scale), ..drawing.clone() };
        self.put_to_scale(Some(layout.px_per_unit), &to_scale)?;
        let text = format!("SCALE {}", scale.text());
        self.put_strokes(strokes(&text, DVec2::new(left_px, layout.text_px), DIGIT * layout.side));
        Ok(())
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

    /// Adds the scale bar with its length in the model's units, in strokes, which a pen and a picture of pixels draw too; returns
    /// where the next text begins.
    fn put_bar(&mut self, layout: &Layout, unit: &str, size: Size) -> f64 {
        let (side, digit) = (layout.side, DIGIT * layout.side);
        let length = round_below(BAR * f64::from(size.width) / layout.px_per_unit);
        let from = DVec2::new(layout.origin_px.x, layout.text_px + 0.5 * digit);
        let to = from + DVec2::X * (length * layout.px_per_unit);
        let tick = DVec2::Y * (TICK * side);
        self.put_strokes(vec![[from - tick, from + tick], [from, to], [to - tick, to + tick]]);
        let text = format!("{length} {unit}");
        let left = to.x + 0.5 * digit;
        self.put_strokes(strokes(&text, DVec2::new(left, layout.text_px), digit));
        left + (width_of(&text) + 1.5) * digit
    }

    /// Adds the symbol of the projection, at the right of the strip: a cut cone and its view from the left, which lies on the
    /// right in first angle and on the left in third (ISO 5456-2).
    fn put_symbol(&mut self, layout: &Layout, angle: ProjectionAngle) {
        let unit = DIGIT * layout.side;
        let right = layout.origin_px.x + layout.views_px().x;
        let middle = layout.text_px + 0.5 * unit;
        let centres = [right - 3.4 * unit, right - 0.8 * unit];
        let [cone, rings] = match angle {
            ProjectionAngle::First => centres,
            ProjectionAngle::Third => [centres[1], centres[0]],
        };
        let at = |x: f64, y: f64| DVec2::new(cone + x * unit, middle + y * unit);
        let corners = [at(-0.7, -0.4), at(0.7, -0.8), at(0.7, 0.8), at(-0.7, 0.4)];
        self.put_strokes((0..4).map(|k| [corners[k], corners[(k + 1) % 4]]).collect());
        for radius in [0.4, 0.8] {
            let on = |k: u32| {
                DVec2::new(rings, middle) + DVec2::from_angle(f64::from(k) * TAU / f64::from(SIDES)) * (radius * unit)
            };
            self.put_strokes((0..SIDES).map(|k| [on(k), on(k + 1)]).collect());
        }
    }

    fn put_strokes(&mut self, strokes: Vec<[DVec2; 2]>) {
        let look = self.looks.len() as u32 - 1;
        let stroke = |ends| LineSegment { look, ..LineSegment::new(Class::Curve, ends, [DVec3::ZERO; 2]) };
        self.segments.extend(strokes.into_iter().map(stroke));
    }
}

/// The places of the views on a sheet.
struct Layout {
    px_per_unit: f64,
    /// The sheet's shorter side, and the top of the text in the strip, pixels.
    side: f64,
    text_px: f64,
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
        // At the strip's lower edge, below the names of the views.
        let text_px = sheet.y - (BORDER + DIGIT) * side;
        Ok(Self { px_per_unit, side, text_px, origin_px, gap_px, columns, rows, front_row })
    }

    /// Width and height of all views together, pixels.
    fn views_px(&self) -> DVec2 {
        let units = DVec2::new(self.columns[0] + self.columns[1], self.rows[0] + self.rows[1]);
        units * self.px_per_unit + self.gap_px
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
        let lines = VisibleLines::on_sheet(
            &scene,
            &LineSettings::default(),
            (angle, &DrawingSettings::default()),
            &Progress::default(),
        )
        .unwrap();
        let view = |(name, column, is_in_front_row): (&'static str, usize, bool)| {
            let corners = corners(&scene);
            let settings = CameraSettings { view: name.parse().unwrap(), parallel: true, ..CameraSettings::default() };
            let camera = settings.fit(scene.centre, scene.radius, 1.0, corners.iter().copied()).unwrap();
            let (low, high) = crate::mesh::bounds(&corners);
            let axes = DMat3::from_mat4(camera.view_from_world());
            let reach = corners.iter().map(|corner| (axes * (*corner - (low + high) * 0.5)).truncate().abs());
            View { name, settings, extent: 2.0 * reach.fold(DVec2::ZERO, DVec2::max), column, is_in_front_row }
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
        let (lines, layout, views, _) = found(ProjectionAngle::Third);
        // The names of the views come first.
        let of_sheet = |segment: &LineSegment| segment.ends_world == [DVec3::ZERO; 2];
        let names: usize = views.iter().map(|view| strokes(&view.name.to_uppercase(), DVec2::ZERO, 1.0).len()).sum();
        let bar = lines.segments.iter().position(of_sheet).unwrap() + names;
        let drawn: Vec<_> = lines.segments[bar..].iter().map(|segment| segment.ends_px).collect();
        let length = drawn[1][0].distance(drawn[1][1]) / layout.px_per_unit;
        let said = format!("{}", (length * 1e9).round() * 1e-9);
        let height = DIGIT * layout.side;
        let corner = drawn[1][1] + DVec2::new(0.5, -0.5) * height;
        let expected = strokes(&format!("{said} mm"), corner, height);
        let ends = expected.iter().flatten().zip(drawn[3..].iter().flatten());
        assert!(ends.into_iter().all(|(expected, drawn)| expected.distance(*drawn) < 1e-6), "{said}");
    }

    #[test]
    fn a_sheet_without_room_is_refused() {
        let scene = scene(Size { width: 300, height: 30 });
        let refused = VisibleLines::on_sheet(
            &scene,
            &LineSettings::default(),
            (ProjectionAngle::First, &DrawingSettings::default()),
            &Progress::default(),
        );
        assert!(refused.unwrap_err().to_string().contains("larger --size"));
    }
}
