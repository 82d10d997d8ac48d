//! Conversion from world space to the eye's space and the picture, in f64.
//!
//! The eye's space has its origin at the eye and looks along -z, in file units. Points far from the world's origin lose no more
//! precision there. In the picture a point has pixels and a *key*. The key is linear along straight lines of the picture and
//! grows with the distance from the eye. In perspective it is the inverse of the depth, negative; in parallel projection, the
//! depth itself. Straight lines and flat triangles stay straight and flat in these three coordinates.

use crate::camera::Projection;
use crate::scene::Scene;
use crate::tolerances::{COORDINATE_NOISE, EDGE_ON};
use glam::{DMat3, DVec2, DVec3};
use robust::{Coord, Coord3D, orient2d, orient3d};

/// The eye's place and direction, and the projection into the picture.
#[derive(Debug, Clone)]
pub(in crate::lines) struct Space {
    rotation: DMat3,
    eye: DVec3,
    lens: Lens,
    /// Pixels.
    pub size: DVec2,
    /// Depths of the planes between which lines are drawn, file units.
    pub near: f64,
    pub far: f64,
    /// How far rounding of the world's own numbers may move a coordinate, file units.
    pub noise: f64,
    /// What a lift of 1 moves points towards the eye by: a scene radius in parallel projection, a share of their depth in
    /// perspective.
    lift: f64,
    /// Sine of the angle to the view below which a face is edge-on: far from the origin rounding turns the view, too.
    pub edge_on: f64,
}

#[derive(Debug, Clone, Copy)]
enum Lens {
    /// Pixels per unit at depth 1; the factor from the inverse of a depth to a key.
    Perspective {
        focal_px: f64,
        key_scale: f64,
    },
    Parallel {
        px_per_unit: f64,
    },
}

impl Space {
    pub(in crate::lines) fn of(scene: &Scene) -> Self {
        let camera = &scene.camera;
        let size = DVec2::new(f64::from(scene.size.width), f64::from(scene.size.height));
        let lens = match camera.projection {
            Projection::Perspective { fov_y_degrees } => {
                let focal_px = size.y * 0.5 / (fov_y_degrees.to_radians() * 0.5).tan();
                let distance = (camera.eye - scene.centre).length().max(camera.near);
                // In a scene's middle the key then grows as fast as pixels do.
                Lens::Perspective { focal_px, key_scale: -focal_px * distance }
            }
            Projection::Parallel { height } => Lens::Parallel { px_per_unit: size.y / height },
        };
        let lift = match lens {
            Lens::Perspective { .. } => scene.radius / (camera.eye - scene.centre).length().max(scene.radius),
            Lens::Parallel { .. } => scene.radius,
        };
        let reach = scene.centre.abs().max_element() + scene.radius;
        let noise = COORDINATE_NOISE * reach.max(camera.eye.abs().max_element());
        Self {
            rotation: DMat3::from_mat4(camera.view_from_world()),
            eye: camera.eye,
            lens,
            size,
            near: camera.near,
            far: camera.far,
            noise,
            lift,
            edge_on: EDGE_ON + noise / camera.eye.distance(camera.target),
        }
    }

    /// A point of the world in the eye's space.
    pub(in crate::lines) fn view(&self, world: DVec3) -> DVec3 {
        self.rotation * (world - self.eye)
    }

    /// A point of the eye's space in the world.
    pub(in crate::lines) fn world(&self, view: DVec3) -> DVec3 {
        self.rotation.transpose() * view + self.eye
    }

    /// A point moved towards the eye by a share of the scene's radius: in perspective by so much at the depth of the scene's
    /// centre, and in proportion at others. Its image stays, and straight lines stay straight.
    pub(in crate::lines) fn lifted(&self, view: DVec3, share: f64) -> DVec3 {
        match self.lens {
            Lens::Perspective { .. } => view * (1.0 - share * self.lift),
            Lens::Parallel { .. } => view + DVec3::Z * (share * self.lift),
        }
    }

    /// The point that [`Space::lifted`] moved here.
    pub(in crate::lines) fn lowered(&self, view: DVec3, share: f64) -> DVec3 {
        match self.lens {
            Lens::Perspective { .. } => view / (1.0 - share * self.lift),
            Lens::Parallel { .. } => view - DVec3::Z * (share * self.lift),
        }
    }

    /// A direction of the world in the eye's space.
    pub(in crate::lines) fn direction(&self, world: DVec3) -> DVec3 {
        self.rotation * world
    }

    /// A direction of the eye's space in the world.
    pub(in crate::lines) fn world_direction(&self, view: DVec3) -> DVec3 {
        self.rotation.transpose() * view
    }

    /// The direction of a point's image as the point moves in a direction, of any length.
    pub(in crate::lines) fn image_direction(&self, view: DVec3, direction: DVec3) -> DVec2 {
        let flipped = DVec2::new(direction.x, -direction.y);
        match self.lens {
            Lens::Perspective { .. } => flipped - DVec2::new(view.x, -view.y) * (direction.z / view.z),
            Lens::Parallel { .. } => flipped,
        }
    }

    /// A point in front of the eye in the picture: pixels from the upper left, y down, and its key.
    pub(in crate::lines) fn project(&self, view: DVec3) -> (DVec2, f64) {
        let flipped = DVec2::new(view.x, -view.y);
        match self.lens {
            Lens::Perspective { focal_px, key_scale } => {
                let inverse = -1.0 / view.z;
                (self.size * 0.5 + flipped * (focal_px * inverse), key_scale * inverse)
            }
            Lens::Parallel { px_per_unit } => (self.size * 0.5 + flipped * px_per_unit, -view.z * px_per_unit),
        }
    }

    /// The point of the eye's space that is drawn at a pixel with a key.
    pub(in crate::lines) fn point(&self, px: DVec2, key: f64) -> DVec3 {
        let centred = px - self.size * 0.5;
        let depth = self.depth_of_key(key);
        let flat = match self.lens {
            Lens::Perspective { focal_px, .. } => centred * (depth / focal_px),
            Lens::Parallel { px_per_unit } => centred / px_per_unit,
        };
        DVec3::new(flat.x, -flat.y, -depth)
    }

    pub(in crate::lines) fn depth_of_key(&self, key: f64) -> f64 {
        match self.lens {
            Lens::Perspective { key_scale, .. } => key_scale / key,
            Lens::Parallel { px_per_unit } => key / px_per_unit,
        }
    }

    /// Returns how far a key at one pixel must exceed a plane's key for the point to lie this distance behind the plane. The
    /// plane goes through a point and has a unit normal; its depths are no smaller than `nearest`.
    pub(in crate::lines) fn key_beyond(&self, [point, normal]: [DVec3; 2], nearest: f64, distance: f64) -> f64 {
        match self.lens {
            Lens::Perspective { key_scale, .. } => distance * key_scale.abs() / (nearest * normal.dot(point).abs()),
            Lens::Parallel { px_per_unit } => distance * px_per_unit / normal.z.abs(),
        }
    }

    /// How much larger a key must be than one at this depth for the point to be so much farther away, or less.
    pub(in crate::lines) fn key_step(&self, depth: f64, distance: f64) -> f64 {
        match self.lens {
            Lens::Perspective { key_scale, .. } => distance * key_scale.abs() / (depth * depth),
            Lens::Parallel { px_per_unit } => distance * px_per_unit,
        }
    }

    /// Two points of the line of sight through a pixel: the eye, or a point before the scene, and one on the near plane.
    pub(in crate::lines) fn ray(&self, px: DVec2) -> [DVec3; 2] {
        let centred = px - self.size * 0.5;
        match self.lens {
            Lens::Perspective { focal_px, .. } => {
                let flat = centred * (self.near / focal_px);
                [DVec3::ZERO, DVec3::new(flat.x, -flat.y, -self.near)]
            }
            Lens::Parallel { px_per_unit } => {
                let flat = centred / px_per_unit;
                [DVec3::new(flat.x, -flat.y, 0.0), DVec3::new(flat.x, -flat.y, -self.far)]
            }
        }
    }

    /// Pixels that a length across the view covers at a depth.
    pub(in crate::lines) fn px_per_unit(&self, depth: f64) -> f64 {
        match self.lens {
            Lens::Perspective { focal_px, .. } => focal_px / depth,
            Lens::Parallel { px_per_unit } => px_per_unit,
        }
    }

    /// Positive where the image of `point` lies left of the line from `from` to `to`, seen by the eye with y up, negative
    /// right of it, 0 on it: exact for these coordinates. Divided by the second number it is the distance of the point from
    /// the plane through the eye and the line, file units.
    pub(in crate::lines) fn turn(&self, from: DVec3, to: DVec3, point: DVec3) -> (f64, f64) {
        match self.lens {
            Lens::Perspective { .. } => {
                let plane = to.cross(from);
                let value = point.dot(plane);
                // Six roundings on the longest way; |point||from||to| bounds every product.
                let bound = point.length() * from.length() * to.length() * (8.0 * f64::EPSILON);
                let exact = || {
                    let [a, b, c, eye] = [to, from, point, DVec3::ZERO].map(|DVec3 { x, y, z }| Coord3D { x, y, z });
                    // orient3d(a, b, c, 0) is the determinant of a, b, c.
                    orient3d(a, b, c, eye)
                };
                (if value.abs() > bound { value } else { exact() }, plane.length())
            }
            Lens::Parallel { .. } => {
                let [a, b, c] = [from, to, point].map(|DVec3 { x, y, .. }| Coord { x, y });
                (orient2d(a, b, c), (to - from).truncate().length())
            }
        }
    }

    /// How much [`Space::turn`] grows where the point moves by a vector parallel to the picture.
    pub(in crate::lines) fn turn_aside(&self, from: DVec3, to: DVec3, aside: DVec3) -> f64 {
        match self.lens {
            Lens::Perspective { .. } => aside.dot(to.cross(from)),
            Lens::Parallel { .. } => (to - from).truncate().perp_dot(aside.truncate()),
        }
    }

    /// Whether lines of sight meet in the eye.
    pub(in crate::lines) fn is_perspective(&self) -> bool {
        matches!(self.lens, Lens::Perspective { .. })
    }

    /// The direction from a point to the eye, of any length.
    pub(in crate::lines) fn to_eye(&self, view: DVec3) -> DVec3 {
        match self.lens {
            Lens::Perspective { .. } => -view,
            Lens::Parallel { .. } => DVec3::Z,
        }
    }
}

/// Returns the point where the line between two points of the eye's space passes the plane across the view at a depth, if it does.
pub(in crate::lines) fn at_depth([a, b]: [DVec3; 2], depth: f64) -> Option<DVec3> {
    let (above, below) = (-a.z - depth, -b.z - depth);
    let point = || (a + (b - a) * (above / (above - below))).with_z(-depth);
    ((above >= 0.0) != (below >= 0.0)).then(point)
}
