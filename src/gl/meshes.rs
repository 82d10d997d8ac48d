//! The scene's meshes on the device, and how they are drawn.

use super::Gl;
use super::execute::Resources;
use super::legacy::{MODELVIEW, PROJECTION};
use super::objects::Buffer;
use crate::error::{Error, Result};
use crate::mesh::{Mesh, Part, VertexArrays};
use crate::plan::Paint;
use crate::scene::{Color, Scene};
use glam::DVec3;
use glow::HasContext;
use std::rc::Rc;
use std::sync::Arc;

/// A mesh on the device.
pub(super) struct MeshBuffers {
    mesh: Arc<Mesh>,
    unit: f64,
    pub(super) centre: DVec3,
    pub(super) vertex_count: usize,
    vertices: Buffer,
    texture_coordinates: Option<Buffer>,
    indices: Buffer,
    parts: Vec<Part>,
}

impl Resources {
    /// Uploads the scene's meshes that are not there yet and lets go of others.
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

    pub(super) fn find_mesh(&self, mesh: &Arc<Mesh>) -> Option<&MeshBuffers> {
        self.meshes.iter().find(|buffers| Arc::ptr_eq(&buffers.mesh, mesh))
    }

    /// Draws all objects; their own texture coordinates go to this unit.
    pub(super) fn draw_objects(&mut self, scene: &Scene, paint: &Paint, material_unit: Option<u32>) -> Result<()> {
        // SAFETY: the context is current.
        unsafe { self.gl.legacy.load_matrix(PROJECTION, &scene.clip_from_view()) };
        let mut bound = None;
        let mut streamed = None;
        for (number, object) in scene.objects.iter().enumerate() {
            let buffers = self.find_mesh(&object.mesh).ok_or_else(of_another_scene)?;
            let list = match paint {
                Paint::Coordinates(lists) => {
                    let list = lists.get(number).filter(|list| list.len() == buffers.vertex_count);
                    Some(list.ok_or_else(of_another_scene)?)
                }
                Paint::Materials | Paint::Uniform(_) => None,
            };
            // Copies share both mesh and list.
            let wanted = (Arc::as_ptr(&object.mesh), list.map(Arc::as_ptr));
            if bound != Some(wanted) {
                buffers.bind(&self.gl, material_unit);
                if let Some(list) = list {
                    // The one before is deleted only now, after the draws that read it.
                    streamed = Some(Buffer::new(&self.gl, glow::ARRAY_BUFFER, bytemuck::cast_slice(list))?);
                    // SAFETY: the context is current; the buffer just bound has coordinates for every vertex.
                    unsafe { self.gl.legacy.texture_coordinate_array(0) };
                }
                bound = Some(wanted);
            }
            // SAFETY: the context is current.
            unsafe { self.gl.legacy.load_matrix(MODELVIEW, &scene.view_from_object(object, buffers.centre)) };
            for part in &buffers.parts {
                let color = match paint {
                    Paint::Materials => {
                        let Color([red, green, blue]) = scene.material_color(&object.mesh, part.material);
                        [red, green, blue, 1.0]
                    }
                    Paint::Uniform(color) => *color,
                    Paint::Coordinates(_) => [1.0; 4],
                };
                if let Some(unit) = material_unit {
                    self.textures.bind_material(scene, object, part.material, unit)?;
                }
                // SAFETY: the context is current; the part lies within the bound index buffer, whose indices lie within the
                // bound vertex buffers, both by construction of `VertexArrays`.
                unsafe {
                    self.gl.legacy.color(color);
                    let first_byte = part.first as i32 * size_of::<u32>() as i32;
                    self.gl.glow.draw_elements(glow::TRIANGLES, part.count as i32, glow::UNSIGNED_INT, first_byte);
                }
            }
        }
        drop(streamed);
        Ok(())
    }
}

/// A plan's lists are by the scene's objects and vertices.
pub(super) fn of_another_scene() -> Error {
    Error::gl("drawing", "a plan was made for another scene")
}

impl MeshBuffers {
    /// Makes the mesh's arrays those that are drawn; its own texture coordinates go to this unit.
    pub(super) fn bind(&self, gl: &Gl, material_unit: Option<u32>) {
        self.vertices.bind();
        // SAFETY: the context is current and the bound buffer holds interleaved positions and normals.
        unsafe { gl.legacy.position_and_normal_arrays() };
        if let (Some(unit), Some(coordinates)) = (material_unit, &self.texture_coordinates) {
            coordinates.bind();
            // SAFETY: the context is current and the bound buffer has coordinates for every vertex.
            unsafe { gl.legacy.texture_coordinate_array(unit) };
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
