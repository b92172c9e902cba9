//! Transforms shapes to world space.

use super::limits::in_world;
use super::transform::Affine;
use kit::{Sphere, Triangle, Vec2, Vec3};

/// Relative tolerance for a transform that keeps a sphere a sphere: of the lengths of its axes, and
/// of the angles between them. Files have matrices with about 7 digits.
const SIMILARITY_TOLERANCE: f64 = 1e-5;

/// Transforms triangles to world space; normals use the inverse transpose.
///
/// A mirroring transform would reverse the winding order relative to the normals, so `p1` and `p2`
/// are swapped. A triangle without area after the transform is kept: no ray hits it.
pub(crate) struct TriangleTransform {
    to_world: Affine,
    normals: kit::Mat3,
    mirrors: bool,
}

impl TriangleTransform {
    pub(crate) fn new(to_world: Affine) -> TriangleTransform {
        TriangleTransform {
            normals: to_world.for_normals(),
            mirrors: to_world.mirrors(),
            to_world,
        }
    }

    /// The triangle in world space; `None` if a coordinate is too large.
    pub(crate) fn triangle(&self, local: &Triangle) -> Option<Triangle> {
        let [p0, mut p1, mut p2] = [local.p0, local.p1, local.p2].map(|p| self.to_world.point(p));
        if ![p0, p1, p2].into_iter().all(in_world) {
            return None;
        }
        let [n0, mut n1, mut n2] = [local.n0, local.n1, local.n2];
        if self.mirrors {
            std::mem::swap(&mut p1, &mut p2);
            std::mem::swap(&mut n1, &mut n2);
        }
        let transformed =
            |n: Vec3| unit(self.normals * n).unwrap_or_else(|| Triangle::flat(p0, p1, p2).n0);
        Some(Triangle::smooth(
            [p0, p1, p2],
            [n0, n1, n2].map(transformed),
        ))
    }
}

impl TriangleTransform {
    /// Reorders the texture coordinates of a triangle like its vertices.
    pub(crate) fn tex_coords(&self, [a, b, c]: [Vec2; 3]) -> [Vec2; 3] {
        if self.mirrors { [a, c, b] } else { [a, b, c] }
    }
}

/// Whether a triangle has no area.
pub(super) fn is_flat(triangle: &Triangle) -> bool {
    let (a, b) = (triangle.p1 - triangle.p0, triangle.p2 - triangle.p0);
    // Scaled, so that the product of two short edges does not underflow.
    match (unit(a), unit(b)) {
        (Some(a), Some(b)) => a.cross(b) == Vec3::ZERO,
        _ => true,
    }
}

/// `v` normalised without overflow or underflow.
fn unit(v: Vec3) -> Option<Vec3> {
    (v / v.abs().max_element()).try_normalize()
}

/// Why a sphere cannot be transformed.
#[derive(Debug, PartialEq)]
pub(super) enum SphereError {
    /// It would become an ellipsoid with these semi-axes.
    Ellipsoid([f64; 3]),
    /// A coordinate is too large.
    TooLarge,
}

/// Transforms a sphere around the origin. The transform may rotate, mirror, translate and scale
/// uniformly.
pub(super) fn sphere(radius: f64, to_world: &Affine) -> Result<Sphere, SphereError> {
    let m = &to_world.m;
    let axes = [m.x_axis, m.y_axis, m.z_axis];
    let [x, y, z] = axes.map(Vec3::length);
    let scale = x.max(y).max(z);
    if !in_world(Vec3::splat(scale * radius)) || !in_world(to_world.t) {
        return Err(SphereError::TooLarge);
    }
    let tolerance = SIMILARITY_TOLERANCE * scale;
    let orthogonal = [(0, 1), (1, 2), (2, 0)]
        .iter()
        .all(|(i, j)| axes[*i].dot(axes[*j]).abs() <= tolerance * scale);
    if scale - x.min(y).min(z) > tolerance || !orthogonal {
        return Err(SphereError::Ellipsoid([x, y, z].map(|s| s * radius)));
    }
    Ok(Sphere {
        center: to_world.t,
        radius: radius * scale,
    })
}
