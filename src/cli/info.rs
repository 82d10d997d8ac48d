//! `tinta info`: whether tinta works here, with the properties of every backend or why it failed; or a model's edges by class.

use super::models::load_meshes;
use super::options::{GivenOptions, Selection};
use super::{Command, Verdict, given};
use serde_json::json;
use tinta::drivers::{DriverCheck, DriverFindings, check};
use tinta::edges::{Class, ClassCounts, ClassSet, Classes, SilhouetteRule, Silhouettes};
use tinta::gl::context::{Attempt, Outcome, attempts};
use tinta::glam::DVec3;
use tinta::mesh::UpAxis;
use tinta::record::{CameraRecord, ModelRecord};
use tinta::settings::Setting;
use tinta::styles::Inking;
use tinta::{Backend, Error, LoadOptions, Result, Scene, SceneSettings, Style, StyleName};

/// The command.
pub(super) const COMMAND: Command = Command {
    examples: &[
        "tinta info                                      say whether tinta works here",
        "tinta info cow.obj                              count its edges by class",
    ],
    ..Command::new("info", <Arguments as clap::Args>::augment_args, |matches, _| run(&given::<Arguments>(matches)?))
};

/// Show whether tinta works here and with which drivers, or count a model's edges by class
#[derive(clap::Args)]
#[command(after_help = "\
Exit code: 0 if a context works, and with --check if all draw as they should; 1 if one does not; 2 if none works. --check also names \
the known faults of each driver.")]
pub(super) struct Arguments {
    /// Model file (FORMATS), built-in model, or - for standard input [default: none, show the drivers]
    #[arg(value_name = "MODEL")]
    model: Option<String>,

    /// Backends to try: auto (all), egl, surfaceless, osmesa, wgl, cgl [default: auto]
    #[arg(long, value_name = "BACKEND", default_value = "auto", hide_default_value = true, conflicts_with = "model")]
    backend: Backend,

    /// Draw small scenes in every style on each, compare them with reference pictures, and ask about copies, offsets, smoothed lines and alpha [default: off]
    #[arg(long, conflicts_with = "model")]
    check: bool,

    /// Print one JSON object instead of text [default: off]
    #[arg(long)]
    json: bool,

    #[command(flatten)]
    crease: GivenOptions<OfEdges>,

    #[command(flatten)]
    read: GivenOptions<OfReading>,
}

/// The setting of the edge list, the same as in the style inking.
struct OfEdges;

impl Selection for OfEdges {
    type Of = Style;

    fn has(setting: &Setting<Style>) -> bool {
        setting.name == "crease-angle"
    }
}

/// How a model is read.
struct OfReading;

impl Selection for OfReading {
    type Of = LoadOptions;
}

pub(super) fn run(arguments: &Arguments) -> Result<Verdict> {
    if let Some(model) = &arguments.model {
        return edges(model, arguments).map(|()| Verdict::Good);
    }
    if let Some(option) = arguments.crease.options.keys().chain(arguments.read.options.keys()).next() {
        let problem = format!("--{option}: it counts a model's edges; name the model");
        return Err(Error::CommandLine { problem });
    }
    if arguments.check {
        return run_check(arguments);
    }
    let attempts = attempts(arguments.backend);
    if arguments.json {
        super::print_json(&serde_json::json!({ "version": env!("CARGO_PKG_VERSION"), "attempts": attempts }))?;
    } else {
        super::print(&(works(&attempts) + &attempts.iter().map(in_words).collect::<String>()))?;
    }
    if attempts.iter().any(|attempt| matches!(attempt.outcome, Outcome::Context(_))) {
        return Ok(Verdict::Good);
    }
    let reason = |attempt: Attempt| match attempt.outcome {
        Outcome::Error(reason) => format!("{}: {reason}", attempt.device),
        Outcome::Context(_) => attempt.device,
    };
    Err(Error::NoContext { attempts: attempts.into_iter().map(reason).collect() })
}

/// The first line: the driver of the first context, with which tinta draws; empty where none works.
fn works(attempts: &[Attempt]) -> String {
    let info = |attempt: &Attempt| match &attempt.outcome {
        Outcome::Context(info) => {
            Some(format!("tinta works: it draws with {}, OpenGL {}\n\n", info.renderer, info.version))
        }
        Outcome::Error(_) => None,
    };
    attempts.iter().find_map(info).unwrap_or_default()
}

/// Checks every context there is.
fn run_check(arguments: &Arguments) -> Result<Verdict> {
    let checked = check(arguments.backend);
    if arguments.json {
        super::print_json(&serde_json::json!({ "version": env!("CARGO_PKG_VERSION"), "checked": checked }))?;
    } else {
        super::print(&checked.iter().map(checked_in_words).collect::<String>())?;
    }
    let found: Vec<&DriverFindings> = checked.iter().filter_map(|checked| checked.found.as_ref()).collect();
    match (found.is_empty(), found.iter().all(|found| found.is_good())) {
        (true, _) => {
            let reason = |checked: DriverCheck| format!("{}: {}", checked.device, checked.error.unwrap_or_default());
            Err(Error::NoContext { attempts: checked.into_iter().map(reason).collect() })
        }
        (false, true) => Ok(Verdict::Good),
        (false, false) => Ok(Verdict::Different),
    }
}

fn checked_in_words(checked: &DriverCheck) -> String {
    let Some(found) = &checked.found else {
        let error = checked.error.clone().unwrap_or_default();
        return format!("{}\n  no context: {error}\n\n", checked.device);
    };
    let mut text = format!("{}\n  {}, {}\n", checked.device, found.context.renderer, found.context.version);
    let mut add = |passed: bool, name: &str, what: &str| {
        text += &format!("  {:<5}{name:<26}{what}\n", if passed { "ok" } else { "NOT" });
    };
    for drawn in &found.styles {
        let what = match (&drawn.problem, drawn.differing) {
            (Some(problem), _) => problem.clone(),
            (None, Some(0)) => "the reference, byte for byte".to_owned(),
            (None, differing) => format!(
                "{} pixels differ, {} of them in shade, by at most {} of 255",
                differing.unwrap_or_default(),
                drawn.of_other_shades,
                drawn.largest
            ),
        };
        add(drawn.passed, drawn.style, &what);
    }
    found.probes.iter().for_each(|probe| add(probe.passed, probe.name, &probe.counted));
    if let Some(problem) = &found.not_probed {
        add(false, "its answers", problem);
    }
    for fault in &found.known_faults {
        text += &format!(
            "  known: {}\n         seen in {}, last in {}; {}\n",
            fault.name, fault.first_seen, fault.last_seen, fault.workaround
        );
    }
    text + "\n"
}

fn in_words(attempt: &Attempt) -> String {
    let info = match &attempt.outcome {
        Outcome::Error(reason) => return format!("{}\n  no context: {reason}\n\n", attempt.device),
        Outcome::Context(info) => info,
    };
    let yes = |is: bool| if is { "yes" } else { "no" }.to_owned();
    let rows = [
        ("vendor", info.vendor.clone()),
        ("renderer", info.renderer.clone()),
        ("GL version", info.version.clone()),
        ("GLSL version", info.glsl_version.clone()),
        ("alpha, depth bits", format!("{}, {}", info.alpha_bits, info.depth_bits)),
        ("line widths", format!("{} to {} px", info.aliased_line_width[0], info.aliased_line_width[1])),
        ("smooth line widths", format!("{} to {} px", info.smooth_line_width[0], info.smooth_line_width[1])),
        ("point sizes", format!("{} to {} px", info.aliased_point_size[0], info.aliased_point_size[1])),
        ("smooth point sizes", format!("{} to {} px", info.smooth_point_size[0], info.smooth_point_size[1])),
        ("largest picture", format!("{} px", info.largest_picture)),
        ("draws into textures", yes(info.framebuffer_objects)),
        ("draws into at once", info.draw_buffers.to_string()),
        ("draws floating point", yes(info.float_targets)),
        ("timer queries", yes(info.timer_queries)),
    ];
    let lines: String = rows.iter().map(|(name, value)| format!("  {name:<21}{value}\n")).collect();
    format!("{}\n{lines}\n", attempt.device)
}

/// Prints a model's edges by class.
fn edges(model: &str, arguments: &Arguments) -> Result<()> {
    let Style::Inking(Inking { crease_angle, .. }) = Style::with_options(StyleName::Inking, &arguments.crease.options)?
    else {
        return Ok(());
    };
    let (mut read, rule) = (arguments.read.settings()?, SilhouetteRule::Exact);
    read.section.iter_mut().flat_map(|planes| &mut planes.0).for_each(|plane| plane.is_of_file = true);
    let scene = Scene::new(load_meshes(&[model.to_owned()], &read)?, &SceneSettings::default())?;
    let Some(object) = scene.objects.first() else { return Ok(()) };
    let (mesh, found) = (&object.mesh, scene.edges(object));
    found.remark().iter().for_each(|remark| super::say(&format!("tinta: {remark}")));
    let list = found.list();
    let mut counts = Classes::new(mesh, list, crease_angle, ClassSet::EDGES).counts();
    counts.silhouette = Silhouettes::new(mesh, list).find(mesh, list, scene.eye(object, rule), rule).len();
    if !arguments.json {
        // Any given axis keeps the file's coordinates.
        let of_file = LoadOptions { up_axis: UpAxis::Y, section: None, ..read };
        let (low, high) = super::models::read(model, &of_file)?.mesh.extent();
        let names: Vec<String> = mesh.parts.iter().map(|part| super::plain(&part.name)).collect();
        let size = format!(
            "{:<16}{} to {}, in the axes of the file, as for --section\n",
            "size",
            low + DVec3::ZERO,
            high + DVec3::ZERO
        );
        let parts = if names.is_empty() { String::new() } else { format!("{:<16}{}\n", "parts", names.join(", ")) };
        return super::print(&(size + &parts + &edges_in_words(list.len(), counts, list.reversed_edges())));
    }
    let classes: Vec<Class> = ClassSet::EDGES.classes().collect();
    let classes = classes.into_iter().map(|class| (class.name().to_owned(), json!(*counts.of(class))));
    super::print_json(&json!({
        "version": env!("CARGO_PKG_VERSION"),
        "model": ModelRecord::new(mesh),
        "load": read,
        "edges": list.len(),
        "classes": classes.collect::<serde_json::Map<_, _>>(),
        "reversed_edges": list.reversed_edges(),
        "crease_angle_degrees": crease_angle.degrees(),
        "crease_cosine": crease_angle.cosine,
        "camera": CameraRecord::new(&scene),
    }))
}

fn edges_in_words(edges: usize, mut counts: ClassCounts, reversed: usize) -> String {
    let mut text = format!("{:<16}{edges:>10}\n", "edges");
    for class in ClassSet::EDGES.classes() {
        let what = match class {
            Class::Boundary => "one face",
            Class::NonManifold => "three faces or more",
            Class::Silhouette => "where the surface turns away, in the view iso",
            Class::Crease => "sharper than the crease angle",
            Class::ConvexCrease => "of these convex",
            Class::ConcaveCrease => "of these concave",
            Class::Material => "between two materials",
            Class::Texture => "between different texture coordinates",
            Class::Normal => "between different vertex normals",
            Class::Part => "between two parts",
            Class::Marked => "marked by the file",
            Class::Tangent => "where a rounding begins",
            // No edges of the mesh.
            _ => continue,
        };
        text.push_str(&format!("  {:<14}{:>10}  {what}\n", class.name(), *counts.of(class)));
    }
    if reversed > 0 {
        text.push_str(&format!("  {:<14}{reversed:>10}  faces wound against each other\n", "reversed"));
    }
    text
}
