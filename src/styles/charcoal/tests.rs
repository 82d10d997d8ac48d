use super::*;
use crate::scene::SceneSettings;
use std::sync::Arc;

fn scene() -> Scene {
    Scene::new(vec![Arc::new(Mesh::triangle())], &SceneSettings::default()).unwrap()
}

/// Small textures for speed, as other tests cover their contents; the published ones if full sizes are requested.
fn small() -> Size {
    match std::env::var_os("TINTA_FULL_SIZES") {
        Some(_) => Charcoal::default().texture_size,
        None => Size { width: 16, height: 16 },
    }
}

fn fragments(charcoal: &Charcoal, show: Show) -> Vec<String> {
    let plan = charcoal.charcoal(&scene(), show).unwrap();
    let last = plan.steps().filter_map(|(_, step)| if let Step::Draw(draw) = step { Some(draw) } else { None }).last();
    last.unwrap().program.as_ref().unwrap().fragments.iter().map(ToString::to_string).collect()
}

#[test]
fn with_any_setting_that_is_a_uniform_the_listing_runs() {
    for recipe in CharcoalRecipe::ALL {
        let charcoal =
            Charcoal { cet_filter: CetFilter::Mipmap, seed: 3, texture_size: small(), ..Charcoal::recipe(recipe.1) };
        assert_eq!(fragments(&charcoal, Show::Final), ["valente/charcoal.frag"], "{}", recipe.0);
    }
}

#[test]
fn each_improvement_exchanges_one_part() {
    let parts = |improve| {
        let operator = ContrastOperator::Bias;
        fragments(&Charcoal { improve, operator, texture_size: small(), ..Charcoal::default() }, Show::Final)
    };
    let faithful = parts(Improvements::default());
    for name in ["clamp", "wrap", "paper-coordinate", "proportion", "tooth", "two-sided", "strokes"] {
        let improved = parts(name.parse().unwrap());
        let different = faithful.iter().zip(&improved).filter(|(a, b)| a != b).count();
        assert_eq!((different, improved.len()), (1, faithful.len()), "{name}");
    }
    assert_eq!("all".parse(), Ok(Improvements::ALL));
    assert_eq!("clamp,wrap,paper-coordinate,luminance".parse(), Ok(Improvements::ALL));
    assert!("clamp,rap".parse::<Improvements>().is_err());
}

#[test]
fn textures_are_made_once_for_all_plans_of_the_same_settings() {
    let charcoal = Charcoal { texture_size: Size { width: 16, height: 16 }, ..Charcoal::default() };
    let pictures = |charcoal: &Charcoal| charcoal.charcoal(&scene(), Show::Final).unwrap().pictures;
    let (first, again) = (pictures(&charcoal), pictures(&charcoal.clone()));
    assert!(first.iter().zip(&again).all(|(a, b)| Arc::ptr_eq(&a.picture, &b.picture)));
    let other = pictures(&Charcoal { density_percent: 10.0, ..charcoal.clone() });
    assert_ne!(first[CET].picture, other[CET].picture, "a changed setting is not overlooked");
}

#[test]
fn the_paper_is_drawn_first_and_over_the_whole_picture() {
    let charcoal = Charcoal { texture_size: small(), ..Charcoal::default() };
    let text = charcoal.charcoal(&scene(), Show::Final).unwrap().to_string();
    let expected = "\
pass 1: charcoal
  clear to (1, 1, 1, 1), depth to 1
  draw the screen square with valente/paper.vert + valente/paper.frag, paperTexture = Picture(2), no depth test
  draw the objects in (1, 1, 1, 1) with valente/charcoal.vert + valente/charcoal.frag, ";
    assert!(text.starts_with(expected), "{text}");
}

#[test]
fn nonsense_is_refused_by_the_options_name() {
    let refused = |charcoal: Charcoal| charcoal.charcoal(&scene(), Show::Final).unwrap_err().to_string();
    let base = Charcoal::default;
    for contrast_exponent in [0.0, -1.0, f32::NAN, f32::INFINITY] {
        assert!(refused(Charcoal { contrast_exponent, ..base() }).starts_with("contrast"));
    }
    for saturation in [-0.1, f32::NAN, f32::INFINITY] {
        assert!(refused(Charcoal { saturation, ..base() }).starts_with("saturation"));
    }
    for light in [[0.0; 3], [f32::NAN, 0.0, 1.0], [f32::INFINITY, 0.0, 0.0]] {
        let front = Some([0.0, 0.0, 1.0]);
        assert!(refused(Charcoal { lights: [Some(light), front], ..base() }).starts_with("light-1"));
        assert!(refused(Charcoal { lights: [front, Some(light)], ..base() }).starts_with("light-2"));
        assert!(refused(Charcoal { lights: [Some(light), None], ..base() }).starts_with("light-1"));
    }
    assert!(refused(Charcoal { lights: [None, None], ..base() }).starts_with("light-2: the picture needs a light"));
    assert!(refused(Charcoal { density_percent: 101.0, ..base() }).starts_with("density"));
    assert!(refused(Charcoal { cet_exponent: 0.5, ..base() }).starts_with("cet-exponent"));
    let texture_size = Size { width: 5000, height: 1 };
    assert!(refused(Charcoal { texture_size, ..base() }).starts_with("texture-size"));
    for show in [Show::Normals, Show::Depth, Show::Map, Show::Borders, Show::Tones] {
        assert!(base().charcoal(&scene(), show).unwrap_err().to_string().starts_with("show"));
    }
    assert!(base().sand(&scene(), Show::Final).unwrap_err().to_string().starts_with("style sand"));
}
