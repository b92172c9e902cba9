//! Rendering in passes over the whole picture, which is whole whenever it ends.

use crate::progressive::centre_first;
use crate::rendered::RenderedTile;
use crate::{Counters, Job, LightSettings, PreparedScene, Rendered};
use kit::film::Cell;
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, Ordering};

/// A picture that is rendered in passes of more and more samples.
///
/// The pixels of a finished picture are those of a single pass, bit for bit: their samples are the
/// same, and are added exactly ([`PixelSum`](crate::PixelSum)).
#[derive(Clone, Copy, Debug)]
pub struct Passes<'a> {
    /// What is rendered.
    pub scene: &'a PreparedScene,
    /// The whole job. Its samples are those of a *round* of passes.
    pub job: Job,
    /// How.
    pub settings: LightSettings,
}

/// A finished tile.
#[derive(Clone, Copy, Debug)]
pub struct TileDone {
    /// Its pixels times their samples; with adaptive sampling times their largest number.
    pub samples: u64,
    /// The rays that were traced for it.
    pub rays: u64,
}

/// The samples of the first pass. A pass of one sample would go through the centres of the pixels.
const FIRST_PASS: u32 = 2;

/// A pass has fewer than twice as many samples: a picture that is interrupted is at most this
/// uneven.
const MAX_PASS: u32 = 256;

/// The rays and tests that a pass should have at least, about those of a few seconds on one core.
/// Each pass has a cost for every pixel, and beams of few samples are wide. Not a time, so that the
/// counts of a picture do not depend on the machine.
const WORTHWHILE: u64 = 1 << 29;

/// The largest number of samples of a pixel: sample numbers have 32 bits.
const MAX_SAMPLES: u32 = 1 << 30;

impl Passes<'_> {
    /// Renders rounds of passes on rayon's current thread pool until `is_done` returns true for the
    /// picture after a round.
    ///
    /// The first pass, of two samples for each pixel, is always completed. After it, the rendering
    /// ends soon after `stop` is set. `tile_done` is called with each tile; it may set `stop`.
    ///
    /// With adaptive sampling, whose tallies cannot be resumed, a pixel gets all its samples at
    /// once, and those that have none when `stop` is set keep the samples of a first plain pass.
    /// There is one round.
    pub fn render(
        &self,
        stop: &AtomicBool,
        tile_done: &(dyn Fn(TileDone) + Sync),
        is_done: &mut dyn FnMut(&Rendered) -> bool,
    ) -> Rendered {
        if self.settings.adaptive.is_some() && self.scene.picture.is_lit() {
            return self.render_adaptive(stop, tile_done);
        }
        let never = AtomicBool::new(false);
        let mut so_far = self.nothing();
        let first = self.job.sampling.first_sample;
        let (mut taken, mut end) = (0, self.job.samples);
        loop {
            let job = self.pass(taken, next_pass(taken, end, &so_far.counters));
            let stop = if taken == 0 { &never } else { stop };
            self.render_tiles(&job, &self.settings, stop, &mut so_far, tile_done);
            taken += job.samples;
            let is_stopped = stop.load(Ordering::Relaxed);
            if taken < end && !is_stopped {
                continue;
            }
            so_far.update_film();
            let has_room = MAX_SAMPLES - first - end >= self.job.samples;
            if is_stopped || is_done(&so_far) || !has_room {
                return so_far;
            }
            end += self.job.samples;
        }
    }

    fn render_adaptive(
        &self,
        stop: &AtomicBool,
        tile_done: &(dyn Fn(TileDone) + Sync),
    ) -> Rendered {
        let never = AtomicBool::new(false);
        let plain = LightSettings {
            adaptive: None,
            ..self.settings
        };
        let mut preview = self.nothing();
        let job = self.pass(0, FIRST_PASS.min(self.job.samples));
        self.render_tiles(&job, &plain, &never, &mut preview, &|_| ());
        preview.update_film();
        let mut picture = self.nothing();
        self.render_tiles(&self.job, &self.settings, stop, &mut picture, tile_done);
        picture.update_film();
        if stop.load(Ordering::Relaxed) {
            picture.fill_from(&preview);
        }
        picture
    }

    fn nothing(&self) -> Rendered {
        Rendered::exact(self.job.film, self.scene.picture.is_lit())
    }

    /// The job of the pass that takes `count` samples after the first `taken`.
    fn pass(&self, taken: u32, count: u32) -> Job {
        let mut job = self.job;
        job.sampling.first_sample += taken;
        job.samples = count;
        job
    }

    /// Adds the tiles that are finished before `stop` is set. Does not update the film.
    fn render_tiles(
        &self,
        job: &Job,
        settings: &LightSettings,
        stop: &AtomicBool,
        picture: &mut Rendered,
        tile_done: &(dyn Fn(TileDone) + Sync),
    ) {
        let tiles: Vec<Cell> = centre_first(job.cell);
        let adding = Mutex::new(&mut *picture);
        let finish = |tile: RenderedTile| {
            // `stop` is never reset: if it is not set now, it was not set during the tile.
            if !stop.load(Ordering::Relaxed) {
                let mut picture = adding.lock().expect("adding a tile does not panic");
                picture.add_tile(&tile);
                drop(picture);
                tile_done(TileDone {
                    samples: tile.cell.area() * u64::from(job.samples),
                    rays: tile.counters.rays,
                });
            }
        };
        self.scene
            .render_tiles(job, settings, &tiles, stop, &finish);
    }
}

/// The number of samples of the next pass, if `taken` are taken, with these `counters`, and the
/// round ends after `end`: as many as there are already, or enough to be worthwhile; all that
/// remain if a last pass would be smaller. Never leaves a single sample for a last pass.
fn next_pass(taken: u32, end: u32, counters: &Counters) -> u32 {
    let remaining = end - taken;
    let work = (counters.rays + counters.box_tests + counters.prim_tests).max(1);
    let worthwhile = u64::from(taken) * WORTHWHILE / work;
    let next = u64::from(taken)
        .max(worthwhile)
        .clamp(u64::from(FIRST_PASS), u64::from(MAX_PASS)) as u32;
    if remaining < 2 * next {
        remaining
    } else {
        next
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The passes of a picture of `end` samples, each of which takes `work` tests.
    fn passes(end: u32, work: u64) -> Vec<u32> {
        let mut passes = Vec::new();
        let mut taken = 0;
        while taken < end {
            let counters = Counters {
                box_tests: u64::from(taken) * work,
                ..Counters::default()
            };
            passes.push(next_pass(taken, end, &counters));
            taken += passes.last().expect("it was pushed");
        }
        passes
    }

    #[test]
    fn passes_double_if_a_sample_is_much_work() {
        assert_eq!(passes(64, WORTHWHILE), [2, 2, 4, 8, 16, 32]);
        assert_eq!(passes(1000, WORTHWHILE)[..8], [2, 2, 4, 8, 16, 32, 64, 128]);
    }

    #[test]
    fn passes_are_few_if_a_sample_is_little_work() {
        assert_eq!(passes(64, WORTHWHILE / 20), [2, 20, 42]);
        assert_eq!(passes(64, WORTHWHILE / 60), [2, 62]);
        assert_eq!(passes(1024, 1), [2, 256, 256, 510]);
    }

    #[test]
    fn no_pass_is_uneven_or_of_one_sample() {
        for work in [0, 1, WORTHWHILE / 20, WORTHWHILE] {
            assert_eq!(passes(1, work), [1]);
            assert_eq!(passes(3, work), [3]);
            for end in 2..2000 {
                let passes = passes(end, work);
                assert_eq!(passes.iter().sum::<u32>(), end);
                assert!(passes.iter().all(|pass| (2..2 * MAX_PASS).contains(pass)));
            }
        }
    }
}
