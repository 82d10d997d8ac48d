//! Shapes that OpenCASCADE tessellated, with the surface of each face. `tangent_shapes.py` beside this folder makes them.

use super::tangents;
use crate::support::shapes::mesh;
use glam::DVec3;
use std::collections::{BTreeMap, HashMap};
use std::path::{Path, PathBuf};
use tinta::EdgeList;

/// A shape as in its file.
struct Shape {
    positions: Vec<DVec3>,
    triangles: Vec<[u32; 3]>,
    /// The surface of each triangle.
    surfaces: Vec<u8>,
    /// Pairs of surfaces that join smoothly, and how.
    smooth: HashMap<[u8; 2], String>,
}

impl Shape {
    fn read(path: &Path) -> Self {
        let bytes = std::fs::read(path).unwrap();
        let end = bytes.windows(11).position(|at| at == b"end_header\n").unwrap() + 11;
        let head = std::str::from_utf8(&bytes[..end]).unwrap();
        let (mut smooth, mut counts) = (HashMap::new(), Vec::new());
        for line in head.lines() {
            match line.split(' ').collect::<Vec<_>>()[..] {
                ["comment", "smooth", one, other, kind] => {
                    smooth.insert([one, other].map(|surface| surface.parse().unwrap()), kind.to_owned());
                }
                ["element", _, count] => counts.push(count.parse::<usize>().unwrap()),
                _ => {}
            }
        }
        let (vertices, faces) = bytes[end..].split_at(12 * counts[0]);
        let number = |bytes: &[u8]| f64::from(f32::from_le_bytes(bytes.try_into().unwrap()));
        let corner = |bytes: &[u8]| u32::from(u16::from_le_bytes(bytes.try_into().unwrap()));
        Self {
            positions: vertices
                .chunks(12)
                .map(|at| DVec3::from_array([0, 4, 8].map(|axis| number(&at[axis..axis + 4]))))
                .collect(),
            triangles: faces.chunks(8).map(|face| [1, 3, 5].map(|at| corner(&face[at..at + 2]))).collect(),
            surfaces: faces.chunks(8).map(|face| face[7]).collect(),
            smooth,
        }
    }

    /// For each kind of smooth edge its length and that found, and the length of other edges found.
    fn found(self) -> (BTreeMap<String, [f64; 2]>, f64) {
        let mesh = mesh(self.positions, self.triangles);
        let edges = EdgeList::new(&mesh);
        let length = |edge: u32| {
            let [from, to] = edges.positions()[edge as usize].map(|end| mesh.positions[end as usize]);
            from.distance(to)
        };
        let kind = |edge: u32| {
            let mut sides: Vec<u8> = edges.faces(edge).iter().map(|face| self.surfaces[*face as usize]).collect();
            sides.sort_unstable();
            <[u8; 2]>::try_from(sides).ok().and_then(|sides| self.smooth.get(&sides))
        };
        let mut lengths: BTreeMap<String, [f64; 2]> = BTreeMap::new();
        let mut wrong = 0.0;
        for edge in 0..edges.len() as u32 {
            if let Some(kind) = kind(edge) {
                lengths.entry(kind.clone()).or_default()[0] += length(edge);
            }
        }
        for edge in tangents(&mesh, &edges) {
            match kind(edge).and_then(|kind| lengths.get_mut(kind)) {
                Some(lengths) => lengths[1] += length(edge),
                None => wrong += length(edge),
            }
        }
        (lengths, wrong)
    }
}

fn shapes() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/edges/tangent_shapes");
    let mut shapes: Vec<PathBuf> = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    shapes.sort();
    assert!(shapes.len() > 70, "only {} shapes", shapes.len());
    shapes
}

#[test]
fn fillets_of_a_kernel_have_their_tangent_edges_whole_or_not_at_all_and_nothing_else_has_any() {
    for path in shapes() {
        let name = path.file_stem().unwrap().display().to_string();
        let (lengths, wrong) = Shape::read(&path).found();
        println!("{name}: {lengths:.2?}, {wrong} wrong");
        assert_eq!(wrong, 0.0, "{name}");
        for (kind, [all, found]) in lengths {
            let is_whole = found >= 0.999 * all;
            assert!(is_whole || kind == "free" && found == 0.0, "{name}: {found} of {all} {kind}");
        }
    }
}
