//! Assertions that tests of triangles and spheres share.

use super::numbers::{float, unchanged, vec3};
use crate::tools::truth::expected::{Expected, ExpectedHit, TrueSurface};
use kit::Vec3;
use std::fmt::Write;
use wire::work::{Ray, Xyz};

pub(crate) fn triangle_literal(vertices: &[Xyz; 6]) -> String {
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

pub(crate) fn sphere_literal((center, radius): &(Xyz, f64)) -> String {
    format!(
        "Sphere {{ center: {}, radius: {} }}",
        vec3(*center),
        float(*radius)
    )
}

/// Adds the assertions on both functions of a shape; `None` where more than one answer scores.
pub(crate) fn asserts(
    text: &mut String,
    expected: &Expected,
    test: &str,
    intersect: &str,
    prim: u32,
    ray: &Ray,
) -> Option<()> {
    match (expected.hits.as_slice(), expected.miss) {
        ([], _) => {
            let _ = writeln!(text, "// It misses: {}.", expected.why_miss);
            let _ = writeln!(text, "assert!({test}.is_none());");
            let _ = writeln!(
                text,
                "let mut after = ray;\nassert!({intersect}.is_none());"
            );
            text.push_str(&unchanged("after", ray));
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

pub(crate) fn hit_asserts(text: &mut String, hit: &ExpectedHit, prim: u32) {
    let _ = writeln!(
        text,
        "assert!((hit.t - {}).abs() <= {}, \"t = {{}}\", hit.t);",
        float(hit.t),
        float(hit.t_bound)
    );
    vector_assert(text, "p", hit.p, hit.p_bound);
    if let Some((surface, bound)) = hit.surface {
        let distance = match surface {
            TrueSurface::Plane(q, n) => {
                let [q, n] = [q, n].map(|v| vec3(v.into()));
                format!("(hit.p - {q}).dot({n})")
            }
            TrueSurface::Sphere(center, radius) => {
                let (center, radius) = (vec3(center.into()), float(radius));
                format!("(hit.p - {center}).length() - {radius}")
            }
        };
        let _ = writeln!(
            text,
            "let off = {distance};\nassert!(off.abs() <= {}, \"p is {{off}} off the surface\");",
            float(bound)
        );
    }
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
