//! Lines put to scale: how many of their pixels are a millimetre of the paper.

use super::drawing::drawn_layers::page;
use super::drawing::page::PageSize;
use super::drawing::scale::Scale;
use super::drawing::settings::DrawingSettings;
use super::visible_lines::VisibleLines;
use crate::error::{Error, Result};
use crate::settings::Value;

impl VisibleLines {
    /// Makes the drawing to the scale of its settings, where a length of the model is this many pixels; `None` in a perspective.
    ///
    /// # Errors
    ///
    /// [`Error::Setting`] for a perspective, and for a scale at which the drawing does not fit its paper, with the largest round
    /// one at which it does.
    pub fn put_to_scale(&mut self, px_per_unit: Option<f64>, drawing: &DrawingSettings) -> Result<()> {
        let Some(scale) = drawing.scale else { return Ok(()) };
        let Some(px_per_unit) = px_per_unit else {
            let problem = "a perspective has no scale; add --parallel";
            return Err(Error::value("scale", scale.text(), problem));
        };
        let Some(largest) = self.largest_scale(px_per_unit, drawing) else { return Ok(()) };
        if scale.0 > largest.0 * (1.0 + 1e-9) {
            let round = largest.rounded().text();
            let problem = format!("the drawing does not fit its paper; the largest round scale that does is {round}");
            return Err(Error::value("scale", scale.text(), problem));
        }
        self.px_per_mm = Some(px_per_unit / (scale.0 * drawing.units.millimetres()));
        Ok(())
    }

    /// The scale at which the drawing fills its paper up to the margins; `None` without paper.
    pub(in crate::lines) fn largest_scale(&self, px_per_unit: f64, drawing: &DrawingSettings) -> Option<Scale> {
        let filling =
            page(self, None, drawing).units.px_per_mm.filter(|_| matches!(drawing.page_size, PageSize::Paper(_)));
        filling.map(|px_per_mm| Scale::of_pixels(px_per_unit, px_per_mm, drawing.units))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::camera::{CameraSettings, Projection};
    use crate::lines::{LineSettings, ModelUnit};
    use crate::scene::{Scene, SceneSettings};
    use glam::DVec2;
    use std::sync::Arc;

    /// The lines of an open box, 3 units wide and seen from the front, and how many pixels a unit is.
    fn open_box() -> (VisibleLines, Option<f64>) {
        let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../models/open-box.obj");
        let mesh = crate::mesh::load(path, &Default::default()).unwrap().mesh;
        let camera = CameraSettings { view: "front".parse().unwrap(), parallel: true, ..CameraSettings::default() };
        let scene = Scene::new([Arc::new(mesh)], &SceneSettings { camera, ..SceneSettings::default() }).unwrap();
        let Projection::Parallel { height } = scene.camera.projection else { unreachable!() };
        let px_per_unit = f64::from(scene.size.height) / height;
        (VisibleLines::of(&scene, &LineSettings::default()).unwrap(), Some(px_per_unit))
    }

    fn on_a4(scale: &str, units: ModelUnit) -> DrawingSettings {
        let page_size = PageSize::Paper("A4".parse().unwrap());
        DrawingSettings { page_size, scale: Some(scale.parse().unwrap()), units, ..DrawingSettings::default() }
    }

    #[test]
    fn lengths_on_paper_are_the_models_times_the_scale() {
        let (lines, px_per_unit) = open_box();
        let ends = || lines.segments.iter().flat_map(|segment| segment.ends_px);
        let width_px = ends().map(|end| end.x).fold(f64::NEG_INFINITY, f64::max)
            - ends().map(|end| end.x).fold(f64::INFINITY, f64::min);
        let width_units = width_px / px_per_unit.unwrap();
        for (scale, units, factor) in [
            ("1:1", ModelUnit::Cm, 10.0),
            ("1:2.5", ModelUnit::Cm, 4.0),
            ("20:1", ModelUnit::Mm, 20.0),
            ("1:20", ModelUnit::M, 50.0),
            ("2:1", ModelUnit::In, 50.8),
        ] {
            let (mut lines, settings) = (lines.clone(), on_a4(scale, units));
            lines.put_to_scale(px_per_unit, &settings).unwrap();
            let mm = width_px / lines.px_per_mm.unwrap();
            assert!((mm - width_units * factor).abs() < 1e-9, "{scale}: {mm} mm");
            // The paper keeps its size, and the drawing its middle.
            let page = page(&lines, None, &settings);
            assert_eq!(page.units.px_per_mm, lines.px_per_mm, "{scale}");
            let sides = page.lengths().map(|side| side.trim_end_matches("mm").parse::<f64>().unwrap());
            let extent_mm = page.extent_px / lines.px_per_mm.unwrap();
            assert!(
                extent_mm.distance(DVec2::from(sides)) < 1e-6 && (sides[0] == 210.0 || sides[0] == 297.0),
                "{scale}"
            );
        }
    }

    #[test]
    fn what_does_not_fit_is_refused_with_a_scale_that_does() {
        let (mut lines, px_per_unit) = open_box();
        let refused = |lines: &mut VisibleLines, px_per_unit, scale: &str| {
            lines.put_to_scale(px_per_unit, &on_a4(scale, ModelUnit::M)).unwrap_err().to_string()
        };
        let said = refused(&mut lines, px_per_unit, "1:2");
        let fits = said.rsplit(' ').next().unwrap().to_owned();
        assert!(said.starts_with("scale 1:2: the drawing does not fit its paper; the largest round scale"), "{said}");
        assert!(lines.clone().put_to_scale(px_per_unit, &on_a4(&fits, ModelUnit::M)).is_ok(), "{fits}");
        assert!(refused(&mut lines, None, "1:20").contains("a perspective has no scale"));
        let without_paper = DrawingSettings { page_size: PageSize::Unset, ..on_a4("1:2", ModelUnit::Mm) };
        assert!(without_paper.check().unwrap_err().to_string().contains("add --page A4"));
    }
}
