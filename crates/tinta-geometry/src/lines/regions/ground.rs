//! The shadow that a scene casts on the ground: the horizontal plane below its lowest point, y up.
//!
//! Seen along the rays of a far light, a scene's shadow is its outline. So the outline is cut exactly in a view along the light, its
//! corners are moved along the light to the ground, and from there into the picture. A projection by a straight light maps straight
//! lines to straight lines: nothing is lost on the way.

use super::cut::cut;
use super::region::{Region, Regions};
use super::view::View;
use crate::camera::{self, CameraSettings, Framing};
use crate::error::Result;
use crate::lines::eye::space::Space;
use crate::lines::progress::Progress;
use crate::lines::sight::Sight;
use crate::memory::AREAS;
use crate::mesh::double_area;
use crate::scene::{Scene, SceneSettings, Size};
use glam::{DVec2, DVec3};

/// How high the light of a shadow stands, degrees. A lower one makes longer shadows, which shrink the model in its picture.
const HEIGHT_DEGREES: f64 = 62.0;

/// Share of the light's depth that turns the shadow backwards; the rest of it falls to the side, where it is seen.
const DEPTH_SHARE: f64 = 0.6;

/// The least part of a shadow that lies apart, as a share of the largest one: what single curls and spikes cast reads as dirt.
const LEAST_PART: f64 = 0.005;

/// Side of the picture in which the light sees the scene, pixels; regions are exact to a small part of one.
const LIGHT_PX: u32 = 1024;

/// The direction towards the light of a scene's shadow, world space: from the side of a far light of tones, which is given in the eye's
/// space, but always high.
pub fn ground_light(scene: &Scene, towards: [f32; 3]) -> DVec3 {
    let [x, _, z] = towards.map(f64::from);
    let world = Space::of(scene).world_direction(DVec3::new(x, 0.0, z.abs() * DEPTH_SHARE));
    let level = DVec3::new(world.x, 0.0, world.z).normalize_or(DVec3::NEG_X);
    let (sin, cos) = HEIGHT_DEGREES.to_radians().sin_cos();
    level * cos + DVec3::Y * sin
}

/// Returns the shadow of a scene in its picture without its specks, by a light in this direction, world space; nothing where the ground
/// is seen from below. Areas run beyond the picture.
///
/// # Errors
///
/// Those of [`Regions::with_progress`] and [`Scene::seen_with`].
pub fn ground_shadow(scene: &Scene, light: DVec3, progress: &Progress) -> Result<Regions<()>> {
    let ground = scene.lowest();
    let space = Space::of(scene);
    let mut shadow = Regions { size: scene.size, regions: Vec::new(), broken: 0 };
    if space.to_eye(space.view(DVec3::new(scene.centre.x, ground, scene.centre.z))).dot(space.direction(DVec3::Y))
        <= 0.0
    {
        return Ok(shadow);
    }
    let [azimuth_degrees, elevation_degrees] = [light.x.atan2(light.z), light.y.asin()].map(f64::to_degrees);
    let from_light = camera::View { azimuth_degrees, elevation_degrees };
    let camera =
        CameraSettings { view: from_light, parallel: true, framing: Framing::Middle, ..CameraSettings::default() };
    let size = Size { width: LIGHT_PX, height: LIGHT_PX };
    let lit = scene.seen_with(&SceneSettings { camera, size, ..SceneSettings::default() })?;
    let sight = Sight::of(&lit);
    let view = View::of(&sight, AREAS, progress)?;
    let borders = view.borders([], |_| false, progress)?;
    let outline = cut(&view, borders, |px| view.first_hit(px).map(|_| ()), progress)?;
    let of_light = Space::of(&lit);
    let on_ground = |px: &DVec2| {
        let [from, _] = of_light.ray(*px);
        let world = of_light.world(from);
        space.view(world - light * ((world.y - ground) / light.y))
    };
    let ring = |corners: &Vec<DVec2>| {
        let corners: Vec<DVec3> = corners.iter().map(on_ground).collect();
        let seen = before(&corners, space.near);
        seen.into_iter().map(|view| space.project(view).0).collect::<Vec<_>>()
    };
    for Region { loops, .. } in outline.regions.iter().filter(|region| region.seen.is_some()) {
        let loops: Vec<Vec<DVec2>> = loops.iter().map(ring).filter(|corners| corners.len() > 2).collect();
        let area_px = loops.iter().map(|corners| double_area(corners)).sum::<f64>().abs() * 0.5;
        shadow.regions.push(Region { seen: (), loops, area_px });
    }
    let largest = shadow.regions.iter().map(|part| part.area_px).fold(0.0, f64::max);
    shadow.regions.retain(|part| part.area_px >= LEAST_PART * largest);
    Ok(shadow)
}

/// The part of a polygon that lies farther from the eye than the near plane.
fn before(corners: &[DVec3], near: f64) -> Vec<DVec3> {
    let mut kept = Vec::with_capacity(corners.len());
    for (from, to) in corners.iter().zip(corners.iter().cycle().skip(1)) {
        let [from_depth, to_depth] = [from, to].map(|corner| -corner.z - near);
        if from_depth >= 0.0 {
            kept.push(*from);
        }
        if (from_depth >= 0.0) != (to_depth >= 0.0) {
            kept.push(from.lerp(*to, from_depth / (from_depth - to_depth)));
        }
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::{LoadOptions, Mesh, load};

    fn scene(camera: CameraSettings) -> Scene {
        let mesh = load("../../models/open-box.obj", &LoadOptions::default()).unwrap().mesh;
        let size = Size { width: 400, height: 400 };
        Scene::new([mesh], &SceneSettings { camera, size, ..SceneSettings::default() }).unwrap()
    }

    #[test]
    fn a_boxs_shadow_has_the_area_of_its_base_and_of_its_sides_moved_along_the_light() {
        let from_above = CameraSettings {
            view: "top".parse().unwrap(),
            parallel: true,
            height: Some(10.0),
            ..CameraSettings::default()
        };
        let scene = scene(from_above);
        let mesh = &scene.objects[0].mesh;
        let (low, high) = mesh.extent();
        let side = high - low;
        for light in [DVec3::Y, DVec3::new(0.3, 1.0, 0.0), DVec3::new(-0.4, 0.9, 0.2)] {
            let light = light.normalize();
            let shadow = ground_shadow(&scene, light, &Progress::default()).unwrap();
            let moved = side.y / light.y * light.abs();
            let area = side.x * side.z + side.x * moved.z + side.z * moved.x;
            let found: f64 = shadow.regions.iter().map(|region| region.area_px).sum();
            let px_per_unit = 400.0 / 10.0;
            assert!((found / (area * px_per_unit * px_per_unit) - 1.0).abs() < 1e-4, "{light}: {found} {area}");
        }
    }

    /// Whether a ray from a point meets a face.
    fn meets(mesh: &Mesh, from: DVec3, along: DVec3) -> bool {
        mesh.triangles.iter().any(|corners| {
            let [a, b, c] = corners.map(|corner| mesh.positions[corner as usize] - from);
            let sides = [a.cross(b), b.cross(c), c.cross(a)].map(|normal| normal.dot(along));
            let distance = (b - a).cross(c - a).dot(a) / (b - a).cross(c - a).dot(along);
            distance > 0.0 && (sides.iter().all(|side| *side > 0.0) || sides.iter().all(|side| *side < 0.0))
        })
    }

    #[test]
    fn the_ground_is_dark_where_a_ray_to_the_light_meets_a_face() {
        let mut state = 7_u64;
        let mut number = || {
            state ^= state << 13;
            state ^= state >> 7;
            state ^= state << 17;
            state as f64 / u64::MAX as f64 * 2.0 - 1.0
        };
        let (mut dark, mut wrong, mut asked) = (0, 0, 0);
        for _ in 0..60 {
            // Tetrahedra around one place, which pass through one another: their shadow is one area.
            let mut positions = Vec::new();
            for _ in 0..8 {
                let [a, b, c] = [0; 3].map(|_| DVec3::new(number(), number(), number()));
                positions.extend([a, b, c, (a + b + c) * -0.6]);
            }
            let faces = |first: u32| [[0, 1, 2], [0, 2, 3], [0, 3, 1], [1, 3, 2]].map(|face| face.map(|at| first + at));
            let triangles: Vec<[u32; 3]> = (0..8).flat_map(|solid| faces(4 * solid)).collect();
            let mesh = Mesh::of_triangles("solids", positions, &triangles, &LoadOptions::default()).unwrap();
            let camera = CameraSettings { view: "top".parse().unwrap(), parallel: true, ..CameraSettings::default() };
            let size = Size { width: 300, height: 300 };
            let scene = Scene::new([mesh], &SceneSettings { camera, size, ..SceneSettings::default() }).unwrap();
            let light = DVec3::new(number(), 1.5, number()).normalize();
            let shadow = ground_shadow(&scene, light, &Progress::default()).unwrap();
            let (space, mesh, ground) = (Space::of(&scene), &scene.objects[0].mesh, scene.lowest());
            for _ in 0..200 {
                let px = DVec2::new(number(), number()) * 150.0 + 150.0;
                let sides = |ring: &Vec<DVec2>| {
                    let ends = ring.iter().zip(ring.iter().cycle().skip(1));
                    ends.filter(|(a, b)| {
                        (a.y > px.y) != (b.y > px.y) && px.x < a.x + (b.x - a.x) * (px.y - a.y) / (b.y - a.y)
                    })
                    .count()
                };
                let is_dark = shadow.regions.iter().flat_map(|region| &region.loops).map(sides).sum::<usize>() % 2 == 1;
                let lies = |px: DVec2| {
                    let world = space.world(space.ray(px)[0]);
                    meets(mesh, DVec3::new(world.x, ground, world.z), light)
                };
                // Places at the shadow's border are left out.
                let around =
                    [[0.02, 0.0], [-0.02, 0.0], [0.0, 0.02], [0.0, -0.02]].map(|step| lies(px + DVec2::from(step)));
                if around == [around[0]; 4] {
                    asked += 1;
                    dark += usize::from(is_dark);
                    wrong += usize::from(is_dark != around[0]);
                }
            }
        }
        assert!(asked > 11_000 && dark > 2_000, "{asked} {dark}");
        assert_eq!(wrong, 0, "of {asked}, {dark} dark");
    }

    #[test]
    fn ground_seen_from_below_has_no_shadow_and_the_light_stands_high_on_its_side() {
        let below = scene(CameraSettings { view: "30,-20".parse().unwrap(), ..CameraSettings::default() });
        assert!(ground_shadow(&below, DVec3::Y, &Progress::default()).unwrap().regions.is_empty());
        let above = scene(CameraSettings { view: "front".parse().unwrap(), ..CameraSettings::default() });
        let [left, right] = [-0.5, 0.5].map(|x| ground_light(&above, [x, 0.3, 0.5]));
        assert!(left.x < 0.0 && right.x > 0.0 && left.y > 0.8 && left.z > 0.0, "{left} {right}");
        assert!((left.length() - 1.0).abs() < 1e-12);
    }
}
