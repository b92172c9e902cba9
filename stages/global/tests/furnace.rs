//! Paths in scenes with known solutions: the inside of a sphere with uniform direct light, and
//! furnaces with objects.

// BEGIN SOLUTION(part4.task2)
use global::{estimate_radiance, glass_sample, mirror_sample, play_roulette, refraction_sample};
use kit::scene::{NamedMaterial, Object};
use kit::{
    BsdfSample, Environment, Hit, LitScene, Material, PixelSampler, PrimId, Ray, Scattering, Scene,
    Spectrum, Sphere, Surface, Tally, Vec2, Vec3, math,
};
use statistics::{detectable_bias, sidak, two_sided};
use std::f64::consts::{FRAC_1_PI, TAU};

/// Significance level of all z-tests of this file together.
const FAMILY: f64 = 1e-6;
/// Number of z-tests.
const TESTS: usize = 12;
/// Tolerance for a path of a few dozen bounces.
const ROUNDING: f64 = 1e-12;

/// The scattering functions of parts 3 and 4. The diffuse one is copied, because a stage imports no
/// other stage.
struct AllMaterials;

impl Scattering for AllMaterials {
    fn f(&self, material: &Material, wo: Vec3, wi: Vec3) -> Spectrum {
        match material {
            Material::Diffuse { reflectance } if wo.z * wi.z > 0.0 => *reflectance * FRAC_1_PI,
            _ => Spectrum::BLACK,
        }
    }

    fn pdf(&self, _: &Material, _: Vec3, _: Vec3) -> f64 {
        unreachable!("the path tracer does not call `pdf`")
    }

    fn sample(&self, material: &Material, wo: Vec3, u: Vec2, choice: f64) -> Option<BsdfSample> {
        match *material {
            Material::Diffuse { reflectance } => {
                let (sin, cos) = math::sin_cos(TAU * u.y);
                let z = (1.0 - u.x).sqrt();
                Some(BsdfSample {
                    wi: Vec3::new(u.x.sqrt() * cos, u.x.sqrt() * sin, z.copysign(wo.z)),
                    f: reflectance * FRAC_1_PI,
                    pdf: z * FRAC_1_PI,
                    delta: false,
                })
            }
            Material::Mirror { reflectance } => mirror_sample(reflectance, wo),
            Material::Refraction {
                transmittance, ior, ..
            } => refraction_sample(transmittance, ior, wo),
            Material::Glass {
                reflectance,
                transmittance,
                ior,
                ..
            } => glass_sample(reflectance, transmittance, ior, wo, choice),
            _ => None,
        }
    }
}

/// A scene of spheres, each with its own material.
fn spheres(list: &[(Vec3, f64, Material)]) -> Scene {
    Scene {
        spheres: list
            .iter()
            .map(|&(center, radius, _)| Sphere { center, radius })
            .collect(),
        object_of: (0..list.len() as u32).collect(),
        objects: (0..list.len() as u32)
            .map(|material| Object {
                name: "ball".into(),
                material,
            })
            .collect(),
        materials: list
            .iter()
            .map(|&(_, _, material)| NamedMaterial {
                name: "ball".into(),
                material,
            })
            .collect(),
        ..Scene::default()
    }
}

/// The closest sphere, by a simple test that is independent of the course's kernels. Normals point
/// outwards.
fn closest(scene: &Scene, ray: &Ray) -> Option<Hit> {
    let hit = |(i, s): (usize, &Sphere)| {
        let f = ray.o - s.center;
        let b = f.dot(ray.d);
        let c = f.length_squared() - s.radius * s.radius;
        let discriminant = s.radius * s.radius - (f - b * ray.d).length_squared();
        let q = if discriminant >= 0.0 {
            -b - discriminant.sqrt().copysign(b)
        } else {
            return None;
        };
        let (near, far) = if b > 0.0 { (q, c / q) } else { (c / q, q) };
        let t = [near, far].into_iter().find(|&t| t > 0.0)?;
        let n = (ray.at(t) - s.center).normalize();
        Some(Hit {
            t,
            p: s.center + s.radius * n,
            n,
            ng: n,
            uv: Vec2::ZERO,
            prim: PrimId((scene.triangles.len() + i) as u32),
        })
    };
    scene
        .spheres
        .iter()
        .enumerate()
        .filter_map(hit)
        .min_by(|a, b| a.t.total_cmp(&b.t))
}

fn no_roulette(throughput: Spectrum, _: u32, _: f64) -> Option<Spectrum> {
    Some(throughput)
}

/// The red channels of `paths` paths that start with `ray`.
fn trace_paths(
    lit: &LitScene,
    ray: &Ray,
    max_depth: u32,
    paths: u32,
    direct: &mut impl FnMut(&Surface, Vec3, &mut PixelSampler) -> Spectrum,
    roulette: &mut impl FnMut(Spectrum, u32, f64) -> Option<Spectrum>,
) -> Tally {
    let mut sampler = PixelSampler::new(0, 0, 9);
    (0..paths)
        .map(|_| {
            sampler.get_sample();
            let radiance = estimate_radiance(
                lit,
                ray,
                max_depth,
                &mut sampler,
                &AllMaterials,
                &mut |ray| closest(&lit.scene, ray),
                direct,
                roulette,
            );
            assert!(radiance.is_finite());
            radiance.r
        })
        .collect()
}

fn no_direct(_: &Surface, _: Vec3, _: &mut PixelSampler) -> Spectrum {
    Spectrum::BLACK
}

fn assert_mean(what: &str, estimate: &Tally, truth: f64, worst_sure_bias: f64) {
    let significance = sidak(FAMILY, TESTS);
    let p = two_sided(estimate.z_against(truth));
    let (mean, error) = (estimate.mean(), estimate.standard_error());
    assert!(
        p > significance,
        "{what}: {mean} ± {error}, expected {truth}"
    );
    let sure = detectable_bias(error, significance);
    assert!(
        sure <= worst_sure_bias,
        "{what}: too noisy, a bias below ±{sure} is not detected"
    );
    // A bias of this size is detected in both directions.
    for off in [sure, -sure] {
        let p = two_sided(estimate.z_against(truth + off));
        assert!(
            error == 0.0 || p < significance,
            "{what}: a bias of {off} is not detected, p = {p:e}"
        );
    }
}

/// Hard case 83. In a diffuse sphere whose direct light is 1 everywhere, the radiance is the
/// geometric series 1 + ρ + ρ² + ... With ρ = 1/2 that is 2 - 2^(1-m); with ρ = 1 it is m.
#[test]
fn bounces_in_a_furnace_add_up_to_a_geometric_series() {
    let ray = Ray::new(Vec3::new(0.1, 0.2, 0.3), Vec3::X);
    for rho in [0.5, 1.0] {
        let wall = Material::Diffuse {
            reflectance: Spectrum::grey(rho),
        };
        let lit = LitScene::new(spheres(&[(Vec3::ZERO, 1.0, wall)]), None);
        for max_depth in [0, 1, 2, 5, 30] {
            let sum: f64 = (0..max_depth).map(|k| f64::powi(rho, k as i32)).sum();
            let ball = trace_paths(
                &lit,
                &ray,
                max_depth,
                20,
                &mut |_, _, _| Spectrum::WHITE,
                &mut no_roulette,
            );
            assert!((ball.mean() - sum).abs() < ROUNDING * (1.0 + sum));
            assert!(ball.standard_error() < ROUNDING * (1.0 + sum));
        }
    }
}

/// Hard case 84. The same sphere with roulette: noisier, but without a bias.
#[test]
fn roulette_on_and_off_agree() {
    let ray = Ray::new(Vec3::new(0.1, 0.2, 0.3), Vec3::X);
    let wall = Material::Diffuse {
        reflectance: Spectrum::new(0.7, 0.4, 0.1),
    };
    let lit = LitScene::new(spheres(&[(Vec3::ZERO, 1.0, wall)]), None);
    let lamp = &mut |_: &Surface, _: Vec3, _: &mut PixelSampler| Spectrum::WHITE;
    let truth = (1.0 - f64::powi(0.7, 60)) / 0.3;
    let on = trace_paths(&lit, &ray, 60, 100_000, lamp, &mut play_roulette);
    assert_mean("roulette", &on, truth, 0.07);
    // The test detects survivors without compensation: the estimate is too dark.
    let uncompensated = &mut |throughput: Spectrum, bounces: u32, u: f64| {
        play_roulette(throughput, bounces, u).map(|_| throughput)
    };
    let dark = trace_paths(&lit, &ray, 60, 100_000, lamp, uncompensated);
    assert!(truth - dark.mean() > 0.07, "{}", dark.mean());
}

/// Emission is visible at depth 0, directly lit surfaces from depth 1 on.
#[test]
fn depth_counts_bounces() {
    let lamp = Material::Emission {
        radiance: Spectrum::grey(5.0),
    };
    let lit = LitScene::new(spheres(&[(Vec3::ZERO, 1.0, lamp)]), None);
    let at_the_lamp = Ray::new(3.0 * Vec3::Z, -Vec3::Z);
    for max_depth in [0, 1, 7] {
        let seen = trace_paths(
            &lit,
            &at_the_lamp,
            max_depth,
            1,
            &mut no_direct,
            &mut no_roulette,
        );
        assert_eq!(seen.mean(), 5.0);
    }
    let past_the_lamp = Ray::new(3.0 * Vec3::Z, Vec3::Y);
    let nothing = trace_paths(&lit, &past_the_lamp, 7, 1, &mut no_direct, &mut no_roulette);
    assert_eq!(nothing.mean(), 0.0);
    // From inside, the back of the lamp is visible: black.
    let inside = Ray::new(Vec3::ZERO, Vec3::Y);
    let back = trace_paths(&lit, &inside, 7, 1, &mut no_direct, &mut no_roulette);
    assert_eq!(back.mean(), 0.0);
}

/// A mirror reflects its environment only from the second ray on.
#[test]
fn mirror_needs_a_second_ray() {
    let mirror = Material::Mirror {
        reflectance: Spectrum::grey(0.5),
    };
    let environment = Environment::uniform(Spectrum::WHITE);
    let lit = LitScene::new(spheres(&[(Vec3::ZERO, 1.0, mirror)]), Some(environment));
    let ray = Ray::new(3.0 * Vec3::Z, -Vec3::Z);
    let direct = &mut |_: &Surface, _: Vec3, _: &mut PixelSampler| -> Spectrum {
        panic!("mirrors have no direct light")
    };
    for (max_depth, seen) in [(0, 0.0), (1, 0.0), (2, 0.5), (9, 0.5)] {
        let mirror = trace_paths(&lit, &ray, max_depth, 1, direct, &mut no_roulette);
        assert_eq!(mirror.mean(), seen, "at depth {max_depth}");
    }
}

/// Light that `direct` already contains must not be added again when a random ray hits it.
#[test]
fn light_is_counted_only_once() {
    let matte = Material::Diffuse {
        reflectance: Spectrum::WHITE,
    };
    let environment = Environment::uniform(Spectrum::WHITE);
    let lit = LitScene::new(spheres(&[(Vec3::ZERO, 1.0, matte)]), Some(environment));
    let ray = Ray::new(3.0 * Vec3::Z, -Vec3::Z);
    let direct = &mut |_: &Surface, _: Vec3, _: &mut PixelSampler| Spectrum::WHITE;
    // A white sphere is invisible in a white furnace. It is convex, so there is only direct light.
    let ball = trace_paths(&lit, &ray, 9, 100, direct, &mut no_roulette);
    assert_eq!(ball.mean(), 1.0);
}

/// Hard case 78 and the furnace test for glass: objects without absorption are invisible in a
/// furnace. Mirrors, refraction, glass, and a sphere of air in a sphere of glass, with rays that
/// enter, leave and are reflected inside.
#[test]
fn spheres_without_absorption_are_invisible_in_a_furnace() {
    let one = Spectrum::WHITE;
    let glass = |ior| Material::Glass {
        reflectance: one,
        transmittance: one,
        roughness: 0.0,
        ior,
    };
    let bodies: [&[(Vec3, f64, Material)]; 4] = [
        &[(Vec3::ZERO, 1.0, Material::Mirror { reflectance: one })],
        &[(
            Vec3::ZERO,
            1.0,
            Material::Refraction {
                transmittance: one,
                roughness: 0.0,
                ior: 1.45,
            },
        )],
        &[(Vec3::ZERO, 1.0, glass(1.45))],
        &[
            (Vec3::ZERO, 1.0, glass(2.4)),
            (Vec3::new(0.1, 0.0, 0.2), 0.6, glass(1.0 / 2.4)),
        ],
    ];
    for body in bodies {
        let lit = LitScene::new(
            spheres(body),
            Some(Environment::uniform(Spectrum::grey(0.75))),
        );
        for x in [0.0, 0.3, 0.7, 0.99, 0.999_999] {
            let ray = Ray::new(Vec3::new(x, 0.0, 3.0), -Vec3::Z);
            let ball = trace_paths(&lit, &ray, 1000, 500, &mut no_direct, &mut no_roulette);
            assert!((ball.mean() - 0.75).abs() < 1e-9, "{}", ball.mean());
        }
    }
}

/// Tinted glass follows Airy's sum. A sphere seen through its centre reflects R and transmits
/// (1-R)² t² Σ (R t)^2k; the rest leaves after internal reflections. The furnace has radiance 1.
#[test]
fn tinted_glass_is_the_sum_of_its_reflections() {
    let t = 0.8;
    let ball = Material::Glass {
        reflectance: Spectrum::WHITE,
        transmittance: Spectrum::grey(t),
        roughness: 0.0,
        ior: 1.5,
    };
    let lit = LitScene::new(
        spheres(&[(Vec3::ZERO, 1.0, ball)]),
        Some(Environment::uniform(Spectrum::WHITE)),
    );
    // Light passes the boundary twice, in and out, whatever the number of internal reflections.
    let r = 0.04;
    let truth = r + (1.0 - r) * t * t;
    let ray = Ray::new(3.0 * Vec3::Z, -Vec3::Z);
    let seen = trace_paths(&lit, &ray, 200, 200_000, &mut no_direct, &mut no_roulette);
    assert_mean("tinted glass", &seen, truth, 0.003);
}

/// Hard case 82 from inside: in thousands of bounces inside a mirror sphere, no ray escapes or gets
/// stuck.
#[test]
fn no_ray_escapes_from_a_closed_mirror() {
    let mirror = Material::Mirror {
        reflectance: Spectrum::WHITE,
    };
    for (center, radius) in [
        (Vec3::ZERO, 1.0),
        (Vec3::new(1e4, -3e3, 50.0), 0.01),
        (Vec3::splat(7.0), 1e5),
    ] {
        let lit = LitScene::new(
            spheres(&[(center, radius, mirror)]),
            Some(Environment::uniform(Spectrum::WHITE)),
        );
        let ray = Ray::new(
            center + 0.3 * radius * Vec3::Y,
            Vec3::new(0.6, 0.64, 0.48).normalize(),
        );
        let seen = trace_paths(&lit, &ray, 5000, 1, &mut no_direct, &mut no_roulette);
        assert_eq!(
            seen.mean(),
            0.0,
            "a ray escaped from the sphere of radius {radius}"
        );
    }
}
// END SOLUTION(part4.task2)
