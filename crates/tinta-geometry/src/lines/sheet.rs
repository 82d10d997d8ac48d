//! A sheet of views: front, top, side and isometric, to one scale, with a scale bar.
//!
//! Input: a scene, [`LineSettings`], a [`ProjectionAngle`]. Output: the [`VisibleLines`] of all views on one picture of the scene's
//! size, which all writers take like those of one view.

use crate::camera::CameraSettings;
use crate::edges::Class;
use crate::error::{Error, Result};
use crate::lines::drawing::page::PageSize;
use crate::lines::drawing::scale::Scale;
use crate::lines::drawing::scale::round_below;
use crate::lines::drawing::settings::DrawingSettings;
use crate::lines::sheet_text::{strokes, width_of};
use crate::lines::{Label, LineSegment, LineSettings, PartStyle, Progress, VisibleLines};
use crate::mesh::NONE;
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

/// Height of the strip that holds the scale bar, likewise, also with a title block, and half the height of the bar's ends.
const STRIP: f64 = 0.08;
const STRIP_OF_BLOCK: f64 = 0.12;
const TICK: f64 = 0.01;

/// Height of the numbers, and of the views' names, likewise.
const DIGIT: f64 = 0.03;
pub(super) const NAME: f64 = 0.018;

/// Distance of the frame from the sheet's edge, likewise.
const FRAME: f64 = 0.025;

/// The least scale of the isometric view, as a share of the others'.
const ISO: f64 = 0.5;

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

impl View {
    /// Whether it is the view in space, which has a scale of its own.
    fn is_iso(&self) -> bool {
        self.column == 1 && !self.is_in_front_row
    }
}

impl VisibleLines {
    /// Finds the lines of a scene in the views of a sheet, in place of those of its camera; with a title they have a frame and a title
    /// block.
    ///
    /// # Errors
    ///
    /// Those of [`VisibleLines::with_progress`], and [`Error::Setting`] for a sheet too small for four views, and for a title that does not
    /// fit its field.
    pub fn on_sheet(
        scene: &Scene,
        settings: &LineSettings,
        (angle, drawing, title): (ProjectionAngle, &DrawingSettings, Option<&str>),
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
        let scene = &Scene { size: on_paper(scene.size, drawing), ..scene.clone() };
        let layout = Layout::new(&views, scene.size, angle, title.map(|_| drawing))?;
        let title = title.map(|title| layout.lettered(title)).transpose()?;
        let settings = LineSettings { counts_changes: false, ..settings.clone() };
        let mut sheet = Self::none(scene.size);
        for view in &views {
            let px_per_unit = layout.px_per_unit(view);
            let px = (view.extent * px_per_unit + 2.0 * PAD_PX).ceil();
            let size = Size { width: px.x as u32, height: px.y as u32 };
            let camera = CameraSettings { height: Some(px.y / px_per_unit), ..view.settings.clone() };
            let camera = camera.fit(scene.centre, scene.radius, size.aspect(), corners.iter().copied())?;
            let seen = Scene { camera, size, ..scene.clone() };
            let lines = Self::with_progress(&seen, &settings, progress)?;
            sheet.put(lines, layout.middle_px(view) - px * 0.5);
        }
        // Labels and scale bars have a layer.
        sheet.looks.resize_with(sheet.looks.len().max(1), PartStyle::default);
        sheet.looks.push(PartStyle { name: "sheet".to_owned(), is_of_sheet: true, ..PartStyle::default() });
        sheet.put_names(&layout, &views);
        let right_px = sheet.put_bar(&layout, &drawing.units.text(), scene.size);
        if title.is_some() {
            sheet.put_strokes(rectangle(layout.frame()));
        }
        let scale = sheet.put_scale(&layout, drawing)?.map(|scale| format!("SCALE {scale}"));
        let digit = DIGIT * layout.side;
        match title {
            Some(title) => sheet.put_block(&layout, (angle, drawing), &title, scale.as_deref()),
            None => {
                let right = layout.origin_px.x + layout.views_px().x;
                sheet.put_symbol(DVec2::new(right, layout.text_px + 0.5 * digit), digit, angle);
                sheet.put_strokes(strokes(&scale.unwrap_or_default(), DVec2::new(right_px, layout.text_px), digit));
            }
        }
        Ok(sheet)
    }

    /// Adds the name of each view below it.
    fn put_names(&mut self, layout: &Layout, views: &[View]) {
        let height = NAME * layout.side;
        for view in views {
            let px_per_unit = layout.px_per_unit(view);
            let note = if px_per_unit < layout.px_per_unit { ", NOT TO SCALE" } else { "" };
            let name = view.name.to_uppercase() + note;
            let below = DVec2::Y * (view.extent.y * 0.5 * px_per_unit + height);
            let left = DVec2::X * (width_of(&name) * 0.5 * height);
            self.put_strokes(strokes(&name, layout.middle_px(view) + below - left, height));
        }
    }

    /// Puts the sheet to the scale of its settings, or on paper to the largest round one that fits, and returns it.
    fn put_scale(&mut self, layout: &Layout, drawing: &DrawingSettings) -> Result<Option<String>> {
        let known = drawing.scale.or(layout.scale);
        let scale = known.or_else(|| self.largest_scale(layout.px_per_unit, drawing).map(Scale::rounded));
        let to_scale = DrawingSettings { scale, ..drawing.clone() };
        self.put_to_scale(Some(layout.px_per_unit), &to_scale)?;
        Ok(scale.map(|scale| scale.text()))
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
        let from = DVec2::new(layout.bar_px, layout.text_px + 0.5 * digit);
        let to = from + DVec2::X * (length * layout.px_per_unit);
        let tick = DVec2::Y * (TICK * side);
        self.put_strokes(vec![[from - tick, from + tick], [from, to], [to - tick, to + tick]]);
        let text = format!("{length} {unit}");
        let left = to.x + 0.5 * digit;
        self.put_strokes(strokes(&text, DVec2::new(left, layout.text_px), digit));
        left + (width_of(&text) + 1.5) * digit
    }

    /// Adds the symbol of the projection, with the middle of its right side here: a cut cone and its view from the left, which lies on
    /// the right in first angle and on the left in third (ISO 5456-2).
    pub(super) fn put_symbol(&mut self, DVec2 { x: right, y: middle }: DVec2, unit: f64, angle: ProjectionAngle) {
        let centres = [right - 3.4 * unit, right - 0.8 * unit];
        let [cone, rings] = match angle {
            ProjectionAngle::First => centres,
            ProjectionAngle::Third => [centres[1], centres[0]],
        };
        let at = |x: f64, y: f64| DVec2::new(cone + x * unit, middle + y * unit);
        self.put_strokes(closed([at(-0.7, -0.4), at(0.7, -0.8), at(0.7, 0.8), at(-0.7, 0.4)]));
        for radius in [0.4, 0.8] {
            let on = |k: u32| {
                DVec2::new(rings, middle) + DVec2::from_angle(f64::from(k) * TAU / f64::from(SIDES)) * (radius * unit)
            };
            self.put_strokes((0..SIDES).map(|k| [on(k), on(k + 1)]).collect());
        }
    }

    pub(super) fn put_strokes(&mut self, strokes: Vec<[DVec2; 2]>) {
        let look = self.looks.len() as u32 - 1;
        let stroke = |ends| LineSegment { look, part: NONE, ..LineSegment::new(Class::Curve, ends, [DVec3::ZERO; 2]) };
        self.segments.extend(strokes.into_iter().map(stroke));
    }
}

/// The sides of a quadrilateral.
fn closed(corners: [DVec2; 4]) -> Vec<[DVec2; 2]> {
    (0..4).map(|k| [corners[k], corners[(k + 1) % 4]]).collect()
}

/// The sides of a rectangle between two corners.
pub(super) fn rectangle([low, high]: [DVec2; 2]) -> Vec<[DVec2; 2]> {
    closed([low, DVec2::new(high.x, low.y), high, DVec2::new(low.x, high.y)])
}

/// The places of the views on a sheet.
pub(super) struct Layout {
    /// The scale of a drawing whose frame fills its paper.
    scale: Option<Scale>,
    px_per_unit: f64,
    /// The same of the isometric view.
    iso_px_per_unit: f64,
    /// The sheet, its shorter side, and the top of the text in the strip, pixels.
    pub(super) sheet_px: DVec2,
    pub(super) side: f64,
    text_px: f64,
    /// The upper left corner of all views, and the left end of the scale bar.
    origin_px: DVec2,
    bar_px: f64,
    /// Widths of both columns, and heights of both rows from the top, pixels.
    columns: [f64; 2],
    rows: [f64; 2],
    /// Which row holds the front view.
    front_row: usize,
}

impl Layout {
    fn new(views: &[View], size: Size, angle: ProjectionAngle, of_block: Option<&DrawingSettings>) -> Result<Self> {
        let front_row = usize::from(angle == ProjectionAngle::Third);
        let sheet_px = DVec2::new(f64::from(size.width), f64::from(size.height));
        let side = sheet_px.min_element();
        let strip = if of_block.is_some() { STRIP_OF_BLOCK } else { STRIP };
        let room = sheet_px - DVec2::splat((2.0 * BORDER + GAP) * side) - DVec2::Y * (strip * side);
        if room.min_element() < LEAST_PX {
            let problem = format!("four views do not fit a sheet of {size}; give a larger --size");
            return Err(Error::setting("sheet", problem));
        }
        let row_of = |view: &View| if view.is_in_front_row { front_row } else { 1 - front_row };
        let cells = |iso: f64| {
            let (mut columns, mut rows) = ([0.0_f64; 2], [0.0_f64; 2]);
            for view in views {
                let extent = if view.is_iso() { view.extent * iso } else { view.extent };
                columns[view.column] = columns[view.column].max(extent.x);
                rows[row_of(view)] = rows[row_of(view)].max(extent.y);
            }
            (columns, rows)
        };
        let px_per_unit = |(columns, rows): ([f64; 2], [f64; 2])| {
            (room / DVec2::new(columns.iter().sum(), rows.iter().sum())).min_element()
        };
        let largest = px_per_unit(cells(ISO));
        let frame = sheet_px - 2.0 * FRAME * side;
        let round = of_block.and_then(|drawing| on_round_scale(largest, frame, drawing));
        let (round, scale) = round.map_or((None, largest), |(round, scale)| (Some(round), scale));
        // The isometric view takes what the others leave.
        let (columns, rows) = cells(0.0);
        let left = room / scale - DVec2::new(columns[0], rows[front_row]);
        let fitting = views.iter().filter(|view| view.is_iso()).map(|view| (left / view.extent).min_element());
        let iso = fitting.fold(1.0, f64::min).max(ISO);
        let (columns, rows) = cells(iso);
        let [columns, rows] = [columns, rows].map(|lengths| lengths.map(|length| length * scale));
        let origin_px =
            DVec2::splat(BORDER * side) + (room - DVec2::new(columns.iter().sum(), rows.iter().sum())) * 0.5;
        // At the strip's lower edge, below the names of the views.
        let text_px = sheet_px.y - (BORDER + DIGIT) * side;
        let bar_px = if of_block.is_some() { BORDER * side } else { origin_px.x };
        Ok(Self {
            scale: round,
            px_per_unit: scale,
            iso_px_per_unit: iso * scale,
            sheet_px,
            side,
            text_px,
            origin_px,
            bar_px,
            columns,
            rows,
            front_row,
        })
    }

    /// Pixels of a unit in a view.
    fn px_per_unit(&self, view: &View) -> f64 {
        if view.is_iso() { self.iso_px_per_unit } else { self.px_per_unit }
    }

    /// The frame's upper left and lower right corner, pixels.
    pub(super) fn frame(&self) -> [DVec2; 2] {
        let edge = DVec2::splat(FRAME * self.side);
        [edge, self.sheet_px - edge]
    }

    /// Width and height of all views together, pixels.
    fn views_px(&self) -> DVec2 {
        DVec2::new(self.columns.iter().sum(), self.rows.iter().sum()) + GAP * self.side
    }

    /// The middle of a view, pixels.
    fn middle_px(&self, view: &View) -> DVec2 {
        let row = if view.is_in_front_row { self.front_row } else { 1 - self.front_row };
        let middle = |number: usize, lengths: [f64; 2]| match number {
            0 => lengths[0] * 0.5,
            _ => lengths[0] + lengths[1] * 0.5 + GAP * self.side,
        };
        self.origin_px + DVec2::new(middle(view.column, self.columns), middle(row, self.rows))
    }
}

/// A sheet's size in pixels, of a shape whose frame fills its paper up to the margins, if it has one.
fn on_paper(size: Size, drawing: &DrawingSettings) -> Size {
    let PageSize::Paper(paper) = drawing.page_size else { return size };
    let width = f64::from(size.width);
    let [across, down] =
        paper.sides_mm(DVec2::new(width, f64::from(size.height))).map(|side| side - 2.0 * drawing.margin.0);
    let (shape, edges) = (across / down, 2.0 * FRAME);
    let height = match shape > 1.0 {
        true => width / (shape * (1.0 - edges) + edges),
        false => width * ((1.0 - edges) / shape + edges),
    };
    Size { height: height.round() as u32, ..size }
}

/// The scale of a drawing whose frame fills its paper, the given one or the largest round one, and the pixels of a unit; `None` without
/// paper, and for a scale at which the views do not fit.
fn on_round_scale(largest: f64, frame_px: DVec2, drawing: &DrawingSettings) -> Option<(Scale, f64)> {
    let PageSize::Paper(paper) = drawing.page_size else { return None };
    let room_mm = DVec2::from(paper.sides_mm(frame_px)) - 2.0 * drawing.margin.0;
    let fitting = Scale::of_pixels(largest, (frame_px / room_mm).max_element(), drawing.units);
    let scale = drawing.scale.unwrap_or_else(|| fitting.rounded());
    (scale.0 <= fitting.0).then_some((scale, largest * (scale.0 / fitting.0)))
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
            (angle, &DrawingSettings::default(), None),
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
        let layout = Layout::new(&views, scene.size, angle, None).unwrap();
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
                    let is_there = |k: &usize| {
                        (layout.middle_px(&views[*k]) + flat[*k] * layout.px_per_unit(&views[*k])).distance(px) < 1e-6
                    };
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
        let names: usize = views
            .iter()
            .map(|view| match layout.px_per_unit(view) < layout.px_per_unit {
                true => strokes("ISO, NOT TO SCALE", DVec2::ZERO, 1.0).len(),
                false => strokes(&view.name.to_uppercase(), DVec2::ZERO, 1.0).len(),
            })
            .sum();
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
    fn the_isometric_view_takes_all_that_the_others_leave() {
        for angle in ProjectionAngle::ALL.map(|(_, angle)| angle) {
            let (_, layout, views, _) = found(angle);
            let (iso, side) = (layout.px_per_unit(&views[3]), layout.side);
            let borders = DVec2::splat(2.0 * BORDER * side) + DVec2::Y * (STRIP * side);
            let left = layout.sheet_px - borders - layout.views_px();
            assert!(left.min_element() > -1e-9 && iso <= layout.px_per_unit && iso >= ISO * layout.px_per_unit);
            let cell = DVec2::new(layout.columns[1], layout.rows[1 - layout.front_row]) + left;
            let is_too_large = (views[3].extent * (iso * 1.001)).cmpgt(cell).any();
            assert!(is_too_large || iso == layout.px_per_unit, "{angle}: {iso} of {}", layout.px_per_unit);
        }
    }

    #[test]
    fn a_title_is_refused_before_any_line_is_found() {
        let progress = Progress::default();
        progress.cancel();
        let drawing = DrawingSettings::default();
        for (title, problem) in [("Größe", "no sign 'Ö'"), (&*"long ".repeat(30), "too long"), ("A", "cancelled")] {
            let asked = (ProjectionAngle::First, &drawing, Some(title));
            let scene = scene(Size { width: 900, height: 600 });
            let refused = VisibleLines::on_sheet(&scene, &LineSettings::default(), asked, &progress).unwrap_err();
            assert!(refused.to_string().contains(problem), "{title}: {refused}");
        }
    }

    #[test]
    fn a_sheet_without_room_is_refused() {
        let scene = scene(Size { width: 300, height: 30 });
        let refused = VisibleLines::on_sheet(
            &scene,
            &LineSettings::default(),
            (ProjectionAngle::First, &DrawingSettings::default(), None),
            &Progress::default(),
        );
        assert!(refused.unwrap_err().to_string().contains("larger --size"));
    }
}
