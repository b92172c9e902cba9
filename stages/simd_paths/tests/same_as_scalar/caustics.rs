//! Caustic rays keep the mean of each pixel wherever they are sent, and all instruction sets give
//! the same bits.

use crate::scenes::{Random, box_with_a_point_light, random_scene};
use crate::{TO_DEPTH_5, bits, reuse::trace_guided};
use kit::{LitScene, Material, Scene, Spectrum, Sphere, Tally, Vec2, Vec3, warp};
use lanes::instruction_sets;
use simd_paths::{CausticGuide, Landing, Level, MAX_CAUSTIC_RAYS, PathSettings};

/// Landings on the walls of a box from -1 to 1, from near `targets`.
fn landings(count: u32, spread: f64, targets: &[Vec3]) -> Vec<Landing> {
    let mut random = Random::new(3);
    let landing = |i| {
        let wall = random.direction();
        Landing {
            p: wall / wall.abs().max_element(),
            from: targets[i as usize % targets.len()] + random.direction() * spread,
            light: 1.0 + random.direction().x,
        }
    };
    (0..count).map(landing).collect()
}

const BALLS: [Vec3; 3] = [
    Vec3::new(-0.4, -0.5, -0.2),
    Vec3::new(0.5, -0.5, 0.1),
    Vec3::new(0.0, 0.5, -0.2),
];

/// A mirror, a ball of glass and a lamp in a box.
fn room() -> LitScene {
    let balls = BALLS.map(|center| Sphere {
        center,
        radius: 0.3,
    });
    let mut scene: Scene = box_with_a_point_light(balls.to_vec());
    scene.lights.clear();
    let reflectance = Spectrum::grey(0.9);
    let materials = [
        Material::Mirror { reflectance },
        Material::Glass {
            reflectance,
            transmittance: reflectance,
            roughness: 0.0,
            ior: 1.5,
        },
        Material::Emission {
            radiance: Spectrum::WHITE,
        },
    ];
    let first = scene.object_of.len() - 3;
    for (i, material) in materials.into_iter().enumerate() {
        scene.objects.push(scene.objects[0].clone());
        scene.materials.push(scene.materials[0].clone());
        scene.objects[i + 1].material = i as u32 + 1;
        scene.materials[i + 1].material = material;
        scene.object_of[first + i] = i as u32 + 1;
    }
    LitScene::new(scene, None)
}

#[test]
fn caustic_rays_have_the_same_bits_with_every_instruction_set() {
    let guide = CausticGuide::new(&landings(20_000, 0.4, &BALLS)).expect("a guide");
    let mut random = Random::new(4);
    for i in 0..30 {
        let lit = random_scene(&mut random, if i % 5 == 0 { 60 } else { 28 });
        let mut all = Vec::new();
        for level in instruction_sets() {
            let radiance = trace_guided(&lit, TO_DEPTH_5, 9, level, Some(&guide));
            all.push(radiance.into_iter().map(bits).collect::<Vec<_>>());
        }
        assert!(all.iter().all(|bits| *bits == all[0]), "scene {i}");
    }
}

/// Samples of a pixel: with fewer the rare bright ones dominate the errors.
const SAMPLES: u32 = 16_384;

/// Also where nothing is: a bad guide has the same mean.
#[test]
fn caustic_rays_keep_the_mean_of_each_pixel() {
    let lit = room();
    let guides = [
        landings(20_000, 0.3, &BALLS[..2]),
        landings(3_000, 0.6, &BALLS[2..]),
    ];
    for (i, landings) in guides.iter().enumerate() {
        let guide = CausticGuide::new(landings).expect("a guide");
        let settings = PathSettings {
            keeps_direct: true,
            reuses_paths: i == 1,
            ..TO_DEPTH_5
        };
        let [alone, guided] = [None, Some(&guide)]
            .map(|guide| trace_guided(&lit, settings, SAMPLES, Level::new(), guide));
        let mut squares = Tally::default();
        for (alone, guided) in alone
            .chunks(SAMPLES as usize)
            .zip(guided.chunks(SAMPLES as usize))
        {
            let differences = guided.iter().zip(alone).map(|(a, b)| *a - *b);
            let difference: Tally = differences.map(|d| d.luminance()).collect();
            // Pixels without a diffuse surface are the same.
            if difference.standard_error() > 0.0 {
                squares.push((difference.mean() / difference.standard_error()).powi(2));
            }
        }
        assert!(squares.mean() < 1.5, "guide {i}: {squares:?}");
    }
}

/// Numbers of rays are densities: their integral over all directions is the number, and no sample
/// lies where they are 0.
#[test]
fn lobes_have_the_density_of_their_samples() {
    let guide = CausticGuide::new(&landings(20_000, 0.3, &BALLS)).expect("a guide");
    let mut random = Random::new(5);
    let mut with_lobes = 0;
    for _ in 0..40 {
        let wall = random.direction();
        let lobes = guide.lobes_at(wall / wall.abs().max_element());
        let rays = lobes.rays();
        assert!((0.0..=MAX_CAUSTIC_RAYS as f64 + 1e-9).contains(&rays));
        let (mut least, mut sum) = (f64::INFINITY, Tally::default());
        for i in 0..SAMPLES {
            let u = Vec2::new(f64::from(i % 64) + 0.5, f64::from(i / 64) + 0.5) / 64.0;
            sum.push(lobes.density(warp::uniform_sphere(u)) * 4.0 * std::f64::consts::PI);
            if let Some(d) = lobes.sample(f64::from(i) / 4096.0, u) {
                assert!((d.length() - 1.0).abs() < 1e-12);
                least = least.min(lobes.density(d));
            }
        }
        if least < f64::INFINITY {
            with_lobes += 1;
            assert!(least > 0.0, "{lobes:?}");
            assert!((sum.mean() / rays - 1.0).abs() < 0.2, "{lobes:?}");
        }
    }
    assert!(with_lobes > 30, "{with_lobes}");
    assert_eq!(guide.lobes_at(Vec3::NAN).rays(), 0.0);
    assert_eq!(guide.lobes_at(Vec3::splat(5.0)).rays(), 0.0);
    assert_eq!(CausticGuide::new(&[]), None);
}
