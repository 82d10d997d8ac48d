//! Edge benchmarks.
use std::time::Instant;
use tinta::edges::*;
use tinta::{LoadOptions, load};
fn main() {
    for path in std::env::args().skip(1).filter(|a| !a.starts_with("--")) {
        let mesh = load(&path, &LoadOptions::default()).unwrap().mesh;
        let n = mesh.triangles.len() as f64;
        let med = |mut v: Vec<f64>| {
            v.sort_by(f64::total_cmp);
            v[v.len() / 2]
        };
        let wanted = ClassSet::of(&[Class::Boundary, Class::Crease, Class::NonManifold]);
        for t in [1, 2] {
            let mut a = vec![];
            let mut b = vec![];
            for _ in 0..15 {
                let s = Instant::now();
                let e = EdgeList::with_threads(&mesh, t);
                a.push(s.elapsed().as_secs_f64() * 1e3);
                let s = Instant::now();
                let c = Classes::with_threads(&mesh, &e, CreaseAngle::default(), wanted, t);
                b.push(s.elapsed().as_secs_f64() * 1e3);
                std::hint::black_box(c);
            }
            let (a, b) = (med(a), med(b));
            println!("{path} threads {t}: build {a:.2} classify {b:.2}  {:.1} Mtri/s", n / (a + b) / 1e3);
        }
        let e = EdgeList::new(&mesh);
        println!("edges {} reversed {} degenerate {}", e.len(), e.reversed_edges(), e.degenerate_faces());
        let c = Classes::new(&mesh, &e, CreaseAngle::default(), ClassSet::ALL);
        println!("{:?}", c.counts());
        let s = Instant::now();
        let sil = Silhouettes::new(&mesh, &e);
        println!("planes {:.2}", s.elapsed().as_secs_f64() * 1e3);
        let s = Instant::now();
        let cones = NormalCones::new(&mesh, &e, &sil);
        println!("cones {:.2}", s.elapsed().as_secs_f64() * 1e3);
        let (lo, hi) = mesh.bounds();
        let ctr = (lo + hi) * 0.5;
        let r = (hi - lo).length();
        let eye = |i: usize| {
            let t = 0.1 * i as f64;
            Eye::Point(ctr + glam::DVec3::new(1.5 * t.sin(), 0.3, 1.5 * t.cos()) * r)
        };
        for rule in [SilhouetteRule::Exact, SilhouetteRule::Paper] {
            for (name, f) in [("plain1", 0), ("plain2", 1), ("cones", 2)] {
                let mut a = vec![];
                let mut k = 0;
                for i in 0..(if f == 2 { 400 } else { 41 }) {
                    let s = Instant::now();
                    let f = match f {
                        0 => sil.find_with_threads(&mesh, &e, eye(i), rule, 1),
                        1 => sil.find_with_threads(&mesh, &e, eye(i), rule, 2),
                        _ => cones.find(&mesh, &e, &sil, eye(i), rule),
                    };
                    a.push(s.elapsed().as_secs_f64() * 1e3);
                    k = f.len();
                }
                println!("{rule:?} {name} {:.3} ms, {k} edges", med(a));
            }
        }
        for i in 0..40 {
            for rule in [SilhouetteRule::Exact, SilhouetteRule::Paper] {
                assert_eq!(sil.find(&mesh, &e, eye(i), rule), cones.find(&mesh, &e, &sil, eye(i), rule));
            }
        }
    }
}
