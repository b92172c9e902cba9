//! Choosing the passes of a [`ProgressiveRender`], so that the picture is whole whenever it ends.

use crate::{Counters, Job, LightSettings, PreparedScene, ProgressiveRender, Rendered, TileDone};
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

/// The samples of the first pass. A pass of one sample would go through the centres of the pixels.
const FIRST_PASS: u32 = 2;

/// A pass has fewer than twice as many samples: a picture that is interrupted is at most this
/// uneven.
const MAX_PASS: u32 = 256;

/// The rays and tests that a pass should have at least, about those of a few seconds on one core.
/// Each pass has a cost for every pixel, and beams of few samples are wide. Not a time, so that the
/// counts of a picture do not depend on the machine.
const WORTHWHILE: u64 = 1 << 29;

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
        self.render_passes(stop, tile_done, is_done, false)
    }

    /// Renders one round for a part of a picture, whose pixels all have the same samples: if `stop`
    /// is set, those of the pass in progress are left out.
    ///
    /// With adaptive sampling, a part that is stopped is as in [`Passes::render`].
    pub fn render_part(
        &self,
        stop: &AtomicBool,
        tile_done: &(dyn Fn(TileDone) + Sync),
    ) -> Rendered {
        self.render_passes(stop, tile_done, &mut |_| true, true)
    }

    fn render_passes(
        &self,
        stop: &AtomicBool,
        tile_done: &(dyn Fn(TileDone) + Sync),
        is_done: &mut dyn FnMut(&Rendered) -> bool,
        whole_passes: bool,
    ) -> Rendered {
        if self.settings.adaptive.is_some() && self.scene.picture.is_lit() {
            return self.render_adaptive(stop, tile_done);
        }
        let never = AtomicBool::new(false);
        let mut end = self.job.samples;
        let first = next_pass(0, end, &Counters::default());
        let mut render = self.of_samples(first, &self.settings);
        loop {
            let is_first = render.passes() == 1;
            let stop = if is_first { &never } else { stop };
            let so_far = render.rendered();
            let before =
                (whole_passes && !is_first).then(|| (so_far.sums.clone(), so_far.removed.clone()));
            render.run_with(self.scene, usize::MAX, stop, tile_done);
            let is_stopped = stop.load(Ordering::Relaxed);
            if let Some(before) = before.filter(|_| !render.is_done()) {
                let rendered = render.rendered_mut();
                (rendered.sums, rendered.removed) = before;
            }
            if render.samples() == end || is_stopped {
                render.rendered_mut().update_film();
                let has_room = render.has_room(self.job.samples);
                if is_stopped || is_done(render.rendered()) || !has_room {
                    return render.into_rendered();
                }
                end += self.job.samples;
            }
            let counters = &render.rendered().counters;
            render.add_pass_of(next_pass(render.samples(), end, counters));
        }
    }

    fn render_adaptive(
        &self,
        stop: &AtomicBool,
        tile_done: &(dyn Fn(TileDone) + Sync),
    ) -> Rendered {
        let plain = LightSettings {
            adaptive: None,
            ..self.settings
        };
        let mut preview = self.of_samples(FIRST_PASS.min(self.job.samples), &plain);
        preview.run(self.scene, usize::MAX, &AtomicBool::new(false));
        preview.rendered_mut().update_film();
        let mut render = self.of_samples(self.job.samples, &self.settings);
        render.run_with(self.scene, usize::MAX, stop, tile_done);
        let mut picture = render.into_rendered();
        picture.update_film();
        if stop.load(Ordering::Relaxed) {
            picture.fill_from(preview.rendered());
        }
        picture
    }

    /// A picture whose first pass has `samples` for each pixel.
    fn of_samples(&self, samples: u32, settings: &LightSettings) -> ProgressiveRender {
        let job = Job {
            samples,
            ..self.job
        };
        ProgressiveRender::exact(self.scene, job, *settings)
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
