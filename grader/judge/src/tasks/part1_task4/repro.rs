//! Rust tests of spheres.

use crate::tools::repro::hits::{asserts, sphere_literal};
use crate::tools::repro::numbers::ray;
use crate::tools::{Tier, convert, truth};
use std::fmt::Write;
use wire::work::{Probe, Xyz};

/// A test of both functions with one probe; `None` where either answer scores.
pub(crate) fn sphere(tier: Tier, spheres: &[(Xyz, f64)], probe: &Probe) -> Option<String> {
    let numbers = spheres.get(probe.shape as usize)?;
    let shape = convert::sphere(numbers);
    let expected = truth::sphere(tier, probe.shape, &shape, &convert::ray(&probe.ray));
    let mut text = String::from("use kit::{PrimId, Ray, Sphere, Vec3};\n");
    let _ = writeln!(text, "let s = {};", sphere_literal(numbers));
    ray(&mut text, &probe.ray);
    asserts(
        &mut text,
        &expected,
        "intersect::test_sphere(&s, &ray)",
        &format!(
            "intersect::intersect_sphere(&s, PrimId({}), &mut after)",
            probe.shape
        ),
        probe.shape,
        &probe.ray,
    )?;
    Some(text)
}
