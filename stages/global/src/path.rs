//! Part 4, task 2: path tracing.

use kit::{Hit, LitScene, PixelSampler, Ray, Scattering, Spectrum, Surface, Vec3};

/// Estimates the radiance along `ray` with one path of at most `max_depth` rays (the flag `-m`).
///
/// Chapter: stages/book/src/part4/task2.md
///
/// ```text
/// Lo = Le + ∫ f · Li · |cos θi| dwi        where Li is the Lo of the surface that is hit along wi
/// ```
///
/// `ray` is a camera ray: its direction is a unit vector.
///
/// Light is traced backwards: at each surface [`Scattering::sample`] samples one direction, and
/// `trace` finds the next surface. The radiance of this surface is multiplied by the product of all
/// weights `f · |cos θi| / pdf` so far, the *throughput*.
///
/// A path has at most `max_depth` rays, of which the first is `ray`. With 0, only emission is
/// visible; with 1, also directly lit surfaces; with 2, also what those surfaces illuminate and
/// what mirrors reflect, and so on. Passing through a glass sphere takes two more rays. The rules
/// are:
///
/// - The emission of a surface counts at the first hit, and after a sample of a delta distribution
///   ([`BsdfSample::delta`](kit::BsdfSample::delta): mirrors and smooth glass), where no direct
///   light was estimated. The same holds for [`LitScene::background`] if nothing is hit. Elsewhere
///   the direct light of the previous surface already contains this light.
/// - Unless `max_depth` is 0, `direct` returns the direct light of each surface that is not a
///   mirror or smooth glass ([`Material::is_delta`](kit::Material::is_delta)), towards the unit
///   world direction `wo` (part 3).
/// - While rays are left, `next_2d` and `next_1d` of the sampler, in this order, sample the next
///   direction.
/// - `roulette` (task 3) gets the new throughput, the number of bounces so far (1 after the first)
///   and a `next_1d` of the sampler. It returns the throughput to continue with, or `None` to end
///   the path.
///
/// A ray that leaves a surface starts with [`Surface::leave`].
///
/// See it: `cargo grader picture part4.task2`.
#[allow(
    clippy::too_many_arguments,
    reason = "the functions of other tasks come in as arguments, so that each task can be tested alone"
)]
pub fn estimate_radiance(
    lit: &LitScene,
    ray: &Ray,
    max_depth: u32,
    sampler: &mut PixelSampler,
    scattering: &impl Scattering,
    trace: &mut impl FnMut(&Ray) -> Option<Hit>,
    direct: &mut impl FnMut(&Surface, Vec3, &mut PixelSampler) -> Spectrum,
    roulette: &mut impl FnMut(Spectrum, u32, f64) -> Option<Spectrum>,
) -> Spectrum {
    // BEGIN SOLUTION(part4.task2)
    let mut ray = *ray;
    let mut radiance = Spectrum::BLACK;
    let mut throughput = Spectrum::WHITE;
    let mut emission_counts = true;
    for bounce in 1..=max_depth.max(1) {
        let Some(hit) = trace(&ray) else {
            if emission_counts {
                radiance += throughput * lit.background(ray.d);
            }
            break;
        };
        let surface = lit.surface(&hit);
        let wo = -ray.d;
        if emission_counts {
            radiance += throughput * surface.emitted(wo);
        }
        if max_depth == 0 {
            break;
        }
        if !surface.material.is_delta() {
            radiance += throughput * direct(&surface, wo, sampler);
        }
        if bounce == max_depth {
            break;
        }
        let (u, choice) = (sampler.next_2d(), sampler.next_1d());
        let local_wo = surface.frame.to_local(wo);
        let Some(sample) = scattering.sample(surface.material, local_wo, u, choice) else {
            break;
        };
        let survivor = roulette(throughput * sample.weight(), bounce, sampler.next_1d());
        let Some(survivor) = survivor else {
            break;
        };
        throughput = survivor;
        emission_counts = sample.delta;
        ray = surface.leave(surface.frame.to_world(sample.wi));
    }
    radiance
    // STUB: kit::hole!("part4.task2", lit, ray, max_depth, sampler, scattering, trace, direct, roulette)
    // END SOLUTION(part4.task2)
}
