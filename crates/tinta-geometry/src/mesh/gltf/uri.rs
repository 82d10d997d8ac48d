//! Where a glTF file says that its data lies: in the address itself, or in a file whose name it is.

use crate::files::shown;
use base64::Engine;
use base64::alphabet::STANDARD;
use base64::engine::{DecodePaddingMode, GeneralPurpose, GeneralPurposeConfig};

/// Base64, with padding or without.
const BASE64: GeneralPurpose = GeneralPurpose::new(
    &STANDARD,
    GeneralPurposeConfig::new()
        .with_decode_padding_mode(DecodePaddingMode::Indifferent)
        .with_decode_allow_trailing_bits(true),
);

/// What an address stands for.
#[derive(Debug, PartialEq, Eq)]
pub(super) enum Uri {
    /// The bytes themselves.
    Data(Vec<u8>),
    /// A file's name, with the folders before it.
    File(String),
}

/// Takes an address apart; network addresses are not read.
pub(super) fn parse(uri: &str) -> Result<Uri, String> {
    if let Some(data) = uri.strip_prefix("data:") {
        let (kind, data) = data.split_once(',').ok_or("an address in it begins with data: but holds no data")?;
        return match kind.ends_with(";base64") {
            true => BASE64.decode(data).map(Uri::Data).map_err(|_| "an address in it holds broken base64".to_owned()),
            false => Ok(Uri::Data(unescaped(data))),
        };
    }
    // One letter before a colon is a disk.
    let scheme = uri.split_once(':').map(|(scheme, _)| scheme).filter(|scheme| {
        scheme.len() > 1 && scheme.bytes().all(|byte| byte.is_ascii_alphanumeric() || b"+-.".contains(&byte))
    });
    match scheme {
        Some(_) => Err(format!(
            "it refers to {}, but only files are read; save that file beside the model and refer to it",
            shown(uri)
        )),
        None => Ok(Uri::File(String::from_utf8_lossy(&unescaped(uri)).into_owned())),
    }
}

/// A text with its `%20` put back; a percent sign without two digits stays.
fn unescaped(text: &str) -> Vec<u8> {
    let mut rest = text.as_bytes();
    let mut bytes = Vec::with_capacity(rest.len());
    while let [first, after @ ..] = rest {
        let digits = after.get(..2).filter(|digits| *first == b'%' && digits.iter().all(u8::is_ascii_hexdigit));
        let byte = digits.and_then(|digits| u8::from_str_radix(std::str::from_utf8(digits).ok()?, 16).ok());
        bytes.push(byte.unwrap_or(*first));
        rest = if byte.is_some() { &after[2..] } else { after };
    }
    bytes
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn addresses_are_data_or_files_and_nothing_else() {
        let file = |name: &str| Ok(Uri::File(name.to_owned()));
        assert_eq!(parse("data:application/octet-stream;base64,AQID"), Ok(Uri::Data(vec![1, 2, 3])));
        assert_eq!(parse("data:;base64,AQ"), Ok(Uri::Data(vec![1])));
        assert_eq!(parse("data:text/plain,a%20b%"), Ok(Uri::Data(b"a b%".to_vec())));
        assert_eq!(parse("a%20box%2ebin"), file("a box.bin"));
        assert_eq!(parse("100%.bin"), file("100%.bin"));
        assert_eq!(parse("C:\\art\\box.bin"), file("C:\\art\\box.bin"));
        for refused in ["https://example.org/box.bin", "file:///etc/passwd", "data:", "data:;base64,****"] {
            assert!(parse(refused).is_err(), "{refused}");
        }
    }
}
