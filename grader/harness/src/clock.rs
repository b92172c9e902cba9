//! How long the student's thread has worked, as the processor counts it: on a busy machine it
//! waits, and that is not its fault.

use std::path::PathBuf;
use std::sync::OnceLock;
use std::time::{Duration, Instant};

/// Where Linux keeps the student's thread's times.
static TIMES: OnceLock<PathBuf> = OnceLock::new();

/// Code that neither works nor comes back, because it sleeps or waits, has so many times its limit.
const WAITING: u32 = 8;

/// Says that this thread is the one to be timed.
pub(crate) fn start() {
    if let Ok(thread) = std::fs::read_link("/proc/thread-self") {
        let _ = TIMES.set(PathBuf::from("/proc").join(thread).join("schedstat"));
    }
}

/// Time that one case has taken.
pub(crate) struct Stopwatch {
    worked_before: Duration,
    started: Instant,
}

impl Stopwatch {
    /// Starts now.
    pub(crate) fn start() -> Stopwatch {
        Stopwatch {
            // A thread that has not begun has not worked.
            worked_before: worked().unwrap_or_default(),
            started: Instant::now(),
        }
    }

    /// How much of `limit` is left; `None` if it is used up.
    pub(crate) fn left(&self, limit: Duration) -> Option<Duration> {
        let worked = worked().map(|now| now.saturating_sub(self.worked_before));
        left(limit, self.started.elapsed(), worked)
    }
}

/// What is left of `limit` after so much time on the wall's clock, of which the thread has worked
/// so much. Where the system does not say, it has worked all the time.
fn left(limit: Duration, passed: Duration, worked: Option<Duration>) -> Option<Duration> {
    let left = limit.checked_sub(worked.unwrap_or(passed))?;
    (passed < limit * WAITING && !left.is_zero()).then_some(left)
}

/// What the student's thread has worked since it began, if the system says.
fn worked() -> Option<Duration> {
    let times = std::fs::read_to_string(TIMES.get()?).ok()?;
    let nanoseconds = times.split_whitespace().next()?.parse().ok()?;
    Some(Duration::from_nanos(nanoseconds))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn waiting_for_the_processor_does_not_count() {
        let seconds = Duration::from_secs;
        let of_five = |passed, worked| left(seconds(5), seconds(passed), worked);
        assert_eq!(of_five(30, Some(seconds(2))), Some(seconds(3)));
        assert_eq!(of_five(30, Some(seconds(5))), None);
        assert_eq!(of_five(30, Some(seconds(6))), None);
        assert_eq!(of_five(40, Some(seconds(0))), None, "it only sleeps");
        assert_eq!(of_five(2, None), Some(seconds(3)));
        assert_eq!(of_five(6, None), None);
    }
}
