//! `<input>`, `<p>` and `<h>`: the index lists of a primitive element.
//!
//! Each list has groups of indices, one group per corner. A group has one index for each input, at
//! the offset of the input. The groups are numbered over all lists of the element.

use super::document::{Document, Element, children, tag};
use super::numbers::{indices, integer_attribute, token_range};
use crate::diagnostic::SceneError;
use std::ops::Range;

/// Maximum number of indices per corner. Files have up to about ten.
const MAX_STRIDE: u64 = 64;

/// An `<input>` and its offset in a group.
pub(super) struct InputAt<'a> {
    pub(super) element: Element<'a>,
    pub(super) offset: usize,
}

/// The inputs and the indices of a primitive element.
pub(super) struct IndexLists<'a> {
    pub(super) inputs: Vec<InputAt<'a>>,
    /// Number of indices per group.
    stride: usize,
    indices: Vec<u32>,
    /// Each `<p>` and `<h>`, and its first group.
    lists: Vec<(Element<'a>, usize)>,
}

impl<'a> IndexLists<'a> {
    /// Reads the inputs of a primitive element, and no index list yet.
    pub(super) fn new(
        doc: &Document<'a>,
        element: Element<'a>,
    ) -> Result<IndexLists<'a>, SceneError> {
        let inputs = children(element)
            .filter(|child| tag(*child) == "input")
            .map(|input| {
                let offset = offset(doc, input)?;
                Ok(InputAt {
                    element: input,
                    offset,
                })
            })
            .collect::<Result<Vec<InputAt<'a>>, SceneError>>()?;
        let last = inputs.iter().map(|input| input.offset).max();
        Ok(IndexLists {
            inputs,
            stride: last.unwrap_or(0) + 1,
            indices: Vec::new(),
            lists: Vec::new(),
        })
    }

    /// Adds a `<p>` or `<h>`. Returns its groups.
    pub(super) fn add(
        &mut self,
        doc: &Document<'a>,
        list: Element<'a>,
    ) -> Result<Range<usize>, SceneError> {
        let indices = indices(doc, list)?;
        let stride = self.stride;
        if !indices.len().is_multiple_of(stride) {
            let found = indices.len();
            let title = format!(
                "<{}> has {found} indices, not a multiple of {stride}",
                tag(list)
            );
            let expected = format!("expected {stride} indices per corner, one for each offset");
            return Err(doc
                .on(list, title, expected)
                .help("part of the list is missing, or an <input> has a wrong offset")
                .into());
        }
        let first = self.group_count();
        self.lists.push((list, first));
        self.indices.extend(indices);
        Ok(first..self.group_count())
    }

    /// Number of groups of all lists.
    pub(super) fn group_count(&self) -> usize {
        self.indices.len() / self.stride
    }

    /// The index of the input at `offset` in a group.
    pub(super) fn index(&self, group: usize, offset: usize) -> usize {
        self.indices[group * self.stride + offset] as usize
    }

    /// The bytes of the file with this index.
    pub(super) fn range(&self, doc: &Document<'a>, group: usize, offset: usize) -> Range<usize> {
        let next = self.lists.partition_point(|(_, first)| *first <= group);
        let (list, first) = self.lists[next - 1];
        token_range(doc, list, (group - first) * self.stride + offset)
    }
}

fn offset<'a>(doc: &Document<'a>, input: Element<'a>) -> Result<usize, SceneError> {
    match integer_attribute(doc, input, "offset")? {
        Some(offset) if offset < MAX_STRIDE => Ok(offset as usize),
        Some(offset) => {
            let title = format!("offset=\"{offset}\" is too large");
            let expected = format!("expected at most {}", MAX_STRIDE - 1);
            let help = "an offset is the position of an index in its corner, from 0";
            let finding = doc.on_attribute(input, "offset", title, expected);
            Err(finding.help(help).into())
        }
        None => Err(doc
            .attribute(input, "offset")
            .expect_err("the attribute is missing")),
    }
}
