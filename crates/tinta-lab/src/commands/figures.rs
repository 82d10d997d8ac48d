//! `tinta figures`: the three texts' figures as our pictures and plots, and their numbers measured here, on a page.

use crate::figures::page::{FigureRecord, PageContent, PictureRecord, page, png_source, svg_source};
use crate::figures::plot::{PLOT_SIZE, plot, title};
use crate::figures::{
    Artist, Content, Drawing, HowToMeasure, NO_TEXTURED_MODEL, Numbers, Panel, TRIANGLES, Turn, figures, measure, only,
    pass_columns, triangles_a_turn,
};
use serde_json::json;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use tinta::cli::models::load_meshes;
use tinta::cli::progress::{Steps, TimedProgress};
use tinta::cli::{Command, Verdict, given};
use tinta::shell::quoted;
use tinta::{Backend, Error, LoadOptions, Mesh, Picture, Renderer, Result, Size, Target, TextTarget};

/// The command.
pub(super) const COMMAND: Command = Command {
    examples: &["tinta figures -o figures                        redraw the texts' figures"],
    offers: |option| {
        let all = || figures(Size { width: 1, height: 1 });
        if option == "only" { all().iter().map(|figure| figure.id).collect() } else { Vec::new() }
    },
    ..Command::new("figures", <Arguments as clap::Args>::augment_args, |matches, _| {
        run(&given::<Arguments>(matches)?).map(|()| Verdict::Good)
    })
};

/// Draw and measure the figures of the three texts again, as pictures, plots and a page
#[derive(clap::Args)]
#[command(after_help = "\
Files: index.html shows everything and needs no other file; its pictures have fewer colours than the files beside it. \
figures.json holds commands, settings and every raw time. Each picture is a PNG, each plot an SVG.")]
pub(super) struct Arguments {
    /// Folder to write into; created if missing
    #[arg(short, long, value_name = "DIR")]
    output: PathBuf,

    /// Figures to draw, separated by commas, such as evangelista-5,dachsbacher-ants [default: all]
    #[arg(long, value_name = "FIGURES", value_delimiter = ',')]
    only: Vec<String>,

    /// Size of the pictures and of the timed frames [default: 512x512, the papers']
    #[arg(long, value_name = "WxH", default_value = "512x512", hide_default_value = true)]
    size: Size,

    /// Frames to time for each setting [default: 21, with --quick 3]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=100_000))]
    frames: Option<u32>,

    /// Time fewer frames, and only the three smaller of figure 13's six scenes [default: off]
    #[arg(long)]
    quick: bool,

    /// Textured model for the figures of a game's character [default: builtin:soldier]
    #[arg(long, value_name = "FILE")]
    model: Option<String>,

    /// Picture for all surfaces of that model (PCX, PNG, TGA, BMP, JPEG, PPM) [default: the picture that the model names]
    #[arg(long = "model-picture", value_name = "FILE", requires = "model")]
    skin: Option<PathBuf>,

    /// OpenGL from: egl, surfaceless, osmesa, wgl, cgl, auto (the first that works) [default: auto]
    #[arg(long, value_name = "BACKEND", default_value = "auto", hide_default_value = true)]
    backend: Backend,
}

/// The model of the figures that show a game's character with its own texture.
const BUILTIN_CHARACTER: &str = "builtin:soldier";

/// Tones of figure 13, a plot each.
const PLOTS: [u8; 3] = [1, 2, 3];

/// The kinds of work, in the order of [`expected`].
enum Work {
    Panel,
    Scenes,
    Squares,
}

/// Its expected time, seconds: measured with two cores and a software renderer; the proportions are similar elsewhere. Actual
/// times replace it as soon as they are known.
fn expected(panels: usize, is_measured: bool, how: &HowToMeasure) -> [Steps; 3] {
    /// The time of a picture with its file, of a turn of a small model, of a triangle.
    const PICTURE: f64 = 0.09;
    const TURN: f64 = 0.3;
    const TRIANGLE: f64 = 0.5e-6;
    let turns = if is_measured { how.frames } else { 0 };
    let pixels = how.size.pixel_count() as f64 / (512.0 * 512.0);
    let steps = |count, seconds| Steps { count, seconds };
    [
        steps(panels, PICTURE * pixels.max(0.2)),
        steps(turns, TURN * pixels + TRIANGLE * triangles_a_turn(how) as f64),
        steps(turns, TURN * pixels),
    ]
}

pub(super) fn run(arguments: &Arguments) -> Result<()> {
    let chosen = only(figures(arguments.size), &arguments.only)?;
    if arguments.output.join("figures.json").exists() {
        return Err(Error::output(
            &arguments.output,
            "this folder holds the figures of an earlier run; name another folder",
        ));
    }
    tinta::cli::make_folder(&arguments.output)?;
    let folder = Folder(&arguments.output);
    // A folder that cannot be written is found before the work.
    let (page_target, record_target) = (folder.text("index.html")?, folder.text("figures.json")?);
    let mut artist = Artist::new(arguments.textured()?);
    let mut renderer = Renderer::new(arguments.backend)?;
    let how = arguments.how_to_measure();
    let is_measured = chosen.iter().any(|figure| matches!(figure.content, Content::Frames | Content::OtherNumbers));
    let panels: usize = chosen.iter().map(|figure| figure.panels().len()).sum();
    let progress = TimedProgress::new("drawing", &expected(panels, is_measured, &how));
    let mut records = Vec::new();
    for figure in &chosen {
        let mut record = FigureRecord::new(figure, arguments.command(figure.id));
        for panel in figure.panels() {
            match arguments.drawn(&folder, &mut artist, &mut renderer, panel)? {
                Some(drawn) => record.pictures.push(drawn),
                None => record.left_out.push(format!("{}, for {NO_TEXTURED_MODEL}", panel.label)),
            }
            progress.step(Work::Panel as usize);
        }
        if figure.content == Content::Passes {
            record.passes = pass_columns(&how)?;
        }
        records.push(record);
    }
    let numbers = match is_measured {
        true => Some(measure(&mut renderer, &how, |turn| {
            progress.step(match turn {
                Turn::Scenes => Work::Scenes as usize,
                Turn::Squares => Work::Squares as usize,
            });
        })?),
        false => None,
    };
    if let Some(numbers) = &numbers
        && let Some(record) = records.iter_mut().find(|record| record.id == "evangelista-13")
    {
        for tones in PLOTS {
            let file = format!("evangelista-13-tones-{tones}.svg");
            let text = plot(numbers, tones)?;
            folder.text(&file)?.write(&text)?;
            record.pictures.push(plot_record(file, tones, &text));
        }
    }
    drop(progress);
    let gl = renderer.context();
    let shown = PageContent { figures: &records, numbers: numbers.as_ref() };
    page_target.write(&page(shown, &gl.renderer, arguments.size))?;
    record_target.write(&arguments.json(&records, numbers.as_ref(), gl)?)?;
    for record in &records {
        for line in &record.left_out {
            tinta::cli::say(&format!("tinta: {} ({}), left out: {line}", record.id, record.number));
        }
    }
    Ok(())
}

fn plot_record(file: String, tones: u8, text: &str) -> PictureRecord {
    let label = title(tones).to_owned();
    let (width, height) = PLOT_SIZE;
    let size = Size { width, height };
    PictureRecord { file, label, size, command: None, style: None, show: None, source: svg_source(text) }
}

impl Arguments {
    fn how_to_measure(&self) -> HowToMeasure {
        let frames = self.frames.unwrap_or(if self.quick { 3 } else { 21 });
        let scenes = if self.quick { TRIANGLES.len() / 2 } else { TRIANGLES.len() };
        HowToMeasure { size: self.size, frames: frames as usize, scenes }
    }

    /// The model with a texture: the user's, or the built-in one.
    fn textured(&self) -> Result<Option<Arc<Mesh>>> {
        let path = self.model.as_deref().unwrap_or(BUILTIN_CHARACTER);
        let options = LoadOptions { skin: self.skin.clone(), ..LoadOptions::default() };
        let mesh = load_meshes(&[path.to_owned()], &options)?.pop();
        match mesh {
            Some(mesh) if mesh.materials.iter().any(|material| material.has_texture()) => Ok(Some(mesh)),
            _ => Err(Error::value(
                "model",
                path,
                "no picture for it was found, and these figures draw with a model's own; name one with --model-picture",
            )),
        }
    }

    /// The name of that model on a command line.
    fn textured_name(&self) -> Option<String> {
        let model = quoted(self.model.as_deref().unwrap_or(BUILTIN_CHARACTER));
        Some(match &self.skin {
            Some(skin) => format!("{model} --texture skin={}", quoted(&skin.to_string_lossy())),
            None => model,
        })
    }

    /// The command that makes a whole figure.
    fn command(&self, id: &str) -> String {
        let HowToMeasure { size, frames, .. } = self.how_to_measure();
        let quick = if self.quick { " --quick" } else { "" };
        format!("tinta figures -o figures --only {id} --size {size} --frames {frames}{quick}")
    }

    /// Draws a panel into its file; `None` if it needs a missing texture.
    fn drawn(
        &self,
        folder: &Folder<'_>,
        artist: &mut Artist,
        renderer: &mut Renderer,
        panel: &Panel,
    ) -> Result<Option<PictureRecord>> {
        let Some(picture) = artist.draw(renderer, panel, self.size)? else { return Ok(None) };
        folder.picture(&panel.file, &picture)?;
        Ok(Some(self.record(panel, &picture)))
    }

    fn record(&self, panel: &Panel, picture: &Picture) -> PictureRecord {
        let scene = match &panel.drawing {
            Drawing::Scene(scene) => Some(scene),
            Drawing::Grains(_) | Drawing::Ramp => None,
        };
        PictureRecord {
            file: panel.file.clone(),
            label: panel.label.to_owned(),
            size: picture.size,
            command: Some(panel.command(self.size, self.textured_name().as_deref())),
            style: scene.map(|scene| scene.style.clone()),
            show: scene.map(|scene| scene.show),
            source: png_source(picture),
        }
    }

    fn json(&self, records: &[FigureRecord], numbers: Option<&Numbers>, gl: &tinta::gl::ContextInfo) -> Result<String> {
        let value = json!({
            "version": env!("CARGO_PKG_VERSION"),
            "size": self.size,
            "quick": self.quick,
            "gl": gl,
            "figures": records,
            "numbers": numbers,
        });
        let text = serde_json::to_string_pretty(&value).map_err(|error| {
            Error::output("figures.json", format!("the record cannot be written as JSON ({error}); report this"))
        })?;
        Ok(text + "\n")
    }
}

/// Where the files go.
struct Folder<'a>(&'a Path);

impl Folder<'_> {
    fn path(&self, name: &str) -> String {
        self.0.join(name).to_string_lossy().into_owned()
    }

    fn text(&self, name: &str) -> Result<TextTarget> {
        TextTarget::check(&self.path(name))
    }

    fn picture(&self, name: &str, picture: &Picture) -> Result<()> {
        Target::check(&self.path(name), false)?.write(picture)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_figure_has_its_own_files_and_id() {
        let all: Vec<crate::figures::Figure> = figures(Size { width: 64, height: 64 });
        let mut files: Vec<&str> =
            all.iter().flat_map(crate::figures::Figure::panels).map(|panel| panel.file.as_str()).collect();
        let count = files.len();
        files.sort_unstable();
        files.dedup();
        assert_eq!(files.len(), count);
    }

    #[test]
    fn the_time_left_is_that_of_all_that_is_to_come() {
        let how = HowToMeasure { size: Size { width: 512, height: 512 }, frames: 21, scenes: TRIANGLES.len() };
        let seconds = |is_measured| expected(50, is_measured, &how).map(Steps::total).iter().sum::<f64>();
        let [drawn, measured] = [seconds(false), seconds(true)];
        assert!(
            drawn > 4.0 && measured > drawn + 21.0,
            "{drawn} {measured}: what is measured is not done when all is drawn"
        );
        let quick = HowToMeasure { frames: 3, scenes: 3, ..how };
        let seconds = expected(50, true, &quick).map(Steps::total).iter().sum::<f64>();
        assert!(seconds < measured / 2.0, "{seconds} of {measured}");
    }

    #[test]
    fn names_with_blanks_are_quoted_for_a_shell() {
        assert_eq!(quoted("models/a.md2"), "models/a.md2");
        assert_eq!(quoted("my model's.md2"), "'my model'\\''s.md2'");
    }
}
