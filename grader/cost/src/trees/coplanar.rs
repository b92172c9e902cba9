//! Scenes on which a traversal without slack is wrong: triangles that overlap in one plane, in flat
//! boxes. All are hit at the same exact `t`; which one is the closest depends on rounding, and the
//! box test rounds its entry differently.

use super::WrongHits;
use judge::cases::probes::{ProbeRng, through};
use kernels::{Builder, ClosestHit, Traversal, brute_force};
use kit::{Ray, Triangle, Vec3};

/// Triangles in one plane.
const LAYERS: usize = 64;

/// Number of planes, each with its own triangles; their axes alternate.
const PLANES: usize = 24;

/// Small leaves, so that many boxes can be pruned.
const MAX_LEAF_SIZE: usize = 2;

/// Scenes, and the hits that brute force finds in them.
pub(crate) struct CoplanarScenes {
    scenes: Vec<CoplanarScene>,
}

/// The triangles of one plane, and rays with the hit that brute force finds.
struct CoplanarScene {
    triangles: Vec<Triangle>,
    rays: Vec<(Ray, ClosestHit)>,
}

impl CoplanarScenes {
    /// Generates the scenes, with `rays` rays in all.
    pub(crate) fn new(seed: u64, rays: usize) -> CoplanarScenes {
        let mut dice = ProbeRng::new("cost overlaps", seed);
        let scenes = (0..PLANES).map(|plane| {
            let triangles = overlapping(&mut dice, plane % 3);
            let rays = (0..rays / PLANES).map(|_| {
                let target = middle(&triangles[dice.below(LAYERS)]);
                let ray = through(target + dice.range(1.0, 9.0) * dice.direction(), target);
                (ray, brute_force(&triangles, &ray))
            });
            CoplanarScene {
                rays: rays.collect(),
                triangles,
            }
        });
        CoplanarScenes {
            scenes: scenes.collect(),
        }
    }

    /// Compares the traversal of such a tree with brute force.
    pub(crate) fn wrong(&self, builder: &Builder, slack_ulp: u32) -> WrongHits {
        let wrong = self.scenes.iter().map(|CoplanarScene { triangles, rays }| {
            let bounds: Vec<_> = triangles.iter().map(Triangle::bounds).collect();
            let tree = (builder.build)(&bounds, MAX_LEAF_SIZE);
            let mut traversal = Traversal::new(slack_ulp);
            let rays = rays.iter();
            rays.filter(|(ray, truth)| traversal.closest(&tree, triangles, ray) != *truth)
                .count()
        });
        WrongHits {
            rays: self.scenes.iter().map(|scene| scene.rays.len()).sum(),
            wrong: wrong.sum(),
        }
    }
}

/// Returns triangles of many sizes in a plane perpendicular to `axis`, at a coordinate that is not
/// a round number.
fn overlapping(dice: &mut ProbeRng, axis: usize) -> Vec<Triangle> {
    let coordinate = dice.range(-3.0, 3.0);
    let mut vertex = |around: Vec3, size: f64| {
        let mut p = around + size * dice.in_cube();
        p[axis] = coordinate;
        p
    };
    (0..LAYERS)
        .map(|_| {
            let around = vertex(Vec3::ZERO, 0.3);
            let [p0, p1, p2] = [0; 3].map(|_| vertex(around, 1.0));
            Triangle::flat(p0, p1, p2)
        })
        .collect()
}

fn middle(tri: &Triangle) -> Vec3 {
    (tri.p0 + tri.p1 + tri.p2) / 3.0
}
