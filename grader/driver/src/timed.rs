//! Times one intersection test, in a loop with nothing else in it.

use crate::convert;
use crate::stages::Stages;
use std::hint::black_box;
use std::time::Instant;
use wire::work::{Shapes, TestTiming};

/// Times the test of the given shapes. For hits of `test_triangle` and `test_sphere` it also
/// computes `o + t·d`, as the kernels do with which they are compared.
pub(crate) fn test(stages: &Stages, timing: &TestTiming) -> Result<Vec<f64>, String> {
    match &timing.shapes {
        Shapes::Triangles(triangles) => {
            let test = stages.intersect()?.test_triangle;
            Ok(time(
                triangles,
                timing,
                convert::triangle,
                |triangle, ray| test(triangle, ray).map(|hit| (hit, ray.at(hit.t))),
            ))
        }
        Shapes::Spheres(spheres) => {
            let test = stages.intersect()?.test_sphere;
            Ok(time(spheres, timing, convert::sphere, |sphere, ray| {
                test(sphere, ray).map(|t| (t, ray.at(t)))
            }))
        }
        Shapes::Boxes(boxes) => {
            let test = stages.bbox()?.intersect_bbox;
            Ok(time(boxes, timing, convert::aabb, test))
        }
    }
}

fn time<W, S, A>(
    shapes: &[W],
    timing: &TestTiming,
    shape: impl Fn(&W) -> S,
    test: impl Fn(&S, &kit::Ray) -> Option<A>,
) -> Vec<f64> {
    let shapes: Vec<S> = shapes.iter().map(shape).collect();
    let rays: Vec<kit::Ray> = timing.rays.iter().map(convert::ray).collect();
    let per_ray = timing.per_ray.max(1) as usize;
    let pass = |order: &[u32]| {
        for i in order {
            let i = *i as usize;
            let ray = &rays[i];
            for shape in &shapes[i * per_ray..(i + 1) * per_ray] {
                if let Some(answer) = test(shape, ray) {
                    black_box(answer);
                }
            }
        }
    };
    let rounds = timing.orders.iter().enumerate().map(|(round, order)| {
        harness::call(round);
        let started = Instant::now();
        pass(order);
        started.elapsed().as_secs_f64()
    });
    rounds.collect()
}
