// BEGIN SOLUTION(part2.task1)
//! The middle of the centroids' box, on its longest axis: space in half. It looks at no primitive twice.
//!
//! A. Glassner, "Space Subdivision for Fast Ray Tracing", IEEE Computer Graphics and Applications 4(10), 1984, halves
//! space so; the assignment recommends it for trees.

use super::{Item, around_centroids, partition};

pub(super) fn split(items: &mut [Item]) -> usize {
    let centroids = around_centroids(items);
    let axis = centroids.extent().max_position();
    let middle = centroids.centroid()[axis];
    partition(items, |item| item.centroid[axis] < middle)
}
// END SOLUTION(part2.task1)
