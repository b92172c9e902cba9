// BEGIN SOLUTION(part6.task1)
//! Splits triangles whose boxes are mostly empty before the tree is built.
//!
//! The box of a long thin triangle that is not along an axis is nearly empty, and rays that enter it
//! test the triangle in vain. Two boxes, one for each half, have half its surface, four a quarter.
//! So such a triangle is divided into parts, and the tree is built over the boxes of the parts
//! (Karras, Aila, "Fast parallel construction of high-quality bounding volume hierarchies", 2013,
//! section 4.4). A triangle may then be in several leaves; each of them tests all of it, so the hits
//! are the same.

use crate::sah::BuildPrimitive;
use kit::{Aabb, Vec3};
use std::cmp::Ordering;
use std::collections::BinaryHeap;

/// A part is divided if the surface of its box is more than this many times the surface that
/// infinitely small boxes around it would have together. In a mesh without long thin triangles there
/// are few: most have a ratio from 2 to 5.
const SPARSE: f64 = 6.0;

/// The number of additional parts is at most the number of triangles over this.
const TRIANGLES_PER_SPLIT: usize = 2;

/// Parts are enlarged by this share of the triangle's largest edge. Clipping has rounding errors,
/// and the triangle test may report a hit at such a distance from the triangle, but a part's box is
/// much smaller than the triangle's.
const MARGIN: f64 = 1.0 / (1_u64 << 40) as f64;

/// Adds the boxes of `triangles`, given in the tree's space with their ids, to `prims`: one box for
/// each, or those of its parts.
pub(crate) fn add_triangles(
    prims: &mut Vec<BuildPrimitive>,
    triangles: impl ExactSizeIterator<Item = (u32, [Vec3; 3])>,
) {
    let mut most = triangles.len() / TRIANGLES_PER_SPLIT;
    let mut sparse = BinaryHeap::new();
    for (id, vertices) in triangles {
        let part = Part::whole(id, vertices);
        if part.is_sparse() {
            sparse.push(part);
        } else {
            prims.push(BuildPrimitive::new(id, part.bounds));
        }
    }
    while most > 0
        && let Some(part) = sparse.pop()
    {
        let Some(halves) = part.halves() else {
            prims.push(part.primitive());
            continue;
        };
        most -= 1;
        for half in halves {
            if half.is_sparse() {
                sparse.push(half);
            } else {
                prims.push(half.primitive());
            }
        }
    }
    prims.extend(sparse.iter().map(Part::primitive));
}

/// A convex part of a triangle.
struct Part {
    id: u32,
    polygon: Vec<Vec3>,
    bounds: Aabb,
    /// The surface of its box, and what tight boxes would have, both halved.
    area: f64,
    tight_area: f64,
    margin: f64,
}

impl Part {
    fn whole(id: u32, vertices: [Vec3; 3]) -> Part {
        let extent = bounds_of(&vertices).extent().max_element();
        Part::new(id, vertices.to_vec(), MARGIN * extent)
    }

    fn new(id: u32, polygon: Vec<Vec3>, margin: f64) -> Part {
        let bounds = bounds_of(&polygon);
        let e = bounds.extent();
        let fan = polygon.windows(2).skip(1);
        let normal: Vec3 = fan
            .map(|edge| (edge[0] - polygon[0]).cross(edge[1] - polygon[0]))
            .sum();
        Part {
            id,
            bounds,
            area: e.x * e.y + e.y * e.z + e.z * e.x,
            tight_area: 0.5 * normal.abs().element_sum(),
            margin,
            polygon,
        }
    }

    fn is_sparse(&self) -> bool {
        self.area > SPARSE * self.tight_area
    }

    fn primitive(&self) -> BuildPrimitive {
        let bounds = Aabb {
            min: self.bounds.min - self.margin,
            max: self.bounds.max + self.margin,
        };
        BuildPrimitive::new(self.id, bounds)
    }

    /// Divides the part in the middle of the longest edge of its box. `None` if it is too small.
    fn halves(&self) -> Option<[Part; 2]> {
        let e = self.bounds.extent();
        let axis = if e.x >= e.y && e.x >= e.z {
            0
        } else if e.y >= e.z {
            1
        } else {
            2
        };
        let middle = self.bounds.centroid()[axis];
        if e[axis] <= 4.0 * self.margin || !(self.bounds.min[axis] < middle) {
            return None;
        }
        let (mut below, mut above) = (Vec::new(), Vec::new());
        let mut previous = *self.polygon.last()?;
        for &p in &self.polygon {
            let (from, to) = (previous[axis] - middle, p[axis] - middle);
            if from * to < 0.0 {
                let mut crossing = previous + (p - previous) * (from / (from - to));
                crossing[axis] = middle;
                below.push(crossing);
                above.push(crossing);
            }
            if to <= 0.0 {
                below.push(p);
            }
            if to >= 0.0 {
                above.push(p);
            }
            previous = p;
        }
        Some([below, above].map(|polygon| Part::new(self.id, polygon, self.margin)))
    }

    /// What dividing the part can gain.
    fn excess(&self) -> f64 {
        self.area - self.tight_area
    }
}

/// The part with the largest excess comes first. The order is total, so that the tree is always the
/// same.
impl Ord for Part {
    fn cmp(&self, other: &Part) -> Ordering {
        let by_excess = self.excess().total_cmp(&other.excess());
        by_excess.then_with(|| other.id.cmp(&self.id))
    }
}

impl PartialOrd for Part {
    fn partial_cmp(&self, other: &Part) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Part {
    fn eq(&self, other: &Part) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Part {}

fn bounds_of(points: &[Vec3]) -> Aabb {
    Aabb {
        min: points.iter().copied().fold(Vec3::INFINITY, Vec3::min),
        max: points.iter().copied().fold(Vec3::NEG_INFINITY, Vec3::max),
    }
}
// END SOLUTION(part6.task1)
