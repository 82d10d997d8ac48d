//! The shapes that stiff cases are made of: small, each with one thing wrong or extreme, in units of about 1.

use super::WrittenShape;
use super::closed_form::UnhiddenTriangles;
use glam::{DVec2, DVec3};
use std::f64::consts::{PI, TAU};
use std::path::Path;
use tinta::error::Result;
use tinta::mesh::{LoadOptions, Mesh, load};

/// A shape by name, with its parameter if it has one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Shape {
    /// One of the models that need no file.
    Builtin(&'static str),
    /// A sphere of 8 * 4^cuts triangles, an octahedron cut again and again.
    Ball(u32),
    /// The same with all triangles wound the other way.
    InsideOut(u32),
    /// A cube from 0 to 1.
    Cube,
    /// A box from 0 to 1 along x, this high and this deep.
    Solid(f64, f64),
    /// A cube from 0 to 1 and, before the middle of its front, another this much smaller.
    CubeAndSmaller(f64),
    /// The same with the smaller cube beside it.
    CubeBesideSmaller(f64),
    /// Eight cubes with sides of this length, at the corners of a larger one.
    Specks(f64),
    /// Two cubes with a side in common.
    Touching,
    /// A box on a floor two thousand times as wide.
    OnAFloor,
    /// An empty mesh.
    Nothing,
    /// One triangle, 1 wide and this high.
    Triangle(f64),
    /// Three vertices in one place.
    Point,
    /// Three vertices on a line.
    Line,
    /// A vertex with this value as one coordinate, in a square whose other corners are sound.
    BadVertex(f64),
    /// A needle this much longer than wide, standing on a triangle.
    Needle(f64),
    /// A ball with triangles without area strewn over its edges.
    ZeroAreas,
    /// A ball with triangles on its edges whose third corner lies between the others up to rounding.
    Slivers,
    /// Every triangle of a cube three times.
    Duplicates,
    /// Every triangle of a cube also the other way round.
    OppositeDuplicates,
    /// This many squares that share one edge.
    Fins(u32),
    /// A band with one side and one edge.
    Moebius,
    /// A square beside two half as long, with their common corner on its side.
    TJunction,
    /// A cube standing on another, with part of a face in common.
    Contact,
    /// Two cubes that pass through one another.
    Piercing,
    /// This many separate triangles.
    Isolated(u32),
    /// This many triangles around one vertex, in a plane.
    Fan(u32),
    /// Two squares whose normals differ by this angle, degrees.
    Hinge(f64),
    /// Four squares side by side, each a tenth of a unit behind the last: seen from the front they differ by depth only.
    Terraces,
    /// A sheet 1 high with this many folds of 90 degrees.
    Corrugated(u32),
    /// A wavy sheet, pressed flat along z, of this many squares along each side.
    Flat(u32),
    /// A comb of this many separate teeth, each as wide as the gap beside it.
    Comb(u32),
    /// A fence of this many closed bars, with gaps of a bar's width.
    Fence(u32),
    /// A shape that a file brings.
    Written(WrittenShape),
    /// A long strip from in front of the eye of these cases to far behind it, through the point (1, 1, 1) of eye space, the place
    /// of the articles' light.
    ThroughTheLight,
}

/// Positions and triangles.
type Triangles = (Vec<DVec3>, Vec<[u32; 3]>);

impl Shape {
    /// The shape as a mesh, each position `scale` times as far from the origin and then moved by `offset`; `folder` takes the
    /// picture of a shape that has one.
    ///
    /// # Errors
    ///
    /// The errors of a file with the same triangles.
    pub(crate) fn mesh(self, scale: f64, offset: DVec3, folder: &Path, options: &LoadOptions) -> Result<Mesh> {
        let (positions, triangles) = match self {
            Self::Builtin(name) if scale == 1.0 && offset == DVec3::ZERO => {
                return Ok(load(name, options)?.mesh);
            }
            Self::Written(written) => return written.mesh(folder, options),
            Self::Builtin(name) => {
                let mesh = load(name, options)?.mesh;
                (mesh.positions, mesh.triangles)
            }
            other => other.triangles(),
        };
        let positions = positions.into_iter().map(|point| point * scale + offset).collect();
        Mesh::of_triangles("a stiff case", positions, &triangles, options)
    }

    /// Its faces, if none of them hides part of another one that faces the eye.
    pub(super) fn unhidden(self) -> Option<UnhiddenTriangles> {
        let is_closed = match self {
            Self::Cube | Self::Solid(..) | Self::CubeBesideSmaller(_) | Self::Specks(_) | Self::Touching => true,
            Self::Ball(_) => true,
            Self::Corrugated(_) | Self::Triangle(_) | Self::Hinge(_) => false,
            _ => return None,
        };
        let (points, faces) = self.triangles();
        Some(UnhiddenTriangles { points, faces, is_closed })
    }

    fn triangles(self) -> Triangles {
        let unit = || cube(DVec3::ZERO, DVec3::ONE);
        let of_side = |low: DVec3, side: f64| cube(low, low + side);
        match self {
            Self::Builtin(_) | Self::Written(_) | Self::Nothing => Default::default(),
            Self::Ball(cuts) => ball(cuts),
            Self::InsideOut(cuts) => turned_round(ball(cuts)),
            Self::Cube => unit(),
            Self::Solid(height, depth) => cube(DVec3::ZERO, DVec3::new(1.0, height, depth)),
            Self::CubeAndSmaller(times) => {
                let side = 1.0 / times;
                both(unit(), of_side(DVec3::new(0.5 - side * 0.5, 0.5 - side * 0.5, 1.0 + side), side))
            }
            Self::CubeBesideSmaller(times) => both(unit(), of_side(DVec3::X * 1.5, times.recip())),
            Self::Specks(side) => {
                unit().0.into_iter().fold(Triangles::default(), |all, corner| both(all, of_side(corner, side)))
            }
            Self::Touching => both(unit(), of_side(DVec3::X, 1.0)),
            Self::OnAFloor => {
                let floor = cube(DVec3::new(-500.0, -1.0, -500.0), DVec3::new(500.0, 0.0, 500.0));
                both(floor, cube(DVec3::new(-0.25, 0.0, -0.25), DVec3::new(0.25, 1.0, 0.25)))
            }
            Self::Triangle(height) => (vec![DVec3::ZERO, DVec3::X, DVec3::Y * height], vec![[0, 1, 2]]),
            Self::Point => (vec![DVec3::splat(0.25); 3], vec![[0, 1, 2]]),
            Self::Line => (vec![DVec3::ZERO, DVec3::X, DVec3::X * 2.0], vec![[0, 1, 2]]),
            Self::BadVertex(bad) => both((vec![DVec3::new(bad, 0.5, 0.5)], vec![[1, 2, 0]]), unit()),
            Self::Needle(ratio) => needle(ratio),
            Self::ZeroAreas => on_edges(ball(2), |a, _| a, |a, b, c| vec![[a, b, c], [a, b, b], [a, a, a]]),
            Self::Slivers => on_edges(ball(2), DVec3::midpoint, |a, b, c| vec![[a, b, c]]),
            Self::Duplicates => (unit().0, unit().1.repeat(3)),
            Self::OppositeDuplicates => both(unit(), turned_round(unit())),
            Self::Fins(count) => fins(count),
            Self::Moebius => moebius(64),
            Self::TJunction => t_junction(),
            Self::Contact => both(unit(), cube(DVec3::new(0.25, 1.0, 0.25), DVec3::new(1.25, 1.5, 0.75))),
            Self::Piercing => both(unit(), turned_cube()),
            Self::Isolated(count) => isolated(count),
            Self::Fan(count) => fan(count),
            Self::Hinge(degrees) => hinge(degrees),
            Self::Terraces => strips(4, |step| {
                [0.0, 0.5].map(|more| DVec2::new(f64::from(step) * 0.5 + more, f64::from(step) * -0.1))
            }),
            Self::Corrugated(folds) => {
                let ridge = |fold: u32| DVec2::new(f64::from(fold), f64::from(fold % 2)) / f64::from(folds + 1);
                strips(folds + 1, |fold| [fold, fold + 1].map(ridge))
            }
            Self::Flat(side) => sheet(side),
            Self::Comb(teeth) => {
                let width = 0.5 / f64::from(teeth);
                strips(teeth, |tooth| [0.0, width].map(|more| DVec2::X * (f64::from(tooth) * 2.0 * width + more)))
            }
            Self::Fence(bars) => (0..bars).fold(Triangles::default(), |fence, number| {
                let low = DVec3::X * f64::from(number) * 0.04;
                both(fence, cube(low, low + DVec3::new(0.02, 1.0, 0.02)))
            }),
            Self::ThroughTheLight => through_the_light(),
        }
    }
}

/// Two shapes as one.
fn both(mut first: Triangles, second: Triangles) -> Triangles {
    let start = first.0.len() as u32;
    first.0.extend(second.0);
    first.1.extend(second.1.into_iter().map(|face| face.map(|index| index + start)));
    first
}

fn turned_round((points, faces): Triangles) -> Triangles {
    (points, faces.into_iter().map(|[a, b, c]| [a, c, b]).collect())
}

fn cube(low: DVec3, high: DVec3) -> Triangles {
    let pick = |corner: u32, axis: usize| if corner >> axis & 1 == 1 { high[axis] } else { low[axis] };
    let points = (0..8).map(|corner| DVec3::new(pick(corner, 0), pick(corner, 1), pick(corner, 2))).collect();
    let squares = [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
    (points, squares.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect())
}

fn turned_cube() -> Triangles {
    let (points, faces) = cube(DVec3::new(0.35, -0.2, 0.3), DVec3::new(0.75, 1.3, 0.8));
    let turn = glam::DQuat::from_rotation_z(0.4) * glam::DQuat::from_rotation_x(0.3);
    (points.into_iter().map(|point| turn * point).collect(), faces)
}

fn through_the_light() -> Triangles {
    let far = [(-0.6, -0.5), (0.6, -0.5), (0.0, 0.5)].map(|(x, y)| DVec3::new(x, y, -3.0));
    (vec![DVec3::ONE, far[0], far[1], far[2]], vec![[0, 1, 2], [0, 2, 3], [0, 3, 1]])
}

/// An octahedron cut and rounded again and again.
fn ball(cuts: u32) -> Triangles {
    let mut points = vec![DVec3::X, DVec3::Y, DVec3::Z, DVec3::NEG_X, DVec3::NEG_Y, DVec3::NEG_Z];
    let mut faces: Vec<[u32; 3]> =
        vec![[0, 1, 2], [1, 3, 2], [3, 4, 2], [4, 0, 2], [1, 0, 5], [3, 1, 5], [4, 3, 5], [0, 4, 5]];
    for _ in 0..cuts {
        let mut middles = std::collections::HashMap::new();
        let mut middle = |points: &mut Vec<DVec3>, a: u32, b: u32| {
            *middles.entry((a.min(b), a.max(b))).or_insert_with(|| {
                points.push((points[a as usize] + points[b as usize]).normalize());
                points.len() as u32 - 1
            })
        };
        let mut cut = Vec::with_capacity(faces.len() * 4);
        for [a, b, c] in faces {
            let [ab, bc, ca] = [middle(&mut points, a, b), middle(&mut points, b, c), middle(&mut points, c, a)];
            cut.extend([[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]);
        }
        faces = cut;
    }
    (points, faces)
}

/// A shape with more faces: for the first edge of each of its faces a new vertex, made of the edge's ends, and faces of the three.
fn on_edges(
    (mut points, mut faces): Triangles,
    vertex: impl Fn(DVec3, DVec3) -> DVec3,
    more: impl Fn(u32, u32, u32) -> Vec<[u32; 3]>,
) -> Triangles {
    for [a, b, _] in faces.clone() {
        points.push(vertex(points[a as usize], points[b as usize]));
        faces.extend(more(a, b, points.len() as u32 - 1));
    }
    (points, faces)
}

fn needle(ratio: f64) -> Triangles {
    let points = [DVec3::ZERO, DVec3::X / ratio, DVec3::Y, DVec3::X * 0.5, DVec3::new(0.25, 0.0, 0.3)];
    (points.to_vec(), vec![[0, 1, 2], [0, 3, 4]])
}

fn t_junction() -> Triangles {
    let points = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0), (2.0, 0.0), (2.0, 0.5), (1.0, 0.5), (2.0, 1.0)];
    let points = points.map(|(x, y)| DVec3::new(x, y, 0.0)).to_vec();
    (points, vec![[0, 1, 2], [0, 2, 3], [1, 4, 5], [1, 5, 6], [6, 5, 7], [6, 7, 2]])
}

fn fan(count: u32) -> Triangles {
    let rim = (0..count).map(|step| {
        let angle = f64::from(step) / f64::from(count) * TAU;
        DVec3::new(angle.cos(), angle.sin(), 0.0)
    });
    let points = std::iter::once(DVec3::ZERO).chain(rim).collect();
    (points, (0..count).map(|step| [0, 1 + step, 1 + (step + 1) % count]).collect())
}

/// The hinge is the z axis; one leaf lies in y = 0, the other is bent down from it.
fn hinge(degrees: f64) -> Triangles {
    let (sin, cos) = degrees.to_radians().sin_cos();
    let leaf = DVec3::new(cos, -sin, 0.0);
    let points = vec![DVec3::ZERO, DVec3::Z, DVec3::Z - DVec3::X, DVec3::NEG_X, leaf, leaf + DVec3::Z];
    (points, vec![[0, 1, 2], [0, 2, 3], [0, 4, 5], [0, 5, 1]])
}

/// Upright rectangles of height 1, each from its left to its right end in the plane of x and z.
fn strips(count: u32, ends: impl Fn(u32) -> [DVec2; 2]) -> Triangles {
    let strip = |number: u32| {
        let [left, right] = ends(number);
        [(left, 0.0), (right, 0.0), (right, 1.0), (left, 1.0)].map(|(end, y)| DVec3::new(end.x, y, end.y))
    };
    let faces = (0..count).flat_map(|number| [[0, 1, 2], [0, 2, 3]].map(|face| face.map(|i| i + number * 4)));
    ((0..count).flat_map(strip).collect(), faces.collect())
}

fn fins(count: u32) -> Triangles {
    let mut points = vec![DVec3::ZERO, DVec3::Y];
    let mut faces = Vec::new();
    for fin in 0..count {
        let angle = f64::from(fin) / f64::from(count) * TAU;
        let out = DVec3::new(angle.cos(), 0.0, angle.sin());
        let first = points.len() as u32;
        points.extend([out, out + DVec3::Y]);
        faces.extend([[0, first, first + 1], [0, first + 1, 1]]);
    }
    (points, faces)
}

fn moebius(steps: u32) -> Triangles {
    let rung = |step: u32| {
        let around = f64::from(step) / f64::from(steps) * TAU;
        let half = around * 0.5;
        let out = DVec3::new(around.cos(), 0.0, around.sin());
        let across = (out * half.cos() + DVec3::Y * half.sin()) * 0.4;
        [out - across, out + across]
    };
    let points = (0..steps).flat_map(rung).collect();
    let faces = (0..steps).flat_map(|step| {
        let [a, b] = [step * 2, step * 2 + 1];
        // The last rung meets the first one turned over.
        let [c, d] = if step + 1 == steps { [1, 0] } else { [a + 2, b + 2] };
        [[a, b, c], [b, d, c]]
    });
    (points, faces.collect())
}

/// Small triangles on a grid, each turned separately.
fn isolated(count: u32) -> Triangles {
    let side = f64::from(count).sqrt().ceil();
    let corner = |index: u32, corner: u32| {
        let place = DVec2::new(f64::from(index) % side, (f64::from(index) / side).floor()) / side;
        let angle = f64::from(index) * 0.7 + f64::from(corner) * TAU / 3.0;
        let depth = (place.x * 9.0).sin() * (place.y * 7.0).cos() * 0.2;
        DVec3::new(place.x + angle.cos() * 0.4 / side, place.y + angle.sin() * 0.4 / side, depth)
    };
    let points = (0..count).flat_map(|index| (0..3).map(move |place| corner(index, place))).collect();
    (points, (0..count).map(|index| [index * 3, index * 3 + 1, index * 3 + 2]).collect())
}

/// A sheet of squares in the plane z = 0 with a wavy rim.
fn sheet(side: u32) -> Triangles {
    let at = |x: u32, y: u32| {
        let (x, y) = (f64::from(x) / f64::from(side), f64::from(y) / f64::from(side));
        DVec3::new(x + (y * PI * 3.0).sin() * 0.05, y + (x * PI * 2.0).sin() * 0.05, 0.0)
    };
    let points = (0..=side).flat_map(|y| (0..=side).map(move |x| at(x, y))).collect();
    let faces = (0..side).flat_map(|y| {
        (0..side).flat_map(move |x| {
            let [a, b] = [y * (side + 1) + x, (y + 1) * (side + 1) + x];
            [[a, a + 1, b + 1], [a, b + 1, b]]
        })
    });
    (points, faces.collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use tinta::edges::{EdgeList, Incidence};

    fn mesh(shape: Shape) -> Mesh {
        shape.mesh(1.0, DVec3::ZERO, Path::new(""), &LoadOptions::default()).unwrap()
    }

    /// Boundary, inner, reversed and non-manifold edges.
    fn incidences(shape: Shape) -> [usize; 4] {
        let mesh = mesh(shape);
        let list = EdgeList::new(&mesh);
        [Incidence::Boundary, Incidence::Inner, Incidence::InnerReversed, Incidence::NonManifold]
            .map(|kind| list.incidence().iter().filter(|incidence| **incidence == kind).count())
    }

    #[test]
    fn shapes_have_the_edges_their_names_say() {
        assert_eq!(incidences(Shape::Cube), [0, 18, 0, 0]);
        assert_eq!(incidences(Shape::Ball(2)), [0, 192, 0, 0]);
        assert_eq!(incidences(Shape::Fins(5)), [15, 5, 0, 1]);
        assert_eq!(incidences(Shape::Fan(100)), [100, 100, 0, 0]);
        assert_eq!(incidences(Shape::Isolated(7)), [21, 0, 0, 0]);
        assert_eq!(incidences(Shape::Hinge(60.0)), [6, 3, 0, 0]);
        // A band of 64 rungs has one rim of 128 edges, and one rung where its two ends meet the wrong way round.
        assert_eq!(incidences(Shape::Moebius), [128, 127, 1, 0]);
        // Twice the same faces in opposite directions: each of the cube's edges has four of them.
        assert_eq!(incidences(Shape::OppositeDuplicates), [0, 0, 0, 18]);
    }

    #[test]
    fn a_cubes_and_a_balls_normals_point_outward_and_turned_round_inward() {
        let outward = |shape: Shape, middle: DVec3| {
            let mesh = mesh(shape);
            let corners = |face: &[u32; 3]| face.map(|index| mesh.positions[index as usize] - middle);
            mesh.triangles
                .iter()
                .filter(|face| {
                    let [a, b, c] = corners(face);
                    (b - a).cross(c - a).dot(a) > 0.0
                })
                .count()
        };
        assert_eq!(outward(Shape::Cube, DVec3::splat(0.5)), 12);
        assert_eq!(outward(Shape::Ball(1), DVec3::ZERO), 32);
        assert_eq!(outward(Shape::InsideOut(1), DVec3::ZERO), 0);
    }

    #[test]
    fn what_is_nothing_is_refused_and_what_is_bad_is_left_out() {
        let options = LoadOptions::default();
        let refused = |shape: Shape| shape.mesh(1.0, DVec3::ZERO, Path::new(""), &options).unwrap_err().kind();
        assert_eq!([Shape::Nothing, Shape::Point, Shape::Line].map(refused), ["model"; 3]);
        assert_eq!(mesh(Shape::BadVertex(f64::NAN)).triangles.len(), 12);
        assert_eq!(mesh(Shape::Duplicates).defects.duplicate_triangles, 24);
        assert_eq!(mesh(Shape::ZeroAreas).triangles.len(), 128);
    }
}
