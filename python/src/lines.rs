//! Exact lines: arrays of pieces, layers of paths, SVG, PDF and JSON.

use crate::arrays::{pairs, points, shaped};
use crate::errors::raised;
use crate::mesh::{Mesh, resolved};
use crate::request::{Basis, FunctionRequest};
use crate::settings::options;
use crate::warnings::warn;
use crate::work::done;
use numpy::PyReadonlyArray2;
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict};
use std::sync::{Arc, OnceLock};
use tinta::glam::DVec3;
use tinta::lines::{DrawingContent, DrawingFormat, GHOST_OPACITY, LineSegment, Progress, Sight, drawn_layers};
use tinta::request::{DrawnLines, Resolved, WantedLines};
use tinta::styles::Below;
use tinta::{Error, Result, VisibleLines};

/// The lines found in a scene.
#[pyclass(frozen, module = "tinta_npr._native")]
pub(crate) struct Lines {
    pub(crate) lines: Arc<VisibleLines>,
    pub drawn: Arc<Resolved>,
    pub asked: FunctionRequest,
    /// The drawing with all pieces, hidden ones and outlines too, on first access.
    all: OnceLock<Arc<DrawnLines>>,
}

/// Finds the lines of meshes together.
#[pyfunction]
#[pyo3(signature = (meshes, given, look=None, preset=None))]
pub(crate) fn lines(
    py: Python<'_>,
    meshes: Vec<Py<Mesh>>,
    given: &Bound<'_, PyDict>,
    look: Option<&str>,
    preset: Option<&str>,
) -> PyResult<Lines> {
    let asked = FunctionRequest::new("lines", &meshes, given, &Basis { look, preset, ..Basis::default() })?;
    let progress = Arc::new(Progress::default());
    let (watched, request) = (progress.clone(), asked.request.clone());
    let (lines, drawn) = done(
        py,
        || progress.cancel(),
        move || {
            let drawn = resolved(&meshes, &request, true)?;
            let lines = drawn.all_lines(&Sight::of(&drawn.scene), WantedLines::default(), &watched)?;
            Ok((lines, drawn))
        },
    )?;
    if drawn.contents.below == Below::Nothing && !lines.segments.iter().any(|segment| segment.is_visible) {
        let nothing = "no line of these classes is visible in this picture; see classes, eye and target";
        warn(py, &[nothing.to_owned()])?;
    }
    Ok(Lines { lines: Arc::new(lines), drawn: Arc::new(drawn), asked, all: OnceLock::new() })
}

impl Lines {
    /// Refuses a sheet, which has several cameras.
    fn one_view(&self) -> PyResult<()> {
        match self.drawn.contents.sheet {
            Some(_) => Err(raised(Error::setting("sheet", "a sheet has four cameras; ask for lines of one view"))),
            None => Ok(()),
        }
    }

    /// All pieces, as arrays and JSON have them: hidden ones too, those of the outline marked; short ones unless the drawing has
    /// a least length.
    fn everything(&self, py: Python<'_>) -> PyResult<Arc<DrawnLines>> {
        if let Some(all) = self.all.get() {
            return Ok(all.clone());
        }
        let wanted = WantedLines::of(format_named("json"), false);
        let all = self.with_lines(py, (*self.drawn).clone(), wanted, move |drawn, lines, progress| {
            drawn.drawing(&Sight::of(&drawn.scene), lines, wanted, progress).map(Arc::new)
        })?;
        // Another thread may have been here first: then both keep its result.
        Ok(self.all.get_or_init(|| all).clone())
    }

    /// Works with the lines that a drawing of the same scene wants: those found, or new ones if it shows more of them.
    fn with_lines<T: Send + 'static>(
        &self,
        py: Python<'_>,
        drawn: Resolved,
        wanted: WantedLines,
        work: impl FnOnce(Resolved, Arc<VisibleLines>, &Progress) -> Result<T> + Send + 'static,
    ) -> PyResult<T> {
        let (lines, serves) = (self.lines.clone(), self.drawn.contents.finds_all_for(&drawn.contents, wanted));
        let progress = Arc::new(Progress::default());
        let watched = progress.clone();
        let work = move || {
            let lines = if serves {
                lines
            } else {
                drawn.all_lines(&Sight::of(&drawn.scene), wanted, &watched).map(Arc::new)?
            };
            work(drawn, lines, &watched)
        };
        done(py, || progress.cancel(), work)
    }

    /// The drawing with these settings and this title.
    fn drawn_with(&self, given: &Bound<'_, PyDict>, title: Option<String>) -> PyResult<Resolved> {
        self.drawn.with_options(options("Lines.svg", given)?, title).map_err(raised)
    }

    /// A file of the drawing; `put` is given the drawing and may put others in place of its lines and areas.
    pub(crate) fn written<'py>(
        &self,
        py: Python<'py>,
        (given, title): (&Bound<'py, PyDict>, Option<String>),
        format: DrawingFormat,
        put: impl FnOnce(&mut DrawnLines) -> Result<()> + Send + 'static,
    ) -> PyResult<Bound<'py, PyBytes>> {
        let (asked, wanted) = (self.asked.clone(), WantedLines::of(format, false));
        let bytes = self.with_lines(py, self.drawn_with(given, title)?, wanted, move |drawn, lines, progress| {
            let mut drawn = drawn.drawing(&Sight::of(&drawn.scene), lines, wanted, progress)?;
            put(&mut drawn)?;
            drawn.written(format, None, asked.recipe(&drawn.resolved, None).as_ref())?.bytes()
        })?;
        Ok(PyBytes::new(py, &bytes))
    }
}

/// The format of this name.
pub(crate) fn format_named(name: &str) -> DrawingFormat {
    DrawingFormat::of_name(&format!("drawing.{name}")).unwrap_or(DrawingFormat::PIXELS)
}

#[pymethods]
impl Lines {
    /// The picture's width and height, pixels.
    #[getter]
    fn size(&self) -> (u32, u32) {
        (self.lines.size.width, self.lines.size.height)
    }

    /// Every column of the pieces as an array, under its name.
    fn arrays<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let all = self.everything(py)?;
        let of = &all.lines.segments;
        let arrays = PyDict::new(py);
        let numbers: Vec<f64> = of.iter().flat_map(|piece| piece.ends_px).flat_map(|end| end.to_array()).collect();
        arrays.set_item("segments", shaped(py, numbers, &[of.len(), 2, 2])?)?;
        let edges: Vec<[i64; 2]> =
            of.iter().map(|piece| piece.edge.map_or([-1; 2], |edge| edge.map(i64::from))).collect();
        arrays.set_item("edge", pairs(py, &edges)?)?;
        column(&arrays, "code", of, |piece| piece.class as u8)?;
        column(&arrays, "visible", of, |piece| piece.is_visible)?;
        column(&arrays, "outline", of, |piece| piece.is_outline)?;
        column(&arrays, "covered", of, |piece| piece.is_covered)?;
        column(&arrays, "angle", of, |piece| piece.angle_degrees.unwrap_or(f64::NAN))?;
        column(&arrays, "object", of, |piece| piece.object)?;
        Ok(arrays)
    }

    /// How many edges there are of each class.
    fn counts<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let (counts, mut edges) = (PyDict::new(py), self.lines.edges);
        for (name, class) in tinta::edges::Class::ALL {
            counts.set_item(name, *edges.of(class))?;
        }
        Ok(counts)
    }

    /// The bytes of the drawing's file: "svg", "pdf" or "png", which is as large as the lines' picture.
    #[pyo3(signature = (format, given, title=None))]
    fn file<'py>(
        &self,
        py: Python<'py>,
        format: &str,
        given: &Bound<'py, PyDict>,
        title: Option<String>,
    ) -> PyResult<Bound<'py, PyBytes>> {
        let format = format_named(format);
        self.written(py, (given, title), format, move |drawn| match format.content {
            DrawingContent::Pixels if drawn.areas.is_some() => {
                Err(Error::setting("areas", "pixels and layers are of lines alone; leave it out, or write a .svg"))
            }
            _ => Ok(()),
        })
    }

    /// The JSON file's text: all pieces and the camera.
    fn json(&self, py: Python<'_>) -> PyResult<String> {
        self.one_view()?;
        let all = self.everything(py)?;
        let bytes = done(py, || (), move || all.written(format_named("json"), None, None)?.bytes())?;
        Ok(String::from_utf8_lossy(&bytes).into_owned())
    }

    /// Where the camera shows points of the drawn scene: pixels, y down; NaN behind the eye.
    fn projected<'py>(&self, py: Python<'py>, numbers: PyReadonlyArray2<'_, f64>) -> PyResult<Bound<'py, PyAny>> {
        self.one_view()?;
        let (camera, size) = (&self.drawn.scene.camera, self.drawn.scene.size);
        let [width, height] = [size.width, size.height].map(f64::from);
        let clip_from_world = camera.clip_from_view(width / height) * camera.view_from_world();
        let place = |point: [f64; 3]| {
            let clip = clip_from_world * DVec3::from_array(point).extend(1.0);
            let scale = if clip.w > 0.0 { 0.5 / clip.w } else { f64::NAN };
            [(0.5 + clip.x * scale) * width, (0.5 - clip.y * scale) * height]
        };
        let rows = numbers.as_array();
        pairs(py, &rows.rows().into_iter().map(|row| place([row[0], row[1], row[2]])).collect::<Vec<_>>())
    }

    /// The drawing as plain values: its layers from the lowest to the highest.
    fn layers<'py>(&self, py: Python<'py>, given: &Bound<'py, PyDict>) -> PyResult<Vec<Bound<'py, PyDict>>> {
        let layers =
            self.with_lines(py, self.drawn_with(given, None)?, WantedLines::default(), |drawn, lines, _| {
                drawn_layers(&lines, &drawn.contents.drawing)
            })?;
        let described = |drawn: tinta::lines::DrawnLayer| -> PyResult<Bound<'py, PyDict>> {
            let layer = PyDict::new(py);
            let [visibility, name] = drawn.layer.words();
            layer.set_item("name", name)?;
            layer.set_item("visible", visibility == "visible")?;
            layer.set_item("color", drawn.color.0)?;
            layer.set_item("width", drawn.width_px)?;
            layer.set_item("dash", Some(drawn.dash_px).filter(|lengths| !lengths.is_empty()))?;
            layer.set_item("opacity", if drawn.is_ghost { GHOST_OPACITY } else { 1.0 })?;
            let mut paths = Vec::new();
            for path in drawn.paths {
                let mut all = path.points_px;
                if path.is_closed {
                    all.extend(all.first().copied());
                }
                paths.push(points(py, &all)?);
            }
            layer.set_item("paths", paths)?;
            Ok(layer)
        };
        layers.into_iter().map(described).collect()
    }

    /// The labels of points, hidden ones too, each a dict.
    fn labels<'py>(&self, py: Python<'py>) -> PyResult<Vec<Bound<'py, PyDict>>> {
        // Without any, all pieces need not be found.
        if self.drawn.scene.objects.iter().all(|object| object.mesh.curves.labels.is_empty()) {
            return Ok(Vec::new());
        }
        let described = |label: &tinta::lines::Label| {
            let described = PyDict::new(py);
            described.set_item("text", &label.text)?;
            described.set_item("at", label.px.to_array())?;
            described.set_item("visible", label.is_visible)?;
            described.set_item("object", label.object)?;
            Ok(described)
        };
        self.everything(py)?.lines.labels.iter().map(described).collect()
    }

    /// The camera: eye, target, up, and either fov in degrees or height in the mesh's units.
    fn camera<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        use tinta::camera::Projection;
        self.one_view()?;
        let (camera, of) = (PyDict::new(py), &self.drawn.scene.camera);
        for (name, vector) in [("eye", of.eye), ("target", of.target), ("up", of.up)] {
            camera.set_item(name, vector.to_array())?;
        }
        match of.projection {
            Projection::Perspective { fov_y_degrees } => camera.set_item("fov", fov_y_degrees)?,
            Projection::Parallel { height } => {
                camera.set_item("parallel", true)?;
                camera.set_item("height", height)?;
            }
        }
        Ok(camera)
    }
}

fn column<T: numpy::Element>(
    arrays: &Bound<'_, PyDict>,
    name: &str,
    of: &[LineSegment],
    value: impl Fn(&LineSegment) -> T,
) -> PyResult<()> {
    let values: Vec<T> = of.iter().map(value).collect();
    let count = values.len();
    arrays.set_item(name, shaped(arrays.py(), values, &[count])?)
}
