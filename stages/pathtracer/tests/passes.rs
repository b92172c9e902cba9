//! Rendering in passes: the pixels of one pass, and a whole picture whenever it ends.
// BEGIN SOLUTION(part6.task1)

use kit::FilmSize;
use kit::sampler::{Pattern, Sampling};
use pathtracer::args::Shade;
use pathtracer::{
    AccelKind, Job, LightSettings, Passes, Picture, PreparedScene, Rendered, Textures,
};
use std::path::Path;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

const FILM: FilmSize = FilmSize { w: 40, h: 32 };

fn scene(shade: Shade, kind: AccelKind) -> PreparedScene {
    let path =
        Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes/dae/cornell_mirror_glass.dae");
    let scene = scenes::load(path).expect("a scene").scene;
    PreparedScene::new(Picture::new(shade, scene, None), Textures::default(), kind)
}

fn job(scene: &PreparedScene, samples: u32, pattern: Pattern) -> Job {
    Job {
        camera: scenes::placement::place(scene.scene(), FILM).camera,
        film: FILM,
        cell: FILM.whole(),
        samples,
        sampling: Sampling {
            pattern,
            seed: 3,
            first_sample: 0,
        },
    }
}

fn settings() -> LightSettings {
    LightSettings {
        max_depth: 4,
        lamp_rays: 4,
        ..LightSettings::default()
    }
}

/// All samples of a tile at once.
fn single_pass(scene: &PreparedScene, job: &Job, settings: &LightSettings) -> Rendered {
    let mut rendered = Rendered::black(job.film, scene.picture.is_lit());
    let tiles = job.cell.tiles();
    let (contents, stop) = (
        scene.picture.pixel_contents(job, settings),
        AtomicBool::new(false),
    );
    let tiles = scene.render_tiles(job, settings, &contents, &tiles, &stop, &|tile| tile);
    tiles.iter().for_each(|tile| rendered.add_tile(tile));
    rendered
}

#[test]
fn passes_give_the_pixels_of_one_pass() {
    for (shade, kind) in [
        (Shade::Lit, AccelKind::Simd),
        (Shade::Lit, AccelKind::Bvh),
        (Shade::Normals, AccelKind::Bvh),
    ] {
        let scene = scene(shade, kind);
        for samples in [1, 2, 3, 7, 36] {
            for pattern in [
                Pattern::Independent,
                Pattern::Stratified { samples },
                Pattern::Sobol,
                Pattern::Sobol4,
            ] {
                let job = job(&scene, samples, pattern);
                let passes = Passes {
                    scene: &scene,
                    job,
                    settings: settings(),
                };
                let never = AtomicBool::new(false);
                let picture = passes.render(&never, &|_| (), &mut |_| true);
                let expected = single_pass(&scene, &job, &settings());
                let what = format!("{shade:?} {kind:?} {pattern:?} -s {samples}");
                assert!(picture.film == expected.film, "{what}");
                assert_eq!(picture.counters.rays, expected.counters.rays, "{what}");
                // Packets test what the beams of a batch may hit: other batches, other tests.
                if kind != AccelKind::Simd {
                    assert_eq!(picture.counters, expected.counters, "{what}");
                }
                assert_eq!(picture.effects, expected.effects, "{what}");
            }
        }
    }
}

/// More rounds give the picture of as many samples: the sums of 3 times 12 samples are those of 36.
#[test]
fn rounds_add_up() {
    let scene = scene(Shade::Lit, AccelKind::Simd);
    let passes = |samples| Passes {
        scene: &scene,
        job: job(&scene, samples, Pattern::Sobol),
        settings: settings(),
    };
    let never = AtomicBool::new(false);
    let mut rounds = 0;
    let three = passes(12).render(&never, &|_| (), &mut |so_far| {
        rounds += 1;
        assert_eq!(so_far.film.get(0, 0).samples, 12 * rounds);
        rounds == 3
    });
    let one = passes(36).render(&never, &|_| (), &mut |_| true);
    assert!(three.film == one.film && rounds == 3);
}

/// However early it is stopped, every pixel has samples, and the noise is that of all pixels.
#[test]
fn a_stopped_picture_is_whole() {
    let scene = scene(Shade::Lit, AccelKind::Simd);
    let plain = settings();
    let adaptive = LightSettings {
        adaptive: Some((8, 0.05)),
        ..plain
    };
    for settings in [plain, adaptive] {
        for stop_after in [0, 1, 9] {
            let stop = AtomicBool::new(stop_after == 0);
            let count = AtomicU64::new(0);
            let passes = Passes {
                scene: &scene,
                job: job(&scene, 4096, Pattern::Sobol),
                settings,
            };
            let tile_done = |_| {
                if count.fetch_add(1, Ordering::Relaxed) + 1 >= stop_after {
                    stop.store(true, Ordering::Relaxed);
                }
            };
            let picture = passes.render(&stop, &tile_done, &mut |_| panic!("it was stopped"));
            assert_eq!(picture.rendered_pixels(), FILM.whole().area());
            assert!(picture.samples() < 4096 * FILM.whole().area());
            let noise = picture.relative_error().expect("all pixels have a tally");
            assert!(noise > 0.02, "{noise}");
            assert!(picture.luminance.iter().all(|tally| tally.count() >= 2));
        }
    }
}

/// A part that is stopped has the samples of whole passes: those of a shorter part, bit for bit.
#[test]
fn a_stopped_part_is_a_shorter_part() {
    let scene = scene(Shade::Lit, AccelKind::Bvh);
    let part = |samples| Passes {
        scene: &scene,
        job: job(&scene, samples, Pattern::Sobol),
        settings: settings(),
    };
    for stop_after in [1, 3, 5] {
        let (stop, count) = (AtomicBool::new(false), AtomicU64::new(0));
        let tile_done = |_| {
            if count.fetch_add(1, Ordering::Relaxed) + 1 >= stop_after {
                stop.store(true, Ordering::Relaxed);
            }
        };
        let stopped = part(4096).render_part(&stop, &tile_done);
        let samples = (stopped.samples() / FILM.whole().area()) as u32;
        assert!((2..4096).contains(&samples), "{samples}");
        let shorter = part(samples).render_part(&AtomicBool::new(false), &|_| ());
        assert!(stopped.sums == shorter.sums, "{samples} samples");
    }
}

/// Adaptive sampling: the pixels of one pass, too, though a plain pass precedes them.
#[test]
fn an_adaptive_picture_is_that_of_one_pass() {
    let scene = scene(Shade::Lit, AccelKind::Simd);
    let job = job(&scene, 64, Pattern::Sobol);
    let settings = LightSettings {
        adaptive: Some((8, 0.2)),
        ..settings()
    };
    let passes = Passes {
        scene: &scene,
        job,
        settings,
    };
    let picture = passes.render(&AtomicBool::new(false), &|_| (), &mut |_| true);
    let expected = single_pass(&scene, &job, &settings);
    assert!(picture.film == expected.film);
    assert_eq!(picture.counters, expected.counters);
}
// END SOLUTION(part6.task1)
