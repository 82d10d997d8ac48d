//! The ratio that decides about the search for hidden faces (`SEARCHED` and `DRAWN` in `hidden_faces.rs`): how many faces one thread
//! looks at while the driver draws one. By processor time, which the load of other programs hardly changes.

use serde_json::{Value, json};
use std::sync::Arc;
use tinta::hidden_faces::faces_not_hidden;
use tinta::plan::prune::{Rule, prune};
use tinta::plan::{Depth, Faces, Geometry, Plan, Step};
use tinta::renderer::{median, processor_milliseconds};
use tinta::{Renderer, Scene, Show, Style, StyleName};

/// Lets the draws of objects that test and write depth draw these faces alone; returns how many do.
pub fn only(plan: &mut Plan, faces: &Arc<Vec<Faces>>) -> usize {
    let steps = plan.passes.iter_mut().flat_map(|pass| &mut pass.steps);
    let draws = steps.filter_map(|step| if let Step::Draw(draw) = step { Some(draw) } else { None });
    let draws = draws.filter(|draw| matches!(draw.geometry, Geometry::Objects(_)) && draw.depth == Depth::TestAndWrite);
    draws.map(|draw| draw.faces = Some(faces.clone())).count()
}

/// The median processor time of some work, nanoseconds.
fn nanoseconds(rounds: usize, mut work: impl FnMut()) -> f64 {
    let now = || processor_milliseconds().expect("the system tells processor time");
    let times = (0..rounds).map(|_| {
        let start = now();
        work();
        (now() - start) * 1e6
    });
    median(times.collect()).expect("a round")
}

/// Prints for each scene the nanoseconds of looking at a face, those of drawing one that is left out, and their ratio.
pub fn ratios(renderer: &mut Renderer, scenes: &[(String, Scene)], rounds: usize) -> Value {
    println!("\nprocessor time of a face: looked at by one thread, drawn by three-pass, and the ratio");
    let row = |(name, scene): &(String, Scene)| {
        let mut pruning = renderer.pruning();
        let bits = pruning.subpixel_bits;
        let search = || faces_not_hidden(scene, scene.size, bits, [0.0; 2], 1);
        let lists: Vec<Faces> =
            search().0.into_iter().map(|list| list.map_or(Faces::All, |list| Faces::Listed(Arc::new(list)))).collect();
        let left_out: usize =
            lists.iter().map(|faces| if let Faces::Listed(list) = faces { list.left_out } else { 0 }).sum();
        pruning.keep.push(Rule::HiddenFaces);
        let plan = Style::named(StyleName::ThreePass).plan(scene, Show::Final).expect("a plan");
        let all = prune(&plan, scene, &pruning).plan;
        let mut seen = all.clone();
        let draws = only(&mut seen, &Arc::new(lists));
        let searched_ns = nanoseconds(rounds, || drop(search())) / scene.triangle_count() as f64;
        let [all_ns, seen_ns] = [&all, &seen]
            .map(|plan| nanoseconds(rounds, || drop(renderer.time_frames(scene, plan, 0, 1).expect("a frame"))));
        let drawn_ns = (all_ns - seen_ns) / (left_out * draws).max(1) as f64;
        let ratio = drawn_ns / searched_ns;
        println!(
            "  {name:<44}{:>9} faces, {left_out} left out by {draws} draws{searched_ns:>8.1} ns{drawn_ns:>8.1} ns{ratio:>7.2}",
            scene.triangle_count()
        );
        json!({ "scene": name, "searched_ns": searched_ns, "drawn_ns": drawn_ns })
    };
    scenes.iter().map(row).collect()
}
