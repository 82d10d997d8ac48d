//! The light that an MTL material emits: `Ke` and `map_Ke`.

use crate::mesh::{Material, left_out};

/// The light that a material emits.
#[derive(Default)]
pub(super) struct Emission {
    /// Red, green and blue in [0, 1].
    pub color: [f32; 3],
    pub has_picture: bool,
    /// Whether it is drawn as the material's colour.
    is_color: bool,
}

impl Emission {
    /// Makes it the colour of a material that is black and has no picture.
    pub(super) fn put_on(&mut self, material: &mut Material) {
        self.is_color = self.color != [0.0; 3] && material.color == Some([0.0; 3]) && !material.has_texture();
        if self.is_color {
            material.color = Some(self.color);
        }
    }

    /// The remark on all of them, if any emits light.
    pub(super) fn remark<'a>(path: &str, all: impl Iterator<Item = &'a Self>) -> Option<String> {
        let (mut of_black, mut of_others) = (0, 0);
        for one in all {
            of_black += usize::from(one.is_color);
            of_others += usize::from(!one.is_color && (one.has_picture || one.color != [0.0; 3]));
        }
        let parts: Vec<String> = left_out::emission(of_black, of_others).collect();
        (!parts.is_empty()).then(|| format!("{path}: not drawn: {}", parts.join(", ")))
    }
}

#[cfg(test)]
mod tests {
    use crate::LoadOptions;
    use crate::mesh::read_bytes;

    #[test]
    fn light_that_a_black_material_emits_is_its_colour_and_other_light_is_said() {
        let as_color = "t.obj: not drawn: 1 black material's emission as light (drawn as its colour)";
        let said = "t.obj: not drawn: 1 material's emission";
        for (statements, color, remark) in [
            ("Kd 0 0 0\nKe 1 0 0", Some([1.0, 0.0, 0.0]), as_color),
            ("Ke 0.5\nKd 0 0 0", Some([0.5; 3]), as_color),
            ("Kd 0 0 0\nKe 7 0 -1", Some([1.0, 0.0, 0.0]), as_color),
            ("Kd 0 0 0\nKe 0 0 0", Some([0.0; 3]), ""),
            ("Kd 0 0 0\nKe nan", Some([0.0; 3]), ""),
            ("Kd 0 0 1\nKe 1 0 0", Some([0.0, 0.0, 1.0]), said),
            ("Ke 1 0 0", None, said),
            ("Kd 0 0 1\nmap_Ke light.png", Some([0.0, 0.0, 1.0]), said),
        ] {
            let text = "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\n";
            let materials = format!("newmtl a\n{statements}\n");
            let beside: [(&str, &[u8]); 1] = [("m.mtl", materials.as_bytes())];
            let loaded = read_bytes(text.as_bytes(), "t.obj", &beside, &LoadOptions::default()).unwrap();
            assert_eq!(loaded.mesh.materials[0].color, color, "{statements}");
            assert_eq!(loaded.remarks.join(" "), remark, "{statements}");
        }
    }
}
