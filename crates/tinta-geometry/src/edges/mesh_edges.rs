//! A mesh's edges with the data kept between views: the list, its classes, the faces' planes.

use super::axes::{Axis, axes};
use super::flat_faces::{areas, flat_faces};
use super::{
    Class, ClassSet, Classes, CreaseAngle, EdgeList, Eye, LastingCreases, SilhouetteRule, Silhouettes, SmoothSurface,
};
use crate::mesh::{Mesh, face_normals};
use crate::threads::threads_for;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

/// The edges of a mesh, to select the ones to draw.
#[derive(Debug)]
pub struct MeshEdges {
    mesh: Arc<Mesh>,
    list: EdgeList,
    silhouettes: OnceLock<Silhouettes>,
    /// For the latest settings.
    classes: Mutex<Option<(ClassSet, Arc<Classes>)>>,
    /// For the latest settings.
    lasting: Mutex<Option<Arc<LastingCreases>>>,
    is_flat: OnceLock<Vec<bool>>,
    /// For the latest angle.
    smooth: Mutex<Option<Arc<SmoothSurface>>>,
    axes: OnceLock<Vec<Axis>>,
}

impl MeshEdges {
    /// Builds the list; everything else is computed on first use.
    pub fn new(mesh: Arc<Mesh>) -> Self {
        let list = EdgeList::new(&mesh);
        Self::with_list(mesh, list)
    }

    /// Takes a list built from the mesh.
    pub(crate) fn with_list(mesh: Arc<Mesh>, list: EdgeList) -> Self {
        let (classes, lasting, smooth) = (Mutex::new(None), Mutex::new(None), Mutex::new(None));
        let (silhouettes, is_flat, axes) = (OnceLock::new(), OnceLock::new(), OnceLock::new());
        Self { mesh, list, silhouettes, classes, lasting, is_flat, smooth, axes }
    }

    /// The mesh.
    pub fn mesh(&self) -> &Arc<Mesh> {
        &self.mesh
    }

    /// The list.
    pub fn list(&self) -> &EdgeList {
        &self.list
    }

    /// Returns a sentence if open edges are so close to one another that they were probably meant to be one.
    pub fn remark(&self) -> Option<String> {
        let (pairs, share) = match super::cracks(&self.mesh, &self.list) {
            0 => return None,
            1 => ("1 pair of open edges runs".to_owned(), crate::tolerances::CRACK),
            count => (format!("{count} pairs of open edges run"), crate::tolerances::CRACK),
        };
        let percent = share * 100.0;
        Some(format!(
            "{}: {pairs} within {percent} % of the model's size of each other; --weld {share:e} joins them",
            self.mesh.name
        ))
    }

    /// Returns the static classes in `wanted`; keeps those of the latest settings.
    pub fn classes(&self, crease_angle: CreaseAngle, wanted: ClassSet) -> Arc<Classes> {
        let mut kept = self.classes.lock().unwrap_or_else(PoisonError::into_inner);
        match &*kept {
            Some((set, classes)) if *set == wanted && classes.crease_angle == crease_angle => classes.clone(),
            _ => {
                let classes = Arc::new(Classes::new(&self.mesh, &self.list, crease_angle, wanted));
                *kept = Some((wanted, classes.clone()));
                classes
            }
        }
    }

    /// Returns the lasting creases; keeps those of the latest settings.
    pub(crate) fn lasting(&self, angle: CreaseAngle, wanted: ClassSet, by_normals: bool) -> Arc<LastingCreases> {
        let mut kept = self.lasting.lock().unwrap_or_else(PoisonError::into_inner);
        match &*kept {
            Some(known) if (known.angle, known.wanted, known.by_normals) == (angle, wanted, by_normals) => {
                known.clone()
            }
            _ => {
                let of = (&*self.mesh, &self.list, self.flat_faces());
                let found = Arc::new(LastingCreases::find(of, angle, wanted, by_normals));
                *kept = Some(found.clone());
                found
            }
        }
    }

    fn flat_faces(&self) -> &[bool] {
        self.is_flat.get_or_init(|| flat_faces(&self.mesh, &self.list))
    }

    /// The area of flat faces of several triangles, and of all faces, in units of the model's own.
    pub(crate) fn areas(&self) -> [f64; 2] {
        areas(&self.mesh, self.flat_faces())
    }

    /// Returns the smooth surface that the faces approximate, sharp at creases of this angle; keeps the latest one.
    pub(crate) fn smooth(&self, crease_angle: CreaseAngle) -> Arc<SmoothSurface> {
        let mut kept = self.smooth.lock().unwrap_or_else(PoisonError::into_inner);
        match &*kept {
            Some(smooth) if smooth.crease_angle == crease_angle => smooth.clone(),
            _ => {
                let smooth = Arc::new(SmoothSurface::new(&self.mesh, &self.list, crease_angle));
                *kept = Some(smooth.clone());
                smooth
            }
        }
    }

    /// The axes of round surfaces.
    pub(crate) fn axes(&self) -> &[Axis] {
        self.axes.get_or_init(|| {
            let threads = threads_for(self.mesh.triangles.len());
            let smooth = CreaseAngle::of_drawings().cosine;
            axes(&self.mesh, &self.list, &face_normals(&self.mesh, threads), smooth, threads)
        })
    }

    /// The silhouette edges for an eye in the mesh's own coordinates, ascending.
    pub fn silhouette(&self, eye: Eye, rule: SilhouetteRule) -> Vec<u32> {
        let silhouettes = self.silhouettes.get_or_init(|| Silhouettes::new(&self.mesh, &self.list));
        silhouettes.find(&self.mesh, &self.list, eye, rule)
    }

    /// Returns the edges to draw, each with its first class in `wanted`, in the order of [`Class::ALL`]. Ascending within a
    /// class.
    pub fn chosen(
        &self,
        wanted: ClassSet,
        crease_angle: CreaseAngle,
        eye: Eye,
        rule: SilhouetteRule,
    ) -> Vec<(Class, Vec<u32>)> {
        let silhouette = if wanted.contains(Class::Silhouette) { self.silhouette(eye, rule) } else { Vec::new() };
        self.chosen_with(wanted, crease_angle, &silhouette)
    }

    /// Like [`MeshEdges::chosen`] with these silhouette edges, ascending.
    pub fn chosen_with(
        &self,
        wanted: ClassSet,
        crease_angle: CreaseAngle,
        silhouette: &[u32],
    ) -> Vec<(Class, Vec<u32>)> {
        let classes = self.classes(crease_angle, wanted);
        let mut lists: Vec<(Class, Vec<u32>)> = Class::ALL.into_iter().map(|(_, class)| (class, Vec::new())).collect();
        for edge in silhouette {
            // A silhouette edge has two faces, so it is neither boundary nor non-manifold, which come before.
            lists[Class::Silhouette as usize].1.push(*edge);
        }
        for edge in &classes.marked {
            let class = classes.of_edges[*edge as usize].first();
            let is_silhouette = || silhouette.binary_search(edge).is_ok();
            if let Some(class) = class.filter(|class| *class < Class::Silhouette || !is_silhouette()) {
                lists[class as usize].1.push(*edge);
            }
        }
        lists.retain(|(_, edges)| !edges.is_empty());
        lists
    }
}
