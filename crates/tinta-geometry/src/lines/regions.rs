//! Exact regions: a view cut into areas, each seen as one face or as background.
//!
//! Input: a [`Scene`](crate::scene::Scene). Output: [`Regions`], polygons with holes that fill the picture without gaps and overlaps. Neighbours share
//! their vertices. Three steps make them:
//!
//! 1. *Borders*. Where one face gives way to another lies the image of a side of a face, of an intersection of faces, or of a cut
//!    by the near or the far plane. The deciders of lines find the visible pieces of all of these. One too many does no harm.
//! 2. *Cells*. Snap rounding cuts the borders where they cross, on a grid of at most 2^-15 pixels; they bound the cells of a
//!    planar map. All of this is exact in integers.
//! 3. *Labels*. In each cell one ray decides what is seen. Borders with the same label on both sides go, which joins their cells.
//!
//! No step closes a gap, since none can open: a piece ends on another one, and goes a little beyond it.
//!
//! ```
//! # fn main() -> tinta_geometry::Result<()> {
//! use tinta_geometry::lines::Regions;
//! use tinta_geometry::{LoadOptions, Scene, SceneSettings, load};
//!
//! let mesh = load("../../models/open-box.obj", &LoadOptions::default())?.mesh;
//! let scene = Scene::new([mesh], &SceneSettings::default())?;
//!
//! let regions = Regions::of(&scene)?;
//! let area: f64 = regions.regions.iter().map(|region| region.area_px).sum();
//! assert!((area - 512.0 * 512.0).abs() < 1e-9 * area);
//! # Ok(())
//! # }
//! ```

mod cut;
mod grid;
mod ground;
mod lit;
mod planar_map;
mod region;
mod snap;
mod seen_normals;
mod surface;
mod tone_borders;
mod tones;
mod view;

pub use ground::{ground_light, ground_shadow};
pub use lit::LIGHTS;
pub use region::{Region, Regions, SeenFace};
pub use seen_normals::SeenNormals;
pub use surface::{JoinKey, Surface};
pub use tones::{ToneLight, ToneRule, TonedSurface};
pub(in crate::lines) use view::View;
