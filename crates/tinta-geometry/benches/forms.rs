//! Measures the time of form lines: `cargo bench -p tinta-geometry --bench forms -- MODEL`. It prints milliseconds,
//! the least and the median of 26 views around the model at 512 x 512. Curvature, which all views share, is separate.

use std::sync::Arc;
use std::time::Instant;
use tinta_geometry::curvature::Curvatures;
use tinta_geometry::edges::{Class, ClassSet, CreaseAngle};
use tinta_geometry::glam::DVec3;
use tinta_geometry::{CameraSettings, EdgeList, LineSettings, LoadOptions, Scene, SceneSettings, VisibleLines, load};

const VIEWS: u32 = 26;

fn main() -> tinta_geometry::Result<()> {
    let model = std::env::args().skip(1).find(|argument| !argument.starts_with("--"));
    let model = model.unwrap_or_else(|| "../../models/bust.obj".to_owned());
    let mesh = Arc::new(load(&model, &LoadOptions::default())?.mesh);
    println!("{model}: {} triangles", mesh.triangles.len());
    let edges = EdgeList::new(&mesh);
    for smoothing in [0.0, 1.0] {
        let times = (0..9).map(|_| timed(|| Curvatures::new(&mesh, &edges, CreaseAngle::default(), smoothing)));
        said(&format!("curvature, smoothing {smoothing}"), times.collect());
    }
    let scene = Scene::new([mesh], &SceneSettings::default())?;
    let edges = [Class::Boundary, Class::NonManifold, Class::Silhouette, Class::Crease, Class::Intersection];
    let sets: [(&str, &[Class]); 4] = [
        ("edges", &[]),
        ("and suggestive contours", &[Class::Suggestive]),
        ("and ridges and valleys", &[Class::Ridge, Class::Valley]),
        ("all", &[Class::Suggestive, Class::Ridge, Class::Valley, Class::Material]),
    ];
    for (name, more) in sets {
        let classes = ClassSet::of(&edges).or(ClassSet::of(more));
        let settings = LineSettings { classes, finds_hidden: false, ..LineSettings::default() };
        let mut times = Vec::new();
        for view in 0..VIEWS {
            let turn = f64::from(view) * 2.4;
            let height = 1.0 - 2.0 * (f64::from(view) + 0.5) / f64::from(VIEWS);
            let across = (1.0 - height * height).sqrt();
            let direction = DVec3::new(across * turn.cos(), height, across * turn.sin());
            let eye = Some(scene.centre + direction * scene.radius * 3.0);
            let camera = CameraSettings { eye, ..CameraSettings::default() };
            let scene = scene.seen_with(&SceneSettings { camera, ..SceneSettings::default() })?;
            // The first view computes the data that later views reuse.
            if view == 0 {
                VisibleLines::of(&scene, &settings)?;
            }
            times.push(timed(|| VisibleLines::of(&scene, &settings)));
        }
        said(name, times);
    }
    Ok(())
}

fn timed<T>(work: impl FnOnce() -> T) -> f64 {
    let clock = Instant::now();
    std::hint::black_box(work());
    clock.elapsed().as_secs_f64() * 1e3
}

fn said(what: &str, mut times: Vec<f64>) {
    times.sort_unstable_by(f64::total_cmp);
    println!("{what}: {:.1} least, {:.1} median", times[0], times[times.len() / 2]);
}
