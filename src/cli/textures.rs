//! `tinta textures`: writes the charcoal drawing's textures to files, for inspection and use elsewhere.

use super::options::{Chosen, Selection};
use super::{Command, Verdict, given};
use serde_json::json;
use std::path::PathBuf;
use std::time::Instant;
use tinta::renderer::milliseconds_since;
use tinta::settings::Setting;
use tinta::styles::{Charcoal, Ramp};
use tinta::textures::{ContrastTexture, NoiseTexture, PaperTexture};
use tinta::{Picture, Result, Size, Style, StyleName, Target};

/// The command.
pub(super) const COMMAND: Command = Command {
    examples: &["tinta textures -o textures                      write charcoal's textures"],
    ..Command::new("textures", <Arguments as clap::Args>::augment_args, |matches, _| {
        run(&given::<Arguments>(matches)?).map(|()| Verdict::Good)
    })
};

/// Write the textures of the styles: charcoal's grain, noise and paper, and the paint's ramp
#[derive(clap::Args)]
#[command(after_help = "\
Files: cet.png, noise.png and paper.png; and ramp.png, to edit and give to --ramp. With the default density, exponent and blur \
also the text's figures 2 (figure-2.png, the grains before they are moved) and 3 (figure-3-m-1.3.png, -5.5 and -15).")]
pub(super) struct Arguments {
    /// Folder to write into; created if missing
    #[arg(short, long, value_name = "DIR")]
    output: PathBuf,

    /// Size in pixels, or one number for a square [default: 512x512]
    #[arg(long, value_name = "WxH", default_value = "512x512", hide_default_value = true)]
    size: Size,

    #[command(flatten)]
    grain: Chosen<OfGrain>,

    /// Print one JSON object: files, settings, milliseconds [default: off]
    #[arg(long)]
    json: bool,
}

/// The settings that determine the contrast-enhanced texture and all random numbers, as in a charcoal drawing.
struct OfGrain;

impl Selection for OfGrain {
    type Of = Style;

    fn has(setting: &Setting<Style>) -> bool {
        ["seed", "random", "density", "cet-exponent", "cet-blur"].contains(&setting.name)
    }
}

/// Makes all textures, then writes them: an invalid setting leaves no file, a full disk none of them.
pub(super) fn run(arguments: &Arguments) -> Result<()> {
    let mut made = Vec::new();
    let contrast = arguments.contrast()?;
    let (size, seed, random) = (contrast.size, contrast.seed, contrast.random);
    made.push(Made::new("cet.png", &contrast, ContrastTexture::picture)?);
    made.push(Made::new("noise.png", &NoiseTexture { size, seed, random }, NoiseTexture::picture)?);
    made.push(Made::new("paper.png", &PaperTexture { size, seed, random }, PaperTexture::picture)?);
    made.push(Made::new("ramp.png", &Ramp::default(), |ramp| Ok(Picture::clone(&ramp.picture)))?);
    if contrast == (ContrastTexture { size, seed, ..ContrastTexture::default() }) {
        let scattered = ContrastTexture::figure_2(size, seed);
        made.push(Made::new("figure-2.png", &scattered, ContrastTexture::picture)?);
        for texture in ContrastTexture::figure_3(size, seed) {
            let name = format!("figure-3-m-{}.png", texture.exponent);
            made.push(Made::new(&name, &texture, ContrastTexture::picture)?);
        }
    }
    super::make_folder(&arguments.output)?;
    let targets = made.iter().map(|texture| {
        let path = arguments.output.join(&texture.name);
        Target::check(&path.to_string_lossy(), false)
    });
    let targets = targets.collect::<Result<Vec<_>>>()?;
    Target::write_all(targets.iter().zip(made.iter().map(|texture| &texture.picture)))?;
    if arguments.json {
        let rows: Vec<_> = made
            .iter()
            .map(|texture| json!({ "file": texture.name, "settings": texture.settings, "ms": texture.ms }))
            .collect();
        super::print_json(&json!({ "version": env!("CARGO_PKG_VERSION"), "textures": rows }))?;
    }
    Ok(())
}

/// A texture, its file's name and how long it took.
struct Made {
    name: String,
    settings: serde_json::Value,
    picture: Picture,
    ms: f64,
}

impl Made {
    fn new<T: serde::Serialize>(name: &str, texture: &T, make: impl Fn(&T) -> Result<Picture>) -> Result<Self> {
        let start = Instant::now();
        let picture = make(texture)?;
        Ok(Self { name: name.to_owned(), settings: json!(texture), picture, ms: milliseconds_since(start) })
    }
}

impl Arguments {
    fn contrast(&self) -> Result<ContrastTexture> {
        let charcoal = match Style::with_options(StyleName::Charcoal, &self.grain.options)? {
            Style::Charcoal(charcoal) => charcoal,
            _ => Charcoal::default(),
        };
        Ok(ContrastTexture {
            size: self.size,
            density_percent: charcoal.density_percent,
            exponent: charcoal.cet_exponent,
            blur_px: charcoal.cet_blur_px,
            seed: charcoal.seed,
            random: charcoal.random,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::Parser;

    #[derive(Parser)]
    struct Line {
        #[command(flatten)]
        arguments: Arguments,
    }

    #[test]
    fn without_options_the_command_line_means_the_librarys_defaults() {
        let arguments = Line::try_parse_from(["tinta", "-o", "folder"]).unwrap().arguments;
        let contrast = arguments.contrast().unwrap();
        assert_eq!(contrast, ContrastTexture::default());
        let (size, seed, random) = (contrast.size, contrast.seed, contrast.random);
        assert_eq!(NoiseTexture { size, seed, random }, NoiseTexture::default());
        assert_eq!(PaperTexture { size, seed, random }, PaperTexture::default());
    }
}
