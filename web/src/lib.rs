//! tinta in a browser: the library's styles on a canvas, its exact lines, its tables of settings, for a page of plain JavaScript.
//!
//! Takes models' bytes, and options by the command line's names; returns pictures, SVG and their descriptions as JSON. The page
//! is in `web/page/`; `scripts/web` builds both into `web/dist/`. For targets other than a browser it is empty.

#[cfg(target_arch = "wasm32")]
mod errors;
#[cfg(target_arch = "wasm32")]
mod model;
#[cfg(target_arch = "wasm32")]
mod pane;
#[cfg(target_arch = "wasm32")]
mod tables;

#[cfg(target_arch = "wasm32")]
pub use model::Model;
#[cfg(target_arch = "wasm32")]
pub use pane::Pane;
