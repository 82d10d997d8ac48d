//! `tinta again`: redraws a picture from its recipe and compares the two.

use super::render;
use super::run_settings::{RunSettings, is_of_one_run};
use super::standard_input;
use super::{Command, given};
use super::{Verdict, say};
use crate::files::shown;
use std::path::{Path, PathBuf};
use tinta::limits::PICTURE_BYTES;
use tinta::request::{OptionLayer, Request, unknown};
use tinta::settings::{HasSettings, OptionValue, Options};
use tinta::{Backend, Error, Picture, Recipe, Result, Size};

/// The command.
pub(super) const COMMAND: Command = Command {
    examples: &[
        "tinta again cow.png                             draw it again and compare",
        "tinta again cow.png -o again.png                keep the new picture",
    ],
    ..Command::new("again", <Arguments as clap::Args>::augment_args, |matches, _| run(&given::<Arguments>(matches)?))
};

/// Redraw a picture from its recipe, and compare the two
#[derive(clap::Args)]
pub(super) struct Arguments {
    /// Picture that `tinta render` wrote, .png or .svg
    #[arg(value_name = "PICTURE")]
    picture: PathBuf,

    /// File to write, in the same format [default: none, the two are only compared]
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,

    /// Path of the model now, or - for standard input; with several models, once for each, in their order [default: where it was]
    #[arg(long, value_name = "FILE")]
    model: Vec<String>,

    /// Read files outside the model's folder, if the recipe does so too; a recipe alone cannot allow it [default: off]
    #[arg(long)]
    allow_external: bool,

    /// Folder of shaders to draw with, if the recipe has one; a recipe alone cannot have shaders run [default: none]
    #[arg(long, value_name = "FOLDER")]
    glsl: Option<String>,
}

/// A picture to draw again.
struct Redrawing<'a> {
    arguments: &'a Arguments,
    /// The file of the new picture.
    output: PathBuf,
    /// What messages call the new picture.
    name: String,
}

/// Draws the picture again; exit code 1 if it differs.
pub(super) fn run(arguments: &Arguments) -> Result<Verdict> {
    let recipe = Recipe::read(&arguments.picture)?;
    let kind = if is_png(&arguments.picture)? { "png" } else { "svg" };
    // Kept until the comparison ends.
    let unnamed = if arguments.output.is_none() { Some(folder()?) } else { None };
    let redrawing = match (&arguments.output, &unnamed) {
        (None, Some(folder)) => Redrawing {
            arguments,
            output: folder.path().join(format!("again.{kind}")),
            name: format!("{}, drawn again,", arguments.picture.display()),
        },
        (output, _) => {
            let output = output.clone().unwrap_or_default();
            check_output(&output, &arguments.picture, kind)?;
            let name = output.display().to_string();
            Redrawing { arguments, output, name }
        }
    };
    let models = models(arguments, &recipe)?;
    let before = std::fs::read(&arguments.picture).map_err(|error| failed(&arguments.picture, &error))?;
    redrawing.draw(&recipe, &models)?;
    redrawing.compare(&recipe, &before)
}

/// A folder for a picture that nobody keeps.
fn folder() -> Result<tempfile::TempDir> {
    tempfile::tempdir().map_err(|error| {
        let folder = std::env::temp_dir();
        Error::output(folder, format!("no file can be written here ({error}); name one with -o")).because(&error)
    })
}

/// A comparison needs files of one kind, and the old picture must survive.
fn check_output(output: &Path, picture: &Path, wanted: &str) -> Result<()> {
    let refuse = |problem: String| Err(Error::output(output, problem));
    let kind = |path: &Path| path.extension().and_then(|extension| extension.to_str()).map(str::to_ascii_lowercase);
    if kind(output).as_deref() != Some(wanted) {
        return refuse(format!(
            "the picture is {}, so the new one must be too; name a .{wanted} file",
            wanted.to_uppercase()
        ));
    }
    match output.canonicalize().is_ok_and(|output| picture.canonicalize().is_ok_and(|picture| picture == output)) {
        true => refuse("this is the picture to compare with; name another file, or leave out -o".to_owned()),
        false => Ok(()),
    }
}

fn is_svg(path: &Path) -> bool {
    path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("svg"))
}

/// By its content, because the file may have been renamed.
fn is_png(path: &Path) -> Result<bool> {
    use std::io::Read;
    let mut first = [0];
    let read = std::fs::File::open(path).and_then(|mut file| file.read(&mut first));
    read.map(|_| first == [0x89]).map_err(|error| failed(path, &error))
}

fn failed(path: &Path, error: &std::io::Error) -> Error {
    Error::picture(path, format!("it cannot be read ({error}); check the file")).because(error)
}

/// The models to draw; each must exist.
fn models(arguments: &Arguments, recipe: &Recipe) -> Result<Vec<String>> {
    let refuse = |setting: &str, problem: String| Err(Error::setting(setting, problem));
    if !arguments.model.is_empty() && arguments.model.len() != recipe.models.len() {
        let problem = format!(
            "the picture has {} models ({}) and {} are given; give each, in this order",
            recipe.models.len(),
            recipe.models.join(", "),
            arguments.model.len()
        );
        return refuse("model", problem);
    }
    let models: Vec<String> = match arguments.model.is_empty() {
        true => recipe.models.iter().map(|model| on_this_system(model)).collect(),
        false => arguments.model.clone(),
    };
    if arguments.model.is_empty() && models.iter().any(|model| model == standard_input::DASH) {
        let known = recipe.files.iter().find(|file| file.path == standard_input::DASH);
        let known =
            known.map_or(String::new(), |file| format!(" ({} bytes, SHA-256 {})", file.bytes, shown(&file.sha256)));
        return Err(Error::model(
            standard_input::NAME,
            format!(
                "the picture's model came from there{known} and was not kept; pipe it in again with --model -, or say where it \
                 is now with --model FILE"
            ),
        ));
    }
    let is_there =
        |model: &str| model.starts_with("builtin:") || model == standard_input::DASH || Path::new(model).exists();
    match models.iter().find(|model| !is_there(model)) {
        Some(model) => {
            Err(Error::model(model.clone(), "the picture's model is missing; say where it is now with --model FILE"))
        }
        None => Ok(models),
    }
}

/// A path as this system writes it: one of Windows has its folders behind `\`, and Windows knows `/` as well.
fn on_this_system(model: &str) -> String {
    let slashes = model.replace('\\', "/");
    if !Path::new(model).exists() && Path::new(&slashes).exists() { slashes } else { model.to_owned() }
}

impl Redrawing<'_> {
    /// Draws the recipe. Options that are not part of a picture, such as a file to write, are refused: a recipe may come from anyone.
    fn draw(&self, recipe: &Recipe, models: &[String]) -> Result<()> {
        let arguments = self.arguments;
        let refuse = |problem: String| Error::picture(&arguments.picture, problem);
        if recipe.command != "render" {
            return Err(refuse(format!(
                "its recipe is for tinta {}, which cannot be repeated here; use tinta render",
                recipe.command
            )));
        }
        if models.is_empty() {
            return Err(refuse("its recipe names no model; it is not drawn".to_owned()));
        }
        for name in recipe.options.keys() {
            if is_of_one_run(name) {
                return Err(refuse(format!(
                    "its recipe has the option {name}, which does not describe a picture; it is not drawn"
                )));
            }
            if !Request::table().has(name) {
                return Err(refuse(format!("its recipe is not drawn: {}", unknown(name))));
            }
        }
        let external = arguments.allow_external.then(|| ("allow-external".to_owned(), OptionValue::Switch(true)));
        let glsl = arguments.glsl.as_ref().map(|folder| ("glsl".to_owned(), OptionValue::text(folder)));
        let given: Options = external.into_iter().chain(glsl).collect();
        if let Some(problem) = recipe.not_granted(&given) {
            return Err(refuse(problem));
        }
        let output = self.output.display().to_string();
        // The recipe has all options of the picture's look.
        let style = recipe.style.parse().ok().map(OptionLayer::Style);
        let layers: Vec<OptionLayer> =
            style.into_iter().chain([OptionLayer::Given(recipe.options.clone()), OptionLayer::Given(given)]).collect();
        let of_recipe = |error| match error {
            Error::Setting { .. } | Error::Settings { .. } => {
                refuse(format!("its recipe has an option that is not understood ({error}); this may be an older tinta"))
            }
            error => error,
        };
        let (request, _) = Request::from_layers(&layers).map_err(of_recipe)?;
        let backend = recipe.gl.as_ref().and_then(|gl| gl.backend.parse().ok()).unwrap_or_default();
        let mut request = request.with_models(models.to_vec());
        request.backend = backend;
        check_size(&arguments.picture, request.scene.size)?;
        let draw = |request: &Request| {
            render::render(request, &RunSettings::default(), &output, &[], &mut super::models::session()).map(drop)
        };
        match draw(&request) {
            // Another backend is better than none; a message names it.
            Err(Error::NoContext { .. }) if backend != Backend::Auto => {
                request.backend = Backend::Auto;
                draw(&request)
            }
            result => result.map_err(of_recipe),
        }
    }

    /// Compares the two files, then what they show.
    fn compare(&self, recipe: &Recipe, before: &[u8]) -> Result<Verdict> {
        let after = std::fs::read(&self.output).map_err(|error| failed(&self.output, &error))?;
        let now = Recipe::read(&self.output)?;
        recipe.differences(&now).iter().for_each(|difference| say(&format!("tinta: {difference}")));
        if before == after {
            say(&format!("tinta: {} is the same, byte for byte", self.name));
            return Ok(Verdict::Good);
        }
        match is_svg(&self.output) {
            true => Ok(self.compare_drawings(before, &after, recipe, &now)),
            false => self.compare_pictures(),
        }
    }

    fn compare_pictures(&self) -> Result<Verdict> {
        let (before, after) = (Picture::read(&self.arguments.picture)?, Picture::read(&self.output)?);
        let name = &self.name;
        match before.difference(&after) {
            Some(difference) if difference.pixels == 0 => {
                say(&format!(
                    "tinta: {name} has the same pixels; the file differs in its recipe or in how it was packed"
                ));
                Ok(Verdict::Good)
            }
            Some(difference) => {
                let all = after.size.pixel_count();
                say(&format!(
                    "tinta: {name} differs in {} of {all} pixels, by at most {} of 255",
                    difference.pixels, difference.largest
                ));
                Ok(Verdict::Different)
            }
            None => {
                say(&format!("tinta: {name} is {} pixels large, the picture {}", after.size, before.size));
                Ok(Verdict::Different)
            }
        }
    }

    /// Line by line, without the lines that hold recipe and command.
    fn compare_drawings(&self, before: &[u8], after: &[u8], then: &Recipe, now: &Recipe) -> Verdict {
        let drawn = |bytes: &[u8]| -> Vec<String> {
            let text = String::from_utf8_lossy(bytes);
            let is_about = |line: &str| {
                ["<tinta:recipe", "<dc:description", "<dc:title", "<title"].iter().any(|start| line.starts_with(start))
            };
            text.lines().filter(|line| !is_about(line)).map(str::to_owned).collect()
        };
        let (before, after) = (drawn(before), drawn(after));
        let name = &self.name;
        if before == after {
            let why = if then.models == now.models { "recipe" } else { "recipe, which names other models" };
            say(&format!("tinta: {name} has the same lines; the file differs in its {why}"));
            return Verdict::Good;
        }
        let shared = before.iter().zip(&after).filter(|(before, after)| before == after).count();
        let count = before.len().max(after.len()) - shared;
        say(&format!("tinta: {name} differs in {count} of {} lines of the file", after.len()));
        Verdict::Different
    }
}

/// Refuses a recipe for a picture much larger than the file itself: the result might be unreadable, and takes long to draw.
fn check_size(path: &Path, size: Size) -> Result<()> {
    if !is_png(path)? || size.pixel_count() as u64 * 4 <= PICTURE_BYTES {
        return Ok(());
    }
    let picture = Picture::read(path)?;
    match picture.size == size {
        true => Ok(()),
        false => Err(Error::picture(
            path,
            format!("it has {} pixels but its recipe is for {size}; give the picture that tinta wrote", picture.size),
        )),
    }
}
