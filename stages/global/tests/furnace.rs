//! Paths in scenes whose light is known: the inside of a glowing ball, and a furnace with glass in it.

// BEGIN SOLUTION(part4.task2)
use global::{estimate_radiance, glass_sample, mirror_sample, play_roulette, refraction_sample};
use kit::scene::{NamedMaterial, Object};
use kit::{
    BsdfSample, Environment, Hit, LitScene, Material, PixelSampler, PrimId, Ray, Scattering, Scene,
    Spectrum, Sphere, Surface, Tally, Vec2, Vec3, math,
};
use statistics::{detectable_bias, sidak, two_sided};
use std::f64::consts::{FRAC_1_PI, TAU};

/// Chance that any of the z-tests of this file accuses a right estimate.
const FAMILY: f64 = 1e-6;
/// How many there are.
const TESTS: usize = 12;
/// Rounding of a path of a few dozen bounces.
const ROUNDING: f64 = 1e-12;

/// The scattering functions of parts 3 and 4. The matte one is written out, since a stage knows no other stage.
struct Everything;

impl Scattering for Everything {
    fn f(&self, material: &Material, wo: Vec3, wi: Vec3) -> Spectrum {
        match material {
            Material::Diffuse { reflectance } if wo.z * wi.z > 0.0 => *reflectance * FRAC_1_PI,
            _ => Spectrum::BLACK,
        }
    }

    fn pdf(&self, _: &Material, _: Vec3, _: Vec3) -> f64 {
        unreachable!("paths do not ask for it")
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

/// The closest sphere: a plain test, independent of the course's kernels. Normals point outwards.
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

fn never(throughput: Spectrum, _: u32, _: f64) -> Option<Spectrum> {
    Some(throughput)
}

/// The red channel of `paths` paths that follow `ray`.
fn follow(
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
                &Everything,
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
    let alarm = sidak(FAMILY, TESTS);
    let p = two_sided(estimate.z_against(truth));
    let (mean, error) = (estimate.mean(), estimate.standard_error());
    assert!(p > alarm, "{what}: {mean} ± {error}, should be {truth}");
    let sure = detectable_bias(error, alarm);
    assert!(sure <= worst_sure_bias, "{what}: too noisy to tell ±{sure}");
    // What is off by as much is caught, whichever way.
    for off in [sure, -sure] {
        let p = two_sided(estimate.z_against(truth + off));
        assert!(error == 0.0 || p < alarm, "{what}: off by {off}, p = {p:e}");
    }
}

/// Hard case 83. Inside a matte ball where every place is lit directly with radiance 1, each further bounce adds its share:
/// 1 + ρ + ρ² + ... With ρ = 1/2 that is 2 - 2^(1-m); with ρ = 1 it is m.
#[test]
fn a_white_furnace_sums_its_bounces() {
    let ray = Ray::new(Vec3::new(0.1, 0.2, 0.3), Vec3::X);
    for rho in [0.5, 1.0] {
        let wall = Material::Diffuse {
            reflectance: Spectrum::grey(rho),
        };
        let lit = LitScene::new(spheres(&[(Vec3::ZERO, 1.0, wall)]), None);
        for max_depth in [0, 1, 2, 5, 30] {
            let sum: f64 = (0..max_depth).map(|k| f64::powi(rho, k as i32)).sum();
            let ball = follow(
                &lit,
                &ray,
                max_depth,
                20,
                &mut |_, _, _| Spectrum::WHITE,
                &mut never,
            );
            assert!((ball.mean() - sum).abs() < ROUNDING * (1.0 + sum));
            assert!(ball.standard_error() < ROUNDING * (1.0 + sum));
        }
    }
}

/// Hard case 84. The same ball with roulette: noisier, as bright.
#[test]
fn roulette_on_and_off_agree() {
    let ray = Ray::new(Vec3::new(0.1, 0.2, 0.3), Vec3::X);
    let wall = Material::Diffuse {
        reflectance: Spectrum::new(0.7, 0.4, 0.1),
    };
    let lit = LitScene::new(spheres(&[(Vec3::ZERO, 1.0, wall)]), None);
    let lamp = &mut |_: &Surface, _: Vec3, _: &mut PixelSampler| Spectrum::WHITE;
    let truth = (1.0 - f64::powi(0.7, 60)) / 0.3;
    let on = follow(&lit, &ray, 60, 100_000, lamp, &mut play_roulette);
    assert_mean("roulette", &on, truth, 0.07);
    // Survivors that do not make up for the dead are seen: their light is too little.
    let unpaid = &mut |throughput: Spectrum, bounces: u32, u: f64| {
        play_roulette(throughput, bounces, u).map(|_| throughput)
    };
    let dark = follow(&lit, &ray, 60, 100_000, lamp, unpaid);
    assert!(truth - dark.mean() > 0.07, "{}", dark.mean());
}

/// What emits is seen at depth 0, directly lit surfaces from depth 1 on.
#[test]
fn depth_counts_bounces() {
    let lamp = Material::Emission {
        radiance: Spectrum::grey(5.0),
    };
    let lit = LitScene::new(spheres(&[(Vec3::ZERO, 1.0, lamp)]), None);
    let at_the_lamp = Ray::new(3.0 * Vec3::Z, -Vec3::Z);
    for max_depth in [0, 1, 7] {
        let seen = follow(&lit, &at_the_lamp, max_depth, 1, &mut no_direct, &mut never);
        assert_eq!(seen.mean(), 5.0);
    }
    let past_the_lamp = Ray::new(3.0 * Vec3::Z, Vec3::Y);
    let nothing = follow(&lit, &past_the_lamp, 7, 1, &mut no_direct, &mut never);
    assert_eq!(nothing.mean(), 0.0);
    // From inside, the back of the lamp: black.
    let inside = Ray::new(Vec3::ZERO, Vec3::Y);
    let back = follow(&lit, &inside, 7, 1, &mut no_direct, &mut never);
    assert_eq!(back.mean(), 0.0);
}

/// A mirror shows something from the second ray on: the lamp, and what is lit.
#[test]
fn a_mirror_needs_a_second_ray() {
    let mirror = Material::Mirror {
        reflectance: Spectrum::grey(0.5),
    };
    let all_around = Environment::uniform(Spectrum::WHITE);
    let lit = LitScene::new(spheres(&[(Vec3::ZERO, 1.0, mirror)]), Some(all_around));
    let ray = Ray::new(3.0 * Vec3::Z, -Vec3::Z);
    let direct = &mut |_: &Surface, _: Vec3, _: &mut PixelSampler| -> Spectrum {
        panic!("mirrors have no direct light")
    };
    for (max_depth, seen) in [(0, 0.0), (1, 0.0), (2, 0.5), (9, 0.5)] {
        let mirror = follow(&lit, &ray, max_depth, 1, direct, &mut never);
        assert_eq!(mirror.mean(), seen, "at depth {max_depth}");
    }
}

/// Light that `direct` has counted already must not count again when a random ray finds it.
#[test]
fn a_lamp_counts_once() {
    let matte = Material::Diffuse {
        reflectance: Spectrum::WHITE,
    };
    let all_around = Environment::uniform(Spectrum::WHITE);
    let lit = LitScene::new(spheres(&[(Vec3::ZERO, 1.0, matte)]), Some(all_around));
    let ray = Ray::new(3.0 * Vec3::Z, -Vec3::Z);
    let direct = &mut |_: &Surface, _: Vec3, _: &mut PixelSampler| Spectrum::WHITE;
    // A white ball in a white furnace cannot be seen. It is convex, so direct light is all.
    let ball = follow(&lit, &ray, 9, 100, direct, &mut never);
    assert_eq!(ball.mean(), 1.0);
}

/// Hard case 78 and the furnace for glass: whatever is clear cannot be seen in a furnace. Mirrors, refraction, glass and a
/// ball of air in a ball of glass, with rays that enter, leave and are trapped for a while.
#[test]
fn clear_balls_are_invisible_in_a_furnace() {
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
            let ball = follow(&lit, &ray, 1000, 500, &mut no_direct, &mut never);
            assert!((ball.mean() - 0.75).abs() < 1e-9, "{}", ball.mean());
        }
    }
}

/// Tinted glass is as bright as Airy's sum says: a ball seen through its centre reflects R, and passes (1-R)² t² Σ (R t)^2k
/// and reflects the rest. Only what arrives is counted: the furnace is 1.
#[test]
fn tinted_glass_has_the_sum_of_its_reflections() {
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
    // In and out, however often it is reflected inside, light passes the boundary twice.
    let r = 0.04;
    let truth = r + (1.0 - r) * t * t;
    let ray = Ray::new(3.0 * Vec3::Z, -Vec3::Z);
    let seen = follow(&lit, &ray, 200, 200_000, &mut no_direct, &mut never);
    assert_mean("tinted glass", &seen, truth, 0.003);
}

/// Hard case 82, and a mirror inside out: thousands of bounces in a mirror ball, none of which escapes or sticks.
#[test]
fn nothing_escapes_from_a_closed_mirror() {
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
        let seen = follow(&lit, &ray, 5000, 1, &mut no_direct, &mut never);
        assert_eq!(seen.mean(), 0.0, "a ray got out of {radius}");
    }
}
// END SOLUTION(part4.task2)
