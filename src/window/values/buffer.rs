//! The intermediate pictures a style can show.

use crate::choice::Choice;
use crate::edges::{Class, ClassSet};
use crate::error::ParseError;
use crate::request::Request;
use crate::scene::Color;
use crate::styles::{ClassColors, Inking, PaintMode, Show, Style, StyleName};
use std::str::FromStr;

/// One of a style's pictures or maps.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Buffer {
    /// One of its pictures.
    Show(Show),
    /// The model's edges, one colour a class; the same for all styles.
    EdgeClasses,
}

impl Default for Buffer {
    fn default() -> Self {
        Self::Show(Show::Final)
    }
}

/// Edge classes as the user writes them.
const EDGE_CLASSES: &str = "edge-classes";

impl Buffer {
    /// In the user's notation.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Show(show) => show.choice_name(),
            Self::EdgeClasses => EDGE_CLASSES,
        }
    }

    /// The request that draws this buffer of another; the finished picture if its style lacks the buffer.
    pub(crate) fn drawn(self, request: &Request) -> Request {
        let drawn = Request { show: Show::Final, ..request.clone() };
        match self {
            Self::EdgeClasses => Request { style: edge_classes(), exact_lines: false, ..drawn },
            Self::Show(show) if buffers(request.style.style_name()).contains(&self) => Request { show, ..drawn },
            Self::Show(_) => drawn,
        }
    }
}

impl FromStr for Buffer {
    type Err = ParseError;

    fn from_str(text: &str) -> Result<Self, ParseError> {
        match text {
            EDGE_CLASSES => Ok(Self::EdgeClasses),
            _ => Show::of_name(text).map(Self::Show).map_err(|problem| format!("{problem}, {EDGE_CLASSES}").into()),
        }
    }
}

/// The buffers of a style, its finished picture first.
pub fn buffers(style: StyleName) -> Vec<Buffer> {
    style.info().shows.iter().map(|show| Buffer::Show(*show)).chain([Buffer::EdgeClasses]).collect()
}

/// The colours of classes, in their order, far apart for eyes of any kind.
pub(in crate::window) const CLASS_COLORS: [(Class, [f32; 3]); 9] = [
    (Class::Boundary, [0.84, 0.37, 0.0]),
    (Class::NonManifold, [0.8, 0.1, 0.1]),
    (Class::Silhouette, [0.0, 0.0, 0.0]),
    (Class::Crease, [0.0, 0.45, 0.7]),
    (Class::Material, [0.0, 0.62, 0.45]),
    (Class::Texture, [0.8, 0.47, 0.65]),
    (Class::Normal, [0.75, 0.65, 0.0]),
    (Class::Part, [0.35, 0.7, 0.9]),
    (Class::Marked, [0.45, 0.3, 0.7]),
];

/// All edges by class on blank faces.
fn edge_classes() -> Style {
    let mut colors = ClassColors::default();
    for (class, color) in CLASS_COLORS {
        colors.0.set_class(class, Color(color));
    }
    Style::Inking(Inking { classes: ClassSet::EDGES, colors, paint: PaintMode::None, ..Inking::default() })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::Mesh;
    use crate::scene::{Scene, SceneSettings};
    use std::sync::Arc;

    #[test]
    fn every_style_plans_every_buffer_it_is_said_to_have_and_no_other() {
        let scene = Scene::new(vec![Arc::new(Mesh::triangle())], &SceneSettings::default()).unwrap();
        // Sand draws only models with pictures on them.
        for (name, style) in StyleName::of_passes().filter(|(_, style)| *style != StyleName::Sand) {
            for (_, show) in Show::ALL {
                let is_known = buffers(style).contains(&Buffer::Show(show));
                assert_eq!(Style::named(style).plan(&scene, show).is_ok(), is_known, "{name} {show:?}");
            }
            let classes = Buffer::EdgeClasses.drawn(&Request::of_style(style));
            assert!(classes.style.plan(&scene, classes.show).is_ok());
        }
    }

    #[test]
    fn buffers_are_read_by_the_names_they_have() {
        for (_, style) in StyleName::of_passes() {
            for buffer in buffers(style) {
                assert_eq!(buffer.name().parse(), Ok(buffer));
            }
        }
        assert!("bumps".parse::<Buffer>().unwrap_err().0.contains("edge-classes"));
    }
}
