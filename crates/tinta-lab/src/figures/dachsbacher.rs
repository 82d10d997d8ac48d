//! The pictures of Dachsbacher's article. They have no numbers, and only their captions are known here: the captions below
//! separate the article's statements from our pictures.
//!
//! All are drawn by the article's own rules, its normals among them (`--normals dachsbacher`).

use super::figure::{Content, Drawing, Figure, Panel, Shot, Text, panel};
use tinta::mesh::Normals;
use tinta::styles::{Inking, PaintMode, RampRow, Style};

pub(super) fn figures() -> Vec<Figure> {
    vec![result(), edges(), options(), shading(), ramp(), ants()]
}

fn figure(
    id: &'static str,
    number: &'static str,
    title: &'static str,
    caption: &'static str,
    panels: Vec<Panel>,
) -> Figure {
    Figure { id, text: Text::Dachsbacher, number, title, caption, content: Content::Pictures(panels) }
}

/// The bust's head, read and drawn by the article's rules.
fn bust(file: &str, label: &'static str, inking: Inking, options: &str) -> Panel {
    panel(file, label, "builtin:bust", Shot::face(), Style::Inking(inking), options).by_the_articles_normals()
}

impl Panel {
    fn by_the_articles_normals(mut self) -> Self {
        if let Drawing::Scene(scene) = &mut self.drawing {
            scene.normals = Normals::Dachsbacher;
            scene.options.push_str(" --normals dachsbacher");
        }
        self
    }
}

fn ink_alone() -> Inking {
    Inking { paint: PaintMode::None, ..Inking::default() }
}

fn paint_alone(paint: PaintMode) -> Inking {
    Inking { paint, is_inked: false, ..Inking::default() }
}

fn result() -> Figure {
    figure(
        "dachsbacher-result",
        "First picture of the bust",
        "What the program makes",
        "The article: “The cartoon rendering technique presents the Beethoven bust.” Its pictures were not at hand, only \
         their captions. The bust here was made for this project as a homage to the article's.",
        vec![bust("dachsbacher-result", "ink and paint", Inking::default(), "--style inking")],
    )
}

fn edges() -> Figure {
    figure(
        "dachsbacher-edges",
        "Second picture of the bust",
        "Edges alone",
        "The article: “Beethoven has to make do with the edges of inking.” Faces in the background's colour hide the lines behind \
         them.",
        vec![bust("dachsbacher-edges", "ink", ink_alone(), "--style inking --paint none")],
    )
}

fn options() -> Figure {
    figure(
        "dachsbacher-options",
        "Third picture of the bust",
        "The program's three options",
        "The article: “Beethoven with the three rendering options of our sample program.” It does not say which three. Lines \
         alone, faces alone and both are what its two sections make, and our guess.",
        vec![
            bust("dachsbacher-options-ink", "ink", ink_alone(), "--style inking --paint none"),
            bust("dachsbacher-options-paint", "paint", paint_alone(PaintMode::Ramp), "--style inking --no-borders"),
            bust("dachsbacher-options-both", "both", Inking::default(), "--style inking"),
        ],
    )
}

fn shading() -> Figure {
    let painted = |file: &str, label, paint: PaintMode, option: &str| {
        bust(file, label, paint_alone(paint), &format!("--style inking --no-borders{option}"))
    };
    figure(
        "dachsbacher-shading",
        "Section Painting",
        "Why a texture: flat shading, Gouraud shading, the ramp",
        "No picture of the article, but its argument: with flat shading “the borders of the triangles themselves become visible”, \
         and Gouraud shading gives gradients “although you wanted to reduce the number of colours”. Light and tones are the \
         same in all three: looked up once a face, once a vertex, and at every pixel.",
        vec![
            painted("dachsbacher-shading-flat", "flat", PaintMode::FlatShaded, " --paint flat-shaded"),
            painted("dachsbacher-shading-gouraud", "Gouraud", PaintMode::Gouraud, " --paint gouraud"),
            painted("dachsbacher-shading-ramp", "ramp", PaintMode::Ramp, ""),
        ],
    )
}

fn ramp() -> Figure {
    figure(
        "dachsbacher-ramp",
        "The ramp",
        "The texture that shades",
        "The article: “You define the shading of the surfaces with a simple texture.” Four gradients one below the other, three \
         flat tones each; the light chooses the column, the surface the row. The colours are ours.",
        vec![Panel { file: "dachsbacher-ramp.png".to_owned(), label: "ramp", drawing: Drawing::Ramp }],
    )
}

fn ants() -> Figure {
    let ants = Inking { ramp_row: RampRow::Object, ..Inking::default() };
    let style = Style::Inking(ants);
    let shot = Shot::view(30.0, 35.0, "--view 30,35");
    figure(
        "dachsbacher-ants",
        "The ants",
        "Ants painted by the ramp",
        "The article: “You render the faces of the ants with the shading from the picture on page 213”, the ramp above. Here each \
         ant has its own gradient. Silhouettes are found by the listing's rule, one view vector for all edges; from here the \
         exact rule draws nearly the same.",
        vec![
            panel("dachsbacher-ants", "ants", "builtin:ant", shot, style, "--style inking --ramp-row object")
                .times(4)
                .by_the_articles_normals(),
        ],
    )
}
