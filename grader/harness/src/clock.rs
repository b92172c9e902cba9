//! Measures what the student's code takes: the processor time of all its threads, and the time in
//! which it waits. Neither waiting for a processor on a busy machine nor printing counts.
//!
//! No time decides alone: limits grow with the time of a [`Control`] beside the code.

use crate::control::{Control, Rounds};
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
}

/// Reads the text of a file `schedstat`: its second number is the time, in nanoseconds, in which the
/// thread could have run and no processor was free.
fn queued(schedstat: &str) -> Option<Duration> {
    let number = schedstat.split_whitespace().nth(1)?;
    Some(Duration::from_nanos(number.parse().ok()?))
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

/// And so much longer for each write. Measured at a load of 12 on two processors: 19 µs for a
/// line of `println!`.
const WAITING_FOR_WRITE: Duration = Duration::from_micros(40);

/// The most that [`WAITING_FOR_WRITE`] adds up to in a case: code that prints and sleeps has an
/// end.
const MOST_WAITING_FOR_WRITES: Duration = Duration::from_secs(240);

/// Between two looks at a case no more than this counts as waiting: a machine that was stopped for
/// longer, or had no processor for whoever looks, is not the code's fault.
const LONGEST_LOOK: Duration = Duration::from_millis(20);

/// How often the control is timed while a case runs.
const BETWEEN_ROUNDS: Duration = Duration::from_millis(50);

/// How many rounds it takes to say that the time is over.
const MIN_ROUNDS: u32 = 5;

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

/// The processor time of this thread.
pub(crate) fn time_of_this_thread() -> Duration {
    time(false)
}

/// The processor time of all threads of this process, or of this thread.
///
/// Once a process has a limit of processor time, as in a sandbox, Linux reads the time of all
/// threads from a sum that it renews at ticks, at ends of threads and when a thread's own time is
/// read. So the own time comes first, without which a few milliseconds of work take none.
fn time(of_all_threads: bool) -> Duration {
    #[cfg(unix)]
    {
        use rustix::time::{ClockId, clock_gettime};
        let own = clock_gettime(ClockId::ThreadCPUTime);
        let time = match of_all_threads {
            true => clock_gettime(ClockId::ProcessCPUTime),
            false => own,
        };
        Duration::new(time.tv_sec.unsigned_abs(), time.tv_nsec as u32)
    }
    #[cfg(not(unix))]
    {
        let _ = of_all_threads;
        static START: OnceLock<Instant> = OnceLock::new();
        START.get_or_init(Instant::now).elapsed()
    }
}

/// What the code of a case has taken so far.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
struct Taken {
    /// Processor time of all threads but this one, which watches.
    worked: Duration,
    /// Elapsed time, counted at each look.
    passed: Duration,
    /// Of it, the student's thread could have run, but no processor was free.
    queued: Duration,
    output: Output,
}

impl Taken {
    /// The processor time, without what printing takes.
    fn computed(self) -> Duration {
        self.worked.saturating_sub(self.output.time())
    }

    /// The time in which no thread of the code worked and its own did not wait for a processor.
    fn waited(self) -> Duration {
        self.passed.saturating_sub(self.worked + self.queued)
    }

    /// What counts for the limit of a task's cases together. Of the time in which writes may have
    /// waited only half counts: the reader may have been late, or the code may have slept.
    fn spent(self) -> Duration {
        let waited = self.waited();
        self.computed() + waited - waited.min(self.output.waiting()) / 2
    }

    /// The rest of `limit` on a machine that is so many times slower than the one whose seconds the
    /// limit is.
    fn left(self, limit: Duration, slowness: f64) -> Result<Duration, TimeUp> {
        let to_wait = match self.output.writes {
            0 => limit * WAITING,
            _ => limit * WAITING + WAITING_FOR_READER + self.output.waiting(),
        };
        let left = limit.mul_f64(slowness).saturating_sub(self.computed());
        if left.is_zero() {
            Err(TimeUp::Computing)
        } else if self.waited() >= to_wait.mul_f64(slowness) {
            Err(TimeUp::Waiting)
        } else {
            Ok(left)
        }
    }
}

/// Measures the time of one case.
pub(crate) struct Stopwatch {
    worked_before: Duration,
    queued_before: Duration,
    output_before: Output,
    last_look: Instant,
    last_round: Instant,
    taken: Taken,
    rounds: Rounds,
}

impl Stopwatch {
    /// Starts a stopwatch for code before which `marker` will be printed.
    pub(crate) fn start(marker: &str) -> Stopwatch {
        let now = Instant::now();
        Stopwatch {
            worked_before: time_of_others(),
            // A thread that has not started has used no time.
            queued_before: queued_so_far().unwrap_or_default(),
            output_before: Output::of_student().and(marker),
            last_look: now,
            last_round: now,
            taken: Taken::default(),
            rounds: Rounds::default(),
        }
    }

    /// Looks at the code, and says how much of `limit` is left.
    pub(crate) fn left(
        &mut self,
        limit: Duration,
        control: &mut Control,
    ) -> Result<Duration, TimeUp> {
        let now = Instant::now();
        let queued = queued_so_far().unwrap_or_default();
        self.taken = Taken {
            worked: time_of_others().saturating_sub(self.worked_before),
            passed: self.taken.passed + (now - self.last_look).min(LONGEST_LOOK),
            queued: queued.saturating_sub(self.queued_before),
            output: Output::of_student().since(self.output_before),
        };
        self.last_look = now;
        if now - self.last_round >= BETWEEN_ROUNDS {
            self.last_round = now;
            self.rounds.add(control.round());
        }
        let mut left = self.taken.left(limit, self.rounds.slowness());
        while left.is_err() && self.rounds.count < MIN_ROUNDS {
            self.rounds.add(control.round());
            left = self.taken.left(limit, self.rounds.slowness());
        }
        left
    }

    /// What the case has taken so far, in seconds of the machine whose seconds the limits are.
    pub(crate) fn spent(&self) -> Duration {
        self.taken.spent().div_f64(self.rounds.slowness())
    }
}

/// The processor time of all threads but this one.
fn time_of_others() -> Duration {
    match cfg!(unix) {
        true => time(true).saturating_sub(time(false)),
        false => time(true),
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

    /// This, and `text` in one more write.
    fn and(self, text: &str) -> Output {
        Output {
            writes: self.writes + 1,
            bytes: self.bytes + text.len() as u64,
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
        times(self.writes, TIME_OF_WRITE).saturating_add(times(self.bytes, TIME_OF_BYTE))
    }

    /// How long its writes may wait for a reader.
    fn waiting(self) -> Duration {
        times(self.writes, WAITING_FOR_WRITE).min(MOST_WAITING_FOR_WRITES)
    }
}

/// `count` times `each`, in whole nanoseconds; the longest time that they can count if it is
/// longer.
fn times(count: u64, each: Duration) -> Duration {
    Duration::from_nanos(count.saturating_mul(each.as_nanos() as u64))
}

/// How long the student's thread had no processor since its start, if the system reports it.
fn queued_so_far() -> Option<Duration> {
    let mut files = STUDENT.get()?.lock().ok()?;
    queued(&text(files.schedstat.as_mut()?)?)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn schedstat_has_the_time_of_waiting_for_a_processor() {
        let time = Duration::from_nanos(556_677);
        assert_eq!(queued("11223344 556677 89\n"), Some(time));
        assert_eq!(queued("11223344"), None);
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
    fn the_marker_of_a_case_is_not_what_its_code_prints() {
        let before = Output::default().and("\n\0case 3\n");
        let output = |writes, bytes| Output { writes, bytes }.since(before);
        assert_eq!(output(1, 9), Output::default());
        assert_eq!(output(2, 11).writes, 1);
        let waited = |writes, passed| Taken {
            passed: Duration::from_secs(passed),
            output: output(writes, 9),
            ..Taken::default()
        };
        let left = |taken: Taken| taken.left(Duration::from_secs(1), 1.0);
        assert_eq!(left(waited(1, 9)), Err(TimeUp::Waiting));
        assert!(left(waited(2, 9)).is_ok());
    }

    #[cfg(unix)]
    #[test]
    fn work_on_other_threads_counts_and_that_of_the_watch_does_not() {
        let before = time_of_others();
        let work = || {
            let started = time_of_this_thread();
            while time_of_this_thread() < started + Duration::from_millis(20) {
                std::hint::black_box(0);
            }
        };
        let threads = [(); 3].map(|()| std::thread::spawn(work));
        threads
            .into_iter()
            .for_each(|thread| thread.join().unwrap());
        assert!(time_of_others() - before >= Duration::from_millis(60));
        let mut control = Control::new();
        let (own, all) = (time(false), time(true));
        (0..20).for_each(|_| assert!(control.round() < Duration::MAX));
        assert!(time(false) > own && time(true) > all);
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn a_limit_of_processor_time_does_not_make_the_clock_coarse() {
        use rustix::process::{Resource, Rlimit, getrlimit, setrlimit};
        let old = getrlimit(Resource::Cpu);
        let current = old.current.or(old.maximum).or(Some(1_000_000));
        setrlimit(Resource::Cpu, Rlimit { current, ..old }).unwrap();
        for _ in 0..20 {
            let before = time(true);
            std::hint::black_box((0..50_000).map(std::hint::black_box).sum::<u64>());
            assert!(time(true) > before);
        }
    }

    /// What is left of five seconds after so many seconds.
    fn of_five(worked: u64, passed: u64, queued: u64, slowness: f64) -> Result<Duration, TimeUp> {
        let seconds = Duration::from_secs;
        let taken = Taken {
            worked: seconds(worked),
            passed: seconds(passed),
            queued: seconds(queued),
            output: Output::default(),
        };
        taken.left(seconds(5), slowness)
    }

    #[test]
    fn waiting_for_the_processor_does_not_count() {
        let left = |seconds| Ok(Duration::from_secs(seconds));
        assert_eq!(of_five(2, 300, 298, 1.0), left(3));
        assert_eq!(of_five(5, 300, 295, 1.0), Err(TimeUp::Computing));
        // Several threads work more than a second in each.
        assert_eq!(of_five(6, 2, 0, 1.0), Err(TimeUp::Computing));
        // It sleeps beyond 8 limits.
        assert_eq!(of_five(0, 39, 0, 1.0), left(5));
        assert_eq!(of_five(0, 40, 0, 1.0), Err(TimeUp::Waiting));
        assert_eq!(of_five(0, 80, 41, 1.0), left(5));
    }

    #[test]
    fn printing_is_no_computing() {
        let seconds = Duration::from_secs;
        let printed = |writes| Taken {
            worked: seconds(20),
            passed: seconds(20),
            output: Output {
                writes,
                bytes: 30 * writes,
            },
            ..Taken::default()
        };
        assert!(printed(1_500_000).left(seconds(5), 1.0).is_ok());
        assert_eq!(
            printed(1_000_000).left(seconds(5), 1.0),
            Err(TimeUp::Computing)
        );
    }

    #[test]
    fn many_writes_may_wait_long_and_few_may_not() {
        let seconds = Duration::from_secs;
        let left = |writes, passed| {
            let taken = Taken {
                passed: seconds(passed),
                output: Output { writes, bytes: 0 },
                ..Taken::default()
            };
            assert!(taken.spent() >= seconds(passed / 2), "{writes} {passed}");
            taken.left(seconds(1), 1.0)
        };
        assert!(left(7_700_000, 149).is_ok());
        assert_eq!(left(39, 39), Err(TimeUp::Waiting));
        assert_eq!(left(u64::MAX, 278), Err(TimeUp::Waiting));
    }

    #[test]
    fn a_machine_ten_times_as_slow_ends_the_same_code() {
        for (worked, waited) in [(0, 0), (4, 0), (5, 0), (4, 39), (4, 40), (0, 41)] {
            let fast = of_five(worked, worked + waited, 0, 1.0);
            let slow = of_five(10 * worked, 10 * (worked + waited), 0, 10.0);
            assert_eq!(slow, fast.map(|left| 10 * left), "{worked} {waited}");
        }
    }

    #[test]
    fn a_stopped_machine_is_one_look() {
        let mut watch = Stopwatch::start("");
        let mut control = Control::new();
        let hour = Duration::from_secs(3600);
        watch.last_look = watch.last_look.checked_sub(hour).unwrap_or(watch.last_look);
        assert!(watch.left(hour, &mut control).is_ok());
        assert!(watch.taken.passed <= LONGEST_LOOK);
        assert!(watch.spent() <= LONGEST_LOOK + watch.taken.worked);
    }
}
