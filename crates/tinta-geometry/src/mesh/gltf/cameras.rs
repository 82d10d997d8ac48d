//! The first camera that a glTF file's scene shows.

use super::container;
use super::nodes::Nodes;
use crate::camera::CameraSettings;
use glam::DVec3;

/// The camera of a glTF or GLB file's bytes, in the file's coordinates, with the aspect (width over height) of its picture, if
/// the file gives one; `None` if its scene shows none.
///
/// # Errors
///
/// A sentence without the file's name for what is no such file.
pub fn camera(file: &[u8]) -> std::result::Result<Option<(CameraSettings, Option<f64>)>, String> {
    let root = container::parse(container::open(file)?.json)?;
    let nodes = Nodes::of(&root)?;
    let Some((node, camera)) = nodes.shown.iter().find_map(|node| Some((*node, root.nodes[*node].camera?))) else {
        return Ok(None);
    };
    let camera =
        root.cameras.get(camera.value()).ok_or("its node names a camera that does not exist; export it again")?;
    let turn = nodes.rotation(&root, node);
    let (eye, backward) = (nodes.scene_from_node[node].transform_point3(DVec3::ZERO), turn * DVec3::Z);
    let distance = if eye.dot(backward) > 0.0 { eye.dot(backward) } else { eye.length().max(1.0) };
    let settings = CameraSettings {
        eye: Some(eye),
        target: Some(eye - backward * distance),
        up: Some(turn * DVec3::Y),
        ..CameraSettings::default()
    };
    match (&camera.perspective, &camera.orthographic) {
        (Some(perspective), _) => {
            let settings = CameraSettings { fov_y_degrees: f64::from(perspective.yfov).to_degrees(), ..settings };
            Ok(Some((settings, perspective.aspect_ratio.map(f64::from))))
        }
        (None, Some(orthographic)) => {
            let [half_width, half_height] = [orthographic.xmag, orthographic.ymag].map(f64::from);
            let settings = CameraSettings { parallel: true, height: Some(2.0 * half_height), ..settings };
            Ok(Some((settings, Some(half_width / half_height))))
        }
        (None, None) => Err("its camera is neither perspective nor orthographic; export it again".to_owned()),
    }
}
