//! The worst answer as a Rust test: to paste into a stage's `tests/` folder, run in a debugger, keep.
//!
//! It fails on the code that gave the answer and passes on any that earns the points.

use crate::cases::Spec;
use crate::convert;
use crate::course::Tier;
use crate::judge::expected::{Expected, ExpectedHit};
use crate::score::CaseResult;
use crate::truth;
use kit::{Sphere, Vec3};
use std::fmt::Write;
use wire::Work;
use wire::work::{Camera, Probe, Ray, Xyz};

/// A test for the worst answer of a task's failed cases, core points first. `None` if none of them can be said in
/// a few lines.
pub fn worst(cases: &[CaseResult], specs: &[Spec], task: &str) -> Option<String> {
    let mut failed: Vec<&CaseResult> = cases.iter().filter(|case| case.worst().is_some()).collect();
    failed.sort_by_key(|case| case.tier == Tier::Robust);
    failed.into_iter().find_map(|case| {
        let spec = specs.iter().find(|spec| spec.is(task, &case.name))?;
        let worst = case
            .findings
            .iter()
            .filter_map(|finding| finding.worst.as_ref());
        worst
            .into_iter()
            .find_map(|worst| test(spec, case.tier, worst.call as usize))
    })
}

/// A test for one call of a case.
pub fn test(spec: &Spec, tier: Tier, call: usize) -> Option<String> {
    let body = match &spec.work {
        Work::Triangles { triangles, probes } => triangle(tier, triangles, probes.get(call)?)?,
        Work::Spheres { spheres, probes } => sphere(tier, spheres, probes.get(call)?)?,
        Work::CameraRays { cameras, sensor } if !sensor.is_empty() => camera_ray(
            cameras.get(call / sensor.len())?,
            sensor[call % sensor.len()],
        ),
        _ => return None,
    };
    let mut text = format!(
        "/// {}\n#[test]\nfn {}_{call}() {{\n",
        spec.about, spec.name
    );
    body.lines().for_each(|line| {
        let _ = writeln!(text, "    {line}");
    });
    text.push_str("}\n");
    Some(text)
}

fn triangle(tier: Tier, triangles: &[[Xyz; 6]], probe: &Probe) -> Option<String> {
    let vertices = triangles.get(probe.shape as usize)?;
    let shape = convert::triangle(vertices);
    let expected = truth::triangle(tier, probe.shape, &shape, &convert::ray(&probe.ray));
    let mut text = String::from("use kit::{PrimId, Ray, Triangle, Vec3};\n");
    let _ = writeln!(text, "let tri = Triangle {{");
    for (name, p) in ["p0", "p1", "p2", "n0", "n1", "n2"]
        .into_iter()
        .zip(vertices)
    {
        let _ = writeln!(text, "    {name}: {},", vec3(*p));
    }
    text.push_str("};\n");
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

fn sphere(tier: Tier, spheres: &[(Xyz, f64)], probe: &Probe) -> Option<String> {
    let &(center, radius) = spheres.get(probe.shape as usize)?;
    let shape = Sphere {
        center: Vec3::from(center),
        radius,
    };
    let expected = truth::sphere(tier, probe.shape, &shape, &convert::ray(&probe.ray));
    let mut text = String::from("use kit::{PrimId, Ray, Sphere, Vec3};\n");
    let _ = writeln!(
        text,
        "let s = Sphere {{ center: {}, radius: {} }};",
        vec3(center),
        float(radius)
    );
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

fn camera_ray(camera: &Camera, [x, y]: [f64; 2]) -> String {
    let [right, up, backward] = camera.c2w.map(Vec3::from);
    let mut text = String::from("use kit::{Camera, Mat3, Vec2, Vec3};\n");
    let _ = writeln!(
        text,
        "let camera = Camera {{\n    pos: {},",
        vec3(camera.pos)
    );
    let columns = camera.c2w.map(vec3).join(", ");
    let _ = writeln!(text, "    c2w: Mat3::from_cols({columns}),");
    let _ = writeln!(
        text,
        "    h_fov: {},\n    v_fov: {},",
        float(camera.h_fov),
        float(camera.v_fov)
    );
    let _ = writeln!(
        text,
        "    n_clip: {},\n    f_clip: {},\n}};",
        float(camera.n_clip),
        float(camera.f_clip)
    );
    let half = |degrees: f64| kit::math::tan((0.5 * degrees).to_radians());
    let d = (2.0 * x - 1.0) * half(camera.h_fov) * right
        + (2.0 * y - 1.0) * half(camera.v_fov) * up
        - backward;
    let _ = writeln!(
        text,
        "let ray = raygen::generate_ray(&camera, Vec2::new({}, {}));",
        float(x),
        float(y)
    );
    let _ = writeln!(text, "assert_eq!(ray.o, camera.pos);");
    let d = vec3(d.normalize().into());
    let _ = writeln!(
        text,
        "assert!((ray.d - {d}).abs().max_element() <= 1e-9, \"d = {{}}\", ray.d);"
    );
    let _ = writeln!(
        text,
        "assert!((ray.d.length() - 1.0).abs() <= 1e-12, \"d has length {{}}\", ray.d.length());"
    );
    let _ = writeln!(
        text,
        "assert_eq!((ray.min_t, ray.max_t), (camera.n_clip, camera.f_clip));"
    );
    text
}

fn ray(text: &mut String, ray: &Ray) {
    let _ = writeln!(
        text,
        "let ray = Ray {{\n    o: {},\n    d: {},",
        vec3(ray.o),
        vec3(ray.d)
    );
    let _ = writeln!(
        text,
        "    min_t: {},\n    max_t: {},\n}};",
        float(ray.min_t),
        float(ray.max_t)
    );
}

fn vec3([x, y, z]: Xyz) -> String {
    format!("Vec3::new({}, {}, {})", float(x), float(y), float(z))
}

/// A float as Rust writes it, bit for bit.
fn float(number: f64) -> String {
    if number.is_nan() {
        "f64::NAN".into()
    } else if number.is_infinite() {
        if number > 0.0 {
            "f64::INFINITY".into()
        } else {
            "f64::NEG_INFINITY".into()
        }
    } else {
        format!("{number:?}")
    }
}
