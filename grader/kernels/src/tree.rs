//! Tree builders and traversal: the public interface.

use kit::{Aabb, Bvh, PrimId, Ray, Triangle};
use lanes::Precision;

/// A tree builder.
#[derive(Clone, Copy)]
pub struct Builder {
    /// How a node is split.
    pub name: &'static str,
    /// The publication.
    pub paper: &'static str,
    /// Builds the tree over the bounds of the primitives `0..n`. The second argument is the largest
    /// number of primitives in a leaf.
    pub build: fn(&[Aabb], usize) -> Bvh,
}

/// The closest hit: `t` and primitive. Of hits with equal `t`, the one with the lowest id.
pub type ClosestHit = Option<(f64, PrimId)>;

/// Tree traversal with Ize's box test and Woop's triangle test, in `f64`.
#[derive(Clone, Debug, Default)]
pub struct Traversal {
    /// Slack of the pruning: boxes are skipped if they start behind the closest hit so far by more
    /// than this number of units in the last place.
    pub slack_ulp: u32,
    /// Box tests so far.
    pub box_tests: u64,
    /// Triangle tests so far.
    pub prim_tests: u64,
    /// The stack: nodes to visit, and the `t` at which the ray enters them; empty between rays.
    pub stack: Vec<(u32, f64)>,
}

impl Traversal {
    /// Creates a traversal with its counters at 0.
    pub fn new(slack_ulp: u32) -> Traversal {
        Traversal {
            slack_ulp,
            ..Traversal::default()
        }
    }

    /// Returns the closest hit through the tree; `None` in a handout in which this would be a
    /// solution.
    pub fn closest(&mut self, bvh: &Bvh, triangles: &[Triangle], ray: &Ray) -> ClosestHit {
        // BEGIN SOLUTION(part2.task3)
        crate::traversal::closest(self, bvh, triangles, ray)
        // STUB: let _ = (bvh, triangles, ray);
        // STUB: None
        // END SOLUTION(part2.task3)
    }
}

/// Returns the closest hit by testing every triangle: the reference for the traversal.
pub fn brute_force(triangles: &[Triangle], ray: &Ray) -> ClosestHit {
    // BEGIN SOLUTION(part2.task3)
    crate::traversal::brute_force(triangles, ray)
    // STUB: let _ = (triangles, ray);
    // STUB: None
    // END SOLUTION(part2.task3)
}

/// A tree whose boxes and triangles are stored and tested in one precision.
pub struct RoundedTree<'a> {
    /// Name of the box test.
    pub box_test: &'static str,
    /// Name of the triangle test.
    pub triangle_test: &'static str,
    /// What boxes, triangles and rays are stored and computed in.
    pub precision: Precision,
    /// Slack of the pruning, in units in the last place of the precision.
    pub slack_ulp: u32,
    /// Returns the closest hit of a ray.
    pub closest: Box<dyn FnMut(&Ray) -> ClosestHit + 'a>,
}

/// Returns `bvh` over `triangles` with different tests and precisions, the exact one first; empty in
/// a handout in which these would be a solution.
pub fn rounded_trees<'a>(bvh: &'a Bvh, triangles: &[Triangle]) -> Vec<RoundedTree<'a>> {
    // BEGIN SOLUTION(part2.task3)
    crate::rounded_tree::trees(bvh, triangles)
    // STUB: let _ = (bvh, triangles);
    // STUB: Vec::new()
    // END SOLUTION(part2.task3)
}
