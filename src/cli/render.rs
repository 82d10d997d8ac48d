//! `tinta render`: models to a picture.

use glam::DVec3;
use std::path::PathBuf;
use std::sync::Arc;
use std::time::Instant;
use tinta::mesh::{BUILTINS, Normals, UpAxis, load};
use tinta::picture::write_rgba_png;
use tinta::record::{CameraRecord, ModelRecord, Record, Summary};
use tinta::renderer::{PassTime, milliseconds_since};
use tinta::styles::{Border, Filter, ToneLookup};
use tinta::{
    Backend, Background, CameraSettings, Color, Error, LoadOptions, Renderer, Result, Scene, SceneSettings, Show, Size,
    Style, StyleName, Target, View,
};

/// Draw models into a picture file
#[derive(clap::Args)]
#[command(after_help = after_help())]
pub struct Arguments {
    /// Model files (OBJ, PLY, STL) or built-in models; several make one scene, each at its own coordinates
    #[arg(required = true, value_name = "MODEL")]
    models: Vec<String>,

    /// Picture to write: .png .jpg .bmp .tga .ppm, or - for PNG on standard output
    #[arg(short, long, value_name = "FILE")]
    output: String,

    /// Style: phong, three-pass, two-pass [default: three-pass]
    #[arg(long, value_name = "STYLE", default_value = "three-pass", hide_default_value = true)]
    style: StyleName,

    /// Size in pixels, or one number for a square [default: 512x512]
    #[arg(long, value_name = "WxH", default_value = "512x512", hide_default_value = true)]
    size: Size,

    /// Colour behind the scene: a CSS name, #rrggbb or rgb(r,g,b) [default: white]
    #[arg(long, value_name = "COLOUR", default_value = "white", hide_default_value = true)]
    background: Color,

    /// No background: alpha 0 where nothing is drawn [default: off]
    #[arg(long, conflicts_with = "background")]
    transparent: bool,

    /// Leave out faces turned away: none, back; faster, and the same picture of closed models [default: none]
    #[arg(long, value_name = "FACES", action = clap::ArgAction::Set, value_parser = parse_cull, default_value = "none", hide_default_value = true)]
    cull: bool,

    /// One colour for all surfaces [default: the model's own, #edbd85 where it has none]
    #[arg(long, value_name = "COLOUR")]
    color: Option<Color>,

    /// Repeat the models on a square grid, up to 10000 times [default: 1]
    #[arg(long, value_name = "N", default_value = "1", hide_default_value = true)]
    copies: u32,

    #[command(flatten)]
    camera: CameraArguments,

    #[command(flatten)]
    cartoon: CartoonArguments,

    #[command(flatten)]
    model: ModelArguments,

    #[command(flatten)]
    run: RunArguments,
}

#[derive(clap::Args)]
#[command(next_help_heading = "Camera")]
struct CameraArguments {
    /// View from iso, front, back, left, right, top, bottom or AZIMUTH,ELEVATION in degrees [default: 30,15]
    #[arg(long, value_name = "VIEW", default_value = "30,15", hide_default_value = true, allow_hyphen_values = true)]
    view: View,

    /// Vertical field of view in degrees [default: 30]
    #[arg(long, value_name = "DEGREES", default_value = "30", hide_default_value = true, allow_hyphen_values = true)]
    fov: f64,

    /// Parallel projection instead of perspective [default: off]
    #[arg(long)]
    parallel: bool,

    /// Position of the eye, model units [default: where --view shows the whole scene]
    #[arg(long, value_name = "X,Y,Z", value_parser = parse_vector, allow_hyphen_values = true, conflicts_with = "view")]
    eye: Option<DVec3>,

    /// Point in the middle of the picture [default: the scene's centre]
    #[arg(long, value_name = "X,Y,Z", value_parser = parse_vector, allow_hyphen_values = true)]
    target: Option<DVec3>,

    /// Direction that is up in the picture [default: 0,1,0]
    #[arg(long, value_name = "X,Y,Z", value_parser = parse_vector, allow_hyphen_values = true)]
    up: Option<DVec3>,

    /// Distance of the near plane from the eye, model units [default: fitted]
    #[arg(long, value_name = "LENGTH", allow_hyphen_values = true)]
    near: Option<f64>,

    /// Distance of the far plane from the eye, model units [default: fitted]
    #[arg(long, value_name = "LENGTH", allow_hyphen_values = true)]
    far: Option<f64>,
}

#[derive(clap::Args)]
#[command(next_help_heading = "Cartoon styles (the defaults are the paper's; phong uses none of these)")]
struct CartoonArguments {
    /// Number of tones, 1 to 3; fewer leave out the brightest [default: 3]
    #[arg(long, value_name = "N", default_value = "3", hide_default_value = true)]
    tones: u8,

    /// Diffuse and specular light from which the second and third tone hold [default: 0.8,0.65]
    #[arg(long, value_name = "D,S", value_parser = parse_pair, default_value = "0.8,0.65", hide_default_value = true, allow_hyphen_values = true)]
    tone_thresholds: [f32; 2],

    /// What the tones multiply the colour by [default: 0.65,0.95,1]
    #[arg(long, value_name = "A,B,C", value_parser = parse_triple, default_value = "0.65,0.95,1", hide_default_value = true, allow_hyphen_values = true)]
    tone_levels: [f32; 3],

    /// Find tones by comparing (steps) or in a 1-D texture (texture) [default: steps]
    #[arg(long, value_name = "HOW", default_value = "steps", hide_default_value = true)]
    tone_lookup: ToneLookup,

    /// No borders, tones alone [default: off]
    #[arg(long)]
    no_borders: bool,

    /// Edge filter: laplacian4, laplacian8, mitchell, sobel, roberts [default: laplacian4]
    #[arg(long, value_name = "FILTER", default_value = "laplacian4", hide_default_value = true)]
    filter: Filter,

    /// What the edge filter's response is multiplied by; more darkens faint edges [default: 0.2]
    #[arg(long, value_name = "FACTOR", default_value = "0.2", hide_default_value = true, allow_hyphen_values = true)]
    detection_factor: f32,

    /// Draw a square behind the scene, on or off; off loses outer borders [default: on]
    #[arg(long, value_name = "ON|OFF", action = clap::ArgAction::Set, value_parser = parse_switch, default_value = "on", hide_default_value = true)]
    background_quad: bool,

    /// Which picture: final, normals, depth, map, borders, tones [default: final]
    #[arg(long, value_name = "PICTURE", default_value = "final", hide_default_value = true)]
    show: Show,
}

#[derive(clap::Args)]
#[command(next_help_heading = "Models")]
struct ModelArguments {
    /// Axis that points up in the file: x, y, z, -x, -y, -z [default: y]
    #[arg(long, value_name = "AXIS", default_value = "y", hide_default_value = true, allow_hyphen_values = true)]
    up_axis: UpAxis,

    /// Join vertices nearer than this share of the model's size [default: 1e-7]
    #[arg(long, value_name = "SHARE", default_value = "1e-7", hide_default_value = true, allow_hyphen_values = true)]
    weld: f64,

    /// Normals: file (computed where it has none), smooth, flat [default: file]
    #[arg(long, value_name = "WHERE", default_value = "file", hide_default_value = true)]
    normals: Normals,

    /// Largest angle between faces that computed normals round off, degrees [default: 60]
    #[arg(long, value_name = "DEGREES", default_value = "60", hide_default_value = true, allow_hyphen_values = true)]
    smooth_angle: f64,

    /// Refuse models with defects [default: off, defects are counted and left out]
    #[arg(long)]
    strict: bool,
}

#[derive(clap::Args)]
#[command(next_help_heading = "Running")]
struct RunArguments {
    /// OpenGL from: egl, osmesa, auto (the first that works) [default: auto]
    #[arg(long, value_name = "BACKEND", default_value = "auto", hide_default_value = true)]
    backend: Backend,

    /// Frames to draw and time after warm-up, with --json or --explain [default: 1]
    #[arg(long, value_name = "N", default_value = "1", hide_default_value = true, value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    frames: u32,

    /// Print one JSON record: model, style, camera, GL, times [default: off]
    #[arg(long)]
    json: bool,

    /// Print the plan, its passes and steps, with times [default: off]
    #[arg(long, conflicts_with = "json")]
    explain: bool,

    /// Write what GL holds after every step into this folder, RGBA PNG [default: off]
    #[arg(long, value_name = "DIR")]
    dump: Option<PathBuf>,
}

/// Frames drawn before measuring: the driver compiles in the first and settles in the second.
const WARM_UP: usize = 2;

/// Most frames drawn again to time single passes.
const PASS_FRAMES: usize = 21;

/// Draws what the arguments say.
pub fn run(arguments: &Arguments) -> Result<()> {
    let target = Target::check(&arguments.output, arguments.transparent)?;
    if target == Target::Stdout && (arguments.run.json || arguments.run.explain) {
        return Err(Error::Setting {
            setting: "-o -".to_owned(),
            problem: "the picture and --json or --explain cannot share standard output; name a file".to_owned(),
        });
    }
    make_dump_folder(arguments)?;
    let style = arguments.style();
    // Context and driver need as long as a large model: both at once. The renderer stays on this thread, as GL wants.
    let settings = arguments.scene_settings();
    let (renderer, loaded) = std::thread::scope(|scope| {
        let load = || load_scene(arguments, &settings);
        // Where no second thread can be had, one after the other.
        let Ok(loading) = std::thread::Builder::new().spawn_scoped(scope, load) else {
            let loaded = load();
            return (open_renderer(arguments, &settings, &style, || true), loaded);
        };
        let renderer = open_renderer(arguments, &settings, &style, || loading.is_finished());
        match loading.join() {
            Ok(loaded) => (renderer, loaded),
            Err(panic) => std::panic::resume_unwind(panic),
        }
    });
    let Loaded { scene, load_ms } = loaded?;
    let plan = style.plan(&scene, arguments.cartoon.show)?;
    let Opened { mut renderer, context_ms, warm_up_ms } = renderer?;

    let first_frame = Instant::now();
    let picture = renderer.draw(&scene, &plan)?;
    let first_frame_ms = milliseconds_since(first_frame);
    target.write(&picture)?;
    if let Some(folder) = &arguments.run.dump {
        for (number, step) in renderer.step_pictures(&scene, &plan)?.iter().enumerate() {
            let name = format!("{:02}-{}-{}.png", number + 1, step.pass, step.step);
            write_rgba_png(&step.picture, &folder.join(name))?;
        }
    }
    if !arguments.run.json && !arguments.run.explain {
        return Ok(());
    }
    let frames = arguments.run.frames as usize;
    let times = Summary::new(renderer.time_frames(&scene, &plan, WARM_UP, frames)?);
    let passes = renderer.time_passes(&scene, &plan, frames.min(PASS_FRAMES))?;
    if arguments.run.explain {
        return super::print(&explanation(&plan, &passes, &times, frames));
    }
    super::print_json(&Record {
        version: env!("CARGO_PKG_VERSION"),
        models: model_records(&scene, arguments.models.len()),
        load: arguments.load_options(),
        copies: arguments.copies,
        triangles: scene.triangle_count(),
        style,
        show: arguments.cartoon.show,
        size: scene.size,
        background: scene.background,
        color: scene.color,
        recolor: scene.recolor,
        camera: CameraRecord::new(&scene),
        gl: renderer.context().clone(),
        passes,
        load_ms,
        context_ms,
        warm_up_ms,
        first_frame_ms,
        frame_ms: times,
    })
}

/// A renderer and how long it took to get ready.
struct Opened {
    renderer: Renderer,
    context_ms: f64,
    warm_up_ms: Option<f64>,
}

/// Opens the context and, if the models are not there yet, warms it up.
fn open_renderer(
    arguments: &Arguments,
    settings: &SceneSettings,
    style: &Style,
    models_are_read: impl Fn() -> bool,
) -> Result<Opened> {
    let start = Instant::now();
    let mut renderer = Renderer::new(arguments.run.backend)?;
    let context_ms = milliseconds_since(start);
    let warm_up_ms = if models_are_read() {
        None
    } else {
        let start = Instant::now();
        renderer.warm_up(settings, style, arguments.cartoon.show)?;
        Some(milliseconds_since(start))
    };
    Ok(Opened { renderer, context_ms, warm_up_ms })
}

/// A scene ready to be drawn and how long its models took.
struct Loaded {
    scene: Scene,
    load_ms: f64,
}

/// Reads the models, says what is to be said of them, and puts the scene together.
fn load_scene(arguments: &Arguments, settings: &SceneSettings) -> Result<Loaded> {
    let start = Instant::now();
    let options = arguments.load_options();
    let mut meshes = Vec::new();
    for path in &arguments.models {
        let loaded = load(path, &options)?;
        loaded.remarks.iter().for_each(|remark| super::say(&format!("tinta: {remark}")));
        meshes.push(Arc::new(loaded.mesh));
    }
    let load_ms = milliseconds_since(start);
    let scene = Scene::new(meshes, settings)?;
    scene.make_arrays();
    Ok(Loaded { scene, load_ms })
}

fn make_dump_folder(arguments: &Arguments) -> Result<()> {
    let Some(folder) = &arguments.run.dump else { return Ok(()) };
    std::fs::create_dir_all(folder).map_err(|error| Error::Output {
        path: format!("--dump {}", folder.display()),
        problem: if folder.is_file() {
            "this is a file; name a folder".to_owned()
        } else {
            format!("the folder cannot be made ({error}); choose another")
        },
    })
}

fn model_records(scene: &Scene, models: usize) -> Vec<ModelRecord> {
    scene.objects[..models]
        .iter()
        .map(|object| ModelRecord {
            path: object.mesh.name.clone(),
            vertices: object.mesh.positions.len(),
            triangles: object.mesh.triangles.len(),
            defects: object.mesh.defects.clone(),
        })
        .collect()
}

fn explanation(plan: &tinta::plan::Plan, passes: &[PassTime], times: &Summary, frames: usize) -> String {
    let mut text = plan.to_string();
    text.push_str(&format!("\n{:<20}{:>10}{:>10}\n", "pass", "clock ms", "device ms"));
    for pass in passes {
        let device = pass.gpu_ms.map_or("-".to_owned(), |ms| format!("{ms:.3}"));
        text.push_str(&format!("{:<20}{:>10.3}{:>10}\n", pass.name, pass.cpu_ms, device));
    }
    let count = if frames == 1 { "1 frame".to_owned() } else { format!("the median of {frames} frames") };
    text.push_str(&format!("{:<20}{:>10.3}            with read-back, {count}\n", "whole picture", times.median));
    text
}

impl Arguments {
    fn load_options(&self) -> LoadOptions {
        LoadOptions {
            weld: self.model.weld,
            normals: self.model.normals,
            smooth_angle_degrees: self.model.smooth_angle,
            up_axis: self.model.up_axis,
            strict: self.model.strict,
        }
    }

    fn scene_settings(&self) -> SceneSettings {
        SceneSettings {
            copies: self.copies,
            camera: CameraSettings {
                view: self.camera.view,
                eye: self.camera.eye,
                target: self.camera.target,
                up: self.camera.up,
                fov_y_degrees: self.camera.fov,
                parallel: self.camera.parallel,
                near: self.camera.near,
                far: self.camera.far,
            },
            size: self.size,
            background: if self.transparent { Background::Transparent } else { Background::Color(self.background) },
            color: self.color,
        }
    }

    fn style(&self) -> Style {
        let mut style = Style::named(self.style);
        let cartoon = match &mut style {
            Style::ThreePass(cartoon) | Style::TwoPass(cartoon) => Some(cartoon),
            Style::Phong(phong) => {
                phong.cull_back_faces = self.cull;
                None
            }
        };
        if let Some(cartoon) = cartoon {
            let options = &self.cartoon;
            cartoon.cull_back_faces = self.cull;
            cartoon.tones.count = options.tones;
            [cartoon.tones.diffuse_threshold, cartoon.tones.specular_threshold] = options.tone_thresholds;
            cartoon.tones.levels = options.tone_levels;
            cartoon.tones.lookup = options.tone_lookup;
            cartoon.border = (!options.no_borders)
                .then_some(Border { filter: options.filter, detection_factor: options.detection_factor });
            cartoon.background_square = options.background_quad;
        }
        style
    }
}

fn after_help() -> String {
    let names: Vec<String> =
        BUILTINS.iter().map(|builtin| format!("  builtin:{:<10} {}", builtin.name, builtin.what)).collect();
    format!(
        "Built-in models:\n{}\n\n\
         As published, borders are black and a pixel or two wide at any size, and edges are not smoothed. Facets that\n\
         show as thin lines come from the file's normals: try --normals smooth.",
        names.join("\n")
    )
}

fn parse_vector(text: &str) -> std::result::Result<DVec3, String> {
    parse_numbers::<f64, 3>(text).map(DVec3::from_array)
}

fn parse_pair(text: &str) -> std::result::Result<[f32; 2], String> {
    parse_numbers(text)
}

fn parse_triple(text: &str) -> std::result::Result<[f32; 3], String> {
    parse_numbers(text)
}

fn parse_numbers<T: std::str::FromStr, const N: usize>(text: &str) -> std::result::Result<[T; N], String> {
    let numbers: Vec<T> = text.split(',').map_while(|number| number.trim().parse().ok()).collect();
    let whole = numbers.len() == text.split(',').count();
    numbers
        .try_into()
        .ok()
        .filter(|_| whole)
        .ok_or_else(|| format!("give {N} numbers with commas between them and no blanks"))
}

fn parse_cull(text: &str) -> std::result::Result<bool, String> {
    match text {
        "none" => Ok(false),
        "back" => Ok(true),
        _ => Err("choose none or back".to_owned()),
    }
}

fn parse_switch(text: &str) -> std::result::Result<bool, String> {
    match text {
        "on" => Ok(true),
        "off" => Ok(false),
        _ => Err("choose on or off".to_owned()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::Parser;

    #[derive(Parser)]
    struct Line {
        #[command(flatten)]
        arguments: Arguments,
    }

    #[test]
    fn without_options_the_command_line_means_the_librarys_defaults() {
        let arguments = Line::try_parse_from(["tinta", "a.obj", "-o", "a.png"]).unwrap().arguments;
        assert_eq!(arguments.style(), Style::named(StyleName::ThreePass));
        assert_eq!(arguments.load_options(), LoadOptions::default());
        let (asked, default) = (arguments.scene_settings(), SceneSettings::default());
        assert_eq!(asked.camera, default.camera);
        assert_eq!((asked.copies, asked.size), (default.copies, default.size));
        assert_eq!((asked.background, asked.color), (default.background, default.color));
        assert_eq!(arguments.run.backend, Backend::default());
        assert_eq!(arguments.cartoon.show, Show::default());
    }
}
