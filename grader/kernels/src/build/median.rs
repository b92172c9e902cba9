// BEGIN SOLUTION(part2.task1)
//! As many primitives on either side, in order along the longest axis of the centroids' box: the flattest tree, which is
//! not the cheapest one to walk.
//!
//! T. Kay, J. Kajiya, "Ray Tracing Complex Scenes", SIGGRAPH 1986.

use super::{Item, around_centroids};

pub(super) fn split(items: &mut [Item]) -> usize {
    let axis = around_centroids(items).extent().max_position();
    let middle = items.len() / 2;
    items.select_nth_unstable_by(middle, |a, b| {
        let along = a.centroid[axis].total_cmp(&b.centroid[axis]);
        along.then(a.id.cmp(&b.id))
    });
    middle
}
// END SOLUTION(part2.task1)
