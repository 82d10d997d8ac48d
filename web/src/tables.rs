//! The contents of the page's controls: the tables of settings, the models, the shaders.

use crate::errors::{said, unreadable};
use serde_json::{Value, json};
use tinta::glsl::es::{Stage, transcribed};
use tinta::keys::{action, sheet};
use tinta::mesh::BUILTINS;
use tinta::preset::{LOOKS, Look};
use tinta::request::{Layer, Request};
use tinta::settings::{HasSettings, Kind, OptionValue, Setting, on_off};
use tinta::{SceneSettings, Style, StyleName};
use wasm_bindgen::prelude::wasm_bindgen;
use wasm_bindgen::{JsError, JsValue};

/// Every style with its settings, those of the scene, the built-in models, the sheet of keys: JSON.
#[wasm_bindgen]
pub fn tables() -> String {
    let styles: Vec<Value> = StyleName::of_passes()
        .map(|(name, of)| {
            let style = Style::named(of);
            let settings: Vec<Value> =
                Style::table().of(Some(&style)).into_iter().map(|setting| control(setting, &style)).collect();
            let shows: Vec<Value> = of.info().shows.iter().map(|show| json!(show)).collect();
            json!({ "name": name, "shows": shows, "settings": settings })
        })
        .collect();
    let scene = SceneSettings::default();
    let of_scene: Vec<Value> =
        SceneSettings::table().of(Some(&scene)).into_iter().map(|setting| control(setting, &scene)).collect();
    // Meshes of surfaces are for measuring.
    let offered = BUILTINS.iter().filter(|model| model.closed_form().is_none());
    let models: Vec<Value> = offered.map(|model| json!({ "name": model.name, "what": model.what })).collect();
    let keys: Vec<Value> = sheet(true).map(|(keys, what)| json!({ "keys": keys, "what": what })).collect();
    // The page saves vector lines but does not draw them.
    let looks = LOOKS.iter().filter(|look| !look.draws_lines());
    let looks: Vec<Value> = looks.map(|look| json!({ "name": look.name, "about": look.about })).collect();
    json!({ "version": env!("CARGO_PKG_VERSION"), "styles": styles, "looks": looks, "scene": of_scene, "models": models, "keys": keys })
        .to_string()
}

/// A look's effect on a side and on the scene: JSON, the style's name, its settings and the scene's, each a text by its name;
/// `null` is the default.
///
/// # Errors
///
/// A sentence for an unknown look.
#[wasm_bindgen]
pub fn look(name: &str) -> Result<String, JsError> {
    let look = Look::of_name(name).map_err(|error| JsError::new(&format!("{error}")))?;
    let (request, _) = Request::from_layers(&[Layer::Look(look)]).map_err(said)?;
    let of = |is_of: &dyn Fn(&str) -> bool| -> serde_json::Map<String, Value> {
        let mut options = request.options.iter().filter(|(name, _)| is_of(name.as_str()));
        options.by_ref().map(|(name, value)| (name.clone(), text(value))).collect()
    };
    let settings = of(&|name| Style::table().has(name));
    // The page sets the picture's size, and the mouse its view.
    let is_of_scene = |name: &str| !["size", "view"].contains(&name) && SceneSettings::table().has(name);
    let mut scene = of(&is_of_scene);
    // Settings of another look return to their defaults.
    for other in LOOKS {
        for name in other.preset().map_err(said)?.options.into_keys().filter(|name| is_of_scene(name)) {
            scene.entry(name).or_insert(Value::Null);
        }
    }
    Ok(json!({ "style": request.style.name(), "settings": settings, "scene": scene }).to_string())
}

/// A value as a control has it.
fn text(value: &OptionValue) -> Value {
    match value {
        OptionValue::Switch(is_on) => on_off(*is_on).into(),
        OptionValue::Text(text) => text.as_str().into(),
        OptionValue::Texts(texts) => texts.join(",").into(),
    }
}

/// A setting as a control needs it.
fn control<T: Clone + 'static>(setting: &Setting<T>, of: &T) -> Value {
    let kind = match &setting.kind {
        Kind::Numbers { count, range, decimals } => {
            json!({ "is": "numbers", "count": count, "range": range, "decimals": decimals })
        }
        Kind::Choice(names) => json!({ "is": "choice", "names": names }),
        Kind::Recipe(names) => json!({ "is": "recipe", "names": names }),
        Kind::Several(names) => json!({ "is": "several", "names": names }),
        Kind::Switch => json!({ "is": "switch" }),
        Kind::Flag => json!({ "is": "flag" }),
        Kind::File => json!({ "is": "file" }),
        Kind::Color => json!({ "is": "color" }),
        Kind::Colors { offered, example, .. } | Kind::Text { offered, example } => {
            json!({ "is": "text", "offered": offered, "example": example })
        }
    };
    json!({
        "name": setting.name,
        "label": setting.label(),
        "kind": kind,
        "help": setting.help,
        "heading": setting.heading,
        "open": setting.open,
        "default": setting.value(of),
    })
}

/// A shader of `glsl/` in pieces, the published version and this browser's: JSON, a list of pairs.
///
/// # Errors
///
/// A sentence for an unknown shader.
#[wasm_bindgen]
pub fn listing(path: &str) -> Result<String, JsError> {
    let text = tinta::glsl::source(path).ok_or_else(|| JsError::new(&format!("there is no shader {path}")))?;
    let pieces = transcribed(Stage::of(path), text).map_err(|problem| JsError::new(&format!("{path}: {problem}")))?;
    let pairs: Vec<[&str; 2]> = pieces.iter().map(|piece| [piece.original.as_str(), piece.text.as_str()]).collect();
    serde_json::to_string(&pairs).map_err(unreadable)
}

/// The paths of all shaders: JSON.
#[wasm_bindgen]
pub fn shaders() -> String {
    json!(tinta::glsl::SOURCES.iter().map(|(path, _)| path).collect::<Vec<_>>()).to_string()
}

/// The error for a setting's text, if the style refuses it.
#[wasm_bindgen]
pub fn refusal(style: &str, name: &str, text: &str) -> Option<String> {
    let style = Style::named(style.parse().ok()?);
    let setting = Style::table().find(&style, name)?;
    setting.set(&mut style.clone(), text).err().map(|error| error.to_string())
}

/// The action of a key, by its `KeyboardEvent.key` name: JSON, an action's name, or an object of its name and value; `null` for a
/// key without an action.
#[wasm_bindgen]
pub fn key_action(key: &str, has_shift: bool, has_ctrl: bool) -> String {
    json!(action(|name| name.eq_ignore_ascii_case(key), has_shift, has_ctrl)).to_string()
}

/// Runs when the page opens: prints a bug's message and place to the console.
#[wasm_bindgen(start)]
pub fn start() {
    std::panic::set_hook(Box::new(|panic| {
        web_sys::console::error_1(&JsValue::from_str(&format!("tinta: {panic}")));
    }));
}
