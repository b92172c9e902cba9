//! Packets compute the radiance of scalar paths, bit for bit, with every instruction set.

mod caustics;
mod reuse;
mod scalar;
mod scenes;

use kit::sampler::{Pattern, Sampling};
use kit::{Camera, FilmSize, LitScene, Mat3, PixelSampler, PrimId, Spectrum, Sphere, Vec2, Vec3};
use lanes::instruction_sets;
use scalar::{ScalarPaths, radiance};
use scenes::{Random, box_with_a_point_light, random_scene};
use simd_paths::{Counts, PathMemory, PathScene, PathSettings, PathStart, View};

/// A camera inside the scene.
fn view(centered: bool, has_lens: bool) -> View {
    View {
        camera: Camera {
            pos: Vec3::new(0.2, 0.1, 1.7),
            c2w: Mat3::IDENTITY,
            h_fov: 80.0,
            v_fov: 60.0,
            n_clip: 0.3,
            f_clip: 9.0,
        },
        film: FilmSize { w: 8, h: 6 },
        has_lens,
        centered,
    }
}

fn bits(radiance: Spectrum) -> [u64; 3] {
    radiance.to_array().map(f64::to_bits)
}

fn starts(sampling: Sampling, view: &View) -> Vec<PathStart> {
    let pixels = view.film.whole().pixels();
    let of = |(x, y)| PathStart {
        pixel: (x, y),
        sampler: PixelSampler::new(x, y, sampling),
    };
    pixels.map(of).collect()
}

/// Traces paths through `lit` as packets and as scalar paths, and compares them. Returns how many
/// paths have radiance.
fn compare(lit: &LitScene, settings: PathSettings, sampling: Sampling, view: &View) -> usize {
    let samples: u32 = if view.centered { 1 } else { 5 };
    let starts = starts(sampling, view);
    let scalar = ScalarPaths::new(lit, settings);
    let (mut expected, mut expected_direct) = (Vec::new(), Vec::new());
    for start in &starts {
        let mut start = start.clone();
        for _ in 0..samples {
            if !view.centered {
                start.sampler.start_sample();
            }
            let (radiance, direct) = radiance(&scalar, view, &start);
            expected.push(bits(radiance));
            // Without a direct surface all light is direct.
            expected_direct.push(bits(direct.unwrap_or(radiance)));
        }
    }
    // With all primitives in the tree, and with every other one apart from it.
    for odd in [0..0, 0..lit.scene.len() as u32 / 2] {
        let apart: Vec<PrimId> = odd.map(|i| PrimId(2 * i + 1)).collect();
        let mut all_counts = Vec::new();
        for level in instruction_sets() {
            let scene = PathScene::new(lit, &apart).expect("a scene");
            let scene = scene.at_level(level);
            let mut fallback = ScalarPaths::new(lit, settings);
            fallback.apart.clone_from(&apart);
            let mut memory = PathMemory::default();
            let results = scene.trace(
                view,
                &settings,
                &starts,
                samples,
                &mut memory,
                &mut fallback,
            );
            assert_eq!(results.len(), expected.len());
            for (i, (radiance, expected)) in results.iter().zip(&expected).enumerate() {
                assert_eq!(
                    bits(*radiance),
                    *expected,
                    "{level:?}, path {i}: {radiance:?}\n{lit:#?}"
                );
            }
            let parts = memory.direct.iter().zip(&results);
            let direct: Vec<_> = parts
                .map(|(direct, all)| bits(direct.unwrap_or(*all)))
                .collect();
            for (i, direct) in direct.iter().enumerate() {
                assert_eq!(
                    *direct, expected_direct[i],
                    "{level:?}, path {i}: direct light differs"
                );
            }
            assert_eq!(
                direct.len(),
                if settings.keeps_direct {
                    results.len()
                } else {
                    0
                }
            );
            let counts = sum(memory.counts, fallback.counts.get());
            assert_eq!(counts, scalar.counts.get(), "{level:?}: the counts differ");
            all_counts.push(memory.counts);
        }
        let first: Counts = all_counts[0];
        assert!(all_counts.iter().all(|c| *c == first), "{all_counts:?}");
    }
    expected.iter().filter(|bits| **bits != [0; 3]).count()
}

/// The operations of packets and of the scalar code, as far as both count them.
fn sum(packets: Counts, scalars: Counts) -> Counts {
    Counts {
        rays: packets.rays + scalars.rays,
        light_rays: packets.light_rays + scalars.light_rays,
        background: packets.background + scalars.background,
        bounces: packets.bounces + scalars.bounces,
        ..Counts::default()
    }
}

fn pattern(i: usize) -> Pattern {
    [
        Pattern::Sobol,
        Pattern::Independent,
        Pattern::Stratified { samples: 5 },
        Pattern::Sobol4,
    ][i % 4]
}

#[test]
fn with_lists_and_trees_and_every_material_and_light() {
    let mut random = Random::new(1);
    let mut lit_paths = 0;
    for i in 0..400 {
        let lit = random_scene(&mut random, if i % 5 == 0 { 60 } else { 28 });
        let settings = PathSettings {
            light_samples: (i % 3) as u32,
            max_depth: 1 + (i % 6) as u32,
            has_textures: i % 8 == 3,
            samples_bsdf: i % 4 == 1,
            min_bounces: [Some(3), Some(1), None][i % 3],
            roulette_factor: 1 + (i % 4) as u32,
            soft_terminator: i % 5 == 2,
            keeps_direct: i % 2 == 0,
            reuses_paths: false,
        };
        let sampling = Sampling {
            pattern: pattern(i),
            seed: i as u64,
            first_sample: (i % 2) as u32 * 7,
        };
        lit_paths += compare(&lit, settings, sampling, &view(i % 7 == 0, i % 9 == 2));
    }
    assert!(lit_paths > 20_000, "{lit_paths} paths have radiance");
}

/// Most pixels are empty: they get no paths.
#[test]
fn with_a_scene_far_away() {
    let mut random = Random::new(2);
    let mut lit_paths = 0;
    for i in 0..60 {
        let lit = random_scene(&mut random, if i % 2 == 0 { 60 } else { 6 });
        let mut view = view(false, i % 9 == 2);
        view.camera.pos = Vec3::new(0.5, -0.2, 12.0);
        view.camera.f_clip = 16.0;
        view.film = FilmSize { w: 16, h: 12 };
        let sampling = Sampling {
            pattern: pattern(i),
            seed: i as u64,
            first_sample: 0,
        };
        lit_paths += compare(&lit, TO_DEPTH_5, sampling, &view);
    }
    assert!(lit_paths > 2_000, "{lit_paths} paths have radiance");
}

const TO_DEPTH_5: PathSettings = PathSettings {
    light_samples: 1,
    max_depth: 5,
    has_textures: false,
    samples_bsdf: false,
    min_bounces: Some(3),
    roulette_factor: 1,
    soft_terminator: false,
    keeps_direct: false,
    reuses_paths: false,
};

/// Equal random, and still not one normal: interpolated they give a zero of the other sign, and
/// other tangents with it.
#[test]
fn where_normals_differ_in_the_sign_of_a_zero() {
    let mut scene = box_with_a_point_light(vec![]);
    let with_zeros = |n: Vec3, zero: f64| n.map(|c| if c == 0.0 { zero } else { c });
    for t in &mut scene.triangles {
        (t.n0, t.n1, t.n2) = (
            with_zeros(t.n0, -0.0),
            with_zeros(t.n1, 0.0),
            with_zeros(t.n2, -0.0),
        );
    }
    let lit = LitScene::new(scene, None);
    let lit_paths = compare(&lit, TO_DEPTH_5, Sampling::from(1), &view(false, false));
    assert!(lit_paths > 50, "{lit_paths} paths have radiance");
}

/// The hit point of such a sphere rounds to its centre.
#[test]
fn at_spheres_smaller_than_rounding() {
    for radius in [1e-120, 1e-30, 3e-16] {
        let center = Vec3::new(0.2, 0.1, 0.0);
        let lit = LitScene::new(
            box_with_a_point_light(vec![Sphere { center, radius }]),
            None,
        );
        let straight_ahead = View {
            film: FilmSize { w: 1, h: 1 },
            ..view(true, false)
        };
        compare(&lit, TO_DEPTH_5, Sampling::from(2), &straight_ahead);
        let hit = intersect::test_sphere(
            &lit.scene.spheres[0],
            &raygen::generate_ray(&straight_ahead.camera, Vec2::splat(0.5)),
        );
        assert!(hit.is_some(), "the ray misses a radius of {radius}");
    }
}
