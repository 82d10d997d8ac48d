//! Textures as areas show them: each face in one colour, the mean of its texels.
//!
//! In: a scene. Out: the same scene with a material without texture for each of these colours. The material with number `n` in a file of
//! `count` materials has its colours at `n + count`, `n + 2 * count` and so on.

use crate::error::Result;
use crate::mesh::{Material, Mesh};
use crate::picture::{Picture, material_pictures};
use crate::scene::Scene;
use glam::{DVec2, DVec3, DVec4, Vec2};
use std::borrow::Cow;
use std::collections::hash_map::Entry;
use std::collections::{BTreeSet, HashMap};
use std::sync::Arc;

/// The most colours of a mesh, for each of its materials: more are told apart by fewer bits, so that areas join.
const MOST_COLORS: usize = 256;

/// The most parts of a face's side between which its texture is read.
const MOST_PARTS: f64 = 16.0;

/// The cosine of the largest angle between two triangles of one face.
const FLAT: f64 = 0.999;

/// Returns the scene with flat colours in place of the textures that it shows.
///
/// # Errors
///
/// Those of [`material_pictures`].
pub(super) fn in_flat_colors(scene: &Scene) -> Result<Cow<'_, Scene>> {
    if !scene.shows_textures() {
        return Ok(Cow::Borrowed(scene));
    }
    let mut flat = scene.clone();
    let mut known = HashMap::new();
    for object in &mut flat.objects {
        let mesh = Arc::as_ptr(&object.mesh);
        if let Entry::Vacant(place) = known.entry(mesh) {
            place.insert(object.with_mesh(Arc::new(flat_mesh(&object.mesh)?)));
        }
        object.offset = std::mem::replace(object, known[&mesh].clone()).offset;
    }
    Ok(Cow::Owned(flat))
}

/// A triangle, its face, its material and its mean colour.
type Triangle = (usize, u32, usize, DVec3);

fn flat_mesh(mesh: &Mesh) -> Result<Mesh> {
    let (pictures, faces) = (material_pictures(&mesh.materials)?, faces(mesh));
    let of_triangle = |triangle: usize| -> Option<Triangle> {
        let material = *mesh.triangle_materials.get(triangle)? as usize;
        let picture = pictures.get(material)?.as_ref()?;
        let corners = [0, 1, 2].map(|corner| place(mesh, triangle, corner).as_dvec2());
        Some((triangle, faces[triangle], material, mean(picture, corners)))
    };
    let mut triangles: Vec<Triangle> = (0..mesh.triangles.len()).filter_map(of_triangle).collect();
    triangles.sort_by_key(|(_, face, material, _)| (*face, *material));
    for of_face in triangles.chunk_by_mut(|one, other| (one.1, one.2) == (other.1, other.2)) {
        let mean = of_face.iter().map(|triangle| triangle.3).sum::<DVec3>() / of_face.len() as f64;
        of_face.iter_mut().for_each(|triangle| triangle.3 = mean);
    }
    let key = |(_, _, material, color): &Triangle, bits: u32| {
        (*material, color.round().as_uvec3().to_array().map(|channel| channel >> bits))
    };
    let count = mesh.materials.len();
    let most = |bits: u32| {
        let colors: BTreeSet<_> = triangles.iter().map(|triangle| key(triangle, bits)).collect();
        let mut counts = vec![0; count];
        colors.iter().for_each(|(material, _)| counts[*material] += 1);
        counts.into_iter().max().unwrap_or(0)
    };
    let bits = (0..8).find(|bits| most(*bits) <= MOST_COLORS).unwrap_or(8);
    triangles.sort_by_cached_key(|triangle| key(triangle, bits));
    let (mut flat, mut numbers) = (mesh.clone(), (0..count).collect::<Vec<_>>());
    for of_color in triangles.chunk_by(|one, other| key(one, bits) == key(other, bits)) {
        let material = of_color[0].2;
        numbers[material] += count;
        let Material { name, texture_color, .. } = &mesh.materials[material];
        let mean = of_color.iter().map(|triangle| triangle.3).sum::<DVec3>() / (255.0 * of_color.len() as f64);
        let factor = DVec3::from(texture_color.unwrap_or([1.0; 3]).map(f64::from));
        let color = Some((mean * factor).as_vec3().to_array());
        flat.materials.resize(flat.materials.len().max(numbers[material] + 1), Material::default());
        flat.materials[numbers[material]] = Material { name: name.clone(), color, ..Material::default() };
        of_color.iter().for_each(|triangle| flat.triangle_materials[triangle.0] = numbers[material] as u32);
    }
    Ok(flat)
}

/// The texture coordinates of a triangle's corner, as drivers get them.
fn place(mesh: &Mesh, triangle: usize, corner: usize) -> Vec2 {
    let number = mesh.triangle_texture_coordinates.get(triangle).map(|corners| corners[corner] as usize);
    number.and_then(|number| mesh.texture_coordinates.get(number)).copied().unwrap_or_default()
}

/// The number of each triangle's face. Two triangles that meet in a plane and in the texture along the longest side of both are one, as
/// files without polygons write a quadrilateral.
fn faces(mesh: &Mesh) -> Vec<u32> {
    let mut faces: Vec<u32> = (0..mesh.triangles.len() as u32).map(|triangle| mesh.file_face(triangle)).collect();
    let mut halves: HashMap<_, (usize, DVec3)> = HashMap::new();
    for (triangle, positions) in mesh.triangles.iter().enumerate() {
        let corners = positions.map(|position| mesh.positions[position as usize]);
        let length = |corner: &usize| corners[*corner].distance_squared(corners[(*corner + 1) % 3]);
        let longest = (0..3).max_by(|one, other| length(one).total_cmp(&length(other))).unwrap_or_default();
        let end = |corner: usize| (positions[corner], place(mesh, triangle, corner).to_array().map(f32::to_bits));
        let mut ends = [longest, (longest + 1) % 3].map(end);
        ends.sort_unstable();
        let normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalize_or_zero();
        match halves.entry(ends) {
            Entry::Occupied(half) if half.get().1.dot(normal) > FLAT => faces[triangle] = faces[half.remove().0],
            half => _ = half.insert_entry((triangle, normal)),
        }
    }
    faces
}

/// The mean of the texels in a triangle with these corners, whose coordinates are shares of the picture from its lower left; 0 to 255.
fn mean(picture: &Picture, corners: [DVec2; 3]) -> DVec3 {
    let size = DVec2::new(f64::from(picture.size.width), f64::from(picture.size.height));
    let [a, b, c] = corners.map(|corner| corner * size);
    let longest = a.distance(b).max(b.distance(c)).max(c.distance(a));
    let parts = longest.ceil().clamp(1.0, MOST_PARTS) as u32;
    let texel = |along: u32, up: u32| {
        let [along, up] = [along, up].map(|part| (f64::from(part) + 1.0 / 3.0) / f64::from(parts));
        let [x, y] = (a + (b - a) * along + (c - a) * up).rem_euclid(size).to_array().map(|it| it as i64);
        DVec4::from(picture.pixel(x, i64::from(picture.size.height) - 1 - y).map(f64::from)).truncate()
    };
    let texels = (0..parts).flat_map(|along| (0..parts - along).map(move |up| texel(along, up)));
    texels.sum::<DVec3>() / f64::from(parts * (parts + 1) / 2)
}
