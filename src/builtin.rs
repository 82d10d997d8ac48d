//! The models that need no file: `builtin:bust` and friends, made by the program in `models/`.

use crate::choice::nearest;
use crate::error::{Error, Result};
use tinta_geometry::mesh::{LoadOptions, LoadStage, Loaded, read_bytes};

/// A built-in model.
#[derive(Debug, Clone, Copy)]
pub struct Builtin {
    /// Its name behind `builtin:`.
    pub name: &'static str,
    /// What it shows, for help pages.
    pub what: &'static str,
    /// The model's file.
    model: &'static [u8],
    /// Files that it names.
    beside: &'static [(&'static str, &'static [u8])],
}

/// All built-in models.
pub const BUILTINS: [Builtin; 5] = [
    Builtin {
        name: "bust",
        what: "a portrait bust",
        model: include_bytes!("../models/bust.obj"),
        beside: &[("bust.mtl", include_bytes!("../models/bust.mtl"))],
    },
    Builtin {
        name: "open-box",
        what: "a box without its lid",
        model: include_bytes!("../models/open-box.obj"),
        beside: &[],
    },
    Builtin {
        name: "ant",
        what: "an ant",
        model: include_bytes!("../models/ant.obj"),
        beside: &[("ant.mtl", include_bytes!("../models/ant.mtl"))],
    },
    Builtin {
        name: "gear",
        what: "a gear wheel",
        model: include_bytes!("../models/gear.obj"),
        beside: &[("gear.mtl", include_bytes!("../models/gear.mtl"))],
    },
    Builtin {
        name: "soldier",
        what: "a toy soldier with a skin, from Quake 2's format",
        model: include_bytes!("../models/soldier.md2"),
        beside: &[("soldier.pcx", include_bytes!("../models/soldier.pcx"))],
    },
];

/// The built-in model a name stands for; `None` if the name is a path, an error if it names none.
pub(crate) fn find(name: &str) -> Option<Result<Builtin>> {
    let short = name.strip_prefix("builtin:")?;
    let found = BUILTINS.into_iter().find(|builtin| builtin.name == short);
    Some(found.ok_or_else(|| {
        let choice = match nearest(short, &BUILTINS.map(|builtin| builtin.name)) {
            Some(meant) => format!("did you mean builtin:{meant}?"),
            None => format!("choose one of {}", BUILTINS.map(|builtin| format!("builtin:{}", builtin.name)).join(", ")),
        };
        Error::model(name, format!("there is no such built-in model; {choice}"))
    }))
}

/// Reads a model: `builtin:NAME`, or an OBJ, PLY, STL, MD2, 3DS or glTF file.
///
/// # Errors
///
/// [`Error::File`] when there is no such built-in model; those of [`tinta_geometry::load()`].
pub fn load(path: &str, options: &LoadOptions) -> Result<Loaded> {
    load_watched(path, options, &|_| {})
}

/// As [`load`], for whoever shows how far it is: `watch` is told of each stage when it begins.
///
/// # Errors
///
/// Those of [`load`].
pub fn load_watched(path: &str, options: &LoadOptions, watch: &dyn Fn(LoadStage)) -> Result<Loaded> {
    match find(path) {
        Some(model) => {
            let model = model?;
            watch(LoadStage::Joining);
            read_bytes(model.model, path, model.beside, options)
        }
        None => tinta_geometry::mesh::load_watched(path, options, watch),
    }
}
