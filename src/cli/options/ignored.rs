//! Warns about options that have no effect on the drawn styles.

use tinta::StyleName;
use tinta::styles::is_ignored;

/// What to say about options given as words on a command line that none of the drawn styles has.
pub(crate) fn remark(words: &[String], styles: &[&str]) -> Option<String> {
    let mut ignored: Vec<&str> = Vec::new();
    for word in words.iter().take_while(|word| *word != "--") {
        let Some(option) = word.strip_prefix("--").and_then(|option| option.split('=').next()) else { continue };
        if is_ignored(option, styles) && !ignored.contains(&option) {
            ignored.push(option);
        }
    }
    let (first, rest) = ignored.split_first()?;
    let mut names = format!("--{first}");
    rest.iter().for_each(|option| names.push_str(&format!(", --{option}")));
    let (have, it) = if rest.is_empty() { ("has", "it") } else { ("have", "them") };
    let mut drawn = styles.to_vec();
    drawn.dedup();
    let plural = if drawn.len() > 1 { "s" } else { "" };
    let names_of_styles = || StyleName::ALL.into_iter().map(|(name, _)| name).chain(["lines"]);
    let of_all = names_of_styles().find(|style| ignored.iter().all(|option| !is_ignored(option, &[style])));
    let has_it = match of_all {
        Some(style) => format!("style {style} has {it}"),
        // Of options that no style has all of, each has one of its own.
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

    fn said(line: &str, styles: &[&str]) -> Option<String> {
        remark(&line.split(' ').map(str::to_owned).collect::<Vec<_>>(), styles)
    }

    #[test]
    fn options_of_other_styles_are_named_once_and_those_of_this_one_not_at_all() {
        let line = "render a.obj -o a.png --style charcoal --tones 2 --seed=3 --filter=sobel --tones=1 --size 64";
        let expected = "--tones, --filter have no effect on style charcoal; style three-pass has them";
        assert_eq!(said(line, &["charcoal"]).as_deref(), Some(expected));
        assert_eq!(said(line, &["three-pass"]).unwrap().split(' ').next(), Some("--seed"));
        assert_eq!(said("render a.obj -o a.png --tones 2 -- --seed", &["three-pass"]), None);
        let expected =
            "--seed, --filter have no effect on style phong; style charcoal has --seed, style three-pass has --filter";
        assert_eq!(said("--seed 3 --filter sobel", &["phong"]).as_deref(), Some(expected));
    }

    #[test]
    fn of_two_styles_one_is_enough() {
        let line = "compare a.obj -o a.png --tones 2 --joints off --ink-threshold 0.3";
        let expected = "--ink-threshold has no effect on styles three-pass and inking; style dietrich has it";
        assert_eq!(said(line, &["three-pass", "inking"]).as_deref(), Some(expected));
        assert!(said("--joints off", &["ink", "ink"]).unwrap().contains("on style ink; style inking has it"));
    }
}
