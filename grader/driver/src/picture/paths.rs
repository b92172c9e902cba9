//! The picture of Part 4, task 2.

use super::given_light::Lamps;
use super::{Eye, Panel, panel};
use crate::panels;
use crate::stages::Global;
use kit::sampler::{Pattern, Sampling};
use kit::{BsdfSample, Material, PixelSampler, Scattering, Spectrum, Surface, Vec2, Vec3, warp};
use wire::light::LitWorld;
use wire::picture::{GivenScattering, View};

/// The radiance of paths through a world of rectangles.
pub(super) fn paths(
    stage: &Global,
    size: [u32; 2],
    world: &LitWorld,
    view: &View,
    max_depth: u32,
    samples: u32,
    scattering: GivenScattering,
) -> Vec<Panel> {
    let lit = panels::lit_scene(world);
    let lamps = Lamps::of(world);
    let eye = Eye::new(view);
    vec![panel(size, |x, y| {
        let ray = eye.through(x, y);
        let sampling = Sampling {
            pattern: Pattern::Sobol,
            ..Sampling::default()
        };
        let mut sampler = PixelSampler::new(x, y, sampling);
        let mut sum = Spectrum::BLACK;
        for _ in 0..samples {
            sampler.start_sample();
            sum += (stage.estimate_radiance)(
                &lit,
                &ray,
                max_depth,
                &mut sampler,
                &UniformScattering(scattering),
                &mut |ray| panels::first_hit(world, ray),
                &mut |surface: &Surface, wo, sampler: &mut PixelSampler| match surface.material {
                    Material::Diffuse { reflectance } => {
                        *reflectance * scattering.white * lamps.irradiance(surface, wo, sampler)
                    }
                    _ => Spectrum::BLACK,
                },
                &mut |throughput, _, _| Some(throughput),
            );
        }
        (sum / f64::from(samples)).to_array()
    })]
}

/// Diffuse surfaces, sampled uniformly, and mirrors.
struct UniformScattering(GivenScattering);

impl Scattering for UniformScattering {
    fn f(&self, _: &Material, _: Vec3, _: Vec3) -> Spectrum {
        Spectrum::BLACK
    }

    fn pdf(&self, _: &Material, _: Vec3, _: Vec3) -> f64 {
        0.0
    }

    fn sample(&self, material: &Material, wo: Vec3, u: Vec2, _: f64) -> Option<BsdfSample> {
        match material {
            Material::Diffuse { reflectance } => {
                let wi = warp::uniform_hemisphere(u) * 1.0_f64.copysign(wo.z);
                Some(BsdfSample {
                    wi,
                    f: *reflectance * self.0.white,
                    pdf: warp::UNIFORM_HEMISPHERE_PDF,
                    delta: false,
                })
            }
            Material::Mirror { reflectance } if wo.z != 0.0 => Some(BsdfSample {
                wi: Vec3::from(self.0.mirror) * wo,
                // Only the weight counts, f · |cos θ| / pdf.
                f: *reflectance,
                pdf: wo.z.abs(),
                delta: true,
            }),
            _ => None,
        }
    }
}
