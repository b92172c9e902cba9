//! Part 6, beyond the summit: light followed along eight paths at a time.
//!
//! Extra credit, and no more hints than this: [`PathScene`] says what it has to do, the stages `direct` and `global` how, and
//! it gives their pictures, bit for bit. With few primitives around most of the time goes into all that is not a tree.
//!
// BEGIN SOLUTION(part6.task2)
//! Read in this order: `scene` and `neighbours` (what there is, and who is asked), `vec3x8`, `rays` and `lanes` (eight vectors,
//! eight rays, and which of them), `camera`, `batch` and `follow` (where paths start, how they lie in memory, and how few
//! lanes stay idle), `eight` (one bounce), `room` (few primitives, asked by eight rays), `surfaces` and `deed` (what was hit), `lamp`,
//! `turn` and `matte` (light, sines, matte surfaces), `special` (mirrors and glass, which are asked of others).
//!
//! Every lane does what the stages do, operation by operation, so no bit is different; where the plain kernels think twice,
//! they are asked. `fearless_simd` compiles it for each instruction set, and the best that the machine has is chosen once
//! a batch. That reaches functions that are inlined, and not closures that are not: hence few of them.
// STUB: //! `fearless_simd` is there for the lanes; its `dispatch!` chooses the machine's instructions once a batch.
// END SOLUTION(part6.task2)

// BEGIN SOLUTION(part6.task2)
mod batch;
mod camera;
mod deed;
mod eight;
mod follow;
mod lamp;
mod lanes;
mod matte;

mod rays;
mod room;
mod special;
mod surfaces;
mod turn;
mod vec3x8;
// END SOLUTION(part6.task2)

mod neighbours;
mod scene;

pub use fearless_simd::Level;
pub use neighbours::{Neighbours, Path};
pub use scene::{BATCH, Counts, PathBatch, PathScene, PathSettings, Start, View};
