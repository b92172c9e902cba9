//! The clock of the end of a submission
//! ([`Launcher::end`](crate::workers::launcher::Launcher::end)).

use std::ops::Add;
use std::sync::Once;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

/// A moment on a clock that stands still while this program, or the machine, is stopped, and that
/// does not jump: code is not to blame for that.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Awake(Duration);

/// How often the clock is advanced.
const TICK: Duration = Duration::from_millis(100);

/// The most that a tick counts. On a busy machine it comes late.
const MOST_OF_TICK: Duration = Duration::from_secs(1);

/// Milliseconds since the clock was first read.
static PASSED: AtomicU64 = AtomicU64::new(0);

impl Awake {
    /// The present moment.
    pub fn now() -> Awake {
        static CLOCK: Once = Once::new();
        CLOCK.call_once(|| {
            std::thread::spawn(|| {
                let mut last = Instant::now();
                loop {
                    std::thread::sleep(TICK);
                    let passed = last.elapsed();
                    last += passed;
                    let counted = counted(passed).as_millis() as u64;
                    PASSED.fetch_add(counted, Ordering::Relaxed);
                }
            });
        });
        Awake(Duration::from_millis(PASSED.load(Ordering::Relaxed)))
    }

    /// The time from `earlier` to this moment; none if that is later.
    pub fn saturating_duration_since(self, earlier: Awake) -> Duration {
        self.0.saturating_sub(earlier.0)
    }
}

impl Add<Duration> for Awake {
    type Output = Awake;

    fn add(self, more: Duration) -> Awake {
        Awake(self.0.saturating_add(more))
    }
}

/// What counts of the time between two ticks.
fn counted(passed: Duration) -> Duration {
    passed.min(MOST_OF_TICK)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_clock_goes_on_and_a_pause_counts_as_one_tick() {
        let start = Awake::now();
        while Awake::now() == start {
            std::thread::sleep(TICK);
        }
        assert!(Awake::now() > start);
        assert_eq!(counted(TICK), TICK);
        assert_eq!(counted(Duration::from_secs(7000)), MOST_OF_TICK);
    }
}
