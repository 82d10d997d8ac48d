//! The triangles of a draw as GL sees them: which of them cover a pixel's middle, and each corner's share there.

use crate::gl::square::Square;
use crate::mesh::{NONE, Part, VertexArrays};
use crate::plan::{Draw, Faces, Geometry, Paint};
use crate::scene::Scene;
use glam::{DMat3, DVec3, Mat4, Vec4};

/// The matrices and arrays that a group of triangles is drawn with.
pub(super) struct Group<'a> {
    /// The object's number in the scene; `None` for a square.
    pub(super) object: Option<usize>,
    pub(super) vertices: &'a [[f32; 6]],
    pub(super) view_from_object: Mat4,
    pub(super) clip_from_view: Mat4,
    /// A colour for each vertex; empty if the triangles have their own.
    colors: &'a [[f32; 4]],
    /// Texture coordinates for each vertex and texture unit; empty if there are none.
    coordinates: [&'a [[f32; 2]]; 2],
}

/// A triangle in clip space.
pub(super) struct Triangle {
    /// The number of its group.
    pub(super) group: usize,
    /// Its number in the object's mesh.
    pub(super) number: usize,
    /// Its corners, as places in the group's arrays.
    pub(super) corners: [u32; 3],
    /// The material of its part; [`NONE`] for none.
    pub(super) material: u32,
    /// Whether another lies on its back.
    pub(super) is_doubled: bool,
    /// The colour of its part.
    color: [f32; 4],
    clip: [Vec4; 3],
    /// Lowest and highest column and row that it may cover.
    bounds: [[f64; 2]; 2],
}

/// A triangle that covers a pixel.
pub(super) struct Cover<'a> {
    pub(super) triangle: &'a Triangle,
    /// Each corner's share, perspective included; together 1.
    pub(super) shares: DVec3,
    /// 0 at the near plane, 1 at the far one.
    pub(super) depth: f64,
    /// 1 over the distance, as `gl_FragCoord.w`.
    pub(super) inverse_w: f64,
    pub(super) is_front: bool,
}

/// All triangles of a draw, in drawing order.
pub(super) struct Triangles<'a> {
    pub(super) groups: Vec<Group<'a>>,
    all: Vec<Triangle>,
    /// For each row of the picture, from the lowest: the triangles that may cover pixels of it, in drawing order.
    rows: Vec<Vec<u32>>,
    size: [f64; 2],
    /// The pixel that will be asked for, if it is a single one.
    only_at: Option<[u32; 2]>,
    /// Parts of a pixel that the driver places corners at.
    steps: f64,
}

impl Group<'_> {
    /// Returns the colour of a triangle's corner.
    pub(super) fn color(&self, triangle: &Triangle, vertex: u32) -> [f32; 4] {
        self.colors.get(vertex as usize).copied().unwrap_or(triangle.color)
    }

    /// Returns a vertex's coordinate for a texture unit.
    pub(super) fn coordinate(&self, unit: usize, vertex: u32) -> [f32; 4] {
        let [s, t] = self.coordinates[unit].get(vertex as usize).copied().unwrap_or_default();
        [s, t, 0.0, 1.0]
    }
}

impl<'a> Triangles<'a> {
    /// Returns the triangles of a draw, or those near one pixel; none for edges. `subpixel_bits` is the driver's.
    pub(super) fn of(
        scene: &'a Scene,
        draw: &'a Draw,
        material_unit: Option<usize>,
        subpixel_bits: u32,
        only_at: Option<[u32; 2]>,
    ) -> Self {
        let size = [f64::from(scene.size.width), f64::from(scene.size.height)];
        let rows = vec![Vec::new(); scene.size.height as usize];
        let steps = f64::from(1_u32 << subpixel_bits.min(16));
        let mut triangles = Self { groups: Vec::new(), all: Vec::new(), rows, size, steps, only_at };
        if let Some(square) = Square::of(&draw.geometry) {
            triangles.groups.push(Group {
                object: None,
                vertices: square.corners,
                view_from_object: square.view_from_square,
                clip_from_view: square.clip_from_view,
                colors: &[],
                coordinates: [&[]; 2],
            });
            let clip = triangles.clip_of_last_group();
            let whole = Part { material: NONE, is_doubled: false, first: 0, count: 6 };
            for (number, corners) in [[0, 1, 2], [0, 2, 3]].into_iter().enumerate() {
                triangles.push((number, corners), &clip, &whole, square.color);
            }
        }
        if let Geometry::Objects(paint) = &draw.geometry {
            for number in 0..scene.objects.len() {
                triangles.push_object(scene, draw, paint, number, material_unit);
            }
        }
        triangles
    }

    fn push_object(&mut self, scene: &'a Scene, draw: &'a Draw, paint: &'a Paint, number: usize, unit: Option<usize>) {
        let object = &scene.objects[number];
        let arrays: &VertexArrays = scene.arrays(object);
        let (indices, parts) = match draw.faces.as_ref().and_then(|faces| faces.get(number)) {
            Some(Faces::None) => return,
            Some(Faces::Listed(list)) => (&list.indices, &list.parts),
            Some(Faces::All) | None => (&arrays.indices, &arrays.parts),
        };
        let (mut colors, mut coordinates): (&[[f32; 4]], [&[[f32; 2]]; 2]) = (&[], [&[]; 2]);
        match paint {
            Paint::Coordinates(lists) => coordinates[0] = lists.get(number).map_or(&[], |list| list.as_slice()),
            Paint::Colors(lists) => colors = lists.get(number).map_or(&[], |list| list.as_slice()),
            Paint::Materials | Paint::Uniform(_) => {}
        }
        if let Some(slot) = unit.and_then(|unit| coordinates.get_mut(unit)) {
            *slot = &arrays.texture_coordinates;
        }
        self.groups.push(Group {
            object: Some(number),
            vertices: &arrays.vertices,
            view_from_object: scene.view_from_object(object, arrays.centre),
            clip_from_view: scene.clip_from_view(),
            colors,
            coordinates,
        });
        let clip = self.clip_of_last_group();
        for part in parts {
            let color = paint.color(scene, object, part.material);
            let first = part.first as usize;
            for (place, corners) in indices[first..first + part.count as usize].as_chunks::<3>().0.iter().enumerate() {
                let place = first / 3 + place;
                let in_mesh = arrays.order.get(place).map_or(place, |number| *number as usize);
                self.push((in_mesh, *corners), &clip, part, color);
            }
        }
    }

    /// The camera's projection of the last group's vertices.
    fn clip_of_last_group(&self) -> Vec<Vec4> {
        let Some(group) = self.groups.last() else { return Vec::new() };
        let clip_from_object = group.clip_from_view * group.view_from_object;
        group.vertices.iter().map(|[x, y, z, ..]| clip_from_object * Vec4::new(*x, *y, *z, 1.0)).collect()
    }

    /// Adds a triangle of the last group, by its number, corners and projected vertices.
    fn push(&mut self, (number, corners): (usize, [u32; 3]), vertices: &[Vec4], of: &Part, color: [f32; 4]) {
        let clip = corners.map(|corner| vertices[corner as usize]);
        let mut bounds = [[0.0; 2], self.size];
        if clip.iter().all(|corner| corner.w > 0.0) {
            let places = clip.map(|corner| self.place(corner));
            for axis in 0..2 {
                bounds[0][axis] = places.iter().map(|place| place[axis]).fold(f64::INFINITY, f64::min) - 1.0;
                bounds[1][axis] = places.iter().map(|place| place[axis]).fold(f64::NEG_INFINITY, f64::max) + 1.0;
            }
        }
        if self.only_at.is_some_and(|[x, y]| !is_within(&bounds, [f64::from(x) + 0.5, f64::from(y) + 0.5])) {
            return;
        }
        let number_here = self.all.len() as u32;
        let (lowest, highest) = (bounds[0][1].max(0.0) as usize, bounds[1][1].max(0.0) as usize);
        self.rows.iter_mut().take(highest + 1).skip(lowest).for_each(|row| row.push(number_here));
        let Part { material, is_doubled, .. } = *of;
        let group = self.groups.len() - 1;
        self.all.push(Triangle { group, number, corners, material, is_doubled, color, clip, bounds });
    }

    /// Returns a corner's place in the picture, pixels from the lower left, as a driver computes it.
    fn place(&self, corner: Vec4) -> [f64; 2] {
        let inverse = 1.0 / corner.w;
        [0, 1].map(|axis| {
            let half = self.size[axis] as f32 * 0.5;
            f64::from(corner[axis] * inverse * half + half)
        })
    }

    /// Returns the triangles that cover a pixel's middle, in drawing order.
    pub(super) fn covering(&self, [x, y]: [u32; 2]) -> impl Iterator<Item = Cover<'_>> {
        let middle = [f64::from(x) + 0.5, f64::from(y) + 0.5];
        let is_near = move |triangle: &&Triangle| is_within(&triangle.bounds, middle);
        let row = self.rows.get(y as usize).map_or(&[][..], Vec::as_slice);
        row.iter().map(|number| &self.all[*number as usize]).filter(is_near).filter_map(move |triangle| {
            let cover = self.at(triangle, middle)?;
            let is_within = match triangle.clip.iter().all(|corner| corner.w > 0.0) {
                true => self.covers(triangle, middle),
                // Cut by the eye's plane: the part before it, by the shares' signs.
                false => cover.inverse_w > 0.0 && cover.shares.min_element() >= 0.0,
            };
            (is_within && (0.0..=1.0).contains(&cover.depth)).then_some(cover)
        })
    }

    /// Whether a triangle covers a pixel's middle by GL's rule: within its edges, their ends in steps of the driver; on an edge
    /// if it is an upper or left one.
    fn covers(&self, triangle: &Triangle, middle: [f64; 2]) -> bool {
        // y down, because drivers draw windows so.
        let place = |corner| {
            let [x, y] = self.place(corner);
            // Counted from a pixel's middle: halves are rounded away from it.
            [((x - 0.5) * self.steps).round(), ((self.size[1] - y - 0.5) * self.steps).round()]
        };
        let [a, b, c] = triangle.clip.map(place);
        let middle = [(middle[0] - 0.5) * self.steps, (self.size[1] - middle[1] - 0.5) * self.steps];
        let area = cross(a, b, c);
        if area == 0.0 {
            return false;
        }
        let corners = if area > 0.0 { [a, b, c] } else { [a, c, b] };
        (0..3).all(|number| {
            let (from, to) = (corners[number], corners[(number + 1) % 3]);
            let side = cross(from, to, middle);
            // Clockwise with y down: upper edges run right, left ones up.
            let is_owner = (from[1] == to[1] && to[0] > from[0]) || to[1] < from[1];
            side > 0.0 || (side == 0.0 && is_owner)
        })
    }

    /// Returns a triangle's shares at a place of its plane, also outside of it; `None` if it is seen edge-on.
    pub(super) fn at<'t>(&self, triangle: &'t Triangle, place: [f64; 2]) -> Option<Cover<'t>> {
        let clip = triangle.clip.map(|corner| corner.as_dvec4());
        let columns = clip.map(|corner| DVec3::new(corner.x, corner.y, corner.w));
        let matrix = DMat3::from_cols(columns[0], columns[1], columns[2]);
        let determinant = matrix.determinant();
        if determinant == 0.0 || !determinant.is_finite() {
            return None;
        }
        let ndc = [0, 1].map(|axis| place[axis] / self.size[axis] * 2.0 - 1.0);
        // Each corner's share over its w: linear in the picture.
        let linear = matrix.inverse() * DVec3::new(ndc[0], ndc[1], 1.0);
        let inverse_w = linear.element_sum();
        let depth = linear.dot(DVec3::new(clip[0].z, clip[1].z, clip[2].z)) * 0.5 + 0.5;
        Some(Cover { triangle, shares: linear / inverse_w, depth, inverse_w, is_front: determinant > 0.0 })
    }

    /// The steepest change of depth from pixel to pixel, along x or y.
    pub(super) fn slope(&self, triangle: &Triangle, [x, y]: [f64; 2]) -> f64 {
        let depth = |place| self.at(triangle, place).map_or(0.0, |cover| cover.depth);
        let here = depth([x, y]);
        (depth([x + 1.0, y]) - here).abs().max((depth([x, y + 1.0]) - here).abs())
    }
}

/// Whether a place lies between the lowest and the highest of both axes.
fn is_within([low, high]: &[[f64; 2]; 2], place: [f64; 2]) -> bool {
    (0..2).all(|axis| low[axis] <= place[axis] && place[axis] <= high[axis])
}

/// Twice the area to the left of `a` to `b`, seen with y up.
fn cross(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> f64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}
