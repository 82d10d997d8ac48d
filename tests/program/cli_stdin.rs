//! Models and lists from standard input, where a command line has `-`.

use crate::program::{refused_in_one_line, said, tinta};
use crate::support::{Folder, root};
use std::io::Write;
use std::process::{Command, Output, Stdio};

/// Runs a command with these bytes on its standard input.
fn piped(arguments: &[&str], bytes: &[u8]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_tinta"));
    let command = command.args(arguments).current_dir(root());
    let mut child = command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    // A program that does not read it has already refused it.
    let _ = child.stdin.take().unwrap().write_all(bytes);
    child.wait_with_output().unwrap()
}

const OBJ: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
const PLY: &str = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n\
    element tristrips 1\nproperty list int int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n6 0 2 1 3 0 2\n";
const STL: &str = "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid a\n";

fn binary_stl() -> Vec<u8> {
    let corners: Vec<u8> =
        [0.0f32, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0].map(f32::to_le_bytes).concat();
    // It begins like text, but its length shows a binary file.
    let header = [b"solid".as_slice(), &[b' '; 75]].concat();
    [header.as_slice(), &1u32.to_le_bytes(), &corners, &[0, 0]].concat()
}

#[test]
fn a_model_of_every_format_is_drawn_from_a_pipe_as_from_its_file() {
    let folder = Folder::new();
    let soldier = std::fs::read(root().join("models/soldier.md2")).unwrap();
    let glb = crate::support::gltf_files::box_file().binary();
    let models: [(&str, &[u8]); 6] = [
        ("a.obj", OBJ.as_bytes()),
        ("a.ply", PLY.as_bytes()),
        ("text.stl", STL.as_bytes()),
        ("binary.stl", &binary_stl()),
        ("a.md2", &soldier),
        ("a.glb", &glb),
    ];
    for (name, bytes) in models {
        let file = folder.file(name, bytes);
        let (from_file, from_pipe) = (folder.path("file.png"), folder.path("pipe.png"));
        let draw = |model: &'static str, output: &str| {
            let model = if model.is_empty() { file.clone() } else { model.to_owned() };
            piped(&["render", &model, "-o", output, "--size", "48", "--no-recipe"], bytes)
        };
        let (filed, piped) = (draw("", &from_file), draw("-", &from_pipe));
        assert_eq!((filed.status.code(), piped.status.code()), (Some(0), Some(0)), "{name}: {}", said(&piped));
        assert!(std::fs::read(&from_file).unwrap() == std::fs::read(&from_pipe).unwrap(), "{name}");
        assert_eq!(said(&piped).replace("standard input", &file), said(&filed), "{name}");
    }
}

#[test]
fn a_picture_can_be_piped_through() {
    let output = piped(&["render", "-", "-o", "-", "--size", "40"], OBJ.as_bytes());
    assert_eq!(image::load_from_memory(&output.stdout).unwrap().width(), 40, "{}", said(&output));
    let counted = piped(&["info", "-", "--json"], OBJ.as_bytes());
    assert!(String::from_utf8_lossy(&counted.stdout).contains("\"standard input\""), "{}", said(&counted));
}

#[test]
fn what_is_no_model_on_standard_input_is_refused_in_a_sentence() {
    let folder = Folder::new();
    let out = folder.path("out.png");
    for (bytes, sentence) in [
        (b"".as_slice(), "nothing came; pipe a model file into it, or see what the command before the pipe says"),
        (b"dear diary", "this is not a model in a supported format"),
        (b"<html>404</html>", "this is not a model in a supported format"),
        (b"v 0 0 0\nv 1 0 0\n", "it holds 2 vertices but no faces"),
        (b"{\"asset\":{\"version\":\"1.0\"},\"meshes\":{}}", "it is glTF 1.0"),
    ] {
        let output = piped(&["render", "-", "-o", &out], bytes);
        let said = said(&output);
        assert_eq!((output.status.code(), output.stdout.len()), (Some(2), 0), "{said}");
        assert!(said.starts_with("tinta: standard input: ") && said.contains(sentence), "{said}");
        assert_eq!(said.lines().count(), 1, "{said}");
    }
    assert!(!std::path::Path::new(&out).exists());
    refused_in_one_line(&["view", "-"], &["standard input: the window reads its models again"]);
}

#[test]
fn a_recipe_keeps_the_hash_of_what_was_piped_in_and_again_says_what_it_needs() {
    let folder = Folder::new();
    let (first, again) = (folder.path("a.png"), folder.path("again.png"));
    assert_eq!(piped(&["render", "-", "-o", &first, "--size", "48"], OBJ.as_bytes()).status.code(), Some(0));
    let sha256 = "SHA-256 ";
    let refused = tinta(&["again", &first, "-o", &again]);
    let message = said(&refused);
    assert_eq!(refused.status.code(), Some(2), "{message}");
    assert!(
        message
            .contains(&format!("standard input: the picture's model came from there ({} bytes, {sha256}", OBJ.len()))
    );
    assert!(message.contains("pipe it in again with --model -, or say where it is now with --model FILE"), "{message}");
    assert!(!std::path::Path::new(&again).exists());
    let redrawn = piped(&["again", &first, "-o", &again, "--model", "-"], OBJ.as_bytes());
    assert_eq!(
        (redrawn.status.code(), said(&redrawn).contains("byte for byte")),
        (Some(0), true),
        "{}",
        said(&redrawn)
    );
    let other = OBJ.replace("v 1 0 0", "v 2 0 0");
    let redrawn = piped(&["again", &first, "-o", &again, "--model", "-"], other.as_bytes());
    assert_eq!(redrawn.status.code(), Some(1), "{}", said(&redrawn));
    assert!(said(&redrawn).contains("- was ") && said(&redrawn).contains(sha256), "{}", said(&redrawn));
}

#[test]
fn a_list_of_jobs_is_read_from_standard_input() {
    let folder = Folder::new();
    let done = folder.path("done");
    let job = r#"{"id": "a", "command": "render", "model": "builtin:open-box", "output": "a.svg", "size": 64}"#;
    let output = piped(&["batch", "-", "-o", &done], job.as_bytes());
    assert_eq!(output.status.code(), Some(0), "{}", said(&output));
    assert!(std::path::Path::new(&done).join("a.svg").exists());
    let nothing = piped(&["batch", "-", "-o", &done], b"");
    assert!(said(&nothing).contains("standard input: nothing came; pipe a list of jobs into it"), "{}", said(&nothing));
    let wrong = piped(&["batch", "-", "-o", &folder.path("x")], job.replace("builtin:open-box", "-").as_bytes());
    let message = "tinta: standard input: line 1: model: - is standard input, which jobs lack; name a file\n";
    assert_eq!((wrong.status.code(), said(&wrong)), (Some(2), message.to_owned()));
}
