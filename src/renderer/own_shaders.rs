//! Remarks on shaders that replace built-in ones: those that a plan does not run, and uniforms that nothing sets.

use crate::gl::fixed_function;
use crate::plan::{Draw, Plan, Program, Step};
use std::collections::HashMap;
use tinta_glsl::tokens::{Kind, Token, tokens};

/// Returns remarks on these shaders, by their paths, as a plan runs them, a sentence each.
pub(super) fn remarks(plan: &Plan, own: &HashMap<String, String>) -> Vec<String> {
    let draws = plan.steps().filter_map(|(_, step)| if let Step::Draw(draw) = step { Some(draw) } else { None });
    let programs: Vec<(&Draw, Program)> =
        draws.filter_map(|draw| Some((draw, fixed_function::program_of(draw, false)?))).collect();
    let mut paths: Vec<&str> = own.keys().map(String::as_str).collect();
    paths.sort_unstable();
    let runs = |path: &str| programs.iter().any(|(_, program)| shaders(program).any(|shader| shader == path));
    let unused: Vec<&str> = paths.iter().copied().filter(|path| !runs(path)).collect();
    let mut remarks = Vec::new();
    if !unused.is_empty() {
        remarks.push(format!(
            "no pass of this drawing runs your {}; tinta render --explain lists the shaders of each pass",
            unused.join(", ")
        ));
    }
    // GL's side sets the uniforms of its own programs.
    for path in paths.into_iter().filter(|path| !path.starts_with("fixed/")) {
        let of_path = programs.iter().filter(|(_, program)| shaders(program).any(|shader| shader == path));
        let mut unset: Vec<String> = Vec::new();
        for (draw, program) in of_path {
            let is_set = |name: &str| {
                draw.uniforms.iter().any(|uniform| uniform.name == name)
                    || (0..).zip(&draw.textures).any(|(unit, (sampler, _))| {
                        fixed_function::sampler(draw, program, unit).unwrap_or(sampler) == name
                    })
            };
            unset.extend(uniforms(&own[path]).into_iter().filter(|name| !is_set(name)).map(str::to_owned));
        }
        unset.sort_unstable();
        unset.dedup();
        if !unset.is_empty() {
            remarks.push(format!(
                "nothing sets {} of your {path}: numbers are 0, samplers read texture unit 0; write constants instead",
                unset.join(", ")
            ));
        }
    }
    remarks
}

fn shaders(program: &Program) -> impl Iterator<Item = &str> {
    [&program.vertex].into_iter().chain(&program.fragments).map(AsRef::as_ref)
}

/// The names of the uniforms that a shader declares without a value and uses.
fn uniforms(text: &str) -> Vec<&str> {
    let words: Vec<Token<'_>> =
        tokens(text).into_iter().filter(|token| token.kind != Kind::Between && !token.is_directive).collect();
    let mut names = Vec::new();
    for (place, _) in words.iter().enumerate().filter(|(_, token)| token.text == "uniform") {
        // A type follows, then names with commas between them; a value may have commas of its own.
        let mut declared = words[place + 1..].iter().take_while(|token| token.text != ";").skip(1).peekable();
        while let Some(token) = declared.next() {
            if declared.peek().is_some_and(|next| next.text == "=") {
                break;
            }
            names.extend((token.kind == Kind::Word).then_some(token.text));
        }
    }
    names.retain(|name| words.iter().filter(|token| token.text == *name).count() > 1);
    names
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::glsl;
    use crate::mesh::Mesh;
    use crate::scene::Scene;
    use crate::styles::{Show, Style, StyleName};
    use std::sync::Arc;

    #[test]
    fn uniforms_are_those_declared_and_used() {
        let text = "#define uniform no\nuniform vec3 a, b;\nuniform sampler3D Noise; // uniform float c;\nuniform float unused, set = 1.0;\n\
                    void main() { gl_FragColor = vec4(a + b * set, texture3D(Noise, a).r); }";
        assert_eq!(uniforms(text), ["a", "b", "Noise"]);
    }

    #[test]
    fn every_style_sets_the_uniforms_of_its_own_shaders() {
        let all: HashMap<String, String> =
            glsl::SOURCES.iter().map(|(path, text)| ((*path).to_owned(), (*text).to_owned())).collect();
        let mut count = 0;
        for (name, _) in StyleName::of_passes() {
            let scene = Scene::new(vec![Arc::new(Mesh::triangle())], &Default::default()).unwrap();
            let Ok(plan) = Style::named(name.parse().unwrap()).plan(&scene, Show::Final) else { continue };
            let said = remarks(&plan, &all);
            assert!(said.iter().all(|remark| !remark.contains("nothing sets")), "{name}: {said:?}");
            count += 1;
        }
        assert!(count >= 8, "{count} styles");
    }
}
