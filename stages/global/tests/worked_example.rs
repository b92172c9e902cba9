//! The worked examples of the chapters of Part 4: the first tests to make green.

use global::{estimate_radiance, fresnel_dielectric, play_roulette, reflect, refract};
use kit::scene::{NamedMaterial, Object};
use kit::{
    BsdfSample, Hit, LitScene, Material, PixelSampler, PrimId, Ray, Scattering, Scene, Spectrum,
    Triangle, Vec2, Vec3,
};

#[test]
fn part4_task1_a_view_of_glass() {
    let outside = Vec3::new(0.6, 0.0, 0.8);
    assert_eq!(reflect(outside), Vec3::new(-0.6, 0.0, 0.8));
    let refracted = refract(outside, 1.5).expect("from outside there is a refracted direction");
    assert!(
        (refracted - Vec3::new(-0.4, 0.0, -0.9165)).length() < 1e-4,
        "{refracted}"
    );
    let reflected = fresnel_dielectric(0.8, 1.0 / 1.5);
    assert!((reflected - 0.0439).abs() < 1e-4, "{reflected}");

    // From inside everything is reflected.
    let inside = Vec3::new(0.8, 0.0, -0.6);
    assert_eq!(refract(inside, 1.5), None);
    assert_eq!(fresnel_dielectric(0.6, 1.5), 1.0);
    assert_eq!(reflect(inside), Vec3::new(-0.8, 0.0, -0.6));
}

/// What a surface reflects, in one direction, with its reflectance as the weight.
struct Straight;

impl Scattering for Straight {
    fn f(&self, _: &Material, _: Vec3, _: Vec3) -> Spectrum {
        Spectrum::BLACK
    }

    fn pdf(&self, _: &Material, _: Vec3, _: Vec3) -> f64 {
        0.0
    }

    fn sample(&self, material: &Material, _: Vec3, _: Vec2, _: f64) -> Option<BsdfSample> {
        let Material::Diffuse { reflectance } = *material else {
            return None;
        };
        Some(BsdfSample {
            wi: Vec3::Z,
            f: reflectance,
            pdf: 1.0,
            delta: false,
        })
    }
}

#[test]
fn part4_task2_a_wall_a_floor_and_a_lamp() {
    let wall = Material::Diffuse {
        reflectance: Spectrum::new(0.8, 0.2, 0.2),
    };
    let floor = Material::Diffuse {
        reflectance: Spectrum::grey(0.5),
    };
    let lamp = Material::Emission {
        radiance: Spectrum::grey(10.0),
    };
    let materials = [wall, floor, lamp];
    let named = |material| NamedMaterial {
        name: "surface".into(),
        material,
    };
    let scene = Scene {
        triangles: vec![Triangle::flat(Vec3::ZERO, Vec3::X, Vec3::Y); 3],
        object_of: vec![0, 1, 2],
        objects: (0..3)
            .map(|material| Object {
                name: "surface".into(),
                material,
            })
            .collect(),
        materials: materials.into_iter().map(named).collect(),
        ..Scene::default()
    };
    let lit = LitScene::new(scene, None);
    let mut hits = (0..3).map(|prim| Hit {
        t: 1.0,
        p: Vec3::new(0.25, 0.25, 0.0),
        n: Vec3::Z,
        ng: Vec3::Z,
        uv: Vec2::new(0.25, 0.25),
        prim: PrimId(prim),
    });
    let direct = [Spectrum::new(0.4, 0.1, 0.1), Spectrum::grey(0.3)];
    let radiance = estimate_radiance(
        &lit,
        &Ray::new(Vec3::new(0.25, 0.25, 1.0), -Vec3::Z),
        3,
        &mut PixelSampler::new(0, 0, 1),
        &Straight,
        &mut |_| hits.next(),
        // The lamp reflects nothing.
        &mut |surface, _, _| {
            let of = direct.get(surface.prim.0 as usize);
            of.copied().unwrap_or(Spectrum::BLACK)
        },
        &mut |throughput, _, _| Some(throughput),
    );
    let expected = [0.64, 0.16, 0.16];
    for (found, expected) in [radiance.r, radiance.g, radiance.b].iter().zip(expected) {
        assert!(
            (found - expected).abs() < 1e-12,
            "{radiance:?}, expected {expected}"
        );
    }
}

#[test]
fn part4_task3_a_path_survives_or_ends() {
    let throughput = Spectrum::new(0.25, 0.125, 0.0);
    assert_eq!(
        play_roulette(throughput, 4, 0.1),
        Some(Spectrum::new(1.0, 0.5, 0.0))
    );
    assert_eq!(play_roulette(throughput, 4, 0.25), None);
}
