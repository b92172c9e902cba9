//! Part 1, tasks 3 and 4: ray/triangle and ray/sphere intersection.
//!
//! Read [`triangle`], then [`sphere`]. Each has a test, which returns the distance along the ray,
//! and a function that records the hit and shortens the ray. Both follow the same conventions:
//!
//! - The ends of the ray's range count.
//! - Both sides of a surface are hit.
//! - `d` need not have unit length.
//! - A miss changes nothing.
//! - A ray or a shape with a NaN or an infinite coordinate is a miss, and so is a ray with `d = 0`.

// BEGIN SOLUTION(part1.task3)
mod exact;
pub mod rounding;
// END SOLUTION(part1.task3)

pub mod sphere;
pub mod triangle;

pub use sphere::{intersect_sphere, test_sphere};
pub use triangle::{intersect_triangle, record_triangle, test_triangle};
