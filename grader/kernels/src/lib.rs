//! Well-known ray tests and trees, small and plain, a file each, side by side. `grader cost` compares them.
//!
//! Every kernel is written once, for numbers of any kind: run on `f32` and on `f64` it shows what they cost and give,
//! run on [`Counted`] how much it computes. Read [`real`] (what a number is), [`kernel`] (what a kernel is), then
//! the kernels:
//!
//! - `triangle`: Möller-Trumbore (plain, with the usual epsilon, culling), plane then sides, Baldwin-Weber, Plücker,
//!   Woop, Woop with fused edges (everywhere, at zero), a filter with an exact fallback
//! - `sphere`: the quadratic formula, its q form, Haines's discriminant; each with and without reprojection
//! - `bbox`: naive slabs, NaN-safe slabs, Williams, Ize
//! - `build`: trees split at the midpoint, at the median, and by the surface area heuristic
//! - `walk`: closest hits through a tree, with a choice of slack
//!
//! In a handout those are missing that solve a task of its own.

mod counted;
pub mod kernel;
pub mod real;
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
mod walk;
// END SOLUTION(part2.task3)

pub use counted::{Count, Counted};
pub use kernel::{Bundle, Found, Kernel, Pass};
pub use real::{Precision, Real};
pub use tree::{Builder, Closest, Walker, brute_force};

/// The triangle tests, the textbook's in double first; none where they would give a task away.
pub fn triangles() -> Vec<Kernel<kit::Triangle, Found>> {
    // BEGIN SOLUTION(part1.task3)
    triangle::kernels()
    // STUB: Vec::new()
    // END SOLUTION(part1.task3)
}

/// The sphere tests, the textbook's in double first; none where they would give a task away.
pub fn spheres() -> Vec<Kernel<kit::Sphere, Found>> {
    // BEGIN SOLUTION(part1.task4)
    sphere::kernels()
    // STUB: Vec::new()
    // END SOLUTION(part1.task4)
}

/// The box tests, the textbook's in double first; none where they would give a task away.
pub fn boxes() -> Vec<Kernel<kit::Aabb, kit::Interval>> {
    // BEGIN SOLUTION(part2.task2)
    bbox::kernels()
    // STUB: Vec::new()
    // END SOLUTION(part2.task2)
}

/// The ways to build a tree, the simplest first; none where they would give a task away.
pub fn builders() -> Vec<Builder> {
    // BEGIN SOLUTION(part2.task1)
    build::builders()
    // STUB: Vec::new()
    // END SOLUTION(part2.task1)
}
