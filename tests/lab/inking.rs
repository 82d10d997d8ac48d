//! Where the style inking puts its ink, by masks of it.

use crate::support::{BACKENDS, renderer, scene};
use tinta::lines::Length;
use tinta::plan::LineDrawing;
use tinta::styles::Inking;
use tinta::{Picture, Renderer, Scene, Show, Style};
use tinta_lab::compare::{Agreement, InkMask};

fn draw(renderer: &mut Renderer, scene: &Scene, style: Inking, show: Show) -> Picture {
    let plan = Style::Inking(style).plan(scene, show).unwrap();
    renderer.draw(scene, &plan).unwrap()
}

#[test]
fn quads_lie_where_gls_lines_do() {
    for backend in *BACKENDS {
        let mut renderer = renderer(backend);
        let scene = scene("builtin:gear", 240, 240);
        let ink = |renderer: &mut Renderer, line_drawing| {
            let style = Inking { line_drawing, is_smooth: false, line_width: Length::Px(3.0), ..Inking::default() };
            InkMask::of(&draw(renderer, &scene, style, Show::Borders))
        };
        let (gl, quads) = (ink(&mut renderer, LineDrawing::Gl), ink(&mut renderer, LineDrawing::Quads));
        let numbers = Agreement::of(&gl, &quads, 1).unwrap().numbers;
        assert!(numbers.left_shared > Some(0.99) && numbers.right_shared > Some(0.99), "{backend:?} {numbers:?}");
    }
}

#[test]
fn without_polygon_offset_the_faces_eat_their_own_lines() {
    // Errata D8.
    let mut renderer = renderer(BACKENDS[0]);
    let scene = scene("builtin:gear", 240, 240);
    let mut ink = |polygon_offset| {
        let style = Inking { polygon_offset, is_smooth: false, ..Inking::default() };
        InkMask::of(&draw(&mut renderer, &scene, style, Show::Borders)).count()
    };
    let (with, without) = (ink([1.0, 5.0]), ink([0.0, 0.0]));
    assert!(without < with * 85 / 100, "{without} of {with} pixels of ink are left");
}
