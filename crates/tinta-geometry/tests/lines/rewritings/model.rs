//! A scene that can be rewritten.

use super::rules::edges;
use crate::support::lines::{explicit, moved_camera};
use crate::support::shapes::joined;
use glam::{DMat3, DVec3};
use std::sync::Arc;
use tinta::camera::Projection;
use tinta::{CameraSettings, Mesh, Scene, SceneSettings, Size};

#[derive(Clone)]
pub struct Model {
    pub meshes: Vec<Mesh>,
    pub camera: CameraSettings,
    pub size: Size,
    pub is_mirrored: bool,
    /// Whether a surface has a rim.
    pub is_open: bool,
    /// Whether faces were repeated.
    pub has_layers: bool,
}

impl Model {
    pub fn of(scene: &Scene) -> Self {
        // As readers create them: all positions differ.
        let placed = |object: &tinta::scene::Object| {
            let positions = object.mesh.positions.iter().map(|point| *point + object.offset).collect();
            joined(&[Mesh { positions, ..(*object.mesh).clone() }])
        };
        let mut camera = explicit(scene);
        match scene.camera.projection {
            Projection::Parallel { height } => camera.height = Some(height),
            Projection::Perspective { fov_y_degrees } => camera.fov_y_degrees = fov_y_degrees,
        }
        let meshes: Vec<Mesh> = scene.objects.iter().map(placed).collect();
        let is_open = meshes.iter().any(|mesh| edges(mesh).values().any(|faces| faces.len() == 1));
        Self { meshes, camera, size: scene.size, is_mirrored: false, is_open, has_layers: false }
    }

    pub fn scene(&self) -> Scene {
        let settings = SceneSettings { camera: self.camera.clone(), size: self.size, ..SceneSettings::default() };
        Scene::new(self.meshes.iter().cloned().map(Arc::new).collect::<Vec<_>>(), &settings).unwrap()
    }

    /// The centre and half the diagonal of all meshes.
    fn ball(&self) -> (DVec3, f64) {
        let bounds = self.meshes.iter().map(Mesh::bounds);
        let (low, high) = bounds.reduce(|a, b| (a.0.min(b.0), a.1.max(b.1))).unwrap();
        ((low + high) * 0.5, low.distance(high) * 0.5)
    }

    /// The model in parallel projection, seen from a direction.
    pub fn parallel_from(&self, direction: DVec3) -> Self {
        let (middle, radius) = self.ball();
        let camera = CameraSettings {
            eye: Some(middle + direction * 3.0 * radius),
            target: Some(middle),
            up: Some(direction.any_orthonormal_vector()),
            parallel: true,
            height: Some(2.2 * radius),
            near: Some(radius),
            far: Some(5.0 * radius),
            ..CameraSettings::default()
        };
        Self { camera, ..self.clone() }
    }

    /// The closest perspective view, from a million radii away.
    pub fn perspective_from(&self, direction: DVec3) -> Self {
        let mut far = self.parallel_from(direction);
        let (middle, radius) = self.ball();
        let distance = 1e6 * radius;
        far.camera.eye = Some(middle + direction * distance);
        far.camera.parallel = false;
        far.camera.height = None;
        far.camera.fov_y_degrees = 2.0 * (1.1 * radius / distance).atan().to_degrees();
        far.camera.near = Some(distance - 2.0 * radius);
        far.camera.far = Some(distance + 2.0 * radius);
        far
    }

    /// Writes each mesh as an OBJ, and the options of its picture, into the folder `TINTA_REWRITTEN`, for the
    /// inspection of a failed scene.
    pub fn keep(&self, name: &str) {
        let Ok(folder) = std::env::var("TINTA_REWRITTEN") else { return };
        let path = format!("{folder}/{name}");
        let mut command = String::from("tinta render");
        for (number, mesh) in self.meshes.iter().enumerate() {
            let vertex = |DVec3 { x, y, z }: &DVec3| format!("v {x:?} {y:?} {z:?}\n");
            let face = |[a, b, c]: &[u32; 3]| format!("f {} {} {}\n", a + 1, b + 1, c + 1);
            let text: String = mesh.positions.iter().map(vertex).chain(mesh.triangles.iter().map(face)).collect();
            std::fs::write(format!("{path}-{number}.obj"), text).unwrap();
            command += &format!(" {path}-{number}.obj");
        }
        let camera = &self.camera;
        let vector = |vector: Option<DVec3>| vector.map(|DVec3 { x, y, z }| format!("{x:?},{y:?},{z:?}")).unwrap();
        command += &format!(" --weld 0 --size {}x{}", self.size.width, self.size.height);
        command +=
            &format!(" --eye={} --target={} --up={}", vector(camera.eye), vector(camera.target), vector(camera.up));
        command += &format!(" --near={:?} --far={:?}", camera.near.unwrap(), camera.far.unwrap());
        match camera.parallel {
            true => command += &format!(" --parallel --height={:?}", camera.height.unwrap()),
            false => command += &format!(" --fov={:?}", camera.fov_y_degrees),
        }
        std::fs::write(format!("{path}.txt"), command).unwrap();
    }

    /// Moves model and camera by a similarity.
    pub fn moved(mut self, turn: DMat3, scale: f64, shift: DVec3) -> Self {
        let place = |point: DVec3| turn * point * scale + shift;
        for mesh in &mut self.meshes {
            mesh.positions.iter_mut().for_each(|point| *point = place(*point));
        }
        self.camera = moved_camera(&self.camera, turn, scale, shift);
        self
    }
}

/// The mesh of some triangles, with only the positions that they use.
pub fn compact(mesh: &Mesh, triangles: Vec<[u32; 3]>) -> Mesh {
    let mut used = triangles.as_flattened().to_vec();
    used.sort_unstable();
    used.dedup();
    let number = |corner: u32| used.binary_search(&corner).unwrap() as u32;
    let triangles = triangles.into_iter().map(|corners| corners.map(number)).collect();
    crate::support::shapes::mesh(used.iter().map(|corner| mesh.positions[*corner as usize]).collect(), triangles)
}
