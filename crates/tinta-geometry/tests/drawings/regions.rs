//! Tests exact regions with rays: the region of a pixel's middle has the face that a ray hits there. The regions fill the picture
//! without gaps and overlaps.

mod hatching;

use crate::support::families::{KINDS, scene_of_kind};
use crate::support::growth::FAMILIES;
use crate::support::lines::{explicit, scene_of_family, scenes_wanted, view};
use crate::support::shapes::{Random, cuboid, icosphere, joined, mesh};
use crate::support::{PUBLIC_MODELS, public_meshes};
use glam::{DVec2, DVec3};
use std::collections::BTreeSet;
use std::time::Duration;
use tinta::camera::Projection;
use tinta::lines::{
    Areas, Hit, JoinKey, Progress, Region, Regions, SeenFace, Sight, Surface, ToneLight, ToneRule, TonedSurface, fills,
    first_hits, painted, svg_of_paths,
};
use tinta::mesh::NONE;
use tinta::tolerances::{CONTACT, WELD};
use tinta::{CameraSettings, Color, DrawingSettings, Error, LoadOptions, Scene, SceneSettings, Size, VisibleLines};

/// Distance of a pixel's middle from a border below which either side is right, pixels.
const NEAR_BORDER_PX: f64 = 0.01;

#[derive(Debug, Default)]
struct RegionTally {
    pixels: usize,
    near_borders: usize,
    /// Regions whose rings touch one another.
    touching: usize,
    wrong: usize,
    example: String,
}

/// Compares the regions of all pixels with rays. Panics where the regions do not fill the picture exactly once.
fn check(name: &str, scene: &Scene) -> RegionTally {
    let seen = |hit: Hit| SeenFace { object: hit.object, face: hit.face };
    check_labels(name, scene, &Regions::of(scene).unwrap(), seen, |hit, label| touches(scene, world(scene, hit), label))
}

/// Compares the labels of all pixels with those of rays. `is_as_right` says whether another label will do.
fn check_labels<T: Copy + PartialEq + std::fmt::Debug>(
    name: &str,
    scene: &Scene,
    found: &Regions<Option<T>>,
    label: impl Fn(Hit) -> T,
    is_as_right: impl Fn(&Hit, T) -> bool,
) -> RegionTally {
    assert_eq!(found.broken, 0, "{name}");
    let size = [scene.size.width as usize, scene.size.height as usize];
    let whole = (size[0] * size[1]) as f64;
    let sum: f64 = found.regions.iter().map(|region| region.area_px).sum();
    assert!((sum - whole).abs() <= 1e-9 * whole, "{name}: {sum} of {whole}");
    let by_corners: f64 = found.regions.iter().flat_map(|region| &region.loops).map(|corners| area(corners)).sum();
    assert!((by_corners.abs() - whole).abs() <= 1e-9 * whole, "{name}: {by_corners} of {whole}");
    let touching = found.regions.iter().filter(|region| has_valid_rings(region, name)).count();
    let mut region_of = vec![usize::MAX; size[0] * size[1]];
    for (number, region) in found.regions.iter().enumerate() {
        fill(region, size, |pixel| {
            assert_eq!(region_of[pixel], usize::MAX, "{name}: two regions at {pixel}");
            region_of[pixel] = number;
        });
    }
    let mut checked = RegionTally { pixels: region_of.len(), touching, ..RegionTally::default() };
    for (pixel, (number, hit)) in region_of.into_iter().zip(first_hits(scene)).enumerate() {
        assert_ne!(number, usize::MAX, "{name}: no region at {pixel}");
        let seen = found.regions[number].seen;
        let of_ray = hit.map(&label);
        let px = DVec2::new((pixel % size[0]) as f64 + 0.5, (pixel / size[0]) as f64 + 0.5);
        if seen == of_ray || hit.zip(seen).is_some_and(|(hit, seen)| is_as_right(&hit, seen)) {
            continue;
        }
        let is_near = |region: &Region<Option<T>>| region.loops.iter().any(|it| distance(it, px) < NEAR_BORDER_PX);
        if found.regions.iter().any(is_near) {
            checked.near_borders += 1;
        } else {
            checked.wrong += 1;
            checked.example = format!("{name} at {px}: {seen:?} instead of {of_ray:?}");
        }
    }
    checked
}

fn corners(scene: &Scene, seen: SeenFace) -> [DVec3; 3] {
    let object = &scene.objects[seen.object as usize];
    object.mesh.triangles[seen.face as usize].map(|corner| object.mesh.positions[corner as usize] + object.offset)
}

fn world(scene: &Scene, hit: &Hit) -> DVec3 {
    let [a, b, c] = corners(scene, SeenFace { object: hit.object, face: hit.face });
    a * hit.weights[0] + b * hit.weights[1] + c * hit.weights[2]
}

/// Whether a face is at a point of another: the two coincide there, and the lower number counts.
fn touches(scene: &Scene, point: DVec3, seen: SeenFace) -> bool {
    let [a, b, c] = corners(scene, seen);
    let normal = (b - a).cross(c - a).normalize_or_zero();
    let longest = a.distance(b).max(b.distance(c)).max(c.distance(a));
    let (low, high) = scene.objects[seen.object as usize].mesh.bounds();
    let toward = match scene.camera.projection {
        Projection::Parallel { .. } => scene.camera.backward(),
        Projection::Perspective { .. } => (scene.camera.eye - point).normalize(),
    };
    let distance = normal.dot(point - a);
    // Along the ray, where the ray meets the face's plane.
    let on_plane = point - toward * (distance / normal.dot(toward));
    let inside = [[a, b], [b, c], [c, a]].into_iter().all(|[from, to]| {
        let inward = normal.cross(to - from).normalize_or_zero();
        inward.dot(on_plane - from) >= -1e-6 * longest
    });
    distance.abs() <= 2.0 * (CONTACT * longest + WELD * low.distance(high)) && inside
}

/// Asserts that a region's rings are simple and the first one is its outline, as OGC's polygons are; returns whether rings touch.
fn has_valid_rings<T>(region: &Region<T>, name: &str) -> bool {
    let bits = |point: &DVec2| point.to_array().map(f64::to_bits);
    let mut corners = BTreeSet::new();
    for (number, ring) in region.loops.iter().enumerate() {
        let own: BTreeSet<[u64; 2]> = ring.iter().map(bits).collect();
        assert_eq!(own.len(), ring.len(), "{name}: a ring meets a corner twice: {ring:?}");
        assert_eq!((area(ring) > 0.0) == (area(&region.loops[0]) > 0.0), number == 0, "{name}: {:?}", region.loops);
        corners.extend(own);
    }
    corners.len() < region.loops.iter().map(Vec::len).sum()
}

/// The signed area of a polygon.
fn area(corners: &[DVec2]) -> f64 {
    let next = corners.iter().cycle().skip(1);
    corners.iter().zip(next).map(|(a, b)| a.perp_dot(*b)).sum::<f64>() * 0.5
}

/// Calls `at` with each pixel whose middle lies in a region.
fn fill<T>(region: &Region<T>, [width, height]: [usize; 2], mut at: impl FnMut(usize)) {
    let all = || region.loops.iter().flatten();
    let low = all().map(|point| point.y).fold(f64::INFINITY, f64::min);
    let high = all().map(|point| point.y).fold(f64::NEG_INFINITY, f64::max);
    for row in low.floor() as usize..(high.ceil() as usize).min(height) {
        let y = row as f64 + 0.5;
        let mut places: Vec<f64> = Vec::new();
        for corners in &region.loops {
            for (a, b) in corners.iter().zip(corners.iter().cycle().skip(1)) {
                if (a.y > y) != (b.y > y) {
                    // The same for both neighbours.
                    let (a, b) = if a.y < b.y { (a, b) } else { (b, a) };
                    places.push(a.x + (b.x - a.x) * ((y - a.y) / (b.y - a.y)));
                }
            }
        }
        places.sort_unstable_by(f64::total_cmp);
        for pair in places.chunks_exact(2) {
            let columns = (pair[0] - 0.5).ceil() as usize..((pair[1] - 0.5).ceil() as usize).min(width);
            columns.for_each(|column| at(row * width + column));
        }
    }
}

/// The distance of a point from a closed polygon's sides.
fn distance(corners: &[DVec2], px: DVec2) -> f64 {
    let of_side = |(a, b): (&DVec2, &DVec2)| crate::support::lines::distance(px, [*a, *b]);
    corners.iter().zip(corners.iter().cycle().skip(1)).map(of_side).fold(f64::INFINITY, f64::min)
}

fn check_families(count: u64) {
    let mut all = RegionTally::default();
    for seed in 1..=count {
        let mut random = Random::seeded(seed);
        let (name, scene) = scene_of_kind(seed as usize, &mut random);
        add(&mut all, check(&format!("{name}, seed {seed}"), &scene));
    }
    judge(&all);
}

fn add(all: &mut RegionTally, one: RegionTally) {
    all.pixels += one.pixels;
    all.near_borders += one.near_borders;
    all.wrong += one.wrong;
    all.touching += one.touching;
    if one.wrong > 0 {
        println!("{} wrong, {}", one.wrong, one.example);
        all.example = one.example;
    }
}

fn judge(all: &RegionTally) {
    println!("{} pixels, {} near borders differ, {} wrong {}", all.pixels, all.near_borders, all.wrong, all.example);
    assert!(all.pixels > 0 && all.wrong as f64 <= 1e-5 * all.pixels as f64, "{all:?}");
}

#[test]
fn regions_of_every_family_are_the_faces_that_rays_hit_briefly() {
    check_families(KINDS as u64);
}

#[test]
#[ignore = "exhaustive: 10 scenes of each family, or as many scenes as TINTA_LINE_SCENES says"]
fn regions_of_many_scenes_are_the_faces_that_rays_hit() {
    check_families(scenes_wanted().unwrap_or(10 * KINDS as u64));
}

/// Scenes with far more crossing borders than visible ones. The faces of twins nearly touch in wide zones, where one place does not tell
/// what is seen in a whole cell.
#[test]
fn regions_of_crowded_families_are_the_faces_that_rays_hit() {
    let mut all = RegionTally::default();
    for family in FAMILIES.iter().filter(|family| family.name != "twins") {
        let count = if family.name == "soup" { 1_000 } else { 300 };
        let scene = scene_of_family(family, count);
        let (camera, size) = (explicit(&scene), Size { width: 160, height: 120 });
        let small = scene.seen_with(&SceneSettings { camera, size, ..SceneSettings::default() }).unwrap();
        add(&mut all, check(family.name, &small));
    }
    judge(&all);
}

fn check_models(names: &[&str], views: &[CameraSettings]) {
    let models = public_meshes(names);
    let mut all = RegionTally::default();
    for (name, mesh) in &models {
        for camera in views {
            let settings = SceneSettings { camera: camera.clone(), ..SceneSettings::default() };
            let scene = Scene::new([mesh.clone()], &settings).unwrap();
            add(&mut all, check(&format!("{name} from {:?}", camera.view), &scene));
        }
    }
    if !models.is_empty() {
        judge(&all);
    }
}

#[test]
fn regions_of_public_models_are_the_faces_that_rays_hit_briefly() {
    check_models(&["cow.obj", "teapot.obj", "suzanne.obj"], &[view("30,23", false), view("front", true)]);
}

#[test]
#[ignore = "exhaustive: all public models from 6 sides, with TINTA_FULL_SIZES from 26"]
fn regions_of_all_public_models_are_the_faces_that_rays_hit() {
    let names = [&PUBLIC_MODELS[..], &["doll.obj"]].concat();
    let mut views = vec![view("0,90", false), view("0,-90", false)];
    for height in [-45, 0, 45] {
        views.extend((0..8).map(|turn| view(&format!("{},{height}", turn * 45), turn % 2 == 1)));
    }
    if std::env::var_os("TINTA_FULL_SIZES").is_none() {
        views = views.into_iter().step_by(5).collect();
    }
    check_models(&names, &views);
}

/// The tone at a ray's hit, by the listing's formulas with matrices of the world.
fn tone(scene: &Scene, rule: &ToneRule, hit: &Hit) -> u8 {
    let view = scene.camera.view_from_world();
    let object = &scene.objects[hit.object as usize];
    let mesh = &object.mesh;
    let (mut diffuse, mut mirrored, mut to_eye) = (0.0, DVec3::ZERO, DVec3::ZERO);
    let mut points = Vec::new();
    for corner in 0..3 {
        let position = mesh.positions[mesh.triangles[hit.face as usize][corner] as usize] + object.offset;
        let normal = mesh.normals[mesh.triangle_normals[hit.face as usize][corner] as usize].as_dvec3();
        let point = view.transform_point3(position) / scene.radius;
        points.push(point);
        if let ToneLight::Far(light) = rule.light {
            diffuse += hit.weights[corner] * light.dot(view.transform_vector3(normal));
            continue;
        }
        let ToneLight::Near(light) = rule.light else { continue };
        let (light, eye) = ((light - point).normalize(), -point.normalize());
        let normal = view.transform_vector3(normal).normalize();
        diffuse += hit.weights[corner] * (light.dot(normal) + 1.0) * 0.5;
        // GLSL's reflect(-light, normal).
        mirrored += hit.weights[corner] * (-light - 2.0 * normal.dot(-light) * normal);
        to_eye += hit.weights[corner] * eye;
    }
    if matches!(rule.light, ToneLight::Far(_)) {
        let to_eye = match scene.camera.projection {
            Projection::Parallel { .. } => DVec3::Z,
            Projection::Perspective { .. } => -points[0],
        };
        let is_front = (points[1] - points[0]).cross(points[2] - points[0]).dot(to_eye) > 0.0;
        let light = if is_front { diffuse } else { -diffuse };
        return rule.thresholds.iter().map(|threshold| u8::from(light >= *threshold)).sum();
    }
    let specular = mirrored.normalize().dot(to_eye.normalize());
    if specular > rule.thresholds[1] { 2 } else { u8::from(diffuse >= rule.thresholds[0]) }
}

/// The published rule, that of the look `print`, and one with two tones.
fn rules() -> [ToneRule; 3] {
    [
        ToneRule { light: ToneLight::Near(DVec3::ONE), thresholds: [0.8, 0.65] },
        ToneRule { light: ToneLight::Far(DVec3::new(-0.4, 1.0, 0.6).normalize()), thresholds: [0.2, 0.56] },
        ToneRule { light: ToneLight::Near(DVec3::ONE), thresholds: [0.6, 2.0] },
    ]
}

fn check_tones(name: &str, scene: &Scene) -> RegionTally {
    let mut all = RegionTally::default();
    for rule in rules() {
        let found = Regions::toned(&Sight::of(scene), &rule, &Progress::default()).unwrap();
        let surface = |hit: Hit| TonedSurface { object: hit.object, material: NONE, tone: tone(scene, &rule, &hit) };
        add(&mut all, check_labels(name, scene, &found, surface, |_, _| false));
        if let Some(folder) = std::env::var_os("TINTA_TONES") {
            let grey = |surface: TonedSurface| Color([[0.65, 0.95, 1.0][usize::from(surface.tone)]; 3]);
            let lines = VisibleLines::of(scene, &tinta::LineSettings::default()).unwrap();
            let paths = tinta::lines::chain(&lines.segments);
            let settings = DrawingSettings::default();
            let areas = Areas { fills: fills(&found, grey), ..Areas::default() };
            let text = svg_of_paths(&lines, paths.clone(), Some(&areas), &settings).unwrap();
            let only = svg_of_paths(&lines, paths, None, &settings).unwrap();
            println!("{name}: lines {} bytes, with areas {}", only.len(), text.len());
            let file = format!("{}-{}.svg", name.replace('/', "-"), rule.thresholds[0]);
            std::fs::write(std::path::PathBuf::from(folder).join(file), text).unwrap();
        }
    }
    all
}

#[test]
fn tones_of_a_ball_are_those_that_rays_find() {
    let mesh = icosphere(3);
    let normals: Vec<_> = mesh.positions.iter().map(|position| position.normalize().as_vec3()).collect();
    let triangle_normals = mesh.triangles.clone();
    let mesh = tinta::Mesh { normals, triangle_normals, ..mesh };
    let scene = Scene::new([mesh], &SceneSettings::default()).unwrap();
    judge(&check_tones("ball", &scene));
}

#[test]
fn tones_of_surfaces_in_one_place_are_those_that_rays_find() {
    let mesh = icosphere(3);
    let normals: Vec<_> = mesh.positions.iter().map(|position| position.normalize().as_vec3()).collect();
    let ball = tinta::Mesh { normals, triangle_normals: mesh.triangles.clone(), ..mesh };
    let count = ball.positions.len() as u32;
    let mut doubled = ball.clone();
    let reversed: Vec<[u32; 3]> = ball.triangles.iter().map(|[a, b, c]| [*a, *c, *b]).collect();
    doubled.normals.extend(ball.normals.iter().map(|normal| -*normal));
    // Each triangle, then the same from behind.
    doubled.triangles = ball.triangles.iter().zip(&reversed).flat_map(|(front, back)| [*front, *back]).collect();
    let behind = |triangle: &[u32; 3]| triangle.map(|normal| normal + count);
    doubled.triangle_normals =
        ball.triangles.iter().zip(&reversed).flat_map(|(front, back)| [*front, behind(back)]).collect();
    for meshes in [vec![ball.clone(), ball], vec![doubled]] {
        judge(&check_tones("in one place", &Scene::new(meshes, &SceneSettings::default()).unwrap()));
    }
}

#[test]
fn numbers_that_overflow_end_in_no_panic() {
    for exponent in (14..=300).step_by(11) {
        let far = 10f64.powi(exponent);
        let corners = vec![DVec3::new(far, 0.0, 0.0), DVec3::new(far, 1.0, 0.0), DVec3::new(far, 0.0, 1.0)];
        let mesh = mesh(corners, vec![[0, 1, 2]]);
        let mesh = tinta::Mesh { normals: vec![glam::Vec3::X], triangle_normals: vec![[0; 3]], ..mesh };
        let Ok(scene) = Scene::new([mesh], &SceneSettings::default()) else { continue };
        let lines = tinta::LineSettings { finds_outline: true, ..tinta::LineSettings::default() };
        drop(VisibleLines::of(&scene, &lines));
        rules().iter().for_each(|rule| drop(Regions::toned(&Sight::of(&scene), rule, &Progress::default())));
    }
}

#[test]
fn tones_of_public_models_are_those_that_rays_find() {
    let mut all = RegionTally::default();
    let models = public_meshes(&["cow.obj", "teapot.obj", "suzanne.obj"]);
    for (name, mesh) in &models {
        // Without materials, which are no part of the comparison.
        let mesh = tinta::Mesh { triangle_materials: Vec::new(), ..mesh.clone() };
        let settings = SceneSettings { camera: view("30,23", false), ..SceneSettings::default() };
        add(&mut all, check_tones(name, &Scene::new([mesh], &settings).unwrap()));
    }
    if !models.is_empty() {
        judge(&all);
    }
}

/// What a region joined so shows where a face is seen.
fn surface(scene: &Scene, seen: SeenFace, joined: JoinKey) -> Surface {
    let mesh = &scene.objects[seen.object as usize].mesh;
    let material = mesh.triangle_materials.get(seen.face as usize).copied().filter(|material| *material != NONE);
    let material = material.filter(|_| joined != JoinKey::Object);
    let face = (joined == JoinKey::Face).then(|| mesh.file_face(seen.face));
    Surface { object: seen.object, material, tone: None, face }
}

/// The directed sides of regions that no other of them has the other way: the borders of their union.
fn border(regions: &[&Vec<Vec<DVec2>>]) -> BTreeSet<[[u64; 2]; 2]> {
    let bits = |point: DVec2| point.to_array().map(f64::to_bits);
    let of_loop = |corners: &Vec<DVec2>| {
        let next = corners.iter().cycle().skip(1);
        corners.iter().zip(next).map(|(a, b)| [bits(*a), bits(*b)]).collect::<Vec<_>>()
    };
    let all: BTreeSet<_> = regions.iter().flat_map(|loops| loops.iter().flat_map(of_loop)).collect();
    all.iter().filter(|[a, b]| !all.contains(&[*b, *a])).copied().collect()
}

/// Joined regions show what rays hit, and fill the picture; the outline of an object is that of all of its regions.
fn check_joined(name: &str, scene: &Scene) -> RegionTally {
    let mut all = RegionTally::default();
    let of_faces = Regions::of(scene).unwrap();
    for joined in [JoinKey::Face, JoinKey::Material, JoinKey::Object] {
        let found = Regions::joined_by(&Sight::of(scene), joined, &Progress::default()).unwrap();
        let label = |hit: Hit| surface(scene, SeenFace { object: hit.object, face: hit.face }, joined);
        let is_as_right = |hit: &Hit, seen: Surface| {
            let point = world(scene, hit);
            let faces = 0..scene.objects[seen.object as usize].mesh.triangles.len() as u32;
            faces
                .map(|face| SeenFace { object: seen.object, face })
                .any(|face| surface(scene, face, joined) == seen && touches(scene, point, face))
        };
        add(&mut all, check_labels(name, scene, &found, label, is_as_right));
        for object in 0..scene.objects.len() as u32 {
            let is_it = |seen: Option<u32>| seen == Some(object);
            let of_map: Vec<_> = found.regions.iter().filter(|it| is_it(it.seen.map(|seen| seen.object))).collect();
            let of_object: Vec<_> =
                of_faces.regions.iter().filter(|it| is_it(it.seen.map(|seen| seen.object))).collect();
            let area = |sum: f64, area_px: f64| sum + area_px;
            let areas = [
                of_map.iter().map(|it| it.area_px).fold(0.0, area),
                of_object.iter().map(|it| it.area_px).fold(0.0, area),
            ];
            assert!((areas[0] - areas[1]).abs() <= 1e-9 * areas[1].max(1.0), "{name}: {areas:?}");
            let [joined_border, face_border] = [
                border(&of_map.iter().map(|it| &it.loops).collect::<Vec<_>>()),
                border(&of_object.iter().map(|it| &it.loops).collect::<Vec<_>>()),
            ];
            assert_eq!(joined_border, face_border, "{name}, {joined:?}: the outline of object {object}");
        }
    }
    all
}

#[test]
fn joined_regions_of_every_family_show_what_rays_hit() {
    let mut all = RegionTally::default();
    for seed in 1..=KINDS as u64 {
        let mut random = Random::seeded(seed);
        let (name, scene) = scene_of_kind(seed as usize, &mut random);
        add(&mut all, check_joined(&format!("{name}, seed {seed}"), &scene));
    }
    judge(&all);
}

#[test]
fn joined_regions_of_public_models_show_what_rays_hit() {
    let mut all = RegionTally::default();
    let models = public_meshes(&["cow.obj", "teapot.obj", "suzanne.obj", "doll.obj"]);
    for (name, mesh) in &models {
        let camera = view("30,23", false);
        let settings =
            SceneSettings { camera, copies: 2, size: Size { width: 256, height: 192 }, ..SceneSettings::default() };
        add(&mut all, check_joined(name, &Scene::new([mesh.clone()], &settings).unwrap()));
    }
    if !models.is_empty() {
        judge(&all);
    }
}

/// Three sides of a box in squares, the first of all its faces without area.
#[test]
fn the_triangles_of_a_polygon_are_one_region() {
    let positions: Vec<DVec3> = (0..8)
        .map(|corner| DVec3::new(f64::from(corner & 1), f64::from(corner >> 1 & 1), f64::from(corner >> 2)))
        .collect();
    let corners = [0, 1, 1, 0, 2, 3, 1, 4, 5, 7, 6, 0, 1, 5, 4, 2, 6, 7, 3, 0, 4, 6, 2, 1, 3, 7, 5];
    let sizes = vec![3, 4, 4, 4, 4, 4, 4];
    let mesh = tinta::Mesh::of_polygons("a box", positions, &corners, sizes, &LoadOptions::default()).unwrap();
    let settings = SceneSettings { camera: view("30,30", true), ..SceneSettings::default() };
    let scene = Scene::new([mesh], &settings).unwrap();
    let found = Regions::joined_by(&Sight::of(&scene), JoinKey::Face, &Progress::default()).unwrap();
    let mut seen: Vec<_> = found.regions.iter().filter_map(|region| region.seen?.face).collect();
    seen.sort_unstable();
    assert_eq!(seen, [2, 4, 6], "in front, on top, on the right");
    for (traps, is_crisp) in [(true, false), (false, true)] {
        let groups = painted(&found, traps, |_| Color([0.5; 3]));
        let areas = groups.last().unwrap();
        assert_eq!((areas.fills.len(), areas.is_crisp, groups.len()), (3, is_crisp, 1 + usize::from(traps)));
        assert!(areas.fills.iter().all(|fill| fill.trap.is_empty() && fill.loops.len() == 1));
        if traps {
            // Three borders meet in the box's corner: two with the region of the lowest number, which are one stroke.
            assert_eq!(groups[0].fills.iter().map(|fill| fill.trap.len()).collect::<Vec<_>>(), [1, 1]);
            assert_eq!(groups[0].clip.len(), 1);
        }
    }
}

#[test]
fn two_squares_one_behind_the_other_have_three_regions() {
    let square = |half: f64, z: f64| {
        let at = |x: f64, y: f64| DVec3::new(x * half, y * half, z);
        mesh(vec![at(-1.0, -1.0), at(1.0, -1.0), at(1.0, 1.0), at(-1.0, 1.0)], vec![[0, 1, 2], [0, 2, 3]])
    };
    let settings = SceneSettings { camera: view("front", true), ..SceneSettings::default() };
    let scene = Scene::new([square(1.0, 0.0), square(0.5, 1.0)], &settings).unwrap();
    let found = Regions::of(&scene).unwrap();
    // Two halves of each square, and the background.
    let of = |object: u32| found.regions.iter().filter(move |it| it.seen.is_some_and(|seen| seen.object == object));
    assert_eq!((of(0).count(), of(1).count(), found.regions.len()), (2, 2, 5));
    let [large, small] = [0, 1].map(|object| of(object).map(|region| region.area_px).sum::<f64>());
    assert!((large - 3.0 * small).abs() < 1e-3, "{large} {small}");
    let background = found.regions.iter().find(|region| region.seen.is_none()).unwrap();
    assert_eq!(background.loops.len(), 2, "the picture's frame, and a hole");
}

#[test]
fn a_hole_that_touches_its_outline_in_a_corner_is_a_ring_of_its_own() {
    let at = |corners: [[f64; 2]; 4], z: f64| {
        mesh(corners.map(|[x, y]| DVec3::new(x, y, z)).to_vec(), vec![[0, 1, 2], [0, 2, 3]])
    };
    let square = at([[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]], 0.0);
    let before = at([[1.0, 0.0], [0.5, 0.5], [0.0, 0.0], [0.5, -0.5]], 1.0);
    let settings = SceneSettings { camera: view("front", true), ..SceneSettings::default() };
    let scene = Scene::new([square, before], &settings).unwrap();
    let found = Regions::joined_by(&Sight::of(&scene), JoinKey::Object, &Progress::default()).unwrap();
    let square = found.regions.iter().find(|it| it.seen.is_some_and(|seen| seen.object == 0)).unwrap();
    assert!(has_valid_rings(square, "square"), "its rings touch");
    assert_eq!(square.loops.iter().map(Vec::len).collect::<Vec<_>>(), [5, 4]);
}

#[test]
fn regions_end_when_asked() {
    let scene = scene_of_kind(0, &mut Random::seeded(1)).1;
    let late = Regions::with_progress(&Sight::of(&scene), &Progress::within(Duration::ZERO));
    assert!(matches!(late, Err(Error::OutOfTime { .. })));
    let progress = Progress::default();
    progress.cancel();
    assert!(matches!(Regions::with_progress(&Sight::of(&scene), &progress), Err(Error::Cancelled)));
}

#[test]
fn a_part_seen_from_nearby_has_its_areas_however_small_it_is_beside_the_whole() {
    let areas = |side: f64| {
        let low = DVec3::new(0.5 - side * 0.5, 0.5 - side * 0.5, 1.0 + side);
        let both = joined(&[cuboid(DVec3::ZERO, DVec3::ONE), cuboid(low, low + side)]);
        let middle = low + side * 0.5;
        let eye = middle + side * DVec3::new(1.5, 1.0, 3.0);
        let camera =
            CameraSettings { eye: Some(eye), target: Some(middle), near: Some(side), ..CameraSettings::default() };
        let size = Size { width: 128, height: 128 };
        let scene = Scene::new([both], &SceneSettings { camera, size, ..SceneSettings::default() }).unwrap();
        let mut areas = [0.0; 12];
        for region in Regions::of(&scene).unwrap().regions {
            if let Some(place) = region.seen.and_then(|seen| seen.face.checked_sub(12)) {
                areas[place as usize] += region.area_px;
            }
        }
        areas
    };
    let usual = areas(1e-2);
    assert_eq!(usual.iter().filter(|area| **area > 1.0).count(), 6, "{usual:?}");
    for side in [1e-3, 1e-4, 1e-5] {
        let found = areas(side);
        assert!(found.iter().zip(usual).all(|(a, b)| (a - b).abs() < 0.5), "{side}: {found:?} instead of {usual:?}");
    }
    // Six times the distance below which positions count as one: near an edge of it two of its faces touch.
    let all = |areas: [f64; 12]| areas.iter().sum::<f64>();
    assert!((all(areas(1e-6)) - all(usual)).abs() < 0.5);
}
