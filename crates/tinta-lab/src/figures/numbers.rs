//! The measurements of Evangelista et al. 2005, section 5, with the numbers printed in the article.

use super::mix::Mix;
use super::series::{Interval, Series, gain_percent};
use super::throughput::ShaderRow;
use serde::Serialize;
use tinta::gl::ContextInfo;
use tinta::scene::Size;
use tinta::styles::Filter;

/// The numbers printed in the article's text.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Article {
    /// The card.
    pub device: &'static str,
    /// Picture size.
    pub size: Size,
    /// Triangles of the first and the last scene.
    pub triangles: [usize; 2],
    /// How much more frames a second the cheaper filter gives, percent.
    pub filter_gain_percent: f64,
    /// How much more frames a second two passes without the square give at most, percent.
    pub background_gain_percent: f64,
}

/// The article's numbers; those of the shaders are in [`super::SHADERS`].
pub const ARTICLE: Article = Article {
    device: "GeForce FX 5200, processor of 1 GHz",
    size: Size { width: 512, height: 512 },
    triangles: [3_039, 122_646],
    filter_gain_percent: 48.0,
    background_gain_percent: 100.0,
};

/// Everything measured.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Numbers {
    /// The driver and machine.
    pub host: Host,
    /// Picture size of the frames.
    pub size: Size,
    /// A frame with only a clear and the read-back.
    pub empty: Series,
    /// The scenes of figure 13.
    pub scenes: Vec<MixRow>,
    /// Their frames, scene by scene.
    pub frames: Vec<FrameRow>,
    /// The article's filter and the one it replaces.
    pub filters: Vec<FilterRow>,
    /// Two passes without the square, from near to far.
    pub backgrounds: Vec<BackgroundRow>,
    /// The shaders.
    pub shaders: Vec<ShaderRow>,
    /// The numbers printed in the article's text.
    #[serde(rename = "paper")]
    pub article: Article,
    /// Why ours differ, a few sentences for each number.
    pub reasons: Vec<Reason>,
}

/// A sentence about a measured number.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Reason {
    /// `frames`, `filter`, `background` or `throughput`.
    pub about: &'static str,
    /// It.
    pub sentence: String,
}

/// A scene of figure 13.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct MixRow {
    /// Its contents.
    #[serde(flatten)]
    pub mix: Mix,
    /// Share of the picture's pixels that its models cover, 0 to 1.
    pub covered: f64,
}

/// A curve's point of figure 13.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FrameRow {
    /// Triangles of its scene.
    pub triangles: usize,
    /// One to three.
    pub tones: u8,
    /// Two or three.
    pub passes: u8,
    /// Its frames.
    #[serde(flatten)]
    pub series: Series,
}

/// A filter in the first scene, three passes.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FilterRow {
    /// The filter.
    pub filter: Filter,
    /// Its frames.
    #[serde(flatten)]
    pub series: Series,
}

/// The bust from one distance.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct BackgroundRow {
    /// The eye's distance, relative to the one at which the bust fills the picture.
    pub distance: f64,
    /// Share of the picture's pixels that it covers, 0 to 1.
    pub covered: f64,
    /// Three passes with the square.
    pub three_pass: Series,
    /// Two passes with the square.
    pub two_pass: Series,
    /// Two passes without it.
    pub two_pass_without: Series,
}

impl BackgroundRow {
    /// How much more frames a second two passes without the square give than three passes, percent.
    pub(crate) fn gain_percent(&self) -> Interval {
        gain_percent(&self.two_pass_without, &self.three_pass)
    }
}

impl Numbers {
    /// How much more frames a second the article's filter gives than the one it replaces, percent.
    pub(crate) fn filter_gain_percent(&self) -> Option<Interval> {
        let of = |filter| self.filters.iter().find(|row| row.filter == filter);
        Some(gain_percent(&of(Filter::Laplacian4)?.series, &of(Filter::Laplacian8)?.series))
    }

    /// How much more frames a second two passes give than three, percent, in each scene and number of tones.
    pub(crate) fn gains_of_two(&self) -> Vec<Interval> {
        let of_two = self.frames.iter().filter(|row| row.passes == 2);
        let gain = |row: &FrameRow| {
            let three = self.curve(row.tones, 3).find(|other| other.triangles == row.triangles)?;
            Some(gain_percent(&row.series, &three.series))
        };
        of_two.filter_map(gain).collect()
    }

    /// The frames of these tones and passes, by triangles.
    pub fn curve(&self, tones: u8, passes: u8) -> impl Iterator<Item = &FrameRow> {
        self.frames.iter().filter(move |row| row.tones == tones && row.passes == passes)
    }
}

/// The driver and machine.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Host {
    /// GL_RENDERER
    pub renderer: String,
    /// GL_VERSION
    pub version: String,
    /// Threads of the processor.
    pub threads: usize,
    /// Whether the renderer is a program rather than a graphics device.
    pub is_software: bool,
}

impl Host {
    /// The machine this runs on.
    pub fn new(context: &ContextInfo) -> Self {
        let threads = std::thread::available_parallelism().map_or(1, usize::from);
        let (renderer, version) = (context.renderer.clone(), context.version.clone());
        Self { is_software: context.is_software(), renderer, version, threads }
    }
}
