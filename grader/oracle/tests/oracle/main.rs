//! Tests the oracle against rational arithmetic, against kernels that are known to be correct, and
//! on the hard cases.

mod kernels;
mod rationals;
mod rays;

mod boxes;
mod fairness;
mod hard_cases;
mod many;
mod spheres;
mod triangles;
