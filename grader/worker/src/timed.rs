//! One test over and over, timed: a loop with nothing else in it.

use crate::convert;
use std::hint::black_box;
use std::time::Instant;
use wire::Answer;
use wire::work::{TestTiming, Xyz};

/// `test_triangle`, and `o + t·d` of a hit, as the kernels that it is held against do.
#[cfg(feature = "intersect")]
pub(crate) fn triangles(triangles: &[[Xyz; 6]], timing: &TestTiming) -> Answer {
    time(triangles, timing, convert::triangle, |triangle, ray| {
        intersect::test_triangle(triangle, ray).map(|hit| (hit, ray.at(hit.t)))
    })
}

/// `test_sphere`, and `o + t·d` of a hit.
#[cfg(feature = "intersect")]
pub(crate) fn spheres(spheres: &[(Xyz, f64)], timing: &TestTiming) -> Answer {
    time(spheres, timing, convert::sphere, |sphere, ray| {
        intersect::test_sphere(sphere, ray).map(|t| (t, ray.at(t)))
    })
}

/// `intersect_bbox`.
#[cfg(feature = "bbox")]
pub(crate) fn boxes(boxes: &[[Xyz; 2]], timing: &TestTiming) -> Answer {
    time(boxes, timing, convert::aabb, bbox::intersect_bbox)
}

fn time<W, S, A>(
    shapes: &[W],
    timing: &TestTiming,
    shape: impl Fn(&W) -> S,
    test: impl Fn(&S, &kit::Ray) -> Option<A>,
) -> Answer {
    let shapes: Vec<S> = shapes.iter().map(shape).collect();
    let rays: Vec<kit::Ray> = timing.rays.iter().map(convert::ray).collect();
    let per_ray = timing.per_ray.max(1) as usize;
    let pass = || {
        for (ray, shapes) in rays.iter().zip(shapes.chunks_exact(per_ray)) {
            for shape in shapes {
                if let Some(answer) = test(shape, ray) {
                    black_box(answer);
                }
            }
        }
    };
    // Warms caches and branch predictors.
    pass();
    let rounds = (0..timing.rounds as usize).map(|round| {
        harness::call(round);
        let started = Instant::now();
        for _ in 0..timing.passes {
            pass();
        }
        started.elapsed().as_secs_f64()
    });
    Answer::TestTimes(rounds.collect())
}
