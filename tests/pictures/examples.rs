//! The programs in examples/ run unchanged, and the guarantees for a user's style hold.

#[expect(dead_code, reason = "the program's own main is not run here")]
#[path = "../../examples/edges_only.rs"]
mod edges_only;
#[expect(dead_code, reason = "the program's own main is not run here")]
#[path = "../../examples/exact_lines.rs"]
mod exact_lines;
#[expect(dead_code, reason = "the program's own main is not run here")]
#[path = "../../examples/load_and_render.rs"]
mod load_and_render;
#[expect(dead_code, reason = "the program's own main is not run here")]
#[path = "../../examples/own_style.rs"]
mod own_style;

use crate::support::{BACKENDS, renderer, root, scene};
use std::collections::HashMap;
use tinta::edges::Class;
use tinta::plan::Pass;
use tinta::{Error, Picture, Renderer, Style, StyleName};

fn share_of(picture: &Picture, is_counted: impl Fn(&[u8]) -> bool) -> f64 {
    picture.pixels.chunks_exact(4).filter(|pixel| is_counted(pixel)).count() as f64 / picture.size.pixel_count() as f64
}

#[test]
fn the_examples_draw_what_they_say() {
    let folder = tempfile::tempdir().unwrap();
    let file = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let written = load_and_render::draw("builtin:open-box", folder.path()).unwrap();
    assert_eq!(written.len(), StyleName::of_passes().count() - 1, "every style but sand");
    for path in &written {
        let picture = Picture::read_png(path.as_ref()).unwrap();
        assert_eq!(picture.size.pixel_count(), 240 * 240);
        assert!(share_of(&picture, |pixel| pixel[..3] != [255; 3]) > 0.02, "{path} is empty");
    }
    // The open box has 4 boundary edges and 8 creases, by hand.
    let (mut counts, silhouettes) = edges_only::draw("builtin:open-box", &file("edges.png")).unwrap();
    assert_eq!([*counts.of(Class::Boundary), *counts.of(Class::Crease)], [4, 8]);
    assert!((1..=8).contains(&silhouettes), "{silhouettes}");
    let edges = Picture::read_png(file("edges.png").as_ref()).unwrap();
    let grey = |pixel: &[u8]| pixel[0] == pixel[1] && pixel[1] == pixel[2];
    assert_eq!(share_of(&edges, grey), 1.0, "black lines on white and nothing else");
    let (visible, hidden) = exact_lines::draw("builtin:open-box", &file("lines.svg")).unwrap();
    assert!(visible >= 9 && hidden >= 1, "{visible} visible, {hidden} hidden");
    let text = std::fs::read_to_string(file("lines.svg")).unwrap();
    assert!(text.contains("crease") && text.contains("stroke-dasharray"));
    own_style::draw("builtin:open-box", &file("own.png")).unwrap();
    let own = Picture::read_png(file("own.png").as_ref()).unwrap();
    assert!(share_of(&own, |pixel| pixel[..3] != [255; 3]) > 0.02);
}

/// The halftone's shaders under their names.
fn shaders() -> HashMap<String, String> {
    let text = |name: &str| std::fs::read_to_string(root().join("examples/own_style").join(name)).unwrap();
    HashMap::from(["halftone.vert", "halftone.frag"].map(|name| (format!("own/{name}"), text(name))))
}

#[test]
fn a_style_of_ones_own_needs_its_shaders_and_leaves_the_others_alone() {
    let scene = scene("builtin:ant", 96, 96);
    for backend in *BACKENDS {
        let mut renderer: Renderer = renderer(backend);
        let three_pass = Style::named(StyleName::ThreePass);
        let before = renderer.render(&scene, &three_pass).unwrap();
        let plan = own_style::halftone(&scene, 6.0);
        let Err(Error::Shader { path, log }) = renderer.draw(&scene, &plan) else {
            panic!("drawn without its shaders")
        };
        assert!(path.contains("own/halftone") && log.contains("not part of this program"), "{path}: {log}");
        renderer.replace_shaders(shaders()).unwrap();
        let halftone = renderer.draw(&scene, &plan).unwrap();
        let paper = share_of(&halftone, |pixel| pixel[..3] == [255; 3]);
        let empty = share_of(&before, |pixel| pixel[..3] == [255; 3]);
        assert!(paper > empty + 0.02 && paper < 0.99, "paper between dots: {paper}, around the ant: {empty}");
        assert_eq!(renderer.render(&scene, &three_pass).unwrap(), before, "a built-in style beside it");

        let mut broken = shaders();
        broken.insert(
            "own/halftone.frag".to_owned(),
            "#version 120\nvoid main() { gl_FragColor = vec3(1.0); }".to_owned(),
        );
        let Err(Error::Shader { path, .. }) = renderer.replace_shaders(broken) else { panic!("a mistake was taken") };
        assert_eq!(path, "own/halftone.frag");
        assert_eq!(renderer.draw(&scene, &plan).unwrap(), halftone, "the shaders before it go on");
        // Two styles in one plan: the pass that comes last is seen.
        let mut both = three_pass.plan(&scene, tinta::Show::Final).unwrap();
        let Pass { steps, .. } = plan.passes[0].clone();
        both.passes.push(Pass::new("halftone", steps));
        assert_eq!(renderer.draw(&scene, &both).unwrap(), halftone);
    }
}
