//! The language, statement by statement: values, lines, and mistakes with their lines.

use tinta_glsl::{
    Comparison, Event, Mistake, Precision, Run, Sample, Settings, Stage, Texel, Textures, Trace, Type, Value, What,
};

fn run_in(text: &str, inputs: &[(&str, Value)], settings: &Settings<'_>) -> Result<Run, Mistake> {
    Stage::new(&[("a.frag", text)])?.run(inputs, &(), settings)
}

/// Runs statements that set gl_FragColor.
fn color_of(statements: &str) -> Vec<f64> {
    let run = run_in(&format!("void main() {{ {statements} }}"), &[], &Settings::default()).unwrap();
    run.output("gl_FragColor").unwrap().numbers().to_vec()
}

fn mistake_of(text: &str) -> String {
    run_in(text, &[], &Settings::default()).unwrap_err().to_string()
}

#[test]
fn values_follow_the_specification() {
    for (expression, expected) in [
        ("vec4(vec3(0.0f), 1)", [0.0, 0.0, 0.0, 1.0]),
        ("vec4(1.0, 2.0, 3.0, 4.0).wzyx", [4.0, 3.0, 2.0, 1.0]),
        ("vec4(7 / 2, 7.0 / 2.0, -7 / 2, 2 + 3 * 4)", [3.0, 3.5, -3.0, 14.0]),
        ("-vec4(1.0, 2.0, 3.0, 4.0) + 4 * vec4(1.0)", [3.0, 2.0, 1.0, 0.0]),
        (
            "vec4(mat2(1.0, 2.0, 3.0, 4.0) * vec2(1.0, 10.0), vec2(1.0, 10.0) * mat2(1.0, 2.0, 3.0, 4.0))",
            [31.0, 42.0, 21.0, 43.0],
        ),
        ("vec4(mat3(2.0)[1], mat2(1.0, 2.0, 3.0, 4.0)[1][0])", [0.0, 2.0, 0.0, 3.0]),
        ("vec4(reflect(vec3(1.0, -1.0, 0.0), vec3(0.0, 1.0, 0.0)), length(vec2(3.0, 4.0)))", [1.0, 1.0, 0.0, 5.0]),
        (
            "vec4(cross(vec3(1.0, 0.0, 0.0), vec3(0.0, 1.0, 0.0)), dot(vec2(1.0, 2.0), vec2(3.0, 4.0)))",
            [0.0, 0.0, 1.0, 11.0],
        ),
        ("vec4(clamp(vec2(-1.0, 0.5), 0.0, 1.0), mix(1.0, 3.0, 0.25), step(0.5, 0.5))", [0.0, 0.5, 1.5, 1.0]),
        ("vec4(gl_LightSource[0].position.zyx, gl_LightSource[7 - 6].diffuse.a)", [1.0, 0.0, 0.0, 1.0]),
        ("vec4(gl_FrontMaterial.diffuse.r, gl_LightModel.ambient.gba)", [0.8, 0.2, 0.2, 1.0]),
        ("vec4(mod(-1.0, 4.0), fract(-0.25), floor(-0.25), sign(-3.0))", [3.0, 0.75, -1.0, -1.0]),
        (
            "vec4(1.0 < 2.0 ? 1.0 : 0.0, float(true && !false), float(1 == 1 ^^ 2 == 2), float(any(lessThan(vec2(1.0, 5.0), vec2(2.0)))))",
            [1.0, 1.0, 0.0, 1.0],
        ),
    ] {
        assert_eq!(color_of(&format!("gl_FragColor = {expression};")), expected, "{expression}");
    }
}

#[test]
fn statements_run_in_order() {
    let loops = "float sum = 0.0; for (int i = 0; i < 5; ++i) { if (i == 1) continue; if (i == 4) break; sum += float(i); } int n = 0; do n++; while (n < 3); while (n > 0) n--; gl_FragColor = vec4(sum, n, 0.0, 0.0);";
    assert_eq!(color_of(loops), [5.0, 0.0, 0.0, 0.0]);
    let parts =
        "vec4 a = vec4(0.0); a.yx = vec2(1.0, 2.0); a[3] = 5.0; a.z += 7.0; { vec4 a = vec4(9.0); } gl_FragColor = a;";
    assert_eq!(color_of(parts), [2.0, 1.0, 7.0, 5.0]);
}

#[test]
fn functions_may_lie_in_other_shaders_and_write_what_they_are_given() {
    let main = "float twice(float x); void both(float x, out float low, inout float high);\nvoid main() { float l, h = 1.0; both(twice(3.0), l, h); gl_FragColor = vec4(l, h, twice(4), 0.0); }";
    let parts = "const float TWO = 2.0; float twice(float x) { return TWO * x; } void both(float x, out float low, inout float high) { low = x - 1.0; high += x; }";
    let other = "const float TWO = 5.0;";
    let stage = Stage::new(&[("main.frag", main), ("other.frag", other), ("parts.frag", parts)]).unwrap();
    let run = stage.run(&[], &(), &Settings::default()).unwrap();
    assert_eq!(run.output("gl_FragColor").unwrap().numbers(), [5.0, 7.0, 8.0, 0.0]);
}

#[test]
fn macros_stand_for_their_text_on_the_line_that_names_them() {
    let text = "#version 120\n#define at(trans) ((place.x+trans)*UNIT.x) // a comment\n#define UNIT unit /* and\nanother */\nvoid main() {\n    vec2 place = vec2(1.0), unit = vec2(0.5);\n    gl_FragColor = vec4(at(-1), at(0),\n                        at(1), 4*UNIT.y);\n}";
    let settings = Settings { trace: Trace::Everything, ..Settings::default() };
    let run = run_in(text, &[], &settings).unwrap();
    assert_eq!(run.output("gl_FragColor").unwrap().numbers(), [0.0, 0.5, 1.0, 2.0]);
    let lines: Vec<u32> = run.events.iter().map(|event| event.line).collect();
    assert_eq!(lines, [6, 6, 7]);
}

#[test]
fn the_trace_tells_what_each_statement_did() {
    struct One;
    impl Textures for One {
        fn read(&self, sampler: usize, at: [f64; 2]) -> Option<Sample> {
            let texels = vec![Texel { place: [0, 0], weight: 1.0, value: [at[0]; 4] }];
            (sampler == 3).then_some(Sample { value: [at[0]; 4], texels })
        }
    }
    let text = "uniform sampler2D map;\nfloat read(float x) { return texture2D(map, vec2(x, 0.0)).r; }\nvoid main() {\n    float a = read(0.25);\n    if (a > 0.5) gl_FragColor = vec4(1.0);\n    else discard;\n}";
    let stage = Stage::new(&[("a.frag", text)]).unwrap();
    let map = Value::new(Type::named("sampler2D").unwrap(), &[3.0]);
    let run = stage.run(&[("map", map)], &One, &Settings { trace: Trace::Everything, ..Settings::default() }).unwrap();
    assert!(run.is_discarded);
    let seen: Vec<&What> = run.events.iter().map(|Event { what, .. }| what).collect();
    let quarter = Value::floats(&[0.25]);
    assert!(matches!(seen[0], What::Read { texture, sample, .. } if texture == "map" && sample.value[0] == 0.25));
    assert_eq!(seen[1], &What::Returned { function: "read".to_owned(), value: quarter });
    assert_eq!(seen[2], &What::Set { variable: "a".to_owned(), value: quarter });
    let compared = Some(Comparison { left: 0.25, operator: ">", right: 0.5 });
    assert_eq!(seen[3..], [&What::Branched { is_taken: false, compared }, &What::Discarded]);
}

#[test]
fn a_condition_of_several_comparisons_names_none_of_them() {
    let text = "void main() { float a = 1.0; if (a > 0.5 && a < 2.0) a = 3.0; if (!(a < 2.0)) a = 4.0; }";
    let run = run_in(text, &[], &Settings { trace: Trace::Everything, ..Settings::default() }).unwrap();
    let branches = run.events.iter().filter(|event| matches!(event.what, What::Branched { .. }));
    let compared = branches.map(|event| matches!(event.what, What::Branched { compared: Some(_), .. }));
    assert_eq!(compared.collect::<Vec<_>>(), [false, false]);
}

#[test]
fn single_precision_is_that_of_f32() {
    let inputs = [("x", Value::floats(&[f64::from(0.1_f32)])), ("y", Value::floats(&[f64::from(0.7_f32)]))];
    let text = "uniform float x; uniform float y; void main() { gl_FragColor = vec4(x * y + x, sqrt(x) / y, x - y, dot(vec2(x, y), vec2(y, y))); }";
    let settings = Settings { precision: Precision::Single, ..Settings::default() };
    let run = run_in(text, &inputs, &settings).unwrap();
    let (x, y) = (0.1_f32, 0.7_f32);
    let expected = [x * y + x, x.sqrt() / y, x - y, x * y + y * y].map(f64::from);
    assert_eq!(run.output("gl_FragColor").unwrap().numbers(), expected);
    let exact = run_in(text, &inputs, &Settings::default()).unwrap();
    assert_ne!(exact.output("gl_FragColor").unwrap().numbers(), expected);
}

#[test]
fn derivatives_are_the_changes_given() {
    let text = "varying float x; void main() { gl_FragColor = vec4(dFdx(x), dFdy(x * 2.0), fwidth(x), 0.0); }";
    let stage = Stage::new(&[("a.frag", text)]).unwrap();
    assert!(stage.asks_neighbours());
    let at = |x: f64| stage.run(&[("x", Value::floats(&[x]))], &(), &Settings::default()).unwrap().asked;
    let (here, right, up) = (at(1.0), at(1.5), at(3.0));
    let minus = |a: &Value, b: &Value| Value::floats(&[a.first() - b.first()]);
    let changes: Vec<[Value; 2]> = (0..3).map(|n| [minus(&right[n], &here[n]), minus(&up[n], &here[n])]).collect();
    let settings = Settings { changes: &changes, ..Settings::default() };
    let run = stage.run(&[("x", Value::floats(&[1.0]))], &(), &settings).unwrap();
    assert_eq!(run.output("gl_FragColor").unwrap().numbers(), [0.5, 4.0, 2.5, 0.0]);
}

#[test]
fn mistakes_name_the_line() {
    for (text, expected) in [
        ("void main() {\n\n    x = 1.0;\n}", "a.frag, line 3: there is no variable x"),
        ("void main() {\n    float x = vec2(1.0);\n}", "a.frag, line 2: float cannot hold vec2"),
        (
            "void main() {\n    vec2 x = vec2(1.0) + vec3(1.0);\n}",
            "a.frag, line 2: + cannot be used with vec2 and vec3",
        ),
        ("void main() {\n    float x = sine(1.0);\n}", "a.frag, line 2: there is no function sine for these arguments"),
        ("void main() {\n    vec2 x = vec2(1.0);\n    x.z = 1.0;\n}", "a.frag, line 3: vec2 has no such component"),
        ("void main() {\n    if (1.0) discard;\n}", "a.frag, line 2: a condition is a bool, not float"),
        (
            "void main() {\n    while (true) {}\n}",
            "a.frag, line 2: it still runs after 200000 statements; end its loop",
        ),
        ("float f() { return f(); }\nvoid main() {\n    f();\n}", "a.frag, line 1: f calls itself"),
        ("void main() {\n    float x = 1.0\n}", "a.frag, line 3: ; is expected, not }"),
        ("void main() {\n    discard;", "a.frag, line 2: the shader ends within a function"),
        ("void helper() {}", "a.frag, line 1: no shader has a main function"),
        ("#define A A\nvoid main() { A; }", "a.frag, line 2: a macro stands for itself"),
        (
            "#ifdef A\n#endif\nvoid main() {}",
            "a.frag, line 1: #ifdef is not understood; only #version, #extension, #define and #undef are",
        ),
        ("void main() {\n    float x[2];\n}", "a.frag, line 2: arrays of a shader's own are not understood"),
    ] {
        assert_eq!(mistake_of(text), expected, "{text}");
    }
}

#[test]
fn nothing_that_is_read_makes_it_panic() {
    let whole = "uniform sampler2D m; float f(in float x) { return x > 0.5 ? x : -x; }\nvoid main() { vec4 a = vec4(f(0.2), 1, 2, 3); for (int i = 0; i < 3; ++i) a.xy[1] += 1.0; gl_FragColor = a; }";
    for end in 0..whole.len() {
        let _ = run_in(&whole[..end], &[], &Settings::default());
        let without = format!("{}{}", &whole[..end], whole.get(end + 1..).unwrap_or_default());
        let _ = run_in(&without, &[], &Settings::default());
    }
    let _ = run_in(&format!("void main() {{ float x = {}1.0; }}", "(".repeat(100_000)), &[], &Settings::default());
}
