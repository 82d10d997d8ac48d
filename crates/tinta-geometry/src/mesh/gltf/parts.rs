//! A glTF mesh's vertices, triangles, lines and points, read once and put in every place that shows them.

use super::accessors::Accessors;
use super::nodes::Nodes;
use super::outline::{Outline, Place, PrimitivePart, Set, attribute};
use crate::mesh::NONE;
use crate::mesh::soup::{Corner, Soup};
use glam::{DMat3, DMat4, DVec3, Vec2};
use gltf_json::mesh::{Mode, MorphTarget, Semantic};
use gltf_json::{Accessor, Index, Skin};
use std::collections::HashMap;
use std::collections::hash_map::Entry;

/// A set's vertices as the file has them.
struct Vertices {
    positions: Vec<DVec3>,
    /// Empty or as many as positions, like the next two.
    normals: Vec<DVec3>,
    texture_coordinates: Vec<Vec2>,
    /// Red, green and blue as displays have them, sRGB.
    colors: Vec<[f32; 3]>,
    /// The joints that move each vertex, and how much; a vertex has these in each list.
    weights: Vec<Vec<([f64; 4], [f64; 4])>>,
}

/// The contents of a piece, as indices into the vertices of its set.
enum Primitives {
    Points(Vec<u32>),
    Segments(Vec<[u32; 2]>),
    Faces {
        triangles: Vec<[u32; 3]>,
        /// The edges that the file marks.
        marks: Vec<[u32; 2]>,
    },
}

impl Primitives {
    fn read(piece: &PrimitivePart<'_>, accessors: &Accessors<'_>) -> Result<Self, String> {
        let indices = match piece.primitive.indices {
            Some(indices) => accessors.indices(indices, piece.corners)?,
            None => (0..piece.corners as u32).collect(),
        };
        // The largest number begins a new strip, loop or fan: KHR_mesh_primitive_restart.
        let end = match (piece.primitive.indices, piece.mode) {
            (Some(list), Mode::LineStrip | Mode::LineLoop | Mode::TriangleStrip | Mode::TriangleFan) => {
                Some(accessors.largest(list)?)
            }
            _ => None,
        };
        let runs = indices.split(|index| Some(*index) == end);
        Ok(match piece.mode {
            Mode::Points => Self::Points(indices),
            Mode::Lines => Self::Segments(indices.as_chunks().0.to_vec()),
            Mode::LineStrip | Mode::LineLoop => {
                let segments = runs.flat_map(|run| {
                    let closing = run.last().zip(run.first()).filter(|_| piece.mode == Mode::LineLoop);
                    let pairs = run.windows(2).map(|pair| [pair[0], pair[1]]);
                    pairs.chain(closing.map(|(last, first)| [*last, *first]))
                });
                Self::Segments(segments.collect())
            }
            _ => {
                // The first run is mostly the only one and needs no copy.
                let mut runs = runs.map(|run| every_triangle(run, piece.mode));
                let mut every = runs.next().unwrap_or_default();
                runs.for_each(|mut run| every.append(&mut run));
                let marks = piece.edges.as_ref().map_or(Ok(Vec::new()), |edges| edges.marks(&every, accessors))?;
                Self::Faces { triangles: without_joins(every, piece.mode), marks }
            }
        })
    }
}

/// Adds a mesh in all its places; each node that shows it is a part.
pub(super) fn put(
    soup: &mut Soup,
    (outline, places): &(Outline<'_>, Vec<Place>),
    accessors: &Accessors<'_>,
    nodes: &Nodes,
    part_of_node: &[u32],
) -> Result<(), String> {
    let drawn: Vec<Primitives> =
        outline.pieces.iter().map(|piece| Primitives::read(piece, accessors)).collect::<Result<_, String>>()?;
    let mut skins: HashMap<usize, Vec<DMat4>> = HashMap::new();
    // Most places have the mesh's own weights: its vertices are read once for all of them.
    let mut vertices: Vec<Vertices> = Vec::new();
    let mut shape_read: Option<(&[f32], bool)> = None;
    let mut places = places.iter().peekable();
    while let Some(Place { node: number, instances }) = places.next() {
        let node = &accessors.root.nodes[*number];
        let weights = node.weights.as_ref().or(outline.mesh.weights.as_ref()).map_or(&[][..], Vec::as_slice);
        let joints = match node.skin {
            None => None,
            Some(skin) => Some(match skins.entry(skin.value()) {
                Entry::Occupied(known) => known.into_mut(),
                Entry::Vacant(unknown) => {
                    let found = accessors.root.get(skin);
                    let skin = found.ok_or_else(|| format!("its skin {skin} does not exist; export it again"))?;
                    unknown.insert(joint_matrices(skin, accessors, nodes)?)
                }
            }),
        };
        let joints = joints.map(|joints| joints.as_slice());
        let shape = (weights, joints.is_some());
        if shape_read != Some(shape) {
            let read = |set| Vertices::read(set, weights, joints.is_some(), accessors);
            vertices = outline.sets.iter().map(read).collect::<Result<_, String>>()?;
            shape_read = Some(shape);
        }
        let scene_from_node = nodes.scene_from_node[*number];
        let copies = match instances {
            None => vec![scene_from_node],
            Some(instances) => instances.places(accessors)?.map(|from_mesh| scene_from_node * from_mesh).collect(),
        };
        for (number, copy) in copies.iter().enumerate() {
            let put = |vertices| PlacedSet::put(soup, vertices, copy, joints);
            let sets: Vec<PlacedSet> = vertices.iter().map(put).collect::<Result<_, String>>()?;
            if number + 1 == copies.len() && places.peek().is_none() {
                // Before the corners take their memory.
                vertices = Vec::new();
            }
            put_pieces(soup, outline, &drawn, &sets);
        }
        soup.polygon_parts.resize(soup.polygon_materials.len(), part_of_node[*number]);
    }
    Ok(())
}

/// Adds a mesh's points, lines and faces between vertices that are placed.
fn put_pieces(soup: &mut Soup, outline: &Outline<'_>, drawn: &[Primitives], sets: &[PlacedSet]) {
    for (piece, drawn) in outline.pieces.iter().zip(drawn) {
        let placed = &sets[piece.set];
        match drawn {
            Primitives::Points(points) => placed.put_points(soup, points),
            Primitives::Segments(segments) => placed.put_segments(soup, segments),
            Primitives::Faces { triangles, marks } => {
                placed.put_faces(soup, triangles, piece.material);
                placed.put_marks(soup, marks);
            }
        }
    }
}

/// The triangles that indices stand for, counter-clockwise, also those of strips that only continue elsewhere.
fn every_triangle(indices: &[u32], mode: Mode) -> Vec<[u32; 3]> {
    match (mode, indices) {
        (Mode::TriangleStrip, _) => {
            let turned = |(place, corners): (usize, &[u32])| match place % 2 {
                0 => [corners[0], corners[1], corners[2]],
                _ => [corners[0], corners[2], corners[1]],
            };
            indices.windows(3).enumerate().map(turned).collect()
        }
        (Mode::TriangleFan, [first, rest @ ..]) => rest.windows(2).map(|pair| [pair[0], pair[1], *first]).collect(),
        _ => indices.as_chunks().0.to_vec(),
    }
}

/// The same without those of strips that only continue elsewhere.
fn without_joins(mut triangles: Vec<[u32; 3]>, mode: Mode) -> Vec<[u32; 3]> {
    if mode == Mode::TriangleStrip {
        triangles.retain(|[a, b, c]| a != b && b != c && a != c);
    }
    triangles
}

/// For each joint of a skin: scene from the mesh as it was bound to it.
fn joint_matrices(skin: &Skin, accessors: &Accessors<'_>, nodes: &Nodes) -> Result<Vec<DMat4>, String> {
    if skin.joints.len() > nodes.scene_from_node.len() {
        return Err("its skin has more joints than there are nodes; export it again".to_owned());
    }
    let bound: Option<Vec<[f64; 16]>> =
        skin.inverse_bind_matrices.map(|index| accessors.numbers(index, skin.joints.len())).transpose()?;
    let matrix = |(place, joint): (usize, &Index<gltf_json::Node>)| {
        let scene_from_joint = nodes.scene_from_node.get(joint.value());
        let scene_from_joint =
            scene_from_joint.ok_or_else(|| format!("its node {joint} does not exist; export it again"))?;
        let joint_from_mesh = bound.as_ref().and_then(|bound| bound.get(place)).map(DMat4::from_cols_array);
        Ok(*scene_from_joint * joint_from_mesh.unwrap_or(DMat4::IDENTITY))
    };
    skin.joints.iter().enumerate().map(matrix).collect()
}

impl Vertices {
    fn read(set: &Set<'_>, morphs: &[f32], is_skinned: bool, accessors: &Accessors<'_>) -> Result<Self, String> {
        let (primitive, count) = (set.primitive, set.count);
        let vectors = |index| -> Result<Vec<DVec3>, String> {
            Ok(accessors.numbers::<3>(index, count)?.into_iter().map(DVec3::from_array).collect())
        };
        let mut positions = vectors(set.positions)?;
        let mut normals = attribute(primitive, Semantic::Normals).map_or(Ok(Vec::new()), vectors)?;
        let moved = |list: &mut Vec<DVec3>, by: fn(&MorphTarget) -> Option<Index<Accessor>>| {
            let targets = primitive.targets.iter().flatten().zip(morphs).filter(|(_, share)| **share != 0.0);
            for (index, share) in targets.filter_map(|(target, share)| Some((by(target)?, f64::from(*share)))) {
                list.iter_mut().zip(vectors(index)?).for_each(|(vector, step)| *vector += step * share);
            }
            Ok::<(), String>(())
        };
        moved(&mut positions, |target| target.positions)?;
        if !normals.is_empty() {
            moved(&mut normals, |target| target.normals)?;
        }
        let texture_coordinates = match attribute(primitive, Semantic::TexCoords(set.coordinates.set)) {
            None => Vec::new(),
            Some(index) => {
                let pair = |[u, v]: [f64; 2]| set.coordinates.to_lower_left(Vec2::new(u as f32, v as f32));
                accessors.numbers::<2>(index, count)?.into_iter().map(pair).collect()
            }
        };
        let colors = match attribute(primitive, Semantic::Colors(0)) {
            None => Vec::new(),
            Some(index) => accessors.colors(index, count)?,
        };
        let mut weights = Vec::new();
        for number in (0..).take_while(|_| is_skinned) {
            let list = |semantic| attribute(primitive, semantic).map(|index| accessors.numbers::<4>(index, count));
            let (Some(joints), Some(shares)) = (list(Semantic::Joints(number)), list(Semantic::Weights(number))) else {
                break;
            };
            weights.push(joints?.into_iter().zip(shares?).collect());
        }
        Ok(Self { positions, normals, texture_coordinates, colors, weights })
    }

    /// What moves a vertex where joints do; `None` where none of them has a share.
    fn matrix(&self, vertex: usize, joints: &[DMat4]) -> Result<Option<DMat4>, String> {
        let (mut sum, mut shares) = (DMat4::ZERO, 0.0);
        for (numbers, weights) in self.weights.iter().filter_map(|list| list.get(vertex)) {
            for (number, share) in numbers.iter().zip(weights).filter(|(_, share)| **share != 0.0) {
                let joint = joints
                    .get(*number as usize)
                    .ok_or("its vertices use joints that its skin lacks; export it again")?;
                sum += *joint * *share;
                shares += *share;
            }
        }
        Ok((shares > 0.0).then(|| sum * (1.0 / shares)))
    }
}

/// A set's vertices in the soup.
struct PlacedSet {
    count: usize,
    first_position: u32,
    /// [`NONE`] where it has none, like the next.
    first_normal: u32,
    first_texture: u32,
    /// Which vertices lie where left and right have changed places; one for all, or one each.
    mirrored: Vec<bool>,
}

impl PlacedSet {
    fn put(soup: &mut Soup, vertices: &Vertices, place: &DMat4, joints: Option<&[DMat4]>) -> Result<Self, String> {
        let first = |is_empty: bool, length: usize| if is_empty { NONE } else { length as u32 };
        let mut placed = Self {
            count: vertices.positions.len(),
            first_position: soup.positions.len() as u32,
            first_normal: first(vertices.normals.is_empty(), soup.normals.len()),
            first_texture: first(vertices.texture_coordinates.is_empty(), soup.texture_coordinates.len()),
            mirrored: Vec::new(),
        };
        let linear = |matrix: &DMat4| DMat3::from_mat4(*matrix);
        match joints.filter(|_| !vertices.weights.is_empty()) {
            None => {
                soup.positions.extend(vertices.positions.iter().map(|position| place.transform_point3(*position)));
                let turn = Turn::of(linear(place));
                soup.normals.extend(vertices.normals.iter().map(|normal| turn.normal(*normal).as_vec3()));
                placed.mirrored.push(turn.is_mirrored);
            }
            Some(joints) => {
                for (vertex, position) in vertices.positions.iter().enumerate() {
                    let matrix = vertices.matrix(vertex, joints)?.unwrap_or(*place);
                    soup.positions.push(matrix.transform_point3(*position));
                    let turn = Turn::of(linear(&matrix));
                    soup.normals.extend(vertices.normals.get(vertex).map(|normal| turn.normal(*normal).as_vec3()));
                    placed.mirrored.push(turn.is_mirrored);
                }
            }
        }
        // Where some have none they are white.
        if !vertices.colors.is_empty() || !soup.colors.is_empty() {
            soup.colors.resize(placed.first_position as usize, [1.0; 3]);
            soup.colors.extend(&vertices.colors);
            soup.colors.resize(soup.positions.len(), [1.0; 3]);
        }
        soup.texture_coordinates.extend(&vertices.texture_coordinates);
        Ok(placed)
    }

    fn put_points(&self, soup: &mut Soup, indices: &[u32]) {
        let known = indices.iter().filter(|index| (**index as usize) < self.count);
        let before = soup.points.len();
        soup.points.extend(known.map(|index| self.first_position + index));
        soup.defects.out_of_range_faces += indices.len() - (soup.points.len() - before);
    }

    fn put_segments(&self, soup: &mut Soup, segments: &[[u32; 2]]) {
        for segment in segments {
            match segment.iter().all(|index| (*index as usize) < self.count) {
                true => soup.segments.push(segment.map(|index| self.first_position + index)),
                false => soup.defects.out_of_range_faces += 1,
            }
        }
    }

    fn put_marks(&self, soup: &mut Soup, marks: &[[u32; 2]]) {
        let known = marks.iter().filter(|ends| ends.iter().all(|index| (*index as usize) < self.count));
        soup.marked.extend(known.map(|ends| ends.map(|index| self.first_position + index)));
    }

    fn put_faces(&self, soup: &mut Soup, triangles: &[[u32; 3]], material: u32) {
        for triangle in triangles {
            if triangle.iter().any(|index| *index as usize >= self.count) {
                soup.defects.out_of_range_faces += 1;
                continue;
            }
            let mirrored = self.mirrored.get(triangle[0] as usize).or(self.mirrored.first());
            let [a, b, c] = *triangle;
            let from = |first: u32, index: u32| if first == NONE { NONE } else { first + index };
            soup.corners.extend((if mirrored == Some(&true) { [a, c, b] } else { [a, b, c] }).map(|index| Corner {
                position: self.first_position + index,
                normal: from(self.first_normal, index),
                texture: from(self.first_texture, index),
            }));
            soup.polygon_materials.push(material);
        }
    }
}

/// How a matrix turns normals: by its cofactors, which a matrix without volume has too.
struct Turn {
    cofactors: DMat3,
    is_mirrored: bool,
}

impl Turn {
    fn of(linear: DMat3) -> Self {
        let DMat3 { x_axis: x, y_axis: y, z_axis: z } = linear;
        let is_mirrored = linear.determinant() < 0.0;
        let sign = if is_mirrored { -1.0 } else { 1.0 };
        Self { cofactors: DMat3::from_cols(y.cross(z), z.cross(x), x.cross(y)) * sign, is_mirrored }
    }

    /// Of length 1, or 0 where the file's has none: a normal is then computed.
    fn normal(&self, file: DVec3) -> DVec3 {
        (self.cofactors * file).normalize_or_zero()
    }
}
