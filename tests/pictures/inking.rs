//! The styles inking and dietrich, drawn: against closed forms, against each other's variants, in every option.

use crate::support::lines::{px, view};
use crate::support::shapes::{cuboid, icosphere, shaded};
use crate::support::{BACKENDS, renderer, root, scene, scene_with};
use glam::{DVec2, DVec3};
use std::sync::Arc;
use tinta::edges::{Class, ClassSet, SilhouetteRule};
use tinta::lines::Length;
use tinta::mesh::Normals;
use tinta::picture::Difference;
use tinta::plan::LineDrawing;
use tinta::styles::{ClassColors, Dietrich, Inking, LightOn, PaintMode, Ramp, RampRow};
use tinta::{Backend, Background, LoadOptions, Mesh, Picture, Renderer, Scene, SceneSettings, Show, Size, Style, load};

const EQUAL: Difference = Difference { largest: 0, pixels: 0 };

fn draw(renderer: &mut Renderer, scene: &Scene, style: Inking, show: Show) -> Picture {
    let plan = Style::Inking(style).plan(scene, show).unwrap();
    renderer.draw(scene, &plan).unwrap()
}

/// Where a world-space point falls in the picture, pixels from the upper left.
fn pixel(scene: &Scene, point: DVec3) -> (i64, i64) {
    let DVec2 { x, y } = px(scene, point);
    (x as i64, y as i64)
}

#[test]
fn of_a_boxs_twelve_edges_the_nine_that_are_seen_are_drawn_and_the_others_hidden() {
    let mesh = shaded(&cuboid(DVec3::ZERO, DVec3::new(1.0, 1.2, 1.4)));
    let camera = view("iso", false);
    let size = Size { width: 240, height: 240 };
    let scene = Scene::new(vec![mesh.clone()], &SceneSettings { camera, size, ..SceneSettings::default() }).unwrap();
    let eye = scene.camera.eye;
    for backend in *BACKENDS {
        let mut renderer = renderer(backend);
        for line_drawing in [LineDrawing::Gl, LineDrawing::Quads] {
            let style = Inking { line_drawing, paint: PaintMode::None, ..Inking::default() };
            let picture = draw(&mut renderer, &scene, style, Show::Final);
            let (mut seen, mut hidden) = (0, 0);
            let (low, high) = mesh.bounds();
            for edge in scene.edges(&scene.objects[0]).list().positions() {
                let [a, b] = edge.map(|position| mesh.positions[position as usize]);
                if (b - a).to_array().iter().filter(|x| **x != 0.0).count() > 1 {
                    continue;
                }
                let middle = (a + b) * 0.5;
                // An edge is seen where either of the two sides it lies on faces the eye.
                let faces_eye = |axis: usize| match middle[axis] {
                    x if x == low[axis] => eye[axis] < low[axis],
                    x if x == high[axis] => eye[axis] > high[axis],
                    _ => false,
                };
                let (x, y) = pixel(&scene, middle);
                let dark = (-2..=2).flat_map(|dx| (-2..=2).map(move |dy| (dx, dy)));
                let is_drawn = dark.clone().any(|(dx, dy)| picture.pixel(x + dx, y + dy)[0] < 100);
                assert_eq!(is_drawn, (0..3).any(faces_eye), "{backend:?} {line_drawing:?} edge {a} {b}");
                if is_drawn { seen += 1 } else { hidden += 1 }
            }
            assert_eq!((seen, hidden), (9, 3));
        }
    }
}

#[test]
fn ink_paint_and_both_are_the_texts_three_options() {
    let mut renderer = renderer(BACKENDS[0]);
    let scene = scene("builtin:bust", 200, 200);
    let style = |is_inked, paint| Inking { is_inked, paint, ..Inking::default() };
    let both = draw(&mut renderer, &scene, style(true, PaintMode::Ramp), Show::Final);
    let paint = draw(&mut renderer, &scene, style(false, PaintMode::Ramp), Show::Final);
    let ink = draw(&mut renderer, &scene, style(true, PaintMode::None), Show::Final);
    assert_eq!(draw(&mut renderer, &scene, style(true, PaintMode::Ramp), Show::Tones).difference(&paint), Some(EQUAL));
    assert_eq!(draw(&mut renderer, &scene, style(true, PaintMode::Ramp), Show::Borders).difference(&ink), Some(EQUAL));
    // Without ink, `both` is the paint; where ink covers a pixel wholly, `both` is the ink.
    let triples = both.pixels.chunks_exact(4).zip(paint.pixels.chunks_exact(4)).zip(ink.pixels.chunks_exact(4));
    let (mut painted, mut inked) = (0, 0);
    for ((both, paint), ink) in triples {
        if ink[0] == 255 && paint[0] < 255 {
            assert_eq!(both, paint);
            painted += 1;
        } else if ink[0] == 0 {
            assert_eq!(both, ink);
            inked += 1;
        }
    }
    assert!(painted > 5000 && inked > 200, "{painted} {inked}");
}

#[test]
fn paint_has_three_tones_a_gradient_and_stays_within_its_rows() {
    let mut renderer = renderer(BACKENDS[0]);
    let scene = scene("builtin:bust", 200, 200);
    for row in 0..4 {
        let style = Inking { ramp_row: RampRow::Row(row), is_inked: false, ..Inking::default() };
        let picture = draw(&mut renderer, &scene, style.clone(), Show::Final);
        let ramp = &style.ramp.picture;
        let y = i64::from(u32::from(row) * ramp.size.height / 4 + 5);
        let tones: std::collections::BTreeSet<[u8; 4]> =
            (0..i64::from(ramp.size.width)).map(|x| ramp.pixel(x, y)).collect();
        assert_eq!(colors(&picture), tones.iter().map(|tone| [tone[0], tone[1], tone[2]]).collect(), "row {row}");
    }
}

#[test]
fn by_the_texts_normals_painted_pixels_get_another_tone() {
    // Errata D12: the shares it prints.
    let mut renderer = renderer(BACKENDS[0]);
    let settings = SceneSettings { size: Size { width: 512, height: 512 }, ..SceneSettings::default() };
    let style = Inking { is_inked: false, ..Inking::default() };
    let mut painted = |model: &str, normals, smooth_angle_degrees| {
        let options = LoadOptions { normals, smooth_angle_degrees, ..LoadOptions::default() };
        let path = if model.starts_with("builtin:") { model.into() } else { root().join(model).display().to_string() };
        let mesh = Arc::new(load(&path, &options).unwrap().mesh);
        draw(&mut renderer, &Scene::new(vec![mesh], &settings).unwrap(), style.clone(), Show::Final)
    };
    let mut wrong = Vec::new();
    // Percent against the default and against its weights without splitting.
    for (model, expected) in [
        ("builtin:bust", [17.4, 11.5]),
        ("builtin:ant", [6.3, 4.1]),
        ("builtin:gear", [42.4, 10.8]),
        ("builtin:open-box", [1.7, 1.5]),
        ("models/pawn.obj", [39.2, 20.4]),
    ] {
        let text = painted(model, Normals::Dachsbacher, 60.0);
        let others = [painted(model, Normals::File, 60.0), painted(model, Normals::Smooth, 180.0)];
        let shares = others.map(|other| {
            let pairs = || text.pixels.chunks_exact(4).zip(other.pixels.chunks_exact(4));
            let painted = pairs().filter(|(a, b)| *a != [255; 4] || *b != [255; 4]).count();
            pairs().filter(|(a, b)| a != b).count() as f64 / painted as f64 * 100.0
        });
        let is_as_printed = shares.iter().zip(expected).all(|(share, expected)| (share - expected).abs() < 1.0);
        if !is_as_printed {
            wrong.push(format!("{model}: {shares:.1?} % of the painted pixels, {expected:?} are printed"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// The colours of a picture's faces.
fn colors(picture: &Picture) -> std::collections::BTreeSet<[u8; 3]> {
    let of_pixel = |pixel: &[u8]| [pixel[0], pixel[1], pixel[2]];
    picture.pixels.chunks_exact(4).map(of_pixel).filter(|color| *color != [255; 3]).collect()
}

#[test]
fn of_the_three_shadings_only_gourauds_has_more_colours_than_the_ramp() {
    // The text's argument for the texture: flat shading shows the triangles, Gouraud's makes colours run into each other.
    let scene = scene("builtin:bust", 200, 200);
    for backend in *BACKENDS {
        let mut renderer = renderer(backend);
        let mut painted = |paint| {
            let style = Inking { paint, ramp_row: RampRow::Row(1), is_inked: false, ..Inking::default() };
            draw(&mut renderer, &scene, style, Show::Final)
        };
        let [flat, gouraud, ramp] = [PaintMode::FlatShaded, PaintMode::Gouraud, PaintMode::Ramp].map(&mut painted);
        assert_eq!((colors(&flat).len(), colors(&ramp).len()), (3, 3), "{backend:?}");
        assert_eq!(colors(&flat), colors(&ramp));
        let mixed = colors(&gouraud);
        assert!(mixed.len() > 60 && mixed.is_superset(&colors(&ramp)), "{backend:?}: {} colours", mixed.len());
        // The light is the same: most pixels agree.
        let pairs = || ramp.pixels.chunks_exact(4).zip(gouraud.pixels.chunks_exact(4).zip(flat.pixels.chunks_exact(4)));
        let covered = pairs().filter(|(ramp, _)| **ramp != [255; 4]).count();
        let as_gouraud = pairs().filter(|(ramp, (gouraud, _))| **ramp != [255; 4] && ramp == gouraud).count();
        let as_flat = pairs().filter(|(ramp, (_, flat))| **ramp != [255; 4] && ramp == flat).count();
        assert!(as_gouraud * 10 > covered * 4 && as_flat * 10 > covered * 6, "{as_gouraud} and {as_flat} of {covered}");
    }
}

#[test]
fn a_gradient_for_each_colour_paints_every_material_in_three_tones_of_its_own() {
    let scene = scene("builtin:bust", 200, 200);
    let own = [PaintMode::Ramp, PaintMode::FlatShaded, PaintMode::Gouraud];
    let own = own.map(|paint| Inking { ramp_row: RampRow::Own, is_inked: false, paint, ..Inking::default() });
    let flat = Inking { paint: PaintMode::Flat, is_inked: false, ..Inking::default() };
    for backend in *BACKENDS {
        let mut renderer = renderer(backend);
        let [ramp, flat_shaded, gouraud] =
            own.clone().map(|style| colors(&draw(&mut renderer, &scene, style, Show::Final)));
        // The materials' colours are the middle tones.
        let materials = colors(&draw(&mut renderer, &scene, flat.clone(), Show::Final));
        assert!(
            ramp.len() > 20 && ramp.len() <= 3 * materials.len(),
            "{backend:?}: {} of {}",
            ramp.len(),
            materials.len()
        );
        assert!(materials.intersection(&ramp).count() >= 8, "{backend:?}: {materials:?} and {ramp:?}");
        assert!(flat_shaded.len() <= 3 * materials.len() && gouraud.len() > 10 * materials.len(), "{backend:?}");
    }
}

#[test]
fn flat_shading_gives_each_side_of_a_box_the_tone_of_its_light() {
    let mesh = shaded(&cuboid(DVec3::ZERO, DVec3::new(1.0, 1.2, 1.4)));
    let camera = view("iso", false);
    let size = Size { width: 120, height: 120 };
    let scene = Scene::new(vec![mesh.clone()], &SceneSettings { camera, size, ..SceneSettings::default() }).unwrap();
    let mut renderer = renderer(BACKENDS[0]);
    for paint in [PaintMode::FlatShaded, PaintMode::Gouraud] {
        let style = Inking { paint, ramp_row: RampRow::Row(0), is_inked: false, ..Inking::default() };
        let picture = draw(&mut renderer, &scene, style.clone(), Show::Final);
        let light = scene.camera.view_from_world().transpose().transform_vector3(DVec3::new(0.0, 1.0, 1.0).normalize());
        let (low, high) = mesh.bounds();
        for axis in [DVec3::X, DVec3::Y, DVec3::Z] {
            // With its own corners' normals Gouraud interpolation mixes equal colours.
            let middle = (low + high) * 0.5 + axis * (high - low) * 0.5;
            let (x, y) = pixel(&scene, middle);
            let bright = axis.dot(light).clamp(0.1, 0.9);
            let expected = style.ramp.picture.pixel((bright * 256.0) as i64, 5);
            let actual = picture.pixel(x, y);
            let is_near = expected.iter().zip(actual).all(|(a, b)| a.abs_diff(b) <= 1);
            assert!(is_near, "{paint}, the side towards {axis}: {actual:?} instead of {expected:?}");
        }
    }
}

#[test]
fn light_from_the_vertex_shader_paints_what_light_from_the_cpu_does() {
    for backend in *BACKENDS {
        let mut renderer = renderer(backend);
        let scene = scene("builtin:ant", 200, 200);
        let [cpu, shader] = [LightOn::Cpu, LightOn::VertexShader]
            .map(|light| draw(&mut renderer, &scene, Inking { light, ..Inking::default() }, Show::Final));
        // Rounding moves a tone's edge by a pixel here and there.
        let different = cpu.difference(&shader).unwrap().pixels;
        assert!(different < scene.size.pixel_count() / 400, "{backend:?}: {different} pixels");
    }
}

#[test]
fn quads_have_their_width() {
    for backend in *BACKENDS {
        let mut renderer = renderer(backend);
        // One edge across the picture, seen straight on.
        let mut settings = SceneSettings { size: Size { width: 200, height: 120 }, ..SceneSettings::default() };
        settings.camera = view("front", true);
        let slab = shaded(&cuboid(DVec3::new(-3.0, -1.0, 0.0), DVec3::new(3.0, 1.0, 1.0)));
        let scene = Scene::new(vec![slab], &settings).unwrap();
        for width in [1.0, 4.0, 10.0, 40.0] {
            let style = Inking {
                line_drawing: LineDrawing::Quads,
                line_width: Length::Px(width),
                is_smooth: false,
                ..Inking::default()
            };
            let picture = draw(&mut renderer, &scene, style, Show::Borders);
            let (_, y) = pixel(&scene, DVec3::new(0.0, 1.0, 1.0));
            let dark = (y - 30..y + 30).filter(|y| picture.pixel(100, *y)[0] < 128).count();
            assert_eq!(dark, width as usize, "{backend:?}");
        }
    }
}

#[test]
fn lines_wider_than_the_driver_draws_are_quads_and_said_so_once() {
    let mut renderer = renderer(BACKENDS[0]);
    let scene = scene("builtin:gear", 64, 64);
    let widest = f64::from(renderer.context().smooth_line_width[1]);
    let plan = |width, line_drawing| {
        Style::Inking(Inking { line_width: Length::Px(width), line_drawing, ..Inking::default() })
            .plan(&scene, Show::Final)
            .unwrap()
    };
    assert!(renderer.remarks(&plan(2.0, LineDrawing::Gl)).is_empty());
    let wide = plan(widest + 1.0, LineDrawing::Gl);
    let remarks = renderer.remarks(&wide);
    assert_eq!(remarks.len(), 1, "{remarks:?}");
    assert!(remarks[0].contains("drawn as quads"), "{remarks:?}");
    renderer.draw(&scene, &wide).unwrap();
    assert!(renderer.remarks(&plan(widest + 1.0, LineDrawing::Quads)).is_empty(), "that is what was asked for");
}

#[test]
fn the_open_box_of_figure_6_has_red_outer_and_blue_inner_lines() {
    let mut renderer = renderer(BACKENDS[0]);
    let scene = scene("builtin:open-box", 200, 200);
    let style = Inking { colors: ClassColors::figure_6(), paint: PaintMode::None, ..Inking::default() };
    let picture = draw(&mut renderer, &scene, style.clone(), Show::Final);
    let count = |is: &dyn Fn(&[u8]) -> bool| picture.pixels.chunks_exact(4).filter(|pixel| is(pixel)).count();
    let red = count(&|pixel| pixel[0] > 200 && pixel[1] < 60 && pixel[2] < 60);
    let blue = count(&|pixel| pixel[0] < 60 && pixel[1] < 90 && pixel[2] > 200);
    assert!(red > blue && blue > 60, "{red} red, {blue} blue");
    let creases = Inking { classes: ClassSet::of(&[Class::Crease]), ..style };
    let text = Style::Inking(creases).plan(&scene, Show::Final).unwrap().to_string();
    assert!(text.contains("8 crease edges") && !text.contains("boundary"), "{text}");
}

#[test]
fn the_plan_says_what_the_text_does() {
    // Two sides are visible: two upright edges and two at the bottom separate them from the hidden ones.
    let scene = scene("builtin:open-box", 100, 100);
    let text = Style::Inking(Inking { paint: PaintMode::None, ..Inking::default() }).plan(&scene, Show::Final).unwrap();
    let expected = "\
pass 1: paint
  clear to (1, 1, 1, 1), depth to 1
  draw the objects in (1, 1, 1, 1) without shaders, pushed back by (1, 5)
pass 2: ink
  draw smooth lines of 2 px at 4 boundary edges in (0, 0, 0, 1), 4 silhouette edges in (0, 0, 0, 1), 4 crease edges in \
(0, 0, 0, 1) without shaders, blended
  draw smooth points of 2 px at 4 boundary edges in (0, 0, 0, 1), 4 silhouette edges in (0, 0, 0, 1), 4 crease edges in \
(0, 0, 0, 1) without shaders, blended
picture: the framebuffer
";
    assert_eq!(text.to_string(), expected);
}

#[test]
fn lines_that_only_test_depth_close_the_gaps_between_smoothed_ones() {
    // Errata D11.
    let mut settings = SceneSettings { size: Size { width: 240, height: 240 }, ..SceneSettings::default() };
    settings.camera = view("front", true);
    let scene = scene_with("builtin:gear", settings);
    for backend in *BACKENDS {
        let mut renderer = renderer(backend);
        let [written, tested] = [true, false].map(|writes_depth| {
            let style = Inking { writes_depth, silhouette: SilhouetteRule::Exact, ..Inking::default() };
            draw(&mut renderer, &scene, style, Show::Borders)
        });
        let pairs = || written.pixels.chunks_exact(4).zip(tested.pixels.chunks_exact(4)).map(|(a, b)| (a[0], b[0]));
        assert!(pairs().all(|(written, tested)| tested <= written), "ink is only added");
        let closed = pairs().filter(|(written, tested)| written - tested > 100).count();
        assert!(closed > 200, "{backend:?}: {closed} pixels");
    }
}

#[test]
fn the_models_own_picture_is_multiplied_into_the_paint() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    // Two by two texels: red, green above blue, white.
    let ppm = b"P6 2 2 255\n\xff\0\0\0\xff\0\0\0\xff\xff\xff\xff";
    std::fs::write(at("four.ppm"), ppm).unwrap();
    let obj = "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nusemtl m\nf 1/1 2/2 3/3 4/4\n";
    std::fs::write(at("square.obj"), obj).unwrap();
    std::fs::write(at("m.mtl"), "newmtl m\nmap_Kd four.ppm\n").unwrap();
    let options = LoadOptions { skin: Some(at("four.ppm")), ..LoadOptions::default() };
    let mesh = load(at("square.obj").to_str().unwrap(), &options).unwrap().mesh;
    let mut settings = SceneSettings { size: Size { width: 100, height: 100 }, ..SceneSettings::default() };
    settings.camera = view("front", true);
    settings.color = Some(tinta::Color([1.0, 1.0, 0.5]));
    let scene = Scene::new(vec![Arc::new(mesh)], &settings).unwrap();
    for backend in *BACKENDS {
        let mut renderer = renderer(backend);
        let flat = Inking { paint: PaintMode::Flat, has_texture: true, is_inked: false, ..Inking::default() };
        let picture = draw(&mut renderer, &scene, flat.clone(), Show::Final);
        let quarter = |x, y| picture.pixel(x, y)[..3].to_vec();
        // In the middle of each texel the picture's colour multiplied by the object's.
        let expected = [[255, 0, 0], [0, 255, 0], [0, 0, 128], [255, 255, 128]];
        for ((x, y), expected) in [(27, 27), (73, 27), (27, 73), (73, 73)].into_iter().zip(expected) {
            let close = quarter(x, y).iter().zip(expected).all(|(a, b)| a.abs_diff(b) <= 8);
            assert!(close, "{backend:?} at {x},{y}: {:?}, not {expected:?}", quarter(x, y));
        }
        // On the second unit, behind the ramp.
        let ramp = Inking { paint: PaintMode::Ramp, ramp_row: RampRow::Row(1), ..flat };
        let picture = draw(&mut renderer, &scene, ramp, Show::Final);
        assert!(picture.pixel(27, 27)[0] > 100 && picture.pixel(27, 27)[1] < 10, "{:?}", picture.pixel(27, 27));
    }
    let without = Style::Inking(Inking { has_texture: true, ..Inking::default() });
    let refused = without.plan(&crate::support::scene("builtin:gear", 9, 9), Show::Final).unwrap_err().to_string();
    assert!(refused.contains("--skin"), "{refused}");
}

#[test]
fn ink_on_nothing_is_ink_and_nothing_else() {
    let mut renderer = renderer(BACKENDS[0]);
    let settings = SceneSettings {
        size: Size { width: 120, height: 120 },
        background: Background::Transparent,
        ..SceneSettings::default()
    };
    let scene = scene_with("builtin:gear", settings);
    let picture = draw(&mut renderer, &scene, Inking { paint: PaintMode::None, ..Inking::default() }, Show::Final);
    let pixels = || picture.pixels.chunks_exact(4);
    assert!(pixels().all(|pixel| pixel[..3] == [0; 3]), "black ink or nothing");
    assert!(pixels().filter(|pixel| pixel[3] == 255).count() > 100 && pixels().any(|pixel| pixel[3] == 0));
}

#[test]
fn dietrichs_ink_on_a_sphere_is_the_rim_its_threshold_says() {
    let mut settings = SceneSettings { size: Size { width: 400, height: 400 }, ..SceneSettings::default() };
    settings.camera.parallel = true;
    let scene = Scene::new(vec![shaded(&icosphere(5))], &settings).unwrap();
    for backend in *BACKENDS {
        let mut renderer = renderer(backend);
        for threshold in [0.1f32, 0.25, 0.5, 0.9] {
            let style = Style::Dietrich(Dietrich { threshold, ..Dietrich::default() });
            let picture = renderer.draw(&scene, &style.plan(&scene, Show::Final).unwrap()).unwrap();
            let pixels = || picture.pixels.chunks_exact(4);
            let ink = pixels().filter(|pixel| pixel[..3] == [0; 3]).count();
            let disc = pixels().filter(|pixel| pixel[..3] != [255; 3]).count();
            // N.V = sqrt(1 - r^2) in a parallel view, so the rim is the share threshold^2 of the disc.
            let share = ink as f64 / disc as f64;
            let expected = f64::from(threshold * threshold);
            assert!((share - expected).abs() < 0.004, "{backend:?} {threshold}: {share} instead of {expected}");
        }
    }
}

#[test]
fn nonsense_is_refused_by_the_options_name() {
    let scene = scene("builtin:gear", 9, 9);
    let refused = |style: Inking, show| Style::Inking(style).plan(&scene, show).unwrap_err().to_string();
    let base = Inking::default;
    for width in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(refused(Inking { line_width: Length::Px(width), ..base() }, Show::Final).starts_with("line-width"));
    }
    assert!(refused(Inking { polygon_offset: [f32::NAN, 5.0], ..base() }, Show::Final).starts_with("polygon-offset"));
    assert!(refused(base(), Show::Map).starts_with("show"));
    let picture = Arc::new(Picture { size: Size { width: 1, height: 4 }, pixels: vec![90; 16] });
    let ramp = Ramp { picture, rows: 4, path: None };
    let both = refused(Inking { ramp_row: RampRow::Own, ramp, ..base() }, Show::Final);
    assert!(both.starts_with("ramp-row own: ") && both.contains("leave out this or --ramp"), "{both}");
    assert!(refused(Inking { is_inked: false, ..base() }, Show::Borders).starts_with("show borders"));
    let dietrich = Style::Dietrich(Dietrich { threshold: 1.5, ..Dietrich::default() });
    assert!(dietrich.plan(&scene, Show::Final).unwrap_err().to_string().starts_with("ink-threshold 1.5"));
    assert!("silhouette".parse::<ClassColors>().is_err() && "edge=red".parse::<ClassColors>().is_err());
    let colors: ClassColors = "silhouette=red,crease=#0000ff".parse().unwrap();
    assert_eq!(colors.of_class(Class::Crease), tinta::Color([0.0, 0.0, 1.0]));
    let layers = refused(Inking { colors: "crease=red,hidden=blue".parse().unwrap(), ..base() }, Show::Final);
    assert!(layers.starts_with("class-colors hidden: only drawings by style lines"), "{layers}");
}

fn check_order(backends: &[Backend]) {
    // Smoothed lines once took the polygon offset from the next frame's faces.
    for &backend in backends {
        let mut renderer = renderer(backend);
        let scene = scene("builtin:gear", 64, 64);
        let mut styles: Vec<Style> = crate::support::styles().into_iter().map(|(_, style)| style).collect();
        styles.push(Style::Inking(Inking { is_smooth: false, cull_back_faces: true, ..Inking::default() }));
        styles.push(Style::Inking(Inking { line_drawing: LineDrawing::Quads, ..Inking::default() }));
        let first: Vec<Picture> =
            styles.iter().map(|style| crate::support::renderer(backend).render(&scene, style).unwrap()).collect();
        for before in &styles {
            for (style, first) in styles.iter().zip(&first) {
                renderer.render(&scene, before).unwrap();
                let again = renderer.render(&scene, style).unwrap();
                assert_eq!(first.difference(&again), Some(EQUAL), "{backend:?}: {style:?} after {before:?}");
            }
        }
    }
}

#[test]
fn what_was_drawn_before_changes_nothing_by_egl_briefly() {
    check_order(&BACKENDS[..1]);
}

#[test]
#[ignore = "exhaustive: every style after every other, by both backends"]
fn what_was_drawn_before_changes_nothing() {
    check_order(&*BACKENDS);
}

/// A cube from -1 to 1 seen from above, with a curve and two points of the given heights; the curve passes beyond the cube.
fn with_free_lines(heights: [f64; 3]) -> Scene {
    let curve = vec![DVec3::new(-2.0, heights[0], 0.5), DVec3::new(2.0, heights[0], 0.5)];
    let points = [DVec3::new(-0.5, heights[1], -0.5), DVec3::new(2.0, heights[2], -0.5)];
    let free = Mesh::of_curves("free", &[curve], &points, &[], &LoadOptions::default()).unwrap();
    let camera = view("top", true);
    let size = Size { width: 200, height: 200 };
    let settings = SceneSettings { camera, size, ..SceneSettings::default() };
    Scene::new([shaded(&cuboid(-DVec3::ONE, DVec3::ONE)), free], &settings).unwrap()
}

#[test]
fn curves_and_points_are_inked_in_front_of_faces_and_beside_them_and_not_behind() {
    let mut colors = ClassColors::default();
    for (class, color) in [(Class::Curve, [1.0, 0.0, 0.0]), (Class::Point, [0.0, 0.0, 1.0])] {
        colors.0.set_class(class, tinta::scene::Color(color));
    }
    for backend in *BACKENDS {
        let mut renderer = renderer(backend);
        for line_drawing in [LineDrawing::Gl, LineDrawing::Quads] {
            for has_joints in [true, false] {
                for height in [-1.5, 1.0, 1.5] {
                    let scene = with_free_lines([height; 3]);
                    let style =
                        Inking { line_drawing, has_joints, colors, paint: PaintMode::None, ..Inking::default() };
                    let picture = draw(&mut renderer, &scene, style, Show::Final);
                    let has = |point: DVec3, color: [bool; 3]| {
                        let (x, y) = pixel(&scene, point);
                        let near = (-1..=1).flat_map(|dx| (-1..=1).map(move |dy| (dx, dy)));
                        let mut drawn = near.map(|(dx, dy)| picture.pixel(x + dx, y + dy));
                        drawn.any(|drawn| (0..3).all(|channel| (drawn[channel] > 128) == color[channel]))
                    };
                    let (red, blue) = ([true, false, false], [false, false, true]);
                    let found = [
                        has(DVec3::new(0.2, height, 0.5), red),
                        has(DVec3::new(1.5, height, 0.5), red),
                        has(DVec3::new(-0.5, height, -0.5), blue),
                        has(DVec3::new(2.0, height, -0.5), blue),
                    ];
                    let is_above = height > 0.0;
                    assert_eq!(
                        found,
                        [is_above, true, is_above, true],
                        "{backend:?} {line_drawing:?} joints {has_joints}, at height {height}"
                    );
                }
            }
        }
    }
}

#[test]
fn inking_without_curve_and_point_leaves_them_out() {
    let mut renderer = renderer(BACKENDS[0]);
    let scene = with_free_lines([1.5; 3]);
    let bare = Scene { objects: scene.objects[..1].to_vec(), ..scene.clone() };
    let draw = |renderer: &mut Renderer, scene: &Scene, classes| {
        draw(renderer, scene, Inking { classes, ..Inking::default() }, Show::Final)
    };
    let all = Inking::default().classes;
    let without = all.without(&[Class::Curve, Class::Point]);
    let expected = draw(&mut renderer, &bare, all);
    assert!(draw(&mut renderer, &scene, without) == expected);
    assert!(draw(&mut renderer, &bare, without) == expected, "the classes change no picture of a model without curves");
    for class in [Class::Curve, Class::Point] {
        assert!(draw(&mut renderer, &scene, all.without(&[class])) != expected);
    }
}
