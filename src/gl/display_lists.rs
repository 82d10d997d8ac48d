//! Vertices drawn without buffers: sent anew in every picture, or compiled once into display lists.
//!
//! A list is made when a draw first asks for it and kept as long as every picture calls it.

use super::Gl;
use super::immediate::{Immediate, Vertices};
use super::objects::DisplayList;
use crate::error::{Error, Result};
use crate::mesh::Mesh;
use crate::plan::{EdgeRun, FaceList, Mark, Submission};
use std::cell::{Cell, RefCell};
use std::rc::Rc;
use std::sync::Arc;

/// What a display list is made of: two are the same if these are.
#[derive(PartialEq)]
pub(super) enum Content {
    /// A run of an object's faces.
    Faces {
        /// The object's mesh.
        mesh: Same<Mesh>,
        /// The length that is 1 in its vertices.
        unit: f64,
        /// Which of its faces, if not all.
        list: Option<Same<FaceList>>,
        /// Which run of them.
        part: usize,
        /// The texture coordinates for the first unit.
        coordinates: Option<Same<Vec<[f32; 2]>>>,
        /// The vertices' colours.
        colors: Option<Same<Vec<[f32; 4]>>>,
        /// The unit that gets the mesh's own texture coordinates.
        own_unit: Option<u32>,
        /// Whether its normals are in it.
        has_normals: bool,
    },
    /// A run of an object's edges.
    Edges {
        /// The object's mesh.
        mesh: Same<Mesh>,
        /// The length that is 1 in its vertices.
        unit: f64,
        /// All runs.
        runs: Same<Vec<EdgeRun>>,
        /// Which of them.
        run: usize,
        /// Lines or points.
        mark: Mark,
    },
    /// What lies on some corners of the squares that fill the picture: how they are joined, and the first.
    Corners(u32, u32),
    /// Something that is drawn once; never kept.
    Once,
}

/// The very same thing, not one that is equal; kept alive, so that no other can come to lie in its place.
pub(super) struct Same<T>(Arc<T>);

impl<T> Same<T> {
    pub(super) fn as_this(this: &Arc<T>) -> Self {
        Self(this.clone())
    }
}

impl<T> PartialEq for Same<T> {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}

/// The display lists compiled so far.
#[derive(Default)]
pub(super) struct DisplayLists(RefCell<Vec<Compiled>>);

struct Compiled {
    content: Content,
    list: DisplayList,
    /// Whether the picture at hand has called it.
    is_used: Cell<bool>,
}

impl DisplayLists {
    /// Lets go of the lists that the last picture did not call; of all of them where the next one calls none.
    pub(super) fn prepare(&self, submission: Submission) {
        let is_wanted = |compiled: &Compiled| compiled.is_used.replace(false) && submission == Submission::DisplayList;
        self.0.borrow_mut().retain(is_wanted);
    }

    /// Draws vertices by glBegin and glEnd, or by the list that has this content.
    pub(super) fn draw(
        &self,
        gl: &Rc<Gl>,
        submission: Submission,
        content: Content,
        vertices: &Vertices<'_>,
    ) -> Result<()> {
        let immediate = available(gl, submission)?;
        if submission == Submission::Immediate {
            // SAFETY: the context is current, and glBegin and glEnd are called in pairs and nowhere else.
            unsafe { immediate.send(vertices) };
            return Ok(());
        }
        // SAFETY: the context is current and the list alive.
        let call = |list: &DisplayList| unsafe { immediate.call(list.name()) };
        if let Some(known) = self.0.borrow().iter().find(|known| known.content == content) {
            known.is_used.set(true);
            call(&known.list);
            return Ok(());
        }
        let list = DisplayList::new(gl)?;
        // SAFETY: as above; the list is new.
        unsafe { immediate.compile(list.name(), vertices) };
        gl.check("compiling a display list")?;
        call(&list);
        if content != Content::Once {
            self.0.borrow_mut().push(Compiled { content, list, is_used: Cell::new(true) });
        }
        Ok(())
    }
}

/// The functions, if the driver has them.
pub(super) fn available(gl: &Gl, submission: Submission) -> Result<&Immediate> {
    gl.immediate.as_ref().map_err(|missing| {
        let problem = format!(
            "{} has no {missing}, by which programs of 2001 drew; leave this out, buffers draw the same picture",
            gl.info.renderer
        );
        Error::value("submission", submission, problem)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_list_is_known_by_what_is_in_it() {
        let mesh = Arc::new(Mesh::triangle());
        let faces = |mesh, part, unit| Content::Faces {
            mesh: Same::as_this(mesh),
            unit,
            list: None,
            part,
            coordinates: None,
            colors: None,
            own_unit: None,
            has_normals: false,
        };
        assert!(faces(&mesh, 0, 1.0) == faces(&mesh, 0, 1.0));
        assert!(faces(&mesh, 0, 1.0) != faces(&mesh, 1, 1.0) && faces(&mesh, 0, 1.0) != faces(&mesh, 0, 2.0));
        assert!(
            faces(&mesh, 0, 1.0) != faces(&Arc::new(Mesh::triangle()), 0, 1.0),
            "another mesh, though an equal one"
        );
        let runs = Arc::new(Vec::new());
        let (mesh, runs) = (|| Same::as_this(&mesh), || Same::as_this(&runs));
        let edges = |mark| Content::Edges { mesh: mesh(), unit: 1.0, runs: runs(), run: 0, mark };
        assert!(edges(Mark::Lines) == edges(Mark::Lines) && edges(Mark::Lines) != edges(Mark::Points));
    }
}
