//! `tinta measure`: every style's error against its run time, on the user's own models and machine.

mod settings;

use super::options::{CameraArguments, ModelArguments};
use super::progress::Progress;
use settings::settings;
use std::path::PathBuf;
use std::sync::Arc;
use std::time::{Duration, Instant};
use tinta::measure::{MeasureSettings, Setting, Subject, measure, steps};
use tinta::mesh::load;
use tinta::renderer::milliseconds_since;
use tinta::{Backend, Error, Mesh, Renderer, Result, Scene, SceneSettings, Show, Size, Style, StyleName};

/// Measure every style's error against its run time; a table, plots and a page come out
#[derive(clap::Args)]
pub struct Arguments {
    /// Model files (OBJ, PLY, STL, MD2, 3DS) or built-in models, each measured by itself
    #[arg(value_name = "MODEL", required_unless_present_any = ["suite", "merge"])]
    models: Vec<String>,

    /// Built-in models together: papers (bust, ant), solids (gear, open box), all
    #[arg(long, value_name = "SUITE", value_parser = parse_suite)]
    suite: Option<Suite>,

    /// Folder for results.jsonl, results.csv, plots and report.html
    #[arg(short, long, value_name = "DIR")]
    output: PathBuf,

    /// Sizes in pixels with commas between [default: 512x512]
    #[arg(long, value_name = "SIZES", value_delimiter = ',', default_value = "512x512", hide_default_value = true)]
    size: Vec<Size>,

    /// Styles with commas between [default: all]
    #[arg(long, value_name = "STYLES", value_delimiter = ',')]
    styles: Vec<StyleName>,

    /// Frames of each setting that are timed [default: 21, with --quick 7]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=100_000))]
    frames: Option<u32>,

    /// Fewer settings and frames [default: off]
    #[arg(long)]
    quick: bool,

    /// Distance within which ink and line count as the same, pixels [default: 2]
    #[arg(long, value_name = "PIXELS", default_value = "2", hide_default_value = true, allow_hyphen_values = true)]
    tolerance: f64,

    /// Go on where an interrupted run in the same folder stopped [default: off]
    #[arg(long, conflicts_with = "merge")]
    resume: bool,

    /// Put results of several runs or machines together instead of measuring
    #[arg(long, value_name = "FILE", num_args = 1.., conflicts_with_all = ["models", "suite"])]
    merge: Vec<PathBuf>,

    /// What this machine is called in the report [default: system, processor, threads]
    #[arg(long, value_name = "NAME")]
    machine: Option<String>,

    /// OpenGL from: egl, osmesa, auto (the first that works) [default: auto]
    #[arg(long, value_name = "BACKEND", default_value = "auto", hide_default_value = true)]
    backend: Backend,

    #[command(flatten)]
    camera: CameraArguments,

    #[command(flatten)]
    model: ModelArguments,
}

/// Built-in models that are measured together.
type Suite = &'static [&'static str];

fn parse_suite(text: &str) -> std::result::Result<Suite, String> {
    match text {
        "papers" => Ok(&["builtin:bust", "builtin:ant"]),
        "solids" => Ok(&["builtin:gear", "builtin:open-box"]),
        "all" => Ok(&["builtin:bust", "builtin:ant", "builtin:gear", "builtin:open-box"]),
        _ => Err("choose papers, solids or all".to_owned()),
    }
}
