//! Edges by class, and silhouettes from a point.

use crate::arrays::{pairs, shaped};
use crate::mesh::Mesh;
use crate::settings::options;
use crate::work::done;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use tinta::edges::{ClassSet, Classes, Eye, MeshEdges, SilhouetteRule};
use tinta::glam::DVec3;
use tinta::settings::HasSettings;
use tinta::{EdgeList, LineSettings, Mesh as TintaMesh};

/// The edges found, one row each.
struct Rows {
    vertices: Vec<[u32; 2]>,
    codes: Vec<u8>,
    faces: Vec<[i64; 2]>,
}

/// The edges of a mesh with a class in every view, each with its first class and its faces.
#[pyfunction]
pub(crate) fn edges<'py>(py: Python<'py>, mesh: Py<Mesh>, given: &Bound<'py, PyDict>) -> PyResult<Bound<'py, PyDict>> {
    let options = options("edges", given)?;
    let rows = done(
        py,
        || (),
        move || {
            let settings = LineSettings::from_options(&options)?;
            let mesh = &mesh.get().mesh;
            let list = EdgeList::new(mesh);
            let wanted = settings.classes.and(ClassSet::EDGES);
            let classes = Classes::new(mesh, &list, settings.crease_angle, wanted);
            Ok(rows(mesh, &list, &classes))
        },
    )?;
    let found = PyDict::new(py);
    let count = rows.codes.len();
    found.set_item("vertices", pairs(py, &rows.vertices)?)?;
    found.set_item("code", shaped(py, rows.codes, &[count])?)?;
    found.set_item("faces", pairs(py, &rows.faces)?)?;
    Ok(found)
}

fn rows(mesh: &TintaMesh, list: &EdgeList, classes: &Classes) -> Rows {
    let mut rows = Rows { vertices: Vec::new(), codes: Vec::new(), faces: Vec::new() };
    for edge in &classes.marked {
        let Some(class) = classes.of_edges[*edge as usize].first() else { continue };
        rows.vertices.push(in_file(mesh, list.positions()[*edge as usize]));
        rows.codes.push(class as u8);
        let faces = list.faces(*edge);
        rows.faces.push([0, 1].map(|side| faces.get(side).map_or(-1, |face| i64::from(*face))));
    }
    rows
}

/// Vertices by the numbers they were given with.
fn in_file(mesh: &TintaMesh, positions: [u32; 2]) -> [u32; 2] {
    positions.map(|position| mesh.file_vertices[position as usize])
}

/// The silhouette edges of a mesh seen from a point, or from far away in a direction.
#[pyfunction]
pub(crate) fn silhouette<'py>(
    py: Python<'py>,
    mesh: Py<Mesh>,
    eye: [f64; 3],
    is_direction: bool,
) -> PyResult<Bound<'py, PyAny>> {
    let find = move || {
        let eye = DVec3::from_array(eye);
        let eye = if is_direction { Eye::Direction(eye) } else { Eye::Point(eye) };
        // The scene keeps the edges for the next eye.
        let scene = mesh.get().kept()?;
        let edges: &MeshEdges = scene.edges(&scene.objects[0]);
        let found = edges.silhouette(eye, SilhouetteRule::Exact);
        let numbers = found.into_iter().map(|edge| in_file(edges.mesh(), edges.list().positions()[edge as usize]));
        Ok(numbers.collect::<Vec<_>>())
    };
    let found = done(py, || (), find)?;
    pairs(py, &found)
}
