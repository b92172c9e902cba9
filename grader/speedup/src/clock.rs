//! The time that measurements use.

use std::time::{Duration, Instant};

/// The processor time of this thread where the system reports it, so that other programs on the
/// machine do not count; else the time since `start`.
pub(crate) fn processor_time(start: Instant) -> Duration {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").ok();
    let nanoseconds = text.and_then(|text| text.split_whitespace().next()?.parse().ok());
    nanoseconds.map_or_else(|| start.elapsed(), Duration::from_nanos)
}
