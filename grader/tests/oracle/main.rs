//! The oracle against plain rationals, against kernels that are known to be right, and against
//! the hard cases.

mod rationals;
mod rays;

mod boxes;
mod spheres;
mod triangles;
