//! Benchmarks of the tree: construction, and traversal for the closest hit and for any hit, on the
//! generated meshes.
//!
//! Run with `cargo bench -p timings --bench bvh`; arguments after `--` are criterion's. Each time
//! is that of one tree or of one ray; throughput is in triangles for the construction and in rays
//! for the traversal.

use bvh::{construct_bvh, intersect_bvh, occludes_bvh};
use criterion::{Criterion, Throughput};
use kit::{Aabb, Hit, Interval, PixelSampler, PrimId, Ray, Triangle, Vec3, World};
use meshes::{MeshKind, generate};
use std::hint::black_box;

const TRIANGLES: usize = 100_000;
const RAYS: usize = 4096;

struct Mesh<'a>(&'a [Triangle]);

impl World for Mesh<'_> {
    #[inline(always)]
    fn hit_box(&mut self, b: &Aabb, ray: &Ray) -> Option<Interval> {
        bbox::intersect_bbox(b, ray)
    }

    fn hit_prim(&mut self, id: PrimId, ray: &mut Ray) -> Option<Hit> {
        intersect::intersect_triangle(&self.0[id.0 as usize], id, ray)
    }

    fn blocked(&mut self, id: PrimId, ray: &Ray) -> bool {
        intersect::test_triangle(&self.0[id.0 as usize], ray).is_some()
    }
}

/// Rays from a sphere around the box to points in it. Successive rays are independent.
fn rays_at(bounds: &Aabb) -> Vec<Ray> {
    let mut random = PixelSampler::new(0, 0, 1);
    let mut in_cube = || {
        let (xy, z) = (random.next_2d(), random.next_1d());
        2.0 * Vec3::new(xy.x, xy.y, z) - 1.0
    };
    let radius = bounds.extent().length();
    (0..RAYS)
        .map(|_| {
            let o = bounds.centroid() + radius * in_cube().normalize_or(Vec3::Y);
            let target = bounds.centroid() + 0.5 * bounds.extent() * in_cube();
            Ray::new(o, (target - o).normalize())
        })
        .collect()
}

fn main() {
    let mut c = Criterion::default().configure_from_args().sample_size(20);
    for kind in MeshKind::ALL {
        let mesh = generate(kind, TRIANGLES);
        let bounds: Vec<Aabb> = mesh.iter().map(Triangle::bounds).collect();
        let mut group = c.benchmark_group(kind.name());
        group.throughput(Throughput::Elements(mesh.len() as u64));
        group.bench_function("build", |b| b.iter(|| construct_bvh(black_box(&bounds), 4)));

        let tree = construct_bvh(&bounds, 4);
        let rays = rays_at(&tree.nodes[0].bounds);
        let mut world = Mesh(&mesh);
        let mut turns = rays.iter().cycle();
        group.throughput(Throughput::Elements(1));
        group.bench_function("closest hit", |b| {
            b.iter(|| {
                turns
                    .next()
                    .and_then(|ray| intersect_bvh(&tree, &mut { *ray }, &mut world))
            });
        });
        group.bench_function("any hit", |b| {
            b.iter(|| {
                turns
                    .next()
                    .is_some_and(|ray| occludes_bvh(&tree, ray, &mut world))
            });
        });
        group.finish();
    }
    c.final_summary();
}
