//! The figures of Evangelista et al. 2005: all fourteen, and the numbers of section 5. Figures 2 and 3 are other authors'
//! pictures and not drawn; figure 4 is one too, but the paper names its two tones.

use super::figure::{Content, Figure, Panel, Shot, Text, panel};
use tinta::styles::{Border, Cartoon, ClassColors, Filter, Inking, PaintMode, Phong, Show, Style, Tones};

const BUST: &str = "builtin:bust";

/// Ours for the two monkeys: figures 8, 9 and 12 show one scene.
fn pair(file: &str, label: &'static str, style: Style, options: &str) -> Panel {
    panel(file, label, BUST, Shot::view(20.0, 10.0, "--view 20,10"), style, options).times(2)
}

/// A filter's borders of that scene, with the maps of figure 9.
fn filtered(file: &str, label: &'static str, filter: Filter, options: &str) -> Panel {
    let border = Some(Border { filter, ..Border::default() });
    pair(file, label, Style::ThreePass(Cartoon { border, ..Cartoon::default() }), options)
        .showing(Show::Borders, "borders")
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
            "evangelista-2",
            "Figure 2",
            "A cartoon by Decaudin",
            "“Rendez-vous”: borders and uniform shading in two tones.",
            Content::NotDrawn(
                "it is Decaudin's picture of his own scene, made by his own program; figure 5 (c) has two tones, and with borders \
                 tinta render builtin:bust -o cartoon.png --style three-pass --tones 2 draws them",
            ),
        ),
        figure(
            "evangelista-3",
            "Figure 3",
            "Hatching, strokes, halftoning",
            "At the left hatching and strokes like wax crayon, at the right halftoning like old print.",
            Content::NotDrawn(
                "they are other authors' pictures of techniques that the paper names as further work and gives no rule for; the \
                 example program own_style.rs draws a halftone",
            ),
        ),
        figure(
            "evangelista-4",
            "Figure 4",
            "Two tones, ambient and specular, no borders",
            "The paper shows a scene of the game The Legend of Zelda: The Wind Waker: uniform shading without borders, one tone for \
             ambient light and one for the highlight. Ours are these two tones on the bust: the diffuse step is put out of reach.",
            Content::Pictures(vec![panel(
                "evangelista-4",
                "two tones",
                BUST,
                face(),
                Style::ThreePass(Cartoon {
                    tones: Tones { diffuse_threshold: 2.0, ..Tones::default() },
                    border: None,
                    ..Cartoon::default()
                }),
                "--no-borders --tones tone-thresholds=2,0.65",
            )]),
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
            "Where the outline runs lines are red, at creases blue. The figure explains which lines to find, so ours \
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
            "evangelista-7",
            "Figure 7",
            "The sequence of passes",
            "The paper draws a diagram: at the left two passes, at the right three. Ours are the plans that this program carries out, \
             step by step; the second and third pass at the right are the second at the left.",
            Content::Passes,
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
            "The first pass's framebuffer: normals as red, green and blue, depth in alpha, shown as \
             grey, dark is near.",
            Content::Pictures(vec![
                pair("evangelista-9-normals", "normals", three_pass(), "").showing(Show::Normals, "normals"),
                pair("evangelista-9-depth", "depth", three_pass(), "").showing(Show::Depth, "depth"),
            ]),
        ),
        figure(
            "evangelista-10",
            "Figure 10",
            "Two filters of others",
            "At the left the Laplacian that Nienhaus uses, at the right the pixels that Mitchell's filter reads. The paper prints both \
             matrices; below each are the edges it finds in the maps of figure 9.",
            Content::Pictures(vec![
                filtered(
                    "evangelista-10-laplacian8",
                    "the Laplacian, nine reads",
                    Filter::Laplacian8,
                    "--filter laplacian8",
                ),
                filtered("evangelista-10-mitchell", "Mitchell's, five reads", Filter::Mitchell, "--filter mitchell"),
            ]),
        ),
        figure(
            "evangelista-11",
            "Figure 11",
            "The filter of the paper, and those it names",
            "The simplified Laplacian, whose matrix the paper prints, on the same maps. Beside it the three filters that section 4.1 \
             names besides the Laplacian, and Mitchell's in two programs, as he had to write it; their matrices are not printed, and \
             the Gaussian's is our reading.",
            Content::Pictures(vec![
                filtered("evangelista-11", "the paper's, five reads", Filter::Laplacian4, ""),
                filtered("evangelista-11-sobel", "Sobel, eight reads", Filter::Sobel, "--filter sobel"),
                filtered("evangelista-11-roberts", "Roberts, four reads", Filter::Roberts, "--filter roberts"),
                filtered("evangelista-11-gaussian", "Gaussian, nine reads", Filter::Gaussian, "--filter gaussian"),
                filtered(
                    "evangelista-11-mitchell-two",
                    "Mitchell's in two programs, ten reads",
                    Filter::MitchellTwo,
                    "--filter mitchell-two",
                ),
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
             curves its text prints the triangles of the first and the last scene and no frame rate; only ours are \
             drawn.",
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
