//! Memory and GL objects over many frames; in a separate process, because other tests' memory would count too.

use std::sync::{Arc, Mutex};
use tinta::gl::context::witnesses;
use tinta::styles::{Cartoon, Ink, MapEncoding, MapTarget, Mrt, Quality, Supersample};
use tinta::{Backend, LoadOptions, Renderer, Scene, SceneSettings, Show, Size, Style, StyleName, load};

/// Growth allowed over hundreds of frames in each style, KiB. The allocator's own level moves by about 1,000 once, after
/// 1,000 frames as after 6,000; a frame of one style that leaked a 64 x 64 RGBA picture would need 4,800.
const ALLOWED_KIB: u64 = 2048;

/// The growth of memory between equal spans of work, KiB, if it grows in three consecutive spans: a leak does, while the
/// allocator's level moves once.
fn growth(mut memory_after_a_span: impl FnMut() -> u64) -> u64 {
    let (mut before, mut least) = (memory_after_a_span(), u64::MAX);
    for _ in 0..3 {
        let after = memory_after_a_span();
        least = least.min(after.saturating_sub(before));
        if least < ALLOWED_KIB {
            break;
        }
        before = after;
    }
    least
}

#[test]
fn growth_is_what_goes_on_and_not_what_moves_once() {
    let of = |spans: &[u64]| {
        let mut spans = spans.iter();
        growth(|| *spans.next().unwrap())
    };
    assert_eq!(of(&[100, 3_100, 6_200, 9_200]), 3_000);
    assert_eq!(of(&[100, 3_100, 6_200, 6_300]), 100);
    assert_eq!(of(&[5_000, 4_000]), 0);
}

/// Held by each test here, to keep one from counting another's memory.
static ALONE: Mutex<()> = Mutex::new(());

/// Draws so many frames of each style at a time, and looks at memory so often before and after.
fn check_frames(frames_at_once: usize, looks: usize) {
    let _alone = ALONE.lock().unwrap_or_else(|poisoned| poisoned.into_inner());
    let mesh = load("builtin:ant", &LoadOptions::default()).unwrap().mesh;
    let settings = SceneSettings { size: Size { width: 64, height: 64 }, ..SceneSettings::default() };
    let scene = Scene::new(vec![Arc::new(mesh)], &settings).unwrap();
    // Sand needs a model with a texture. Charcoal's textures, 3 MiB uploaded anew after every other style, find another place in
    // the allocator each time: charcoal is tested alone, with its textures made once as in an animation.
    let names = StyleName::of_passes().map(|(_, name)| name);
    let others = names.filter(|name| ![StyleName::Sand, StyleName::Charcoal].contains(name)).map(Style::named);
    let groups = [others.chain(improved()).collect::<Vec<_>>(), vec![Style::named(StyleName::Charcoal)]];
    for (backend, styles) in witnesses().into_iter().flat_map(|one| groups.iter().map(move |s| (one, s))) {
        let mut renderer = Renderer::new(backend).unwrap_or_else(|error| panic!("{error}"));
        let mut frames = |count| {
            for style in styles {
                let plan = style.plan(&scene, Show::Final).unwrap();
                renderer.time_frames(&scene, &plan, 0, count).unwrap();
                renderer.time_passes(&scene, &plan, 2).unwrap();
            }
            renderer.live_objects()
        };
        // Until the driver has compiled all, and the allocator settled.
        (0..6).for_each(|_| {
            frames(frames_at_once);
        });
        let objects = frames(5);
        assert!(objects > 0);
        // The minimum of many samples is the memory held.
        let least = || {
            let look = |_| {
                assert_eq!(frames(frames_at_once), objects);
                resident_kib()
            };
            (0..looks).map(look).min().unwrap()
        };
        let grown = growth(least);
        println!("{backend:?}, {} styles: grown by {grown} KiB", styles.len());
        assert!(grown < ALLOWED_KIB, "{backend:?}: frames of each style grew the process by {grown} KiB");
    }
}

#[test]
fn a_few_frames_leave_memory_and_objects_as_they_were_briefly() {
    check_frames(3, 5);
}

#[test]
#[ignore = "exhaustive: hundreds of frames in each style by both backends"]
fn a_thousand_frames_leave_memory_and_objects_as_they_were() {
    check_frames(30, 10);
}

#[test]
fn pictures_of_changing_sizes_leave_memory_as_it_was() {
    let _alone = ALONE.lock().unwrap_or_else(|poisoned| poisoned.into_inner());
    let mesh = Arc::new(load("builtin:open-box", &LoadOptions::default()).unwrap().mesh);
    let scenes = [64, 128].map(|side| {
        let settings = SceneSettings { size: Size { width: side, height: side }, ..SceneSettings::default() };
        Scene::new(vec![mesh.clone()], &settings).unwrap()
    });
    for backend in witnesses() {
        let mut renderer = Renderer::new(backend).unwrap_or_else(|error| panic!("{error}"));
        let mut draw = |count: usize| {
            for number in 0..count {
                renderer.render(&scenes[number % 2], &Style::named(StyleName::ThreePass)).unwrap();
            }
            resident_kib()
        };
        let before = draw(100);
        // One surface kept at every change, 128 KiB or 32, would make 16,000.
        let grown = draw(200).saturating_sub(before);
        println!("{backend:?}: grown by {grown} KiB");
        assert!(grown < ALLOWED_KIB, "{backend:?}: 200 pictures of changing sizes grew the process by {grown} KiB");
    }
}

#[test]
fn a_renderer_deletes_every_object_it_made() {
    let _alone = ALONE.lock().unwrap_or_else(|poisoned| poisoned.into_inner());
    let scene_mesh = Arc::new(load("builtin:open-box", &LoadOptions::default()).unwrap().mesh);
    let scene = Scene::new(vec![scene_mesh], &SceneSettings::default()).unwrap();
    for backend in witnesses() {
        let mut renderer = Renderer::new(backend).unwrap_or_else(|error| panic!("{error}"));
        renderer.render(&scene, &Style::named(StyleName::ThreePass)).unwrap();
        for style in improved() {
            renderer.render(&scene, &style).unwrap();
        }
        assert!(renderer.live_objects() >= 6, "a mesh's two buffers, the squares, the map, three programs");
        assert_eq!(renderer.close(), 0);
    }
}

#[cfg(feature = "window")]
fn check_switches(at_once: usize, looks: usize) {
    use tinta::request::Request;
    use tinta::window::{Drawer, Job, Orbit, Side};
    let _alone = ALONE.lock().unwrap_or_else(|poisoned| poisoned.into_inner());
    let mut drawer = Drawer::new(Backend::Egl).unwrap_or_else(|error| panic!("{error}"));
    let settings = SceneSettings { size: Size { width: 64, height: 64 }, ..SceneSettings::default() };
    // Kept, with charcoal's textures in them.
    let names = StyleName::of_passes().filter(|(_, name)| *name != StyleName::Sand);
    let requests: Vec<Request> = names.map(|(_, name)| Request::of_style(name)).collect();
    let mut switches = |count: usize| {
        let mut scene = None;
        for number in 0..count {
            if number % 10 == 0 {
                let mesh = Arc::new(load("builtin:ant", &LoadOptions::default()).unwrap().mesh);
                scene = Some(Arc::new(Scene::new(vec![mesh], &SceneSettings::default()).unwrap()));
            }
            let job = Job {
                scene: scene.clone().unwrap(),
                orbit: Orbit::default(),
                settings: settings.clone(),
                drawings: vec![(Side::Left, requests[number % requests.len()].clone())],
                has_strokes: [false; 2],
                found: [None, None],
                is_coarse: false,
                keeps_patches: false,
            };
            drawer.draw(&job).unwrap();
        }
        drawer.live_objects()
    };
    (0..4).for_each(|_| {
        switches(2 * at_once);
    });
    let objects = switches(at_once);
    assert!(objects > 0);
    // Charcoal's textures find another place in the allocator each time: the minimum of many samples is the memory held.
    let least = || {
        let look = |_| {
            assert_eq!(switches(at_once), objects);
            resident_kib()
        };
        (0..looks).map(look).min().unwrap()
    };
    let grown = growth(least);
    println!("grown by {grown} KiB");
    assert!(grown < ALLOWED_KIB, "style switches and reloads grew the process by {grown} KiB");
}

#[cfg(feature = "window")]
#[test]
fn a_hundred_style_switches_and_ten_model_reloads_leave_memory_and_objects_as_they_were_briefly() {
    check_switches(20, 3);
}

#[cfg(feature = "window")]
#[test]
#[ignore = "exhaustive: a thousand switches"]
fn a_thousand_style_switches_and_model_reloads_leave_memory_and_objects_as_they_were() {
    check_switches(80, 8);
}

#[cfg(target_os = "linux")]
fn check_worker(looks: usize, has_charcoal: bool) {
    use std::io::{BufRead, BufReader, Write};
    use std::process::{Command, Stdio};
    let _alone = ALONE.lock().unwrap_or_else(|poisoned| poisoned.into_inner());
    let folder = tempfile::tempdir().unwrap();
    let mut worker = Command::new(env!("CARGO_BIN_EXE_tinta"))
        .args(["batch", "--worker", "--output"])
        .arg(folder.path())
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    let (mut jobs, mut outcomes) =
        (worker.stdin.take().unwrap(), BufReader::new(worker.stdout.take().unwrap()).lines());
    let mut id = 0;
    let mut work = |count: usize| {
        for _ in 0..count {
            let style = StyleName::of_passes().cycle().nth(id).unwrap().1;
            let is_left_out = style == StyleName::Sand || style == StyleName::Charcoal && !has_charcoal;
            let style = if is_left_out { StyleName::Phong } else { style }.name();
            let (model, size) = (["bust", "ant", "open-box", "gear"][id % 4], 24 + 8 * (id % 3));
            let job = format!(
                r#"{{"id":{id},"command":"render","model":"builtin:{model}","output":"{}.png","size":{size},"style":"{style}"}}"#,
                id % 20
            );
            writeln!(jobs, "{job}").unwrap();
            let outcome = outcomes.next().unwrap().unwrap();
            assert!(outcome.starts_with(r#"{"error":null"#), "{outcome}");
            id += 1;
        }
        resident_kib_of(&worker.id().to_string())
    };
    // Charcoal's textures, 3 MiB, find another place in the allocator each time: the minimum of many samples is the memory held.
    let mut least = || (0..looks).map(|_| work(18)).min().unwrap();
    // Until the driver has compiled all.
    least();
    let grown = growth(least);
    println!("{looks} times 18 jobs: grown by {grown} KiB");
    assert!(grown < ALLOWED_KIB, "{looks} times 18 jobs grew the worker by {grown} KiB, and as many before and after");
    drop(jobs);
    assert!(worker.wait().unwrap().success());
}

#[cfg(target_os = "linux")]
#[test]
fn a_worker_of_a_batch_does_dozens_of_jobs_in_the_memory_of_the_first_briefly() {
    check_worker(3, false);
}

#[cfg(target_os = "linux")]
#[test]
#[ignore = "exhaustive: hundreds of jobs, charcoal among them"]
fn a_worker_of_a_batch_does_hundreds_of_jobs_in_the_memory_of_the_first() {
    check_worker(8, true);
}

/// Styles with additional objects: drawn textures, a copy of the depth, a larger surface.
fn improved() -> [Style; 5] {
    let cartoon = |map_encoding| Style::ThreePass(Cartoon { map_encoding, ..Cartoon::default() });
    let best = Style::Ink(Ink { quality: Quality::Best, ..Ink::default() });
    let texture = Style::TwoPass(Cartoon { map_target: MapTarget::Texture, ..Cartoon::default() });
    let mrt = Style::Mrt(Mrt(Cartoon { supersample: Supersample::Two, ..Cartoon::default() }));
    [cartoon(MapEncoding::Float), cartoon(MapEncoding::DepthTexture), best, texture, mrt]
}

/// Resident memory of this process.
fn resident_kib() -> u64 {
    resident_kib_of("self")
}

/// Resident memory of a process.
fn resident_kib_of(process: &str) -> u64 {
    let status = std::fs::read_to_string(format!("/proc/{process}/status")).unwrap();
    let line = status.lines().find(|line| line.starts_with("VmRSS:")).unwrap();
    line.split_ascii_whitespace().nth(1).unwrap().parse().unwrap()
}
