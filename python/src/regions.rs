//! Exact areas: arrays of them, SVG, PDF and JSON with the lines above.

use crate::arrays::{points, shaped};
use crate::errors::raised;
use crate::lines::{Lines, format_named};
use crate::request::{Basis, asked};
use crate::settings::options;
use crate::work::done;
use numpy::PyReadonlyArray2;
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict, PyList};
use std::sync::Arc;
use tinta::choice::Choice;
use tinta::lines::{Areas, JoinKey, Progress, Sight, Surface, painted};
use tinta::record::regions_json;
use tinta::request::Resolved;
use tinta::styles::{Contents, LineStyle, ViewAreas};
use tinta::{Color, Error, Size, Style};

/// The areas of the lines' view.
#[pyclass(frozen, module = "tinta_npr._native")]
pub(crate) struct Regions {
    pub(crate) areas: Arc<ViewAreas>,
    drawn: Arc<Resolved>,
    lines: Py<Lines>,
    pub(crate) is_alone: bool,
}

/// The contents of a drawing with areas: `by` is a name of [`JoinKey`], or `tone` for those of a style.
fn vectors(
    by: &str,
    given: &Bound<'_, PyDict>,
    (style, look): (Option<&str>, Option<&str>),
    is_alone: bool,
    size: Size,
) -> PyResult<Contents> {
    let given = options("Lines.regions", given)?;
    let asked_style = if by == "tone" {
        asked("Lines.regions", given, &Basis { style, look, ..Basis::default() }).map_err(raised)?.style
    } else {
        if let Some(name) =
            given.keys().map(String::as_str).chain(style.and(Some("style"))).chain(look.and(Some("look"))).next()
        {
            return Err(raised(Error::setting(
                name,
                "only areas of tone have this; give by=\"tone\", or leave it out",
            )));
        }
        let joined = JoinKey::NAMED.iter().find(|(name, _)| *name == by).map(|(_, joined)| *joined);
        let names: Vec<&str> = JoinKey::NAMED.iter().map(|(name, _)| *name).chain(["tone"]).collect();
        let problem = format!("choose one of {}", names.join(", "));
        let joined = joined.ok_or_else(|| raised(Error::value("by", by, problem)))?;
        Style::Lines(LineStyle { areas: Some(joined), is_of_areas_alone: is_alone, ..LineStyle::default() })
    };
    let name = asked_style.name();
    let problem = "it has no areas of tone; choose three-pass, two-pass, mrt or ink";
    asked_style.vectors(size).ok_or_else(|| raised(Error::value("style", name, problem)))
}

/// Finds the areas of a view whose lines are known.
#[pyfunction]
pub(crate) fn regions(
    py: Python<'_>,
    lines: Py<Lines>,
    by: &str,
    given: &Bound<'_, PyDict>,
    style: Option<&str>,
    look: Option<&str>,
) -> PyResult<Regions> {
    let of = lines.get();
    let is_alone = of.drawn.contents.lines.is_none();
    let vectors = vectors(by, given, (style, look), is_alone, of.drawn.scene.size)?;
    let (drawn, found) = (of.drawn.clone(), of.lines.clone());
    let progress = Arc::new(Progress::default());
    let (watched, seen) = (progress.clone(), drawn.clone());
    let none = || Error::setting("by", "this style has no areas");
    let find = move || vectors.areas(&Sight::of(&seen.scene), &found, &watched)?.ok_or_else(none);
    let areas = done(py, || progress.cancel(), find)?;
    Ok(Regions { areas: Arc::new(areas), drawn, lines, is_alone })
}

#[pymethods]
impl Regions {
    /// Every column of the regions as an array, under its name: -1 for none.
    fn arrays<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let of = &self.areas.regions.regions;
        let arrays = PyDict::new(py);
        let column = |name: &str, value: &dyn Fn(Surface) -> Option<u32>| {
            let values =
                of.iter().map(|region| region.seen.and_then(value).map_or(-1, i64::from)).collect::<Vec<i64>>();
            arrays.set_item(name, shaped(py, values, &[of.len()])?)
        };
        column("object", &|surface| Some(surface.object))?;
        column("material", &|surface| surface.material)?;
        column("tone", &|surface| surface.tone.map(u32::from))?;
        column("face", &|surface| surface.face)?;
        arrays.set_item("area", shaped(py, of.iter().map(|region| region.area_px).collect(), &[of.len()])?)?;
        Ok(arrays)
    }

    /// The loops of each region, arrays of points.
    fn loops<'py>(&self, py: Python<'py>) -> PyResult<Vec<Bound<'py, PyList>>> {
        let of_region = |region: &tinta::lines::Region<Option<Surface>>| {
            let loops = region.loops.iter().map(|corners| points(py, corners)).collect::<PyResult<Vec<_>>>()?;
            PyList::new(py, loops)
        };
        self.areas.regions.regions.iter().map(of_region).collect()
    }

    /// The bytes of the drawing's file, "svg" or "pdf", in its own colours or in these, one for each region.
    fn file<'py>(
        &self,
        py: Python<'py>,
        format: &str,
        given: &Bound<'py, PyDict>,
        title: Option<String>,
        colors: Option<PyReadonlyArray2<'_, f64>>,
    ) -> PyResult<Bound<'py, PyBytes>> {
        let (areas, is_alone) = (self.areas.clone(), self.is_alone);
        let colors: Option<Vec<Color>> = colors.map(|colors| {
            let rows = colors.as_array();
            rows.rows().into_iter().map(|row| Color([row[0] as f32, row[1] as f32, row[2] as f32])).collect()
        });
        self.lines.get().written(py, (given, title), format_named(format), move |drawn| {
            let mut areas = (*areas).clone();
            if let Some(colors) = colors {
                let fills = painted(&areas.regions, !is_alone, |number| colors[number]);
                areas.drawn = Areas { fills, ..Areas::around(&areas.regions) };
            }
            drawn.areas = Some(areas);
            Ok(())
        })
    }

    /// The JSON file's text.
    fn json(&self, py: Python<'_>) -> PyResult<String> {
        let (areas, drawn) = (self.areas.clone(), self.drawn.clone());
        done(py, || (), move || regions_json(&areas.regions, &drawn.scene))
    }
}
