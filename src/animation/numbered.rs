//! Names with a number in them, in the notation of C's `printf`: `frame-%04d.png` is `frame-0001.png`, `frame-0002.png`, …

use crate::lines::DrawingFormat;
use crate::picture::PictureFormat;
use std::path::Path;

/// A name whose file name has an open number.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct NumberedName {
    before: String,
    digits: usize,
    after: String,
}

impl NumberedName {
    /// Finds the first `%d` or `%0Nd` (N from 1 to 9) in the file name of a picture or a drawing; `None` without one.
    ///
    /// Other per cent signs, and those in folder names, stay unchanged.
    pub fn parse(name: &str) -> Option<Self> {
        let file_name = Path::new(name).file_name()?.to_str()?;
        let is_drawing = DrawingFormat::of_name(name).is_some_and(|format| !format.is_of_lines_alone);
        if PictureFormat::of(Path::new(name)).is_none() && !is_drawing {
            return None;
        }
        let (folder, file_name) = name.split_at(name.rfind(file_name)?);
        let places = file_name.match_indices('%');
        places.into_iter().find_map(|(at, _)| {
            let rest = &file_name[at + 1..];
            let (digits, after) = match rest.as_bytes() {
                [b'd', ..] => (1, &rest[1..]),
                [b'0', digit @ b'1'..=b'9', b'd', ..] => (usize::from(digit - b'0'), &rest[3..]),
                _ => return None,
            };
            Some(Self { before: format!("{folder}{}", &file_name[..at]), digits, after: after.to_owned() })
        })
    }

    /// Returns the name with this number.
    pub fn with(&self, number: u32) -> String {
        format!("{}{number:0digits$}{}", self.before, self.after, digits = self.digits)
    }

    /// Returns the number in a name of this pattern.
    #[cfg(any(feature = "cli", test))]
    pub(crate) fn number_in(&self, name: &str) -> Option<u32> {
        let number = name.strip_prefix(&self.before)?.strip_suffix(&self.after)?.parse().ok()?;
        (self.with(number) == name).then_some(number)
    }

    /// Returns the text before the number, its least count of digits, and the text after it.
    pub fn parts(&self) -> (&str, usize, &str) {
        (&self.before, self.digits, &self.after)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_put_in_as_printf_does() {
        let name = |pattern: &str, number| NumberedName::parse(pattern).unwrap().with(number);
        assert_eq!(name("frame-%04d.png", 7), "frame-0007.png");
        assert_eq!(name("a/%d.tga", 120), "a/120.tga");
        assert_eq!(name("50%/x%02d_100%.png", 123), "50%/x123_100%.png");
        assert_eq!(name("10%_%03d.png", 4), "10%_004.png");
        assert_eq!([name("f-%04d.svg", 7), name("%d.PDF", 7)], ["f-0007.svg", "7.PDF"]);
    }

    #[test]
    fn numbers_are_found_in_their_names_and_in_no_others() {
        let number = |name: &str| NumberedName::parse("a/f%03d.png").unwrap().number_in(name);
        assert_eq!([number("a/f007.png"), number("a/f1234.png")], [Some(7), Some(1234)]);
        for name in ["a/f07.png", "a/f0007.png", "a/f+07.png", "a/f.png", "b/f007.png", "a/f007.tga"] {
            assert_eq!(number(name), None, "{name}");
        }
    }

    #[test]
    fn names_without_a_number_have_none() {
        for name in ["a.png", "100%.png", "%04d/a.png", "%4d.png", "%0d.png", "%s.png", "frame-%04d", "%d.gif", "%", ""]
        {
            assert_eq!(NumberedName::parse(name), None, "{name}");
        }
    }
}
