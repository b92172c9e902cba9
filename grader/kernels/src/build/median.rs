//! Splits at the median: half of the primitives on either side, ordered along the longest axis of
//! the centroid bounds. This gives the shallowest tree, but not the one with the cheapest
//! traversal.
//!
//! T. Kay, J. Kajiya, "Ray Tracing Complex Scenes", SIGGRAPH 1986.

use super::primitive::{BuildPrimitive, centroid_bounds};

pub(super) fn split(primitives: &mut [BuildPrimitive]) -> usize {
    let axis = centroid_bounds(primitives).extent().max_position();
    let middle = primitives.len() / 2;
    primitives.select_nth_unstable_by(middle, |a, b| {
        let along = a.centroid[axis].total_cmp(&b.centroid[axis]);
        along.then(a.id.cmp(&b.id))
    });
    middle
}
