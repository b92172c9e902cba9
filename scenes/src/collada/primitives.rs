//! `<triangles>`, `<polylist>`, `<polygons>`, `<tristrips>`, `<trifans>`: how the corners in the
//! index lists form polygons.

use super::document::{Document, Element, child, children, describe, tag};
use super::index_lists::IndexLists;
use super::numbers::{check_count, indices, token_range};
use crate::diagnostic::SceneError;
use std::ops::Range;

/// The polygons of a primitive element.
pub(super) struct Polygons<'a> {
    pub(super) lists: IndexLists<'a>,
    pub(super) polygons: Vec<Polygon>,
    /// The groups of the holes of all polygons.
    holes: Vec<Range<usize>>,
    /// Number of triangles, polygons, strips or fans, to be compared with the attribute `count`.
    declared: usize,
    /// Polygons with fewer than 3 corners, and where the first one is.
    too_small: usize,
    first_too_small: Option<Range<usize>>,
}

/// A polygon of consecutive groups. In a fan, the first corner is the same for all triangles.
pub(super) struct Polygon {
    pub(super) first: usize,
    corners: usize,
    /// The group of the corner that all triangles of a fan share.
    hub: Option<usize>,
    /// Whether the winding order is reversed, as in every second triangle of a strip.
    pub(super) reversed: bool,
    /// Its part of [`Polygons::holes`].
    holes: Range<usize>,
}

impl Polygon {
    fn new(first: usize, corners: usize) -> Polygon {
        Polygon {
            first,
            corners,
            hub: None,
            reversed: false,
            holes: 0..0,
        }
    }

    /// The groups of the corners on the boundary.
    pub(super) fn groups(&self) -> impl Iterator<Item = usize> {
        let others = self.corners - usize::from(self.hub.is_some());
        self.hub.into_iter().chain(self.first..self.first + others)
    }
}

impl<'a> Polygons<'a> {
    /// Reads the inputs and the index lists of a primitive element.
    pub(super) fn read(
        doc: &Document<'a>,
        element: Element<'a>,
    ) -> Result<Polygons<'a>, SceneError> {
        let mut polygons = Polygons {
            lists: IndexLists::new(doc, element)?,
            polygons: Vec::new(),
            holes: Vec::new(),
            declared: 0,
            too_small: 0,
            first_too_small: None,
        };
        for part in children(element) {
            match tag(part) {
                "p" => {
                    let groups = polygons.lists.add(doc, part)?;
                    polygons.add_list(doc, element, part, groups)?;
                }
                "ph" => polygons.add_with_holes(doc, part)?,
                _ => {}
            }
        }
        if tag(element) == "polylist" {
            polygons.split_polylist(doc, element)?;
        }
        if let Some(first) = &polygons.first_too_small {
            let title = format!("polygons with fewer than 3 corners: {}", polygons.too_small);
            doc.at(first.clone(), title, "they are ignored").warn();
        }
        Ok(polygons)
    }

    /// Warns if the attribute `count` is not the number of polygons.
    pub(super) fn check_count(&self, doc: &Document<'a>, element: Element<'a>) {
        let what = match tag(element) {
            "triangles" => "triangles",
            "tristrips" => "strips",
            "trifans" => "fans",
            _ => "polygons",
        };
        check_count(doc, element, self.declared as u64, what);
    }

    /// The groups of the holes of a polygon.
    pub(super) fn holes(&self, polygon: &Polygon) -> &[Range<usize>] {
        &self.holes[polygon.holes.clone()]
    }

    /// The groups of the corners of a triangle without holes.
    pub(super) fn as_triangle(&self, polygon: &Polygon) -> Option<[usize; 3]> {
        let mut groups = polygon.groups();
        (polygon.corners == 3 && polygon.holes.is_empty())
            .then(|| std::array::from_fn(|_| groups.next().unwrap_or_default()))
    }

    /// Adds the polygons of a `<p>` with these groups. The `<p>` of a polylist is split later.
    fn add_list(
        &mut self,
        doc: &Document<'a>,
        element: Element<'a>,
        list: Element<'a>,
        groups: Range<usize>,
    ) -> Result<(), SceneError> {
        self.declared += match tag(element) {
            "triangles" => groups.len() / 3,
            "polylist" => 0,
            _ => 1,
        };
        match tag(element) {
            "triangles" if !groups.len().is_multiple_of(3) => {
                let title = format!("<p> has {} corners, not a multiple of 3", groups.len());
                let help = "part of the list is missing: export the file again";
                let finding = doc.on(list, title, "expected three corners per triangle");
                return Err(finding.help(help).into());
            }
            "triangles" => {
                let triangles = groups.step_by(3).map(|first| Polygon::new(first, 3));
                self.polygons.extend(triangles);
            }
            "polygons" => self.add_polygon(list.range(), groups),
            // All triples of consecutive corners, with alternating winding order.
            "tristrips" => {
                let count = groups.len().saturating_sub(2);
                let triangles = groups.take(count).enumerate().map(|(i, first)| Polygon {
                    reversed: i % 2 == 1,
                    ..Polygon::new(first, 3)
                });
                self.polygons.extend(triangles);
            }
            // The first corner with all pairs of consecutive other corners.
            "trifans" => {
                let hub = Some(groups.start);
                let count = groups.len().saturating_sub(2);
                let firsts = groups.skip(1).take(count);
                let triangles = firsts.map(|first| Polygon {
                    hub,
                    ..Polygon::new(first, 3)
                });
                self.polygons.extend(triangles);
            }
            _ => {}
        }
        Ok(())
    }

    /// Adds a polygon with these groups, if it has enough corners. `mark` is where it is.
    fn add_polygon(&mut self, mark: Range<usize>, groups: Range<usize>) {
        if groups.len() >= 3 {
            self.polygons.push(Polygon::new(groups.start, groups.len()));
        } else {
            self.too_small += 1;
            self.first_too_small.get_or_insert(mark);
        }
    }

    /// Adds the polygon of a `<ph>`: a `<p>`, and an `<h>` for each hole.
    fn add_with_holes(&mut self, doc: &Document<'a>, ph: Element<'a>) -> Result<(), SceneError> {
        let outline = doc.child(ph, "p")?;
        let groups = self.lists.add(doc, outline)?;
        let before = self.polygons.len();
        self.add_polygon(outline.range(), groups);
        self.declared += 1;
        let first_hole = self.holes.len();
        for hole in children(ph).filter(|child| tag(*child) == "h") {
            let groups = self.lists.add(doc, hole)?;
            if groups.len() >= 3 {
                self.holes.push(groups);
            }
        }
        if let Some(polygon) = self.polygons.get_mut(before) {
            polygon.holes = first_hole..self.holes.len();
        }
        Ok(())
    }

    /// `<polylist>`: `<vcount>` has the number of corners of each polygon.
    fn split_polylist(
        &mut self,
        doc: &Document<'a>,
        element: Element<'a>,
    ) -> Result<(), SceneError> {
        let found = self.lists.group_count();
        let Some(vcount) = child(element, "vcount") else {
            return match found {
                0 => Ok(()),
                _ => doc.child(element, "vcount").map(|_| ()),
            };
        };
        let counts = indices(doc, vcount)?;
        let needed: u64 = counts.iter().map(|count| u64::from(*count)).sum();
        if needed != found as u64 {
            let title = format!(
                "<vcount> of {} needs {needed} corners, <p> has {found}",
                describe(element)
            );
            let expected = format!("expected counts that add up to {found}");
            return Err(doc
                .on(vcount, title, expected)
                .help("part of a list is missing or duplicated: export the file again")
                .into());
        }
        let mut first = 0;
        for (i, count) in counts.iter().map(|count| *count as usize).enumerate() {
            let mark = match (count, &self.first_too_small) {
                (0..3, None) => token_range(doc, vcount, i),
                _ => 0..0,
            };
            self.add_polygon(mark, first..first + count);
            first += count;
        }
        self.declared = counts.len();
        Ok(())
    }
}
