//! Rust tests of rays traced through a list of shapes.

use crate::tools::repro::hits::{hit_asserts, sphere_literal, triangle_literal};
use crate::tools::repro::numbers::{ray, unchanged};
use crate::tools::truth::expected::Expected;
use crate::tools::{Tier, convert, truth};
use oracle::Shapes;
use std::fmt::Write;
use wire::work::{Ray, Xyz};

/// The largest number of shapes on the line of a ray in a readable test.
const SHAPES: usize = 6;

/// A test of the closest hit among all shapes that the line of a ray meets, in their order; `None`
/// for triangles and spheres together, and where more than one answer scores.
pub(crate) fn first_of(
    tier: Tier,
    triangles: &[[Xyz; 6]],
    spheres: &[(Xyz, f64)],
    probe: &Ray,
) -> Option<String> {
    let line = Ray {
        min_t: f64::NEG_INFINITY,
        max_t: f64::INFINITY,
        ..*probe
    };
    let line = convert::ray(&line);
    let scene = convert::scene(triangles, spheres);
    let meets = |expected: Expected| !expected.hits.is_empty();
    let (kind, function, met): (&str, &str, Vec<(usize, String)>) = if spheres.is_empty() {
        let each = triangles.iter().zip(&scene.triangles).enumerate();
        let met = each
            .filter(|(_, (_, shape))| meets(truth::triangle(tier, 0, shape, &line)))
            .map(|(id, (numbers, _))| (id, triangle_literal(numbers)));
        ("Triangle", "intersect_triangle", met.collect())
    } else if triangles.is_empty() {
        let each = spheres.iter().zip(&scene.spheres).enumerate();
        let met = each
            .filter(|(_, (_, shape))| meets(truth::sphere(tier, 0, shape, &line)))
            .map(|(id, (numbers, _))| (id, sphere_literal(numbers)));
        ("Sphere", "intersect_sphere", met.collect())
    } else {
        return None;
    };
    let shapes = Shapes::new(scene.primitives());
    let expected = truth::first_of(tier, &shapes, &convert::ray(probe), false);
    if met.is_empty() || met.len() > SHAPES || expected.hits.len() > 1 {
        return None;
    }
    let mut text = format!("use kit::{{PrimId, Ray, {kind}, Vec3}};\n");
    ray(&mut text, probe);
    text.push_str("let shapes = [\n");
    for (id, literal) in &met {
        let _ = writeln!(text, "    ({id}, {literal}),");
    }
    let _ = writeln!(
        text,
        "];\nlet mut after = ray;\nlet mut closest = None;\nfor (id, shape) in &shapes {{"
    );
    let _ = writeln!(
        text,
        "    closest = intersect::{function}(shape, PrimId(*id), &mut after).or(closest);\n}}"
    );
    match expected.hits.first() {
        Some(_) if expected.miss => return None,
        Some(hit) => {
            text.push_str("let hit = closest.expect(\"one of them is hit\");\n");
            hit_asserts(&mut text, hit, hit.prim);
        }
        None => {
            text.push_str("assert!(closest.is_none());\n");
            text.push_str(&unchanged("after", probe));
        }
    }
    Some(text)
}
