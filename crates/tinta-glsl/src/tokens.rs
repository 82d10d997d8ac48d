//! The tokens of a shader's text: names, numbers, signs, and the white space and comments between them.

/// The kind of a token.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// A name or keyword.
    Word,
    /// A number, with its suffix.
    Number,
    /// One sign: a bracket, an operator's character, `#`.
    Sign,
    /// Space, line ends, comments.
    Between,
}

/// A piece of a shader's text.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Token<'a> {
    /// Its kind.
    pub kind: Kind,
    /// Its text, unchanged.
    pub text: &'a str,
    /// Whether its line begins with `#`.
    pub is_directive: bool,
}

/// Splits a text into pieces; together they are the whole text.
pub fn tokens(text: &str) -> Vec<Token<'_>> {
    let (mut tokens, mut rest) = (Vec::new(), text);
    let (mut is_directive, mut begins_line) = (false, true);
    while let Some(first) = rest.chars().next() {
        let (kind, length) = token(rest, first);
        let (text, after) = rest.split_at(length);
        rest = after;
        if text == "#" && begins_line {
            is_directive = true;
        }
        tokens.push(Token { kind, text, is_directive });
        match kind {
            Kind::Between if text == "\n" => (is_directive, begins_line) = (false, true),
            Kind::Between => {}
            Kind::Word | Kind::Number | Kind::Sign => begins_line = false,
        }
    }
    tokens
}

/// Returns the kind and the length of a text's first token.
fn token(text: &str, first: char) -> (Kind, usize) {
    let run = |is_part: fn(char) -> bool| text.find(|c| !is_part(c)).unwrap_or(text.len());
    let is_name = |c: char| c.is_ascii_alphanumeric() || c == '_';
    let begins_number = |c: char| c.is_ascii_digit();
    if text.starts_with("//") {
        (Kind::Between, text.find('\n').unwrap_or(text.len()))
    } else if text.starts_with("/*") {
        (Kind::Between, text.find("*/").map_or(text.len(), |end| end + 2))
    } else if first == '\n' {
        (Kind::Between, 1)
    } else if first.is_whitespace() {
        (Kind::Between, run(|c| c.is_whitespace() && c != '\n'))
    } else if begins_number(first) || (first == '.' && text[1..].starts_with(begins_number)) {
        (Kind::Number, number_length(text))
    } else if is_name(first) {
        (Kind::Word, run(|c| c.is_ascii_alphanumeric() || c == '_'))
    } else {
        (Kind::Sign, first.len_utf8())
    }
}

/// Returns the length of a number: digits, a point, an exponent with its sign, a suffix.
fn number_length(text: &str) -> usize {
    let bytes = text.as_bytes();
    let is_exponent = |place: usize| matches!(bytes[place], b'e' | b'E') && !text.starts_with("0x");
    let is_part = |place: usize| match bytes[place] {
        b'+' | b'-' => is_exponent(place - 1),
        byte => byte.is_ascii_alphanumeric() || byte == b'.',
    };
    (1..bytes.len()).find(|place| !is_part(*place)).unwrap_or(bytes.len())
}

/// Whether a number is whole: no point, no exponent, no suffix of a float.
pub fn is_whole(number: &str) -> bool {
    number.bytes().all(|byte| byte.is_ascii_digit())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_names_and_comments_are_told_apart() {
        let found: Vec<(Kind, &str)> = tokens("a1=.5f+1e-3-2; // x\n#define B 4")
            .into_iter()
            .filter(|token| token.text.trim() != "")
            .map(|token| (token.kind, token.text))
            .collect();
        let (word, number, sign) = (Kind::Word, Kind::Number, Kind::Sign);
        let expected = [
            (word, "a1"),
            (sign, "="),
            (number, ".5f"),
            (sign, "+"),
            (number, "1e-3"),
            (sign, "-"),
            (number, "2"),
            (sign, ";"),
            (Kind::Between, "// x"),
            (sign, "#"),
            (word, "define"),
            (word, "B"),
            (number, "4"),
        ];
        assert_eq!(found, expected);
        let in_directives: String =
            tokens("a\n #b c\nx").iter().filter(|token| token.is_directive).map(|token| token.text).collect();
        assert_eq!(in_directives, "#b c\n");
    }
}
