//! Given direct light for pictures of tasks that come after Part 3.

use crate::panels::first_hit;
use kit::{PixelSampler, Ray, Spectrum, Surface, Vec3};
use wire::light::{LitWorld, Material, Panel};

/// The emitting panels of a world.
pub(super) struct Lamps<'a> {
    world: &'a LitWorld,
    lamps: Vec<(&'a Panel, Spectrum)>,
}

impl<'a> Lamps<'a> {
    pub(super) fn of(world: &'a LitWorld) -> Lamps<'a> {
        let panels = world.panels.iter();
        let lamps = panels.filter_map(|panel| match panel.material {
            Material::Emission(radiance) => Some((panel, Spectrum::from(radiance))),
            _ => None,
        });
        Lamps {
            world,
            lamps: lamps.collect(),
        }
    }

    /// The irradiance from one random point of each lamp, on the side of `wo`: the integral over
    /// the areas of the lamps.
    pub(super) fn irradiance(
        &self,
        surface: &Surface,
        wo: Vec3,
        sampler: &mut PixelSampler,
    ) -> Spectrum {
        let side = surface.frame.n * 1.0_f64.copysign(wo.dot(surface.frame.n));
        let mut sum = Spectrum::BLACK;
        for (panel, radiance) in &self.lamps {
            let share = sampler.next_2d().to_array();
            let place = [0, 1].map(|i| panel.min[i] + share[i] * (panel.max[i] - panel.min[i]));
            let towards = Vec3::from(panel.point(place)) - surface.p;
            let front = Vec3::from(panel.front());
            let (here, there) = (side.dot(towards), -front.dot(towards));
            if here <= 0.0 || there <= 0.0 {
                continue;
            }
            // Up to just before the lamp, which is at t = 1.
            let shadow_ray = Ray {
                max_t: 1.0 - 1e-6,
                ..surface.leave(towards)
            };
            if first_hit(self.world, &shadow_ray).is_none() {
                // Both cosines have the distance in their divisor.
                let distance2 = towards.length_squared();
                sum += *radiance * (here * there * panel.area() / (distance2 * distance2));
            }
        }
        sum
    }
}
