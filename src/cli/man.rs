//! A manual page for the program and one for each command.
//!
//! clap_mangen writes names, synopses and options from the definition that also reads the command line. Examples, exit
//! codes, environment and the texts below `--help` are put below them.

use super::Program;
use clap::Command;
use clap_mangen::Man;
use roff::{Roff, bold, roman};

/// A manual page.
pub(super) struct Page {
    /// Its file: `tinta-render.1`.
    pub file: String,
    /// The page in man's language.
    pub text: String,
}

/// The description of the program, for its own page.
const DESCRIPTION: &str = "Draws 3D models as cartoons, ink, charcoal and line art. It runs OpenGL 2.1 programs \
published between 2001 and 2007, almost as printed, and computes exact visible lines. It needs neither a display nor a \
graphics card: OpenGL comes from EGL or OSMesa, and Mesa's software renderer is enough. Models are files, or built in, \
such as builtin:bust. Each command has its own page with all its options and their defaults.";

/// Where a window opens.
const DISPLAY: (&str, &str) =
    ("DISPLAY, WAYLAND_DISPLAY", "Where tinta view opens its window. All other commands need no display.");

/// Variables that Mesa reads.
const ENVIRONMENT: [(&str, &str); 3] = [
    ("GALLIUM_DRIVER", "Mesa's software driver: llvmpipe, or the slower softpipe. Unset, Mesa chooses."),
    ("LIBGL_ALWAYS_SOFTWARE", "Set to 1, Mesa draws in software and ignores graphics cards."),
    ("LP_NUM_THREADS", "Number of threads that Mesa's llvmpipe draws with; unset, one for each core."),
];

/// The command that opens no OpenGL.
const WITHOUT_OPENGL: &str = "generate";

/// The meaning of each exit code.
const EXIT_CODES: [(&str, &str); 4] = [
    ("0", "Done."),
    (
        "1",
        "A check found a difference: pictures that should be equal differ, a case did not end as it must, or a job of a batch failed.",
    ),
    ("2", "Not done; one sentence on standard error says why."),
    ("130 and 143", "Stopped by Ctrl-C or SIGTERM: exact lines are not written; of a batch jobs are left to do."),
];

/// Further ones of `tinta batch`.
const EXIT_CODES_OF_BATCH: [(&str, &str); 1] = [("75", "Another run is working on the same slice; try again later.")];

pub(super) fn pages(program: &Program) -> Vec<Page> {
    let mut whole = program.command_line().disable_help_subcommand(true);
    whole.build();
    let examples = examples(&whole);
    let all: Vec<String> = whole.get_subcommands().map(|command| command.get_name().to_owned()).collect();
    let of_all = Page { file: "tinta.1".to_owned(), text: page(&whole, &examples, &all) };
    let of_commands = whole.get_subcommands().map(|command| {
        let name = command.get_name();
        let own: Vec<String> =
            examples.iter().filter(|example| example.split_whitespace().nth(1) == Some(name)).cloned().collect();
        Page { file: format!("tinta-{name}.1"), text: page(command, &own, &[]) }
    });
    std::iter::once(of_all).chain(of_commands).collect()
}

/// The examples below the program's help; a second line stays with its first.
fn examples(whole: &Command) -> Vec<String> {
    let text = whole.get_after_help().map(ToString::to_string).unwrap_or_default();
    let lines = text.lines().skip_while(|line| *line != "Examples:").skip(1).take_while(|line| !line.is_empty());
    let mut examples: Vec<String> = Vec::new();
    for line in lines.filter_map(|line| line.strip_prefix("  ")) {
        match examples.last_mut() {
            Some(example) if line.starts_with(' ') => *example = format!("{example}\n{line}"),
            _ => examples.push(line.to_owned()),
        }
    }
    examples
}

/// A page; the program's own names `commands`.
pub(super) fn page(command: &Command, examples: &[String], commands: &[String]) -> String {
    let usage = command.clone().render_usage().to_string();
    let usage = usage.strip_prefix("Usage: ").unwrap_or(&usage).to_owned();
    let man = Man::new(command.clone().override_usage(usage));
    // roff omits an empty date, which would shift the following fields.
    let title = command.get_display_name().unwrap_or("tinta");
    let mut text = format!(".TH {title} 1 \"\" \"tinta {}\" \"tinta\"\n", env!("CARGO_PKG_VERSION"));
    text += &written(|out| man.render_name_section(out));
    text += &written(|out| man.render_synopsis_section(out));
    let mut description = Roff::new();
    description.control("SH", ["DESCRIPTION"]);
    if commands.is_empty() {
        let about = command.get_about().map(ToString::to_string).unwrap_or_default();
        let more = command.get_after_help().map(ToString::to_string).unwrap_or_default();
        described(&mut description, &format!("{about}.\n\n{more}"));
    } else {
        described(&mut description, DESCRIPTION);
    }
    text += &description.render();
    text += &with_subsections(command, &written(|out| man.render_options_section(out)));
    if !commands.is_empty() {
        text += &written(|out| man.render_subcommands_section(out)).replace(".SH SUBCOMMANDS", ".SH COMMANDS");
    }
    let mut rest = Roff::new();
    if !examples.is_empty() {
        rest.control("SH", ["EXAMPLES"]);
        as_it_stands(&mut rest, examples.iter().flat_map(|example| example.lines()));
    }
    listed(&mut rest, "EXIT STATUS", &EXIT_CODES);
    if command.get_name() == "batch" {
        EXIT_CODES_OF_BATCH.iter().for_each(|code| row(&mut rest, *code));
    }
    if command.get_name() != WITHOUT_OPENGL {
        listed(&mut rest, "ENVIRONMENT", &ENVIRONMENT);
        if command.get_name() == "view" || !commands.is_empty() {
            row(&mut rest, DISPLAY);
        }
    }
    rest.control("SH", ["SEE ALSO"]);
    let others: Vec<String> = match commands {
        [] => vec!["tinta(1)".to_owned()],
        commands => commands.iter().map(|name| format!("tinta-{name}(1)")).collect(),
    };
    rest.text([roman(others.join(", "))]);
    text + &rest.render()
}

/// Writes into memory, where writing does not fail.
fn written(write: impl Fn(&mut dyn std::io::Write) -> std::io::Result<()>) -> String {
    let mut text = Vec::new();
    let _ = write(&mut text);
    String::from_utf8_lossy(&text).into_owned()
}

/// clap_mangen makes a section of each group of options, in capitals; here they are parts of one.
fn with_subsections(command: &Command, options: &str) -> String {
    let mut headings: Vec<&str> = Vec::new();
    for heading in command.get_arguments().filter_map(|arg| arg.get_help_heading()) {
        if !headings.contains(&heading) {
            headings.push(heading);
        }
    }
    let mut headings = headings.into_iter();
    let lines = options.lines().map(|line| match line.starts_with(".SH ") && line != ".SH OPTIONS" {
        true => Roff::new().control("SS", headings.next()).to_roff(),
        false => format!("{line}\n"),
    });
    lines.collect()
}

/// Paragraphs; lines indented by two blanks stay unchanged.
fn described(page: &mut Roff, text: &str) {
    for (number, paragraph) in text.trim_end().split("\n\n").enumerate() {
        if number > 0 {
            page.control("PP", []);
        }
        let (set_in, running): (Vec<&str>, Vec<&str>) = paragraph.lines().partition(|line| line.starts_with("  "));
        running.into_iter().for_each(|line| {
            page.text([roman(line)]);
        });
        if !set_in.is_empty() {
            page.control("PP", []);
            as_it_stands(page, set_in.into_iter());
        }
    }
}

fn as_it_stands<'a>(page: &mut Roff, lines: impl Iterator<Item = &'a str>) {
    page.control("nf", []);
    lines.for_each(|line| {
        page.text([roman(line)]);
    });
    page.control("fi", []);
}

fn listed(page: &mut Roff, heading: &str, rows: &[(&str, &str)]) {
    page.control("SH", [heading]);
    rows.iter().for_each(|named| row(page, *named));
}

fn row(page: &mut Roff, (name, what): (&str, &str)) {
    page.control("TP", []).text([bold(name)]).text([roman(what)]);
}

#[cfg(test)]
mod tests;
