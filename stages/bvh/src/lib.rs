//! Part 2, tasks 1 and 3: a tree of boxes, so that a ray meets few primitives instead of all.
//!
//! Read in this order: `kit::bvh` (what a tree is), [`construct`] (task 1, how it is built), `kit::world` (what
//! a traversal may ask) and [`traverse`] (task 3, how a ray walks it).

pub mod construct;
pub mod traverse;

pub use construct::construct_bvh;
pub use traverse::{intersect_bvh, occludes_bvh};
