//! Meshes: arrays or files, read once and drawn often.

use crate::arrays::shaped;
use crate::errors::{in_python, raised, wrong};
use crate::settings::{options, python_options};
use crate::warnings::warn;
use crate::work::done;
use numpy::{PyReadonlyArray1, PyReadonlyArray2};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::collections::{BTreeSet, HashMap};
use std::path::PathBuf;
use std::sync::{Arc, OnceLock};
use tinta::glam::{DVec3, Vec3};
use tinta::mesh::Curves;
use tinta::request::Resolved;
use tinta::settings::{HasSettings, Options};
use tinta::{LoadOptions, Request, Result, Scene, load};

/// A mesh, read and checked, with the results cached when it was drawn.
#[pyclass(frozen, module = "tinta_npr._native")]
pub(crate) struct Mesh {
    pub mesh: Arc<tinta::Mesh>,
    /// Its file's path as given.
    pub path: Option<String>,
    /// The settings it was read with.
    pub options: Options,
    /// The other files read with it.
    pub files: Vec<PathBuf>,
    remarks: Vec<String>,
    /// How it was seen first: its arrays and edges are shared by all later views.
    scene: OnceLock<Scene>,
}

/// Three numbers of an array.
type ArrayRow<'a> = numpy::ndarray::ArrayView1<'a, f64>;

/// Vertices and their numbers in the given mesh, triangles and their faces in the given mesh, normals and triangles of normals.
type PickledArrays<'py> = (
    PyReadonlyArray2<'py, f64>,
    PyReadonlyArray1<'py, u32>,
    PyReadonlyArray2<'py, u32>,
    PyReadonlyArray1<'py, u32>,
    PyReadonlyArray2<'py, f32>,
    PyReadonlyArray2<'py, u32>,
);

/// Curves and points: their positions, these positions' numbers in the given ones, segments, points, and labels of points.
type PickledCurves<'py> = (PyReadonlyArray2<'py, f64>, Vec<u32>, Vec<[u32; 2]>, Vec<u32>, Vec<(u32, String)>);

/// Faces as their corners one after the other.
struct Corners {
    indices: Vec<i64>,
    /// How many each face has; empty for triangles.
    sizes: Vec<i64>,
}

impl Corners {
    /// The face that a corner is of.
    fn row(&self, corner: usize) -> usize {
        let mut end = 0;
        let is_behind = |size: &i64| {
            end += usize::try_from(*size).unwrap_or(0);
            end > corner
        };
        if self.sizes.is_empty() { corner / 3 } else { self.sizes.iter().position(is_behind).unwrap_or(0) }
    }

    /// Returns the corners and sizes in the library's form, or the error with its place.
    fn checked(self, vertices: usize) -> std::result::Result<(Vec<u32>, Vec<u32>), String> {
        if let Some(row) = self.sizes.iter().position(|size| *size < 3) {
            return Err(format!("row {row} has {} corners; a face has 3 or more", self.sizes[row]));
        }
        let is_there = |index: i64| usize::try_from(index).is_ok_and(|index| index < vertices);
        if let Some(corner) = self.indices.iter().position(|index| !is_there(*index)) {
            let (row, index) = (self.row(corner), self.indices[corner]);
            return Err(format!("row {row} names vertex {index}, but vertices are numbered 0 to {}", vertices - 1));
        }
        let counted: i64 = self.sizes.iter().sum();
        if !self.sizes.is_empty() && counted != self.indices.len() as i64 {
            return Err(format!("their sizes name {counted} corners, but there are {}", self.indices.len()));
        }
        let whole = |numbers: Vec<i64>| numbers.into_iter().map(|number| number as u32).collect();
        Ok((whole(self.indices), whole(self.sizes)))
    }
}

/// Returns the vertices as points, or the error with the vertex's number.
fn checked_vertices(numbers: &[f64]) -> std::result::Result<Vec<DVec3>, String> {
    let (rows, _) = numbers.as_chunks::<3>();
    match rows.iter().position(|row| !row.iter().all(|number| number.is_finite())) {
        Some(row) => Err(format!("row {row} is not finite: {:?}", rows[row])),
        None => Ok(rows.iter().map(|row| DVec3::from_array(*row)).collect()),
    }
}

#[pymethods]
impl Mesh {
    /// Makes a mesh of contiguous arrays; `sizes` are the faces' numbers of corners, none for triangles. All are copied before
    /// anything else can run, and the copies are checked.
    #[staticmethod]
    fn of_arrays(
        py: Python<'_>,
        vertices: PyReadonlyArray2<'_, f64>,
        corners: PyReadonlyArray1<'_, i64>,
        sizes: Option<PyReadonlyArray1<'_, i64>>,
        name: String,
        given: &Bound<'_, PyDict>,
    ) -> PyResult<Self> {
        let options = options("mesh", given)?;
        let numbers = vertices.as_array().iter().copied().collect::<Vec<f64>>();
        let indices = corners.as_array().to_vec();
        let sizes = sizes.map(|sizes| sizes.as_array().to_vec()).unwrap_or_default();
        drop(vertices);
        if numbers.is_empty() {
            return Err(wrong("vertices", "there are none"));
        }
        if indices.is_empty() {
            return Err(wrong("faces", "there are none"));
        }
        let of_mesh = options.clone();
        let made = done(
            py,
            || (),
            move || {
                let positions = match checked_vertices(&numbers) {
                    Ok(positions) => positions,
                    Err(problem) => return Ok(Err(("vertices", problem))),
                };
                match (Corners { indices, sizes }).checked(positions.len()) {
                    Ok((corners, sizes)) => {
                        let load = LoadOptions::from_options(&of_mesh)?;
                        tinta::Mesh::of_polygons(&name, positions, &corners, sizes, &load).map(Ok)
                    }
                    Err(problem) => Ok(Err(("faces", problem))),
                }
            },
        )?;
        let mesh = made.map_err(|(argument, problem)| wrong(argument, problem))?;
        // As of a file: defects that change the picture.
        let others = mesh.defects.others();
        let told = others.consequence().map(|consequence| format!("{}: {others}; {consequence}", mesh.name));
        let remarks: Vec<String> = told.into_iter().collect();
        warn(py, &remarks)?;
        Ok(Self::new(mesh, None, options, Vec::new(), remarks))
    }

    /// Makes a mesh without faces of curves, given by all positions and the place where each curve ends, of points and of their
    /// labels, empty or as many. Everything is copied first, and the copies are checked.
    #[staticmethod]
    fn of_curves(
        py: Python<'_>,
        positions: PyReadonlyArray2<'_, f64>,
        ends: PyReadonlyArray1<'_, i64>,
        points: PyReadonlyArray2<'_, f64>,
        labels: Vec<String>,
        given: &Bound<'_, PyDict>,
    ) -> PyResult<Self> {
        let options = options("mesh", given)?;
        let numbers = positions.as_array().iter().copied().collect::<Vec<f64>>();
        let points = points.as_array().iter().copied().collect::<Vec<f64>>();
        let ends = ends.as_array().to_vec();
        drop(positions);
        let of_mesh = options.clone();
        let made = done(
            py,
            || (),
            move || {
                let positions = match checked_vertices(&numbers) {
                    Ok(positions) => positions,
                    Err(problem) => return Ok(Err(("curves", problem))),
                };
                let points = match checked_vertices(&points) {
                    Ok(points) => points,
                    Err(problem) => return Ok(Err(("points", problem))),
                };
                let mut start = 0;
                let curves: Option<Vec<Vec<DVec3>>> = ends
                    .iter()
                    .map(|end| {
                        let end = usize::try_from(*end).ok()?;
                        let curve = positions.get(start..end)?.to_vec();
                        start = end;
                        Some(curve)
                    })
                    .collect();
                let Some(curves) = curves else { return Ok(Err(("curves", "their ends are out of order".to_owned()))) };
                let labels: Vec<&str> = labels.iter().map(String::as_str).collect();
                let load = LoadOptions::from_options(&of_mesh)?;
                tinta::Mesh::of_curves("curves", &curves, &points, &labels, &load).map(Ok)
            },
        )?;
        let mesh = made.map_err(|(argument, problem)| wrong(argument, problem))?;
        Ok(Self::new(mesh, None, options, Vec::new(), Vec::new()))
    }

    /// The positions of its curves and points, which belong to no face: (N, 3) float64.
    #[getter]
    fn free<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let positions = &self.mesh.curves.positions;
        let numbers: Vec<f64> = positions.iter().flat_map(|point| point.to_array()).collect();
        shaped(py, numbers, &[positions.len(), 3])
    }

    /// This surface with the curves and points of another mesh, at other positions, as many as before.
    fn with_curves_of(&self, other: &Self, positions: PyReadonlyArray2<'_, f64>) -> PyResult<Self> {
        let numbers = positions.as_array().iter().copied().collect::<Vec<f64>>();
        let positions = checked_vertices(&numbers).map_err(|problem| wrong("curves", problem))?;
        if positions.len() != other.mesh.curves.positions.len() {
            return Err(wrong("curves", "they have another number of positions"));
        }
        let curves = tinta::mesh::Curves { positions, ..other.mesh.curves.clone() };
        let mesh = tinta::Mesh { curves, ..(*self.mesh).clone() };
        Ok(Self::new(mesh, None, self.options.clone(), self.files.clone(), self.remarks.clone()))
    }

    /// This mesh, made of the triangles of another, with the numbers of the other's given faces and with its marked edges.
    fn with_faces_of(&self, other: &Self) -> Self {
        let faces = self.given_faces().map(|triangle| other.mesh.file_face(triangle)).collect();
        self.marked(faces, other.mesh.marked.iter().copied())
    }

    /// This mesh with other numbers of its given faces, one for each of them, and with marked edges, each by the numbers of its ends in
    /// the given mesh. Edges of vertices that no face uses are left out.
    fn with_marks(&self, faces: PyReadonlyArray1<'_, u32>, edges: PyReadonlyArray2<'_, u32>) -> PyResult<Self> {
        let (faces, edges) = (faces.as_array(), edges.as_array());
        let numbers: Option<Vec<u32>> = self.given_faces().map(|face| faces.get(face as usize).copied()).collect();
        let numbers = numbers.ok_or_else(|| wrong("faces", "the mesh has more; give a number for each"))?;
        Ok(self.marked(numbers, edges.rows().into_iter().map(|edge| [edge[0], edge[1]])))
    }

    /// Reads a mesh from a file.
    #[staticmethod]
    fn of_file(py: Python<'_>, path: String, given: &Bound<'_, PyDict>) -> PyResult<Self> {
        let options = options("mesh", given)?;
        let (of_mesh, file) = (options.clone(), path.clone());
        let loaded = done(py, || (), move || load(&file, &LoadOptions::from_options(&of_mesh)?))?;
        warn(py, &loaded.remarks)?;
        Ok(Self::new(loaded.mesh, Some(path), options, loaded.files, loaded.remarks))
    }

    /// Whether it was read with these settings, those that are not given as by default.
    fn was_read_with(&self, given: &Bound<'_, PyDict>) -> PyResult<bool> {
        let read = |options: &Options| LoadOptions::from_options(options).map_err(raised);
        let mut all = self.options.clone();
        all.extend(options("mesh", given)?);
        Ok(read(&all)? == read(&self.options)?)
    }

    /// Its name: its file's path, or the given name.
    #[getter]
    fn name(&self) -> &str {
        &self.mesh.name
    }

    /// Remarks from reading, a sentence each.
    #[getter]
    fn remarks(&self) -> Vec<String> {
        self.remarks.iter().map(|remark| in_python(remark)).collect()
    }

    /// The vertices that faces use, equal ones once: (N, 3) float64.
    #[getter]
    fn vertices<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let numbers: Vec<f64> = self.mesh.positions.iter().flat_map(|point| point.to_array()).collect();
        shaped(py, numbers, &[self.mesh.positions.len(), 3])
    }

    /// The triangles, counter-clockwise seen from outside: (M, 3) uint32, numbers of `vertices`.
    #[getter]
    fn faces<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        shaped(py, self.mesh.triangles.as_flattened().to_vec(), &[self.mesh.triangles.len(), 3])
    }

    /// The face of the given mesh that each triangle is of: (M,) uint32.
    #[getter]
    fn file_faces<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        shaped(py, self.given_faces().collect(), &[self.mesh.triangles.len()])
    }

    /// Vectors turned as reading with these settings turned the mesh: (N, 3).
    fn turned<'py>(&self, py: Python<'py>, vectors: PyReadonlyArray2<'_, f64>) -> PyResult<Bound<'py, PyAny>> {
        let up_axis = LoadOptions::from_options(&self.options).map_err(raised)?.up_axis;
        let rows = vectors.as_array();
        let turn = |row: ArrayRow<'_>| up_axis.to_y_up(DVec3::new(row[0], row[1], row[2])).to_array();
        let numbers: Vec<f64> = rows.rows().into_iter().flat_map(turn).collect();
        shaped(py, numbers, &[rows.nrows(), 3])
    }

    /// It never changes, so a copy is itself.
    fn __copy__(this: Py<Self>) -> Py<Self> {
        this
    }

    fn __deepcopy__(this: Py<Self>, _memo: &Bound<'_, PyAny>) -> Py<Self> {
        this
    }

    /// How a pickle makes it again: a file's from the file, another from its arrays.
    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyAny>)> {
        let class = py.get_type::<Self>();
        let options = python_options(py, &self.options)?;
        if let Some(path) = &self.path {
            return Ok((class.getattr("of_file")?, (path, options).into_pyobject(py)?.into_any()));
        }
        let normals: Vec<f32> = self.mesh.normals.iter().flat_map(|normal| normal.to_array()).collect();
        let mesh = &self.mesh;
        let arrays = (
            self.vertices(py)?,
            shaped(py, mesh.file_vertices.clone(), &[mesh.file_vertices.len()])?,
            self.faces(py)?,
            shaped(py, mesh.file_faces.clone(), &[mesh.file_faces.len()])?,
            shaped(py, normals, &[mesh.normals.len(), 3])?,
            shaped(py, mesh.triangle_normals.as_flattened().to_vec(), &[mesh.triangle_normals.len(), 3])?,
        );
        let free = &mesh.curves;
        let curves = (self.free(py)?, &free.file_vertices, &free.segments, &free.points, &free.labels);
        let arguments =
            (arrays, curves, &mesh.marked, &mesh.name, options, &self.remarks).into_pyobject(py)?.into_any();
        Ok((class.getattr("of_pickle")?, arguments))
    }

    /// The mesh of a pickle.
    #[staticmethod]
    fn of_pickle(
        arrays: PickledArrays<'_>,
        curves: PickledCurves<'_>,
        marked: Vec<[u32; 2]>,
        name: String,
        given: &Bound<'_, PyDict>,
        remarks: Vec<String>,
    ) -> PyResult<Self> {
        let options = options("mesh", given)?;
        let (vertices, file_vertices, faces, file_faces, normals, face_normals) = arrays;
        let vectors = |array: PyReadonlyArray2<'_, f64>| -> Vec<f64> { array.as_array().iter().copied().collect() };
        let corners = |array: PyReadonlyArray2<'_, u32>| -> Vec<[u32; 3]> {
            array.as_array().iter().copied().collect::<Vec<_>>().as_chunks::<3>().0.to_vec()
        };
        let points_of = |array| checked_vertices(&vectors(array)).map_err(|problem| wrong("pickle", problem));
        let positions = points_of(vertices)?;
        let normals: Vec<f32> = normals.as_array().iter().copied().collect();
        let (free, of_file, segments, points, labels) = curves;
        let free = points_of(free)?;
        let curves = Curves { positions: free, file_vertices: of_file, segments, points, labels, hatching: 0 };
        let mesh = tinta::Mesh {
            curves,
            marked,
            weld: LoadOptions::from_options(&options).map_err(raised)?.weld,
            name,
            file_vertices: file_vertices.as_array().to_vec(),
            triangles: corners(faces),
            normals: normals.as_chunks::<3>().0.iter().map(|row| Vec3::from_array(*row)).collect(),
            triangle_normals: corners(face_normals),
            positions,
            position_colors: Vec::new(),
            texture_coordinates: Vec::new(),
            triangle_texture_coordinates: Vec::new(),
            materials: Vec::new(),
            triangle_materials: Vec::new(),
            file_faces: file_faces.as_array().to_vec(),
            parts: Vec::new(),
            triangle_parts: Vec::new(),
            defects: tinta::mesh::Defects::default(),
        };
        let is_within = |rows: &[[u32; 3]], count: usize| rows.as_flattened().iter().all(|row| (*row as usize) < count);
        let free = &mesh.curves;
        let is_whole = mesh.file_vertices.len() == mesh.positions.len()
            && free.file_vertices.len() == free.positions.len()
            && free
                .segments
                .as_flattened()
                .iter()
                .chain(&free.points)
                .all(|end| (*end as usize) < free.positions.len())
            && free.labels.iter().all(|(point, _)| (*point as usize) < free.points.len())
            && mesh.triangle_normals.len() == mesh.triangles.len()
            && [0, mesh.triangles.len()].contains(&mesh.file_faces.len())
            && mesh.marked.as_flattened().iter().all(|end| (*end as usize) < mesh.positions.len())
            && !(mesh.triangles.is_empty() && free.is_empty())
            && is_within(&mesh.triangles, mesh.positions.len())
            && is_within(&mesh.triangle_normals, mesh.normals.len());
        match is_whole {
            true => Ok(Self::new(mesh, None, options, Vec::new(), remarks)),
            false => Err(wrong("pickle", "its arrays do not fit one another; pickle the mesh again")),
        }
    }

    fn __repr__(&self) -> String {
        let (vertices, faces) = (self.mesh.positions.len(), self.mesh.triangles.len());
        format!("<tinta_npr.Mesh {:?}: {vertices} vertices, {faces} triangles>", self.mesh.name)
    }
}

impl Mesh {
    /// Its scene, with the edges and arrays found so far.
    pub(crate) fn kept(&self) -> Result<&Scene> {
        let scene = match self.scene.get() {
            Some(scene) => return Ok(scene),
            None => Request::default().placed(vec![self.mesh.clone()])?,
        };
        // Another thread may have been here first: then both keep its scene.
        Ok(self.scene.get_or_init(|| scene))
    }

    fn new(
        mesh: tinta::Mesh,
        path: Option<String>,
        options: Options,
        files: Vec<PathBuf>,
        remarks: Vec<String>,
    ) -> Self {
        Self { mesh: Arc::new(mesh), path, options, files, remarks, scene: OnceLock::new() }
    }

    /// The face of the given mesh that each triangle is of.
    fn given_faces(&self) -> impl Iterator<Item = u32> {
        (0..self.mesh.triangles.len() as u32).map(move |triangle| self.mesh.file_face(triangle))
    }

    /// Returns it with these numbers of its triangles' faces, and with these edges marked by the given numbers of their ends.
    fn marked(&self, file_faces: Vec<u32>, edges: impl Iterator<Item = [u32; 2]>) -> Self {
        let places: HashMap<u32, u32> = self.mesh.file_vertices.iter().copied().zip(0..).collect();
        let place = |[one, other]: [u32; 2]| Some((*places.get(&one)?, *places.get(&other)?));
        // In ascending order, each once.
        let marked: BTreeSet<_> =
            edges.filter_map(place).map(|(one, other)| [one.min(other), one.max(other)]).collect();
        let mesh = tinta::Mesh { file_faces, marked: marked.into_iter().collect(), ..(*self.mesh).clone() };
        Self::new(mesh, None, self.options.clone(), self.files.clone(), self.remarks.clone())
    }
}

/// The corners, by number, of the triangles between a flat outline and its holes: (N, 3). `holes` are the numbers of their first points.
#[pyfunction]
pub(crate) fn triangles_of_rings<'py>(
    py: Python<'py>,
    points: PyReadonlyArray2<'_, f64>,
    holes: Vec<u32>,
) -> PyResult<Bound<'py, PyAny>> {
    let mut corners: Vec<u32> = Vec::new();
    let points = points.as_array();
    earcut::Earcut::new().earcut(points.rows().into_iter().map(|row| [row[0], row[1]]), &holes, &mut corners);
    let count = corners.len() / 3;
    shaped(py, corners, &[count, 3])
}

/// The picture of meshes that a request draws, found while Python's other threads run.
pub(crate) fn drawable(py: Python<'_>, meshes: Vec<Py<Mesh>>, request: &Request) -> PyResult<Resolved> {
    let request = request.clone();
    let work = move || {
        let resolved = resolved(&meshes, &request, false)?;
        resolved.lit().make_arrays();
        Ok(resolved)
    };
    done(py, || (), work)
}

/// A request resolved for meshes; a single mesh keeps its scene.
pub(crate) fn resolved(meshes: &[Py<Mesh>], request: &Request, as_vectors: bool) -> Result<Resolved> {
    match meshes {
        [only] if request.scene.copies == 1 => request.resolve_again(only.get().kept()?, as_vectors),
        _ => request.resolve(meshes.iter().map(|mesh| mesh.get().mesh.clone()).collect(), as_vectors),
    }
}
