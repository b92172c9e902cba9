//! The functions of the stage `bvh`, for any world.

use driver::stages;
use kit::{Aabb, Hit, Interval, PrimId, Ray, World};

pub(crate) const STAGE: stages::Bvh = stages::Bvh {
    construct_bvh: bvh::construct_bvh,
    intersect_bvh: |tree, ray, world| bvh::intersect_bvh(tree, ray, &mut Given(world)),
    occludes_bvh: |tree, ray, world| bvh::occludes_bvh(tree, ray, &mut Given(world)),
};

/// The world that the driver gives.
struct Given<'a>(&'a mut dyn World);

impl World for Given<'_> {
    fn hit_box(&mut self, b: &Aabb, ray: &Ray) -> Option<Interval> {
        self.0.hit_box(b, ray)
    }

    fn hit_prim(&mut self, id: PrimId, ray: &mut Ray) -> Option<Hit> {
        self.0.hit_prim(id, ray)
    }

    fn blocked(&mut self, id: PrimId, ray: &Ray) -> bool {
        self.0.blocked(id, ray)
    }
}
