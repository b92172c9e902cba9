//! Vertex normals that disagree with the surface: no light passes, and nothing is black for it.

use kit::sampler::Sampling;
use kit::scene::{NamedLight, NamedMaterial, Object};
use kit::{Camera, FilmSize, Light, LitScene, Mat3, Material, Scene, Spectrum, Triangle, Vec3};
use pathtracer::{
    Accel, AccelKind, Darkness, DirectSampling, Job, LightSettings, Textures, darkness, render_lit,
};
use std::sync::atomic::AtomicBool;

/// A sheet in the plane y = 0, whose normals are tilted by `degrees` towards +x, and a point light.
fn sheet(degrees: f64, light: Vec3, material: Material) -> LitScene {
    let (sin, cos) = degrees.to_radians().sin_cos();
    let n = Vec3::new(sin, cos, 0.0);
    let corner = |x: f64, z: f64| Vec3::new(x, 0.0, z);
    let triangles = [
        [corner(-1.0, -1.0), corner(1.0, 1.0), corner(1.0, -1.0)],
        [corner(-1.0, -1.0), corner(-1.0, 1.0), corner(1.0, 1.0)],
    ];
    let scene = Scene {
        triangles: triangles
            .map(|points| Triangle::smooth(points, [n; 3]))
            .to_vec(),
        object_of: vec![0, 0],
        objects: vec![Object {
            name: "sheet".into(),
            material: 0,
        }],
        materials: vec![NamedMaterial {
            name: "paint".into(),
            material,
        }],
        lights: vec![NamedLight {
            name: "lamp".into(),
            light: Light::Point {
                position: light,
                intensity: Spectrum::grey(40.0),
            },
        }],
        ..Scene::default()
    };
    LitScene::new(scene, None)
}

const WHITE: Material = Material::Diffuse {
    reflectance: Spectrum::grey(0.8),
};

fn job(from: Vec3) -> Job {
    let film = FilmSize { w: 8, h: 8 };
    let c2w: Mat3 = Camera::look_at(from, Vec3::ZERO, Vec3::Y).expect("a direction");
    Job {
        camera: Camera {
            pos: from,
            c2w,
            h_fov: 10.0,
            v_fov: 10.0,
            n_clip: 0.0,
            f_clip: 1e30,
        },
        film,
        cell: film.whole(),
        samples: 4,
        sampling: Sampling::from(0),
    }
}

/// The mean luminance, which is the same with paths in lanes.
fn mean(lit: &LitScene, from: Vec3, direct_sampling: DirectSampling) -> f64 {
    mean_with(lit, from, direct_sampling, false)
}

fn mean_with(
    lit: &LitScene,
    from: Vec3,
    direct_sampling: DirectSampling,
    soft_terminator: bool,
) -> f64 {
    let settings = LightSettings {
        max_depth: 3,
        direct_sampling,
        soft_terminator,
        ..LightSettings::default()
    };
    let pictures = [AccelKind::Bvh, AccelKind::Simd].map(|kind| {
        let accel = Accel::build(kind, &lit.scene);
        let (stop, textures) = (AtomicBool::new(false), Textures::default());
        let rendered = render_lit(
            lit,
            &textures,
            &accel,
            &job(from),
            &settings,
            &stop,
            &|_, _| (),
        );
        rendered.film.pixels().to_vec()
    });
    assert_eq!(pictures[0], pictures[1]);
    let luminances = pictures[0].iter().map(|pixel| pixel.radiance.luminance());
    luminances.sum::<f64>() / 64.0
}

const ABOVE: Vec3 = Vec3::new(0.0, 4.0, 0.0);
/// Sees the front of the sheet, but the back of normals that are tilted by 60 degrees.
const LOW: Vec3 = Vec3::new(-4.0, 1.0, 0.01);

#[test]
fn tilted_normals_are_not_black() {
    for sampling in [DirectSampling::Lights, DirectSampling::Mis] {
        let flat = mean(&sheet(0.0, ABOVE, WHITE), LOW, sampling);
        let tilted = mean(&sheet(60.0, ABOVE, WHITE), LOW, sampling);
        assert!((0.4..0.75).contains(&flat), "{flat}");
        assert!(
            tilted > 0.5 * flat && tilted < 1.01 * flat,
            "{tilted} {flat}"
        );
    }
}

/// The light is below the sheet, but on the front of its tilted normals.
#[test]
fn no_light_passes_an_opaque_sheet() {
    let below = Vec3::new(4.0, -1.0, 0.0);
    let above = Vec3::new(2.0, 3.0, 0.5);
    for material in [
        WHITE,
        Material::Glossy {
            reflectance: Spectrum::WHITE,
            shininess: 2.0,
        },
    ] {
        for sampling in [DirectSampling::Lights, DirectSampling::Mis] {
            assert_eq!(mean(&sheet(60.0, below, material), above, sampling), 0.0);
        }
    }
}

/// Light that just grazes the sheet is on the front of its tilted normals: with a hard terminator
/// the sheet is bright at once.
#[test]
fn a_soft_terminator_fades_towards_the_plane_of_the_surface() {
    let from = Vec3::new(2.0, 3.0, 0.5);
    let glossy = Material::Glossy {
        reflectance: Spectrum::WHITE,
        shininess: 2.0,
    };
    for material in [WHITE, glossy] {
        for sampling in [DirectSampling::Lights, DirectSampling::Mis] {
            let at = |degrees: f64, tilt: f64, soft| {
                let (sin, cos) = degrees.to_radians().sin_cos();
                let light = 6.0 * Vec3::new(cos, sin, 0.0);
                mean_with(&sheet(tilt, light, material), from, sampling, soft)
            };
            let share = |degrees| at(degrees, 60.0, true) / at(degrees, 60.0, false);
            assert!(at(12.0, 60.0, false) > 0.05, "bright");
            let shares = [12.0, 20.0, 40.0, 70.0].map(share);
            assert!(shares.is_sorted() && shares[0] < 0.7, "{shares:?}");
            // Where the light is as high as the normals let expect, and where both normals agree.
            assert!((share(89.0) - 1.0).abs() < 1e-12);
            assert!((at(20.0, 0.0, true) / at(20.0, 0.0, false) - 1.0).abs() < 1e-12);
        }
    }
}

/// What a note about a black picture says is true of it.
#[test]
fn the_reason_of_a_black_picture_is_found() {
    let reason = |lit: &LitScene, from: Vec3, max_depth: u32| {
        let settings = LightSettings {
            max_depth,
            ..LightSettings::default()
        };
        let accel = Accel::build(AccelKind::Bvh, &lit.scene);
        darkness(lit, &accel, &job(from), &settings)
    };
    let below = Vec3::new(0.0, -4.0, 0.0);
    let from = Vec3::new(1.0, 4.0, 0.5);
    let black = Material::Diffuse {
        reflectance: Spectrum::BLACK,
    };
    assert_eq!(
        reason(&sheet(0.0, ABOVE, WHITE), from, 0),
        Darkness::DepthZero
    );
    assert_eq!(
        reason(&sheet(0.0, below, WHITE), from, 1),
        Darkness::FacingAway
    );
    assert_eq!(
        reason(&sheet(0.0, ABOVE, black), from, 1),
        Darkness::BlackSurfaces
    );
    assert_eq!(reason(&sheet(0.0, ABOVE, WHITE), from, 1), Darkness::Other);
    let mut away = job(from);
    away.camera.pos = Vec3::new(50.0, 4.0, 0.0);
    let lit = sheet(0.0, ABOVE, WHITE);
    let accel = Accel::build(AccelKind::Bvh, &lit.scene);
    let settings = LightSettings::default();
    assert_eq!(
        darkness(&lit, &accel, &away, &settings),
        Darkness::NothingSeen
    );
    let mut covered = sheet(0.0, ABOVE, WHITE).scene;
    let roof = covered.triangles.iter().map(|t| {
        let up = Vec3::new(0.0, 3.0, 0.0);
        Triangle::flat(up + 0.5 * t.p0, up + 0.5 * t.p1, up + 0.5 * t.p2)
    });
    let roof: Vec<Triangle> = roof.collect();
    covered.triangles.extend(roof);
    covered.object_of = vec![0; 4];
    let from = Vec3::new(4.0, 1.0, 0.5);
    assert_eq!(
        reason(&LitScene::new(covered, None), from, 1),
        Darkness::Shadowed
    );
}
