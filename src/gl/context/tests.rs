//! Contexts take turns.

use super::context_lock::{ContextLock, OF_EGL, OF_OSMESA, OF_SURFACELESS};
use super::driver::VERSION;
use super::platform::{NotCurrent, Platform};
use super::{Backend, Context, egl, osmesa};
use crate::mesh::{LoadOptions, load};
use crate::picture::Picture;
use crate::plan::{Draw, Geometry, Step};
use crate::renderer::Renderer;
use crate::scene::{Scene, SceneSettings, Size};
use crate::styles::{Show, Style, StyleName};
use std::ffi::{CStr, c_void};
use std::sync::Arc;
use std::sync::mpsc::channel;
use std::sync::{Mutex, PoisonError};

/// These tests ask whether any context is at work, so they are not at work at once themselves.
static ALONE: Mutex<()> = Mutex::new(());

fn open(backend: Backend) -> Context {
    Context::open(backend, None).unwrap_or_else(|error| panic!("{backend:?}: {error}"))
}

/// While one context is current, another of the same screen waits on its thread and continues when the first has ended.
fn take_turns(backend: Backend, lock: &'static ContextLock) {
    let _alone = ALONE.lock().unwrap_or_else(PoisonError::into_inner);
    let first = open(backend);
    if !first.info().is_software() {
        eprintln!("SKIPPED: {} is hardware, whose contexts need not take turns", first.info().renderer);
        return;
    }
    let (opened, is_opened) = channel();
    let (entered, is_entered) = channel();
    let (ask, asked) = channel();
    std::thread::scope(|scope| {
        scope.spawn(move || {
            let second = open(backend);
            opened.send(()).unwrap();
            asked.recv().unwrap();
            let current = second.enter().unwrap();
            entered.send(()).unwrap();
            drop(current);
        });
        is_opened.recv().unwrap();
        let current = first.enter().unwrap();
        ask.send(()).unwrap();
        assert!(lock.is_locked());
        // It may not have come as far as asking yet; if it could enter it would, sooner or later, before this has ended.
        for _ in 0..1000 {
            std::thread::yield_now();
            assert!(is_entered.try_recv().is_err(), "two contexts are at work at once");
        }
        drop(current);
        is_entered.recv().unwrap();
    });
}

#[test]
fn software_contexts_of_egl_take_turns() {
    take_turns(Backend::Egl, &OF_EGL);
}

#[test]
fn contexts_of_the_surfaceless_platform_take_turns() {
    take_turns(Backend::Surfaceless, &OF_SURFACELESS);
}

#[test]
fn contexts_of_osmesa_take_turns() {
    if !osmesa::is_there() {
        eprintln!("SKIPPED: there is no OSMesa");
        return;
    }
    take_turns(Backend::OsMesa, &OF_OSMESA);
}

#[test]
fn a_context_of_a_device_and_one_of_another_screen_are_at_work_together() {
    let _alone = ALONE.lock().unwrap_or_else(PoisonError::into_inner);
    let egl = open(Backend::Egl);
    let current = egl.enter().unwrap();
    let others = [Backend::Surfaceless, Backend::OsMesa];
    for other in others.into_iter().filter(|other| *other == Backend::Surfaceless || osmesa::is_there()) {
        // Ends only if it need not wait for the other.
        std::thread::scope(|scope| scope.spawn(|| drop(open(other).enter().unwrap())).join().unwrap());
    }
    drop(current);
}

/// Draws this many pictures of three styles in each of two contexts at once, each on its own thread.
fn draw_at_once(pictures: usize, backends: [Backend; 2]) {
    let draw = |backend: Backend| {
        let mut renderer = Renderer::new(backend).unwrap();
        let mesh = Arc::new(load("builtin:gear", &LoadOptions::default()).unwrap().mesh);
        let styles = [StyleName::ThreePass, StyleName::Inking, StyleName::Charcoal].map(Style::named);
        let drawn: Vec<_> = (0..pictures)
            .map(|number| {
                let size = Size { width: 64 + (number % 3) as u32 * 32, height: 96 };
                let scene =
                    Scene::new(vec![mesh.clone()], &SceneSettings { size, ..SceneSettings::default() }).unwrap();
                renderer.render(&scene, &styles[number % styles.len()]).unwrap()
            })
            .collect();
        drawn
    };
    let [first, second] = std::thread::scope(|scope| {
        backends.map(|backend| scope.spawn(move || draw(backend))).map(|thread| thread.join().unwrap())
    });
    assert!(first == second, "{backends:?}");
}

#[test]
fn two_screens_draw_the_same_at_once_briefly() {
    let _alone = ALONE.lock().unwrap_or_else(PoisonError::into_inner);
    draw_at_once(12, [Backend::Egl, Backend::Surfaceless]);
}

#[test]
#[ignore = "exhaustive: five hundred pictures by each of two threads"]
fn two_screens_draw_the_same_at_once_for_long() {
    let _alone = ALONE.lock().unwrap_or_else(PoisonError::into_inner);
    draw_at_once(500, [Backend::Egl, Backend::Surfaceless]);
}

/// EGL's context as macOS has one: without a surface that could be drawn into.
struct WithoutSurface(super::pbuffer::Pbuffer<()>);

impl Platform for WithoutSurface {
    fn resize(&mut self, _: Size) -> Result<(), String> {
        Ok(())
    }

    fn make_current(&self) -> Result<(), NotCurrent> {
        self.0.make_current()
    }

    fn release(&self) {
        self.0.release();
    }

    fn proc_address(&self, name: &CStr) -> *const c_void {
        self.0.proc_address(name)
    }

    fn largest_surface(&self) -> Size {
        self.0.largest_surface()
    }

    fn lacks_surface(&self) -> bool {
        true
    }
}

/// Pixels that differ by more than rounding.
fn of_other_shades([a, b]: &[Picture; 2]) -> usize {
    let pairs = a.pixels.chunks_exact(4).zip(b.pixels.chunks_exact(4));
    pairs.filter(|(a, b)| a.iter().zip(*b).any(|(a, b)| a.abs_diff(*b) > 1)).count()
}

#[test]
fn a_framebuffer_object_in_the_place_of_a_surface_draws_the_same_but_for_lines_and_rounding() {
    let _alone = ALONE.lock().unwrap_or_else(PoisonError::into_inner);
    let device = egl::devices().unwrap().remove(0);
    let context = {
        let _guard = OF_EGL.lock();
        let platform = WithoutSurface(egl::open(&device, VERSION).unwrap());
        Context::load(Box::new(platform), "egl", device.name, None, &OF_EGL).unwrap()
    };
    assert_eq!(context.info(), open(Backend::Egl).info());
    let [mut without, mut with] = [Renderer::of(context), Renderer::new(Backend::Egl).unwrap()];
    let mesh = Arc::new(load("builtin:gear", &LoadOptions::default()).unwrap().mesh);
    let mut wrong = Vec::new();
    // Larger and smaller again, to recreate the surface's framebuffer object; sand needs a model with a texture.
    for (width, height) in [(96, 64), (160, 120), (64, 64)] {
        let settings = SceneSettings { size: Size { width, height }, ..SceneSettings::default() };
        let scene = Scene::new(vec![mesh.clone()], &settings).unwrap();
        for (name, style) in StyleName::of_passes().filter(|(_, style)| *style != StyleName::Sand) {
            for show in [Show::Final, Show::Map] {
                let Ok(plan) = Style::named(style).plan(&scene, show) else { continue };
                let pictures = [&mut without, &mut with].map(|renderer| renderer.draw(&scene, &plan).unwrap());
                let difference = pictures[0].difference(&pictures[1]).unwrap();
                let is_edge = |step: &Step| matches!(step, Step::Draw(Draw { geometry: Geometry::Edges { .. }, .. }));
                // Mesa draws into a surface from above and into a framebuffer object from below, so halfway values round to
                // opposite sides. Charcoal's tables turn that into another shade here and there. A line between two pixels covers
                // those of one side.
                let all = scene.size.pixel_count();
                let is_near = match plan.steps().any(|(_, step)| is_edge(step)) {
                    true => difference.pixels <= all / 8,
                    false => difference.largest <= 1 || of_other_shades(&pictures) <= all / 200,
                };
                if !is_near {
                    wrong.push(format!("{name}, {show:?}, {width}x{height}: {difference:?}"));
                }
            }
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}
