//! `<triangles>`, `<polylist>`, `<polygons>`, `<tristrips>`, `<trifans>`: groups of indices.
//!
//! Each `<p>` is a list of groups, one per corner. A group has one index for each input, at the
//! offset of the input. The five elements differ in how groups form polygons.

use super::document::{Document, Element, child, children, describe, tag};
use super::numbers::{indices, integer_attribute, token_range};
use crate::diagnostic::SceneError;

/// Maximum number of indices per corner. Files have up to about ten.
const MAX_STRIDE: u64 = 64;

/// The index lists of a primitive element, and its polygons.
pub(super) struct Polygons<'a> {
    pub(super) inputs: Vec<InputAt<'a>>,
    pub(super) lists: Vec<IndexList<'a>>,
    /// Number of indices per corner.
    pub(super) stride: usize,
    /// Number of polygons, strips or fans, to be compared with the attribute `count`.
    pub(super) declared: usize,
    /// What `declared` counts, for messages.
    pub(super) what: &'static str,
    polygons: Vec<Polygon>,
}

/// An `<input>` and its offset in a group.
pub(super) struct InputAt<'a> {
    pub(super) element: Element<'a>,
    pub(super) offset: usize,
}

/// A `<p>` element.
pub(super) struct IndexList<'a> {
    pub(super) element: Element<'a>,
    pub(super) indices: Vec<u32>,
}

/// A polygon of consecutive groups. In a fan, the first corner is the same for all triangles.
#[derive(Clone, Copy)]
pub(super) struct Polygon {
    pub(super) list: usize,
    pub(super) first: usize,
    corners: usize,
    /// The group of the corner that all triangles of a fan share.
    hub: Option<usize>,
    /// Whether the winding order is reversed, as in every second triangle of a strip.
    pub(super) reversed: bool,
}

impl Polygon {
    /// The group of corner `corner`.
    pub(super) fn group(&self, corner: usize) -> usize {
        match self.hub {
            Some(hub) if corner == 0 => hub,
            Some(_) => self.first + corner - 1,
            None => self.first + corner,
        }
    }

    /// The groups of all corners.
    pub(super) fn groups(&self) -> impl Iterator<Item = usize> {
        (0..self.corners).map(|corner| self.group(corner))
    }
}

impl Polygons<'_> {
    pub(super) fn is_empty(&self) -> bool {
        self.polygons.is_empty()
    }

    pub(super) fn iter(&self) -> impl Iterator<Item = &Polygon> {
        self.polygons.iter()
    }

    /// Number of triangles of all polygons.
    pub(super) fn triangle_count(&self) -> usize {
        self.polygons
            .iter()
            .map(|polygon| polygon.corners - 2)
            .sum()
    }
}

/// Reads the inputs and the index lists of a primitive element.
pub(super) fn read_polygons<'a>(
    doc: &Document<'a>,
    element: Element<'a>,
) -> Result<Polygons<'a>, SceneError> {
    let inputs = read_inputs(doc, element)?;
    let stride = inputs
        .iter()
        .map(|input| input.offset + 1)
        .max()
        .unwrap_or(1);
    let mut lists = Vec::new();
    for part in children(element) {
        match tag(part) {
            "p" => lists.push(IndexList {
                element: part,
                indices: indices(doc, part)?,
            }),
            "ph" => doc.warn(|| {
                let help = "triangulate the mesh in the modelling program before the export";
                doc.on(
                    part,
                    "a polygon with holes is ignored",
                    "holes are not supported",
                )
                .help(help)
            }),
            _ => {}
        }
    }
    for list in &lists {
        if !list.indices.len().is_multiple_of(stride) {
            let title = format!(
                "<p> has {} indices, not a multiple of {stride}",
                list.indices.len()
            );
            return Err(doc
                .on(
                    list.element,
                    title,
                    format!("expected {stride} indices per corner, one for each offset"),
                )
                .help("part of the list is missing, or an <input> has a wrong offset")
                .into());
        }
    }
    let mut polygons = Polygons {
        inputs,
        lists,
        stride,
        declared: 0,
        what: "polygons",
        polygons: Vec::new(),
    };
    match tag(element) {
        "triangles" => polygons.split_triangles(doc)?,
        "polylist" => polygons.split_polylist(doc, element)?,
        "polygons" => polygons.split_lists(doc),
        strips_or_fans => polygons.split_strips(strips_or_fans == "trifans"),
    }
    Ok(polygons)
}

fn read_inputs<'a>(
    doc: &Document<'a>,
    element: Element<'a>,
) -> Result<Vec<InputAt<'a>>, SceneError> {
    let inputs = children(element).filter(|child| tag(*child) == "input");
    inputs
        .map(|input| match integer_attribute(doc, input, "offset")? {
            Some(offset) if offset < MAX_STRIDE => Ok(InputAt {
                element: input,
                offset: offset as usize,
            }),
            Some(offset) => {
                let title = format!("offset=\"{offset}\" is too large");
                let expected = format!("expected at most {}", MAX_STRIDE - 1);
                let help = "an offset is the position of an index in its corner, from 0";
                Err(doc
                    .on_attribute(input, "offset", title, expected)
                    .help(help)
                    .into())
            }
            None => Err(doc
                .attribute(input, "offset")
                .expect_err("the attribute is missing")),
        })
        .collect()
}

impl<'a> Polygons<'a> {
    fn corners_in(&self, list: usize) -> usize {
        self.lists[list].indices.len() / self.stride
    }

    fn push(&mut self, list: usize, first: usize, corners: usize) {
        let polygon = Polygon {
            list,
            first,
            corners,
            hub: None,
            reversed: false,
        };
        self.polygons.push(polygon);
    }

    fn split_triangles(&mut self, doc: &Document<'a>) -> Result<(), SceneError> {
        self.what = "triangles";
        for list in 0..self.lists.len() {
            let corners = self.corners_in(list);
            if !corners.is_multiple_of(3) {
                let title = format!("<p> has {corners} corners, not a multiple of 3");
                let expected = "expected three corners per triangle";
                let help = "part of the list is missing: export the file again";
                return Err(doc
                    .on(self.lists[list].element, title, expected)
                    .help(help)
                    .into());
            }
            for first in (0..corners).step_by(3) {
                self.push(list, first, 3);
            }
            self.declared += corners / 3;
        }
        Ok(())
    }

    fn split_polylist(
        &mut self,
        doc: &Document<'a>,
        element: Element<'a>,
    ) -> Result<(), SceneError> {
        let Some(vcount) = child(element, "vcount") else {
            return match self.lists.as_slice() {
                [] => Ok(()),
                _ => doc.child(element, "vcount").map(|_| ()),
            };
        };
        let counts = indices(doc, vcount)?;
        let needed: u64 = counts.iter().map(|count| u64::from(*count)).sum();
        let found: usize = (0..self.lists.len())
            .map(|list| self.corners_in(list))
            .sum();
        if needed != found as u64 || self.lists.len() > 1 {
            let title = format!(
                "<vcount> of {} needs {needed} corners, <p> has {found}",
                describe(element)
            );
            return Err(doc
                .on(
                    vcount,
                    title,
                    format!("expected counts that add up to {found}, in one <p>"),
                )
                .help("part of a list is missing or duplicated: export the file again")
                .into());
        }
        let mut first = 0;
        let mut too_small = 0;
        for (i, count) in counts.iter().map(|count| *count as usize).enumerate() {
            if count >= 3 {
                self.push(0, first, count);
            } else {
                too_small += 1;
                if too_small == 1 {
                    doc.warn(|| {
                        let title = format!("a polygon has {count} corners");
                        doc.at(
                            token_range(doc, vcount, i),
                            title,
                            "expected at least 3; it is ignored",
                        )
                    });
                }
            }
            first += count;
        }
        self.declared = counts.len();
        Ok(())
    }

    /// `<polygons>`: each `<p>` is a polygon.
    fn split_lists(&mut self, doc: &Document<'a>) {
        self.declared = self.lists.len();
        for list in 0..self.lists.len() {
            match self.corners_in(list) {
                corners @ 3.. => self.push(list, 0, corners),
                corners => doc.warn(|| {
                    let title = format!("a polygon has {corners} corners");
                    let expected = "expected at least 3; it is ignored";
                    doc.on(self.lists[list].element, title, expected)
                }),
            }
        }
    }

    /// Each `<p>` is a strip (all triples of consecutive corners, with alternating winding order)
    /// or a fan (the first corner with all pairs of consecutive other corners).
    fn split_strips(&mut self, fans: bool) {
        self.what = if fans { "fans" } else { "strips" };
        self.declared = self.lists.len();
        for list in 0..self.lists.len() {
            for i in 0..self.corners_in(list).saturating_sub(2) {
                self.polygons.push(if fans {
                    Polygon {
                        list,
                        first: i + 1,
                        corners: 3,
                        hub: Some(0),
                        reversed: false,
                    }
                } else {
                    Polygon {
                        list,
                        first: i,
                        corners: 3,
                        hub: None,
                        reversed: i % 2 == 1,
                    }
                });
            }
        }
    }
}
