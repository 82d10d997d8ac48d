//! Shared parts of the tests: places, meshes, families of scenes, sums of lines. The tests of the program use them too.

pub mod drawn;
pub mod families;
pub mod growth;
pub mod lines;
pub mod places;
pub mod random_scenes;
pub mod rendered;
pub mod shapes;

pub use places::*;
