//! Why a picture may show nothing of a scene.
//!
//! Input: the faces for GL, the model's curves and the camera. Each face is followed until it leaves: before the eye, in the picture, between the
//! planes, turned to the eye, on the centre of a pixel. The face that gets farthest gives the answer, and the first that
//! reaches a centre ends the search. Places are those that GL computes, with room for its rounding.

use super::{Object, Scene, Size};
use crate::tolerances::WINDOW_ROUNDING_PX;
use glam::{DMat4, DVec2, DVec3, DVec4};

/// Where the last face of a scene leaves the picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum UnseenReason {
    /// No face is before the eye.
    Behind,
    /// Those before it lie beside the picture.
    Beside,
    /// Those in the picture lie before the near plane or beyond the far one.
    CutOff,
    /// Those between the planes are turned away and culled.
    TurnedAway,
    /// The others may lie between the centres of pixels.
    BetweenPixels,
}

/// The sides of the picture, then the near and far planes: points inside have products of at least 0 with all of them.
pub(super) const SIDES: [DVec4; 4] = [
    DVec4::new(1.0, 0.0, 0.0, 1.0),
    DVec4::new(-1.0, 0.0, 0.0, 1.0),
    DVec4::new(0.0, 1.0, 0.0, 1.0),
    DVec4::new(0.0, -1.0, 0.0, 1.0),
];
const PLANES: [DVec4; 2] = [DVec4::new(0.0, 0.0, 1.0, 1.0), DVec4::new(0.0, 0.0, -1.0, 1.0)];

impl Scene {
    /// Returns why a picture on a surface of this size may show no face; `None` where a face surely covers a pixel's centre.
    /// `culls` says whether faces turned away from the eye are left out.
    pub fn unseen(&self, surface: Size, culls: bool) -> Option<UnseenReason> {
        let mut farthest = UnseenReason::Behind;
        let (outside, mut seen): (Vec<&Object>, Vec<_>) = self.objects.iter().partition(|it| self.is_outside(it, 0.0));
        if seen.is_empty() {
            seen = outside;
        }
        for object in seen {
            let arrays = self.arrays(object);
            let view_from_object = self.view_from_object(object, arrays.centre).as_dmat4();
            let clip_from_view = self.clip_from_view().as_dmat4();
            let reach = |corners: &[DVec3]| {
                let view: Vec<DVec3> =
                    corners.iter().map(|corner| view_from_object.transform_point3(*corner)).collect();
                reach(&view, clip_from_view, surface, culls)
            };
            for face in arrays.indices.chunks_exact(3) {
                let corner = |number: usize| {
                    let [x, y, z, ..] = arrays.vertices[face[number] as usize];
                    DVec3::new(x.into(), y.into(), z.into())
                };
                farthest = farthest.max(reach(&[0, 1, 2].map(corner))?);
            }
            let curves = &object.mesh.curves;
            let place = |position: u32| (curves.positions[position as usize] - arrays.centre) / self.radius;
            for segment in &curves.segments {
                farthest = farthest.max(reach(&segment.map(place))?);
            }
            for point in &curves.points {
                farthest = farthest.max(reach(&[place(*point)])?);
            }
        }
        Some(farthest)
    }
}

/// Where a face with these corners in the eye's space leaves the picture; `None` if it covers a pixel's centre.
fn reach(view: &[DVec3], clip_from_view: DMat4, surface: Size, culls: bool) -> Option<UnseenReason> {
    if view.iter().all(|corner| corner.z >= 0.0) {
        return Some(UnseenReason::Behind);
    }
    let mut clip: Vec<DVec4> = view.iter().map(|corner| clip_from_view * corner.extend(1.0)).collect();
    for (planes, unseen) in [(&SIDES[..], UnseenReason::Beside), (&PLANES[..], UnseenReason::CutOff)] {
        planes.iter().for_each(|plane| clip = inside(&clip, *plane));
        if clip.is_empty() {
            return Some(unseen);
        }
    }
    let half = DVec2::new(f64::from(surface.width), f64::from(surface.height)) * 0.5;
    let places: Vec<DVec2> = clip.iter().map(|corner| corner.truncate().truncate() / corner.w * half + half).collect();
    let turn = |pair: &[DVec2]| (pair[0] - places[0]).perp_dot(pair[1] - places[0]);
    if culls && places.windows(2).map(turn).sum::<f64>() < 0.0 {
        return Some(UnseenReason::TurnedAway);
    }
    (!covers_a_centre(&places)).then_some(UnseenReason::BetweenPixels)
}

/// The part of a convex polygon on the inner side of a plane.
pub(super) fn inside(polygon: &[DVec4], plane: DVec4) -> Vec<DVec4> {
    let mut kept = Vec::with_capacity(polygon.len() + 1);
    for (number, to) in polygon.iter().enumerate() {
        let from = polygon[(number + polygon.len() - 1) % polygon.len()];
        let [before, after] = [from.dot(plane), to.dot(plane)];
        if (before < 0.0) != (after < 0.0) {
            kept.push(from + (*to - from) * (before / (before - after)));
        }
        if after >= 0.0 {
            kept.push(*to);
        }
    }
    kept
}

/// Whether a convex polygon surely covers the centre of a pixel.
fn covers_a_centre(places: &[DVec2]) -> bool {
    // The first and the last centre between two places, given as counts of pixels.
    let centres =
        |low: f64, high: f64| [(low + WINDOW_ROUNDING_PX - 0.5).ceil(), (high - WINDOW_ROUNDING_PX - 0.5).floor()];
    let heights = places.iter().map(|place| place.y);
    let [mut row, last] =
        centres(heights.clone().fold(f64::INFINITY, f64::min), heights.fold(f64::NEG_INFINITY, f64::max));
    while row <= last {
        let height = row + 0.5;
        let sides =
            places.iter().enumerate().map(|(number, to)| (places[(number + places.len() - 1) % places.len()], *to));
        let met = sides.filter(|(from, to)| (from.y > height) != (to.y > height));
        let met = met.map(|(from, to)| from.x + (to.x - from.x) * ((height - from.y) / (to.y - from.y)));
        let (left, right) = met.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)));
        let [first, end] = centres(left, right);
        if first <= end {
            return true;
        }
        row += 1.0;
    }
    false
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::camera::CameraSettings;
    use crate::mesh::Mesh;
    use crate::scene::SceneSettings;
    use std::sync::Arc;

    fn unseen(camera: CameraSettings, side: u32) -> Option<UnseenReason> {
        let size = Size { width: side, height: side };
        let scene = Scene::new(vec![Arc::new(Mesh::triangle())], &SceneSettings { camera, size, ..Default::default() });
        let scene = scene.unwrap();
        scene.unseen(scene.size, true)
    }

    fn looking(eye: DVec3, target: DVec3) -> CameraSettings {
        CameraSettings { eye: Some(eye), target: Some(target), ..CameraSettings::default() }
    }

    #[test]
    fn each_way_out_of_the_picture_has_its_name() {
        let front = DVec3::new(0.3, 0.3, 5.0);
        let middle = DVec3::new(0.3, 0.3, 0.0);
        for parallel in [false, true] {
            let looking = |eye, target| CameraSettings { parallel, ..looking(eye, target) };
            assert_eq!(unseen(looking(front, middle), 64), None);
            assert_eq!(unseen(looking(front, DVec3::new(0.3, 0.3, 9.0)), 64), Some(UnseenReason::Behind));
            let planes = |near, far| CameraSettings { near: Some(near), far: Some(far), ..looking(front, middle) };
            assert_eq!(unseen(planes(5.5, 9.0), 64), Some(UnseenReason::CutOff));
            assert_eq!(unseen(planes(1.0, 4.5), 64), Some(UnseenReason::CutOff));
            assert_eq!(unseen(planes(4.0, 6.0), 64), None);
            assert_eq!(unseen(looking(DVec3::new(0.3, 0.3, -5.0), middle), 64), Some(UnseenReason::TurnedAway));
        }
        // In parallel projection the fitted height shows the model wherever it is.
        assert_eq!(unseen(looking(front, DVec3::new(30.0, 0.3, 0.0)), 64), Some(UnseenReason::Beside));
        // From aside: planes fitted to a face across the view are too close for f32.
        let far_off = looking(DVec3::new(300.0, 0.3, 850.0), middle);
        assert_eq!(unseen(far_off.clone(), 64), Some(UnseenReason::BetweenPixels));
        assert_eq!(unseen(CameraSettings { fov_y_degrees: 0.1, ..far_off }, 64), None);
    }

    #[test]
    fn planes_in_the_hollow_of_a_face_that_passes_through_both_see_it_and_beside_it_do_not() {
        // From the side the triangle runs through both planes; only its middle is between them.
        let camera = |near| CameraSettings {
            near: Some(near),
            far: Some(near + 0.1),
            ..looking(DVec3::new(-4.0, 0.2, 0.5), DVec3::new(0.3, 0.2, 0.0))
        };
        assert_eq!(unseen(CameraSettings { near: Some(2.0), far: Some(9.0), ..camera(2.0) }, 64), None);
        assert_eq!(unseen(camera(4.3), 512), None);
        assert_eq!(unseen(camera(2.0), 512), Some(UnseenReason::CutOff));
    }

    #[test]
    fn a_polygon_covers_a_centre_where_one_lies_well_inside() {
        let square = |low: f64, high: f64| [[low, low], [high, low], [high, high], [low, high]].map(DVec2::from_array);
        assert!(covers_a_centre(&square(7.2, 7.8)) && !covers_a_centre(&square(7.6, 8.4)));
        assert!(!covers_a_centre(&square(7.49, 7.51)), "perhaps, but not surely");
        let needle = [[0.0, 0.0], [90.0, 30.3], [90.0, 31.4]].map(DVec2::from_array);
        assert!(covers_a_centre(&needle));
        assert!(!covers_a_centre(&[]));
    }
}
