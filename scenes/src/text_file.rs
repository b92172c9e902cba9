//! Reads text files: UTF-8, UTF-16, and the 8-bit encodings of old exporters.

use crate::diagnostic::{Diagnostic, SceneError};
use crate::limited_file;
use std::path::Path;

/// The text of a file, without a byte order mark.
#[derive(Debug)]
pub(crate) struct DecodedText {
    pub(crate) text: String,
    /// If some bytes have no meaning in the encoding: where the first one was replaced.
    pub(crate) warning: Option<Diagnostic>,
}

/// Reads a text file. Its errors include advice.
pub(crate) fn read(path: &Path, name: &str) -> Result<DecodedText, SceneError> {
    decode(name, limited_file::read_scene(path, name)?)
}

/// The text of `bytes`.
///
/// A byte order mark, or a zero byte beside the first `<`, means UTF-16. Text that is not valid
/// UTF-8 is ISO 8859-1 if its XML declaration names an 8-bit encoding. These encodings differ in
/// names and comments only: all else in a file is ASCII. Otherwise each invalid byte is replaced by
/// U+FFFD, with a warning.
fn decode(name: &str, bytes: Vec<u8>) -> Result<DecodedText, SceneError> {
    let archive = match bytes.as_slice() {
        [b'P', b'K', 3, 4, ..] => Some("a ZIP archive, such as .zae or .kmz"),
        [0x1f, 0x8b, ..] => Some("compressed with gzip"),
        _ => None,
    };
    if let Some(archive) = archive {
        let title = format!("the file is {archive}");
        let help = "unpack it, and pass the .dae file that it contains";
        return Err(Diagnostic::about_file(name, title).help(help).into());
    }
    let ((text, is_valid), encoding) = match bytes.as_slice() {
        [0xff, 0xfe, rest @ ..] => (utf16(rest, u16::from_le_bytes), "UTF-16"),
        [0xfe, 0xff, rest @ ..] => (utf16(rest, u16::from_be_bytes), "UTF-16"),
        [b'<', 0, ..] => (utf16(&bytes, u16::from_le_bytes), "UTF-16"),
        [0, b'<', ..] => (utf16(&bytes, u16::from_be_bytes), "UTF-16"),
        _ => (utf8(bytes), "UTF-8"),
    };
    let warning = (!is_valid).then(|| {
        let first = text.find(char::REPLACEMENT_CHARACTER).unwrap_or(0);
        let mark = first..first + char::REPLACEMENT_CHARACTER.len_utf8();
        Diagnostic::about_file(name, format!("the file is not valid {encoding}"))
            .at(&text, mark, "invalid bytes are replaced from here on")
            .help("save it as UTF-8")
    });
    Ok(DecodedText { text, warning })
}

/// The text, and whether it is valid. U+FFFD is in place of invalid bytes.
fn utf8(bytes: Vec<u8>) -> (String, bool) {
    match String::from_utf8(bytes) {
        Ok(text) => match text.strip_prefix('\u{feff}') {
            Some(rest) => (rest.to_owned(), true),
            None => (text, true),
        },
        Err(invalid) if is_8_bit(invalid.as_bytes()) => {
            let latin_1 = invalid.as_bytes().iter().copied().map(char::from);
            (latin_1.collect(), true)
        }
        Err(invalid) => {
            let text = String::from_utf8_lossy(invalid.as_bytes());
            (text.into_owned(), false)
        }
    }
}

/// Whether the XML declaration names an encoding of one byte per character.
fn is_8_bit(bytes: &[u8]) -> bool {
    let end = bytes.windows(2).take(200).position(|pair| pair == b"?>");
    let declaration = String::from_utf8_lossy(&bytes[..end.unwrap_or(0)]).to_ascii_lowercase();
    ["iso-8859", "latin", "windows-125", "cp125", "ascii"]
        .iter()
        .any(|name| declaration.contains(name))
}

/// The text, and whether it is valid. U+FFFD is in place of unpaired surrogates and of a last byte
/// without partner.
fn utf16(bytes: &[u8], unit: impl Fn([u8; 2]) -> u16) -> (String, bool) {
    let (pairs, rest) = bytes.as_chunks::<2>();
    let mut is_valid = rest.is_empty();
    let mut text = String::with_capacity(bytes.len());
    for decoded in char::decode_utf16(pairs.iter().map(|pair| unit(*pair))) {
        is_valid &= decoded.is_ok();
        text.push(decoded.unwrap_or(char::REPLACEMENT_CHARACTER));
    }
    if !rest.is_empty() {
        text.push(char::REPLACEMENT_CHARACTER);
    }
    (text, is_valid)
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "<a name='é𝄞'/>";

    fn decoded(bytes: &[u8]) -> DecodedText {
        decode("a.dae", bytes.to_vec()).unwrap_or_else(|e| panic!("{e}"))
    }

    fn utf16_bytes(text: &str, bytes: impl Fn(u16) -> [u8; 2]) -> Vec<u8> {
        text.encode_utf16().flat_map(bytes).collect()
    }

    #[test]
    fn every_unicode_encoding_gives_the_same_text() {
        let marked = format!("\u{feff}{TEXT}");
        for bytes in [
            TEXT.as_bytes().to_vec(),
            marked.as_bytes().to_vec(),
            utf16_bytes(TEXT, u16::to_le_bytes),
            utf16_bytes(TEXT, u16::to_be_bytes),
            utf16_bytes(&marked, u16::to_le_bytes),
            utf16_bytes(&marked, u16::to_be_bytes),
        ] {
            let decoded = decoded(&bytes);
            assert_eq!((decoded.text.as_str(), decoded.warning), (TEXT, None));
        }
    }

    #[test]
    fn declared_8_bit_encodings_are_latin_1() {
        let bytes = b"<?xml version='1.0' encoding='ISO-8859-1'?><a name='\xe9'/>";
        let decoded = decoded(bytes);
        assert!(decoded.text.ends_with("<a name='é'/>"), "{}", decoded.text);
        assert_eq!(decoded.warning, None);
    }

    #[test]
    fn invalid_bytes_are_replaced_with_a_warning() {
        let odd = [utf16_bytes("<a/>\n", u16::to_le_bytes), vec![b'<']].concat();
        let surrogate = [b"\xff\xfe".as_slice(), b"<\0a\0/\0>\0\n\0", b"\0\xd8"].concat();
        for bytes in [b"<a/>\n\xe9".as_slice(), &odd, &surrogate] {
            let decoded = decoded(bytes);
            assert_eq!(decoded.text, "<a/>\n\u{fffd}");
            let warning = decoded.warning.expect("a warning");
            assert_eq!(warning.line_and_column(), Some((2, 1)));
        }
    }

    #[test]
    fn archives_are_an_error_with_advice() {
        for bytes in [b"PK\x03\x04".as_slice(), b"\x1f\x8b\x08"] {
            let error = decode("a.dae", bytes.to_vec()).unwrap_err();
            assert!(error.0.what_to_do().unwrap().contains("unpack"), "{error}");
        }
    }
}
