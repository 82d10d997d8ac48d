//! The classes of an edge that are independent of the view.

use super::tangents::tangents;
use super::{EdgeList, Incidence};
use crate::choice::Choice;
use crate::error::{Error, ParseError, Result};
use crate::mesh::{Mesh, NONE, Shells, face_normals};
use crate::settings::{Kind, Problem, Setting, Value};
use crate::threads::{in_parallel, threads_for};
use crate::tolerances::{CREASE_DIGITS, PARALLEL_COSINE};
use glam::DVec3;
use serde::Serialize;

crate::choices! {
    /// Why an edge is drawn. An edge of several classes belongs to the first of them here.
    #[derive(Default, PartialOrd, Ord)]
    #[repr(u8)]
    pub enum Class {
        /// It has one face.
        Boundary = "boundary",
        /// It has three faces or more; the text's listing overwrites one of them and never draws the edge (errata D2).
        NonManifold = "non-manifold",
        /// One of its two faces is seen from the front, the other from the back.
        #[default]
        Silhouette = "silhouette",
        /// The normals of its two faces differ by more than the crease angle.
        Crease = "crease",
        /// A crease where the surface is convex, for drawings that distinguish convex from concave.
        ConvexCrease = "convex-crease",
        /// The same where the surface is concave.
        ConcaveCrease = "concave-crease",
        /// Its two faces have different materials: in the text, an inner edge that counts as boundary (errata D10).
        Material = "material",
        /// Its texture coordinates differ between its two faces; likewise.
        Texture = "texture",
        /// Its vertex normals differ between its two faces; likewise.
        Normal = "normal",
        /// Its two faces belong to different parts of the file. The exact lines also find it where parts intersect.
        Part = "part",
        /// The model's file marks it as an edge to draw: glTF's EXT_mesh_primitive_edge_visibility.
        Marked = "marked",
        /// Two different surfaces meet here without a crease, such as a plane and a rounding.
        Tangent = "tangent",
        /// No edge of the mesh: two faces intersect along it. Only the exact lines find it.
        Intersection = "intersection",
        /// A suggestive contour: a nearby eye would see a contour there (DeCarlo et al. 2003). This and the three classes below
        /// are no edges either; the exact lines find them from the surface's curvature.
        Suggestive = "suggestive",
        /// A ridge: the crest of a convex surface's largest curvature, along its direction (Ohtake et al. 2004).
        Ridge = "ridge",
        /// The same where the surface is concave.
        Valley = "valley",
        /// No edge of a surface: a curve that the model holds as such, or that a program gives.
        Curve = "curve",
        /// Likewise a single point, drawn as a dot.
        Point = "point",
        /// The axis of a round surface, or a cross at the middle of one seen end-on. Only the exact lines find it.
        Centre = "centre",
    }
}

impl Class {
    /// Returns the class's name, as users write it.
    pub fn name(self) -> &'static str {
        self.choice_name()
    }
}

/// A set of classes.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct ClassSet(u32);

impl ClassSet {
    /// Every class.
    pub const ALL: Self = Self(u32::MAX >> (u32::BITS as usize - Class::ALL.len()));

    /// Every class that a mesh's edges can be of.
    pub const EDGES: Self =
        Self(Self::ALL.0 & !(1 << Class::Intersection as u8) & !Self::FORMS.0 & !Self::OF_NO_SURFACE.0);

    /// The classes of form lines, which cross faces where the surface's curvature requires it.
    pub(crate) const FORMS: Self = Self::of(&[Class::Suggestive, Class::Ridge, Class::Valley]);

    /// The classes that belong to no surface: the model's own curves and points. They hide nothing.
    pub const FREE: Self = Self::of(&[Class::Curve, Class::Point]);

    /// Those, and centre lines.
    pub(crate) const OF_NO_SURFACE: Self = Self::FREE.or(Self::of(&[Class::Centre]));

    /// Returns the set of these classes.
    pub const fn of(classes: &[Class]) -> Self {
        let mut bits = 0;
        let mut index = 0;
        while index < classes.len() {
            bits |= 1 << classes[index] as u8;
            index += 1;
        }
        Self(bits)
    }

    /// Whether the set contains the class.
    pub fn contains(self, class: Class) -> bool {
        self.0 & 1 << class as u8 != 0
    }

    /// Whether the set is empty.
    pub(crate) fn is_empty(self) -> bool {
        self.0 == 0
    }

    /// Returns the classes in both sets.
    #[must_use]
    pub fn and(self, other: Self) -> Self {
        Self(self.0 & other.0)
    }

    /// Returns the classes in either set.
    #[must_use]
    pub const fn or(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }

    /// Returns this set without these classes.
    #[must_use]
    pub fn without(self, classes: &[Class]) -> Self {
        Self(self.0 & !Self::of(classes).0)
    }

    /// Returns the first class of [`Class::ALL`] in the set, as which an edge of several classes is drawn.
    pub fn first(self) -> Option<Class> {
        self.classes().next()
    }

    /// Returns its classes in the order of [`Class::ALL`].
    pub fn classes(self) -> impl Iterator<Item = Class> {
        Class::ALL.into_iter().map(|(_, class)| class).filter(move |class| self.contains(*class))
    }
}

impl ClassSet {
    /// Declares the setting for the classes drawn; `all` is the set of permitted classes.
    pub fn setting<T: Clone + 'static>(all: Self, field: fn(&mut T) -> &mut Self) -> Setting<T> {
        let names = Class::ALL.map(|(name, _)| name).into_iter().chain(["all"]);
        Setting::of(
            "classes",
            "CLASSES",
            Kind::Several(names.collect()),
            "Edges to draw: boundary, non-manifold, silhouette, crease (or convex-crease, concave-crease), material, texture, \
             normal, part, marked, tangent, the model's own curve and point, in style lines also intersection, centre and the form lines suggestive, \
             ridge, valley; separated by commas, or all; with + before them beside the default ones",
            move |of: &T| field(&mut of.clone()).text(),
            move |of: &mut T, text: &str| {
                let (kept, text) = text.strip_prefix('+').map_or((Self::default(), text), |text| (*field(of), text));
                *field(of) = kept.or(Self::parsed(text, all)?);
                Ok(())
            },
        )
        .said("boundary,silhouette,crease,curve,point; style lines: also non-manifold, material, marked, intersection")
    }
}

impl ClassSet {
    /// Its names, separated by commas.
    pub(crate) fn text(self) -> String {
        self.classes().map(Class::name).collect::<Vec<_>>().join(",")
    }

    /// The set of these names, separated by commas; `all` are those of the name `all`.
    pub(crate) fn parsed(text: &str, all: Self) -> std::result::Result<Self, ParseError> {
        let named: std::result::Result<Vec<Class>, ParseError> =
            text.split(',').map(|name| name.trim().parse()).collect();
        match text {
            "all" => Ok(all),
            _ => Ok(Self::of(&named.map_err(|problem| format!("{problem}, or all"))?)),
        }
    }
}

impl Serialize for ClassSet {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error> {
        serializer.collect_seq(self.classes())
    }
}

/// Crease angle of drawings without a published text, degrees.
const DRAWING_DEGREES: f64 = 30.0;

/// The angle between two faces' normals above which their edge is a crease.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct CreaseAngle {
    /// Its cosine, in [-1, 1].
    pub cosine: f64,
}

impl CreaseAngle {
    /// Creates a crease angle from degrees, 0 to 180.
    ///
    /// # Errors
    ///
    /// [`Error::Setting`] for any other.
    pub fn from_degrees(degrees: f64) -> Result<Self> {
        if (0.0..=180.0).contains(&degrees) {
            let cosine = degrees.to_radians().cos();
            // No f64 angle has exactly the listing's cosine, but users must be able to write it.
            let listing = Self::default();
            let is_the_listings = (cosine - listing.cosine).abs() <= 4.0 * f64::EPSILON;
            return Ok(match degrees {
                _ if is_the_listings => listing,
                DRAWING_DEGREES => Self::of_drawings(),
                _ => Self { cosine },
            });
        }
        Err(Error::value("crease-angle", degrees, "the angle is between 0 and 180 degrees"))
    }

    /// Returns the shortest number of degrees that parses to this angle, or else the nearest number.
    fn written_degrees(self) -> f64 {
        let degrees = self.degrees();
        let is_it = |degrees: &f64| CreaseAngle::from_degrees(*degrees).is_ok_and(|found| found == self);
        let rounded = (0..=14).filter_map(|decimals| format!("{degrees:.decimals$}").parse::<f64>().ok());
        let near = (0..32).scan((degrees, degrees), |(below, above), _| {
            (*below, *above) = (below.next_down(), above.next_up());
            Some([*below, *above])
        });
        rounded.chain(near.flatten()).find(is_it).unwrap_or(degrees)
    }

    /// Declares the setting of the crease angle.
    pub fn setting<T: Clone + 'static>(field: fn(&mut T) -> &mut Self) -> Setting<T> {
        let help = "Smallest angle between two faces that makes their edge a crease, in degrees; style lines too";
        Setting::field("crease-angle", "DEGREES", help, field).said("66.4, a cosine of 0.4; ink and style lines: 30")
    }

    /// Returns the angle of drawings without a published text, 30 degrees: at 66.4 a hexagonal prism and a chamfer have no
    /// edges. 30 degrees in a file's digits still make a crease, so the edges of a twelve-sided prism are all of one kind.
    pub fn of_drawings() -> Self {
        Self { cosine: DRAWING_DEGREES.to_radians().cos() + CREASE_DIGITS }
    }

    /// Returns the angle in degrees.
    pub fn degrees(self) -> f64 {
        self.cosine.clamp(-1.0, 1.0).acos().to_degrees()
    }
}

impl Value for CreaseAngle {
    fn kind() -> Kind {
        Kind::Numbers { count: 1, range: [0.0, 180.0], decimals: 1 }
    }

    fn text(&self) -> String {
        self.written_degrees().text()
    }

    fn parse(text: &str) -> std::result::Result<Self, Problem> {
        Ok(Self::from_degrees(f64::parse(text)?)?)
    }
}

impl Default for CreaseAngle {
    /// The listing's 0.4, about 66 degrees.
    fn default() -> Self {
        Self { cosine: 0.4 }
    }
}

/// The static classes of all edges of a mesh.
#[derive(Debug, Clone, PartialEq)]
pub struct Classes {
    /// Each edge's classes.
    pub of_edges: Vec<ClassSet>,
    /// The edges with any class, ascending.
    pub marked: Vec<u32>,
    /// The crease angle used.
    pub crease_angle: CreaseAngle,
}

/// The number of edges of each class.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize)]
pub struct ClassCounts {
    /// One face.
    pub boundary: usize,
    /// Three faces or more.
    #[serde(rename = "non-manifold")]
    pub non_manifold: usize,
    /// One face seen from the front, one from the back.
    pub silhouette: usize,
    /// Sharper than the crease angle.
    pub crease: usize,
    /// Likewise, and convex.
    #[serde(rename = "convex-crease")]
    pub convex_crease: usize,
    /// Likewise, and concave.
    #[serde(rename = "concave-crease")]
    pub concave_crease: usize,
    /// Between two materials.
    pub material: usize,
    /// Between different texture coordinates.
    pub texture: usize,
    /// Between different vertex normals.
    pub normal: usize,
    /// Between two parts.
    pub part: usize,
    /// Marked as an edge by the file.
    pub marked: usize,
    /// Where a rounding begins.
    pub tangent: usize,
    /// Intersections of faces; not counted among edges.
    pub intersection: usize,
    /// Faces crossed by a suggestive contour.
    pub suggestive: usize,
    /// Likewise for ridges.
    pub ridge: usize,
    /// Likewise for valleys.
    pub valley: usize,
    /// Segments of curves; not counted among edges.
    pub curve: usize,
    /// Single points; likewise.
    pub point: usize,
    /// Centre lines; likewise.
    pub centre: usize,
}

impl ClassCounts {
    /// Returns the count of one class.
    pub fn of(&mut self, class: Class) -> &mut usize {
        match class {
            Class::Boundary => &mut self.boundary,
            Class::NonManifold => &mut self.non_manifold,
            Class::Silhouette => &mut self.silhouette,
            Class::Crease => &mut self.crease,
            Class::ConvexCrease => &mut self.convex_crease,
            Class::ConcaveCrease => &mut self.concave_crease,
            Class::Material => &mut self.material,
            Class::Texture => &mut self.texture,
            Class::Normal => &mut self.normal,
            Class::Part => &mut self.part,
            Class::Marked => &mut self.marked,
            Class::Tangent => &mut self.tangent,
            Class::Intersection => &mut self.intersection,
            Class::Suggestive => &mut self.suggestive,
            Class::Ridge => &mut self.ridge,
            Class::Valley => &mut self.valley,
            Class::Curve => &mut self.curve,
            Class::Point => &mut self.point,
            Class::Centre => &mut self.centre,
        }
    }
}

impl Classes {
    /// Finds the classes in `wanted`, except the silhouette, which needs an eye.
    ///
    /// An edge between faces wound against each other (errata) is judged with one face reversed: its crease angle is that of
    /// the surface, whatever the winding. Faces without area have no creases.
    pub fn new(mesh: &Mesh, edges: &EdgeList, crease_angle: CreaseAngle, wanted: ClassSet) -> Self {
        Self::with_threads(mesh, edges, crease_angle, wanted, threads_for(mesh.triangles.len()))
    }

    /// As [`Classes::new`] with a number of threads; the result is the same for all of them.
    pub fn with_threads(
        mesh: &Mesh,
        edges: &EdgeList,
        crease_angle: CreaseAngle,
        wanted: ClassSet,
        threads: usize,
    ) -> Self {
        let by_normals = ClassSet::of(&[Class::Tangent]).or(CREASES);
        let normals = if wanted.and(by_normals).is_empty() { Vec::new() } else { face_normals(mesh, threads) };
        let judge = Judge {
            mesh,
            edges,
            normals: &normals,
            cosine: crease_angle.cosine,
            fronts_outside: (!wanted.and(TURNS).is_empty())
                .then(|| Shells::of(mesh).fronts_outside(mesh.triangles.len())),
            seams: Seams::of(mesh, wanted),
        };
        let has_marks = wanted.contains(Class::Marked) && !mesh.marked.is_empty();
        let parts = in_parallel(edges.len(), threads, |range| {
            let mut marked = Vec::new();
            let classes: Vec<ClassSet> = range
                .map(|edge| {
                    let mut classes = judge.classes(edge);
                    if has_marks && mesh.marked.binary_search(&edges.positions[edge]).is_ok() {
                        classes = classes.or(ClassSet::of(&[Class::Marked]));
                    }
                    let classes = classes.and(wanted);
                    if !classes.is_empty() {
                        marked.push(edge as u32);
                    }
                    classes
                })
                .collect();
            (classes, marked)
        });
        let mut parts = parts.into_iter();
        let (mut of_edges, mut marked) = parts.next().unwrap_or_default();
        for (classes, edges) in parts {
            of_edges.extend(classes);
            marked.extend(edges);
        }
        if wanted.contains(Class::Tangent) {
            let found = tangents(mesh, edges, &normals, CreaseAngle::of_drawings().cosine, threads);
            for edge in &found {
                let classes = &mut of_edges[*edge as usize];
                *classes = classes.or(ClassSet::of(&[Class::Tangent]));
            }
            marked.extend(found);
            marked.sort_unstable();
            marked.dedup();
        }
        Self { of_edges, marked, crease_angle }
    }

    /// Returns the number of edges of each class; an edge of several classes counts in each.
    pub fn counts(&self) -> ClassCounts {
        let mut counts = ClassCounts::default();
        for edge in &self.marked {
            self.of_edges[*edge as usize].classes().for_each(|class| *counts.of(class) += 1);
        }
        counts
    }
}

/// The data that decides an edge's classes.
struct Judge<'a> {
    mesh: &'a Mesh,
    edges: &'a EdgeList,
    normals: &'a [[f64; 3]],
    cosine: f64,
    /// For each face whether its front is outside, if convex or concave creases are wanted.
    fronts_outside: Option<Vec<bool>>,
    seams: Seams,
}

/// The classes that depend on the angle between an edge's two faces.
pub(crate) const CREASES: ClassSet = ClassSet::of(&[Class::Crease, Class::ConvexCrease, Class::ConcaveCrease]);

/// The crease classes that depend on the side of the outside.
const TURNS: ClassSet = ClassSet::of(&[Class::ConvexCrease, Class::ConcaveCrease]);

/// The seams to find: the wanted ones that this mesh can have.
struct Seams {
    material: bool,
    texture: bool,
    normal: bool,
    part: bool,
}

impl Seams {
    fn of(mesh: &Mesh, wanted: ClassSet) -> Self {
        Self {
            material: wanted.contains(Class::Material) && !mesh.triangle_materials.is_empty(),
            texture: wanted.contains(Class::Texture) && !mesh.triangle_texture_coordinates.is_empty(),
            normal: wanted.contains(Class::Normal) && !mesh.triangle_normals.is_empty(),
            part: wanted.contains(Class::Part) && !mesh.triangle_parts.is_empty(),
        }
    }

    fn any(&self) -> bool {
        self.material || self.texture || self.normal || self.part
    }
}

impl Judge<'_> {
    #[inline(always)]
    fn classes(&self, edge: usize) -> ClassSet {
        let incidence = self.edges.incidence[edge];
        match incidence {
            Incidence::Boundary => ClassSet::of(&[Class::Boundary]),
            Incidence::NonManifold => ClassSet::of(&[Class::NonManifold]),
            Incidence::Inner | Incidence::InnerReversed => {
                let faces = self.edges.faces[edge].map(|face| face as usize);
                let mut classes = ClassSet::default();
                if !self.normals.is_empty() {
                    let [first, second] = faces.map(|face| DVec3::from_array(self.normals[face]));
                    let cosine = first.dot(second);
                    let cosine = if incidence == Incidence::Inner { cosine } else { -cosine };
                    if cosine < self.cosine - PARALLEL_COSINE {
                        classes = self.turn_at(edge, first).or(ClassSet::of(&[Class::Crease]));
                    }
                }
                if self.seams.any() { classes.or(self.seams_at(edge, faces)) } else { classes }
            }
        }
    }

    /// Returns whether a crease is convex or concave, if wanted. It is convex if the second face's third corner is not outside
    /// the first face, whose normal is `normal`.
    fn turn_at(&self, edge: usize, normal: DVec3) -> ClassSet {
        let Some(fronts_outside) = &self.fronts_outside else { return ClassSet::default() };
        let ends = self.edges.positions[edge];
        let is_front_outside = fronts_outside[self.edges.faces[edge][0] as usize];
        let second = self.mesh.triangles[self.edges.faces[edge][1] as usize];
        let position = |number: u32| self.mesh.positions[number as usize];
        let third = second.into_iter().find(|corner| !ends.contains(corner)).map(position);
        let before = third.map_or(0.0, |third| (third - position(ends[0])).dot(normal));
        let is_concave = if is_front_outside { before > 0.0 } else { before < 0.0 };
        ClassSet::of(&[if is_concave { Class::ConcaveCrease } else { Class::ConvexCrease }])
    }

    fn seams_at(&self, edge: usize, faces: [usize; 2]) -> ClassSet {
        let mesh = self.mesh;
        let mut classes = ClassSet::default();
        let differ = |list: &[u32]| list.get(faces[0]) != list.get(faces[1]);
        if self.seams.material && differ(&mesh.triangle_materials) {
            classes = classes.or(ClassSet::of(&[Class::Material]));
        }
        if self.seams.part && differ(&mesh.triangle_parts) {
            classes = classes.or(ClassSet::of(&[Class::Part]));
        }
        if self.seams.texture
            && self.differs(edge, faces, &mesh.triangle_texture_coordinates, &mesh.texture_coordinates)
        {
            classes = classes.or(ClassSet::of(&[Class::Texture]));
        }
        if self.seams.normal && self.differs(edge, faces, &mesh.triangle_normals, &mesh.normals) {
            classes = classes.or(ClassSet::of(&[Class::Normal]));
        }
        classes
    }

    /// Whether the faces' values differ at either of the edge's positions.
    fn differs<T: PartialEq>(&self, edge: usize, faces: [usize; 2], corners: &[[u32; 3]], values: &[T]) -> bool {
        self.edges.positions[edge].iter().any(|position| {
            let index = faces.map(|face| {
                let corner = self.mesh.triangles[face].iter().position(|other| other == position);
                corner.and_then(|corner| corners.get(face).map(|corners| corners[corner])).unwrap_or(NONE)
            });
            index[0] != index[1] && values.get(index[0] as usize) != values.get(index[1] as usize)
        })
    }
}
