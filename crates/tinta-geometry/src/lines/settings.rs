//! The settings of lines: which classes are wanted, by which rules.

use crate::edges::{Class, ClassSet, CreaseAngle, SilhouetteRule};
use crate::error::{Error, Result};
use crate::lines::smooth::forms::FormSettings;
use crate::settings::{HasSettings, Setting, Table, Value as _, within};
use std::sync::LazyLock;

/// Which lines are wanted.
#[derive(Debug, Clone, PartialEq)]
pub struct LineSettings {
    /// Classes of lines. Default all but the seams of textures and normals, which belong to a model's data, not its shape, and the
    /// form lines, which are those of a smooth surface.
    pub classes: ClassSet,
    /// From which angle between faces an edge is a crease. Default 30 degrees; more find fewer lines.
    pub crease_angle: CreaseAngle,
    /// Whether creases are drawn only where they last: closed or long ones, and those at which a flat face of several triangles ends. Default
    /// no; then single folds of scans are drawn, too.
    pub lasting_creases: bool,
    /// Where silhouettes run: exact ones, the default, are what the faces show; smooth ones are what a curved surface that the faces stand
    /// for would show. The listing's rule is refused: it knows no exact lines.
    pub silhouette: SilhouetteRule,
    /// Whether hidden parts are found too. Default yes; without them [`VisibleLines::segments`](super::VisibleLines::segments) has what is seen alone, and no time
    /// is spent on what lies behind.
    pub finds_hidden: bool,
    /// Whether outlines are found, for [`LineSegment::is_outline`](super::LineSegment::is_outline); lines are cut where they begin and end. Default no: it takes
    /// time, and nobody else needs the cuts.
    pub finds_outline: bool,
    /// How strong form lines must be, where their classes are wanted.
    pub forms: FormSettings,
    /// Whether it is counted where silhouettes begin and end to be seen, and why, for [`VisibleLines::changes`](super::VisibleLines::changes). Default no; then hidden
    /// parts are found, too.
    pub counts_changes: bool,
    /// Whether each piece is decided by all faces and lines, without the search's hierarchies and shortcuts: a reference for tests, which
    /// takes minutes where the search takes a second. Default no. Refused with smooth silhouettes.
    pub reference: bool,
}

impl Default for LineSettings {
    fn default() -> Self {
        Self {
            classes: ClassSet::of(&[
                Class::Boundary,
                Class::NonManifold,
                Class::Silhouette,
                Class::Crease,
                Class::Material,
                Class::Intersection,
            ]),
            crease_angle: CreaseAngle::of_drawings(),
            lasting_creases: false,
            silhouette: SilhouetteRule::Exact,
            finds_hidden: true,
            finds_outline: false,
            forms: FormSettings::default(),
            counts_changes: false,
            reference: false,
        }
    }
}

impl HasSettings for LineSettings {
    fn table() -> &'static Table<Self> {
        static TABLE: LazyLock<Table<LineSettings>> =
            LazyLock::new(|| Table { settings: LineSettings::settings(), defaults: vec![LineSettings::default()] });
        &TABLE
    }
}

impl LineSettings {
    /// As by default, with the creases of Dachsbacher's listing: what the ink of all styles is measured against.
    pub fn as_published() -> Self {
        Self { crease_angle: CreaseAngle::default(), ..Self::default() }
    }

    /// Whether smooth contours are drawn.
    pub(super) fn has_smooth_contours(&self) -> bool {
        self.silhouette == SilhouetteRule::Smooth && self.classes.contains(Class::Silhouette)
    }

    /// The settings, for a table of something that has lines in it.
    pub fn settings() -> Vec<Setting<Self>> {
        let edges = vec![
            ClassSet::setting(ClassSet::ALL, |lines: &mut Self| &mut lines.classes),
            CreaseAngle::setting(|lines: &mut Self| &mut lines.crease_angle),
            Setting::flag(
                "lasting-creases",
                "Leave out the folds of scans: draw only creases that are long, closed, or at the end of a flat face",
                |lines: &Self| lines.lasting_creases,
                |lines, is_on| lines.lasting_creases = is_on,
            ),
            SilhouetteRule::setting(|lines: &mut Self| &mut lines.silhouette)
                .refusing(|lines| not_published(lines.silhouette))
                .offering(&["exact", "smooth"]),
        ];
        let forms = within(FormSettings::settings(), |lines: &mut Self| Some(&mut lines.forms));
        edges.into_iter().chain(forms).collect()
    }
}

/// Refuses the listing's rule.
pub(super) fn not_published(rule: SilhouetteRule) -> Result<()> {
    let problem = "style lines finds silhouettes exactly or smooth; leave it out, or draw --style inking into a .png";
    if rule == SilhouetteRule::Published { Err(Error::value("silhouette", rule.text(), problem)) } else { Ok(()) }
}
