//! Warns about options that have no effect on the drawn styles.

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
