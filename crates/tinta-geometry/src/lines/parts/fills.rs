//! Surfaces of parts in the colours that rules give them.
//!
//! In: a scene and rules. Out: the scene, whose meshes have a material more for each colour of a material's faces.

use crate::lines::parts::rules::PartRules;
use crate::mesh::{Material, Mesh, NONE, PatternMatches};
use crate::scene::{Color, Scene};
use std::collections::HashMap;
use std::sync::Arc;

impl Scene {
    /// The scene with the surfaces of parts in the colours of [`PartStyle::fill`](super::style::PartStyle::fill).
    #[must_use]
    pub fn with_fills(mut self, rules: &PartRules) -> Self {
        if !rules.have(|style| style.fill.is_some()) {
            return self;
        }
        let mut known: HashMap<*const Mesh, Option<Arc<Mesh>>> = HashMap::new();
        for object in &mut self.objects {
            let filled = known.entry(Arc::as_ptr(&object.mesh)).or_insert_with(|| filled(&object.mesh, rules));
            if let Some(filled) = filled {
                *object = object.with_mesh(filled.clone());
            }
        }
        self
    }
}

/// The mesh with materials for its filled parts; `None` if no face changes.
fn filled(mesh: &Mesh, PartRules(rules): &PartRules) -> Option<Arc<Mesh>> {
    // Of several rules the last one counts.
    let fills = rules.iter().rev().filter_map(|rule| Some((rule.pattern.named(mesh), rule.style.fill?)));
    let fills: Vec<(PatternMatches, Color)> = fills.collect();
    let mut filled = mesh.clone();
    filled.triangle_materials.resize(mesh.triangles.len(), NONE);
    let mut numbers: HashMap<[u32; 2], Option<u32>> = HashMap::new();
    let mut has_changed = false;
    for (face, material) in filled.triangle_materials.iter_mut().enumerate() {
        let key = mesh.part_and_material(face);
        let number = *numbers.entry(key).or_insert_with(|| {
            let (_, Color(color)) = fills.iter().find(|(named, _)| named.holds(key))?;
            let name = mesh.materials.get(key[1] as usize).map_or_else(String::new, |material| material.name.clone());
            let fill = Material { name, color: Some(*color), is_fill: true, ..Material::default() };
            let known = filled.materials.iter().position(|material| *material == fill);
            Some(known.unwrap_or_else(|| {
                filled.materials.push(fill);
                filled.materials.len() - 1
            }) as u32)
        });
        let Some(number) = number.filter(|number| number != material) else { continue };
        (*material, has_changed) = (number, true);
    }
    // Colours of vertices multiply those of faces.
    let mut is_filled = vec![true; mesh.positions.len()];
    for (triangle, material) in mesh.triangles.iter().zip(&filled.triangle_materials) {
        let is_fill = filled.materials.get(*material as usize).is_some_and(|material| material.is_fill);
        triangle.iter().for_each(|corner| is_filled[*corner as usize] &= is_fill);
    }
    let colors = filled.position_colors.iter_mut().zip(is_filled);
    colors.filter(|(_, is_filled)| *is_filled).for_each(|(color, _)| *color = [1.0; 3]);
    has_changed.then(|| Arc::new(filled))
}
