//! Tests that need a GL context or the finished program. One binary, so that it links once.

mod animation;
mod charcoal;
mod charcoal_twin;
mod cli;
mod cli_ink;
mod cli_lines;
mod docs;
mod edges;
mod figures;
mod goldens;
mod inking;
mod licences;
mod lines_inking;
mod measure;
mod pipeline;
mod shapes;
mod shared_models;
mod silhouettes;
mod support;
mod svg;
mod textures;
mod turntable;
mod twin;
