//! Drivers that are missing, wrong, refuse, run out of memory or lose the context: each an error that names it.

use crate::support::{BACKENDS, Folder, renderer, root, scene, skip};
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use tinta::gl::Fault;
use tinta::{Backend, Error, Picture, Renderer, Scene, Show, Style, StyleName};

/// Styles that need every kind of object: tone tables, copies, textures drawn into, pictures, lists of edges.
const STYLES: [StyleName; 4] = [StyleName::ThreePass, StyleName::Mrt, StyleName::Inking, StyleName::Charcoal];

/// A fault that comes after so many calls.
type MakeFault = fn(u32) -> Fault;

fn small() -> Scene {
    scene("builtin:open-box", 48, 40)
}

fn draw(renderer: &mut Renderer, scene: &Scene, style: &Style) -> tinta::Result<Picture> {
    let plan = style.plan(scene, Show::Final)?;
    renderer.draw(scene, &plan)
}

#[test]
fn a_context_that_is_refused_is_reported_with_every_attempt() {
    for (backend, attempts) in [(BACKENDS[0], 1), (BACKENDS[1], 1), (Backend::Auto, 2)] {
        let error = Renderer::with_fault(backend, Fault::ContextRefused).expect_err("no driver has OpenGL 9.9");
        let message = error.to_string();
        assert!(message.starts_with("no OpenGL 2.1 context could be made (tried "), "{message}");
        let refusals = message.matches("making a GL 9.9 context failed").count();
        assert!(refusals >= attempts, "{backend:?}: {message}");
    }
}

#[test]
fn a_shader_that_is_refused_is_named_with_the_drivers_reason_and_the_next_picture_is_right() {
    let (scene, style) = (small(), Style::named(StyleName::ThreePass));
    for backend in *BACKENDS {
        let expected = draw(&mut renderer(backend), &scene, &style).unwrap();
        let mut refused = Vec::new();
        for after in 0.. {
            let mut renderer = Renderer::with_fault(backend, Fault::ShaderRefused { after }).unwrap();
            match draw(&mut renderer, &scene, &style) {
                Ok(picture) => {
                    assert_eq!(picture, expected);
                    break;
                }
                Err(Error::Shader { path, log }) => {
                    assert!(log.contains("refused on purpose"), "{path}: {log}");
                    refused.push(path);
                }
                Err(other) => panic!("{backend:?}: {other}"),
            }
            assert_eq!(draw(&mut renderer, &scene, &style).unwrap(), expected, "{backend:?} after shader {after}");
            assert_eq!(renderer.close(), 0);
        }
        let names = ["map", "toon", "border"].map(|name| refused.iter().any(|path| path.contains(name)));
        assert_eq!((refused.len(), names), (6, [true; 3]), "{backend:?}: {refused:?}");
    }
}

fn check_memory(backends: &[Backend], styles: &[StyleName]) {
    let scene = small();
    for &backend in backends {
        for &name in styles {
            let style = Style::named(name);
            let expected = draw(&mut renderer(backend), &scene, &style).unwrap();
            let mut places = 0;
            loop {
                let mut renderer = Renderer::with_fault(backend, Fault::OutOfMemory { after: places }).unwrap();
                match draw(&mut renderer, &scene, &style) {
                    Ok(picture) => {
                        assert_eq!(picture, expected);
                        break;
                    }
                    Err(error) => {
                        assert!(matches!(error, Error::Gl { .. }), "{error}");
                        assert!(error.to_string().contains("(GL_OUT_OF_MEMORY)"), "{name:?}, place {places}: {error}");
                    }
                }
                assert_eq!(draw(&mut renderer, &scene, &style).unwrap(), expected, "{name:?} after place {places}");
                assert_eq!(renderer.close(), 0);
                places += 1;
            }
            assert!(places >= 3, "{backend:?}, {name:?}: memory is taken in {places} places");
        }
    }
}

#[test]
fn memory_that_runs_out_in_three_passes_is_named_wherever_it_does_and_the_next_picture_is_right_briefly() {
    check_memory(&*BACKENDS, &[StyleName::ThreePass]);
}

#[test]
#[ignore = "exhaustive: every place of every style by both backends"]
fn memory_that_runs_out_is_named_wherever_it_does_and_the_next_picture_is_right() {
    check_memory(&*BACKENDS, &STYLES);
}

#[test]
fn a_lost_context_is_named_whenever_it_is_lost_and_for_ever_and_a_new_renderer_draws() {
    let (scene, style) = (small(), Style::named(StyleName::Mrt));
    let plan = style.plan(&scene, Show::Final).unwrap();
    let faults: [(MakeFault, &str); 2] = [
        (|after| Fault::ContextLost { after }, "GL_CONTEXT_LOST"),
        (|after| Fault::ContextReset { after }, "GL_GUILTY_CONTEXT_RESET"),
    ];
    for backend in *BACKENDS {
        let expected = draw(&mut renderer(backend), &scene, &style).unwrap();
        for (fault, what) in faults {
            let is_lost = |error: Error| {
                let message = error.to_string();
                assert!(matches!(error, Error::ContextLost { .. }), "{message}");
                assert!(message.starts_with("the GL context was lost in ") && message.contains(what), "{message}");
            };
            let mut moments = 0;
            loop {
                let mut renderer = Renderer::with_fault(backend, fault(moments)).unwrap();
                match renderer.draw(&scene, &plan) {
                    Ok(picture) => {
                        assert_eq!(picture, expected);
                        break;
                    }
                    Err(error) => is_lost(error),
                }
                is_lost(renderer.draw(&scene, &plan).unwrap_err());
                is_lost(renderer.time_frames(&scene, &plan, 0, 2).unwrap_err());
                is_lost(renderer.time_passes(&scene, &plan, 2).unwrap_err());
                is_lost(renderer.step_pictures(&scene, &plan).unwrap_err());
                is_lost(renderer.compile_shader("evangelista/map.vert").unwrap_err());
                assert_eq!(renderer.close(), 0);
                assert_eq!(draw(&mut self::renderer(backend), &scene, &style).unwrap(), expected);
                moments += 1;
            }
            assert!(moments >= 8, "{backend:?}: lost at {moments} moments");
        }
    }
}

#[test]
fn a_context_lost_while_a_shader_compiles_is_not_blamed_on_the_shader() {
    for backend in *BACKENDS {
        let mut renderer = Renderer::with_fault(backend, Fault::ContextLost { after: 0 }).unwrap();
        // The first call that counts; the fault is active afterwards.
        let scene = small();
        assert!(matches!(draw(&mut renderer, &scene, &Style::named(StyleName::Phong)), Err(Error::ContextLost { .. })));
        assert!(matches!(renderer.compile_shader("evangelista/map.vert"), Err(Error::ContextLost { .. })));
    }
}

#[test]
fn a_faulty_context_leaves_others_on_its_thread_alone() {
    let (scene, style) = (small(), Style::named(StyleName::ThreePass));
    let expected = draw(&mut renderer(Backend::Auto), &scene, &style).unwrap();
    let mut sound = renderer(Backend::Auto);
    let mut lost = Renderer::with_fault(Backend::Auto, Fault::ContextLost { after: 0 }).unwrap();
    let mut poor = Renderer::with_fault(Backend::Auto, Fault::OutOfMemory { after: 1 }).unwrap();
    for turn in 0..3 {
        assert!(matches!(draw(&mut lost, &scene, &style), Err(Error::ContextLost { .. })), "turn {turn}");
        assert_eq!(draw(&mut sound, &scene, &style).unwrap(), expected, "turn {turn}");
        // Its memory runs out once, in the first turn.
        assert_eq!(draw(&mut poor, &scene, &style).is_err(), turn == 0, "turn {turn}");
    }
}

/// The program in a changed environment.
fn tinta(environment: &[(&str, &Path)], arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_tinta"));
    for name in ["__EGL_VENDOR_LIBRARY_DIRS", "__EGL_VENDOR_LIBRARY_FILENAMES", "LIBGL_DRIVERS_PATH", "GALLIUM_DRIVER"]
    {
        command.env_remove(name);
    }
    command.envs(environment.iter().copied()).args(arguments).current_dir(root()).output().unwrap()
}

/// Asserts exit code 2 by no signal, one sentence of ours with all `words`, and no picture; for drawing and for `tinta info`.
fn fails(environment: &[(&str, &Path)], backend: &str, words: &[&str]) {
    let folder = Folder::new();
    let out = folder.path("a.png");
    for arguments in [&["render", "builtin:ant", "-o", &out, "--size", "32"][..], &["info"], &["info", "--json"]] {
        let arguments = [arguments, &["--backend", backend]].concat();
        let output = tinta(environment, &arguments);
        let said = String::from_utf8_lossy(&output.stderr);
        let what = format!("{environment:?} {arguments:?}: {:?}: {said}", output.status);
        assert_eq!(output.status.code(), Some(2), "{what}");
        // The driver may print messages too.
        assert_eq!(said.lines().filter(|line| line.starts_with("tinta: ")).count(), 1, "{what}");
        assert!(said.contains("tinta: no OpenGL 2.1 context could be made (tried "), "{what}");
        assert!(words.iter().all(|word| said.contains(word)) && !said.contains("panicked"), "{words:?}: {what}");
        assert!(!Path::new(&out).exists(), "{what}");
    }
}

/// Whether a backend is Mesa, which reads the environment variables of these tests.
fn is_mesa(backend: &str) -> bool {
    let text = String::from_utf8(tinta(&[], &["info", "--backend", backend]).stdout).unwrap();
    let is_mesa = text.lines().any(|line| line.contains("GL version") && line.contains("Mesa"));
    if !is_mesa {
        skip(&format!("faults of Mesa's {backend}: another driver is there, or none"));
    }
    is_mesa
}

#[test]
fn without_a_driver_the_error_names_what_was_missing() {
    let empty = Folder::new();
    let nowhere = PathBuf::from(empty.path("no-such-file.json"));
    let folder = PathBuf::from(empty.path(""));
    fails(&[("__EGL_VENDOR_LIBRARY_DIRS", &folder)], "egl", &["EGL: no devices", "apt-get install"]);
    fails(&[("__EGL_VENDOR_LIBRARY_FILENAMES", &nowhere)], "egl", &["EGL: no devices", "apt-get install"]);
    if is_mesa("egl") {
        fails(&[("LIBGL_DRIVERS_PATH", &folder)], "egl", &["EGL device 0", "opening the display failed"]);
    }
    // The other way still works, and is taken.
    if !is_mesa("osmesa") {
        return;
    }
    let output =
        tinta(&[("__EGL_VENDOR_LIBRARY_DIRS", &folder)], &["render", "builtin:ant", "-o", "-", "--size", "32"]);
    assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
    assert_eq!(image::load_from_memory(&output.stdout).unwrap().width(), 32);
}

/// A shared library of this machine other than a driver.
#[cfg(target_os = "linux")]
fn some_library() -> Option<PathBuf> {
    let maps = std::fs::read_to_string("/proc/self/maps").unwrap();
    let paths = maps.lines().filter_map(|line| line.split_ascii_whitespace().nth(5));
    paths.map(PathBuf::from).find(|path| {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        name.starts_with("libgcc_s.so") || name.starts_with("libm.so")
    })
}

#[cfg(target_os = "linux")]
#[test]
fn a_wrong_driver_library_is_named_and_what_it_lacks() {
    const NAMES: [&str; 5] = ["libEGL.so.1", "libEGL.so", "libOSMesa.so.8", "libOSMesa.so.6", "libOSMesa.so"];
    let library = some_library().map(|path| std::fs::read(path).unwrap());
    if library.is_none() {
        skip("a driver library without a driver's functions: no other library is loaded here to copy");
    }
    let text = [&b"dear diary "[..]; 1000].concat();
    let kinds =
        [(Some(Vec::new()), "file too short"), (Some(text), "invalid ELF header"), (library, "undefined symbol")];
    for (bytes, reason) in kinds {
        let Some(bytes) = bytes else { continue };
        let folder = Folder::new();
        NAMES.iter().for_each(|name| drop(folder.file(name, &bytes)));
        let place = PathBuf::from(folder.path(""));
        let environment: &[(&str, &Path)] = &[("LD_LIBRARY_PATH", &place)];
        fails(environment, "egl", &["EGL: ", "libEGL.so.1", reason]);
        fails(environment, "osmesa", &["OSMesa: ", "libOSMesa.so.8", reason]);
        fails(environment, "auto", &["libEGL.so.1", "libOSMesa.so.8", reason]);
    }
}

#[test]
fn a_driver_that_refuses_contexts_or_is_not_there_is_an_error_and_no_signal() {
    for backend in ["egl", "osmesa", "surfaceless", "auto"] {
        if !is_mesa(backend) {
            continue;
        }
        for version in ["1.1", "2.0"] {
            let environment: &[(&str, &Path)] = &[("MESA_GL_VERSION_OVERRIDE", Path::new(version))];
            fails(environment, backend, &["making a GL 2.1 context failed"]);
        }
        let words: &[&str] = match backend {
            "egl" => &["EGL device 0"],
            "surfaceless" => &["EGL surfaceless"],
            // Mesa's own library would crash.
            "osmesa" => &["OSMesa", "GALLIUM_DRIVER", "\"nonsense\"", "llvmpipe"],
            _ => &["EGL device 0", "OSMesa", "EGL surfaceless"],
        };
        fails(&[("GALLIUM_DRIVER", Path::new("nonsense"))], backend, words);
    }
    for driver in ["", "llvmpipe", "softpipe"].into_iter().filter(|_| is_mesa("osmesa")) {
        let output = tinta(&[("GALLIUM_DRIVER", Path::new(driver))], &["info", "--backend", "osmesa"]);
        assert_eq!(output.status.code(), Some(0), "{driver:?}: {}", String::from_utf8_lossy(&output.stderr));
    }
}

#[test]
fn a_shader_the_driver_refuses_ends_the_program_with_its_name_and_the_drivers_reason() {
    for backend in ["egl", "osmesa", "surfaceless"] {
        if !is_mesa(backend) {
            continue;
        }
        // Mesa saves the shaders it receives, and can be told to compile others in their place.
        let shaders = Folder::new();
        let place = PathBuf::from(shaders.path(""));
        let out = shaders.path("a.png");
        let arguments =
            ["render", "builtin:ant", "-o", &out, "--style", "three-pass", "--size", "32", "--backend", backend];
        let off: (&str, &Path) = ("MESA_SHADER_CACHE_DISABLE", Path::new("true"));
        let output = tinta(&[("MESA_SHADER_DUMP_PATH", &place), off], &arguments);
        assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
        std::fs::remove_file(&out).unwrap();
        let mut replaced = 0;
        for file in std::fs::read_dir(&place).unwrap() {
            std::fs::write(file.unwrap().path(), "#version 120\n#error refused on purpose\n").unwrap();
            replaced += 1;
        }
        if replaced == 0 {
            skip(&format!("a refused shader end to end: {backend}'s Mesa writes no shaders down"));
            continue;
        }
        let output = tinta(&[("MESA_SHADER_READ_PATH", &place), off], &arguments);
        let said = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{backend}: {said}");
        assert!(
            said.starts_with("tinta: glsl/evangelista/") && said.contains("refused on purpose"),
            "{backend}: {said}"
        );
        assert_eq!(said.lines().count(), 1, "{said}");
        assert!(!Path::new(&out).exists());
    }
}
