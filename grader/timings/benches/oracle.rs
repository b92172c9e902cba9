//! Measures the oracle on ordinary rays, by shape and by the share of rays that hit.
//!
//! Run with `cargo bench -p timings --bench oracle`; arguments after `--` are criterion's. Each
//! time is that of one verdict.

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use kit::{Aabb, PixelSampler, Ray, Sphere, Triangle, Vec3};
use oracle::{bbox, sphere, triangle};

/// The rays of each benchmark, judged in turns.
const COUNT: u32 = 1000;

/// How far the target of a ray may be from the middle of the shape, in edges of the unit cube that
/// contains everything.
const AIMS: [(&str, f64); 3] = [("at", 0.0), ("near", 0.5), ("around", 2.0)];

/// Returns a random point in the unit cube.
fn point(sampler: &mut PixelSampler) -> Vec3 {
    let (a, b) = (sampler.get_sample(), sampler.get_sample());
    Vec3::new(a.x, a.y, b.x)
}

fn pairs<S>(shape: impl Fn([Vec3; 3]) -> S, aim: f64) -> Vec<(S, Ray)> {
    let pair = |i| {
        let mut sampler = PixelSampler::new(i, 0, 0);
        let [a, b, c, o] = [0; 4].map(|_| point(&mut sampler));
        let at = (a + b + c) / 3.0 + aim * (point(&mut sampler) - 0.5);
        (shape([a, b, c]), Ray::new(o, at - o))
    };
    (0..COUNT).map(pair).collect()
}

fn decide<S, V>(c: &mut Criterion, name: &str, shape: fn([Vec3; 3]) -> S, by: fn(&S, &Ray) -> V) {
    let mut group = c.benchmark_group(format!("oracle/{name}"));
    group.throughput(Throughput::Elements(1));
    for (aimed, aim) in AIMS {
        let pairs = pairs(shape, aim);
        let mut turns = pairs.iter().cycle();
        group.bench_function(aimed, |b| {
            b.iter(|| turns.next().map(|(shape, ray)| by(shape, ray)));
        });
    }
    group.finish();
}

fn oracle(c: &mut Criterion) {
    decide(c, "triangle", |[a, b, c]| Triangle::flat(a, b, c), triangle);
    let ball = |[a, b, c]: [Vec3; 3]| Sphere {
        center: (a + b + c) / 3.0,
        radius: 0.2,
    };
    decide(c, "sphere", ball, sphere);
    decide(c, "box", |[a, b, _]| Aabb::of([a, b]), bbox);
}

criterion_group!(benches, oracle);
criterion_main!(benches);
