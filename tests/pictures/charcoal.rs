//! The styles charcoal and sand, drawn: the direction of every setting, closed forms, and refusals.

use crate::support::charcoal::{ball, draw, variants};
use crate::support::{BACKENDS, full_sizes, renderer, scene, scene_with};
use std::sync::Arc;
use tinta::picture::Difference;
use tinta::styles::{CetFilter, Charcoal, CharcoalRecipe, ContrastOperator, Improvements, Noise, TextureSource};
use tinta::textures::PaperTexture;
use tinta::{Background, CameraSettings, Color, LoadOptions, Picture, Scene, SceneSettings, Show, Size, Style, load};

const EQUAL: Difference = Difference { largest: 0, pixels: 0 };

/// Red, green and blue of all pixels.
fn channels(picture: &Picture) -> impl Iterator<Item = u8> + '_ {
    picture.pixels.chunks_exact(4).flat_map(|pixel| pixel[..3].iter().copied())
}

/// As published, on textures this many texels wide and high, which are quicker to make; of the published size with
/// `TINTA_FULL_SIZES`.
fn with_textures(side: u32) -> Charcoal {
    let published = Charcoal::default();
    let small = Size { width: side, height: side };
    Charcoal { texture_size: if full_sizes() { published.texture_size } else { small }, ..published }
}

fn small() -> Charcoal {
    with_textures(128)
}

fn mean(picture: &Picture) -> f64 {
    channels(picture).map(f64::from).sum::<f64>() / channels(picture).count() as f64
}

#[test]
fn smudging_never_lightens_saturation_never_darkens_and_density_darkens_on_average() {
    let common = small();
    let base = || common.clone();
    for backend in *BACKENDS {
        let mut renderer = renderer(backend);
        let scene = scene("builtin:bust", 200, 200);
        let mut picture = |charcoal: Charcoal| draw(&mut renderer, &scene, &charcoal, Show::Final);
        let plain = picture(base());
        let smudged = picture(Charcoal { smudge: true, ..base() });
        assert!(channels(&plain).zip(channels(&smudged)).all(|(plain, smudged)| smudged <= plain));
        assert!(mean(&smudged) < mean(&plain) - 1.0);
        let mut before = plain;
        for saturation in [1.1, 1.5, 3.0] {
            let after = picture(Charcoal { saturation, ..base() });
            assert!(channels(&before).zip(channels(&after)).all(|(before, after)| before <= after), "{saturation}");
            before = after;
        }
        let means = [0.0, 20.0, 40.0, 60.0, 80.0, 100.0]
            .map(|density_percent| mean(&picture(Charcoal { density_percent, ..base() })));
        assert!(means.is_sorted_by(|a, b| a > b), "{means:?}");
        let [darker, closure] = [CharcoalRecipe::Darker, CharcoalRecipe::Closure]
            .map(|recipe| mean(&picture(Charcoal { texture_size: common.texture_size, ..Charcoal::recipe(recipe) })));
        assert!(darker < means[3] && means[3] < closure, "{darker} {closure}");
    }
}

#[test]
fn the_listing_and_its_parts_draw_the_same_picture() {
    // Luminance belongs to sand, which makes charcoal run in parts without any improved part.
    let improve = Improvements { luminance: true, ..Improvements::default() };
    for backend in *BACKENDS {
        let mut renderer = renderer(backend);
        let scene = scene("builtin:bust", 256, 256);
        for smudge in [false, true] {
            let listing = Charcoal { smudge, ..small() };
            let parts = Charcoal { improve, ..listing.clone() };
            let plans = [&listing, &parts].map(|c| Style::Charcoal(c.clone()).plan(&scene, Show::Final).unwrap());
            assert_ne!(plans[0].to_string(), plans[1].to_string(), "they run different shaders");
            let [listing, parts] = plans.map(|plan| renderer.draw(&scene, &plan).unwrap());
            assert!(listing.difference(&parts).unwrap().largest <= 1, "{backend:?}");
        }
    }
}

#[test]
fn the_same_seed_gives_the_same_bytes_on_both_backends_and_another_seed_another_drawing() {
    let [mut egl, mut osmesa] = BACKENDS.map(renderer);
    let scene = scene("builtin:gear", 150, 100);
    for (name, charcoal) in variants() {
        let again = Charcoal { pictures: Default::default(), ..charcoal.clone() };
        let pictures = [draw(&mut egl, &scene, &charcoal, Show::Final), draw(&mut osmesa, &scene, &again, Show::Final)];
        assert_eq!(pictures[0].difference(&pictures[1]), Some(EQUAL), "{name}");
        let other = draw(&mut egl, &scene, &Charcoal { seed: 77, ..charcoal }, Show::Final);
        assert!(pictures[0].difference(&other).unwrap().pixels > 5000, "{name}");
    }
}

#[test]
fn each_choice_changes_the_drawing_and_every_operator_is_its_formula() {
    let mut renderer = renderer(BACKENDS[0]);
    let scene = scene("builtin:bust", 160, 160);
    let common = with_textures(160);
    let base = || common.clone();
    let plain = draw(&mut renderer, &scene, &base(), Show::Final);
    for other in [
        Charcoal { cet_filter: CetFilter::Mipmap, ..base() },
        Charcoal { noise: Noise::Object, ..base() },
        Charcoal { operator: ContrastOperator::Sigmoid, ..base() },
        Charcoal { cet_exponent: 1.3, ..base() },
        Charcoal { lights: [Some([0.0, 0.0, 1.0]), Some([1.0, 0.0, 0.0])], ..base() },
        Charcoal { lights: [Some([0.26, 0.9, 0.35]), None], ..base() },
    ] {
        let picture = draw(&mut renderer, &scene, &other, Show::Final);
        assert!(picture.difference(&plain).unwrap().pixels > 1000, "{other:?}");
    }
    let light = draw(&mut renderer, &scene, &base(), Show::Diffuse);
    let power = f64::from(base().contrast_exponent);
    let formulas: [(ContrastOperator, &dyn Fn(f64) -> f64); 3] = [
        (ContrastOperator::Power, &|tone| tone.powf(power)),
        (ContrastOperator::Sigmoid, &|tone| tone.powf(power) / (tone.powf(power) + (1.0 - tone).powf(power))),
        (ContrastOperator::Bias, &|tone| tone / (tone + power * (1.0 - tone))),
    ];
    for (operator, formula) in formulas {
        let cem = draw(&mut renderer, &scene, &Charcoal { operator, ..base() }, Show::Cem);
        for (light, cem) in channels(&light).zip(channels(&cem)) {
            let expected = formula(f64::from(light) / 255.0) * 255.0;
            assert!((expected - f64::from(cem)).abs() <= 1.6, "{operator:?} {light} {cem} {expected}");
        }
    }
}

#[test]
fn mipmaps_blur_the_grain_away() {
    let mut renderer = renderer(BACKENDS[0]);
    let scene = ball();
    let mut roughness = |cet_filter| {
        let picture = draw(&mut renderer, &scene, &Charcoal { cet_filter, ..Charcoal::default() }, Show::Cet);
        let row = |y: i64| (45..75).map(move |x| (x, y));
        let step = |(x, y)| f64::from(picture.pixel(x, y)[0].abs_diff(picture.pixel(x + 1, y)[0]));
        (45..75).flat_map(row).map(step).sum::<f64>()
    };
    let (linear, mipmap) = (roughness(CetFilter::Linear), roughness(CetFilter::Mipmap));
    assert!(mipmap < linear * 0.5, "{mipmap} {linear}");
}

#[test]
fn noise_on_the_object_moves_with_it_and_noise_on_the_screen_does_not() {
    let mut renderer = renderer(BACKENDS[0]);
    let still = ball();
    let mut panned = still.clone();
    let pixel = match still.camera.projection {
        tinta::camera::Projection::Parallel { height } => height / f64::from(still.size.height),
        _ => panic!("the ball is seen in parallel projection"),
    };
    let right = still.camera.view_from_world().inverse().transform_vector3(glam::DVec3::X);
    // The camera goes left by seven pixels, so the ball goes right by as many.
    panned.camera.eye -= right * pixel * 7.0;
    panned.camera.target -= right * pixel * 7.0;
    let mut different = |noise| {
        let charcoal = Charcoal { noise, ..Charcoal::default() };
        let [a, b] = [&still, &panned].map(|scene| draw(&mut renderer, scene, &charcoal, Show::Cet));
        let pixels = (40..80).flat_map(|y| (40..80).map(move |x| (x, y)));
        pixels.filter(|&(x, y)| a.pixel(x, y)[0].abs_diff(b.pixel(x + 7, y)[0]) > 24).count()
    };
    let (object, screen) = (different(Noise::Object), different(Noise::Screen));
    assert!(object < 80 && screen > 400, "{object} {screen} of 1600 pixels differ");
}

#[test]
fn specks_in_the_lights_come_from_wrapping_and_go_with_it() {
    let mut renderer = renderer(BACKENDS[0]);
    let scene = ball();
    let lights = [Some([0.0, 0.5, 1.0]), Some([0.3, 0.0, 1.0])];
    let mut dark = |improve| {
        let charcoal = Charcoal { lights, improve, ..small() };
        let (cet, light) = (draw(&mut renderer, &scene, &charcoal, Show::Cet), Show::Diffuse);
        let light = draw(&mut renderer, &scene, &charcoal, light);
        let pairs = cet.pixels.chunks_exact(4).zip(light.pixels.chunks_exact(4));
        pairs.filter(|(cet, light)| light[0] == 255 && cet[0] < 64).count()
    };
    let (published, improved) = (dark("none".parse().unwrap()), dark("wrap".parse().unwrap()));
    assert!(published > 500 && improved * 10 < published, "{published} {improved}");
}

#[test]
fn paper_covers_the_background_unless_it_is_transparent_and_may_be_a_file() {
    let mut renderer = renderer(BACKENDS[0]);
    let size = Size { width: 64, height: 48 };
    let settings = SceneSettings { size, background: Background::Color(Color([1.0, 0.0, 0.0])), ..Default::default() };
    let charcoal = Charcoal { texture_size: size, ..Charcoal::default() };
    let paper = draw(&mut renderer, &scene_with("builtin:gear", settings.clone()), &charcoal, Show::Paper);
    let sheet = PaperTexture { size, ..PaperTexture::default() }.picture().unwrap();
    assert!(paper.difference(&sheet).unwrap().largest <= 1);
    let transparent = SceneSettings { background: Background::Transparent, ..settings.clone() };
    let picture = draw(&mut renderer, &scene_with("builtin:gear", transparent), &charcoal, Show::Final);
    assert_eq!(picture.pixel(0, 0), [0; 4]);
    assert!(picture.pixels.chunks_exact(4).all(|pixel| [0, 255].contains(&pixel[3])));
    let file = tempfile::Builder::new().suffix(".ppm").tempfile().unwrap();
    std::fs::write(file.path(), b"P6 1 1 255\n\xc0\x80\x40").unwrap();
    let charcoal = Charcoal { paper: TextureSource::read(file.path()).unwrap(), ..charcoal };
    let picture = draw(&mut renderer, &scene_with("builtin:gear", settings), &charcoal, Show::Final);
    assert_eq!(picture.pixel(0, 0), [0xc0, 0x80, 0x40, 255]);
    let brightest = picture.pixels.chunks_exact(4).map(|pixel| [pixel[0], pixel[1], pixel[2]]).max().unwrap();
    assert_eq!(brightest, [0xc0, 0x80, 0x40], "nothing is lighter than the paper without saturation");
}

/// A square in the plane z = 0 with a picture of one colour on it, seen straight on.
fn textured_square(ppm_color: [u8; 3]) -> (tempfile::TempDir, Scene) {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    std::fs::write(at("one.ppm"), [b"P6 1 1 255\n".as_slice(), &ppm_color].concat()).unwrap();
    let obj = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3 4/4\n";
    std::fs::write(at("square.obj"), obj).unwrap();
    let options = LoadOptions { skin: Some(at("one.ppm")), ..LoadOptions::default() };
    let mesh = load(at("square.obj").to_str().unwrap(), &options).unwrap().mesh;
    let mut settings = SceneSettings { size: Size { width: 100, height: 100 }, ..SceneSettings::default() };
    settings.camera = CameraSettings { view: "front".parse().unwrap(), parallel: true, ..settings.camera };
    let scene = Scene::new(vec![Arc::new(mesh)], &settings).unwrap();
    // The picture is read when it is drawn with.
    (folder, scene)
}

#[test]
fn sand_is_the_drawing_mixed_with_sepia_by_the_printed_weights_or_rec_709s() {
    let (_folder, scene) = textured_square([200, 100, 50]);
    let color = [200.0, 100.0, 50.0].map(|value: f64| value / 255.0);
    let weighted = |weights: [f64; 3], alpha: f64| weights.iter().zip(color).map(|(w, c)| w * c).sum::<f64>() + alpha;
    let cases = [
        (Improvements::default(), weighted([0.1125, 0.0154, 0.0721], 1.0)),
        ("luminance".parse().unwrap(), weighted([0.2125, 0.7154, 0.0721], 0.0)),
    ];
    for backend in *BACKENDS {
        let mut renderer = renderer(backend);
        for (improve, luminance) in cases {
            let charcoal = Charcoal { improve, ..small() };
            let drawing = draw(&mut renderer, &scene, &charcoal, Show::Final);
            let plan = Style::Sand(charcoal).plan(&scene, Show::Final).unwrap();
            let sand = renderer.draw(&scene, &plan).unwrap();
            let sepia = [1.2, 1.0, 0.8].map(|factor| luminance * factor);
            for (x, y) in [(50, 50), (20, 70), (70, 30), (33, 44)] {
                for (channel, sepia) in sepia.iter().enumerate() {
                    let expected = f64::from(drawing.pixel(x, y)[channel]) * 0.4 + sepia * 255.0 * 0.6;
                    let actual = f64::from(sand.pixel(x, y)[channel]);
                    // The drawing was rounded before it was mixed here.
                    assert!((expected.min(255.0) - actual).abs() <= 1.0, "{backend:?} {expected} {actual}");
                }
            }
            assert_eq!(sand.pixel(0, 0), drawing.pixel(0, 0), "the paper is the same");
        }
    }
}

#[test]
fn sand_without_texture_coordinates_or_a_picture_is_refused_with_that_sentence() {
    let refused = Style::Sand(Charcoal::default()).plan(&scene("builtin:gear", 9, 9), Show::Final).unwrap_err();
    let refused = refused.to_string();
    for words in ["style sand", "builtin:gear has no texture coordinates", "--skin", "--style charcoal"] {
        assert!(refused.contains(words), "{refused}");
    }
}
