//! `tinta edges`: a model's edges by class, how long it takes to find them, and the model with its edges as GLB.

use super::models::load_meshes;
use super::options::{Below, CameraFile, Chosen, OfSubject, Selection};
use super::{Command, Verdict, given};
use std::path::Path;
use std::time::Instant;
use tinta::edges::{self, Class, ClassSet, Classes, CreaseAngle, Eye, SilhouetteRule, Silhouettes};
use tinta::record::{CameraRecord, EdgeRecord, ModelRecord, Summary};
use tinta::renderer::milliseconds_since;
use tinta::settings::Setting;
use tinta::styles::Inking;
use tinta::{EdgeList, Error, LineSettings, Mesh, Result, Scene, Style, StyleName, TextTarget};

/// The command.
pub(super) const COMMAND: Command = Command {
    examples: &[
        "tinta edges cow.obj                             count edges by class",
        "tinta edges cow.obj -o cow.glb                  write the model with its edges",
    ],
    ..Command::new("edges", <Arguments as clap::Args>::augment_args, |matches, _| {
        run(&given::<Arguments>(matches)?).map(|()| Verdict::Good)
    })
};

/// Count a model's edges by class, time how they are found, or write them into a GLB file
#[derive(clap::Args)]
pub(super) struct Arguments {
    /// Model file (OBJ, PLY, STL, MD2, 3DS, glTF, GLB), built-in model, or - for standard input
    #[arg(value_name = "MODEL")]
    model: String,

    /// Repetitions to time [default: 1]
    #[arg(long, value_name = "N", default_value = "1", hide_default_value = true, value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    frames: u32,

    /// GLB file to write: the model with its edges, by EXT_mesh_primitive_edge_visibility; classes and crease angle are then
    /// those of style lines by default
    #[arg(short, long, value_name = "FILE.glb")]
    output: Option<String>,

    /// Print one JSON record [default: off]
    #[arg(long)]
    json: bool,

    #[command(flatten)]
    crease: Chosen<OfEdges>,

    #[command(flatten)]
    camera: CameraFile,

    #[command(flatten)]
    subject: Chosen<OfSubject>,
}

/// The settings of the edge list, the same as in the style inking.
struct OfEdges;

impl Selection for OfEdges {
    type Of = Style;

    fn has(setting: &Setting<Style>) -> bool {
        ["classes", "crease-angle", "silhouette"].contains(&setting.name)
    }
}

pub(super) fn run(arguments: &Arguments) -> Result<()> {
    let style = Style::with_options(StyleName::Inking, &arguments.crease.options)?;
    let Inking { crease_angle, silhouette: rule, classes: chosen, .. } =
        if let Style::Inking(inking) = style { inking } else { Inking::default() };
    if rule == SilhouetteRule::Smooth {
        let problem = "smooth silhouettes run through faces, not along edges; choose paper or exact, or draw them";
        return Err(Error::value("silhouette", rule, problem));
    }
    let has = |name: &str| arguments.crease.options.contains_key(name);
    let target = arguments.output.as_deref().map(check_output).transpose()?;
    // A file is a drawing to others, so it begins with the settings of exact lines.
    let drawing = target.as_ref().map(|_| LineSettings::default());
    let of_drawing = drawing.as_ref().filter(|_| !has("classes")).map(|lines| lines.classes.and(ClassSet::EDGES));
    let wanted = of_drawing.unwrap_or(if has("classes") { chosen } else { ClassSet::EDGES });
    let of_drawing = drawing.as_ref().filter(|_| !has("crease-angle")).map(|lines| lines.crease_angle);
    let crease_angle = of_drawing.unwrap_or(crease_angle);
    let start = Instant::now();
    let below = Below { camera: arguments.camera.camera.as_deref(), ..Below::default() };
    let (request, _) = arguments.subject.request(std::slice::from_ref(&arguments.model), &below)?;
    let mut meshes = load_meshes(&request.models, &request.read)?;
    let load_ms = milliseconds_since(start);
    let scene = Scene::new(meshes.clone(), &request.scene)?;
    let Some(mesh) = meshes.pop() else { return Err(Error::CommandLine { problem: "no model was named".to_owned() }) };
    let eye = scene.eye(&scene.objects[0], rule);
    // Timed like frames: every round repeats all the work.
    let mut times: [Vec<f64>; 4] = Default::default();
    let mut last = None;
    for _ in 0..arguments.frames {
        let found = Found::of(&mesh, crease_angle, wanted, eye, rule);
        times.iter_mut().zip(found.ms).for_each(|(times, time)| times.push(time));
        last = Some(found);
    }
    let Some(Found { edges, classes, silhouette, .. }) = last else { return Ok(()) };
    scene.edges(&scene.objects[0]).remark().iter().for_each(|remark| super::say(&format!("tinta: {remark}")));
    if let Some(target) = target {
        target.write_bytes(&edges::glb(&mesh, &edges, wanted, crease_angle)?)?;
        if target == TextTarget::Stdout {
            return Ok(());
        }
    }
    let mut counts = classes.counts();
    counts.silhouette = if wanted.contains(Class::Silhouette) { silhouette.len() } else { 0 };
    let [build_ms, classify_ms, planes_ms, silhouette_ms] = times.map(Summary::new);
    let record = EdgeRecord {
        version: env!("CARGO_PKG_VERSION"),
        model: ModelRecord::new(&mesh),
        load: request.read,
        edges: edges.len(),
        classes: counts,
        reversed_edges: edges.reversed_edges(),
        crease_angle_degrees: crease_angle.degrees(),
        crease_cosine: crease_angle.cosine,
        silhouette_rule: rule,
        camera: CameraRecord::new(&scene),
        load_ms,
        build_ms,
        classify_ms,
        planes_ms,
        silhouette_ms,
    };
    if arguments.json { super::print_json(&record) } else { super::print(&in_words(&record, wanted)) }
}

/// A mesh's edges, and the milliseconds that building, classifying, the faces' planes and the search took.
struct Found {
    edges: EdgeList,
    classes: Classes,
    silhouette: Vec<u32>,
    ms: [f64; 4],
}

impl Found {
    fn of(mesh: &Mesh, crease_angle: CreaseAngle, wanted: ClassSet, eye: Eye, rule: SilhouetteRule) -> Self {
        let mut clock = Instant::now();
        let mut lap = || milliseconds_since(std::mem::replace(&mut clock, Instant::now()));
        let edges = EdgeList::new(mesh);
        let build = lap();
        let classes = Classes::new(mesh, &edges, crease_angle, wanted);
        let classify = lap();
        let silhouettes = Silhouettes::new(mesh, &edges);
        let planes = lap();
        let silhouette = silhouettes.find(mesh, &edges, eye, rule);
        let search = lap();
        Self { edges, classes, silhouette, ms: [build, classify, planes, search] }
    }
}

/// Checks the file to write.
fn check_output(output: &str) -> Result<TextTarget> {
    let is_glb = Path::new(output).extension().is_some_and(|ending| ending.eq_ignore_ascii_case("glb"));
    if output != "-" && !is_glb {
        return Err(Error::output(output, "edges are written as GLB; choose a name that ends in .glb"));
    }
    super::messages::check_output(output)?;
    TextTarget::check(output)
}

fn in_words(record: &EdgeRecord, wanted: ClassSet) -> String {
    let mut counts = record.classes;
    let mut text = format!("{:<16}{:>10}\n", "edges", record.edges);
    for class in wanted.and(ClassSet::EDGES).classes() {
        let name = class.name();
        let what = match class {
            Class::Boundary => "one face",
            Class::NonManifold => "three faces or more",
            Class::Silhouette => "between a face seen from the front and one that is not",
            Class::Crease => "sharper than the crease angle",
            Class::ConvexCrease => "of these convex",
            Class::ConcaveCrease => "of these concave",
            Class::Material => "between two materials",
            Class::Texture => "between different texture coordinates",
            Class::Normal => "between different vertex normals",
            Class::Part => "between two parts",
            Class::Marked => "marked by the file",
            Class::Intersection => "where faces pass through one another",
            Class::Suggestive | Class::Ridge | Class::Valley | Class::ApparentRidge => "faces with such a line",
            Class::Curve => "segments of the model's own curves",
            Class::Point => "the model's own points",
        };
        text.push_str(&format!("  {name:<14}{:>10}  {what}\n", counts.of(class)));
    }
    if record.reversed_edges > 0 {
        text.push_str(&format!("  {:<14}{:>10}  faces wound against each other\n", "reversed", record.reversed_edges));
    }
    text.push_str(&format!("\n{:<16}{:>10}{:>10}{:>10}\n", "milliseconds", "median", "min", "max"));
    for (name, times) in [
        ("build", &record.build_ms),
        ("classify", &record.classify_ms),
        ("planes", &record.planes_ms),
        ("silhouette", &record.silhouette_ms),
    ] {
        text.push_str(&format!("{name:<16}{:>10.3}{:>10.3}{:>10.3}\n", times.median, times.min, times.max));
    }
    text
}
