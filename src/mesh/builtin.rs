//! The models that need no file: `builtin:bust` and friends, made by the program in `models/`.

use super::{obj, soup::Soup};
use crate::error::{Error, Result};

/// A built-in model.
#[derive(Debug, Clone, Copy)]
pub struct Builtin {
    /// Its name behind `builtin:`.
    pub name: &'static str,
    /// What it shows, for help pages.
    pub what: &'static str,
    obj: &'static [u8],
    mtl: &'static [u8],
}

/// All built-in models.
pub const BUILTINS: [Builtin; 4] = [
    Builtin {
        name: "bust",
        what: "a portrait bust",
        obj: include_bytes!("../../models/bust.obj"),
        mtl: include_bytes!("../../models/bust.mtl"),
    },
    Builtin {
        name: "open-box",
        what: "a box without its lid",
        obj: include_bytes!("../../models/open-box.obj"),
        mtl: b"",
    },
    Builtin {
        name: "ant",
        what: "an ant",
        obj: include_bytes!("../../models/ant.obj"),
        mtl: include_bytes!("../../models/ant.mtl"),
    },
    Builtin {
        name: "gear",
        what: "a gear wheel",
        obj: include_bytes!("../../models/gear.obj"),
        mtl: include_bytes!("../../models/gear.mtl"),
    },
];

/// The built-in model a name stands for; `None` if the name is a path, an error if it names none.
pub fn find(name: &str) -> Option<Result<Builtin>> {
    let short = name.strip_prefix("builtin:")?;
    let found = BUILTINS.into_iter().find(|builtin| builtin.name == short);
    Some(found.ok_or_else(|| {
        let names = BUILTINS.map(|builtin| format!("builtin:{}", builtin.name)).join(", ");
        Error::model(name, format!("there is no such built-in model; take one of {names}"))
    }))
}

/// Reads a built-in model as a file would be.
pub(super) fn read(builtin: &Builtin, name: &str, remarks: &mut Vec<String>) -> Result<Soup> {
    obj::read(builtin.obj, name, &obj::Materials::Text(builtin.mtl), remarks)
}
