//! The scene's meshes on the device, and their drawing.

use super::Gl;
use super::buffers::{FaceIndices, MeshBuffers, OfVertices};
use super::execute::Resources;
use super::immediate::{Places, Vertices};
use super::legacy::{FIXED_UNITS, MODELVIEW, PROJECTION};
use super::objects::Buffer;
use crate::culling::DrawnFaces;
use crate::error::{Error, Result};
use crate::mesh::{Mesh, Part, VertexArrays};
use crate::plan::{Draw, Faces, Geometry, Paint, Plan, Step, Submission};
use crate::scene::{Object, Scene};
use std::rc::Rc;
use std::sync::Arc;

impl Resources {
    /// Uploads the scene's missing meshes and releases the others.
    pub(super) fn upload_meshes(&mut self, scene: &Scene) -> Result<()> {
        let is_used = |buffers: &MeshBuffers| {
            buffers.unit == scene.radius && scene.objects.iter().any(|object| Arc::ptr_eq(&object.mesh, &buffers.mesh))
        };
        self.meshes.retain(is_used);
        for object in &scene.objects {
            if self.find_mesh(&object.mesh).is_none() {
                self.meshes.push(MeshBuffers::new(&self.gl, &object.mesh, scene.radius, scene.arrays(object))?);
            }
        }
        Ok(())
    }

    /// Uploads the missing texture coordinates and colours that this plan paints with, and releases the others.
    pub(super) fn upload_paint(&mut self, plan: &Plan) -> Result<()> {
        let (mut coordinates, mut colors) = (Vec::new(), Vec::new());
        for (_, step) in plan.steps() {
            match step {
                Step::Draw(Draw { geometry: Geometry::Objects(Paint::Coordinates(lists)), .. }) => {
                    coordinates.extend(lists.iter());
                }
                Step::Draw(Draw { geometry: Geometry::Objects(Paint::Colors(lists)), .. }) => {
                    colors.extend(lists.iter());
                }
                _ => {}
            }
        }
        upload(&self.gl, &mut self.coordinates, &coordinates)?;
        upload(&self.gl, &mut self.colors, &colors)
    }

    /// Uploads the missing lists of faces that this plan draws, and releases the others.
    pub(super) fn upload_faces(&mut self, scene: &Scene, plan: &Plan) -> Result<()> {
        let lists: Vec<(usize, &Arc<DrawnFaces>)> = plan
            .steps()
            .filter_map(
                |(_, step)| if let Step::Draw(Draw { faces: Some(faces), .. }) = step { Some(faces) } else { None },
            )
            .flat_map(|faces| faces.iter().enumerate())
            .filter_map(|(object, faces)| if let Faces::Listed(list) = faces { Some((object, list)) } else { None })
            .collect();
        self.faces.retain(|faces| lists.iter().any(|(_, list)| Arc::ptr_eq(list, &faces.list)));
        for (object, list) in lists {
            if self.faces.iter().any(|faces| Arc::ptr_eq(list, &faces.list)) {
                continue;
            }
            let mesh = scene.objects.get(object).and_then(|object| self.find_mesh(&object.mesh));
            let vertex_count = mesh.ok_or_else(of_another_scene)?.vertex_count;
            let lies_within = |part: &Part| (part.first + part.count) as usize <= list.indices.len();
            if list.indices.iter().any(|index| *index as usize >= vertex_count) || !list.parts.iter().all(lies_within) {
                return Err(of_another_scene());
            }
            let buffer = Buffer::new(&self.gl, glow::ELEMENT_ARRAY_BUFFER, bytemuck::cast_slice(&list.indices))?;
            self.faces.push(FaceIndices { list: list.clone(), buffer });
        }
        Ok(())
    }

    pub(super) fn find_mesh(&self, mesh: &Arc<Mesh>) -> Option<&MeshBuffers> {
        self.meshes.iter().find(|buffers| Arc::ptr_eq(&buffers.mesh, mesh))
    }

    /// Draws the objects, or the faces that the draw lists; this unit gets their own texture coordinates.
    pub(super) fn draw_objects(
        &mut self,
        scene: &Scene,
        draw: &Draw,
        paint: &Paint,
        material_unit: Option<u32>,
    ) -> Result<()> {
        // SAFETY: the context is current.
        unsafe { self.gl.legacy.load_matrix(PROJECTION, &self.in_tile(scene.clip_from_view())) };
        let mut bound = None;
        for (number, object) in scene.objects.iter().enumerate() {
            let listed = match draw.faces.as_ref().map_or(Some(&Faces::All), |faces| faces.get(number)) {
                Some(Faces::All) => None,
                Some(Faces::None) => continue,
                Some(Faces::Listed(list)) => Some(list),
                None => return Err(of_another_scene()),
            };
            let buffers = self.find_mesh(&object.mesh).ok_or_else(of_another_scene)?;
            let lists = PaintLists::of(paint, number, buffers.vertex_count)?;
            // SAFETY: the context is current.
            unsafe { self.gl.legacy.load_matrix(MODELVIEW, &scene.view_from_object(object, buffers.centre)) };
            let parts = listed.map_or(&buffers.parts, |list| &list.parts);
            if self.submission == Submission::Buffers {
                // Copies share both mesh and lists.
                let wanted =
                    (Arc::as_ptr(&object.mesh), lists.coordinates.map(Arc::as_ptr), lists.colors.map(Arc::as_ptr));
                if bound != Some(wanted) {
                    buffers.bind(&self.gl, material_unit);
                    self.bind_paint(&lists)?;
                }
                if let Some(list) = listed {
                    let indices = self.faces.iter().find(|faces| Arc::ptr_eq(list, &faces.list));
                    indices.ok_or_else(of_another_scene)?.buffer.bind();
                }
                // After a list of faces the next copy may be drawn whole.
                bound = listed.is_none().then_some(wanted);
            }
            for part in parts.iter() {
                if let Some(unit) = material_unit {
                    self.textures.bind_material(object, part.material, unit);
                }
                if draw.culls_doubled_faces {
                    self.gl.cull(draw.cull_back_faces || part.is_doubled);
                }
                // SAFETY: the context is current.
                unsafe { self.gl.legacy.color(paint.color(scene, object, part.material)) };
                if self.submission != Submission::Buffers {
                    let has_normals = draw.program.is_some();
                    let faces = RunOfFaces { object, listed, part, lists, material_unit, has_normals };
                    self.send_faces(scene, &faces)?;
                    continue;
                }
                // SAFETY: the context is current; the part lies within the bound index buffer, whose indices lie within the
                // bound vertex buffers, both by construction of `VertexArrays`.
                unsafe {
                    let first_byte = part.first as i32 * size_of::<u32>() as i32;
                    self.gl.legacy.draw_elements(&self.gl.glow, glow::TRIANGLES, part.count as i32, first_byte);
                }
            }
        }
        Ok(())
    }

    /// Binds lists of texture coordinates and of colours.
    fn bind_paint(&self, lists: &PaintLists<'_>) -> Result<()> {
        if let Some(list) = lists.coordinates {
            buffer_of(&self.coordinates, list)?.bind();
            // SAFETY: the context is current; the buffer just bound has coordinates for every vertex.
            unsafe { self.gl.legacy.texture_coordinate_array(0, 2) };
        }
        if let Some(list) = lists.colors {
            buffer_of(&self.colors, list)?.bind();
            // SAFETY: the context is current; the buffer just bound has a colour for every vertex.
            unsafe { self.gl.legacy.color_array() };
        }
        Ok(())
    }

    /// Draws a run of faces without buffers.
    fn send_faces(&self, scene: &Scene, faces: &RunOfFaces<'_>) -> Result<()> {
        let RunOfFaces { object, listed, part, lists, material_unit, has_normals } = *faces;
        let arrays = scene.arrays(object);
        let own_unit = material_unit.filter(|_| !arrays.texture_coordinates.is_empty());
        let mut coordinates = [None; FIXED_UNITS as usize];
        coordinates[0] = lists.coordinates.map(|list| list.as_slice());
        if let Some(slot) = own_unit.and_then(|unit| coordinates.get_mut(unit as usize)) {
            *slot = Some(arrays.texture_coordinates.as_slice());
        }
        let indices = listed.map_or(&arrays.indices, |list| &list.indices);
        let vertices = Vertices {
            mode: glow::TRIANGLES,
            places: match has_normals {
                true => Places::PositionsAndNormals(&arrays.vertices),
                false => Places::Positions(&arrays.vertices),
            },
            indices: &indices[part.first as usize..][..part.count as usize],
            colors: lists.colors.map(|list| list.as_slice()),
            coordinates,
        };
        self.gl.draw_in_immediate_mode(&vertices)
    }
}

/// Faces of an object that share a material.
#[derive(Clone, Copy)]
struct RunOfFaces<'a> {
    object: &'a Object,
    /// The list they are in, if not all of the object's faces are drawn.
    listed: Option<&'a Arc<DrawnFaces>>,
    /// The run of the list or object.
    part: &'a Part,
    lists: PaintLists<'a>,
    material_unit: Option<u32>,
    has_normals: bool,
}

/// Uploads missing lists and releases unused ones.
fn upload<T: bytemuck::NoUninit>(gl: &Rc<Gl>, present: &mut Vec<OfVertices<T>>, wanted: &[&Arc<Vec<T>>]) -> Result<()> {
    present.retain(|present| wanted.iter().any(|list| Arc::ptr_eq(list, &present.list)));
    for list in wanted {
        if !present.iter().any(|present| Arc::ptr_eq(list, &present.list)) {
            let buffer = Buffer::new(gl, glow::ARRAY_BUFFER, bytemuck::cast_slice(list))?;
            present.push(OfVertices { list: Arc::clone(list), buffer });
        }
    }
    Ok(())
}

/// Returns the buffer of a list.
fn buffer_of<'a, T>(present: &'a [OfVertices<T>], list: &Arc<Vec<T>>) -> Result<&'a Buffer> {
    let found = present.iter().find(|present| Arc::ptr_eq(list, &present.list));
    found.map(|present| &present.buffer).ok_or_else(of_another_scene)
}

/// A paint's data for each vertex of an object.
#[derive(Clone, Copy, Default)]
struct PaintLists<'a> {
    coordinates: Option<&'a Arc<Vec<[f32; 2]>>>,
    colors: Option<&'a Arc<Vec<[f32; 4]>>>,
}

impl<'a> PaintLists<'a> {
    fn of(paint: &'a Paint, object: usize, vertex_count: usize) -> Result<Self> {
        fn list<T>(lists: &[Arc<Vec<T>>], object: usize, vertex_count: usize) -> Result<&Arc<Vec<T>>> {
            lists.get(object).filter(|list| list.len() == vertex_count).ok_or_else(of_another_scene)
        }
        Ok(match paint {
            Paint::Materials | Paint::Uniform(_) => Self::default(),
            Paint::Coordinates(lists) => {
                Self { coordinates: Some(list(lists, object, vertex_count)?), ..Self::default() }
            }
            Paint::Colors(lists) => Self { colors: Some(list(lists, object, vertex_count)?), ..Self::default() },
        })
    }
}

/// Returns an error if a plan's lists do not fit the scene's objects and vertices.
pub(super) fn of_another_scene() -> Error {
    Error::gl("drawing", "a plan was made for another scene")
}

impl MeshBuffers {
    /// Binds the mesh's arrays for drawing; this unit gets its own texture coordinates.
    pub(super) fn bind(&self, gl: &Gl, material_unit: Option<u32>) {
        self.vertices.bind();
        // SAFETY: the context is current and the bound buffer holds interleaved positions and normals.
        unsafe { gl.legacy.position_and_normal_arrays() };
        if let (Some(unit), Some(coordinates)) = (material_unit, &self.texture_coordinates) {
            coordinates.bind();
            // SAFETY: the context is current and the bound buffer has coordinates for every vertex.
            unsafe { gl.legacy.texture_coordinate_array(unit, 2) };
        }
        self.indices.bind();
    }

    fn new(gl: &Rc<Gl>, mesh: &Arc<Mesh>, unit: f64, arrays: &VertexArrays) -> Result<Self> {
        Ok(Self {
            mesh: mesh.clone(),
            unit,
            centre: arrays.centre,
            vertex_count: arrays.vertices.len(),
            vertices: Buffer::new(gl, glow::ARRAY_BUFFER, bytemuck::cast_slice(&arrays.vertices))?,
            texture_coordinates: match arrays.texture_coordinates.as_slice() {
                [] => None,
                coordinates => Some(Buffer::new(gl, glow::ARRAY_BUFFER, bytemuck::cast_slice(coordinates))?),
            },
            indices: Buffer::new(gl, glow::ELEMENT_ARRAY_BUFFER, bytemuck::cast_slice(&arrays.indices))?,
            parts: arrays.parts.clone(),
        })
    }
}
