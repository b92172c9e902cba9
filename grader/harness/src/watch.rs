//! Runs the cases on a thread of their own and ends the worker when one exceeds a limit.

use crate::clock::{self, Output, Stopwatch, TimeUp};
use crate::control::Control;
use crate::isolate;
use crate::usage::UsageFile;
use std::io::Write;
use std::sync::Mutex;
use std::sync::mpsc::{self, Receiver, RecvTimeoutError, Sender};
use std::time::Duration;
use wire::file::FrameWriter;
use wire::{Case, Excess, Record, RecordFrame};

/// Stack size of the student's thread: enough for recursion over a deep tree; endless recursion
/// overflows it soon.
const STACK_BYTES: usize = 64 << 20;

/// If one call makes more writes to the system than this, it prints without end.
const MOST_WRITES: u64 = 5_000_000;

/// The shortest time between two checks of the time limit.
const MIN_WAIT: Duration = Duration::from_millis(1);

/// The longest one: a case that starts threads or fills their stacks is ended before it has many.
const MAX_WAIT: Duration = Duration::from_millis(5);

/// How much a case takes between two reports of it: the grader adds up what the cases of a task take,
/// and sees that the worker is alive.
const BETWEEN_REPORTS: Duration = Duration::from_millis(500);

/// The most threads of a worker: code that divides its work among the processors needs fewer.
const MOST_THREADS: u64 = 128;

/// The cases to run, and how.
pub(crate) struct Job {
    pub(crate) cases: Vec<Case>,
    /// The number of the first case to run.
    pub(crate) first: u32,
    /// Memory in megabytes that the cases may use.
    pub(crate) memory_mb: usize,
    /// Whether the worker gives up all rights before code of the student's runs.
    pub(crate) sealed: bool,
    /// Runs a case with its number.
    pub(crate) run: fn(u32, &Case) -> Record,
}

/// Runs the cases one after the other. An error is returned only before code of the student's has
/// run; afterwards nothing on this thread may print or panic, since a panic calls a hook that may be
/// the student's.
pub(crate) fn watch(job: Job, records: &'static Mutex<FrameWriter>) -> Result<(), String> {
    let limits: Vec<Duration> = job
        .cases
        .iter()
        .map(|case| Duration::from_millis(case.limit_ms))
        .collect();
    let (first, sealed, memory_mb) = (job.first, job.sealed, job.memory_mb);
    let (to_student, numbers) = mpsc::channel::<u32>();
    let (to_watch, finished) = mpsc::channel::<Record>();
    let (to_start, started) = mpsc::channel::<Result<(), String>>();
    let thread = std::thread::Builder::new()
        .name("student".into())
        .stack_size(STACK_BYTES);
    let student = move || {
        clock::start();
        let ready = seal(sealed);
        let is_ready = ready.is_ok();
        if to_start.send(ready).is_ok() && is_ready {
            run_each(&job, &numbers, &to_watch);
        }
    };
    thread
        .spawn(student)
        .map_err(|e| format!("cannot start a thread: {e}"))?;
    let mut usage = UsageFile::open();
    let control = Control::new();
    let sealed_student = started.recv().map_err(|e| e.to_string())?;
    // This thread, too: the student's code could be made to run on it.
    sealed_student
        .and_then(|()| seal(sealed))
        .map_err(|why| format!("cannot give up its rights: {why}"))?;
    // Its own stack is no memory that a case takes.
    let of_cases = ((memory_mb << 20) + STACK_BYTES) as u64;
    let mut watch = Watch {
        records,
        to_student,
        finished,
        most_resident: usage.now().resident.saturating_add(of_cases),
        usage,
        control,
    };
    for (case, limit) in (first..).zip(&limits[(first as usize).min(limits.len())..]) {
        if watch.case(case, *limit).is_none() {
            // The channel or the student's thread is gone: there is nobody to tell.
            std::process::abort();
        }
    }
    Ok(())
}

/// Runs the cases with these numbers, and sends their records.
fn run_each(job: &Job, numbers: &Receiver<u32>, to_watch: &Sender<Record>) {
    for number in numbers {
        // On this thread: if the student's code keeps stdout locked, this one waits in vain, and the
        // time limit ends it.
        print(&wire::output_marker(number));
        let record = (job.run)(number, &job.cases[number as usize]);
        print("");
        if to_watch.send(record).is_err() {
            return;
        }
    }
}

/// The main thread's part: it writes how each case ends.
struct Watch {
    records: &'static Mutex<FrameWriter>,
    to_student: Sender<u32>,
    finished: Receiver<Record>,
    usage: UsageFile,
    /// The most bytes of memory that the process may use.
    most_resident: u64,
    control: Control,
}

impl Watch {
    /// Lets case number `case` run, and writes its record. Ends the process if it exceeds a limit.
    /// `None` if a record cannot be written or will not come.
    fn case(&mut self, case: u32, limit: Duration) -> Option<()> {
        self.write(&RecordFrame::Started { case })?;
        let mut stopwatch = Stopwatch::start(&wire::output_marker(case));
        let mut reported = Duration::ZERO;
        let mut printing = PrintingCall::default();
        self.to_student.send(case).ok()?;
        loop {
            let call = isolate::current_call();
            let left = stopwatch.left(limit, &mut self.control);
            if left.is_err() || stopwatch.spent() >= reported + BETWEEN_REPORTS {
                reported = stopwatch.spent();
                let ms = reported.as_millis() as u64;
                self.write(&RecordFrame::Spent { case, ms })?;
            }
            let left = match left {
                Ok(left) => left,
                Err(TimeUp::Computing) => return self.end(&RecordFrame::TimedOut { case, call }),
                Err(TimeUp::Waiting) => {
                    let what = Excess::Waiting;
                    return self.end(&RecordFrame::TookTooMuch { case, call, what });
                }
            };
            if printing.has_no_end(call, Output::of_student()) {
                return self.end(&RecordFrame::PrintedTooMuch { case, call });
            }
            match self.finished.recv_timeout(left.clamp(MIN_WAIT, MAX_WAIT)) {
                Ok(record) => return self.write(&RecordFrame::Done(record)),
                Err(RecvTimeoutError::Timeout) => {}
                Err(RecvTimeoutError::Disconnected) => return None,
            }
            let usage = self.usage.now();
            let too_much = if usage.threads > MOST_THREADS {
                Some(Excess::Threads)
            } else {
                (usage.resident > self.most_resident).then_some(Excess::Memory)
            };
            if let Some(what) = too_much {
                return self.end(&RecordFrame::TookTooMuch { case, call, what });
            }
        }
    }

    fn write(&self, frame: &RecordFrame) -> Option<()> {
        self.records.lock().ok()?.write(frame).ok()
    }

    /// Writes the last frame and ends the process.
    fn end(&self, frame: &RecordFrame) -> Option<()> {
        self.write(frame)?;
        std::process::exit(0)
    }
}

/// Gives up all rights of this thread, if the worker is to be sealed.
#[cfg(feature = "sandbox")]
fn seal(sealed: bool) -> Result<(), String> {
    match sealed {
        true => sandbox::confine::seal_thread(),
        false => Ok(()),
    }
}

/// A worker that was built for a student's own run has nothing to give up its rights with.
#[cfg(not(feature = "sandbox"))]
fn seal(sealed: bool) -> Result<(), String> {
    match sealed {
        true => Err("it was built without the feature `sandbox`".into()),
        false => Ok(()),
    }
}

/// Prints `text` and everything that was printed before.
fn print(text: &str) {
    let mut stdout = std::io::stdout();
    // What cannot be printed is not worth the points of the case.
    let _ = stdout.write_all(text.as_bytes());
    let _ = stdout.flush();
}

/// The call that was running when the watch last looked, and the output before.
#[derive(Default)]
struct PrintingCall {
    call: Option<u32>,
    before: Output,
}

impl PrintingCall {
    /// Whether `call`, which is running, has made more than [`MOST_WRITES`] since the watch first
    /// saw it.
    fn has_no_end(&mut self, call: u32, output: Output) -> bool {
        if self.call != Some(call) {
            self.call = Some(call);
            self.before = output;
        }
        output.since(self.before).writes > MOST_WRITES
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_one_call_that_prints_without_end_is_ended() {
        let output = |writes| Output {
            writes,
            ..Output::default()
        };
        let mut printing = PrintingCall::default();
        assert!(!printing.has_no_end(0, output(10)));
        assert!(!printing.has_no_end(0, output(MOST_WRITES)));
        assert!(!printing.has_no_end(1, output(2 * MOST_WRITES)));
        assert!(!printing.has_no_end(1, output(3 * MOST_WRITES)));
        assert!(printing.has_no_end(1, output(3 * MOST_WRITES + 1)));
    }
}
