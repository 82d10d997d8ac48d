//! Flat and Gouraud shading in the ramp's tones, for comparison with the ramp. The section "Painting" of C. Dachsbacher's article
//! tries them first.
//!
//! Light and tones are the ramp's. Flat shading looks a tone up once a face, Gouraud shading once a vertex, with GL mixing
//! between vertices; the ramp as a texture is looked up at every pixel.

use super::gradients::{Gradients, Light, VertexLists};
use crate::culling::DrawnFaces;
use crate::mesh::Part;
use crate::plan::Faces;
use crate::scene::{Object, Scene};
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

/// Red, green and blue, 0 to 255.
type Tone = [u8; 3];

/// An object's faces by their tone.
type ByTone = Arc<BTreeMap<Tone, Arc<DrawnFaces>>>;

/// Returns each vertex's tone as a colour: red, green, blue, alpha.
pub(super) fn vertex_colors(gradients: &Gradients<'_>) -> VertexLists<[f32; 4]> {
    let coordinates = gradients.coordinates(true);
    gradients.of_objects(|number, _| {
        Arc::new(coordinates[number].iter().map(|coordinate| opaque(gradients.texel(*coordinate))).collect())
    })
}

/// Returns the faces of each tone, an entry for each object, and the tone as a colour.
pub(super) fn faces_by_tone(scene: &Scene, gradients: &Gradients<'_>) -> Vec<([f32; 4], Arc<Vec<Faces>>)> {
    let light = Light::of(scene);
    let lists: Arc<Vec<ByTone>> =
        gradients.of_objects(|number, object| of_object(scene, light, gradients, number, object));
    let tones: BTreeSet<Tone> = lists.iter().flat_map(|list| list.keys().copied()).collect();
    let faces = |tone: &Tone| -> Vec<Faces> {
        lists.iter().map(|list| list.get(tone).cloned().map_or(Faces::None, Faces::Listed)).collect()
    };
    tones.iter().map(|tone| (opaque(*tone), Arc::new(faces(tone)))).collect()
}

/// Returns an object's faces by tone, each list in drawing order.
fn of_object(scene: &Scene, light: Light, gradients: &Gradients<'_>, number: usize, object: &Object) -> ByTone {
    let (mesh, arrays) = (&object.mesh, scene.arrays(object));
    let mut lists: BTreeMap<Tone, DrawnFaces> = BTreeMap::new();
    for part in &arrays.parts {
        let row = gradients.coordinate(number, part.material);
        for face in part.first as usize / 3..(part.first + part.count) as usize / 3 {
            let triangle = mesh.triangles[arrays.order[face] as usize];
            let [a, b, c] = triangle.map(|position| mesh.positions[position as usize]);
            let normal = (b - a).cross(c - a).normalize_or_zero().as_vec3();
            let tone = gradients.texel([light.on(normal), row]);
            let list = lists.entry(tone).or_default();
            let first = list.indices.len() as u32;
            list.indices.extend_from_slice(&arrays.indices[face * 3..][..3]);
            match list.parts.last_mut() {
                Some(last) if (last.material, last.is_doubled) == (part.material, part.is_doubled) => last.count += 3,
                _ => list.parts.push(Part { first, count: 3, ..*part }),
            }
        }
    }
    Arc::new(lists.into_iter().map(|(tone, list)| (tone, Arc::new(list))).collect())
}

fn opaque([red, green, blue]: Tone) -> [f32; 4] {
    [red, green, blue, u8::MAX].map(|channel| f32::from(channel) / 255.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::{LoadOptions, load};
    use crate::scene::SceneSettings;
    use crate::styles::{Ramp, RampRow};

    #[test]
    fn every_face_has_one_tone_and_is_drawn_once() {
        let mesh = Arc::new(load("builtin:ant", &LoadOptions::default()).unwrap().mesh);
        let scene = Scene::new(vec![mesh.clone()], &SceneSettings { copies: 3, ..SceneSettings::default() }).unwrap();
        let ramp = Ramp::default();
        for row in [RampRow::Material, RampRow::Object, RampRow::Row(2)] {
            let gradients = Gradients::new(&scene, &ramp, row);
            let tones = faces_by_tone(&scene, &gradients);
            assert!(tones.len() >= 3 && tones.len() <= 12, "{row:?}: {}", tones.len());
            for (number, object) in scene.objects.iter().enumerate() {
                let mut drawn: Vec<[u32; 3]> = Vec::new();
                for (_, faces) in &tones {
                    let Faces::Listed(list) = &faces[number] else { continue };
                    assert_eq!(list.parts.iter().map(|part| part.count).sum::<u32>() as usize, list.indices.len());
                    drawn.extend(list.indices.chunks_exact(3).map(|face| [face[0], face[1], face[2]]));
                }
                let arrays = scene.arrays(object);
                let mut all: Vec<[u32; 3]> =
                    arrays.indices.chunks_exact(3).map(|face| [face[0], face[1], face[2]]).collect();
                drawn.sort_unstable();
                all.sort_unstable();
                assert!(drawn == all, "{row:?}: object {number}");
            }
        }
    }

    #[test]
    fn a_vertexs_colour_is_what_the_ramp_shows_in_its_light() {
        let mesh = Arc::new(load("builtin:gear", &LoadOptions::default()).unwrap().mesh);
        let scene = Scene::new(vec![mesh], &SceneSettings { copies: 2, ..SceneSettings::default() }).unwrap();
        let ramp = Ramp::default();
        let gradients = Gradients::new(&scene, &ramp, RampRow::Row(1));
        let (coordinates, colors) = (gradients.coordinates(true), vertex_colors(&gradients));
        assert!(Arc::ptr_eq(&colors[0], &colors[1]), "copies share their list");
        assert_eq!(colors[0].len(), scene.arrays(&scene.objects[0]).vertices.len());
        for (coordinate, color) in coordinates[0].iter().zip(colors[0].iter()) {
            let texel = gradients.texel(*coordinate).map(|channel| f32::from(channel) / 255.0);
            assert_eq!((&color[..3], color[3]), (&texel[..], 1.0));
        }
    }
}
