//! Tests that need a GL context or the finished program. One binary, so that it links once.

mod animation;
mod charcoal;
mod charcoal_twin;
mod cli;
mod cli_ink;
mod cli_lines;
mod docs;
mod edges;
mod goldens;
mod inking;
mod licences;
mod lines_inking;
mod pipeline;
mod report;
mod report_page;
mod shapes;
mod shared_models;
mod silhouettes;
mod support;
mod svg;
mod textures;
mod turntable;
mod twin;
