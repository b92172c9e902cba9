//! The worker program: `worker RECORDS FIRST MEMORY_MB` reads cases from its standard input, runs
//! them from number FIRST on and sends their records back. RECORDS is the file of records where the
//! standard input cannot be a socket, and `-` elsewhere. Two words may follow: with `calls` it also
//! sends an entry for each call; with `sealed` the student's thread gives up all rights first.
//!
//! Before each case it prints [`wire::output_marker`], so that the grader knows which case printed
//! what.
//!
//! The grader starts it and reads the records. The student's code runs on its own thread; the main
//! thread enforces the time limit. A case that exceeds its time or memory limit ends the worker:
//! the grader reads which case it was and starts another worker with the next case.

use crate::channel;
use crate::clock::{self, Output, Stopwatch};
use crate::isolate;
use cap::Cap;
use std::alloc::System;
use std::io::Write;
use std::process::ExitCode;
use std::sync::Mutex;
use std::sync::mpsc::{self, RecvTimeoutError};
use std::time::Duration;
use wire::file::FrameWriter;
use wire::{Case, Record, RecordFrame};

/// Stack size of the student's thread: enough for recursion over a deep tree; endless recursion
/// overflows it soon.
const STACK_BYTES: usize = 64 << 20;

/// If one call makes more writes to the system than this, it prints without end.
const MOST_WRITES: u64 = 5_000_000;

/// The shortest time between two checks of the time limit.
const MIN_WAIT: Duration = Duration::from_millis(1);

/// Runs the program. `memory` is its allocator; `run` runs a case with its number and returns its
/// record.
pub fn main(memory: &Cap<System>, run: fn(u32, &Case) -> Record) -> ExitCode {
    match work(memory, run) {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("worker: {message}");
            ExitCode::from(2)
        }
    }
}

fn work(memory: &Cap<System>, run: fn(u32, &Case) -> Record) -> Result<(), String> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [records, first, memory_mb, options @ ..] = arguments.as_slice() else {
        return Err("the grader starts this program: run `cargo grader part1` instead".into());
    };
    let has = |option: &str| options.iter().any(|given| given == option);
    let first: u32 = first
        .parse()
        .map_err(|e| format!("FIRST is {first}: {e}"))?;
    let memory_mb: usize = memory_mb
        .parse()
        .map_err(|e| format!("MEMORY_MB is {memory_mb}: {e}"))?;
    let (cases, records) =
        channel::open(records).map_err(|e| format!("cannot read the cases: {e}"))?;
    // The student's thread writes to it, too, and may outlive this function.
    let records: &Mutex<FrameWriter> = Box::leak(Box::new(Mutex::new(records)));
    if has("calls") {
        isolate::write_calls(records);
    }
    isolate::watch_panics();
    // The memory of the cases does not count.
    memory
        .set_limit(memory.allocated().saturating_add(memory_mb << 20))
        .map_err(|_| "no memory left".to_string())?;
    watch(cases, first, records, has("sealed"), run)
}

/// Runs the cases on another thread, one after the other, and ends the process when one takes too
/// long.
fn watch(
    cases: Vec<Case>,
    first: u32,
    records: &Mutex<FrameWriter>,
    sealed: bool,
    run: fn(u32, &Case) -> Record,
) -> Result<(), String> {
    let limits: Vec<Duration> = cases
        .iter()
        .map(|case| Duration::from_millis(case.limit_ms))
        .collect();
    let (to_runner, indices) = mpsc::channel::<u32>();
    let (to_watch, finished) = mpsc::channel::<Record>();
    let run_all = move || {
        clock::start();
        if sealed && let Err(why) = seal() {
            // Nothing of the student's has run, so this is no result.
            eprintln!("worker: cannot give up its rights: {why}");
            std::process::exit(2);
        }
        for index in indices {
            // On this thread: if the student's code keeps stdout locked, this one waits in vain,
            // and the time limit ends it.
            print(&wire::output_marker(index));
            let record = run(index, &cases[index as usize]);
            print("");
            if to_watch.send(record).is_err() {
                return;
            }
        }
    };
    let thread = std::thread::Builder::new()
        .name("student".into())
        .stack_size(STACK_BYTES);
    thread
        .spawn(run_all)
        .map_err(|e| format!("cannot start a thread: {e}"))?;

    let write = |frame: &RecordFrame| {
        let mut records = records.lock().map_err(|e| e.to_string())?;
        let written = records.write(frame);
        written.map_err(|e| format!("cannot write a record: {e}"))
    };
    for (case, limit) in (first..).zip(&limits[(first as usize).min(limits.len())..]) {
        write(&RecordFrame::Started { case })?;
        let stopwatch = Stopwatch::start();
        let mut printing = PrintingCall::default();
        to_runner.send(case).map_err(|e| e.to_string())?;
        loop {
            let call = isolate::current_call();
            let Some(left) = stopwatch.left(*limit) else {
                write(&RecordFrame::TimedOut { case, call })?;
                std::process::exit(0);
            };
            if printing.has_no_end(call, Output::of_student()) {
                write(&RecordFrame::PrintedTooMuch { case, call })?;
                std::process::exit(0);
            }
            match finished.recv_timeout(left.max(MIN_WAIT)) {
                Ok(record) => {
                    write(&RecordFrame::Done(record))?;
                    break;
                }
                Err(RecvTimeoutError::Timeout) => {}
                Err(RecvTimeoutError::Disconnected) => {
                    return Err("the student's thread ended".into());
                }
            }
        }
    }
    Ok(())
}

/// Gives up all rights of this thread.
#[cfg(feature = "sandbox")]
fn seal() -> Result<(), String> {
    sandbox::confine::seal_thread()
}

/// A worker that was built for a student's own run has nothing to give up its rights with.
#[cfg(not(feature = "sandbox"))]
fn seal() -> Result<(), String> {
    Err("it was built without the feature `sandbox`".into())
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
