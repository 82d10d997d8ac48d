//! The ramp texture of the text's section "Painting": gradients of a few flat tones, one a row, looked up by the light.

use crate::error::{Error, ParseError, Result};
use crate::mesh::VertexArrays;
use crate::picture::Picture;
use crate::scene::{Color, Object, Scene, Size};
use crate::settings::{Kind, Problem, Value};
use glam::{DVec3, Vec3};
use serde::{Serialize, Serializer};
use std::path::{Path, PathBuf};
use std::str::FromStr;
use std::sync::{Arc, LazyLock};

/// Rows of a ramp: as many as the text's picture has.
pub const ROWS: u32 = 4;

/// The direction towards the light, eye space, before it is given length 1: the listing's.
const LIGHT_DIRECTION: DVec3 = DVec3::new(0.0, 1.0, 1.0);

/// Light in which a gradient shows its base colour.
const MIDDLING_LIGHT: f32 = 0.6;

/// What the listing clamps the light to.
const LIGHT_RANGE: [f32; 2] = [0.1, 0.9];

/// A picture of four gradients one above the other, dark at the left.
#[derive(Debug, Clone, PartialEq)]
pub struct Ramp {
    /// The picture; each quarter of its height is a gradient, the first at the top.
    pub picture: Arc<Picture>,
    /// The file it came from; `None` for the built-in one.
    pub path: Option<PathBuf>,
}

impl Default for Ramp {
    /// Four gradients of three tones, our own.
    fn default() -> Self {
        static BUILT_IN: LazyLock<Arc<Picture>> = LazyLock::new(|| Arc::new(built_in()));
        Self { picture: BUILT_IN.clone(), path: None }
    }
}

impl Ramp {
    /// Reads a picture.
    ///
    /// # Errors
    ///
    /// [`Error::Picture`] when it cannot be read or is lower than its gradients are many.
    pub fn read(path: &Path) -> Result<Self> {
        Self::of(Picture::read(path)?, path)
    }

    /// A picture's bytes as a ramp; `name` is for messages.
    ///
    /// # Errors
    ///
    /// Those of [`Ramp::read`].
    pub fn from_bytes(bytes: &[u8], name: &str) -> Result<Self> {
        Self::of(Picture::from_bytes(bytes, name)?, Path::new(name))
    }

    fn of(picture: Picture, path: &Path) -> Result<Self> {
        if picture.size.height < ROWS {
            return Err(Error::Picture {
                path: path.display().to_string(),
                problem: format!(
                    "a ramp has {ROWS} gradients one above the other; make it at least {ROWS} pixels high"
                ),
            });
        }
        Ok(Self { picture: Arc::new(picture), path: Some(path.to_path_buf()) })
    }
}

impl Ramp {
    /// The row whose colour in middling light is nearest.
    fn nearest_row(&self, color: Color) -> u32 {
        let Size { width, height } = self.picture.size;
        let distance = |row: &u32| {
            let y = (row * 2 + 1) * height / (ROWS * 2);
            let pixel = self.picture.pixel((MIDDLING_LIGHT * width as f32) as i64, y.into());
            let squares = pixel.iter().zip(color.0).map(|(a, b)| (f32::from(*a) / 255.0 - b).powi(2));
            squares.sum::<f32>()
        };
        (0..ROWS).min_by(|a, b| distance(a).total_cmp(&distance(b))).unwrap_or_default()
    }
}

/// What the built-in ramp is called.
const BUILT_IN: &str = "built-in";

impl Value for Ramp {
    fn kind() -> Kind {
        Kind::File
    }

    /// A ramp that is from no file has none.
    fn text(&self) -> String {
        match &self.path {
            Some(path) => path.to_string_lossy().into_owned(),
            None if *self == Self::default() => BUILT_IN.to_owned(),
            None => String::new(),
        }
    }

    fn parse(text: &str) -> std::result::Result<Self, Problem> {
        Ok(if text == BUILT_IN { Self::default() } else { Self::read(Path::new(text))? })
    }
}

impl Serialize for Ramp {
    fn serialize<S: Serializer>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error> {
        serializer.serialize_str(&self.text())
    }
}

impl Value for RampRow {
    fn kind() -> Kind {
        Kind::Choice(vec!["material", "object", "0", "1", "2", "3"])
    }

    fn text(&self) -> String {
        match self {
            Self::Material => "material".to_owned(),
            Self::Object => "object".to_owned(),
            Self::Row(row) => row.to_string(),
        }
    }

    fn parse(text: &str) -> std::result::Result<Self, Problem> {
        Ok(text.parse()?)
    }
}

/// Which gradient a surface gets.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum RampRow {
    /// Each material the one nearest to its colour; without a colour the first.
    #[default]
    Material,
    /// Each object the next one.
    Object,
    /// This one for all, 0 to 3.
    Row(u8),
}

impl FromStr for RampRow {
    type Err = ParseError;

    fn from_str(text: &str) -> std::result::Result<Self, ParseError> {
        match text {
            "material" => Ok(Self::Material),
            "object" => Ok(Self::Object),
            _ => text
                .parse()
                .ok()
                .filter(|row| u32::from(*row) < ROWS)
                .map(Self::Row)
                .ok_or_else(|| format!("choose material, object, or a row from 0 to {}", ROWS - 1).into()),
        }
    }
}

impl RampRow {
    /// The row of a surface.
    fn of(self, scene: &Scene, ramp: &Ramp, object: usize, material: u32) -> u32 {
        match self {
            Self::Object => (object % ROWS as usize) as u32,
            Self::Row(row) => u32::from(row) % ROWS,
            Self::Material => {
                let mesh = &scene.objects[object].mesh;
                let given = mesh.materials.get(material as usize).and_then(|material| material.color.map(Color));
                let color = if scene.recolor { Some(scene.color) } else { given };
                color.map_or(0, |color| ramp.nearest_row(color))
            }
        }
    }
}

/// The texture coordinate of a row.
fn coordinate(row: u32) -> f32 {
    // The picture's top is at 1.
    1.0 - (row as f32 + 0.5) / ROWS as f32
}

/// The texture coordinates of all objects' vertices: light, where it is `lit` here, and row.
pub fn coordinates(scene: &Scene, ramp: &Ramp, row: RampRow, lit: bool) -> Arc<Vec<Arc<Vec<[f32; 2]>>>> {
    // The listing turns every normal into eye space by the inverse of a modelview it takes for rigid (errata D7); turning
    // the light the other way once comes to the same.
    let view = scene.camera.view_from_world();
    let light = view.transpose().transform_vector3(LIGHT_DIRECTION.normalize()).as_vec3();
    let mut lists: Vec<Arc<Vec<[f32; 2]>>> = Vec::with_capacity(scene.objects.len());
    for (number, object) in scene.objects.iter().enumerate() {
        // Copies of a mesh stand the same way in the light.
        let is_copy = |earlier: &Object| Arc::ptr_eq(&earlier.mesh, &object.mesh);
        let same = (row != RampRow::Object).then(|| scene.objects[..number].iter().position(is_copy)).flatten();
        let list = match same {
            Some(earlier) => lists[earlier].clone(),
            None => {
                let row = |material| coordinate(row.of(scene, ramp, number, material));
                Arc::new(of_object(scene.arrays(object), light, lit, row))
            }
        };
        lists.push(list);
    }
    Arc::new(lists)
}

fn of_object(arrays: &VertexArrays, light: Vec3, lit: bool, row: impl Fn(u32) -> f32) -> Vec<[f32; 2]> {
    let rows: Vec<f32> = arrays.parts.iter().map(|part| row(part.material)).collect();
    let first_row = rows.first().copied().unwrap_or_default();
    let brightness = |[_, _, _, x, y, z]: &[f32; 6]| {
        if lit { light.dot(Vec3::new(*x, *y, *z)).clamp(LIGHT_RANGE[0], LIGHT_RANGE[1]) } else { 0.0 }
    };
    let mut list: Vec<[f32; 2]> = arrays.vertices.iter().map(|vertex| [brightness(vertex), first_row]).collect();
    for (part, row) in arrays.parts.iter().zip(&rows).filter(|(_, row)| **row != first_row) {
        for index in &arrays.indices[part.first as usize..][..part.count as usize] {
            list[*index as usize][1] = *row;
        }
    }
    list
}

/// Base colours of the built-in gradients: clay, rust, umber, slate.
const BASES: [[f32; 3]; ROWS as usize] =
    [[0.93, 0.74, 0.52], [0.80, 0.36, 0.24], [0.60, 0.49, 0.38], [0.46, 0.58, 0.72]];

/// Light from which the base colour and the highlight hold.
const TONES_FROM: [f32; 2] = [0.45, 0.82];

fn built_in() -> Picture {
    let size = Size { width: 256, height: 64 };
    let pixel = |base: &[f32; 3], x: u32| {
        let light = (x as f32 + 0.5) / size.width as f32;
        let tone = |channel: f32| match light {
            light if light < TONES_FROM[0] => channel * 0.62,
            light if light < TONES_FROM[1] => channel,
            _ => channel + (1.0 - channel) * 0.55,
        };
        let [red, green, blue] = base.map(|channel| (tone(channel) * 255.0).round() as u8);
        [red, green, blue, u8::MAX]
    };
    // All lines of a gradient are the same.
    let gradient = |base| -> Vec<u8> {
        let line: Vec<u8> = (0..size.width).flat_map(|x| pixel(base, x)).collect();
        line.repeat((size.height / ROWS) as usize)
    };
    Picture { size, pixels: BASES.iter().flat_map(gradient).collect() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::{Mesh, NONE};
    use crate::scene::SceneSettings;

    #[test]
    fn the_built_in_ramp_has_four_gradients_of_three_tones() {
        let Ramp { picture, .. } = Ramp::default();
        let mut all = std::collections::HashSet::new();
        for row in 0..ROWS {
            let y = i64::from(row * picture.size.height / ROWS + 3);
            let tones: std::collections::HashSet<[u8; 4]> =
                (0..i64::from(picture.size.width)).map(|x| picture.pixel(x, y)).collect();
            assert_eq!(tones.len(), 3);
            all.extend(tones);
        }
        assert_eq!(all.len(), 12);
    }

    #[test]
    fn rows_are_chosen_by_colour_object_or_number() {
        let ramp = Ramp::default();
        for (row, base) in BASES.iter().enumerate() {
            assert_eq!(ramp.nearest_row(Color(*base)), row as u32);
        }
        let scene = Scene::new(vec![Arc::new(Mesh::triangle())], &SceneSettings::default()).unwrap();
        assert_eq!(RampRow::Material.of(&scene, &ramp, 0, NONE), 0);
        assert_eq!(RampRow::Object.of(&scene, &ramp, 5, 0), 1);
        assert_eq!([coordinate(0), coordinate(3)], [0.875, 0.125]);
        assert_eq!("2".parse(), Ok(RampRow::Row(2)));
        assert!("4".parse::<RampRow>().is_err());
    }

    #[test]
    fn the_light_is_the_listings_formula_in_eye_space() {
        let scene = Scene::new(vec![Arc::new(Mesh::triangle())], &SceneSettings::default()).unwrap();
        let lists = coordinates(&scene, &Ramp::default(), RampRow::Material, true);
        let normal = scene.camera.view_from_world().transform_vector3(DVec3::Z);
        let expected = normal.dot(DVec3::new(0.0, 1.0, 1.0).normalize()).clamp(0.1, 0.9) as f32;
        assert_eq!(lists[0].len(), 3);
        assert!(lists[0].iter().all(|[light, _]| (light - expected).abs() < 1e-6), "{lists:?} {expected}");
    }
}
