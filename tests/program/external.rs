//! Files that a model names outside its folder are read only with permission.

use crate::hostile::SQUARE;
use crate::program::{assert_refused, one_line, tinta};
use crate::support::{Folder, root, scene_of_mesh};
use tinta::{LoadOptions, load};

/// A folder with a model's folder in it and, outside that, a material file and a picture.
fn outside() -> Folder {
    let folder = Folder::new();
    std::fs::create_dir_all(folder.path("model/art")).unwrap();
    let picture = std::fs::read(root().join("tests/goldens/ant-three-pass.png")).unwrap();
    for name in ["secret.png", "model/art/inside.png"] {
        folder.file(name, &picture);
    }
    folder.file("secret.mtl", b"newmtl a\nKd 1 0 0\n");
    folder.file("model/art/inside.mtl", b"newmtl a\nKd 0 0 1\n");
    std::os::unix::fs::symlink("../secret.png", folder.path("model/link.png")).unwrap();
    std::os::unix::fs::symlink("../secret.mtl", folder.path("model/link.mtl")).unwrap();
    std::os::unix::fs::symlink("art/inside.png", folder.path("model/inside-link.png")).unwrap();
    std::os::unix::fs::symlink("..", folder.path("model/up")).unwrap();
    folder
}

#[test]
fn material_files_outside_the_models_folder_are_followed_only_when_asked_to() {
    let folder = outside();
    let absolute = folder.path("secret.mtl");
    let with = |name: &str, allow_external: bool| {
        let text = format!("mtllib {name}\n{SQUARE}usemtl a\nf 1 2 3\nf 1 3 4\n");
        let model = folder.file("model/a.obj", text.as_bytes());
        let loaded = load(&model, &LoadOptions { allow_external, ..LoadOptions::default() }).unwrap();
        (loaded.mesh.materials.first().and_then(|material| material.color), loaded.remarks)
    };
    for name in ["../secret.mtl", &absolute, "link.mtl", "up/secret.mtl", "art/../../secret.mtl"] {
        let (color, remarks) = with(name, false);
        assert_eq!((color, remarks.len()), (None, 1), "{name}: {remarks:?}");
        assert!(remarks[0].contains("is outside its folder") && remarks[0].contains("--allow-external"), "{remarks:?}");
        assert_eq!(with(name, true), (Some([1.0, 0.0, 0.0]), vec![]), "{name}");
    }
    for name in ["art/inside.mtl", "../model/art/inside.mtl", "./art/../art/inside.mtl"] {
        assert_eq!(with(name, false), (Some([0.0, 0.0, 1.0]), vec![]), "{name}");
    }
}

#[test]
fn pictures_outside_the_models_folder_are_followed_only_when_asked_to() {
    let folder = outside();
    let absolute = folder.path("secret.png");
    let with = |name: &str, allow_external: bool| {
        folder.file("model/a.mtl", format!("newmtl a\nmap_Kd {name}\n").as_bytes());
        let text = format!("mtllib a.mtl\n{SQUARE}usemtl a\nf 1/1 2/1 3/2\nf 1/1 3/2 4/2\n");
        let model = folder.file("model/a.obj", text.as_bytes());
        let loaded = load(&model, &LoadOptions { allow_external, ..LoadOptions::default() }).unwrap();
        let scene = scene_of_mesh(loaded.mesh);
        let pictures = tinta::picture::material_pictures(&scene.objects[0].mesh.materials).unwrap();
        (pictures[0].is_some(), loaded.remarks)
    };
    for name in ["../secret.png", &absolute, "link.png", "up/secret.png", "..\\secret.png"] {
        let (is_there, remarks) = with(name, false);
        assert!(!is_there && remarks.len() == 1, "{name}: {remarks:?}");
        assert!(remarks[0].contains("is outside its folder") && remarks[0].contains("--allow-external"), "{remarks:?}");
        assert_eq!(with(name, true), (true, vec![]), "{name}");
    }
    for name in ["art/inside.png", "inside-link.png", "../model/art/inside.png"] {
        assert_eq!(with(name, false), (true, vec![]), "{name}");
    }
}

#[test]
fn a_picture_exchanged_for_a_link_after_the_model_was_read_is_not_opened() {
    let folder = outside();
    folder.file("model/a.mtl", b"newmtl a\nmap_Kd art/inside.png\n");
    let text = format!("mtllib a.mtl\n{SQUARE}usemtl a\nf 1/1 2/1 3/2\nf 1/1 3/2 4/2\n");
    let model = folder.file("model/a.obj", text.as_bytes());
    let exchanged = |allow_external: bool| {
        let mesh = load(&model, &LoadOptions { allow_external, ..LoadOptions::default() }).unwrap().mesh;
        std::fs::remove_file(folder.path("model/art/inside.png")).unwrap();
        std::os::unix::fs::symlink(folder.path("secret.png"), folder.path("model/art/inside.png")).unwrap();
        let scene = scene_of_mesh(mesh);
        tinta::picture::material_pictures(&scene.objects[0].mesh.materials)
            .map(|pictures| pictures.len())
            .map_err(|error| error.to_string())
    };
    let message = exchanged(false).unwrap_err();
    assert!(message.contains("inside.png: it is outside the model's folder; --allow-external"), "{message}");
    assert_eq!(exchanged(true), Ok(1));
}

#[test]
fn a_skin_that_the_user_names_may_lie_anywhere_and_the_option_is_the_programs_too() {
    let folder = outside();
    let text = format!("mtllib ../secret.mtl\n{SQUARE}usemtl a\nf 1/1 2/1 3/2\nf 1/1 3/2 4/2\n");
    let model = folder.file("model/a.obj", text.as_bytes());
    let skin = Some(folder.path("secret.png").into());
    let scene = scene_of_mesh(load(&model, &LoadOptions { skin, ..LoadOptions::default() }).unwrap().mesh);
    assert!(tinta::picture::material_pictures(&scene.objects[0].mesh.materials).unwrap().iter().all(Option::is_some));

    let output = tinta(&["info", &model]);
    one_line(&String::from_utf8(output.stderr).unwrap(), &["secret.mtl is outside", "--allow-external reads it"]);
    assert_refused(&tinta(&["info", &model, "--strict"]), &["1 missing material"]);
    let output = tinta(&["info", &model, "--strict", "--allow-external"]);
    assert_eq!((output.status.code(), output.stderr.as_slice()), (Some(0), b"".as_slice()));
}
