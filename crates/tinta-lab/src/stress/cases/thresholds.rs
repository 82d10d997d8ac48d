//! Settings and geometry at the very edge of a decision.

use super::case::{Case, Drawing, Group, Study, looking};
use crate::stress::{Shape, Variant};
use glam::DVec3;
use tinta::camera::CameraSettings;
use tinta::edges::CreaseAngle;
use tinta::lines::{Length, LineSettings};
use tinta::scene::Size;
use tinta::styles::{Border, Cartoon, Charcoal, Dietrich, Inking, Style, Tones};

pub(super) fn cases() -> Vec<Case> {
    [geometry(), tones(), borders(), charcoal()].concat()
}

fn rendered(name: impl Into<String>, drawing: Drawing) -> Case {
    Case::rendered(Group::Thresholds, name, drawing)
}

fn geometry() -> Vec<Case> {
    let threshold = LineSettings::as_published().crease_angle.degrees();
    let mut all = Vec::new();
    for (offset, creases) in [(-1e-7, 0.0), (1e-7, 1.0)] {
        let drawing = Drawing { shape: Shape::Hinge(threshold + offset), ..Drawing::default() };
        let name = format!("a hinge {offset:e} degrees beyond the crease angle");
        all.push(rendered(name, drawing).with("crease", creases, creases));
    }
    // The cube's right side is visible only from beyond its plane; then the outline goes around two faces. In or nearly in its
    // plane both outlines count: an eye just beside the plane sees one or the other.
    for (offset, silhouettes) in [(-1e-8, 4.0), (-1e-12, 7.0), (0.0, 7.0), (1e-12, 7.0), (1e-8, 6.0)] {
        let camera = looking(DVec3::new(1.0 + offset, 0.3, 5.0), DVec3::splat(0.5));
        let name = format!("the eye {offset:e} beyond a face's plane");
        all.push(rendered(name, Drawing { camera, ..Drawing::default() }).with("silhouette", silhouettes, silhouettes));
    }
    // Eye space is in scene radii around the eye: this shape's is 1.
    let camera = CameraSettings { fov_y_degrees: 60.0, ..looking(DVec3::ZERO, DVec3::NEG_Z) };
    let drawing = Drawing { shape: Shape::ThroughTheLight, camera, ..Drawing::default() };
    all.push(rendered("a vertex where the light stands", drawing));
    all
}

fn tones() -> Vec<Case> {
    let with = |diffuse_threshold: f32, specular_threshold: f32| {
        let tones = Tones { diffuse_threshold, specular_threshold, ..Tones::default() };
        Variant::new("three-pass", Style::ThreePass(Cartoon { tones, ..Cartoon::default() }))
    };
    let drawn = [
        ("tone thresholds that are equal", 0.5, 0.5),
        ("tone thresholds in reverse", 0.65, 0.8),
        ("tone thresholds below 0", -1.0, -5.0),
        ("tone thresholds above 1", 7.0, 9.0),
        ("a tone threshold that the light reaches exactly", 1.0, 1.0),
        ("tone thresholds of 1e38", 1e38, -1e38),
    ];
    let drawn = drawn.map(|(name, diffuse, specular)| rendered(name, of_ball(with(diffuse, specular))));
    let never = [("a tone threshold that is no number", f32::NAN), ("an infinite tone threshold", f32::INFINITY)];
    let never = never.map(|(name, threshold)| refused(name, with(threshold, 0.5), "--tone-thresholds"));
    let mut all: Vec<Case> = drawn.into_iter().chain(never).collect();
    let tones = Tones { levels: [2.0, 0.0, -1.0], ..Tones::default() };
    let levels = Variant::new("three-pass", Style::ThreePass(Cartoon { tones, ..Cartoon::default() }));
    all.push(refused("tones brighter than all light", levels, "--tone-levels"));
    let dietrich = Style::Dietrich(Dietrich { threshold: 1.0, ..Dietrich::default() });
    all.push(rendered("an outline threshold of 1", of_ball(Variant::new("dietrich", dietrich))));
    all
}

fn borders() -> Vec<Case> {
    let with = |detection_factor: f32| {
        let cartoon = Cartoon { border: Some(Border { detection_factor, ..Border::default() }), ..Cartoon::default() };
        Variant::new(format!("three-pass --detection-factor {detection_factor}"), Style::ThreePass(cartoon))
    };
    let none = rendered("a detection factor of 0", of_ball(with(0.0))).with("ink_px", 0.0, 0.0);
    let negative = rendered("a negative detection factor", of_ball(with(-1.0)));
    let huge = rendered("a detection factor of 1e9", of_ball(with(1e9))).with("ink_px", 100.0, 1e5);
    let mut all = vec![none, negative, huge];
    all.push(refused("a detection factor that is no number", with(f32::NAN), "--detection-factor"));
    let inking = |name: &str, inking: Inking| {
        let variants = vec![Variant::new("inking", Style::Inking(inking))];
        rendered(name, Drawing { variants, ..Drawing::default() })
    };
    for (name, degrees) in [("a crease angle of 0 degrees", 0.0), ("a crease angle of 180 degrees", 180.0)] {
        let crease_angle = CreaseAngle::from_degrees(degrees).unwrap_or_default();
        all.push(inking(name, Inking { crease_angle, ..Inking::default() }));
    }
    for (name, width) in [("a line width of 1e-6", 1e-6), ("a line width of 1e3", 1e3)] {
        let case = inking(name, Inking { line_width: Length::Px(width), ..Inking::default() });
        all.push(Case { expected: super::Demand::Either(&["setting"]), ..case });
    }
    all.push(inking("a polygon offset of 1e9", Inking { polygon_offset: [1e9, -1e9], ..Inking::default() }));
    all
}

fn charcoal() -> Vec<Case> {
    let with = |charcoal: Charcoal| Variant::new("charcoal", Style::Charcoal(charcoal));
    let base = Charcoal::default;
    let exponent = |contrast_exponent| with(Charcoal { contrast_exponent, ..base() });
    let density = |density_percent| with(Charcoal { density_percent, ..base() });
    let texture_size = Size { width: 1, height: 1 };
    let lights = |lights: [[f32; 3]; 2]| with(Charcoal { lights: lights.map(Some), ..base() });
    let drawn = [
        ("a contrast exponent of 1e-30", "all that is lit is white", exponent(1e-30)),
        ("a contrast exponent of 0.5", "light is raised, not lowered", exponent(0.5)),
        ("a contrast exponent of 1", "", exponent(1.0)),
        ("a contrast exponent of 1000", "", exponent(1000.0)),
        ("a contrast exponent of 1e30", "all that is not lit fully is black", exponent(1e30)),
        ("a density of 0 percent", "", density(0.0)),
        ("a density of 100 percent", "", density(100.0)),
        ("a saturation of a million", "", with(Charcoal { saturation: 1e6, ..base() })),
        ("a saturation of 0", "", with(Charcoal { saturation: 0.0, ..base() })),
        ("lights as short as 1e-30", "", lights([[1e-30, 0.0, 0.0], [0.0, 1e-30, 0.0]])),
        ("lights as long as 1e30", "", lights([[1e30, 0.0, 0.0], [0.0, 1e30, 1e30]])),
        ("textures of one texel", "each is one tone", with(Charcoal { texture_size, ..base() })),
    ];
    let drawn = drawn.map(|(name, answer, variant)| Case { answer, ..rendered(name, of_ball(variant)) });
    let mut all = drawn.to_vec();
    let never = [
        ("a contrast exponent of 0", exponent(0.0), "--contrast"),
        ("a negative contrast exponent", exponent(-1.0), "--contrast"),
        ("a contrast exponent that is no number", exponent(f32::NAN), "--contrast"),
        ("a density of 101 percent", density(101.0), "--density"),
        ("a light without direction", lights([[0.0; 3], [1.0; 3]]), "--light"),
    ];
    all.extend(never.map(|(name, variant, words)| refused(name, variant, words)));
    all
}

fn of_ball(variant: Variant) -> Drawing {
    Drawing { shape: Shape::Ball(3), variants: vec![variant], ..Drawing::default() }
}

fn refused(name: &str, variant: Variant, words: &'static str) -> Case {
    let drawing = Drawing { study: Study::Picture, ..of_ball(variant) };
    Case::refused(Group::Thresholds, name, drawing, "setting", words)
}
