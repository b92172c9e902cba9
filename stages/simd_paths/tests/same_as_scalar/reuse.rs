//! Paths that are shared keep the mean of each pixel, and all instruction sets give the same bits.

use crate::scalar::ScalarPaths;
use crate::scenes::{Random, box_with_a_point_light, random_scene};
use crate::{TO_DEPTH_5, bits, starts, view};
use kit::sampler::Sampling;
use kit::{LitScene, Material, Spectrum, Sphere, Tally, Vec3};
use lanes::instruction_sets;
use simd_paths::{CausticGuide, Level, PathMemory, PathScene, PathSettings};

const REUSE: PathSettings = PathSettings {
    keeps_direct: true,
    reuses_paths: true,
    ..TO_DEPTH_5
};

fn trace(lit: &LitScene, settings: PathSettings, samples: u32, level: Level) -> Vec<Spectrum> {
    trace_guided(lit, settings, samples, level, None)
}

pub(crate) fn trace_guided(
    lit: &LitScene,
    settings: PathSettings,
    samples: u32,
    level: Level,
    guide: Option<&CausticGuide>,
) -> Vec<Spectrum> {
    let scene = PathScene::new(lit, &[]).expect("a scene");
    let guided = scene.at_level(level).guided(guide);
    let mut fallback = ScalarPaths::new(lit, settings);
    let (view, mut memory) = (view(false, false), PathMemory::default());
    let starts = starts(Sampling::from(7), &view);
    guided.trace(
        &view,
        &settings,
        &starts,
        samples,
        &mut memory,
        &mut fallback,
    )
}

#[test]
fn shared_paths_have_the_same_bits_with_every_instruction_set() {
    let mut random = Random::new(4);
    for i in 0..30 {
        let lit = random_scene(&mut random, if i % 5 == 0 { 60 } else { 28 });
        let mut all = Vec::new();
        for level in instruction_sets() {
            let radiance = trace(&lit, REUSE, 9, level);
            all.push(radiance.into_iter().map(bits).collect::<Vec<_>>());
        }
        assert!(all.iter().all(|bits| *bits == all[0]), "scene {i}");
    }
}

/// Balls and walls hide the surfaces that some paths find from other pixels, and a mirror lets
/// paths with fewer bounces left find them.
#[test]
fn shared_paths_keep_the_mean_of_each_pixel_and_lower_the_variance() {
    let ball = |x: f64, y: f64, z: f64| Sphere {
        center: Vec3::new(x, y, z),
        radius: 0.3,
    };
    let balls = vec![
        ball(-0.5, -0.6, 0.1),
        ball(0.5, -0.5, -0.4),
        ball(0.0, 0.4, -0.6),
    ];
    let mut scene = box_with_a_point_light(balls);
    let mirror = Spectrum::grey(0.9);
    scene.objects.push(scene.objects[0].clone());
    scene.materials.push(scene.materials[0].clone());
    scene.objects[1].material = 1;
    scene.materials[1].material = Material::Mirror {
        reflectance: mirror,
    };
    *scene.object_of.last_mut().expect("a ball") = 1;
    let lit = LitScene::new(scene, None);
    for max_depth in [2, 3, 5] {
        let [alone, shared] = [false, true].map(|reuses_paths| {
            let settings = PathSettings {
                max_depth,
                reuses_paths,
                ..REUSE
            };
            trace(&lit, settings, 4096, Level::new())
        });
        // Squares of differences of means in standard errors; variances.
        let (mut squares, mut before, mut after) = (Tally::default(), 0.0, 0.0);
        for (alone, shared) in alone.chunks(4096).zip(shared.chunks(4096)) {
            let tally = |samples: &[Spectrum]| -> Tally {
                samples.iter().map(|sample| sample.luminance()).collect()
            };
            let differences: Vec<_> = shared.iter().zip(alone).map(|(a, b)| *a - *b).collect();
            let difference = tally(&differences);
            squares.push((difference.mean() / difference.standard_error()).powi(2));
            before += tally(alone).standard_error().powi(2);
            after += tally(shared).standard_error().powi(2);
        }
        assert!(squares.mean() < 1.6, "depth {max_depth}: {squares:?}");
        assert!(
            after < 0.75 * before,
            "depth {max_depth}: {after} of {before}"
        );
    }
}
