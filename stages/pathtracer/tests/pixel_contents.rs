//! Pixels that provably see nothing take one batch of an adaptive picture, and no other pixel does
//! for this reason.

use kit::scene::{NamedLight, NamedMaterial, Object};
use kit::{
    Camera, FilmSize, Light, LitScene, Material, PixelSampler, Scene, Spectrum, Sphere, Triangle,
    Vec2, Vec3,
};
use pathtracer::{Accel, AccelKind, Counters, Job, LightSettings, Picture, Textures, render_lit};
use raygen::generate_ray;
use std::sync::atomic::AtomicBool;

const FILM: FilmSize = FilmSize { w: 48, h: 32 };
const BATCH: u32 = 4;

fn settings() -> LightSettings {
    LightSettings {
        adaptive: Some((BATCH, 0.05)),
        ..LightSettings::default()
    }
}

fn job(camera: Camera) -> Job {
    Job {
        camera,
        film: FILM,
        cell: FILM.whole(),
        samples: 12,
        sampling: 5.into(),
    }
}

/// A camera at `pos` that looks at `target`.
fn camera(pos: Vec3, target: Vec3) -> Camera {
    Camera {
        pos,
        c2w: Camera::look_at(pos, target, Vec3::Y).expect("it has a direction"),
        h_fov: 60.0,
        v_fov: 42.0,
        n_clip: 0.0,
        f_clip: f64::INFINITY,
    }
}

/// A few small triangles and spheres around the origin, and a lamp.
fn scene(seed: u64) -> LitScene {
    let mut sampler = PixelSampler::new(0, 0, seed);
    let mut number = |scale: f64| scale * (2.0 * sampler.next_1d() - 1.0);
    let mut point = |scale: f64| Vec3::new(number(scale), number(scale), number(scale));
    let mut scene = Scene {
        lights: vec![NamedLight {
            name: String::new(),
            light: Light::Point {
                position: Vec3::new(0.0, 9.0, 9.0),
                intensity: Spectrum::grey(99.0),
            },
        }],
        ..Scene::default()
    };
    for _ in 0..5 {
        let corner = point(2.0);
        let triangle = Triangle::flat(corner, corner + point(1.0), corner + point(1.0));
        scene.triangles.push(triangle);
        scene.spheres.push(Sphere {
            center: point(2.0),
            radius: 0.3,
        });
    }
    let objects = scene.len();
    scene.materials.push(NamedMaterial {
        name: String::new(),
        material: Material::Diffuse {
            reflectance: Spectrum::grey(0.5),
        },
    });
    scene.objects.push(Object {
        name: String::new(),
        material: 0,
    });
    scene.object_of = vec![0; objects];
    LitScene::new(scene, None)
}

#[test]
fn no_ray_of_an_empty_pixel_hits_anything() {
    let mut empty_pixels = 0;
    for seed in 0..20 {
        let lit = scene(seed);
        let pos = Vec3::new(1.0, 2.0, 7.0 + 0.1 * seed as f64);
        let mut camera = camera(pos, Vec3::ZERO);
        if seed % 2 == 1 {
            // Within the scene: primitives that are partly behind the camera are cut off.
            (camera.pos, camera.n_clip) = (0.1 * pos, 0.1);
        }
        let job = job(camera);
        let accel = Accel::build(AccelKind::Brute, &lit.scene);
        let picture = Picture::Lit(lit);
        let contents = picture.pixel_contents(&job, &settings());
        for (x, y) in FILM
            .whole()
            .pixels()
            .filter(|&pixel| contents.is_empty(pixel))
        {
            empty_pixels += 1;
            let corners = [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (1.0, 1.0), (0.5, 0.5)];
            for (dx, dy) in corners {
                let sensor = Vec2::new(
                    (f64::from(x) + dx) / f64::from(FILM.w),
                    (f64::from(y) + dy) / f64::from(FILM.h),
                );
                let mut ray = generate_ray(&job.camera, sensor);
                let mut counters = Counters::default();
                let hit = accel.closest(picture.scene(), &mut ray, None, &mut counters);
                assert_eq!(hit, None, "seed {seed}, pixel ({x}, {y})");
            }
        }
    }
    // Of 30,720 pixels.
    assert!(empty_pixels > 10_000, "{empty_pixels}");
}

#[test]
fn empty_pixels_take_one_batch_with_every_tree() {
    let lit = scene(3);
    let job = job(camera(Vec3::new(1.0, 2.0, 8.0), Vec3::ZERO));
    let contents = Picture::Lit(lit.clone()).pixel_contents(&job, &settings());
    let samples = |kind| {
        let accel = Accel::build(kind, &lit.scene);
        let stop = AtomicBool::new(false);
        let textures = Textures::default();
        render_lit(
            &lit,
            &textures,
            &accel,
            &job,
            &settings(),
            &stop,
            &|_, _| {},
        )
    };
    let pictures = [AccelKind::Brute, AccelKind::Bvh, AccelKind::Simd].map(samples);
    let mut black = 0;
    for pixel in FILM.whole().pixels() {
        for picture in &pictures {
            let estimate = picture.film.get(pixel.0, pixel.1);
            if contents.is_empty(pixel) {
                assert_eq!(estimate.samples, BATCH, "{pixel:?}");
            } else if estimate.radiance == Spectrum::BLACK {
                // It is near a primitive, and black is not enough.
                assert_eq!(estimate.samples, job.samples, "{pixel:?}");
                black += 1;
            }
        }
    }
    assert!(black > 0, "no pixel is black beside a primitive");
}

#[test]
fn nothing_is_empty_where_rays_start_elsewhere_or_the_background_shines() {
    let camera = camera(Vec3::new(1.0, 2.0, 8.0), Vec3::ZERO);
    let is_any = |lit: LitScene, camera, settings: LightSettings| {
        let contents = Picture::Lit(lit).pixel_contents(&job(camera), &settings);
        FILM.whole().pixels().any(|pixel| contents.is_empty(pixel))
    };
    assert!(is_any(scene(3), camera, settings()));
    let mut with_lens = settings();
    with_lens.lens.radius = 0.1;
    assert!(!is_any(scene(3), camera, with_lens));
    assert!(!is_any(scene(3), camera, LightSettings::default()));
    let mut sky = scene(3).scene;
    sky.lights.push(NamedLight {
        name: String::new(),
        light: Light::Hemisphere {
            radiance: Spectrum::WHITE,
        },
    });
    assert!(!is_any(LitScene::new(sky, None), camera, settings()));
    // Within the scene: some primitives are behind the camera.
    let inside = self::camera(Vec3::ZERO, Vec3::Z);
    assert!(!is_any(scene(3), inside, settings()));
}
