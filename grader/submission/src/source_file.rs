//! Reads one source file of a submission, whatever editor wrote it.

use crate::not_graded::NotGraded;
use grader::course::sources;
use std::borrow::Cow;
use std::path::Path;

/// The maximum size of a source file in bytes.
pub(crate) const MAX_FILE_SIZE: u64 = 1 << 20;

/// The text of a source file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct SourceFile {
    /// The text as it is compiled: lines end with LF, and there is no byte order mark.
    pub(crate) text: Vec<u8>,
    /// What was unusual about it.
    pub(crate) note: Option<&'static str>,
}

/// The byte order mark of UTF-8.
const BYTE_ORDER_MARK: &[u8] = b"\xef\xbb\xbf";

/// Reads the file `path` after checking it. It must be inside the folder `top`, which has no links
/// in its path.
pub(crate) fn read(top: &Path, path: &Path) -> Result<SourceFile, NotGraded> {
    let error = |why: String| NotGraded::Refused(format!("{} {why}", path.display()));
    let failed = |e| NotGraded::at("read", path, &e);
    let real = path.canonicalize().map_err(failed)?;
    if !real.starts_with(top) {
        return Err(error(
            "is a link to a file outside the submission: replace it by the file itself".into(),
        ));
    }
    let metadata = real.metadata().map_err(failed)?;
    if !metadata.is_file() {
        return Err(error(
            "is not a regular file: replace it by a text file".into(),
        ));
    }
    if metadata.len() > MAX_FILE_SIZE {
        return Err(error(format!(
            "has {} bytes: expected at most {MAX_FILE_SIZE}",
            metadata.len()
        )));
    }
    if path.to_str().is_none() {
        return Err(error("has a name that is not UTF-8: rename it".into()));
    }
    Ok(decode(&std::fs::read(&real).map_err(failed)?))
}

/// Text without what some editors add. Bytes that are no text stay: the compiler refuses them, and
/// only the stage that they are in does not compile.
fn decode(bytes: &[u8]) -> SourceFile {
    let (None, Ok(text)) = (sources::why_no_text(bytes), std::str::from_utf8(bytes)) else {
        return SourceFile {
            text: bytes.to_vec(),
            note: sources::why_no_text(bytes),
        };
    };
    let has_mark = bytes.starts_with(BYTE_ORDER_MARK);
    let text = if has_mark {
        &text[BYTE_ORDER_MARK.len()..]
    } else {
        text
    };
    let text = with_line_feeds(text);
    SourceFile {
        note: match (has_mark, &text) {
            (true, Cow::Borrowed(_)) => Some("byte order mark, left out"),
            (true, Cow::Owned(_)) => Some("Windows line ends (CRLF) and byte order mark, left out"),
            (false, Cow::Owned(_)) => Some("Windows line ends (CRLF), read as LF"),
            (false, Cow::Borrowed(_)) => None,
        },
        text: text.into_owned().into_bytes(),
    }
}

/// Text whose lines end with LF. The compiler reads CRLF in the same way, even in literals.
fn with_line_feeds(text: &str) -> Cow<'_, str> {
    match text.contains("\r\n") {
        true => Cow::Owned(text.replace("\r\n", "\n")),
        false => Cow::Borrowed(text),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_editors_add_is_removed_and_said() {
        let of = |bytes: &[u8]| {
            let file = decode(bytes);
            (
                String::from_utf8_lossy(&file.text).into_owned(),
                file.note.unwrap_or_default(),
            )
        };
        assert_eq!(of("fn é() {}\n".as_bytes()), ("fn é() {}\n".into(), ""));
        let (text, note) = of(b"\xef\xbb\xbfmod a;\n");
        assert_eq!(text, "mod a;\n");
        assert!(note.contains("byte order mark"), "{note}");
        let (text, note) = of(b"mod a;\r\nmod b;\r\n");
        assert_eq!(text, "mod a;\nmod b;\n");
        assert!(note.contains("CRLF"), "{note}");
        let (text, note) = of(b"\xef\xbb\xbfmod a;\r\n");
        assert_eq!(text, "mod a;\n");
        assert!(note.contains("(CRLF) and byte order mark"), "{note}");
    }

    #[test]
    fn bytes_that_are_no_text_are_left_to_the_compiler() {
        for (bytes, why) in [
            (b"\xff\xfem\0o\0d\0".as_slice(), "UTF-16"),
            (b"// caf\xe9\n".as_slice(), "no UTF-8"),
        ] {
            let file = decode(bytes);
            assert_eq!(file.text, bytes);
            assert!(file.note.is_some_and(|note| note.contains(why)));
        }
    }
}
