//! Axis-aligned bounding boxes.

use crate::Vec3;

/// Axis-aligned box: the points `p` with `min <= p <= max` on every axis, in world space.
///
/// Points on the faces belong to the box.
///
/// ```
/// use kit::{Aabb, Vec3};
/// let unit = Aabb::of([Vec3::ZERO, Vec3::ONE]);
/// let larger = unit.grown_by(Vec3::new(3.0, 0.5, 0.5));
/// assert_eq!(larger.max, Vec3::new(3.0, 1.0, 1.0));
/// assert_eq!(Aabb::EMPTY.union(unit), unit);
/// assert!(Aabb::EMPTY.is_empty() && !unit.is_empty());
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Aabb {
    /// Corner with the smallest coordinates.
    pub min: Vec3,
    /// Corner with the largest coordinates.
    pub max: Vec3,
}

impl Aabb {
    /// The empty box: `min` is +∞ and `max` is -∞. Its union with a point is the box of that point.
    pub const EMPTY: Aabb = Aabb {
        min: Vec3::INFINITY,
        max: Vec3::NEG_INFINITY,
    };

    /// The smallest box that contains all of `points`; [`Aabb::EMPTY`] if there are none.
    pub fn of(points: impl IntoIterator<Item = Vec3>) -> Aabb {
        points.into_iter().fold(Aabb::EMPTY, Aabb::grown_by)
    }

    /// The smallest box that contains this one and the point `p`.
    #[must_use]
    #[inline]
    pub fn grown_by(self, p: Vec3) -> Aabb {
        Aabb {
            min: self.min.min(p),
            max: self.max.max(p),
        }
    }

    /// The smallest box that contains this one and `other`.
    #[must_use]
    #[inline]
    pub fn union(self, other: Aabb) -> Aabb {
        Aabb {
            min: self.min.min(other.min),
            max: self.max.max(other.max),
        }
    }

    /// Whether the box contains no point. A box with a NaN coordinate counts as empty.
    #[inline]
    pub fn is_empty(&self) -> bool {
        !(self.min.x <= self.max.x && self.min.y <= self.max.y && self.min.z <= self.max.z)
    }

    /// The centre. Halves before it adds, so that coordinates near the largest float do not
    /// overflow.
    #[inline]
    pub fn centroid(&self) -> Vec3 {
        0.5 * self.min + 0.5 * self.max
    }

    /// Edge lengths, `max - min`, one for each axis.
    #[inline]
    pub fn extent(&self) -> Vec3 {
        self.max - self.min
    }

    /// Total area of the six faces; 0 for an empty box.
    #[inline]
    pub fn surface_area(&self) -> f64 {
        if self.is_empty() {
            return 0.0;
        }
        let e = self.extent();
        2.0 * (e.x * e.y + e.y * e.z + e.z * e.x)
    }

    /// Whether `other` lies inside this box. Touching faces count; every box contains an empty one.
    #[inline]
    pub fn contains(&self, other: &Aabb) -> bool {
        other.is_empty() || (self.min.cmple(other.min).all() && self.max.cmpge(other.max).all())
    }
}
