//! The pictures of Part 3, tasks 2 and 3.

use super::{Eye, Panel, panel};
use crate::panels;
use crate::stages::Direct;
use kit::sampler::{Pattern, Sampling};
use kit::{Material, PixelSampler, Scattering, Spectrum, Vec2, Vec3};
use wire::direct::Strategy;
use wire::light::LitWorld;
use wire::picture::{GivenScattering, View};

/// Emission and direct light.
pub(super) fn direct(
    stage: &Direct,
    size: [u32; 2],
    world: &LitWorld,
    view: &View,
    strategy: Strategy,
    samples: u32,
    scattering: GivenScattering,
) -> Vec<Panel> {
    let lit = panels::lit_scene(world);
    let eye = Eye::new(view);
    vec![panel(size, |x, y| {
        let ray = eye.through(x, y);
        let Some(hit) = panels::first_hit(world, &ray) else {
            return lit.background(ray.d).to_array();
        };
        let (surface, wo) = (lit.surface(&hit), -ray.d);
        let mut sampler = PixelSampler::new(
            x,
            y,
            Sampling {
                pattern: Pattern::Sobol,
                ..Sampling::default()
            },
        );
        sampler.start_sample();
        let mut radiance = match strategy {
            Strategy::Lights => surface.emitted(wo),
            Strategy::ZeroBounce | Strategy::Hemisphere => {
                (stage.zero_bounce_radiance)(&surface, wo)
            }
        };
        let (s, f) = (&mut sampler, &GivenDiffuse(scattering));
        radiance += match strategy {
            Strategy::ZeroBounce => Spectrum::BLACK,
            Strategy::Hemisphere => (stage.estimate_direct_lighting_hemisphere)(
                &lit,
                &surface,
                wo,
                samples,
                s,
                f,
                &mut |ray| panels::first_hit(world, ray),
            ),
            Strategy::Lights => (stage.estimate_direct_lighting_importance)(
                &lit,
                &surface,
                wo,
                samples,
                s,
                f,
                &mut |ray| panels::first_hit(world, ray).is_some(),
            ),
        };
        radiance.to_array()
    })]
}

/// Given scattering, so that the picture of a task is right before task 1 is written.
struct GivenDiffuse(GivenScattering);

impl Scattering for GivenDiffuse {
    fn f(&self, material: &Material, wo: Vec3, wi: Vec3) -> Spectrum {
        match material {
            Material::Diffuse { reflectance } if wo.z * wi.z > 0.0 => *reflectance * self.0.white,
            _ => Spectrum::BLACK,
        }
    }

    fn pdf(&self, _: &Material, _: Vec3, _: Vec3) -> f64 {
        0.0
    }

    fn sample(&self, _: &Material, _: Vec3, _: Vec2, _: f64) -> Option<kit::BsdfSample> {
        None
    }
}
