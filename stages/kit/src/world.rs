//! What a tree hangs in.

use crate::{Aabb, Hit, Interval, PrimId, Ray};

/// The boxes and primitives that a traversal asks about.
///
/// A traversal gets every answer from here: this is where tests are counted, kernels chosen
/// and triangles and spheres mixed.
pub trait World {
    /// Where `ray` is inside `b`, cut to the ray's range; `None` if nowhere.
    fn hit_box(&mut self, b: &Aabb, ray: &Ray) -> Option<Interval>;

    /// The hit of `ray` with primitive `id`, if there is one in the ray's range. On a hit
    /// `ray.max_t` is shortened to it.
    fn hit_prim(&mut self, id: PrimId, ray: &mut Ray) -> Option<Hit>;

    /// Whether primitive `id` blocks `ray` anywhere in its range.
    fn blocked(&mut self, id: PrimId, ray: &Ray) -> bool;
}
