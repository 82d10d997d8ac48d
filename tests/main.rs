//! Tests that need a GL context or the finished program. One binary, so that it links once.

mod animation;
mod charcoal;
mod charcoal_twin;
mod cli;
mod cli_ink;
mod docs;
mod edges;
mod goldens;
mod improved;
mod inking;
mod licences;
mod pipeline;
mod shapes;
mod shared_models;
mod silhouettes;
mod support;
mod textures;
mod turntable;
mod twin;
