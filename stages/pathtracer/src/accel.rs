//! How the closest hit is found: by asking every primitive, or through a tree. All ways find the same, bit for bit.

use crate::SceneWorld;
use bvh::{construct_bvh, intersect_bvh, occludes_bvh};
use kit::{Bvh, Hit, PrimId, Ray, Scene, TriangleHit, World};
use simd_bvh::{WideBvh, Work};

/// Primitives in a leaf at most: the assignment's choice.
pub const MAX_LEAF_SIZE: usize = 4;

/// The ways to find a hit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AccelKind {
    /// Every ray asks every primitive.
    Brute,
    /// The tree of stage `bvh`.
    Bvh,
    /// The tree of stage `simd_bvh`; and light is followed along eight paths at a time, by stage `simd_paths`, unless
    /// light is looked for around, effects are forced, or one or two samples are asked for at a time (`-a 2`).
    Simd,
}

/// A way to find a hit, ready for one scene.
#[derive(Clone, Debug)]
pub enum Accel {
    /// Every ray asks every primitive.
    Brute {
        /// How many there are.
        primitives: u32,
    },
    /// The tree of stage `bvh`.
    Bvh(Bvh),
    /// The tree of stage `simd_bvh`.
    Simd(WideBvh),
}

impl Accel {
    /// Gets ready for `scene`: builds the tree, if it takes one.
    pub fn build(kind: AccelKind, scene: &Scene) -> Accel {
        match kind {
            AccelKind::Brute => Accel::Brute {
                primitives: u32::try_from(scene.len()).expect("fewer than 2^32 primitives"),
            },
            AccelKind::Bvh => Accel::Bvh(construct_bvh(&scene.primitive_bounds(), MAX_LEAF_SIZE)),
            AccelKind::Simd => Accel::Simd(WideBvh::build(&scene.triangles, &scene.spheres)),
        }
    }

    /// The closest hit of `ray` in `world`, the one with the lowest id at equal `t`; shortens the ray to it.
    pub fn closest(&self, ray: &mut Ray, world: &mut SceneWorld<'_>) -> Option<Hit> {
        match self {
            Accel::Bvh(tree) => intersect_bvh(tree, ray, world),
            Accel::Simd(tree) => {
                let (id, hit) = closest_in(tree, ray, world)?;
                world.record(id, ray, hit)
            }
            Accel::Brute { primitives } => {
                let mut closest: Option<Hit> = None;
                for id in (0..*primitives).map(PrimId) {
                    // Equal `t` is in range once more: the first one, with the lowest id, stays.
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

    /// Whether anything in `world` is in the range of `ray`.
    pub fn occluded(&self, ray: &Ray, world: &mut SceneWorld<'_>) -> bool {
        match self {
            Accel::Bvh(tree) => occludes_bvh(tree, ray, world),
            Accel::Simd(tree) => occluded_in(tree, ray, world),
            Accel::Brute { primitives } => (0..*primitives)
                .map(PrimId)
                .any(|id| world.blocked(id, ray)),
        }
    }
}

/// The closest hit of `ray` in `world`, whose wide tree is `tree`, before it is recorded.
#[inline]
pub(crate) fn closest_in(
    tree: &WideBvh,
    ray: &Ray,
    world: &mut SceneWorld<'_>,
) -> Option<(PrimId, TriangleHit)> {
    let mut work = Work::default();
    let exact = &mut |id, ray: &Ray| world.test(id, ray);
    let found = tree.closest(ray, world.left, exact, &mut work);
    world.counters.add_work(work);
    found
}

/// Whether anything in `world`, whose wide tree is `tree`, is in the range of `ray`.
#[inline]
pub(crate) fn occluded_in(tree: &WideBvh, ray: &Ray, world: &mut SceneWorld<'_>) -> bool {
    let mut work = Work::default();
    let exact = &mut |id, ray: &Ray| world.test(id, ray);
    let blocked = tree.occluded(ray, world.left, exact, &mut work);
    world.counters.add_work(work);
    blocked
}
