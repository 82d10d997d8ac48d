//! Several views on one page: lines and areas of each at its place, some seen through others, and keys to their colours.

use crate::lines::{Lines, format_named};
use crate::regions::Regions as ViewRegions;
use numpy::PyReadonlyArray2;
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict};
use std::sync::Arc;
use tinta::glam::DVec2;
use tinta::lines::{Areas, FillGroup, Key, KeyText, Region, Regions, Surface, painted};
use tinta::mesh::NONE;
use tinta::request::DrawnLines;
use tinta::styles::ViewAreas;
use tinta::{Color, Error, Size, VisibleLines};

/// One view.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub(crate) struct View<'py> {
    lines: Py<Lines>,
    /// Its areas, a colour for each, and their opacity.
    areas: Option<(Py<ViewRegions>, PyReadonlyArray2<'py, f64>, f32)>,
    /// Its upper left corner, pixels.
    at: [f64; 2],
    /// The number of each of its objects on the sheet; below 0: it is left out.
    objects: Vec<i64>,
}

/// A key: rectangles as left, top, right, bottom, red, green, blue; texts with their place, the share of the width that is to the left of
/// it, how far below it the base line lies in heights of letters, that height in those of labels, red, green, blue.
type GivenKey = (Vec<[f64; 7]>, Vec<(String, [f64; 8])>);

/// What a sheet takes of a view's areas.
struct Fills {
    areas: Arc<ViewAreas>,
    colors: Vec<Color>,
    opacity: f32,
    has_traps: bool,
}

/// Writes views as one file, with the settings of the first: `svg`, `pdf`, or `png` of lines alone.
#[pyfunction]
pub(crate) fn sheet<'py>(
    py: Python<'py>,
    format: &str,
    size: (u32, u32),
    views: Vec<View<'py>>,
    keys: Vec<GivenKey>,
    title: Option<String>,
) -> PyResult<Bound<'py, PyBytes>> {
    let taken = |view: &View<'_>| {
        let fills = view.areas.as_ref().map(|(regions, colors, opacity)| {
            let rows = colors.as_array();
            let color = |row: numpy::ndarray::ArrayView1<'_, f64>| Color([0, 1, 2].map(|part| row[part] as f32));
            let regions = regions.get();
            Fills {
                areas: regions.areas.clone(),
                colors: rows.rows().into_iter().map(color).collect(),
                opacity: *opacity,
                has_traps: !regions.is_alone,
            }
        });
        (view.lines.get().lines.clone(), fills, DVec2::from_array(view.at), view.objects.clone())
    };
    let all: Vec<_> = views.iter().map(taken).collect();
    let keys: Vec<Key> = keys.into_iter().map(key).collect();
    let put = move |drawn: &mut DrawnLines| {
        let mut sheet = VisibleLines::none(Size { width: size.0, height: size.1 });
        let mut areas = Areas { keys, ..Areas::default() };
        let is_one = all.len() == 1;
        for (number, (lines, fills, at, objects)) in all.iter().enumerate() {
            if !is_one && lines.looks.len() > 1 {
                return Err(Error::setting("part", "several views have one style for all parts; leave it out"));
            }
            let on_sheet = |object: u32| objects.get(object as usize).and_then(|object| u32::try_from(*object).ok());
            let mut lines = lines.without_specks(&drawn.resolved.contents.drawing)?;
            lines
                .segments
                .retain_mut(|segment| on_sheet(segment.object).map(|object| segment.object = object).is_some());
            sheet.put(lines, *at);
            if let Some(fills) = fills {
                fills.put(&mut areas, *at, on_sheet, if is_one { NONE } else { number as u32 });
            }
        }
        let regions = Regions { size: sheet.size, regions: Vec::new(), broken: 0 };
        (drawn.lines, drawn.areas) = (Arc::new(sheet), Some(ViewAreas { regions, drawn: areas }));
        Ok(())
    };
    let Some(first) = views.first() else { return Ok(PyBytes::new(py, &[])) };
    first.lines.get().written(py, (&PyDict::new(py), title), format_named(format), put)
}

impl Fills {
    /// Adds the areas of the objects that are on the sheet.
    fn put(&self, sheet: &mut Areas, at: DVec2, on_sheet: impl Fn(u32) -> Option<u32>, view: u32) {
        let all = &self.areas.regions;
        let mut colors = Vec::new();
        let mut chosen = tinta::lines::Regions { regions: Vec::new(), ..*all };
        for (region, color) in all.regions.iter().zip(&self.colors) {
            let Some((seen, object)) = region.seen.and_then(|seen| Some((seen, on_sheet(seen.object)?))) else {
                continue;
            };
            let loops =
                region.loops.iter().map(|corners| corners.iter().map(|corner| *corner + at).collect()).collect();
            chosen.regions.push(Region { seen: Some(Surface { object, ..seen }), loops, area_px: region.area_px });
            colors.push(*color);
        }
        let named = |group: FillGroup| FillGroup {
            material: if group.object == NONE { view } else { group.material },
            opacity: self.opacity,
            ..group
        };
        sheet.fills.extend(painted(&chosen, self.has_traps, |number| colors[number]).into_iter().map(named));
        if let Some([low, high]) = Areas::around(&chosen).corners_px {
            let [before_low, before_high] = sheet.corners_px.unwrap_or([low, high]);
            sheet.corners_px = Some([before_low.min(low), before_high.max(high)]);
        }
    }
}

fn key((boxes, texts): GivenKey) -> Key {
    let rectangle = |[left, top, right, bottom, red, green, blue]: [f64; 7]| {
        let corners = [DVec2::new(left, top), DVec2::new(right, bottom)];
        (corners, Color([red, green, blue].map(|part| part as f32)))
    };
    let text = |(text, [x, y, left, below, size, red, green, blue]): (String, [f64; 8])| KeyText {
        text,
        at_px: DVec2::new(x, y),
        left,
        below,
        size,
        color: Color([red, green, blue].map(|part| part as f32)),
    };
    Key { boxes: boxes.into_iter().map(rectangle).collect(), texts: texts.into_iter().map(text).collect() }
}
