//! Objects outside the picture, and faces that the driver would cull.

use super::ground::stays_in_objects;
use super::rule::{Omission, Rule, Situation, counted};
use crate::culling::{DrawnFaces, faces_not_culled};
use crate::hidden_faces::faces_not_hidden;
use crate::limits::DRAWN_AT_ONCE_PIXELS;
use crate::plan::{Blend, Depth, Draw, EdgeRun, Faces, Geometry, Plan, Step};
use crate::scene::Scene;
use std::sync::{Arc, PoisonError};

/// Leaves out objects outside the picture, with their edges.
pub(super) fn outside(plan: &mut Plan, situation: &Situation<'_>) -> Result<Omission, String> {
    let scene = situation.scene;
    let all_outside = |width_px: f32| -> Vec<bool> {
        scene.objects.iter().map(|object| scene.is_outside(object, width_px)).collect()
    };
    let outside = all_outside(0.0);
    let count = outside.iter().filter(|is_outside| **is_outside).count();
    if count == 0 {
        return Err("no object is outside the picture".to_owned());
    }
    let selection = Arc::new(
        outside.iter().map(|is_outside| if *is_outside { Faces::None } else { Faces::All }).collect::<Vec<_>>(),
    );
    let (mut is_changed, mut edges) = (false, 0);
    for draw in plan.draws_mut() {
        let keeps_places = draw.keeps_places();
        match &mut draw.geometry {
            Geometry::Objects(_) if draw.faces.is_none() && keeps_places => {
                draw.faces = Some(selection.clone());
                is_changed = true;
            }
            Geometry::Edges { runs, width_px, .. } if keeps_places => {
                let beyond = all_outside(*width_px);
                let is_left_out = |run: &EdgeRun| beyond.get(run.object).is_some_and(|is_outside| *is_outside);
                let left_out: usize = runs.iter().filter(|run| is_left_out(run)).map(|run| run.ends.len()).sum();
                if left_out > 0 {
                    *runs = Arc::new(runs.iter().filter(|run| !is_left_out(run)).cloned().collect());
                    edges += left_out;
                    is_changed = true;
                }
            }
            _ => {}
        }
    }
    if !is_changed {
        return Err("objects outside the picture are left out already".to_owned());
    }
    if count == outside.len() {
        let draws_nothing = |step: &Step| matches!(step, Step::Draw(draw) if stays_in_objects(draw));
        plan.passes.iter_mut().for_each(|pass| pass.steps.retain(|step| !draws_nothing(step)));
    }
    let lines =
        if edges > 0 { format!(" and {}", counted(edges, "of their edges", "of their edges")) } else { String::new() };
    Ok(Omission {
        rule: Rule::OutsideObjects,
        what: format!("{} of {}{lines}", count, counted(outside.len(), "object", "objects")),
        reason: "none of their pixels would lie in the picture".to_owned(),
        facts: vec!["their bounding boxes lie outside one side of the camera's view".to_owned()],
    })
}

/// Leaves out faces that the driver would otherwise cull after computing their vertices.
pub(super) fn culled_faces(plan: &mut Plan, situation: &Situation<'_>) -> Result<Omission, String> {
    let Situation { scene, surface, pruning, .. } = *situation;
    let is_culled = |draw: &Draw| draw.cull_back_faces && draw.keeps_places();
    if !plan.draws().any(|draw| draw.is_of_objects() && is_culled(draw)) {
        return Err(
            "this style draws faces from both sides; --cull back leaves those out that are turned away".to_owned()
        );
    }
    if !pruning.is_software {
        return Err("the device culls faster than they are found here".to_owned());
    }
    let lists = |number: usize| {
        let object = &scene.objects[number];
        let arrays = scene.arrays(object);
        let clip_from_object = scene.clip_from_view() * scene.view_from_object(object, arrays.centre);
        faces_not_culled(arrays, clip_from_object, surface, pruning.subpixel_bits)
    };
    let left_out = choose(plan, scene, is_culled, lists);
    if left_out == 0 {
        return Err("no face is surely turned away".to_owned());
    }
    Ok(Omission {
        rule: Rule::CulledFaces,
        what: format!("{left_out} of {} faces", scene.triangle_count()),
        reason: "the driver would cull them, after it has computed their vertices".to_owned(),
        facts: vec![
            "their corners run clockwise in the picture, wherever on its sub-pixels the driver places them".to_owned(),
        ],
    })
}

/// For how many views the search for hidden faces rests.
const REST: u32 = 31;

/// Leaves out faces that cover no pixel's centre, and those behind others at every centre that they cover.
pub(super) fn hidden_faces(plan: &mut Plan, situation: &Situation<'_>) -> Result<Omission, String> {
    let Situation { scene, surface, pruning, .. } = *situation;
    let hides = |draw: &Draw| {
        draw.is_of_objects()
            && draw.keeps_places()
            && draw.keeps_pixels()
            && draw.depth == Depth::TestAndWrite
            && draw.blend == Blend::Replace
            && !draw.cull_back_faces
    };
    if !plan.draws().any(hides) {
        return Err("no draw of objects tests and writes depth, and nothing else".to_owned());
    }
    if !pruning.is_software {
        return Err("the device draws them faster than they are found here".to_owned());
    }
    if surface.pixel_count() > DRAWN_AT_ONCE_PIXELS {
        return Err("so large a picture is drawn in tiles".to_owned());
    }
    let mut offsets: Vec<Option<[f32; 2]>> =
        plan.draws().filter(|draw| hides(draw)).map(|draw| draw.polygon_offset).collect();
    offsets.dedup();
    let mut left_out = 0;
    for offset in offsets {
        let is_meant = |draw: &Draw| hides(draw) && draw.polygon_offset == offset;
        let draws = plan.draws().filter(|draw| is_meant(draw)).count();
        let mut rest = pruning.rest.lock().unwrap_or_else(PoisonError::into_inner);
        if let (Some((models, views)), Some(first)) = (rest.as_mut(), scene.objects.first())
            && *views > 0
            && models.is_of(first)
        {
            *views -= 1;
            break;
        }
        let (mut lists, is_worth_it) =
            faces_not_hidden(scene, surface, pruning.subpixel_bits, offset.unwrap_or_default(), draws);
        if !is_worth_it {
            *rest = scene.objects.first().map(|first| (first.identity(), REST));
        }
        left_out = left_out.max(choose(plan, scene, is_meant, |number| lists[number].take()));
    }
    if left_out == 0 {
        return Err("no face is surely hidden, or an earlier view saved less than its search cost".to_owned());
    }
    Ok(Omission {
        rule: Rule::HiddenFaces,
        what: format!("{left_out} of {} faces", scene.triangle_count()),
        reason: "none of their pixels would be seen".to_owned(),
        facts: vec![
            "others lie before them at every pixel's centre that they may cover, or they cover none".to_owned(),
        ],
    })
}

/// The faces of each object that a draw draws.
type Selection = Arc<Vec<Faces>>;

/// Restricts draws of whole objects that satisfy `is_meant` to the listed faces; returns how many faces are left out.
fn choose(
    plan: &mut Plan,
    scene: &Scene,
    is_meant: impl Fn(&Draw) -> bool,
    mut list: impl FnMut(usize) -> Option<DrawnFaces>,
) -> usize {
    let is_whole = |draw: &Draw, number: usize| match &draw.faces {
        None => true,
        Some(faces) => faces.get(number) == Some(&Faces::All),
    };
    let mut left_out = 0;
    let lists: Vec<Option<Faces>> = (0..scene.objects.len())
        .map(|number| {
            let is_needed = plan.draws().any(|draw| draw.is_of_objects() && is_meant(draw) && is_whole(draw, number));
            let drawn = is_needed.then(|| list(number)).flatten()?;
            left_out += drawn.left_out;
            Some(Faces::Listed(Arc::new(drawn)))
        })
        .collect();
    if left_out == 0 {
        return 0;
    }
    // Draws with the same list before share the new list.
    let mut made: Vec<(Option<Selection>, Selection)> = Vec::new();
    for draw in plan.draws_mut().filter(|draw| draw.is_of_objects() && is_meant(draw)) {
        let before = draw.faces.take();
        let known = made.iter().find(|(old, _)| *old == before).map(|(_, new)| new.clone());
        draw.faces = Some(known.unwrap_or_else(|| {
            let old = |number: usize| before.as_ref().map_or(Faces::All, |faces| faces[number].clone());
            let pick = |(number, list): (usize, &Option<Faces>)| match (old(number), list) {
                (Faces::All, Some(list)) => list.clone(),
                (old, _) => old,
            };
            let new = Arc::new(lists.iter().enumerate().map(pick).collect());
            made.push((before, Arc::clone(&new)));
            new
        }));
    }
    left_out
}
