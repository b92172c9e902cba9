//! One ray against boxes and primitives. Reading order: `ray_in_tree`, `simd_box_test` (eight boxes at
//! a time), `triangle_filter` (eight triangles at a time), `woop` (one triangle, in double
//! precision), `found` (the closest hit so far), `box_test` (rays beyond single precision), `fused`
//! (a product and a sum with one rounding).

pub(crate) mod box_test;
pub(crate) mod found;
pub(crate) mod fused;
pub(crate) mod ray_in_tree;
pub(crate) mod simd_box_test;
pub(crate) mod triangle_filter;
pub(crate) mod woop;
