//! The error for a text that is not well-formed XML: what is wrong, where, and what to do.
//!
//! The parser names no position for a text that ends too early, as after a download that was cut
//! off. The error then marks the last character.

use super::precheck::markup_length;
use crate::diagnostic::{Diagnostic, SceneError};
use roxmltree::{Error, TextPos};

/// The advice if the end of a file is missing.
const COMPLETE: &str =
    "export the scene again, or repeat the download: the end of the file is missing";

/// The error for `text`, which the parser refused with `error`.
pub(super) fn error(name: &str, text: &str, error: &Error) -> SceneError {
    let written = text.trim();
    if written.is_empty() {
        let what = if text.is_empty() {
            "is empty"
        } else {
            "has only white space"
        };
        return Diagnostic::about_file(name, format!("the file {what}: it is not a COLLADA scene"))
            .help("export the scene again, or repeat the download")
            .into();
    }
    if !written.starts_with('<') {
        let start = text.len() - text.trim_start().len();
        return Diagnostic::about_file(name, "the file is not XML: it does not begin with `<`")
            .at(text, start..start + 1, "expected <?xml or <COLLADA")
            .help("pass a scene: .dae, .glb, .gltf, .obj or .ply")
            .into();
    }
    let at = byte_of(text, error.pos());
    let last = text.trim_end().char_indices().last().map_or(0, |(i, _)| i);
    let (why, at, label, help) = match (error, end_that_is_missing(text, error, at)) {
        (Error::DtdDetected, _) => (
            "it declares entities".to_owned(),
            text.find("<!ENTITY").unwrap_or(at),
            "the parser stops here",
            "remove the <!ENTITY ...> of the <!DOCTYPE>: COLLADA needs none",
        ),
        (_, Some(end)) => (
            format!("it ends {end}"),
            last,
            "the file ends here",
            COMPLETE,
        ),
        (error, None) => (
            error.to_string(),
            at,
            "the parser stops here",
            "correct the XML here, or export the file again",
        ),
    };
    Diagnostic::about_file(name, format!("the file is not well-formed XML: {why}"))
        .at(text, at..at + 1, label)
        .help(help)
        .into()
}

/// Where the text ends, if it is wrong only because it ends there. `at` is the byte of the error.
fn end_that_is_missing(text: &str, error: &Error, at: usize) -> Option<&'static str> {
    match error {
        Error::NoRootNode => return Some("before its first element"),
        Error::UnclosedRootNode => return Some("before all elements are closed"),
        _ => {}
    }
    let is_at_end = matches!(error, Error::UnexpectedEndOfStream) || at >= text.trim_end().len();
    let tag = text.rfind('<').unwrap_or(0);
    let is_open = markup_length(&text[tag..]) == text.len() - tag && !text.ends_with('>');
    (is_at_end || (is_open && at >= tag)).then_some("inside a tag or a comment")
}

/// The byte at a position of the parser: line and column count from 1, columns in characters.
fn byte_of(text: &str, pos: TextPos) -> usize {
    let lines = text.split_inclusive('\n');
    let before = lines.take(pos.row.saturating_sub(1) as usize);
    let line_start = before.map(str::len).sum::<usize>();
    let column = text[line_start..]
        .chars()
        .take(pos.col.saturating_sub(1) as usize);
    line_start + column.map(char::len_utf8).sum::<usize>()
}
