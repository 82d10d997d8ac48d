//! Shaders in OpenGL ES's language of WebGL 1: GLSL 1.20 rewritten word by word as GLSL ES 1.00.
//!
//! In: the text of a shader in `glsl/`. Out: the same program for a browser, in pieces that show the changes. The
//! fixed-function pipeline's variables in 1.20 (matrices, the vertex's attributes, its colours) become uniforms, attributes and
//! varyings with the names in `UNIFORMS` and `ATTRIBUTES`.
//!
//! Rewriting words suffices: only the whole numbers that are floats need a type, and their statement shows it. The existing GLSL
//! parsers lose comments, which the page shows beside the program.
//!
//! ```
//! use tinta::glsl::es::{Stage, linked, transcribed};
//!
//! let filter = tinta::glsl::source("evangelista/border.frag").expect("a shader of the article");
//! let pieces = transcribed(Stage::Fragment, filter)?;
//! let original: String = pieces.iter().map(|piece| piece.original.as_str()).collect();
//! assert_eq!(original, filter);
//! assert!(pieces.iter().any(|piece| piece.original == "0.2f" && piece.text == "0.2"));
//! // Several shaders linked together become one.
//! assert!(linked(Stage::Fragment, &[filter])?.starts_with("#version 100\n"));
//! # Ok::<(), String>(())
//! ```

use std::collections::HashSet;
use tinta_glsl::tokens::{Kind, Token, is_whole, tokens};

/// The stage of a shader in its program.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stage {
    /// The vertex shader.
    Vertex,
    /// A fragment shader.
    Fragment,
}

impl Stage {
    /// Returns the stage of the shader with this path.
    pub fn of(path: &str) -> Self {
        if path.ends_with(".vert") { Self::Vertex } else { Self::Fragment }
    }
}

/// A piece of a shader.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Piece {
    /// The original text in the shader.
    pub original: String,
    /// The rewritten text; equal to the original if no change was needed.
    pub text: String,
}

impl Piece {
    /// Whether the piece was changed.
    pub fn is_changed(&self) -> bool {
        self.original != self.text
    }
}

/// A name of the fixed-function pipeline: in 1.20, its type, and the name here.
type Name = (&'static str, &'static str, &'static str);

/// Inputs that the fixed-function pipeline gives shaders for a whole draw.
pub(crate) const UNIFORMS: [Name; 4] = [
    ("gl_ModelViewMatrix", "mat4", "tinta_ModelViewMatrix"),
    ("gl_ProjectionMatrix", "mat4", "tinta_ProjectionMatrix"),
    ("gl_ModelViewProjectionMatrix", "mat4", "tinta_ModelViewProjectionMatrix"),
    ("gl_NormalMatrix", "mat3", "tinta_NormalMatrix"),
];

/// Inputs that it gives vertex shaders for each vertex, in the order of their locations.
pub(crate) const ATTRIBUTES: [Name; 5] = [
    ("gl_Vertex", "vec4", "tinta_Vertex"),
    ("gl_Normal", "vec3", "tinta_Normal"),
    ("gl_Color", "vec4", "tinta_Color"),
    ("gl_MultiTexCoord0", "vec4", "tinta_MultiTexCoord0"),
    ("gl_MultiTexCoord1", "vec4", "tinta_MultiTexCoord1"),
];

/// Colours passed from vertices to fragments: the name written, the name read, the name here. They are clamped on the way.
const COLORS: [Name; 2] = [
    ("gl_FrontColor", "gl_Color", "tinta_FrontColor"),
    ("gl_FrontSecondaryColor", "gl_SecondaryColor", "tinta_FrontSecondaryColor"),
];

/// The colour of back faces, unused because lighting is one-sided.
const BACK_COLOR: (&str, &str) = ("gl_BackColor", "tinta_BackColor");

/// Texture coordinates passed to fragments.
const COORDINATES: (&str, &str) = ("gl_TexCoord", "tinta_TexCoord[2]");

/// The new name of a vertex shader's `main`: another function calls it and then does the pipeline's work.
const MAIN: &str = "tinta_main";

/// Most rounds of a loop of unknown length: far more than any loop here runs.
const LONGEST_LOOP: u32 = 1024;

/// Rewrites one shader and returns its pieces.
///
/// # Errors
///
/// A sentence that names the part this language cannot express.
pub fn transcribed(stage: Stage, text: &str) -> Result<Vec<Piece>, String> {
    let tokens = tokens(text);
    let mut texts = rewritten(stage, &tokens)?;
    let head = head(stage, &words(&tokens));
    let version = tokens.iter().position(|token| token.text == "#").ok_or("a shader begins with its #version")?;
    let end = tokens[version..].iter().position(|token| token.text == "\n").map_or(tokens.len(), |end| version + end);
    texts[version] = head.trim_end().to_owned();
    texts[version + 1..end].iter_mut().for_each(String::clear);
    if stage == Stage::Vertex
        && let Some(last) = texts.last_mut()
    {
        last.push_str(&vertex_main(&words(&tokens)));
    }
    let mut pieces: Vec<Piece> = Vec::new();
    for (place, (token, text)) in tokens.iter().zip(texts).enumerate() {
        let is_changed = token.text != text;
        match pieces.last_mut() {
            Some(last) if (!is_changed && !last.is_changed()) || (version + 1..end).contains(&place) => {
                last.original.push_str(token.text);
                last.text.push_str(&text);
            }
            _ => pieces.push(Piece { original: token.text.to_owned(), text }),
        }
    }
    Ok(pieces)
}

/// Merges several shaders of a stage into one text without comments; shared declarations appear once. Before each item `#line`
/// tells its line and the place of its shader in `texts`, so that a compiler's log names them.
///
/// # Errors
///
/// As [`transcribed`], and for two different declarations of one name.
pub fn linked(stage: Stage, texts: &[&str]) -> Result<String, String> {
    let all: Vec<Vec<Token<'_>>> = texts.iter().map(|text| tokens(text)).collect();
    let words: HashSet<&str> = all.iter().flat_map(|tokens| words(tokens)).collect();
    let mut out = head(stage, &words);
    let (mut known, mut constants) = (HashSet::new(), HashSet::new());
    for (number, tokens) in all.iter().enumerate() {
        for (line, item) in items(tokens, &rewritten(stage, tokens)?) {
            if item.is_empty() || item.starts_with("#version") || !known.insert(item.clone()) {
                continue;
            }
            let constant = item.strip_prefix("const ").and_then(|item| item.split_whitespace().nth(1));
            if let Some(name) = constant
                && !constants.insert(name.to_owned())
            {
                return Err(format!("two shaders that are linked together declare {name} differently"));
            }
            out.push_str(&format!("#line {line} {number}\n{item}\n"));
        }
    }
    if stage == Stage::Vertex {
        out.push_str(&vertex_main(&words));
    }
    Ok(out)
}

/// The names in a shader.
fn words<'a>(tokens: &[Token<'a>]) -> HashSet<&'a str> {
    tokens.iter().filter(|token| token.kind == Kind::Word).map(|token| token.text).collect()
}

/// Returns the shader's first lines: version, extensions, precision, and declarations that the pipeline made.
fn head(stage: Stage, words: &HashSet<&str>) -> String {
    let has = |name: &str| words.contains(name);
    let mut head = "#version 100\n".to_owned();
    if stage == Stage::Fragment && ["dFdx", "dFdy", "fwidth"].into_iter().any(has) {
        head.push_str("#extension GL_OES_standard_derivatives : require\n");
    }
    if has("gl_FragData") {
        head.push_str("#extension GL_EXT_draw_buffers : require\n");
    }
    head.push_str("precision highp float;\nprecision highp int;\nprecision highp sampler2D;\n");
    for (old, kind, new) in UNIFORMS {
        if has(old) || (old == "gl_ModelViewProjectionMatrix" && has("ftransform")) {
            head.push_str(&format!("uniform {kind} {new};\n"));
        }
    }
    if stage == Stage::Vertex {
        for (old, kind, new) in ATTRIBUTES {
            if has(old) || (old == "gl_Vertex" && has("ftransform")) {
                head.push_str(&format!("attribute {kind} {new};\n"));
            }
        }
    }
    for (written, read, new) in COLORS {
        if has(if stage == Stage::Vertex { written } else { read }) {
            head.push_str(&format!("varying vec4 {new};\n"));
        }
    }
    if has(BACK_COLOR.0) {
        head.push_str(&format!("vec4 {};\n", BACK_COLOR.1));
    }
    if has(COORDINATES.0) {
        head.push_str(&format!("varying vec4 {};\n", COORDINATES.1));
    }
    // This language has no noise; where 1.20 had it, it was 0 (Valente 2007, section 3.1).
    let noises = [("noise1", "float", "float"), ("noise2", "vec2", "vec2"), ("noise3", "vec3", "vec3")];
    for (name, result, argument) in noises.into_iter().chain([("noise4", "float", "vec4")]) {
        if has(name) {
            head.push_str(&format!("{result} {name}({argument} place) {{ return {result}(0.0); }}\n"));
        }
    }
    head
}

/// Returns the pipeline's work after a vertex shader: it clamps colours and makes points a pixel wide.
fn vertex_main(words: &HashSet<&str>) -> String {
    let mut main = format!("\nvoid main() {{\n    {MAIN}();\n    gl_PointSize = 1.0;\n");
    for (written, _, new) in COLORS {
        if words.contains(written) {
            main.push_str(&format!("    {new} = clamp({new}, 0.0, 1.0);\n"));
        }
    }
    main + "}\n"
}

/// Returns each token's new text, by its place.
fn rewritten(stage: Stage, tokens: &[Token<'_>]) -> Result<Vec<String>, String> {
    let mut texts: Vec<String> = tokens.iter().map(|token| token.text.to_owned()).collect();
    // The places of tokens that are not white space or comments.
    let places: Vec<usize> = (0..tokens.len()).filter(|place| tokens[*place].kind != Kind::Between).collect();
    for (number, place) in places.iter().enumerate() {
        let text = tokens[*place].text;
        match tokens[*place].kind {
            Kind::Number => texts[*place] = text.strip_suffix(['f', 'F']).unwrap_or(text).to_owned(),
            Kind::Word if text == "ftransform" => {
                texts[*place] = format!("({} * {})", UNIFORMS[2].2, ATTRIBUTES[0].2);
                places[number + 1..].iter().take(2).for_each(|bracket| texts[*bracket].clear());
            }
            // Here a uniform has no value of its own; one that has is not set by any style.
            Kind::Word if text == "uniform" => {
                let declaration = places[number..].iter().map(|place| tokens[*place].text);
                if declaration.take_while(|text| *text != ";").any(|text| text == "=") {
                    texts[*place] = "const".to_owned();
                }
            }
            Kind::Word if text == "texture1D" => sample_table(tokens, &places[number..], &mut texts)?,
            Kind::Word => {
                if let Some(new) = renamed(stage, text) {
                    texts[*place] = new.to_owned();
                }
            }
            Kind::Sign | Kind::Between => {}
        }
    }
    for place in floats(tokens, &places) {
        texts[place].push_str(".0");
    }
    // Last, because the text after each round of a loop moves with all its changes.
    for number in (0..places.len()).filter(|number| tokens[places[*number]].text == "for") {
        bound_loop(tokens, &places[number..], &mut texts)?;
    }
    Ok(texts)
}

/// Returns the new name of a name in 1.20, if it differs.
fn renamed(stage: Stage, name: &str) -> Option<&'static str> {
    let find = |names: &[Name]| names.iter().find(|(old, ..)| *old == name).map(|(.., new)| *new);
    let color = COLORS.iter().find(|(written, read, _)| match stage {
        Stage::Vertex => *written == name,
        Stage::Fragment => *read == name,
    });
    let attribute = if stage == Stage::Vertex { find(&ATTRIBUTES) } else { None };
    match name {
        "main" if stage == Stage::Vertex => Some(MAIN),
        "sampler1D" => Some("sampler2D"),
        name if name == BACK_COLOR.0 => Some(BACK_COLOR.1),
        name if name == COORDINATES.0 => Some("tinta_TexCoord"),
        _ => find(&UNIFORMS).or(attribute).or(color.map(|(.., new)| *new)),
    }
}

/// Replaces a one-dimensional texture by the middle of one that is a texel high. `places` begins with the call.
fn sample_table(tokens: &[Token<'_>], places: &[usize], texts: &mut [String]) -> Result<(), String> {
    let close = closing(tokens, places, 1).ok_or("a call of texture1D does not end")?;
    let comma = (2..close).find(|place| {
        let is_top = depth(tokens, &places[1..*place]) == 1;
        tokens[places[*place]].text == "," && is_top
    });
    let comma = comma.ok_or("a call of texture1D has no place in the texture")?;
    texts[places[0]] = "texture2D".to_owned();
    texts[places[comma]] = ", vec2(".to_owned();
    texts[places[close]] = ", 0.5))".to_owned();
    Ok(())
}

/// Bounds a loop, which must run here from one number to another. Other loops run up to [`LONGEST_LOOP`] times and end by their
/// own condition. `places` begins with the word `for`.
fn bound_loop(tokens: &[Token<'_>], places: &[usize], texts: &mut [String]) -> Result<(), String> {
    let text = |place: usize| tokens[places[place]].text;
    let close = closing(tokens, places, 1).ok_or("a loop's head does not end")?;
    let ends: Vec<usize> = (2..close).filter(|place| text(*place) == ";").collect();
    let [first, second] = ends[..] else { return Err("a loop's head has three parts".to_owned()) };
    let value = (2..first).find(|place| text(*place) == "=").ok_or("a loop sets a number first")? + 1;
    if value + 1 == first && tokens[places[value]].kind == Kind::Number {
        return Ok(());
    }
    let body = close + 1;
    let end = closing(tokens, places, body).filter(|_| text(body) == "{").ok_or("a loop's body is a block")?;
    if (body..end).any(|place| text(place) == "continue") {
        return Err("a loop that does not begin at a number cannot be continued".to_owned());
    }
    let step = texts[places[second] + 1..places[close]].concat();
    texts[places[0]] = "{".to_owned();
    texts[places[1]] = String::new();
    let counted = format!("for (int tinta_round = 0; tinta_round < {LONGEST_LOOP}; ++tinta_round)");
    texts[places[first]] = format!("; {counted} {{ if (!(");
    texts[places[second]] = ")) break;".to_owned();
    texts[places[second] + 1..=places[close]].iter_mut().for_each(String::clear);
    texts[places[end]] = format!("}} {}; }} }}", step.trim());
    Ok(())
}

/// Returns the whole numbers that are floats: 1.20 converts them where it needs floats, this language does not. Numbers in square
/// brackets stay whole, and so do those that share a stretch between two separators with a word of type int.
fn floats(tokens: &[Token<'_>], places: &[usize]) -> Vec<usize> {
    let text = |place: &usize| tokens[*place].text;
    let whole: HashSet<&str> =
        places.windows(2).filter(|pair| text(&pair[0]) == "int").map(|pair| text(&pair[1])).chain(["int"]).collect();
    let (mut floats, mut segment, mut has_whole, mut brackets) = (Vec::new(), Vec::new(), false, 0);
    for (number, place) in places.iter().enumerate() {
        let next_line = number > 0 && tokens[places[number - 1]].is_directive && !tokens[*place].is_directive;
        let is_separator = ["(", ")", "{", "}", ";", ","].contains(&text(place));
        if is_separator || next_line {
            if !std::mem::take(&mut has_whole) {
                floats.append(&mut segment);
            }
            segment.clear();
        }
        match text(place) {
            "[" => brackets += 1,
            "]" => brackets -= 1,
            word => has_whole |= whole.contains(word) || (tokens[*place].is_directive && word == "version"),
        }
        if brackets == 0 && tokens[*place].kind == Kind::Number && is_whole(text(place)) {
            segment.push(*place);
        }
    }
    if !has_whole {
        floats.append(&mut segment);
    }
    floats
}

/// Returns how many brackets are open after these.
fn depth(tokens: &[Token<'_>], places: &[usize]) -> i32 {
    let step = |place: &usize| match tokens[*place].text {
        "(" | "{" | "[" => 1,
        ")" | "}" | "]" => -1,
        _ => 0,
    };
    places.iter().map(step).sum()
}

/// Returns the place of the bracket that closes the one at `open`.
fn closing(tokens: &[Token<'_>], places: &[usize], open: usize) -> Option<usize> {
    (open + 1..places.len()).find(|place| depth(tokens, &places[open..=*place]) == 0)
}

/// Returns a shader's top-level items: directives, declarations, functions. Each is its first line, counted from 1, and its text
/// without comments, as many lines long as in the shader.
fn items(tokens: &[Token<'_>], texts: &[String]) -> Vec<(usize, String)> {
    let (mut items, mut item, mut depth) = (Vec::new(), String::new(), 0);
    let mut was_directive = false;
    let (mut line, mut first) = (1, 1);
    let mut close = |first: usize, item: &mut String| items.push((first, std::mem::take(item).trim().to_owned()));
    for (token, text) in tokens.iter().zip(texts) {
        if was_directive && !token.is_directive {
            close(first, &mut item);
        }
        was_directive = token.is_directive;
        let line_ends = token.text.matches('\n').count();
        if token.kind != Kind::Between && item.trim().is_empty() {
            first = line;
        }
        line += line_ends;
        let is_comment = token.kind == Kind::Between && token.text.starts_with('/');
        item.push_str(&if is_comment { format!(" {}", "\n".repeat(line_ends)) } else { text.clone() });
        match token.text {
            "{" | "(" => depth += 1,
            "}" | ")" => depth -= 1,
            _ => {}
        }
        let ends = matches!(token.text, ";" | "}") && depth == 0 && !token.is_directive;
        if ends {
            close(first, &mut item);
        }
    }
    close(first, &mut item);
    items
}

#[cfg(test)]
mod tests;
