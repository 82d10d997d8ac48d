//! Figure 7 of Evangelista et al. 2005, the diagram of passes: the plans of two and of three passes, as this program carries
//! them out.

use super::HowToMeasure;
use serde::Serialize;
use tinta::error::Result;
use tinta::mesh::{LoadOptions, load};
use tinta::scene::{Scene, SceneSettings};
use tinta::styles::{Show, Style, StyleName};

/// One of the diagram's two columns.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct PassColumn {
    /// Its heading.
    pub title: &'static str,
    /// The command that prints it.
    pub command: String,
    /// Its passes, from the first to the last.
    pub passes: Vec<PassSteps>,
}

/// A pass.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct PassSteps {
    /// Its name in reports and dumps.
    pub name: &'static str,
    /// Its steps, a line each.
    pub steps: Vec<String>,
}

/// Both columns, in the order of the paper: two passes at the left, three at the right.
///
/// # Errors
///
/// As [`Style::plan`], which does not fail for published settings.
pub fn pass_columns(how: &HowToMeasure) -> Result<Vec<PassColumn>> {
    let settings = SceneSettings { size: how.size, ..SceneSettings::default() };
    let scene = Scene::new(vec![load("builtin:bust", &LoadOptions::default())?.mesh], &settings)?;
    let column = |(title, name): (&'static str, StyleName)| {
        let plan = Style::named(name).plan(&scene, Show::Final)?;
        let pass = |pass: &tinta::plan::Pass| PassSteps {
            name: pass.name,
            steps: pass.steps.iter().map(ToString::to_string).collect(),
        };
        Ok(PassColumn {
            title,
            command: format!("tinta render builtin:bust -o {0}.png --style {0} --explain --full", name.name()),
            passes: plan.passes.iter().map(pass).collect(),
        })
    };
    [("Two passes", StyleName::TwoPass), ("Three passes", StyleName::ThreePass)].into_iter().map(column).collect()
}
