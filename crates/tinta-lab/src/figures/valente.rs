//! The figures of Valente 2007 that show a result of his: 2 to 4 and 6 to 12. Figures 1 and 5 are other authors' pictures.
//!
//! The originals' pictures were not at hand: captions repeat the report's own text about them.

use super::figure::{Content, Drawing, Figure, Panel, Shot, Text, panel};
use tinta::scene::Size;
use tinta::styles::{CetCoordinate, Charcoal, CharcoalRecipe, Improvements, Show, Style};
use tinta::textures::ContrastTexture;

const BUST: &str = "builtin:bust";

pub(super) fn figures(size: Size) -> Vec<Figure> {
    // Textures are stretched over the picture: made in its size they have one grain a pixel, as in a picture of 512.
    let base = Charcoal { texture_size: size, ..Charcoal::default() };
    let options = |style: &str, more: &str| {
        let stretched = if size == Charcoal::default().texture_size { String::new() } else { size.to_string() };
        let texture = if stretched.is_empty() { stretched } else { format!(" --grain texture-size={stretched}") };
        format!("--style {style}{texture}{more}")
    };
    let drawn = |file: &str, label, model, shot, charcoal: Charcoal, more: &str| {
        panel(file, label, model, shot, Style::Charcoal(charcoal), &options("charcoal", more))
    };
    let face =
        |file: &str, label, charcoal: Charcoal, more: &str| drawn(file, label, BUST, Shot::face(), charcoal, more);
    let saturated = || Charcoal { saturation: 1.2, ..base.clone() };
    let contrast = |contrast_exponent| Charcoal { contrast_exponent, ..base.clone() };
    let recipe = |recipe| Charcoal { texture_size: size, ..Charcoal::recipe(recipe) };
    let figure = |id, number, title, caption, panels| Figure {
        id,
        text: Text::Valente,
        number,
        title,
        caption,
        content: Content::Pictures(panels),
    };
    let sand = |file: &str, label, charcoal: Charcoal, more: &str| {
        panel(file, label, "", Shot::whole(), Style::Sand(charcoal), &options("sand", more)).textured()
    };
    let luminance = || {
        let improve = Improvements { luminance: true, ..Improvements::default() };
        Charcoal { improve, ..base.clone() }
    };
    let everything = || Charcoal { improve: Improvements::EVERYTHING, ..recipe(CharcoalRecipe::Closure) };
    let [light, medium, dense] = ContrastTexture::figure_3(size, 0);
    let grains =
        |file: &str, label, texture| Panel { file: format!("{file}.png"), label, drawing: Drawing::Grains(texture) };
    let quarter = || Shot::view(35.0, 20.0, "--view 35,20");
    vec![
        figure(
            "valente-2",
            "Figure 2",
            "Scattered grains of density 60",
            "Black pixels at random places on white, before the contrast operator moves them. The report does not say what 60 \
             counts; here it is percent.",
            vec![grains("valente-2", "density 60", ContrastTexture::figure_2(size, 0))],
        ),
        figure(
            "valente-3",
            "Figure 3",
            "Three contrast-enhanced textures",
            "The same density moved along t to t^m and blurred. A larger m gathers the grains in the darkest rows, at the \
             bottom. Each grain starts at a random place within its pixel, which is ours: the report's picture, which was not at \
             hand, may have stripes.",
            vec![
                grains("valente-3-left", "m = 1.3", light),
                grains("valente-3-middle", "m = 5.5", medium),
                grains("valente-3-right", "m = 15", dense),
            ],
        ),
        figure(
            "valente-4",
            "Figure 4",
            "Diffuse light and the contrast-enhanced model",
            "The light of two lamps on a white surface, and the same raised to the contrast exponent: here 3, to make it visible. \
             The report shows the picture of the work it follows; ours is the bust.",
            vec![
                face("valente-4-left", "diffuse light", base.clone(), "").showing(Show::Diffuse, "diffuse"),
                face("valente-4-right", "contrast enhanced, m = 3", contrast(3.0), " --contrast 3")
                    .showing(Show::Cem, "cem"),
            ],
        ),
        figure(
            "valente-6",
            "Figure 6",
            "A drawing without smudging",
            "Grain by tone on paper, as the listing draws it. Exponent, lights and paper are ours: the report gives none, and its \
             picture was not at hand.",
            vec![face("valente-6", "without", base.clone(), "")],
        ),
        figure(
            "valente-7",
            "Figure 7",
            "The same drawing smudged",
            "Multiplied by the enhanced light once more, which darkens everything except the lights.",
            vec![face("valente-7", "smudged", Charcoal { smudge: true, ..base.clone() }, " --smudge on")],
        ),
        figure(
            "valente-8",
            "Figure 8",
            "The saturated light as the grain's coordinate",
            "Saturation lifts the light above 1, and the texture, which repeats, begins anew with its darkest rows: dark \
             patches stand where the light is strongest. Beside it the published coordinate with the same saturation.",
            vec![
                face(
                    "valente-8",
                    "saturated coordinate",
                    Charcoal { cet_coordinate: CetCoordinate::Saturated, ..saturated() },
                    " --saturation 1.2 --grain cet-coordinate=saturated",
                ),
                face("valente-8-published", "published coordinate", saturated(), " --saturation 1.2"),
            ],
        ),
        figure(
            "valente-9",
            "Figure 9",
            "Sand",
            "A Quake 2 character whose own texture, turned to sepia, is mixed with the charcoal drawing. Ours is a toy soldier in \
             the same format, or the model that --model names; beside it the same with the weights probably intended, which show \
             its texture. The report's picture was not at hand.",
            vec![
                sand("valente-9", "sand", base.clone(), ""),
                sand("valente-9-luminance", "luminance mended", luminance(), " --improve luminance"),
            ],
        ),
        figure(
            "valente-10",
            "Figure 10",
            "More results",
            "Other models in the published settings; ours are the ant and the gear.",
            vec![
                drawn("valente-10-ant", "ant", "builtin:ant", quarter(), base.clone(), ""),
                drawn("valente-10-gear", "gear", "builtin:gear", quarter(), base.clone(), ""),
            ],
        ),
        figure(
            "valente-11",
            "Figure 11",
            "A detail of one of the models",
            "Seen closer, the grain keeps its size because it lies on the picture, not on the model.",
            vec![drawn("valente-11", "detail", BUST, close(), base.clone(), "")],
        ),
        figure(
            "valente-12",
            "Figure 12",
            "Other results",
            "The report ends with further drawings, which were not at hand. Ours are the two ways its conclusions name, \
             stronger strokes and faint outlines left to the viewer; the second with everything improved, beyond the report; \
             and figure 9's model.",
            vec![
                face("valente-12-darker", "darker", recipe(CharcoalRecipe::Darker), " --charcoal darker"),
                face("valente-12-closure", "closure", recipe(CharcoalRecipe::Closure), " --charcoal closure"),
                face(
                    "valente-12-everything",
                    "closure, everything improved",
                    everything(),
                    " --charcoal closure --improve everything",
                ),
                drawn("valente-12-model", "figure 9's model", "", Shot::whole(), base.clone(), "").textured(),
            ],
        ),
    ]
}

/// The bust's eyes and nose.
fn close() -> Shot {
    Shot::eye([1.6, 4.7, 4.2], [0.1, 4.1, 0.4], 30.0, "--eye 1.6,4.7,4.2 --target 0.1,4.1,0.4 --fov 30")
}
