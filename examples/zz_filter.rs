//! Scan.
use std::sync::Arc;
use tinta::scene::Rectangle;
use tinta::*;
fn main() {
    let size: u32 = std::env::args().nth(1).unwrap().parse().unwrap();
    let mesh = load("builtin:gear", &LoadOptions::default()).unwrap().mesh;
    let scene = Scene::new(
        vec![Arc::new(mesh)],
        &SceneSettings { size: Size { width: size, height: size }, ..SceneSettings::default() },
    )
    .unwrap();
    let mut style = Style::named(StyleName::Charcoal);
    if let Style::Charcoal(c) = &mut style {
        if let Some(t) = std::env::args().nth(2) {
            let t = t.parse().unwrap();
            c.texture_size = Size { width: t, height: t };
        }
    }
    let plan = style.plan(&scene, Show::Final).unwrap();
    let mut renderer = Renderer::new(Backend::Auto).unwrap();
    let whole = Rectangle { x: 0, y: 0, width: size, height: size };
    let values = renderer.step_values(&scene, &plan, whole).unwrap();
    let square = &values[1].colors[0];
    let picture = &plan.pictures.iter().find(|p| p.name.contains("paper")).unwrap().picture;
    println!("paper {:?} picture names {:?}", picture.size, plan.pictures.iter().map(|p| p.name).collect::<Vec<_>>());
    let w = picture.size.width as i64;
    let texel = |x: i64, y: i64, c: usize| -> i64 {
        let (x, y) = (x.rem_euclid(w), y.rem_euclid(w));
        i64::from(picture.pixels[(((w - 1 - y) * w + x) * 4) as usize + c])
    };
    let lerp = |v0: i64, v1: i64, f: i64, round: i64| -> i64 {
        match round {
            0 => v0 + ((f * (v1 - v0)) >> 8),
            1 => v0 + ((f * (v1 - v0) + 128) >> 8),
            2 => {
                let f = f + (f >> 7);
                v0 + ((f * (v1 - v0)) >> 8)
            }
            3 => {
                let f = f + (f >> 7);
                v0 + ((f * (v1 - v0) + 128) >> 8)
            }
            _ => v0 + (f * (v1 - v0)) / 256,
        }
    };
    for coords in 0..4 {
        for round in 0..5 {
            for order in 0..2 {
                let mut hist = [0usize; 4];
                let mut shown = 0;
                for py in 0..size {
                    for px in 0..size {
                        let split = |p: u32| -> (i64, i64) {
                            let s = (p as f32 + 0.5) / size as f32;
                            match coords {
                                0 => {
                                    let f = (s * (w as f32 * 256.0)).floor() as i64 - 128;
                                    (f >> 8, f & 255)
                                }
                                1 => {
                                    let f = ((s * w as f32 - 0.5) * 256.0).floor() as i64;
                                    (f >> 8, f & 255)
                                }
                                2 => {
                                    let f = ((s * w as f32) * 256.0).round() as i64 - 128;
                                    (f >> 8, f & 255)
                                }
                                _ => {
                                    let f = ((s * w as f32 - 0.5) * 256.0).round() as i64;
                                    (f >> 8, f & 255)
                                }
                            }
                        };
                        let ((x, fx), (y, fy)) = (split(px), split(py));
                        for c in 0..3 {
                            let q = |i: i64, j: i64| texel(x + i, y + j, c);
                            let v = if order == 0 {
                                lerp(lerp(q(0, 0), q(1, 0), fx, round), lerp(q(0, 1), q(1, 1), fx, round), fy, round)
                            } else {
                                lerp(lerp(q(0, 0), q(0, 1), fy, round), lerp(q(1, 0), q(1, 1), fy, round), fx, round)
                            };
                            let d = (square[(py * size + px) as usize][c] * 255.0).round() as i64;
                            hist[(v - d).unsigned_abs().min(3) as usize] += 1;
                            if (v - d).abs() > 0 && coords == 0 && round == 1 && order == 0 && shown < 6 {
                                shown += 1;
                                println!(
                                    "  px {px},{py} c{c} v {v} d {d} x {x} fx {fx} y {y} fy {fy} q {:?}",
                                    [q(0, 0), q(1, 0), q(0, 1), q(1, 1)]
                                );
                            }
                        }
                    }
                }
                println!("coords {coords} round {round} order {order}: {hist:?}");
            }
        }
    }
}
