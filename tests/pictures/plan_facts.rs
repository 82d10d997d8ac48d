//! The facts that plans state about their draws: the pruner relies on them alone, for anyone's shaders, and ignores them once a
//! shader is replaced.

use crate::prune::{beside, every_rule};
use crate::support::{BACKENDS, renderer, root, scene};
use std::borrow::Cow;
use std::collections::{HashMap, HashSet};
use tinta::plan::prune::{PrunedPlan, Pruning, Rule, prune};
use tinta::plan::{Draw, Facts, Plan, Program, Step, Target};
use tinta::styles::{Cartoon, Charcoal, Dietrich, Ink, MapEncoding, Mrt};
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

fn left_out(pruned: &PrunedPlan) -> Vec<Rule> {
    pruned.omissions.iter().map(|omission| omission.rule).collect()
}

#[test]
fn a_border_shader_replaced_by_one_that_inks_all_of_the_picture_inks_all_of_it() {
    let scene = far_away("builtin:gear");
    let style = Style::named(StyleName::ThreePass);
    let plan = style.plan(&scene, Show::Final).unwrap();
    for backend in *BACKENDS {
        let mut renderer = renderer(backend);
        let published = renderer.render(&scene, &style).unwrap();
        replace(&mut renderer, "evangelista/border.frag", ALL_INK);
        let full = renderer.draw(&scene, &plan).unwrap();
        assert!(full.pixels.chunks_exact(4).all(|pixel| *pixel == [0, 0, 0, u8::MAX]));
        assert!(renderer.render(&scene, &style).unwrap() == full, "{backend:?}: confined to the objects");
        let unaware = Pruning { replaced_shaders: Vec::new(), ..renderer.pruning() };
        let confined = prune(&plan, &scene, &unaware).plan;
        assert!(renderer.draw(&scene, &confined).unwrap() != full, "else this test would see nothing");
        let short = prune(&plan, &scene, &renderer.pruning());
        assert!(!left_out(&short).contains(&Rule::EmptyPixels));
        assert!(left_out(&short).contains(&Rule::BackgroundSquare), "the other shaders are as they were");
        // Given back, it is confined again.
        renderer.replace_shaders(HashMap::new()).unwrap();
        assert!(left_out(&prune(&plan, &scene, &renderer.pruning())).contains(&Rule::EmptyPixels));
        assert!(renderer.render(&scene, &style).unwrap() == published);
    }
}

/// A replaced shader, with a style and a scene whose pruned plan would draw something else if the replacement did not count.
struct ReplacedShader {
    path: &'static str,
    text: String,
    style: Style,
    scene: Scene,
}

fn replaced(path: &'static str, text: &str, style: Style) -> ReplacedShader {
    ReplacedShader { path, text: text.to_owned(), style, scene: far_away("builtin:gear") }
}

#[test]
fn whatever_shader_is_replaced_the_short_plan_draws_what_the_full_one_does() {
    let mut one_tone = Cartoon::default();
    one_tone.tones.count = 1;
    let three = Style::named(StyleName::ThreePass);
    let source = |path: &str| tinta::glsl::source(path).unwrap().to_owned();
    let scaled = |path: &str, factor: &str| {
        source(path).replace("ftransform()", &format!("ftransform() * vec4({factor}, {factor}, 1.0, 1.0)"))
    };
    let in_stripes = "#version 120\nvoid main() { gl_FragColor = vec4(mod(floor(gl_FragCoord.x), 2.0)); }\n";
    let holed =
        "#version 120\nvoid main() { if (mod(gl_FragCoord.x, 4.0) < 2.0) discard; gl_FragColor = vec4(0.5); }\n";
    let dark = "#version 120\nfloat toneOf(float diffuse, float specular) { return 0.25; }\n";
    let cases = [
        // The map is no longer even.
        replaced("evangelista/map.frag", in_stripes, three.clone()),
        replaced("evangelista/map.frag", in_stripes, Style::named(StyleName::TwoPass)),
        // Objects are drawn where the camera does not have them.
        replaced("evangelista/map.vert", &scaled("evangelista/map.vert", "3.0"), three.clone()),
        replaced("improved/two-targets.vert", &scaled("improved/two-targets.vert", "3.0"), Style::Mrt(Mrt::default())),
        ReplacedShader {
            scene: beside("builtin:bust"),
            ..replaced("evangelista/toon.vert", &scaled("evangelista/toon.vert", "0.2"), three)
        },
        replaced("improved/plane-ink.frag", ALL_INK, Style::Ink(Ink::default())),
        // A part of the shorter program only: the longer one is unchanged.
        replaced("improved/tone-one.frag", dark, Style::ThreePass(one_tone)),
        // The cleared colour shows through holes.
        replaced("valente/paper.frag", holed, Style::Charcoal(Charcoal::default())),
    ];
    let mut renderer = renderer(BACKENDS[0]);
    for ReplacedShader { path, text, style, scene } in cases {
        replace(&mut renderer, path, &text);
        let plan = style.plan(&scene, Show::Final).unwrap();
        let full = renderer.draw(&scene, &plan).unwrap();
        let other = Style::named(StyleName::ThreePass).plan(&scene, Show::Map).unwrap();
        let mut draw = |pruning: &Pruning| {
            // The full picture must leave nothing for the pruned plan to show.
            renderer.draw(&scene, &other).unwrap();
            renderer.draw(&scene, &prune(&plan, &scene, pruning).plan).unwrap()
        };
        let mut would_differ = false;
        for is_software in [true, false] {
            let pruning = Pruning { is_software, replaced_shaders: vec![path.to_owned()], ..every_rule() };
            assert!(draw(&pruning) == full, "{path} in {}", style.name());
            would_differ |= draw(&Pruning { replaced_shaders: Vec::new(), ..pruning }) != full;
        }
        assert!(would_differ, "{path} in {} shows nothing", style.name());
        assert_eq!(renderer.pruning().replaced_shaders, [path]);
    }
}

/// The same plan with copies of its shaders under new names, and their texts.
fn as_ones_own(mut plan: Plan) -> (Plan, HashMap<String, String>) {
    let mut texts = HashMap::new();
    let mut own = |path: &mut Cow<'static, str>| {
        let name = format!("own/{path}");
        texts.insert(name.clone(), tinta::glsl::source(path).unwrap().to_owned());
        *path = name.into();
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
            let pruning = Pruning { is_software, ..renderer.pruning() };
            let (short, own_short) = (prune(&plan, &scene, &pruning), prune(&own, &scene, &pruning));
            assert_eq!(short.omissions, own_short.omissions, "{own}");
            assert_eq!(own_short.plan.to_string().replace("own/", ""), short.plan.to_string());
            assert!(renderer.draw(&scene, &own_short.plan).unwrap() == picture, "{own}");
            seen.extend(left_out(&own_short).iter().map(|rule| rule.name()));
            // Facts that are not stated are not assumed.
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
            // Names that are not English words either.
            let is_a_word = name.chars().all(|c| c.is_lowercase());
            assert!(is_a_word || !words.contains(name), "{place} names the uniform {name}");
        }
        assert!(
            !source.ends_with("prune") && (!text.contains(".uniforms") || source.ends_with("display.rs")),
            "{place}"
        );
    }
}
