//! Measures the processor time of the student's thread. Waiting for a processor on a busy machine
//! does not count.

use std::path::PathBuf;
use std::sync::OnceLock;
use std::time::{Duration, Instant};

/// The file in which Linux shows the times of the student's thread.
static TIMES: OnceLock<PathBuf> = OnceLock::new();

/// Code that sleeps or waits may take this many times its limit in elapsed time.
const WAITING: u32 = 8;

/// Makes the current thread the one whose time is measured.
pub(crate) fn start() {
    if let Ok(thread) = std::fs::read_link("/proc/thread-self") {
        let _ = TIMES.set(PathBuf::from("/proc").join(thread).join("schedstat"));
    }
}

/// The processor time of the current thread since some moment; where the system does not report it,
/// the elapsed time. Only differences have a meaning.
pub fn thread_time() -> Duration {
    static START: OnceLock<Instant> = OnceLock::new();
    // The system updates the time of a thread when it gives up the processor.
    std::thread::yield_now();
    let times = std::fs::read_to_string("/proc/thread-self/schedstat").ok();
    times
        .and_then(|times| nanoseconds(&times))
        .unwrap_or_else(|| START.get_or_init(Instant::now).elapsed())
}

/// Measures the time of one case.
pub(crate) struct Stopwatch {
    worked_before: Duration,
    started: Instant,
}

impl Stopwatch {
    /// Starts a stopwatch.
    pub(crate) fn start() -> Stopwatch {
        Stopwatch {
            // A thread that has not started has used no processor time.
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

/// The rest of `limit` after `passed` elapsed time and `worked` processor time; `None` if it is
/// used up. Where the system does not report processor time, elapsed time counts.
fn left(limit: Duration, passed: Duration, worked: Option<Duration>) -> Option<Duration> {
    let left = limit.checked_sub(worked.unwrap_or(passed))?;
    (passed < limit * WAITING && !left.is_zero()).then_some(left)
}

/// The processor time of the student's thread since its start, if the system reports it.
fn worked() -> Option<Duration> {
    nanoseconds(&std::fs::read_to_string(TIMES.get()?).ok()?)
}

/// The processor time in the text of a file `schedstat`: its first number.
fn nanoseconds(times: &str) -> Option<Duration> {
    let nanoseconds = times.split_whitespace().next()?.parse().ok()?;
    Some(Duration::from_nanos(nanoseconds))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_number_of_schedstat_is_the_processor_time() {
        let times = "11223344 556677 89\n";
        assert_eq!(nanoseconds(times), Some(Duration::from_nanos(11_223_344)));
        assert_eq!(nanoseconds(""), None);
    }

    #[test]
    fn the_time_of_a_thread_does_not_decrease() {
        let before = thread_time();
        assert!(before <= thread_time());
    }

    #[test]
    fn waiting_for_the_processor_does_not_count() {
        let seconds = Duration::from_secs;
        let of_five = |passed, worked| left(seconds(5), seconds(passed), worked);
        assert_eq!(of_five(30, Some(seconds(2))), Some(seconds(3)));
        assert_eq!(of_five(30, Some(seconds(5))), None);
        assert_eq!(of_five(30, Some(seconds(6))), None);
        assert_eq!(
            of_five(40, Some(seconds(0))),
            None,
            "it sleeps beyond 8 limits"
        );
        assert_eq!(of_five(2, None), Some(seconds(3)));
        assert_eq!(of_five(6, None), None);
    }
}
