//! `tinta render --look all`: draws models in each look.

use super::messages::{make_folder, print};
use super::options::Looks;
use super::render::{self, Arguments};
use super::{Command, Verdict, given};
use std::fmt::Write;
use std::path::Path;
use tinta::markup::escaped;
use tinta::page::{Pictures, beginning};
use tinta::preset::{LOOKS, Look, OptionValue, Preset};
use tinta::recipe::option_words;
use tinta::request::{Request, Session, is_drawn_into, is_of_camera};
use tinta::settings::refuse_exclusive;
use tinta::{Error, Result, Size, TextTarget};

/// The command `render`, which draws in one look or in all.
pub(super) const COMMAND: Command = Command {
    run: |matches, call| {
        let mut arguments: Arguments = given(matches)?;
        match arguments.look.looks {
            Some(Looks::All) => share_camera(&mut arguments).and_then(|()| run(&arguments, call.session)),
            _ => render::run(&arguments, call.session),
        }
    },
    offers: |option| match option {
        "look" => LOOKS.iter().map(|look| look.name).chain(["all"]).collect(),
        _ => Vec::new(),
    },
    ..render::COMMAND
};

/// Gives all looks the first one's camera and size where none are given: their pictures can be compared.
fn share_camera(arguments: &mut Arguments) -> Result<()> {
    let preset = arguments.preset.preset.as_deref().map(Preset::read).transpose()?;
    let is_said = |name: &str| preset.as_ref().is_some_and(|preset| preset.options.contains_key(name));
    let of_view = |name: &str| name == "size" || is_of_camera(name) && arguments.camera.camera.is_none();
    let mut shared = LOOKS[0].preset()?.options;
    shared.entry("parallel".to_owned()).or_insert(OptionValue::Switch(false));
    for (name, value) in shared.into_iter().filter(|(name, _)| of_view(name) && !is_said(name)) {
        let mut options = arguments.options.options.clone();
        options.entry(name).or_insert(value);
        // Such as a view where an eye is given.
        if refuse_exclusive(&options).is_ok() {
            arguments.options.options = options;
        }
    }
    Ok(())
}

/// Draws a picture in each look, as pixels and as vectors where it has them, and writes a page that shows them side by side.
fn run(arguments: &Arguments, session: &mut Session) -> Result<Verdict> {
    let folder = Path::new(&arguments.output);
    if arguments.output == "-" || is_drawn_into(&arguments.output) {
        return Err(Error::output(&arguments.output, "--look all draws a picture in each look; name a folder"));
    }
    make_folder(folder)?;
    let (mut figures, mut verdict) = (String::new(), Verdict::Good);
    for look in LOOKS {
        let (request, _) = arguments.asked_in(Some(look), "a.png")?;
        for file in files(look, &request) {
            let drawn = render::drawn(arguments, Some(look), &folder.join(&file).display().to_string(), session)?;
            verdict = if drawn == Verdict::Good { verdict } else { drawn };
            figures += &figure(arguments, look, &file, request.scene.size);
        }
    }
    let page = folder.join("index.html");
    let text = beginning("Looks", Pictures::Beside)
        + &format!("<h1>Looks</h1>\n<main class=\"pictures\">\n{figures}</main>\n</body>\n</html>\n");
    TextTarget::check(&page.display().to_string())?.write(&text)?;
    print(&format!("{}\n", page.display())).map(|()| verdict)
}

/// The files of a look: pixels unless it draws lines, and vectors where it has them.
fn files(look: Look, request: &Request) -> Vec<String> {
    let has_vectors = request.style.vectors(request.scene.size).is_some();
    let kinds = [("png", !look.draws_lines()), ("svg", has_vectors)];
    kinds.into_iter().filter(|(_, is)| *is).map(|(kind, _)| format!("{}.{kind}", look.name)).collect()
}

/// A picture of the page, which needs only the files beside it.
fn figure(arguments: &Arguments, look: Look, file: &str, size: Size) -> String {
    let kind = if file.ends_with(".svg") { "vectors" } else { "pixels" };
    let words = ["render".to_owned()].into_iter().chain(arguments.models.iter().cloned());
    let words = words.chain(["-o", file, "--look", look.name].map(str::to_owned));
    let given = arguments.options.options.iter().flat_map(|(name, value)| match value {
        OptionValue::Switch(false) => vec![format!("--no-{name}")],
        value => option_words(name, value),
    });
    let mut text = String::new();
    let _ = write!(
        text,
        "<figure>\n<a class=\"picture\" href=\"{file}\"><img src=\"{file}\" alt=\"{} in the look {name}, as {kind}\" \
         width=\"{}\" height=\"{}\"/></a>\n<figcaption><strong>{name}</strong>, as {kind}: {}<br/><code>{}</code></figcaption>\n\
         </figure>\n",
        escaped(&arguments.models.join(", ")),
        size.width,
        size.height,
        escaped(look.about),
        escaped(&tinta::shell::command_line(words.chain(given))),
        name = look.name,
    );
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_looks_share_the_camera_that_is_given_or_the_first_ones() {
        let scenes = |words: &str| {
            let matches = <Arguments as clap::Args>::augment_args(clap::Command::new("render").no_binary_name(true));
            let matches = matches.try_get_matches_from(words.split(' ')).unwrap();
            let mut arguments: Arguments = super::super::given(&matches).unwrap();
            share_camera(&mut arguments).unwrap();
            LOOKS.map(|look| arguments.asked_in(Some(look), "a.png").unwrap().0.scene)
        };
        let first = Request::from_layers(&[tinta::request::OptionLayer::Look(LOOKS[0])]).unwrap().0.scene;
        for words in ["a.obj -o looks", "a.obj -o looks --eye 1,2,3", "a.obj -o looks --parallel --view top --size 32"]
        {
            let all = scenes(words);
            assert!(all.iter().all(|scene| scene.camera == all[0].camera && scene.size == all[0].size), "{words}");
            assert_eq!(
                (all[0].camera == first.camera, all[0].size == first.size),
                (words == "a.obj -o looks", !words.contains("--size"))
            );
        }
    }

    #[test]
    fn every_look_is_drawn_in_its_size() {
        let words = ["a<b.obj", "-o", "looks", "--size", "32x24"];
        let matches = <Arguments as clap::Args>::augment_args(clap::Command::new("render").no_binary_name(true));
        let arguments: Arguments = super::super::given(&matches.try_get_matches_from(words).unwrap()).unwrap();
        let files = LOOKS.map(|look| files(look, &arguments.asked_in(Some(look), "a.png").unwrap().0).join(" "));
        assert_eq!(files, ["print.png print.svg", "technical.svg", "sketch.png", "published.png published.svg"]);
        let size = Size { width: 32, height: 24 };
        let figure = figure(&arguments, LOOKS[2], "sketch.png", size);
        assert!(figure.contains("a&lt;b.obj") && !figure.contains("a<b"));
        assert!(figure.contains("-o sketch.png --look sketch --size 32x24</code>"), "{figure}");
        // Without a size, pictures have their look's size; published styles use the size of the papers' pictures.
        for (more, size) in [
            ("a.png", [1280, 960]),
            ("a.png --look sketch", [1280, 960]),
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
    }
}
