//! Formulas that are written once and computed with one number or with eight at a time.
//!
//! Reading order: [`real`] (the numbers: `f32`, `f64`, those of `wide`), `scalar` (what single
//! numbers have in addition), `vec3` and `shapes` (vectors, rays, triangles, spheres).
// BEGIN SOLUTION(part6.task2)
//! Then the formulas: `camera`, `triangle`, `sphere`, `record` and `surface` (rays, hits and the
//! step off a surface), `frame`, `light`, `mis`, `sin_cos`, `diffuse`, `specular` and `roulette`.
// END SOLUTION(part6.task2)
//!
//! A stage computes with plain `f64`. What Part 6 computes in lanes and what `kernels` compares in
//! several precisions is generic over [`Real`]; no formula is written for one width. Everything is
//! `#[inline(always)]`, and no formula contains a closure: `fearless_simd` compiles only inlined
//! code for an instruction set.

mod instruction_sets;
pub mod real;
mod scalar;
mod shapes;
mod vec3;
mod wide;

// BEGIN SOLUTION(part6.task2)
pub mod camera;
pub mod diffuse;
pub mod frame;
pub mod light;
pub mod mis;
pub mod record;
pub mod roulette;
pub mod sin_cos;
pub mod specular;
pub mod surface;
// END SOLUTION(part6.task2)

// BEGIN SOLUTION(part1.task4)
pub mod sphere;
// END SOLUTION(part1.task4)

// BEGIN SOLUTION(part1.task3)
// The kernels of every width decide alike: one file has the bounds.
#[path = "../../intersect/src/rounding.rs"]
pub mod rounding;
pub mod triangle;
// END SOLUTION(part1.task3)

pub use instruction_sets::instruction_sets;
pub use real::{Mask, Real};
pub use scalar::{Precision, Scalar};
pub use shapes::{Ray, Sphere, Triangle};
pub use vec3::Vec3;
