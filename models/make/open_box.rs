//! An open box: five walls without thickness and no lid.
//!
//! Out: eight shared corners and ten triangles that face outward, so the four
//! upper edges are boundaries and the other eight are creases.

use crate::mesh::Mesh;
use crate::obj::{Model, Part, Shading};
use crate::vector::v;

pub fn model() -> Model {
    let (half_width, height, half_depth) = (1.0, 1.2, 0.8);
    let mut mesh = Mesh::default();
    for y in [0.0, height] {
        for (x, z) in [(-1.0, 1.0), (1.0, 1.0), (1.0, -1.0), (-1.0, -1.0)] {
            mesh.add(v(x * half_width, y, z * half_depth));
        }
    }
    mesh.quad([3, 2, 1, 0]);
    for side in 0..4 {
        let next = (side + 1) % 4;
        mesh.quad([side, next, next + 4, side + 4]);
    }
    Model {
        name: "open-box",
        title: "An open box: zero-thickness walls, 4 boundary edges and 8 creases.",
        parts: vec![Part {
            name: "open-box".to_owned(),
            material: None,
            shading: Shading::Unstated,
            closed: false,
            mesh,
        }],
    }
}
