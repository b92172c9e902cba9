//! Measures the processor time of the student's thread. Neither waiting for a processor on a busy
//! machine nor printing counts.

use crate::usage::text;
use std::fs::File;
use std::path::Path;
use std::sync::{Mutex, OnceLock};
use std::time::{Duration, Instant};

/// The files in which Linux shows the time and the output of a thread. They are opened before the
/// student's code runs, and in a sandbox nothing else can be opened there.
struct ThreadFiles {
    schedstat: Option<File>,
    io: Option<File>,
}

impl ThreadFiles {
    /// The files of the current thread.
    fn open() -> ThreadFiles {
        let open = |name| File::open(Path::new("/proc/thread-self").join(name)).ok();
        ThreadFiles {
            schedstat: open("schedstat"),
            io: open("io"),
        }
    }

    /// The times of the thread since its start, if the system reports them.
    fn times(&mut self) -> Option<ThreadTimes> {
        ThreadTimes::parse(&text(self.schedstat.as_mut()?)?)
    }
}

/// What a thread did with its time.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
struct ThreadTimes {
    /// It ran.
    worked: Duration,
    /// It could have run, but no processor was free.
    queued: Duration,
}

impl ThreadTimes {
    /// Reads the text of a file `schedstat`: its first two numbers, in nanoseconds.
    fn parse(schedstat: &str) -> Option<ThreadTimes> {
        let mut numbers = schedstat.split_whitespace();
        let mut next = || Some(Duration::from_nanos(numbers.next()?.parse().ok()?));
        Some(ThreadTimes {
            worked: next()?,
            queued: next()?,
        })
    }

    /// The times since `before`.
    fn since(self, before: ThreadTimes) -> ThreadTimes {
        ThreadTimes {
            worked: self.worked.saturating_sub(before.worked),
            queued: self.queued.saturating_sub(before.queued),
        }
    }
}

/// The files of the student's thread.
static STUDENT: OnceLock<Mutex<ThreadFiles>> = OnceLock::new();

/// A generous estimate of the time that formatting and writing takes: for each write to the system
/// (`println!` makes one for each line, `eprintln!` one for each piece of it). Measured: 0.6 µs for
/// a line with two numbers, 1.5 µs for one with eight, and several times that on a busy machine,
/// where each write also wakes the reader.
const TIME_OF_WRITE: Duration = Duration::from_micros(10);

/// The same for each byte that is written.
const TIME_OF_BYTE: Duration = Duration::from_nanos(25);

/// Code that sleeps or waits may take this many times its limit in elapsed time, not counting the
/// time in which a busy machine has no processor for it.
const WAITING: u32 = 8;

/// Code that has printed may wait for so much longer: on a busy machine whoever reads what it
/// prints may come late, and a full pipe makes it wait.
const WAITING_FOR_READER: Duration = Duration::from_secs(30);

/// How code used up its time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum TimeUp {
    /// It computed for longer than its limit.
    Computing,
    /// It slept or waited.
    Waiting,
}

/// Makes the current thread the one whose time is measured.
pub(crate) fn start() {
    let _ = STUDENT.set(Mutex::new(ThreadFiles::open()));
}

/// The processor time of the student's code: in a worker, that of all threads of the process, those
/// that have ended, too; elsewhere, where other threads run other code, that of this thread. Where
/// the system does not report it, the elapsed time. Only differences have a meaning.
pub fn code_time() -> Duration {
    time(STUDENT.get().is_some())
}

/// The processor time of all threads of this process, or of this thread.
fn time(of_all_threads: bool) -> Duration {
    #[cfg(unix)]
    {
        use rustix::time::{ClockId, clock_gettime};
        let time = clock_gettime(match of_all_threads {
            true => ClockId::ProcessCPUTime,
            false => ClockId::ThreadCPUTime,
        });
        Duration::new(time.tv_sec.unsigned_abs(), time.tv_nsec as u32)
    }
    #[cfg(not(unix))]
    {
        let _ = of_all_threads;
        static START: OnceLock<Instant> = OnceLock::new();
        START.get_or_init(Instant::now).elapsed()
    }
}

/// Measures the time of one case.
pub(crate) struct Stopwatch {
    times_before: ThreadTimes,
    output_before: Output,
    started: Instant,
}

impl Stopwatch {
    /// Starts a stopwatch.
    pub(crate) fn start() -> Stopwatch {
        Stopwatch {
            // A thread that has not started has used no time.
            times_before: times().unwrap_or_default(),
            output_before: Output::of_student(),
            started: Instant::now(),
        }
    }

    /// How much of `limit` is left.
    pub(crate) fn left(&self, limit: Duration) -> Result<Duration, TimeUp> {
        let times = times().map(|now| now.since(self.times_before));
        let queued = times.unwrap_or_default().queued;
        let output = Output::of_student().since(self.output_before);
        let printing = output.time();
        let to_wait = match output.writes {
            0 => limit * WAITING,
            _ => limit * WAITING + WAITING_FOR_READER,
        };
        left(
            limit,
            to_wait,
            self.started.elapsed().saturating_sub(printing + queued),
            times.map(|times| times.worked.saturating_sub(printing)),
        )
    }
}

/// What a thread has written to files and pipes: mostly what it printed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Output {
    /// The number of writes to the system.
    pub(crate) writes: u64,
    pub(crate) bytes: u64,
}

impl Output {
    /// The output of the student's thread since its start; none where the system does not report
    /// it.
    pub(crate) fn of_student() -> Output {
        let io = STUDENT.get().and_then(|files| files.lock().ok());
        let io = io.and_then(|mut files| text(files.io.as_mut()?));
        io.as_deref().map(Output::parse).unwrap_or_default()
    }

    /// Reads the text of a file `io`, which has a line for each count.
    fn parse(io: &str) -> Output {
        let count = |name: &str| {
            let mut lines = io.lines();
            let count = lines.find_map(|line| line.strip_prefix(name)?.strip_prefix(": "));
            count.and_then(|count| count.parse().ok()).unwrap_or(0)
        };
        Output {
            writes: count("syscw"),
            bytes: count("wchar"),
        }
    }

    /// The output since `before`.
    pub(crate) fn since(self, before: Output) -> Output {
        Output {
            writes: self.writes.saturating_sub(before.writes),
            bytes: self.bytes.saturating_sub(before.bytes),
        }
    }

    /// The time that printing it takes at most.
    fn time(self) -> Duration {
        let times = |count: u64, each: Duration| {
            Duration::from_nanos(count.saturating_mul(each.as_nanos() as u64))
        };
        times(self.writes, TIME_OF_WRITE).saturating_add(times(self.bytes, TIME_OF_BYTE))
    }
}

/// The rest of `limit` after `worked` processor time and `passed` elapsed time in which the thread
/// had a processor or waited for something else, `to_wait` at most. Where the system does not
/// report processor time, elapsed time counts.
fn left(
    limit: Duration,
    to_wait: Duration,
    passed: Duration,
    worked: Option<Duration>,
) -> Result<Duration, TimeUp> {
    let left = limit.saturating_sub(worked.unwrap_or(passed));
    if left.is_zero() {
        Err(TimeUp::Computing)
    } else if passed >= to_wait {
        Err(TimeUp::Waiting)
    } else {
        Ok(left)
    }
}

/// The times of the student's thread since its start, if the system reports them.
fn times() -> Option<ThreadTimes> {
    STUDENT.get()?.lock().ok()?.times()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn schedstat_has_the_time_of_running_and_of_waiting_for_a_processor() {
        let times = ThreadTimes {
            worked: Duration::from_nanos(11_223_344),
            queued: Duration::from_nanos(556_677),
        };
        assert_eq!(ThreadTimes::parse("11223344 556677 89\n"), Some(times));
        assert_eq!(ThreadTimes::parse("11223344"), None);
    }

    #[test]
    fn the_output_of_a_thread_is_counted() {
        let io = "rchar: 77\nwchar: 2000\nsyscr: 14\nsyscw: 100\nwrite_bytes: 9\n";
        let output = Output::parse(io);
        assert_eq!(
            output,
            Output {
                writes: 100,
                bytes: 2000
            }
        );
        assert_eq!(output.time(), Duration::from_micros(1050));
        assert_eq!(Output::parse(""), Output::default());
    }

    #[test]
    fn work_on_another_thread_counts() {
        let before = time(true);
        let work = || {
            let started = time(true);
            while time(true) < started + Duration::from_millis(20) {
                std::hint::black_box(0);
            }
        };
        std::thread::spawn(work).join().unwrap();
        assert!(time(true) - before >= Duration::from_millis(20));
    }

    #[test]
    fn waiting_for_the_processor_does_not_count() {
        let seconds = Duration::from_secs;
        let of_five = |passed, worked: Option<u64>| {
            left(
                seconds(5),
                seconds(40),
                seconds(passed),
                worked.map(seconds),
            )
        };
        assert_eq!(of_five(30, Some(2)), Ok(seconds(3)));
        assert_eq!(of_five(30, Some(5)), Err(TimeUp::Computing));
        assert_eq!(of_five(30, Some(6)), Err(TimeUp::Computing));
        // It sleeps beyond 8 limits.
        assert_eq!(of_five(40, Some(0)), Err(TimeUp::Waiting));
        assert_eq!(of_five(2, None), Ok(seconds(3)));
        assert_eq!(of_five(6, None), Err(TimeUp::Computing));
    }
}
