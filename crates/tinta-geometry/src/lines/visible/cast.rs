//! The first face that a ray through each pixel's middle hits: a picture of the scene without GL.

use crate::bvh::Box3;
use crate::lines::visible::faces::Faces;
use crate::lines::visible::space::Space;
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
/// near and the far plane. Computes in f64. Of faces in the same place, the one with the lower number counts.
pub fn first_hits(scene: &Scene) -> Vec<Option<Hit>> {
    let space = Space::of(scene);
    let faces = Faces::of(&space, scene);
    let width = scene.size.width as usize;
    let rows = in_chunks(scene.size.height as usize, 8, cores(), |rows| {
        let mut hits = Vec::with_capacity(rows.len() * width);
        for y in rows {
            for x in 0..width {
                let px = DVec2::new(x as f64 + 0.5, y as f64 + 0.5);
                hits.push(first_hit(&space, &faces, px));
            }
        }
        hits
    });
    rows.concat()
}

/// Returns the first hit of the ray through a place in the picture.
pub(in crate::lines) fn first_hit(space: &Space, faces: &Faces, px: DVec2) -> Option<Hit> {
    let column = Box3::new(px.extend(f64::NEG_INFINITY), px.extend(f64::INFINITY));
    let ray = space.ray(px);
    let mut first: Option<(f64, u32, [f64; 3])> = None;
    faces.tree.any(&column, |place| {
        let number = faces.numbers[place as usize];
        if let Some((depth, weights)) = meet(space, faces.corners(place), ray) {
            let is_first = first.is_none_or(|(least, other, _)| depth < least || (depth == least && number < other));
            if is_first && (space.near..=space.far).contains(&depth) {
                first = Some((depth, number, weights));
            }
        }
        false
    });
    first.map(|(depth, number, weights)| {
        let (object, face) = faces.in_object(number);
        Hit { object: object as u32, face, weights, depth }
    })
}

/// Returns the depth at which a ray, given by two of its points, meets a face, with the corners' weights.
pub(in crate::lines) fn meet(space: &Space, corners: [DVec3; 3], [from, to]: [DVec3; 2]) -> Option<(f64, [f64; 3])> {
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
