//! Finding hits: brute force or a tree. Every way finds the same hits, bit for bit.

use crate::Counters;
use crate::world::{SceneWorld, record_hit, test_primitive};
use bvh::{construct_bvh, intersect_bvh, occludes_bvh};
use kit::{Bvh, Hit, PrimId, Ray, Scene, TriangleHit, World};
use simd_bvh::{TestCounts, WideBvh};

/// The largest number of primitives in a leaf: the assignment's choice.
pub const MAX_LEAF_SIZE: usize = 4;

/// The ways to find a hit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AccelKind {
    /// Every ray tests every primitive.
    Brute,
    /// The binary tree of stage `bvh`.
    Bvh,
    /// The wide tree of stage `simd_bvh`. Paths are traced in packets of eight by stage
    /// `simd_paths`, unless direct light samples the hemisphere (`-H`), effects are forced, or
    /// batches have one or two samples (`-a 2`).
    Simd,
}

/// A way to find a hit, built for one scene.
#[derive(Clone, Debug)]
pub enum Accel {
    /// Every ray tests every primitive.
    Brute,
    /// The binary tree of stage `bvh`.
    Bvh(Bvh),
    /// The wide tree of stage `simd_bvh`.
    Simd(WideBvh),
}

impl Accel {
    /// Builds the tree over `scene`, if `kind` uses one.
    pub fn build(kind: AccelKind, scene: &Scene) -> Accel {
        match kind {
            AccelKind::Brute => Accel::Brute,
            AccelKind::Bvh => Accel::Bvh(construct_bvh(&scene.primitive_bounds(), MAX_LEAF_SIZE)),
            AccelKind::Simd => Accel::Simd(WideBvh::build_apart(&scene.triangles, &scene.spheres)),
        }
    }

    /// The closest hit of `ray` in `scene`, which the tree was built over; at equal `t` the hit
    /// with the lowest id. Shortens the ray to the hit. Primitive `skip` is never hit.
    ///
    /// Adds the tests to `counters`, but not the ray.
    #[inline]
    pub fn closest(
        &self,
        scene: &Scene,
        ray: &mut Ray,
        skip: Option<PrimId>,
        counters: &mut Counters,
    ) -> Option<Hit> {
        if let Accel::Simd(tree) = self {
            let (id, hit) = closest_in(tree, scene, ray, skip, counters)?;
            return record_hit(scene, id, ray, hit);
        }
        let mut world = SceneWorld::new(scene, skip);
        let hit = self.closest_through(scene, ray, &mut world);
        *counters += world.counters();
        hit
    }

    /// [`Accel::closest`] with tests by `world`. Panics if this is the wide tree, whose tests do
    /// not go through [`World`].
    #[inline]
    pub(crate) fn closest_through<W: World>(
        &self,
        scene: &Scene,
        ray: &mut Ray,
        world: &mut W,
    ) -> Option<Hit> {
        match self {
            Accel::Bvh(tree) => intersect_bvh(tree, ray, world),
            Accel::Simd(_) => panic!("{NO_WORLD}"),
            Accel::Brute => {
                let mut closest: Option<Hit> = None;
                for id in prims(scene) {
                    // A hit at equal `t` is also in range. The first one, which has the lowest
                    // id, is kept.
                    if let Some(hit) = world.hit_prim(id, ray)
                        && closest.is_none_or(|c| hit.t < c.t)
                    {
                        closest = Some(hit);
                    }
                }
                closest
            }
        }
    }

    /// Whether any primitive of `scene` but `skip` is hit in the range of `ray`.
    ///
    /// Adds the tests to `counters`, but not the ray.
    #[inline]
    pub fn occluded(
        &self,
        scene: &Scene,
        ray: &Ray,
        skip: Option<PrimId>,
        counters: &mut Counters,
    ) -> bool {
        if let Accel::Simd(tree) = self {
            return occluded_in(tree, scene, ray, skip, counters);
        }
        let mut world = SceneWorld::new(scene, skip);
        let blocked = self.occluded_through(scene, ray, &mut world);
        *counters += world.counters();
        blocked
    }

    /// [`Accel::occluded`] with tests by `world`. Panics if this is the wide tree.
    #[inline]
    pub(crate) fn occluded_through<W: World>(
        &self,
        scene: &Scene,
        ray: &Ray,
        world: &mut W,
    ) -> bool {
        match self {
            Accel::Bvh(tree) => occludes_bvh(tree, ray, world),
            Accel::Simd(_) => panic!("{NO_WORLD}"),
            Accel::Brute => prims(scene).any(|id| world.blocked(id, ray)),
        }
    }
}

/// The message for the wide tree where tests have to go through [`World`].
const NO_WORLD: &str = "the tests of the wide tree do not go through `World`";

fn prims(scene: &Scene) -> impl Iterator<Item = PrimId> {
    let count = u32::try_from(scene.len()).expect("fewer than 2^32 primitives");
    (0..count).map(PrimId)
}

/// The closest hit of `ray` in `scene`, whose wide tree is `tree`, before it is recorded.
#[inline]
pub(crate) fn closest_in(
    tree: &WideBvh,
    scene: &Scene,
    ray: &Ray,
    skip: Option<PrimId>,
    counters: &mut Counters,
) -> Option<(PrimId, TriangleHit)> {
    let mut tests = TestCounts::default();
    let exact = &mut |id, ray: &Ray| test_primitive(scene, id, ray);
    let hit = tree.closest(ray, skip, exact, &mut tests);
    *counters += tests;
    hit
}

/// Whether any primitive of `scene` but `skip`, whose wide tree is `tree`, is hit in the range of
/// `ray`.
#[inline]
pub(crate) fn occluded_in(
    tree: &WideBvh,
    scene: &Scene,
    ray: &Ray,
    skip: Option<PrimId>,
    counters: &mut Counters,
) -> bool {
    let mut tests = TestCounts::default();
    let exact = &mut |id, ray: &Ray| test_primitive(scene, id, ray);
    let blocked = tree.occluded(ray, skip, exact, &mut tests);
    *counters += tests;
    blocked
}
