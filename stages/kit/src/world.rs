//! The tests that a traversal calls.

use crate::{Aabb, Hit, Interval, PrimId, Ray};

/// Box and primitive tests, as called by a traversal.
///
/// A traversal calls all tests through this trait. Implementations count the tests, choose the
/// kernels, and mix triangles and spheres.
///
/// ```
/// use kit::{Aabb, Hit, Interval, PrimId, Ray, World};
///
/// /// Counts the boxes that a traversal asks for, and misses all.
/// #[derive(Default)]
/// struct Counter {
///     boxes: usize,
/// }
///
/// impl World for Counter {
///     fn hit_box(&mut self, _: &Aabb, _: &Ray) -> Option<Interval> {
///         self.boxes += 1;
///         None
///     }
///     fn hit_prim(&mut self, _: PrimId, _: &mut Ray) -> Option<Hit> {
///         None
///     }
///     fn blocked(&mut self, _: PrimId, _: &Ray) -> bool {
///         false
///     }
/// }
/// ```
pub trait World {
    /// Intersects `ray` with the box `b`. Returns the part of the ray's range inside the box;
    /// `None` on a miss.
    fn hit_box(&mut self, b: &Aabb, ray: &Ray) -> Option<Interval>;

    /// Intersects `ray` with primitive `id`. On a hit within the ray's range, reduces `ray.max_t`
    /// to it.
    fn hit_prim(&mut self, id: PrimId, ray: &mut Ray) -> Option<Hit>;

    /// Whether `ray` hits primitive `id` anywhere in its range (any hit).
    fn blocked(&mut self, id: PrimId, ray: &Ray) -> bool;
}
