//! `tinta page`: a model in the browser's page, as one file that needs no server.
//!
//! The page is built once, by `scripts/web`, and put beside the program by packages. This command leaves out what a lesson does
//! not need and adds the model, the styles and the lecture.

use super::options::{Below, GivenOptions, NamedLook, PresetFile, Selection};
use super::{Command, Verdict, given, say, standard_input};
use base64::Engine;
use base64::engine::general_purpose::STANDARD as BASE64;
use flate2::{Compression, write::GzEncoder};
use serde_json::json;
use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use tinta::camera::View;
use tinta::glsl::es::{Stage, transcribed};
use tinta::mesh::{LoadedModel, load};
use tinta::page::NOT_OF_BROWSERS;
use tinta::request::Request;
use tinta::settings::{HasSettings, Kind, OptionValue, Setting, names_of, on_off};
use tinta::{Error, FileKind, LoadOptions, Result, SceneSettings, Style, StyleName, TextTarget};

/// The command.
pub(super) const COMMAND: Command = Command {
    examples: &["tinta page cow.obj -o cow.html                  turn it in a browser"],
    offers: |option| match option {
        "lecture" => names_of::<Lecture>(),
        "right" => names_of::<StyleName>(),
        _ => Vec::new(),
    },
    ..Command::new("page", <Arguments as clap::Args>::augment_args, |matches, _| {
        run(&given::<Arguments>(matches)?).map(|()| Verdict::Good)
    })
};

tinta_geometry::choices! {
    /// A text whose explanation stands beside the picture.
    pub enum Lecture {
        /// Three passes.
        Evangelista = "evangelista",
        /// Edges as ink.
        Dachsbacher = "dachsbacher",
        /// Charcoal.
        Valente = "valente",
    }
}

impl Lecture {
    /// The style that it is about.
    fn style(self) -> StyleName {
        match self {
            Self::Evangelista => StyleName::ThreePass,
            Self::Dachsbacher => StyleName::Inking,
            Self::Valente => StyleName::Charcoal,
        }
    }
}

/// Write a page for a browser that shows a model: one file with the program in it, for use without a server
#[derive(clap::Args)]
pub(super) struct Arguments {
    /// Model file (FORMATS) or built-in model
    #[arg(value_name = "MODEL")]
    model: String,

    /// Page to write, .html
    #[arg(short, long, value_name = "FILE")]
    output: String,

    /// Text to explain beside the picture: evangelista (three passes), dachsbacher (edges as ink), valente (charcoal) [default: none]
    #[arg(long, value_name = "TEXT")]
    lecture: Option<Lecture>,

    /// Style right of the divider; the options below are for the left side [default: three-pass; with a lecture none]
    #[arg(long, value_name = "STYLE")]
    right: Option<StyleName>,

    /// Page that scripts/web built [default: page.html beside the program, in ../share/tinta, or in web/dist of a checkout]
    #[arg(long, hide_short_help = true, value_name = "FILE")]
    from: Option<PathBuf>,

    #[command(flatten)]
    look: NamedLook,

    #[command(flatten)]
    preset: PresetFile,

    #[command(flatten)]
    options: GivenOptions<OfPage>,
}

/// What a page shows: no files besides the model's, no output.
struct OfPage;

impl Selection for OfPage {
    type Of = Request;

    fn has(setting: &Setting<Request>) -> bool {
        let name = setting.name;
        let is_shown = Style::table().has(name) || SceneSettings::table().has(name) || LoadOptions::table().has(name);
        (is_shown || ["style", "show", "glsl"].contains(&name))
            && setting.kind != Kind::File
            && !NOT_OF_BROWSERS.contains(&name)
    }
}

/// Writes the page.
fn run(arguments: &Arguments) -> Result<()> {
    if arguments.model == standard_input::DASH {
        return Err(Error::model(
            standard_input::NAME,
            "a page needs the model's name; save it as a file and name that",
        ));
    }
    super::messages::check_output(&arguments.output)?;
    let target = TextTarget::check(&arguments.output)?;
    super::inputs::Inputs::new(std::slice::from_ref(&arguments.model), &Default::default(), &[])
        .keep(&arguments.output)?;
    let request = request(arguments)?;
    let loaded = load(&arguments.model, &request.read).map_err(|error| request.attributed(error))?;
    loaded.remarks.iter().for_each(|remark| say(&format!("tinta: {remark}")));
    let files = files(&arguments.model, &loaded)?;
    let attributed = |error| request.attributed(error);
    let scene = request.placed(vec![Arc::new(loaded.mesh)]).map_err(attributed)?;
    request.style.plan(&scene, request.show).map_err(attributed)?;
    let view = request.suited_view(&scene);
    let shaders: BTreeMap<String, String> = request.shaders()?.into_iter().collect();
    if let Some(folder) = &request.glsl {
        say(&format!("tinta: {}", rewritten(folder, &shaders)?));
    }
    let page = built(arguments.from.as_deref())?;
    let page = with_lesson(&page, arguments.lecture, &link(arguments, (&request, view), &shaders), &files);
    let page = page.ok_or_else(|| {
        let name = arguments.from.clone().unwrap_or_default();
        Error::model(name, "this is no page that scripts/web built; name its web/dist/page.html")
    })?;
    target.write(&page)?;
    say(&format!("tinta: {} has {:.1} MB", arguments.output, page.len() as f64 / 1e6));
    Ok(())
}

/// The drawing of the left side.
fn request(arguments: &Arguments) -> Result<Request> {
    let Arguments { look, preset, .. } = arguments;
    let mut options = GivenOptions::<OfPage>::of_options(&arguments.options.options);
    let is_free = look.look.is_none() && preset.preset.is_none() && !options.options.contains_key("style");
    if let Some(lecture) = arguments.lecture.filter(|_| is_free) {
        options.options.insert("style".to_owned(), OptionValue::text(lecture.style().name()));
    }
    let below = Below {
        look: look.look,
        preset: preset.preset.as_deref(),
        has_looks: true,
        command: "page",
        ..Below::default()
    };
    let (request, remarks) = options.request(std::slice::from_ref(&arguments.model), &below)?;
    remarks.iter().for_each(|remark| say(&format!("tinta: {remark}")));
    Ok(request)
}

/// The files of a model by their names, the model's own first; none for a built-in one.
fn files(model: &str, loaded: &LoadedModel) -> Result<Vec<(String, Vec<u8>)>> {
    if model.starts_with("builtin:") {
        return Ok(Vec::new());
    }
    let pictures = loaded.mesh.materials.iter().filter_map(|material| material.texture.clone());
    let mut files: Vec<(String, Vec<u8>)> = Vec::new();
    for path in [PathBuf::from(model)].into_iter().chain(loaded.files.iter().cloned()).chain(pictures) {
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        if files.iter().any(|(known, _)| *known == name) {
            continue;
        }
        match std::fs::read(&path) {
            Ok(bytes) => files.push((name, bytes)),
            // The page says that a picture is missing, as the model's reader does.
            Err(_) if !files.is_empty() => {}
            Err(error) => {
                return Err(Error::model(path, format!("it cannot be read ({error}); check the file")).because(&error));
            }
        }
    }
    Ok(files)
}

/// The built page: the named one, or the one that came with the program.
fn built(named: Option<&Path>) -> Result<String> {
    const LARGEST_BYTES: u64 = 1 << 28;
    let read = |path: &Path| {
        let bytes = crate::files::read(path, LARGEST_BYTES)
            .map_err(|failure| failure.into_error(FileKind::Model, path, "a page that scripts/web built"))?;
        Ok(String::from_utf8_lossy(&bytes).into_owned())
    };
    if let Some(path) = named {
        return read(path);
    }
    let program = std::env::current_exe().and_then(|program| program.canonicalize()).unwrap_or_default();
    let mut folders = program.ancestors().skip(1);
    let beside = folders.clone().take(1).map(|folder| folder.join("page.html"));
    let share = folders.clone().skip(1).take(1).map(|folder| folder.join("share/tinta/page.html"));
    let checkout = folders.by_ref().map(|folder| folder.join("web/dist/page.html"));
    match beside.chain(share).chain(checkout).find(|path| path.is_file()) {
        Some(path) => read(&path),
        None => Err(Error::value(
            "from",
            "page.html",
            "this program came without its part for browsers; run scripts/web --install in tinta's repository, or name a page.html \
             of a release with --from FILE",
        )),
    }
}

/// Which lines of the reader's own shaders change on their way to a browser.
fn rewritten(folder: &str, shaders: &BTreeMap<String, String>) -> Result<String> {
    let of_shader = |(path, text): (&String, &String)| {
        let pieces = transcribed(Stage::of(path), text)
            .map_err(|problem| Error::value("glsl", folder, format!("{path} cannot run in browsers: {problem}")))?;
        let (mut line, mut lines) = (1, Vec::new());
        for piece in pieces {
            if piece.is_changed() && lines.last() != Some(&line) {
                lines.push(line);
            }
            line += piece.original.matches('\n').count();
        }
        let lines: Vec<String> = lines.iter().map(ToString::to_string).collect();
        Ok(format!("{path} in {} {}", if lines.len() == 1 { "line" } else { "lines" }, lines.join(", ")))
    };
    let changes: Vec<String> = shaders.iter().map(of_shader).collect::<Result<_>>()?;
    Ok(format!("browsers need other words of {}; the page marks them", changes.join("; ")))
}

/// What the page shows at first, as its links say it.
fn link(arguments: &Arguments, (request, view): (&Request, View), shaders: &BTreeMap<String, String>) -> String {
    let mut words = String::new();
    let mut put = |name: &str, value: &str| {
        let _ = write!(words, "{}{}={}", if words.is_empty() { "" } else { "&" }, encoded(name), encoded(value));
    };
    if let Some(name) = arguments.model.strip_prefix("builtin:") {
        put("model", name);
    }
    if let Some(lecture) = arguments.lecture {
        put("lecture", &lecture.to_string());
    }
    let is_alone = arguments.lecture.is_some() && arguments.right.is_none();
    put("divider", if is_alone { "100" } else { "50" });
    put("left", request.style.name());
    put("right", arguments.right.unwrap_or(StyleName::ThreePass).name());
    for (name, value) in &request.options {
        let value = match value {
            OptionValue::Switch(is_on) => on_off(*is_on).to_owned(),
            OptionValue::Text(text) => text.clone(),
            OptionValue::Texts(texts) => texts.join(","),
        };
        match name.as_str() {
            "glsl" | "style" | "view" => {}
            "show" => put("left.show", &value),
            name if NOT_OF_BROWSERS.contains(&name) => {}
            name if SceneSettings::table().has(name) => put(&format!("scene:{name}"), &value),
            name if LoadOptions::table().has(name) => put(&format!("read:{name}"), &value),
            name => put(&format!("left:{name}"), &value),
        }
    }
    for (path, text) in shaders {
        // All of the published text is cut, at its beginning.
        let published = tinta::glsl::source(path).unwrap_or_default();
        put(&format!("shader:{path}"), &format!("0,{},{text}", published.len()));
    }
    let View { azimuth_degrees, elevation_degrees } = view;
    let fov = request.scene.camera.fov_y_degrees;
    put("orbit", &format!("{azimuth_degrees},{elevation_degrees},1,0,0,{fov},perspective"));
    words
}

/// A text as part of a link.
fn encoded(text: &str) -> String {
    let is_plain = |byte: &u8| byte.is_ascii_alphanumeric() || b"-_.,:".contains(byte);
    text.bytes()
        .map(|byte| if is_plain(&byte) { char::from(byte).to_string() } else { format!("%{byte:02X}") })
        .collect()
}

/// Where the lesson stands in the built page.
const PLACE: &str = "<!-- lesson -->\n";

/// The page with its lesson, and without other lectures; `None` if it has no place for one.
fn with_lesson(page: &str, lecture: Option<Lecture>, link: &str, files: &[(String, Vec<u8>)]) -> Option<String> {
    let (before, after) = page.split_once(PLACE)?;
    let wanted = lecture.map(|lecture| format!(" data-lecture=\"{}\"", lecture));
    let is_of_lesson = |line: &&str| {
        let is_of_lecture = line.starts_with("<script") && line.contains(" data-lecture=");
        !is_of_lecture || wanted.as_ref().is_some_and(|wanted| line.contains(wanted))
    };
    let mut whole: String = before.split_inclusive('\n').filter(is_of_lesson).collect();
    let mut lesson = BTreeMap::from([("link", json!(link))]);
    if !files.is_empty() {
        lesson.insert("files", json!(files.iter().map(|(name, _)| name).collect::<Vec<_>>()));
    }
    let lesson = json!(lesson).to_string().replace('<', "\\u003c");
    let _ = writeln!(whole, "<script type=\"application/json\" id=\"lesson\">{lesson}</script>");
    for (name, bytes) in files {
        let name = tinta::markup::escaped(name);
        let _ = writeln!(
            whole,
            "<script type=\"text/plain\" data-file=\"model/{name}\">{}</script>",
            BASE64.encode(packed(bytes))
        );
    }
    whole.push_str(after);
    Some(whole)
}

/// Bytes compressed as gzip.
fn packed(bytes: &[u8]) -> Vec<u8> {
    let mut encoder = GzEncoder::new(Vec::new(), Compression::default());
    // Memory takes all that is written.
    let _ = encoder.write_all(bytes);
    encoder.finish().unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::Read;

    const PAGE: &str = "<p>\n<script type=\"text/plain\" data-file=\"main.js\">QQ==</script>\n\
        <script type=\"text/plain\" data-file=\"a.md\" data-lecture=\"evangelista\">QQ==</script>\n\
        <script type=\"text/plain\" data-file=\"b.md\" data-lecture=\"valente\">QQ==</script>\n<!-- lesson -->\n<script>\n";

    #[test]
    fn a_page_has_its_lecture_alone_and_the_models_files() {
        let files = [("<cow>.obj".to_owned(), b"v 0 0 0".to_vec())];
        for (lecture, [has_a, has_b]) in [
            (None, [false, false]),
            (Some(Lecture::Evangelista), [true, false]),
            (Some(Lecture::Valente), [false, true]),
        ] {
            let page = with_lesson(PAGE, lecture, "left=ink&a=</script>", &files).unwrap();
            assert!(page.contains("main.js") && page.ends_with("<script>\n"), "{page}");
            assert_eq!([page.contains("a.md"), page.contains("b.md")], [has_a, has_b], "{lecture:?}");
            // Nothing in the lesson ends its element.
            assert_eq!(page.matches("</script>").count(), 3 + usize::from(has_a) + usize::from(has_b), "{page}");
            let packed = page.split_once("model/&lt;cow&gt;.obj\">").unwrap().1.split('<').next().unwrap();
            let mut plain = Vec::new();
            let bytes = BASE64.decode(packed).unwrap();
            flate2::read::GzDecoder::new(&bytes[..]).read_to_end(&mut plain).unwrap();
            assert_eq!(plain, files[0].1);
        }
        assert!(with_lesson("<p>", None, "", &[]).is_none(), "no place for a lesson");
    }

    #[test]
    fn every_letter_survives_a_link() {
        assert_eq!(encoded("tone-levels=0.5,1&#ü"), "tone-levels%3D0.5,1%26%23%C3%BC");
    }
}
