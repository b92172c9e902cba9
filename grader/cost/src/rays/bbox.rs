//! Rays at boxes.

use super::{Target, decades, stored_vec};
use crate::report::{RayFamily, Shape};
use judge::cases::probes::{Dice, through};
use kernels::Precision;
use kit::{Aabb, Ray, Vec3};

impl Target for Aabb {
    const SHAPE: Shape = Shape::Box;
    const PER_RAY: usize = 8;
    const COLUMNS: &'static [(RayFamily, &'static str)] = &[
        (
            RayFamily::Ordinary,
            "sides up to 2, from 2 to 6 away; hits and misses",
        ),
        (RayFamily::Edge, "aimed at an edge, as far as f64 can aim"),
        (RayFamily::Vertex, "aimed at a corner"),
        (RayFamily::Sliver, "flat on one axis: a wall"),
        (RayFamily::Needle, "flat on two axes: a wire"),
        (
            RayFamily::Grazing,
            "from a point in the plane of a face, along it or at 1e-3 to 1e-12 to it",
        ),
        (
            RayFamily::FarOffset,
            "ray and box 10 to 1e6 away from the world's origin",
        ),
        (RayFamily::TinyScale, "all lengths times 1e-10 to 1e-30"),
        (RayFamily::HugeScale, "all lengths times 1e10 to 1e30"),
        (RayFamily::Inside, "starting inside"),
        (
            RayFamily::OnTheSurface,
            "starting on a face: one in four along an axis",
        ),
    ];

    fn aim(dice: &mut Dice) -> (Aabb, Vec3) {
        let b = some_box(dice);
        // Twice as long on each axis: an eighth of the volume, and some half of the rays.
        let target = b.centroid() + b.extent() * dice.in_cube();
        (b, target)
    }

    fn hard(family: RayFamily, dice: &mut Dice) -> Option<(Aabb, Ray)> {
        let mut b = some_box(dice);
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
                let off = decades(dice, -12.0, -3.0);
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

    fn placed(&self, scale: f64, by: Vec3) -> Aabb {
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

    fn faces(&self, _: &Ray) -> bool {
        true
    }
}

fn some_box(dice: &mut Dice) -> Aabb {
    Aabb::of([dice.in_cube(), dice.in_cube()])
}

fn corner(b: &Aabb, dice: &mut Dice) -> Vec3 {
    Vec3::from_array([0, 1, 2].map(|axis| dice.one_of(&[b.min, b.max])[axis]))
}

/// A point of the box, faces included.
fn inside(b: &Aabb, dice: &mut Dice) -> Vec3 {
    let share = 0.5 * dice.in_cube() + 0.5;
    (b.min + share * b.extent()).clamp(b.min, b.max)
}
