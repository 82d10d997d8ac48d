//! Shared parts of all pages: their head, and the style sheet, light and dark.
//!
//! ```
//! use tinta::page::{Pictures, beginning};
//!
//! assert!(beginning("Looks", Pictures::Beside).contains("<title>Looks</title>"));
//! ```

use crate::markup::escaped;

/// The style sheet of every page.
const STYLE_SHEET: &str = include_str!("page.css");

/// Options that the page for browsers does not have: those for files that it cannot name, and those that the hand sets there.
pub const NOT_OF_BROWSERS: [&str; 6] = ["allow-external", "eye", "height", "size", "target", "up"];

/// Where a page's pictures are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Pictures {
    /// Inside the page, which forbids everything else.
    Within,
    /// In separate files.
    Beside,
}

/// A page up to and with the beginning of its body: XHTML that browsers read as HTML.
pub fn beginning(title: &str, pictures: Pictures) -> String {
    let policy = match pictures {
        Pictures::Within => {
            "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src data:; \
             style-src 'unsafe-inline'; script-src 'unsafe-inline'\"/>\n"
        }
        Pictures::Beside => "",
    };
    format!(
        "<!DOCTYPE html>\n<html xmlns=\"http://www.w3.org/1999/xhtml\" lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n{policy}\
         <meta name=\"color-scheme\" content=\"light dark\"/>\n<title>{}</title>\n<style>\n{STYLE_SHEET}</style>\n</head>\n\
         <body>\n",
        escaped(title)
    )
}

#[cfg(test)]
mod tests {
    use super::STYLE_SHEET;
    use std::collections::BTreeMap;

    /// The names and values of the colours in the first `:root` after `start`, over those of `below`.
    fn colors(start: &str, below: &BTreeMap<String, [f64; 3]>) -> BTreeMap<String, [f64; 3]> {
        let rest = &STYLE_SHEET[STYLE_SHEET.find(start).unwrap()..];
        let block = rest[rest.find(":root {").unwrap() + 7..].split('}').next().unwrap();
        let mut colors = below.clone();
        for (name, value) in block.split(';').filter_map(|declaration| declaration.split_once(": #")) {
            let channel = |index: usize| f64::from(u8::from_str_radix(&value[index..index + 2], 16).unwrap());
            colors.insert(name.trim().to_owned(), [channel(0), channel(2), channel(4)]);
        }
        colors
    }

    /// The ratio of WCAG 2.
    fn contrast(one: [f64; 3], other: [f64; 3]) -> f64 {
        let luminance = |color: [f64; 3]| {
            let linear = color.map(|channel| match channel / 255.0 {
                low if low <= 0.04045 => low / 12.92,
                high => ((high + 0.055) / 1.055).powf(2.4),
            });
            0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]
        };
        let (one, other) = (luminance(one) + 0.05, luminance(other) + 0.05);
        (one / other).max(other / one)
    }

    /// The colours of texts and of backgrounds of every rule, as written.
    fn rules() -> Vec<(Option<&'static str>, Option<&'static str>)> {
        let value = |declarations: &'static str, name: &str| {
            let mut all = declarations.split(';').filter_map(|declaration| declaration.split_once(':'));
            all.find(|(property, _)| property.trim() == name).map(|(_, value)| value.trim())
        };
        let blocks = STYLE_SHEET.split('{').skip(1).filter_map(|rest| rest.split_once('}')).map(|(block, _)| block);
        blocks.map(|block| (value(block, "color"), value(block, "background"))).collect()
    }

    #[test]
    fn black_on_white_is_twenty_one_to_one() {
        assert!((contrast([0.0; 3], [255.0; 3]) - 21.0).abs() < 1e-9);
        assert!((contrast([118.0; 3], [255.0; 3]) - 4.54).abs() < 0.005);
    }

    #[test]
    fn every_text_stands_out_from_every_background_in_light_and_dark() {
        let light = colors(":root", &BTreeMap::new());
        let dark = colors("@media (prefers-color-scheme: dark)", &light);
        assert!(light.keys().all(|name| light[name] != dark[name]), "every colour has a dark twin");
        let name = |value: &'static str| value.strip_prefix("var(").and_then(|rest| rest.strip_suffix(')'));
        let mut pairs = Vec::new();
        for (text, background) in rules() {
            let text = text.filter(|text| *text != "inherit");
            assert!(text.is_none_or(|text| name(text).is_some()), "a text's colour has a name: {text:?}");
            match (text.and_then(name), background.and_then(name)) {
                (Some(text), Some(background)) => pairs.push((text, background)),
                // An element without a background may stand on the page or on a band.
                (Some(text), None) => pairs.extend([(text, "--paper"), (text, "--band")]),
                (None, Some(background)) => pairs.extend([("--ink", background), ("--soft", background)]),
                (None, None) => {}
            }
        }
        assert!(pairs.len() > 20);
        for (mode, colors) in [("light", light), ("dark", dark)] {
            for (text, background) in &pairs {
                let ratio = contrast(colors[*text], colors[*background]);
                assert!(ratio >= 4.5, "{mode}: {text} on {background} is {ratio:.2} to 1");
            }
        }
    }
}
