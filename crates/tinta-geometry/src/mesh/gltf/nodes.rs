//! A glTF file's nodes: which of them its scene shows, and where each lies.

use super::extensions::{self, VISIBILITY};
use crate::limits::NODE_LEVELS;
use crate::mesh::{NONE, NamedPart};
use glam::{DMat4, DQuat, DVec3};
use gltf_json::{Index, Node, Root, Scene};
use serde::Deserialize;

/// The extension of a node.
#[derive(Deserialize)]
struct Visibility {
    visible: Option<bool>,
}

/// The scene's contents.
pub(super) struct Nodes {
    /// For each node of the file where it lies: scene from node.
    pub scene_from_node: Vec<DMat4>,
    /// The nodes of the scene, each once.
    pub shown: Vec<usize>,
    /// For each node of the file whether it, or one above it, is hidden.
    is_hidden: Vec<bool>,
    /// The node that each node lies below.
    parents: Vec<Option<usize>>,
}

impl Nodes {
    /// Follows the tree of nodes, which must be one: without circles, every node below one other at most.
    pub(super) fn of(root: &Root) -> Result<Self, String> {
        let parents = parents(root)?;
        let mut scene_from_node = vec![DMat4::IDENTITY; root.nodes.len()];
        let mut is_hidden = vec![false; root.nodes.len()];
        let tops = (0..parents.len()).filter(|node| parents[*node].is_none());
        let mut reached = 0;
        let mut waiting: Vec<(usize, usize)> = tops.map(|node| (node, 1)).collect();
        while let Some((number, level)) = waiting.pop() {
            if level > NODE_LEVELS {
                return Err(format!("its nodes are more than {NODE_LEVELS} levels deep; export it with fewer"));
            }
            reached += 1;
            let node = &root.nodes[number];
            let above = parents[number].map_or(DMat4::IDENTITY, |parent| scene_from_node[parent]);
            scene_from_node[number] = above * parent_from_node(node);
            is_hidden[number] = hides(node)? || parents[number].is_some_and(|parent| is_hidden[parent]);
            waiting.extend(children(node).map(|child| (child.value(), level + 1)));
        }
        if reached < root.nodes.len() {
            return Err("its nodes form a cycle; export it again".to_owned());
        }
        Ok(Self { scene_from_node, shown: shown(root)?, is_hidden, parents })
    }

    /// The nodes that show a mesh, each with its mesh's number.
    pub(super) fn with_meshes<'a>(&'a self, root: &'a Root) -> impl Iterator<Item = (usize, usize)> + use<'a> {
        let visible = self.shown.iter().copied().filter(|node| !self.is_hidden[*node]);
        visible.filter_map(|node| Some((node, root.nodes[node].mesh?.value())))
    }

    /// How a node is turned in the scene, whatever its size: cameras have none.
    pub(super) fn rotation(&self, root: &Root, node: usize) -> DQuat {
        let above = std::iter::successors(Some(node), |node| self.parents[*node]);
        above.fold(DQuat::IDENTITY, |below, node| rotation(&root.nodes[node]) * below)
    }

    /// The nodes that show a mesh and those above them, as parts, each after the one above it; for each node its part.
    pub(super) fn parts(&self, root: &Root) -> (Vec<NamedPart>, Vec<u32>) {
        let (mut parts, mut of_nodes) = (Vec::new(), vec![NONE; root.nodes.len()]);
        for (shown, _) in self.with_meshes(root) {
            let above = std::iter::successors(Some(shown), |node| self.parents[*node]);
            let mut unknown: Vec<usize> = above.take_while(|node| of_nodes[*node] == NONE).collect();
            while let Some(number) = unknown.pop() {
                let within = self.parents[number].map_or(NONE, |parent| of_nodes[parent]);
                let node = &root.nodes[number];
                let of_mesh = || root.meshes.get(node.mesh?.value())?.name.clone();
                let name = node.name.clone().or_else(of_mesh).unwrap_or_else(|| format!("node {number}"));
                of_nodes[number] = parts.len() as u32;
                parts.push(NamedPart { name, within });
            }
        }
        (parts, of_nodes)
    }
}

/// Whether a node hides itself and all below it.
fn hides(node: &Node) -> Result<bool, String> {
    let others = node.extensions.as_ref().map(|extensions| &extensions.others);
    Ok(extensions::said::<Visibility>(others, VISIBILITY)?.is_some_and(|said| said.visible == Some(false)))
}

fn children(node: &Node) -> impl Iterator<Item = Index<Node>> {
    node.children.iter().flatten().copied()
}

/// The node that each node lies below.
fn parents(root: &Root) -> Result<Vec<Option<usize>>, String> {
    let mut parents = vec![None; root.nodes.len()];
    for (number, node) in root.nodes.iter().enumerate() {
        for child in children(node) {
            match parents.get_mut(child.value()) {
                None => return Err(format!("its node {child} does not exist; export it again")),
                Some(Some(_)) => return Err(format!("its node {child} has two parents; export it again")),
                Some(parent) => *parent = Some(number),
            }
        }
    }
    Ok(parents)
}

/// The nodes of the default scene, or of the first; of all nodes if the file has no scene.
fn shown(root: &Root) -> Result<Vec<usize>, String> {
    let mut waiting: Vec<usize> = match root.scene.unwrap_or(Index::new(0)) {
        _ if root.scenes.is_empty() => return Ok((0..root.nodes.len()).collect()),
        scene => {
            let Scene { nodes, .. } =
                root.get(scene).ok_or_else(|| format!("its scene {scene} does not exist; export it again"))?;
            nodes.iter().rev().map(Index::value).collect()
        }
    };
    let (mut is_shown, mut shown) = (vec![false; root.nodes.len()], Vec::new());
    while let Some(number) = waiting.pop() {
        let Some(seen) = is_shown.get_mut(number) else {
            return Err(format!("its node {number} does not exist; export it again"));
        };
        // A scene may name a node twice.
        if !std::mem::replace(seen, true) {
            shown.push(number);
            waiting.extend(root.nodes.get(number).into_iter().flat_map(children).map(|child| child.value()));
        }
    }
    Ok(shown)
}

fn parent_from_node(node: &Node) -> DMat4 {
    if let Some(matrix) = node.matrix {
        return DMat4::from_cols_array(&matrix.map(f64::from));
    }
    let vector = |given: Option<[f32; 3]>, default| given.map_or(default, |v| DVec3::from_array(v.map(f64::from)));
    DMat4::from_scale_rotation_translation(
        vector(node.scale, DVec3::ONE),
        rotation(node),
        vector(node.translation, DVec3::ZERO),
    )
}

fn rotation(node: &Node) -> DQuat {
    let rotation = match node.matrix {
        Some(matrix) => DMat4::from_cols_array(&matrix.map(f64::from)).to_scale_rotation_translation().1,
        None => DQuat::from_array(node.rotation.unwrap_or_default().0.map(f64::from)),
    };
    unit_rotation(rotation)
}

/// A rotation of length 1. Written with few digits it is not quite that long; of length 0 it turns nothing.
pub(super) fn unit_rotation(rotation: DQuat) -> DQuat {
    if rotation.length_squared() > 0.0 { rotation.normalize() } else { DQuat::IDENTITY }
}

#[cfg(test)]
mod tests {
    use super::super::camera;
    use super::super::tests::{load, problem, triangle};
    use serde_json::json;

    #[test]
    fn hidden_nodes_are_not_drawn_nor_what_is_below_them_and_their_cameras_look() {
        let mut file = triangle();
        file["extensionsUsed"] = json!(["KHR_node_visibility"]);
        file["extensionsRequired"] = json!(["KHR_node_visibility"]);
        file["cameras"] = json!([{"type": "perspective", "perspective": {"yfov": 1, "znear": 1}}]);
        file["nodes"] = json!([
            {"children": [1, 2, 4]},
            {"mesh": 0, "name": "seen", "extensions": {"KHR_node_visibility": {"visible": true}}},
            {"children": [3], "camera": 0, "extensions": {"KHR_node_visibility": {"visible": false}}},
            {"mesh": 0, "translation": [5, 0, 0], "extensions": {"KHR_node_visibility": {"visible": true}}},
            {"mesh": 0, "translation": [0, 5, 0], "extensions": {"KHR_node_visibility": {}}}
        ]);
        for has_scenes in [true, false] {
            if !has_scenes {
                file.as_object_mut().unwrap().remove("scenes");
                file.as_object_mut().unwrap().remove("scene");
            }
            let loaded = load(&file).unwrap();
            assert_eq!(loaded.mesh.triangles.len(), 2, "the first and the last");
            assert_eq!(loaded.mesh.positions.iter().map(|position| position.x).fold(0.0, f64::max), 1.0);
            let mut names: Vec<&str> = loaded.mesh.parts.iter().map(|part| part.name.as_str()).collect();
            names.sort_unstable();
            assert_eq!(names, ["node 0", "node 4", "seen"]);
            assert_eq!(loaded.remarks, ["t.gltf: not drawn: 1 camera"]);
            assert!(camera(file.to_string().as_bytes()).unwrap().is_some());
        }
        file["nodes"][1]["extensions"]["KHR_node_visibility"]["visible"] = json!(1);
        let sentence = "t.gltf: its KHR_node_visibility is damaged (invalid type: integer `1`, expected a boolean); export it again";
        assert_eq!(problem(&file), sentence);
    }
}
