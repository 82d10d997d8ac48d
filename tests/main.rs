//! Tests that need a GL context or the finished program. One binary, so that it links once.

mod animation;
mod charcoal;
mod charcoal_twin;
mod cli;
mod cli_ink;
mod docs;
mod edges;
mod goldens;
mod inking;
mod licences;
mod lines_brute;
mod lines_degenerate;
mod lines_invariance;
mod lines_random;
mod lines_rules;
mod lines_shapes;
mod lines_support;
mod pipeline;
mod shapes;
mod shared_models;
mod silhouettes;
mod support;
mod textures;
mod turntable;
mod twin;
