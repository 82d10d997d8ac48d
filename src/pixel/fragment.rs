//! One draw at one pixel: its vertices and the pixel itself, run by the interpreter.

use super::textures::{Images, OfTriangle};
use super::triangles::{Cover, Triangles};
use crate::error::{Error, Result};
use crate::glsl::BUILT_IN;
use crate::plan::{self, Blend, Depth, Draw};
use glam::{DMat3, Mat4};
use serde::Serialize;
use std::collections::HashMap;
use std::sync::{Mutex, PoisonError};
use tinta_glsl::{Base, Event, Mistake, Precision, Run, Settings, Stage, Trace, Type, Value};

/// The steps of a depth buffer of 24 bits.
const DEPTH_STEPS: f64 = 16_777_215.0;

/// Two depths this close are equal for GL_EQUAL: the driver's interpolation is not recomputed to its last bit.
const EQUAL_DEPTH_STEPS: f64 = 4.0;

/// A triangle that covers the pixel.
#[derive(Debug, Clone, Default, Serialize)]
pub struct Fragment {
    /// The object's number in the scene; `None` for a square over the picture.
    pub object: Option<usize>,
    /// The triangle's number in the object's mesh, from 0.
    pub triangle: usize,
    /// Whether the triangle faces the eye.
    pub is_front: bool,
    /// Its corners.
    pub corners: Vec<Corner>,
    /// The pixel's depth on it, 0 to 1.
    pub depth: f64,
    /// Whether it passes the depth test, which runs in drawing order; `None` without a test.
    pub is_nearer: Option<bool>,
    /// The shader's inputs that differ from pixel to pixel.
    pub varyings: Vec<(String, Value)>,
    /// What each statement of the fragment shader did; empty if the depth test failed.
    pub events: Vec<Event>,
    /// Whether the shader discarded it.
    pub is_discarded: bool,
    /// Red, green, blue and alpha that the shader wrote, for each texture of the target.
    pub colors: Vec<[f64; 4]>,
}

/// A corner of a triangle that covers the pixel.
#[derive(Debug, Clone, Serialize)]
pub struct Corner {
    /// Its share in the pixel, perspective included.
    pub share: f64,
    /// What each statement of the vertex shader did.
    pub events: Vec<Event>,
    /// What it passed on: varyings, and colours as GL clamps them.
    pub varyings: Vec<(String, Value)>,
}

impl Fragment {
    /// Whether it changes the pixel.
    pub fn is_written(&self) -> bool {
        self.is_nearer != Some(false) && !self.is_discarded
    }
}

/// A draw prepared for questions about its pixels.
pub(super) struct PreparedDraw<'a> {
    pub(super) draw: &'a Draw,
    pub(super) program: String,
    pub(super) vertex: Stage,
    pub(super) fragment: Stage,
    pub(super) triangles: Triangles<'a>,
    pub(super) samplers: Vec<&'static str>,
    pub(super) images: Images<'a>,
    pub(super) precision: Precision,
    /// What vertices passed on to untraced pixels, by group, vertex and material.
    pub(super) corners: Mutex<HashMap<(usize, u32, u32), Varyings>>,
    /// Rows of the surface.
    pub(super) height: u32,
    /// Whether it draws into textures, whose rows drivers count from below.
    pub(super) is_texture: bool,
}

type NamedValues<'a> = Vec<(&'a str, Value)>;

/// What a vertex passes on, by name.
type Varyings = Vec<(String, Value)>;

impl PreparedDraw<'_> {
    /// Runs every triangle that covers a pixel, in drawing order, from the depth that the driver held before.
    pub(super) fn fragments(&self, at: [u32; 2], depth: Option<f32>, trace: Trace) -> Result<Vec<Fragment>> {
        if !self.draw.scissor.is_none_or(|part| {
            (part.x..part.x + part.width).contains(&at[0]) && (part.y..part.y + part.height).contains(&at[1])
        }) {
            return Ok(Vec::new());
        }
        let mut held = depth.map_or(1.0, f64::from);
        let mut fragments = Vec::new();
        for cover in self.triangles.covering(at) {
            let is_culled = self.draw.cull_back_faces || self.draw.culls_doubled_faces && cover.triangle.is_doubled;
            if is_culled && !cover.is_front {
                continue;
            }
            let mut depth = cover.depth;
            if let Some([factor, units]) = self.draw.polygon_offset {
                let middle = [f64::from(at[0]) + 0.5, f64::from(at[1]) + 0.5];
                let slope = self.triangles.slope(cover.triangle, middle);
                depth = (depth + f64::from(factor) * slope + f64::from(units) / DEPTH_STEPS).clamp(0.0, 1.0);
            }
            let steps = |depth: f64| (depth * DEPTH_STEPS).round();
            let is_nearer = match self.draw.depth {
                Depth::Ignore => None,
                Depth::TestAndWrite | Depth::TestOnly => Some(steps(depth) < steps(held)),
                Depth::Equal => Some((steps(depth) - steps(held)).abs() <= EQUAL_DEPTH_STEPS),
            };
            let fragment = self.fragment(&cover, at, depth, is_nearer, trace)?;
            if fragment.is_written() && self.draw.depth == Depth::TestAndWrite {
                held = depth;
            }
            fragments.push(fragment);
        }
        Ok(fragments)
    }

    fn fragment(
        &self,
        cover: &Cover<'_>,
        at: [u32; 2],
        depth: f64,
        is_nearer: Option<bool>,
        trace: Trace,
    ) -> Result<Fragment> {
        let triangle = cover.triangle;
        let group = &self.triangles.groups[triangle.group];
        let mut fragment = Fragment {
            object: group.object,
            triangle: triangle.number,
            is_front: cover.is_front,
            depth,
            is_nearer,
            ..Fragment::default()
        };
        if is_nearer == Some(false) {
            return Ok(fragment);
        }
        for (corner, share) in triangle.corners.into_iter().zip(cover.shares.to_array()) {
            let (events, varyings) = self.corner(cover, corner, trace)?;
            fragment.corners.push(Corner { share, events, varyings });
        }
        let changes =
            if self.fragment.asks_neighbours() { self.changes(cover, at, &fragment.corners)? } else { Vec::new() };
        let middle = [f64::from(at[0]) + 0.5, f64::from(at[1]) + 0.5];
        let run = self.run_fragment(cover, middle, &fragment.corners, &changes, trace)?;
        fragment.varyings = self.interpolated(cover, &fragment.corners);
        fragment.is_discarded = run.is_discarded;
        let color = |name: &str| run.output(name).map(|color| std::array::from_fn(|n| color.numbers()[n]));
        let data = (0..).map_while(|number| color(&format!("gl_FragData[{number}]")));
        fragment.colors = color("gl_FragColor").into_iter().chain(data).collect();
        fragment.events = run.events;
        Ok(fragment)
    }

    /// What the vertex shader did for a corner, if everything is traced, and what it passed on.
    fn corner(&self, cover: &Cover<'_>, corner: u32, trace: Trace) -> Result<(Vec<Event>, Varyings)> {
        if trace == Trace::Everything {
            let run = self.run_vertex(cover, corner, trace)?;
            let varyings = self.passed(&run);
            return Ok((run.events, varyings));
        }
        let place = (cover.triangle.group, corner, cover.triangle.material);
        let known = || self.corners.lock().unwrap_or_else(PoisonError::into_inner);
        let varyings = known().get(&place).cloned();
        let varyings = match varyings {
            Some(varyings) => varyings,
            None => {
                let varyings = self.passed(&self.run_vertex(cover, corner, Trace::Nothing)?);
                known().insert(place, varyings.clone());
                varyings
            }
        };
        Ok((Vec::new(), varyings))
    }

    /// Runs the vertex shader for a corner.
    fn run_vertex(&self, cover: &Cover<'_>, corner: u32, trace: Trace) -> Result<Run> {
        let group = &self.triangles.groups[cover.triangle.group];
        let [x, y, z, nx, ny, nz] = group.vertices[corner as usize].map(f64::from);
        let matrix = |matrix: Mat4| Value::matrix(&matrix.to_cols_array().map(f64::from));
        let turn = DMat3::from_mat4(group.view_from_object.as_dmat4()).inverse().transpose();
        let vector = |numbers: [f32; 4]| Value::floats(&numbers.map(f64::from));
        let mut inputs: NamedValues<'_> = vec![
            ("gl_Vertex", Value::floats(&[x, y, z, 1.0])),
            ("gl_Normal", Value::floats(&[nx, ny, nz])),
            ("gl_Color", vector(group.color(cover.triangle, corner))),
            ("gl_MultiTexCoord0", vector(group.coordinate(0, corner))),
            ("gl_MultiTexCoord1", vector(group.coordinate(1, corner))),
            ("gl_ModelViewMatrix", matrix(group.view_from_object)),
            ("gl_ProjectionMatrix", matrix(group.clip_from_view)),
            ("gl_ModelViewProjectionMatrix", matrix(group.clip_from_view * group.view_from_object)),
            ("gl_NormalMatrix", Value::matrix(&turn.to_cols_array().map(|number| f64::from(number as f32)))),
        ];
        inputs.extend(self.uniforms());
        let settings = Settings { precision: self.precision, trace, changes: &[] };
        self.vertex.run(&inputs, &(), &settings).map_err(misunderstood)
    }

    /// The draw's uniforms, samplers among them.
    fn uniforms(&self) -> NamedValues<'_> {
        let value = |value: plan::Value| match value {
            plan::Value::Float(x) => Value::floats(&[f64::from(x)]),
            plan::Value::Int(x) => Value::int(x),
            plan::Value::Vec2(v) | plan::Value::TexelSize(v) | plan::Value::PixelPlace(v) => {
                Value::floats(&v.map(f64::from))
            }
            plan::Value::Vec3(v) => Value::floats(&v.map(f64::from)),
        };
        let sampler = |number: usize| Value::new(Type::vector(Base::Sampler, 1), &[number as f64]);
        let uniforms = self.draw.uniforms.iter().map(|uniform| (&*uniform.name, value(uniform.value)));
        uniforms.chain(self.samplers.iter().enumerate().map(|(number, name)| (*name, sampler(number)))).collect()
    }

    /// What a vertex passes on, by the names that the fragment shader reads.
    fn passed(&self, run: &Run) -> Vec<(String, Value)> {
        let mut names: Vec<(&str, &str)> = self.fragment.varyings().into_iter().map(|name| (name, name)).collect();
        names.extend([("gl_FrontColor", "gl_Color"), ("gl_FrontSecondaryColor", "gl_SecondaryColor")]);
        names.extend(["gl_TexCoord[0]", "gl_TexCoord[1]"].map(|name| (name, name)));
        let passed = names.into_iter().filter_map(|(written, read)| {
            let value = run.output(written)?;
            // GL 2.1 clamps colours on their way.
            let is_color = written != read;
            Some((read.to_owned(), if is_color { value.map(|number| number.clamp(0.0, 1.0)) } else { value }))
        });
        passed.collect()
    }

    /// Varyings at the shares of a place.
    fn interpolated(&self, cover: &Cover<'_>, corners: &[Corner]) -> Vec<(String, Value)> {
        let shares = cover.shares.to_array();
        let names = corners[0].varyings.iter();
        let mixed = names.enumerate().map(|(place, (name, first))| {
            let mut value = first.map(|_| 0.0);
            for (corner, share) in corners.iter().zip(shares) {
                let (_, of_corner) = &corner.varyings[place];
                for (sum, number) in value.numbers_mut().iter_mut().zip(of_corner.numbers()) {
                    *sum += share * number;
                }
            }
            let kept =
                |number: f64| if self.precision == Precision::Single { f64::from(number as f32) } else { number };
            (name.clone(), value.map(kept))
        });
        mixed.collect()
    }

    /// Runs the fragment shader at a place of the triangle's plane.
    fn run_fragment(
        &self,
        cover: &Cover<'_>,
        [x, y]: [f64; 2],
        corners: &[Corner],
        changes: &[[Value; 2]],
        trace: Trace,
    ) -> Result<Run> {
        let varyings = self.interpolated(cover, corners);
        let kept = |number: f64| if self.precision == Precision::Single { f64::from(number as f32) } else { number };
        let mut inputs: NamedValues<'_> = vec![
            ("gl_FragCoord", Value::floats(&[x, y, kept(cover.depth), kept(cover.inverse_w)])),
            ("gl_FrontFacing", Value::bool(cover.is_front)),
        ];
        inputs.extend(varyings.iter().map(|(name, value)| (name.as_str(), *value)));
        for name in ["gl_Color", "gl_SecondaryColor", "gl_TexCoord[0]", "gl_TexCoord[1]"] {
            if !inputs.iter().any(|(known, _)| *known == name) {
                inputs.push((name, Value::floats(&[0.0; 4])));
            }
        }
        inputs.extend(self.uniforms());
        let group = &self.triangles.groups[cover.triangle.group];
        let textures = OfTriangle { images: &self.images, object: group.object, material: cover.triangle.material };
        let settings = Settings { precision: self.precision, trace, changes };
        self.fragment.run(&inputs, &textures, &settings).map_err(misunderstood)
    }

    /// Runs the four pixels that drivers shade together, and returns how the values asked for change: along x in this pixel's row,
    /// along y in its column.
    fn changes(&self, cover: &Cover<'_>, at: [u32; 2], corners: &[Corner]) -> Result<Vec<[Value; 2]>> {
        let asked = |x: i64, y: i64| -> Result<Vec<Value>> {
            let place = [x as f64 + 0.5, y as f64 + 0.5];
            let Some(there) = self.triangles.at(cover.triangle, place) else { return Ok(Vec::new()) };
            Ok(self.run_fragment(&there, place, corners, &[], Trace::Nothing)?.asked)
        };
        let [x, y] = at.map(i64::from);
        let (left, top) = (x & !1, i64::from(self.height) - 1);
        // Windows are drawn from their upper row, textures from their lowest.
        let low = if self.is_texture { y & !1 } else { top - ((top - y) | 1) };
        let minus = |high: &Value, low: &Value| {
            let mut change = *high;
            change.numbers_mut().iter_mut().zip(low.numbers()).for_each(|(high, low)| *high -= low);
            change
        };
        let (along_x, along_y) = ([asked(left, y)?, asked(left + 1, y)?], [asked(x, low)?, asked(x, low + 1)?]);
        let pairs = along_x[0].iter().zip(&along_x[1]).zip(along_y[0].iter().zip(&along_y[1]));
        Ok(pairs.map(|((left, right), (low, high))| [minus(right, left), minus(high, low)]).collect())
    }
}

/// Combines a colour with the one that is there.
pub(super) fn blended(blend: Blend, source: [f64; 4], there: [f64; 4]) -> [f64; 4] {
    let alpha = source[3];
    match blend {
        Blend::Replace => source,
        Blend::Over => {
            let over = |channel: usize| source[channel] * alpha + there[channel] * (1.0 - alpha);
            [over(0), over(1), over(2), alpha + there[3] * (1.0 - alpha)]
        }
        Blend::Multiply => [0, 1, 2, 3].map(|n| if n == 3 { there[3] } else { source[n] * there[n] }),
    }
}

/// What the interpreter says of a shader, as an error.
pub(super) fn misunderstood(mistake: Mistake) -> Error {
    let Mistake { path, line, problem } = mistake;
    Error::Statement { path: format!("{BUILT_IN}{path}"), line, problem }
}
