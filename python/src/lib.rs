//! The Python package `tinta_npr`: a door to the library, as the command line is one.
//!
//! Meshes come in as arrays or paths of files, with settings by their names; arrays of lines, SVG and pictures go out. Python
//! code in `python/tinta_npr` does the rest: it recognises meshes of other packages, cameras, notebooks. This crate has the loops
//! over the tables of settings (`settings.rs`), arrays (`mesh.rs`, `arrays.rs`), and the threads that work while Python's other
//! threads run (`work.rs`, `studio.rs`).
//!
//! All `unsafe` code comes from pyo3's macros `#[pyclass]` and `#[pyfunction]`.

mod arrays;
mod command;
mod edges;
mod errors;
mod help;
mod judging;
mod lines;
mod mesh;
mod picture;
mod regions;
mod request;
mod settings;
mod sheet;
mod studio;
mod warnings;
mod work;

/// The module `tinta_npr._native` in Python.
#[pyo3::pymodule]
mod _native {
    #[pymodule_export]
    use super::command::command;
    #[pymodule_export]
    use super::edges::{edges, silhouette};
    #[pymodule_export]
    use super::help::documentation;
    #[pymodule_export]
    use super::judging::{compare, measure};
    #[pymodule_export]
    use super::lines::{Lines, lines};
    #[pymodule_export]
    use super::mesh::{Mesh, triangles_of_rings};
    #[pymodule_export]
    use super::picture::{Picture, png, render, save, write};
    #[pymodule_export]
    use super::regions::{Regions, regions};
    #[pymodule_export]
    use super::request::reading;
    #[pymodule_export]
    use super::settings::{camera_names, check, names, settings};
    #[pymodule_export]
    use super::sheet::sheet;
    #[pymodule_export]
    use super::studio::close;
    #[pymodule_export]
    use super::warnings::warn_of;

    /// The version of the package.
    #[pymodule_export]
    const VERSION: &str = env!("CARGO_PKG_VERSION");
}
