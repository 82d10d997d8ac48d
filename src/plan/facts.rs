//! Facts that a style states of its draws. With them `prune` can shorten plans without knowing a shader.
//!
//! A draw's state includes its depth test and blending, but only the author knows the effect of its shaders. So the style states
//! that effect beside the draw. A plan draws the same whatever it states: only `prune` reads the facts, and it assumes nothing
//! else. When a shader is replaced by another text, its draws' facts are dropped.

use super::Program;
use std::fmt;

/// Facts about a draw's shaders. The default states none.
///
/// ```
/// use tinta::plan::{Draw, Facts, Geometry, Paint, Program};
///
/// let program = Program::new("own/dots.vert", ["own/dots.frag"]);
/// let dots = Draw { facts: Facts::plain(), ..Draw::new(Geometry::Objects(Paint::Materials), Some(program)) };
/// assert_eq!(dots.facts.to_string(), "keeps places, keeps pixels");
/// ```
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Facts {
    /// Vertices are drawn at the scene camera's projection of them, as by `ftransform()`. Faces outside the picture, turned away
    /// or hidden can then be left out.
    pub keeps_places: bool,
    /// Every pixel of a face gets a colour and the face's depth: the shaders discard none and write no depth.
    pub keeps_pixels: bool,
    /// All its pixels get this colour: red, green, blue, alpha.
    pub constant_color: Option<[f32; 4]>,
    /// It leaves every pixel's colour and depth unchanged, for this reason.
    pub adds_nothing: Option<String>,
    /// Largest distance from its own pixel at which it reads the textures that passes leave, pixels.
    pub reach_px: Option<u32>,
    /// Its vertex shader uses the vertex's place in clip space for more than its position, so clip space must be the whole
    /// picture's.
    pub reads_clip_place: bool,
    /// The result for a pixel if each of these textures is uniform within the draw's reach.
    pub where_even: Option<WhereEven>,
    /// A program that draws the same with less work.
    pub shorter: Option<Shorter>,
}

/// A filter's result for a pixel whose surroundings are uniform.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum WhereEven {
    /// The pixel stays unchanged.
    Unchanged,
    /// It gets this colour: red, green, blue, alpha.
    Color([f32; 4]),
}

/// A program for the same uniforms, textures and pixels, without the light that no tone depends on.
#[derive(Debug, Clone, PartialEq)]
pub struct Shorter {
    /// Its shaders.
    pub program: Program,
    /// The light that they do not compute.
    pub without: &'static str,
    /// Why that makes no difference.
    pub because: String,
}

impl Facts {
    /// Returns the facts of most shaders: they keep places and pixels.
    pub fn plain() -> Self {
        Self { keeps_places: true, keeps_pixels: true, ..Self::default() }
    }

    /// Returns the facts of a square of one colour.
    pub(crate) fn constant(color: [f32; 4]) -> Self {
        Self { constant_color: Some(color), ..Self::plain() }
    }
}

impl fmt::Display for Facts {
    /// `keeps places, keeps pixels`; empty without facts.
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let color = |[r, g, b, a]: [f32; 4]| format!("({r}, {g}, {b}, {a})");
        let facts = [
            self.keeps_places.then(|| "keeps places".to_owned()),
            self.keeps_pixels.then(|| "keeps pixels".to_owned()),
            self.constant_color.map(|constant| format!("all in {}", color(constant))),
            self.adds_nothing.as_ref().map(|reason| format!("adds nothing: {reason}")),
            self.reach_px.map(|reach| format!("reads no further than {reach} px")),
            self.reads_clip_place.then(|| "reads its place in clip space".to_owned()),
            self.where_even.map(|what| match what {
                WhereEven::Unchanged => "nothing where that is even".to_owned(),
                WhereEven::Color(even) => format!("{} where that is even", color(even)),
            }),
            self.shorter
                .as_ref()
                .map(|Shorter { program, without, .. }| format!("the same as {program} without {without}")),
        ];
        out.write_str(&facts.into_iter().flatten().collect::<Vec<_>>().join(", "))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plan::{Draw, Geometry, Pass, Plan, Step};

    fn program(vertex: &'static str, fragment: &'static str) -> Program {
        Program::new(vertex, [fragment])
    }

    fn facts_after(facts: Facts, replaced: &str) -> Facts {
        let draw = Draw { facts, ..Draw::new(Geometry::ScreenSquare, Some(program("a.vert", "a.frag"))) };
        let mut plan = Plan::new(vec![Pass::new("a", vec![Step::Draw(draw)])]);
        plan.forget_facts_of(&[replaced.to_owned()]);
        let Step::Draw(draw) = plan.passes.remove(0).steps.remove(0) else { panic!("a draw") };
        draw.facts
    }

    #[test]
    fn facts_go_with_any_shader_of_their_program_and_stay_with_others() {
        let shorter = Shorter { program: program("a.vert", "b.frag"), without: "light", because: String::new() };
        let facts = Facts { shorter: Some(shorter), ..Facts::constant([1.0; 4]) };
        assert_eq!(facts_after(facts.clone(), "a.vert"), Facts::default());
        assert_eq!(facts_after(facts.clone(), "a.frag"), Facts::default());
        assert_eq!(facts_after(facts.clone(), "c.frag"), facts);
        // The shorter program no longer draws the same.
        assert_eq!(facts_after(facts, "b.frag"), Facts::constant([1.0; 4]));
    }

    #[test]
    fn fixed_functions_need_not_be_stated() {
        let fixed = Draw::new(Geometry::ScreenSquare, None);
        assert!(fixed.keeps_places() && fixed.keeps_pixels());
        let half = Draw::new(Geometry::ScreenSquare, Some(Program::new("a.vert", [""; 0])));
        assert!(!half.keeps_places() && half.keeps_pixels());
        let own = Draw::new(Geometry::ScreenSquare, Some(program("a.vert", "a.frag")));
        assert!(!own.keeps_places() && !own.keeps_pixels());
        assert_eq!(own.facts.to_string(), "");
    }

    #[test]
    fn facts_print_as_what_they_allow() {
        let facts = Facts { reach_px: Some(2), where_even: Some(WhereEven::Unchanged), ..Facts::plain() };
        assert_eq!(
            facts.to_string(),
            "keeps places, keeps pixels, reads no further than 2 px, nothing where that is even"
        );
        assert_eq!(
            Facts::constant([0.0, 0.5, 1.0, 1.0]).to_string(),
            "keeps places, keeps pixels, all in (0, 0.5, 1, 1)"
        );
    }
}
