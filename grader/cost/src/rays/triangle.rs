//! Rays at triangles.

use super::{Target, decades, stored_vec};
use crate::report::{RayFamily, Shape};
use judge::cases::probes::{Dice, at, through};
use kernels::Precision;
use kit::{Ray, Triangle, Vec3};

/// A normal this much shorter than the products in it, or a ray this close to the plane, may be taken for its opposite.
const SURELY_FACING: f64 = 1e-6;

impl Target for Triangle {
    const SHAPE: Shape = Shape::Triangle;
    const PER_RAY: usize = 4;
    const COLUMNS: &'static [(RayFamily, &'static str)] = &[
        (
            RayFamily::Ordinary,
            "triangles of a size, from 2 to 6 away; hits and misses",
        ),
        (RayFamily::Edge, "aimed at an edge, as far as f64 can aim"),
        (RayFamily::Vertex, "aimed at a vertex"),
        (
            RayFamily::Sliver,
            "height 1e-3 to 1e-9 of the longest edge, the third vertex above its middle",
        ),
        (
            RayFamily::Needle,
            "one edge 1e-3 to 1e-9 as long as the others",
        ),
        (
            RayFamily::Grazing,
            "at an angle of 1e-2 to 1e-9 to the plane",
        ),
        (
            RayFamily::FarOffset,
            "ray and triangle 10 to 1e6 away from the world's origin",
        ),
        (RayFamily::TinyScale, "all lengths times 1e-10 to 1e-30"),
        (RayFamily::HugeScale, "all lengths times 1e10 to 1e30"),
        (
            RayFamily::OnTheSurface,
            "starting on the triangle, up to rounding: a hit at almost 0, or none",
        ),
    ];

    fn aim(dice: &mut Dice) -> (Triangle, Vec3) {
        let tri = some_triangle(dice);
        let target = at(&tri, hit_or_miss(dice));
        (tri, target)
    }

    fn hard(family: RayFamily, dice: &mut Dice) -> Option<(Triangle, Ray)> {
        let tri = match family {
            RayFamily::Sliver => sliver(dice),
            RayFamily::Needle => needle(dice),
            _ => some_triangle(dice),
        };
        let from = |dice: &mut Dice| dice.range(2.0, 6.0) * dice.direction();
        let ray = match family {
            RayFamily::Edge => {
                let along = dice.range(0.0, 1.0);
                let b = dice.one_of(&[[along, 0.0], [0.0, along], [along, 1.0 - along]]);
                let target = at(&tri, b);
                through(target + from(dice), target)
            }
            RayFamily::Vertex => {
                let target = dice.one_of(&[tri.p0, tri.p1, tri.p2]);
                through(target + from(dice), target)
            }
            RayFamily::Sliver | RayFamily::Needle => {
                let target = at(&tri, hit_or_miss(dice));
                through(target + from(dice), target)
            }
            RayFamily::Grazing => {
                let target = at(&tri, hit_or_miss(dice));
                let aside = dice.one_of(&[-1.0, 1.0]) * decades(dice, -9.0, -2.0);
                let along = dice.direction().reject_from_normalized(tri.n0).normalize();
                let distance = dice.range(2.0, 6.0);
                through(target + distance * (along + aside * tri.n0), target)
            }
            RayFamily::OnTheSurface => Ray::new(at(&tri, dice.inside(0.01)), dice.direction()),
            _ => return None,
        };
        Some((tri, ray))
    }

    fn placed(&self, scale: f64, by: Vec3) -> Triangle {
        let place = |p: Vec3| scale * p + by;
        Triangle {
            p0: place(self.p0),
            p1: place(self.p1),
            p2: place(self.p2),
            ..*self
        }
    }

    fn stored(&self, precision: Precision) -> Triangle {
        Triangle {
            p0: stored_vec(self.p0, precision),
            p1: stored_vec(self.p1, precision),
            p2: stored_vec(self.p2, precision),
            ..*self
        }
    }

    fn faces(&self, ray: &Ray) -> bool {
        let (e1, e2) = (self.p1 - self.p0, self.p2 - self.p0);
        let size = e1.length() * e2.length() * ray.d.length();
        ray.d.dot(e1.cross(e2)) < -SURELY_FACING * size
    }
}

/// Vertices in the cube from -1 to 1, no edge short and no corner flat.
fn some_triangle(dice: &mut Dice) -> Triangle {
    loop {
        let [p0, p1, p2] = [0; 3].map(|_| dice.in_cube());
        let doubled_area = (p1 - p0).cross(p2 - p0).length();
        if doubled_area > 0.1 {
            return Triangle::flat(p0, p1, p2);
        }
    }
}

/// Weights of `p1` and `p2` of a point on the triangle, or of one in the parallelograms around it: as often the one as
/// the other.
fn hit_or_miss(dice: &mut Dice) -> [f64; 2] {
    let is_inside = |[b1, b2]: [f64; 2]| b1 >= 0.0 && b2 >= 0.0 && b1 + b2 <= 1.0;
    let wants_inside = dice.range(0.0, 1.0) < 0.5;
    loop {
        let b = [0; 2].map(|_| dice.range(-1.0, 2.0));
        if is_inside(b) == wants_inside {
            return b;
        }
    }
}

fn sliver(dice: &mut Dice) -> Triangle {
    let flat = some_triangle(dice);
    let across = (flat.p1 - flat.p0).cross(flat.n0).normalize();
    let on_edge = flat.p0 + dice.range(0.3, 0.7) * (flat.p1 - flat.p0);
    let p2 = on_edge + decades(dice, -9.0, -3.0) * across;
    Triangle::flat(flat.p0, flat.p1, p2)
}

fn needle(dice: &mut Dice) -> Triangle {
    let flat = some_triangle(dice);
    let p2 = flat.p1 + decades(dice, -9.0, -3.0) * (flat.p2 - flat.p1);
    Triangle::flat(flat.p0, flat.p1, p2)
}
