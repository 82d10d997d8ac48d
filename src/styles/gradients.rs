//! The ramp's gradient for each surface of a scene, and the brightness of its vertices: the texture coordinates of the text's
//! section "Painting".

use super::ramp::{Ramp, RampRow, WIDTH, gradient};
use crate::mesh::VertexArrays;
use crate::picture::Picture;
use crate::scene::{Color, Object, Scene, Size};
use glam::{DVec3, Vec3};
use std::collections::BTreeSet;
use std::sync::Arc;

/// The direction towards the light, eye space, before normalisation: the listing's.
const LIGHT_DIRECTION: DVec3 = DVec3::new(0.0, 1.0, 1.0);

/// The range that the listing clamps the light to.
const LIGHT_RANGE: [f32; 2] = [0.1, 0.9];

/// The gradients of a ramp, and their assignment to a scene's surfaces.
pub(super) struct Gradients<'a> {
    scene: &'a Scene,
    ramp: &'a Ramp,
    row: RampRow,
    /// With the materials' own gradients: their base colours, from the top, and the picture they make.
    own: Option<(Vec<[u8; 3]>, Arc<Picture>)>,
}

impl<'a> Gradients<'a> {
    pub(super) fn new(scene: &'a Scene, ramp: &'a Ramp, row: RampRow) -> Self {
        Self { scene, ramp, row, own: (row == RampRow::Own).then(|| own_gradients(scene)) }
    }

    /// Returns the picture that holds them.
    pub(super) fn picture(&self) -> &Arc<Picture> {
        self.own.as_ref().map_or(&self.ramp.picture, |(_, picture)| picture)
    }

    /// Returns their number.
    fn count(&self) -> u32 {
        self.own.as_ref().map_or(self.ramp.rows, |(bases, _)| bases.len() as u32)
    }

    /// The row of a surface.
    fn row(&self, object: usize, material: u32) -> u32 {
        let mesh = || &self.scene.objects[object].mesh;
        match self.row {
            RampRow::Object => (object % self.ramp.rows as usize) as u32,
            RampRow::Row(row) => u32::from(row) % self.ramp.rows,
            RampRow::Material => {
                let given = mesh().materials.get(material as usize).and_then(|material| material.color.map(Color));
                let color = if self.scene.recolor { Some(self.scene.color) } else { given };
                color.map_or(0, |color| self.ramp.nearest_row(color))
            }
            RampRow::Own => {
                let base = bytes(self.scene.material_color(mesh(), material));
                let bases = self.own.iter().flat_map(|(bases, _)| bases);
                bases.zip(0..).find(|(known, _)| **known == base).map_or(0, |(_, row)| row)
            }
        }
    }

    /// Returns the texture coordinate of a surface's row.
    pub(super) fn coordinate(&self, object: usize, material: u32) -> f32 {
        // The picture's top is at 1.
        1.0 - (self.row(object, material) as f32 + 0.5) / self.count() as f32
    }

    /// Returns GL's colour at a texture coordinate: red, green, blue.
    pub(super) fn texel(&self, [light, row]: [f32; 2]) -> [u8; 3] {
        let Size { width, height } = self.picture().size;
        let from_bottom = (row * height as f32) as i64;
        let [red, green, blue, _] =
            self.picture().pixel((light * width as f32) as i64, i64::from(height) - 1 - from_bottom);
        [red, green, blue]
    }

    /// Returns the texture coordinates of all objects' vertices: the light, if it is `lit` here, and the row.
    pub(super) fn coordinates(&self, lit: bool) -> VertexLists<[f32; 2]> {
        let light = Light::of(self.scene);
        self.of_objects(|number, object| {
            let row = |material| self.coordinate(number, material);
            Arc::new(of_object(self.scene.arrays(object), light, lit, row))
        })
    }

    /// Returns one value for each object; copies with the same orientation to the light share theirs.
    pub(super) fn of_objects<T: Clone>(&self, make: impl Fn(usize, &Object) -> T) -> Arc<Vec<T>> {
        let objects = &self.scene.objects;
        Arc::new(match self.row {
            RampRow::Object => objects.iter().enumerate().map(|(number, object)| make(number, object)).collect(),
            _ => self.scene.of_meshes(make),
        })
    }
}

/// Makes a gradient for each colour of a scene's materials: the colours in order, and a row of pixels for each.
fn own_gradients(scene: &Scene) -> (Vec<[u8; 3]>, Arc<Picture>) {
    let mut bases = BTreeSet::new();
    for object in &scene.objects {
        let parts = scene.arrays(object).parts.iter();
        bases.extend(parts.map(|part| bytes(scene.material_color(&object.mesh, part.material))));
    }
    let bases: Vec<[u8; 3]> = bases.into_iter().collect();
    let gradients: Vec<u8> =
        bases.iter().flat_map(|base| gradient(base.map(|channel| f32::from(channel) / 255.0))).collect();
    let size = Size { width: WIDTH, height: bases.len() as u32 };
    (bases, Arc::new(Picture { size, pixels: gradients }))
}

/// A colour in 1/255.
fn bytes(Color(channels): Color) -> [u8; 3] {
    channels.map(|channel| (channel * 255.0).round() as u8)
}

/// A list for each object, with an entry for each of its vertices.
pub(super) type VertexLists<T> = Arc<Vec<Arc<Vec<T>>>>;

/// The text's light.
#[derive(Clone, Copy)]
pub(super) struct Light {
    /// The direction towards the light, world space.
    direction: Vec3,
}

impl Light {
    /// Returns the light of a scene, which is fixed in eye space.
    pub(super) fn of(scene: &Scene) -> Self {
        // The listing turns every normal into eye space by the inverse of a modelview it assumes rigid (errata D7). Turning the
        // light the other way once is equivalent.
        let world_from_view = scene.camera.view_from_world().transpose();
        Self { direction: world_from_view.transform_vector3(LIGHT_DIRECTION.normalize()).as_vec3() }
    }

    /// Returns a surface's brightness from its normal in world space: 0.1 to 0.9.
    pub(super) fn on(self, normal: Vec3) -> f32 {
        self.direction.dot(normal).clamp(LIGHT_RANGE[0], LIGHT_RANGE[1])
    }
}

fn of_object(arrays: &VertexArrays, light: Light, lit: bool, row: impl Fn(u32) -> f32) -> Vec<[f32; 2]> {
    let rows: Vec<f32> = arrays.parts.iter().map(|part| row(part.material)).collect();
    let first_row = rows.first().copied().unwrap_or_default();
    let brightness = |[_, _, _, x, y, z]: &[f32; 6]| if lit { light.on(Vec3::new(*x, *y, *z)) } else { 0.0 };
    let mut list: Vec<[f32; 2]> = arrays.vertices.iter().map(|vertex| [brightness(vertex), first_row]).collect();
    for (part, row) in arrays.parts.iter().zip(&rows).filter(|(_, row)| **row != first_row) {
        for index in &arrays.indices[part.first as usize..][..part.count as usize] {
            list[*index as usize][1] = *row;
        }
    }
    list
}

#[cfg(test)]
mod tests {
    use super::super::ramp::MIDDLING_LIGHT;
    use super::*;
    use crate::mesh::{Mesh, NONE};
    use crate::scene::SceneSettings;

    #[test]
    fn rows_are_chosen_by_material_object_or_number() {
        let ramp = Ramp::default();
        let scene = Scene::new(vec![Arc::new(Mesh::triangle())], &SceneSettings::default()).unwrap();
        let gradients = |row| Gradients::new(&scene, &ramp, row);
        assert_eq!(gradients(RampRow::Material).row(0, NONE), 0);
        assert_eq!(gradients(RampRow::Object).row(5, 0), 1);
        assert_eq!([0, 3].map(|row| gradients(RampRow::Row(row)).coordinate(0, NONE)), [0.875, 0.125]);
    }

    #[test]
    fn a_texel_is_that_of_its_row_and_column_and_beyond_the_picture_that_at_its_edge() {
        // Each pixel encodes its place.
        let size = Size { width: 10, height: 8 };
        let pixel = |place: u32| [(place % 10) as u8, (place / 10) as u8, 7, 255];
        let picture = Picture { size, pixels: (0..80).flat_map(pixel).collect() };
        let ramp = Ramp { picture: Arc::new(picture), rows: 4, path: None };
        let scene = Scene::new(vec![Arc::new(Mesh::triangle())], &SceneSettings::default()).unwrap();
        let gradients = |row| Gradients::new(&scene, &ramp, RampRow::Row(row));
        for row in 0..4 {
            let coordinate = gradients(row).coordinate(0, NONE);
            assert_eq!(gradients(row).texel([0.45, coordinate])[0], 4);
            let expected = [2 * row, 2 * row + 1];
            assert!(expected.contains(&gradients(row).texel([0.45, coordinate])[1]), "row {row}");
        }
        assert_eq!(gradients(0).texel([1.0, 1.0]), [9, 0, 7]);
        assert_eq!(gradients(0).texel([0.0, 0.0]), [0, 7, 7]);
    }

    #[test]
    fn each_materials_colour_gets_a_gradient_of_its_own() {
        let mesh = crate::mesh::load("builtin:bust", &crate::mesh::LoadOptions::default()).unwrap().mesh;
        let colors: BTreeSet<[u8; 3]> =
            mesh.materials.iter().filter_map(|material| material.color.map(|color| bytes(Color(color)))).collect();
        let settings = SceneSettings { copies: 2, ..SceneSettings::default() };
        let scene = Scene::new(vec![Arc::new(mesh)], &settings).unwrap();
        let ramp = Ramp::default();
        let gradients = Gradients::new(&scene, &ramp, RampRow::Own);
        assert_eq!(gradients.count() as usize, colors.len());
        for part in &scene.arrays(&scene.objects[1]).parts {
            let base = bytes(scene.material_color(&scene.objects[1].mesh, part.material));
            let row = gradients.coordinate(1, part.material);
            let [shadow, middle, highlight] = [0.1, MIDDLING_LIGHT, 0.9].map(|light| gradients.texel([light, row]));
            assert_eq!(middle, base);
            assert!((0..3).all(|channel| shadow[channel] <= base[channel] && base[channel] <= highlight[channel]));
        }
        // One colour for all gives one gradient.
        let red = SceneSettings { color: Some(Color([1.0, 0.0, 0.0])), ..settings };
        let scene = Scene::new(vec![scene.objects[0].mesh.clone()], &red).unwrap();
        let gradients = Gradients::new(&scene, &ramp, RampRow::Own);
        assert_eq!((gradients.count(), gradients.texel([MIDDLING_LIGHT, 0.5])), (1, [255, 0, 0]));
    }

    #[test]
    fn the_light_is_the_listings_formula_in_eye_space() {
        let scene = Scene::new(vec![Arc::new(Mesh::triangle())], &SceneSettings::default()).unwrap();
        let lists = Gradients::new(&scene, &Ramp::default(), RampRow::Material).coordinates(true);
        let normal = scene.camera.view_from_world().transform_vector3(DVec3::Z);
        let expected = normal.dot(DVec3::new(0.0, 1.0, 1.0).normalize()).clamp(0.1, 0.9) as f32;
        assert_eq!(lists[0].len(), 3);
        assert!(lists[0].iter().all(|[light, _]| (light - expected).abs() < 1e-6), "{lists:?} {expected}");
    }
}
