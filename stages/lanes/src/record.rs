//! Points and normals at hits, as `intersect::record_triangle` and `intersect::intersect_sphere`
//! record them.

use crate::real::Real;
use crate::rounding::{CANCELLATION, CANCELLED_NORMAL};
use crate::shapes::{Ray, Sphere};
use crate::triangle::is_ordinary;
use crate::vec3::Vec3;

/// The unit geometric normal of a triangle with the edges `e1` and `e2` from its first vertex, and
/// whether it is accurate: else `intersect::record_triangle` computes it with more care.
#[inline(always)]
pub fn geometric_normal<R: Real>(e1: Vec3<R>, e2: Vec3<R>) -> (Vec3<R>, R::Mask) {
    let normal = e1.cross(e2);
    let length2 = normal.dot(normal);
    let smallest = e1.dot(e1) * e2.dot(e2) * length2.constant(CANCELLATION * CANCELLATION);
    let is_accurate = smallest.less(length2) & is_ordinary(length2);
    (normal / length2.sqrt(), is_accurate)
}

/// The point of a triangle with the barycentric weights `b1` and `b2` of its second and third
/// vertex.
#[inline(always)]
pub fn triangle_point<R: Real>(p0: Vec3<R>, e1: Vec3<R>, e2: Vec3<R>, [b1, b2]: [R; 2]) -> Vec3<R> {
    p0 + e1 * b1 + e2 * b2
}

/// The unit normal interpolated from those of the vertices; the geometric normal `ng` where they
/// cancel or are not finite.
#[inline(always)]
pub fn shading_normal<R: Real>(n: [Vec3<R>; 3], [b1, b2]: [R; 2], ng: Vec3<R>) -> Vec3<R> {
    let b0 = b1.constant(1.0) - b1 - b2;
    let normal = n[0] * b0 + n[1] * b1 + n[2] * b2;
    let length = normal.length();
    let is_defined = length.constant(CANCELLED_NORMAL).less(length)
        & length.less(length.constant(f64::INFINITY));
    (normal / length).masked_or(is_defined, ng)
}

/// The unit outward normal of a sphere where the ray hits it at `t`, and whether it is defined: at
/// a sphere so small that its points round to the centre it is not.
#[inline(always)]
pub fn sphere_normal<R: Real>(ray: &Ray<R>, sphere: &Sphere<R>, t: R) -> (Vec3<R>, R::Mask) {
    let from_center = ((ray.o - sphere.center) + ray.d * t) / sphere.radius;
    let inverse = t.constant(1.0) / from_center.length();
    let is_defined = t.constant(0.0).less(inverse) & inverse.less(inverse.constant(f64::INFINITY));
    (from_center * inverse, is_defined)
}

/// The point of a sphere with the unit normal `n`.
#[inline(always)]
pub fn sphere_point<R: Real>(sphere: &Sphere<R>, n: Vec3<R>) -> Vec3<R> {
    sphere.center + n * sphere.radius
}
