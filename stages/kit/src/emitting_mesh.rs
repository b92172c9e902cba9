//! Surfaces that emit, as one light: triangles chosen by their area.

use crate::warp;
use crate::{Spectrum, Triangle, Vec2, Vec3};

/// Triangles that emit, and their areas summed up.
#[derive(Clone, Debug, PartialEq)]
pub struct EmittingMesh {
    triangles: Vec<EmittingTriangle>,
    /// Area of the triangles up to and with this one.
    area_up_to: Vec<f64>,
    /// For each triangle, one over its area.
    inverse_areas: Vec<f64>,
    /// Emitted radiance.
    pub radiance: Spectrum,
}

/// One of them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EmittingTriangle {
    /// First vertex.
    pub p0: Vec3,
    /// Edge to the second vertex.
    pub e1: Vec3,
    /// Edge to the third vertex.
    pub e2: Vec3,
    /// Unit normal of the side that shines.
    pub front: Vec3,
}

/// A triangle of a mesh that emits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EmittingPart {
    /// The triangle.
    pub triangle: EmittingTriangle,
    /// Area of the triangles before it: it is chosen from there on.
    pub before: f64,
    /// One over its own area.
    pub inverse_area: f64,
}

impl EmittingTriangle {
    /// The triangle as a light: the side that shines is the side of its vertex normals.
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
    /// A light made of `triangles`; those without area are left out. `None` if no area is left.
    pub fn new(triangles: Vec<EmittingTriangle>, radiance: Spectrum) -> Option<EmittingMesh> {
        let area = |t: &EmittingTriangle| 0.5 * t.e1.cross(t.e2).length();
        let triangles: Vec<EmittingTriangle> =
            triangles.into_iter().filter(|t| area(t) > 0.0).collect();
        let mut sum = 0.0;
        let area_up_to: Vec<f64> = triangles
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
            area_up_to,
            radiance,
        })
    }

    /// Area of all triangles.
    #[inline]
    pub fn area(&self) -> f64 {
        *self.area_up_to.last().expect("a light has a triangle")
    }

    /// How many triangles there are.
    #[expect(clippy::len_without_is_empty, reason = "a light has a triangle")]
    #[inline]
    pub fn len(&self) -> usize {
        self.triangles.len()
    }

    /// Triangle number `i`, and what it takes to know whether and where it is chosen.
    #[inline]
    pub fn part(&self, i: usize) -> EmittingPart {
        EmittingPart {
            triangle: self.triangles[i],
            before: if i == 0 { 0.0 } else { self.area_up_to[i - 1] },
            inverse_area: self.inverse_areas[i],
        }
    }

    /// A point uniform over the area and the normal there, from `u` in [0, 1)².
    #[inline]
    pub(crate) fn sample(&self, u: Vec2) -> (Vec3, Vec3) {
        let target = u.x * self.area();
        let i = self
            .area_up_to
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
