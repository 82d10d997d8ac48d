//! Copies of a node's mesh: EXT_mesh_gpu_instancing.
//!
//! In: a node and the file's accessors. Out: how many copies it has, and where each lies, node from mesh.

use super::accessors::Accessors;
use super::extensions::{self, INSTANCES};
use super::nodes::unit_rotation;
use glam::{DMat4, DQuat, DVec3};
use gltf_json::{Accessor, Index, Node};
use serde::Deserialize;

/// The extension of a node.
#[derive(Deserialize)]
struct InstanceExtension {
    #[serde(default)]
    attributes: Attributes,
}

/// The accessors that place the copies; other attributes are the application's own.
#[derive(Deserialize, Default)]
struct Attributes {
    #[serde(rename = "TRANSLATION")]
    translation: Option<u32>,
    #[serde(rename = "ROTATION")]
    rotation: Option<u32>,
    #[serde(rename = "SCALE")]
    scale: Option<u32>,
}

/// The copies of a node's mesh.
pub(super) struct Instances {
    translations: Option<Index<Accessor>>,
    rotations: Option<Index<Accessor>>,
    scales: Option<Index<Accessor>>,
    /// How many there are.
    pub count: usize,
}

impl Instances {
    /// The copies of a node's mesh; `None` where it is drawn once, as a skin is, which its joints place.
    pub(super) fn of(node: &Node, accessors: &Accessors<'_>) -> Result<Option<Self>, String> {
        if node.skin.is_some() {
            return Ok(None);
        }
        let others = node.extensions.as_ref().map(|extensions| &extensions.others);
        let Some(InstanceExtension { attributes }) = extensions::said::<InstanceExtension>(others, INSTANCES)? else {
            return Ok(None);
        };
        let Attributes { translation, rotation, scale } = attributes;
        let [translations, rotations, scales] = [translation, rotation, scale].map(|index| index.map(Index::new));
        let mut instances = Self { translations, rotations, scales, count: 0 };
        let counts: Vec<usize> =
            instances.accessors().map(|index| accessors.count(index)).collect::<Result<_, String>>()?;
        let Some(first) = counts.first() else { return Ok(None) };
        if counts.iter().any(|count| count != first) {
            return Err(format!("the lists of its {INSTANCES} have different lengths; export it again"));
        }
        instances.count = *first;
        Ok(Some(instances))
    }

    /// The accessors that it reads.
    pub(super) fn accessors(&self) -> impl Iterator<Item = Index<Accessor>> {
        [self.translations, self.rotations, self.scales].into_iter().flatten()
    }

    /// Where each copy lies: node from mesh.
    pub(super) fn places(&self, accessors: &Accessors<'_>) -> Result<impl Iterator<Item = DMat4>, String> {
        let vectors = |index: Option<Index<Accessor>>| match index {
            None => Ok(Vec::new()),
            Some(index) => accessors.numbers::<3>(index, self.count),
        };
        let (translations, scales) = (vectors(self.translations)?, vectors(self.scales)?);
        let rotations = match self.rotations {
            None => Vec::new(),
            Some(index) => accessors.numbers::<4>(index, self.count)?,
        };
        Ok((0..self.count).map(move |place| {
            DMat4::from_scale_rotation_translation(
                scales.get(place).copied().map_or(DVec3::ONE, DVec3::from_array),
                rotations.get(place).copied().map_or(DQuat::IDENTITY, |turn| unit_rotation(DQuat::from_array(turn))),
                translations.get(place).copied().map_or(DVec3::ZERO, DVec3::from_array),
            )
        }))
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::{add_accessor, add_floats, load, problem, triangle};
    use super::INSTANCES;
    use glam::{DVec3, dvec3};
    use serde_json::{Value, json};

    /// The triangle (0,0,0), (1,0,0), (0,1,0) in a node of twice its size, moved by 1 along x within it.
    fn with_attributes(mut file: Value, attributes: Value) -> Value {
        file["extensionsUsed"] = json!([INSTANCES]);
        file["extensionsRequired"] = json!([INSTANCES]);
        file["nodes"][1]["extensions"] = json!({INSTANCES: {"attributes": attributes}});
        file
    }

    fn has(positions: &[DVec3], point: DVec3) -> bool {
        positions.iter().any(|position| position.distance(point) < 1e-4)
    }

    #[test]
    fn every_copy_lies_where_the_lists_say_within_its_node() {
        let half = 0.5f32.sqrt();
        let mut file = triangle();
        let moves = add_floats(&mut file, "VEC3", &[0.0, 0.0, 0.0, 10.0, 0.0, 0.0, 0.0, 20.0, 0.0]);
        // A quarter turn about z for the second.
        let turns = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, half, half, 0.0, 0.0, 0.0, 1.0];
        let float_turns = add_floats(&mut file, "VEC4", &turns);
        let sizes = add_floats(&mut file, "VEC3", &[1.0, 1.0, 1.0, 1.0, 3.0, 1.0, -1.0, 1.0, 1.0]);
        let bytes: Vec<u8> = turns.iter().map(|turn| (turn * 127.0).round() as i8 as u8).collect();
        let byte_turns = add_accessor(&mut file, 5120, "VEC4", 3, &bytes);
        let shorts: Vec<u8> = turns.iter().flat_map(|turn| ((turn * 32_767.0).round() as i16).to_le_bytes()).collect();
        let short_turns = add_accessor(&mut file, 5122, "VEC4", 3, &shorts);
        for list in [byte_turns, short_turns] {
            file["accessors"][list]["normalized"] = json!(true);
        }
        for turns in [float_turns, byte_turns, short_turns] {
            let attributes = json!({"TRANSLATION": moves, "ROTATION": turns, "SCALE": sizes, "_ID": 99});
            let loaded = load(&with_attributes(file.clone(), attributes)).unwrap();
            assert!(loaded.remarks.is_empty(), "{:?}", loaded.remarks);
            let mesh = loaded.mesh;
            assert_eq!((mesh.triangles.len(), mesh.positions.len(), mesh.parts.len()), (3, 9, 2));
            for corner in [dvec3(2.0, 0.0, 0.0), dvec3(4.0, 0.0, 0.0), dvec3(2.0, 2.0, 0.0)] {
                assert!(has(&mesh.positions, corner), "{corner} of {:?}", mesh.positions);
            }
            // (0, 1) is made three times as long, turned to (-3, 0), moved to (7, 0), and in the node to (16, 0).
            assert!(has(&mesh.positions, dvec3(16.0, 0.0, 0.0)) && has(&mesh.positions, dvec3(22.0, 2.0, 0.0)));
            // Mirrored, and still counter-clockwise.
            assert!(has(&mesh.positions, dvec3(0.0, 40.0, 0.0)));
            for corners in &mesh.triangles {
                let [a, b, c] = corners.map(|index| mesh.positions[index as usize]);
                assert!((b - a).cross(c - a).z > 0.0, "{a} {b} {c}");
            }
        }
    }

    #[test]
    fn lists_that_are_missing_or_differ_in_length_are_read_or_refused() {
        let mut file = triangle();
        let moves = add_floats(&mut file, "VEC3", &[0.0, 0.0, 0.0, 10.0, 0.0, 0.0]);
        let sizes = add_floats(&mut file, "VEC3", &[1.0; 9]);
        let count = |attributes: Value| load(&with_attributes(file.clone(), attributes)).unwrap().mesh.triangles.len();
        assert_eq!([count(json!({"TRANSLATION": moves})), count(json!({"_ID": 0}))], [2, 1]);
        let refused = |attributes: Value| problem(&with_attributes(file.clone(), attributes));
        let different = "t.gltf: the lists of its EXT_mesh_gpu_instancing have different lengths; export it again";
        assert_eq!(refused(json!({"TRANSLATION": moves, "SCALE": sizes})), different);
        assert!(refused(json!({"TRANSLATION": 99})).contains("its accessor 99 does not exist"));
        assert!(refused(json!({"ROTATION": moves})).contains("3 numbers per element where 4 are needed"));
        assert!(refused(json!("none")).contains("its EXT_mesh_gpu_instancing is damaged"));
        // A list of zeros takes no bytes in the file.
        let mut many = with_attributes(file.clone(), json!({"TRANSLATION": moves}));
        many["accessors"][moves] = json!({"componentType": 5126, "count": 1_000_000_000, "type": "VEC3"});
        assert!(problem(&many).contains("take more than 20 times the file's size"), "{}", problem(&many));
    }
}
