//! Part 2, tasks 1 and 3: building and walking the tree.

use kit::{Aabb, Bvh, Hit, Ray, World};

/// Task 1.
pub fn construct_bvh(bounds: &[Aabb], max_leaf_size: usize) -> Bvh {
    kit::hole!("part2.task1", bounds, max_leaf_size)
}

/// Task 3.
pub fn intersect_bvh<W: World>(bvh: &Bvh, ray: &mut Ray, world: &mut W) -> Option<Hit> {
    kit::hole!("part2.task3", bvh, ray, world)
}

/// Task 3.
pub fn occludes_bvh<W: World>(bvh: &Bvh, ray: &Ray, world: &mut W) -> bool {
    kit::hole!("part2.task3", bvh, ray, world)
}
