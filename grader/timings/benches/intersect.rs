//! Benchmarks of the triangle and sphere tests: rays that hit, rays that miss, and a random mix of
//! both.
//!
//! Run with `cargo bench -p timings --bench intersect`; arguments after `--` are criterion's. Each
//! ray has its own shape, so no result can be reused. Each time is that of one test, with about a
//! nanosecond for the loop around it.

use criterion::{BenchmarkId, Criterion, Throughput};
use kit::{PixelSampler, Ray, Sphere, Triangle, Vec3};

/// The pairs of each benchmark, tested in turns: more than the branch predictor remembers.
const PAIRS: u32 = 1024;

/// Shapes, each with its own ray.
type Pairs<S> = Vec<(S, Ray)>;

/// A uniform random point in the cube [-1, 1)³.
fn point(random: &mut PixelSampler) -> Vec3 {
    let mut coordinate = || 2.0 * random.next_1d() - 1.0;
    Vec3::new(coordinate(), coordinate(), coordinate())
}

/// Three named lists of pairs. `shape` returns a shape, a point inside its outline and a point
/// outside.
fn workloads<S: Clone>(
    shape: impl Fn(&mut PixelSampler) -> (S, Vec3, Vec3),
) -> [(&'static str, Pairs<S>); 3] {
    let mut random = PixelSampler::new(0, 0, 1);
    let (mut hits, mut misses, mut mixed) = (Vec::new(), Vec::new(), Vec::new());
    for _ in 0..PAIRS {
        let (shape, inside, outside) = shape(&mut random);
        let origin = 5.0 * point(&mut random).normalize();
        let towards = |target: Vec3| Ray::new(origin, (target - origin).normalize());
        hits.push((shape.clone(), towards(inside)));
        misses.push((shape.clone(), towards(outside)));
        let coin = random.next_1d() < 0.5;
        mixed.push((shape, towards(if coin { inside } else { outside })));
    }
    [("hit", hits), ("miss", misses), ("mixed", mixed)]
}

fn triangles(random: &mut PixelSampler) -> (Triangle, Vec3, Vec3) {
    let (p0, p1, p2) = (point(random), point(random), point(random));
    let inside = 0.4 * p0 + 0.3 * p1 + 0.3 * p2;
    let outside = -0.6 * p0 + 0.8 * p1 + 0.8 * p2;
    (Triangle::flat(p0, p1, p2), inside, outside)
}

fn spheres(random: &mut PixelSampler) -> (Sphere, Vec3, Vec3) {
    let (center, radius) = (point(random), 0.1 + random.next_1d());
    let off_center = point(random).normalize();
    let inside = center + 0.3 * radius * off_center;
    let outside = center + 2.0 * radius * off_center;
    (Sphere { center, radius }, inside, outside)
}

fn bench<S: Clone, H>(
    c: &mut Criterion,
    kernel: &str,
    shape: impl Fn(&mut PixelSampler) -> (S, Vec3, Vec3),
    test: impl Fn(&S, &Ray) -> Option<H>,
) {
    let mut group = c.benchmark_group(kernel);
    group.throughput(Throughput::Elements(1));
    for (name, pairs) in workloads(shape) {
        let mut turns = pairs.iter().cycle();
        group.bench_function(BenchmarkId::from_parameter(name), |b| {
            b.iter(|| turns.next().and_then(|(shape, ray)| test(shape, ray)));
        });
    }
    group.finish();
}

/// The textbook test, for comparison (Möller, Trumbore, "Fast, minimum storage ray-triangle
/// intersection", 1997).
#[inline]
fn moller_trumbore(tri: &Triangle, ray: &Ray) -> Option<kit::TriangleHit> {
    let (e1, e2) = (tri.p1 - tri.p0, tri.p2 - tri.p0);
    let p = ray.d.cross(e2);
    let det = e1.dot(p);
    if det == 0.0 {
        return None;
    }
    let inv_det = 1.0 / det;
    let s = ray.o - tri.p0;
    let b1 = s.dot(p) * inv_det;
    if !(0.0..=1.0).contains(&b1) {
        return None;
    }
    let q = s.cross(e1);
    let b2 = ray.d.dot(q) * inv_det;
    if b2 < 0.0 || b1 + b2 > 1.0 {
        return None;
    }
    let t = e2.dot(q) * inv_det;
    ray.in_range(t).then_some(kit::TriangleHit { t, b1, b2 })
}

fn main() {
    let mut c = Criterion::default().configure_from_args();
    bench(&mut c, "triangle", triangles, intersect::test_triangle);
    bench(
        &mut c,
        "triangle_moller_trumbore",
        triangles,
        moller_trumbore,
    );
    bench(&mut c, "sphere", spheres, intersect::test_sphere);
    c.final_summary();
}
