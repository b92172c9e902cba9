//! The primitives of a node, which a split partitions.

use kit::{Aabb, PrimId, Vec3};

/// A primitive during construction.
#[derive(Clone, Copy)]
pub(super) struct BuildPrimitive {
    pub(super) id: PrimId,
    pub(super) bounds: Aabb,
    pub(super) centroid: Vec3,
}

/// Returns the bounds of the primitives' centroids.
pub(super) fn centroid_bounds(primitives: &[BuildPrimitive]) -> Aabb {
    Aabb::of(primitives.iter().map(|primitive| primitive.centroid))
}

/// Partitions the primitives by `goes_left`; returns the number of left ones.
pub(super) fn partition(
    primitives: &mut [BuildPrimitive],
    goes_left: impl Fn(&BuildPrimitive) -> bool,
) -> usize {
    let mut left = 0;
    for i in 0..primitives.len() {
        if goes_left(&primitives[i]) {
            primitives.swap(i, left);
            left += 1;
        }
    }
    left
}
