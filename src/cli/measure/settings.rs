//! Which settings are measured: each as the options that `tinta render` takes, so that a row can be drawn again.

use super::super::options::StyleArguments;
use clap::Parser;
use tinta::measure::Setting;
use tinta::plan::Submission;
use tinta::recipe::option_words;
use tinta::shell::quoted;
use tinta::styles::Origin;
use tinta::{Error, Result, Style, StyleName};

/// A setting's options by themselves.
#[derive(Parser)]
pub(crate) struct StyleOptions {
    #[arg(long, default_value = "three-pass")]
    style: StyleName,

    #[arg(long, default_value = "buffers")]
    submission: Submission,

    #[command(flatten)]
    styles: StyleArguments,
}

/// What is measured besides even when it has to be quick.
const QUICK: [&str; 10] = [
    "--style ink",
    "--style ink --quality best",
    "--style three-pass --map-encoding float --slope-threshold on",
    "--style three-pass --filter sobel",
    "--style three-pass --detection-factor 1",
    "--style inking --silhouette exact",
    "--style inking --silhouette exact --smooth off --line-width 1",
    "--style three-pass --cull back",
    "--style mrt",
    "--style mrt --cull back",
];

/// What is measured besides when there is time.
const FULL: [&str; 34] = [
    "--style inking --silhouette exact --polygon-offset 0,0",
    "--style inking --silhouette exact --classes boundary,non-manifold,silhouette,crease,material",
    "--style inking --light vertex-shader",
    "--style inking --submission immediate",
    "--style inking --submission display-list",
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

/// The settings of some styles, all of them for none named: first the styles of the texts by default, then what is listed above, and
/// styles of this project that are not.
pub(super) fn settings(styles: &[StyleName], is_quick: bool) -> Result<Vec<Setting>> {
    let of_defaults = |is_own: bool| {
        let styles = StyleName::lines_first().into_iter();
        let wanted = styles.filter(move |style| (style.info().origin == Origin::Own) == is_own);
        wanted.map(|style| format!("--style {}", style.name()))
    };
    let listed = |list: &'static [&'static str]| list.iter().map(|options| (*options).to_owned());
    let own = of_defaults(true).filter(|options| !QUICK.contains(&options.as_str()));
    let others = listed(&QUICK).chain(own).chain(listed(if is_quick { &[] } else { &FULL }));
    let faithful = of_defaults(false).map(|options| (options, true));
    faithful
        .chain(others.map(|options| (options, false)))
        .map(|(options, is_faithful)| setting(options, is_faithful))
        .filter(|setting| match setting {
            Ok((name, _)) => styles.is_empty() || styles.contains(name),
            Err(_) => true,
        })
        .map(|setting| setting.map(|(_, setting)| setting))
        .collect()
}

fn setting(options: String, is_faithful: bool) -> Result<(StyleName, Setting)> {
    let words = std::iter::once("tinta").chain(options.split_whitespace());
    let parsed =
        StyleOptions::try_parse_from(words).map_err(|error| Error::CommandLine { problem: error.to_string() })?;
    let style = parsed.styles.style(parsed.style)?;
    Ok((parsed.style, Setting { style, submission: parsed.submission, options, is_faithful }))
}

/// The setting that a preset's words make; none for no words.
pub(super) fn of_words(words: &[String]) -> Result<Option<Setting>> {
    if words.is_empty() {
        return Ok(None);
    }
    let given = std::iter::once("tinta".to_owned()).chain(words.iter().cloned());
    let parsed =
        StyleOptions::try_parse_from(given).map_err(|error| Error::CommandLine { problem: error.to_string() })?;
    let style = parsed.styles.style(parsed.style)?;
    let is_faithful = style == Style::named(parsed.style);
    // What is as by default is left out, as in the settings above.
    let mut changed = style.to_options()?;
    changed.remove("style");
    let words = changed.iter().flat_map(|(name, value)| option_words(name, value));
    let options = words.fold(format!("--style {}", parsed.style.name()), |text, word| text + " " + &quoted(&word));
    Ok(Some(Setting { style, submission: parsed.submission, options, is_faithful }))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_setting_is_one_that_render_takes_and_none_comes_twice() {
        let all = settings(&[], false).unwrap();
        for (name, style) in StyleName::ALL {
            assert!(all.iter().any(|setting| setting.style == Style::named(style)), "{name} is not measured");
        }
        for (index, setting) in all.iter().enumerate() {
            let is_same = |other: &Setting| other.style == setting.style && other.submission == setting.submission;
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
    fn styles_can_be_chosen() {
        let chosen = settings(&[StyleName::Dietrich], false).unwrap();
        assert!(!chosen.is_empty() && chosen.iter().all(|setting| setting.options.contains("dietrich")));
    }
}
