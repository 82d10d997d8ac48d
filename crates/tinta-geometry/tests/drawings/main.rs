//! Lines and areas as drawings: specks, parts, tones, files. One binary, to link once.

extern crate tinta_geometry as tinta;

mod dxf;
mod lit;
mod part_styles;
#[cfg(feature = "pdf")]
mod pdf;
mod quality;
mod regions;
mod specks;
#[expect(dead_code, reason = "shared with the other tests")]
#[path = "../support/mod.rs"]
mod support;
mod svg;
mod taper;
mod written_once;
