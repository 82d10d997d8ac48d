//! What plans state of their draws: the pruner goes by that alone, of anybody's shaders, and by nothing once one is replaced.

use crate::prune::every_rule;
use crate::support::{BACKENDS, ball, renderer, root, scene};
use std::collections::{HashMap, HashSet};
use tinta::plan::prune::{Pruned, Pruning, Rule, prune};
use tinta::plan::{Draw, Facts, Plan, Program, Step, Target};
use tinta::styles::{Cartoon, Charcoal, Dietrich, Ink, MapEncoding, Mrt, Phong};
use tinta::{Error, Renderer, Scene, Show, Style, StyleName};

const ALL_INK: &str = "#version 120\nvoid main() { gl_FragColor = vec4(0.0, 0.0, 0.0, 1.0); }\n";

/// A model that fills little of its picture.
fn far_away(model: &str) -> Scene {
    let mut scene = scene(model, 128, 96);
    scene.camera.eye = scene.centre + (scene.camera.eye - scene.centre) * 3.0;
    scene.camera.far *= 3.0;
    scene
}

fn replace(renderer: &mut Renderer, path: &str, text: &str) {
    renderer.replace_shaders(HashMap::from([(path.to_owned(), text.to_owned())])).unwrap();
}

fn draws_mut(plan: &mut Plan) -> impl Iterator<Item = &mut Draw> {
    let steps = plan.passes.iter_mut().flat_map(|pass| &mut pass.steps);
    steps.filter_map(|step| if let Step::Draw(draw) = step { Some(draw) } else { None })
}

fn left_out(pruned: &Pruned) -> Vec<Rule> {
    pruned.omissions.iter().map(|omission| omission.rule).collect()
}

#[test]
fn a_border_shader_replaced_by_one_that_inks_all_of_the_picture_inks_all_of_it() {
    let scene = far_away("builtin:gear");
    let style = Style::named(StyleName::ThreePass);
    let plan = style.plan(&scene, Show::Final).unwrap();
    for backend in BACKENDS {
        let mut renderer = renderer(backend);
        let published = renderer.render(&scene, &style).unwrap();
        replace(&mut renderer, "evangelista/border.frag", ALL_INK);
        let full = renderer.draw(&scene, &plan).unwrap();
        assert!(full.pixels.chunks_exact(4).all(|pixel| *pixel == [0, 0, 0, u8::MAX]));
        assert!(renderer.render(&scene, &style).unwrap() == full, "{backend:?}: confined to the objects");
        let short = prune(&plan, &scene, &renderer.pruning(u32::MAX));
        assert!(!left_out(&short).contains(&Rule::EmptyPixels));
        assert!(left_out(&short).contains(&Rule::BackgroundSquare), "the other shaders are as they were");
        // Given back, it is confined again.
        renderer.replace_shaders(HashMap::new()).unwrap();
        assert!(left_out(&prune(&plan, &scene, &renderer.pruning(1))).contains(&Rule::EmptyPixels));
        assert!(renderer.render(&scene, &style).unwrap() == published);
    }
}

#[test]
fn whatever_shader_is_replaced_the_short_plan_draws_what_the_full_one_does() {
    let one_tone = {
        let mut cartoon = Cartoon::default();
        cartoon.tones.count = 1;
        cartoon
    };
    let larger =
        |text: &str| text.replace("gl_Position=ftransform()", "gl_Position=ftransform()*vec4(3.0,3.0,1.0,1.0)");
    let source = |path: &str| tinta::glsl::source(path).unwrap().to_owned();
    let in_stripes = "#version 120\nvoid main() { gl_FragColor = vec4(mod(floor(gl_FragCoord.x), 2.0)); }\n";
    let holed =
        "#version 120\nvoid main() { if (mod(gl_FragCoord.x, 4.0) < 2.0) discard; gl_FragColor = vec4(0.5); }\n";
    let dark = "#version 120\nfloat toneOf(float diffuse, float specular) { return 0.25; }\n";
    let three = Style::named(StyleName::ThreePass);
    let cases: [(&str, String, Style); 9] = [
        // Borders where the map is no longer even, and beyond where objects are.
        ("evangelista/map.frag", in_stripes.to_owned(), three.clone()),
        ("evangelista/map.frag", in_stripes.to_owned(), Style::named(StyleName::TwoPass)),
        ("evangelista/map.vert", larger(&source("evangelista/map.vert")), three.clone()),
        ("evangelista/toon.vert", larger(&source("evangelista/toon.vert")), three),
        ("improved/plane-map.frag", in_stripes.to_owned(), Style::Ink(Ink::default())),
        ("improved/plane-ink.frag", ALL_INK.to_owned(), Style::Ink(Ink::default())),
        (
            "improved/two-targets.vert",
            source("improved/two-targets.vert").replace("ftransform()", "vec4(0.0)"),
            Style::Mrt(Mrt::default()),
        ),
        // A part of the shorter program only: the longer one is as it was.
        ("improved/tone-one.frag", dark.to_owned(), Style::ThreePass(one_tone)),
        ("valente/paper.frag", holed.to_owned(), Style::Charcoal(Charcoal::default())),
    ];
    let mut renderer = renderer(BACKENDS[0]);
    for (path, text, style) in cases {
        let scene = far_away("builtin:gear");
        replace(&mut renderer, path, &text);
        let plan = style.plan(&scene, Show::Final).unwrap();
        let full = renderer.draw(&scene, &plan).unwrap();
        for is_software in [true, false] {
            let short = prune(&plan, &scene, &Pruning { is_software, ..renderer.pruning(u32::MAX) }).plan;
            assert!(renderer.draw(&scene, &short).unwrap() == full, "{path} in {}\n{short:#}", style.name());
        }
    }
    // Through the holes one sees the faces behind.
    let (scene, style) = (ball(4), Style::Phong(Phong::default()));
    let behind = source("phong/phong.frag").replace("void main() {", "void main() { if (gl_FrontFacing) discard;");
    assert!(behind.contains("discard"));
    let plan = style.plan(&scene, Show::Final).unwrap();
    let pruning = Pruning { pictures: u32::MAX, ..renderer.pruning(1) };
    assert!(left_out(&prune(&plan, &scene, &pruning)).contains(&Rule::HiddenFaces));
    replace(&mut renderer, "phong/phong.frag", &behind);
    let short = prune(&plan, &scene, &renderer.pruning(u32::MAX)).plan;
    assert!(renderer.draw(&scene, &short).unwrap() == renderer.draw(&scene, &plan).unwrap());
}

/// The same plan by copies of its shaders under names of one's own, and their texts.
fn as_ones_own(mut plan: Plan) -> (Plan, HashMap<String, String>) {
    let mut texts = HashMap::new();
    let mut own = |path: &mut &'static str| {
        let name: &'static str = format!("own/{path}").leak();
        texts.insert(name.to_owned(), tinta::glsl::source(path).unwrap().to_owned());
        *path = name;
    };
    let mut rename = |program: &mut Program| {
        own(&mut program.vertex);
        program.fragments.iter_mut().for_each(&mut own);
    };
    for draw in draws_mut(&mut plan) {
        draw.program.iter_mut().for_each(&mut rename);
        draw.facts.shorter.iter_mut().for_each(|shorter| rename(&mut shorter.program));
    }
    (plan, texts)
}

#[test]
fn a_style_of_ones_own_that_states_facts_is_pruned_like_the_built_in_ones() {
    let scene = far_away("builtin:bust");
    let with = |change: fn(&mut Cartoon)| {
        let mut cartoon = Cartoon::default();
        change(&mut cartoon);
        cartoon
    };
    let styles = [
        Style::ThreePass(Cartoon::default()),
        Style::TwoPass(with(|cartoon| cartoon.tones.count = 2)),
        Style::ThreePass(with(|cartoon| cartoon.map_encoding = MapEncoding::DepthTexture)),
        Style::ThreePass(with(|cartoon| cartoon.border.iter_mut().for_each(|border| border.detection_factor = 0.0))),
        Style::Ink(Ink::default()),
        Style::Dietrich(Dietrich { cull_back_faces: true, ..Dietrich::default() }),
        Style::Charcoal(Charcoal::default()),
    ];
    let mut renderer = renderer(BACKENDS[0]);
    let mut seen = HashSet::new();
    for style in styles {
        let plan = style.plan(&scene, Show::Final).unwrap();
        let (own, texts) = as_ones_own(plan.clone());
        renderer.replace_shaders(texts).unwrap();
        let picture = renderer.draw(&scene, &plan).unwrap();
        for is_software in [true, false] {
            let pruning = Pruning { is_software, ..renderer.pruning(u32::MAX) };
            let (short, own_short) = (prune(&plan, &scene, &pruning), prune(&own, &scene, &pruning));
            assert_eq!(short.omissions, own_short.omissions, "{own}");
            assert_eq!(own_short.plan.to_string().replace("own/", ""), short.plan.to_string());
            assert!(renderer.draw(&scene, &own_short.plan).unwrap() == picture, "{own}");
            seen.extend(left_out(&own_short).iter().map(|rule| rule.name()));
            // What is not stated is not assumed.
            let mut silent = own.clone();
            draws_mut(&mut silent).for_each(|draw| draw.facts = Facts::default());
            let silent = prune(&silent, &scene, &pruning);
            let by_reading = [Rule::UnreadMap, Rule::UnreadTextures];
            assert!(left_out(&silent).iter().all(|rule| by_reading.contains(rule)), "{:?}", silent.omissions);
            assert!(renderer.draw(&scene, &silent.plan).unwrap() == picture);
        }
    }
    for rule in ["border", "culled-faces", "unused-light", "background-square", "empty-pixels", "overwritten-clear"] {
        assert!(seen.contains(rule), "{rule} applies to none of them: {seen:?}");
    }
    // Objects and faces are left out of the halftone of examples/ too.
    let beside = crate::prune::beside("builtin:bust");
    assert!(
        left_out(&prune(
            &as_ones_own(Style::named(StyleName::Phong).plan(&beside, Show::Final).unwrap()).0,
            &beside,
            &every_rule()
        ))
        .contains(&Rule::OutsideObjects)
    );
}

#[test]
fn a_plan_that_reads_what_an_earlier_one_left_behind_is_refused_before_it_is_drawn() {
    let scene = scene("builtin:open-box", 32, 32);
    let plan = |style: &Style| style.plan(&scene, Show::Final).unwrap();
    let texture = Style::named(StyleName::Mrt);
    for style in [Style::named(StyleName::ThreePass), texture] {
        let mut renderer = renderer(BACKENDS[0]);
        renderer.draw(&scene, &plan(&style)).unwrap();
        let mut broken = plan(&style);
        broken.passes.remove(0);
        if broken.passes.len() > 1 {
            assert!(broken.passes.iter().all(|pass| pass.target == Target::Framebuffer));
        }
        let error = renderer.draw(&scene, &broken).map(drop).unwrap_err();
        assert!(matches!(error, Error::Plan { .. }), "{error}");
        assert_eq!(error.kind(), "plan");
        assert!(error.to_string().starts_with("the plan cannot be drawn: the pass border "), "{error}");
        renderer.draw(&scene, &plan(&style)).unwrap();
    }
}

/// All files below a folder.
fn files(folder: &std::path::Path) -> Vec<std::path::PathBuf> {
    let entries = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    entries.flat_map(|path| if path.is_dir() { files(&path) } else { vec![path] }).collect()
}

#[test]
fn the_plan_and_its_pruner_name_no_shader_and_no_uniform() {
    let mut sources = files(&root().join("src/plan"));
    sources.push(root().join("src/plan.rs"));
    assert!(sources.len() > 8);
    let uniforms: HashSet<&str> = tinta::glsl::SOURCES
        .iter()
        .flat_map(|(_, text)| text.lines().filter_map(|line| line.strip_prefix("uniform ")))
        .map(|line| line.trim_end_matches(';').rsplit(' ').next().unwrap())
        .collect();
    assert!(["borderMap", "detectionFactor", "reach", "count"].iter().all(|name| uniforms.contains(name)));
    for source in sources {
        let text = std::fs::read_to_string(&source).unwrap();
        let place = source.display();
        for (path, _) in tinta::glsl::SOURCES {
            let (folder, file) = path.split_once('/').unwrap();
            assert!(!text.contains(file), "{place} names {file}");
            assert!(!text.contains(&format!("{folder}/")), "{place} names {folder}/");
        }
        let words: HashSet<&str> = text.split(|c: char| !c.is_alphanumeric() && c != '_').collect();
        for name in &uniforms {
            assert!(!text.contains(&format!("\"{name}\"")), "{place} names the uniform {name}");
            // Those that are no words of English either.
            let is_a_word = name.chars().all(|c| c.is_lowercase());
            assert!(is_a_word || !words.contains(name), "{place} names the uniform {name}");
        }
        assert!(
            !source.ends_with("prune") && (!text.contains(".uniforms") || source.ends_with("display.rs")),
            "{place}"
        );
    }
}
