//! Guarantees for programs that use the library: values that go from thread to thread, errors that `?` takes.

use crate::support::drawn::{lines, segment};
use crate::support::scene;
use std::error::Error as _;
use tinta::animation::AnimationWriter;
use tinta::edges::Class;
use tinta::lines::{DrawingSettings, pdf, svg};
use tinta::plan::{Plan, Texture};
use tinta::record::drawing_json;
use tinta::{
    Camera, Color, EdgeList, Error, LoadOptions, Mesh, ParseError, Picture, Preset, Recipe, Scene, SceneSettings, Size,
    Style, Target, VisibleLines,
};

fn is_send<T: Send>() {}

fn is_send_and_sync<T: Send + Sync>() {}

#[test]
fn values_are_shared_by_threads() {
    is_send_and_sync::<(Error, ParseError)>();
    is_send_and_sync::<(Mesh, LoadOptions, Scene, SceneSettings, Camera, EdgeList)>();
    is_send_and_sync::<(Style, Plan, Texture, Preset, Recipe)>();
    is_send_and_sync::<(Picture, Target, VisibleLines)>();
    is_send::<AnimationWriter>();
}

#[test]
fn a_text_that_is_no_value_is_an_error_of_this_crate() {
    fn read(text: &str) -> tinta::Result<(Color, Size)> {
        let (color, size) = text.split_once(' ').unwrap();
        Ok((color.parse()?, size.parse()?))
    }
    assert_eq!(read("tomato 640x480").unwrap().1, Size { width: 640, height: 480 });
    let error = read("tomatoe 640x480").unwrap_err();
    assert_eq!(error.to_string(), "a colour is a CSS name or #rrggbb, for example tan or #d2b48c");
    assert_eq!((error.kind(), error.source().is_none()), ("text", true));
}

#[test]
fn a_scene_is_made_of_meshes_and_of_shared_ones() {
    let shared = std::sync::Arc::new(Mesh::triangle());
    let settings = SceneSettings::default();
    assert_eq!(Scene::new([Mesh::triangle()], &settings).unwrap().triangle_count(), 1);
    assert_eq!(Scene::new(vec![shared.clone(), shared], &settings).unwrap().triangle_count(), 2);
}

#[test]
fn a_part_is_marked_in_every_file_and_a_whole_is_not() {
    let scene = scene("builtin:open-box", 32, 32);
    let whole = lines(vec![segment(Class::Silhouette, true, [10.0, 10.0], [90.0, 50.0])]);
    let part = VisibleLines { undecided: 3, ..whole.clone() };
    let note = "partial: the time was over before 3 lines were decided";
    assert_eq!((part.partial_note().as_deref(), whole.partial_note()), (Some(note), None));
    let with_specks = VisibleLines { has_specks: true, ..part.clone() };
    assert_eq!(with_specks.partial_note(), Some(format!("{note} and specks were left out")));
    let settings = DrawingSettings::default();
    let texts = |lines: &VisibleLines| {
        let pdf = pdf(lines, &settings).unwrap();
        [
            svg(lines, &settings).unwrap(),
            drawing_json(lines, None, &scene).unwrap(),
            String::from_utf8_lossy(&pdf).into_owned(),
        ]
    };
    for text in texts(&part) {
        assert!(text.contains(note), "{text}");
    }
    for text in texts(&whole) {
        assert!(!text.contains("partial"), "{text}");
    }
    let json: serde_json::Value = serde_json::from_str(&texts(&part)[1]).unwrap();
    assert_eq!((&json["partial"], &json["undecided"]), (&note.into(), &3.into()));
}
