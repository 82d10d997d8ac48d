//! Copies in a scene: objects that share a mesh, and what is made for a mesh.

use super::{Object, Scene};
use std::sync::Arc;

impl Scene {
    /// Returns a value for each object; copies, which share a mesh, share theirs.
    pub fn of_meshes<T: Clone>(&self, make: impl Fn(usize, &Object) -> T) -> Vec<T> {
        let mut made: Vec<T> = Vec::with_capacity(self.objects.len());
        for (number, object) in self.objects.iter().enumerate() {
            let first = self.objects[..number].iter().position(|other| Arc::ptr_eq(&other.mesh, &object.mesh));
            made.push(first.map_or_else(|| make(number, object), |first| made[first].clone()));
        }
        made
    }

    /// The objects without further copies.
    pub fn originals(&self) -> impl Iterator<Item = &Object> {
        let is_new = |number: usize, mesh| self.objects[..number].iter().all(|other| !Arc::ptr_eq(&other.mesh, mesh));
        let objects = self.objects.iter().enumerate();
        objects.filter(move |(number, object)| is_new(*number, &object.mesh)).map(|(_, object)| object)
    }
}
