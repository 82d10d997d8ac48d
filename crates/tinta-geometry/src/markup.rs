//! Escapes texts for XML and HTML.

/// Whether neither can hold the character: most control characters.
pub fn is_unprintable(letter: char) -> bool {
    (letter.is_control() && !matches!(letter, '\t' | '\n' | '\r')) || matches!(letter, '\u{fffe}' | '\u{ffff}')
}

/// Escapes a text for an element or an attribute; forbidden characters become U+FFFD.
pub fn escaped(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for letter in text.chars() {
        match letter {
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '&' => escaped.push_str("&amp;"),
            '"' => escaped.push_str("&quot;"),
            '\'' => escaped.push_str("&#39;"),
            // Unescaped, readers would take them for blanks or other line ends.
            '\t' | '\n' | '\r' => escaped.push_str(&format!("&#{};", letter as u32)),
            _ if is_unprintable(letter) => escaped.push(char::REPLACEMENT_CHARACTER),
            _ => escaped.push(letter),
        }
    }
    escaped
}

/// The text before a recipe in an SVG's metadata.
pub const RECIPE_BEGIN: &str = "<tinta:recipe xmlns:tinta=\"urn:tinta:recipe\">";

/// The text after it.
pub const RECIPE_END: &str = "</tinta:recipe>";

/// A recipe, JSON, as an element of an SVG's metadata, with a line end; nothing for no recipe.
pub fn recipe_element(json: &str) -> String {
    if json.is_empty() { String::new() } else { format!("{RECIPE_BEGIN}{}{RECIPE_END}\n", escaped(json)) }
}

#[cfg(test)]
mod tests {
    use super::escaped;

    #[test]
    fn no_text_breaks_a_page() {
        assert_eq!(escaped("a<b>&\"c\" 'd'"), "a&lt;b&gt;&amp;&quot;c&quot; &#39;d&#39;");
        assert_eq!(escaped("é→🖋 \u{1}\u{0}\t]]>"), "é→🖋 \u{fffd}\u{fffd}&#9;]]&gt;");
        assert_eq!(escaped("1\n2\u{7}3\u{ffff}"), "1&#10;2\u{fffd}3\u{fffd}");
    }
}
