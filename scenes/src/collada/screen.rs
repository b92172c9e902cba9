//! A look at the text before it is parsed: what would keep the XML parser busy for minutes is refused.
//!
//! roxmltree compares every attribute of a tag with all others of it, and hands namespaces on from each element to
//! its children: both take a time that grows with the square of their number, or worse.

use super::limits::{MAX_ATTRIBUTES, MAX_NAMESPACES};
use crate::diagnostic::{Diagnostic, SceneError};
use std::ops::Range;

/// Refuses a text with too many attributes in one tag or too many namespaces in all. Whether the text is
/// well-formed is the parser's business.
pub(super) fn screen(name: &str, text: &str) -> Result<(), SceneError> {
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
            return Err(refusal(name, text, at..at + 1, title));
        }
        namespaces += tag.matches("xmlns").count();
        if namespaces > MAX_NAMESPACES {
            let title = format!("the file declares more than {MAX_NAMESPACES} namespaces");
            return Err(refusal(name, text, at..at + 1, title));
        }
    }
    Ok(())
}

fn refusal(name: &str, text: &str, mark: Range<usize>, title: String) -> SceneError {
    Diagnostic::about_file(name, title)
        .at(text, mark, "this tag is one too many")
        .help("no modelling program writes such a file: export the scene again")
        .into()
}

/// How long the comment, CDATA section, instruction or tag is that `markup` starts with.
fn markup_length(markup: &str) -> usize {
    let until = |end: &str| markup.find(end).map_or(markup.len(), |at| at + end.len());
    if markup.starts_with("<!--") {
        until("-->")
    } else if markup.starts_with("<![CDATA[") {
        until("]]>")
    } else if markup.starts_with("<?") {
        until("?>")
    } else {
        // A `>` may stand in an attribute's value.
        let mut quote = None;
        let end = markup.char_indices().find(|(_, c)| match (quote, c) {
            (None, '"' | '\'') => {
                quote = Some(*c);
                false
            }
            (None, '>') => true,
            (Some(open), c) if open == *c => {
                quote = None;
                false
            }
            _ => false,
        });
        end.map_or(markup.len(), |(at, _)| at + 1)
    }
}

/// How many attributes a tag has: equals signs outside of quotes.
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
