//! The scene's meshes on the device, and how they are drawn.

use super::Gl;
use super::execute::Resources;
use super::legacy::{MODELVIEW, PROJECTION};
use super::objects::Buffer;
use crate::error::{Error, Result};
use crate::mesh::{Mesh, Part, VertexArrays};
use crate::plan::{Draw, FaceList, Faces, Geometry, Paint, Plan, Step};
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

/// Some of an object's faces on the device.
pub(super) struct FaceIndices {
    list: Arc<FaceList>,
    buffer: Buffer,
}

/// Texture coordinates of an object's vertices on the device.
pub(super) struct Coordinates {
    list: Arc<Vec<[f32; 2]>>,
    buffer: Buffer,
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

    /// Uploads the texture coordinates this plan paints by that are not there yet and lets go of others.
    pub(super) fn upload_coordinates(&mut self, plan: &Plan) -> Result<()> {
        let is_painted = |(_, step): (_, &'_ Step)| match step {
            Step::Draw(Draw { geometry: Geometry::Objects(Paint::Coordinates(lists)), .. }) => Some(lists.clone()),
            _ => None,
        };
        let painted: Vec<_> = plan.steps().filter_map(is_painted).collect();
        let lists: Vec<&Arc<Vec<[f32; 2]>>> = painted.iter().flat_map(|lists| lists.iter()).collect();
        self.coordinates.retain(|present| lists.iter().any(|list| Arc::ptr_eq(list, &present.list)));
        for list in lists {
            if !self.coordinates.iter().any(|present| Arc::ptr_eq(list, &present.list)) {
                let buffer = Buffer::new(&self.gl, glow::ARRAY_BUFFER, bytemuck::cast_slice(list))?;
                self.coordinates.push(Coordinates { list: list.clone(), buffer });
            }
        }
        Ok(())
    }

    /// Uploads the lists of faces this plan draws that are not there yet and lets go of others.
    pub(super) fn upload_faces(&mut self, scene: &Scene, plan: &Plan) -> Result<()> {
        let lists: Vec<(usize, &Arc<FaceList>)> = plan
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

    /// Draws the objects, or these faces of them; their own texture coordinates go to this unit.
    pub(super) fn draw_objects(
        &mut self,
        scene: &Scene,
        paint: &Paint,
        faces: Option<&Vec<Faces>>,
        material_unit: Option<u32>,
    ) -> Result<()> {
        // SAFETY: the context is current.
        unsafe { self.gl.legacy.load_matrix(PROJECTION, &scene.clip_from_view()) };
        let mut bound = None;
        for (number, object) in scene.objects.iter().enumerate() {
            let listed = match faces.map_or(Some(&Faces::All), |faces| faces.get(number)) {
                Some(Faces::All) => None,
                Some(Faces::None) => continue,
                Some(Faces::Listed(list)) => Some(list),
                None => return Err(of_another_scene()),
            };
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
                    let present = self.coordinates.iter().find(|present| Arc::ptr_eq(list, &present.list));
                    present.ok_or_else(of_another_scene)?.buffer.bind();
                    // SAFETY: the context is current; the buffer just bound has coordinates for every vertex.
                    unsafe { self.gl.legacy.texture_coordinate_array(0) };
                }
                bound = Some(wanted);
            }
            // SAFETY: the context is current.
            unsafe { self.gl.legacy.load_matrix(MODELVIEW, &scene.view_from_object(object, buffers.centre)) };
            let mut parts = &buffers.parts;
            if let Some(list) = listed {
                let indices = self.faces.iter().find(|faces| Arc::ptr_eq(list, &faces.list));
                indices.ok_or_else(of_another_scene)?.buffer.bind();
                parts = &list.parts;
                // The next copy may be drawn whole.
                bound = None;
            }
            for part in parts {
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
