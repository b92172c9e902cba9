//! Measures millions of rays per second on one thread: the wide tree and the tree of stage `bvh`,
//! in one run.
//!
//! `cargo bench -p simd_bvh -- SCENE.dae`; without a scene a generated mesh. Camera rays go through
//! a picture of 480 x 360 pixels in order; bounce rays leave the hits in random directions; shadow
//! rays go from the hits to a point above and look for any hit. Each figure is the best of several
//! repetitions, because other programs on the machine only add time.

// BEGIN SOLUTION(part6.task1)
use bvh::{construct_bvh, intersect_bvh, occludes_bvh};
use kit::{
    Aabb, FilmSize, Frame, Hit, Interval, PixelSampler, PrimId, Primitive, Ray, Scene, TriangleHit,
    Vec2, Vec3, World, warp,
};
use meshes::{MeshKind, generate};
use scenes::placement;
use simd_bvh::{Level, TestCounts, WideBvh};
use std::hint::black_box;
use std::path::Path;
use std::time::{Duration, Instant};

const FILM: FilmSize = FilmSize { w: 480, h: 360 };
const REPETITIONS: usize = 9;
/// How many times a repetition traces all rays.
const ROUNDS: usize = 4;

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

/// The CPU time of this thread where the system reports it, else the time since `start`.
fn cpu_time(start: Instant) -> Duration {
    std::fs::read_to_string("/proc/thread-self/schedstat")
        .ok()
        .and_then(|stat| stat.split_whitespace().next()?.parse().ok())
        .map_or_else(|| start.elapsed(), Duration::from_nanos)
}

/// The best rate, in millions of rays per second.
fn rate(rays: &[Ray], mut trace: impl FnMut(&Ray) -> bool) -> f64 {
    let start = Instant::now();
    let best = (0..REPETITIONS)
        .map(|_| {
            let before = cpu_time(start);
            for _ in 0..ROUNDS {
                black_box(rays.iter().filter(|ray| trace(ray)).count());
            }
            cpu_time(start) - before
        })
        .min()
        .unwrap_or(Duration::MAX);
    (rays.len() * ROUNDS) as f64 / best.as_secs_f64() / 1e6
}

fn main() {
    let argument = std::env::args().skip(1).find(|arg| !arg.starts_with('-'));
    let scene = match &argument {
        Some(path) => {
            scenes::load(Path::new(path))
                .expect("a scene that can be read")
                .scene
        }
        None => Scene {
            triangles: generate(MeshKind::ALL[0], 50_000),
            ..Scene::default()
        },
    };
    let start = Instant::now();
    let wide = WideBvh::build(&scene.triangles, &scene.spheres);
    let wide_build = start.elapsed();
    let start = Instant::now();
    let tree = construct_bvh(&scene.primitive_bounds(), 4);
    let tree_build = start.elapsed();
    println!(
        "{} primitives; built: bvh {:.1} ms, simd_bvh {:.1} ms ({} nodes, {} blocks), {:?}",
        scene.len(),
        1e3 * tree_build.as_secs_f64(),
        1e3 * wide_build.as_secs_f64(),
        wide.node_count(),
        wide.block_count(),
        Level::new(),
    );
    println!(
        "{:<8} {:>9} {:>9} {:>9}   box and primitive tests per ray",
        "Mrays/s", "rays", "bvh", "simd_bvh"
    );
    for (name, rays) in ["camera", "bounce", "shadow"].into_iter().zip(rays(&scene)) {
        let mut world = Kernels(&scene);
        let any = name == "shadow";
        let binary = rate(&rays, |ray| {
            if any {
                occludes_bvh(&tree, ray, &mut world)
            } else {
                intersect_bvh(&tree, &mut { *ray }, &mut world).is_some()
            }
        });
        let mut counts = TestCounts::default();
        let exact = &mut |id: PrimId, ray: &Ray| Kernels(&scene).test(id, ray);
        let wide_rate = rate(&rays, |ray| {
            if any {
                wide.occluded(ray, None, exact, &mut counts)
            } else {
                wide.closest(ray, None, exact, &mut counts).is_some()
            }
        });
        let each = |tests: u64| tests as f64 / (rays.len() * REPETITIONS * ROUNDS) as f64;
        println!(
            "{name:<8} {:>9} {binary:>9.2} {wide_rate:>9.2}   {:.1} and {:.1}",
            rays.len(),
            each(counts.box_tests),
            each(counts.prim_tests)
        );
    }
}
// STUB: fn main() {}
// END SOLUTION(part6.task1)
