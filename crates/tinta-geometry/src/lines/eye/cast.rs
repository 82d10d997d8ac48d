//! The first face that a ray through each pixel's middle hits: a picture of the scene without GL.

use crate::bvh::Box3;
use crate::lines::eye::face_pair::FacePlane;
use crate::lines::eye::faces::Faces;
use crate::lines::eye::pieces::PieceTree;
use crate::lines::eye::space::Space;
use crate::scene::Scene;
use crate::threads::{cores, in_chunks};
use glam::{DVec2, DVec3};

/// A ray's first hit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hit {
    /// The object in the scene.
    pub object: u32,
    /// The face in the object's mesh.
    pub face: u32,
    /// The point as a mean of the face's three corners: their weights in space, which add up to 1.
    pub weights: [f64; 3],
    /// Distance from the eye along the view, file units.
    pub depth: f64,
}

/// Returns the first hit of the ray through each pixel's middle, row by row from the top; `None` where no face lies between the
/// near and the far plane. Computes in f64. Of faces that touch there, the one with the lowest number counts.
pub fn first_hits(scene: &Scene) -> Vec<Option<Hit>> {
    let space = Space::of(scene);
    let faces = Faces::of(&space, scene);
    let width = scene.size.width as usize;
    let rows = in_chunks(scene.size.height as usize, 8, cores(), |rows| {
        let mut hits = Vec::with_capacity(rows.len() * width);
        for y in rows {
            for x in 0..width {
                let px = DVec2::new(x as f64 + 0.5, y as f64 + 0.5);
                hits.push(first_hit(&space, &faces, None, px));
            }
        }
        hits
    });
    rows.concat()
}

/// Where a ray meets a face.
#[derive(Debug, Clone, Copy)]
pub(in crate::lines) struct FaceHit {
    pub depth: f64,
    pub place: u32,
    pub weights: [f64; 3],
}

/// Returns the first hit of the ray through a place in the picture. Of faces that touch there, the one with the lowest number counts, as
/// in a picture by GL. A tree of the faces' pieces, without those that are hidden for sure, makes it quicker.
pub(in crate::lines) fn first_hit(space: &Space, faces: &Faces, pieces: Option<&PieceTree>, px: DVec2) -> Option<Hit> {
    let hits = nearest_hits(space, faces, pieces, px).into_iter();
    let FaceHit { depth, place, weights } = hits.min_by_key(|hit| faces.numbers[hit.place as usize])?;
    let (object, face) = faces.in_object(faces.numbers[place as usize]);
    Some(Hit { object: object as u32, face, weights, depth })
}

/// Returns the first hit of the ray through a place in the picture, and those of faces that touch it there.
pub(in crate::lines) fn nearest_hits(
    space: &Space,
    faces: &Faces,
    pieces: Option<&PieceTree>,
    px: DVec2,
) -> Vec<FaceHit> {
    let column = Box3::new(px.extend(f64::NEG_INFINITY), px.extend(f64::INFINITY));
    let ray = space.ray(px);
    let mut hits: Vec<FaceHit> = Vec::new();
    let mut add = |place: u32| {
        let hit = meet(space, faces.corners(place), ray);
        let hit = hit.filter(|(depth, _)| (space.near..=space.far).contains(depth));
        hits.extend(hit.map(|(depth, weights)| FaceHit { depth, place, weights }));
        false
    };
    match pieces {
        Some(pieces) => pieces.any(&column, |place| add(place as u32)),
        None => faces.tree.any(&column, add),
    };
    let Some(nearest) = hits.iter().min_by(|a, b| a.depth.total_cmp(&b.depth)).copied() else { return hits };
    let [a, b, c] = faces.corners(nearest.place);
    let point = a * nearest.weights[0] + b * nearest.weights[1] + c * nearest.weights[2];
    let of_nearest = FacePlane::exact(faces, nearest.place);
    let touches = |place: u32| FacePlane::exact(faces, place).touches(space, &of_nearest, point);
    hits.retain(|hit| hit.place == nearest.place || touches(hit.place));
    hits
}

/// Returns the depth at which a ray, given by two of its points, meets a face, with the corners' weights.
fn meet(space: &Space, corners: [DVec3; 3], [from, to]: [DVec3; 2]) -> Option<(f64, [f64; 3])> {
    let turns = [1, 2, 0].map(|first| space.turn(corners[first], corners[(first + 1) % 3], to).0);
    let is_inside = turns.iter().all(|turn| *turn >= 0.0) || turns.iter().all(|turn| *turn <= 0.0);
    let [a, b, c] = corners;
    let normal = (b - a).cross(c - a);
    let along = normal.dot(to - from);
    if !is_inside || along == 0.0 {
        return None;
    }
    let point = from + (to - from) * (normal.dot(a - from) / along);
    let square = normal.length_squared();
    let weight = |from: DVec3, to: DVec3| (to - from).cross(point - from).dot(normal) / square;
    Some((-point.z, [weight(b, c), weight(c, a), weight(a, b)]))
}
