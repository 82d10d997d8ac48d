//! `tinta looks`: draws a model in each look.

use super::render;
use super::run_settings::RunSettings;
use super::{Command, Verdict, given};
use std::fmt::Write;
use std::path::PathBuf;
use tinta::markup::escaped;
use tinta::page::{Pictures, beginning};
use tinta::preset::{LOOKS, Look};
use tinta::request::{Request, layers};
use tinta::settings::{OptionValue, Options};
use tinta::{Result, SceneSettings, Size, TextTarget};

/// The command.
pub(super) const COMMAND: Command = Command {
    examples: &["tinta looks cow.obj -o looks                    draw it in every look"],
    ..Command::new("looks", <Arguments as clap::Args>::augment_args, |matches, _| {
        run(&given::<Arguments>(matches)?).map(|()| Verdict::Good)
    })
};

/// List the looks, or draw a model in each
#[derive(clap::Args)]
pub(super) struct Arguments {
    /// Model file or built-in model [default: builtin:bust]
    #[arg(value_name = "MODEL", default_value = "builtin:bust", hide_default_value = true)]
    model: String,

    /// Folder for a picture in each look, as pixels and as vectors where it has them, and index.html, which shows them side by side; created if missing [default: none, list the looks]
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,

    #[arg(long, value_name = "WxH", default_value_t = default_size(), hide_default_value = true, help = format!(
        "Size in pixels, or one number for a square [default: {}]", default_size()
    ))]
    size: Size,
}

/// The size of the default look, used here for all looks.
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
    let mut session = super::models::session();
    for look in LOOKS {
        let request = request(look, arguments.size)?.with_models(vec![arguments.model.clone()]);
        for file in files(look, &request) {
            let output = folder.join(file).display().to_string();
            render::render(&request, &RunSettings::default(), &output, &[], &mut session)?;
        }
    }
    let page = folder.join("index.html");
    TextTarget::check(&page.display().to_string())?.write(&html(&arguments.model, arguments.size)?)?;
    super::print(&format!("{}\n", page.display()))
}

/// A look in this size.
fn request(look: Look, size: Size) -> Result<Request> {
    let size = Options::from([("size".to_owned(), OptionValue::text(size.to_string()))]);
    Ok(Request::from_layers(&layers(Some(look), Vec::new(), size, look.draws_lines()))?.0)
}

/// A line for each.
fn list() -> String {
    let mut text = String::new();
    for look in LOOKS {
        let _ = writeln!(text, "{:<10} {}", look.name, look.about);
    }
    text + "\nDraw a model in every look:  tinta looks MODEL -o looks\nDraw it in one look:         tinta render MODEL -o picture.png --look NAME\n"
}

/// The files of a look: pixels unless it draws lines, and vectors where it has them.
fn files(look: Look, request: &Request) -> Vec<String> {
    let has_vectors = look.draws_lines() || request.style.vectors(request.scene.size).is_some();
    let kinds = [("png", !look.draws_lines()), ("svg", has_vectors)];
    kinds.into_iter().filter(|(_, is)| *is).map(|(kind, _)| format!("{}.{kind}", look.name)).collect()
}

/// The page, which needs only the pictures beside it.
fn html(model: &str, size: Size) -> Result<String> {
    let (mut figures, model) = (String::new(), escaped(model));
    for look in LOOKS {
        for file in files(look, &request(look, size)?) {
            let kind = if file.ends_with(".svg") { "vectors" } else { "pixels" };
            let _ = write!(
                figures,
                "<figure>\n<a class=\"picture\" href=\"{file}\"><img src=\"{file}\" alt=\"{model} in the look {name}, as {kind}\" \
                 width=\"{}\" height=\"{}\"/></a>\n<figcaption><strong>{name}</strong>, as {kind}: {}<br/>\
                 <code>tinta render {model} -o {file} --look {name} --size {size}</code></figcaption>\n</figure>\n",
                size.width,
                size.height,
                escaped(look.about),
                name = look.name,
            );
        }
    }
    Ok(beginning("Looks", Pictures::Beside)
        + &format!("<h1>Looks</h1>\n<main class=\"pictures\">\n{figures}</main>\n</body>\n</html>\n"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_look_is_listed_and_can_be_drawn_in_its_size() {
        let size = Size { width: 32, height: 24 };
        let page = html("a<b.obj", size).unwrap();
        for look in LOOKS {
            assert!(list().contains(look.about) && page.contains(&escaped(look.about)), "{}", look.name);
        }
        assert!(page.contains("a&lt;b.obj") && !page.contains("a<b"));
        let files = LOOKS.map(|look| files(look, &request(look, size).unwrap()).join(" "));
        assert_eq!(files, ["print.png print.svg", "technical.svg", "charcoal.png", "published.png published.svg"]);
        // Without a size, pictures have their look's size; published styles use the size of the papers' pictures.
        for (more, size) in [
            ("a.png", [1280, 960]),
            ("a.png --look charcoal", [1280, 960]),
            ("a.svg --look technical", [1280, 960]),
            ("a.png --look print --style inking", [1280, 960]),
            ("a.png --look published", [512, 512]),
            ("a.png --style ink", [512, 512]),
            ("a.png --preset paper:dachsbacher-inking", [512, 512]),
            ("a.svg", [1280, 960]),
            ("a.dxf", [512, 512]),
            ("a.png --look print --size 64x32", [64, 32]),
        ] {
            let words = format!("tinta render builtin:bust -o {more}");
            let words: Vec<String> = words.split(' ').map(str::to_owned).collect();
            assert_eq!(
                super::super::render::asked_by(&words).unwrap().0.scene.size,
                Size { width: size[0], height: size[1] },
                "{words:?}"
            );
        }
        assert_eq!(default_size(), Size { width: 1280, height: 960 });
    }
}
