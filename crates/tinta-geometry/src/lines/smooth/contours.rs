//! Smooth contours: where the smooth surface that the faces approximate turns away from the eye (Hertzmann and Zorin
//! 2000).
//!
//! Input: the scene's objects with their [`SmoothSurface`]s. Output: [`Contours`]. n . v is computed at every corner,
//! where n is the smooth normal and v the direction to the eye. Inside a face it is taken as linear, so it is 0 along
//! at most one straight segment, which begins and ends on the face's sides. At a side that is not sharp, both faces
//! get bit-identical ends, so the segments chain without gaps. Exactly 0, or a value within rounding of it, counts as
//! front, as if the eye were slightly farther out along the normal. So no face has more than one segment, and a face
//! with n . v = 0 everywhere has none. At a vertex with n . v = 0 the contour passes as if slightly beside it.
//!
//! At a sharp edge each face has its own normals. The edge is silhouette along the shares where exactly one side is
//! front. Such a share begins where a smooth contour ends on the edge. Between flat faces this is the rule for
//! polygons.

use crate::edges::{CreaseAngle, EdgeList, Eye, Incidence, Shell, SilhouetteRule, SmoothSurface};
use crate::lines::eye::space::Space;
use crate::lines::input::object_edges::ObjectEdges;
use crate::mesh::{Mesh, NONE, triangle_normal};
use crate::scene::Scene;
use crate::threads::{cores, filled, in_chunks};
use crate::tolerances::{EDGE_ON, FLAT};
use glam::DVec3;
use std::sync::Arc;

/// The smooth contours of a scene, before their visibility is decided.
pub(in crate::lines) struct Contours {
    pub surfaces: Vec<ObjectSurface>,
    /// Segments by object, then face; then those on edges; then pieces cut off at cusps.
    pub pieces: Vec<ContourPiece>,
    /// The connections between segments.
    pub links: Vec<Link>,
}

/// The smooth surface of an object, seen from an eye.
pub(in crate::lines) struct ObjectSurface {
    pub surface: Arc<SmoothSurface>,
    pub mesh: Arc<Mesh>,
    /// n . v of each normal, in units of v; 0 if it is within rounding.
    pub towards: Vec<f64>,
    /// The object's first position among those of all objects.
    pub first_position: u32,
    /// Whether the eye may be inside closed shells.
    sees_inside: bool,
    /// The silhouette shares of sharp edges next to curved faces: by edge, then along it.
    pub edge_parts: Vec<(u32, [f64; 2])>,
}

/// A straight segment of a contour, inside one face or on a sharp edge.
#[derive(Debug, Clone, Copy)]
pub(in crate::lines) struct ContourPiece {
    /// The object, and the face in its edge list.
    pub object: u32,
    pub face: u32,
    /// The edges on which it begins and ends, at most one of them [`NONE`]: a side where other faces continue. Its ends in eye space.
    pub edges: [u32; 2],
    pub ends: [DVec3; 2],
    /// The smooth surface's normals at its ends, of any length, in eye space.
    pub normals: [DVec3; 2],
    /// Whether its front side is nearer to the eye; there the surface bends away from the eye on the normal's side.
    pub bends_away: bool,
    /// The same from its face alone: the growth of n . v towards the eye, times twice the face's area.
    pub bend: f64,
    /// The sharp edge that it lies on, if any: there the smooth normals turn away, but the faces do not.
    pub on_edge: Option<u32>,
}

/// Two segments that meet, on an edge or at a cusp inside a face, and the end of each.
#[derive(Debug, Clone, Copy)]
pub(in crate::lines) struct Link {
    pub object: u32,
    pub ends: [(usize, usize); 2],
}

/// The place where a cut through a face leaves it.
pub(in crate::lines) struct Exit {
    pub point: DVec3,
    pub edge: u32,
    /// n . v at this place.
    pub towards: f64,
}

/// An edge under the smooth rule.
pub(in crate::lines) enum OnEdge {
    /// The faces decide, as in the exact rule.
    ByFaces,
    /// Silhouette between these shares of it, counted from its lower position.
    Shares(Vec<[f64; 2]>),
    /// Like `Shares`, but only the smooth normals turn away, not the faces: the shares belong to a contour.
    OfContour(Vec<[f64; 2]>),
}

/// Faces per batch of a thread.
const CHUNK: usize = 8192;

impl Contours {
    /// Finds the segments and their cusps. `positions` are those of all objects in eye space. The
    /// near plane may cut faces open.
    pub(in crate::lines) fn new(
        scene: &Scene,
        space: &Space,
        positions: &[DVec3],
        is_cut_by_near: bool,
        objects: &[ObjectEdges<'_>],
        crease_angle: CreaseAngle,
    ) -> Self {
        let mut all = Self { surfaces: Vec::with_capacity(objects.len()), pieces: Vec::new(), links: Vec::new() };
        for (number, object) in objects.iter().enumerate() {
            let edges = object.edges.get();
            let (mesh, surface) = (edges.mesh().clone(), edges.smooth(crease_angle));
            let eye = scene.eye(object.object, SilhouetteRule::Exact);
            let count = surface.normals.len();
            let towards = filled(count, cores().min(count / CHUNK).max(1), 0.0, |normal| {
                towards(surface.normals[normal], mesh.positions[surface.normal_positions[normal] as usize], eye)
            });
            let (low, high) = mesh.bounds();
            let is_within = |eye: DVec3| eye.cmpge(low).all() && eye.cmple(high).all();
            let sees_inside = is_cut_by_near || matches!(eye, Eye::Point(eye) if is_within(eye));
            let first_position = object.first_position;
            let mut curved =
                ObjectSurface { surface, mesh, towards, first_position, sees_inside, edge_parts: Vec::new() };
            let chunks = in_chunks(curved.mesh.triangles.len(), CHUNK, cores(), |range| {
                range.filter_map(|face| curved.piece(space, positions, number as u32, face as u32)).collect::<Vec<_>>()
            });
            chunks.into_iter().for_each(|chunk| all.pieces.extend(chunk));
            let list = edges.list();
            for edge in (0..list.len() as u32).filter(|edge| curved.surface.is_sharp[*edge as usize]) {
                match curved.on_edge(space, positions, list, edge) {
                    OnEdge::ByFaces => {}
                    OnEdge::Shares(shares) => curved.edge_parts.extend(shares.into_iter().map(|share| (edge, share))),
                    OnEdge::OfContour(shares) => {
                        let pieces = curved.pieces_on_edge(space, positions, list, number as u32, edge, shares);
                        all.pieces.extend(pieces);
                    }
                }
            }
            all.surfaces.push(curved);
        }
        all.linked(positions)
    }

    /// Whether a segment belongs to a closed shell and bends towards its inside, so it cannot be visible from
    /// outside.
    pub(in crate::lines) fn is_inside(&self, piece: &ContourPiece) -> bool {
        self.surfaces[piece.object as usize].encloses(piece.face, piece.bends_away)
    }
}

/// n . v of a normal at a position; 0 if it is within rounding.
fn towards(normal: DVec3, position: DVec3, eye: Eye) -> f64 {
    let to_eye = match eye {
        Eye::Point(eye) => eye - position,
        Eye::Direction(direction) => direction,
    };
    let towards = normal.dot(to_eye);
    if towards.abs() <= EDGE_ON * to_eye.length() { 0.0 } else { towards }
}

/// Whether a value counts as front.
fn is_front(towards: f64) -> bool {
    towards >= 0.0
}

/// The place along an edge, from its lower position, where a linear value passes 0.
fn zero([low, high]: [f64; 2]) -> f64 {
    (low / (low - high)).clamp(0.0, 1.0)
}

/// A point between two others; shares of 0 and 1 give them exactly.
pub(in crate::lines) fn between(from: DVec3, to: DVec3, share: f64) -> DVec3 {
    match share {
        0.0 => from,
        1.0 => to,
        _ => from + (to - from) * share,
    }
}

impl ObjectSurface {
    /// n . v at a face's corners.
    pub(in crate::lines) fn of_face(&self, face: u32) -> [f64; 3] {
        self.surface.corner_normals[face as usize].map(|normal| self.towards[normal as usize])
    }

    /// A face's corners in eye space.
    pub(in crate::lines) fn corners(&self, positions: &[DVec3], face: u32) -> [DVec3; 3] {
        self.mesh.triangles[face as usize].map(|position| positions[(position + self.first_position) as usize])
    }

    pub(in crate::lines) fn longest_side(&self, positions: &[DVec3], face: u32) -> f64 {
        let [a, b, c] = self.corners(positions, face);
        a.distance(b).max(b.distance(c)).max(c.distance(a))
    }

    /// The contour's segment inside a face; `None` if it has none.
    fn piece(&self, space: &Space, positions: &[DVec3], object: u32, face: u32) -> Option<ContourPiece> {
        let values = self.of_face(face);
        let fronts = values.map(is_front);
        if fronts == [true; 3] || fronts == [false; 3] {
            return None;
        }
        let triangle = self.mesh.triangles[face as usize];
        let corners = self.corners(positions, face);
        let normals = self.surface.corner_normals[face as usize].map(|normal| self.surface.normals[normal as usize]);
        let mut crossings = (0..3).filter(|side| fronts[*side] != fronts[(side + 1) % 3]).map(|side| {
            let next = (side + 1) % 3;
            // The same numbers in the same order from either face.
            let [low, high] = if triangle[side] < triangle[next] { [side, next] } else { [next, side] };
            let share = zero([values[low], values[high]]);
            let edge = self.surface.sides[face as usize][side];
            let point = between(corners[low], corners[high], share);
            let normal = normals[low] + (normals[high] - normals[low]) * share;
            (edge, point, space.direction(normal))
        });
        let (first, second) = (crossings.next()?, crossings.next()?);
        if first.0 == NONE && second.0 == NONE {
            return None;
        }
        let (along, across) = (corners[1] - corners[0], corners[2] - corners[0]);
        let normal = along.cross(across);
        // The direction in which n . v grows fastest, times the squared normal.
        let growth = across.cross(normal) * (values[1] - values[0]) + normal.cross(along) * (values[2] - values[0]);
        let bend = growth.dot(space.to_eye((first.1 + second.1) * 0.5)) / normal.length();
        Some(ContourPiece {
            object,
            face,
            edges: [first.0, second.0],
            ends: [first.1, second.1],
            normals: [first.2, second.2],
            bends_away: bend > 0.0,
            bend: if bend.is_finite() { bend } else { 0.0 },
            on_edge: None,
        })
    }

    /// The shares of a sharp edge at which its smooth normals turn away but its faces do not.
    fn pieces_on_edge(
        &self,
        space: &Space,
        positions: &[DVec3],
        list: &EdgeList,
        object: u32,
        edge: u32,
        shares: Vec<[f64; 2]>,
    ) -> Vec<ContourPiece> {
        let &[first, second] = list.faces(edge) else { return Vec::new() };
        let ends = list.positions()[edge as usize];
        let [low, high] = ends.map(|position| positions[(position + self.first_position) as usize]);
        let normal = |face: u32, share: f64| {
            let [low, high] = self.at_ends(face, ends).map(|normal| self.surface.normals[normal as usize]);
            between(low, high, share)
        };
        let bends_away = self.is_convex(positions, [first, second]);
        let piece = |[from, to]: [f64; 2]| ContourPiece {
            object,
            face: first,
            edges: [edge; 2],
            ends: [from, to].map(|share| between(low, high, share)),
            normals: [from, to].map(|share| space.direction(normal(first, share) + normal(second, share))),
            bends_away,
            bend: 0.0,
            on_edge: Some(edge),
        };
        shares.into_iter().map(piece).collect()
    }

    /// The exit of a plane through a point from a face, by another side than it came in; of two exits the farther
    /// along a direction.
    pub(in crate::lines) fn exit(
        &self,
        positions: &[DVec3],
        face: u32,
        came: u32,
        [point, plane]: [DVec3; 2],
        way: DVec3,
    ) -> Option<Exit> {
        let corners = self.corners(positions, face);
        let values = self.of_face(face);
        let heights = corners.map(|corner| plane.dot(corner - point));
        let exits = (0..3).filter_map(|side| {
            let next = (side + 1) % 3;
            let edge = self.surface.sides[face as usize][side];
            if edge == came || edge == NONE || (heights[side] >= 0.0) == (heights[next] >= 0.0) {
                return None;
            }
            let share = heights[side] / (heights[side] - heights[next]);
            let towards = values[side] + (values[next] - values[side]) * share;
            Some(Exit { point: between(corners[side], corners[next], share), edge, towards })
        });
        exits.max_by(|a, b| way.dot(a.point).total_cmp(&way.dot(b.point)))
    }

    pub(in crate::lines) fn is_front_face(&self, space: &Space, positions: &[DVec3], face: u32) -> bool {
        let [a, b, c] = self.corners(positions, face);
        (b - a).cross(c - a).dot(space.to_eye(a)) > 0.0
    }

    /// The silhouette shares of an edge.
    pub(in crate::lines) fn on_edge(&self, space: &Space, positions: &[DVec3], list: &EdgeList, edge: u32) -> OnEdge {
        if list.incidence()[edge as usize] != Incidence::Inner {
            return OnEdge::ByFaces;
        }
        if !self.surface.is_sharp[edge as usize] {
            return OnEdge::Shares(Vec::new());
        }
        let ends = list.positions()[edge as usize];
        let &[first, second] = list.faces(edge) else { return OnEdge::ByFaces };
        if self.is_flat(first, ends) && self.is_flat(second, ends) {
            return OnEdge::ByFaces;
        }
        let values = [first, second].map(|face| self.at_ends(face, ends).map(|normal| self.towards[normal as usize]));
        let mut places = vec![0.0, 1.0];
        places.extend(values.iter().filter(|[low, high]| is_front(*low) != is_front(*high)).map(|ends| zero(*ends)));
        places.sort_unstable_by(f64::total_cmp);
        let differs = |place: f64| {
            let [first, second] = values.map(|[low, high]| low + (high - low) * place);
            is_front(first) != is_front(second)
        };
        let shares = places.windows(2).filter(|share| share[0] < share[1] && differs((share[0] + share[1]) * 0.5));
        let shares = shares.map(|share| [share[0], share[1]]).collect();
        // If the bend cannot be seen from outside, the edge keeps its other classes.
        match self.is_front_face(space, positions, first) == self.is_front_face(space, positions, second) {
            false => OnEdge::Shares(shares),
            true if self.encloses(first, self.is_convex(positions, [first, second])) => OnEdge::Shares(Vec::new()),
            true => OnEdge::OfContour(shares),
        }
    }

    /// Whether the second face lies behind the first.
    fn is_convex(&self, positions: &[DVec3], of: [u32; 2]) -> bool {
        let [[a, b, c], other] = of.map(|face| self.corners(positions, face));
        (b - a).cross(c - a).dot((other[0] + other[1] + other[2]) / 3.0 - a) < 0.0
    }

    /// Whether a face's shell is closed, and a surface with this bend at the face bends towards its inside.
    fn encloses(&self, face: u32, bends_away: bool) -> bool {
        !self.sees_inside
            && match self.surface.shells[face as usize] {
                Shell::Open => false,
                Shell::Outward => !bends_away,
                Shell::Inward => bends_away,
            }
    }

    /// A face's normals at two of its positions.
    fn at_ends(&self, face: u32, ends: [u32; 2]) -> [u32; 2] {
        let triangle = self.mesh.triangles[face as usize];
        ends.map(|end| {
            let corner = triangle.iter().position(|position| *position == end).unwrap_or(0);
            self.surface.corner_normals[face as usize][corner]
        })
    }

    /// Whether a face's smooth normals at two of its positions equal the face's own.
    fn is_flat(&self, face: u32, ends: [u32; 2]) -> bool {
        let corners = self.mesh.triangles[face as usize].map(|position| self.mesh.positions[position as usize]);
        let Some(own) = triangle_normal(corners) else { return true };
        self.at_ends(face, ends).iter().all(|normal| self.surface.normals[*normal as usize].distance(own) <= FLAT)
    }
}
