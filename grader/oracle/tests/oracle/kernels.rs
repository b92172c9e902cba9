//! Kernels that are correct within `f64` precision: the oracle must never mark them down.

use kit::{Aabb, Interval, Ray, Sphere, Triangle, Vec3};

/// A ray/triangle test: `t` of a hit.
pub(crate) type TriangleKernel = fn(&Triangle, &Ray) -> Option<f64>;
/// A ray/sphere test: `t` of a hit.
pub(crate) type SphereKernel = fn(&Sphere, &Ray) -> Option<f64>;
/// A ray/box test.
pub(crate) type BoxKernel = fn(&Aabb, &Ray) -> Option<Interval>;

pub(crate) const TEXTBOOK_TRIANGLES: [(&str, TriangleKernel); 9] = [
    ("Möller-Trumbore", moller_trumbore),
    ("Möller-Trumbore from p1", moller_trumbore_from_p1),
    (
        "Möller-Trumbore without division",
        moller_trumbore_undivided,
    ),
    ("Cramer's rule", cramer),
    ("signed volumes", signed_volumes),
    ("Plücker coordinates in world space", plucker),
    ("plane, then the side of each edge", plane_and_edges),
    ("plane with unit normal, then areas", plane_and_areas),
    ("plane, then weights from dot products", plane_and_dots),
];

pub(crate) const ROBUST_TRIANGLES: [(&str, TriangleKernel); 2] =
    [("Woop", woop), ("Woop with fused edges", woop_fused)];

fn moller_trumbore(tri: &Triangle, ray: &Ray) -> Option<f64> {
    let (e1, e2) = (tri.p1 - tri.p0, tri.p2 - tri.p0);
    let pvec = ray.d.cross(e2);
    let det = e1.dot(pvec);
    if det == 0.0 {
        return None;
    }
    let inv = 1.0 / det;
    let s = ray.o - tri.p0;
    let u = s.dot(pvec) * inv;
    if !(0.0..=1.0).contains(&u) {
        return None;
    }
    let q = s.cross(e1);
    let v = ray.d.dot(q) * inv;
    if v < 0.0 || u + v > 1.0 {
        return None;
    }
    in_range(ray, e2.dot(q) * inv)
}

fn moller_trumbore_from_p1(tri: &Triangle, ray: &Ray) -> Option<f64> {
    moller_trumbore(&Triangle::flat(tri.p1, tri.p2, tri.p0), ray)
}

fn moller_trumbore_undivided(tri: &Triangle, ray: &Ray) -> Option<f64> {
    let (e1, e2) = (tri.p1 - tri.p0, tri.p2 - tri.p0);
    let pvec = ray.d.cross(e2);
    let det = e1.dot(pvec);
    let sign = det.signum();
    let s = ray.o - tri.p0;
    let u = sign * s.dot(pvec);
    let q = s.cross(e1);
    let v = sign * ray.d.dot(q);
    if det == 0.0 || u < 0.0 || v < 0.0 || u + v > det.abs() {
        return None;
    }
    in_range(ray, e2.dot(q) / det)
}

fn cramer(tri: &Triangle, ray: &Ray) -> Option<f64> {
    let (a, b, c) = (tri.p0 - tri.p1, tri.p0 - tri.p2, tri.p0 - ray.o);
    let det3 = |x: Vec3, y: Vec3, z: Vec3| {
        x.x * (y.y * z.z - z.y * y.z)
            + y.x * (z.y * x.z - x.y * z.z)
            + z.x * (x.y * y.z - y.y * x.z)
    };
    let det = det3(a, b, ray.d);
    if det == 0.0 {
        return None;
    }
    let beta = det3(c, b, ray.d) / det;
    let gamma = det3(a, c, ray.d) / det;
    if !(0.0..=1.0).contains(&gamma) || beta < 0.0 || beta > 1.0 - gamma {
        return None;
    }
    in_range(ray, det3(a, b, c) / det)
}

fn signed_volumes(tri: &Triangle, ray: &Ray) -> Option<f64> {
    let [a, b, c] = [tri.p0, tri.p1, tri.p2].map(|p| p - ray.o);
    let w = [
        ray.d.dot(b.cross(c)),
        ray.d.dot(c.cross(a)),
        ray.d.dot(a.cross(b)),
    ];
    by_signs(w)?;
    let n = (b - a).cross(c - a);
    in_range(ray, a.dot(n) / ray.d.dot(n))
}

fn plucker(tri: &Triangle, ray: &Ray) -> Option<f64> {
    let moment = ray.o.cross(ray.d);
    let side = |from: Vec3, to: Vec3| ray.d.dot(from.cross(to)) + moment.dot(to - from);
    let w = [
        side(tri.p1, tri.p2),
        side(tri.p2, tri.p0),
        side(tri.p0, tri.p1),
    ];
    by_signs(w)?;
    let n = (tri.p1 - tri.p0).cross(tri.p2 - tri.p0);
    in_range(ray, (tri.p0 - ray.o).dot(n) / ray.d.dot(n))
}

fn plane_and_edges(tri: &Triangle, ray: &Ray) -> Option<f64> {
    let n = (tri.p1 - tri.p0).cross(tri.p2 - tri.p0);
    let facing = n.dot(ray.d);
    if facing == 0.0 {
        return None;
    }
    let t = n.dot(tri.p0 - ray.o) / facing;
    let p = ray.at(t);
    let inside = |a: Vec3, b: Vec3| n.dot((b - a).cross(p - a)) >= 0.0;
    if !(inside(tri.p0, tri.p1) && inside(tri.p1, tri.p2) && inside(tri.p2, tri.p0)) {
        return None;
    }
    in_range(ray, t)
}

fn plane_and_areas(tri: &Triangle, ray: &Ray) -> Option<f64> {
    let n = (tri.p1 - tri.p0).cross(tri.p2 - tri.p0);
    let all = n.length();
    let n = n / all;
    let facing = n.dot(ray.d);
    if facing == 0.0 || all == 0.0 {
        return None;
    }
    let t = (n.dot(tri.p0) - n.dot(ray.o)) / facing;
    let p = ray.at(t);
    let b1 = (tri.p0 - tri.p2).cross(p - tri.p2).dot(n) / all;
    let b2 = (tri.p1 - tri.p0).cross(p - tri.p0).dot(n) / all;
    if !(b1 >= 0.0 && b2 >= 0.0 && b1 + b2 <= 1.0) {
        return None;
    }
    in_range(ray, t)
}

/// Ericson, *BigFloat-Time Collision Detection*, §3.4.
fn plane_and_dots(tri: &Triangle, ray: &Ray) -> Option<f64> {
    let (v0, v1) = (tri.p1 - tri.p0, tri.p2 - tri.p0);
    let n = v0.cross(v1);
    let facing = n.dot(ray.d);
    if facing == 0.0 {
        return None;
    }
    let t = n.dot(tri.p0 - ray.o) / facing;
    let v2 = ray.at(t) - tri.p0;
    let (d00, d01, d11) = (v0.dot(v0), v0.dot(v1), v1.dot(v1));
    let (d20, d21) = (v2.dot(v0), v2.dot(v1));
    let denom = d00 * d11 - d01 * d01;
    let v = (d11 * d20 - d01 * d21) / denom;
    let w = (d00 * d21 - d01 * d20) / denom;
    if !(v >= 0.0 && w >= 0.0 && v + w <= 1.0) {
        return None;
    }
    in_range(ray, t)
}

fn woop(tri: &Triangle, ray: &Ray) -> Option<f64> {
    woop_with(tri, ray, |a, b, c, d| a * b - c * d)
}

/// Kahan's difference of products: at most 1.5 ulp of error.
fn woop_fused(tri: &Triangle, ray: &Ray) -> Option<f64> {
    woop_with(tri, ray, |a, b, c, d| {
        let cd = c * d;
        a.mul_add(b, -cd) + (-c).mul_add(d, cd)
    })
}

fn woop_with(tri: &Triangle, ray: &Ray, difference: fn(f64, f64, f64, f64) -> f64) -> Option<f64> {
    let z = ray.d.abs().max_position();
    let (x, y) = ((z + 1) % 3, (z + 2) % 3);
    let scale = 1.0 / ray.d[z];
    let (sx, sy) = (ray.d[x] / ray.d[z], ray.d[y] / ray.d[z]);
    let sheared = [tri.p0, tri.p1, tri.p2].map(|p| {
        let p = p - ray.o;
        Vec3::new(p[x] - sx * p[z], p[y] - sy * p[z], scale * p[z])
    });
    let [a, b, c] = sheared;
    let w = [
        difference(b.x, c.y, b.y, c.x),
        difference(c.x, a.y, c.y, a.x),
        difference(a.x, b.y, a.y, b.x),
    ];
    let det = by_signs(w)?;
    in_range(ray, (w[0] * a.z + w[1] * b.z + w[2] * c.z) / det)
}

/// Returns the sum of three edge functions if they all have the same sign.
fn by_signs(w: [f64; 3]) -> Option<f64> {
    let det = w[0] + w[1] + w[2];
    let mixed = w.iter().any(|w| *w < 0.0) && w.iter().any(|w| *w > 0.0);
    (!mixed && det != 0.0).then_some(det)
}

fn in_range(ray: &Ray, t: f64) -> Option<f64> {
    ray.in_range(t).then_some(t)
}

pub(crate) const TEXTBOOK_SPHERES: [(&str, SphereKernel); 3] = [
    ("quadratic formula", quadratic),
    ("quadratic formula with half b", half_b),
    ("geometric", geometric),
];

pub(crate) const ROBUST_SPHERES: [(&str, SphereKernel); 1] = [("Haines", haines)];

fn first_in_range(ray: &Ray, roots: [f64; 2]) -> Option<f64> {
    roots.into_iter().find(|t| ray.in_range(*t))
}

fn quadratic(s: &Sphere, ray: &Ray) -> Option<f64> {
    let f = ray.o - s.center;
    let a = ray.d.dot(ray.d);
    let b = 2.0 * f.dot(ray.d);
    let c = f.dot(f) - s.radius * s.radius;
    let discriminant = b * b - 4.0 * a * c;
    if discriminant < 0.0 {
        return None;
    }
    let root = discriminant.sqrt();
    first_in_range(ray, [(-b - root) / (2.0 * a), (-b + root) / (2.0 * a)])
}

fn half_b(s: &Sphere, ray: &Ray) -> Option<f64> {
    let f = ray.o - s.center;
    let a = ray.d.length_squared();
    let b = f.dot(ray.d);
    let c = f.length_squared() - s.radius * s.radius;
    let discriminant = b * b - a * c;
    if discriminant < 0.0 {
        return None;
    }
    let inv = 1.0 / a;
    let root = discriminant.sqrt();
    first_in_range(ray, [(-b - root) * inv, (-b + root) * inv])
}

fn geometric(s: &Sphere, ray: &Ray) -> Option<f64> {
    let length = ray.d.length();
    let d = ray.d / length;
    let to_center = s.center - ray.o;
    let along = to_center.dot(d);
    let aside = to_center.dot(to_center) - along * along;
    if aside > s.radius * s.radius {
        return None;
    }
    let half = (s.radius * s.radius - aside).sqrt();
    first_in_range(ray, [(along - half) / length, (along + half) / length])
}

fn haines(s: &Sphere, ray: &Ray) -> Option<f64> {
    let f = ray.o - s.center;
    let a = ray.d.length_squared();
    let b = f.dot(ray.d);
    let l = f - (b / a) * ray.d;
    let discriminant = s.radius * s.radius - l.length_squared();
    if discriminant < 0.0 {
        return None;
    }
    let root = (a * discriminant).sqrt();
    let q = if b > 0.0 { -b - root } else { root - b };
    if q == 0.0 {
        return first_in_range(ray, [0.0, 0.0]);
    }
    let c = f.length_squared() - s.radius * s.radius;
    let (t0, t1) = (q / a, c / q);
    first_in_range(ray, [t0.min(t1), t0.max(t1)])
}

pub(crate) const TEXTBOOK_BOXES: [(&str, BoxKernel); 5] = [
    ("Kay-Kajiya slabs", kay_kajiya),
    ("Williams", williams),
    ("minima and maxima", min_max),
    ("centre and half extent", center_and_half),
    ("planes and origin times 1/d", scaled_planes),
];

pub(crate) const ROBUST_BOXES: [(&str, BoxKernel); 1] = [("Ize", ize)];

fn interval(min: f64, max: f64) -> Option<Interval> {
    (min <= max).then_some(Interval { min, max })
}

fn kay_kajiya(b: &Aabb, ray: &Ray) -> Option<Interval> {
    if b.is_empty() {
        return None;
    }
    let (mut near, mut far) = (ray.min_t, ray.max_t);
    for i in 0..3 {
        if ray.d[i] == 0.0 {
            if ray.o[i] < b.min[i] || ray.o[i] > b.max[i] {
                return None;
            }
            continue;
        }
        let t0 = (b.min[i] - ray.o[i]) / ray.d[i];
        let t1 = (b.max[i] - ray.o[i]) / ray.d[i];
        near = near.max(t0.min(t1));
        far = far.min(t0.max(t1));
    }
    interval(near, far)
}

/// Williams et al., *An Efficient and Robust Ray-Box Intersection Algorithm*, 2005, with
/// comparisons that a NaN does not pass.
fn williams(b: &Aabb, ray: &Ray) -> Option<Interval> {
    if b.is_empty() {
        return None;
    }
    let inv = 1.0 / ray.d;
    let (mut near, mut far) = (ray.min_t, ray.max_t);
    for i in 0..3 {
        let (low, high) = match inv[i] < 0.0 {
            true => (b.max[i], b.min[i]),
            false => (b.min[i], b.max[i]),
        };
        let (t0, t1) = ((low - ray.o[i]) * inv[i], (high - ray.o[i]) * inv[i]);
        if t0 > near {
            near = t0;
        }
        if t1 < far {
            far = t1;
        }
    }
    interval(near, far)
}

fn min_max(b: &Aabb, ray: &Ray) -> Option<Interval> {
    if b.is_empty() {
        return None;
    }
    let inv = 1.0 / ray.d;
    let (mut near, mut far) = (ray.min_t, ray.max_t);
    for i in 0..3 {
        let (t0, t1) = (
            (b.min[i] - ray.o[i]) * inv[i],
            (b.max[i] - ray.o[i]) * inv[i],
        );
        if t0.is_nan() || t1.is_nan() {
            continue;
        }
        near = near.max(t0.min(t1));
        far = far.min(t0.max(t1));
    }
    interval(near, far)
}

/// The slab of each axis as its centre and half its extent.
fn center_and_half(b: &Aabb, ray: &Ray) -> Option<Interval> {
    let (center, half) = (0.5 * (b.min + b.max), 0.5 * (b.max - b.min));
    slabs(b, ray, |i| {
        let inv = 1.0 / ray.d[i];
        let middle = (center[i] - ray.o[i]) * inv;
        let reach = half[i] * inv.abs();
        [middle - reach, middle + reach]
    })
}

/// The planes and the origin are each multiplied by the reciprocal of `d`.
fn scaled_planes(b: &Aabb, ray: &Ray) -> Option<Interval> {
    slabs(b, ray, |i| {
        let inv = 1.0 / ray.d[i];
        let o = ray.o[i] * inv;
        [b.min[i] * inv - o, b.max[i] * inv - o]
    })
}

/// A slab test whose `t` at both planes of an axis, in any order, come from `ends`, unless `d` is 0
/// there or a plane is infinite.
fn slabs(b: &Aabb, ray: &Ray, ends: impl Fn(usize) -> [f64; 2]) -> Option<Interval> {
    if b.is_empty() {
        return None;
    }
    let (mut near, mut far) = (ray.min_t, ray.max_t);
    for i in 0..3 {
        if ray.d[i] == 0.0 {
            if ray.o[i] < b.min[i] || ray.o[i] > b.max[i] {
                return None;
            }
            continue;
        }
        let [t0, t1] = match b.min[i].is_finite() && b.max[i].is_finite() {
            true => ends(i),
            false => [b.min[i], b.max[i]].map(|plane| (plane - ray.o[i]) / ray.d[i]),
        };
        near = near.max(t0.min(t1));
        far = far.min(t0.max(t1));
    }
    interval(near, far)
}

/// Ize, *Robust BVH Ray Traversal*, JCGT 2013; with divisions, because the reciprocal of a denormal
/// overflows.
fn ize(b: &Aabb, ray: &Ray) -> Option<Interval> {
    if b.is_empty() {
        return None;
    }
    let (mut near, mut far) = (ray.min_t, ray.max_t);
    for i in 0..3 {
        let (low, high) = match ray.d[i].is_sign_negative() {
            true => (b.max[i], b.min[i]),
            false => (b.min[i], b.max[i]),
        };
        let t0 = (low - ray.o[i]) / ray.d[i];
        let t1 = ((high - ray.o[i]) / ray.d[i]).next_up().next_up();
        if t0 > near {
            near = t0;
        }
        if t1 < far {
            far = t1;
        }
    }
    interval(near, far)
}
