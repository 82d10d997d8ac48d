//! Guarantees for programs that use the library: values that go from thread to thread, errors that `?` takes.

use std::error::Error as _;
use tinta::animation::AnimationWriter;
use tinta::plan::{Plan, Texture};
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
