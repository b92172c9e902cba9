// BEGIN SOLUTION(part6.task2)
//! Eight paths at a time see what one path at a time sees, bit for bit, with the instructions of every machine.

mod plain;
mod scenes;

use kit::sampler::{Pattern, Sampling};
use kit::{Camera, FilmSize, LitScene, Mat3, PixelSampler, Vec3};
use plain::{Plain, radiance};
use scenes::{Numbers, random_scene};
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
fn view(centered: bool) -> View {
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
        centered,
    }
}

fn starts(sampling: Sampling, samples: u32, centered: bool) -> Vec<Start> {
    let pixels = (0..6).flat_map(|y| (0..8).map(move |x| (x, y)));
    let of = |(x, y)| {
        let mut sampler = PixelSampler::new(x, y, sampling);
        (0..samples).map(move |_| {
            if !centered {
                sampler.start_sample();
            }
            ((x, y), sampler.clone())
        })
    };
    pixels.flat_map(of).collect()
}

/// Follows paths through `lit` both ways; how many of them saw light.
fn compare(lit: &LitScene, settings: PathSettings, sampling: Sampling, centered: bool) -> usize {
    let starts = starts(sampling, if centered { 1 } else { 5 }, centered);
    let view = view(centered);
    let mut plain = Plain::new(lit, settings);
    let wanted: Vec<[u64; 3]> = starts
        .iter()
        .map(|start| {
            radiance(&mut plain, &view, start)
                .to_array()
                .map(f64::to_bits)
        })
        .collect();
    let mut counts = Vec::new();
    for level in levels() {
        let scene = PathScene::new(lit, |id| plain::geometric_normal(lit, id));
        let scene = scene.expect("an ordinary scene").at_level(level);
        let mut others = Plain::new(lit, settings);
        let mut work = PathBatch::default();
        let seen = scene.follow(&view, &settings, &starts, &mut work, &mut others);
        for (i, (seen, wanted)) in seen.iter().zip(&wanted).enumerate() {
            let bits = seen.to_array().map(f64::to_bits);
            assert_eq!(bits, *wanted, "{level:?}, path {i}: {seen:?}\n{lit:#?}");
        }
        let rays = work.counts.rays + others.rays;
        assert_eq!(rays, plain.rays, "{level:?}: as many rays");
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
            first_game: [Some(3), Some(1), None][i % 3],
        };
        let sampling = Sampling {
            pattern: pattern(i),
            seed: i as u64,
            first_sample: (i % 2) as u32 * 7,
        };
        lit_paths += compare(&lit, settings, sampling, i % 7 == 0);
    }
    assert!(lit_paths > 20_000, "{lit_paths} paths saw light");
}
// END SOLUTION(part6.task2)
