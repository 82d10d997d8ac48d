//! Exact areas as JSON.

use super::CameraRecord;
use super::json::json;
use crate::camera::Projection;
use crate::error::Result;
use crate::lines::{Region, Regions, Surface};
use crate::scene::{Object, Scene};
use serde::Serialize;
use std::fmt::Write;

/// An object of the scene as written to the file.
#[derive(Serialize)]
struct ObjectRecord<'a> {
    name: &'a str,
    materials: Vec<&'a str>,
}

/// An area as written to the file.
#[derive(Serialize)]
struct RegionRecord {
    object: Option<u32>,
    #[serde(skip_serializing_if = "Option::is_none")]
    material: Option<u32>,
    #[serde(skip_serializing_if = "Option::is_none")]
    tone: Option<u8>,
    #[serde(skip_serializing_if = "Option::is_none")]
    face: Option<u32>,
    area_px: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    area: Option<f64>,
    loops: Vec<Vec<[f64; 2]>>,
}

/// Returns areas as one JSON object: `size`, `camera`, `objects` with their names and their materials' names, and `regions`, one
/// per line of the text.
///
/// A region has its `object`, `null` for background; its `material`, `tone` and `face`, each if all of the region has it in
/// common; its area without holes, square pixels, and in parallel projection the same in square units of the model; its loops, the outer one first, then holes, which run the other way: corners in
/// pixels, y down.
///
/// # Errors
///
/// [`crate::Error::Lines`] for numbers that JSON cannot hold.
pub fn regions_json(regions: &Regions<Option<Surface>>, scene: &Scene) -> Result<String> {
    let mut text =
        format!("{{\"size\": {},\n\"camera\": {},\n", json(&regions.size)?, json(&CameraRecord::new(scene))?);
    write_regions(regions, scene, &mut text)?;
    text.push_str("}\n");
    Ok(text)
}

/// The pixels of a length of the model, which all of a parallel projection has in common.
pub(crate) fn px_per_unit(scene: &Scene) -> Option<f64> {
    match scene.camera.projection {
        Projection::Parallel { height } => Some(f64::from(scene.size.height) / height),
        Projection::Perspective { .. } => None,
    }
}

/// Writes the members `objects` and `regions` of a JSON object.
pub(super) fn write_regions(regions: &Regions<Option<Surface>>, scene: &Scene, text: &mut String) -> Result<()> {
    let object = |object: &Object| {
        let materials = object.mesh.materials.iter().map(|material| material.name.as_str()).collect();
        json(&ObjectRecord { name: &object.mesh.name, materials })
    };
    let objects: Vec<String> = scene.objects.iter().map(object).collect::<Result<_>>()?;
    let _ = write!(text, "\"objects\": [{}],\n\"regions\": [", objects.join(", "));
    for (index, Region { seen, loops, area_px }) in regions.regions.iter().enumerate() {
        let record = RegionRecord {
            object: seen.map(|surface| surface.object),
            material: seen.and_then(|surface| surface.material),
            tone: seen.and_then(|surface| surface.tone),
            face: seen.and_then(|surface| surface.face),
            area_px: *area_px,
            area: px_per_unit(scene).map(|px_per_unit| area_px / px_per_unit.powi(2)),
            loops: loops.iter().map(|corners| corners.iter().map(|corner| corner.to_array()).collect()).collect(),
        };
        text.push_str(if index == 0 { "\n" } else { ",\n" });
        text.push_str(&json(&record)?);
    }
    text.push_str("\n]");
    Ok(())
}
