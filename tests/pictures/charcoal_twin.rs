//! An independent twin of the charcoal drawing on the CPU: rays through pixels, the text's formula in f64, textures read
//! as GL reads them.

use crate::support::{BACKENDS, failure_folder, renderer, scene_with, side_by_side};
use glam::{DVec2, DVec3};
use std::sync::Arc;
use tinta::picture::write_rgba_png;
use tinta::styles::{CetCoordinate, Charcoal, CharcoalRecipe, Improvements};
use tinta::textures::{ContrastTexture, NoiseTexture, PaperTexture};
use tinta::{
    Backend, CameraSettings, LoadOptions, Mesh, Picture, Renderer, Scene, SceneSettings, Show, Size, Style, load,
};

/// The drawing or one of its stages.
pub fn draw(renderer: &mut Renderer, scene: &Scene, charcoal: &Charcoal, show: Show) -> Picture {
    renderer.draw(scene, &Style::Charcoal(charcoal.clone()).plan(scene, show).unwrap()).unwrap()
}

/// Returns the first hit of a ray through the middle of a pixel: the triangle and the barycentric coordinates of the point.
fn hit(mesh: &Mesh, origin: DVec3, direction: DVec3) -> Option<(usize, DVec3)> {
    let mut nearest: Option<(f64, usize, DVec3)> = None;
    for (number, triangle) in mesh.triangles.iter().enumerate() {
        let [a, b, c] = triangle.map(|position| mesh.positions[position as usize]);
        let (first, second) = (b - a, c - a);
        let across = direction.cross(second);
        let determinant = first.dot(across);
        if determinant.abs() < 1e-14 {
            continue;
        }
        let from_corner = origin - a;
        let share_b = from_corner.dot(across) / determinant;
        let share_c = direction.dot(from_corner.cross(first)) / determinant;
        let distance = second.dot(from_corner.cross(first)) / determinant;
        let is_inside = share_b >= 0.0 && share_c >= 0.0 && share_b + share_c <= 1.0;
        if is_inside && distance > 0.0 && nearest.is_none_or(|(known, ..)| distance < known) {
            nearest = Some((distance, number, DVec3::new(1.0 - share_b - share_c, share_b, share_c)));
        }
    }
    nearest.map(|(_, number, shares)| (number, shares))
}

/// GL_LINEAR with GL_REPEAT, in [0, 1]; t counts from the lowest row.
fn sample(picture: &Picture, place: DVec2) -> [f64; 3] {
    let (width, height) = (i64::from(picture.size.width), i64::from(picture.size.height));
    let (x, y) = (place.x * width as f64 - 0.5, place.y * height as f64 - 0.5);
    let (left, low) = (x.floor(), y.floor());
    let (right_share, high_share) = (x - left, y - low);
    let texel = |dx: i64, dy: i64| {
        let column = (left as i64 + dx).rem_euclid(width);
        let row = (low as i64 + dy).rem_euclid(height);
        picture.pixel(column, height - 1 - row)
    };
    [0, 1, 2].map(|channel| {
        let value = |dx, dy| f64::from(texel(dx, dy)[channel]) / 255.0;
        let lower = value(0, 0) * (1.0 - right_share) + value(1, 0) * right_share;
        let upper = value(0, 1) * (1.0 - right_share) + value(1, 1) * right_share;
        lower * (1.0 - high_share) + upper * high_share
    })
}

/// The textures, made again from the settings.
struct Textures {
    noise: Picture,
    cet: Picture,
    paper: Picture,
}

impl Textures {
    fn of(charcoal: &Charcoal) -> Self {
        let (size, seed, random) = (charcoal.texture_size, charcoal.seed, charcoal.random);
        let (density_percent, exponent) = (charcoal.density_percent, charcoal.cet_exponent);
        let cet = ContrastTexture { size, seed, random, density_percent, exponent, ..ContrastTexture::default() };
        Self {
            noise: NoiseTexture { size, seed, random }.picture().unwrap(),
            cet: cet.picture().unwrap(),
            paper: PaperTexture { size, seed, random }.picture().unwrap(),
        }
    }
}

/// The text's formula for a pixel of the model, in [0, 1]: the light, the CEM and the drawing.
struct Tones {
    light: f64,
    cem: f64,
    drawing: [f64; 3],
}

/// `normal_view` of any length, `place` in the picture from 0 to 1.
fn tones(charcoal: &Charcoal, textures: &Textures, normal_view: DVec3, place: DVec2) -> Tones {
    let normal = normal_view.normalize();
    let light: f64 = charcoal
        .lights
        .iter()
        .flatten()
        .map(|light| DVec3::from_array(light.map(f64::from)).normalize().dot(normal).max(0.0))
        .sum();
    let original = light.powf(f64::from(charcoal.contrast_exponent));
    let mut cem = original * f64::from(charcoal.saturation);
    if charcoal.improve.clamp {
        cem = cem.clamp(0.0, 1.0);
    }
    let mut row = if charcoal.cet_coordinate == CetCoordinate::Saturated { cem } else { original };
    if charcoal.improve.wrap {
        let half_texel = 0.5 / f64::from(charcoal.texture_size.height);
        row = row.clamp(half_texel, 1.0 - half_texel);
    }
    let random = sample(&textures.noise, place).iter().sum::<f64>() / 3.0;
    let grain = sample(&textures.cet, DVec2::new(random, row));
    let paper = sample(&textures.paper, place);
    let smudge = if charcoal.smudge { cem } else { 1.0 };
    let drawing = [0, 1, 2].map(|channel| grain[channel] * cem * smudge - (1.0 - paper[channel]));
    Tones { light, cem, drawing }
}

/// What a ray through the middle of a pixel meets.
#[derive(Clone, Copy)]
struct Met {
    /// Of any length, in eye space.
    normal_view: DVec3,
    /// The paper's coordinate of the listing: divided by w at the vertices, then interpolated in perspective (erratum V4).
    listing_place: DVec2,
}

/// What every pixel shows.
fn cast(scene: &Scene) -> Vec<Option<Met>> {
    let Size { width, height } = scene.size;
    let mesh = &scene.objects[0].mesh;
    let clip_from_world = scene.camera.clip_from_view(scene.size.aspect()) * scene.camera.view_from_world();
    let world_from_clip = clip_from_world.inverse();
    let view = scene.camera.view_from_world();
    let mut met = Vec::new();
    for y in 0..height {
        for x in 0..width {
            let ndc = |z| {
                let (x, y) = (f64::from(x) + 0.5, f64::from(y) + 0.5);
                DVec3::new(x / f64::from(width) * 2.0 - 1.0, 1.0 - y / f64::from(height) * 2.0, z)
            };
            let (near, far) = (world_from_clip.project_point3(ndc(-1.0)), world_from_clip.project_point3(ndc(1.0)));
            met.push(hit(mesh, near, far - near).map(|(triangle, shares)| {
                let [a, b, c] = mesh.triangle_normals[triangle].map(|normal| mesh.normals[normal as usize].as_dvec3());
                let [p, q, r] = mesh.triangles[triangle].map(|corner| {
                    clip_from_world.project_point3(mesh.positions[corner as usize]).truncate() * 0.5 + 0.5
                });
                Met {
                    normal_view: view.transform_vector3(a * shares.x + b * shares.y + c * shares.z),
                    listing_place: p * shares.x + q * shares.y + r * shares.z,
                }
            }));
        }
    }
    met
}

/// Mean and largest difference to the twin, steps of 255, over pixels of the model away from silhouettes. The twin reads noise and
/// paper at the pixel's place, or at the listing's.
fn against_the_twin(
    scene: &Scene,
    met: &[Option<Met>],
    actual: &Picture,
    is_by_the_listing: bool,
    expected: impl Fn(DVec3, DVec2) -> [f64; 3],
) -> (f64, f64, Picture, usize) {
    let (width, height) = (scene.size.width as usize, scene.size.height as usize);
    let mut twin = actual.clone();
    let (mut sum, mut largest, mut count) = (0.0, 0.0f64, 0usize);
    for y in 1..height - 1 {
        for x in 1..width - 1 {
            let Some(Met { normal_view: normal, listing_place }) = met[y * width + x] else { continue };
            // Next to a silhouette or a crease GL may have chosen another triangle for the pixel.
            let is_smooth = |(dx, dy): (usize, usize)| {
                met[(y + dy - 1) * width + x + dx - 1]
                    .is_some_and(|other| other.normal_view.normalize().dot(normal.normalize()) > 0.7)
            };
            let block = (0..3).flat_map(|dx| (0..3).map(move |dy| (dx, dy)));
            if !block.into_iter().all(is_smooth) {
                continue;
            }
            let middle = DVec2::new((x as f64 + 0.5) / width as f64, 1.0 - (y as f64 + 0.5) / height as f64);
            let place = if is_by_the_listing { listing_place } else { middle };
            let pixel = actual.pixel(x as i64, y as i64);
            for (channel, value) in expected(normal, place).into_iter().enumerate() {
                let value = value.clamp(0.0, 1.0) * 255.0;
                twin.pixels[(y * width + x) * 4 + channel] = value.round() as u8;
                let difference = (value - f64::from(pixel[channel])).abs();
                (sum, largest, count) = (sum + difference, largest.max(difference), count + 1);
            }
        }
    }
    (sum / count as f64, largest, twin, count / 3)
}

/// A ball in parallel projection, where V4's coordinate and the twin's are the same.
pub fn ball() -> Scene {
    ball_from(CameraSettings { parallel: true, ..CameraSettings::default() })
}

fn ball_from(camera: CameraSettings) -> Scene {
    let mesh = crate::support::shapes::icosphere(3);
    let mut text = String::new();
    mesh.positions.iter().for_each(|p| text.push_str(&format!("v {} {} {}\n", p.x, p.y, p.z)));
    mesh.triangles.iter().for_each(|[a, b, c]| text.push_str(&format!("f {} {} {}\n", a + 1, b + 1, c + 1)));
    let file = tempfile::Builder::new().suffix(".obj").tempfile().unwrap();
    std::fs::write(file.path(), text).unwrap();
    let mesh = load(file.path().to_str().unwrap(), &LoadOptions::default()).unwrap().mesh;
    let settings = SceneSettings { camera, size: Size { width: 120, height: 120 }, ..SceneSettings::default() };
    Scene::new(vec![Arc::new(mesh)], &settings).unwrap()
}

/// Textures of the picture's size, as 512 x 512 is by default: noise and paper are then read in the middle of their texels,
/// where the filter's precision, which GL leaves open (Mesa's software renderer has 8 bits), does not count.
pub fn variants() -> Vec<(&'static str, Charcoal)> {
    let base = || Charcoal { texture_size: Size { width: 120, height: 120 }, ..Charcoal::default() };
    let bright = [Some([-0.55, 0.75, 0.55]), Some([0.9, -0.15, 0.35])];
    vec![
        ("plain", base()),
        ("sheet-3", Charcoal { seed: 3, ..base() }),
        ("darker", Charcoal { texture_size: base().texture_size, ..Charcoal::recipe(CharcoalRecipe::Darker) }),
        ("closure", Charcoal { texture_size: base().texture_size, ..Charcoal::recipe(CharcoalRecipe::Closure) }),
        ("figure-8", Charcoal { cet_coordinate: CetCoordinate::Saturated, saturation: 1.2, ..base() }),
        ("one-light", Charcoal { lights: [None, Some([-0.7, -0.56, 0.45])], ..base() }),
        ("bright", Charcoal { lights: bright, ..base() }),
        ("bright-improved", Charcoal { lights: bright, saturation: 1.5, improve: Improvements::ALL, ..base() }),
    ]
}

#[test]
fn the_twin_notices_another_exponent_and_the_paper_that_swims() {
    let mut renderer = renderer(BACKENDS[0]);
    let (scene, charcoal) = (ball(), variants().remove(0).1);
    let (met, textures) = (cast(&scene), Textures::of(&charcoal));
    let other = draw(&mut renderer, &scene, &Charcoal { contrast_exponent: 1.6, ..charcoal.clone() }, Show::Final);
    let expected = |normal, place| tones(&charcoal, &textures, normal, place).drawing;
    assert!(against_the_twin(&scene, &met, &other, false, expected).0 > 2.0);
    // Errata V4: in perspective the vertex program's coordinate is off within each large triangle.
    let mut settings = SceneSettings { size: Size { width: 120, height: 120 }, ..SceneSettings::default() };
    (settings.camera.fov_y_degrees, settings.camera.view) = (70.0, "20,60".parse().unwrap());
    let box_scene = scene_with("builtin:open-box", settings);
    let met = cast(&box_scene);
    let mut mean = |paper_coordinate| {
        let improve = Improvements { paper_coordinate, ..Improvements::default() };
        let picture = draw(&mut renderer, &box_scene, &Charcoal { improve, ..charcoal.clone() }, Show::Final);
        against_the_twin(&box_scene, &met, &picture, false, expected).0
    };
    let (published, improved) = (mean(false), mean(true));
    assert!(published > 2.0 && improved < 0.5, "{published} {improved}");
}

#[test]
fn in_perspective_the_listings_coordinate_leaves_the_texels_middles_and_the_drivers_filter_shows() {
    let mut renderer = renderer(BACKENDS[0]);
    let (scene, charcoal) = (ball_from(CameraSettings::default()), variants().remove(0).1);
    let (met, textures) = (cast(&scene), Textures::of(&charcoal));
    let mut against = |paper_coordinate, is_by_the_listing| {
        let improve = Improvements { paper_coordinate, ..Improvements::default() };
        let picture = draw(&mut renderer, &scene, &Charcoal { improve, ..charcoal.clone() }, Show::Final);
        let expected = |normal, place| tones(&charcoal, &textures, normal, place).drawing;
        let (mean, largest, ..) = against_the_twin(&scene, &met, &picture, is_by_the_listing, expected);
        println!(
            "paper-coordinate {paper_coordinate}, listing {is_by_the_listing}: mean {mean:.2}, at most {largest:.1}"
        );
        (mean, largest)
    };
    let (published, mended, elsewhere) = (against(false, true), against(true, false), against(false, false));
    assert!(mended.0 < 0.5 && mended.1 < 3.0, "{mended:?}");
    // The filter's 8 bits and the rasterizer's last bit move grains; where the coordinate is not the listing's, far more move.
    assert!(published.0 < 1.5 && published.1 < 25.0 && published.0 * 3.0 < elsewhere.0, "{published:?} {elsewhere:?}");
}

fn check_formula(backends: &[Backend], variants: &[(&str, Charcoal)]) {
    let scene = ball();
    let met = cast(&scene);
    for &backend in backends {
        let mut renderer = renderer(backend);
        for (name, charcoal) in variants {
            let textures = Textures::of(charcoal);
            let check = |show: Show, actual: &Picture, value: &dyn Fn(Tones) -> [f64; 3]| {
                let expected = |normal, place| value(tones(charcoal, &textures, normal, place));
                let (mean, largest, twin, count) = against_the_twin(&scene, &met, actual, false, expected);
                assert!(count > 5000, "{count} pixels were compared");
                if mean >= 0.5 || largest >= 3.0 {
                    let path = failure_folder().join(format!("charcoal-{name}-{show:?}-{backend:?}.png"));
                    write_rgba_png(&side_by_side(&twin, actual), &path).unwrap();
                    panic!(
                        "{name} {show:?} {backend:?}: mean {mean}, largest {largest} of 255, allowed 0.5 and 3; \
                         expected | difference | actual: {}",
                        path.display()
                    );
                }
            };
            let mut picture = |show| draw(&mut renderer, &scene, charcoal, show);
            check(Show::Final, &picture(Show::Final), &|tones| tones.drawing);
            check(Show::Diffuse, &picture(Show::Diffuse), &|tones| [tones.light; 3]);
            check(Show::Cem, &picture(Show::Cem), &|tones| [tones.cem; 3]);
        }
    }
}

#[test]
fn the_plain_drawing_one_by_one_light_and_the_mended_one_are_the_texts_formula_briefly() {
    let variants = variants();
    check_formula(&BACKENDS[..1], &[&variants[..1], &variants[5..6], &variants[7..]].concat());
}

#[test]
#[ignore = "exhaustive: eight variants by both backends"]
fn the_drawing_is_the_texts_formula() {
    check_formula(&*BACKENDS, &variants());
}
