//! One call in words and shown.

use crate::tools::call_text::{few, point, ray_and};
use crate::tools::shown::{ShownCall, ShownRay, YourHit};
use crate::tools::snapshot::Fields;
use crate::tools::truth::{self, records};
use crate::tools::{Tier, convert, plural};
use oracle::Shapes;
use wire::answer::HitsAnswer;
use wire::work::BruteForceWork;

pub(super) fn input(work: &BruteForceWork, call: usize) -> Option<String> {
    let count = work.triangles.len() + work.spheres.len();
    let triangles = work.triangles.iter().map(|[p0, p1, p2, ..]| {
        let [p0, p1, p2] = [p0, p1, p2].map(|p| point(*p));
        format!("triangle {p0} {p1} {p2}")
    });
    let spheres = work
        .spheres
        .iter()
        .map(|(center, radius)| format!("sphere {}, {radius:?}", point(*center)));
    let shapes = few(triangles.chain(spheres), "; ");
    let shapes = shapes.unwrap_or_else(|| plural(count, "shape", "shapes"));
    Some(ray_and(work.rays.get(call)?, &shapes))
}

/// The right hits of some calls, as fields.
pub(super) fn exact(work: &BruteForceWork, enclosed: bool, calls: &[u32]) -> Vec<Fields> {
    let scene = convert::scene(&work.triangles, &work.spheres);
    records::of_scene(&scene, enclosed, &work.rays, calls)
}

pub(super) fn shown(
    work: &BruteForceWork,
    tier: Tier,
    enclosed: bool,
    call: usize,
    answer: Option<&HitsAnswer>,
) -> Option<ShownCall> {
    let scene = convert::scene(&work.triangles, &work.spheres);
    let ray = convert::ray(work.rays.get(call)?);
    let shapes = Shapes::new(scene.primitives());
    let expected = truth::first_of(tier, &shapes, &ray, enclosed);
    let hit = answer.and_then(|answer| answer.hits.get(call));
    let yours = hit.map(|hit| YourHit {
        t: hit.map(|hit| hit.t),
        record: *hit,
    });
    Some(ShownCall::Ray(ShownRay::of_hit(
        scene.clone(),
        ray,
        &expected,
        yours,
    )))
}
