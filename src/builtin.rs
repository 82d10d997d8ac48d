//! The models that need no file: `builtin:bust` and friends, made by the program in `models/`, and meshes of surfaces in closed form.

use crate::choice::nearest;
use crate::error::{Error, Result};
use glam::DVec3;
use tinta_geometry::lines::closed_forms::{ClosedForm, Patch};
use tinta_geometry::mesh::{LoadOptions, LoadStage, LoadedModel, read_bytes};

/// A built-in model.
#[derive(Debug, Clone, Copy)]
pub struct Builtin {
    /// Its name behind `builtin:`.
    pub name: &'static str,
    /// A description of the model, for help pages.
    pub what: &'static str,
    source: Source,
}

/// The source of a built-in model's triangles.
#[derive(Debug, Clone, Copy)]
enum Source {
    /// The model's file, and those that it names.
    File(&'static [u8], &'static [(&'static str, &'static [u8])]),
    /// A surface that can be tessellated into any number of triangles.
    Surface(ClosedForm),
}

/// Triangles of a surface named without a number.
const TRIANGLES: usize = 10_000;

/// Least and most triangles of a surface.
const SURFACE_TRIANGLES: [usize; 2] = [100, 4_000_000];

impl Builtin {
    /// The surface that its meshes stand for, if they are of one.
    pub fn closed_form(&self) -> Option<ClosedForm> {
        if let Source::Surface(form) = self.source { Some(form) } else { None }
    }
}

/// A built-in model by the name a user gives: `builtin:NAME`, or `builtin:NAME:TRIANGLES` for a surface.
#[derive(Debug, Clone, Copy)]
pub struct NamedBuiltin {
    /// The model.
    pub builtin: Builtin,
    /// The approximate number of triangles, for a surface.
    pub triangles: usize,
}

/// All built-in models; static, so that a program holds their files once.
pub static BUILTINS: [Builtin; 13] = [
    Builtin {
        name: "bust",
        what: "a portrait bust",
        source: Source::File(
            include_bytes!("../models/bust.obj"),
            &[("bust.mtl", include_bytes!("../models/bust.mtl"))],
        ),
    },
    Builtin {
        name: "open-box",
        what: "a box without its lid",
        source: Source::File(include_bytes!("../models/open-box.obj"), &[]),
    },
    Builtin {
        name: "ant",
        what: "an ant",
        source: Source::File(include_bytes!("../models/ant.obj"), &[("ant.mtl", include_bytes!("../models/ant.mtl"))]),
    },
    Builtin {
        name: "gear",
        what: "a gear wheel",
        source: Source::File(
            include_bytes!("../models/gear.obj"),
            &[("gear.mtl", include_bytes!("../models/gear.mtl"))],
        ),
    },
    Builtin {
        name: "car",
        what: "a car of parts that touch and overlap",
        source: Source::File(include_bytes!("../models/car.obj"), &[("car.mtl", include_bytes!("../models/car.mtl"))]),
    },
    Builtin {
        name: "case",
        what: "a case with drawers that lie flush in its frame",
        source: Source::File(
            include_bytes!("../models/case.obj"),
            &[("case.mtl", include_bytes!("../models/case.mtl"))],
        ),
    },
    Builtin {
        name: "plates",
        what: "two plates whose holes are filled by pins",
        source: Source::File(
            include_bytes!("../models/plates.obj"),
            &[("plates.mtl", include_bytes!("../models/plates.mtl"))],
        ),
    },
    Builtin {
        name: "soldier",
        what: "a toy soldier with a skin, from Quake 2's format",
        source: Source::File(
            include_bytes!("../models/soldier.md2"),
            &[("soldier.pcx", include_bytes!("../models/soldier.pcx"))],
        ),
    },
    Builtin {
        name: "sphere",
        what: "a sphere of 10,000 triangles; sphere:500 of about 500, as all of these",
        source: Source::Surface(ClosedForm::Ellipsoid { half_axes: DVec3::ONE }),
    },
    Builtin {
        name: "ellipsoid",
        what: "an ellipsoid",
        source: Source::Surface(ClosedForm::Ellipsoid { half_axes: DVec3::new(1.0, 0.6, 1.4) }),
    },
    Builtin { name: "torus", what: "a torus", source: Source::Surface(ClosedForm::Torus { ring: 1.0, tube: 0.4 }) },
    Builtin {
        name: "superquadric",
        what: "a box with round edges",
        source: Source::Surface(ClosedForm::Superquadric { half_axes: DVec3::new(1.0, 0.6, 1.4), power: 4 }),
    },
    Builtin {
        name: "patch",
        what: "hills on a bicubic patch",
        source: Source::Surface(ClosedForm::Patch(Patch::HILLS)),
    },
];

/// The built-in model of a name; `None` if the name is a path.
///
/// # Errors
///
/// [`Error::File`] for an unknown model, or an impossible number of triangles.
pub fn builtin(name: &str) -> Option<Result<NamedBuiltin>> {
    let short = name.strip_prefix("builtin:")?;
    let (short, count) = short.split_once(':').map_or((short, None), |(short, count)| (short, Some(count)));
    let found = BUILTINS.into_iter().find(|builtin| builtin.name == short);
    let Some(builtin) = found else {
        let choice = match nearest(short, &BUILTINS.map(|builtin| builtin.name)) {
            Some(meant) => format!("did you mean builtin:{meant}?"),
            None => format!("choose one of {}", BUILTINS.map(|builtin| format!("builtin:{}", builtin.name)).join(", ")),
        };
        return Some(Err(Error::model(name, format!("there is no such built-in model; {choice}"))));
    };
    let [least, most] = SURFACE_TRIANGLES;
    let triangles =
        count.map_or(Some(TRIANGLES), |count| count.parse().ok().filter(|count| (least..=most).contains(count)));
    Some(match (builtin.source, triangles) {
        (Source::File(..), _) if count.is_some() => {
            Err(Error::model(name, format!("this model has one number of triangles; write builtin:{short}")))
        }
        (_, Some(triangles)) => Ok(NamedBuiltin { builtin, triangles }),
        (_, None) => Err(Error::model(
            name,
            format!("a surface is made of {least} to {most} triangles; write for example builtin:{short}:{TRIANGLES}"),
        )),
    })
}

/// Reads a model: `builtin:NAME`, or a file as [`tinta_geometry::load()`] reads it.
///
/// # Errors
///
/// [`Error::File`] when there is no such built-in model; those of [`tinta_geometry::load()`].
pub fn load(path: &str, options: &LoadOptions) -> Result<LoadedModel> {
    load_watched(path, options, &|_| {})
}

/// Like [`load`], with progress: `watch` receives each stage when it begins.
///
/// # Errors
///
/// Those of [`load`].
pub fn load_watched(path: &str, options: &LoadOptions, watch: &dyn Fn(LoadStage)) -> Result<LoadedModel> {
    match builtin(path) {
        Some(model) => {
            let model = model?;
            watch(LoadStage::Joining);
            match model.builtin.source {
                Source::File(file, beside) => read_bytes(file, path, beside, options),
                Source::Surface(form) => {
                    let mesh = form.mesh_with(model.triangles, 0.0, options)?;
                    Ok(LoadedModel {
                        mesh,
                        frames: Vec::new(),
                        files: Vec::new(),
                        remarks: Vec::new(),
                        stages: Vec::new(),
                    })
                }
            }
        }
        None => tinta_geometry::mesh::load_watched(path, options, watch),
    }
}
