//! The oracle against plain rationals, against kernels that are known to be right, and against
//! the hard cases.

mod kernels;
mod rationals;
mod rays;

mod boxes;
mod fairness;
mod hard_cases;
mod many;
mod spheres;
mod triangles;
