//! `tinta looks`: what a model looks like in each look.

use super::session::Session;
use super::{Stop, carry_out_render, parse};
use std::ffi::OsString;
use std::fmt::Write;
use std::path::{Path, PathBuf};
use tinta::markup::escaped;
use tinta::page::{Pictures, beginning};
use tinta::preset::{LOOKS, Look, OptionValue};
use tinta::{Error, Result, SceneSettings, Size, TextTarget};

/// Say what looks there are, or draw a model in each
#[derive(clap::Args)]
pub(super) struct Arguments {
    /// Model file or built-in model [default: builtin:bust]
    #[arg(value_name = "MODEL", default_value = "builtin:bust", hide_default_value = true)]
    model: String,

    /// Folder for a picture in each look and index.html, which shows them side by side; created if missing [default: none, the looks are listed]
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,

    #[arg(long, value_name = "WxH", default_value_t = default_size(), hide_default_value = true, help = format!(
        "Size in pixels, or one number for a square [default: {}]", default_size()
    ))]
    size: Size,
}

/// The size of the look that is drawn where nothing is asked for, here of all of them.
fn default_size() -> Size {
    let options = LOOKS[0].preset().map(|look| look.options).unwrap_or_default();
    let size =
        options.get("size").and_then(|size| if let OptionValue::Text(size) = size { size.parse().ok() } else { None });
    size.unwrap_or(SceneSettings::default().size)
}

/// Lists or draws them.
pub(super) fn run(arguments: &Arguments) -> Result<()> {
    let Some(folder) = &arguments.output else { return super::print(&list()) };
    super::make_folder(folder)?;
    let mut session = Session::for_one();
    for look in LOOKS {
        let words = words(&arguments.model, look, arguments.size, &folder.join(file(look)));
        let (parsed, given) = parse(words.into_iter().map(OsString::from)).map_err(|stop| match stop {
            Stop::Wrong(error) => error,
            Stop::Help(help) => Error::CommandLine { problem: help.to_string() },
        })?;
        carry_out_render(parsed, &given, &mut session)?;
    }
    let page = folder.join("index.html");
    TextTarget::check(&page.display().to_string())?.write(&html(&arguments.model, arguments.size))?;
    super::print(&format!("{}\n", page.display()))
}

/// A line for each.
fn list() -> String {
    let mut text = String::new();
    for look in LOOKS {
        let _ = writeln!(text, "{:<10} {}", look.name, look.about);
    }
    text + "\ntinta looks MODEL -o looks draws them; tinta render MODEL -o picture.png --look NAME draws one\n"
}

/// The file of a look: vectors where it draws lines.
fn file(look: Look) -> String {
    format!("{}.{}", look.name, if look.draws_lines() { "svg" } else { "png" })
}

fn words(model: &str, look: Look, size: Size, output: &Path) -> Vec<String> {
    let output = output.display().to_string();
    let size = size.to_string();
    ["tinta", "render", model, "-o", &output, "--look", look.name, "--size", &size].map(str::to_owned).to_vec()
}

/// The page, which needs the pictures beside it and nothing else.
fn html(model: &str, size: Size) -> String {
    let mut figures = String::new();
    for look in LOOKS {
        let (file, model) = (file(look), escaped(model));
        let _ = write!(
            figures,
            "<figure>\n<a class=\"picture\" href=\"{file}\"><img src=\"{file}\" alt=\"{model} in the look {name}\" \
             width=\"{}\" height=\"{}\"/></a>\n<figcaption><strong>{name}</strong>: {}<br/>\
             <code>tinta render {model} -o {file} --look {name} --size {size}</code></figcaption>\n</figure>\n",
            size.width,
            size.height,
            escaped(look.about),
            name = look.name,
        );
    }
    beginning("Looks", Pictures::Beside)
        + &format!("<h1>Looks</h1>\n<main class=\"pictures\">\n{figures}</main>\n</body>\n</html>\n")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_look_is_listed_and_can_be_drawn_in_its_size() {
        let size = Size { width: 32, height: 24 };
        for look in LOOKS {
            assert!(
                list().contains(look.about) && html("a<b.obj", size).contains(&escaped(look.about)),
                "{}",
                look.name
            );
            let words = words("builtin:bust", look, size, Path::new("a.png").with_file_name(file(look)).as_path());
            assert!(super::super::check(words.into_iter().map(OsString::from)).is_ok(), "{}", look.name);
        }
        assert!(html("a<b.obj", size).contains("a&lt;b.obj") && !html("a<b.obj", size).contains("a<b"));
        assert_eq!(file(LOOKS[1]), "technical.svg");
        // What is written is as large as its look wants, unless a size is given; published styles are as large as the paper's pictures.
        for (more, size) in [
            ("a.png", [1280, 960]),
            ("a.png --look charcoal", [1280, 960]),
            ("a.svg --look technical", [1280, 960]),
            ("a.png --look print --style inking", [1280, 960]),
            ("a.png --look published", [512, 512]),
            ("a.png --style ink", [512, 512]),
            ("a.png --preset paper:dachsbacher-inking", [512, 512]),
            ("a.svg", [512, 512]),
            ("a.png --look print --size 64x32", [64, 32]),
        ] {
            let words = format!("tinta render builtin:bust -o {more}");
            let (parsed, _) = parse(words.split(' ').map(OsString::from)).unwrap();
            let super::super::Command::Render(render) = parsed.command else { panic!("{words}") };
            assert_eq!(render.size().unwrap(), Size { width: size[0], height: size[1] }, "{words}");
        }
        assert_eq!(default_size(), Size { width: 1280, height: 960 });
    }
}
