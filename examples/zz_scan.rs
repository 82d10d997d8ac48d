//! Scan.
use std::sync::Arc;
use tinta::pixel::*;
use tinta::scene::Rectangle;
use tinta::*;
fn main() {
    let args: Vec<String> = std::env::args().collect();
    let size = args.get(3).map_or(160, |a| a.parse().unwrap());
    let mesh = load(&args[1], &LoadOptions::default()).unwrap().mesh;
    let mut settings = SceneSettings { size: Size { width: size, height: size }, ..SceneSettings::default() };
    if std::env::var_os("PARALLEL").is_some() {
        settings.camera.parallel = true;
    }
    let scene = Scene::new(vec![Arc::new(mesh)], &settings).unwrap();
    let mut options = std::collections::BTreeMap::new();
    options.insert("style".to_owned(), tinta::settings::OptionValue::text(args[2].as_str()));
    for pair in args[4..].chunks(2) {
        if pair[0] != "at" {
            options.insert(pair[0].clone(), tinta::settings::OptionValue::text(pair[1].as_str()));
        }
    }
    let mut style = Style::from_options(&options.into_iter().collect()).unwrap();
    if let Style::Charcoal(c) | Style::Sand(c) = &mut style {
        if std::env::var_os("OWN").is_none() {
            c.texture_size = Size { width: size, height: size };
        }
    }
    let plan = style.plan(&scene, Show::Final).unwrap();
    let backend = std::env::var("BACKEND").ok().map_or(Backend::Auto, |b| b.parse().unwrap());
    let mut renderer = Renderer::new(backend).unwrap();
    let whole = Rectangle { x: 0, y: 0, width: size, height: size };
    let values = renderer.step_values(&scene, &plan, whole).unwrap();
    println!("{} bits {}", renderer.context().renderer, renderer.context().subpixel_bits);

    for precision in [Precision::Single] {
        for filtering in [Filtering::Exact, Filtering::Bytes] {
            let t = std::time::Instant::now();
            let how = Recomputation { precision, filtering, subpixel_bits: renderer.context().subpixel_bits as u32 };
            let ex = Explainer::new(&scene, &plan, &values, how).unwrap();
            let mut table: Vec<(String, [usize; 6], f64, f64)> = Vec::new();
            let mut worst: Vec<(f64, [u32; 2], String)> = Vec::new();
            for y in 0..size {
                for x in 0..size {
                    let steps = ex.pixel([x, y], false).unwrap();
                    if table.is_empty() {
                        table = steps.iter().map(|s| (format!("{} {}", s.pass, s.step), [0; 6], 0.0, 0.0)).collect();
                    }
                    for (s, row) in steps.iter().zip(&mut table) {
                        let d = s.difference.unwrap_or(-1.0);
                        let k = if d < 0.0 {
                            5
                        } else if d < 0.02 {
                            0
                        } else if d < 1.02 {
                            1
                        } else if d < 2.02 {
                            2
                        } else if d < 8.02 {
                            3
                        } else {
                            4
                        };
                        row.1[k] += 1;
                        row.2 = f64::max(row.2, d);
                        row.3 += d.max(0.0);
                        if d > 1.02 {
                            worst.push((
                                d,
                                [x, y],
                                format!(
                                    "{} {} covers {} computed {:?} drawn {:?}",
                                    s.pass,
                                    s.step,
                                    s.fragments.len(),
                                    s.computed.as_ref().unwrap()[0].map(|v| v * 255.0),
                                    s.drawn[0].map(|v| v * 255.0)
                                ),
                            ));
                        }
                    }
                }
            }
            println!("{precision:?} {filtering:?} {:.2}s", t.elapsed().as_secs_f64());
            for (name, c, max, sum) in &table {
                println!(
                    "  {name:28} 0:{:6} 1:{:6} 2:{:5} <=8:{:5} more:{:5} none:{:6} max {max:.3} mean {:.4}",
                    c[0],
                    c[1],
                    c[2],
                    c[3],
                    c[4],
                    c[5],
                    sum / f64::from(size * size)
                );
            }
            worst.sort_by(|a, b| b.0.total_cmp(&a.0));
            for (d, at, what) in worst.iter().take(6) {
                println!("    {d:.1} at {at:?} {what}");
            }
        }
    }
    if let Some(i) = args.iter().position(|a| a == "at") {
        let at: Vec<u32> = args[i + 1].split(',').map(|n| n.parse().unwrap()).collect();
        let how = Recomputation {
            precision: Precision::Single,
            filtering: Filtering::Bytes,
            subpixel_bits: renderer.context().subpixel_bits as u32,
        };
        let ex = Explainer::new(&scene, &plan, &values, how).unwrap();
        println!("{}", serde_json::to_string_pretty(&ex.pixel([at[0], at[1]], true).unwrap()).unwrap());
    }
}
