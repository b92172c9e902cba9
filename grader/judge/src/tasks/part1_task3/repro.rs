//! Rust tests of triangles.

use crate::tools::repro::hits::{asserts, triangle_literal};
use crate::tools::repro::numbers::ray;
use crate::tools::{Tier, convert, truth};
use std::fmt::Write;
use wire::work::{Probe, TriangleWork};

/// A test of both functions with one probe; `None` where either answer scores.
pub(crate) fn triangle(tier: Tier, work: &TriangleWork, probe: &Probe) -> Option<String> {
    let vertices = work.triangles.get(probe.shape as usize)?;
    let shape = convert::triangle(vertices);
    let expected = truth::triangle(tier, probe.shape, &shape, &convert::ray(&probe.ray));
    let mut text = String::from("use kit::{PrimId, Ray, Triangle, Vec3};\n");
    let _ = writeln!(text, "let tri = {};", triangle_literal(vertices));
    ray(&mut text, &probe.ray);
    let test = "intersect::test_triangle(&tri, &ray)";
    let arguments = format!("&tri, PrimId({}), &mut after", probe.shape);
    let second = match work.by_record {
        true => format!("{test}.map(|hit| intersect::record_triangle({arguments}, hit))"),
        false => format!("intersect::intersect_triangle({arguments})"),
    };
    asserts(&mut text, &expected, test, &second, probe.shape, &probe.ray)?;
    Some(text)
}
