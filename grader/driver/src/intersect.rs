//! Runs Part 1, tasks 3 and 4: probes of single shapes, and rays through lists of shapes.

use crate::convert;
use crate::stages::Intersect;
use harness::{attempt, each_call};
use kit::PrimId;
use wire::answer::{HitsAnswer, SphereAnswer, TriangleAnswer};
use wire::work::{BruteForceWork, SphereWork, TriangleWork};

pub(crate) fn triangles(stage: &Intersect, work: &TriangleWork) -> Vec<TriangleAnswer> {
    each_call(&work.probes, |_, probe| {
        let triangle = convert::triangle(&work.triangles[probe.shape as usize]);
        let mut ray = convert::ray(&probe.ray);
        let test = attempt("test_triangle", || (stage.test_triangle)(&triangle, &ray));
        let id = PrimId(probe.shape);
        let hit = attempt(work.function(), || match work.by_record {
            // Once more: a gap in the test is what the record needs, and is told as that.
            true => (stage.test_triangle)(&triangle, &ray)
                .map(|hit| (stage.record_triangle)(&triangle, id, &mut ray, hit)),
            false => (stage.intersect_triangle)(&triangle, id, &mut ray),
        });
        let (test, hit) = (test.flatten(), hit.flatten());
        TriangleAnswer {
            test: test.map(|h| [h.t, h.b1, h.b2]),
            hit: hit.as_ref().map(convert::wire_hit),
            ray_after: convert::wire_ray(&ray),
        }
    })
}

pub(crate) fn spheres(stage: &Intersect, work: &SphereWork) -> Vec<SphereAnswer> {
    each_call(&work.probes, |_, probe| {
        let sphere = convert::sphere(&work.spheres[probe.shape as usize]);
        let mut ray = convert::ray(&probe.ray);
        let test = attempt("test_sphere", || (stage.test_sphere)(&sphere, &ray));
        let hit = attempt("intersect_sphere", || {
            (stage.intersect_sphere)(&sphere, PrimId(probe.shape), &mut ray)
        });
        let (test, hit) = (test.flatten(), hit.flatten());
        SphereAnswer {
            test,
            hit: hit.as_ref().map(convert::wire_hit),
            ray_after: convert::wire_ray(&ray),
        }
    })
}

pub(crate) fn brute_force(stage: &Intersect, work: &BruteForceWork) -> HitsAnswer {
    let triangles: Vec<_> = work.triangles.iter().map(convert::triangle).collect();
    let spheres: Vec<_> = work.spheres.iter().map(convert::sphere).collect();
    let answers = each_call(&work.rays, |_, ray| {
        let mut ray = convert::ray(ray);
        let mut closest = None;
        let mut ids = (0..).map(PrimId);
        for (triangle, id) in triangles.iter().zip(ids.by_ref()) {
            let hit = attempt("intersect_triangle", || {
                (stage.intersect_triangle)(triangle, id, &mut ray)
            });
            closest = hit.flatten().or(closest);
        }
        for (sphere, id) in spheres.iter().zip((triangles.len() as u32..).map(PrimId)) {
            let hit = attempt("intersect_sphere", || {
                (stage.intersect_sphere)(sphere, id, &mut ray)
            });
            closest = hit.flatten().or(closest);
        }
        (closest.as_ref().map(convert::wire_hit), ray.max_t)
    });
    let (hits, max_t) = answers.into_iter().unzip();
    HitsAnswer {
        hits,
        max_t,
        box_tests: 0,
        prim_tests: ((triangles.len() + spheres.len()) * work.rays.len()) as u64,
    }
}
