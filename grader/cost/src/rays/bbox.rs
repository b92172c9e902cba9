//! Test rays for boxes.

use super::{Target, log_uniform, stored_vec};
use crate::report::{RayFamily, Shape};
use judge::cases::probes::{ProbeRng, through};
use kernels::Precision;
use kit::{Aabb, Ray, Vec3};

impl Target for Aabb {
    const SHAPE: Shape = Shape::Box;
    const SHAPES_PER_RAY: usize = 8;
    const RAY_FAMILIES: &'static [(RayFamily, &'static str)] = &[
        (
            RayFamily::Ordinary,
            "edges up to 2, distance 2 to 6; hits and misses",
        ),
        (RayFamily::Edge, "aimed at an edge, up to rounding"),
        (RayFamily::Vertex, "aimed at a corner, up to rounding"),
        (RayFamily::Sliver, "flat on one axis"),
        (RayFamily::Needle, "flat on two axes"),
        (
            RayFamily::Grazing,
            "origin in the plane of a face, parallel to it or at a slope of 1e-3 to 1e-12",
        ),
        (
            RayFamily::FarOffset,
            "ray and box at 10 to 1e6 from the world's origin",
        ),
        (RayFamily::TinyScale, "all lengths times 1e-10 to 1e-30"),
        (RayFamily::HugeScale, "all lengths times 1e10 to 1e30"),
        (RayFamily::Inside, "origin inside the box"),
        (
            RayFamily::OnTheSurface,
            "origin on a face; one ray in four is parallel to an axis",
        ),
    ];

    fn shape_and_target(dice: &mut ProbeRng) -> (Aabb, Vec3) {
        let b = random_box(dice);
        // Twice as long on each axis: an eighth of the volume, and about half of the rays.
        let target = b.centroid() + b.extent() * dice.in_cube();
        (b, target)
    }

    fn hard_pair(family: RayFamily, dice: &mut ProbeRng) -> Option<(Aabb, Ray)> {
        let mut b = random_box(dice);
        let from = dice.range(2.0, 6.0) * dice.direction();
        let axis = dice.below(3);
        let ray = match family {
            RayFamily::Edge => {
                let mut target = corner(&b, dice);
                target[axis] = inside(&b, dice)[axis];
                through(target + from, target)
            }
            RayFamily::Vertex => {
                let target = corner(&b, dice);
                through(target + from, target)
            }
            RayFamily::Sliver => {
                b.max[axis] = b.min[axis];
                let target = b.centroid() + b.extent() * dice.in_cube();
                through(target + from, target)
            }
            RayFamily::Needle => {
                for axis in [axis, (axis + 1) % 3] {
                    b.max[axis] = b.min[axis];
                }
                let target = inside(&b, dice);
                through(target + from, target)
            }
            RayFamily::Grazing => {
                let mut ray = through(inside(&b, dice) + from, inside(&b, dice));
                ray.o[axis] = dice.one_of(&[b.min, b.max])[axis];
                let off = log_uniform(dice, -12.0, -3.0);
                ray.d[axis] = dice.one_of(&[0.0, -0.0, off, -off]);
                ray
            }
            RayFamily::Inside => Ray::new(inside(&b, dice), dice.direction()),
            RayFamily::OnTheSurface => {
                let mut o = inside(&b, dice);
                o[axis] = dice.one_of(&[b.min, b.max])[axis];
                let axes = [Vec3::X, -Vec3::Y, Vec3::Z];
                let d = match dice.below(4) {
                    0 => dice.one_of(&axes),
                    _ => dice.direction(),
                };
                Ray::new(o, d)
            }
            _ => return None,
        };
        Some((b, ray))
    }

    fn transformed(&self, scale: f64, by: Vec3) -> Aabb {
        Aabb {
            min: scale * self.min + by,
            max: scale * self.max + by,
        }
    }

    fn stored(&self, precision: Precision) -> Aabb {
        Aabb {
            min: stored_vec(self.min, precision),
            max: stored_vec(self.max, precision),
        }
    }
}

fn random_box(dice: &mut ProbeRng) -> Aabb {
    Aabb::of([dice.in_cube(), dice.in_cube()])
}

fn corner(b: &Aabb, dice: &mut ProbeRng) -> Vec3 {
    Vec3::from_array([0, 1, 2].map(|axis| dice.one_of(&[b.min, b.max])[axis]))
}

/// Returns a point in the box, faces included.
fn inside(b: &Aabb, dice: &mut ProbeRng) -> Vec3 {
    let share = 0.5 * dice.in_cube() + 0.5;
    (b.min + share * b.extent()).clamp(b.min, b.max)
}
