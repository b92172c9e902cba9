//! One call in words and shown.

use crate::tools::call_text::{holding, point, ray_and, ray_circumstances};
use crate::tools::shown::{ShownCall, ShownRay, YourHit};
use crate::tools::snapshot::Fields;
use crate::tools::truth::{self, records};
use crate::tools::{Tier, convert};
use kit::{Primitive, Triangle, Vec3};
use wire::answer::TriangleAnswer;
use wire::work::{Ray, TriangleWork};

pub(super) fn input(work: &TriangleWork, call: usize) -> Option<String> {
    let probe = work.probes.get(call)?;
    let triangle = work.triangles.get(probe.shape as usize)?;
    let is_smooth = triangle[3] != triangle[4] || triangle[3] != triangle[5];
    let [p0, p1, p2, n0, n1, n2] = triangle.map(point);
    let normals = match is_smooth {
        true => format!(", n0 = {n0}, n1 = {n1}, n2 = {n2}"),
        false => String::new(),
    };
    let triangle = format!("triangle p0 = {p0}, p1 = {p1}, p2 = {p2}{normals}");
    Some(ray_and(&probe.ray, &triangle))
}

pub(super) fn circumstances(work: &TriangleWork, call: usize) -> Option<Vec<&'static str>> {
    let probe = work.probes.get(call)?;
    let triangle = convert::triangle(&work.triangles[probe.shape as usize]);
    let of_triangle = of_triangle(&triangle, &probe.ray);
    Some([ray_circumstances(&probe.ray), of_triangle].concat())
}

fn of_triangle(triangle: &Triangle, ray: &Ray) -> Vec<&'static str> {
    let normal = (triangle.p1 - triangle.p0).cross(triangle.p2 - triangle.p0);
    let along = normal.dot(Vec3::from(ray.d));
    let t = normal.dot(triangle.p0 - Vec3::from(ray.o)) / along;
    holding(&[
        (along > 0.0, "the ray comes from behind the triangle"),
        (along < 0.0, "the ray comes from in front of the triangle"),
        (t < 0.0, "the triangle's plane lies behind the ray's origin"),
        (triangle.p0 != Vec3::ZERO, "p0 is not at the world's origin"),
    ])
}

/// The right hits of some calls, as fields.
pub(super) fn exact(work: &TriangleWork, calls: &[u32]) -> Vec<Fields> {
    let of_call = |&call: &u32| {
        let probe = &work.probes[call as usize];
        let triangle = convert::triangle(&work.triangles[probe.shape as usize]);
        records::of_shape(Primitive::Triangle(&triangle), &probe.ray)
    };
    calls.iter().map(of_call).collect()
}

pub(super) fn shown(
    work: &TriangleWork,
    tier: Tier,
    call: usize,
    answers: Option<&Vec<TriangleAnswer>>,
) -> Option<ShownCall> {
    let probe = work.probes.get(call)?;
    let scene = convert::scene(
        std::slice::from_ref(work.triangles.get(probe.shape as usize)?),
        &[],
    );
    let ray = convert::ray(&probe.ray);
    let expected = truth::triangle(tier, probe.shape, &scene.triangles[0], &ray);
    let yours = answers
        .and_then(|answers| answers.get(call))
        .map(|answer| YourHit {
            t: answer.hit.map(|hit| hit.t).or(answer.test.map(|[t, ..]| t)),
            record: answer.hit,
        });
    Some(ShownCall::Ray(ShownRay::of_hit(
        scene, ray, &expected, yours,
    )))
}
