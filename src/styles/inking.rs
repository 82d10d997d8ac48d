//! `inking`: lines from an edge list over painted faces. C. Dachsbacher, *Beethoven aus Bits und Bytes*.
//!
//! Faces first, pushed back by polygon offset; then the selected edges as GL lines, with GL points at their ends to join wide
//! lines. As in the text, everything uses the fixed-function pipeline, except for the variant whose vertex shader computes the
//! light.

mod runs;

use super::gradients::Gradients;
use super::shading::{faces_by_tone, vertex_colors};
use super::textured::textured;
use super::{ALL_STYLES, INKING, Ramp, RampRow, Show, Supersample, cull, no_borders};
use crate::edges::{Class, ClassSet, CreaseAngle, SilhouetteRule};
use crate::error::{Error, Result};
use crate::lines::{ClassColors, Length, Units, line_width};
use crate::plan::{
    Blend, Depth, Draw, EdgeRun, Facts, Geometry, LineDrawing, Mark, Paint, Pass, Plan, PlanPicture, Program, Sampling,
    Step, Texture,
};
use crate::scene::{Background, Scene};
use crate::settings::{ON_OFF, Setting, under};
use std::sync::Arc;

/// Settings of `inking`; the defaults are the text's.
#[derive(Debug, Clone, PartialEq)]
pub struct Inking {
    /// Whether to draw lines. Default yes.
    pub is_inked: bool,
    /// The classes of lines to draw. Default boundary, silhouette and crease, and the model's own curves and points, of which the
    /// text knows none; it names the others but its listing leaves them out.
    pub classes: ClassSet,
    /// Smallest angle between faces at a crease. Default a cosine of 0.4; more degrees draw fewer lines.
    pub crease_angle: CreaseAngle,
    /// The rule for silhouettes. Default the listing's.
    pub silhouette: SilhouetteRule,
    /// Width of the lines and of the points at their ends. Default 2 pixels.
    pub line_width: Length,
    /// Whether lines are smoothed and blended, the text's optional part. Default yes.
    pub is_smooth: bool,
    /// Whether points at the lines' ends join them. Default yes, as in the text. Without them wide lines have notches where they
    /// meet; thin ones hardly any.
    pub has_joints: bool,
    /// Whether to draw edges whose two faces are both turned away. Default yes, as in the text. On a closed model the front faces
    /// hide them, except where polygon offset or line width lets them through.
    pub back_edges: bool,
    /// How lines get their width. Default as GL draws them.
    pub line_drawing: LineDrawing,
    /// Whether lines write depth, as in the text. Default yes. A smoothed line's faint end then hides the point that should close
    /// the gap to the next one.
    pub writes_depth: bool,
    /// The lines' colours. Default black.
    pub colors: ClassColors,
    /// glPolygonOffset's factor and units. Default 1 and 5; more keeps faces from covering their own lines and lets hidden lines
    /// through.
    pub polygon_offset: [f32; 2],
    /// How faces are painted. Default by the ramp.
    pub paint: PaintMode,
    /// The ramp. Default four gradients of three tones.
    pub ramp: Ramp,
    /// The gradient that a surface gets. Default by material.
    pub ramp_row: RampRow,
    /// Where the light is computed. Default on the CPU, as in the listing.
    pub light: LightOn,
    /// Whether the model's own texture is multiplied in, by the second texture stage. Default no.
    pub has_texture: bool,
    /// Whether to skip faces turned away from the eye: faster. The picture of closed models changes only in a few pixels at
    /// outlines. Default no.
    pub cull_back_faces: bool,
    /// Supersampling factor of the drawing. Default 1; more smooths every edge and keeps
    /// the lines' width.
    pub supersample: Supersample,
}

impl Default for Inking {
    fn default() -> Self {
        Self {
            is_inked: true,
            classes: ClassSet::of(&[Class::Boundary, Class::Silhouette, Class::Crease]).or(ClassSet::FREE),
            crease_angle: CreaseAngle::default(),
            silhouette: SilhouetteRule::Published,
            line_width: Length::Px(2.0),
            is_smooth: true,
            has_joints: true,
            back_edges: true,
            line_drawing: LineDrawing::Gl,
            writes_depth: true,
            colors: ClassColors::default(),
            polygon_offset: [1.0, 5.0],
            paint: PaintMode::Ramp,
            ramp: Ramp::default(),
            ramp_row: RampRow::Material,
            light: LightOn::Cpu,
            has_texture: false,
            cull_back_faces: false,
            supersample: Supersample::One,
        }
    }
}

impl Inking {
    /// Its settings.
    pub(super) fn settings() -> Vec<Setting<Self>> {
        let common = vec![
            no_borders(|inking: &Self| !inking.is_inked, |inking, is_without| inking.is_inked = !is_without),
            cull(|inking: &mut Self| &mut inking.cull_back_faces),
            Supersample::setting(|inking: &mut Self| &mut inking.supersample),
        ];
        let lines = vec![
            CreaseAngle::setting(|inking: &mut Self| &mut inking.crease_angle),
            SilhouetteRule::setting(|inking: &mut Self| &mut inking.silhouette),
            ClassSet::setting(CLASSES, |inking: &mut Self| &mut inking.classes),
            ClassColors::setting(|inking: &mut Self| &mut inking.colors),
            line_width(|inking: &mut Self| &mut inking.line_width),
            Setting::field(
                "smooth",
                ON_OFF,
                "Smooth and blend the lines, on or off; quads are never smoothed",
                |inking: &mut Self| &mut inking.is_smooth,
            ),
            Setting::field(
                "joints",
                ON_OFF,
                "Join lines with points at their ends, on or off; thin lines hardly need it",
                |inking: &mut Self| &mut inking.has_joints,
            ),
            Setting::field(
                "back-edges",
                ON_OFF,
                "Draw edges whose faces both point away, on or off; closed models hide nearly all of them",
                |inking: &mut Self| &mut inking.back_edges,
            ),
            Setting::field(
                "line-drawing",
                "HOW",
                "Draw lines as GL lines (gl) or as quads of exactly their width (quads)",
                |inking: &mut Self| &mut inking.line_drawing,
            ),
            Setting::either(
                "ink-depth",
                "HOW",
                ["test", "write"],
                "Depth of the lines: write it, as in the text (write; smoothed lines get gaps), or only test it \
                 (test)",
                |inking: &mut Self| &mut inking.writes_depth,
            ),
            Setting::field(
                "polygon-offset",
                "F,U",
                "How far faces are pushed behind the lines: glPolygonOffset's factor and units",
                |inking: &mut Self| &mut inking.polygon_offset,
            )
            .range(-10.0, 20.0, 1),
        ];
        let faces = vec![
            Setting::field(
                "paint",
                "HOW",
                "Paint of the faces: none (the background's colour), flat (their own colour), or by light: ramp (a \
                 tone for each pixel), flat-shaded (a tone for each face), gouraud (tones mixed between vertices)",
                |inking: &mut Self| &mut inking.paint,
            ),
            Setting::field(
                "ramp",
                "FILE",
                "Picture of four gradients, one above the other, dark at the left",
                |inking: &mut Self| &mut inking.ramp,
            )
            .inside("texture")
            .said("built in"),
            Setting::field(
                "ramp-row",
                "ROW",
                "Gradient of the ramp: material (the one nearest to the material's colour), object (the next one for \
                 each object), 0 to 3, or own (made from each colour)",
                |inking: &mut Self| &mut inking.ramp_row,
            ),
            Setting::field(
                "light",
                "WHERE",
                "Compute the light on the cpu or in a vertex-shader",
                |inking: &mut Self| &mut inking.light,
            )
            .labelled("light on"),
            Setting::field(
                "texture",
                ON_OFF,
                "Multiply the paint by the model's own texture, on or off",
                |inking: &mut Self| &mut inking.has_texture,
            ),
        ];
        under(ALL_STYLES, common).chain(under(INKING, lines)).chain(under(INKING, faces)).collect()
    }
}

tinta_geometry::choices! {
    /// How faces are painted.
    pub enum PaintMode {
        /// In the background's colour, only to hide lines.
        None = "none",
        /// Each material in its colour.
        Flat = "flat",
        /// By the light, looked up in the ramp at every pixel.
        Ramp = "ramp",
        /// By the light on each face, looked up in the ramp once per face: flat shading, which shows the triangles.
        FlatShaded = "flat-shaded",
        /// By the light at each vertex, looked up in the ramp. Between vertices the colours are mixed (Gouraud shading), which
        /// gives more colours than the ramp has.
        Gouraud = "gouraud",
    }
}

tinta_geometry::choices! {
    /// Where the ramp's light is computed.
    pub enum LightOn {
        /// On the CPU at every vertex, as in the listing.
        Cpu = "cpu",
        /// In a vertex shader, as the text's last section proposes.
        VertexShader = "vertex-shader",
    }
}

/// The classes it can draw: its lines run along edges, or belong to no surface.
const CLASSES: ClassSet = ClassSet::EDGES.or(ClassSet::FREE);

/// Diameter of a model's own points, line widths; exact lines draw them as large.
const POINT_WIDTHS: f32 = 2.0;

/// Widest line, pixels: the largest picture of most drivers.
const WIDEST_LINE: f32 = 16_384.0;

impl Inking {
    /// Whether a step reads normals.
    pub(crate) fn reads_normals(&self) -> bool {
        self.paint != PaintMode::None || self.is_inked && self.classes.contains(Class::Normal)
    }

    /// Paint, then ink.
    pub(super) fn plan(&self, scene: &Scene, show: Show) -> Result<Plan> {
        self.check(scene, show)?;
        let (fill, pictures) = self.fill(scene, show);
        let ground = if show == Show::Borders { blank(scene) } else { scene.background.clear_color() };
        let texture = match (show, self.paint) {
            (Show::Borders, _) | (_, PaintMode::None) => None,
            _ => fill.first().and_then(|draw| textured(scene, &Draw { faces: None, ..draw.clone() })),
        };
        let paint = std::iter::once(Step::clear(ground)).chain(fill.into_iter().map(Step::Draw)).chain(texture);
        let mut passes = vec![Pass::new("paint", paint.collect())];
        if self.is_inked && show != Show::Tones {
            let (runs, points) = (Arc::new(self.runs(scene)), self.points(scene));
            let step = |runs: Arc<Vec<EdgeRun>>, mark, widths: f32| {
                let geometry = Geometry::Edges {
                    runs,
                    mark,
                    width_px: self.line_width_px(scene) * widths * self.scale(),
                    is_smooth: self.is_smooth && self.line_drawing == LineDrawing::Gl,
                    line_drawing: self.line_drawing,
                };
                let depth = if self.writes_depth { Depth::TestAndWrite } else { Depth::TestOnly };
                let blend = if self.is_smooth { Blend::Over } else { Blend::Replace };
                Step::Draw(Draw { blend, depth, ..Draw::new(geometry, None) })
            };
            let marks = if self.has_joints { vec![Mark::Lines, Mark::Points] } else { vec![Mark::Lines] };
            let mut steps: Vec<Step> = marks.into_iter().map(|mark| step(runs.clone(), mark, 1.0)).collect();
            if !points.is_empty() {
                steps.push(step(Arc::new(points), Mark::Points, POINT_WIDTHS));
            }
            passes.push(Pass::new("ink", steps));
        }
        Ok(self.supersample.finish(Plan { pictures, ..Plan::new(passes) }, scene.size))
    }

    /// The width of lines in pixels of the picture.
    fn line_width_px(&self, scene: &Scene) -> f32 {
        let units = Units { px_per_mm: None, height_px: f64::from(scene.size.height) };
        self.line_width.px(units).map_or(f32::NAN, |px| px as f32)
    }

    /// Drawn pixels per picture pixel, along a side.
    fn scale(&self) -> f32 {
        self.supersample.factor() as f32
    }

    fn check(&self, scene: &Scene, show: Show) -> Result<()> {
        let width_px = self.line_width_px(scene);
        if !(width_px > 0.0 && width_px <= WIDEST_LINE) {
            return Err(Error::value(
                "line-width",
                self.line_width,
                format!("a line's width is a number of pixels above 0 and at most {WIDEST_LINE}"),
            ));
        }
        let beyond = self.classes.classes().find(|class| !CLASSES.contains(*class));
        if let Some(class) = beyond {
            let problem = match class {
                Class::Intersection => {
                    "only style lines finds where faces pass through one another; leave it out, or write a .svg"
                }
                _ => "only style lines finds lines that run through faces; leave it out, or write a .svg",
            };
            return Err(Error::value("classes", class.name(), problem));
        }
        if let Some(name) = self.colors.0.first_beyond_classes() {
            let problem =
                "only drawings by style lines tell outlines and hidden lines apart; leave it out, or write a .svg";
            return Err(Error::value("class-colors", name, problem));
        }
        if self.ramp_row == RampRow::Own && self.ramp != Ramp::default() {
            return Err(Error::value(
                "ramp-row",
                "own",
                "its gradients are made of the materials' colours and none is read from a picture; leave out this or --ramp",
            ));
        }
        if let RampRow::Row(row) = self.ramp_row
            && u32::from(row) >= self.ramp.rows
        {
            let problem = format!("this ramp's gradients are 0 to {}", self.ramp.rows - 1);
            return Err(Error::value("ramp-row", row, problem));
        }
        if self.polygon_offset.iter().any(|number| !number.is_finite()) {
            return Err(Error::setting("polygon-offset", "its two numbers must be finite"));
        }
        if !matches!(show, Show::Final | Show::Borders | Show::Tones) {
            return Err(Error::setting(
                "show",
                "the style inking has no map, light or paper; show final, borders or tones",
            ));
        }
        if show == Show::Borders && !self.is_inked {
            return Err(Error::value("show", "borders", "--no-borders leaves none to show; leave out one of the two"));
        }
        let has_picture = |material: &crate::mesh::Material| material.has_texture();
        if self.has_texture && !scene.objects.iter().any(|object| object.mesh.materials.iter().any(has_picture)) {
            return Err(Error::value(
                "texture",
                "on",
                "no model of this scene has a picture on it; name one with --skin, or leave out --texture",
            ));
        }
        Ok(())
    }

    /// Draws the faces, painted or blank; returns the pictures they read.
    fn fill(&self, scene: &Scene, show: Show) -> (Vec<Draw>, Vec<PlanPicture>) {
        let paint_mode = if show == Show::Borders { None } else { Some(self.paint) };
        let gradients = Gradients::new(scene, &self.ramp, self.ramp_row);
        let (mut textures, mut pictures, mut program) = (Vec::new(), Vec::new(), None);
        let all = |paint| vec![(paint, None)];
        let paints = match paint_mode {
            None => all(Paint::Uniform(blank(scene))),
            Some(PaintMode::None) => all(Paint::Uniform(scene.background.clear_color())),
            Some(PaintMode::Flat) => all(Paint::Materials),
            Some(PaintMode::FlatShaded) => {
                let tones = faces_by_tone(scene, &gradients).into_iter();
                tones.map(|(color, faces)| (Paint::Uniform(color), Some(faces))).collect()
            }
            Some(PaintMode::Gouraud) => all(Paint::Colors(vertex_colors(&gradients))),
            Some(PaintMode::Ramp) => {
                let picture = gradients.picture().clone();
                pictures.push(PlanPicture { name: "ramp", picture, sampling: Sampling::NearestClamped });
                textures.push(("ramp", Texture::Picture(0)));
                if self.light == LightOn::VertexShader {
                    program = Some(Program::new("dachsbacher/ramp.vert", [""; 0]));
                }
                all(Paint::Coordinates(gradients.coordinates(self.light == LightOn::Cpu)))
            }
        };
        if self.has_texture && !matches!(paint_mode, None | Some(PaintMode::None)) {
            textures.push(("own", Texture::Material { is_averaged: false }));
        }
        // Its factor counts depth steps between pixels, which shrink with the pixels; its units do not.
        let [factor, units] = self.polygon_offset;
        let draw = |(paint, faces)| Draw {
            textures: textures.clone(),
            cull_back_faces: self.cull_back_faces,
            polygon_offset: Some([factor * self.scale(), units]),
            faces,
            facts: Facts::plain(),
            ..Draw::new(Geometry::Objects(paint), program.clone())
        };
        (paints.into_iter().map(draw).collect(), pictures)
    }
}

/// Returns the ground for lines alone: white, or transparent.
fn blank(scene: &Scene) -> [f32; 4] {
    if scene.background == Background::Transparent { [0.0; 4] } else { [1.0; 4] }
}
