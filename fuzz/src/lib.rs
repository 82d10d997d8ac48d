//! Shared parts of the fuzz targets: see README.md.

pub mod memory;
pub mod readers;
pub mod scenes;
