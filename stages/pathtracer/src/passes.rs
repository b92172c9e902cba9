//! Rendering in passes over the whole picture, which is whole whenever it ends.

use crate::progressive::centre_first;
use crate::rendered::RenderedTile;
use crate::{Job, LightSettings, PreparedScene, Rendered};
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

/// The largest number of samples of a pass: a picture that is interrupted is at most this uneven.
const MAX_PASS: u32 = 256;

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
            let job = self.pass(taken, next_pass(taken, end));
            let stop = if taken == 0 { &never } else { stop };
            self.render_tiles(&job, &self.settings, stop, &mut so_far, tile_done);
            taken += job.samples;
            if stop.load(Ordering::Relaxed) {
                return so_far;
            }
            if taken < end {
                continue;
            }
            let has_room = MAX_SAMPLES - first - end >= self.job.samples;
            if is_done(&so_far) || !has_room {
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
        let job = self.pass(0, next_pass(0, self.job.samples));
        self.render_tiles(&job, &plain, &never, &mut preview, &|_| ());
        let mut picture = self.nothing();
        self.render_tiles(&self.job, &self.settings, stop, &mut picture, tile_done);
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

    /// Adds the tiles that are finished before `stop` is set, and updates the film.
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
        picture.update_film();
    }
}

/// The number of samples of the next pass, if `taken` are taken and the round ends after `end`: as
/// many as there are already, within limits. Never leaves a single sample for a last pass.
fn next_pass(taken: u32, end: u32) -> u32 {
    let remaining = end - taken;
    let next = taken.clamp(FIRST_PASS, MAX_PASS).min(remaining);
    if remaining - next == 1 {
        remaining
    } else {
        next
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn passes(end: u32) -> Vec<u32> {
        let mut passes = Vec::new();
        let mut taken = 0;
        while taken < end {
            passes.push(next_pass(taken, end));
            taken += passes.last().expect("it was pushed");
        }
        passes
    }

    #[test]
    fn passes_double_and_never_end_with_one_sample() {
        assert_eq!(passes(1), [1]);
        assert_eq!(passes(3), [3]);
        assert_eq!(passes(5), [2, 3]);
        assert_eq!(passes(64), [2, 2, 4, 8, 16, 32]);
        assert_eq!(passes(1024)[..9], [2, 2, 4, 8, 16, 32, 64, 128, 256]);
        for end in 2..2000 {
            let passes = passes(end);
            assert_eq!(passes.iter().sum::<u32>(), end);
            assert!(
                passes
                    .iter()
                    .all(|&pass| (2..=MAX_PASS + 1).contains(&pass)),
                "{end}"
            );
        }
    }
}
