//! Lists of numbers in the text of an element, with the position of each.

use super::document::{Document, Element, children, describe, truncated};
use crate::diagnostic::SceneError;
use std::ops::Range;

/// The tokens of an element's text and their byte ranges in the file.
///
/// Text with character references or CDATA is not in the file literally: its tokens have the range
/// of the whole text.
fn tokens<'a>(
    doc: &Document<'a>,
    element: Element<'a>,
) -> impl Iterator<Item = (&'a str, Range<usize>)> {
    let source = doc.source();
    let texts = element.children().filter(|node| node.is_text());
    texts.flat_map(move |node| {
        let range = node.range();
        let raw = &source[range.clone()];
        let parsed = node.text().unwrap_or_default();
        // The range of text before a CDATA section ends where that begins, the text does not.
        // Line ends count once.
        let line_ends = match raw.contains('\r') {
            true => raw.matches("\r\n").count(),
            false => 0,
        };
        let is_whole = parsed.len() == raw.len() - line_ends;
        let plain = is_whole && !raw.contains('&') && !raw.contains('<');
        let text = if plain { raw } else { parsed };
        text.split_ascii_whitespace().map(move |token| {
            let range = if plain {
                let start = range.start + (token.as_ptr() as usize - text.as_ptr() as usize);
                start..start + token.len()
            } else {
                range.clone()
            };
            (token, range)
        })
    })
}

/// The byte range of token `index` of an element's text, or the range of the element if there is no
/// such token.
pub(super) fn token_range<'a>(
    doc: &Document<'a>,
    element: Element<'a>,
    index: usize,
) -> Range<usize> {
    tokens(doc, element)
        .nth(index)
        .map_or_else(|| element.range(), |(_, range)| range)
}

/// All numbers of an element's text. NaN and infinite numbers are errors.
pub(super) fn floats<'a>(doc: &Document<'a>, element: Element<'a>) -> Result<Vec<f64>, SceneError> {
    check_only_text(doc, element)?;
    tokens(doc, element)
        .map(|(token, range)| match parse(doc, token, &range) {
            Some(number) if number.is_finite() => Ok(number),
            number => Err(not_a_number(doc, element, token, number, range)),
        })
        .collect()
}

/// All numbers of an element's text. Numbers that are not finite are NaN, with a warning; `result`
/// describes what the reader does with them.
pub(super) fn floats_or_nan<'a>(
    doc: &Document<'a>,
    element: Element<'a>,
    result: &str,
) -> Result<Vec<f64>, SceneError> {
    check_only_text(doc, element)?;
    tokens(doc, element)
        .map(|(token, range)| match parse(doc, token, &range) {
            Some(number) if number.is_finite() => Ok(number),
            Some(_) => {
                let shown = truncated(token);
                let title = format!("`{shown}` in {} is not finite", describe(element));
                doc.at(range, title, result).warn();
                Ok(f64::NAN)
            }
            None => Err(not_a_number(doc, element, token, None, range)),
        })
        .collect()
}

/// The number that `token` stands for. Not only as XML Schema and Rust write it: a decimal comma
/// gives a warning, and C programs on Windows wrote NaN and infinity as `1.#QNAN` and `1.#INF`.
fn parse<'a>(doc: &Document<'a>, token: &str, range: &Range<usize>) -> Option<f64> {
    if let Ok(number) = token.parse::<f64>() {
        return Some(number);
    }
    let magnitude = token.strip_prefix(['-', '+']).unwrap_or(token);
    if magnitude.starts_with("1.#INF") {
        return Some(f64::INFINITY);
    }
    if magnitude.starts_with("1.#") || magnitude.to_ascii_lowercase().starts_with("nan(") {
        return Some(f64::NAN);
    }
    let number = token.replacen(',', ".", 1).parse::<f64>().ok()?;
    // `1,` and `,1` are rather lists with commas between the numbers.
    let digits = |part: &str| part.contains(|c: char| c.is_ascii_digit());
    let (before, after) = token
        .split_once(',')
        .filter(|(a, b)| digits(a) && digits(b))?;
    let title = format!("`{}` has a decimal comma", truncated(token));
    let read_as = format!("expected a decimal point; read as {before}.{after}");
    doc.at(range.clone(), title, truncated(&read_as)).warn();
    Some(number)
}

/// All integers of an element's text, none negative: indices and vertex counts.
pub(super) fn indices<'a>(
    doc: &Document<'a>,
    element: Element<'a>,
) -> Result<Vec<u32>, SceneError> {
    check_only_text(doc, element)?;
    tokens(doc, element)
        .map(|(token, range)| {
            token.parse::<u32>().map_err(|_| {
                let title = format!(
                    "`{}` in {} is not an index",
                    truncated(token),
                    describe(element)
                );
                doc.at(range, title, "expected an integer >= 0")
                    .help("indices start at 0 and have no sign and no decimal point")
                    .into()
            })
        })
        .collect()
}

/// An error if the element has child elements.
fn check_only_text<'a>(doc: &Document<'a>, element: Element<'a>) -> Result<(), SceneError> {
    match children(element).next() {
        None => Ok(()),
        Some(other) => {
            let title = format!("{} is inside {}", describe(other), describe(element));
            Err(doc
                .on(other, title, "expected only numbers")
                .help("the file is damaged: export it again")
                .into())
        }
    }
}

/// The error for a token that is no number, or for a `number` that is not finite.
fn not_a_number<'a>(
    doc: &Document<'a>,
    element: Element<'a>,
    token: &str,
    number: Option<f64>,
    range: Range<usize>,
) -> SceneError {
    let token = truncated(token);
    let (title, help) = match number {
        Some(number) if number.is_nan() => (
            format!("a number in {} is NaN", describe(element)),
            "the program that wrote the file computed an undefined number: correct the scene there",
        ),
        Some(_) => (
            format!("`{token}` in {} is infinite", describe(element)),
            "the largest number is 1.8e308",
        ),
        None => (
            format!("`{token}` in {} is not a number", describe(element)),
            "write numbers like -1.5 or 2e-3, with a decimal point and spaces between them",
        ),
    };
    doc.at(range, title, "expected a finite number")
        .help(help)
        .into()
}

/// Exactly `N` numbers. `what` describes them in messages.
pub(super) fn exactly<'a, const N: usize>(
    doc: &Document<'a>,
    element: Element<'a>,
    what: &str,
) -> Result<[f64; N], SceneError> {
    let numbers = floats(doc, element)?;
    <[f64; N]>::try_from(numbers.as_slice()).map_err(|_| {
        let noun = if N == 1 { "number" } else { "numbers" };
        let title = format!("{} has {} numbers", describe(element), numbers.len());
        doc.on(element, title, format!("expected {N} {noun}: {what}"))
            .help(format!("write {N} {noun} between the tags"))
            .into()
    })
}

/// The value of an attribute that is an integer, not negative, if the attribute exists.
pub(super) fn integer_attribute<'a>(
    doc: &Document<'a>,
    element: Element<'a>,
    name: &str,
) -> Result<Option<u64>, SceneError> {
    let Some(text) = element.attribute(name) else {
        return Ok(None);
    };
    text.trim().parse::<u64>().map(Some).map_err(|_| {
        let title = format!(
            "{name}=\"{}\" of {} is not a count",
            truncated(text),
            describe(element)
        );
        doc.on_attribute(element, name, title, "expected an integer >= 0")
            .help("write the number with digits only")
            .into()
    })
}

/// Compares the attribute `count` with the number of entries, and warns of a difference: the
/// entries that were found are used.
pub(super) fn check_count<'a>(doc: &Document<'a>, element: Element<'a>, found: u64, of: &str) {
    let Some(text) = element.attribute("count") else {
        let title = format!("{} has no attribute `count`", describe(element));
        doc.on(element, title, format!("using {found}")).warn();
        return;
    };
    if text.trim().parse() != Ok(found) {
        let shown = truncated(text);
        let title = format!(
            "{} has count=\"{shown}\", but contains {found} {of}",
            describe(element)
        );
        doc.on_attribute(element, "count", title, format!("using {found}"))
            .help("part of the file may be missing: compare the picture with the original")
            .warn();
    }
}
