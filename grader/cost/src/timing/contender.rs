//! What is timed, and by which clock.

use base::GraderError;
use std::time::Instant;

/// Reads the time. Tests simulate it.
pub(crate) trait Clock {
    /// Returns the seconds since a fixed moment.
    fn seconds(&self) -> f64;
}

/// The clock of the machine.
pub(crate) struct SystemClock(Instant);

impl SystemClock {
    pub(crate) fn start() -> SystemClock {
        SystemClock(Instant::now())
    }
}

impl Clock for SystemClock {
    fn seconds(&self) -> f64 {
        self.0.elapsed().as_secs_f64()
    }
}

/// Why code is not measured, as the end of the sentence "Your code is not measured: ...".
pub type MissingReason = String;

/// Why there is no measurement.
#[derive(Debug)]
pub enum NotMeasured {
    /// The code is missing, or fails: the others are measured.
    Missing(MissingReason),
    /// The grader fails, and nothing more is measured.
    Failed(GraderError),
}

/// What is measured of code that may be missing.
pub type Measured<T> = Result<T, NotMeasured>;

impl From<GraderError> for NotMeasured {
    fn from(error: GraderError) -> NotMeasured {
        NotMeasured::Failed(error)
    }
}

/// A measurement, or what the report says of missing code.
///
/// # Errors
///
/// The grader's own.
pub(crate) fn or_missing<T>(
    measured: Measured<T>,
) -> Result<Result<T, MissingReason>, GraderError> {
    match measured {
        Ok(value) => Ok(Ok(value)),
        Err(NotMeasured::Missing(why)) => Ok(Err(why)),
        Err(NotMeasured::Failed(error)) => Err(error),
    }
}

/// Code that is missing for this reason.
pub(crate) fn missing<T>(why: impl Into<MissingReason>) -> Measured<T> {
    Err(NotMeasured::Missing(why.into()))
}

/// The number of timed passes in a turn. Their median is not affected by one or two interruptions
/// by other programs.
pub(crate) const TIMED_PASSES: usize = 5;

/// Something that is timed in turns with others.
///
/// In its turn a contender does its work in several passes with the same input. The first pass is
/// not timed: the others then find the caches as this contender leaves them, whichever contender
/// was before it. The time of the turn is the median of the timed passes. The work gets the number
/// of the round: the input may depend on it, in the same way for all contenders.
pub(crate) enum Contender<'a> {
    /// Work in this process. [`Rounds::measure`](super::Rounds::measure) runs the passes.
    Here {
        /// The work.
        work: Box<dyn FnMut(usize) + 'a>,
        /// The number of units in it; the result is the time of one.
        units: usize,
    },
    /// Work in a process of its own, which runs an untimed pass and [`TIMED_PASSES`] others.
    /// Returns the median seconds of one unit.
    Elsewhere(Box<dyn FnMut(usize) -> Measured<f64> + 'a>),
}

impl<'a> Contender<'a> {
    /// Work in this process.
    pub(crate) fn here<T>(units: usize, mut work: impl FnMut(usize) -> T + 'a) -> Contender<'a> {
        Contender::Here {
            work: Box::new(move |round| {
                std::hint::black_box(work(round));
            }),
            units,
        }
    }

    /// Work in a process of its own.
    pub(crate) fn elsewhere(turn: impl FnMut(usize) -> Measured<f64> + 'a) -> Contender<'a> {
        Contender::Elsewhere(Box::new(turn))
    }
}
