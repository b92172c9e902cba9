//! Where a walk without slack goes wrong: triangles that overlap in one plane, in boxes that are flat. All are hit at the
//! same true `t`; which comes out nearest is a matter of rounding, and a box's entry is rounded in another way.

use judge::cases::probes::{Dice, through};
use kernels::{Builder, Closest, Walker, brute_force};
use kit::{Ray, Triangle, Vec3};

/// Triangles on one plane.
const LAYERS: usize = 64;

/// Planes, each with triangles of its own: one axis after the other.
const PLANES: usize = 24;

/// Leaves are small, so that many boxes are skipped or not.
const MAX_LEAF_SIZE: usize = 2;

/// Scenes and what brute force finds in them.
pub(crate) struct Overlaps {
    planes: Vec<Plane>,
}

/// One plane's triangles, and rays with what brute force finds.
struct Plane {
    triangles: Vec<Triangle>,
    rays: Vec<(Ray, Closest)>,
}

impl Overlaps {
    /// `rays` rays in all.
    pub(crate) fn new(seed: u64, rays: usize) -> Overlaps {
        let mut dice = Dice::new("cost overlaps", seed);
        let planes = (0..PLANES).map(|plane| {
            let triangles = overlapping(&mut dice, plane % 3);
            let rays = (0..rays / PLANES).map(|_| {
                let target = middle(&triangles[dice.below(LAYERS)]);
                let ray = through(target + dice.range(1.0, 9.0) * dice.direction(), target);
                (ray, brute_force(&triangles, &ray))
            });
            Plane {
                rays: rays.collect(),
                triangles,
            }
        });
        Overlaps {
            planes: planes.collect(),
        }
    }

    /// Rays that there are.
    pub(crate) fn rays(&self) -> usize {
        self.planes.iter().map(|plane| plane.rays.len()).sum()
    }

    /// Rays for which a walk of such trees finds something else than brute force.
    pub(crate) fn wrong(&self, builder: &Builder, slack_ulp: u32) -> usize {
        let each = self.planes.iter().map(|Plane { triangles, rays }| {
            let bounds: Vec<_> = triangles.iter().map(Triangle::bounds).collect();
            let tree = (builder.build)(&bounds, MAX_LEAF_SIZE);
            let mut walker = Walker::new(slack_ulp);
            let rays = rays.iter();
            rays.filter(|(ray, truth)| walker.closest(&tree, triangles, ray) != *truth)
                .count()
        });
        each.sum()
    }
}

/// Triangles of many sizes on the plane across `axis` at a crooked place.
fn overlapping(dice: &mut Dice, axis: usize) -> Vec<Triangle> {
    let place = dice.range(-3.0, 3.0);
    let mut vertex = |around: Vec3, size: f64| {
        let mut p = around + size * dice.in_cube();
        p[axis] = place;
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
