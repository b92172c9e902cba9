//! Part 2, tasks 1 and 3: a bounding volume hierarchy, so that a ray is tested against few
//! primitives instead of all.
//!
//! Reading order: `kit::bvh` (the tree as data), [`construct`] (task 1, construction), `kit::world`
//! (the tests that a traversal calls) and [`traverse`] (task 3, traversal).

pub mod construct;
pub mod traverse;

pub use construct::construct_bvh;
pub use traverse::{intersect_bvh, occludes_bvh};
