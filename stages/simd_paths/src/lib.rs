//! Part 6, task 2 (extra credit): path tracing in packets of eight paths.
//!
//! There are no further hints than these: [`PathScene`] documents what to compute, the stages
//! `direct` and `global` how. The pictures have to be theirs, bit for bit. In a scene with few
//! primitives, most of the time is spent on shading and sampling, not on the tree.
//!
// BEGIN SOLUTION(part6.task2)
//! Reading order: `scene` and `fallback` (the interface), `vec3x8`, `ray_packet` and `lane_mask`
//! (eight vectors, eight rays, lane masks), `visible` (pixels in which there is something),
//! `camera`, `queue` and `trace` (the paths of a batch, and how idle lanes are avoided), `packet`
//! (one bounce), `intersection` and `primitive_list` (with and without a tree), `large` (walls
//! around a tree), `beam` (rays that are close to each other), `surface_packet` and
//! `material_class` (what was hit), `light`, `shadow_queue`, `sin_cos` and `diffuse` (direct light
//! and scattering at diffuse surfaces), `columns` and `bsdf_rays` (multiple importance sampling),
//! `specular` (mirrors and smooth glass), `caustic_guide`
//! and `caustics` (light behind these), `other_materials` (everything else, by the fallback).
//!
//! The formulas are those of the crate `lanes`, which performs the operations of the stages in the
//! same order, so all bits are equal. What is here decides which lanes compute what. Where a scalar
//! kernel switches to its careful variant, the lane calls the fallback. `fearless_simd`
//! compiles the code for each instruction set; the best one that the machine has is chosen once a
//! batch. Only inlined functions are compiled so, and a closure may not be inlined: hence few of
//! them. What is long or used in several places is a function of its own, `#[inline(never)]`, whose
//! body is in `Simd::vectorize`: it is compiled once for each instruction set. As one function,
//! all of it took more than ten times as long to compile, and paths took 3 % less time.
// STUB: //! Use `fearless_simd`; its `dispatch!` selects the instruction set once a batch. The crate
// STUB: //! `lanes` has vectors and rays of eight lanes.
// END SOLUTION(part6.task2)

// BEGIN SOLUTION(part6.task2)
mod beam;
mod bsdf_rays;
mod camera;
mod caustics;
mod columns;
mod diffuse;
mod intersection;
mod lane_mask;
mod large;
mod light;
mod material_class;
mod other_materials;
mod packet;
mod primitive_list;
mod queue;
mod ray_packet;
mod reuse;
mod samplers;
mod shadow_queue;
mod sin_cos;
mod specular;
mod surface_packet;
mod trace;
mod vec3x8;
mod visible;
// END SOLUTION(part6.task2)

mod caustic_guide;
mod fallback;
mod scene;

pub use caustic_guide::{CausticGuide, Landing, Lobes, MAX_CAUSTIC_RAYS};
pub use fallback::{Beam, HALF_SPACES, HalfSpace, NextRay, ScalarFallback, ScalarPath};
pub use fearless_simd::Level;
pub use scene::{BATCH_SIZE, Counts, PathMemory, PathScene, PathSettings, PathStart, View};
