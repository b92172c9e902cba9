//! The kernels of the explorable figures, each with its inputs and the bits of its results.
//!
//! `bits.js` computes the same records: first the inputs, then the results, as floats.

use super::inputs::Inputs;
use kernels::{HitF64, Kernel, Precision};
use kit::sampler::{Pattern, Sampling};
use kit::{
    Aabb, Bvh, BvhNode, Camera, Hit, Interval, Mat3, NodeKind, PixelSampler, PrimId, Ray, Spectrum,
    Sphere, Tally, Triangle, Vec2, Vec3, World, math,
};
use std::fs;
use std::path::Path;

/// The number of records of a kernel.
const RECORDS: usize = 100_000;

/// The number of records of what is no kernel but decided in fractions, which takes longer.
const EXACT_RECORDS: usize = 20_000;

/// Makes the numbers of a record.
type Record = dyn FnMut(&mut Inputs) -> Vec<f64>;

/// A kernel: its name in `bits.js`, and a function that makes the inputs and results of a record.
struct Records {
    name: &'static str,
    inputs: usize,
    record: Box<Record>,
}

fn all() -> Vec<Records> {
    vec![
        records("sin", 1, |inputs| {
            let x = angle(inputs);
            vec![x, math::sin(x)]
        }),
        records("cos", 1, |inputs| {
            let x = angle(inputs);
            vec![x, math::cos(x)]
        }),
        records("tan", 1, |inputs| {
            let x = angle(inputs);
            vec![x, math::tan(x)]
        }),
        triangle(),
        exact_triangle(),
        sphere("sphere_textbook", "quadratic formula"),
        sphere("sphere_remedied", "Haines's discriminant"),
        exact_sphere(),
        slabs(),
        exact_slabs(),
        traversal(),
        build(),
        camera(),
        glass(),
        exact_glass(),
        lamp(),
        stopping(),
        sampler("sampler", false),
        sampler("strata", true),
        records("malley", 2, |inputs| {
            let u = point_of_the_square(inputs);
            let sample = direct::lambert_sample(Spectrum::WHITE, Vec3::Z, u);
            direction_of(u, sample.map_or(Vec3::NAN, |sample| sample.wi))
        }),
        records("uniform", 2, |inputs| {
            let u = point_of_the_square(inputs);
            direction_of(u, kit::warp::uniform_hemisphere(u))
        }),
    ]
}

/// Writes the records of each kernel to `NAME.bin`, after the number of inputs and of all numbers
/// of a record.
pub(super) fn write_all(folder: &Path) {
    for (seed, mut kernel) in (1..).zip(all()) {
        let mut inputs = Inputs::new(seed);
        let is_exact = kernel.name.starts_with("exact_");
        let count = if is_exact { EXACT_RECORDS } else { RECORDS };
        let records: Vec<Vec<f64>> = (0..count).map(|_| (kernel.record)(&mut inputs)).collect();
        let head = [kernel.inputs as f64, records[0].len() as f64];
        let numbers = head.iter().chain(records.iter().flatten());
        let bytes: Vec<u8> = numbers.flat_map(|x| x.to_le_bytes()).collect();
        let file = folder.join(format!("{}.bin", kernel.name));
        fs::write(&file, bytes).unwrap_or_else(|error| panic!("{}: {error}", file.display()));
    }
}

fn records(
    name: &'static str,
    inputs: usize,
    record: impl FnMut(&mut Inputs) -> Vec<f64> + 'static,
) -> Records {
    Records {
        name,
        inputs,
        record: Box::new(record),
    }
}

/// The kernel of `grader cost` with this name, in `f64`.
fn named<S: 'static, W: 'static>(kernels: Vec<Kernel<S, W>>, name: &str) -> Kernel<S, W> {
    let mut kernels = kernels.into_iter();
    kernels
        .find(|kernel| kernel.info.name == name && kernel.precision == Precision::F64)
        .unwrap_or_else(|| panic!("grader/kernels has no {name}"))
}

/// An angle in radians: of a turn, of many turns, near a multiple of a quarter turn, or tiny.
fn angle(inputs: &mut Inputs) -> f64 {
    use std::f64::consts::{FRAC_PI_4, TAU};
    match inputs.below(5) {
        0 => inputs.between(-TAU, TAU),
        1 => inputs.between(-1e6, 1e6),
        2 => {
            let near = f64::from(inputs.below(4000)) * FRAC_PI_4;
            let ulps = u64::from(inputs.below(5));
            f64::from_bits(near.to_bits() + ulps) * if inputs.unit() < 0.5 { -1.0 } else { 1.0 }
        }
        3 => inputs.wild(40.0).rem_euclid(1e6),
        _ => inputs.wild(1020.0).rem_euclid(1.0),
    }
}

/// A ray and a triangle: anywhere, or aimed at a point of the triangle, its edges and vertices.
fn ray_and_triangle(inputs: &mut Inputs) -> (Ray, Triangle) {
    let kind = inputs.kind();
    let [p0, p1, p2, o] = [(); 4].map(|()| inputs.vec3(kind));
    let d = match inputs.below(3) {
        0 => inputs.vec3(kind),
        aim => {
            let (b1, b2) = match aim {
                1 => (
                    f64::from(inputs.below(3)) * 0.5,
                    f64::from(inputs.below(3)) * 0.5,
                ),
                _ => (inputs.unit(), inputs.unit()),
            };
            p0 + b1 * (p1 - p0) + b2 * (p2 - p0) - o
        }
    };
    (Ray::new(o, d), Triangle::flat(p0, p1, p2))
}

fn triangle_inputs(ray: &Ray, tri: &Triangle) -> Vec<f64> {
    [ray.o, ray.d, tri.p0, tri.p1, tri.p2]
        .iter()
        .flat_map(Vec3::to_array)
        .collect()
}

/// Whether it hits; if it does, t and the point.
fn hit(hit: Option<HitF64>) -> [f64; 5] {
    hit.map_or([0.0; 5], |hit| [1.0, hit.t, hit.p.x, hit.p.y, hit.p.z])
}

/// Möller and Trumbore's test.
fn triangle() -> Records {
    let kernel = named(kernels::triangles(), "Möller-Trumbore");
    records("triangle", 15, move |inputs| {
        let (ray, tri) = ray_and_triangle(inputs);
        [
            triangle_inputs(&ray, &tri),
            hit(kernel.answer(&tri, &ray)).into(),
        ]
        .concat()
    })
}

/// The oracle's answer, for what the figure draws as right: whether the ray hits, and the float
/// nearest to t.
fn exact_triangle() -> Records {
    records("exact_triangle", 15, |inputs| {
        let (ray, tri) = ray_and_triangle(inputs);
        let verdict = oracle::triangle(&tri, &ray);
        let crossing = verdict.crossing.as_ref().filter(|_| verdict.hits());
        let answer = crossing.map_or([0.0, 0.0], |crossing| [1.0, crossing.t.to_f64()]);
        [triangle_inputs(&ray, &tri), answer.into()].concat()
    })
}

/// A ray and a sphere: anywhere, aimed at the sphere, far away, or starting near the surface.
fn ray_and_sphere(inputs: &mut Inputs) -> (Ray, Sphere) {
    let kind = inputs.kind();
    let (center, radius) = (inputs.vec3(kind), inputs.vec3(kind).x.abs());
    let toward = inputs.vec3(kind);
    let o = match inputs.below(3) {
        0 => inputs.vec3(kind),
        1 => center + inputs.wild(30.0) * toward,
        _ => center + radius * (1.0 + inputs.wild(30.0).min(1.0)) * toward.normalize_or_zero(),
    };
    let d = match inputs.below(2) {
        0 => inputs.vec3(kind),
        _ => center + 1.2 * radius * inputs.vec3(1).normalize_or_zero() - o,
    };
    (Ray::new(o, d), Sphere { center, radius })
}

fn sphere_inputs(ray: &Ray, sphere: &Sphere) -> Vec<f64> {
    let vectors = [ray.o, ray.d, sphere.center];
    let vectors = vectors.iter().flat_map(Vec3::to_array);
    vectors.chain([sphere.radius]).collect()
}

/// The near root, or NaN: the kernel's hit of the whole line.
fn sphere(name: &'static str, kernel: &str) -> Records {
    let kernel = named(kernels::spheres(), kernel);
    records(name, 10, move |inputs| {
        let (mut ray, sphere) = ray_and_sphere(inputs);
        ray.min_t = f64::NEG_INFINITY;
        let t = kernel.answer(&sphere, &ray).map_or(f64::NAN, |hit| hit.t);
        [sphere_inputs(&ray, &sphere), vec![t]].concat()
    })
}

/// The oracle's near root, or NaN without one.
fn exact_sphere() -> Records {
    records("exact_sphere", 10, |inputs| {
        let (ray, sphere) = ray_and_sphere(inputs);
        let roots = oracle::sphere(&sphere, &ray).roots;
        let near = roots.map_or(f64::NAN, |[near, _]| near.to_f64());
        [sphere_inputs(&ray, &sphere), vec![near]].concat()
    })
}

/// A ray and a box: often with zeros in the direction, flat, or with the origin in a plane.
fn ray_and_box(inputs: &mut Inputs) -> (Ray, Aabb) {
    let kind = inputs.kind();
    let bounds = Aabb::of([inputs.vec3(kind), inputs.vec3(kind)]);
    let (mut o, mut d) = (inputs.vec3(kind), inputs.vec3(kind));
    for axis in 0..3 {
        match inputs.below(6) {
            0 => d[axis] = 0.0,
            1 => d[axis] = -0.0,
            2 => o[axis] = bounds.min[axis],
            3 => o[axis] = bounds.max[axis],
            _ => {}
        }
    }
    (Ray::new(o, d), bounds)
}

fn box_inputs(ray: &Ray, bounds: &Aabb) -> Vec<f64> {
    let vectors = [ray.o, ray.d, bounds.min, bounds.max];
    vectors.iter().flat_map(Vec3::to_array).collect()
}

/// Whether the textbook's test hits, and its interval.
fn slabs() -> Records {
    let kernel = named(kernels::boxes(), "naive slabs");
    records("slabs", 12, move |inputs| {
        let (ray, bounds) = ray_and_box(inputs);
        let inside = kernel.answer(&bounds, &ray);
        let answer = inside.map_or([0.0; 3], |inside| [1.0, inside.min, inside.max]);
        [box_inputs(&ray, &bounds), answer.into()].concat()
    })
}

/// The oracle's answer: whether the ray meets the box, and the floats nearest to the ends.
fn exact_slabs() -> Records {
    records("exact_slabs", 12, |inputs| {
        let (mut ray, bounds) = ray_and_box(inputs);
        if ray.d == Vec3::ZERO {
            // The oracle leaves this open.
            ray.d = Vec3::X;
        }
        let inside = oracle::bbox(&bounds, &ray).inside.ok();
        let answer = inside.map_or([0.0; 3], |inside| {
            [1.0, inside.min.to_f64(), inside.max.to_f64()]
        });
        [box_inputs(&ray, &bounds), answer.into()].concat()
    })
}

/// A world whose boxes and primitives have given distances; NaN is a miss. It counts.
struct Scripted {
    /// For each node, at the x coordinate of its box.
    entries: [f64; 7],
    hits: [f64; 4],
    box_tests: u32,
    /// The leaves, as the digits of a number.
    leaves: u32,
}

impl World for Scripted {
    fn hit_box(&mut self, bounds: &Aabb, ray: &Ray) -> Option<Interval> {
        self.box_tests += 1;
        let min = self.entries[bounds.min.x as usize];
        let max = ray.max_t;
        (min <= max).then_some(Interval { min, max })
    }

    fn hit_prim(&mut self, id: PrimId, ray: &mut Ray) -> Option<Hit> {
        self.leaves = 10 * self.leaves + id.0 + 1;
        let t = self.hits[id.0 as usize];
        ray.in_range(t).then(|| {
            ray.max_t = t;
            Hit {
                t,
                p: ray.at(t),
                n: Vec3::Z,
                ng: Vec3::Z,
                uv: Vec2::ZERO,
                prim: id,
            }
        })
    }

    fn blocked(&mut self, _: PrimId, _: &Ray) -> bool {
        unreachable!("the figure shows the closest hit")
    }
}

/// The tree of the worked example: nodes A to G, and a primitive in each leaf.
fn tree_of_the_example() -> Bvh {
    let node = |i: u32, kind| {
        let corner = Vec3::new(f64::from(i), 0.0, 0.0);
        let bounds = Aabb {
            min: corner,
            max: corner,
        };
        BvhNode { bounds, kind }
    };
    let interior = |i, left| {
        node(
            i,
            NodeKind::Interior {
                left,
                right: left + 1,
            },
        )
    };
    let leaf = |i: u32| {
        node(
            i,
            NodeKind::Leaf {
                first: i - 3,
                count: 1,
            },
        )
    };
    Bvh {
        nodes: vec![
            interior(0, 1),
            interior(1, 3),
            interior(2, 5),
            leaf(3),
            leaf(4),
            leaf(5),
            leaf(6),
        ],
        order: (0..4).map(PrimId).collect(),
    }
}

/// The reference's traversal: t or NaN, the box tests, the leaves in their order.
fn traversal() -> Records {
    let tree = tree_of_the_example();
    records("traversal", 11, move |inputs| {
        // Few values, so that ties are frequent.
        let mut distances = [0.0; 11].map(|_: f64| match inputs.below(6) {
            0 => f64::NAN,
            _ => f64::from(inputs.below(16)) * 0.5,
        });
        distances[0] = if inputs.below(50) == 0 { f64::NAN } else { 0.0 };
        let mut world = Scripted {
            entries: std::array::from_fn(|i| distances[i]),
            hits: std::array::from_fn(|i| distances[7 + i]),
            box_tests: 0,
            leaves: 0,
        };
        let closest = bvh::intersect_bvh(&tree, &mut Ray::new(Vec3::ZERO, Vec3::X), &mut world);
        let t = closest.map_or(f64::NAN, |hit| hit.t);
        [
            &distances[..],
            &[t, world.box_tests.into(), world.leaves.into()],
        ]
        .concat()
    })
}

/// The reference's split of six boxes on the x axis, 1 high and 1 deep: which boxes go to the left,
/// as bits; and the areas and the expected number of tests, with the areas of `kit`. All of it is
/// exact for such boxes, but for one division.
fn build() -> Records {
    records("build", 12, |inputs| {
        let bounds: [Aabb; 6] = std::array::from_fn(|_| {
            let (centre, half) = (
                f64::from(inputs.below(97)) * 0.25 - 2.0,
                f64::from(1 + inputs.below(40)) * 0.5,
            );
            Aabb {
                min: Vec3::new(centre - half, 0.0, 0.0),
                max: Vec3::new(centre + half, 1.0, 1.0),
            }
        });
        let tree = bvh::construct_bvh(&bounds, 5);
        let NodeKind::Interior { left, right } = tree.nodes[0].kind else {
            unreachable!("six boxes are more than a leaf holds");
        };
        let leaf = |node: u32| match tree.nodes[node as usize].kind {
            NodeKind::Leaf { first, count } => tree.leaf(first, count),
            NodeKind::Interior { .. } => unreachable!("a side has at most five boxes"),
        };
        let bits = leaf(left).iter().fold(0, |bits, id| bits | 1 << id.0);
        let [all, low, high] =
            [0, left, right].map(|i| tree.nodes[i as usize].bounds.surface_area());
        let expected = (low * leaf(left).len() as f64 + high * leaf(right).len() as f64) / all;
        let ends = bounds.iter().flat_map(|b| [b.min.x, b.max.x]);
        ends.chain([f64::from(bits), low, high, expected]).collect()
    })
}

/// The second sample of a pixel: its position, and the next two numbers. Of independent samples, or
/// of up to 1024 strata.
fn sampler(name: &'static str, in_strata: bool) -> Records {
    records(name, 4, move |inputs| {
        let [x, y, seed] = [(); 3].map(|()| inputs.below(u32::MAX));
        let samples = if in_strata { 1 + inputs.below(1024) } else { 0 };
        let pattern = match samples {
            0 => Pattern::Independent,
            samples => Pattern::Stratified { samples },
        };
        let sampling = Sampling {
            pattern,
            seed: u64::from(seed),
            first_sample: 0,
        };
        let mut sampler = PixelSampler::new(x, y, sampling);
        sampler.get_sample();
        let numbers = [sampler.get_sample(), sampler.next_2d()];
        let inputs = [x, y, seed, samples].map(f64::from);
        [&inputs[..], &numbers[0].to_array(), &numbers[1].to_array()].concat()
    })
}

/// Also the corners and the edges of the square, just below 1 among them.
fn point_of_the_square(inputs: &mut Inputs) -> Vec2 {
    let mut number = || match inputs.below(4) {
        0 => f64::from(inputs.below(16)) / 16.0,
        1 => 1.0 - f64::EPSILON / 2.0 * f64::from(1 + inputs.below(4)),
        _ => inputs.unit(),
    };
    Vec2::new(number(), number())
}

fn direction_of(u: Vec2, direction: Vec3) -> Vec<f64> {
    [&u.to_array()[..], &direction.to_array()].concat()
}

/// The reference's camera ray: its direction. Angles up to 180 degrees, tiny ones among them, any
/// rotation, points on the film and beyond.
fn camera() -> Records {
    records("camera", 13, |inputs| {
        let mut fov = || match inputs.below(4) {
            0 => f64::from(inputs.below(181)),
            1 => 180.0 - inputs.wild(40.0).abs().min(180.0),
            2 => inputs.wild(40.0).abs().min(180.0),
            _ => inputs.between(0.0, 180.0),
        };
        let (h_fov, v_fov) = (fov(), fov());
        let eye = inputs.vec3(1);
        let turned = Camera::look_at(eye, Vec3::ZERO, Vec3::Y);
        let c2w = match inputs.below(3) {
            0 => Mat3::from_cols(Vec3::Z, Vec3::Y, -Vec3::X),
            _ => turned.unwrap_or(Mat3::IDENTITY),
        };
        let sensor = match inputs.below(2) {
            0 => Vec2::new(f64::from(inputs.below(9)), f64::from(inputs.below(9))) / 8.0,
            _ => Vec2::new(inputs.between(-1.0, 2.0), inputs.between(-1.0, 2.0)),
        };
        let camera = Camera {
            pos: eye,
            c2w,
            h_fov,
            v_fov,
            n_clip: 0.0,
            f_clip: f64::INFINITY,
        };
        let d = raygen::generate_ray(&camera, sensor).d;
        [
            &[h_fov, v_fov][..],
            &c2w.to_cols_array(),
            &sensor.to_array(),
            &d.to_array(),
        ]
        .concat()
    })
}

/// The chapter's formulas, by angle and index: the two amplitudes and F; NaN beyond the critical
/// angle. (The reference's `fresnel_dielectric` rearranges them, which no script shows.)
fn glass() -> Records {
    records("glass", 3, |inputs| {
        let angle = match inputs.below(3) {
            0 => f64::from(inputs.below(91)).to_radians(),
            1 => inputs.wild(40.0).abs().min(1.5),
            _ => inputs.between(0.0, std::f64::consts::FRAC_PI_2),
        };
        let (sine, cosine) = math::sin_cos(angle);
        let eta = match inputs.below(2) {
            0 => 1.0 + f64::from(inputs.below(25)) / 16.0,
            _ => 1.0 / inputs.between(1.0, 2.5),
        };
        let transmitted = (1.0 - eta * sine * (eta * sine)).sqrt();
        let parallel = (cosine - eta * transmitted) / (cosine + eta * transmitted);
        let across = (eta * cosine - transmitted) / (eta * cosine + transmitted);
        let fraction = (parallel * parallel + across * across) / 2.0;
        vec![cosine, sine, eta, parallel, across, fraction]
    })
}

/// The reference's reflected fraction and refracted direction, or NaN, as inputs: the script's
/// exact answer is within some roundings of them, or a direction is so near the critical angle that
/// rounding decides. The result is 1.
fn exact_glass() -> Records {
    records("exact_glass", 6, |inputs| {
        let (x, z) = (
            f64::from(inputs.below(41)) / 16.0 - 1.25,
            f64::from(inputs.below(41)) / 16.0 - 1.25,
        );
        let (x, z) = if (x, z) == (0.0, 0.0) {
            (0.0, 1.0)
        } else {
            (x, z)
        };
        let ior = 1.0 + f64::from(inputs.below(25)) / 16.0;
        let wo = Vec3::new(x, 0.0, z).normalize();
        let eta = if z > 0.0 { 1.0 / ior } else { ior };
        let fraction = global::fresnel_dielectric(wo.z, eta);
        let wi = global::refract(wo, ior).unwrap_or(Vec3::NAN);
        vec![x, z, ior, fraction, wi.x, wi.z, 1.0]
    })
}

/// What one sample brings from a square lamp above a floor, by a uniform direction (`kit::warp`) and
/// by a point of the lamp, as the book's static figure computes it.
fn lamp() -> Records {
    use std::f64::consts::{FRAC_1_PI, TAU};
    records("lamp", 5, |inputs| {
        let (x, height, edge) = (
            inputs.small(),
            0.5 + inputs.unit() * 4.0,
            inputs.between(0.1, 8.0),
        );
        let u = point_of_the_square(inputs);
        let value = 0.8 * FRAC_1_PI;
        let w = kit::warp::uniform_hemisphere(u);
        let there = height / w.z * w;
        let meets = (there.x - x).abs() <= 0.5 * edge && there.y.abs() <= 0.5 * edge;
        let by_direction = if meets { value * 10.0 * w.z * TAU } else { 0.0 };

        let q = Vec3::new(x + edge * (u.x - 0.5), edge * (u.y - 0.5), height);
        let cos = height / q.length();
        let density = q.length_squared() / (edge * edge * cos);
        let by_point = value * 10.0 * cos / density;
        vec![x, height, edge, u.x, u.y, by_direction, by_point]
    })
}

/// A pixel whose samples are 1/p or 0, stopped by the reference's rules for tasks 1 and 2: the
/// number of samples and their mean.
fn stopping() -> Records {
    records("stopping", 6, |inputs| {
        let [x, y, seed] = [(); 3].map(|()| inputs.below(u32::MAX));
        // Mostly rules that stop early, or the test takes minutes.
        let rare = 1 + inputs.below(3) + 2 * inputs.below(2);
        let tolerance = f64::from(2 + inputs.below(9)) * 0.05;
        let is_sure = inputs.below(8) == 0;
        let p = 0.5_f64.powi(rare as i32);
        let mut sampler = PixelSampler::new(x, y, u64::from(seed));
        let mut tally = Tally::default();
        loop {
            sampler.get_sample();
            tally.push(if sampler.next_1d() < p { 1.0 / p } else { 0.0 });
            let mut plain = adaptive::has_converged;
            let is_over = tally.count() == 2048
                || tally.count().is_multiple_of(32)
                    && if is_sure {
                        adaptive::has_surely_converged(&tally, tolerance, &mut plain)
                    } else {
                        plain(&tally, tolerance)
                    };
            if is_over {
                break;
            }
        }
        let rule = f64::from(u8::from(is_sure));
        let numbers = [x, y, seed].map(f64::from);
        [
            &numbers[..],
            &[p, tolerance, rule],
            &[tally.count() as f64, tally.mean()],
        ]
        .concat()
    })
}
