//! The edges that `inking` draws of a scene.
//!
//! In: a scene and the settings. Out: runs of lines, object by object and class by class. Edges share the vertices of the faces,
//! so their depths agree. Smooth silhouettes run through faces, and a model's own curves lie anywhere: both have separate vertices.

use super::Inking;
use crate::edges::{Class, Side, SilhouetteRule, side_of_face};
use crate::lines::smooth_silhouettes;
use crate::mesh::{Curves, Mesh, VertexArrays};
use crate::plan::EdgeRun;
use crate::scene::{Color, Object, Scene};
use glam::DVec3;
use std::collections::HashMap;

impl Inking {
    /// Returns the edges to draw, object by object and class by class.
    pub(super) fn runs(&self, scene: &Scene) -> Vec<EdgeRun> {
        let is_smooth = self.silhouette == SilhouetteRule::Smooth && self.classes.contains(Class::Silhouette);
        let smooth = if is_smooth { smooth_silhouettes(scene, self.crease_angle) } else { Vec::new() };
        let mut runs = Vec::new();
        for (number, object) in scene.objects.iter().enumerate() {
            let edges = scene.edges(object);
            let arrays = scene.arrays(object);
            let mesh = &object.mesh;
            // The true eye, whatever the rule for silhouettes.
            let true_eye = scene.eye(object, SilhouetteRule::Exact);
            let is_turned_away = |face: &u32| {
                let corners = mesh.triangles[*face as usize].map(|position| mesh.positions[position as usize]);
                side_of_face(corners, true_eye) == Side::Back
            };
            let is_drawn = |edge: &u32| self.back_edges || !edges.list().faces(*edge).iter().all(is_turned_away);
            let smooth = smooth.get(number);
            let eye = scene.eye(object, self.silhouette);
            let chosen = match smooth {
                None => edges.chosen(self.classes, self.crease_angle, eye, self.silhouette),
                Some(smooth) => edges.chosen_with(self.classes, self.crease_angle, &smooth.edges),
            };
            let positions = edges.list().positions();
            let run = |class, ends, own_vertices| self.run(number, class, ends, own_vertices);
            let mut through_faces = Class::ALL.map(|_| OwnLines::default());
            let to_vertex = |point: DVec3| own_vertex(scene, arrays, point);
            let mut of_classes = Vec::new();
            for (class, mut chosen) in chosen {
                chosen.retain(&is_drawn);
                if let Some(smooth) = smooth.filter(|_| class > Class::Silhouette) {
                    // Silhouette parts are drawn as silhouettes.
                    chosen.retain(|edge| {
                        let between = between_parts(smooth.parts_of(*edge));
                        let is_whole = between == [[0.0, 1.0]];
                        for part in between.into_iter().filter(|_| !is_whole) {
                            through_faces[class as usize]
                                .push(along(mesh, positions[*edge as usize], part).map(to_vertex));
                        }
                        is_whole
                    });
                }
                let ends = |edge: &u32| positions[*edge as usize].map(|end| arrays.position_vertices[end as usize]);
                of_classes.push((class, run(class, chosen.iter().map(ends).collect(), None)));
            }
            if let Some(smooth) = smooth {
                let lines = &mut through_faces[Class::Silhouette as usize];
                smooth.pieces.iter().for_each(|ends| lines.push(ends.map(to_vertex)));
                for (edge, part) in smooth.edge_parts.iter().filter(|(edge, _)| is_drawn(edge)) {
                    lines.push(along(mesh, positions[*edge as usize], *part).map(to_vertex));
                }
            }
            if self.classes.contains(Class::Curve) {
                let Curves { positions, segments, .. } = &mesh.curves;
                let lines = &mut through_faces[Class::Curve as usize];
                segments.iter().for_each(|ends| lines.push(ends.map(|end| to_vertex(positions[end as usize]))));
            }
            let of_own = Class::ALL.into_iter().zip(through_faces).filter(|(_, lines)| !lines.ends.is_empty());
            of_classes.extend(of_own.map(|((_, class), lines)| (class, run(class, lines.ends, Some(lines.vertices)))));
            of_classes.sort_by_key(|(class, _)| *class);
            runs.extend(of_classes.into_iter().map(|(_, run)| run));
        }
        runs
    }

    /// Returns the models' own points, each as a line that ends where it begins.
    pub(super) fn points(&self, scene: &Scene) -> Vec<EdgeRun> {
        let objects = scene.objects.iter().enumerate().filter(|(_, object)| !object.mesh.curves.points.is_empty());
        let run = |(number, object): (usize, &Object)| {
            let Curves { positions, points, .. } = &object.mesh.curves;
            let vertex = |point: &u32| own_vertex(scene, scene.arrays(object), positions[*point as usize]);
            let ends = (0..points.len() as u32).map(|point| [point; 2]).collect();
            self.run(number, Class::Point, ends, Some(points.iter().map(vertex).collect()))
        };
        if self.classes.contains(Class::Point) { objects.map(run).collect() } else { Vec::new() }
    }

    fn run(&self, object: usize, class: Class, ends: Vec<[u32; 2]>, own_vertices: Option<Vec<[f32; 6]>>) -> EdgeRun {
        let Color([red, green, blue]) = self.colors.of_class(class);
        EdgeRun { object, name: class.name(), color: [red, green, blue, 1.0], ends, own_vertices }
    }
}

/// A vertex at a point that is none of the mesh's, without a normal.
fn own_vertex(scene: &Scene, arrays: &VertexArrays, point: DVec3) -> [f32; 6] {
    let [x, y, z] = ((point - arrays.centre) / scene.radius).as_vec3().to_array();
    [x, y, z, 0.0, 0.0, 0.0]
}

/// Lines with separate vertices, each vertex once.
#[derive(Debug, Default)]
struct OwnLines {
    vertices: Vec<[f32; 6]>,
    ends: Vec<[u32; 2]>,
    numbers: HashMap<[u32; 3], u32>,
}

impl OwnLines {
    fn push(&mut self, ends: [[f32; 6]; 2]) {
        let ends = ends.map(|vertex| {
            let [x, y, z, ..] = vertex.map(f32::to_bits);
            *self.numbers.entry([x, y, z]).or_insert_with(|| {
                self.vertices.push(vertex);
                self.vertices.len() as u32 - 1
            })
        });
        self.ends.push(ends);
    }
}

/// Returns a part of an edge, in the mesh's own coordinates.
fn along(mesh: &Mesh, ends: [u32; 2], part: [f64; 2]) -> [DVec3; 2] {
    let [low, high] = ends.map(|position| mesh.positions[position as usize]);
    part.map(|share| if share == 1.0 { high } else { low + (high - low) * share })
}

/// Returns the gaps that parts leave of a whole.
fn between_parts(parts: impl Iterator<Item = [f64; 2]>) -> Vec<[f64; 2]> {
    let mut from = 0.0;
    let mut between: Vec<[f64; 2]> = Vec::new();
    for [start, end] in parts.chain([[1.0, 1.0]]) {
        if start > from {
            between.push([from, start]);
        }
        from = end;
    }
    between
}
