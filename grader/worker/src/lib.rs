//! Links a student's stages for the [`driver`], which runs cases on them.
//!
//! Each stage is behind the cargo feature of its name. This crate is small, because it is compiled
//! again with each version of a stage.

#[cfg(feature = "bvh")]
mod bvh;
#[cfg(any(feature = "direct", feature = "global"))]
mod scattering;

use driver::stages::Stages;
use wire::{Case, Record};

/// Runs case number `index` on the linked stages.
pub fn run(index: u32, case: &Case) -> Record {
    driver::run(&STAGES, index, case)
}

/// The linked stages.
const STAGES: Stages = Stages {
    #[cfg(feature = "raygen")]
    raygen: Some(driver::stages::Raygen {
        raytrace_pixel: |x, y, film, ns_aa, sampler, mut camera_ray, mut trace_ray| {
            raygen::raytrace_pixel(x, y, film, ns_aa, sampler, &mut camera_ray, &mut trace_ray)
        },
        generate_ray: raygen::generate_ray,
    }),
    #[cfg(not(feature = "raygen"))]
    raygen: None,
    #[cfg(feature = "intersect")]
    intersect: Some(driver::stages::Intersect {
        test_triangle: intersect::test_triangle,
        intersect_triangle: intersect::intersect_triangle,
        record_triangle: intersect::record_triangle,
        test_sphere: intersect::test_sphere,
        intersect_sphere: intersect::intersect_sphere,
    }),
    #[cfg(not(feature = "intersect"))]
    intersect: None,
    #[cfg(feature = "bbox")]
    bbox: Some(driver::stages::Bbox {
        intersect_bbox: bbox::intersect_bbox,
    }),
    #[cfg(not(feature = "bbox"))]
    bbox: None,
    #[cfg(feature = "bvh")]
    bvh: Some(bvh::STAGE),
    #[cfg(not(feature = "bvh"))]
    bvh: None,
    #[cfg(feature = "direct")]
    direct: Some(driver::stages::Direct {
        lambert_f: direct::lambert_f,
        lambert_pdf: direct::lambert_pdf,
        lambert_sample: direct::lambert_sample,
        zero_bounce_radiance: direct::zero_bounce_radiance,
        estimate_direct_lighting_hemisphere: |lit, surface, wo, samples, sampler, f, mut trace| {
            let f = &scattering::Given(f);
            direct::estimate_direct_lighting_hemisphere(
                lit, surface, wo, samples, sampler, f, &mut trace,
            )
        },
        estimate_direct_lighting_importance:
            |lit, surface, wo, samples, sampler, f, mut occluded| {
                let f = &scattering::Given(f);
                direct::estimate_direct_lighting_importance(
                    lit,
                    surface,
                    wo,
                    samples,
                    sampler,
                    f,
                    &mut occluded,
                )
            },
    }),
    #[cfg(not(feature = "direct"))]
    direct: None,
    #[cfg(feature = "global")]
    global: Some(driver::stages::Global {
        fresnel_dielectric: global::fresnel_dielectric,
        reflect: global::reflect,
        refract: global::refract,
        mirror_sample: global::mirror_sample,
        refraction_sample: global::refraction_sample,
        glass_sample: global::glass_sample,
        estimate_radiance: |lit,
                            ray,
                            max_depth,
                            sampler,
                            f,
                            mut trace,
                            mut direct,
                            mut roulette| {
            global::estimate_radiance(
                lit,
                ray,
                max_depth,
                sampler,
                &scattering::Given(f),
                &mut trace,
                &mut direct,
                &mut roulette,
            )
        },
        play_roulette: global::play_roulette,
    }),
    #[cfg(not(feature = "global"))]
    global: None,
    #[cfg(feature = "adaptive")]
    adaptive: Some(driver::stages::Adaptive {
        has_converged: adaptive::has_converged,
        has_surely_converged: |samples, tolerance, mut rule| {
            adaptive::has_surely_converged(samples, tolerance, &mut rule)
        },
        raytrace_pixel_adaptive: |pixel,
                                  film,
                                  budget,
                                  sampler,
                                  mut camera_ray,
                                  mut trace_ray,
                                  mut stop| {
            adaptive::raytrace_pixel_adaptive(
                pixel,
                film,
                budget,
                sampler,
                &mut camera_ray,
                &mut trace_ray,
                &mut stop,
            )
        },
        rate_colour: adaptive::rate_colour,
    }),
    #[cfg(not(feature = "adaptive"))]
    adaptive: None,
};
