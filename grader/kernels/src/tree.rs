//! Trees and walks, as they are seen from outside.

use kit::{Aabb, Bvh, PrimId, Ray, Triangle};

/// A way to build a tree.
#[derive(Clone, Copy)]
pub struct Builder {
    /// Where a node is split.
    pub name: &'static str,
    /// Where it is from.
    pub paper: &'static str,
    /// The tree over the boxes of primitives `0..n`, with leaves of at most so many.
    pub build: fn(&[Aabb], usize) -> Bvh,
}

/// The closest hit: `t` and primitive. Of hits at equal `t` the one with the lowest number.
pub type Closest = Option<(f64, PrimId)>;

/// Walks trees with Ize's boxes and Woop's triangles, in double.
#[derive(Clone, Debug, Default)]
pub struct Walker {
    /// Units in the last place by which the closest hit so far is taken to be farther away, when boxes are skipped.
    pub slack_ulp: u32,
    /// Box tests so far.
    pub box_tests: u64,
    /// Triangle tests so far.
    pub prim_tests: u64,
    /// Nodes to visit later, and where the ray enters them; empty between rays.
    pub later: Vec<(u32, f64)>,
}

impl Walker {
    /// One that has done nothing yet.
    pub fn new(slack_ulp: u32) -> Walker {
        Walker {
            slack_ulp,
            ..Walker::default()
        }
    }

    /// The closest hit through the tree; none at all where it would give a task away.
    pub fn closest(&mut self, bvh: &Bvh, triangles: &[Triangle], ray: &Ray) -> Closest {
        // BEGIN SOLUTION(part2.task3)
        crate::walk::closest(self, bvh, triangles, ray)
        // STUB: let _ = (bvh, triangles, ray);
        // STUB: None
        // END SOLUTION(part2.task3)
    }
}

/// The closest hit by asking every triangle, which is what a walk should find.
pub fn brute_force(triangles: &[Triangle], ray: &Ray) -> Closest {
    // BEGIN SOLUTION(part2.task3)
    crate::walk::brute_force(triangles, ray)
    // STUB: let _ = (triangles, ray);
    // STUB: None
    // END SOLUTION(part2.task3)
}
