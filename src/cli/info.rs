//! `tinta info`: tries every backend and prints its properties or why it failed.

use tinta::gl::context::{Attempt, Outcome, attempts};
use tinta::{Backend, Error, Result};

/// Show which OpenGL backends work on this machine, and why the others do not
#[derive(clap::Args)]
pub(super) struct Arguments {
    /// Backends to try: auto (all), egl, surfaceless, osmesa, wgl, cgl [default: auto]
    #[arg(long, value_name = "BACKEND", default_value = "auto", hide_default_value = true)]
    backend: Backend,

    /// Print one JSON object instead of text [default: off]
    #[arg(long)]
    json: bool,
}

pub(super) fn run(arguments: &Arguments) -> Result<()> {
    let attempts = attempts(arguments.backend);
    if arguments.json {
        super::print_json(&serde_json::json!({ "version": env!("CARGO_PKG_VERSION"), "attempts": attempts }))?;
    } else {
        super::print(&attempts.iter().map(in_words).collect::<String>())?;
    }
    if attempts.iter().any(|attempt| matches!(attempt.outcome, Outcome::Context(_))) {
        return Ok(());
    }
    let reason = |attempt: Attempt| match attempt.outcome {
        Outcome::Error(reason) => format!("{}: {reason}", attempt.device),
        Outcome::Context(_) => attempt.device,
    };
    Err(Error::NoContext { attempts: attempts.into_iter().map(reason).collect() })
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
