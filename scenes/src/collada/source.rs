//! `<source>`: an array of numbers, and the accessor that describes its entries.

use super::document::{Document, Element, child, children, describe, tag};
use super::numbers::{check_count, floats, integer_attribute};
use crate::diagnostic::SceneError;
use kit::{Vec2, Vec3};

/// Reads a source of points or directions, with three numbers per entry.
pub(super) fn vectors<'a>(
    doc: &Document<'a>,
    source: Element<'a>,
) -> Result<Vec<Vec3>, SceneError> {
    let help =
        "positions and normals have three coordinates: set stride=\"3\" and name three params";
    let entries = entries(
        doc,
        source,
        EntryDescription {
            numbers: "three",
            params: "X, Y, Z",
            help,
        },
    )?;
    Ok(entries.into_iter().map(Vec3::from_array).collect())
}

/// Reads a source of texture coordinates, with two numbers per entry, or the first two of more.
pub(super) fn pairs<'a>(doc: &Document<'a>, source: Element<'a>) -> Result<Vec<Vec2>, SceneError> {
    let help = "texture coordinates are pairs: set stride=\"2\" and name two params";
    let entries = entries(
        doc,
        source,
        EntryDescription {
            numbers: "two",
            params: "S, T",
            help,
        },
    )?;
    Ok(entries.into_iter().map(Vec2::from_array).collect())
}

/// Descriptions of an entry of a source, for messages.
struct EntryDescription {
    numbers: &'static str,
    params: &'static str,
    help: &'static str,
}

fn entries<'a, const N: usize>(
    doc: &Document<'a>,
    source: Element<'a>,
    entry: EntryDescription,
) -> Result<Vec<[f64; N]>, SceneError> {
    let technique = doc.child(source, "technique_common")?;
    let accessor = doc.child(technique, "accessor")?;
    let array = array_of(doc, source, accessor)?;
    let numbers = floats(doc, array)?;
    check_count(doc, array, numbers.len() as u64, "numbers")?;

    let stride = integer_attribute(doc, accessor, "stride")?.unwrap_or(1);
    let offset = integer_attribute(doc, accessor, "offset")?.unwrap_or(0);
    let count = integer_attribute(doc, accessor, "count")?;
    let positions: [usize; N] = coordinates(doc, accessor, stride, entry)?;

    let last = positions.into_iter().max().unwrap_or(0) as u64;
    let available = (numbers.len() as u64).saturating_sub(offset.saturating_add(last));
    let max_count = available.div_ceil(stride);
    let count = count.unwrap_or(max_count);
    if count > max_count {
        let title = format!(
            "{} reads {count} entries, but {} contains {max_count}",
            describe(accessor),
            describe(array)
        );
        return Err(doc
            .on_attribute(
                accessor,
                "count",
                title,
                format!("expected at most {max_count}"),
            )
            .help("part of the array is missing: export the file again, or correct the count")
            .into());
    }
    // All entries are inside the array, so the numbers fit a usize.
    let (stride, offset) = (stride as usize, offset as usize);
    let entry = |i: usize| &numbers[offset + i * stride..];
    Ok((0..count as usize)
        .map(|i| positions.map(|position| entry(i)[position]))
        .collect())
}

/// The array that the accessor refers to, usually in the same source.
fn array_of<'a>(
    doc: &Document<'a>,
    source: Element<'a>,
    accessor: Element<'a>,
) -> Result<Element<'a>, SceneError> {
    let reference = doc.attribute(accessor, "source")?.trim();
    let own = child(source, "float_array")
        .filter(|array| array.attribute("id") == reference.strip_prefix('#'));
    match own {
        Some(array) => Ok(array),
        None => doc.target(accessor, "source", "float_array"),
    }
}

/// The positions of the `N` coordinates in an entry: the first params with a name. Without params:
/// the first numbers.
fn coordinates<'a, const N: usize>(
    doc: &Document<'a>,
    accessor: Element<'a>,
    stride: u64,
    entry: EntryDescription,
) -> Result<[usize; N], SceneError> {
    let params: Vec<Element<'a>> = children(accessor).filter(|e| tag(*e) == "param").collect();
    let named: Vec<usize> = if params.is_empty() {
        (0..N).collect()
    } else {
        let named = params
            .iter()
            .enumerate()
            .filter(|(_, p)| p.has_attribute("name"));
        named.map(|(i, _)| i).take(N).collect()
    };
    match <[usize; N]>::try_from(named) {
        Ok(positions) if positions.iter().all(|position| (*position as u64) < stride) => {
            Ok(positions)
        }
        _ => {
            let title = format!(
                "{} does not read {} numbers per entry",
                describe(accessor),
                entry.numbers
            );
            let params = entry.params;
            let expected = format!("expected params {params} and a stride of at least {N}");
            Err(doc.on(accessor, title, expected).help(entry.help).into())
        }
    }
}
