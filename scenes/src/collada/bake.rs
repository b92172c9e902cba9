//! Shapes placed into the world.

use super::limits::in_world;
use super::transform::Affine;
use kit::{Sphere, Triangle, Vec2, Vec3};

/// How much the lengths of a sphere's transformed axes may differ, and how far they may be from
/// perpendicular, relative to their length. Files write matrices with about 7 digits.
const SAME_SCALE: f64 = 1e-5;

/// Places triangles; normals go by the inverse transpose. A mirroring transform would turn the winding
/// against the normals, so there `p1` and `p2` change places. A triangle that the transform leaves
/// without area is kept: it is never hit.
pub(super) struct Placer {
    to_world: Affine,
    normals: kit::Mat3,
    mirrors: bool,
}

impl Placer {
    pub(super) fn new(to_world: Affine) -> Placer {
        Placer {
            normals: to_world.for_normals(),
            mirrors: to_world.mirrors(),
            to_world,
        }
    }

    /// The triangle in world space; `None` if a coordinate is too large.
    pub(super) fn triangle(&self, local: &Triangle) -> Option<Triangle> {
        let [p0, mut p1, mut p2] = [local.p0, local.p1, local.p2].map(|p| self.to_world.point(p));
        if ![p0, p1, p2].into_iter().all(in_world) {
            return None;
        }
        let [n0, mut n1, mut n2] = [local.n0, local.n1, local.n2];
        if self.mirrors {
            std::mem::swap(&mut p1, &mut p2);
            std::mem::swap(&mut n1, &mut n2);
        }
        let turned =
            |n: Vec3| unit(self.normals * n).unwrap_or_else(|| Triangle::flat(p0, p1, p2).n0);
        Some(Triangle {
            p0,
            p1,
            p2,
            n0: turned(n0),
            n1: turned(n1),
            n2: turned(n2),
        })
    }
}

impl Placer {
    /// The texture coordinates of a triangle's vertices, in the order in which they are placed.
    pub(super) fn on_texture(&self, [a, b, c]: [Vec2; 3]) -> [Vec2; 3] {
        if self.mirrors { [a, c, b] } else { [a, b, c] }
    }
}

/// The direction of `v`, also where its length under- or overflows.
fn unit(v: Vec3) -> Option<Vec3> {
    (v / v.abs().max_element()).try_normalize()
}

/// Why a sphere cannot be placed.
#[derive(Debug, PartialEq)]
pub(super) enum SphereError {
    /// It would become an ellipsoid with these half axes.
    Ellipsoid([f64; 3]),
    /// A coordinate is too large.
    TooLarge,
}

/// Places a sphere about the origin. The transform may turn, mirror and scale, the same along every axis.
pub(super) fn sphere(radius: f64, to_world: &Affine) -> Result<Sphere, SphereError> {
    let m = &to_world.m;
    let axes = [m.x_axis, m.y_axis, m.z_axis];
    let [x, y, z] = axes.map(Vec3::length);
    let scale = x.max(y).max(z);
    if !in_world(Vec3::splat(scale * radius)) || !in_world(to_world.t) {
        return Err(SphereError::TooLarge);
    }
    let slack = SAME_SCALE * scale;
    let square = [(0, 1), (1, 2), (2, 0)]
        .iter()
        .all(|(i, j)| axes[*i].dot(axes[*j]).abs() <= slack * scale);
    if scale - x.min(y).min(z) > slack || !square {
        return Err(SphereError::Ellipsoid([x, y, z].map(|s| s * radius)));
    }
    Ok(Sphere {
        center: to_world.t,
        radius: radius * scale,
    })
}
