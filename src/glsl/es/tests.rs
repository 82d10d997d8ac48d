use super::super::{SOURCES, source};
use super::*;

fn text_of(stage: Stage, text: &str) -> String {
    transcribed(stage, text).unwrap().into_iter().map(|piece| piece.text).collect()
}

#[test]
fn every_shader_is_transcribed_and_its_pieces_are_the_shader() {
    for (path, text) in SOURCES {
        let pieces = transcribed(Stage::of(path), text).unwrap_or_else(|problem| panic!("{path}: {problem}"));
        let original: String = pieces.iter().map(|piece| piece.original.as_str()).collect();
        assert_eq!(original, *text, "{path}");
        assert!(pieces[0].is_changed() && pieces[0].text.starts_with("#version 100\n"), "{path}");
        let new: String = pieces.iter().map(|piece| piece.text.as_str()).collect();
        let code: String = tokens(&new).iter().filter(|it| !it.text.starts_with("//")).map(|it| it.text).collect();
        // What this language does not have.
        let mine = ["gl_Position", "gl_PointSize", "gl_FragColor", "gl_FragData", "gl_FragCoord", "gl_FrontFacing"];
        for token in tokens(&code).iter().filter(|token| token.kind == Kind::Word) {
            assert!(!token.text.starts_with("gl_") || mine.contains(&token.text), "{path}: {}", token.text);
            assert!(!["ftransform", "sampler1D", "texture1D"].contains(&token.text), "{path}: {}", token.text);
        }
        assert!(!tokens(&code).iter().any(|it| it.kind == Kind::Number && it.text.ends_with('f')), "{path}");
    }
}

#[test]
fn whole_numbers_become_floats_where_1_20_takes_them_for_floats() {
    let vertex = |text: &str| text_of(Stage::Fragment, &format!("#version 120\n{text}\n"));
    for (old, new) in [
        ("#define X(t) (gl_FragCoord.x+t)*2", "#define X(t) (gl_FragCoord.x+t)*2.0"),
        ("vec4 a=abs((-b+4*e)*0.2f);", "vec4 a=abs((-b+4.0*e)*0.2);"),
        ("float a = texPosX(-1);", "float a = texPosX(-1.0);"),
        (
            "uniform int smudge; void f() { if (smudge != 0) a *= 2; }",
            "uniform int smudge; void f() { if (smudge != 0) a *= 2.0; }",
        ),
        ("uniform float edge = 1;", "const float edge = 1.0;"),
        ("const int LARGEST = 16; int b = 2 * LARGEST;", "const int LARGEST = 16; int b = 2 * LARGEST;"),
        ("gl_FragData[1] = vec4(1);", "gl_FragData[1] = vec4(1.0);"),
        ("for (int y = 0; y < 4; ++y) a += 1e3;", "for (int y = 0; y < 4; ++y) a += 1e3;"),
    ] {
        assert!(vertex(old).contains(new), "{}", vertex(old));
    }
}

#[test]
fn the_pipelines_names_become_attributes_uniforms_and_varyings() {
    let map = text_of(Stage::Vertex, source("evangelista/map.vert").unwrap());
    for part in [
        "attribute vec4 tinta_Vertex;\n",
        "attribute vec3 tinta_Normal;\n",
        "uniform mat3 tinta_NormalMatrix;\n",
        "varying vec4 tinta_FrontColor;\n",
        "void tinta_main() {",
        "tinta_FrontColor.xyz=tinta_NormalMatrix*tinta_Normal;",
        "gl_Position=(tinta_ModelViewProjectionMatrix * tinta_Vertex);",
        "tinta_FrontColor = clamp(tinta_FrontColor, 0.0, 1.0);",
    ] {
        assert!(map.contains(part), "{part} in {map}");
    }
    assert!(!map.contains("attribute vec4 tinta_Color"), "what is not read is not declared");
    // A fragment's colour is the vertices' varying.
    let fragment = text_of(Stage::Fragment, source("evangelista/map.frag").unwrap());
    assert!(fragment.contains("gl_FragColor=vec4(tinta_FrontColor.xyz,gl_FragCoord.z);"), "{fragment}");
}

#[test]
fn one_dimensional_textures_are_a_texel_high() {
    let text = text_of(Stage::Fragment, source("evangelista/tone-texture.frag").unwrap());
    assert!(text.contains("uniform sampler2D toneTable;"));
    assert!(
        text.contains("texture2D(toneTable, vec2( diffuse * toneTableScale.x + toneTableScale.y, 0.5)).r;"),
        "{text}"
    );
}

#[test]
fn loops_of_unknown_length_are_counted() {
    let text = text_of(Stage::Fragment, source("improved/specks.frag").unwrap());
    let spaced: Vec<&str> = text.split_whitespace().collect();
    let text = spaced.join(" ");
    let counted = "{ float x = low.x; for (int tinta_round = 0; tinta_round < 1024; ++tinta_round) { if (!( x < high.x + 0.5)) \
                   break; {";
    assert!(text.contains(counted), "{text}");
    assert!(text.contains("} x += 1.0; } }"), "{text}");
    assert!(
        text.contains("for (int step = 1; step <= LARGEST; ++step) {"),
        "those that begin at a number stay: {text}"
    );
    let refused =
        transcribed(Stage::Fragment, "#version 120\nvoid main() { for (float x = a; x < b; x += 1.0) { continue; } }");
    assert!(refused.unwrap_err().contains("cannot be continued"));
}

#[test]
fn what_linked_shaders_share_is_declared_once() {
    let paths =
        ["evangelista/border-settings.frag", "evangelista/filter-sobel.frag", "evangelista/depth-as-filtered.frag"];
    let texts: Vec<&str> = paths
        .into_iter()
        .chain(["improved/texel-biased.frag", "evangelista/tap-next.frag"])
        .map(|path| source(path).unwrap())
        .collect();
    let one = linked(Stage::Fragment, &texts).unwrap();
    assert_eq!(one.matches("#version").count(), 1);
    assert_eq!(one.matches("vec4 tap(float x, float y);").count(), 1, "{one}");
    assert_eq!(one.matches("float depthResponse(float response);").count(), 1, "{one}");
    assert!(one.is_ascii(), "comments are left out");
    let differently = ["#version 120\nconst float A = 1.0;", "#version 120\nconst float A = 2.0;"];
    assert!(linked(Stage::Fragment, &differently).unwrap_err().contains("declare A differently"));
}

#[test]
fn each_item_of_linked_shaders_follows_its_line_and_ends_after_as_many_lines() {
    for (path, text) in SOURCES {
        let Ok(linked) = linked(Stage::of(path), &["#version 120\n", text]) else { panic!("{path}") };
        let originals: Vec<&str> = text.lines().collect();
        let (mut line, mut compared) = (None, 0);
        for written in linked.lines() {
            if let Some(rest) = written.strip_prefix("#line ") {
                line = rest
                    .split_once(' ')
                    .filter(|(_, part)| *part == "1")
                    .map(|(line, _)| line.parse::<usize>().unwrap());
                continue;
            }
            // The pipeline's own work is of no shader.
            if written.starts_with("void main() {") && Stage::of(path) == Stage::Vertex {
                line = None;
            }
            // A name that stands there unchanged stands in that line of the shader, except the step of a loop at its end.
            if let Some(number) = line {
                let words = if written.trim_start().starts_with('}') { "" } else { written };
                for word in tokens(words).iter().filter(|token| token.kind == Kind::Word) {
                    let is_old = text.contains(word.text) && !word.text.starts_with("tinta_");
                    if is_old && !["vec2", "for", "int", "if", "break", "texture2D"].contains(&word.text) {
                        assert!(
                            originals[number - 1].contains(word.text),
                            "{path}:{number}: {} in {written}",
                            word.text
                        );
                        compared += 1;
                    }
                }
                line = Some(number + 1);
            }
        }
        assert!(compared > 1, "{path}: {compared}");
    }
}
