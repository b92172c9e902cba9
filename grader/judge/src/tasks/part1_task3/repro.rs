//! Rust tests of triangles.

use crate::tools::repro::hits::{asserts, triangle_literal};
use crate::tools::repro::numbers::ray;
use crate::tools::{Tier, convert, truth};
use std::fmt::Write;
use wire::work::{Probe, Xyz};

/// A test of both functions with one probe; `None` where either answer scores.
pub(crate) fn triangle(tier: Tier, triangles: &[[Xyz; 6]], probe: &Probe) -> Option<String> {
    let vertices = triangles.get(probe.shape as usize)?;
    let shape = convert::triangle(vertices);
    let expected = truth::triangle(tier, probe.shape, &shape, &convert::ray(&probe.ray));
    let mut text = String::from("use kit::{PrimId, Ray, Triangle, Vec3};\n");
    let _ = writeln!(text, "let tri = {};", triangle_literal(vertices));
    ray(&mut text, &probe.ray);
    asserts(
        &mut text,
        &expected,
        "intersect::test_triangle(&tri, &ray)",
        "intersect::intersect_triangle(&tri",
        probe.shape,
        &probe.ray,
    )?;
    Some(text)
}
