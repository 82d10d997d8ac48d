//! Tests the flicker measure of `benches/contours.rs`: none for a sphere, the right length for gaps, and hidden lines
//! explained.

#[path = "../../benches/contours/flicker.rs"]
mod measure;

use glam::DVec2;
use measure::{Flicker, flicker};
use std::sync::Arc;
use tinta::edges::{Class, ClassSet, SilhouetteRule};
use tinta::lines::closed_forms::ClosedForm;
use tinta::{CameraSettings, LineSettings, LoadOptions, Mesh, Scene, SceneSettings, VisibleLines};

fn of(meshes: Vec<Mesh>) -> Scene {
    Scene::new(meshes.into_iter().map(Arc::new).collect::<Vec<_>>(), &SceneSettings::default()).unwrap()
}

/// Two pictures one degree apart, somewhere in a turn, with their silhouettes.
fn a_degree(scene: &Scene, at: usize, silhouette: SilhouetteRule) -> [(Scene, VisibleLines); 2] {
    let cameras = scene.turntable(&CameraSettings::default(), 360).unwrap();
    let classes = ClassSet::of(&[Class::Silhouette]);
    let settings = LineSettings { classes, silhouette, finds_hidden: false, ..LineSettings::default() };
    [at, at + 1].map(|view| {
        let scene = Scene { camera: cameras[view], ..scene.clone() };
        let lines = VisibleLines::of(&scene, &settings).unwrap();
        (scene, lines)
    })
}

fn of_pictures([a, b]: &[(Scene, VisibleLines); 2]) -> Flicker {
    flicker([(&a.0, &a.1), (&b.0, &b.1)], 1.0)
}

#[test]
fn a_sphere_that_turns_does_not_flicker_drawn_smooth() {
    for jitter in [0.0, 0.2] {
        let ball = of(vec![ClosedForm::ellipsoid(1.0, 1.0, 1.0).mesh(10_000, jitter).unwrap()]);
        for at in [0, 77, 200] {
            let Flicker { drawn_px, explained_px, unexplained_px } =
                of_pictures(&a_degree(&ball, at, SilhouetteRule::Smooth));
            assert!(drawn_px > 2000.0);
            assert_eq!([explained_px, unexplained_px], [0.0; 2], "jitter {jitter} at {at}");
        }
    }
}

#[test]
fn what_is_left_out_of_one_picture_is_flicker_by_its_length() {
    let ball = of(vec![ClosedForm::ellipsoid(1.0, 1.0, 1.0).mesh(10_000, 0.0).unwrap()]);
    let mut pictures = a_degree(&ball, 10, SilhouetteRule::Smooth);
    let is_out = |px: DVec2| px.x > 300.0;
    let middle = |ends: [DVec2; 2]| (ends[0] + ends[1]) * 0.5;
    let left_out: f64 = pictures[1]
        .1
        .segments
        .iter()
        .filter(|segment| is_out(middle(segment.ends_px)))
        .map(|segment| segment.ends_px[0].distance(segment.ends_px[1]))
        .sum();
    pictures[1].1.segments.retain(|segment| !is_out(middle(segment.ends_px)));
    let found = of_pictures(&pictures);
    // The ends of the gap count as still drawn for a pixel or two.
    assert!(left_out > 300.0 && (found.unexplained_px - left_out).abs() < 6.0, "{left_out} {found:?}");
    // Vanishing and appearing count the same.
    let [a, b] = pictures;
    assert_eq!(of_pictures(&[b, a]).unexplained_px, found.unexplained_px);
}

#[test]
fn what_goes_behind_something_is_explained() {
    // A sheet in front of a ball hides half of it in the second picture.
    let ball = || ClosedForm::ellipsoid(1.0, 1.0, 1.0).mesh(10_000, 0.0).unwrap();
    let scene = of(vec![ball()]);
    let [first, second] = a_degree(&scene, 0, SilhouetteRule::Smooth);
    let eye = second.0.camera.eye;
    let (ahead, up) = ((second.0.camera.target - eye).normalize(), second.0.camera.up);
    let right = ahead.cross(up).normalize();
    let before = second.0.camera.target - ahead * 0.7;
    let corner = |x: f64, y: f64| before + right * x + up * y;
    let corners = vec![corner(0.0, -2.0), corner(2.0, -2.0), corner(2.0, 2.0), corner(0.0, 2.0)];
    let sheet = Mesh::of_triangles("sheet", corners, &[[0, 1, 2], [0, 2, 3]], &LoadOptions::default()).unwrap();
    let mut hidden = of(vec![ball(), sheet]);
    (hidden.camera, hidden.centre, hidden.radius) = (second.0.camera, second.0.centre, second.0.radius);
    // The second picture is empty, which is right for half of the ball.
    let nothing = VisibleLines { segments: Vec::new(), ..second.1.clone() };
    let pictures = [(&first.0, &first.1), (&hidden, &nothing)];
    let Flicker { drawn_px, explained_px, unexplained_px } = flicker(pictures, 1.0);
    assert!((drawn_px - explained_px - unexplained_px).abs() < 1e-6);
    assert!((explained_px - 0.5 * drawn_px).abs() < 0.02 * drawn_px, "{explained_px} of {drawn_px}");
}
