//! Lists of numbers in the text of an element, with the place of each.

use super::document::{Document, Element, children, describe, short};
use crate::diagnostic::SceneError;
use std::ops::Range;

/// The words of an element's text and where in the file they stand.
///
/// Text with character references or CDATA is not in the file as such: its words are placed at the
/// whole text.
fn words<'a>(
    doc: &Document<'a>,
    element: Element<'a>,
) -> impl Iterator<Item = (&'a str, Range<usize>)> {
    let source = doc.source();
    let texts = element.children().filter(|node| node.is_text());
    texts.flat_map(move |node| {
        let range = node.range();
        let raw = &source[range.clone()];
        let plain = !raw.contains(['&', '<']);
        let text = if plain {
            raw
        } else {
            node.text().unwrap_or_default()
        };
        text.split_ascii_whitespace().map(move |word| {
            let place = if plain {
                let start = range.start + (word.as_ptr() as usize - text.as_ptr() as usize);
                start..start + word.len()
            } else {
                range.clone()
            };
            (word, place)
        })
    })
}

/// The place of word number `index` of an element's text; the element's own place if it has no such word.
pub(super) fn place_of<'a>(doc: &Document<'a>, element: Element<'a>, index: usize) -> Range<usize> {
    words(doc, element)
        .nth(index)
        .map_or_else(|| element.range(), |(_, place)| place)
}

/// All numbers of an element's text. NaN and infinite ones are errors.
pub(super) fn floats<'a>(doc: &Document<'a>, element: Element<'a>) -> Result<Vec<f64>, SceneError> {
    only_text(doc, element)?;
    words(doc, element)
        .map(|(word, place)| {
            let number = word.parse::<f64>().ok().filter(|number| number.is_finite());
            number.ok_or_else(|| not_a_number(doc, element, word, place))
        })
        .collect()
}

/// All whole numbers from 0 of an element's text: indices and vertex counts.
pub(super) fn indices<'a>(
    doc: &Document<'a>,
    element: Element<'a>,
) -> Result<Vec<u32>, SceneError> {
    only_text(doc, element)?;
    words(doc, element)
        .map(|(word, place)| {
            word.parse::<u32>().map_err(|_| {
                let title = format!("`{}` in {} is not an index", short(word), describe(element));
                doc.at(place, title, "expected a whole number from 0")
                    .help("indices count from 0 and have neither sign nor decimal point")
                    .into()
            })
        })
        .collect()
}

/// Numbers stand alone in their element.
fn only_text<'a>(doc: &Document<'a>, element: Element<'a>) -> Result<(), SceneError> {
    match children(element).next() {
        None => Ok(()),
        Some(other) => {
            let title = format!("{} stands in {}", describe(other), describe(element));
            Err(doc
                .on(other, title, "expected nothing but numbers")
                .help("the file is damaged: export it again")
                .into())
        }
    }
}

fn not_a_number<'a>(
    doc: &Document<'a>,
    element: Element<'a>,
    word: &str,
    place: Range<usize>,
) -> SceneError {
    let word = short(word);
    let (title, help) = match word.parse::<f64>() {
        Ok(number) if number.is_nan() => (
            format!("a number in {} is NaN", describe(element)),
            "the program that wrote the file divided by zero somewhere: mend it there",
        ),
        Ok(_) => (
            format!("`{word}` in {} is infinite", describe(element)),
            "numbers go up to 1.8e308",
        ),
        Err(_) => (
            format!("`{word}` in {} is not a number", describe(element)),
            "write numbers like -1.5 or 2e-3, with a decimal point and spaces between them",
        ),
    };
    doc.at(place, title, "expected a finite number")
        .help(help)
        .into()
}

/// Exactly `N` numbers. `what` says what they are.
pub(super) fn exactly<'a, const N: usize>(
    doc: &Document<'a>,
    element: Element<'a>,
    what: &str,
) -> Result<[f64; N], SceneError> {
    let numbers = floats(doc, element)?;
    <[f64; N]>::try_from(numbers.as_slice()).map_err(|_| {
        let numerus = if N == 1 { "number" } else { "numbers" };
        let title = format!("{} has {} numbers", describe(element), numbers.len());
        doc.on(element, title, format!("expected {N} {numerus}: {what}"))
            .help(format!("write {N} {numerus} between the tags"))
            .into()
    })
}

/// An attribute that holds a whole number from 0, if it is there.
pub(super) fn whole_attribute<'a>(
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
            short(text),
            describe(element)
        );
        doc.on_attribute(element, name, title, "expected a whole number from 0")
            .help("write the number in digits alone")
            .into()
    })
}

/// Compares the attribute `count` with what is there: a difference is an error, for something is
/// missing; a file without the attribute gets a warning.
pub(super) fn check_count<'a>(
    doc: &Document<'a>,
    element: Element<'a>,
    found: u64,
    of: &str,
) -> Result<(), SceneError> {
    match whole_attribute(doc, element, "count")? {
        Some(count) if count == found => Ok(()),
        Some(count) => {
            let title = format!(
                "{} says count=\"{count}\" but holds {found} {of}",
                describe(element)
            );
            let help =
                "part of the file is missing or doubled: export it again, or correct the count";
            Err(doc
                .on_attribute(element, "count", title, format!("expected {found}"))
                .help(help)
                .into())
        }
        None => {
            doc.warn(|| {
                let title = format!("{} has no attribute `count`", describe(element));
                doc.on(element, title, format!("taken as {found}"))
            });
            Ok(())
        }
    }
}
