//! Test rays for triangles.

use super::{Target, log_uniform, stored_vec};
use crate::report::{RayFamily, Shape};
use judge::cases::probes::{ProbeRng, at, through};
use kernels::Precision;
use kit::{Ray, Triangle, Vec3};

/// Relative size of `d·n` below which rounding may exchange front and back face: the normal is this
/// much shorter than the products in it, or the ray this close to parallel.
const FACING_TOLERANCE: f64 = 1e-6;

impl Target for Triangle {
    const SHAPE: Shape = Shape::Triangle;
    const SHAPES_PER_RAY: usize = 4;
    const RAY_FAMILIES: &'static [(RayFamily, &'static str)] = &[
        (
            RayFamily::Ordinary,
            "triangles of similar size, distance 2 to 6; hits and misses",
        ),
        (RayFamily::Edge, "aimed at an edge, up to rounding"),
        (RayFamily::Vertex, "aimed at a vertex, up to rounding"),
        (
            RayFamily::Sliver,
            "height 1e-3 to 1e-9 of the longest edge, third vertex above the middle of that edge",
        ),
        (
            RayFamily::Needle,
            "one edge 1e-3 to 1e-9 times as long as the others",
        ),
        (
            RayFamily::Grazing,
            "at an angle of 1e-2 to 1e-9 to the plane",
        ),
        (
            RayFamily::FarOffset,
            "ray and triangle at 10 to 1e6 from the world's origin",
        ),
        (RayFamily::TinyScale, "all lengths times 1e-10 to 1e-30"),
        (RayFamily::HugeScale, "all lengths times 1e10 to 1e30"),
        (
            RayFamily::OnTheSurface,
            "origin on the triangle, up to rounding: a hit at almost t = 0, or a miss",
        ),
    ];

    fn shape_and_target(dice: &mut ProbeRng) -> (Triangle, Vec3) {
        let tri = random_triangle(dice);
        let target = at(&tri, hit_or_miss(dice));
        (tri, target)
    }

    fn hard_pair(family: RayFamily, dice: &mut ProbeRng) -> Option<(Triangle, Ray)> {
        let tri = match family {
            RayFamily::Sliver => sliver(dice),
            RayFamily::Needle => needle(dice),
            _ => random_triangle(dice),
        };
        let from = |dice: &mut ProbeRng| dice.range(2.0, 6.0) * dice.direction();
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
                let aside = dice.one_of(&[-1.0, 1.0]) * log_uniform(dice, -9.0, -2.0);
                let along = dice.direction().reject_from_normalized(tri.n0).normalize();
                let distance = dice.range(2.0, 6.0);
                through(target + distance * (along + aside * tri.n0), target)
            }
            RayFamily::OnTheSurface => Ray::new(at(&tri, dice.inside(0.01)), dice.direction()),
            _ => return None,
        };
        Some((tri, ray))
    }

    fn transformed(&self, scale: f64, by: Vec3) -> Triangle {
        let transform = |p: Vec3| scale * p + by;
        Triangle {
            p0: transform(self.p0),
            p1: transform(self.p1),
            p2: transform(self.p2),
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

    fn is_front_facing(&self, ray: &Ray) -> bool {
        let (e1, e2) = (self.p1 - self.p0, self.p2 - self.p0);
        let size = e1.length() * e2.length() * ray.d.length();
        ray.d.dot(e1.cross(e2)) < -FACING_TOLERANCE * size
    }
}

/// Returns a triangle with vertices in the cube from -1 to 1 and a minimum area, so that no edge is
/// short and no angle is flat.
fn random_triangle(dice: &mut ProbeRng) -> Triangle {
    loop {
        let [p0, p1, p2] = [0; 3].map(|_| dice.in_cube());
        let doubled_area = (p1 - p0).cross(p2 - p0).length();
        if doubled_area > 0.1 {
            return Triangle::flat(p0, p1, p2);
        }
    }
}

/// Returns the weights of `p1` and `p2` of a point, in the triangle or outside it with equal
/// probability.
fn hit_or_miss(dice: &mut ProbeRng) -> [f64; 2] {
    let is_inside = |[b1, b2]: [f64; 2]| b1 >= 0.0 && b2 >= 0.0 && b1 + b2 <= 1.0;
    let wants_inside = dice.range(0.0, 1.0) < 0.5;
    loop {
        let b = [0; 2].map(|_| dice.range(-1.0, 2.0));
        if is_inside(b) == wants_inside {
            return b;
        }
    }
}

fn sliver(dice: &mut ProbeRng) -> Triangle {
    let flat = random_triangle(dice);
    let across = (flat.p1 - flat.p0).cross(flat.n0).normalize();
    let on_edge = flat.p0 + dice.range(0.3, 0.7) * (flat.p1 - flat.p0);
    let p2 = on_edge + log_uniform(dice, -9.0, -3.0) * across;
    Triangle::flat(flat.p0, flat.p1, p2)
}

fn needle(dice: &mut ProbeRng) -> Triangle {
    let flat = random_triangle(dice);
    let p2 = flat.p1 + log_uniform(dice, -9.0, -3.0) * (flat.p2 - flat.p1);
    Triangle::flat(flat.p0, flat.p1, p2)
}
