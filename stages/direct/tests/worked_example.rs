//! The worked examples of the chapters of Part 3: the first tests to make green.

use direct::{
    estimate_direct_lighting_hemisphere, estimate_direct_lighting_importance, lambert_f,
    lambert_pdf, lambert_sample, zero_bounce_radiance,
};
use kit::scene::{NamedLight, NamedMaterial, Object};
use kit::{
    BsdfSample, Environment, Frame, Hit, Light, LitScene, Material, PixelSampler, PrimId, Ray,
    Scattering, Scene, Spectrum, Surface, Triangle, Vec2, Vec3,
};
use std::f64::consts::FRAC_1_PI;

/// The reflectance of the floor of tasks 2 and 3.
const FLOOR: Material = Material::Diffuse {
    reflectance: Spectrum::grey(0.8),
};

/// A diffuse surface of the reflectance 0.8, written out: task 1 need not be finished for task 2.
struct Matte;

impl Scattering for Matte {
    fn f(&self, _: &Material, wo: Vec3, wi: Vec3) -> Spectrum {
        match wo.z * wi.z > 0.0 {
            true => Spectrum::grey(0.8 * FRAC_1_PI),
            false => Spectrum::BLACK,
        }
    }

    fn pdf(&self, _: &Material, _: Vec3, wi: Vec3) -> f64 {
        wi.z.abs() * FRAC_1_PI
    }

    fn sample(&self, _: &Material, _: Vec3, _: Vec2, _: f64) -> Option<BsdfSample> {
        None
    }
}

/// The point of the floor at the origin.
fn floor() -> Surface<'static> {
    Surface {
        p: Vec3::ZERO,
        frame: Frame::around(Vec3::Z),
        ng: Vec3::Z,
        error: Vec3::ZERO,
        material: &FLOOR,
        prim: PrimId(u32::MAX),
    }
}

#[test]
fn part3_task1_an_orange_surface() {
    let orange = Spectrum::new(0.9, 0.5, 0.0);
    let above = Vec3::Z;
    let f = lambert_f(orange, above, above);
    assert!(
        (f.r - 0.2865).abs() < 1e-4 && (f.g - 0.1592).abs() < 1e-4 && f.b == 0.0,
        "{f:?}"
    );
    let sample = lambert_sample(orange, above, Vec2::new(0.25, 0.125)).expect("it reflects");
    let expected = Vec3::new(0.3536, 0.3536, 0.8660);
    assert!((sample.wi - expected).length() < 1e-4, "{}", sample.wi);
    assert!((sample.pdf - 0.2757).abs() < 1e-4, "{}", sample.pdf);
    assert!((lambert_pdf(above, sample.wi) - sample.pdf).abs() < 1e-12);
    let weight = sample.f * (sample.wi.z / sample.pdf);
    assert!(
        (weight.r - 0.9).abs() < 1e-12 && (weight.g - 0.5).abs() < 1e-12,
        "{weight:?}"
    );
}

#[test]
fn part3_task2_one_of_four_directions_meets_the_light() {
    // A sky of the radiance 10. Only the first ray sees it: the others hit something black.
    let black = Triangle::flat(Vec3::Z, Vec3::X + Vec3::Z, Vec3::Y + Vec3::Z);
    let scene = Scene {
        triangles: vec![black],
        object_of: vec![0],
        objects: vec![Object {
            name: "black".into(),
            material: 0,
        }],
        materials: vec![NamedMaterial {
            name: "black".into(),
            material: Material::Diffuse {
                reflectance: Spectrum::BLACK,
            },
        }],
        ..Scene::default()
    };
    let lit = LitScene::new(scene, Some(Environment::uniform(Spectrum::grey(10.0))));
    let surface = floor();
    assert_eq!(zero_bounce_radiance(&surface, Vec3::Z), Spectrum::BLACK);
    let mut cosines = Vec::new();
    let mut trace = |ray: &Ray| {
        cosines.push(ray.d.z);
        (cosines.len() > 1).then(|| Hit {
            t: 1.0,
            p: ray.at(1.0),
            n: Vec3::Z,
            ng: Vec3::Z,
            uv: Vec2::ZERO,
            prim: PrimId(0),
        })
    };
    let mut sampler = PixelSampler::new(0, 0, 3);
    let estimate = estimate_direct_lighting_hemisphere(
        &lit,
        &surface,
        Vec3::Z,
        4,
        &mut sampler,
        &Matte,
        &mut trace,
    );
    assert_eq!(cosines.len(), 4, "one ray for each sample");
    assert!(cosines.iter().all(|cosine| (0.0..=1.0).contains(cosine)));
    // In the book the cosine is 0.98, and the estimate 3.92.
    let expected = 2.0 * 0.8 * 10.0 * cosines[0] / 4.0;
    assert!(
        (estimate.g - expected).abs() < 1e-9,
        "{estimate:?}, expected {expected}"
    );
}

#[test]
fn part3_task3_a_lamp_straight_above() {
    let lamp = NamedLight {
        name: "lamp".into(),
        light: Light::Point {
            position: Vec3::new(0.0, 0.0, 2.0),
            intensity: Spectrum::grey(8.0),
        },
    };
    let scene = Scene {
        lights: vec![lamp],
        ..Scene::default()
    };
    let lit = LitScene::new(scene, None);
    let estimate = |is_occluded: bool| {
        let mut shadow_rays = Vec::new();
        let radiance = estimate_direct_lighting_importance(
            &lit,
            &floor(),
            Vec3::Z,
            1,
            &mut PixelSampler::new(0, 0, 3),
            &Matte,
            &mut |ray| {
                shadow_rays.push(*ray);
                is_occluded
            },
        );
        (radiance, shadow_rays)
    };
    // The lamp brings 8 / 2² = 2 along the normal: f · 2 · 1 / 1.
    let (light, shadow_rays) = estimate(false);
    assert!((light.g - 0.8 * FRAC_1_PI * 2.0).abs() < 1e-9, "{light:?}");
    assert_eq!(shadow_rays.len(), 1);
    assert!((shadow_rays[0].d.normalize() - Vec3::Z).length() < 1e-9);
    assert_eq!(estimate(true).0, Spectrum::BLACK);
}
