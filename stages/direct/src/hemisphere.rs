//! Part 3, task 2: light that a surface gives by itself, and direct light by looking around at random.

// BEGIN SOLUTION(part3.task2)
use kit::warp;
// END SOLUTION(part3.task2)

use kit::{Hit, LitScene, PixelSampler, Ray, Scattering, Spectrum, Surface, Vec3};

/// Light that bounces nowhere: what the surface itself emits along `wo`, the unit world direction to the viewer.
pub fn zero_bounce_radiance(surface: &Surface, wo: Vec3) -> Spectrum {
    // BEGIN SOLUTION(part3.task2)
    surface.emitted(wo)
    // STUB: kit::hole!("part3.task2", surface, wo)
    // END SOLUTION(part3.task2)
}

/// Direct light by uniform hemisphere sampling: the mean of `f · Li · |cos θi| · 2π` over `samples` directions that are
/// uniform over the hemisphere on the side of `wo`.
///
/// `wo` is the unit world direction to the viewer. `Li` is what the first surface along the direction emits towards
/// here, or [`LitScene::background`] where there is none. Rays start with [`Surface::leave`] and are traced by `trace`,
/// which answers with the closest hit. `scattering` gives `f` of directions in the local space of `surface.frame`. Each
/// direction takes numbers of its own from the sampler, one `next_2d` if it can.
///
/// Lights without extent (points, spots, suns) are never found this way: with them alone all is black. Mirrors and
/// smooth glass ([`Material::is_delta`](kit::Material::is_delta)) get nothing either, and cast no ray: no direction chosen
/// at random is theirs. 0 samples give black.
pub fn estimate_direct_lighting_hemisphere(
    lit: &LitScene,
    surface: &Surface,
    wo: Vec3,
    samples: u32,
    sampler: &mut PixelSampler,
    scattering: &impl Scattering,
    trace: &mut impl FnMut(&Ray) -> Option<Hit>,
) -> Spectrum {
    // BEGIN SOLUTION(part3.task2)
    if samples == 0 || surface.material.is_delta() {
        return Spectrum::BLACK;
    }
    let local_wo = surface.frame.to_local(wo);
    let mut sum = Spectrum::BLACK;
    for _ in 0..samples {
        let mut wi = warp::uniform_hemisphere(sampler.next_2d());
        wi.z = wi.z.copysign(local_wo.z);
        let f = scattering.f(surface.material, local_wo, wi);
        if f.is_black() {
            continue;
        }
        let d = surface.frame.to_world(wi);
        let radiance = match trace(&surface.leave(d)) {
            Some(hit) => lit.surface(&hit).emitted(-d),
            None => lit.background(d),
        };
        sum += f * radiance * (wi.z.abs() / warp::UNIFORM_HEMISPHERE_PDF);
    }
    sum / f64::from(samples)
    // STUB: kit::hole!("part3.task2", lit, surface, wo, samples, sampler, scattering, trace)
    // END SOLUTION(part3.task2)
}
