//! Options that the drawn styles do not have: said, since they are harmless but hardly what was meant.

/// Options of styles with the styles they are for; `lines` is that of drawings.
const OF_STYLES: [(&[&str], &[&str]); 10] = [
    (&["no-borders"], &["three-pass", "two-pass", "mrt", "inking", "dietrich", "ink"]),
    (&["cull"], &["phong", "three-pass", "two-pass", "mrt", "inking", "dietrich", "ink", "charcoal", "sand"]),
    (&["tones", "tone-thresholds", "tone-levels", "tone-lookup"], &["three-pass", "two-pass", "mrt", "ink"]),
    (
        &["filter", "detection-factor", "background-quad", "map-encoding", "slope-threshold"],
        &["three-pass", "two-pass", "mrt"],
    ),
    (&["border-width", "supersample"], &["three-pass", "two-pass", "mrt", "ink"]),
    (&["map-target"], &["three-pass", "two-pass", "ink"]),
    (&["crease-angle"], &["inking", "ink", "lines"]),
    (&["silhouette", "classes", "class-colors", "line-width"], &["inking", "lines"]),
    (
        &[
            "smooth",
            "joints",
            "back-edges",
            "line-drawing",
            "ink-depth",
            "polygon-offset",
            "paint",
            "ramp",
            "ramp-row",
            "light",
            "texture",
        ],
        &["inking"],
    ),
    (
        &[
            "charcoal",
            "seed",
            "density",
            "cet-exponent",
            "contrast-exponent",
            "saturation",
            "smudge",
            "light-1",
            "light-2",
            "paper",
            "texture-size",
            "cet-filter",
            "cet-coordinate",
            "contrast-operator",
            "noise",
            "improve",
        ],
        &["charcoal", "sand"],
    ),
];

/// Of one style each.
const OF_ONE: [(&str, &str); 2] = [("ink-threshold", "dietrich"), ("quality", "ink")];

/// Whether this option changes nothing in any of the styles; options that are no style's are not meant.
pub fn is_ignored(option: &str, styles: &[&str]) -> bool {
    let are_others = |having: &[&str]| !styles.iter().any(|style| having.contains(style));
    OF_STYLES.iter().any(|(options, having)| options.contains(&option) && are_others(having))
        || OF_ONE.iter().any(|(one, having)| *one == option && are_others(&[having]))
}

/// What to say about options given as words on a command line that none of the drawn styles has.
pub fn remark(words: &[String], styles: &[&str]) -> Option<String> {
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
    let (have, it) = if rest.is_empty() { ("has", "it is") } else { ("have", "they are") };
    let mut drawn = styles.to_vec();
    drawn.dedup();
    let plural = if drawn.len() > 1 { "s" } else { "" };
    Some(format!("{names} {have} no effect on style{plural} {}; --help says which {it} for", drawn.join(" and ")))
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
        let expected = "--tones, --filter have no effect on style charcoal; --help says which they are for";
        assert_eq!(said(line, &["charcoal"]).as_deref(), Some(expected));
        assert_eq!(said(line, &["three-pass"]).unwrap().split(' ').next(), Some("--seed"));
        assert_eq!(said("render a.obj -o a.png --tones 2 -- --seed", &["three-pass"]), None);
    }

    #[test]
    fn of_two_styles_one_is_enough() {
        let line = "compare a.obj -o a.png --tones 2 --joints off --ink-threshold 0.3";
        let expected = "--ink-threshold has no effect on styles three-pass and inking; --help says which it is for";
        assert_eq!(said(line, &["three-pass", "inking"]).as_deref(), Some(expected));
        assert_eq!(said("--joints off", &["ink", "ink"]).unwrap().matches("ink").count(), 1);
    }
}
