//! `<source>`: an array of numbers, and the accessor that describes its entries.

use super::document::{Document, Element, child, children, describe, tag};
use super::numbers::{check_count, floats_or_nan, integer_attribute};
use crate::diagnostic::SceneError;
use kit::{Vec2, Vec3};

/// Reads a source of points or directions, with three numbers per entry. Numbers that are not
/// finite are NaN. Entries of two numbers, with a warning, have z = 0.
pub(super) fn vectors<'a>(
    doc: &Document<'a>,
    source: Element<'a>,
) -> Result<Vec<Vec3>, SceneError> {
    let kind = EntryKind {
        numbers: "three",
        params: "X, Y, Z",
        help: "positions and normals have three coordinates: set stride=\"3\" and name three params",
        not_finite: "polygons with this position are ignored; a normal is replaced",
    };
    let accessor = accessor(doc, source)?;
    if let (Some(2), [0, 1]) = (accessor.stride, accessor.params.as_slice()) {
        let title = format!("{} reads two numbers per entry", describe(accessor.element));
        let expected = "expected params X, Y, Z; using z = 0";
        doc.on(accessor.element, title, expected).warn();
        let entries = accessor.entries::<2>(doc, source, &kind)?;
        return Ok(entries
            .iter()
            .map(|[x, y]| Vec3::new(*x, *y, 0.0))
            .collect());
    }
    let entries = accessor.entries(doc, source, &kind)?;
    Ok(entries.into_iter().map(Vec3::from_array).collect())
}

/// Reads a source of texture coordinates, with two numbers per entry, or the first two of more.
/// Numbers that are not finite are 0.
pub(super) fn pairs<'a>(doc: &Document<'a>, source: Element<'a>) -> Result<Vec<Vec2>, SceneError> {
    let kind = EntryKind {
        numbers: "two",
        params: "S, T",
        help: "texture coordinates are pairs: set stride=\"2\" and name two params",
        not_finite: "expected a finite number; using 0",
    };
    let finite = |x: f64| if x.is_nan() { 0.0 } else { x };
    let entries = accessor(doc, source)?.entries::<2>(doc, source, &kind)?;
    Ok(entries
        .iter()
        .map(|[s, t]| Vec2::new(finite(*s), finite(*t)))
        .collect())
}

/// Descriptions of an entry of a source, for messages.
struct EntryKind {
    numbers: &'static str,
    params: &'static str,
    help: &'static str,
    not_finite: &'static str,
}

/// An `<accessor>`.
struct Accessor<'a> {
    element: Element<'a>,
    stride: Option<u64>,
    /// The positions of the params with a name. If no param has a name: of all.
    params: Vec<usize>,
}

fn accessor<'a>(doc: &Document<'a>, source: Element<'a>) -> Result<Accessor<'a>, SceneError> {
    let technique = doc.child(source, "technique_common")?;
    let element = doc.child(technique, "accessor")?;
    let params: Vec<Element<'a>> = children(element).filter(|e| tag(*e) == "param").collect();
    let named = |i: &usize| params[*i].has_attribute("name");
    let mut positions: Vec<usize> = (0..params.len()).filter(named).collect();
    if positions.is_empty() {
        positions = (0..params.len()).collect();
    }
    Ok(Accessor {
        element,
        stride: integer_attribute(doc, element, "stride")?,
        params: positions,
    })
}

impl<'a> Accessor<'a> {
    /// The entries, each with the `N` numbers of the first params, or without params, the first `N`
    /// numbers. Without a stride, the entries have no other numbers.
    fn entries<const N: usize>(
        &self,
        doc: &Document<'a>,
        source: Element<'a>,
        kind: &EntryKind,
    ) -> Result<Vec<[f64; N]>, SceneError> {
        let accessor = self.element;
        let array = self.array(doc, source)?;
        let numbers = floats_or_nan(doc, array, kind.not_finite)?;
        check_count(doc, array, numbers.len() as u64, "numbers");
        if numbers.is_empty() {
            return Ok(Vec::new());
        }
        let positions: [usize; N] = match self.params.as_slice() {
            [] => std::array::from_fn(|i| i),
            params => match params.first_chunk() {
                Some(first) => *first,
                None => return Err(self.too_few_numbers::<N>(doc, kind)),
            },
        };
        let last = positions.into_iter().max().unwrap_or(0) as u64;
        let stride = self
            .stride
            .unwrap_or((self.params.len() as u64).max(last + 1));
        if stride <= last {
            return Err(self.too_few_numbers::<N>(doc, kind));
        }
        let offset = integer_attribute(doc, accessor, "offset")?.unwrap_or(0);
        let available = (numbers.len() as u64).saturating_sub(offset.saturating_add(last));
        let max_count = available.div_ceil(stride);
        let mut count = integer_attribute(doc, accessor, "count")?.unwrap_or(max_count);
        if count > max_count {
            let title = format!(
                "{} reads {count} entries, but {} contains {max_count}",
                describe(accessor),
                describe(array)
            );
            let used = format!("using {max_count}");
            doc.on_attribute(accessor, "count", title, used)
                .help("part of the array may be missing: compare the picture with the original")
                .warn();
            count = max_count;
        }
        // All entries are inside the array, so the numbers fit a usize.
        let (stride, offset) = (stride as usize, offset as usize);
        let entry = |i: usize| &numbers[offset + i * stride..];
        Ok((0..count as usize)
            .map(|i| positions.map(|position| entry(i)[position]))
            .collect())
    }

    /// The array that the accessor refers to, usually in the same source.
    fn array(&self, doc: &Document<'a>, source: Element<'a>) -> Result<Element<'a>, SceneError> {
        let reference = doc.attribute(self.element, "source")?.trim();
        let own = child(source, "float_array")
            .filter(|array| array.attribute("id") == reference.strip_prefix('#'));
        match own {
            Some(array) => Ok(array),
            None => doc.target(self.element, "source", "float_array"),
        }
    }

    fn too_few_numbers<const N: usize>(&self, doc: &Document<'a>, kind: &EntryKind) -> SceneError {
        let title = format!(
            "{} does not read {} numbers per entry",
            describe(self.element),
            kind.numbers
        );
        let params = kind.params;
        let expected = format!("expected params {params} and a stride of at least {N}");
        doc.on(self.element, title, expected).help(kind.help).into()
    }
}
