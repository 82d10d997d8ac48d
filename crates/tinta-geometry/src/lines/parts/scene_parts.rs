//! The parts of a scene by number, with their names and styles.

use crate::edges::{Class, ClassSet, CreaseAngle};
use crate::error::{Error, Result};
use crate::lines::parts::rules::{PartRule, PartRules};
use crate::lines::parts::style::{PartRole, PartStyle};
use crate::lines::{LineSegment, LineSettings};
use crate::mesh::{Mesh, NONE, PatternMatches, SECTION};
use crate::scene::Scene;
use std::collections::HashMap;
use std::sync::Arc;

/// The triangles of a model that share a part of its file and a material.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct ScenePart {
    /// The model's name.
    pub model: String,
    /// The part's name in the file; empty without one.
    pub name: String,
    /// The material's name in the file; empty without one.
    pub material: String,
    /// The number of its style in [`VisibleLines::looks`](super::super::VisibleLines::looks).
    pub look: u32,
}

/// The parts of a scene and their styles.
pub(in crate::lines) struct SceneParts {
    pub list: Vec<ScenePart>,
    /// The different styles; the first is that of parts without a rule.
    pub looks: Vec<PartStyle>,
    /// The classes and the crease angle of parts without their own.
    classes: ClassSet,
    crease_angle: CreaseAngle,
    /// For each object the numbers of its parts.
    of_objects: Vec<Arc<Numbers>>,
}

/// The parts of a mesh: of [`WHOLE`], and by the numbers of part and material in the file.
struct Numbers {
    first: u32,
    others: HashMap<[u32; 2], u32>,
}

/// The numbers of part and material of triangles without both, and of curves and points.
const WHOLE: [u32; 2] = [NONE; 2];

impl SceneParts {
    /// Numbers the parts of a scene and applies the rules.
    ///
    /// # Errors
    ///
    /// [`Error::Setting`] for a pattern that names nothing.
    pub(in crate::lines) fn new(scene: &Scene, settings: &LineSettings) -> Result<Self> {
        let &LineSettings { classes, crease_angle, .. } = settings;
        let rules = &settings.parts;
        let looks = vec![PartStyle::default()];
        let mut parts = Self { list: Vec::new(), looks, classes, crease_angle, of_objects: Vec::new() };
        let mut is_used = vec![false; rules.0.len()];
        let mut known: HashMap<*const Mesh, Arc<Numbers>> = HashMap::new();
        for object in &scene.objects {
            let add = || Arc::new(parts.numbers(&object.mesh, rules, &mut is_used));
            let numbers = known.entry(Arc::as_ptr(&object.mesh)).or_insert_with(add).clone();
            parts.of_objects.push(numbers);
        }
        match is_used.iter().position(|is_used| !is_used) {
            None => Ok(parts),
            Some(unused) => {
                let pattern = &rules.0[unused].pattern;
                let meshes = scene.objects.iter().map(|object| object.mesh.as_ref());
                Err(Error::value("part", &pattern.0, pattern.names_nothing(meshes)))
            }
        }
    }

    fn numbers(&mut self, mesh: &Mesh, PartRules(rules): &PartRules, is_used: &mut [bool]) -> Numbers {
        let named: Vec<PatternMatches> = rules.iter().map(|rule| rule.pattern.named(mesh)).collect();
        is_used.iter_mut().zip(&named).for_each(|(is_used, named)| *is_used |= named.is_any());
        let mut add = |key: [u32; 2]| {
            let is_cut = mesh.curves.hatching > 0 && names(mesh, key).name == SECTION;
            let name = if is_cut { SECTION.to_owned() } else { String::new() };
            let mut style = PartStyle { name, is_cut, ..PartStyle::default() };
            let is_fill = |style: &PartStyle| style.role.is_none() && style.is_of_surface();
            let of_lines = |(rule, named): &(&PartRule, &PatternMatches)| named.holds(key) && !is_fill(&rule.style);
            for (rule, _) in rules.iter().zip(&named).filter(of_lines) {
                style = PartStyle { fill: None, ..rule.style.over(&style) };
            }
            let look = self.look(style);
            self.list.push(ScenePart { look, ..names(mesh, key) });
            self.list.len() as u32 - 1
        };
        let first = add(WHOLE);
        let mut others = HashMap::new();
        let mut last = WHOLE;
        let count = mesh.triangle_parts.len().max(mesh.triangle_materials.len());
        for key in (0..count).map(|face| mesh.part_and_material(face)).filter(|key| *key != WHOLE) {
            if key != last {
                others.entry(key).or_insert_with(|| add(key));
                last = key;
            }
        }
        Numbers { first, others }
    }

    /// The number of a style among the different ones.
    fn look(&mut self, style: PartStyle) -> u32 {
        let known = self.looks.iter().position(|look| *look == style);
        known.unwrap_or_else(|| {
            self.looks.push(style);
            self.looks.len() - 1
        }) as u32
    }

    /// The part of a face, in an object's mesh or in a repaired one.
    pub(in crate::lines) fn of_face(&self, object: usize, mesh: &Mesh, face: u32) -> u32 {
        self.number(object, mesh.part_and_material(face as usize))
    }

    /// The part of an object's curves and points.
    pub(in crate::lines) fn of_curves(&self, object: usize) -> u32 {
        self.number(object, WHOLE)
    }

    /// The part of the strokes on an object's cut.
    pub(in crate::lines) fn of_cut(&self, object: usize) -> u32 {
        let Numbers { first, others } = &*self.of_objects[object];
        let cuts = others.values().copied().filter(|part| self.is_of_cut(*part));
        cuts.min().unwrap_or(*first)
    }

    /// Whether this part is a section's cut.
    pub(in crate::lines) fn is_of_cut(&self, part: u32) -> bool {
        self.list.get(part as usize).is_some_and(|part| part.name == SECTION)
    }

    fn number(&self, object: usize, key: [u32; 2]) -> u32 {
        let Numbers { first, others } = &*self.of_objects[object];
        // Most models are one part. Repaired meshes have the parts of their original.
        if key == WHOLE { *first } else { others.get(&key).copied().unwrap_or(*first) }
    }

    /// The number of a part's style.
    pub(in crate::lines) fn look_of(&self, part: u32) -> u32 {
        self.list[part as usize].look
    }

    fn style(&self, part: u32) -> &PartStyle {
        &self.looks[self.look_of(part) as usize]
    }

    fn role(&self, part: u32) -> PartRole {
        self.style(part).role.unwrap_or_default()
    }

    /// Whether a part hides nothing.
    pub(in crate::lines) fn is_ghost(&self, part: u32) -> bool {
        self.role(part) == PartRole::Ghost
    }

    /// Whether a line is a ghost's, or one between two parts of which one may be a ghost.
    pub(in crate::lines) fn may_be_of_ghost(&self, segment: &LineSegment) -> bool {
        let is_between = matches!(segment.class, Class::Intersection | Class::Part);
        self.is_ghost(segment.part) || is_between && self.has_ghosts()
    }

    /// Whether any part hides nothing.
    pub(in crate::lines) fn has_ghosts(&self) -> bool {
        self.looks.iter().any(|look| look.role == Some(PartRole::Ghost))
    }

    /// The part to which a line of several parts belongs: the first that is drawn and hides others, or else the first that is
    /// drawn. A section's cut comes before all others: its outline is the cut's.
    pub(in crate::lines) fn owner(&self, parts: impl Iterator<Item = u32>) -> u32 {
        parts.min_by_key(|part| (self.role(*part) as u8, !self.is_of_cut(*part))).unwrap_or(0)
    }

    /// The classes of a part's lines: none if it is not drawn.
    pub(in crate::lines) fn classes(&self, part: u32) -> ClassSet {
        match self.role(part) {
            PartRole::OccludeOnly => ClassSet::default(),
            _ => self.style(part).classes.unwrap_or(self.classes),
        }
    }

    /// The crease angle of each style.
    pub(in crate::lines) fn crease_angles(&self) -> Vec<CreaseAngle> {
        self.looks.iter().map(|look| look.crease_angle.unwrap_or(self.crease_angle)).collect()
    }

    /// The settings of lines with the classes of all parts together.
    pub(in crate::lines) fn settings(&self, settings: &LineSettings) -> LineSettings {
        let own = self.looks.iter().filter_map(|look| look.classes);
        LineSettings { classes: own.fold(self.classes, ClassSet::or), ..settings.clone() }
    }

    /// Writes the number of each segment's style into it.
    pub(in crate::lines) fn put_looks(&self, segments: &mut [LineSegment]) {
        segments.iter_mut().for_each(|segment| segment.look = self.look_of(segment.part));
    }
}

/// The names of a part and a material.
fn names(mesh: &Mesh, [part, material]: [u32; 2]) -> ScenePart {
    let name = mesh.parts.get(part as usize).map(|part| part.name.clone());
    let material = mesh.materials.get(material as usize).map(|material| material.name.clone());
    let (name, material) = (name.unwrap_or_default(), material.unwrap_or_default());
    ScenePart { model: mesh.name.clone(), name, material, look: 0 }
}
