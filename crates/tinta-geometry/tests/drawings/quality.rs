//! The drawings' default lines on shapes with a known draughtsman's answer: parts as from CAD.

use crate::support::lines::{length, lines_with, scene_of, view};
use crate::support::shapes::mesh;
use glam::{DVec2, DVec3};
use std::collections::{BTreeMap, HashSet};
use std::f64::consts::TAU;
use tinta::edges::{Class, CreaseAngle};
use tinta::lines::{LineSegment, LineSettings, VisibleLines};
use tinta::{DrawingSettings, Mesh};

/// A solid of rings of points, each joined to the next by quads, with the edges that are drawn.
struct Solid {
    mesh: Mesh,
    drawn: HashSet<[u32; 2]>,
}

/// A ring of points at a height, whether its own edges are drawn, and which of the edges to the next ring are.
struct Ring {
    points: Vec<DVec2>,
    z: f64,
    is_edge: bool,
    corners: fn(usize) -> bool,
}

fn edge(a: usize, b: usize) -> [u32; 2] {
    [a.min(b) as u32, a.max(b) as u32]
}

/// Rings from the lowest outside up, over, and, if `closed`, back down inside; otherwise the first and last are capped.
fn solid(rings: &[Ring], closed: bool) -> Solid {
    let count = rings[0].points.len();
    let mut positions: Vec<DVec3> =
        rings.iter().flat_map(|ring| ring.points.iter().map(|point| point.extend(ring.z))).collect();
    let (mut triangles, mut drawn) = (Vec::new(), HashSet::new());
    for (level, ring) in rings.iter().enumerate() {
        let next_level = (level + 1) % rings.len();
        for k in 0..count {
            let (a, b) = (level * count + k, level * count + (k + 1) % count);
            if ring.is_edge {
                drawn.insert(edge(a, b));
            }
            if next_level == 0 && !closed {
                continue;
            }
            let (c, d) = (next_level * count + (k + 1) % count, next_level * count + k);
            triangles.extend([[a, b, c], [a, c, d]].map(|triangle| triangle.map(|corner| corner as u32)));
            if (ring.corners)(k) {
                drawn.insert(edge(a, d));
            }
        }
    }
    if !closed {
        for (level, is_top) in [(0, false), (rings.len() - 1, true)] {
            let middle = positions.len() as u32;
            positions.push(DVec3::new(0.0, 0.0, rings[level].z));
            for k in 0..count {
                let [a, b] = [k, (k + 1) % count].map(|k| (level * count + k) as u32);
                triangles.push(if is_top { [a, b, middle] } else { [b, a, middle] });
            }
        }
    }
    Solid { mesh: mesh(positions, triangles), drawn }
}

fn circle(count: usize, radius: f64) -> Vec<DVec2> {
    (0..count).map(|k| DVec2::from_angle(k as f64 / count as f64 * TAU) * radius).collect()
}

/// A polygon with so many corners, each side in as many parts as 24 points allow.
fn polygon(corners: usize, radius: f64) -> Vec<DVec2> {
    let corner = circle(corners, radius);
    let parts = 24 / corners;
    (0..24)
        .map(|k| corner[k / parts].lerp(corner[(k / parts + 1) % corners], (k % parts) as f64 / parts as f64))
        .collect()
}

const ALL: fn(usize) -> bool = |_| true;
const NONE: fn(usize) -> bool = |_| false;
const SIXTH: fn(usize) -> bool = |k| k % 4 == 0;

fn ring(points: Vec<DVec2>, z: f64, is_edge: bool, corners: fn(usize) -> bool) -> Ring {
    Ring { points, z, is_edge, corners }
}

fn solids() -> Vec<(String, Solid)> {
    let mut all = Vec::new();
    for n in 3..=12 {
        let rings = [ring(circle(n, 1.0), 0.0, true, ALL), ring(circle(n, 1.0), 1.2, true, ALL)];
        all.push((format!("a prism of {n} sides"), solid(&rings, false)));
    }
    for chamfer in [0.05, 0.15, 0.3] {
        // Chamfered above and below.
        let square = |inset: f64| circle(4, 2f64.sqrt()).iter().map(|point| *point * (1.0 - inset)).collect::<Vec<_>>();
        let rings = [
            ring(square(chamfer), -1.0, true, ALL),
            ring(square(0.0), -1.0 + chamfer, true, ALL),
            ring(square(0.0), 1.0 - chamfer, true, ALL),
            ring(square(chamfer), 1.0, true, ALL),
        ];
        all.push((format!("a cube with chamfers of {chamfer}"), solid(&rings, false)));
    }
    for (name, shape) in [
        ("an L bracket", vec![[0.0, 0.0], [2.0, 0.0], [2.0, 0.4], [0.4, 0.4], [0.4, 2.0], [0.0, 2.0]]),
        (
            "a T beam",
            vec![[-1.0, 1.0], [-1.0, 0.7], [-0.2, 0.7], [-0.2, -1.0], [0.2, -1.0], [0.2, 0.7], [1.0, 0.7], [1.0, 1.0]],
        ),
    ] {
        // Capped towards its middle: moved to be wholly visible from there.
        let points: Vec<DVec2> = shape.into_iter().map(DVec2::from_array).collect();
        let middle = if name.starts_with("an") { DVec2::splat(0.2) } else { DVec2::new(0.0, 0.85) };
        let points: Vec<DVec2> = points.into_iter().map(|point| point - middle).collect();
        let rings = [ring(points.clone(), 0.0, true, ALL), ring(points, 3.0, true, ALL)];
        all.push((name.to_owned(), solid(&rings, false)));
    }
    let round = |radius: f64, z: f64| ring(circle(24, radius), z, true, NONE);
    let hexagon = |radius: f64, z: f64| ring(polygon(6, radius), z, true, SIXTH);
    all.push(("a cylinder".to_owned(), solid(&[round(1.0, 0.0), round(1.0, 2.0)], false)));
    all.push(("a frustum".to_owned(), solid(&[round(1.0, 0.0), round(0.5, 2.0)], false)));
    let stepped = [round(1.0, 0.0), round(1.0, 0.5), round(0.4, 0.5), round(0.4, 2.0)];
    all.push(("a stepped shaft".to_owned(), solid(&stepped, false)));
    let washer = [round(1.0, 0.0), round(1.0, 0.2), round(0.5, 0.2), round(0.5, 0.0)];
    all.push(("a washer".to_owned(), solid(&washer, true)));
    let nut = [hexagon(1.0, 0.0), ring(polygon(6, 1.0), 0.8, true, NONE), round(0.55, 0.8), round(0.55, 0.0)];
    all.push(("a hexagonal nut".to_owned(), solid(&nut, true)));
    let head = ring(polygon(6, 1.0), 0.6, true, NONE);
    let bolt = [hexagon(1.0, 0.0), head, round(0.5, 0.6), round(0.5, 3.0)];
    all.push(("a bolt".to_owned(), solid(&bolt, false)));
    let collar = [
        round(0.5, -1.0),
        round(0.5, -0.5),
        hexagon(1.0, -0.5),
        ring(polygon(6, 1.0), 0.5, true, NONE),
        round(0.5, 0.5),
        round(0.5, 1.0),
    ];
    all.push(("a shaft with a hexagonal collar".to_owned(), solid(&collar, false)));
    all
}

/// Length of visible lines by their mesh edges: the visible part of each file edge, silhouette or not.
fn by_edge(lines: &VisibleLines, is_meant: impl Fn(&LineSegment) -> bool) -> BTreeMap<[u32; 2], f64> {
    let mut lengths = BTreeMap::new();
    for segment in lines.segments.iter().filter(|segment| segment.is_visible && is_meant(segment)) {
        let [a, b] = segment.edge.expect("an edge of the mesh");
        *lengths.entry(edge(a as usize, b as usize)).or_default() += length(segment);
    }
    lengths
}

/// Recall and precision by length.
fn shares(drawn: &BTreeMap<[u32; 2], f64>, truth: &BTreeMap<[u32; 2], f64>) -> [f64; 2] {
    let total = |lengths: &BTreeMap<[u32; 2], f64>| lengths.values().sum::<f64>();
    let common: f64 = drawn.iter().map(|(edge, length)| length.min(truth.get(edge).copied().unwrap_or(0.0))).sum();
    [common / total(truth), common / total(drawn)]
}

fn f1([recall, precision]: [f64; 2]) -> f64 {
    2.0 * recall * precision / (recall + precision)
}

#[test]
fn of_parts_as_from_cad_the_defaults_draw_every_edge_and_no_other() {
    let solids = solids();
    assert!(solids.len() >= 20, "{}", solids.len());
    let every = LineSettings { crease_angle: CreaseAngle::from_degrees(1.0).unwrap(), ..LineSettings::default() };
    let (mut better, mut worst_old) = (0, 1.0f64);
    let mut sums = [[0.0; 2]; 2];
    let views = [("25,35", false), ("-40,20", true)];
    for (name, Solid { mesh, drawn }) in &solids {
        for (from, parallel) in views {
            let scene = scene_of(vec![mesh.clone()], view(from, parallel));
            let is_true = |segment: &LineSegment| {
                let [a, b] = segment.edge.unwrap();
                segment.class == Class::Silhouette || drawn.contains(&edge(a as usize, b as usize))
            };
            let truth = by_edge(&lines_with(&scene, &every), is_true);
            let kept =
                lines_with(&scene, &LineSettings::default()).without_specks(&DrawingSettings::default()).unwrap();
            let new = shares(&by_edge(&kept, |_| true), &truth);
            let old = shares(&by_edge(&lines_with(&scene, &LineSettings::as_published()), |_| true), &truth);
            assert!(f1(new) >= f1(old) - 1e-9, "{name} from {from}: {new:?} before {old:?}");
            assert!(new.iter().all(|share| *share > 0.999), "{name} from {from}: {new:?}");
            better += usize::from(f1(new) > f1(old) + 0.01);
            worst_old = worst_old.min(old[0]);
            for (sum, shares) in sums.iter_mut().zip([new, old]) {
                (0..2).for_each(|k| sum[k] += shares[k]);
            }
        }
    }
    let count = (solids.len() * views.len()) as f64;
    let [new, old] = sums.map(|sum| sum.map(|value| value / count));
    println!(
        "{count} drawings of {} parts: recall {:.4} before {:.4}, precision {:.4} before {:.4}; F1 {:.4} before {:.4}; better in {better}; least recall before {worst_old:.2}",
        solids.len(),
        new[0],
        old[0],
        new[1],
        old[1],
        f1(new),
        f1(old)
    );
    assert!(better > 10, "{better} drawings are better than at the published angle");
}

#[test]
fn a_prism_of_six_sides_and_a_chamfered_cube_keep_all_their_edges() {
    for (name, Solid { mesh, drawn }) in solids() {
        let is_meant =
            ["a prism of 6 sides", "a prism of 12 sides", "a cube with chamfers of 0.15"].contains(&name.as_str());
        if !is_meant {
            continue;
        }
        let scene = scene_of(vec![mesh], view("25,35", false));
        let found = lines_with(&scene, &LineSettings::default());
        let edges: HashSet<[u32; 2]> =
            found.segments.iter().map(|s| s.edge.map(|[a, b]| edge(a as usize, b as usize)).unwrap()).collect();
        assert_eq!(edges, drawn, "{name}");
    }
}
