//! The figures of Evangelista et al. 2005 that show a result of theirs: 1, 5, 6, 8, 9, 12, 13, 14. The others are other
//! authors' pictures (2, 3, 4), a diagram (7) and two filters' numbers (10, 11).

use super::{Content, Figure, Panel, Shot, Text, panel};
use crate::styles::{Border, Cartoon, ClassColors, Inking, PaintMode, Phong, Show, Style, Tones};

const BUST: &str = "builtin:bust";

/// Ours for the two monkeys: figures 8, 9 and 12 show one scene.
fn pair(file: &str, label: &'static str, style: Style, options: &str) -> Panel {
    panel(file, label, BUST, Shot::view(20.0, 10.0, "--view 20,10"), style, options).times(2)
}

fn tones(count: u8, border: Option<Border>) -> Cartoon {
    Cartoon { tones: Tones { count, ..Tones::default() }, border, ..Cartoon::default() }
}

pub(super) fn figures() -> Vec<Figure> {
    let face = Shot::face;
    let three_pass = || Style::ThreePass(Cartoon::default());
    let phong = || Style::Phong(Phong::default());
    let shaded = |file, label, count: u8, options: &str| {
        panel(file, label, BUST, face(), Style::ThreePass(tones(count, None)), options)
    };
    let two_pass = |count| Style::TwoPass(tones(count, Some(Border::default())));
    let box_lines =
        Style::Inking(Inking { paint: PaintMode::None, colors: ClassColors::figure_6(), ..Inking::default() });
    let figure =
        |id, number, title, caption, content| Figure { id, text: Text::Evangelista, number, title, caption, content };
    vec![
        figure(
            "evangelista-1",
            "Figure 1",
            "What three passes draw",
            "The paper opens with a cartoon drawn by its three passes. Ours is of the built-in bust, with the listing's \
             three tones and borders.",
            Content::Pictures(vec![panel("evangelista-1", "three passes", BUST, face(), three_pass(), "")]),
        ),
        figure(
            "evangelista-5",
            "Figure 5",
            "Phong's shading beside one, two and three tones",
            "A horse from one viewpoint, first in smooth shading, then uniformly in one to three tones, no borders. The \
             first two tones are diffuse light, the third and lightest the highlight. Ours is the bust.",
            Content::Pictures(vec![
                panel("evangelista-5-a", "(a) Phong", BUST, face(), phong(), "--style phong"),
                shaded("evangelista-5-b", "(b) one tone", 1, "--tones 1 --no-borders"),
                shaded("evangelista-5-c", "(c) two tones", 2, "--tones 2 --no-borders"),
                shaded("evangelista-5-d", "(d) three tones", 3, "--no-borders"),
            ]),
        ),
        figure(
            "evangelista-6",
            "Figure 6",
            "Outer and inner borders of an open box",
            "Where the outline runs lines are red, at creases blue. The figure explains which lines are meant, so ours \
             takes them from the box's edges rather than from a map.",
            Content::Pictures(vec![panel(
                "evangelista-6",
                "outer red, inner blue",
                "builtin:open-box",
                Shot::view(30.0, 25.0, "--view 30,25"),
                box_lines,
                "--style inking --paint none --class-colors figure-6",
            )]),
        ),
        figure(
            "evangelista-8",
            "Figure 8",
            "The scene of the maps, in Phong's shading",
            "The paper's scene holds monkeys of 6,310 triangles each; ours holds two busts of 6,474. The same scene, \
             from the same place, is that of figures 9 and 12.",
            Content::Pictures(vec![pair("evangelista-8", "Phong", phong(), "--style phong")]),
        ),
        figure(
            "evangelista-9",
            "Figure 9",
            "Its normal and depth maps",
            "What the first pass leaves in the framebuffer: normals as red, green and blue, depth in alpha, shown as \
             grey, dark is near.",
            Content::Pictures(vec![
                pair("evangelista-9-normals", "normals", three_pass(), "").showing(Show::Normals, "normals"),
                pair("evangelista-9-depth", "depth", three_pass(), "").showing(Show::Depth, "depth"),
            ]),
        ),
        figure(
            "evangelista-12",
            "Figure 12",
            "Its borders alone",
            "The filter's answer to the maps of figure 9, black on white.",
            Content::Pictures(vec![
                pair("evangelista-12", "borders", three_pass(), "").showing(Show::Borders, "borders"),
            ]),
        ),
        figure(
            "evangelista-13",
            "Figure 13",
            "Frames per second over triangles",
            "Six scenes from 3,039 to 122,646 triangles, one, two and three tones, two and three passes. Of the paper's \
             curves its text prints the triangles of the first and the last scene and no frame rate, so that only ours \
             are drawn.",
            Content::Frames,
        ),
        figure(
            "evangelista-14",
            "Figure 14",
            "Finished drawings by two passes",
            "At the left one tone and borders, at the right three tones and borders.",
            Content::Pictures(vec![
                panel("evangelista-14-left", "one tone", BUST, face(), two_pass(1), "--style two-pass --tones 1"),
                panel("evangelista-14-right", "three tones", BUST, face(), two_pass(3), "--style two-pass"),
            ]),
        ),
        figure(
            "evangelista-numbers",
            "Section 5",
            "The numbers in its text",
            "The cheaper filter, two passes without the square behind the scene, and how many pixels each shader shades \
             in a second.",
            Content::OtherNumbers,
        ),
    ]
}
