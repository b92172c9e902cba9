//! The exact oracle: what a ray truly hits.
//!
//! A kernel in floating point answers nearly right; to grade it takes something that answers
//! right. Every finite `f64` is an integer times a power of two, and deciding a hit takes only
//! sums and products of such numbers, so integers of any length decide it without an error at
//! all: tiny, huge, denormal, grazing. A cheap test in `f64` with an error bound comes first
//! and settles the rays that miss by a mile (a *filter*; Shewchuk, *Adaptive Precision
//! Floating-Point Arithmetic and Fast Robust Geometric Predicates*, 1997).
//!
//! # Four verdicts
//!
//! *Hit* and *miss*; *exact boundary*, a ray through an edge, a vertex, a tangent point or an
//! end of its own range, where the course's convention decides (they count); and *undecidable
//! in `f64`*, where the exact answer is known but hangs on a number so close to zero that
//! correct code may round it to either side. There, either answer scores. How close is derived
//! from what the code rounds, twice: for the formulas of a textbook and for a robust kernel
//! ([`Kernel`]). Rays whose arithmetic rounds nowhere, such as small integers along an axis,
//! are never undecidable: on them the boundary itself can be graded.
//!
//! # Reading order
//!
//! 1. `dyadic`, [`real`]: exact numbers, and numbers good to 126 bits.
//! 2. `roundoff`: what one rounding costs, and where `f64` runs out of exponents.
//! 3. [`verdict`]: what the oracle says, and how an answer is judged by it.
//! 4. [`triangle`](mod@triangle), `triangle_error`; [`sphere`](mod@sphere), `sphere_error`;
//!    [`bbox`](mod@bbox): the decision, and how far off correct code may be.
//! 5. [`near`](mod@near): a filter; [`closest`](mod@closest): many primitives, and ties.
//! 6. [`surface`]: the hit point and its normals.

mod dyadic;
mod roundoff;
mod sphere_error;
mod triangle_error;

pub mod bbox;
pub mod closest;
pub mod near;
pub mod real;
pub mod sphere;
pub mod surface;
pub mod triangle;
pub mod verdict;

pub use bbox::{BoxJudgement, BoxVerdict, bbox};
pub use closest::{Closest, any, closest};
pub use near::{may_touch, near};
pub use real::{Real, ulps};
pub use sphere::{SphereClass, SphereVerdict, sphere};
pub use surface::{NormalTruth, PointTruth};
pub use triangle::{TriangleClass, TriangleVerdict, triangle};
pub use verdict::{Answers, Candidate, Judgement, Kernel, Miss, PerKernel};
