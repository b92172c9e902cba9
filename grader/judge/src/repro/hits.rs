//! Tests of triangles and spheres.

use super::numbers::{float, ray, vec3};
use crate::Tier;
use crate::convert;
use crate::expected::{Expected, ExpectedHit};
use crate::truth;
use kit::{Primitive, Vec3};
use std::fmt::Write;
use wire::work::{Probe, Ray, Xyz};

pub(super) fn triangle(tier: Tier, triangles: &[[Xyz; 6]], probe: &Probe) -> Option<String> {
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
    )?;
    Some(text)
}

pub(super) fn sphere(tier: Tier, spheres: &[(Xyz, f64)], probe: &Probe) -> Option<String> {
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
        "intersect::intersect_sphere(&s",
        probe.shape,
    )?;
    Some(text)
}

fn triangle_literal(vertices: &[Xyz; 6]) -> String {
    let mut text = String::from("Triangle {\n");
    for (name, p) in ["p0", "p1", "p2", "n0", "n1", "n2"]
        .into_iter()
        .zip(vertices)
    {
        let _ = writeln!(text, "    {name}: {},", vec3(*p));
    }
    text.push('}');
    text
}

fn sphere_literal((center, radius): &(Xyz, f64)) -> String {
    format!(
        "Sphere {{ center: {}, radius: {} }}",
        vec3(*center),
        float(*radius)
    )
}

/// So many shapes in a ray's way still make a test that one can read.
const SHAPES: usize = 6;

/// The first hit among all shapes that the line of a ray meets, in their order. `None` for triangles and spheres
/// together, and where more than one answer scores.
pub(super) fn first_of(
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
        let met = each.filter(|(_, (_, shape))| meets(truth::triangle(tier, 0, shape, &line)));
        let met = met.map(|(id, (numbers, _))| (id, triangle_literal(numbers)));
        ("Triangle", "intersect_triangle", met.collect())
    } else if triangles.is_empty() {
        let each = spheres.iter().zip(&scene.spheres).enumerate();
        let met = each.filter(|(_, (_, shape))| meets(truth::sphere(tier, 0, shape, &line)));
        let met = met.map(|(id, (numbers, _))| (id, sphere_literal(numbers)));
        ("Sphere", "intersect_sphere", met.collect())
    } else {
        return None;
    };
    let shapes: Vec<Primitive<'_>> = scene.primitives().collect();
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
        None => text.push_str("assert!(closest.is_none());\nassert_eq!(after, ray);\n"),
    }
    Some(text)
}

/// What both functions of a shape must answer. `None` where more than one answer scores.
fn asserts(
    text: &mut String,
    expected: &Expected,
    test: &str,
    intersect: &str,
    prim: u32,
) -> Option<()> {
    let intersect = format!("{intersect}, PrimId({prim}), &mut after)");
    match (expected.hits.as_slice(), expected.miss) {
        ([], _) => {
            let _ = writeln!(text, "// It misses: {}.", expected.why_miss);
            let _ = writeln!(text, "assert!({test}.is_none());");
            let _ = writeln!(
                text,
                "let mut after = ray;\nassert!({intersect}.is_none());\nassert_eq!(after, ray);"
            );
        }
        ([hit], false) => {
            let _ = writeln!(
                text,
                "assert!({test}.is_some(), \"it hits at t = {}\");",
                hit.t
            );
            let _ = writeln!(
                text,
                "let mut after = ray;\nlet hit = {intersect}.expect(\"it hits\");"
            );
            hit_asserts(text, hit, prim);
        }
        _ => return None,
    }
    Some(())
}

fn hit_asserts(text: &mut String, hit: &ExpectedHit, prim: u32) {
    let _ = writeln!(
        text,
        "assert!((hit.t - {}).abs() <= {}, \"t = {{}}\", hit.t);",
        float(hit.t),
        float(hit.t_bound)
    );
    vector_assert(text, "p", hit.p, hit.p_bound);
    if let Some((uv, bound)) = hit.uv {
        let _ = writeln!(
            text,
            "assert!((hit.uv.x - {}).abs() <= {}, \"uv = {{}}\", hit.uv);",
            float(uv.x),
            float(bound)
        );
        let _ = writeln!(
            text,
            "assert!((hit.uv.y - {}).abs() <= {}, \"uv = {{}}\", hit.uv);",
            float(uv.y),
            float(bound)
        );
    }
    if let Some(n) = hit.n {
        vector_assert(text, "n", n, hit.n_bound);
    }
    if let Some(ng) = hit.ng {
        vector_assert(text, "ng", ng, hit.ng_bound);
    }
    let _ = writeln!(
        text,
        "assert!((hit.n.length() - 1.0).abs() <= 1e-9, \"n has length {{}}\", hit.n.length());"
    );
    let _ = writeln!(text, "assert_eq!(hit.prim, PrimId({prim}));");
    let _ = writeln!(text, "assert_eq!(after, Ray {{ max_t: hit.t, ..ray }});");
}

fn vector_assert(text: &mut String, field: &str, right: Vec3, bound: f64) {
    if bound.is_finite() {
        let right = vec3(right.into());
        let _ = writeln!(
            text,
            "assert!((hit.{field} - {right}).abs().max_element() <= {}, \"{field} = {{}}\", hit.{field});",
            float(bound)
        );
    }
}
