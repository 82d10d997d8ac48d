//! Every figure of the three texts, drawn again or listed with the reason why not: lists of plain data, and the code that draws,
//! measures and shows them.
//!
//! Takes a picture size and a renderer, and returns pictures, measured numbers ([`Numbers`]) and a page with everything
//! ([`page::page`]). The list knows neither GL nor clap: a panel is a scene's settings and a style, with the words that make
//! `tinta` draw the same. A test compares the two.
//!
//! ```
//! use tinta::Size;
//! use tinta_lab::figures::figures;
//!
//! let size = Size { width: 256, height: 256 };
//! let tones = figures(size).into_iter().find(|figure| figure.id == "evangelista-5").expect("figure 5");
//! assert_eq!(tones.panels().len(), 4, "Phong, one, two and three tones");
//! ```

mod dachsbacher;
mod draw;
mod evangelista;
mod figure;
mod filters;
mod measure;
mod mix;
mod numbers;
mod others;
pub mod page;
mod passes;
pub mod plot;
mod reasons;
mod series;
mod throughput;
mod valente;

pub use draw::Artist;
pub use figure::{Content, Drawing, Figure, Model, NO_TEXTURED_MODEL, Panel, SceneDrawing, Text};
pub use filters::{Kernel, kernels};
pub use measure::{HowToMeasure, Turn, measure, triangles_a_turn};
pub use mix::{Mix, TRIANGLES};
pub use numbers::{ARTICLE, Article, BackgroundRow, FilterRow, FrameRow, Host, MixRow, Numbers, Reason};
pub use passes::{PassColumn, PassSteps, pass_columns};
pub use throughput::{SHADERS, ShaderRow};

use tinta::error::{Error, Result};
use tinta::scene::Size;

/// All figures, drawn or not, for pictures of this size.
pub fn figures(size: Size) -> Vec<Figure> {
    [
        others::complete(Text::Evangelista, evangelista::figures()),
        others::complete(Text::Valente, valente::figures(size)),
        others::complete(Text::Dachsbacher, dachsbacher::figures()),
    ]
    .concat()
}

/// The figures with these ids, in the list's order; all if no id is given.
///
/// # Errors
///
/// [`Error::Setting`] for an id that no figure has.
pub fn only(figures: Vec<Figure>, ids: &[String]) -> Result<Vec<Figure>> {
    let known: Vec<&str> = figures.iter().map(|figure| figure.id).collect();
    if let Some(unknown) = ids.iter().find(|id| !known.contains(&id.as_str())) {
        return Err(Error::value(
            "only",
            unknown,
            format!("there is no such figure; choose from {}", known.join(", ")),
        ));
    }
    Ok(figures.into_iter().filter(|figure| ids.is_empty() || ids.iter().any(|id| id == figure.id)).collect())
}
