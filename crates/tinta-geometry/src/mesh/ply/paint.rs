//! The attributes of a PLY file's faces: texture coordinates and the number of a picture, as MeshLab writes them, or a colour.

use super::colors::{full_color, share};
use super::header::Header;
use super::payload::Value;
use crate::limits::FACE_COLORS;
use crate::mesh::soup::Soup;
use crate::mesh::{Material, NONE};
use glam::{DVec3, Vec2};
use std::collections::HashMap;
use std::path::PathBuf;

/// The paint of all faces so far, and that of the one being read.
#[derive(Default)]
pub(super) struct Paint {
    /// The names of the file's pictures.
    pictures: Vec<String>,
    /// A colour's full strength; `None` where faces have none, or something else is drawn in their place.
    full_color: Option<f64>,
    /// The colour of each face.
    colors: Vec<[f32; 3]>,
    /// Of this face: its texture coordinates one after the other, its picture's number, its colour.
    coordinates: Vec<f64>,
    picture: f64,
    color: DVec3,
}

impl Paint {
    pub(super) fn of(header: &Header) -> Self {
        let of = |element| header.element(element).and_then(full_color);
        Self {
            pictures: header.pictures.clone(),
            full_color: of("face").filter(|_| of("vertex").is_none() && header.pictures.is_empty()),
            ..Self::default()
        }
    }

    /// Before a face is read.
    pub(super) fn begin(&mut self) {
        self.coordinates.clear();
        self.picture = 0.0;
    }

    /// A property of the face.
    pub(super) fn take(&mut self, name: &str, value: Value) {
        match (name, value) {
            ("texcoord", Value::Number(number)) => self.coordinates.push(number),
            ("texnumber", Value::Scalar(number)) => self.picture = number,
            ("red" | "diffuse_red", Value::Scalar(number)) => self.color.x = number,
            ("green" | "diffuse_green", Value::Scalar(number)) => self.color.y = number,
            ("blue" | "diffuse_blue", Value::Scalar(number)) => self.color.z = number,
            _ => {}
        }
    }

    /// Puts the paint of a face that was kept onto it: its corners begin at `start`.
    pub(super) fn end(&mut self, soup: &mut Soup, start: usize) {
        let corners = &mut soup.corners[start..];
        if self.coordinates.len() == 2 * corners.len() {
            for (corner, pair) in corners.iter_mut().zip(self.coordinates.chunks_exact(2)) {
                corner.texture = soup.texture_coordinates.len() as u32;
                soup.texture_coordinates.push(Vec2::new(pair[0] as f32, pair[1] as f32));
            }
        }
        if !self.pictures.is_empty() {
            let number = self.picture as usize;
            // Strips, which may come first, have none.
            soup.polygon_materials.resize(soup.polygon_sizes.len() - 1, NONE);
            soup.polygon_materials.push(if number < self.pictures.len() { number as u32 } else { NONE });
        }
        self.colors.extend(self.full_color.map(|full| share(self.color, full)));
    }

    /// Makes materials of pictures, or of the faces' colours; where those are as many as in a photograph, colours at the vertices.
    pub(super) fn put_on(self, soup: &mut Soup) {
        if !self.pictures.is_empty() {
            // A file of triangles alone did not come by its faces one by one.
            soup.polygon_materials.resize(soup.polygon_count(), 0);
            soup.materials = self.pictures.into_iter().map(|name| material(name.clone(), None, Some(name))).collect();
            return;
        }
        // Strips have no colours, and are not counted here.
        if self.colors.is_empty() || self.colors.len() != soup.polygon_count() {
            return;
        }
        let mut numbers: HashMap<[u32; 3], u32> = HashMap::new();
        for color in &self.colors {
            let next = numbers.len() as u32;
            soup.polygon_materials.push(*numbers.entry(color.map(f32::to_bits)).or_insert(next));
            if numbers.len() > FACE_COLORS {
                soup.polygon_materials.clear();
                soup.colors = at_vertices(soup, &self.colors);
                return;
            }
        }
        let mut colors: Vec<([u32; 3], u32)> = numbers.into_iter().collect();
        colors.sort_unstable_by_key(|(_, number)| *number);
        soup.materials = colors
            .into_iter()
            .map(|(bits, number)| material(format!("colour {number}"), Some(bits.map(f32::from_bits)), None))
            .collect();
    }
}

fn material(name: String, color: Option<[f32; 3]>, picture: Option<String>) -> Material {
    Material { name, color, texture: picture.map(PathBuf::from), ..Material::default() }
}

/// For each vertex the mean colour of the faces there.
fn at_vertices(soup: &Soup, colors: &[[f32; 3]]) -> Vec<[f32; 3]> {
    let mut sums = vec![(DVec3::ZERO, 0.0); soup.positions.len()];
    let mut corners = soup.corners.iter();
    for (size, color) in soup.polygon_sizes.iter().zip(colors) {
        for corner in corners.by_ref().take(*size as usize) {
            let (sum, count) = &mut sums[corner.position as usize];
            *sum += DVec3::from_array(color.map(f64::from));
            *count += 1.0;
        }
    }
    let mean = |(sum, count): (DVec3, f64)| if count > 0.0 { (sum / count).as_vec3().to_array() } else { [1.0; 3] };
    sums.into_iter().map(mean).collect()
}

#[cfg(test)]
mod tests {
    use super::super::read;
    use super::*;

    fn file(head: &str, face: &str, faces: &[String]) -> Soup {
        let count = faces.len();
        let text = format!(
            "ply\nformat ascii 1.0\n{head}element vertex 4\nproperty float x\nproperty float y\nproperty float z\n\
             element face {count}\nproperty list uchar int vertex_indices\n{face}end_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n{}",
            faces.concat()
        );
        read(text.as_bytes(), "t.ply", &mut Vec::new()).unwrap()
    }

    const COLOR: &str = "property uchar red\nproperty uchar green\nproperty uchar blue\n";

    #[test]
    fn faces_of_one_colour_share_a_material_and_others_have_their_own() {
        let faces = ["3 0 1 2 255 0 0\n", "3 0 2 3 0 51 255\n", "3 2 1 0 255 0 0\n", "2 0 1 9 9 9\n"];
        let soup = file("", COLOR, &faces.map(str::to_owned));
        assert_eq!(soup.polygon_materials, [0, 1, 0]);
        let colors: Vec<_> = soup.materials.iter().map(|material| material.color.unwrap()).collect();
        assert_eq!(colors, [[1.0, 0.0, 0.0], [0.0, 0.2, 1.0]]);
    }

    #[test]
    fn as_many_colours_as_a_photograph_has_are_averaged_at_the_vertices() {
        let red = |number: usize| format!("3 0 1 2 {} {} 0\n", number % 256, number / 256);
        let soup = file("", COLOR, &(0..512).map(red).collect::<Vec<_>>());
        assert!(soup.materials.is_empty() && soup.polygon_materials.is_empty());
        assert_eq!(soup.colors, [[0.5, 0.5 / 255.0, 0.0], [0.5, 0.5 / 255.0, 0.0], [0.5, 0.5 / 255.0, 0.0], [1.0; 3]]);
    }

    #[test]
    fn meshlabs_coordinates_at_corners_and_its_pictures_are_taken() {
        let face = "property list uchar float texcoord\nproperty int texnumber\n";
        let faces = ["3 0 1 2 6 0 0 1 0 1 1 1\n", "3 0 2 3 6 0 0 1 1 0 0.5 0\n", "3 0 2 3 0 7\n"];
        let head = "comment TextureFile a b.png\ncomment TextureFile c.png\n";
        let soup = file(head, face, &faces.map(str::to_owned));
        assert_eq!(soup.polygon_materials, [1, 0, NONE]);
        let names: Vec<_> = soup.materials.iter().map(|material| material.texture.clone().unwrap()).collect();
        assert_eq!(names, [PathBuf::from("a b.png"), "c.png".into()]);
        let last = soup.corners[5];
        assert_eq!((last.position, soup.texture_coordinates[last.texture as usize]), (3, Vec2::new(0.0, 0.5)));
        assert_eq!(soup.corners[6].texture, NONE, "a face without coordinates");
    }
}
