//! `tinta figures`: the three texts' figures as pictures and plots of ours, on a page.

use super::model_cache::ModelCache;
use super::models::load_meshes;
use super::progress::Progress;
use serde_json::json;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use tinta::figures::page::{FigureRecord, PictureRecord, page};
use tinta::figures::plot::{PLOT_SIZE, plot, title};
use tinta::figures::{
    Artist, Content, Drawing, HowToMeasure, NO_TEXTURED_MODEL, Numbers, Panel, TRIANGLES, figures, measure, only, steps,
};
use tinta::shell::quoted;
use tinta::{Backend, Error, LoadOptions, Mesh, Picture, Renderer, Result, Size, Target, TextTarget};

/// Draw and measure the figures of the three texts again; pictures, plots and a page come out
#[derive(clap::Args)]
#[command(after_help = "\
Files: index.html, which needs nothing but the pictures beside it; figures.json with commands, settings and every raw time; a PNG
for each picture and an SVG for each plot. Where figures need a model with its own texture and none is named with --model, they
are left out, and that is said.")]
pub struct Arguments {
    /// Folder to write into; made if it is not there
    #[arg(short, long, value_name = "DIR")]
    output: PathBuf,

    /// Figures with commas between, such as evangelista-5,dachsbacher-ants [default: all]
    #[arg(long, value_name = "FIGURES", value_delimiter = ',')]
    only: Vec<String>,

    /// Size of the pictures, and of the frames that are timed [default: 512x512, the papers']
    #[arg(long, value_name = "WxH", default_value = "512x512", hide_default_value = true)]
    size: Size,

    /// Frames of each setting that are timed [default: 21, with --quick 3]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=100_000))]
    frames: Option<u32>,

    /// Fewer frames, and the three smaller of figure 13's six scenes [default: off]
    #[arg(long)]
    quick: bool,

    /// Model with its own texture for the figures that need one (MD2, OBJ, 3DS, glTF) [default: those figures are left out]
    #[arg(long, value_name = "FILE")]
    model: Option<String>,

    /// Picture for all surfaces of that model (PCX, PNG, TGA, BMP, JPEG, PPM) [default: what the model names, found beside it]
    #[arg(long, value_name = "FILE", requires = "model")]
    skin: Option<PathBuf>,

    /// OpenGL from: egl, osmesa, auto (the first that works) [default: auto]
    #[arg(long, value_name = "BACKEND", default_value = "auto", hide_default_value = true)]
    backend: Backend,
}

/// Tones of figure 13, a plot each.
const PLOTS: [u8; 3] = [1, 2, 3];

pub fn run(arguments: &Arguments) -> Result<()> {
    let chosen = only(figures(arguments.size), &arguments.only)?;
    if arguments.output.join("figures.json").exists() {
        return Err(Error::Output {
            path: arguments.output.display().to_string(),
            problem: "figures of an earlier run and their times lie here; name another folder".to_owned(),
        });
    }
    super::make_folder(&arguments.output)?;
    let folder = Folder(&arguments.output);
    // A folder that cannot be written is found before the work.
    let (page_target, record_target) = (folder.text("index.html")?, folder.text("figures.json")?);
    let mut artist = Artist::new(arguments.textured()?);
    let mut renderer = Renderer::new(arguments.backend)?;
    let how = arguments.how_to_measure();
    let is_measured = chosen.iter().any(|figure| !matches!(figure.content, Content::Pictures(_)));
    let panels: usize = chosen.iter().map(|figure| figure.panels().len()).sum();
    let measured_steps = if is_measured { steps(&how) } else { 0 };
    let progress = Progress::new("drawing", (panels + measured_steps) as u64);
    let mut records = Vec::new();
    for figure in &chosen {
        let mut record = FigureRecord::new(figure, arguments.command(figure.id));
        for panel in figure.panels() {
            if !artist.can_draw(panel) {
                record.left_out.push(format!("{}, for {NO_TEXTURED_MODEL}", panel.label));
            } else if let Some(picture) = artist.draw(&mut renderer, panel, arguments.size)? {
                folder.picture(&panel.file, &picture)?;
                record.pictures.push(arguments.record(panel, &picture));
            }
            progress.step();
        }
        records.push(record);
    }
    let numbers = match is_measured {
        true => Some(measure(&mut renderer, &how, || progress.step())?),
        false => None,
    };
    if let Some(numbers) = &numbers
        && let Some(record) = records.iter_mut().find(|record| record.id == "evangelista-13")
    {
        for tones in PLOTS {
            let file = format!("evangelista-13-tones-{tones}.svg");
            folder.text(&file)?.write(&plot(numbers, tones)?)?;
            record.pictures.push(plot_record(file, tones));
        }
    }
    drop(progress);
    let gl = renderer.context();
    page_target.write(&page(&records, numbers.as_ref(), &gl.renderer, arguments.size))?;
    record_target.write(&arguments.json(&records, numbers.as_ref(), gl)?)?;
    for record in &records {
        for line in &record.left_out {
            super::say(&format!("tinta: {} ({}), left out: {line}", record.id, record.number));
        }
    }
    Ok(())
}

fn plot_record(file: String, tones: u8) -> PictureRecord {
    let label = title(tones).to_owned();
    let (width, height) = PLOT_SIZE;
    PictureRecord { file, label, size: Size { width, height }, command: None, style: None, show: None }
}

impl Arguments {
    fn how_to_measure(&self) -> HowToMeasure {
        let frames = self.frames.unwrap_or(if self.quick { 3 } else { 21 });
        let scenes = if self.quick { TRIANGLES.len() / 2 } else { TRIANGLES.len() };
        HowToMeasure { size: self.size, frames: frames as usize, scenes }
    }

    /// The user's model, which must have a texture.
    fn textured(&self) -> Result<Option<Arc<Mesh>>> {
        let Some(path) = &self.model else { return Ok(None) };
        let options = LoadOptions { skin: self.skin.clone(), ..LoadOptions::default() };
        let mesh = load_meshes(&ModelCache::for_one(), std::slice::from_ref(path), &options)?.pop();
        match mesh {
            Some(mesh) if mesh.materials.iter().any(|material| material.has_texture()) => Ok(Some(mesh)),
            _ => Err(Error::value(
                "model",
                path,
                "no picture for it was found, and these figures draw with a model's own; name one with --skin",
            )),
        }
    }

    /// What the user's model is called on a command line.
    fn textured_name(&self) -> Option<String> {
        let model = quoted(self.model.as_deref()?);
        Some(match &self.skin {
            Some(skin) => format!("{model} --skin {}", quoted(&skin.to_string_lossy())),
            None => model,
        })
    }

    /// The command that makes a whole figure.
    fn command(&self, id: &str) -> String {
        let HowToMeasure { size, frames, .. } = self.how_to_measure();
        let quick = if self.quick { " --quick" } else { "" };
        format!("tinta figures -o figures --only {id} --size {size} --frames {frames}{quick}")
    }

    fn record(&self, panel: &Panel, picture: &Picture) -> PictureRecord {
        let scene = match &panel.drawing {
            Drawing::Scene(scene) => Some(scene),
            Drawing::Grains { .. } | Drawing::Ramp => None,
        };
        PictureRecord {
            file: panel.file.clone(),
            label: panel.label.to_owned(),
            size: picture.size,
            command: Some(panel.command(self.size, self.textured_name().as_deref())),
            style: scene.map(|scene| scene.style.clone()),
            show: scene.map(|scene| scene.show),
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
        let text = serde_json::to_string_pretty(&value).map_err(|error| Error::Output {
            path: "figures.json".to_owned(),
            problem: format!("the record cannot be written as JSON ({error}); report this"),
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
        let all: Vec<tinta::figures::Figure> = figures(Size { width: 64, height: 64 });
        let mut files: Vec<&str> =
            all.iter().flat_map(tinta::figures::Figure::panels).map(|panel| panel.file.as_str()).collect();
        let count = files.len();
        files.sort_unstable();
        files.dedup();
        assert_eq!(files.len(), count);
    }

    #[test]
    fn names_with_blanks_are_quoted_for_a_shell() {
        assert_eq!(quoted("models/a.md2"), "models/a.md2");
        assert_eq!(quoted("my model's.md2"), "'my model'\\''s.md2'");
    }
}
