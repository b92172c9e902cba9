// BEGIN SOLUTION(part1.task3)
//! A matrix a triangle, worked out beforehand, that takes the triangle to (0,0), (1,0), (0,1): nine numbers and a
//! choice of axis, and the test is three rows of it.
//!
//! D. Baldwin, M. Weber, "Fast Ray-Triangle Intersections by Coordinate Transformation", Journal of Computer Graphics
//! Techniques 5(3), 2016.

use crate::kernel::{About, Found, Hit, Test};
use crate::real::Real;
use crate::shapes::{Ray, Triangle, V3};

pub(super) struct BaldwinWeber;

/// Rows of the matrix from world space to the triangle's, each with its constant: weights of `p1` and `p2`, and the
/// height above the plane.
#[derive(Clone, Copy, Debug)]
pub(super) struct Transform<R> {
    b1: (V3<R>, R),
    b2: (V3<R>, R),
    height: (V3<R>, R),
}

impl Test for BaldwinWeber {
    type Shape = kit::Triangle;
    type Prepared<R: Real> = Transform<R>;
    type Answer<R: Real> = Hit<R>;
    type Wide = Found;

    const ABOUT: About = About {
        name: "Baldwin-Weber",
        paper: "Baldwin, Weber 2016",
        culls: false,
    };

    /// The fixed column of the paper is the axis along which the normal is longest: its entries are 0, 0 and 1, and so
    /// need not be stored. Here they are, so that the test has no branches; the paper's second variant.
    fn prepare<R: Real>(tri: &Triangle<R>) -> Transform<R> {
        let (edge1, edge2) = (tri.p1 - tri.p0, tri.p2 - tri.p0);
        let n = edge1.cross(edge2);
        let z = n.longest_axis();
        let (x, y) = ((z + 1) % 3, (z + 2) % 3);
        let inv = R::of(1.0) / n.on(z);
        let zero = R::of(0.0);
        let on_axes = |along_x: R, along_y: R, along_z: R| {
            let mut row = [zero; 3];
            (row[x], row[y], row[z]) = (along_x, along_y, along_z);
            let [x, y, z] = row;
            V3 { x, y, z }
        };
        let cross = |a: V3<R>, b: V3<R>| a.on(x) * b.on(y) - a.on(y) * b.on(x);
        Transform {
            b1: (
                on_axes(edge2.on(y) * inv, -edge2.on(x) * inv, zero),
                cross(tri.p2, tri.p0) * inv,
            ),
            b2: (
                on_axes(-edge1.on(y) * inv, edge1.on(x) * inv, zero),
                -cross(tri.p1, tri.p0) * inv,
            ),
            height: (
                on_axes(n.on(x) * inv, n.on(y) * inv, R::of(1.0)),
                -n.dot(tri.p0) * inv,
            ),
        }
    }

    #[inline(always)]
    fn test<R: Real>(to: &Transform<R>, ray: &Ray<R>) -> Option<Hit<R>> {
        let (row, constant) = to.height;
        let t = -(row.dot(ray.o) + constant) / row.dot(ray.d);
        if !ray.in_range(t) {
            return None;
        }
        let p = ray.at(t);
        let weight = |(row, constant): (V3<R>, R)| row.dot(p) + constant;
        let (b1, b2) = (weight(to.b1), weight(to.b2));
        let is_inside = b1 >= R::of(0.0) && b2 >= R::of(0.0) && b1 + b2 <= R::of(1.0);
        is_inside.then_some(Hit { t, p })
    }
}
// END SOLUTION(part1.task3)
