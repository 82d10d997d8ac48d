//! The contents of the page's controls: the tables of settings, the models, the shaders.

use crate::errors::{said, unreadable};
use serde_json::{Value, json};
use tinta::glsl::es::{Stage, transcribed};
use tinta::keys::{action, sheet};
use tinta::mesh::{BUILTINS, Format};
use tinta::page::NOT_OF_BROWSERS;
use tinta::preset::{LOOKS, Look, PREFIX, Preset, SHIPPED};
use tinta::request::{OptionLayer, Request};
use tinta::settings::{HasSettings, Kind, OptionValue, Setting, on_off};
use tinta::{LoadOptions, SceneSettings, Style, StyleName};
use wasm_bindgen::prelude::wasm_bindgen;
use wasm_bindgen::{JsError, JsValue};

/// The options of what lies over and under a style's picture.
const AROUND: [&str; 2] = ["exact-lines", "ground"];

/// Whether a setting has a control in the page; the mouse sets the view.
fn is_of_page(name: &str) -> bool {
    name != "view" && !NOT_OF_BROWSERS.contains(&name)
}

/// Every style with its settings, the looks and presets, the settings of the scene and of reading models, the built-in models, the
/// formats of models, the sheet of keys: JSON.
#[wasm_bindgen]
pub fn tables() -> String {
    let request = Request::default();
    let around = AROUND.map(|name| Request::table().find(&request, name).map(|setting| control(setting, &request)));
    let styles: Vec<Value> = StyleName::ALL
        .into_iter()
        // WebGL does not draw faces as lines.
        .filter(|(_, of)| *of != StyleName::BackFaces)
        .map(|(name, of)| {
            let style = Style::named(of);
            let shows: Vec<Value> = of.info().shows.iter().map(|show| json!(show)).collect();
            let around = around.iter().flatten().filter(|_| of != StyleName::Lines).cloned();
            let settings: Vec<Value> = controls(&style).into_iter().chain(around).collect();
            json!({ "name": name, "draws_lines": of.draws_lines(), "shows": shows, "settings": settings })
        })
        .collect();
    // Meshes of surfaces are for measuring.
    let offered = BUILTINS.iter().filter(|model| model.closed_form().is_none());
    let models: Vec<Value> = offered.map(|model| json!({ "name": model.name, "what": model.what })).collect();
    let formats = Format::ALL.iter().map(|format| json!({ "name": format.name, "endings": format.endings }));
    let keys: Vec<Value> = sheet(true).map(|(keys, what)| json!({ "keys": keys, "what": what })).collect();
    let looks = LOOKS.iter().map(|look| json!({ "name": look.name, "about": look.about }));
    let presets = SHIPPED.iter().map(|(name, _)| json!({ "name": name, "about": "as the text prints it" }));
    json!({
        "version": env!("CARGO_PKG_VERSION"),
        "styles": styles,
        "looks": looks.chain(presets).collect::<Vec<_>>(),
        "scene": controls(&SceneSettings::default()),
        "read": controls(&LoadOptions::default()),
        "models": models,
        "formats": formats.collect::<Vec<_>>(),
        "keys": keys,
    })
    .to_string()
}

/// The controls of the page for this.
fn controls<T: HasSettings + Clone + 'static>(of: &T) -> Vec<Value> {
    let settings = T::table().of(Some(of)).into_iter().filter(|setting| is_of_page(setting.name));
    settings.map(|setting| control(setting, of)).collect()
}

/// The effect of a look or a preset: JSON, the style's name, then by their names the settings of the style, of the scene and of
/// reading, each a text; `null` is the default. `view` is the view that it draws from, if it has one.
///
/// # Errors
///
/// A sentence for an unknown name.
#[wasm_bindgen]
pub fn look(name: &str) -> Result<String, JsError> {
    let layer = match name.strip_prefix(PREFIX) {
        Some(_) => OptionLayer::File(Preset::read(name).map_err(said)?),
        None => OptionLayer::Look(Look::of_name(name).map_err(|error| JsError::new(&format!("{error}")))?),
    };
    let (request, _) = Request::from_layers(&[layer]).map_err(said)?;
    let of = |has: &dyn Fn(&str) -> bool| -> serde_json::Map<String, Value> {
        let options = request.options.iter().filter(|(name, _)| has(name.as_str()));
        options.map(|(name, value)| (name.clone(), text(value))).collect()
    };
    let is_of_scene = |name: &str| is_of_page(name) && SceneSettings::table().has(name);
    let is_of_reading = |name: &str| LoadOptions::table().has(name);
    let is_of_style = |name: &str| AROUND.contains(&name) || Style::table().has(name);
    let settings = of(&|name| is_of_style(name) && !is_of_scene(name) && !is_of_reading(name));
    let (mut scene, mut read) = (of(&is_of_scene), of(&is_of_reading));
    // Settings of another look return to their defaults.
    for other in LOOKS {
        for name in other.preset().map_err(said)?.options.into_keys() {
            if is_of_scene(&name) {
                scene.entry(name).or_insert(Value::Null);
            } else if is_of_reading(&name) {
                read.entry(name).or_insert(Value::Null);
            }
        }
    }
    let view = request.options.get("view").map(text);
    Ok(json!({ "style": request.style.name(), "settings": settings, "scene": scene, "read": read, "view": view })
        .to_string())
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

/// A shader in pieces, GLSL 1.20 and this browser's version: JSON, a list of pairs. It is the published one of this path, or its
/// replacement.
///
/// # Errors
///
/// A sentence for an unknown shader.
#[wasm_bindgen]
pub fn listing(path: &str, replacement: Option<String>) -> Result<String, JsError> {
    let published = tinta::glsl::source(path).ok_or_else(|| JsError::new(&format!("there is no shader {path}")))?;
    let text = replacement.as_deref().unwrap_or(published);
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
