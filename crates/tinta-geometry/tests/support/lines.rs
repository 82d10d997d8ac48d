//! Shared parts of the tests of visible lines: scenes of meshes, separate projections, sums of lengths.

use super::growth::{Family, FamilyView};
use super::shapes::{Random, mesh};
use glam::{DMat3, DVec2, DVec3};
use tinta::camera::Projection;
use tinta::edges::{Class, ClassSet};
use tinta::lines::{LineSegment, LineSettings, VisibleLines};
use tinta::{CameraSettings, Mesh, Scene, SceneSettings, Size};

/// The number of random scenes for the exhaustive tests in `TINTA_LINE_SCENES`, of each kind or family.
pub fn scenes_wanted() -> Option<u64> {
    let wanted = std::env::var("TINTA_LINE_SCENES").ok()?;
    Some(wanted.parse().expect("TINTA_LINE_SCENES is a number"))
}

/// A square picture of meshes, 512 pixels.
pub fn scene_of(meshes: Vec<Mesh>, camera: CameraSettings) -> Scene {
    let settings = SceneSettings { camera, size: Size { width: 512, height: 512 }, ..SceneSettings::default() };
    Scene::new(meshes, &settings).unwrap()
}

/// A family's scene of about so many triangles, as the benchmark sees it.
pub fn scene_of_family(family: &Family, triangles: usize) -> Scene {
    let shape = (family.make)(triangles);
    let camera = match family.seen {
        FamilyView::Aslant => view("30,20", false),
        FamilyView::Along => view("0,0", true),
    };
    scene_of(vec![mesh(shape.positions, shape.triangles)], camera)
}

/// The fitted camera as settings.
pub fn explicit(scene: &Scene) -> CameraSettings {
    let camera = &scene.camera;
    CameraSettings {
        eye: Some(camera.eye),
        target: Some(camera.target),
        up: Some(camera.up),
        near: Some(camera.near),
        far: Some(camera.far),
        parallel: matches!(camera.projection, Projection::Parallel { .. }),
        ..CameraSettings::default()
    }
}

/// A camera in numbers, moved by a similarity.
pub fn moved_camera(camera: &CameraSettings, turn: DMat3, scale: f64, shift: DVec3) -> CameraSettings {
    let place = |point: DVec3| turn * point * scale + shift;
    CameraSettings {
        eye: camera.eye.map(place),
        target: camera.target.map(place),
        up: camera.up.map(|up| turn * up),
        near: camera.near.map(|near| near * scale),
        far: camera.far.map(|far| far * scale),
        height: camera.height.map(|height| height * scale),
        ..camera.clone()
    }
}

/// A named view or one by angles, in either projection.
pub fn view(name: &str, parallel: bool) -> CameraSettings {
    CameraSettings { view: name.parse().unwrap(), parallel, ..CameraSettings::default() }
}

/// The lines by the default settings, with the general checks.
pub fn lines(scene: &Scene) -> VisibleLines {
    lines_with(scene, &LineSettings::default())
}

/// Like [`lines`], with settings.
pub fn lines_with(scene: &Scene, settings: &LineSettings) -> VisibleLines {
    let found = VisibleLines::of(scene, settings).unwrap();
    let size = DVec2::new(f64::from(scene.size.width), f64::from(scene.size.height));
    for segment in &found.segments {
        for end in segment.ends_px {
            let is_inside = end.cmpge(DVec2::splat(-1e-6)).all() && end.cmple(size + 1e-6).all();
            assert!(end.is_finite() && is_inside, "{segment:?}");
        }
        assert!(segment.angle_degrees.is_none_or(f64::is_finite), "{segment:?}");
        assert_eq!(segment.edge.is_some(), ClassSet::EDGES.contains(segment.class), "{segment:?}");
    }
    found
}

/// Settings for these classes.
pub fn only(classes: &[Class]) -> LineSettings {
    LineSettings { classes: ClassSet::of(classes), ..LineSettings::default() }
}

/// Where a point of the world is drawn, by the matrices that GL gets: pixels, y down.
pub fn px(scene: &Scene, point: DVec3) -> DVec2 {
    let ndc = (scene.camera.clip_from_view(scene.size.aspect()) * scene.camera.view_from_world()).project_point3(point);
    let size = DVec2::new(f64::from(scene.size.width), f64::from(scene.size.height));
    DVec2::new(ndc.x + 1.0, 1.0 - ndc.y) * 0.5 * size
}

/// The length of a line of the world in the picture.
pub fn px_between(scene: &Scene, a: DVec3, b: DVec3) -> f64 {
    px(scene, a).distance(px(scene, b))
}

/// The distance of a point from a piece of line.
pub fn distance(point: DVec2, [a, b]: [DVec2; 2]) -> f64 {
    let share = (point - a).dot(b - a) / a.distance_squared(b).max(f64::MIN_POSITIVE);
    a.lerp(b, share.clamp(0.0, 1.0)).distance(point)
}

/// A piece's length.
pub fn length(segment: &LineSegment) -> f64 {
    segment.ends_px[0].distance(segment.ends_px[1])
}

/// The pieces of one list that have no equal in another: of the same class and edge, with ends as near as this many pixels.
pub fn without_equal<'a>(segments: &[&'a LineSegment], others: &[&LineSegment], px: f64) -> Vec<&'a LineSegment> {
    let is_equal = |a: &LineSegment, b: &LineSegment| {
        let are_near = |end: usize| a.ends_px[end].distance(b.ends_px[end]) <= px;
        (a.class, a.object, a.edge) == (b.class, b.object, b.edge) && are_near(0) && are_near(1)
    };
    segments.iter().filter(|segment| !others.iter().any(|other| is_equal(segment, other))).copied().collect()
}

/// The length of all pieces of a class, visible or hidden.
pub fn of_class(lines: &VisibleLines, class: Class, is_visible: bool) -> f64 {
    lines.segments.iter().filter(|s| s.class == class && s.is_visible == is_visible).map(length).sum()
}

/// The length of all pieces, visible or hidden.
pub fn total(lines: &VisibleLines, is_visible: bool) -> f64 {
    lines.segments.iter().filter(|segment| segment.is_visible == is_visible).map(length).sum()
}

/// Asserts that two lengths or places are the same up to rounding.
#[track_caller]
pub fn assert_near(actual: f64, expected: f64, tolerance: f64, what: &str) {
    assert!((actual - expected).abs() <= tolerance, "{what}: {actual} px instead of {expected}");
}

/// Where a line passes through a triangle, as a share of its direction (Möller and Trumbore 1997).
pub fn pierce(origin: DVec3, direction: DVec3, [a, b, c]: [DVec3; 3]) -> Option<f64> {
    let (ab, ac) = (b - a, c - a);
    let p = direction.cross(ac);
    let determinant = ab.dot(p);
    if determinant == 0.0 {
        return None;
    }
    let from_a = origin - a;
    let u = from_a.dot(p) / determinant;
    let q = from_a.cross(ab);
    let v = direction.dot(q) / determinant;
    (u >= 0.0 && v >= 0.0 && u + v <= 1.0).then(|| ac.dot(q) / determinant)
}

/// The mesh with its positions and faces in another order, each face beginning at another corner.
pub fn shuffled(mesh: &Mesh, random: &mut Random) -> Mesh {
    let mut order = |count: usize| {
        let mut order: Vec<usize> = (0..count).collect();
        (1..count).rev().for_each(|last| order.swap(last, (random.number() * (last + 1) as f64) as usize));
        order
    };
    let (of_positions, of_faces) = (order(mesh.positions.len()), order(mesh.triangles.len()));
    let mut place = vec![0; of_positions.len()];
    of_positions.iter().enumerate().for_each(|(new, old)| place[*old] = new as u32);
    let turned = |face: usize, mut corners: [u32; 3]| {
        corners.rotate_left(face % 3);
        corners
    };
    let of_corners = |list: &Vec<[u32; 3]>| -> Vec<[u32; 3]> {
        of_faces.iter().filter_map(|face| Some(turned(*face, *list.get(*face)?))).collect()
    };
    let triangles: Vec<[u32; 3]> = of_corners(&mesh.triangles);
    Mesh {
        positions: of_positions.iter().map(|old| mesh.positions[*old]).collect(),
        file_vertices: of_positions.iter().map(|old| mesh.file_vertices[*old]).collect(),
        triangles: triangles.into_iter().map(|corners| corners.map(|corner| place[corner as usize])).collect(),
        triangle_normals: of_corners(&mesh.triangle_normals),
        triangle_texture_coordinates: of_corners(&mesh.triangle_texture_coordinates),
        file_faces: of_faces.iter().map(|face| mesh.file_face(*face as u32)).collect(),
        triangle_materials: of_faces.iter().filter_map(|face| mesh.triangle_materials.get(*face).copied()).collect(),
        ..mesh.clone()
    }
}
