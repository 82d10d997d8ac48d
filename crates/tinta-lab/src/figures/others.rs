//! The figures that are not drawn, with the reason: the parts missing in the lists of drawn figures.

use super::figure::{Content, Figure, Text};

/// Figures of other authors in Valente's report, each with the figure that follows it.
fn not_drawn() -> Vec<(&'static str, Figure)> {
    let figure = |id, number, title, caption, reason| Figure {
        id,
        text: Text::Valente,
        number,
        title,
        caption,
        content: Content::NotDrawn(reason),
    };
    vec![
        (
            "valente-2",
            figure(
                "valente-1",
                "Figure 1",
                "Charcoal drawings",
                "Drawings by hand, among them a dog whose paws and muzzle are left to the viewer: the effect called closure.",
                "they are pictures that Majumder and Gopi print, drawn by hand; figures 6 to 12 show the technique applied to models, \
                 and the recipe closure of figure 12 applied to outlines",
            ),
        ),
        (
            "valente-6",
            figure(
                "valente-5",
                "Figure 5",
                "Results of the work it follows",
                "Renderings by Majumder and Gopi.",
                "they are other authors' results, of models and settings that the report does not name; figure 6 shows this \
                 report's own",
            ),
        ),
    ]
}

/// All figures of one text, from those of its list.
pub(super) fn complete(text: Text, mut figures: Vec<Figure>) -> Vec<Figure> {
    for (before, figure) in not_drawn().into_iter().filter(|(_, figure)| figure.text == text) {
        let place = figures.iter().position(|other| other.id == before).unwrap_or(figures.len());
        figures.insert(place, figure);
    }
    figures
}
