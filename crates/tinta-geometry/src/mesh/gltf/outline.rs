//! The contents of a glTF file's scene before they are read: each mesh's primitives and places, and their size.

use super::accessors::Accessors;
use super::edge_marks::Edges;
use super::extensions::refuse_compressed;
use super::instances::Instances;
use super::materials::Coordinates;
use super::nodes::Nodes;
use crate::limits::{MEMORY_FACTOR, TRIANGLES};
use crate::mesh::NONE;
use crate::mesh::soup::Size;
use gltf_json::mesh::{Mode, Primitive, Semantic};
use gltf_json::validation::Checked::{self, Valid};
use gltf_json::{Accessor, Index, Mesh, Root};
use std::collections::{BTreeMap, HashMap, HashSet};

/// A mesh's contents, before reading.
pub(super) struct Outline<'a> {
    pub mesh: &'a Mesh,
    pub sets: Vec<Set<'a>>,
    pub pieces: Vec<PrimitivePart<'a>>,
}

/// Vertices that one or several primitives use.
pub(super) struct Set<'a> {
    pub primitive: &'a Primitive,
    pub positions: Index<Accessor>,
    pub count: usize,
    pub coordinates: Coordinates,
}

/// A primitive's triangles, lines or points over the vertices of a set.
pub(super) struct PrimitivePart<'a> {
    pub primitive: &'a Primitive,
    pub mode: Mode,
    pub set: usize,
    pub corners: usize,
    pub material: u32,
    /// The edges that the file marks.
    pub edges: Option<Edges>,
}

impl<'a> Outline<'a> {
    pub(super) fn of(
        mesh: &'a Mesh,
        root: &Root,
        accessors: &Accessors<'a>,
        coordinates: &[Result<Coordinates, String>],
    ) -> Result<Self, String> {
        let mut outline = Self { mesh, sets: Vec::new(), pieces: Vec::new() };
        let mut known = HashMap::new();
        for primitive in &mesh.primitives {
            let mode = match primitive.mode {
                Valid(mode) => mode,
                Checked::Invalid => return Err("it has primitives of an unknown kind; export it again".to_owned()),
            };
            // The standard lets data be left out that an extension brings.
            let Some(positions) = attribute(primitive, Semantic::Positions) else {
                return Err("it has primitives without positions; export it again".to_owned());
            };
            refuse_data_elsewhere(primitive, positions, accessors)?;
            let material = primitive.material.map(|material| material.value());
            if material.is_some_and(|material| material >= root.materials.len()) {
                return Err("it uses materials that do not exist; export it again".to_owned());
            }
            let read_by = material.and_then(|material| coordinates.get(material)).cloned();
            let read_by = read_by.unwrap_or(Ok(Coordinates::DEFAULT))?;
            let targets: Vec<_> =
                primitive.targets.iter().flatten().map(|target| (target.positions, target.normals)).collect();
            // Materials that change texture coordinates have separate vertices.
            let key = (&primitive.attributes, targets, read_by.set, material.filter(|_| read_by.is_changed));
            let set = match known.get(&key) {
                Some(set) => *set,
                None => {
                    let count = accessors.count(positions)?;
                    outline.sets.push(Set { primitive, positions, count, coordinates: read_by });
                    known.insert(key, outline.sets.len() - 1);
                    outline.sets.len() - 1
                }
            };
            let corners = match primitive.indices {
                Some(indices) => accessors.count(indices)?,
                None => outline.sets[set].count,
            };
            let material = material.map_or(NONE, |material| material as u32);
            outline.pieces.push(PrimitivePart {
                primitive,
                mode,
                set,
                corners,
                material,
                edges: Edges::of(primitive)?,
            });
        }
        Ok(outline)
    }

    /// How much it has, at most; a set or a piece of nothing counts as one, because it is work too.
    fn size(&self) -> Size {
        let sets = self.sets.iter().map(Set::size);
        sets.chain(self.pieces.iter().map(PrimitivePart::size)).fold(Size::default(), Size::plus)
    }
}

impl Set<'_> {
    fn size(&self) -> Size {
        Size { vertices: self.count.max(1), ..Size::default() }
    }
}

impl PrimitivePart<'_> {
    fn size(&self) -> Size {
        let triangles = match self.mode {
            Mode::Points | Mode::Lines | Mode::LineStrip | Mode::LineLoop => {
                return Size { curves: self.corners.max(1), ..Size::default() };
            }
            Mode::Triangles => self.corners / 3,
            _ => self.corners.saturating_sub(2),
        };
        let triangles = triangles.max(1);
        Size { triangles, corners: triangles.saturating_mul(3), ..Size::default() }
    }
}

/// Rejects a primitive whose numbers only a compressed form has.
fn refuse_data_elsewhere(
    primitive: &Primitive,
    positions: Index<Accessor>,
    accessors: &Accessors<'_>,
) -> Result<(), String> {
    let is_empty = |index: &Index<Accessor>| {
        accessors.root.get(*index).is_some_and(|accessor| accessor.buffer_view.is_none() && accessor.sparse.is_none())
    };
    match primitive.indices.iter().chain([&positions]).any(is_empty) {
        true => refuse_compressed(primitive.extensions.as_ref().map(|extensions| &extensions.others)),
        false => Ok(()),
    }
}

pub(super) fn attribute(primitive: &Primitive, semantic: Semantic) -> Option<Index<Accessor>> {
    primitive.attributes.get(&Valid(semantic)).copied()
}

/// A node that shows a mesh.
pub(super) struct Place {
    pub node: usize,
    /// The node's copies of it; `None` for one in the node's own place.
    pub instances: Option<Instances>,
}

impl Place {
    fn copies(&self) -> usize {
        self.instances.as_ref().map_or(1, |instances| instances.count)
    }
}

/// The meshes that are shown, each with its places.
pub(super) fn outlines<'a>(
    nodes: &Nodes,
    accessors: &Accessors<'a>,
    coordinates: &[Result<Coordinates, String>],
) -> Result<Vec<(Outline<'a>, Vec<Place>)>, String> {
    let root = accessors.root;
    let mut places: BTreeMap<usize, Vec<Place>> = BTreeMap::new();
    for (node, mesh) in nodes.with_meshes(root) {
        let instances = Instances::of(&root.nodes[node], accessors)?;
        places.entry(mesh).or_default().push(Place { node, instances });
    }
    let outline = |(number, places): (usize, Vec<Place>)| {
        let missing = || format!("its mesh {number} does not exist; export it again");
        let mesh = root.meshes.get(number).ok_or_else(missing)?;
        Ok((Outline::of(mesh, root, accessors, coordinates)?, places))
    };
    places.into_iter().map(outline).collect()
}

/// A sentence about copies that make a large drawing of a small file.
pub(super) fn many_copies(outlines: &[(Outline<'_>, Vec<Place>)]) -> Option<String> {
    const MANY: usize = 1_000_000;
    let once: usize = outlines.iter().map(|(outline, _)| outline.size().triangles).sum();
    let whole = whole_size(outlines).triangles;
    (whole >= MANY && whole / 2 >= once)
        .then(|| format!("its nodes draw {whole} triangles, copies of {once}, which takes time and memory"))
}

/// How much all meshes have in all their places.
fn whole_size(outlines: &[(Outline<'_>, Vec<Place>)]) -> Size {
    let of_mesh = |(outline, places): &(Outline<'_>, Vec<Place>)| {
        let copies = places.iter().map(Place::copies).fold(0, usize::saturating_add);
        outline.size().times(copies)
    };
    outlines.iter().map(of_mesh).fold(Size::default(), Size::plus)
}

/// The size of the file's lists that are drawn, each counted once.
fn single_size(outlines: &[(Outline<'_>, Vec<Place>)], accessors: &Accessors<'_>) -> Result<Size, String> {
    /// The use of a list of the file.
    #[derive(PartialEq, Eq, Hash)]
    enum Use {
        Vertices,
        Pieces(u32),
    }
    let mut known = HashSet::new();
    let mut size = Size::default();
    let mut add = |index: Index<Accessor>, use_of_it: Use, more: Size| {
        if known.insert((index.value(), use_of_it)) {
            size = size.plus(more);
        }
    };
    for (outline, places) in outlines {
        for set in &outline.sets {
            add(set.positions, Use::Vertices, set.size());
        }
        for piece in &outline.pieces {
            let index = piece.primitive.indices.unwrap_or(outline.sets[piece.set].positions);
            add(index, Use::Pieces(piece.mode.as_gl_enum()), piece.size());
        }
        for index in places.iter().filter_map(|place| place.instances.as_ref()).flat_map(Instances::accessors) {
            add(index, Use::Vertices, Size { vertices: accessors.count(index)?, ..Size::default() });
        }
    }
    Ok(size)
}

/// Rejects more than is believed of a file of this size, and more copies of it than can be counted or than free memory holds.
pub(super) fn refuse_too_much(
    outlines: &[(Outline<'_>, Vec<Place>)],
    accessors: &Accessors<'_>,
    file_bytes: usize,
    free: Option<u64>,
) -> Result<(), String> {
    let (single, whole) = (single_size(outlines, accessors)?, whole_size(outlines));
    if single.is_too_much(file_bytes) {
        return Err(format!(
            "its {} vertices and {} triangles take more than {MEMORY_FACTOR} times the file's size in memory; export it again",
            single.vertices, single.triangles
        ));
    }
    if whole.is_beyond_count() {
        return Err(format!(
            "its nodes draw {} vertices and {} triangles, of which at most {TRIANGLES} can be counted; export it with fewer \
             copies of its meshes",
            whole.vertices, whole.triangles
        ));
    }
    whole.check_copies(file_bytes, free)
}

#[cfg(test)]
mod tests {
    use super::super::container;
    use super::super::tests::{add_accessor, load, problem, triangle};
    use super::*;
    use crate::mesh::folder::Folder;
    use crate::mesh::gltf::buffers::Buffers;
    use serde_json::{Value, json};

    /// A square of `side` times `side` cells in this many nodes.
    fn nodes_of_a_grid(side: u16, nodes: usize) -> Value {
        let points = (0..=side).flat_map(|y| (0..=side).flat_map(move |x| [f32::from(x), f32::from(y), 0.0]));
        let cell = |x: u16, y: u16| {
            let corner = y * (side + 1) + x;
            [corner, corner + 1, corner + side + 2, corner, corner + side + 2, corner + side + 1]
        };
        let corners = (0..side).flat_map(|y| (0..side).flat_map(move |x| cell(x, y)));
        let points: Vec<u8> = points.flat_map(f32::to_le_bytes).collect();
        let corners: Vec<u8> = corners.flat_map(u16::to_le_bytes).collect();
        let mut file = triangle();
        let positions = add_accessor(&mut file, 5126, "VEC3", points.len() / 12, &points);
        let indices = add_accessor(&mut file, 5123, "SCALAR", corners.len() / 2, &corners);
        file["meshes"] = json!([{"primitives": [{"attributes": {"POSITION": positions}, "indices": indices}]}]);
        let node = |number: usize| json!({"mesh": 0, "translation": [100 * (number % 20), 100 * (number / 20), 0]});
        file["nodes"] = (0..nodes).map(node).collect();
        file["scenes"] = json!([{"nodes": (0..nodes).collect::<Vec<usize>>()}]);
        file
    }

    fn refused(file: &Value, free: Option<u64>) -> Result<(), String> {
        let bytes = serde_json::to_vec(file).unwrap();
        let root = container::parse(&bytes).unwrap();
        let buffers = Buffers::of(&root, None, &Folder::of_files(&[]));
        let accessors = Accessors { root: &root, buffers: &buffers };
        let outlines = outlines(&Nodes::of(&root)?, &accessors, &[])?;
        refuse_too_much(&outlines, &accessors, bytes.len(), free)
    }

    #[test]
    fn meshes_that_many_nodes_share_are_drawn_up_to_free_memory() {
        let file = nodes_of_a_grid(30, 300);
        assert_eq!(load(&file).unwrap().mesh.triangles.len(), 540_000);
        // 288,300 vertices and as many triangles as that, at the peak 88 MiB.
        assert_eq!(refused(&file, Some(90 << 20)), Ok(()));
        let message = refused(&file, Some(80 << 20)).unwrap_err();
        assert_eq!(
            message,
            "it takes 0.1 GiB of memory, and 0.1 GiB are free; close other programs, or make it smaller"
        );
        assert_eq!(refused(&file, None), Ok(()), "where the system does not tell");
        let file = nodes_of_a_grid(100, 2000);
        let message = refused(&file, None).unwrap_err();
        assert_eq!(
            message,
            "it takes 6.2 GiB of memory, and 2.0 GiB are free; close other programs, or make it smaller"
        );
        // More than any memory holds is refused by count: 2^31 triangles.
        let mut file = nodes_of_a_grid(128, 256);
        let primitive = file["meshes"][0]["primitives"][0].clone();
        file["meshes"][0]["primitives"] = Value::Array(vec![primitive; 256]);
        let message = refused(&file, Some(u64::MAX)).unwrap_err();
        let sentence = "its nodes draw 4260096 vertices and 2147483648 triangles, of which at most 1073741824 can be counted; \
                        export it with fewer copies of its meshes";
        assert_eq!(message, sentence);
    }

    #[test]
    fn copies_that_make_a_large_drawing_of_a_small_file_are_said_in_advance() {
        let said = |side: u16, nodes: usize| {
            let bytes = serde_json::to_vec(&nodes_of_a_grid(side, nodes)).unwrap();
            let root = container::parse(&bytes).unwrap();
            let buffers = Buffers::of(&root, None, &Folder::of_files(&[]));
            let accessors = Accessors { root: &root, buffers: &buffers };
            many_copies(&outlines(&Nodes::of(&root).unwrap(), &accessors, &[]).unwrap())
        };
        let sentence = "its nodes draw 1000000 triangles, copies of 20000, which takes time and memory";
        assert_eq!([said(100, 50).as_deref(), said(100, 49).as_deref()], [Some(sentence), None]);
    }

    #[test]
    fn points_and_segments_are_no_triangles_and_a_mesh_alone_is_bounded_by_the_file() {
        let mut file = triangle();
        file["accessors"] = json!([{"componentType": 5126, "count": 500_000, "type": "VEC3"}]);
        file["meshes"] = json!([{"primitives": [{"attributes": {"POSITION": 0}, "mode": 0}]}]);
        // 80 bytes a vertex and 40 a point: 57 MiB of the 64 that every file may take.
        assert_eq!(refused(&file, Some(u64::MAX)), Ok(()));
        file["accessors"][0]["count"] = json!(600_000);
        let message = problem(&file);
        let sentence = "t.gltf: its 600000 vertices and 0 triangles take more than 20 times the file's size in memory";
        assert!(message.starts_with(sentence), "{message}");
        // The same list twice is a copy.
        file["accessors"][0]["count"] = json!(500_000);
        let primitive = file["meshes"][0]["primitives"][0].clone();
        file["meshes"] = json!([{"primitives": [primitive]}, {"primitives": [primitive]}]);
        file["nodes"] = json!([{"mesh": 0}, {"mesh": 1}]);
        file["scenes"] = json!([{"nodes": [0, 1]}]);
        assert_eq!(refused(&file, Some(115 << 20)), Ok(()));
        assert!(refused(&file, Some(114 << 20)).is_err());
    }
}
