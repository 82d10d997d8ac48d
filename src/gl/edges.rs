//! Edges drawn by GL from indices into the objects' own vertices. Lines therefore lie exactly on the faces next to them.

use super::Gl;
use super::buffers::EdgeIndices;
use super::execute::Resources;
use super::immediate::{Places, Vertices};
use super::legacy::{self, MODELVIEW, PROJECTION};
use super::meshes::of_another_scene;
use super::objects::Buffer;
use super::quads::{line_quads, point_quads};
use crate::error::{Error, Result};
use crate::plan::{Draw, EdgeRun, Mark, Submission};
use crate::scene::Scene;
use glam::{Mat4, Vec3};
use glow::HasContext;
use std::rc::Rc;
use std::sync::Arc;

/// Edges kept on the device: those of one plan, as lines, as points that join them, and as dots.
const MOST_KEPT: usize = 3;

impl EdgeIndices {
    fn new(gl: &Rc<Gl>, runs: &Arc<Vec<EdgeRun>>, mark: Mark) -> Result<Self> {
        let ends = |run: &EdgeRun| match mark {
            Mark::Lines => run.ends.as_flattened().to_vec(),
            Mark::Points => each_once(run.ends.as_flattened()),
        };
        let indices: Vec<Vec<u32>> = runs.iter().map(ends).collect();
        let buffer = Buffer::new(gl, glow::ELEMENT_ARRAY_BUFFER, bytemuck::cast_slice(&indices.concat()))?;
        let own = |vertices: &Vec<[f32; 6]>| Buffer::new(gl, glow::ARRAY_BUFFER, bytemuck::cast_slice(vertices));
        let own_vertices =
            runs.iter().map(|run| run.own_vertices.as_ref().map(own).transpose()).collect::<Result<_>>()?;
        Ok(Self { runs: runs.clone(), mark, indices, buffer, own_vertices })
    }
}

/// Returns the distinct numbers in order of first appearance. Where the text draws a point again, the depth test rejects the
/// repetition.
fn each_once(numbers: &[u32]) -> Vec<u32> {
    let mut is_known = vec![false; numbers.iter().max().map_or(0, |largest| *largest as usize + 1)];
    numbers.iter().copied().filter(|number| !std::mem::replace(&mut is_known[*number as usize], true)).collect()
}

impl Resources {
    /// Refuses faces as lines where the driver has none of this width, and in a browser, which has none at all.
    pub(super) fn check_back_faces(&self, draw: &Draw) -> Result<()> {
        let info = &self.gl.info;
        let has_lines = |width_px: f32| self.has_pipeline && info.draws_lines(width_px);
        match draw.back_faces_as_lines.filter(|width_px| !has_lines(*width_px)) {
            None => Ok(()),
            Some(width_px) => {
                let instead = if self.has_pipeline { "give a smaller one" } else { "choose another style" };
                let problem = format!("{} does not draw faces as lines of this width; {instead}", info.renderer);
                Err(Error::value("line-width", width_px, problem))
            }
        }
    }

    /// Sets which faces are drawn, and whether filled or as lines.
    pub(super) fn set_sides(&self, draw: &Draw) {
        let (gl, as_lines) = (&self.gl.glow, draw.back_faces_as_lines);
        // SAFETY: the context is current; the names are of GL 2.1.
        unsafe {
            gl.cull_face(if as_lines.is_some() { glow::FRONT } else { glow::BACK });
            if self.has_pipeline {
                gl.polygon_mode(glow::FRONT_AND_BACK, if as_lines.is_some() { glow::LINE } else { glow::FILL });
            }
            if let Some(width_px) = as_lines {
                gl.disable(glow::LINE_SMOOTH);
                gl.line_width(width_px);
            }
        }
        self.gl.cull(draw.cull_back_faces || as_lines.is_some());
    }

    /// GL_LINES or GL_POINTS.
    pub(super) fn draw_edges(
        &mut self,
        scene: &Scene,
        runs: &Arc<Vec<EdgeRun>>,
        mark: Mark,
        width_px: f32,
        is_smooth: bool,
    ) -> Result<()> {
        let is_it = |edges: &EdgeIndices| edges.mark == mark && Arc::ptr_eq(&edges.runs, runs);
        if !self.edges.iter().any(is_it) {
            self.edges.truncate(MOST_KEPT - 1);
            self.edges.insert(0, EdgeIndices::new(&self.gl, runs, mark)?);
        }
        let Some(edges) = self.edges.iter().find(|edges| is_it(edges)) else { return Ok(()) };
        let (mode, smooth) = smoothed(mark);
        self.set_width(width_px, smooth, is_smooth);
        // SAFETY: the context is current.
        unsafe { self.gl.legacy.load_matrix(PROJECTION, &self.in_tile(scene.clip_from_view())) };
        let mut first = 0;
        for (number, (run, indices)) in runs.iter().zip(&edges.indices).enumerate() {
            let object = scene.objects.get(run.object).ok_or_else(of_another_scene)?;
            let buffers = self.find_mesh(&object.mesh).ok_or_else(of_another_scene)?;
            let vertex_count = run.own_vertices.as_ref().map_or(buffers.vertex_count, Vec::len);
            if run.ends.as_flattened().iter().any(|end| *end as usize >= vertex_count) {
                return Err(of_another_scene());
            }
            // SAFETY: the context is current.
            unsafe {
                self.gl.legacy.load_matrix(MODELVIEW, &scene.view_from_object(object, buffers.centre));
                self.gl.legacy.color(run.color);
            }
            if self.submission == Submission::Buffers {
                match &edges.own_vertices[number] {
                    None => buffers.bind(&self.gl, None),
                    Some(vertices) => {
                        vertices.bind();
                        // SAFETY: the context is current and the bound buffer holds interleaved positions and normals.
                        unsafe { self.gl.legacy.position_and_normal_arrays() };
                    }
                }
                edges.buffer.bind();
                // SAFETY: the context is current; the run lies within the bound index buffer, and its indices within the bound
                // vertex buffer, both checked above.
                unsafe {
                    let first_byte = (first * size_of::<u32>()) as i32;
                    self.gl.legacy.draw_elements(&self.gl.glow, mode, indices.len() as i32, first_byte);
                }
            } else {
                let places = Places::Positions(run.vertices(scene.arrays(object)));
                self.gl.draw_in_immediate_mode(&Vertices::new(mode, places, indices))?;
            }
            first += indices.len();
        }
        if is_smooth {
            // SAFETY: the context is current.
            unsafe { self.gl.glow.disable(smooth) };
            self.draw_unseen()?;
        }
        Ok(())
    }

    /// Sets how wide lines and points are drawn, and whether smoothed by this capability.
    fn set_width(&self, width_px: f32, capability: u32, is_smooth: bool) {
        // SAFETY: the context is current; widths are finite and above 0, which the style has checked.
        unsafe {
            match is_smooth {
                true => self.gl.glow.enable(capability),
                false if self.has_pipeline => self.gl.glow.disable(capability),
                false => {}
            }
            self.gl.glow.line_width(width_px);
            self.gl.legacy.point_size(width_px);
        }
    }

    /// An invisible draw. Mesa 22's llvmpipe keeps the state of smoothed lines and points for the next draw, which then loses its
    /// polygon offset and culling; this draw absorbs that fault.
    fn draw_unseen(&self) -> Result<()> {
        // SAFETY: the context is current; the depth mask is set again before anything else is drawn or cleared.
        unsafe {
            self.gl.glow.color_mask(false, false, false, false);
            self.gl.glow.depth_mask(false);
            self.gl.legacy.load_matrix(PROJECTION, &Mat4::IDENTITY);
            self.gl.legacy.load_matrix(MODELVIEW, &Mat4::from_scale(Vec3::splat(0.5)));
        }
        let drawn = self.draw_corners(glow::LINES, 0, 2);
        // SAFETY: the context is current.
        unsafe { self.gl.glow.color_mask(true, true, true, true) };
        drawn
    }

    /// Draws quads of the requested width, for drivers whose lines or points are narrower.
    pub(super) fn draw_edge_quads(&mut self, scene: &Scene, runs: &[EdgeRun], mark: Mark, width_px: f32) -> Result<()> {
        for run in runs {
            let object = scene.objects.get(run.object).ok_or_else(of_another_scene)?;
            let arrays = scene.arrays(object);
            let clip_from_object = scene.clip_from_view() * scene.view_from_object(object, arrays.centre);
            let in_clip_space = |vertex: &u32| {
                let [x, y, z, ..] = *run.vertices(arrays).get(*vertex as usize)?;
                Some(clip_from_object * Vec3::new(x, y, z).extend(1.0))
            };
            let ends = run.ends.iter().filter_map(|[a, b]| Some([in_clip_space(a)?, in_clip_space(b)?]));
            let quads = match mark {
                Mark::Lines => line_quads(ends, self.tile.whole, width_px),
                Mark::Points => point_quads(ends, self.tile.whole, width_px),
            };
            // SAFETY: the context is current.
            unsafe {
                self.gl.legacy.load_matrix(PROJECTION, &self.in_tile(Mat4::IDENTITY));
                self.gl.legacy.load_matrix(MODELVIEW, &Mat4::IDENTITY);
                self.gl.legacy.color(run.color);
            }
            if self.submission != Submission::Buffers {
                let (indices, places) = ((0..quads.len() as u32).collect::<Vec<u32>>(), Places::Clip(&quads));
                self.gl.draw_in_immediate_mode(&Vertices::new(legacy::QUADS, places, &indices))?;
                continue;
            }
            let buffer = Buffer::new(&self.gl, glow::ARRAY_BUFFER, bytemuck::cast_slice(&quads))?;
            buffer.bind();
            // SAFETY: the context is current and the bound buffer holds four numbers for each vertex drawn.
            unsafe {
                self.gl.legacy.clip_position_array();
                self.gl.legacy.draw_arrays(&self.gl.glow, legacy::QUADS, 0, quads.len() as i32);
            }
        }
        Ok(())
    }
}

/// The GL primitive of a mark, and the capability that smooths it.
fn smoothed(mark: Mark) -> (u32, u32) {
    match mark {
        Mark::Lines => (glow::LINES, glow::LINE_SMOOTH),
        Mark::Points => (glow::POINTS, legacy::POINT_SMOOTH),
    }
}

#[cfg(test)]
mod tests {
    #[test]
    fn each_end_is_a_point_once_in_order_of_appearance() {
        assert_eq!(super::each_once(&[5, 2, 2, 7, 5, 0]), [5, 2, 7, 0]);
        assert!(super::each_once(&[]).is_empty());
    }
}
