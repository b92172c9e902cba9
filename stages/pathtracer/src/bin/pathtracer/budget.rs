//! Rendering for as long as it is worth it: rounds of samples until the time is up or the noise is low enough.

use crate::args::Args;
use pathtracer::{Job, Rendered};
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

/// Samples of a round if `-s` does not say more than one: a single one would be through the pixel's centre every time.
pub(crate) const SAMPLES_OF_A_ROUND: u32 = 16;

/// Samples of a pixel after which no budget goes on: their numbers have 32 bits.
const MOST_SAMPLES: u32 = 1 << 30;

/// Samples after which a black picture is taken to be black, and not to have missed its light so far.
const BLACK_IS_BLACK: u64 = 4096;

/// When to stop.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Budget {
    time: Option<Duration>,
    error: Option<f64>,
}

impl Budget {
    /// What `--time` and `--error` say; `None` without both.
    pub(crate) fn of(args: &Args) -> Option<Budget> {
        let budget = Budget {
            // Beyond what a duration can hold nobody waits.
            time: args
                .time
                .map(|s| Duration::try_from_secs_f64(s).unwrap_or(Duration::MAX)),
            error: args.error,
        };
        (budget.time.is_some() || budget.error.is_some()).then_some(budget)
    }

    /// Renders rounds of `job`, each with samples of its own, until the budget is spent or `stop` is set. There is one round
    /// at least. The last round may take half of its time beyond the budget, or end as much before.
    pub(crate) fn spend(
        &self,
        job: &Job,
        stop: &AtomicBool,
        mut round: impl FnMut(&Job) -> Rendered,
    ) -> Rendered {
        let start = Instant::now();
        let mut job = *job;
        let mut all = round(&job);
        let mut last = start.elapsed();
        while !stop.load(Ordering::Relaxed) && !self.is_spent(&all, start.elapsed() + last / 2) {
            job.sampling.first_sample += job.samples;
            if job.sampling.first_sample >= MOST_SAMPLES {
                break;
            }
            let before = Instant::now();
            all.add(&round(&job));
            last = before.elapsed();
        }
        all
    }

    fn is_spent(&self, so_far: &Rendered, time: Duration) -> bool {
        self.time.is_some_and(|most| time >= most)
            || self.error.is_some_and(|target| {
                let is_black = so_far.luminance.iter().all(|pixel| pixel.mean() == 0.0);
                let samples = so_far.luminance.iter().map(|pixel| pixel.count());
                let known = !is_black || samples.max() >= Some(BLACK_IS_BLACK);
                known && so_far.relative_error().is_some_and(|error| error <= target)
            })
    }
}
