//! Scenes far from the origin: coordinates are large, distances are not.

use kit::scene::{NamedMaterial, Object};
use kit::{Camera, FilmSize, LitScene, Material, Scene, Spectrum, Triangle, Vec3};
use pathtracer::{Accel, AccelKind, DirectSampling, Job, LightSettings, Textures, render_lit};
use std::sync::atomic::AtomicBool;

/// A tilted floor of this `size` below a lamp of one unit, around `origin`.
fn floor_and_lamp(origin: Vec3, size: f64) -> LitScene {
    let (x, up) = (Vec3::new(0.8, 0.6, 0.0), Vec3::new(-0.6, 0.8, 0.0));
    let square = |center: Vec3, x: Vec3, y: Vec3| {
        let corner = |a: f64, b: f64| origin + center + x * a + y * b;
        let [a, b, c, d] =
            [(-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5)].map(|(s, t)| corner(s, t));
        [Triangle::flat(a, b, c), Triangle::flat(a, c, d)]
    };
    let floor = square(Vec3::ZERO, Vec3::Z * size, x * size);
    let lamp = square(up * 2.0, x, Vec3::Z);
    let material = |name: &str, material| NamedMaterial {
        name: name.into(),
        material,
    };
    let object = |name: &str, material| Object {
        name: name.into(),
        material,
    };
    let scene = Scene {
        triangles: [floor, lamp].concat(),
        object_of: vec![0, 0, 1, 1],
        objects: vec![object("floor", 0), object("lamp", 1)],
        materials: vec![
            material(
                "grey",
                Material::Diffuse {
                    reflectance: Spectrum::grey(0.5),
                },
            ),
            material(
                "light",
                Material::Emission {
                    radiance: Spectrum::grey(10.0),
                },
            ),
        ],
        ..Scene::default()
    };
    LitScene::new(scene, None)
}

/// The mean luminance of the floor below the lamp, which is the same with paths in lanes.
fn mean(lit: &LitScene, origin: Vec3, direct_sampling: DirectSampling) -> f64 {
    let film = FilmSize { w: 8, h: 8 };
    let up = Vec3::new(-0.6, 0.8, 0.0);
    let from = up * 1.5;
    let job = Job {
        camera: Camera {
            pos: origin + from,
            c2w: Camera::look_at(from, Vec3::ZERO, Vec3::Z).expect("a direction"),
            h_fov: 60.0,
            v_fov: 60.0,
            n_clip: 0.0,
            f_clip: f64::INFINITY,
        },
        film,
        cell: film.whole(),
        samples: 64,
        sampling: 0.into(),
    };
    let settings = LightSettings {
        direct_sampling,
        ..LightSettings::default()
    };
    let [plain, lanes] = [AccelKind::Bvh, AccelKind::Simd].map(|kind| {
        let accel = Accel::build(kind, &lit.scene);
        let (stop, textures) = (AtomicBool::new(false), Textures::default());
        render_lit(lit, &textures, &accel, &job, &settings, &stop, &|_, _| ())
    });
    assert!(plain.film == lanes.film);
    plain.mean_luminance()
}

/// A shadow ray ends before its light also where rounding is larger than one billionth of the
/// distance: lamps do not shade themselves.
#[test]
fn lamps_far_from_the_origin_light_the_floor() {
    for sampling in [DirectSampling::Lights, DirectSampling::Mis] {
        let expected = mean(&floor_and_lamp(Vec3::ZERO, 20.0), Vec3::ZERO, sampling);
        assert!(expected > 0.1, "{expected}");
        for far in [1e2, 1e4, 1e5, 1e6, 4e6, 1e8, 1e9] {
            let origin = Vec3::new(far, -0.7 * far, 0.3 * far);
            let found = mean(&floor_and_lamp(origin, 20.0), origin, sampling);
            // Rounding moves the points of the lamp and the floor.
            let tolerance = 1e-3 + 1e-12 * far;
            assert!(
                (found / expected - 1.0).abs() < tolerance,
                "{sampling:?} {far}: {found} {expected}"
            );
        }
    }
}

/// The origins of rays move by the rounding of the vertices, which are far away.
#[test]
fn lamps_light_floors_that_are_huge() {
    for sampling in [DirectSampling::Lights, DirectSampling::Mis] {
        let expected = mean(&floor_and_lamp(Vec3::ZERO, 20.0), Vec3::ZERO, sampling);
        for size in [1e3, 1e5, 1e7] {
            let found = mean(&floor_and_lamp(Vec3::ZERO, size), Vec3::ZERO, sampling);
            assert!(
                (found / expected - 1.0).abs() < 1e-3,
                "{sampling:?} {size}: {found} {expected}"
            );
        }
    }
}
