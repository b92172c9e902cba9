//! The true hit point and its normals.

use kit::{Ray, Sphere, Triangle, Vec3};

use super::dyadic::Dyadic3;
use super::roundoff::{abs_cross, gamma, max_abs, sum_abs};
use super::sphere::SphereVerdict;
use super::triangle::Crossing;
use super::verdict::{KernelClass, PerKernel};

/// The true hit point.
///
/// ```
/// use kit::{Ray, Triangle, Vec3};
/// use oracle::{KernelClass, surface};
/// let tri = Triangle::flat(Vec3::ZERO, Vec3::X, Vec3::Y);
/// let ray = Ray::new(Vec3::new(0.25, 0.5, 2.0), Vec3::NEG_Z);
/// let crossing = oracle::triangle(&tri, &ray).crossing.expect("the ray hits");
/// let point = surface::triangle_point(&tri, &crossing);
/// assert!(point.accepts(KernelClass::Robust, Vec3::new(0.25, 0.5, 0.0)));
/// assert!(!point.accepts(KernelClass::Robust, Vec3::new(0.25, 0.5, 0.1)));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PointTruth {
    /// The point, in world space.
    pub p: Vec3,
    /// Largest error that scores, per coordinate.
    pub tolerance: PerKernel<f64>,
}

impl PointTruth {
    /// Whether an answer is within the tolerance.
    pub fn accepts(&self, kernel: KernelClass, p: Vec3) -> bool {
        within(p, self.p, *self.tolerance.get(kernel))
    }
}

/// The true normal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NormalTruth {
    /// The unit normal; `None` if it is undefined, for example because vertex normals cancel, or if
    /// rounding errors of this class of code leave none of it. Then every unit vector scores.
    pub n: PerKernel<Option<Vec3>>,
    /// Largest error that scores, per component.
    pub tolerance: PerKernel<f64>,
}

/// Largest difference from 1 of the length of an answered normal: a normalisation has about 4
/// roundings.
const UNIT_ERROR: f64 = 1e-14;

impl NormalTruth {
    /// Whether an answer is within the tolerance and has unit length.
    pub fn accepts(&self, kernel: KernelClass, n: Vec3) -> bool {
        let is_unit = (n.length() - 1.0).abs() <= UNIT_ERROR;
        let is_close = |truth| within(n, truth, *self.tolerance.get(kernel));
        is_unit && self.n.get(kernel).is_none_or(is_close)
    }

    /// Returns the normalised `v`, whose components are known up to `error`.
    fn of_vector(v: Vec3, error: PerKernel<f64>) -> NormalTruth {
        let length = v.length();
        // The direction changes by error/length, plus a few roundings.
        let tolerance = PerKernel::each(|k| 2.0 * error.get(k) / length + 2.0 * gamma(8.0));
        NormalTruth {
            n: PerKernel::each(|k| (*tolerance.get(k) < 1.0).then(|| v / length)),
            tolerance,
        }
    }
}

fn within(answer: Vec3, truth: Vec3, tolerance: f64) -> bool {
    tolerance == f64::INFINITY || (answer - truth).abs().max_element() <= tolerance
}

/// Returns the point at which the ray's line crosses the triangle: the vertices weighted by the
/// exact barycentric weights.
pub fn triangle_point(tri: &Triangle, at: &Crossing) -> PointTruth {
    let (b1, b2) = (at.b1.to_f64(), at.b2.to_f64());
    PointTruth {
        p: tri.p0 + b1 * (tri.p1 - tri.p0) + b2 * (tri.p2 - tri.p0),
        tolerance: at.p_tolerance,
    }
}

/// Returns the shading normal: the vertex normals weighted by the exact barycentric weights,
/// normalised.
pub fn triangle_normal(tri: &Triangle, at: &Crossing) -> NormalTruth {
    let (b1, b2) = (at.b1.to_f64(), at.b2.to_f64());
    let n = (1.0 - b1 - b2) * tri.n0 + b1 * tri.n1 + b2 * tri.n2;
    let size = max_abs(tri.n0) + max_abs(tri.n1) + max_abs(tri.n2);
    NormalTruth::of_vector(
        n,
        PerKernel::each(|k| size * (at.b_tolerance.get(k) + gamma(8.0))),
    )
}

/// Returns the geometric normal, along `(p1-p0) × (p2-p0)`; its `n` is `None` for a triangle
/// without area or with a vertex that is not finite.
pub fn geometric_normal(tri: &Triangle) -> NormalTruth {
    let vertices = [tri.p0, tri.p1, tri.p2];
    if !vertices.iter().all(|v| v.is_finite()) {
        return NormalTruth::of_vector(Vec3::ZERO, PerKernel::default());
    }
    let [p0, p1, p2] = Dyadic3::aligned(vertices);
    let exact = p1.minus(&p0).cross(&p2.minus(&p0));
    // Scaled so that the largest component is near 1: only the direction matters.
    let n = Dyadic3 {
        e: -(exact.bits() as i64),
        m: exact.m,
    };
    let n = n.to_f64();
    let (e1, e2) = (tri.p1 - tri.p0, tri.p2 - tri.p0);
    let thinness = sum_abs(abs_cross(e1, e2)) / max_abs(e1.cross(e2));
    let error = if thinness.is_finite() {
        gamma(5.0) * thinness
    } else {
        1.0
    };
    NormalTruth::of_vector(n, PerKernel::each(|_| error))
}

/// Returns the hit point at a root of the sphere (0 near, 1 far); `None` if the line misses.
pub fn sphere_point(verdict: &SphereVerdict, ray: &Ray, root: usize) -> Option<PointTruth> {
    let t = verdict.roots?[root].to_f64();
    Some(PointTruth {
        p: ray.at(t),
        tolerance: verdict.p_tolerance[root],
    })
}

/// Returns the distance of `p` from the plane of the triangle, which must have an area; infinite if
/// `p` is not finite.
pub fn off_plane(tri: &Triangle, p: Vec3) -> f64 {
    if !p.is_finite() {
        return f64::INFINITY;
    }
    let [p0, p1, p2, p] = Dyadic3::aligned([tri.p0, tri.p1, tri.p2, p]);
    let normal = p1.minus(&p0).cross(&p2.minus(&p0));
    p.minus(&p0).dot(&normal).to_f64().abs() / normal.to_f64().length()
}

/// Returns the distance of `p` from the sphere; infinite if `p` is not finite.
pub fn off_sphere(s: &Sphere, p: Vec3) -> f64 {
    if !p.is_finite() {
        return f64::INFINITY;
    }
    let [center, radius, p] = Dyadic3::aligned([s.center, Vec3::splat(s.radius), p]);
    let from_center = p.minus(&center);
    // |f| - r, without cancellation.
    let difference = &from_center.dot(&from_center) - &radius.get(0).square();
    difference.to_f64().abs() / (from_center.to_f64().length() + s.radius)
}

/// Returns the normal at a root of the sphere (0 near, 1 far): from the centre to the hit point,
/// normalised.
pub fn sphere_normal(
    verdict: &SphereVerdict,
    s: &Sphere,
    ray: &Ray,
    root: usize,
) -> Option<NormalTruth> {
    let at = sphere_point(verdict, ray, root)?;
    Some(NormalTruth::of_vector(at.p - s.center, at.tolerance))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn distances_from_plane_and_sphere_are_exact() {
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
