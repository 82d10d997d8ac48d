//! Noise goes; relief, edges, large faces and all that has no noise stay.

use super::*;
use crate::mesh::normals::patches::gathered;
use crate::mesh::{LoadOptions, load, triangle_normal};
use std::io::Write;
use std::path::{Path, PathBuf};

const COS_34: f64 = 0.829;

/// A model's denoised normals, with its parts.
struct Model {
    positions: Vec<DVec3>,
    triangles: Vec<[u32; 3]>,
    normals: Vec<DVec3>,
    pairs: Vec<[u32; 2]>,
}

impl Model {
    fn new(positions: Vec<DVec3>, triangles: Vec<[u32; 3]>) -> Self {
        let normal = |t: &[u32; 3]| triangle_normal(t.map(|vertex| positions[vertex as usize])).unwrap();
        let normals = triangles.iter().map(normal).collect();
        let mut edges: Vec<([u32; 2], u32)> = Vec::new();
        for (face, [a, b, c]) in triangles.iter().enumerate() {
            edges.extend([[a, b], [b, c], [c, a]].map(|[a, b]| ([*a.min(b), *a.max(b)], face as u32)));
        }
        edges.sort_unstable();
        let pairs = edges.windows(2).filter(|two| two[0].0 == two[1].0).map(|two| [two[0].1, two[1].1]).collect();
        Self { positions, triangles, normals, pairs }
    }

    /// The unit square in so many cells a side, two triangles each, with its height at each point.
    fn sheet(cells: usize, height: impl Fn(f64, f64) -> f64) -> Self {
        Self::of_cells(cells, |x, y| DVec3::new(x, height(x, y), y))
    }

    fn of_cells(cells: usize, place: impl Fn(f64, f64) -> DVec3) -> Self {
        let (side, share) = (cells + 1, |n: usize| n as f64 / cells as f64);
        let positions = (0..side * side).map(|n| place(share(n % side), share(n / side))).collect();
        let at = |x: usize, y: usize| (y * side + x) as u32;
        let triangles = (0..cells * cells).flat_map(|n| {
            let (x, y) = (n % cells, n / cells);
            [[at(x, y), at(x + 1, y + 1), at(x + 1, y)], [at(x, y), at(x, y + 1), at(x + 1, y + 1)]]
        });
        Self::new(positions, triangles.collect())
    }

    /// Every triangle cut into four.
    fn cut(&self) -> Self {
        let mut middles = std::collections::HashMap::new();
        let mut positions = self.positions.clone();
        let mut middle = |a: u32, b: u32| {
            *middles.entry([a.min(b), a.max(b)]).or_insert_with(|| {
                positions.push((positions[a as usize] + positions[b as usize]) * 0.5);
                positions.len() as u32 - 1
            })
        };
        let parts = self.triangles.iter().flat_map(|&[a, b, c]| {
            let [ab, bc, ca] = [middle(a, b), middle(b, c), middle(c, a)];
            [[a, ab, ca], [b, bc, ab], [c, ca, bc], [ab, bc, ca]]
        });
        let triangles = parts.collect();
        Self::new(positions, triangles)
    }

    fn centre(&self, face: usize) -> DVec3 {
        self.triangles[face].iter().map(|vertex| self.positions[*vertex as usize]).sum::<DVec3>() / 3.0
    }

    fn denoised(&self, cos_smooth: f64) -> DenoisedNormals {
        let area = |[a, b, c]: [DVec3; 3]| (b - a).cross(c - a).length() / 2.0;
        let areas: Vec<f64> =
            self.triangles.iter().map(|t| area(t.map(|vertex| self.positions[vertex as usize]))).collect();
        let neighbours = Neighbours::new(areas.len(), self.pairs.iter().copied());
        let is_flat = |a: u32, b: u32| self.normals[a as usize].dot(self.normals[b as usize]) > 0.99996;
        let (flat, flat_areas) = gathered(
            &neighbours,
            areas.len(),
            |first| areas[first as usize],
            |_, face, other, _| is_flat(face, other).then(|| areas[other as usize]),
        );
        let faces = Faces {
            positions: &self.positions,
            triangles: &self.triangles,
            normals: &self.normals,
            areas: &areas,
            flat: &flat,
            flat_areas: &flat_areas,
            neighbours: &neighbours,
        };
        let [low, high] = [DVec3::min, DVec3::max].map(|of| self.positions.iter().copied().reduce(of).unwrap());
        denoised(&faces, (high - low).length(), cos_smooth)
    }
}

/// As if at random, from -1 to 1.
fn random(x: f64, y: f64) -> f64 {
    ((x * 1269.98 + y * 7823.3).sin() * 43758.5453).fract()
}

/// The mean angle to what the normals should be, degrees, of the faces of which that is said.
fn mean_angle(model: &Model, normals: &[DVec3], ideal: impl Fn(DVec3) -> Option<DVec3>) -> f64 {
    let angles = normals
        .iter()
        .enumerate()
        .filter_map(|(face, normal)| ideal(model.centre(face)).map(|ideal| normal.angle_between(ideal).to_degrees()));
    let angles: Vec<f64> = angles.collect();
    angles.iter().sum::<f64>() / angles.len() as f64
}

#[test]
fn noise_of_a_fine_mesh_goes() {
    let sheet = Model::sheet(200, |x, y| 0.0008 * random(x, y));
    let DenoisedNormals { normals, is_noisy } = sheet.denoised(COS_34);
    let [before, after] = [&sheet.normals, &normals].map(|of| mean_angle(&sheet, of, |_| Some(DVec3::Y)));
    assert!(before > 5.0 && after < before / 6.0, "{before} became {after}");
    assert!(is_noisy.iter().all(|is| *is));
    assert!(normals.iter().all(|normal| (normal.length() - 1.0).abs() < 1e-6));
}

#[test]
fn relief_above_the_noise_stays() {
    // A slope of 20 degrees, a twelfth of the sheet wide, in noise of 3.
    let slope = 20f64.to_radians().tan();
    let relief = |x: f64| slope * (x.clamp(0.46, 0.54) - 0.46);
    let sheet = Model::sheet(200, |x, y| relief(x) + 0.0002 * random(x, y));
    let DenoisedNormals { normals, .. } = sheet.denoised(COS_34);
    let ideal = DVec3::new(-slope, 1.0, 0.0).normalize();
    let on_slope = |place: DVec3| ((place.x - 0.5).abs() < 0.025).then_some(ideal);
    let beside = |place: DVec3| ((place.x - 0.5).abs() > 0.055).then_some(DVec3::Y);
    let angles = [mean_angle(&sheet, &normals, on_slope), mean_angle(&sheet, &normals, beside)];
    // Nine tenths of the slope at least.
    assert!(angles[0] < 2.0 && angles[1] < 0.6, "{angles:?}");
}

#[test]
fn where_there_is_no_noise_normals_stay_as_they_are() {
    let is_kept = |model: Model| {
        let DenoisedNormals { normals, is_noisy } = model.denoised(COS_34);
        normals == model.normals && !is_noisy.contains(&true)
    };
    let relief = |x: f64, y: f64| 0.012 * (x * 25.0).sin() * (y * 20.0).cos();
    assert!(is_kept(Model::sheet(200, |x, y| 0.3 * x * (1.0 - x) + 0.2 * y * y)), "a dome");
    assert!(is_kept(Model::sheet(400, relief)), "relief, finely cut");
    assert!(is_kept(Model::sheet(60, |x, y| 0.002 * random(x, y))), "faces too large for noise");
    assert!(is_kept(Model::sheet(10, |x, y| 0.05 * random(x, y))), "large faces");
    let ball = Model::of_cells(150, |x, y| {
        let (around, up) = (x * 6.2, (y - 0.5) * 3.0);
        DVec3::new(around.cos() * up.cos(), up.sin(), around.sin() * up.cos())
    });
    assert!(is_kept(ball), "a ball, with slivers at its poles");
}

#[test]
fn edges_of_relief_are_no_noise() {
    // Ridges of 18 degrees on a flat ground, on which faces are few; how far they lean from what they were.
    let ridges = Model::sheet(400, |x, y| 0.008 * (x * 40.0).sin().max(0.0) * (2.0 + (y * 30.0).cos()) / 3.0);
    let DenoisedNormals { normals, .. } = ridges.denoised(COS_34);
    let leaning = normals.iter().zip(&ridges.normals).map(|(evened, own)| evened.angle_between(*own).to_degrees());
    let mean = leaning.sum::<f64>() / normals.len() as f64;
    assert!(mean < 0.1, "{mean}");
}

#[test]
fn what_is_cut_finely_for_its_detail_is_no_scan() {
    // Four fifths of each side's points lie in a tenth of the sheet, where there is detail.
    let crowded = |share: f64| if share < 0.8 { share / 8.0 } else { 0.1 + (share - 0.8) * 4.5 };
    let height = |x: f64, y: f64| if x < 0.1 && y < 0.1 { 0.0008 * random(x, y) } else { 0.0 };
    let place = |x: f64, y: f64| {
        let (x, y) = (crowded(x), crowded(y));
        // Round, to keep the rest from being one flat face.
        DVec3::new(x, height(x, y) - 0.2 * (x * x + y * y), y)
    };
    let sheet = Model::of_cells(200, place);
    assert_eq!(sheet.denoised(COS_34).normals, sheet.normals);
}

#[test]
fn a_surface_is_evened_out_alike_however_finely_its_faces_are_cut() {
    let coarse = Model::sheet(150, |x, y| 0.001 * random(x, y) + 0.1 * x * x);
    let fine = coarse.cut();
    let [normals, fine_normals] = [&coarse, &fine].map(|model| model.denoised(COS_34).normals);
    assert!(mean_angle(&coarse, &coarse.normals, |place| Some(DVec3::new(-0.2 * place.x, 1.0, 0.0))) > 5.0);
    let angles = fine_normals.iter().enumerate().map(|(face, normal)| normal.angle_between(normals[face / 4]));
    let mean = angles.sum::<f64>().to_degrees() / fine_normals.len() as f64;
    assert!(mean < 0.7, "{mean}");
}

#[test]
fn an_edge_sharper_than_the_angle_stays() {
    // Two halves at a right angle, in noise.
    let sheet = Model::of_cells(200, |x, y| {
        let rough = 0.0008 * random(x, y);
        if y < 0.5 { DVec3::new(x, rough, y) } else { DVec3::new(x, y - 0.5, 0.5 + rough) }
    });
    let DenoisedNormals { normals, .. } = sheet.denoised(COS_34);
    let ideal = |place: DVec3| match (place.y, place.z) {
        (up, _) if up > 0.01 => Some(DVec3::NEG_Z),
        (_, along) if along < 0.49 => Some(DVec3::Y),
        _ => None,
    };
    let angle = mean_angle(&sheet, &normals, ideal);
    assert!(angle < 1.5, "{angle}");
}

#[test]
fn no_faces_and_alien_angles_are_no_error() {
    assert!(Model::new(Vec::new(), Vec::new()).positions.is_empty());
    let sheet = Model::sheet(100, |x, y| 0.002 * random(x, y));
    for cosine in [-1.0, 0.0, 1.0, 2.0] {
        let DenoisedNormals { normals, .. } = sheet.denoised(cosine);
        assert!(normals.iter().all(|normal| (normal.length() - 1.0).abs() < 1e-6), "{cosine}");
    }
}

/// A public model, where it lies beside the checkout.
fn public(file: &str) -> Option<Model> {
    let public = std::env::var_os("TINTA_MODELS").map_or_else(|| "../shared/models".into(), PathBuf::from);
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").join(public).join(file);
    if !path.is_file() {
        let _ = writeln!(std::io::stderr(), "SKIPPED {}: it is not there", path.display());
        return None;
    }
    let mesh = load(path.to_str().unwrap(), &LoadOptions::default()).unwrap().mesh;
    Some(Model::new(mesh.positions, mesh.triangles))
}

#[test]
fn models_that_were_made_by_hand_keep_all_their_normals() {
    const FILES: [&str; 14] = [
        "ant.ply",
        "beethoven.obj",
        "cow.obj",
        "doll.obj",
        "fandisk.obj",
        "suzanne.obj",
        "teapot.obj",
        "spot/spot_triangulated.obj",
        "parts/bolt.stl",
        "parts/bracket.stl",
        "parts/flange.stl",
        "parts/hex.stl",
        "parts/rounded.stl",
        "parts/tee.stl",
    ];
    for file in FILES {
        let Some(model) = public(file) else { continue };
        assert!(model.denoised(COS_34).normals == model.normals, "{file}");
    }
}

#[test]
fn a_scan_is_calm_and_keeps_its_relief() {
    let Some(bunny) = public("stanford-bunny.obj") else { return };
    let DenoisedNormals { normals, .. } = bunny.denoised(COS_34);
    let between = |of: &[DVec3]| {
        let angles = bunny.pairs.iter().map(|pair| pair.map(|face| of[face as usize])).map(|[a, b]| a.angle_between(b));
        angles.sum::<f64>().to_degrees() / bunny.pairs.len() as f64
    };
    let [before, after] = [between(&bunny.normals), between(&normals)];
    // What remains is mostly its shape.
    assert!(after < before / 1.8, "faces turned {before} degrees from their neighbours and turn {after}");
    // Places of about 70 faces, farther apart than normals are evened out: what turns between them is relief.
    let neighbours = Neighbours::new(bunny.normals.len(), bunny.pairs.iter().copied());
    let places =
        Patches::new(&neighbours, bunny.normals.len(), |_| 1.0, |_, _, _, count| (count < 70.0).then_some(1.0));
    let members = places.members();
    let mean = |of: &[DVec3], place: u32| -> DVec3 {
        members.of(place as usize).iter().map(|face| of[*face as usize]).sum::<DVec3>().normalize()
    };
    let turns = |of: &[DVec3], place: u32, other: u32| mean(of, place).angle_between(mean(of, other)).to_degrees();
    let is_whole = |place: &u32| places.areas[*place as usize] >= 70.0;
    let wholes = (0..places.areas.len() as u32).filter(is_whole);
    let beside = wholes.flat_map(|place| places.neighbours.of(place as usize).iter().map(move |other| [place, *other]));
    let relief: Vec<[f64; 2]> = beside
        .filter(|[place, other]| place < other && is_whole(other))
        .map(|[place, other]| [&bunny.normals, &normals].map(|of| turns(of, place, other)))
        .filter(|[before, _]| *before > 30.0)
        .collect();
    let [before, after] = [0, 1].map(|which| relief.iter().map(|turns| turns[which]).sum::<f64>());
    assert!(relief.len() > 100 && after > 0.85 * before, "{} places: {before} became {after}", relief.len());
    assert!(relief.iter().all(|[before, after]| *after > 0.6 * before), "{relief:?}");
}
