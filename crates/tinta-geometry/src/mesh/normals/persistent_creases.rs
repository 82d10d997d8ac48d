//! Creases that last: chains of edges at which faces differ by more than the smoothing angle and that continue for some length, or on
//! a part close. On scans and on models of few triangles single edges are as sharp by chance, and to split normals there makes specks.
//! Around a flat face of a part a smaller angle is enough, because chamfers of nuts and shafts have 30 degrees.
//!
//! In: welded triangles and the angle's cosine. Out: the vertices where normals may be split, and for each triangle the area of the
//! flat face it is part of. By it a face counts more than the chamfer beside it, which so bends from face to face and leaves them
//! flat.

use super::curved::{Edge, Faces, curved};
use super::incidence::{Incidence, angle_at};
use super::patches::{Neighbours, gathered};
use crate::disjoint_sets::DisjointSets;
use crate::mesh::bounds;
use crate::threads::{both, filled, in_parallel, threads_for};
use crate::tolerances::{FLAT_FACE, MOST_OF_FIGURES};
use glam::DVec3;
use std::collections::HashMap;

/// How far a chain must reach to last, in shares of the diagonal of the model's box: farther than single edges of the scans and low
/// models looked at, less far than the edges of their shortest chamfers.
const LEAST_REACH: f64 = 0.04;

/// Fewest triangles of a flat face around which a smaller angle is enough: those of a hexagon. Facets of round shapes have two.
const LEAST_TRIANGLES: usize = 4;

/// How much larger such a face is than the one beside it. Facets around a round shape are as large as one another.
const LARGER: f64 = 4.0;

/// The cosine of the angle above which an edge of a figure is sharp, if it is not larger: facets of low models stand at up to 50
/// degrees to one another where the form is round.
const COS_OF_FIGURES: f64 = 0.5;

/// The cosine of the angle above which no edge of a part is sharp by chance.
const COS_OF_PARTS: f64 = 0.26;

/// Where normals may be split, and how much faces weigh in.
pub(super) struct PersistentCreases {
    /// For each vertex whether it lies on a crease that lasts.
    pub vertices: Vec<bool>,
    /// For each vertex whether the smaller angle counts: it lies on the border of a flat face.
    pub borders: Vec<bool>,
    /// For each triangle the area of its flat face, in units of the model's own.
    pub areas: Vec<f64>,
    /// For each corner its face's angle, radians.
    pub angles: Vec<f64>,
    /// Each triangle's own area.
    pub own_areas: Vec<f64>,
    /// For each triangle whether its facets stand for a surface that bends both ways.
    pub is_curved: Vec<bool>,
    /// The cosine of the angle above which an edge is sharp.
    pub cos_smooth: f64,
    /// The diagonal of the model's box.
    pub diagonal: f64,
}

impl PersistentCreases {
    pub(super) fn find(
        positions: &[DVec3],
        triangles: &[[u32; 3]],
        given: &[DVec3],
        incidence: &Incidence,
        cos_smooth: f64,
        cos_beside: f64,
    ) -> Self {
        let found = in_parallel(positions.len(), threads_for(triangles.len()), |vertices| {
            let (mut edges, mut spokes) = (Vec::new(), Vec::new());
            for vertex in vertices {
                spokes.clear();
                for &corner in incidence.corners(vertex) {
                    let triangle = triangles[corner as usize / 3];
                    let far = [1, 2].map(|step| triangle[(corner as usize % 3 + step) % 3]);
                    // Each edge once, by its lower end.
                    spokes.extend(far.into_iter().filter(|far| *far as usize > vertex).map(|far| (far, corner / 3)));
                }
                spokes.sort_unstable();
                for pair in spokes.windows(2).filter(|pair| pair[0].0 == pair[1].0) {
                    let [(far, face), (_, other)] = [pair[0], pair[1]];
                    edges.push(Edge { ends: [vertex as u32, far], faces: [face, other] });
                }
            }
            edges
        });
        let edges = || found.iter().flatten();
        let cosine = |edge: &Edge| {
            let [face, other] = edge.faces.map(|face| given[face as usize]);
            face.dot(other)
        };
        let threads = threads_for(triangles.len());
        let own_areas = filled(triangles.len(), threads, 0.0, |face| {
            let [a, b, c] = triangles[face].map(|vertex| positions[vertex as usize]);
            (b - a).cross(c - a).length() * 0.5
        });
        let gather = || {
            let neighbours = Neighbours::new(triangles.len(), edges().map(|edge| edge.faces));
            let begins = |first: u32| own_areas[first as usize];
            let joins = |_, face: u32, other: u32, _| {
                (given[face as usize].dot(given[other as usize]) > FLAT_FACE).then(|| own_areas[other as usize])
            };
            gathered(&neighbours, triangles.len(), begins, joins)
        };
        let angle = |corner: usize| angle_at(positions, triangles, corner as u32);
        let measure = || filled(triangles.len() * 3, threads, 0.0, angle);
        let ((flat, flat_areas), angles) = both(gather, measure);
        let areas: Vec<f64> = flat.iter().map(|face| flat_areas[*face as usize]).collect();
        let mut flat_counts = vec![0; triangles.len()];
        flat.iter().for_each(|face| flat_counts[*face as usize] += 1);
        let in_flat = own_areas.iter().zip(&flat).filter(|(_, face)| flat_counts[**face as usize] > 1);
        let in_flat = in_flat.map(|(area, _)| area).sum::<f64>();
        let is_figure = in_flat < MOST_OF_FIGURES * own_areas.iter().sum::<f64>();
        let cos_smooth = if is_figure { cos_smooth.min(COS_OF_FIGURES) } else { cos_smooth };
        let diagonal = diagonal_of(positions);
        let faces = Faces { triangles, normals: given, areas: &own_areas, angles: &angles };
        let is_border = |edge: &Edge| {
            let [face, other] = edge.faces.map(|face| flat[face as usize]);
            let is_larger = |face: u32, other: u32| {
                flat_counts[face as usize] >= LEAST_TRIANGLES
                    && flat_areas[face as usize] >= LARGER * flat_areas[other as usize]
            };
            is_larger(face, other) || is_larger(other, face)
        };
        let is_crease = |edge: &&Edge| cosine(edge) < cos_smooth || is_border(edge) && cosine(edge) < cos_beside;
        let sharp: Vec<&Edge> = edges().filter(is_crease).collect();
        let mut chains = DisjointSets::new(positions.len());
        sharp.iter().for_each(|edge| chains.join(edge.ends));
        let mut counts = vec![0; positions.len()];
        sharp.iter().flat_map(|edge| edge.ends).for_each(|end| counts[end as usize] += 1);
        // Whether a chain may be chance: on a part one that closes and is sharp all along is none, however small, as a hole's rim.
        let mut may_be_chance = vec![is_figure; positions.len()];
        for edge in &sharp {
            let is_end = edge.ends.iter().any(|end| counts[*end as usize] == 1);
            may_be_chance[chains.root(edge.ends[0]) as usize] |= is_end || cosine(edge) > COS_OF_PARTS;
        }
        let mut of_chains: HashMap<u32, Vec<DVec3>> = HashMap::new();
        for edge in &sharp {
            let of_chain = of_chains.entry(chains.root(edge.ends[0])).or_default();
            of_chain.extend(edge.ends.map(|end| positions[end as usize]));
        }
        let reaches: HashMap<u32, f64> = of_chains.iter().map(|(chain, ends)| (*chain, diagonal_of(ends))).collect();
        let (mut vertices, mut borders) = (vec![false; positions.len()], vec![false; positions.len()]);
        for edge in &sharp {
            let chain = chains.root(edge.ends[0]);
            let lasts = !may_be_chance[chain as usize] || reaches[&chain] >= LEAST_REACH * diagonal;
            let is_border = is_border(edge);
            for end in edge.ends {
                vertices[end as usize] = lasts;
                borders[end as usize] |= lasts && is_border;
            }
        }
        let is_curved =
            if is_figure { vec![true; triangles.len()] } else { curved(&faces, &found, incidence, cos_smooth) };
        Self { vertices, borders, areas, angles, own_areas, is_curved, diagonal, cos_smooth }
    }
}

/// The diagonal of the box around points.
fn diagonal_of(points: &[DVec3]) -> f64 {
    let (low, high) = bounds(points);
    (high - low).length()
}
