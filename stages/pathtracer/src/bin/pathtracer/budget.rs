//! Rendering in passes, until a time limit or a noise target is reached (`--time`, `--error`).

use pathtracer::Rendered;
use pathtracer::args::Args;
use std::time::Duration;

/// Samples of a pass if `-s` is 1: a single sample would always go through the pixel's centre.
pub(crate) const SAMPLES_PER_PASS: u32 = 16;

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

    /// Whether the time is up.
    pub(crate) fn is_late(&self, time: Duration) -> bool {
        self.time.is_some_and(|limit| time >= limit)
    }

    /// Whether the picture is finished `time` after the start.
    pub(crate) fn is_spent(&self, so_far: &Rendered, time: Duration) -> bool {
        self.is_late(time)
            || self.error.is_some_and(|target| {
                let is_black = so_far.luminance.iter().all(|pixel| pixel.mean() == 0.0);
                let samples = so_far.luminance.iter().map(|pixel| pixel.count());
                let is_reliable = !is_black || samples.max() >= Some(MIN_SAMPLES_IF_BLACK);
                is_reliable && so_far.relative_error().is_some_and(|error| error <= target)
            })
    }
}
