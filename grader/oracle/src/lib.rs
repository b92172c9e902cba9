//! The exact oracle: decides what a ray hits.
//!
//! A floating-point kernel is only approximately right; to grade it, the exact answer is needed.
//! Every finite `f64` is an integer times a power of two, and deciding a hit takes only sums and
//! products of such numbers. Integers of arbitrary length therefore decide every ray exactly: tiny,
//! huge, denormal, grazing.
//!
//! A cheap test in `f64` with an error bound comes first and rejects the rays that clearly miss (a
//! *filter*; Shewchuk, *Adaptive Precision Floating-Point Arithmetic and Fast Robust Geometric
//! Predicates*, 1997).
//!
//! # Four verdicts
//!
//! 1. *Hit*.
//! 2. *Miss*.
//! 3. *Exact boundary*: the ray passes through an edge, a vertex or a tangent point, or `t` is an
//!    end of its range. The course's convention decides: these count as hits.
//! 4. *Undecidable in `f64`*: the exact answer is known, but it depends on a number so close to
//!    zero that correct code may round it to either side. Either answer scores.
//!
//! How close is derived from the roundings in two classes of code: textbook formulas and a robust
//! kernel ([`KernelClass`]). A ray for which nothing is rounded, such as one with small integers
//! along an axis, is never undecidable: on such rays the boundary itself can be graded.
//!
//! # Reading order
//!
//! 1. `dyadic`, [`big_float`]: exact numbers, and numbers with 126 bits.
//! 2. `roundoff`: the error of one rounding, and the exponents that `f64` can represent.
//! 3. [`verdict`]: the oracle's result, and how an answer is judged by it.
//! 4. [`triangle`](mod@triangle), `triangle_error`; [`sphere`](mod@sphere), `sphere_error`;
//!    [`bbox`](mod@bbox): the exact decision, and the error bounds of correct code.
//! 5. [`near`](mod@near): a filter for many shapes; [`closest`](mod@closest): many primitives, and
//!    ties.
//! 6. [`surface`]: the hit point and its normals.

mod dyadic;
mod roundoff;
mod sphere_error;
mod triangle_error;

pub mod bbox;
pub mod big_float;
pub mod closest;
pub mod near;
pub mod sphere;
pub mod surface;
pub mod triangle;
pub mod verdict;

pub use bbox::{BoxJudgement, BoxVerdict, bbox};
pub use big_float::{BigFloat, ulps};
pub use closest::{Closest, any, closest};
pub use near::{Shapes, may_touch};
pub use sphere::{SphereClass, SphereVerdict, sphere};
pub use surface::{NormalTruth, PointTruth};
pub use triangle::{PlaneCrossing, TriangleClass, TriangleVerdict, plane_crossing, triangle};
pub use verdict::{Answers, Candidate, Judgement, KernelClass, Miss, PerKernel};
