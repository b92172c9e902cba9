//! Checks the text before it is parsed, for files that would keep the XML parser busy for minutes.
//!
//! roxmltree compares every attribute of a tag with all others, and copies namespaces from each
//! element to its children. The time for both grows with the square of their number, or faster.

use super::limits::{MAX_ATTRIBUTES, MAX_NAMESPACES};
use crate::diagnostic::{Diagnostic, SceneError};
use std::ops::Range;

/// An error if a tag has too many attributes or the file too many namespaces. Does not check
/// whether the text is well-formed.
pub(super) fn check(name: &str, text: &str) -> Result<(), SceneError> {
    let mut rest = text;
    let mut namespaces = 0;
    while let Some(start) = rest.find('<') {
        rest = &rest[start..];
        let at = text.len() - rest.len();
        let tag = &rest[..markup_length(rest)];
        rest = &rest[tag.len()..];
        if tag.starts_with("<!") || tag.starts_with("<?") {
            continue;
        }
        if attributes(tag) > MAX_ATTRIBUTES {
            let title = format!("a tag has more than {MAX_ATTRIBUTES} attributes");
            return Err(too_many(name, text, at..at + 1, title));
        }
        namespaces += tag.matches("xmlns").count();
        if namespaces > MAX_NAMESPACES {
            let title = format!("the file declares more than {MAX_NAMESPACES} namespaces");
            return Err(too_many(name, text, at..at + 1, title));
        }
    }
    Ok(())
}

fn too_many(name: &str, text: &str, mark: Range<usize>, title: String) -> SceneError {
    Diagnostic::about_file(name, title)
        .at(text, mark, "this tag exceeds the limit")
        .help("no modelling program writes such a file: export the scene again")
        .into()
}

/// Length of the comment, CDATA section, processing instruction or tag at the start of `markup`;
/// all of `markup` if it has no end.
pub(super) fn markup_length(markup: &str) -> usize {
    let until = |end: &str| markup.find(end).map_or(markup.len(), |at| at + end.len());
    if markup.starts_with("<!--") {
        until("-->")
    } else if markup.starts_with("<![CDATA[") {
        until("]]>")
    } else if markup.starts_with("<?") {
        until("?>")
    } else {
        // The value of an attribute may contain a `>`. The declarations inside a DOCTYPE are
        // checked one by one.
        let opens_list = markup.starts_with("<!DOCTYPE");
        let mut quote = None;
        let end = markup.char_indices().find(|(_, c)| match (quote, c) {
            (None, '"' | '\'') => {
                quote = Some(*c);
                false
            }
            (None, '>') => true,
            (None, '[') => opens_list,
            (Some(open), c) if open == *c => {
                quote = None;
                false
            }
            _ => false,
        });
        end.map_or(markup.len(), |(at, _)| at + 1)
    }
}

/// Number of attributes of a tag: equals signs outside of quotes.
fn attributes(tag: &str) -> usize {
    let mut quote = None;
    let mut count = 0;
    for c in tag.chars() {
        match quote {
            Some(open) if open == c => quote = None,
            Some(_) => {}
            None if c == '"' || c == '\'' => quote = Some(c),
            None => count += usize::from(c == '='),
        }
    }
    count
}
