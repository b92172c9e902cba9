//! The worker program: `worker RECORDS FIRST MEMORY_MB` reads cases from its standard input, runs
//! them from number FIRST on and sends their records back. RECORDS is the file of records where the
//! standard input cannot be a socket, and `-` elsewhere. Two words may follow: with `calls` it also
//! sends an entry for each call; with `sealed` every thread gives up all rights first.
//!
//! Before each case it prints [`wire::output_marker`], so that the grader knows which case printed
//! what.
//!
//! The grader starts it and reads the records. The student's code runs on its own thread; the main
//! thread enforces the limits ([`crate::watch`]). A case that exceeds one ends the worker: the grader
//! reads which case it was and starts another worker with the next case.

use crate::channel::{self, Channel};
use crate::isolate;
use crate::watch::{self, Job};
use cap::Cap;
use std::alloc::System;
use std::process::ExitCode;
use std::sync::Mutex;
use wire::file::FrameWriter;
use wire::{Case, Record};

/// Runs the program. `memory` is its allocator; `run` runs a case with its number and returns its
/// record.
pub fn main(memory: &Cap<System>, run: fn(u32, &Case) -> Record) -> ExitCode {
    match work(memory, run) {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            // Nothing of the student's has run, so this is no result.
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
    let Channel {
        cases,
        records,
        replies,
    } = channel::open(records).map_err(|e| format!("cannot read the cases: {e}"))?;
    // The student's thread writes to it, too, and may outlive this function.
    let records: &Mutex<FrameWriter> = Box::leak(Box::new(Mutex::new(records)));
    isolate::ask_through(records, replies);
    if has("calls") {
        isolate::write_calls(records);
    }
    isolate::watch_panics();
    // The memory of the cases does not count.
    memory
        .set_limit(memory.allocated().saturating_add(memory_mb << 20))
        .map_err(|_| "no memory left".to_string())?;
    let job = Job {
        cases,
        first,
        memory_mb,
        sealed: has("sealed"),
        run,
    };
    watch::watch(job, records)
}
