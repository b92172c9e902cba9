//! Limits how often the student's code may call a function that it is given.
//!
//! The worker keeps a log of such calls. Without a limit, the log of an endless loop would reach
//! the memory limit before the loop reaches the time limit.

/// The largest number of calls of one function in one call of the student's code. The cases need at
/// most some thousands.
pub const MOST_CALLS: u64 = 1_000_000;

/// The payload with which the student's code unwinds when it exceeds [`MOST_CALLS`].
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct CalledTooOften {
    pub(crate) function: &'static str,
    pub(crate) times: u64,
    pub(crate) asked_for: String,
}

/// Ends the case if the running call has called `function` [`MOST_CALLS`] times before. `asked_for`
/// says what the call was asked for, such as `16 samples`.
#[inline]
pub fn limit_calls(
    function: &'static str,
    calls_before: impl TryInto<u64>,
    asked_for: impl FnOnce() -> String,
) {
    let times = calls_before.try_into().unwrap_or(u64::MAX);
    if times >= MOST_CALLS {
        stop(function, times, asked_for());
    }
}

#[cold]
fn stop(function: &'static str, times: u64, asked_for: String) -> ! {
    std::panic::panic_any(CalledTooOften {
        function,
        times,
        asked_for,
    })
}
