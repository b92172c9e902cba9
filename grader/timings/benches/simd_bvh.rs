//! Benchmarks of the wide tree beside the tree of stage `bvh`, on one thread.
//!
//! Run with `cargo bench -p timings --bench simd_bvh`; arguments after `--` are criterion's. The
//! scene is a generated mesh, or the file that the variable `FIRSTLIGHT_BENCH_SCENE` names. Camera
//! rays go through a picture of 480 x 360 pixels in order; bounce rays leave the hits in random
//! directions; shadow rays go from the hits to a point above and look for any hit. Each time is
//! that of one tree or of one ray; throughput is in primitives for the construction and in rays for
//! the traversal.

use bvh::{construct_bvh, intersect_bvh, occludes_bvh};
use criterion::{Criterion, Throughput};
use kit::{
    Aabb, FilmSize, Frame, Hit, Interval, PixelSampler, PrimId, Primitive, Ray, Scene, TriangleHit,
    Vec2, Vec3, World, warp,
};
use meshes::{MeshKind, generate};
use scenes::placement;
use simd_bvh::{Level, TestCounts, WideBvh};
use std::path::Path;

const FILM: FilmSize = FilmSize { w: 480, h: 360 };

/// The variable that names a scene file.
const SCENE: &str = "FIRSTLIGHT_BENCH_SCENE";

struct Kernels<'a>(&'a Scene);

impl Kernels<'_> {
    fn test(&self, id: PrimId, ray: &Ray) -> Option<TriangleHit> {
        match self.0.primitive(id) {
            Primitive::Triangle(t) => intersect::test_triangle(t, ray),
            Primitive::Sphere(s) => intersect::test_sphere(s, ray).map(|t| TriangleHit {
                t,
                b1: 0.0,
                b2: 0.0,
            }),
        }
    }
}

impl World for Kernels<'_> {
    #[inline(always)]
    fn hit_box(&mut self, b: &Aabb, ray: &Ray) -> Option<Interval> {
        bbox::intersect_bbox(b, ray)
    }

    fn hit_prim(&mut self, id: PrimId, ray: &mut Ray) -> Option<Hit> {
        match self.0.primitive(id) {
            Primitive::Triangle(t) => intersect::intersect_triangle(t, id, ray),
            Primitive::Sphere(s) => intersect::intersect_sphere(s, id, ray),
        }
    }

    fn blocked(&mut self, id: PrimId, ray: &Ray) -> bool {
        self.test(id, ray).is_some()
    }
}

/// Generates camera, bounce and shadow rays.
fn rays(scene: &Scene) -> [Vec<Ray>; 3] {
    let tree = construct_bvh(&scene.primitive_bounds(), 4);
    let camera = placement::place(scene, FILM).camera;
    let bounds = scene.bounds();
    let mut sampler = PixelSampler::new(0, 0, 1);
    let (mut camera_rays, mut bounces, mut shadows) = (Vec::new(), Vec::new(), Vec::new());
    for (x, y) in FILM.whole().pixels() {
        let position = Vec2::new(f64::from(x), f64::from(y)) + sampler.get_sample();
        let tan = |degrees: f64| kit::math::tan((0.5 * degrees).to_radians());
        let d = Vec3::new(
            (2.0 * position.x / f64::from(FILM.w) - 1.0) * tan(camera.h_fov),
            (2.0 * position.y / f64::from(FILM.h) - 1.0) * tan(camera.v_fov),
            -1.0,
        );
        let ray = Ray {
            min_t: camera.n_clip,
            max_t: camera.f_clip,
            ..Ray::new(camera.pos, (camera.c2w * d).normalize())
        };
        camera_rays.push(ray);
        if let Some(hit) = intersect_bvh(&tree, &mut { ray }, &mut Kernels(scene)) {
            let n = if hit.ng.dot(ray.d) > 0.0 {
                -hit.ng
            } else {
                hit.ng
            };
            let o = hit.p + 1e-9 * bounds.extent().length() * n;
            let w = Frame::around(n).to_world(warp::uniform_hemisphere(sampler.next_2d()));
            bounces.push(Ray::new(o, w));
            let above = bounds.centroid() + Vec3::Y * bounds.extent().length();
            shadows.push(Ray {
                max_t: o.distance(above),
                ..Ray::new(o, (above - o).normalize())
            });
        }
    }
    [camera_rays, bounces, shadows]
}

fn main() {
    let mut c = Criterion::default().configure_from_args().sample_size(20);
    let scene = match std::env::var_os(SCENE) {
        Some(path) => {
            scenes::load(Path::new(&path))
                .unwrap_or_else(|e| panic!("{SCENE} names no scene: {e}"))
                .scene
        }
        None => Scene {
            triangles: generate(MeshKind::ALL[0], 50_000),
            ..Scene::default()
        },
    };
    let bounds = scene.primitive_bounds();
    let mut group = c.benchmark_group("build");
    group.throughput(Throughput::Elements(scene.len() as u64));
    group.bench_function("bvh", |b| b.iter(|| construct_bvh(&bounds, 4)));
    group.bench_function("simd_bvh", |b| {
        b.iter(|| WideBvh::build(&scene.triangles, &scene.spheres));
    });
    group.finish();

    let tree = construct_bvh(&bounds, 4);
    let wide = WideBvh::build(&scene.triangles, &scene.spheres);
    println!(
        "{} primitives; simd_bvh has {} nodes, {} blocks, {:?}",
        scene.len(),
        wide.node_count(),
        wide.block_count(),
        Level::new(),
    );
    for (name, rays) in ["camera", "bounce", "shadow"].into_iter().zip(rays(&scene)) {
        let any = name == "shadow";
        let mut world = Kernels(&scene);
        let mut binary = |ray: &Ray| match any {
            true => occludes_bvh(&tree, ray, &mut world),
            false => intersect_bvh(&tree, &mut { *ray }, &mut world).is_some(),
        };
        let mut counts = TestCounts::default();
        let exact = &mut |id: PrimId, ray: &Ray| Kernels(&scene).test(id, ray);
        let mut wide = |ray: &Ray| match any {
            true => wide.occluded(ray, None, exact, &mut counts),
            false => wide.closest(ray, None, exact, &mut counts).is_some(),
        };
        let hits = rays.iter().filter(|ray| wide(ray)).count();
        let mut group = c.benchmark_group(name);
        group.throughput(Throughput::Elements(1));
        let mut turns = rays.iter().cycle();
        group.bench_function("bvh", |b| b.iter(|| turns.next().is_some_and(&mut binary)));
        let mut turns = rays.iter().cycle();
        group.bench_function("simd_bvh", |b| {
            b.iter(|| turns.next().is_some_and(&mut wide));
        });
        group.finish();
        println!("{name}: {hits} of {} rays hit", rays.len());
    }
    c.final_summary();
}
