//! Loops over coordinates and variables declared before they are set: the style of a Java
//! programmer. Signed volumes for triangles, the quadratic formula for spheres.

pub use base::*;
use kit::{Hit, PrimId, Ray, Sphere, Triangle, TriangleHit, Vec2, Vec3};

fn det(a: Vec3, b: Vec3, c: Vec3) -> f64 {
    let mut sum = 0.0;
    for i in 0..3 {
        let j = (i + 1) % 3;
        let k = (i + 2) % 3;
        sum += a[i] * (b[j] * c[k] - b[k] * c[j]);
    }
    sum
}

fn is_between(value: f64, low: f64, high: f64) -> bool {
    if value < low {
        return false;
    }
    if value > high {
        return false;
    }
    return true;
}

pub fn test_triangle(tri: &Triangle, ray: &Ray) -> Option<TriangleHit> {
    let mut result = None;
    let a = tri.p0 - ray.o;
    let b = tri.p1 - ray.o;
    let c = tri.p2 - ray.o;
    let volume0 = det(ray.d, c, b);
    let volume1 = det(ray.d, a, c);
    let volume2 = det(ray.d, b, a);
    let total = volume0 + volume1 + volume2;
    if total != 0.0 {
        let alpha = volume0 / total;
        let beta = volume1 / total;
        let gamma = volume2 / total;
        let inside = alpha >= 0.0 && beta >= 0.0 && gamma >= 0.0;
        let normal = (tri.p1 - tri.p0).cross(tri.p2 - tri.p0);
        let distance = normal.dot(a) / normal.dot(ray.d);
        if inside && is_between(distance, ray.min_t, ray.max_t) {
            result = Some(TriangleHit { t: distance, b1: beta, b2: gamma });
        }
    }
    return result;
}

pub fn intersect_triangle(tri: &Triangle, id: PrimId, ray: &mut Ray) -> Option<Hit> {
    let found = test_triangle(tri, ray);
    if found.is_none() {
        return None;
    }
    let found = found.unwrap();
    let alpha = 1.0 - found.b1 - found.b2;
    let mut normal = Vec3::ZERO;
    for i in 0..3 {
        normal[i] = alpha * tri.n0[i] + found.b1 * tri.n1[i] + found.b2 * tri.n2[i];
    }
    let mut face = (tri.p1 - tri.p0).cross(tri.p2 - tri.p0);
    face = face / face.length();
    normal = normal / normal.length();
    let position = ray.o + ray.d * found.t;
    ray.max_t = found.t;
    return Some(Hit {
        t: found.t,
        p: position,
        n: normal,
        ng: face,
        uv: Vec2::new(found.b1, found.b2),
        prim: id,
    });
}

pub fn test_sphere(s: &Sphere, ray: &Ray) -> Option<f64> {
    let mut a = 0.0;
    let mut b = 0.0;
    let mut c = -s.radius * s.radius;
    for i in 0..3 {
        let k = ray.o[i] - s.center[i];
        a += ray.d[i] * ray.d[i];
        b += 2.0 * k * ray.d[i];
        c += k * k;
    }
    let discriminant = b * b - 4.0 * a * c;
    if discriminant < 0.0 {
        return None;
    }
    let first = (-b - discriminant.sqrt()) / (2.0 * a);
    let second = (-b + discriminant.sqrt()) / (2.0 * a);
    if first >= ray.min_t && first <= ray.max_t {
        return Some(first);
    }
    if second >= ray.min_t && second <= ray.max_t {
        return Some(second);
    }
    return None;
}

pub fn intersect_sphere(s: &Sphere, id: PrimId, ray: &mut Ray) -> Option<Hit> {
    match test_sphere(s, ray) {
        Some(distance) => {
            let position = ray.o + distance * ray.d;
            let normal = (position - s.center) / s.radius;
            ray.max_t = distance;
            return Some(Hit { t: distance, p: position, n: normal, ng: normal, uv: Vec2::ZERO, prim: id });
        }
        None => {
            return None;
        }
    }
}
