//! A scene: meshes in their places, colours, a camera and a picture size.
//!
//! GL draws in scene space, with the scene's centre at the origin and radius 1. So f32 is enough wherever the model
//! lies and however large it is. The papers give their light in eye space without a unit; in scene space it keeps its
//! place relative to the model (errata E11). Scene space only moves and scales world space, without rotation.
//!
//! ```
//! # fn main() -> tinta_geometry::Result<()> {
//! use std::sync::Arc;
//! use tinta_geometry::{Background, LoadOptions, Scene, SceneSettings, Size, load};
//!
//! let ant = Arc::new(load("../../models/ant.obj", &LoadOptions::default())?.mesh);
//! let settings = SceneSettings {
//!     copies: 4,
//!     size: Size { width: 320, height: 240 },
//!     background: Background::Transparent,
//!     ..SceneSettings::default()
//! };
//! let scene = Scene::new(vec![ant], &settings)?;
//! assert_eq!((scene.objects.len(), scene.triangle_count()), (4, 4 * 3964));
//! # Ok(())
//! # }
//! ```

mod copies;
mod extent;
mod near_plane;
mod precision;
mod turntable;
mod unseen;
mod vertex_boxes;

pub use crate::values::{Background, Color, Rectangle, Size};
pub use unseen::UnseenReason;

use crate::camera::{Camera, CameraSettings, Projection, View};
use crate::curvature::{Curvatures, KeptCurvatures};
use crate::edges::{Eye, MeshEdges, SilhouetteRule};
use crate::error::{Error, Result};
use crate::limits::DRAWN_PIXELS;
use crate::mesh::{Material, Mesh, VertexArrays, bounds};
use crate::settings::{HasSettings, Setting, Table, under, within};
use crate::tolerances::{BASE_DEPTH, MOST_OF_FIGURES, SCENE_RADIUS};
use glam::{DMat4, DVec3, Mat4, Vec3};
use std::sync::{Arc, LazyLock, OnceLock, Weak};

/// A mesh in its place.
#[derive(Debug, Clone, Default)]
pub struct Object {
    /// The mesh, shared between copies.
    pub mesh: Arc<Mesh>,
    /// The position of the mesh's origin, world space.
    pub offset: DVec3,
    /// The vertex arrays that GL draws. Like the fields below, created on first use and shared between copies.
    arrays: Arc<OnceLock<VertexArrays>>,
    /// Boxes around the vertices.
    boxes: Arc<OnceLock<Vec<[Vec3; 2]>>>,
    edges: Arc<OnceLock<MeshEdges>>,
    curvatures: Arc<KeptCurvatures>,
}

/// Identifies an object; its copies have the same identity. It keeps no data of the object alive.
#[derive(Debug, Clone)]
pub struct ObjectIdentity(Weak<OnceLock<VertexArrays>>);

impl ObjectIdentity {
    /// Whether `object` is this object or a copy of it.
    pub fn is_of(&self, object: &Object) -> bool {
        std::ptr::eq(self.0.as_ptr(), Arc::as_ptr(&object.arrays))
    }
}

/// Everything that a style needs to plan a picture, and `gl` to draw it.
#[derive(Debug, Clone)]
pub struct Scene {
    /// The meshes at their places.
    pub objects: Vec<Object>,
    /// The centre of the objects' bounding box, world space.
    pub centre: DVec3,
    /// Half the diagonal of the bounding box, file units: the unit of scene space.
    pub radius: f64,
    /// The camera, world space.
    pub camera: Camera,
    /// The picture's size.
    pub size: Size,
    /// The background.
    pub background: Background,
    /// The colour of objects without one; with `recolor`, of all objects.
    pub color: Color,
    /// Whether `color` replaces the model's own colours.
    pub recolor: bool,
    /// The surfaces' colours.
    pub surface: Surface,
}

crate::choices! {
    /// The look of surfaces before a style shades them.
    #[derive(Default)]
    pub enum Surface {
        /// One colour for each material.
        #[default]
        Plain = "plain",
        /// The model's textures and vertex colours; a material is white under its texture.
        Textured = "textured",
    }
}

/// The user's settings of the scene.
#[derive(Debug, Clone, PartialEq)]
pub struct SceneSettings {
    /// Number of copies of the models on a square grid on the ground, as in the first paper's scenes. Default 1.
    pub copies: u32,
    /// The camera.
    pub camera: CameraSettings,
    /// The picture's size, pixels. Default 512 x 512, as in the first paper.
    pub size: Size,
    /// The background. Default white.
    pub background: Background,
    /// One colour for everything, in place of the model's. Default none.
    pub color: Option<Color>,
    /// The colour where the model has none. Default `DEFAULT_COLOR`.
    pub bare_color: Color,
    /// The look of surfaces. Default plain, as in the pictures of the three texts.
    pub surface: Surface,
}

impl Default for SceneSettings {
    fn default() -> Self {
        Self {
            copies: 1,
            camera: CameraSettings::default(),
            size: Size { width: 512, height: 512 },
            background: Background::Color(Color([1.0; 3])),
            color: None,
            bare_color: DEFAULT_COLOR,
            surface: Surface::Plain,
        }
    }
}

impl HasSettings for SceneSettings {
    fn table() -> &'static Table<Self> {
        static TABLE: LazyLock<Table<SceneSettings>> =
            LazyLock::new(|| Table { settings: SceneSettings::settings(), defaults: vec![SceneSettings::default()] });
        &TABLE
    }
}

impl SceneSettings {
    /// The settings, for tables of structs that contain a scene.
    pub fn settings() -> Vec<Setting<Self>> {
        let settings = vec![
            Setting::field("size", "WxH", "Size in pixels, or one number for a square", |scene: &mut Self| {
                &mut scene.size
            })
            .common(),
            Setting::field(
                "background",
                "COLOR",
                "Colour behind the scene: a CSS name, #rrggbb, rgb(r,g,b), or transparent",
                |scene: &mut Self| &mut scene.background,
            )
            .open("transparent")
            .said("white")
            .common(),
            Setting::open_field("color", "COLOR", "own", "One colour for all surfaces", |scene: &mut Self| {
                &mut scene.color
            })
            .said("the model's own")
            .common(),
            Setting::field("bare-color", "COLOR", "Colour of surfaces that have none", |scene: &mut Self| {
                &mut scene.bare_color
            }),
            Setting::field(
                "surface",
                "SURFACE",
                "Colour of surfaces: plain (one per material) or textured (the model's textures and vertex colours)",
                |scene: &mut Self| &mut scene.surface,
            ),
            Setting::field(
                "copies",
                "N",
                "Repeat the models on a square grid, up to 10000 times",
                |scene: &mut Self| &mut scene.copies,
            )
            .range(1.0, 100.0, 0),
        ];
        let camera = within(CameraSettings::settings(), |scene: &mut Self| Some(&mut scene.camera));
        under("Scene", settings).chain(camera).collect()
    }
}

/// The default colour of models without one: a light, warm clay that shows all three tones.
pub(crate) const DEFAULT_COLOR: Color = Color([0.93, 0.74, 0.52]);

/// The thickness of a flat model, as a share of its length.
const FLATNESS: f64 = 1e-3;

/// The least height of an upright figure, as a share of its largest extent. What is lower shows its form from above.
const UPRIGHT: f64 = 2.0 / 3.0;

/// The highest elevation of a view that suits such a figure, degrees. In blind trials of 47 pairs 33 were better seen from here than
/// from 23 degrees, 7 as well, 7 worse.
const HIGHEST_OF_FIGURES: f64 = 12.0;

/// Gap between copies on the grid, as a share of the models' largest extent.
const COPY_GAP: f64 = 0.15;

/// Largest number of copies, because every pass draws each copy separately.
const LARGEST_COPIES: u32 = 10_000;

/// Largest number of points to which the camera is fitted; larger scenes are fitted by their objects' bounding boxes.
const FITTED_POINTS: usize = 4_000_000;

impl Scene {
    /// Places the meshes at their coordinates and fits the camera to them. Accepts meshes and shared meshes; leaves out those of
    /// which a section has left nothing.
    ///
    /// # Errors
    ///
    /// [`Error::Setting`] for a scene that cannot be drawn: no mesh, no copy, no pixel or too many, an impossible
    /// camera, planes too far apart for depth to order faces, or coordinates beyond `SCENE_RADIUS`.
    pub fn new(meshes: impl IntoIterator<Item: Into<Arc<Mesh>>>, settings: &SceneSettings) -> Result<Self> {
        let meshes: Vec<Arc<Mesh>> = meshes.into_iter().map(Into::into).collect();
        if meshes.is_empty() || !(1..=LARGEST_COPIES).contains(&settings.copies) {
            return Err(Error::value(
                "copies",
                settings.copies,
                format!("a scene has at least one model and 1 to {LARGEST_COPIES} copies of it"),
            ));
        }
        check_size(settings.size)?;
        // A section's plane may leave nothing of a model.
        let (gone, left): (Vec<_>, Vec<_>) = meshes.into_iter().partition(|mesh| mesh.is_empty());
        if let (true, Some(mesh)) = (left.is_empty(), gone.first()) {
            let problem =
                format!("nothing is left of {}, which lies wholly in front of the plane; move the plane", mesh.name);
            return Err(Error::setting("section", problem));
        }
        let objects = on_grid(&left, settings.copies);
        let corners: Vec<DVec3> = objects.iter().flat_map(Object::box_corners).collect();
        let (low, high) = bounds(&corners);
        let (centre, radius) = (low * 0.5 + high * 0.5, (high * 0.5 - low * 0.5).length());
        if !SCENE_RADIUS.contains(&radius) {
            return Err(Error::model(
                &objects[0].mesh.name,
                format!(
                    "the scene's radius is {:e}; scale the model to between {:e} and {:e} units",
                    length_of_any(high * 0.5 - low * 0.5),
                    SCENE_RADIUS.start(),
                    SCENE_RADIUS.end()
                ),
            ));
        }
        Self::seen(objects, centre, radius, settings)
    }

    /// Returns the same objects, with their cached data, under other settings; `copies` is ignored.
    ///
    /// # Errors
    ///
    /// Those of [`Scene::new`].
    pub fn seen_with(&self, settings: &SceneSettings) -> Result<Self> {
        check_size(settings.size)?;
        Self::seen(self.objects.clone(), self.centre, self.radius, settings)
    }

    /// Returns the scene with a camera that is fitted to the objects and to their shadow on the ground, by a light in this direction,
    /// world space.
    ///
    /// # Errors
    ///
    /// Those of [`Scene::new`].
    pub fn with_shadow_in_view(self, settings: &SceneSettings, light: DVec3) -> Result<Self> {
        let ground = self.lowest();
        let corners: Vec<DVec3> =
            self.objects.iter().flat_map(|o| o.mesh.all_positions().map(|point| point + o.offset)).collect();
        let shadow = corners.iter().map(|point| point - light * ((point.y - ground) / light.y));
        let points = corners.iter().copied().chain(shadow);
        let camera = settings.camera.fit(self.centre, self.radius, settings.size.aspect(), points)?;
        Ok(Self { camera, ..self }.with_near_plane(&settings.camera))
    }

    /// The size of the box around all objects, world space.
    pub(crate) fn extent(&self) -> DVec3 {
        let corners: Vec<DVec3> = self.objects.iter().flat_map(Object::box_corners).collect();
        let (low, high) = bounds(&corners);
        high - low
    }

    /// The height of the lowest point, y up.
    pub(crate) fn lowest(&self) -> f64 {
        self.objects.iter().flat_map(Object::box_corners).map(|corner| corner.y).fold(f64::INFINITY, f64::min)
    }

    /// Whether one of the objects that are lowest stands.
    pub fn stands(&self) -> bool {
        let ground = self.lowest() + BASE_DEPTH * self.extent().y;
        self.objects.iter().any(|object| object.offset.y + object.mesh.bounds().0.y <= ground && object.mesh.stands())
    }

    /// The view that suits the objects in place of one chosen for any: along the normal of a flat model, whose true shape it shows;
    /// less from above for an upright figure, whose forehead would hide its face.
    pub fn suited(&self, view: View) -> View {
        let extent = self.extent();
        if let Some(thin) = (0..3).find(|axis| extent[*axis] <= FLATNESS * extent.max_element()) {
            return ["right", "top", "front"][thin].parse().unwrap_or(view);
        }
        if extent.y < UPRIGHT * extent.max_element() {
            return view;
        }
        let areas = self.objects.iter().map(|object| self.edges(object).areas());
        let [flat, all] = areas.fold([0.0; 2], |sums, areas| [sums[0] + areas[0], sums[1] + areas[1]]);
        let highest = if flat < MOST_OF_FIGURES * all { HIGHEST_OF_FIGURES } else { f64::INFINITY };
        View { elevation_degrees: view.elevation_degrees.min(highest), ..view }
    }

    /// Objects with the given centre and radius, under these settings.
    fn seen(objects: Vec<Object>, centre: DVec3, radius: f64, settings: &SceneSettings) -> Result<Self> {
        let camera = fitted_camera(&objects, centre, radius, settings)?;
        let scene = Self {
            objects,
            centre,
            radius,
            camera,
            size: settings.size,
            background: settings.background,
            color: settings.color.unwrap_or(settings.bare_color),
            recolor: settings.color.is_some(),
            surface: settings.surface,
        };
        scene.check_distance()?;
        Ok(scene.with_near_plane(&settings.camera))
    }

    /// The vertex arrays of an object of this scene: in scene radii, around the mesh's centre.
    pub fn arrays<'a>(&self, object: &'a Object) -> &'a VertexArrays {
        object.arrays.get_or_init(|| VertexArrays::new(&object.mesh, self.radius))
    }

    /// Boxes around an object's vertices, curves and points, in the space of its arrays.
    fn boxes<'a>(&self, object: &'a Object) -> &'a [[Vec3; 2]] {
        let arrays = self.arrays(object);
        let to_arrays = |point: &DVec3| ((point - arrays.centre) / self.radius).as_vec3();
        let free = || object.mesh.curves.positions.iter().map(to_arrays).collect::<Vec<_>>();
        object.boxes.get_or_init(|| vertex_boxes::boxes(arrays, &free()))
    }

    /// Creates every object's arrays now, for example on a background thread.
    pub fn make_arrays(&self) {
        self.objects.iter().for_each(|object| {
            self.arrays(object);
        });
    }

    /// The edges of an object's mesh.
    pub fn edges<'a>(&self, object: &'a Object) -> &'a MeshEdges {
        object.edges.get_or_init(|| MeshEdges::new(object.mesh.clone()))
    }

    /// The curvature of an object's surface between creases, smoothed as in [`Curvatures::new`]. The latest result
    /// is cached.
    pub(crate) fn curvatures(&self, object: &Object, smoothing: f64) -> Arc<Curvatures> {
        object.curvatures.get(&object.mesh, self.edges(object).list(), smoothing)
    }

    /// The eye in an object's mesh coordinates; for the listing's rule always the camera's axis.
    pub fn eye(&self, object: &Object, rule: SilhouetteRule) -> Eye {
        match (rule, self.camera.projection) {
            (SilhouetteRule::Exact | SilhouetteRule::Smooth, Projection::Perspective { .. }) => {
                Eye::Point(self.camera.eye - object.offset)
            }
            _ => Eye::Direction(self.camera.backward()),
        }
    }

    /// The rigid matrix from a mesh's arrays (centred on `mesh_centre`, in scene radii) to eye space.
    pub fn view_from_object(&self, object: &Object, mesh_centre: DVec3) -> Mat4 {
        let view = self.camera.view_from_world();
        // Relative to the eye in f64, so a distant scene loses no precision.
        let from_eye = mesh_centre + object.offset - self.camera.eye;
        let translation = view.transform_vector3(from_eye) / self.radius;
        let rotation = DMat4::from_mat3(glam::DMat3::from_mat4(view));
        (DMat4::from_translation(translation) * rotation).as_mat4()
    }

    /// The projection, for lengths in scene radii.
    pub fn clip_from_view(&self) -> Mat4 {
        let mut camera = self.camera;
        camera.near /= self.radius;
        camera.far /= self.radius;
        if let Projection::Parallel { height } = &mut camera.projection {
            *height /= self.radius;
        }
        camera.clip_from_view(self.size.aspect()).as_mat4()
    }

    /// The colour of triangles with this material (or [`crate::mesh::NONE`]).
    pub fn material_color(&self, mesh: &Mesh, material: u32) -> Color {
        let is_fill = |material: &Material| material.is_fill;
        if self.recolor && !mesh.materials.get(material as usize).is_some_and(is_fill) {
            return self.color;
        }
        match mesh.materials.get(material as usize) {
            Some(material) if self.is_textured(mesh, material) => Color(material.texture_color.unwrap_or([1.0; 3])),
            material => material.and_then(|material| material.color).map_or(self.bare_color(mesh), Color),
        }
    }

    /// Whether triangles with this material have no colour of their own and none that replaces it: they get the scene's.
    pub fn is_bare(&self, mesh: &Mesh, material: u32) -> bool {
        let is_colored = |material: &Material| material.color.is_some() || self.is_textured(mesh, material);
        let has_color = mesh.materials.get(material as usize).is_some_and(is_colored);
        !(self.recolor || has_color || self.shows_vertex_colors(mesh))
    }

    /// The colour of faces without one; white under vertex colours.
    fn bare_color(&self, mesh: &Mesh) -> Color {
        if self.shows_vertex_colors(mesh) { Color([1.0; 3]) } else { self.color }
    }

    /// Whether a mesh shows its vertex colours, in styles that follow the scene's setting.
    pub fn shows_vertex_colors(&self, mesh: &Mesh) -> bool {
        self.surface == Surface::Textured && !self.recolor && !mesh.position_colors.is_empty()
    }

    /// Whether a material shows its texture, in styles that follow the scene's setting.
    fn is_textured(&self, mesh: &Mesh, material: &Material) -> bool {
        let has_coordinates = !mesh.triangle_texture_coordinates.is_empty();
        self.surface == Surface::Textured && !self.recolor && has_coordinates && material.has_texture()
    }

    /// Whether any texture or vertex colours are shown, in styles that follow the scene's setting.
    pub fn has_textured_surfaces(&self) -> bool {
        self.shows_textures() || self.objects.iter().any(|object| self.shows_vertex_colors(&object.mesh))
    }

    /// Whether any texture is shown, in styles that follow the scene's setting.
    pub fn shows_textures(&self) -> bool {
        let is_textured = |object: &Object| object.mesh.materials.iter().any(|it| self.is_textured(&object.mesh, it));
        self.objects.iter().any(is_textured)
    }

    /// The vertex colours of each object, white without any; `None` if no object shows them.
    pub fn vertex_colors(&self) -> Option<Vec<Arc<Vec<[f32; 4]>>>> {
        if !self.objects.iter().any(|object| self.shows_vertex_colors(&object.mesh)) {
            return None;
        }
        Some(self.of_meshes(|_, object| {
            let arrays = self.arrays(object);
            let has_none = arrays.colors.is_empty();
            Arc::new(if has_none { vec![[1.0; 4]; arrays.vertices.len()] } else { arrays.colors.clone() })
        }))
    }

    /// A sentence for each mesh that seems to have cracks: open edges side by side.
    pub fn crack_remarks(&self) -> Vec<String> {
        self.originals().filter_map(|object| self.edges(object).remark()).collect()
    }

    /// Number of triangles of all objects.
    pub fn triangle_count(&self) -> usize {
        self.objects.iter().map(|object| object.mesh.triangles.len()).sum()
    }
}

/// The length of a vector whose squares may be no numbers of f64.
fn length_of_any(vector: DVec3) -> f64 {
    let largest = vector.abs().max_element();
    if largest > 0.0 { (vector / largest).length() * largest } else { 0.0 }
}

impl Object {
    /// Returns the object with other normals. Its edges and curvatures stay those of the mesh that it has now.
    pub(crate) fn with_normals(&self, normals: Vec<Vec3>, triangle_normals: Vec<[u32; 3]>) -> Self {
        let mesh = Arc::new(Mesh { normals, triangle_normals, ..(*self.mesh).clone() });
        Self { mesh, arrays: Arc::default(), ..self.clone() }
    }

    /// A mesh at its own coordinates.
    fn at_home(mesh: Arc<Mesh>) -> Self {
        Self { mesh, ..Self::default() }
    }

    /// The identity shared by this object and its copies, valid while one of them exists.
    pub fn identity(&self) -> ObjectIdentity {
        ObjectIdentity(Arc::downgrade(&self.arrays))
    }

    /// Another mesh in this object's place.
    #[must_use]
    pub fn with_mesh(&self, mesh: Arc<Mesh>) -> Self {
        Self { offset: self.offset, ..Self::at_home(mesh) }
    }

    fn box_corners(&self) -> [DVec3; 8] {
        let (low, high) = self.mesh.extent();
        std::array::from_fn(|i| {
            let pick = |bit: usize, low: f64, high: f64| if i >> bit & 1 == 1 { high } else { low };
            self.offset + DVec3::new(pick(0, low.x, high.x), pick(1, low.y, high.y), pick(2, low.z, high.z))
        })
    }
}

fn check_size(size: Size) -> Result<()> {
    match size.pixel_count() {
        0 => Err(Error::value("size", size, "a picture has at least one pixel")),
        1..=DRAWN_PIXELS => Ok(()),
        _ => {
            let problem = format!("the largest picture has {DRAWN_PIXELS} pixels; ask for a smaller one");
            Err(Error::value("size", size, problem))
        }
    }
}

/// The camera of these settings, fitted to the objects.
fn fitted_camera(objects: &[Object], centre: DVec3, radius: f64, settings: &SceneSettings) -> Result<Camera> {
    let aspect = settings.size.aspect();
    let point_count: usize = objects.iter().map(|object| object.mesh.all_positions().count()).sum();
    if point_count <= FITTED_POINTS {
        let points = objects.iter().flat_map(|o| o.mesh.all_positions().map(|point| point + o.offset));
        return settings.camera.fit(centre, radius, aspect, points);
    }
    let corners: Vec<DVec3> = objects.iter().flat_map(Object::box_corners).collect();
    settings.camera.fit(centre, radius, aspect, corners.iter().copied())
}

/// The models repeated in rows along x; further rows follow along -z.
fn on_grid(meshes: &[Arc<Mesh>], copies: u32) -> Vec<Object> {
    let all: Vec<DVec3> = meshes.iter().map(|mesh| mesh.extent()).flat_map(|(low, high)| [low, high]).collect();
    let (low, high) = bounds(&all);
    // A gap in every direction, because models that are flat along an axis would otherwise overlap.
    let step = (high - low) + (high - low).max_element() * COPY_GAP;
    let columns = f64::from(copies).sqrt().ceil() as u32;
    let originals: Vec<Object> = meshes.iter().map(|mesh| Object::at_home(mesh.clone())).collect();
    (0..copies)
        .flat_map(|copy| {
            let offset = DVec3::new(f64::from(copy % columns) * step.x, 0.0, -f64::from(copy / columns) * step.z);
            originals.iter().map(move |object| Object { offset, ..object.clone() })
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::{LoadOptions, load};
    use crate::settings::Value as _;

    fn open_box(settings: &SceneSettings) -> Scene {
        let mesh = load("../../models/open-box.obj", &LoadOptions::default()).unwrap().mesh;
        Scene::new(vec![Arc::new(mesh)], settings).unwrap()
    }

    #[test]
    fn scene_space_puts_every_corner_where_world_space_does() {
        let scene = open_box(&SceneSettings { copies: 3, ..SceneSettings::default() });
        let clip_from_world = scene.camera.clip_from_view(1.0) * scene.camera.view_from_world();
        for object in &scene.objects {
            let (low, high) = object.mesh.bounds();
            let mesh_centre = low * 0.5 + high * 0.5;
            let clip_from_object = scene.clip_from_view() * scene.view_from_object(object, mesh_centre);
            for point in &object.mesh.positions {
                let exact = clip_from_world.project_point3(*point + object.offset);
                let local = ((*point - mesh_centre) / scene.radius).as_vec3();
                let drawn = clip_from_object.project_point3(local).as_dvec3();
                assert!(exact.distance(drawn) < 1e-5, "{exact} {drawn}");
            }
        }
    }

    #[test]
    fn an_upright_figure_is_seen_from_lower_and_a_flat_model_along_its_normal() {
        let suited = |name: &str, turn: fn(DVec3) -> DVec3, view: &str| {
            let mut mesh = load(name, &LoadOptions::default()).unwrap().mesh;
            mesh.positions.iter_mut().for_each(|place| *place = turn(*place));
            let scene = Scene::new(vec![Arc::new(mesh)], &SceneSettings::default()).unwrap();
            scene.suited(view.parse().unwrap()).text()
        };
        let upright = |place: DVec3| place;
        assert_eq!(suited("../../models/bust.obj", upright, "30,23"), "30,12");
        assert_eq!(suited("../../models/bust.obj", upright, "-20,5"), "-20,5", "lower already");
        for part in ["gear", "open-box", "car"] {
            assert_eq!(suited(&format!("../../models/{part}.obj"), upright, "30,23"), "30,23", "{part}");
        }
        assert_eq!(
            suited("../../models/bust.obj", |place| DVec3::new(place.y, place.x, place.z), "30,23"),
            "30,23",
            "lying"
        );
        assert_eq!(suited("../../models/gear.obj", |place| place.with_y(0.0), "30,23"), "0,90");
    }

    #[test]
    fn a_scene_far_from_the_origin_gives_the_same_matrices() {
        let near = open_box(&SceneSettings::default());
        let mut far_mesh = (*near.objects[0].mesh).clone();
        let shift = DVec3::new(1e9, -2e9, 5e8);
        far_mesh.positions.iter_mut().for_each(|position| *position += shift);
        let far = Scene::new(vec![Arc::new(far_mesh)], &SceneSettings::default()).unwrap();
        let view = |scene: &Scene| scene.view_from_object(&scene.objects[0], scene.centre);
        assert!(view(&near).abs_diff_eq(view(&far), 1e-6));
        assert!(near.clip_from_view().abs_diff_eq(far.clip_from_view(), 1e-5));
    }

    #[test]
    fn copies_stand_on_a_grid_without_touching() {
        let scene = open_box(&SceneSettings { copies: 5, ..SceneSettings::default() });
        assert_eq!(scene.objects.len(), 5);
        let offsets: Vec<DVec3> = scene.objects.iter().map(|object| object.offset).collect();
        assert!(offsets.iter().all(|offset| offset.y == 0.0));
        let (low, high) = scene.objects[0].mesh.bounds();
        let size = high - low;
        for (i, a) in offsets.iter().enumerate() {
            for b in &offsets[..i] {
                assert!((a.x - b.x).abs() > size.x || (a.z - b.z).abs() > size.z);
            }
        }
    }

    #[test]
    fn copies_of_a_flat_model_do_not_stand_in_one_another() {
        let mut settings = SceneSettings { copies: 9, ..SceneSettings::default() };
        let scene = Scene::new(vec![Arc::new(Mesh::triangle())], &settings).unwrap();
        let rows: std::collections::BTreeSet<u64> = scene.objects.iter().map(|o| (-o.offset.z).to_bits()).collect();
        assert_eq!(rows.len(), 3);
        settings.copies = u32::MAX;
        assert!(Scene::new(vec![Arc::new(Mesh::triangle())], &settings).is_err());
    }

    #[test]
    fn a_camera_beyond_the_precision_of_numbers_is_refused_by_name() {
        let scene = |camera: CameraSettings| {
            let settings = SceneSettings { camera, ..SceneSettings::default() };
            Scene::new(vec![Arc::new(Mesh::triangle())], &settings)
        };
        let refused = |camera: CameraSettings| scene(camera).unwrap_err().to_string();
        let base = CameraSettings::default;
        for fov_y_degrees in [1e-320, 1e-160, 1e-15] {
            assert!(refused(CameraSettings { fov_y_degrees, ..base() }).contains("fov"));
        }
        assert!(refused(CameraSettings { fov_y_degrees: 1e-7, ..base() }).contains("--parallel"));
        assert!(refused(CameraSettings { eye: Some(DVec3::Z * 1e30), ..base() }).contains("eye"));
        // Precise enough for exact lines, but not for GL.
        let by_gl = |camera: CameraSettings| scene(camera).unwrap().check_precision().unwrap_err().to_string();
        assert!(by_gl(CameraSettings { fov_y_degrees: 1e-3, ..base() }).contains("GL can resolve"));
        let (near, far) = (Some(1e-12), Some(1e12));
        assert!(by_gl(CameraSettings { near, far, ..base() }).contains("depth buffer"));
        assert!(scene(base()).unwrap().check_precision().is_ok());
    }
}
