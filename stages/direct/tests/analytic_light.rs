//! Direct light in scenes with known solutions, estimated by all methods.
//!
//! A diffuse floor lies in the plane y = 0 and is seen from above; the shading point is the origin.
//! Each test is a z-test: the probability that a correct estimate fails is at most [`FAMILY`] for
//! all tests together, and a bias of [`WORST_SURE_BIAS`] is detected. The tests also assert that an
//! estimate with a known error fails.

// BEGIN SOLUTION(part3.task3)
mod floor;

use floor::{Floor, RHO};
use kit::scene::{NamedLight, NamedMaterial, Object};
use kit::{Environment, Light, LitScene, Material, Scene, Spectrum, Sphere, Tally, Vec3};
use statistics::{detectable_bias, sidak, two_sided};
use std::f64::consts::{FRAC_1_PI, PI};

/// Significance level of all tests of this file together.
const FAMILY: f64 = 1e-6;
/// Number of estimates that this file compares.
const TESTS: usize = 24;
/// Number of samples of an estimate, sufficient for [`WORST_SURE_BIAS`] in the noisiest scene.
const SAMPLES: u32 = 400_000;
/// Every relative bias of at least this size is detected.
const WORST_SURE_BIAS: f64 = 0.04;
/// Tolerance for an estimate without noise: a dozen rounding errors.
const ROUNDING: f64 = 1e-13;

fn assert_estimates(what: &str, estimate: &Tally, truth: f64) {
    let significance = sidak(FAMILY, TESTS);
    let p = two_sided(estimate.z_against(truth));
    assert!(
        p > significance,
        "{what}: estimated {} ± {}, expected {truth}: p = {p:e}",
        estimate.mean(),
        estimate.standard_error()
    );
    let sure = detectable_bias(estimate.standard_error(), significance) / truth;
    assert!(
        sure < WORST_SURE_BIAS,
        "{what} is too noisy: a bias below ±{sure} is not detected"
    );
    // A bias of this size is detected in both directions.
    for off in [1.0 + WORST_SURE_BIAS, 1.0 - WORST_SURE_BIAS] {
        let p = two_sided(estimate.z_against(off * truth));
        assert!(
            p < significance,
            "{what}: a factor of {off} is not detected, p = {p:e}"
        );
    }
}

fn scene_with(light: Light) -> Scene {
    Scene {
        lights: vec![NamedLight {
            name: "lamp".into(),
            light,
        }],
        ..Scene::default()
    }
}

/// A lamp of 2 x 1 at height 0.75, with its centre above the origin.
fn area(direction: Vec3) -> Scene {
    scene_with(Light::Area {
        center: Vec3::new(0.0, 0.75, 0.0),
        edge_x: Vec3::new(2.0, 0.0, 0.0),
        edge_y: Vec3::new(0.0, 0.0, 1.0),
        direction,
        radiance: Spectrum::grey(3.0),
    })
}

/// The form factor of a rectangle parallel to a surface element, with a corner exactly above it and
/// edges of `a` and `b` times its height (see any catalogue of view factors: differential area to
/// finite rectangle).
fn corner_form_factor(a: f64, b: f64) -> f64 {
    let (ra, rb) = ((1.0 + a * a).sqrt(), (1.0 + b * b).sqrt());
    (a / ra * (b / ra).atan() + b / rb * (a / rb).atan()) / (2.0 * PI)
}

#[test]
fn rectangular_lamp_above_the_floor() {
    let floor = Floor::under(LitScene::new(area(-Vec3::Y), None));
    let truth = RHO * 3.0 * 4.0 * corner_form_factor(1.0 / 0.75, 0.5 / 0.75);
    assert_estimates("hemisphere", &floor.hemisphere(SAMPLES), truth);
    assert_estimates("lights", &floor.lights(SAMPLES, 1), truth);
    assert_estimates("both", &floor.mis(SAMPLES), truth);
    // Four samples per light, and a quarter of the estimates.
    assert_estimates("4 directions", &floor.hemisphere_of(SAMPLES / 4, 4), truth);
    assert_estimates("lights, -l 4", &floor.lights(SAMPLES / 4, 4), truth);
}

/// Both sides of the floor are diffuse, and each is lit from its own side.
#[test]
fn lower_side_is_lit_from_below() {
    let mut scene = area(Vec3::Y);
    if let Light::Area { center, .. } = &mut scene.lights[0].light {
        *center = -*center;
    }
    let below = Floor::under(LitScene::new(scene, None)).seen_from_below();
    let truth = RHO * 3.0 * 4.0 * corner_form_factor(1.0 / 0.75, 0.5 / 0.75);
    assert_estimates("hemisphere, below", &below.hemisphere(SAMPLES), truth);
    assert_estimates("lights, below", &below.lights(SAMPLES, 1), truth);
}

/// No rays are traced if nothing can be scattered.
#[test]
fn no_ray_is_traced_without_scattering() {
    let lamp = || LitScene::new(area(-Vec3::Y), None);
    let behind = Floor::under(lamp()).seen_from_below();
    assert_eq!(behind.lights(100, 1).mean(), 0.0);
    assert_eq!(
        behind.rays_of_last_estimate(),
        0,
        "the lamp is behind the surface"
    );
    let mirror = Floor::under(lamp()).made_of(Material::Mirror {
        reflectance: Spectrum::WHITE,
    });
    for estimate in [mirror.lights(100, 4), mirror.hemisphere_of(100, 4)] {
        assert_eq!(estimate.mean(), 0.0);
        assert_eq!(mirror.rays_of_last_estimate(), 0, "a mirror needs no rays");
    }
}

#[test]
fn zero_samples_are_black() {
    let floor = Floor::under(LitScene::new(area(-Vec3::Y), None));
    assert_eq!(floor.hemisphere_of(3, 0).mean(), 0.0);
    assert_eq!(floor.lights(3, 0).mean(), 0.0);
}

/// Hard case 90.
#[test]
fn lamp_that_faces_away_contributes_nothing() {
    let floor = Floor::under(LitScene::new(area(Vec3::Y), None));
    assert_eq!(floor.hemisphere(1000).mean(), 0.0);
    assert_eq!(floor.lights(1000, 1).mean(), 0.0);
}

/// Hard case 90: all directions to the lamp are in its plane.
#[test]
fn lamp_seen_edge_on_contributes_nothing() {
    let edge_on = scene_with(Light::Area {
        center: Vec3::new(0.0, 2.0, 0.0),
        edge_x: Vec3::Y,
        edge_y: Vec3::Z,
        direction: Vec3::X,
        radiance: Spectrum::WHITE,
    });
    let floor = Floor::under(LitScene::new(edge_on, None));
    assert_eq!(floor.lights(1000, 1).mean(), 0.0);
}

/// The irradiance of a sphere is π L (r/d)² cos θ if all of it is above the horizon.
#[test]
fn emitting_sphere() {
    let center = Vec3::new(0.6, 1.2, -0.3);
    let scene = Scene {
        spheres: vec![Sphere {
            center,
            radius: 0.8,
        }],
        object_of: vec![0],
        objects: vec![Object {
            name: "lamp".into(),
            material: 0,
        }],
        materials: vec![NamedMaterial {
            name: "glow".into(),
            material: Material::Emission {
                radiance: Spectrum::grey(2.0),
            },
        }],
        ..Scene::default()
    };
    let floor = Floor::under(LitScene::new(scene, None));
    let cos = center.y / center.length();
    let truth = RHO * 2.0 * 0.64 / center.length_squared() * cos;
    assert_estimates("hemisphere", &floor.hemisphere(SAMPLES), truth);
    assert_estimates("lights", &floor.lights(SAMPLES, 1), truth);
    assert_estimates("both", &floor.mis(SAMPLES), truth);
}

/// The sky fills the whole hemisphere, so the radiance of the diffuse floor is ρ L.
#[test]
fn uniform_sky() {
    let sky = scene_with(Light::Hemisphere {
        radiance: Spectrum::grey(1.5),
    });
    let floor = Floor::under(LitScene::new(sky, None));
    assert_estimates("hemisphere", &floor.hemisphere(SAMPLES), RHO * 1.5);
    assert_estimates("lights", &floor.lights(SAMPLES, 1), RHO * 1.5);
    assert_estimates("both", &floor.mis(SAMPLES), RHO * 1.5);
}

#[test]
fn uniform_environment() {
    let environment = Environment::uniform(Spectrum::grey(0.7));
    let floor = Floor::under(LitScene::new(Scene::default(), Some(environment)));
    assert_estimates("hemisphere", &floor.hemisphere(SAMPLES), RHO * 0.7);
    assert_estimates("lights", &floor.lights(SAMPLES, 1), RHO * 0.7);
    assert_estimates("both", &floor.mis(SAMPLES), RHO * 0.7);
}

/// An environment map with four rows. The upper two are visible:
/// `∫ L cos θ dw / π = Σ L (cos² θ_top - cos² θ_bottom)`.
#[test]
fn environment_of_horizontal_bands() {
    let bands = [4.0, 0.5, 9.0, 2.0];
    let texels = bands.iter().flat_map(|&b| [Spectrum::grey(b); 3]).collect();
    let environment = Environment::new(3, 4, texels).unwrap();
    let floor = Floor::under(LitScene::new(Scene::default(), Some(environment)));
    let truth = RHO * (4.0 * 0.5 + 0.5 * 0.5);
    assert_estimates("hemisphere", &floor.hemisphere(SAMPLES), truth);
    assert_estimates("lights", &floor.lights(SAMPLES, 1), truth);
    assert_estimates("both", &floor.mis(SAMPLES), truth);
}

#[test]
fn delta_lights_have_no_noise() {
    let position = Vec3::new(1.0, 2.0, 2.0);
    let cases = [
        (
            Light::Point {
                position,
                intensity: Spectrum::grey(9.0),
            },
            9.0 / 9.0 * (2.0 / 3.0),
        ),
        (
            Light::Spot {
                position,
                direction: (-position + Vec3::X).normalize(),
                intensity: Spectrum::grey(9.0),
                falloff_angle: 90.0,
                falloff_exponent: 2.0,
            },
            // The cosine of the angle to the axis is 8/√(9·8), its square 8/9.
            2.0 / 3.0 * (8.0 / 9.0),
        ),
        (
            Light::Directional {
                direction: Vec3::new(0.6, -0.8, 0.0),
                irradiance: Spectrum::grey(5.0),
            },
            5.0 * 0.8,
        ),
    ];
    for (light, irradiance) in cases {
        let floor = Floor::under(LitScene::new(scene_with(light), None));
        let estimate = floor.lights(10, 4);
        let truth = RHO * FRAC_1_PI * irradiance;
        assert!(
            (estimate.mean() / truth - 1.0).abs() < ROUNDING,
            "{light:?}: {} expected {truth}",
            estimate.mean()
        );
        assert_eq!(
            floor.rays_of_last_estimate(),
            10,
            "one shadow ray for each estimate"
        );
        // Random directions never hit delta lights.
        assert_eq!(floor.hemisphere(100).mean(), 0.0);
    }
}

#[test]
fn outside_of_the_cone_of_a_spot_light_is_dark() {
    let spot = scene_with(Light::Spot {
        position: Vec3::Y,
        direction: Vec3::X,
        intensity: Spectrum::WHITE,
        falloff_angle: 90.0,
        falloff_exponent: 0.0,
    });
    let floor = Floor::under(LitScene::new(spot, None));
    assert_eq!(floor.lights(10, 1).mean(), 0.0);
    assert_eq!(floor.rays_of_last_estimate(), 0);
}

/// Hard case 80: the irradiance becomes very large, but stays finite.
#[test]
fn very_close_light_gives_a_finite_estimate() {
    for height in [1e-3, 1e-100, 1e-160, 0.0] {
        let light = Light::Point {
            position: Vec3::new(0.0, height, 0.0),
            intensity: Spectrum::WHITE,
        };
        let floor = Floor::under(LitScene::new(scene_with(light), None));
        assert!(floor.lights(4, 1).mean().is_finite(), "at height {height}");
    }
    let mut low = area(-Vec3::Y);
    if let Light::Area { center, .. } = &mut low.lights[0].light {
        center.y = 1e-12;
    }
    let floor = Floor::under(LitScene::new(low, None));
    assert!(floor.lights(1000, 1).mean().is_finite());
}

/// Typical mistakes change the estimate by more than the tests accept.
#[test]
fn typical_mistakes_are_detected() {
    let floor = Floor::under(LitScene::new(area(-Vec3::Y), None));
    let estimate = floor.lights(SAMPLES, 1);
    let sure = detectable_bias(estimate.standard_error(), sidak(FAMILY, TESTS));
    let truth = RHO * 3.0 * 4.0 * corner_form_factor(1.0 / 0.75, 0.5 / 0.75);
    let without_cosine = floor.lights_without_cosine(SAMPLES).mean();
    assert!(
        (without_cosine - truth).abs() > sure,
        "a missing cosine is not detected"
    );
    assert!(
        estimate.mean() > sure,
        "a factor of 2 in the pdf is not detected"
    );
}
// END SOLUTION(part3.task3)
