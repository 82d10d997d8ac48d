//! A style's settings as options.

use super::Options;
use super::settings::Changed;
use crate::edges::SilhouetteRule;
use crate::error::{Error, Result};
use crate::names::name_of;
use crate::plan::LineDrawing;
use crate::styles::{
    Border, Cartoon, CetCoordinate, CetFilter, Charcoal, ContrastOperator, Dietrich, Filter, Improvements, Ink, Inking,
    LightOn, MapEncoding, MapTarget, Mrt, Noise, PaintMode, Paper, Phong, Quality, Ramp, RampRow, Style, Supersample,
    ToneLookup, Tones,
};

/// The options that make this style with these settings: its name, and what differs from the default; so one option alone
/// is the published style.
///
/// # Errors
///
/// [`Error::Setting`] for a setting that no option sets, and for a file whose name is no text.
pub fn of_style(style: &Style) -> Result<Options> {
    let mut changed = Changed::default();
    changed.set("style", style.name());
    match style {
        Style::Phong(phong) => {
            let Phong { ambient, specular, shininess, cull_back_faces } = phong;
            let default = Phong::default();
            refuse_changed("ambient", *ambient != default.ambient)?;
            refuse_changed("specular", *specular != default.specular)?;
            refuse_changed("shininess", *shininess != default.shininess)?;
            changed.cull(*cull_back_faces);
        }
        Style::ThreePass(cartoon) | Style::TwoPass(cartoon) => changed.cartoon(cartoon),
        Style::Mrt(mrt) => {
            let Mrt { tones, border, background_square, cull_back_faces, supersample } = mrt.clone();
            let default = Cartoon::default();
            changed.cartoon(&Cartoon { tones, border, background_square, cull_back_faces, supersample, ..default });
        }
        Style::Inking(inking) => changed.inking(inking)?,
        Style::Dietrich(dietrich) => {
            let Dietrich { threshold, ink, cull_back_faces } = dietrich;
            let default = Dietrich::default();
            refuse_changed("ink", *ink != default.ink)?;
            changed.number("ink-threshold", *threshold, default.threshold);
            changed.cull(*cull_back_faces);
        }
        Style::Ink(ink) => changed.ink(ink)?,
        Style::Charcoal(charcoal) | Style::Sand(charcoal) => changed.charcoal(charcoal)?,
    }
    Ok(changed.0)
}

impl Changed {
    fn tones(&mut self, tones: &Tones) {
        let Tones { count, diffuse_threshold, specular_threshold, levels, lookup } = tones;
        let default = Tones::default();
        self.number("tones", *count, default.count);
        let thresholds = [*diffuse_threshold, *specular_threshold];
        self.numbers("tone-thresholds", thresholds, [default.diffuse_threshold, default.specular_threshold]);
        self.numbers("tone-levels", *levels, default.levels);
        self.choice("tone-lookup", &ToneLookup::ALL, *lookup, default.lookup);
    }

    fn cartoon(&mut self, cartoon: &Cartoon) {
        let Cartoon { tones, border, background_square, cull_back_faces, map_encoding, map_target, supersample } =
            cartoon;
        let default = Cartoon::default();
        self.tones(tones);
        match border {
            Some(border) => {
                let Border { filter, detection_factor, width_px, slope_threshold } = border;
                let default = Border::default();
                self.choice("filter", &Filter::ALL, *filter, default.filter);
                self.number("detection-factor", *detection_factor, default.detection_factor);
                self.given("border-width", *width_px);
                self.on_off("slope-threshold", *slope_threshold, default.slope_threshold);
            }
            None => self.flag("no-borders", true),
        }
        self.on_off("background-quad", *background_square, default.background_square);
        self.cull(*cull_back_faces);
        self.choice("map-encoding", &MapEncoding::ALL, *map_encoding, default.map_encoding);
        self.choice("map-target", &MapTarget::ALL, *map_target, default.map_target);
        self.choice("supersample", &Supersample::ALL, *supersample, default.supersample);
    }

    fn inking(&mut self, inking: &Inking) -> Result<()> {
        let Inking {
            is_inked,
            classes,
            crease_angle,
            silhouette,
            line_width_px,
            is_smooth,
            has_joints,
            back_edges,
            line_drawing,
            writes_depth,
            colors,
            polygon_offset,
            paint,
            ramp,
            ramp_row,
            light,
            has_texture,
            cull_back_faces,
        } = inking;
        let default = Inking::default();
        self.flag("no-borders", !is_inked);
        self.classes(*classes, default.classes)?;
        self.crease_angle(*crease_angle);
        self.choice("silhouette", &SilhouetteRule::ALL, *silhouette, default.silhouette);
        self.number("line-width", *line_width_px, default.line_width_px);
        self.on_off("smooth", *is_smooth, default.is_smooth);
        self.on_off("joints", *has_joints, default.has_joints);
        self.on_off("back-edges", *back_edges, default.back_edges);
        self.choice("line-drawing", &LineDrawing::ALL, *line_drawing, default.line_drawing);
        if *writes_depth != default.writes_depth {
            self.set("ink-depth", "test");
        }
        self.class_colors(colors);
        self.numbers("polygon-offset", *polygon_offset, default.polygon_offset);
        self.choice("paint", &PaintMode::ALL, *paint, default.paint);
        refuse_changed("ramp", ramp.path.is_none() && *ramp != Ramp::default())?;
        self.path("ramp", ramp.path.as_deref())?;
        match ramp_row {
            RampRow::Material => {}
            RampRow::Object => self.set("ramp-row", "object"),
            RampRow::Row(row) => self.set("ramp-row", row),
        }
        self.choice("light", &LightOn::ALL, *light, default.light);
        self.on_off("texture", *has_texture, default.has_texture);
        self.cull(*cull_back_faces);
        Ok(())
    }

    fn ink(&mut self, ink: &Ink) -> Result<()> {
        let Ink {
            quality,
            supersample,
            is_inked,
            crease_angle,
            line_width_px,
            least_gap_px,
            gap_per_slope,
            tones,
            cull_back_faces,
            map_target,
        } = ink;
        let default = Ink::default();
        refuse_changed("least_gap_px", *least_gap_px != default.least_gap_px)?;
        refuse_changed("gap_per_slope", *gap_per_slope != default.gap_per_slope)?;
        self.choice("quality", &Quality::ALL, *quality, default.quality);
        self.given("supersample", supersample.map(|supersample| name_of(&Supersample::ALL, supersample)));
        self.flag("no-borders", !is_inked);
        self.crease_angle(*crease_angle);
        self.number("border-width", *line_width_px, default.line_width_px);
        self.tones(tones);
        self.cull(*cull_back_faces);
        self.choice("map-target", &MapTarget::ALL, *map_target, default.map_target);
        Ok(())
    }

    fn charcoal(&mut self, charcoal: &Charcoal) -> Result<()> {
        let Charcoal {
            contrast_exponent,
            saturation,
            smudge,
            lights,
            density_percent,
            cet_exponent,
            seed,
            texture_size,
            paper,
            cet_filter,
            cet_coordinate,
            operator,
            noise,
            improve,
            cull_back_faces,
            pictures: _,
        } = charcoal;
        let default = Charcoal::default();
        self.number("contrast-exponent", *contrast_exponent, default.contrast_exponent);
        self.number("saturation", *saturation, default.saturation);
        self.on_off("smudge", *smudge, default.smudge);
        self.numbers("light-1", lights[0], default.lights[0]);
        self.numbers("light-2", lights[1], default.lights[1]);
        self.number("density", *density_percent, default.density_percent);
        self.number("cet-exponent", *cet_exponent, default.cet_exponent);
        self.number("seed", *seed, default.seed);
        self.number("texture-size", *texture_size, default.texture_size);
        if let Paper::File { path, .. } = paper {
            self.path("paper", Some(path))?;
        }
        self.choice("cet-filter", &CetFilter::ALL, *cet_filter, default.cet_filter);
        self.choice("cet-coordinate", &CetCoordinate::ALL, *cet_coordinate, default.cet_coordinate);
        self.choice("contrast-operator", &ContrastOperator::ALL, *operator, default.operator);
        self.choice("noise", &Noise::ALL, *noise, default.noise);
        let Improvements { clamp, wrap, paper_coordinate, luminance } = improve;
        let mended =
            [("clamp", clamp), ("wrap", wrap), ("paper-coordinate", paper_coordinate), ("luminance", luminance)];
        let mended: Vec<&str> = mended.iter().filter(|(_, is_mended)| **is_mended).map(|(name, _)| *name).collect();
        if !mended.is_empty() {
            self.set("improve", mended.join(","));
        }
        self.cull(*cull_back_faces);
        Ok(())
    }
}

fn refuse_changed(setting: &str, is_changed: bool) -> Result<()> {
    match is_changed {
        false => Ok(()),
        true => Err(Error::setting(setting, "no option sets this, so it cannot be kept; leave it as it is by default")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::edges::ClassSet;
    use crate::preset::OptionValue;
    use crate::styles::StyleName;

    #[test]
    fn the_published_styles_are_their_names() {
        for (name, style) in StyleName::ALL {
            let options = of_style(&Style::named(style)).unwrap();
            assert_eq!(options, [("style".to_owned(), OptionValue::text(name))].into());
        }
    }

    #[test]
    fn what_no_option_sets_is_refused_by_name() {
        let refused = |style: Style| of_style(&style).unwrap_err().to_string();
        assert!(refused(Style::Phong(Phong { ambient: 0.5, ..Phong::default() })).starts_with("ambient: no option"));
        assert!(refused(Style::Ink(Ink { gap_per_slope: 1.0, ..Ink::default() })).starts_with("gap_per_slope"));
        let inking = Inking { classes: ClassSet::default(), ..Inking::default() };
        assert!(refused(Style::Inking(inking)).starts_with("--classes"));
    }
}
