//! Part 6, task 1 (extra credit): a wide bounding volume hierarchy that tests eight boxes or eight
//! triangles at a time.
//!
//! There are no further hints than these: [`WideBvh`] documents what to compute, the stages before
//! it how; the speed is up to you. `cargo bench -p simd_bvh` compares it with the tree of stage
//! `bvh`.
//!
// BEGIN SOLUTION(part6.task1)
//! Reading order: `builder` (from triangles to the tree), `packed_box` (boxes during the build),
//! `presplit` (long thin triangles), `large` (walls), `sah` and `binary` (the binary tree of least
//! cost), `collapse` and `widen` (from two to eight children per node), `space`, `node`,
//! `triangle_block` and `sphere_block` (the memory layout of boxes, triangles and spheres),
//! `ray_in_tree`, `simd_box_test` (eight boxes at a time), `triangle_filter` (eight triangles at a
//! time) and `woop` (one triangle, in double precision), `stack`, `traversal` and `intersect` (the
//! traversal by one ray), `stream`, `stream_traversal`, `slot_queue`, `ray_slot` and `slot_stack`
//! (the traversal by many rays together), `box_test` and `unusual_ray` (rays that are too large,
//! too small or too far away for single precision), `region` (the primitives that many rays may
//! hit).
//!
//! The tree is fast and exact. Boxes are single precision and rounded outwards. Triangles have 16
//! bits a coordinate and are tested in single precision, with a bound on all errors, which
//! `triangle_filter` proves: a triangle is missed for certain, hit for certain, or undecided. Only
//! the hits are computed in double precision, with the scalar kernel's arithmetic; where that
//! kernel switches to its careful variant, it is called. So the hits are those of brute force, bit
//! for bit. The source is the same for every machine: `fearless_simd` compiles it for each
//! instruction set, and the best one that the machine has is chosen once per ray.
// STUB: //! Use `fearless_simd`; its `dispatch!` selects the instruction set once a ray.
// END SOLUTION(part6.task1)

// BEGIN SOLUTION(part6.task1)
mod binary;
mod box_test;
mod builder;
mod collapse;
mod found;
mod large;
mod node;
mod packed_box;
mod prefetch;
mod presplit;
mod ray_in_tree;
mod ray_slot;
mod region;
mod rounding;
mod sah;
mod simd_box_test;
mod slot_queue;
mod slot_stack;
mod space;
mod sphere_block;
mod stack;
mod stream_traversal;
mod traversal;
mod triangle_block;
mod triangle_filter;
mod unusual_ray;
mod widen;
mod woop;
// END SOLUTION(part6.task1)

mod intersect;
mod stream;
mod wide;

pub use fearless_simd::Level;
pub use intersect::{ExactTest, TestCounts};
pub use stream::StreamMemory;
pub use wide::{Subset, WideBvh};

/// The earlier name of [`TestCounts`], which programs outside this workspace use.
pub use intersect::TestCounts as Work;
