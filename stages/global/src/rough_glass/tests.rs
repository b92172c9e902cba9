// BEGIN SOLUTION(part4.task1)
//! Tests of rough glass: samples follow the pdf, energy is conserved, and smooth glass is the
//! limit.

use super::*;
use crate::{reflect, refract};
use kit::{PixelSampler, Tally, warp};
use statistics::chi_square;
use statistics::{detectable_bias, sidak, two_sided};

fn glass(roughness: f64) -> RoughGlass {
    RoughGlass {
        reflectance: Some(Spectrum::WHITE),
        transmittance: Spectrum::WHITE,
        roughness,
        ior: 1.5,
    }
}

fn refraction(roughness: f64) -> RoughGlass {
    RoughGlass {
        reflectance: None,
        ..glass(roughness)
    }
}

fn views() -> [Vec3; 5] {
    [
        Vec3::Z,
        -Vec3::Z,
        Vec3::new(0.48, -0.6, 0.64),
        Vec3::new(-0.6, 0.48, -0.64),
        Vec3::new(0.0, 0.99, -0.141),
    ]
    .map(Vec3::normalize)
}

fn samples(glass: RoughGlass, wo: Vec3, count: usize) -> impl Iterator<Item = Option<BsdfSample>> {
    let mut sampler = PixelSampler::new(0, 0, 13);
    (0..count).map(move |_| {
        let u = sampler.get_sample();
        glass.sample(wo, u, sampler.next_1d())
    })
}

/// Hard case 89. The significance level of all tests together is 1e-6. They detect every deviation
/// of 10 % (root mean square), so also another roughness. Smoother glass has a peak that is too
/// narrow for the integration over the cells.
#[test]
fn samples_follow_the_pdf() {
    let significance = sidak(1e-6, 20);
    for roughness in [0.7, 1.0] {
        for wo in views() {
            for glass in [glass(roughness), refraction(roughness)] {
                let fit_to = |other: RoughGlass| {
                    let sample = |u, choice| glass.sample(wo, u, choice).map(|s| s.wi);
                    chi_square::fit_samples(50_000, 13, sample, |wi| other.pdf(wo, wi))
                };
                let fit = fit_to(glass);
                assert!(fit.p > significance, "{glass:?} from {wo}: {fit:?}");
                assert!(fit.detectable_deviation(significance) < 0.1);
                let other = RoughGlass {
                    roughness: 0.7 * roughness,
                    ..glass
                };
                assert!(fit_to(other).p < significance, "{glass:?} from {wo}");
            }
        }
    }
}

/// Hard case 83. The albedo of white glass is at most 1, and approaches 1 for smooth glass.
/// Radiance is counted without the factor η².
#[test]
fn albedo_is_at_most_one() {
    let albedo = |glass: RoughGlass, wo: Vec3| {
        let light = samples(glass, wo, 20_000).map(|sample| {
            sample.map_or(0.0, |s| {
                let eta = glass.index(wo);
                let scale = if s.wi.z * wo.z < 0.0 { eta * eta } else { 1.0 };
                s.weight().g / scale
            })
        });
        light.collect::<Tally>().mean()
    };
    for wo in views() {
        for roughness in [0.001, 0.1, 0.5, 1.0, 7.0] {
            let all = albedo(glass(roughness), wo);
            assert!((0.3..=1.0 + 1e-9).contains(&all), "{roughness} {wo}: {all}");
        }
        assert!(albedo(glass(0.001), wo) > 0.99);
    }
    assert!(albedo(refraction(0.001), Vec3::Z) > 0.99);
    // Beyond the critical angle nothing is refracted.
    assert!(albedo(refraction(0.001), views()[4]) < 0.01);
}

/// The BSDF is reciprocal, except for the factor η².
#[test]
fn bsdf_is_reciprocal() {
    let mut sampler = PixelSampler::new(0, 0, 1);
    let mut refracted = 0;
    for _ in 0..2000 {
        let [a, b] = [sampler.get_sample(), sampler.next_2d()].map(warp::uniform_sphere);
        let glass = glass(0.5);
        let (forward, reverse) = (glass.f(a, b).g, glass.f(b, a).g);
        let eta = if a.z * b.z < 0.0 { glass.index(a) } else { 1.0 };
        refracted += u32::from(forward > 0.0 && eta != 1.0);
        assert!((forward - reverse * eta * eta).abs() <= 1e-9 * forward.abs());
    }
    assert!(refracted > 100);
}

/// The estimate with samples equals the integral over all directions, so `f` and the pdf are
/// consistent. A bias of 20 % is detected.
#[test]
fn mean_sample_weight_is_the_integral_of_f() {
    let significance = sidak(1e-6, 5);
    for wo in views() {
        let glass = glass(0.6);
        let weights = samples(glass, wo, 200_000).map(|s| s.map_or(0.0, |s| s.weight().g));
        let by_samples: Tally = weights.collect();
        let mut sampler = PixelSampler::new(0, 0, 3);
        let uniform: Tally = (0..200_000)
            .map(|_| {
                let wi = warp::uniform_sphere(sampler.get_sample());
                glass.f(wo, wi).g * wi.z.abs() * 4.0 * std::f64::consts::PI
            })
            .collect();
        let p = two_sided(uniform.z_between(&by_samples));
        assert!(p > significance, "{} {}", by_samples.mean(), uniform.mean());
        let sure = detectable_bias(uniform.standard_error(), significance);
        assert!(sure < 0.2 * by_samples.mean(), "{wo}: {sure}");
    }
}

#[test]
fn very_small_roughness_approaches_smooth_glass() {
    for wo in views() {
        let mut far = 0;
        for sample in samples(glass(0.001), wo, 1000).flatten() {
            let smooth = if sample.wi.z * wo.z > 0.0 {
                Some(reflect(wo))
            } else {
                refract(wo, 1.5)
            };
            let off = smooth.map_or(2.0, |smooth| (sample.wi - smooth).length());
            far += u32::from(off > 0.1);
        }
        // GGX has long tails: the normals of a few facets in a thousand deviate by fifty times the
        // roughness.
        assert!(far < 10, "{wo}: {far}");
    }
}

/// Hard case 75.
#[test]
fn directions_in_the_plane_of_the_surface_are_black() {
    let glass = glass(0.5);
    assert_eq!(glass.sample(Vec3::X, Vec2::splat(0.5), 0.5), None);
    assert!(glass.f(Vec3::X, Vec3::Z).is_black() && glass.f(Vec3::Z, Vec3::X).is_black());
    assert_eq!(glass.pdf(Vec3::X, Vec3::Z), 0.0);
}
// END SOLUTION(part4.task1)
