//! Part 4, task 2: light that took any number of bounces.

use kit::{Hit, LitScene, PixelSampler, Ray, Scattering, Spectrum, Surface, Vec3};

/// Radiance that arrives along `ray`, by following one path of at most `max_depth` rays (the flag `-m`).
///
/// ```text
/// Lo = Le + ∫ f · Li · |cos θi| dwi        and Li is the Lo of the surface that is seen along wi
/// ```
///
/// so light is followed backwards: from each surface, [`Scattering::sample`] draws one direction, `trace` finds the next
/// surface, and what is seen there counts by the product of the weights `f · |cos θi| / pdf` so far, the *throughput*.
///
/// A path has at most `max_depth` rays, of which the first is `ray`. With 0 only what emits is seen, with 1 also what is
/// lit directly, with 2 what is lit by that and what a mirror shows, and so on: passing through a glass ball takes two
/// more. On the way:
///
/// - What a surface emits counts where the eye sees it: at the first hit, and behind mirrors and glass
///   ([`BsdfSample::delta`](kit::BsdfSample::delta)), where no direct light was asked for. The same holds for
///   [`LitScene::background`] where nothing is hit. Anywhere else the direct light of the surface before has counted it
///   already.
/// - Unless `max_depth` is 0, `direct` gives the direct light of each surface that is no mirror and no smooth glass
///   ([`Material::is_delta`](kit::Material::is_delta)), towards the unit world direction `wo` (part 3).
/// - While rays are left, `next_2d` and `next_1d` of the sampler, in this order, choose where to go on.
/// - `roulette` (task 3) gets the new throughput, how many bounces the path has made (1 after the first) and a `next_1d` of
///   the sampler, and answers with the throughput to go on with, or ends the path.
///
/// A ray that leaves a surface starts with [`Surface::leave`].
#[allow(
    clippy::too_many_arguments,
    reason = "neighbours come in as arguments, so that each task can be tried alone"
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
