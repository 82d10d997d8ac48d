//! Saves files from the window: the picture, its exact lines, a turn, a preset; and the command line that makes the same.

use crate::animation::{AnimationTarget, AnimationWriter};
use crate::error::Result;
use crate::gl::{Backend, ContextInfo};
use crate::lines::{DrawingFormat, PartRules, Progress, Raster, raster_of_strokes};
use crate::mesh::LoadOptions;
use crate::output::TextTarget;
use crate::picture::{Picture, Target};
use crate::preset::{OptionValue, Options, to_toml};
use crate::recipe::{Driver, FileRecord};
use crate::renderer::Renderer;
use crate::request::{OptionLayer, Request, WantedLines};
use crate::scene::SceneSettings;
use crate::settings::{HasSettings, Value as _};
use crate::shell;
use crate::styles::{Below, is_of_exact_lines};
use crate::window::threads::job::Job;
use crate::window::values::controls;
use crate::window::values::event::{Save, Side};
use crate::window::values::line_style::LinesShown;
use crate::window::values::state::ViewerState;
use std::collections::HashSet;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};

/// Pictures of a turn, and the time of each, milliseconds, as in `--turntable 36`.
const TURN: (u32, u16) = (36, 69);

/// Between what is said about a saved file and the command that makes the same.
pub(in crate::window) const SAME_BY: &str = "; the same by ";

/// How a model is read and where files go.
#[derive(Debug, Clone)]
pub(in crate::window) struct Surroundings {
    /// How the models were read.
    pub load: LoadOptions,
    /// OpenGL from.
    pub backend: Backend,
    /// Where files are written.
    pub folder: PathBuf,
    /// The models' files and the files read with them.
    pub files: Vec<PathBuf>,
    /// Who draws.
    pub context: Option<Box<ContextInfo>>,
    /// Names already given to files, some of which are still being written.
    pub names: Arc<Mutex<HashSet<PathBuf>>>,
}

/// The command that makes the same as is shown of a side, into a file of this kind.
///
/// # Errors
///
/// [`crate::Error::Setting`] where a setting has no option, and the camera's errors.
pub(in crate::window) fn command(
    state: &ViewerState,
    job: &Job,
    surroundings: &Surroundings,
    save: Save,
    side: Side,
    output: &str,
) -> Result<String> {
    let gl = context(surroundings).filter(|_| save != Save::Lines);
    let recipe = request(state, job, surroundings, save, side)?.recipe(&job.scene, &[], gl, |_| None);
    Ok(recipe.command_line(output))
}

/// The request that draws a side's picture into a file of this kind.
fn request(state: &ViewerState, job: &Job, surroundings: &Surroundings, save: Save, side: Side) -> Result<Request> {
    let mut scene = SceneSettings { camera: job.camera()?, ..job.settings.clone() }.to_options()?;
    scene.extend(surroundings.load.to_options()?);
    let drawn = if save == Save::Lines { state.drawing(side) } else { state.drawn(side) };
    let mut options = style_options(&drawn)?;
    // Every picture shows what rules say of surfaces.
    let PartRules(mut rules) = state.part_rules(side);
    rules.retain(|rule| rule.style.is_of_surface());
    if !rules.is_empty() {
        options.entry("part".to_owned()).or_insert_with(|| OptionValue::text(PartRules(rules).text()));
    }
    if save == Save::Turn {
        options.insert("turntable".to_owned(), OptionValue::text(TURN.0.to_string()));
    }
    // A sheet has a framing of its own: the style's options beat the scene's.
    let (request, _) = Request::from_layers(&[OptionLayer::Given(scene), OptionLayer::Given(options)])?;
    Ok(request.with_models(state.models.clone()))
}

/// Who draws.
fn context(surroundings: &Surroundings) -> Option<Driver> {
    surroundings.context.as_deref().map(Driver::new)
}

/// The options of a request without scene and reading: of its style, of its picture, and of the strokes on that.
fn style_options(request: &Request) -> Result<Options> {
    let mut options = Request::table().options(request, &Request::of_style(request.style.style_name()))?;
    options.insert("style".to_owned(), OptionValue::text(request.style.name()));
    if request.contents(false)?.has_strokes() {
        let of_lines = request.options.clone().into_iter().filter(|(name, _)| is_of_exact_lines(name));
        options = of_lines.chain(options).collect();
    }
    Ok(options)
}

/// Writes files of the shown pictures and reports where, with the command that makes the same; turns and presets give one file
/// for each shown style.
///
/// # Errors
///
/// [`crate::Error::File`] and the errors of drawing.
pub(in crate::window) fn save(
    state: &ViewerState,
    job: &Job,
    shown: Option<&Picture>,
    surroundings: &Surroundings,
    save: Save,
) -> Result<String> {
    let active = [state.active];
    let sides = match save {
        Save::Picture | Save::Lines => &active,
        Save::Turn | Save::Preset => state.sides(),
    };
    let said: Result<Vec<String>> =
        sides.iter().map(|side| save_of(state, job, shown, surroundings, save, *side)).collect();
    Ok(said?.join("; "))
}

/// Writes one file and reports where.
fn save_of(
    state: &ViewerState,
    job: &Job,
    shown: Option<&Picture>,
    surroundings: &Surroundings,
    save: Save,
    side: Side,
) -> Result<String> {
    let path = free_name(surroundings, &stem(state, save, side), save);
    let name = path.to_string_lossy().into_owned();
    let command = command(state, job, surroundings, save, side, &name);
    let (files, record) = (&surroundings.files, |path: &Path| FileRecord::of(path).ok());
    match save {
        Save::Picture => {
            let Some(shown) = shown else { return Ok("there is no picture yet".to_owned()) };
            let target = Target::check(&name, false)?;
            if state.sides().len() == 1 {
                let recipe = request(state, job, surroundings, save, side);
                let resolved = recipe.and_then(|request| request.resolve_again(&job.scene, false));
                let recipe =
                    resolved.map(|drawn| drawn.request.recipe(&drawn.scene, files, context(surroundings), record));
                target.write_with(shown, recipe.ok().and_then(|recipe| recipe.note()).as_ref())?;
            } else {
                // A cut or a difference is put together here: no command makes it.
                target.write(shown)?;
                let each = command.unwrap_or_else(|error| error.to_string());
                return Ok(format!("{name}; the {} style alone: {each}", state.style(side).name()));
            }
        }
        Save::Lines => {
            TextTarget::check(&name)?;
            let request = request(state, job, surroundings, save, side)?;
            let resolved = request.resolve_again(&job.scene, true)?;
            let recipe = resolved.request.recipe(&resolved.scene, files, None, record);
            let drawn = resolved.drawn_lines(WantedLines::default(), &Progress::default())?;
            drawn.written(DrawingFormat::SVG, None, Some(&recipe))?.write(&name, request.is_transparent())?;
        }
        Save::Turn => {
            turn(&request(state, job, surroundings, Save::Picture, side)?, job, surroundings.backend, &name)?;
            if state.lines_shown(side) == LinesShown::Alone {
                return Ok(format!("{name}; no command turns lines alone as pixels"));
            }
        }
        Save::Preset => {
            // Without the view: a preset is for any model.
            let mut options = controls::of_scene_in(&job.settings.to_options()?);
            options.remove("view");
            options.extend(style_options(&state.drawn(side))?);
            TextTarget::check(&name)?.write(&to_toml(&options, "Saved by tinta view."))?;
            let use_it = shell::quoted(&name);
            return Ok(format!("{name}; render, compare and measure take it: --preset {use_it}"));
        }
    }
    Ok(match command {
        Ok(command) => format!("{name}{SAME_BY}{command}"),
        Err(error) => format!("{name}; no command makes the same: {}", error.with_dashes()),
    })
}

/// A turn of a request around a scene, in a separate renderer.
fn turn(request: &Request, job: &Job, backend: Backend, name: &str) -> Result<()> {
    let target = AnimationTarget::check(name, false)?;
    let mut renderer = Renderer::new(backend)?;
    let mut writer = AnimationWriter::new(target, TURN.0, TURN.1)?;
    for view in request.turn(job.scene()?, TURN.0, false)? {
        writer.add(match view.contents.below {
            Below::Passes(_) | Below::Tones(..) => view.picture(&mut renderer)?,
            Below::Joined(_) | Below::Nothing => {
                let strokes = view.drawn_lines(WantedLines::default(), &Progress::default())?.strokes()?;
                let Raster { size, pixels } = raster_of_strokes(&strokes, view.scene.size, view.scene.background);
                Picture { size, pixels }
            }
        })?;
    }
    writer.finish().map(drop)
}

/// `bust-three-pass`: the model with the styles that are in the file.
fn stem(state: &ViewerState, save: Save, side: Side) -> String {
    let first = state.models.first().map_or("tinta", String::as_str);
    let model = first.strip_prefix("builtin:").unwrap_or(first);
    let model = Path::new(model).file_stem().map_or("model".into(), |stem| stem.to_string_lossy());
    let styles: Vec<String> = match save {
        Save::Picture => state.sides().iter().map(|side| state.drawn_name(*side)).collect(),
        Save::Lines => vec![state.drawing(side).style.name().to_owned()],
        Save::Turn => vec![state.drawn_name(side)],
        Save::Preset => vec![state.style(side).name().to_owned()],
    };
    format!("{model}-{}", styles.join("-"))
}

/// A new name that neither an existing file nor one being written has.
fn free_name(surroundings: &Surroundings, stem: &str, save: Save) -> PathBuf {
    let extension = match save {
        Save::Picture => "png",
        Save::Lines => "svg",
        Save::Turn => "gif",
        Save::Preset => "toml",
    };
    let name = |number: u32| match number {
        1 => surroundings.folder.join(format!("{stem}.{extension}")),
        number => surroundings.folder.join(format!("{stem}-{number}.{extension}")),
    };
    let mut given = surroundings.names.lock().unwrap_or_else(PoisonError::into_inner);
    let is_free = |path: &PathBuf| path.symlink_metadata().is_err() && !given.contains(path);
    let path = (1..).map(name).find(is_free).unwrap_or_else(|| name(1));
    given.insert(path.clone());
    path
}
