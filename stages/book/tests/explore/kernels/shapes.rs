//! A ray and a shape: the textbook's kernels, and the oracle's answers.

use super::{Records, records};
use crate::explore::inputs::Inputs;
use kernels::{HitF64, Kernel, Precision};
use kit::{Aabb, Ray, Sphere, Triangle, Vec3};

pub(super) fn all() -> Vec<Records> {
    vec![
        triangle(),
        exact_triangle(),
        sphere("sphere_textbook", "quadratic formula"),
        sphere("sphere_remedied", "Haines's discriminant"),
        exact_sphere(),
        slabs(),
        exact_slabs(),
    ]
}

/// The kernel of `grader cost` with this name, in `f64`.
fn named<S: 'static, W: 'static>(kernels: Vec<Kernel<S, W>>, name: &str) -> Kernel<S, W> {
    let mut kernels = kernels.into_iter();
    kernels
        .find(|kernel| kernel.info.name == name && kernel.precision == Precision::F64)
        .unwrap_or_else(|| panic!("grader/kernels has no {name}"))
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
