//! Exact lines: arrays of pieces, layers of paths, SVG, PDF and JSON.

use crate::arrays::{pairs, points, shaped};
use crate::errors::raised;
use crate::mesh::{Mesh, scene};
use crate::request::{Asked, Basis};
use crate::settings::options;
use crate::warnings::warn;
use crate::work::done;
use numpy::PyReadonlyArray2;
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict};
use std::sync::{Arc, OnceLock};
use tinta::glam::DVec3;
use tinta::lines::{GHOST_OPACITY, LineSegment, Progress, drawn_layers};
use tinta::request::{DrawingFormat, DrawnLines, Wanted};
use tinta::{Error, Request, Result, Scene, VisibleLines};

/// The lines found in a scene.
#[pyclass(frozen, module = "tinta_npr._native")]
pub(crate) struct Lines {
    pub(crate) lines: Arc<VisibleLines>,
    pub scene: Arc<Scene>,
    pub asked: Asked,
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
    let asked = Asked::new("lines", &meshes, given, &Basis { look, preset, ..Basis::default() })?;
    let progress = Arc::new(Progress::default());
    let (watched, request) = (progress.clone(), asked.request.clone());
    let (lines, scene) = done(
        py,
        || progress.cancel(),
        move || {
            let scene = request.lit(scene(&meshes, &request.scene)?);
            let lines = request.all_lines(&scene, Wanted::default(), &watched)?;
            Ok((lines, scene))
        },
    )?;
    let has_areas = asked.request.vectors().map_err(raised)?.is_some();
    if !has_areas && !lines.segments.iter().any(|segment| segment.is_visible) {
        let nothing = "no line of these classes is visible in this picture; see classes, eye and target";
        warn(py, &[nothing.to_owned()])?;
    }
    Ok(Lines { lines: Arc::new(lines), scene: Arc::new(scene), asked, all: OnceLock::new() })
}

/// The lines of another request: the existing ones, or new ones if it shows more of them.
fn found(
    lines: Arc<VisibleLines>,
    scene: &Scene,
    [before, now]: [&Request; 2],
    wanted: Wanted,
    progress: &Progress,
) -> Result<Arc<VisibleLines>> {
    match before.finds_all_for(now, wanted)? {
        true => Ok(lines),
        false => now.all_lines(scene, wanted, progress).map(Arc::new),
    }
}

impl Lines {
    /// Refuses what one camera is needed for.
    fn one_view(&self) -> PyResult<()> {
        match self.asked.request.line_style().map_err(raised)?.and_then(|style| style.sheet) {
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
        let wanted = DrawingFormat::Json.wanted(false);
        let all = self.with_lines(py, self.asked.clone(), wanted, move |Found { asked, scene, lines, progress }| {
            asked.request.drawing((*scene).clone(), lines, wanted, progress).map(Arc::new)
        })?;
        // Another thread may have been here first: then both keep its result.
        Ok(self.all.get_or_init(|| all).clone())
    }

    /// Works with the lines that this request wants.
    fn with_lines<T: Send + 'static>(
        &self,
        py: Python<'_>,
        asked: Asked,
        wanted: Wanted,
        work: impl FnOnce(Found<'_>) -> Result<T> + Send + 'static,
    ) -> PyResult<T> {
        let (lines, scene, before) = (self.lines.clone(), self.scene.clone(), self.asked.request.clone());
        let progress = Arc::new(Progress::default());
        let watched = progress.clone();
        let work = move || {
            let lines = found(lines, &scene, [&before, &asked.request], wanted, &watched)?;
            work(Found { asked: &asked, scene, lines, progress: &watched })
        };
        done(py, || progress.cancel(), work)
    }

    /// The request with the settings of a drawing, and its title.
    fn asked_with(&self, given: &Bound<'_, PyDict>, title: Option<String>) -> PyResult<Asked> {
        let mut asked = self.asked.with(options("Lines.svg", given)?).map_err(raised)?;
        asked.request.title = title.or(asked.request.title);
        Ok(asked)
    }

    /// A file of the drawing; `put` is given the drawing and may put others in place of its lines and areas.
    pub(crate) fn written<'py>(
        &self,
        py: Python<'py>,
        (given, title): (&Bound<'py, PyDict>, Option<String>),
        format: DrawingFormat,
        put: impl FnOnce(&mut DrawnLines) -> Result<()> + Send + 'static,
    ) -> PyResult<Bound<'py, PyBytes>> {
        let asked = self.asked_with(given, title)?;
        let wanted = format.wanted(false);
        let bytes = self.with_lines(py, asked, wanted, move |Found { asked, scene, lines, progress }| {
            let mut drawn = asked.request.drawing((*scene).clone(), lines, wanted, progress)?;
            put(&mut drawn)?;
            drawn.written(format, None, asked.recipe(&scene, None).as_ref())?.bytes()
        })?;
        Ok(PyBytes::new(py, &bytes))
    }
}

/// The format of this name.
pub(crate) fn format_named(name: &str) -> DrawingFormat {
    match name {
        "pdf" => DrawingFormat::Pdf,
        "png" => DrawingFormat::Picture,
        _ => DrawingFormat::Svg,
    }
}

/// The lines of a request.
struct Found<'a> {
    asked: &'a Asked,
    scene: Arc<Scene>,
    lines: Arc<VisibleLines>,
    progress: &'a Progress,
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
        self.written(py, (given, title), format, move |drawn| match format {
            DrawingFormat::Picture if drawn.areas.is_some() => {
                Err(Error::setting("areas", "pixels and layers are of lines alone; leave it out, or write a .svg"))
            }
            _ => Ok(()),
        })
    }

    /// The JSON file's text: all pieces and the camera.
    fn json(&self, py: Python<'_>) -> PyResult<String> {
        self.one_view()?;
        let all = self.everything(py)?;
        let bytes = done(py, || (), move || all.written(DrawingFormat::Json, None, None)?.bytes())?;
        Ok(String::from_utf8_lossy(&bytes).into_owned())
    }

    /// Where the camera shows points of the drawn scene: pixels, y down; NaN behind the eye.
    fn projected<'py>(&self, py: Python<'py>, numbers: PyReadonlyArray2<'_, f64>) -> PyResult<Bound<'py, PyAny>> {
        self.one_view()?;
        let (camera, size) = (&self.scene.camera, self.scene.size);
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
        let asked = self.asked_with(given, None)?;
        let layers = self.with_lines(py, asked, Wanted::default(), |Found { asked, lines, .. }| {
            drawn_layers(&lines, &asked.request.line_style()?.unwrap_or_default().drawing)
        })?;
        let described = |drawn: tinta::lines::DrawnLayer| -> PyResult<Bound<'py, PyDict>> {
            let layer = PyDict::new(py);
            let [visibility, name] = drawn.layer.words();
            layer.set_item("name", name)?;
            layer.set_item("visible", visibility == "visible")?;
            layer.set_item("color", drawn.color.0)?;
            layer.set_item("width", drawn.width_px)?;
            layer.set_item("dash", drawn.dash_px)?;
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
        if self.scene.objects.iter().all(|object| object.mesh.curves.labels.is_empty()) {
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
        let (camera, of) = (PyDict::new(py), &self.scene.camera);
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
