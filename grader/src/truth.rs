//! What is right, from the exact oracle.

use crate::course::Tier;
use crate::judge::expected::{Decision, Expected, ExpectedHit};
use kit::{Vec2, Vec3};
use wire::work::{Ray, Xyz};

/// What `ray` and a triangle have to do with each other.
pub fn triangle(_: Tier, triangle: &[Xyz; 6], ray: &Ray) -> Expected {
    let [p0, p1, p2, n0, n1, n2] = triangle.map(Vec3::from);
    let (o, d) = (Vec3::from(ray.o), Vec3::from(ray.d));
    let n = (p1 - p0).cross(p2 - p0);
    let t = (p0 - o).dot(n) / d.dot(n);
    let p = o + t * d;
    let b1 = (p2 - p).cross(p0 - p).dot(n) / n.length_squared();
    let b2 = (p0 - p).cross(p1 - p).dot(n) / n.length_squared();
    if !(b1 >= 0.0 && b2 >= 0.0 && b1 + b2 <= 1.0 && ray.min_t <= t && t <= ray.max_t) {
        return Expected {
            decision: Decision::Miss,
            hit: None,
        };
    }
    let hit = ExpectedHit {
        t,
        t_bound: 1e-9 * t.abs(),
        p,
        p_bound: 1e-9,
        uv: Some((Vec2::new(b1, b2), 1e-9)),
        n: Some(((1.0 - b1 - b2) * n0 + b1 * n1 + b2 * n2).normalize()),
        ng: n.normalize(),
        n_bound: 1e-9,
    };
    Expected {
        decision: Decision::Hit,
        hit: Some(hit),
    }
}

/// What `ray` and a sphere have to do with each other.
pub fn sphere(_: Tier, _: &(Xyz, f64), _: &Ray) -> Expected {
    Expected {
        decision: Decision::Miss,
        hit: None,
    }
}
