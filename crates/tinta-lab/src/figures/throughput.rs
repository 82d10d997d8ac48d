//! How many pixels a fragment shader shades in a second: the time of a square over the whole picture, drawn as the style
//! draws it, less that of the same frame without it.

use super::series::{Contestant, Series};
use serde::Serialize;
use std::sync::Arc;
use tinta::error::Result;
use tinta::plan::{Geometry, Plan, Step};
use tinta::scene::Scene;
use tinta::styles::{Border, Cartoon, Filter, Show, Style};

/// A shader of the article.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Shader {
    /// Its task.
    pub name: &'static str,
    /// The article's number, million pixels a second, if it prints one.
    pub article_mpixels: Option<f64>,
    is_two_pass: bool,
    pass: &'static str,
    /// With a factor other than the published one, to run both filters in the same shader with settings.
    filter: Option<Filter>,
}

/// Detection factor of the two filters that are compared.
pub(super) const COMPARED_FACTOR: f32 = 0.25;

/// The article's four shaders, then the two filters it compares.
pub const SHADERS: [Shader; 6] = [
    Shader { name: "map", article_mpixels: Some(400.0), is_two_pass: false, pass: "map", filter: None },
    Shader { name: "tones", article_mpixels: Some(36.36), is_two_pass: false, pass: "tones", filter: None },
    Shader { name: "border", article_mpixels: Some(28.57), is_two_pass: false, pass: "border", filter: None },
    Shader {
        name: "tones and border in one",
        article_mpixels: Some(15.69),
        is_two_pass: true,
        pass: "tones-and-border",
        filter: None,
    },
    Shader {
        name: "border, four neighbours, factor as a setting",
        article_mpixels: None,
        is_two_pass: false,
        pass: "border",
        filter: Some(Filter::Laplacian4),
    },
    Shader {
        name: "border, eight neighbours, factor as a setting",
        article_mpixels: None,
        is_two_pass: false,
        pass: "border",
        filter: Some(Filter::Laplacian8),
    },
];

/// A shader's measured throughput.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ShaderRow {
    /// As in [`SHADERS`].
    pub name: &'static str,
    /// The fragment shaders below `glsl/`.
    pub fragments: Vec<String>,
    /// The article's number, million pixels a second.
    #[serde(rename = "paper_mpixels")]
    pub article_mpixels: Option<f64>,
    /// Ours; `None` where the square took no measurable time.
    pub mpixels: Option<f64>,
    /// Milliseconds of the square alone: the median of the differences within a turn.
    pub square_ms: f64,
    /// These differences, in the order measured.
    pub squares_ms: Vec<f64>,
    /// The frames with the square.
    pub with_square: Series,
}

/// The frames to measure: one for each shader, and last the one without a square.
pub(super) fn contestants(scene: &Arc<Scene>) -> Result<Vec<Contestant>> {
    let mut contestants = Vec::new();
    for shader in SHADERS {
        let border =
            shader.filter.map(|filter| Border { filter, detection_factor: COMPARED_FACTOR, ..Border::default() });
        let cartoon = Cartoon { border: Some(border.unwrap_or_default()), ..Cartoon::default() };
        let style = if shader.is_two_pass { Style::TwoPass(cartoon) } else { Style::ThreePass(cartoon) };
        let plan = style.plan(scene, Show::Final)?;
        let is_square = |step: &&Step| {
            matches!(step, Step::Draw(draw)
                if matches!(draw.geometry, Geometry::BackgroundSquare { .. } | Geometry::ScreenSquare))
        };
        let pass = plan.passes.iter().find(|pass| pass.name == shader.pass);
        let square = pass.and_then(|pass| pass.steps.iter().find(is_square)).cloned();
        contestants.push(Contestant::new(scene, frame(square)));
    }
    contestants.push(Contestant::new(scene, frame(None)));
    Ok(contestants)
}

/// A frame of a cleared map and perhaps a square.
fn frame(square: Option<Step>) -> Plan {
    let mut steps = vec![Step::clear([0.0, 0.0, 0.0, 1.0]), Step::CopyFramebuffer];
    steps.extend(square);
    let pass = tinta::plan::Pass::new("square", steps);
    Plan::new(vec![pass])
}

/// The rows measured by [`contestants`].
pub(super) fn rows(contestants: &[Contestant]) -> Vec<ShaderRow> {
    let Some((without, with)) = contestants.split_last() else { return Vec::new() };
    let row = |(shader, contestant): (Shader, &Contestant)| {
        let with_square = contestant.series();
        let without = without.series();
        let pairs = with_square.cost_ms().iter().zip(without.cost_ms());
        let squares_ms: Vec<f64> = pairs.map(|(with, without)| with - without).collect();
        let square_ms = tinta::renderer::median(squares_ms.clone()).unwrap_or_default();
        let mpixels = contestant.scene.size.pixel_count() as f64 / square_ms * 1e-3;
        let draws = contestant.plan.steps().filter_map(|(_, step)| match step {
            Step::Draw(draw) => draw.program.as_ref(),
            _ => None,
        });
        ShaderRow {
            name: shader.name,
            fragments: draws.flat_map(|program| &program.fragments).map(ToString::to_string).collect(),
            article_mpixels: shader.article_mpixels,
            mpixels: (square_ms > 0.0).then_some(mpixels),
            square_ms,
            squares_ms,
            with_square,
        }
    };
    SHADERS.into_iter().zip(with).map(row).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use tinta::mesh::Mesh;
    use tinta::scene::SceneSettings;

    #[test]
    fn every_shader_is_drawn_as_one_square_by_its_own_program() {
        let scene = Arc::new(Scene::new(vec![Arc::new(Mesh::triangle())], &SceneSettings::default()).unwrap());
        let rows = rows(&contestants(&scene).unwrap());
        let fragments: Vec<String> =
            rows.iter().map(|row| row.fragments.join("+").replace("evangelista/", "")).collect();
        let expected = [
            "map.frag",
            "toon.frag",
            "border.frag",
            "two-pass.frag",
            "border-settings.frag+filter-laplacian4.frag+tap-next.frag+texel-map.frag+depth-as-filtered.frag",
            "border-settings.frag+filter-laplacian8.frag+tap-next.frag+texel-map.frag+depth-as-filtered.frag",
        ];
        assert_eq!(fragments, expected);
        assert!(rows.iter().all(|row| row.mpixels.is_none()), "nothing was timed");
    }
}
