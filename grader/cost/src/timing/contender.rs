//! What is timed, and by which clock.

use grader::error::GraderError;
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

/// Why a contender cannot be timed, as the end of the sentence "Your code is not measured: ...".
pub(crate) type MissingReason = String;

/// Something that is timed in turns with others.
///
/// Each timed pass follows an untimed one of the same contender with the same input, so that it
/// finds caches and branch predictors as this contender leaves them, whichever contender was before
/// it.
pub(crate) enum Contender<'a> {
    /// Work in this process. [`Rounds::measure`](super::Rounds::measure) runs both passes.
    Here {
        /// The work.
        work: Box<dyn FnMut() + 'a>,
        /// The number of units in it; the result is the time of one.
        units: usize,
    },
    /// Work in a process of its own, which runs both passes. Returns the seconds of one unit.
    Elsewhere(Box<dyn FnMut() -> Result<Result<f64, MissingReason>, GraderError> + 'a>),
}

impl<'a> Contender<'a> {
    /// Work in this process.
    pub(crate) fn here<T>(units: usize, mut work: impl FnMut() -> T + 'a) -> Contender<'a> {
        Contender::Here {
            work: Box::new(move || {
                std::hint::black_box(work());
            }),
            units,
        }
    }

    /// Work in a process of its own.
    pub(crate) fn elsewhere(
        turn: impl FnMut() -> Result<Result<f64, MissingReason>, GraderError> + 'a,
    ) -> Contender<'a> {
        Contender::Elsewhere(Box::new(turn))
    }
}
