//! Test rays for spheres.

use super::{Target, log_uniform, stored_vec};
use crate::report::{RayFamily, Shape};
use judge::cases::probes::ProbeRng;
use kernels::Precision;
use kit::{Ray, Sphere, Vec3};

impl Target for Sphere {
    const SHAPE: Shape = Shape::Sphere;
    const SHAPES_PER_RAY: usize = 4;
    const RAY_FAMILIES: &'static [(RayFamily, &'static str)] = &[
        (
            RayFamily::Ordinary,
            "radius 0.2 to 1, distance 2 to 6; hits and misses",
        ),
        (RayFamily::Edge, "aimed at the rim, up to rounding"),
        (
            RayFamily::Grazing,
            "aimed 1e-2 to 1e-10 radii inside or outside the rim",
        ),
        (
            RayFamily::FarOffset,
            "sphere at 1e2 to 1e6 radii from the ray's origin",
        ),
        (RayFamily::TinyScale, "all lengths times 1e-10 to 1e-30"),
        (RayFamily::HugeScale, "all lengths times 1e10 to 1e30"),
        (
            RayFamily::Inside,
            "origin inside the sphere: the far root counts",
        ),
        (
            RayFamily::OnTheSurface,
            "origin on the sphere, up to rounding; half of the rays enter it",
        ),
    ];

    fn shape_and_target(dice: &mut ProbeRng) -> (Sphere, Vec3) {
        let s = random_sphere(dice);
        let target = s.center + 1.5 * s.radius * dice.in_cube();
        (s, target)
    }

    fn hard_pair(family: RayFamily, dice: &mut ProbeRng) -> Option<(Sphere, Ray)> {
        let s = random_sphere(dice);
        let distance = dice.range(2.0, 6.0);
        let ray = match family {
            RayFamily::Edge => dice.ray_past(&s, 1.0, distance),
            RayFamily::Grazing => {
                let aside = dice.one_of(&[-1.0, 1.0]) * log_uniform(dice, -10.0, -2.0);
                dice.ray_past(&s, 1.0 + aside, distance)
            }
            RayFamily::FarOffset => {
                let distance = s.radius * log_uniform(dice, 2.0, 6.0);
                let impact = dice.range(0.0, 2.0);
                dice.ray_past(&s, impact, distance)
            }
            RayFamily::Inside => {
                let o = s.center + 0.99 * dice.range(0.0, 1.0) * s.radius * dice.direction();
                Ray::new(o, dice.direction())
            }
            RayFamily::OnTheSurface => {
                let o = s.center + s.radius * dice.direction();
                Ray::new(o, dice.direction())
            }
            _ => return None,
        };
        Some((s, ray))
    }

    fn transformed(&self, scale: f64, by: Vec3) -> Sphere {
        Sphere {
            center: scale * self.center + by,
            radius: scale * self.radius,
        }
    }

    fn stored(&self, precision: Precision) -> Sphere {
        Sphere {
            center: stored_vec(self.center, precision),
            radius: precision.stored(self.radius),
        }
    }
}

fn random_sphere(dice: &mut ProbeRng) -> Sphere {
    Sphere {
        center: dice.in_cube(),
        radius: dice.range(0.2, 1.0),
    }
}
