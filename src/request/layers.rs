//! Layers of options, each beating those below it, as one request.

use super::gone::GONE;
use super::{EXACT_LINES, Request, Source};
use crate::camera;
use crate::choice::meant_or;
use crate::error::{Error, Result};
use crate::lines::{DrawingFormat, DrawingSettings, PartRole, PartStyle};
use crate::mesh::SectionPlanes;
use crate::preset::{LOOKS, Look, Preset};
use crate::scene::SceneSettings;
use crate::settings::{EXCLUSIVE, HasSettings, OptionValue, Options, refuse_exclusive};
use crate::styles::{StyleName, is_ignored, is_of_exact_lines, is_of_lines_alone, is_of_vectors};

/// Where options come from.
#[derive(Debug, Clone)]
pub enum OptionLayer {
    /// The style that is drawn where no layer names one; no recipe keeps it.
    Style(StyleName),
    /// A look. Its options for styles other than the drawn one do not count.
    Look(Look),
    /// A file or a substitute for one: a preset, a recipe, a camera.
    File(Preset),
    /// A camera, which replaces the camera of the layers below it.
    Camera(Preset),
    /// Options given by hand. A remark names those that do not affect the drawn style.
    Given(Options),
}

/// Returns the layers of a drawing, the lowest first: the named look (or the first look if no style, look or lines are given),
/// then files, then options given by hand. `draws_lines`: its file holds lines alone. An option that only drawings of lines alone
/// have asks for them, too.
///
/// # Errors
///
/// As [`Look::preset`].
pub fn layers(look: Option<Look>, files: Vec<Preset>, given: Options, draws_lines: bool) -> Vec<OptionLayer> {
    let draws_lines = draws_lines || given.keys().any(|name| is_of_lines_alone(name) && !is_of_exact_lines(name));
    let is_said = !files.is_empty() || given.contains_key("style") || draws_lines;
    let look = look.or(if is_said { None } else { Some(LOOKS[0]) });
    // A look draws its own style into vectors, too.
    let style = (draws_lines && look.is_none()).then_some(OptionLayer::Style(StyleName::Lines));
    let below = style.into_iter().chain(look.map(OptionLayer::Look));
    below.chain(files.into_iter().map(OptionLayer::File)).chain([OptionLayer::Given(given)]).collect()
}

/// A layer's options in this version's names, with the name of the file they come from, if any.
struct ReadLayer {
    options: Options,
    file: Option<Preset>,
    is_look: bool,
}

impl ReadLayer {
    fn of(layer: &OptionLayer) -> Result<Self> {
        let of_file =
            |file: &Preset, is_look| Self { options: file.options.clone(), file: Some(file.clone()), is_look };
        Ok(match layer {
            OptionLayer::Style(_) => Self { options: Options::new(), file: None, is_look: false },
            OptionLayer::Look(look) => of_file(&look.preset()?, true),
            OptionLayer::File(file) | OptionLayer::Camera(file) => of_file(file, false),
            OptionLayer::Given(options) => Self { options: given(options), file: None, is_look: false },
        })
    }

    fn refuse(&self, option: &str, problem: Error) -> Error {
        match &self.file {
            Some(file) => file.refuse(option, problem.to_string()),
            None => problem,
        }
    }

    /// Checks each option alone, then that none excludes another.
    fn check(mut self) -> Result<Self> {
        let table = Request::table();
        for (name, value) in std::mem::take(&mut self.options) {
            let mut settings = table.settings.iter().filter(|setting| setting.name == name);
            let Some(setting) = settings.next() else { return Err(self.refuse(&name, unknown(&name))) };
            let kept =
                setting.kept(value).map_err(|problem| self.refuse(&name, Error::setting(name.clone(), problem)))?;
            if let OptionValue::Text(text) = &kept {
                table
                    .check(&name, text)
                    .map_err(|problem| self.refuse(&name, Error::value(name.clone(), text, problem)))?;
            }
            self.options.insert(name, kept);
        }
        match refuse_exclusive(&self.options) {
            Err(Error::Settings { names, problem }) => {
                let first = names.first().cloned().unwrap_or_default();
                Err(self.refuse(&first, Error::Settings { names, problem }))
            }
            checked => checked.map(|()| self),
        }
    }
}

/// Options as given by hand: a section is meant in the axes of the model's file.
fn given(options: &Options) -> Options {
    let mut options = options.clone();
    let of_file = |planes: &mut String| *planes = SectionPlanes::of_file(planes);
    match options.get_mut("section") {
        Some(OptionValue::Text(planes)) => of_file(planes),
        Some(OptionValue::Texts(planes)) => planes.iter_mut().for_each(of_file),
        _ => {}
    }
    options
}

/// The error for an unknown option.
pub(crate) fn unknown(name: &str) -> Error {
    let names: Vec<&str> = Request::table().of(None).into_iter().map(|setting| setting.name).collect();
    if let Some(problem) = Request::gone(name) {
        return Error::setting(name, problem);
    }
    let choice = meant_or(name, &names, "keys are long names of tinta render --help");
    Error::setting(name.chars().take(40).collect::<String>(), format!("there is no such option; {choice}"))
}

/// Whether a value turns its option off.
fn is_off(value: &OptionValue) -> bool {
    *value == OptionValue::Switch(false)
}

/// Whether an option is the camera's.
pub(crate) fn is_of_camera(name: &str) -> bool {
    SceneSettings::table().settings.iter().any(|setting| setting.name == name && setting.heading == camera::HEADING)
}

/// Whether an option of a higher layer excludes this one.
fn is_excluded(name: &str, above: &Options) -> bool {
    let is_given = |name: &str| above.get(name).is_some_and(|value| !is_off(value));
    let excludes = |(one, others): &(&str, &[&str])| {
        (*one == name && others.iter().any(|other| is_given(other))) || (others.contains(&name) && is_given(one))
    };
    EXCLUSIVE.iter().any(excludes)
}

impl Request {
    /// Merges layers, the lowest first, and names the options given by hand that change nothing.
    ///
    /// # Errors
    ///
    /// [`Error::Setting`] for an unknown option or value, and for an option of exact lines where a picture is drawn;
    /// [`Error::File`] with the line where a file's option is refused; [`Error::Settings`] for options that exclude each other.
    pub fn from_layers(layers: &[OptionLayer]) -> Result<(Self, Vec<String>)> {
        let read: Vec<ReadLayer> = layers.iter().map(|layer| ReadLayer::of(layer)?.check()).collect::<Result<_>>()?;
        let named = read.iter().rev().find_map(|read| match read.options.get("style") {
            Some(OptionValue::Text(style)) => style.parse().ok(),
            _ => None,
        });
        let otherwise =
            layers.iter().find_map(|layer| if let OptionLayer::Style(style) = layer { Some(*style) } else { None });
        let style: StyleName = named.or(otherwise).unwrap_or(StyleName::ThreePass);
        let exact_lines = read.iter().rev().find_map(|read| read.options.get(EXACT_LINES));
        let has_exact_lines = exact_lines.is_some_and(|value| !is_off(value));
        let is_of_lines = |name: &str| is_of_vectors(name, style) || has_exact_lines && is_of_exact_lines(name);
        let mut request = Self::of_style(style);
        let mut has_camera = false;
        for (layer, read) in layers.iter().zip(&read).rev() {
            let above = request.options.clone();
            for (name, value) in &read.options {
                let is_of_another = read.is_look && is_ignored(name, &[style.name()]) && !is_of_lines(name);
                let is_beaten =
                    above.contains_key(name) || is_excluded(name, &above) || has_camera && is_of_camera(name);
                if is_beaten || is_of_another {
                    continue;
                }
                request.options.insert(name.clone(), value.clone());
                if let Some(file) = &read.file {
                    let source = Source { name: file.name.clone(), line: file.line_of(name) };
                    request.sources.insert(name.clone(), source);
                }
            }
            has_camera |= matches!(layer, OptionLayer::Camera(_));
        }
        request.options.retain(|_, value| !is_off(value));
        request.refuse_of_lines(|option| !is_of_lines(option)).map_err(|error| request.attributed(error))?;
        let options = request.options.clone();
        Self::table().apply(&mut request, &options).map_err(|error| request.attributed(error))?;
        let given = layers
            .iter()
            .filter_map(|layer| if let OptionLayer::Given(options) = layer { Some(options) } else { None });
        let given = given.flat_map(Options::keys).map(String::as_str);
        let has_no_effect = |option: &&str| !is_of_lines(option) && !request.is_of_surfaces(option);
        let remark = ignored_remark(given.clone().filter(has_no_effect), &[style.name()]);
        let is_given = |name: &str| given.clone().any(|option| option == name);
        let of_parts = request.part_remark().filter(|_| is_given("part"));
        let of_title = request.title_remark().filter(|_| is_given("title"));
        let remarks = remark.into_iter().chain(of_parts).chain(of_title).collect();
        Ok((request, remarks))
    }

    /// Why an option of an earlier version is unknown, and what took its place; `None` for any other name.
    pub fn gone(option: &str) -> Option<String> {
        GONE.iter().find(|(gone, _)| *gone == option).map(|(_, instead)| format!("this option is gone; {instead}"))
    }

    /// Refuses the options, other than a look's, that a style of passes has as vectors alone, for a picture.
    ///
    /// # Errors
    ///
    /// [`Error::Setting`] with the option.
    pub(crate) fn refuse_vectors_options(&self) -> Result<()> {
        let has_strokes = self.contents(false)?.has_strokes();
        let is_drawn = |option: &str| has_strokes && is_of_exact_lines(option) && !is_of_files(option);
        self.refuse_of_lines(|option| !self.is_of_look(option) && !is_drawn(option))
    }

    /// Refuses those of the options of exact lines alone that `is_refused` names, unless the style draws exact lines.
    fn refuse_of_lines(&self, is_refused: impl Fn(&str) -> bool) -> Result<()> {
        if self.style.style_name().draws_lines() {
            return Ok(());
        }
        let is_wrong =
            |option: &&String| is_of_lines_alone(option) && is_refused(option) && !self.is_of_surfaces(option);
        let Some(option) = self.options.keys().find(is_wrong) else { return Ok(()) };
        let has_vectors = self.style.vectors(self.scene.size).is_some();
        let problem = match OF_PAPER.contains(&option.as_str()) {
            true => pixels_on_paper(&self.options),
            false if has_vectors && !is_of_vectors(option, self.style.style_name()) => {
                "drawings of lines alone have it; leave it out, or choose --look technical or --style lines".to_owned()
            }
            false if option.starts_with("hatch") => {
                "strokes stand for the tones of a finished picture; leave it out, or choose --look print".to_owned()
            }
            false if is_of_exact_lines(option) && !is_of_files(option) => {
                "exact lines have it; leave it out, add --exact-lines, or write a .svg or .pdf".to_owned()
            }
            false => "a picture of pixels cannot have it; leave it out, or write a .svg or .pdf".to_owned(),
        };
        Err(Error::setting(option.clone(), problem))
    }

    /// Whether an option is `part`, and its rules are about surfaces and sections alone, which all styles have.
    pub(super) fn is_of_surfaces(&self, option: &str) -> bool {
        option == "part" && self.part_rules().is_ok_and(|rules| rules.0.iter().all(|rule| rule.style.is_of_surface()))
    }

    /// The remark about rules for parts that change nothing here, or another thing than may be meant.
    fn part_remark(&self) -> Option<String> {
        let styles = self.part_rules().ok()?.0.into_iter().map(|rule| rule.style).collect::<Vec<PartStyle>>();
        let has_fill = styles.iter().any(|style| style.fill.is_some());
        let is_uncut = styles.iter().any(|style| style.role == Some(PartRole::Uncut));
        let remark = match self.style.style_name().draws_lines() {
            _ if is_uncut && self.read.section.is_none() => "uncut changes nothing without --section",
            true if has_fill => "a drawing of lines alone shows no fill; choose --look print, or color for the lines",
            false if !has_fill && styles.iter().any(|style| style.color.is_some()) => {
                "color is that of a part's lines; for its surface say fill"
            }
            _ => return None,
        };
        Some(format!("--part: {remark}"))
    }

    /// The remark about a title on paper without a title block.
    fn title_remark(&self) -> Option<String> {
        let has = |option: &str| self.options.contains_key(option);
        let remark =
            "--title: the file has it, and the paper does not show it; --sheet third draws it in a title block";
        (has("page") && !has("sheet")).then(|| remark.to_owned())
    }

    /// Like [`Request::from_layers`], for options alone.
    ///
    /// # Errors
    ///
    /// Those of [`Request::from_layers`].
    pub fn from_given(options: &Options) -> Result<Self> {
        Ok(Self::from_layers(&[OptionLayer::Given(options.clone())])?.0)
    }
}

/// Whether an option of drawings is about paths in a file, of which pixels have none.
fn is_of_files(option: &str) -> bool {
    DrawingFormat::PIXELS.lacks(option).is_some() || OF_PAPER.contains(&option)
}

/// The options that are about paper.
pub(super) const OF_PAPER: [&str; 6] = ["page", "width-mm", "dpi", "margin", "scale", "units"];

/// The error about a paper size for pixels.
pub(super) fn pixels_on_paper(options: &Options) -> String {
    /// Dots an inch of a print.
    const DPI: f64 = 300.0;
    match DrawingSettings::from_options(options).ok().and_then(|drawing| drawing.page_size.pixels(DPI)) {
        Some(size) => {
            format!("a picture has pixels and no paper; for {DPI} dpi say --size {size}, or write a .svg or .pdf")
        }
        None => "a picture has pixels and no paper; say --size, or write a .svg or .pdf".to_owned(),
    }
}

/// The remark about options that no drawn style has.
pub fn ignored_remark<'a>(options: impl Iterator<Item = &'a str>, styles: &[&str]) -> Option<String> {
    let ignored: Vec<&str> = options.filter(|option| is_ignored(option, styles)).collect();
    let (first, rest) = ignored.split_first()?;
    let mut names = format!("--{first}");
    rest.iter().for_each(|option| names.push_str(&format!(", --{option}")));
    let (have, it) = if rest.is_empty() { ("has", "it") } else { ("have", "them") };
    let mut drawn = styles.to_vec();
    drawn.dedup();
    let plural = if drawn.len() > 1 { "s" } else { "" };
    let names_of_styles = || StyleName::ALL.into_iter().map(|(name, _)| name);
    let of_all = names_of_styles().find(|style| ignored.iter().all(|option| !is_ignored(option, &[style])));
    let has_it = match of_all {
        Some(style) => format!("style {style} has {it}"),
        // No style has all of these options; each option belongs to one style.
        None => {
            let of_one = |option: &&str| names_of_styles().find(|style| !is_ignored(option, &[style]));
            let pairs = ignored.iter().filter_map(|option| Some(format!("style {} has --{option}", of_one(option)?)));
            pairs.collect::<Vec<_>>().join(", ")
        }
    };
    Some(format!("{names} {have} no effect on style{plural} {}; {has_it}", drawn.join(" and ")))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::styles::Style;

    fn given(options: &[(&str, &str)]) -> OptionLayer {
        OptionLayer::Given(
            options.iter().map(|(name, value)| ((*name).to_owned(), OptionValue::text(*value))).collect(),
        )
    }

    fn file(text: &str) -> OptionLayer {
        OptionLayer::File(Preset::parse("a.toml", text).unwrap())
    }

    fn remark(options: &[&str], styles: &[&str]) -> Option<String> {
        ignored_remark(options.iter().copied(), styles)
    }

    #[test]
    fn options_of_other_styles_are_named_and_those_of_this_one_not_at_all() {
        let names = ["filter", "seed", "size", "tones"];
        let expected = "--filter, --tones have no effect on style charcoal; style three-pass has them";
        assert_eq!(remark(&names, &["charcoal"]).as_deref(), Some(expected));
        assert_eq!(remark(&names, &["three-pass"]).unwrap().split(' ').next(), Some("--seed"));
        let expected =
            "--filter, --seed have no effect on style phong; style three-pass has --filter, style charcoal has --seed";
        assert_eq!(remark(&["filter", "seed"], &["phong"]).as_deref(), Some(expected));
    }

    #[test]
    fn of_two_styles_one_is_enough() {
        let names = ["ink-threshold", "joints", "tones"];
        let expected = "--ink-threshold has no effect on styles three-pass and inking; style dietrich has it";
        assert_eq!(remark(&names, &["three-pass", "inking"]).as_deref(), Some(expected));
        assert!(remark(&["joints"], &["ink", "ink"]).unwrap().contains("on style ink; style inking has it"));
    }

    #[test]
    fn a_layer_beats_those_below_and_what_excludes_them() {
        let layers = [file("tones = 1\nview = \"top\"\nseed = 3\n"), given(&[("tones", "2"), ("eye", "1,2,3")])];
        let (request, remarks) = Request::from_layers(&layers).unwrap();
        assert_eq!(request.options.keys().collect::<Vec<_>>(), ["eye", "seed", "tones"]);
        let Style::ThreePass(cartoon) = &request.style else { panic!("three-pass") };
        assert_eq!((cartoon.tones.count, remarks), (2, Vec::new()));
        // A file may turn off an option of a lower layer.
        let (request, _) = Request::from_layers(&[file("parallel = true\n"), file("parallel = false\n")]).unwrap();
        assert!(!request.scene.camera.parallel && request.options.is_empty());
    }

    #[test]
    fn a_look_says_nothing_of_other_styles() {
        let (request, _) = Request::from_layers(&[OptionLayer::Look(LOOKS[0]), given(&[("style", "inking")])]).unwrap();
        assert!(
            !request.options.contains_key("tones") && request.options.contains_key("size"),
            "{:?}",
            request.options
        );
    }

    #[test]
    fn errors_name_the_file_and_line_of_the_option() {
        let refused = |layers: &[OptionLayer]| Request::from_layers(layers).unwrap_err().to_string();
        assert_eq!(
            refused(&[file("\ntones = \"many\"")]),
            "a.toml: line 2: tones many: give a whole number from 0 to 255"
        );
        // Even if a higher layer overrides it.
        assert!(refused(&[file("tones = \"many\""), given(&[("tones", "2")])]).starts_with("a.toml: line 1"));
        assert!(refused(&[file("tone = 2")]).contains("line 1: tone: there is no such option; did you mean tones?"));
        let instead = "--style lines --classes silhouette,boundary,crease,suggestive draws suggestive contours";
        for option in ["valley-depth", "valley-radius", "valley-share"] {
            let expected = format!("a.toml: line 1: {option}: this option is gone; {instead}");
            assert_eq!(refused(&[file(&format!("{option} = 0.1"))]), expected);
        }
        assert_eq!(
            refused(&[given(&[("style", "suggestive")])]),
            format!("style suggestive: this style is gone; {instead}")
        );
        assert!(refused(&[file("eye = [1, 2, 3]\nview = \"top\"")]).contains("exclude each other"));
        assert_eq!(
            refused(&[given(&[("hidden", "dashed"), ("style", "phong")])]),
            "hidden: exact lines have it; leave it out, add --exact-lines, or write a .svg or .pdf"
        );
        let late = Request::from_layers(&[file("tones = 4")]).unwrap().0;
        assert_eq!(late.attributed(Error::setting("tones", "no")).to_string(), "a.toml: line 1: tones: no");
    }

    #[test]
    fn the_first_look_is_drawn_where_nothing_is_said() {
        let style = |look, given: Options, draws_lines| {
            let layers = layers(look, Vec::new(), given, draws_lines);
            Request::from_layers(&layers).unwrap().0.style.name()
        };
        assert_eq!(style(None, Options::new(), false), "ink");
        assert_eq!(style(None, Options::new(), true), "lines");
        assert_eq!(style(Some(LOOKS[2]), Options::new(), false), "charcoal");
        assert_eq!(style(None, Options::from([("style".to_owned(), OptionValue::text("phong"))]), false), "phong");
    }
}
