//! Splits at the middle of the centroid bounds, on their longest axis. One pass over the primitives
//! per node.
//!
//! A. Glassner, "Space Subdivision for Fast Ray Tracing", IEEE Computer Graphics and Applications
//! 4(10), 1984, halves space in this way; the assignment recommends it for trees.

use super::primitive::{BuildPrimitive, centroid_bounds, partition};

pub(super) fn split(primitives: &mut [BuildPrimitive]) -> usize {
    let centroids = centroid_bounds(primitives);
    let axis = centroids.extent().max_position();
    let middle = centroids.centroid()[axis];
    partition(primitives, |primitive| primitive.centroid[axis] < middle)
}
