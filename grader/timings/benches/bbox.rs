//! Benchmarks of the box test: rays that hit, rays that miss, and a random mix; and one ray against
//! many boxes, where the inverse direction can be computed once.
//!
//! Run with `cargo bench -p timings --bench bbox`; arguments after `--` are criterion's. Each time
//! is that of one test, with about a nanosecond for the loop around it.

use criterion::{Criterion, Throughput};
use kit::{Aabb, PixelSampler, Ray, Vec3};

/// The pairs of each benchmark, tested in turns: more than the branch predictor remembers.
const PAIRS: u32 = 1024;

/// A uniform random point in the cube [-1, 1)³.
fn point(random: &mut PixelSampler) -> Vec3 {
    let mut coordinate = || 2.0 * random.next_1d() - 1.0;
    Vec3::new(coordinate(), coordinate(), coordinate())
}

fn main() {
    let mut c = Criterion::default().configure_from_args();
    let mut random = PixelSampler::new(0, 0, 1);
    let (mut hits, mut misses, mut mixed) = (Vec::new(), Vec::new(), Vec::new());
    for _ in 0..PAIRS {
        let (p, q) = (point(&mut random), point(&mut random));
        let bounds = Aabb::of([p, q]);
        let origin = 5.0 * point(&mut random).normalize();
        let towards = |target: Vec3| Ray::new(origin, (target - origin).normalize());
        let (hit, miss) = (towards(0.6 * p + 0.4 * q), towards(2.5 * p - 1.5 * q));
        hits.push((bounds, hit));
        misses.push((bounds, miss));
        let coin = random.next_1d() < 0.5;
        mixed.push((bounds, if coin { hit } else { miss }));
    }

    let mut group = c.benchmark_group("box");
    group.throughput(Throughput::Elements(1));
    for (name, pairs) in [("hit", hits), ("miss", misses), ("mixed", mixed.clone())] {
        let mut turns = pairs.iter().cycle();
        group.bench_function(name, |b| {
            b.iter(|| {
                turns
                    .next()
                    .and_then(|(bounds, ray)| bbox::intersect_bbox(bounds, ray))
            });
        });
    }
    let one_ray = mixed[0].1;
    let mut turns = mixed.iter().cycle();
    group.bench_function("one ray, many boxes", |b| {
        b.iter(|| {
            turns
                .next()
                .and_then(|(bounds, _)| bbox::intersect_bbox(bounds, &one_ray))
        });
    });
    group.finish();
    c.final_summary();
}
