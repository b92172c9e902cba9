//! Why a picture of light is black.

use crate::tracer::RayOrigin;
use crate::{Accel, Counters, DirectSampling, Job, LightSettings};
use kit::sampler::Sampling;
use kit::shading_normal::{Sides, towards_viewer};
use kit::{LitScene, Material, PixelSampler, Spectrum, Vec2};
use raygen::generate_ray;

/// The reason that explains the most of a black picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Darkness {
    /// No camera ray hits a surface.
    NothingSeen,
    /// There is no light source.
    NoLight,
    /// The ray depth is 0, and the camera sees no lamp.
    DepthZero,
    /// All lights are point, spot or directional ones, which hemisphere sampling never finds.
    OnlyDeltaLights,
    /// The surfaces that the camera sees reflect nothing, such as the back of a lamp.
    BlackSurfaces,
    /// No light shines towards the surfaces: they are behind the lamps, or outside of their cones.
    BehindLights,
    /// The surfaces face away from all lights.
    FacingAway,
    /// Between the surfaces and the lights is something else.
    Shadowed,
    /// None of these.
    Other,
}

/// The camera rays that are traced in each direction.
const RAYS: u32 = 32;

/// The samples of each light at each hit.
const SAMPLES: u32 = 4;

/// Why the picture of `job` is black: the first obstacle that no light passes, on its way from the
/// lights to surfaces that camera rays hit.
pub fn darkness(lit: &LitScene, accel: &Accel, job: &Job, settings: &LightSettings) -> Darkness {
    if !lit.has_light() {
        return Darkness::NoLight;
    }
    let counters = &mut Counters::default();
    let sampler = &mut PixelSampler::new(0, 0, Sampling::from(0));
    // How far light comes at any hit, as the obstacle that stops it there.
    let mut furthest = Darkness::NothingSeen;
    let mut passes = |obstacle: Darkness| {
        if obstacle as u8 > furthest as u8 {
            furthest = obstacle;
        }
    };
    for i in 0..RAYS * RAYS {
        let (x, y) = (f64::from(i % RAYS) + 0.5, f64::from(i / RAYS) + 0.5);
        let (w, h) = (job.cell.x1 - job.cell.x0, job.cell.y1 - job.cell.y0);
        let pixel = Vec2::new(
            f64::from(job.cell.x0) + x / f64::from(RAYS) * f64::from(w),
            f64::from(job.cell.y0) + y / f64::from(RAYS) * f64::from(h),
        );
        let film = Vec2::new(f64::from(job.film.w), f64::from(job.film.h));
        let ray = generate_ray(&job.camera, pixel / film);
        let Some(hit) = accel.closest(&lit.scene, &mut { ray }, None, counters) else {
            continue;
        };
        if settings.max_depth == 0 {
            passes(Darkness::DepthZero);
            continue;
        }
        let only_delta = lit.emitters.iter().all(|emitter| emitter.is_delta());
        if settings.direct_sampling == DirectSampling::Hemisphere && only_delta {
            passes(Darkness::OnlyDeltaLights);
            continue;
        }
        let surface = lit.surface(&towards_viewer(lit, hit, ray.d));
        if surface.material.is_delta() {
            passes(Darkness::Other);
            continue;
        }
        passes(Darkness::BlackSurfaces);
        if reflects_nothing(surface.material) {
            continue;
        }
        passes(Darkness::BehindLights);
        let wo = surface.frame.to_local(-ray.d);
        for emitter in &lit.emitters {
            for _ in 0..SAMPLES {
                let Some(light) = emitter.sample(surface.p, sampler.next_2d()) else {
                    continue;
                };
                passes(Darkness::FacingAway);
                let wi = surface.frame.to_local(light.wi);
                let is_opaque = !surface.material.lets_light_through();
                let faces_away =
                    wo.z * wi.z <= 0.0 || Sides::of(&surface).block(surface.material, wo, wi);
                if is_opaque && faces_away {
                    continue;
                }
                passes(Darkness::Shadowed);
                let shadow = surface.shadow_ray(&light);
                let skip = RayOrigin::from(&surface).skip(&lit.scene, shadow.d);
                if !accel.occluded(&lit.scene, &shadow, skip, counters) {
                    passes(Darkness::Other);
                }
            }
        }
    }
    furthest
}

fn reflects_nothing(material: &Material) -> bool {
    match material {
        Material::Diffuse { reflectance } | Material::Glossy { reflectance, .. } => {
            *reflectance == Spectrum::BLACK
        }
        Material::Emission { .. } => true,
        _ => false,
    }
}
