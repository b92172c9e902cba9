//! Rendering in passes, until a time limit or a noise target is reached (`--time`, `--error`).

use pathtracer::args::Args;
use pathtracer::{Job, Rendered};
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

/// Samples of a pass if `-s` is 1: a single sample would always go through the pixel's centre.
pub(crate) const SAMPLES_PER_PASS: u32 = 16;

/// The largest number of samples of a pixel: sample numbers have 32 bits.
const MAX_SAMPLES: u32 = 1 << 30;

/// Samples of a pixel after which a black picture is accepted: with fewer it may have missed the
/// light.
const MIN_SAMPLES_IF_BLACK: u64 = 4096;

/// When to stop.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Budget {
    time: Option<Duration>,
    error: Option<f64>,
}

impl Budget {
    /// The limits of `--time` and `--error`; `None` without both.
    pub(crate) fn new(args: &Args) -> Option<Budget> {
        let budget = Budget {
            // A time too long for a `Duration` is no limit.
            time: args
                .time
                .map(|s| Duration::try_from_secs_f64(s).unwrap_or(Duration::MAX)),
            error: args.error,
        };
        (budget.time.is_some() || budget.error.is_some()).then_some(budget)
    }

    /// Calls `pass` for passes of `job` with different samples until the budget is spent or `stop`
    /// is set, at least once. The total time may differ from the limit by half the time of a pass.
    pub(crate) fn render(
        &self,
        job: &Job,
        stop: &AtomicBool,
        mut pass: impl FnMut(&Job) -> Rendered,
    ) -> Rendered {
        let start = Instant::now();
        let mut job = *job;
        let mut result = pass(&job);
        let mut last = start.elapsed();
        while !stop.load(Ordering::Relaxed) && !self.is_spent(&result, start.elapsed() + last / 2) {
            job.sampling.first_sample += job.samples;
            if job.sampling.first_sample >= MAX_SAMPLES {
                break;
            }
            let before = Instant::now();
            result.add(&pass(&job));
            last = before.elapsed();
        }
        result
    }

    fn is_spent(&self, so_far: &Rendered, time: Duration) -> bool {
        self.time.is_some_and(|limit| time >= limit)
            || self.error.is_some_and(|target| {
                let is_black = so_far.luminance.iter().all(|pixel| pixel.mean() == 0.0);
                let samples = so_far.luminance.iter().map(|pixel| pixel.count());
                let is_reliable = !is_black || samples.max() >= Some(MIN_SAMPLES_IF_BLACK);
                is_reliable && so_far.relative_error().is_some_and(|error| error <= target)
            })
    }
}
