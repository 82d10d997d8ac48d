//! The map of the cartoon styles: how normals and depth are stored between the passes (errata E6 to E8).

use super::gradients::VertexLists;
use crate::plan::{Attachment, Attachments, Format, Paint, Program, SettingValue, Target, Texture, TextureName};
use crate::scene::{Object, Scene};
use crate::settings::Setting;
use std::collections::HashMap;
use std::sync::Arc;

tinta_geometry::choices! {
    /// How normals and depth are stored.
    #[derive(Default)]
    pub enum MapEncoding {
        /// Normals clamped to [0, 1], depth in the 8 bits of alpha: the listing's.
        #[default]
        Published = "paper",
        /// Normals as 0.5 n + 0.5, depth in 8 bits.
        Biased = "biased",
        /// Both unencoded, 16 bits each, in a floating-point target.
        Float16 = "float16",
        /// The same with 32 bits.
        Float = "float",
        /// Normals as 0.5 n + 0.5, depth from a copy of the depth buffer.
        DepthTexture = "depth-texture",
        /// Normals as 0.5 n + 0.5 and, instead of depth, a number for each part and material of an object: the map of Mitchell 2002,
        /// whose filter sees where two objects touch.
        Numbers = "numbers",
    }
}

impl MapEncoding {
    /// The setting's help text.
    pub(super) const HELP: &'static str = "Storage of normals and depth: paper, biased (0.5 n + 0.5), float16, float, \
         depth-texture (biased, depth from the depth buffer), numbers (biased, parts' numbers instead of depth); mrt has paper only";

    /// Returns the shaders that write it.
    pub(super) fn program(self) -> Program {
        let (vertex, fragment) = match self {
            Self::Published => ("evangelista/map.vert", "evangelista/map.frag"),
            Self::Biased | Self::DepthTexture => ("improved/map-biased.vert", "evangelista/map.frag"),
            Self::Float16 | Self::Float => ("improved/map-float.vert", "improved/map-float.frag"),
            Self::Numbers => ("improved/map-numbers.vert", "improved/map-numbers.frag"),
        };
        Program::new(vertex, [fragment])
    }

    /// The paint of a scene's objects.
    pub(super) fn paint(self, scene: &Scene) -> Paint {
        if self == Self::Numbers { Paint::Colors(numbers(scene)) } else { Paint::Materials }
    }

    /// The map's value for a pixel that neither object nor square covers: no normal, farthest depth.
    pub(super) fn empty(self) -> [f32; 4] {
        match self {
            Self::Published | Self::Float16 | Self::Float => [0.0, 0.0, 0.0, 1.0],
            Self::Biased | Self::DepthTexture | Self::Numbers => [0.5, 0.5, 0.5, 1.0],
        }
    }

    /// The map's value under the background square: its normal in eye space, and the depth of the far plane.
    pub(super) fn background(self) -> [f32; 4] {
        match self {
            Self::Published | Self::Float16 | Self::Float => [0.0, 0.0, 1.0, 1.0],
            Self::Biased | Self::DepthTexture | Self::Numbers => [0.5, 0.5, 1.0, 1.0],
        }
    }

    /// The target that the map is written into.
    pub(super) fn target(self, map_target: MapTarget) -> Target {
        match self {
            Self::Float16 => Target::Textures(&FLOAT16_MAP),
            Self::Float => Target::Textures(&FLOAT_MAP),
            Self::Published | Self::Biased | Self::DepthTexture | Self::Numbers => map_target.target(),
        }
    }

    /// Returns the textures that a filter reads it from.
    pub(super) fn textures(self, map_target: MapTarget) -> Vec<(&'static str, Texture)> {
        let mut textures = vec![("borderMap", map_texture(self.target(map_target)))];
        if self == Self::DepthTexture {
            textures.push(("depthMap", Texture::DepthMap));
        }
        textures
    }

    /// The fragment shader that lets a filter read the map.
    pub(super) fn shader(self) -> &'static str {
        match self {
            Self::Published | Self::Float16 | Self::Float => "evangelista/texel-map.frag",
            Self::Biased | Self::Numbers => "improved/texel-biased.frag",
            Self::DepthTexture => "improved/texel-depth-texture.frag",
        }
    }

    /// Returns the smallest step of its depths.
    pub(super) fn depth_step(self) -> f32 {
        match self {
            Self::Published | Self::Biased | Self::Numbers => 1.0 / 255.0,
            // The last of 11 binary digits between 0.5 and 1, where most of a scene's window depth lies.
            Self::Float16 => 1.0 / 2048.0,
            Self::Float | Self::DepthTexture => 1.0 / 16_777_216.0,
        }
    }
}

/// White, with a number as alpha for each part and material of an object: neighbours differ much, and none has the background's 1.
fn numbers(scene: &Scene) -> VertexLists<[f32; 4]> {
    let mut first = 0;
    // Copies with the same numbers share their list.
    let mut known = HashMap::new();
    let list = |object: &Object| {
        let (list, count) = known.entry((Arc::as_ptr(&object.mesh), first % NUMBERS)).or_insert_with(|| {
            let (arrays, mut numbers) = (scene.arrays(object), HashMap::new());
            let mut colors = vec![[1.0; 4]; arrays.vertices.len()];
            for (face, corners) in arrays.order.iter().zip(arrays.indices.as_chunks::<3>().0) {
                let next = first + numbers.len();
                let number = *numbers.entry(object.mesh.part_and_material(*face as usize)).or_insert(next);
                corners
                    .iter()
                    .for_each(|corner| colors[*corner as usize][3] = (number * STEP % NUMBERS) as f32 / 255.0);
            }
            (Arc::new(colors), numbers.len())
        });
        first += *count;
        list.clone()
    };
    Arc::new(scene.objects.iter().map(list).collect())
}

/// The numbers that 8 bits hold beside the background's.
const NUMBERS: usize = 255;

/// The step from a number to the next: prime to their count, so all of them come before one is repeated.
const STEP: usize = 38;

tinta_geometry::choices! {
    /// How the map gets from the pass that draws it to the one that reads it.
    #[derive(Default)]
    pub enum MapTarget {
        /// Drawn into the framebuffer and copied into a texture: the listing's.
        #[default]
        Copy = "copy",
        /// Drawn into a texture by a framebuffer object; maps in floating point always are.
        Texture = "texture",
    }
}

impl MapTarget {
    /// Returns the setting of a style that has one.
    pub(super) fn setting<T: Clone + 'static>(field: fn(&mut T) -> &mut Self) -> Setting<T> {
        let help = "Copy the map into its texture (copy) or draw it there with a framebuffer object (texture); \
                    pictures differ by rounding only; mrt always draws it there";
        Setting::field("map-target", "HOW", help, field)
    }

    /// The target of a map with 8 bits per channel.
    pub(super) fn target(self) -> Target {
        match self {
            Self::Copy => Target::Framebuffer,
            Self::Texture => Target::Textures(&MAP),
        }
    }
}

/// The texture that holds a map drawn into this target.
pub(super) fn map_texture(target: Target) -> Texture {
    match target {
        Target::Framebuffer => Texture::BorderMap,
        Target::Textures(_) => Texture::Drawn(MAP_TEXTURE),
    }
}

/// Normals and depth.
pub(super) const MAP_TEXTURE: TextureName = TextureName("Map");

const MAP: Attachments = Attachments {
    colors: &[Attachment { name: MAP_TEXTURE, format: Format::Unorm8 }],
    has_depth: true,
    asked_by: SettingValue { setting: "map-target", value: "texture" },
    instead: SettingValue { setting: "map-target", value: "copy" },
    instead_draws: None,
};

const FLOAT16_MAP: Attachments = Attachments {
    colors: &[Attachment { name: MAP_TEXTURE, format: Format::Float16 }],
    has_depth: true,
    asked_by: SettingValue { setting: "map-encoding", value: "float16" },
    instead: SettingValue { setting: "map-encoding", value: "biased" },
    instead_draws: None,
};

const FLOAT_MAP: Attachments = Attachments {
    colors: &[Attachment { name: MAP_TEXTURE, format: Format::Float32 }],
    asked_by: SettingValue { setting: "map-encoding", value: "float" },
    ..FLOAT16_MAP
};

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::{LoadOptions, read_bytes};
    use crate::scene::SceneSettings;
    use std::collections::BTreeSet;

    /// A row of so many flush squares, each a part and of a material of its own where asked.
    fn row(count: usize, has_parts: bool, has_materials: bool, copies: u32) -> Scene {
        let (mut model, mut materials) = ("mtllib m.mtl\n".to_owned(), String::new());
        for number in 0..=count {
            model += &format!("v {number} 0 0\nv {number} 1 0\n");
        }
        for number in 0..count {
            let [a, b, c, d] = [1, 3, 4, 2].map(|corner| corner + number * 2);
            let part = if has_parts { format!("o part{number}\n") } else { String::new() };
            let material = if has_materials { format!("usemtl m{number}\n") } else { String::new() };
            model += &format!("{part}{material}f {a} {b} {c} {d}\n");
            materials += &format!("newmtl m{number}\nKd 1 0 0\n");
        }
        let beside: [(&str, &[u8]); 1] = [("m.mtl", materials.as_bytes())];
        let mesh = read_bytes(model.as_bytes(), "row.obj", &beside, &LoadOptions::default()).unwrap().mesh;
        Scene::new([mesh], &SceneSettings { copies, ..SceneSettings::default() }).unwrap()
    }

    /// The numbers of each object's faces, in drawing order, in 1/255.
    fn of_faces(scene: &Scene) -> Vec<Vec<u8>> {
        let lists = numbers(scene);
        let of_object = |(object, list): (&Object, &Arc<Vec<[f32; 4]>>)| {
            let face = |corners: &[u32]| {
                let numbers: Vec<u8> = corners.iter().map(|it| (list[*it as usize][3] * 255.0).round() as u8).collect();
                assert!(numbers.windows(2).all(|pair| pair[0] == pair[1]), "a face has one number");
                numbers[0]
            };
            scene.arrays(object).indices.chunks(3).map(face).collect()
        };
        scene.objects.iter().zip(lists.iter()).map(of_object).collect()
    }

    #[test]
    fn each_part_and_material_has_its_number_until_all_are_used() {
        let distinct = |scene: &Scene| of_faces(scene).concat().into_iter().collect::<BTreeSet<u8>>();
        for (has_parts, has_materials) in [(true, false), (false, true), (true, true)] {
            for count in [1, 2, 16, 255, 300] {
                let found = distinct(&row(count, has_parts, has_materials, 1));
                assert_eq!(found.len(), count.min(255), "{count} {has_parts} {has_materials}");
                assert!(!found.contains(&255), "which is the background's");
            }
        }
        assert_eq!(distinct(&row(3, false, false, 1)).len(), 1, "one surface has one number");
        assert_eq!(distinct(&row(3, true, false, 5)).len(), 15, "copies are objects, too");
        assert_eq!(distinct(&row(2, true, false, 200)).len(), 255);
    }
}
