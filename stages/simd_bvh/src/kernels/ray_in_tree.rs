//! A ray in the tree's space that single precision can handle.

use crate::layout::space::{LocalRay, ORDINARY, TreeSpace};
use kit::{Ray, Vec3};

/// A ray of ordinary size in the tree's space. Its origin is moved along it to near the tree, so
/// that all coordinates have few digits before the point.
pub(crate) struct RayInTree {
    pub(crate) o: Vec3,
    /// An [`ORDINARY`] direction.
    pub(crate) d: Vec3,
    /// The range. `min_t` may be negative if the origin was moved, but no hit has a negative `t`.
    pub(crate) min_t: f64,
    pub(crate) max_t: f64,
    /// At least the distance from the origin of the world's ray to any point of the tree, in the
    /// tree's space.
    reach: f64,
    pub(crate) scale: TScale,
}

/// The relation of distances along a ray in the world and in the tree.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct TScale {
    /// A point at `t` on the world's ray is at `t·speed - start` on the other one.
    speed: f64,
    start: f64,
}

/// The largest distance of a ray origin.
pub(crate) const FARTHEST: f64 = (1 << 18) as f64;

/// The largest size of a tree. Only scenes of extreme scale have a larger one.
pub(crate) const LARGEST: f64 = 8.0;

/// Origins beyond this distance are moved.
const NEAR: f64 = 24.0;

/// This far before the point that is closest to the tree's centre: before all of the tree, whose
/// points have a distance of at most √3·[`LARGEST`] from the centre, and the hits have a `t` of
/// at least 1.
const APPROACH: f64 = 16.0;

impl RayInTree {
    /// `None` for rays of extreme size, from very far away or with a negative `min_t`.
    #[inline(always)]
    pub(crate) fn new(ray: &Ray, space: &TreeSpace) -> Option<RayInTree> {
        let LocalRay { o, d, speed } = space.ray(ray);
        let distance = o.abs().element_sum();
        // Every comparison with NaN is false.
        let is_ordinary = ORDINARY.contains(&d.abs().element_sum())
            && distance < FARTHEST
            && ray.min_t >= 0.0
            && !ray.max_t.is_nan()
            && space.size <= LARGEST;
        if !is_ordinary {
            return None;
        }
        let mut near = RayInTree {
            o,
            d,
            min_t: ray.min_t * speed,
            max_t: ray.max_t * speed,
            reach: distance + 3.0 * space.size,
            scale: TScale { speed, start: 0.0 },
        };
        if distance > NEAR {
            near.approach();
        }
        Some(near)
    }

    /// Moves the origin of a ray that starts far away towards the tree.
    fn approach(&mut self) {
        let length2 = self.d.length_squared();
        let start = -self.o.dot(self.d) / length2 - APPROACH / length2.sqrt();
        if start > 0.0 {
            self.scale.start = start;
            self.o += start * self.d;
            self.min_t -= start;
            self.max_t -= start;
        }
    }

    /// At least the error in double precision of a point on the ray, or of a vertex projected along
    /// it, in the tree's space.
    #[inline(always)]
    pub(crate) fn noise(&self) -> f32 {
        noise_within(self.reach)
    }
}

/// [`RayInTree::noise`] of a ray from which no point of the tree is farther than `reach`.
#[inline(always)]
pub(crate) fn noise_within(reach: f64) -> f32 {
    const NOISE: f64 = 1.0 / (1_u64 << 48) as f64;
    (reach * NOISE) as f32
}

impl TScale {
    /// The `t` on the ray in the tree of a point at `t` on the world's ray.
    #[inline(always)]
    pub(crate) fn local_t(self, t: f64) -> f64 {
        t * self.speed - self.start
    }
}
