//! The portrait bust: polygonises the sculpted fields and thins the meshes.
//!
//! In: the fields of `face.rs`, `hair.rs` and `clothes.rs`, centimetres. Out:
//! closed overlapping parts, one per material and kind, in decimetres with
//! the socle on y = 0.

use crate::clothes;
use crate::decimate::decimate;
use crate::face::{self, Face};
use crate::hair;
use crate::mesh::Mesh;
use crate::obj::{Material, Model, Part, Shading};
use crate::polygonise::{Grid, gradient, polygonise};
use crate::vector::{Vec3, v};

/// Decimetres a centimetre.
const SCALE: f64 = 0.1;

const SKIN: Material = material("skin", [0.93, 0.77, 0.64]);
const LIP: Material = material("lip", [0.82, 0.56, 0.49]);
const LIP_LINE: Material = material("lip-line", [0.50, 0.30, 0.27]);
const HAIR: Material = material("hair", [0.60, 0.50, 0.42]);
const BROW: Material = material("brow", [0.45, 0.36, 0.30]);
const EYE: Material = material("eye", [0.96, 0.95, 0.91]);
const IRIS: Material = material("iris", [0.28, 0.20, 0.16]);
const COAT: Material = material("coat", [0.40, 0.52, 0.62]);
const LAPEL: Material = material("lapel", [0.33, 0.43, 0.53]);
const WAISTCOAT: Material = material("waistcoat", [0.80, 0.69, 0.48]);
const LINEN: Material = material("linen", [0.96, 0.94, 0.88]);
const BRASS: Material = material("brass", [0.88, 0.76, 0.42]);
const STONE: Material = material("stone", [0.79, 0.78, 0.74]);

const fn material(name: &'static str, colour: [f64; 3]) -> Material {
    Material { name, colour }
}

/// Cosines of the angles past which an edge stays sharp: on flesh and loose
/// cloth, and on cut stuff.
const SOFT: f64 = 0.5;
const TAILORED: f64 = 0.75;

type Field<'a> = &'a (dyn Fn(Vec3) -> f64 + Sync);

/// How one part is made from its field.
struct Recipe<'a> {
    name: &'static str,
    material: Material,
    field: Field<'a>,
    grid: Grid,
    triangles: usize,
    crease_cosine: f64,
    weight: Field<'a>,
}

pub fn model() -> Model {
    let face = Face::new();
    let skin = |p: Vec3| face.skin(p);
    let lips = |p: Vec3| face.lips(p);
    let brows = |p: Vec3| face.brows(p);
    // What lies under another part by some millimetres is never seen.
    let hidden = |p: Vec3, covers: &[Field]| covers.iter().any(|cover| cover(p) < -0.4);
    let skin_weight = |p: Vec3| {
        if hidden(p, &[&hair::mass, &clothes::coat, &clothes::cravat, &clothes::lapels]) {
            return 0.002;
        }
        face_weight(p)
    };
    let hair_weight = |p: Vec3| if hidden(p, &[&skin, &clothes::coat, &clothes::lapels]) { 0.002 } else { 1.0 };
    let coat_weight = |p: Vec3| {
        if hidden(p, &[&clothes::lapels, &clothes::waistcoat]) { 0.01 } else { 1.0 }
    };
    let under_coat = |p: Vec3| {
        if hidden(p, &[&clothes::coat, &clothes::lapels, &skin]) { 0.004 } else { 1.0 }
    };
    let even = |_: Vec3| 1.0;
    let recipes = [
        Recipe {
            name: "head",
            material: SKIN,
            field: &skin,
            grid: grid([8.5, -17.5, 12.5, -11.5, 12.5], 0.17),
            triangles: 1560,
            crease_cosine: SOFT,
            weight: &skin_weight,
        },
        Recipe {
            name: "lips",
            material: LIP,
            field: &lips,
            grid: grid([3.6, -8.8, -5.4, 5.8, 11.5], 0.07),
            triangles: 160,
            crease_cosine: SOFT,
            weight: &even,
        },
        Recipe {
            name: "brows",
            material: BROW,
            field: &brows,
            grid: grid([6.8, 0.0, 4.0, 3.5, 11.0], 0.09),
            triangles: 140,
            crease_cosine: SOFT,
            weight: &even,
        },
        Recipe {
            name: "hair",
            material: HAIR,
            field: &hair::mass,
            grid: grid([15.0, -14.0, 18.0, -16.5, 12.0], 0.3),
            triangles: 200,
            crease_cosine: SOFT,
            weight: &hair_weight,
        },
        Recipe {
            name: "coat",
            material: COAT,
            field: &clothes::coat,
            grid: grid([16.0, -35.5, -6.0, -12.0, 12.0], 0.3),
            triangles: 340,
            crease_cosine: TAILORED,
            weight: &coat_weight,
        },
        Recipe {
            name: "waistcoat",
            material: WAISTCOAT,
            field: &clothes::waistcoat,
            grid: grid([8.0, -35.0, -14.0, 0.0, 12.0], 0.25),
            triangles: 40,
            crease_cosine: TAILORED,
            weight: &under_coat,
        },
        Recipe {
            name: "lapels",
            material: LAPEL,
            field: &clothes::lapels,
            grid: grid([14.0, -32.0, -6.0, -12.5, 12.0], 0.2),
            triangles: 220,
            crease_cosine: TAILORED,
            weight: &even,
        },
        Recipe {
            name: "cravat",
            material: LINEN,
            field: &clothes::cravat,
            grid: grid([9.0, -25.0, -10.0, -10.0, 12.5], 0.18),
            triangles: 360,
            crease_cosine: SOFT,
            weight: &under_coat,
        },
        Recipe {
            name: "collar",
            material: LINEN,
            field: &clothes::collar,
            grid: grid([8.0, -16.5, -8.0, -8.0, 7.5], 0.12),
            triangles: 70,
            crease_cosine: TAILORED,
            weight: &even,
        },
    ];
    let mut parts = all_cooked(&recipes);
    let ready = [
        ("locks", HAIR, hair::locks()),
        ("eyes", EYE, face::eyeballs()),
        ("irises", IRIS, face::irises()),
        ("lashes", BROW, face::lashes()),
        ("mouth-line", LIP_LINE, face.mouth_line()),
        ("buttons", BRASS, clothes::buttons()),
        ("socle", STONE, clothes::socle()),
    ];
    for (name, material, mesh) in ready {
        parts.push(Part {
            name: name.to_owned(),
            material: Some(material),
            shading: Shading::Smooth { crease_cosine: 0.65 },
            closed: true,
            mesh,
        });
    }
    for position in parts.iter_mut().flat_map(|part| &mut part.mesh.positions) {
        *position = (*position - v(0.0, clothes::FOOT, 0.0)) * SCALE;
    }
    Model { name: "bust", title: "A portrait bust, after the busts of Beethoven that the cartoon papers drew.", parts }
}

/// The box is given as half width, low y, high y, low z, high z.
fn grid([half_width, low_y, high_y, low_z, high_z]: [f64; 5], step: f64) -> Grid {
    Grid { low: v(-half_width, low_y, low_z), high: v(half_width, high_y, high_z), step }
}

/// Eyes, nose and mouth get more triangles than cheeks and forehead.
fn face_weight(p: Vec3) -> f64 {
    let eye = (face::halved(p) - face::EYE).length();
    if eye < 2.2 {
        6.0
    } else if p.x.abs() < 3.0 && p.y < 0.5 && p.y > -8.5 && p.z > 7.5 {
        5.0
    } else if p.z > 4.0 {
        2.5
    } else {
        1.0
    }
}

/// Every part by its recipe, in the recipes' order, on as many threads as
/// there are recipes: the few large ones set the time either way.
fn all_cooked(recipes: &[Recipe]) -> Vec<Part> {
    std::thread::scope(|scope| {
        let started: Vec<_> = recipes.iter().map(|recipe| scope.spawn(move || cooked(recipe))).collect();
        started.into_iter().map(|thread| thread.join().expect("sculpting a part does not panic")).collect()
    })
}

fn cooked(recipe: &Recipe) -> Part {
    // Cut off inside the box, so that a part that runs out of it is closed.
    let Grid { low, high, step } = recipe.grid;
    let boxed = |p: Vec3| {
        let past = (low - p).max(p - high) + v(1.5, 1.5, 1.5) * step;
        (recipe.field)(p).max(past.x).max(past.y).max(past.z)
    };
    let fine = polygonise(&boxed, recipe.grid).keep_large_pieces(0.2);
    let mesh: Mesh = decimate(&fine, recipe.triangles, recipe.weight);
    Part {
        name: recipe.name.to_owned(),
        material: Some(recipe.material),
        shading: Shading::Given(sculpted_normals(&mesh, recipe)),
        closed: true,
        mesh,
    }
}

/// The normals of the sculpture itself rather than of the thinned mesh: the
/// tones of a face then bend as smoothly as before. Where the two disagree an
/// edge or a fold runs through the vertex, and the mesh is right.
fn sculpted_normals(mesh: &Mesh, recipe: &Recipe) -> Vec<[Vec3; 3]> {
    let reach = 1.2 * recipe.grid.step;
    let field_normals: Vec<Vec3> =
        mesh.positions.iter().map(|&p| gradient(recipe.field, p, reach).normalized()).collect();
    let mut corners = mesh.corner_normals(recipe.crease_cosine);
    for (triangle, normals) in mesh.triangles.iter().zip(&mut corners) {
        for (vertex, normal) in triangle.iter().zip(normals) {
            let sculpted = field_normals[*vertex];
            if sculpted.dot(*normal) > 0.8 {
                *normal = sculpted;
            }
        }
    }
    corners
}
