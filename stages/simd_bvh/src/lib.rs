//! Part 6, task 1 (extra credit): a wide bounding volume hierarchy that tests eight boxes or eight
//! triangles at a time.
//!
//! There are only these hints: [`WideBvh`] documents what to compute, and the earlier stages show
//! how. The speed is up to you: in a checkout of the whole course, `cargo bench -p timings --bench
//! simd_bvh` compares your tree with that of stage `bvh`.
//!
// BEGIN SOLUTION(part6.task1)
//! Reading order: `wide`, `intersect`, `stream` and `ray_tile` (the tree, and how rays are traced),
//! `build` (from primitives to the tree), `layout` (the memory layout of boxes, triangles and
//! spheres), `kernels` (one ray against eight boxes or triangles), `one_ray`, `many_rays` and
//! `tile` (the traversals). Each folder's `mod.rs` has its own reading order.
//!
//! The tree is fast and exact. Boxes are single precision and rounded outwards. Triangles have 16
//! bits a coordinate and are tested in single precision, with a bound on all errors that
//! `kernels::triangle_filter` proves. A triangle is missed for certain, hit for certain, or
//! undecided.
//!
//! Only the hits are computed in double precision, with the scalar kernel's arithmetic. Where the
//! scalar kernel switches to its careful variant, this variant is called. So the hits are those of
//! brute force, bit for bit. The source is the same for every machine: `fearless_simd` compiles it
//! for each instruction set, and the best one that the machine has is chosen once per ray.
// STUB: //! Use `fearless_simd`; its `dispatch!` selects the instruction set once a ray.
// END SOLUTION(part6.task1)

// BEGIN SOLUTION(part6.task1)
mod build;
mod kernels;
mod layout;
mod many_rays;
mod one_ray;
mod rounding;
mod tile;
// END SOLUTION(part6.task1)

mod intersect;
mod ray_tile;
mod stream;
mod wide;

pub use fearless_simd::Level;
pub use intersect::{ExactTest, TestCounts};
pub use ray_tile::{RayTile, TileEnds, TileMemory};
pub use stream::StreamMemory;
pub use wide::{Subset, WideBvh};

/// The earlier name of [`TestCounts`], which programs outside this workspace use.
pub use intersect::TestCounts as Work;
