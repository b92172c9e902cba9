// BEGIN SOLUTION(part4.task1)
//! Rough glass as a whole: what is drawn, how much light is sent on, and what it becomes as it gets smooth.

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

fn drawn(glass: RoughGlass, wo: Vec3, count: usize) -> impl Iterator<Item = Option<BsdfSample>> {
    let mut numbers = PixelSampler::new(0, 0, 13);
    (0..count).map(move |_| {
        let u = numbers.get_sample();
        glass.sample(wo, u, numbers.next_1d())
    })
}

/// Hard case 89. All false alarms together have a chance of 1e-6, a deviation of 10 % (root mean square) is sure to be
/// seen; another roughness is. Smoother glass has a peak that is narrower than the cells are integrated by.
#[test]
fn samples_fall_where_the_pdf_says() {
    let alarm = sidak(1e-6, 20);
    for roughness in [0.7, 1.0] {
        for wo in views() {
            for glass in [glass(roughness), refraction(roughness)] {
                let fit_to = |other: RoughGlass| {
                    let sample = |u, choice| glass.sample(wo, u, choice).map(|s| s.wi);
                    chi_square::fit_samples(50_000, 13, sample, |wi| other.pdf(wo, wi))
                };
                let fit = fit_to(glass);
                assert!(fit.p > alarm, "{glass:?} from {wo}: {fit:?}");
                assert!(fit.detectable_deviation(alarm) < 0.1);
                let other = RoughGlass {
                    roughness: 0.7 * roughness,
                    ..glass
                };
                assert!(fit_to(other).p < alarm, "{glass:?} from {wo}");
            }
        }
    }
}

/// Hard case 83. White glass never sends on more light than comes in, and all of it as it gets smooth. Radiance is counted
/// without the squeeze of η².
#[test]
fn a_furnace_is_not_outshone() {
    let sent_on = |glass: RoughGlass, wo: Vec3| {
        let light = drawn(glass, wo, 20_000).map(|sample| {
            sample.map_or(0.0, |s| {
                let eta = glass.index(wo);
                let squeeze = if s.wi.z * wo.z < 0.0 { eta * eta } else { 1.0 };
                s.weight().g / squeeze
            })
        });
        light.collect::<Tally>().mean()
    };
    for wo in views() {
        for roughness in [0.001, 0.1, 0.5, 1.0, 7.0] {
            let all = sent_on(glass(roughness), wo);
            assert!((0.3..=1.0 + 1e-9).contains(&all), "{roughness} {wo}: {all}");
        }
        assert!(sent_on(glass(0.001), wo) > 0.99);
    }
    assert!(sent_on(refraction(0.001), Vec3::Z) > 0.99);
    // Beyond the critical angle nothing passes.
    assert!(sent_on(refraction(0.001), views()[4]) < 0.01);
}

/// Light runs the same way back, but for the squeeze.
#[test]
fn light_runs_both_ways() {
    let mut numbers = PixelSampler::new(0, 0, 1);
    let mut passed = 0;
    for _ in 0..2000 {
        let [a, b] = [numbers.get_sample(), numbers.next_2d()].map(warp::uniform_sphere);
        let glass = glass(0.5);
        let (there, back) = (glass.f(a, b).g, glass.f(b, a).g);
        let eta = if a.z * b.z < 0.0 { glass.index(a) } else { 1.0 };
        passed += u32::from(there > 0.0 && eta != 1.0);
        assert!((there - back * eta * eta).abs() <= 1e-9 * there.abs());
    }
    assert!(passed > 100);
}

/// The estimate by samples equals the integral over all directions: f and pdf belong together. A bias of 20 % is sure to
/// be seen.
#[test]
fn the_weight_of_samples_is_the_integral_of_f() {
    let alarm = sidak(1e-6, 5);
    for wo in views() {
        let glass = glass(0.6);
        let weights = drawn(glass, wo, 200_000).map(|s| s.map_or(0.0, |s| s.weight().g));
        let by_samples: Tally = weights.collect();
        let mut numbers = PixelSampler::new(0, 0, 3);
        let uniformly: Tally = (0..200_000)
            .map(|_| {
                let wi = warp::uniform_sphere(numbers.get_sample());
                glass.f(wo, wi).g * wi.z.abs() * 4.0 * std::f64::consts::PI
            })
            .collect();
        let p = two_sided(uniformly.z_between(&by_samples));
        assert!(p > alarm, "{} {}", by_samples.mean(), uniformly.mean());
        let sure = detectable_bias(uniformly.standard_error(), alarm);
        assert!(sure < 0.2 * by_samples.mean(), "{wo}: {sure}");
    }
}

#[test]
fn nearly_smooth_glass_is_nearly_smooth() {
    for wo in views() {
        let mut far = 0;
        for sample in drawn(glass(0.001), wo, 1000).flatten() {
            let smooth = if sample.wi.z * wo.z > 0.0 {
                Some(reflect(wo))
            } else {
                refract(wo, 1.5)
            };
            let off = smooth.map_or(2.0, |smooth| (sample.wi - smooth).length());
            far += u32::from(off > 0.1);
        }
        // GGX has long tails: a few facets in a thousand are turned by fifty times the roughness.
        assert!(far < 10, "{wo}: {far}");
    }
}

/// Hard case 75.
#[test]
fn in_the_plane_of_the_surface_nothing_leaves() {
    let glass = glass(0.5);
    assert_eq!(glass.sample(Vec3::X, Vec2::splat(0.5), 0.5), None);
    assert!(glass.f(Vec3::X, Vec3::Z).is_black() && glass.f(Vec3::Z, Vec3::X).is_black());
    assert_eq!(glass.pdf(Vec3::X, Vec3::Z), 0.0);
}
// END SOLUTION(part4.task1)
