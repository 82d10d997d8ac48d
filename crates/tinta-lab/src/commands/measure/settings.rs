//! The measured settings, each as the options of `tinta render`, which can draw a row again.

use crate::measure::{Against, MeasuredStyle};
use std::sync::LazyLock;
use tinta::choice::meant_or;
use tinta::cli::options::Selection;
use tinta::pixel::LineTolerance;
use tinta::plan::Submission;
use tinta::recipe::option_words;
use tinta::request::{Request, ignored_remark};
use tinta::settings::{self, HasSettings, Kind, OptionValue, Options, Problem, Table};
use tinta::shell::quoted;
use tinta::styles::Origin;
use tinta::{Backend, Error, Result, Size, Style, StyleName};

/// How is measured.
#[derive(Debug, Clone)]
pub(in crate::commands) struct HowMeasured {
    pub against: Option<Against>,
    pub suite: Option<Suite>,
    pub sizes: Vec<Size>,
    pub styles: Vec<StyleName>,
    pub vary: Option<String>,
    pub frames: Option<u32>,
    pub quick: bool,
    pub tolerance: LineTolerance,
    pub resume: bool,
    pub machine: Option<String>,
    pub backend: Backend,
}

impl Default for HowMeasured {
    fn default() -> Self {
        Self {
            against: None,
            suite: None,
            sizes: vec![Size { width: 512, height: 512 }],
            styles: Vec::new(),
            vary: None,
            frames: None,
            quick: false,
            tolerance: LineTolerance::default(),
            resume: false,
            machine: None,
            backend: Backend::default(),
        }
    }
}

tinta_geometry::choices! {
    /// Built-in models that are measured together.
    pub(in crate::commands) enum Suite {
        Papers = "papers",
        Solids = "solids",
        Assemblies = "assemblies",
        All = "all",
    }
}

impl Suite {
    /// Their names.
    pub(super) fn models(self) -> &'static [&'static str] {
        const ALL: [&str; 7] = [
            "builtin:bust",
            "builtin:ant",
            "builtin:gear",
            "builtin:open-box",
            "builtin:car",
            "builtin:case",
            "builtin:plates",
        ];
        match self {
            Self::Papers => &ALL[..2],
            Self::Solids => &ALL[2..4],
            Self::Assemblies => &ALL[4..],
            Self::All => &ALL,
        }
    }
}

/// All of them.
pub(in crate::commands) struct OfHow;

impl Selection for OfHow {
    type Of = HowMeasured;
    const HAS_HEADINGS: bool = false;
}

impl HasSettings for HowMeasured {
    fn table() -> &'static Table<Self> {
        static TABLE: LazyLock<Table<HowMeasured>> =
            LazyLock::new(|| Table { settings: of_how(), defaults: vec![HowMeasured::default()] });
        &TABLE
    }
}

/// Values joined by commas; a word for an empty list.
fn listed<T: ToString>(values: &[T], none: &str) -> String {
    match values {
        [] => none.to_owned(),
        values => values.iter().map(ToString::to_string).collect::<Vec<_>>().join(","),
    }
}

fn values<T: std::str::FromStr<Err = tinta::ParseError>>(text: &str) -> std::result::Result<Vec<T>, Problem> {
    Ok(text.split(',').map(|value| value.trim().parse()).collect::<std::result::Result<_, _>>()?)
}

fn sizes() -> settings::Setting<HowMeasured> {
    settings::Setting::of(
        "size",
        "SIZES",
        Kind::Text { offered: &[], example: "64x64,128x128" },
        "Sizes in pixels, separated by commas",
        |how: &HowMeasured| listed(&how.sizes, ""),
        |how, text| {
            how.sizes = values(text)?;
            Ok(())
        },
    )
}

fn styles() -> settings::Setting<HowMeasured> {
    settings::Setting::of(
        "styles",
        "STYLES",
        Kind::Several(StyleName::of_passes().map(|(name, _)| name).collect()),
        "Styles, separated by commas",
        |how: &HowMeasured| listed(&how.styles, "all"),
        |how, text| {
            let names: Vec<&str> = StyleName::of_passes().map(|(name, _)| name).collect();
            let named = |name: &str| {
                let found = StyleName::of_passes().find(|(known, _)| *known == name.trim()).map(|(_, style)| style);
                found.ok_or_else(|| meant_or(name.trim(), &names, &format!("choose one of {}", names.join(", "))))
            };
            let named = || text.split(',').map(named).collect::<std::result::Result<_, String>>();
            how.styles = if text == "all" { Vec::new() } else { named()? };
            Ok(())
        },
    )
}

/// Help of the tolerance.
pub(in crate::commands) const TOLERANCE: &str =
    "Distance within which ink and line count as the same, as a share of the picture's height, up to 1/32";

fn of_how() -> Vec<settings::Setting<HowMeasured>> {
    type Of = settings::Setting<HowMeasured>;
    let vary = Of::open_field(
        "vary",
        "OPTION=VALUES",
        "",
        "Measure only each style's default with these values of an option, separated by commas, as a curve",
        |how| &mut how.vary,
    );
    let frames = Of::open_field("frames", "N", "auto", "Frames to time for each setting", |how| &mut how.frames);
    let machine = Of::open_field("machine", "NAME", "", "Name of this machine in the report", |how| &mut how.machine)
        .like("desk");
    let against = "What lines are compared with: the exact lines of the models (lines), or the true contour of smooth surfaces (smooth), \
                   whose models are built-in ones, by default all of them with about 1,000, 10,000 and 100,000 triangles";
    let suite = "Set of built-in models: papers (bust, ant), solids (gear, open box), assemblies (car, case, plates: parts that touch, fill and overlap one another), all";
    let backend = "OpenGL from: egl, surfaceless, osmesa, wgl, cgl, auto (the first that works)";
    vec![
        Of::open_field("against", "WHAT", "", against, |how| &mut how.against).said("lines").common(),
        Of::open_field("suite", "SUITE", "", suite, |how| &mut how.suite).said("none").common(),
        sizes().common(),
        styles().common(),
        vary.like("detection-factor=0.5,1,2").said("nothing").common(),
        frames.whole(1..=100_000).range(1.0, 101.0, 0).said("21, with --quick 7").common(),
        Of::flag("quick", "Measure fewer settings and frames", |how| how.quick, |how, is_on| how.quick = is_on)
            .common(),
        Of::field("tolerance", "SHARE", TOLERANCE, |how| &mut how.tolerance),
        Of::flag(
            "resume",
            "Continue an interrupted run in the same folder",
            |how| how.resume,
            |how, is_on| how.resume = is_on,
        )
        .common(),
        machine.said("system, processor, threads"),
        Of::field("backend", "BACKEND", backend, |how| &mut how.backend),
    ]
}

/// The additional settings of a quick measurement.
const QUICK: [&str; 10] = [
    // The creases of the reference, which are the texts' own.
    "--style ink --crease-angle 66.42182",
    "--style ink --crease-angle 66.42182 --quality best",
    "--style three-pass --map-encoding float --slope-threshold on",
    "--style three-pass --filter sobel",
    "--style three-pass --detection-factor 1",
    "--style inking --silhouette exact",
    "--style inking --silhouette exact --smooth off --line-width 1",
    "--style three-pass --cull back",
    "--style mrt",
    "--style mrt --cull back",
];

/// The additional settings of a full measurement.
const FULL: [&str; 33] = [
    "--style inking --silhouette exact --polygon-offset 0,0",
    "--style inking --silhouette exact --classes boundary,non-manifold,silhouette,crease,material",
    "--style inking --light vertex-shader",
    "--style inking --submission immediate",
    "--style charcoal --improve all",
    "--style three-pass --map-encoding biased",
    "--style three-pass --map-encoding float16",
    "--style three-pass --map-encoding float",
    "--style three-pass --map-encoding depth-texture",
    "--style three-pass --map-target texture",
    "--style three-pass --slope-threshold on",
    "--style three-pass --map-encoding biased --filter sobel",
    "--style three-pass --border-width 1",
    "--style three-pass --supersample 2 --border-width 2",
    "--style three-pass --supersample 4 --border-width 2",
    "--style two-pass --map-encoding float --slope-threshold on",
    "--style three-pass --filter laplacian8",
    "--style three-pass --filter mitchell",
    "--style three-pass --filter mitchell-two",
    "--style three-pass --filter roberts",
    "--style three-pass --filter gaussian",
    "--style three-pass --filter sobel --detection-factor 0.5",
    "--style three-pass --tones 1",
    "--style three-pass --tones 2",
    "--style three-pass --tone-lookup texture",
    "--style three-pass --background-quad off",
    "--style two-pass --filter sobel",
    "--style two-pass --background-quad off",
    "--style two-pass --cull back",
    "--style inking --silhouette exact --line-drawing quads",
    "--style inking --silhouette exact --smooth off",
    "--style inking --silhouette exact --ink-depth test",
    "--style dietrich --ink-threshold 0.15",
];

/// The settings of some styles, or of all if none is named: first the texts' styles by default, then the list above, and this
/// project's styles that it lacks.
pub(super) fn settings(styles: &[StyleName], is_quick: bool) -> Result<Vec<MeasuredStyle>> {
    let of_defaults = |is_own: bool| {
        let styles = StyleName::lines_first().into_iter().filter(|style| !style.draws_lines());
        let wanted = styles.filter(move |style| (style.info().origin == Origin::Own) == is_own);
        wanted.map(|style| format!("--style {}", style.name()))
    };
    let listed = |list: &'static [&'static str]| list.iter().map(|options| (*options).to_owned());
    let own = of_defaults(true).filter(|options| !QUICK.contains(&options.as_str()));
    let others = listed(&QUICK).chain(own).chain(listed(if is_quick { &[] } else { &FULL }));
    let faithful = of_defaults(false).map(|options| (options, true));
    faithful
        .chain(others.map(|options| (options, false)))
        .map(|(options, is_faithful)| setting(&options, is_faithful))
        .filter(|setting| match setting {
            Ok((name, _)) => styles.is_empty() || styles.contains(name),
            Err(_) => true,
        })
        .map(|setting| setting.map(|(_, setting)| setting))
        .collect()
}

/// The settings of `OPTION=VALUE,VALUE`: each style's default with each value, of those styles that have the option.
pub(super) fn varied(styles: &[StyleName], vary: &str) -> Result<Vec<MeasuredStyle>> {
    let Some((option, values)) =
        vary.split_once('=').filter(|(option, values)| !option.is_empty() && !values.is_empty())
    else {
        return Err(Error::value(
            "vary",
            vary,
            "it is an option of a style, = and values, as detection-factor=0.5,1,2",
        ));
    };
    let lines_first = StyleName::lines_first().into_iter().filter(|style| !style.draws_lines());
    let asked = lines_first.filter(|style| styles.is_empty() || styles.contains(style));
    let (ignoring, having): (Vec<StyleName>, Vec<StyleName>) =
        asked.partition(|style| ignored_remark([option].into_iter(), &[style.name()]).is_some());
    if having.is_empty() {
        let names: Vec<&str> = ignoring.iter().map(|style| style.name()).collect();
        let why = ignored_remark([option].into_iter(), &names).unwrap_or_else(|| "no style to measure".to_owned());
        return Err(Error::value("vary", vary, why));
    }
    let each = having.iter().flat_map(|style| values.split(',').map(move |value| (style, value)));
    let words = each.map(|(style, value)| format!("--style {} --{option} {}", style.name(), value.trim()));
    words.map(|text| Ok(setting(&text, false)?.1)).collect()
}

fn setting(text: &str, is_faithful: bool) -> Result<(StyleName, MeasuredStyle)> {
    let words: Vec<&str> = text.split_whitespace().collect();
    let mut options: Options = words
        .chunks(2)
        .filter_map(|pair| Some((pair.first()?.strip_prefix("--")?.to_owned(), OptionValue::text(*pair.get(1)?))))
        .collect();
    let given = options.iter().filter(|(name, _)| *name != "style").flat_map(|(name, value)| option_words(name, value));
    let style = options.get("style").into_iter().flat_map(|style| option_words("style", style));
    let text = style.chain(given).collect::<Vec<_>>().join(" ");
    // The submission of vertices is not part of a drawing.
    let submission = match options.remove("submission") {
        Some(OptionValue::Text(how)) => {
            how.parse().map_err(|problem: tinta::ParseError| Error::value("submission", how, problem))?
        }
        _ => Submission::default(),
    };
    let style = Request::from_given(&options)?.style;
    Ok((style.style_name(), MeasuredStyle { style, submission, options: text, is_faithful }))
}

/// Inking with the contours of smooth surfaces.
pub(super) fn smooth_inking() -> Result<MeasuredStyle> {
    let options = [("style", "inking"), ("silhouette", "smooth")];
    let options = options.map(|(name, value)| (name.to_owned(), OptionValue::text(value))).into();
    setting_of(&Request::from_given(&options)?)
}

/// The setting that a request's style is.
pub(super) fn setting_of(request: &Request) -> Result<MeasuredStyle> {
    let style = request.style.clone();
    let is_faithful = style == Style::named(style.style_name());
    // Default values are left out, as in the settings above.
    let mut changed = style.to_options()?;
    changed.remove("style");
    let words = changed.iter().flat_map(|(name, value)| option_words(name, value));
    let options = words.fold(format!("--style {}", style.name()), |text, word| text + " " + &quoted(&word));
    Ok(MeasuredStyle { style, submission: Submission::default(), options, is_faithful })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_setting_is_one_that_render_takes_and_none_comes_twice() {
        let all = settings(&[], false).unwrap();
        for (name, style) in StyleName::of_passes() {
            assert!(all.iter().any(|setting| setting.style == Style::named(style)), "{name} is not measured");
        }
        for (index, setting) in all.iter().enumerate() {
            let is_same =
                |other: &MeasuredStyle| other.style == setting.style && other.submission == setting.submission;
            assert!(!all[..index].iter().any(is_same), "{}", setting.options);
            assert!(all[..index].iter().all(|other| other.options != setting.options), "{}", setting.options);
        }
    }

    #[test]
    fn the_faithful_ones_are_the_librarys_defaults() {
        for setting in settings(&[], true).unwrap().iter().filter(|setting| setting.is_faithful) {
            let name = setting.options.trim_start_matches("--style ").parse().unwrap();
            assert_eq!(setting.style, Style::named(name));
        }
    }

    #[test]
    fn an_option_is_varied_in_the_styles_that_have_it() {
        let all = varied(&[], "detection-factor=0.5,1,2").unwrap();
        for style in ["three-pass", "two-pass", "mrt"] {
            let of_style = all.iter().filter(|setting| setting.options.contains(&format!("--style {style} ")));
            assert_eq!(of_style.count(), 3, "{style}");
        }
        assert!(all.iter().all(|setting| !setting.options.contains("phong")));
        for wrong in ["detection-factor", "=1", "detection-factor=", "nothing=1", "detection-factor=1,much"] {
            assert!(varied(&[StyleName::ThreePass], wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn styles_can_be_chosen() {
        let chosen = settings(&[StyleName::Dietrich], false).unwrap();
        assert!(!chosen.is_empty() && chosen.iter().all(|setting| setting.options.contains("dietrich")));
    }
}
