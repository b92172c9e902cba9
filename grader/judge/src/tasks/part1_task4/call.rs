//! One call in words and shown.

use crate::tools::call_text::{holding, point, ray_and, ray_circumstances};
use crate::tools::shown::{ShownCall, ShownRay, YourHit};
use crate::tools::snapshot::Fields;
use crate::tools::truth::{self, records};
use crate::tools::{Tier, convert};
use kit::{Primitive, Vec3};
use wire::answer::SphereAnswer;
use wire::work::{Ray, SphereWork};

pub(super) fn input(work: &SphereWork, call: usize) -> Option<String> {
    let probe = work.probes.get(call)?;
    let (center, radius) = work.spheres.get(probe.shape as usize)?;
    let sphere = format!("sphere center = {}, radius = {radius:?}", point(*center));
    Some(ray_and(&probe.ray, &sphere))
}

pub(super) fn circumstances(work: &SphereWork, call: usize) -> Option<Vec<&'static str>> {
    let probe = work.probes.get(call)?;
    let (center, radius) = work.spheres[probe.shape as usize];
    let sphere = of_sphere(center.into(), radius, &probe.ray);
    Some([ray_circumstances(&probe.ray), sphere].concat())
}

fn of_sphere(center: Vec3, radius: f64, ray: &Ray) -> Vec<&'static str> {
    let to_center = center - Vec3::from(ray.o);
    holding(&[
        (
            to_center.length() < radius,
            "the ray starts inside the sphere",
        ),
        (
            to_center.length() > radius,
            "the ray starts outside the sphere",
        ),
        (
            to_center.dot(Vec3::from(ray.d)) < 0.0,
            "the sphere's centre lies behind the ray's origin",
        ),
        (
            center != Vec3::ZERO,
            "the sphere's centre is not at the world's origin",
        ),
        (radius != 1.0, "the radius is not 1"),
    ])
}

/// The right hits of some calls, as fields.
pub(super) fn exact(work: &SphereWork, calls: &[u32]) -> Vec<Fields> {
    let of_call = |&call: &u32| {
        let probe = &work.probes[call as usize];
        let sphere = convert::sphere(&work.spheres[probe.shape as usize]);
        records::of_shape(Primitive::Sphere(&sphere), &probe.ray)
    };
    calls.iter().map(of_call).collect()
}

pub(super) fn shown(
    work: &SphereWork,
    tier: Tier,
    call: usize,
    answers: Option<&Vec<SphereAnswer>>,
) -> Option<ShownCall> {
    let probe = work.probes.get(call)?;
    let scene = convert::scene(
        &[],
        std::slice::from_ref(work.spheres.get(probe.shape as usize)?),
    );
    let ray = convert::ray(&probe.ray);
    let expected = truth::sphere(tier, probe.shape, &scene.spheres[0], &ray);
    let yours = answers
        .and_then(|answers| answers.get(call))
        .map(|answer| YourHit {
            t: answer.hit.map(|hit| hit.t).or(answer.test),
            record: answer.hit,
        });
    Some(ShownCall::Ray(ShownRay::of_hit(
        scene, ray, &expected, yours,
    )))
}
