//! The project's own trees as rows of the table.

use crate::case::{Answers, Case};
use kit::{PrimId, Ray, Triangle};
use rustix::time::{ClockId, clock_gettime};
use simd_bvh::{TestCounts, WideBvh};

/// A row: name, interface, and what answers a case.
pub(crate) struct Row {
    pub(crate) name: &'static str,
    pub(crate) interface: &'static str,
    pub(crate) answer: fn(&Case) -> Answers,
}

/// The rows of this project.
pub(crate) static ROWS: [Row; 2] = [
    Row {
        name: "first_light_wide",
        interface: "simd_bvh::WideBvh::closest",
        answer: wide,
    },
    Row {
        name: "first_light_stages",
        interface: "construct_bvh, closest hit with Woop's test",
        answer: stages,
    },
];

/// The wide tree of Part 6.
fn wide(case: &Case) -> Answers {
    let triangles = case.triangles();
    let tree = WideBvh::build(&triangles, &[]);
    timed(&case.rays, |ray| {
        let exact = &mut |id: PrimId, ray: &Ray| test(&triangles, id, ray);
        let hit = tree.closest(ray, None, exact, &mut TestCounts::default());
        hit.map(|(id, hit)| (hit.t, id))
    })
}

fn test(triangles: &[Triangle], id: PrimId, ray: &Ray) -> Option<kit::TriangleHit> {
    intersect::test_triangle(&triangles[id.0 as usize], ray)
}

/// The tree of Part 2, traversed with the pruning slack that loses no hit.
fn stages(case: &Case) -> Answers {
    let triangles = case.triangles();
    let bounds: Vec<_> = triangles.iter().map(Triangle::bounds).collect();
    let tree = bvh::construct_bvh(&bounds, 4);
    let mut traversal = kernels::Traversal::new(64);
    timed(&case.rays, |ray| traversal.closest(&tree, &triangles, ray))
}

/// Answers every ray, and measures the processor time of this thread.
fn timed(rays: &[Ray], mut closest: impl FnMut(&Ray) -> Option<(f64, PrimId)>) -> Answers {
    let before = thread_seconds();
    let hits = rays.iter().map(|ray| match closest(ray) {
        Some((t, id)) => [t, f64::from(id.0), f64::NAN],
        None => [f64::INFINITY, -1.0, f64::NAN],
    });
    let hits = hits.collect();
    let seconds = thread_seconds() - before;
    Answers { seconds, hits }
}

fn thread_seconds() -> f64 {
    let time = clock_gettime(ClockId::ThreadCPUTime);
    time.tv_sec as f64 + 1e-9 * time.tv_nsec as f64
}
