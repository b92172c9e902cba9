//! The hit point and its normals.

use kit::{Ray, Sphere, Triangle, Vec3};

use super::dyadic::Dyadic3;
use super::roundoff::{cross_of_sizes, gamma, largest, sum};
use super::sphere::SphereVerdict;
use super::triangle::Crossing;
use super::verdict::{Kernel, PerKernel};

/// Where the hit point is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PointTruth {
    /// The point, in world space.
    pub p: Vec3,
    /// How far each coordinate of an answer may be off.
    pub tolerance: PerKernel<f64>,
}

impl PointTruth {
    /// Whether an answer is close enough.
    pub fn accepts(&self, kernel: Kernel, p: Vec3) -> bool {
        within(p, self.p, *self.tolerance.get(kernel))
    }
}

/// What a normal is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NormalTruth {
    /// The unit normal; `None` where it is not defined, as where vertex normals cancel. Then any unit vector will do.
    pub n: Option<Vec3>,
    /// How far each component of an answer may be off.
    pub tolerance: PerKernel<f64>,
}

/// How far the length of an answered normal may be from 1: a normalisation rounds 4 times or so.
const UNIT_ERROR: f64 = 1e-14;

impl NormalTruth {
    /// Whether an answer is close enough, and of unit length.
    pub fn accepts(&self, kernel: Kernel, n: Vec3) -> bool {
        let is_unit = (n.length() - 1.0).abs() <= UNIT_ERROR;
        let is_close = |truth| within(n, truth, *self.tolerance.get(kernel));
        is_unit && self.n.is_none_or(is_close)
    }

    /// The direction of `v`, whose components are known up to `error`.
    fn along(v: Vec3, error: PerKernel<f64>) -> NormalTruth {
        let length = v.length();
        // Turned by error/length, and rounded a few times.
        let tolerance = PerKernel::each(|k| 2.0 * error.get(k) / length + 2.0 * gamma(8.0));
        NormalTruth {
            n: (tolerance.textbook < 1.0).then(|| v / length),
            tolerance,
        }
    }
}

fn within(answer: Vec3, truth: Vec3, tolerance: f64) -> bool {
    tolerance == f64::INFINITY || (answer - truth).abs().max_element() <= tolerance
}

/// Where the ray's line crosses the triangle: the vertices mixed by their exact weights.
pub fn triangle_point(tri: &Triangle, at: &Crossing) -> PointTruth {
    let (b1, b2) = (at.b1.to_f64(), at.b2.to_f64());
    PointTruth {
        p: tri.p0 + b1 * (tri.p1 - tri.p0) + b2 * (tri.p2 - tri.p0),
        tolerance: at.p_tolerance,
    }
}

/// The shading normal: the vertex normals mixed by the exact weights, at unit length.
pub fn triangle_normal(tri: &Triangle, at: &Crossing) -> NormalTruth {
    let (b1, b2) = (at.b1.to_f64(), at.b2.to_f64());
    let n = (1.0 - b1 - b2) * tri.n0 + b1 * tri.n1 + b2 * tri.n2;
    let size = largest(tri.n0) + largest(tri.n1) + largest(tri.n2);
    NormalTruth::along(
        n,
        PerKernel::each(|k| size * (at.b_tolerance.get(k) + gamma(8.0))),
    )
}

/// The geometric normal, along `(p1-p0) × (p2-p0)`; `None` for a triangle without area, or one
/// that is not finite.
pub fn geometric_normal(tri: &Triangle) -> NormalTruth {
    let vertices = [tri.p0, tri.p1, tri.p2];
    if !vertices.iter().all(|v| v.is_finite()) {
        return NormalTruth::along(Vec3::ZERO, PerKernel::default());
    }
    let [p0, p1, p2] = Dyadic3::aligned(vertices);
    let exact = p1.minus(&p0).cross(&p2.minus(&p0));
    // On an exponent that brings the largest component near 1: only the direction is asked for.
    let n = Dyadic3 {
        e: -(exact.bits() as i64),
        m: exact.m,
    };
    let n = n.to_f64();
    let (e1, e2) = (tri.p1 - tri.p0, tri.p2 - tri.p0);
    let thinness = sum(cross_of_sizes(e1, e2)) / largest(e1.cross(e2));
    let error = if thinness.is_finite() {
        gamma(5.0) * thinness
    } else {
        1.0
    };
    NormalTruth::along(n, PerKernel::each(|_| error))
}

/// The hit point at a root of the sphere (0 near, 1 far); `None` if the line misses.
pub fn sphere_point(verdict: &SphereVerdict, ray: &Ray, root: usize) -> Option<PointTruth> {
    let t = verdict.roots?[root].to_f64();
    Some(PointTruth {
        p: ray.at(t),
        tolerance: verdict.p_tolerance[root],
    })
}

/// How far `p` is off the plane of the triangle, which must have an area; infinite if `p` is not finite.
pub fn off_plane(tri: &Triangle, p: Vec3) -> f64 {
    if !p.is_finite() {
        return f64::INFINITY;
    }
    let [p0, p1, p2, p] = Dyadic3::aligned([tri.p0, tri.p1, tri.p2, p]);
    let normal = p1.minus(&p0).cross(&p2.minus(&p0));
    p.minus(&p0).dot(&normal).to_f64().abs() / normal.to_f64().length()
}

/// How far `p` is off the sphere; infinite if `p` is not finite.
pub fn off_sphere(s: &Sphere, p: Vec3) -> f64 {
    if !p.is_finite() {
        return f64::INFINITY;
    }
    let [center, radius, p] = Dyadic3::aligned([s.center, Vec3::splat(s.radius), p]);
    let from_center = p.minus(&center);
    // |f| - r, without cancelling.
    let difference = &from_center.dot(&from_center) - &radius.get(0).square();
    difference.to_f64().abs() / (from_center.to_f64().length() + s.radius)
}

/// The normal at a root of the sphere (0 near, 1 far): from the centre to the hit point, at unit length.
pub fn sphere_normal(
    verdict: &SphereVerdict,
    s: &Sphere,
    ray: &Ray,
    root: usize,
) -> Option<NormalTruth> {
    let at = sphere_point(verdict, ray, root)?;
    Some(NormalTruth::along(at.p - s.center, at.tolerance))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_are_as_far_off_as_they_are() {
        let tri = Triangle::flat(Vec3::ZERO, Vec3::X, Vec3::Y);
        let p = Vec3::new(0.1, 0.7, 1e-30);
        assert_eq!(off_plane(&tri, p), 1e-30);
        let s = Sphere {
            center: Vec3::new(1.0, 2.0, 3.0),
            radius: 5.0,
        };
        assert_eq!(off_sphere(&s, Vec3::new(4.0, 6.0, 3.0)), 0.0);
        let off = off_sphere(&s, Vec3::new(1.0, 2.0, 8.0 + 1e-15));
        assert!((off / (8.0 + 1e-15 - 8.0) - 1.0).abs() < 1e-12);
        assert_eq!(off_sphere(&s, Vec3::NAN), f64::INFINITY);
    }
}
