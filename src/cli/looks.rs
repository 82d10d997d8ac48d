//! `tinta looks`: draws a model in each look.

use super::render::{self, RunSettings};
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

    /// Folder for one picture in each look and index.html, which shows them side by side; created if missing [default: none, list the looks]
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
        let output = folder.join(file(look)).display().to_string();
        let size = Options::from([("size".to_owned(), OptionValue::text(arguments.size.to_string()))]);
        let layers = layers(Some(look), Vec::new(), size, look.draws_lines());
        let request = Request::from_layers(&layers)?.0.with_models(vec![arguments.model.clone()]);
        render::render(&request, &RunSettings::default(), &output, &[], &mut session)?;
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
    text + "\nDraw a model in every look:  tinta looks MODEL -o looks\nDraw it in one look:         tinta render MODEL -o picture.png --look NAME\n"
}

/// The file of a look: vectors if it draws lines.
fn file(look: Look) -> String {
    format!("{}.{}", look.name, if look.draws_lines() { "svg" } else { "png" })
}

/// The page, which needs only the pictures beside it.
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
        }
        assert!(html("a<b.obj", size).contains("a&lt;b.obj") && !html("a<b.obj", size).contains("a<b"));
        assert_eq!(file(LOOKS[1]), "technical.svg");
        // Without a size, pictures have their look's size; published styles use the size of the papers' pictures.
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
