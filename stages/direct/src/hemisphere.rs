//! Part 3, task 2: emitted light, and direct light by uniform hemisphere sampling.

// BEGIN SOLUTION(part3.task2)
use kit::warp;
// END SOLUTION(part3.task2)

use kit::{Hit, LitScene, PixelSampler, Ray, Scattering, Spectrum, Surface, Vec3};

/// Radiance without a bounce: the emission of the surface along `wo`, the unit world direction to
/// the viewer. Surfaces emit on the side of their geometric normal.
///
/// Chapter: stages/book/src/part3/task2.md
///
/// See it: `cargo grader picture part3.task2`.
pub fn zero_bounce_radiance(surface: &Surface, wo: Vec3) -> Spectrum {
    // BEGIN SOLUTION(part3.task2)
    surface.emitted(wo)
    // STUB: kit::hole!("part3.task2", surface, wo)
    // END SOLUTION(part3.task2)
}

/// Estimates direct light by uniform hemisphere sampling: the mean over `samples` directions, uniform
/// over the hemisphere on the side of `wo`, without a bias.
///
/// Chapter: stages/book/src/part3/task2.md
///
/// `wo` is the unit world direction to the viewer. `Li` is the emission of the first surface along
/// the direction, or [`LitScene::background`] if there is none. Rays start with [`Surface::leave`];
/// `trace` returns their closest hit. `scattering` evaluates `f` for directions in the local space
/// of `surface.frame`. Each direction uses its own numbers of the sampler, preferably one
/// `next_2d`.
///
/// Random directions never hit delta lights (point, spot and directional lights): with these lights
/// alone the result is black. Mirrors and smooth glass
/// ([`Material::is_delta`](kit::Material::is_delta)) are black too, and trace no rays, because a
/// random direction is never their reflected or refracted direction. 0 samples give black. The
/// emission of `surface` itself is no direct light: it is that of [`zero_bounce_radiance`].
///
/// See it: `cargo grader picture part3.task2`.
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
