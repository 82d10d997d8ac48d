//! Faces of two materials in one plane: a picture shows one of them all over, the one that areas show.

use crate::support::{BACKENDS, renderer};
use glam::{DMat3, DVec2, DVec3};
use tinta::lines::{Progress, Region, Regions, Sight, ToneLight, ToneRule};
use tinta::preset::LOOKS;
use tinta::request::{OptionLayer, Request};
use tinta::settings::{OptionValue, Options};
use tinta::{Picture, Scene, load};

const VIEWS: [&str; 3] = ["30,23", "62,8", "-50,40"];

const SHIELD: [[f64; 2]; 4] = [[-1.0, -1.0], [1.0, -0.9], [1.1, 1.0], [-1.0, 1.0]];
const BADGE: [[f64; 2]; 4] = [[-0.5, -0.4], [0.6, -0.5], [0.5, 0.6], [-0.4, 0.5]];

fn request(view: &str) -> Request {
    let look = LOOKS.into_iter().find(|look| look.name == "print").unwrap();
    let given = [("size", "300x300"), ("view", view)].map(|(name, value)| (name.to_owned(), OptionValue::text(value)));
    Request::from_layers(&[OptionLayer::Look(look), OptionLayer::Given(Options::from(given))]).unwrap().0
}

/// Two squares in one turned plane, cut along different diagonals, and its scene.
fn scene(turn: DMat3, [first, second]: [&str; 2], request: &Request) -> Scene {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    std::fs::write(path("a.mtl"), "newmtl shield\nKd 0.9 0.2 0.2\nnewmtl badge\nKd 0.2 0.2 0.9\n").unwrap();
    let vertex = |[x, y]: [f64; 2]| {
        let DVec3 { x, y, z } = turn * DVec3::new(x, y, 0.0);
        format!("v {} {} {}\n", x as f32, y as f32, z as f32)
    };
    let vertices: String = SHIELD.into_iter().chain(BADGE).map(vertex).collect();
    let faces = |name: &str| match name {
        "shield" => "usemtl shield\nf 1 2 3\nf 1 3 4\n",
        _ => "usemtl badge\nf 5 6 8\nf 6 7 8\n",
    };
    std::fs::write(path("a.obj"), format!("mtllib a.mtl\n{vertices}{}{}", faces(first), faces(second))).unwrap();
    let mesh = load(path("a.obj").to_str().unwrap(), &request.read).unwrap().mesh;
    Scene::new([mesh], &request.scene).unwrap()
}

/// Places inside the badge's image.
fn places(scene: &Scene, turn: DMat3) -> impl Iterator<Item = DVec2> + '_ {
    let inside = (1..20).flat_map(|row| (1..20).map(move |column| [f64::from(column) / 20.0, f64::from(row) / 20.0]));
    inside.map(move |[right, up]| {
        let [a, b, c, d] = BADGE.map(|[x, y]| turn * DVec3::new(x, y, 0.0));
        let place = a.lerp(b, right).lerp(d.lerp(c, right), up);
        let clip = scene.camera.clip_from_view(1.0) * scene.camera.view_from_world() * place.extend(1.0);
        (DVec2::new(clip.x, -clip.y) / clip.w * 0.5 + 0.5) * f64::from(scene.size.width)
    })
}

fn is_in<T>(region: &Region<T>, px: DVec2) -> bool {
    let sides = region.loops.iter().flat_map(|corners| corners.iter().zip(corners.iter().cycle().skip(1)));
    let is_right = |(a, b): &(&DVec2, &DVec2)| {
        (a.y > px.y) != (b.y > px.y) && a.x + (b.x - a.x) * ((px.y - a.y) / (b.y - a.y)) > px.x
    };
    sides.filter(is_right).count() % 2 == 1
}

#[test]
fn of_faces_in_one_plane_pictures_and_areas_show_the_same() {
    let turns = [DMat3::IDENTITY, DMat3::from_euler(glam::EulerRot::XYZ, 0.3, 0.2, 0.7)];
    let rule = ToneRule { light: ToneLight::Near(DVec3::ONE), thresholds: [0.8, 0.65] };
    for backend in *BACKENDS {
        let mut renderer = renderer(backend);
        for (turn, view, names) in turns.iter().flat_map(|turn| {
            VIEWS
                .iter()
                .flat_map(move |view| [["shield", "badge"], ["badge", "shield"]].map(|names| (*turn, *view, names)))
        }) {
            let request = request(view);
            let scene = scene(turn, names, &request);
            let picture: Picture =
                request.moving(scene.clone(), None, false).and_then(|view| view.picture(&mut renderer)).unwrap();
            let regions = Regions::toned(&Sight::of(&scene), &rule, &Progress::default()).unwrap();
            let materials = &scene.objects[0].mesh.materials;
            for px in places(&scene, turn) {
                let region = regions.regions.iter().find(|region| is_in(region, px)).unwrap();
                let material = &materials[region.seen.unwrap().material as usize];
                assert_eq!(material.name, names[0], "areas show the first");
                let [red, _, blue, _] = picture.pixel(px.x as i64, px.y as i64);
                let shown = if red > blue { "shield" } else { "badge" };
                assert_eq!(shown, names[0], "{px} from {view}, {backend:?}");
            }
        }
    }
}
