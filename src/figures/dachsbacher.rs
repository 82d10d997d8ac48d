//! The pictures of Dachsbacher's article. They have no numbers; its three pictures of the bust are the three options of one
//! program and stand here as one figure.

use super::{Content, Drawing, Figure, Panel, Shot, Text, panel};
use crate::edges::SilhouetteRule;
use crate::styles::{Inking, PaintMode, RampRow, Style};

pub(super) fn figures() -> Vec<Figure> {
    let bust = |file: &str, label, inking, options: &str| {
        panel(file, label, "builtin:bust", Shot::face(), Style::Inking(inking), options)
    };
    let ants = Inking { ramp_row: RampRow::Object, silhouette: SilhouetteRule::Exact, ..Inking::default() };
    let figure = |id, number, title, caption, panels| Figure {
        id,
        text: Text::Dachsbacher,
        number,
        title,
        caption,
        content: Content::Pictures(panels),
    };
    vec![
        figure(
            "dachsbacher-bust",
            "The bust",
            "Beethoven's bust in the program's three options",
            "Lines alone, painted faces alone, and both together. The article's bust is of Beethoven; ours was made for \
             this project as a homage to it.",
            vec![
                bust(
                    "dachsbacher-bust-ink",
                    "ink",
                    Inking { paint: PaintMode::None, ..Inking::default() },
                    "--style inking --paint none",
                ),
                bust(
                    "dachsbacher-bust-paint",
                    "paint",
                    Inking { is_inked: false, ..Inking::default() },
                    "--style inking --no-borders",
                ),
                bust("dachsbacher-bust-both", "both", Inking::default(), "--style inking"),
            ],
        ),
        figure(
            "dachsbacher-ramp",
            "The ramp",
            "The texture that shades",
            "Four gradients one below the other, three flat tones each; the light chooses the column, the surface the row.",
            vec![Panel { file: "dachsbacher-ramp.png".to_owned(), label: "ramp", drawing: Drawing::Ramp }],
        ),
        figure(
            "dachsbacher-ants",
            "The ants",
            "Ants painted by the ramp",
            "Each ant has a gradient of its own. The silhouettes are found exactly here, for by the article's single view \
             vector lines are missing at the picture's sides.",
            vec![
                panel(
                    "dachsbacher-ants",
                    "ants",
                    "builtin:ant",
                    Shot::view(30.0, 35.0, "--view 30,35"),
                    Style::Inking(ants),
                    "--style inking --ramp-row object --silhouette exact",
                )
                .times(4),
            ],
        ),
    ]
}
