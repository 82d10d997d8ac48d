//! `--camera`: a camera out of a file, as the options that would have made it.

use serde_json::Value;
use std::path::Path;
use tinta::glam::{DMat4, DVec3};
use tinta::preset::Preset;
use tinta::recipe::Recipe;
use tinta::settings::{HasSettings, OptionValue, Options};
use tinta::{CameraSettings, Error, FileKind, Result, SceneSettings, Size, View, camera, mesh};

/// Largest file read, bytes: a model with its data, as `--camera scene.glb` names.
const LARGEST_BYTES: u64 = tinta::limits::MODEL_BYTES;

/// The accepted kinds of files.
const CHOICE: &str = "name what --json printed, a picture by tinta render, a glTF model with a camera, or 16 numbers";

/// A camera with the aspect (width over height) of the picture it is for, if the file gives one.
type WithAspect = (CameraSettings, Option<f64>);

/// Reads a file's camera, with the aspect of the picture it is for, if the file gives one.
pub(super) fn read(path: &Path) -> Result<(Preset, Option<f64>)> {
    let failed = |problem: String| Error::file(FileKind::Preset, path, problem);
    let bytes = crate::files::read(path, LARGEST_BYTES)
        .map_err(|failure| failure.into_error(FileKind::Preset, path, "a file with a camera"))?;
    let (options, aspect) = match Recipe::of_bytes(&bytes, &path.to_string_lossy()) {
        Ok(recipe) => (recipe.options, None),
        Err(_) => {
            let (camera, aspect) = of_bytes(&bytes).map_err(failed)?;
            (SceneSettings { camera, ..SceneSettings::default() }.to_options()?, aspect)
        }
    };
    Ok((Preset::of_options(&path.to_string_lossy(), of_camera(options)), aspect))
}

/// Returns a remark on a picture of another aspect than its camera's, which shows more or less at the sides.
pub(super) fn aspect_remark(path: &Path, aspect: f64, size: Size) -> Option<String> {
    let width = aspect * f64::from(size.height);
    // A side is rounded to whole pixels, and matrices are often written with seven digits.
    let is_same = (width - f64::from(size.width)).abs() <= 0.5 + 1e-4 * width;
    (!is_same && width.is_finite()).then(|| {
        format!(
            "{}: its picture is {:.4} times as wide as high, and this one {:.4}; it keeps the camera's height, and --size {}x{} its \
             width too",
            path.display(),
            aspect,
            size.aspect(),
            width.round().max(1.0),
            size.height
        )
    })
}

/// Those of some options that are about the camera.
pub fn of_camera(mut options: Options) -> Options {
    let is_of_camera =
        |name: &str| SceneSettings::table().settings.iter().any(|s| s.name == name && s.heading == camera::HEADING);
    options.retain(|name, value| is_of_camera(name) && *value != OptionValue::Switch(false));
    options
}

/// The camera; the error is a sentence without the file's name.
fn of_bytes(bytes: &[u8]) -> std::result::Result<WithAspect, String> {
    if bytes.starts_with(b"glTF") {
        return of_gltf(bytes);
    }
    let text = std::str::from_utf8(bytes).map_err(|_| format!("it holds no camera; {CHOICE}"))?;
    match serde_json::from_str::<Value>(text) {
        Ok(Value::Object(object)) if object.contains_key("asset") => of_gltf(bytes),
        Ok(Value::Object(object)) => {
            of_record(object.get("camera").unwrap_or(&Value::Null)).map(|camera| (camera, None))
        }
        Ok(numbers @ Value::Array(_)) => of_numbers(flat(&numbers)),
        _ => of_numbers(
            text.split(|c: char| c.is_whitespace() || c == ',')
                .filter(|word| !word.is_empty())
                .map(|word| word.parse().ok())
                .collect(),
        ),
    }
}

fn of_gltf(bytes: &[u8]) -> std::result::Result<WithAspect, String> {
    mesh::gltf_camera(bytes)?.ok_or_else(|| format!("its scene has no camera; {CHOICE}"))
}

/// The camera of a record that tinta wrote.
fn of_record(camera: &Value) -> std::result::Result<CameraSettings, String> {
    let vector = |name: &str| {
        let numbers: Option<Vec<f64>> = camera.get(name)?.as_array()?.iter().map(Value::as_f64).collect();
        numbers.filter(|numbers| numbers.len() == 3).map(|numbers| DVec3::from_slice(&numbers))
    };
    let number = |name: &str| camera.get(name).and_then(Value::as_f64);
    let (Some(eye), Some(target), Some(up)) = (vector("eye"), vector("target"), vector("up")) else {
        return Err(format!("it has no camera with eye, target and up; {CHOICE}"));
    };
    let settings = CameraSettings {
        eye: Some(eye),
        target: Some(target),
        up: Some(up),
        view: View::DEFAULT,
        ..CameraSettings::default()
    };
    match (number("fov_y_degrees"), number("parallel_height")) {
        (Some(fov_y_degrees), _) => Ok(CameraSettings { fov_y_degrees, ..settings }),
        (None, Some(height)) => Ok(CameraSettings { parallel: true, height: Some(height), ..settings }),
        (None, None) => Err(format!("its camera has neither fov_y_degrees nor parallel_height; {CHOICE}")),
    }
}

/// All numbers of a list of lists; `None` for other values.
fn flat(value: &Value) -> Vec<Option<f64>> {
    match value {
        Value::Array(values) => values.iter().flat_map(flat).collect(),
        value => vec![value.as_f64()],
    }
}

fn of_numbers(numbers: Vec<Option<f64>>) -> std::result::Result<WithAspect, String> {
    let count = numbers.len();
    let numbers: Option<Vec<f64>> = numbers.into_iter().collect();
    match numbers.and_then(|numbers| <[f64; 16]>::try_from(numbers).ok()) {
        Some(rows) => {
            let matrix = DMat4::from_cols_array(&rows).transpose();
            let camera = CameraSettings::of_clip_from_world(&matrix).map_err(|error| error.to_string())?;
            Ok((camera, Some(CameraSettings::aspect_of_clip_from_world(&matrix))))
        }
        None if (2..100).contains(&count) => {
            Err(format!("a matrix has 16 numbers, and this file has {count}; {CHOICE}"))
        }
        None => Err(format!("it holds no camera; {CHOICE}")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_camera_is_read_from_a_record_a_matrix_and_a_scene() {
        let record = r#"{"style": "ink", "camera": {"eye": [0, 0, 5], "target": [0, 0, 0], "up": [0, 1, 0], "fov_y_degrees": 40, "parallel_height": null}}"#;
        let (camera, aspect) = of_bytes(record.as_bytes()).unwrap();
        assert_eq!(aspect, None);
        assert_eq!((camera.eye, camera.fov_y_degrees), (Some(DVec3::new(0.0, 0.0, 5.0)), 40.0));
        // Seen from z = 5 with a field of view of 90 degrees, as numpy prints it and as JSON.
        let numbers = "1 0 0 0\n0 1 0 0\n0 0 -1.2 3.8\n0 0 -1 5\n";
        let json = "[[1,0,0,0],[0,1,0,0],[0,0,-1.2,3.8],[0,0,-1,5]]";
        for text in [numbers, json] {
            let (camera, aspect) = of_bytes(text.as_bytes()).unwrap();
            assert_eq!(aspect, Some(1.0));
            assert!(camera.eye.unwrap().distance(DVec3::new(0.0, 0.0, 5.0)) < 1e-12);
            assert!((camera.fov_y_degrees - 90.0).abs() < 1e-12);
        }
        let scene = r#"{"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"camera": 0, "translation": [0, 2, 9]}],
            "cameras": [{"type": "orthographic", "orthographic": {"xmag": 2, "ymag": 1.5, "znear": 0.1, "zfar": 50}}]}"#;
        let (camera, aspect) = of_bytes(scene.as_bytes()).unwrap();
        assert_eq!((camera.parallel, camera.height, aspect), (true, Some(3.0), Some(2.0 / 1.5)));
        assert!(camera.target.unwrap().distance(DVec3::new(0.0, 2.0, 0.0)) < 1e-12);
    }

    #[test]
    fn a_picture_that_shows_other_sides_than_the_file_says_so_and_how_to_keep_them() {
        let of = |row: &str, width, height| {
            let text = format!("{row} 0 0 0\n0 1 0 0\n0 0 -1.2 3.8\n0 0 -1 5\n");
            let (_, aspect) = of_bytes(text.as_bytes()).unwrap();
            aspect_remark(Path::new("m.txt"), aspect.unwrap(), Size { width, height })
        };
        // A matrix of a picture 16:9, in pictures of that proportion and others.
        assert_eq!(of("0.5625", 1920, 1080), None);
        assert_eq!(of("0.5625", 455, 256), None);
        let remark = of("0.5625", 512, 512).unwrap();
        assert!(
            remark.starts_with("m.txt: its picture is 1.7778 times as wide as high, and this one 1.0000"),
            "{remark}"
        );
        assert!(remark.contains("--size 910x512"), "{remark}");
        // Oblong pixels.
        assert!(of("5", 128, 128).unwrap().contains("0.2000 times"));
        assert_eq!(of("1", 128, 128), None);
    }

    #[test]
    fn what_holds_no_camera_says_what_would() {
        for text in [
            "",
            "no camera",
            "1 2 3",
            "{}",
            "[1, 2]",
            "{\"camera\": {\"eye\": [1]}}",
            "{\"asset\": {\"version\": \"2.0\"}}",
            "null",
        ] {
            let problem = of_bytes(text.as_bytes()).map(|_| ()).unwrap_err();
            assert!(problem.contains("16 numbers"), "{text}: {problem}");
        }
        assert!(of_bytes(b"\xff\xfe").is_err());
    }
}
