//! What the library draws with OpenGL, and the steps to it. One binary, to link once.

mod animation;
mod api;
mod charcoal;
mod charcoal_beyond;
mod doubled_faces;
mod examples;
mod gltf;
mod goldens;
mod improved;
mod inking;
mod mrt;
mod pipeline;
mod pixel;
mod plan_facts;
mod prune;
mod prune_pictures;
mod shared_models;
mod small_scenes;
mod stacked_faces;
mod submission;
mod supersampling;
#[expect(dead_code, reason = "shared with the other tests")]
#[path = "../support/mod.rs"]
mod support;
mod surfaces;
mod tiles;
