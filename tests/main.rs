//! Tests that need a GL context or the finished program. One binary, so that it links once.

mod animation;
mod assimp;
mod charcoal;
mod charcoal_twin;
mod cli;
mod cli_ink;
mod cli_lines;
mod cli_measure;
mod corpus;
mod docs;
mod docs_run;
mod edges;
mod examples;
#[cfg(unix)]
mod external;
mod faults;
mod figures;
mod gltf;
mod goldens;
mod hiding;
mod hostile;
mod improved;
mod inking;
#[cfg(unix)]
mod installing;
mod licences;
mod lines_brute;
mod lines_degenerate;
mod lines_inking;
mod lines_invariance;
mod lines_random;
mod lines_rules;
mod lines_shapes;
mod lines_support;
mod measure;
mod mrt;
mod output;
mod output_killed;
mod pipeline;
mod presets;
mod prune;
mod prune_pictures;
mod recipes;
mod report;
mod report_page;
mod shapes;
mod shared_models;
mod silhouettes;
mod stress;
mod support;
mod svg;
mod textures;
mod turntable;
mod twin;
#[cfg(feature = "window")]
mod window;
