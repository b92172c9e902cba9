// BEGIN SOLUTION(part6.task2)
//! Eight paths at a time see what one path at a time sees, bit for bit, with the instructions of every machine.

mod plain;
mod scenes;

use kit::sampler::{Pattern, Sampling};
use kit::{Camera, FilmSize, LitScene, Mat3, PixelSampler, Sphere, Vec2, Vec3};
use plain::{Plain, radiance};
use scenes::{Numbers, box_with_a_lamp, random_scene};
use simd_paths::{Counts, Level, PathBatch, PathScene, PathSettings, Start, View};

/// The instruction sets of this machine.
fn levels() -> Vec<Level> {
    let mut levels = vec![Level::new(), Level::baseline()];
    #[cfg(target_arch = "x86_64")]
    {
        levels.extend(Level::new().as_avx2().map(Level::Avx2));
        levels.extend(Level::new().as_sse4_2().map(Level::Sse4_2));
    }
    levels
}

/// A camera in the middle of things.
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

fn starts(sampling: Sampling, samples: u32, view: &View) -> Vec<Start> {
    let pixels = view.film.whole().pixels();
    let of = |(x, y)| {
        let mut sampler = PixelSampler::new(x, y, sampling);
        (0..samples).map(move |_| {
            if !view.centered {
                sampler.start_sample();
            }
            ((x, y), sampler.clone())
        })
    };
    pixels.flat_map(of).collect()
}

/// Follows paths through `lit` both ways; how many of them saw light.
fn compare(lit: &LitScene, settings: PathSettings, sampling: Sampling, view: &View) -> usize {
    let samples = if view.centered { 1 } else { 5 };
    let starts = starts(sampling, samples, view);
    let plain = Plain::new(lit, settings);
    let wanted: Vec<[u64; 3]> = starts
        .iter()
        .map(|start| radiance(&plain, view, start).to_array().map(f64::to_bits))
        .collect();
    let mut counts = Vec::new();
    for level in levels() {
        let scene = PathScene::new(lit).expect("a scene").at_level(level);
        let mut others = Plain::new(lit, settings);
        let mut work = PathBatch::default();
        let seen = scene.follow(view, &settings, &starts, &mut work, &mut others);
        for (i, (seen, wanted)) in seen.iter().zip(&wanted).enumerate() {
            let bits = seen.to_array().map(f64::to_bits);
            assert_eq!(bits, *wanted, "{level:?}, path {i}: {seen:?}\n{lit:#?}");
        }
        let (mine, theirs) = (work.counts, others.counts.get());
        let all = Counts {
            rays: mine.rays + theirs.rays,
            light_rays: mine.light_rays + theirs.light_rays,
            background: mine.background + theirs.background,
            bounces: mine.bounces + theirs.bounces,
            prim_tests: 0,
        };
        assert_eq!(all, plain.counts.get(), "{level:?}: as much of everything");
        counts.push(work.counts);
    }
    let first: Counts = counts[0];
    assert!(counts.iter().all(|c| *c == first), "{counts:?}");
    wanted.iter().filter(|bits| **bits != [0; 3]).count()
}

fn pattern(i: usize) -> Pattern {
    [
        Pattern::Sobol,
        Pattern::Independent,
        Pattern::Stratified { samples: 5 },
        Pattern::Sobol,
    ][i % 4]
}

#[test]
fn in_rooms_and_beyond_with_every_material_and_light() {
    let mut numbers = Numbers::new(1);
    let mut lit_paths = 0;
    for i in 0..400 {
        let lit = random_scene(&mut numbers, if i % 5 == 0 { 60 } else { 28 });
        let settings = PathSettings {
            light_samples: (i % 3) as u32,
            max_depth: 1 + (i % 6) as u32,
            has_textures: i % 8 == 3,
            first_game: [Some(3), Some(1), None][i % 3],
        };
        let sampling = Sampling {
            pattern: pattern(i),
            seed: i as u64,
            first_sample: (i % 2) as u32 * 7,
        };
        lit_paths += compare(&lit, settings, sampling, &view(i % 7 == 0, i % 9 == 2));
    }
    assert!(lit_paths > 20_000, "{lit_paths} paths saw light");
}

const TO_DEPTH_5: PathSettings = PathSettings {
    light_samples: 1,
    max_depth: 5,
    has_textures: false,
    first_game: Some(3),
};

/// Equal numbers, and still not one normal: interpolated they give a zero of the other sign, and other tangents with it.
#[test]
fn where_normals_differ_in_the_sign_of_a_zero() {
    let mut scene = box_with_a_lamp(vec![]);
    let with_zeros = |n: Vec3, zero: f64| n.map(|c| if c == 0.0 { zero } else { c });
    for t in &mut scene.triangles {
        (t.n0, t.n1, t.n2) = (
            with_zeros(t.n0, -0.0),
            with_zeros(t.n1, 0.0),
            with_zeros(t.n2, -0.0),
        );
    }
    let lit = LitScene::new(scene, None);
    let seen = compare(&lit, TO_DEPTH_5, Sampling::from(1), &view(false, false));
    assert!(seen > 50, "{seen} paths saw light");
}

/// Where such a sphere is hit is its centre, as far as rounding can tell.
#[test]
fn at_spheres_smaller_than_rounding() {
    for radius in [1e-120, 1e-30, 3e-16] {
        let center = Vec3::new(0.2, 0.1, 0.0);
        let lit = LitScene::new(box_with_a_lamp(vec![Sphere { center, radius }]), None);
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
// END SOLUTION(part6.task2)
