//! Meshes of emitting triangles, sampled by area.

use crate::warp;
use crate::{Spectrum, Triangle, Vec2, Vec3};

/// Emitting triangles as one light, with the running sums of their areas.
///
/// ```
/// use kit::emitting_mesh::EmittingTriangle;
/// use kit::{EmittingMesh, Spectrum, Vec3};
/// let half = |p0, e1, e2| EmittingTriangle { p0, e1, e2, front: Vec3::Z };
/// let (x, y) = (Vec3::X, Vec3::Y);
/// let square = vec![half(Vec3::ZERO, x, y), half(x + y, -x, -y)];
/// let mesh = EmittingMesh::new(square, Spectrum::grey(1.0)).expect("an area");
/// assert_eq!((mesh.len(), mesh.area()), (2, 1.0));
/// let second = mesh.part(1);
/// assert_eq!((second.before, second.inverse_area), (0.5, 2.0));
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct EmittingMesh {
    triangles: Vec<EmittingTriangle>,
    /// For each triangle, the area of all triangles up to and including it.
    cumulative_areas: Vec<f64>,
    /// For each triangle, the inverse of its area.
    inverse_areas: Vec<f64>,
    /// Emitted radiance.
    pub radiance: Spectrum,
}

/// A triangle of an emitting mesh.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EmittingTriangle {
    /// First vertex.
    pub p0: Vec3,
    /// Edge to the second vertex.
    pub e1: Vec3,
    /// Edge to the third vertex.
    pub e2: Vec3,
    /// Unit normal of the emitting side.
    pub front: Vec3,
}

/// A triangle of an emitting mesh, with the numbers that sampling needs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EmittingPart {
    /// The triangle.
    pub triangle: EmittingTriangle,
    /// Total area of the triangles before it. It is sampled for areas from here on.
    pub before: f64,
    /// The inverse of its area.
    pub inverse_area: f64,
}

impl EmittingTriangle {
    /// The emitting triangle of `t`. The emitting side is the side of the vertex normals.
    pub(crate) fn of(t: &Triangle) -> EmittingTriangle {
        let (e1, e2) = (t.p1 - t.p0, t.p2 - t.p0);
        let ng = e1.cross(e2).normalize_or_zero();
        EmittingTriangle {
            p0: t.p0,
            e1,
            e2,
            front: if ng.dot(t.n0 + t.n1 + t.n2) < 0.0 {
                -ng
            } else {
                ng
            },
        }
    }
}

impl EmittingMesh {
    /// A light made of `triangles`, without those of zero area. `None` if the total area is 0 or
    /// infinite.
    pub fn new(triangles: Vec<EmittingTriangle>, radiance: Spectrum) -> Option<EmittingMesh> {
        let area = |t: &EmittingTriangle| 0.5 * t.e1.cross(t.e2).length();
        let triangles: Vec<EmittingTriangle> =
            triangles.into_iter().filter(|t| area(t) > 0.0).collect();
        let mut sum = 0.0;
        let cumulative_areas: Vec<f64> = triangles
            .iter()
            .map(|t| {
                sum += area(t);
                sum
            })
            .collect();
        let inverse_areas = triangles.iter().map(|t| 1.0 / area(t)).collect();
        (sum > 0.0 && sum.is_finite()).then_some(EmittingMesh {
            inverse_areas,
            triangles,
            cumulative_areas,
            radiance,
        })
    }

    /// Total area of all triangles.
    #[inline]
    pub fn area(&self) -> f64 {
        *self
            .cumulative_areas
            .last()
            .expect("a mesh light has at least one triangle")
    }

    /// Number of triangles.
    #[expect(
        clippy::len_without_is_empty,
        reason = "a mesh light has at least one triangle"
    )]
    #[inline]
    pub fn len(&self) -> usize {
        self.triangles.len()
    }

    /// Triangle `i`, with the numbers that sampling needs.
    #[inline]
    pub fn part(&self, i: usize) -> EmittingPart {
        EmittingPart {
            triangle: self.triangles[i],
            before: if i == 0 {
                0.0
            } else {
                self.cumulative_areas[i - 1]
            },
            inverse_area: self.inverse_areas[i],
        }
    }

    /// Samples a point uniformly over the area from `u` in [0, 1)². Returns the point and its front
    /// normal.
    #[inline]
    pub(crate) fn sample(&self, u: Vec2) -> (Vec3, Vec3) {
        let target = u.x * self.area();
        let i = self
            .cumulative_areas
            .partition_point(|&a| a <= target)
            .min(self.triangles.len() - 1);
        let EmittingPart {
            triangle: t,
            before,
            inverse_area,
        } = self.part(i);
        let within = (target - before) * inverse_area;
        let b = warp::uniform_triangle(Vec2::new(within.min(1.0), u.y));
        (t.p0 + b.x * t.e1 + b.y * t.e2, t.front)
    }
}
