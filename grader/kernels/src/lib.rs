//! Well-known intersection tests and tree builders, one per file. `grader cost` compares them.
//!
//! Every kernel is generic over its number type. Run on `f32` and `f64` it shows the cost and the
//! accuracy of each precision; run on [`CountingF64`] it counts its operations. Read [`Scalar`]
//! (the number types), [`kernel`] (the kernel interface), [`instructions`] (with and without fused
//! multiply-add), then the kernels:
//!
//! - `triangle`: Möller-Trumbore (plain, with the usual epsilon, culling), plane then sides,
//!   Baldwin-Weber, Plücker, Woop, Woop with fused edges (everywhere, at zero), a filter with an
//!   exact fallback
//! - `sphere`: the quadratic formula, its q form, Haines's discriminant; each with and without
//!   reprojection
//! - `bbox`: naive slabs, NaN-safe slabs, Williams, Ize
//! - `build`: trees split at the midpoint, at the median, and by the surface area heuristic
//! - `traversal`: closest hits through a tree, with a choice of pruning slack
//! - `rounded_tree`: the same in single and double precision, with the tests that others use
//!
//! A handout does not contain the kernels that solve one of its tasks.

mod counting;
pub mod instructions;
pub mod kernel;
pub mod shapes;
pub mod tree;

// BEGIN SOLUTION(part1.task3)
pub mod exact;
mod triangle;
// END SOLUTION(part1.task3)

// BEGIN SOLUTION(part1.task4)
mod sphere;
// END SOLUTION(part1.task4)

// BEGIN SOLUTION(part2.task2)
mod bbox;
// END SOLUTION(part2.task2)

// BEGIN SOLUTION(part2.task1)
mod build;
// END SOLUTION(part2.task1)

// BEGIN SOLUTION(part2.task3)
mod rounded_tree;
mod traversal;
// END SOLUTION(part2.task3)

pub use counting::{CountingF64, OperationCounts};
pub use instructions::Instructions;
pub use kernel::{HitF64, Kernel, Pass, RayAndShapes};
pub use lanes::{Precision, Scalar};
pub use tree::{Builder, ClosestHit, RoundedTree, Traversal, brute_force, rounded_trees};

/// Returns the triangle tests, the textbook's in `f64` first; empty in a handout in which they
/// would be a solution.
pub fn triangles() -> Vec<Kernel<kit::Triangle, HitF64>> {
    // BEGIN SOLUTION(part1.task3)
    triangle::kernels()
    // STUB: Vec::new()
    // END SOLUTION(part1.task3)
}

/// Returns the sphere tests, the textbook's in `f64` first; empty in a handout in which they would
/// be a solution.
pub fn spheres() -> Vec<Kernel<kit::Sphere, HitF64>> {
    // BEGIN SOLUTION(part1.task4)
    sphere::kernels()
    // STUB: Vec::new()
    // END SOLUTION(part1.task4)
}

/// Returns the box tests, the textbook's in `f64` first; empty in a handout in which they would be
/// a solution.
pub fn boxes() -> Vec<Kernel<kit::Aabb, kit::Interval>> {
    // BEGIN SOLUTION(part2.task2)
    bbox::kernels()
    // STUB: Vec::new()
    // END SOLUTION(part2.task2)
}

/// Returns the tree builders, the simplest first; empty in a handout in which they would be a
/// solution.
pub fn builders() -> Vec<Builder> {
    // BEGIN SOLUTION(part2.task1)
    build::builders()
    // STUB: Vec::new()
    // END SOLUTION(part2.task1)
}
