//! The settings of visible lines: edge classes and the rules for finding them.

use crate::edges::{Class, ClassSet, CreaseAngle, SilhouetteRule};
use crate::error::{Error, Result};
use crate::lines::parts::rules::PartRules;
use crate::lines::smooth::forms::settings::FormSettings;
use crate::settings::{HasSettings, Setting, Table, Value as _, within};
use std::sync::LazyLock;

/// Which lines are found, and how.
#[derive(Debug, Clone, PartialEq)]
pub struct LineSettings {
    /// Classes of lines. Default: all except form lines, which belong to a smooth surface, and texture and normal
    /// seams, which belong to the model's data.
    pub classes: ClassSet,
    /// Angle between two faces from which their edge is a crease. Default 30 degrees; a larger angle finds fewer
    /// lines.
    pub crease_angle: CreaseAngle,
    /// Whether to draw only lasting creases: closed ones and long ones that stand out from the edges around them, and those at the
    /// end of a flat face of several triangles. They continue along edges of two thirds of the crease angle. Default false, which
    /// draws each crease by itself, also single folds of scans.
    pub lasting_creases: bool,
    /// Whether a crease lies where the mesh's normals on both sides of an edge differ by the crease angle, instead of its faces: where
    /// shading breaks. It ends within the edge where they approach each other. Default false.
    pub creases_by_normals: bool,
    /// The rule for silhouettes. `Exact`, the default, finds those of the faces. `Smooth` finds those of the curved
    /// surface that the faces approximate. `Published` is refused because it has no exact lines.
    pub silhouette: SilhouetteRule,
    /// How far a curve or a point may lie behind a face and still count as on it, which does not hide it. A share of
    /// the scene's radius, 0 to 0.1; in perspective it is exact at the depth of the scene's centre and proportional
    /// to the depth. Default 1e-4: the rounding of coordinates with five digits. A larger value also lifts curves
    /// that cut below a coarse surface, and shows those behind a wall as thin.
    pub on_surface: f64,
    /// Styles of parts: colour, width, classes, crease angle, role in hiding. Default none.
    pub parts: PartRules,
    /// Whether seams are left out where coplanar faces of one material meet across parts of one file. Default false.
    pub joins_parts: bool,
    /// Whether hidden parts are found too. Default true. If false,
    /// [`VisibleLines::segments`](super::VisibleLines::segments) holds visible parts only, and hidden ones take no
    /// time.
    pub finds_hidden: bool,
    /// Whether outlines are found, for [`LineSegment::is_outline`](super::LineSegment::is_outline), and lines cut at
    /// their ends. Default false, because it takes time and only outlines need the cuts.
    pub finds_outline: bool,
    /// How strong form lines must be, if their classes are selected.
    pub forms: FormSettings,
    /// Whether to count where silhouettes begin and end to be visible, and why, for
    /// [`VisibleLines::changes`](super::VisibleLines::changes). Default false. If true, hidden parts are found too.
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
                Class::Marked,
                Class::Intersection,
                Class::Curve,
                Class::Point,
            ]),
            crease_angle: CreaseAngle::of_drawings(),
            lasting_creases: false,
            creases_by_normals: false,
            silhouette: SilhouetteRule::Exact,
            on_surface: 1e-4,
            parts: PartRules::default(),
            joins_parts: false,
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
    /// The defaults, with the creases of Dachsbacher's listing and without a file's marks, curves and points: the reference for the ink of all styles.
    pub fn as_published() -> Self {
        let base = Self::default();
        let classes = base.classes.without(&[Class::Marked, Class::Curve, Class::Point]);
        Self { crease_angle: CreaseAngle::default(), classes, ..base }
    }

    pub(super) fn has_smooth_contours(&self) -> bool {
        self.silhouette == SilhouetteRule::Smooth && self.classes.contains(Class::Silhouette)
    }

    /// The settings, for tables of structs that contain these.
    pub fn settings() -> Vec<Setting<Self>> {
        let edges = vec![
            ClassSet::setting(ClassSet::ALL, |lines: &mut Self| &mut lines.classes),
            CreaseAngle::setting(|lines: &mut Self| &mut lines.crease_angle),
            Setting::flag(
                "lasting-creases",
                "Draw creases as whole lines, without the folds of scans and the facets of coarse figures: only long and closed ones, \
                 and those at the end of a flat face",
                |lines: &Self| lines.lasting_creases,
                |lines, is_on| lines.lasting_creases = is_on,
            )
            .inside("crease-angle"),
            SilhouetteRule::setting(|lines: &mut Self| &mut lines.silhouette)
                .refusing(|lines| not_published(lines.silhouette))
                .offering(&["exact", "smooth"]),
            Setting::field(
                "on-surface",
                "SHARE",
                "Distance behind a face, as a share of the scene's radius, up to which a curve or a point still lies on \
                 it and is seen; more lifts curves out of coarse surfaces",
                |lines: &mut Self| &mut lines.on_surface,
            )
            .range(*ON_SURFACE.start(), *ON_SURFACE.end(), 5),
            Setting::field(
                "part",
                "RULE",
                "Style of some parts: PATTERN: SETTINGS, for instance 'bolt*: color=red, ghost'; the pattern names parts and \
                 models, or with material: before it materials; settings are color (of lines), fill (of the surface), line-width, classes (with + \
                 between them), crease-angle, hidden, and ghost (drawn, hides nothing) or occlude-only (hides, is not drawn) or uncut (--section leaves it whole); give it \
                 again for more parts, later rules above earlier ones",
                |lines: &mut Self| &mut lines.parts,
            )
            .repeated(PartRules::BETWEEN)
            .common(),
            Setting::flag(
                "join-parts",
                "Leave out seams where coplanar faces of one material meet across parts of one file",
                |lines: &Self| lines.joins_parts,
                |lines, is_on| lines.joins_parts = is_on,
            ),
        ];
        let forms = within(FormSettings::settings(), |lines: &mut Self| Some(&mut lines.forms));
        edges.into_iter().chain(forms).collect()
    }
}

/// Smallest and largest [`LineSettings::on_surface`]. With more, curves behind a model would lie on it.
const ON_SURFACE: std::ops::RangeInclusive<f64> = 0.0..=0.1;

/// Refuses an impossible [`LineSettings::on_surface`].
pub(super) fn check_on_surface(share: f64) -> Result<()> {
    match ON_SURFACE.contains(&share) {
        true => Ok(()),
        false => Err(Error::value("on-surface", share, "it is a share of the scene's radius, from 0 to 0.1")),
    }
}

/// Refuses [`SilhouetteRule::Published`].
pub(super) fn not_published(rule: SilhouetteRule) -> Result<()> {
    let problem = "style lines finds silhouettes exactly or smooth; leave it out, or draw --style inking into a .png";
    if rule == SilhouetteRule::Published { Err(Error::value("silhouette", rule.text(), problem)) } else { Ok(()) }
}
