//! `tinta info`: tries every backend and prints its properties or why it failed.

use super::Verdict;
use super::{Command, given};
use tinta::drivers::{Checked, Found, check};
use tinta::gl::context::{Attempt, Outcome, attempts};
use tinta::{Backend, Error, Result};

/// The command.
pub(super) const COMMAND: Command = Command {
    examples: &["tinta info                                      list the OpenGL backends"],
    ..Command::new("info", <Arguments as clap::Args>::augment_args, |matches, _| run(&given::<Arguments>(matches)?))
};

/// Show which OpenGL backends work on this machine, and why the others do not
#[derive(clap::Args)]
#[command(after_help = "\
Exit code: 0 if a context works, and with --check if all draw as they should; 1 if one does not; 2 if none works. --check also names \
the known faults of each driver.")]
pub(super) struct Arguments {
    /// Backends to try: auto (all), egl, surfaceless, osmesa, wgl, cgl [default: auto]
    #[arg(long, value_name = "BACKEND", default_value = "auto", hide_default_value = true)]
    backend: Backend,

    /// Draw small scenes in every style on each, compare them with reference pictures, and ask about copies, offsets, smoothed lines and alpha [default: off]
    #[arg(long)]
    check: bool,

    /// Print one JSON object instead of text [default: off]
    #[arg(long)]
    json: bool,
}

pub(super) fn run(arguments: &Arguments) -> Result<Verdict> {
    if arguments.check {
        return run_check(arguments);
    }
    let attempts = attempts(arguments.backend);
    if arguments.json {
        super::print_json(&serde_json::json!({ "version": env!("CARGO_PKG_VERSION"), "attempts": attempts }))?;
    } else {
        super::print(&attempts.iter().map(in_words).collect::<String>())?;
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

/// Checks every context there is.
fn run_check(arguments: &Arguments) -> Result<Verdict> {
    let checked = check(arguments.backend);
    if arguments.json {
        super::print_json(&serde_json::json!({ "version": env!("CARGO_PKG_VERSION"), "checked": checked }))?;
    } else {
        super::print(&checked.iter().map(checked_in_words).collect::<String>())?;
    }
    let found: Vec<&Found> = checked.iter().filter_map(|checked| checked.found.as_ref()).collect();
    match (found.is_empty(), found.iter().all(|found| found.is_good())) {
        (true, _) => {
            let reason = |checked: Checked| format!("{}: {}", checked.device, checked.error.unwrap_or_default());
            Err(Error::NoContext { attempts: checked.into_iter().map(reason).collect() })
        }
        (false, true) => Ok(Verdict::Good),
        (false, false) => Ok(Verdict::Different),
    }
}

fn checked_in_words(checked: &Checked) -> String {
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
