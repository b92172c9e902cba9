//! Packets of eight paths render the pictures of scalar paths, bit for bit, with the same counts of
//! effects.
// BEGIN SOLUTION(part6.task2)

use crate::common::{own_scenes, scene_files};
use kit::sampler::{Pattern, Sampling};
use kit::scene::NamedLight;
use kit::{FilmSize, Light, LitScene, Spectrum, Vec3};
use pathtracer::{
    Accel, AccelKind, DirectSampling, Job, Lens, LightSettings, Rendered, Textures, render_lit,
};
use scenes::placement;
use std::env;
use std::path::PathBuf;
use std::sync::atomic::AtomicBool;

/// The scenes of the course, and those in the folder `FIRSTLIGHT_SCENES`.
fn all_scene_files() -> Vec<PathBuf> {
    let mut folders = vec![own_scenes()];
    folders.extend(env::var_os("FIRSTLIGHT_SCENES").map(PathBuf::from));
    scene_files(&folders)
}

fn render(
    (lit, textures): (&LitScene, &Textures),
    accel: &Accel,
    samples: u32,
    settings: &LightSettings,
) -> Rendered {
    // No multiple of eight pixels; few of them where each has many samples.
    let film = match samples {
        0..100 => FilmSize { w: 21, h: 18 },
        _ => FilmSize { w: 7, h: 6 },
    };
    let job = Job {
        camera: placement::place(&lit.scene, film).camera,
        film,
        cell: film.whole(),
        samples,
        sampling: Sampling {
            pattern: [Pattern::Sobol4, Pattern::Sobol][(samples % 2) as usize],
            seed: 5,
            first_sample: 3,
        },
    };
    let stop = AtomicBool::new(false);
    render_lit(lit, textures, accel, &job, settings, &stop, &|_, _| {})
}

/// Samples per pixel and settings that cover the branches of the sample loop and the paths.
fn all_settings() -> Vec<(u32, LightSettings)> {
    let deep = LightSettings {
        max_depth: 6,
        lamp_rays: 4,
        ..LightSettings::default()
    };
    let adaptive = |batch| LightSettings {
        adaptive: Some((batch, 0.3)),
        ..deep
    };
    let through_lens = LightSettings {
        lens: Lens {
            radius: 0.05,
            focus: 2.0,
        },
        ..deep
    };
    vec![
        (1, deep),
        (3, deep),
        (
            3,
            LightSettings {
                lamp_rays: 1,
                ..deep
            },
        ),
        (
            70,
            LightSettings {
                max_depth: 2,
                ..deep
            },
        ),
        (
            4,
            LightSettings {
                max_depth: 1,
                light_samples: 3,
                ..deep
            },
        ),
        (
            4,
            LightSettings {
                max_depth: 0,
                ..deep
            },
        ),
        (
            4,
            LightSettings {
                light_samples: 0,
                ..deep
            },
        ),
        (
            2,
            LightSettings {
                roulette: false,
                ..deep
            },
        ),
        (
            6,
            LightSettings {
                roulette_factor: 3,
                ..deep
            },
        ),
        (
            2,
            LightSettings {
                direct_sampling: DirectSampling::Mis,
                ..deep
            },
        ),
        (
            2,
            LightSettings {
                direct_sampling: DirectSampling::Hemisphere,
                ..deep
            },
        ),
        (3, through_lens),
        (
            5,
            LightSettings {
                soft_terminator: true,
                clamp: Some(0.1),
                ..deep
            },
        ),
        (
            4,
            LightSettings {
                direct_sampling: DirectSampling::Mis,
                soft_terminator: true,
                ..deep
            },
        ),
        (
            20,
            LightSettings {
                clamp: Some(0.05),
                ..adaptive(8)
            },
        ),
        (300, adaptive(100)),
        (600, adaptive(257)),
        (20, adaptive(8)),
        (7, adaptive(32)),
        (1, adaptive(1)),
        (0, deep),
    ]
}

#[test]
fn pictures_and_counts_equal_those_of_scalar_paths() {
    let mut early = 0;
    for file in all_scene_files() {
        let scene = scenes::load(&file).expect("a scene").scene;
        let (textures, _) = Textures::load(&scene, file.parent().expect("a folder"));
        let lit = LitScene::new(scene, None);
        let accels = [AccelKind::Bvh, AccelKind::Simd].map(|kind| Accel::build(kind, &lit.scene));
        for (samples, settings) in all_settings() {
            let [scalar, packets] = accels
                .each_ref()
                .map(|accel| render((&lit, &textures), accel, samples, &settings));
            let what = format!("{}: {samples} samples, {settings:?}", file.display());
            assert!(packets.film == scalar.film, "{what}: the pictures differ");
            if settings.adaptive.is_some_and(|(batch, _)| batch < samples) {
                let taken = packets.film.pixels().iter().map(|pixel| pixel.samples);
                early += usize::from(taken.clone().min() < taken.max());
            }
            assert!(
                packets.luminance == scalar.luminance,
                "{what}: the luminances differ"
            );
            assert!(
                packets.removed == scalar.removed,
                "{what}: what clamping removes differs"
            );
            assert_eq!(packets.effects, scalar.effects, "{what}");
            assert_eq!(packets.counters.rays, scalar.counters.rays, "{what}");
        }
    }
    assert!(
        early > 3,
        "only {early} pictures have pixels that stop early"
    );
}

/// Of forty lamps each sample chooses one: packets and scalar paths the same, and the mean is that
/// of sampling all. In this scene all light is that of the lamps, and 64 samples tell it well.
#[test]
fn one_of_many_lamps_is_chosen() {
    let file = own_scenes().join("gems.dae");
    let mut scene = scenes::load(&file).expect("a scene").scene;
    let bounds = scene.primitive_bounds();
    let all = bounds.iter().fold(bounds[0], |all, b| all.union(*b));
    let size = all.extent();
    scene.lights = (0..40)
        .map(|i| NamedLight {
            name: format!("lamp {i}"),
            light: Light::Area {
                center: all.min
                    + size * Vec3::new(f64::from(i) / 39.0, 0.9, f64::from(i % 4) / 3.0),
                edge_x: 0.05 * size.x * Vec3::X,
                edge_y: 0.02 * size.z * Vec3::Z,
                direction: -Vec3::Y,
                radiance: Spectrum::grey(f64::from(i + 1)),
            },
        })
        .collect();
    let each = LitScene::new(scene, None);
    let chosen = each.clone().with_chosen_lamps();
    assert!(each.emitters.len() > 39 && chosen.emitters.len() == 1);
    let textures = Textures::default();
    let settings = LightSettings::default();
    let [scalar, packets] = [AccelKind::Bvh, AccelKind::Simd].map(|kind| {
        let accel = Accel::build(kind, &chosen.scene);
        render((&chosen, &textures), &accel, 64, &settings)
    });
    assert!(packets.film == scalar.film, "the pictures differ");
    let accel = Accel::build(AccelKind::Simd, &each.scene);
    let all_lamps = render((&each, &textures), &accel, 64, &settings);
    let mean = |rendered: &Rendered| {
        let pixels = rendered.film.pixels().iter();
        let sum: Spectrum = pixels.map(|pixel| pixel.radiance).sum();
        sum.luminance()
    };
    let ratio = mean(&packets) / mean(&all_lamps);
    assert!((ratio - 1.0).abs() < 0.01, "{ratio}");
    assert!(packets.counters.rays < all_lamps.counters.rays / 2);
}

#[test]
fn an_interrupted_picture_stays_black() {
    let lit = LitScene::new(
        scenes::load(&all_scene_files()[0]).expect("a scene").scene,
        None,
    );
    let film = FilmSize { w: 9, h: 8 };
    let job = Job {
        camera: placement::place(&lit.scene, film).camera,
        film,
        cell: film.whole(),
        samples: 4,
        sampling: 1.into(),
    };
    let (stop, settings) = (AtomicBool::new(true), LightSettings::default());
    let accel = Accel::build(AccelKind::Simd, &lit.scene);
    let textures = Textures::default();
    let rendered = render_lit(&lit, &textures, &accel, &job, &settings, &stop, &|_, _| {});
    assert_eq!((rendered.samples(), rendered.counters.rays), (0, 0));
}
// END SOLUTION(part6.task2)
