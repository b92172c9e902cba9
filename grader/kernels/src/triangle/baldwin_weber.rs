//! A precomputed matrix per triangle that maps the triangle to (0,0), (1,0), (0,1): nine numbers
//! and a choice of axis. The test multiplies by its three rows.
//!
//! D. Baldwin, M. Weber, "Fast Ray-Triangle Intersections by Coordinate Transformation", Journal of
//! Computer Graphics Techniques 5(3), 2016.

use crate::kernel::{Hit, HitF64, KernelInfo, Test};
use crate::shapes::{Ray, Triangle, Vec3};
use lanes::Scalar;

pub(super) struct BaldwinWeber;

/// Rows of the matrix from world space to triangle space, each with its constant: the weights of
/// `p1` and `p2`, and the height above the plane.
#[derive(Clone, Copy, Debug)]
pub(super) struct Transform<R> {
    b1: (Vec3<R>, R),
    b2: (Vec3<R>, R),
    height: (Vec3<R>, R),
}

impl Test for BaldwinWeber {
    type Shape = kit::Triangle;
    type Prepared<R: Scalar> = Transform<R>;
    type Answer<R: Scalar> = Hit<R>;
    type AnswerF64 = HitF64;

    const INFO: KernelInfo = KernelInfo::new("Baldwin-Weber", "Baldwin, Weber 2016");

    /// The fixed column of the paper is the axis of the largest component of the normal. Its
    /// entries are 0, 0 and 1 and need not be stored. Here they are stored, so that the test has no
    /// branches: the paper's second variant.
    fn prepare<R: Scalar>(tri: &Triangle<R>) -> Transform<R> {
        let (edge1, edge2) = (tri.p1 - tri.p0, tri.p2 - tri.p0);
        let n = edge1.cross(edge2);
        let z = n.longest_axis();
        let (x, y) = ((z + 1) % 3, (z + 2) % 3);
        let inv = R::from_f64(1.0) / n.component(z);
        let zero = R::from_f64(0.0);
        let on_axes = |along_x: R, along_y: R, along_z: R| {
            let mut row = [zero; 3];
            (row[x], row[y], row[z]) = (along_x, along_y, along_z);
            let [x, y, z] = row;
            Vec3 { x, y, z }
        };
        let cross = |a: Vec3<R>, b: Vec3<R>| {
            a.component(x) * b.component(y) - a.component(y) * b.component(x)
        };
        Transform {
            b1: (
                on_axes(edge2.component(y) * inv, -edge2.component(x) * inv, zero),
                cross(tri.p2, tri.p0) * inv,
            ),
            b2: (
                on_axes(-edge1.component(y) * inv, edge1.component(x) * inv, zero),
                -cross(tri.p1, tri.p0) * inv,
            ),
            height: (
                on_axes(n.component(x) * inv, n.component(y) * inv, R::from_f64(1.0)),
                -n.dot(tri.p0) * inv,
            ),
        }
    }

    #[inline(always)]
    fn test<R: Scalar>(to: &Transform<R>, ray: &Ray<R>) -> Option<Hit<R>> {
        let (row, constant) = to.height;
        let t = -(row.dot(ray.o) + constant) / row.dot(ray.d);
        if !ray.in_range(t) {
            return None;
        }
        let p = ray.at(t);
        let weight = |(row, constant): (Vec3<R>, R)| row.dot(p) + constant;
        let (b1, b2) = (weight(to.b1), weight(to.b2));
        let is_inside =
            b1 >= R::from_f64(0.0) && b2 >= R::from_f64(0.0) && b1 + b2 <= R::from_f64(1.0);
        is_inside.then_some(Hit { t, p })
    }
}
