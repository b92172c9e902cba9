//! Part 6, the summit: a tree that is walked eight boxes and eight triangles at a time.
//!
//! Extra credit, and no more hints than this: [`WideBvh`] says what it has to do, the stages before it how; how fast is
//! up to you. `cargo bench -p simd_bvh` measures it against the tree of stage `bvh`.
//!
// BEGIN SOLUTION(part6.task1)
//! Read in this order: `sah` and `binary` (the binary tree that is cheapest), `collapse` and `wide` (made eight wide),
//! `space`, `node`, `block` and `sphere_block` (how boxes, triangles and spheres lie in memory), `probe` and `lanes` (one
//! box, eight boxes at once), `stack`, `search` and `traverse` (the walk).
//!
//! Fast and exact at the same time: boxes are single precision and only ever too large; triangles are double precision,
//! by the very arithmetic of the plain kernel, and where that one thinks twice it is asked. So the hits are those of
//! asking every primitive, bit for bit. All of it is written once for every machine: `fearless_simd` compiles it for
//! each instruction set, and the best that the machine has is chosen once a walk.
// STUB: //! `fearless_simd` is there for the lanes; its `dispatch!` chooses the machine's instructions once a walk.
// END SOLUTION(part6.task1)

// BEGIN SOLUTION(part6.task1)
mod binary;
mod block;
mod collapse;
mod lanes;
mod node;
mod probe;
mod sah;
mod search;
mod space;
mod sphere_block;
mod stack;
// END SOLUTION(part6.task1)

mod traverse;
mod wide;

pub use fearless_simd::Level;
pub use traverse::Work;
pub use wide::WideBvh;
