//! Runs workers over cases, and finds which case ended a worker.

use crate::child_processes;
use crate::death::Death;
use crate::error::GraderError;
use crate::interrupt;
use crate::printed::{self, Printed, WorkerOutput};
use crate::records::{self, Records};
use std::collections::HashMap;
use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitStatus, Stdio};
use wire::file::{self, FrameReader};
use wire::{Case, Outcome, Record, Work};

/// How a case ended, as seen from outside the worker.
#[derive(Clone, Debug, PartialEq)]
pub enum Ending {
    /// The worker wrote a record.
    Recorded(Record),
    /// The case exceeded its time limit.
    TimedOut {
        /// The call that was running, counted from 0.
        call: u32,
        /// The time limit in milliseconds.
        limit_ms: u64,
    },
    /// The code printed without end.
    PrintedTooMuch {
        /// The call that was running, counted from 0.
        call: u32,
    },
    /// The case ended the worker.
    Died {
        /// How.
        how: Death,
        /// The call that was running, counted from 0; `None` if it is not known.
        call: Option<u32>,
    },
    /// The worker's record is invalid; the text is a sentence that explains why.
    Malformed(String),
    /// Not run, because smaller timings have timed out.
    Skipped,
}

/// The endings of all cases, and what the student's code printed.
#[derive(Clone, Debug)]
pub struct Run {
    /// One for each case, in order.
    pub endings: Vec<Ending>,
    /// What it printed to stdout and stderr, case by case; only cases that printed something.
    pub printed: Vec<Printed>,
}

/// After this many timeouts of a task, its other cases get a short time limit: an endless loop
/// should not cost the student minutes.
const TIMEOUTS_A_TASK: u32 = 2;

/// The short time limit in milliseconds. Correct code needs a few milliseconds.
const SHORT_LIMIT_MS: u64 = 500;

/// Memory in megabytes that a worker may allocate in addition to its cases. Correct code needs less
/// than 100. Code that never stops allocating must end before the machine has to swap.
const MEMORY_MB: u32 = 1024;

/// The same for workers that build trees over a million triangles and time them.
const TIMING_MEMORY_MB: u32 = 4096;

/// For this many cases of a task that end the worker, a second run finds out in which call.
const TRACED_DEATHS: u32 = 2;

/// The file of records in a worker's folder.
const RECORDS: &str = "records";

/// How many bytes of a program's output [`tail`] keeps.
const TAIL_BYTES: usize = 4096;

/// A worker to run.
#[derive(Clone, Debug)]
pub struct Worker {
    /// The program.
    pub program: PathBuf,
    /// Environment variables to set.
    pub environment: Vec<(&'static str, String)>,
}

impl From<PathBuf> for Worker {
    fn from(program: PathBuf) -> Worker {
        Worker {
            program,
            environment: Vec::new(),
        }
    }
}

/// Runs `cases` in `worker`. A case that ends the worker does not affect the others.
pub fn run(worker: &Worker, cases: &[Case]) -> Result<Run, GraderError> {
    let folder = interrupt::temp_folder()?;
    let mut cases_to_run = cases.to_vec();
    let mut endings: Vec<Option<Ending>> = vec![None; cases.len()];
    let mut timeouts: HashMap<&str, u32> = HashMap::new();
    let mut deaths: HashMap<&str, u32> = HashMap::new();
    let mut printed = Vec::new();
    let mut first = 0;
    while first < cases.len() {
        let process = Process {
            worker,
            folder: folder.path(),
            cases: &cases_to_run,
        };
        let (status, output) = process.run(first, false)?;
        printed.extend(output.cases);
        let mut read = process.records(first);
        if read.next_began {
            let died = first + read.endings.len();
            let deaths = deaths.entry(&cases[died].task).or_default();
            *deaths += 1;
            read.endings.push(Ending::Died {
                how: Death::of(status, &output.end, memory_mb(&cases_to_run)),
                call: match *deaths <= TRACED_DEATHS {
                    true => process.call_that_ends(died)?,
                    false => None,
                },
            });
        } else if read.endings.is_empty() {
            return Err(GraderError::new(format!(
                "the worker did not start ({status}): {}",
                output.end.trim()
            )));
        }
        let slots = cases.iter().zip(&mut endings).skip(first);
        let next = first + read.endings.len();
        for ((case, slot), ending) in slots.zip(read.endings) {
            if let (None, Ending::TimedOut { .. }) = (&slot, &ending) {
                *timeouts.entry(&case.task).or_default() += 1;
            }
            slot.get_or_insert(ending);
        }
        first = next;
        for (case, ending) in cases_to_run[first..].iter_mut().zip(&mut endings[first..]) {
            if timeouts
                .get(case.task.as_str())
                .is_none_or(|&timeouts| timeouts < TIMEOUTS_A_TASK)
            {
                continue;
            }
            match case.work {
                // Timings take longer for larger meshes: a short limit does not help.
                Work::Timing(_) => *ending = Some(Ending::Skipped),
                // Correct code takes longer than the short limit, too.
                Work::BuildGrowth(_) => {}
                _ => case.limit_ms = case.limit_ms.min(SHORT_LIMIT_MS),
            }
        }
        while first < cases.len() && endings[first].is_some() {
            first += 1;
        }
        // A worker reads all cases before it starts: do not send the finished ones again.
        cases_to_run[..first]
            .iter_mut()
            .for_each(|case| case.work = Work::Stop(Vec::new()));
    }
    Ok(Run {
        endings: endings
            .into_iter()
            .map(|ending| ending.unwrap_or(Ending::Skipped))
            .collect(),
        printed,
    })
}

/// A worker, its cases and the folder for its files.
#[derive(Clone, Copy)]
struct Process<'a> {
    worker: &'a Worker,
    folder: &'a Path,
    cases: &'a [Case],
}

impl Process<'_> {
    /// Runs the cases from number `first` on in a worker, until it ends. `write_calls` also records
    /// each call.
    fn run(
        self,
        first: usize,
        write_calls: bool,
    ) -> Result<(ExitStatus, WorkerOutput), GraderError> {
        let (cases_file, records) = (self.folder.join("cases"), self.folder.join(RECORDS));
        file::write_cases(&cases_file, self.cases)
            .map_err(|e| GraderError::file("write", &cases_file, e))?;
        // Nothing that an earlier worker wrote is read again.
        File::create(&records).map_err(|e| GraderError::file("write", &records, e))?;
        let program = &self.worker.program;
        let failed = |e| GraderError::file("start", program, e);
        // One pipe, so that the lines of stdout and stderr stay in their order.
        let (reader, stdout) = std::io::pipe().map_err(failed)?;
        let stderr = stdout.try_clone().map_err(failed)?;
        let environment = self.worker.environment.iter();
        let mut command = Command::new(program);
        command
            // A backtrace shows the worker's functions, and floods the report.
            .env("RUST_BACKTRACE", "0")
            .envs(environment.map(|(name, value)| (name, value)))
            .arg(&cases_file)
            .arg(&records)
            .arg(first.to_string())
            .arg(memory_mb(self.cases).to_string())
            .args(write_calls.then_some("calls"))
            .current_dir(self.folder)
            .stdin(Stdio::null())
            .stdout(stdout)
            .stderr(stderr);
        let (mut child, _running) = child_processes::start(&mut command).map_err(failed)?;
        // It holds the other end of the pipe.
        drop(command);
        let output = printed::read(reader, self.cases);
        let status = child
            .wait()
            .map_err(|e| GraderError::file("wait for", program, e))?;
        Ok((status, output))
    }

    /// The records of a run from case `first` on.
    fn records(self, first: usize) -> Records {
        match FrameReader::open(&self.folder.join(RECORDS)) {
            Ok(frames) => records::read(frames, self.cases, first),
            Err(e) => Records::unreadable(&e.to_string()),
        }
    }

    /// Runs case number `case` again and returns the call in which it ends the worker; `None` if it
    /// does not end it again.
    fn call_that_ends(self, case: usize) -> Result<Option<u32>, GraderError> {
        let alone = Process {
            cases: &self.cases[..=case],
            ..self
        };
        alone.run(case, true)?;
        let records = alone.records(case);
        Ok(records.call.filter(|_| records.next_began))
    }
}

/// The memory that a worker for these cases may allocate, in megabytes.
fn memory_mb(cases: &[Case]) -> u32 {
    let is_timing = |case: &Case| matches!(case.work, Work::Timing(_) | Work::BuildGrowth(_));
    match cases.iter().any(is_timing) {
        true => TIMING_MEMORY_MB,
        false => MEMORY_MB,
    }
}

/// The last bytes of a pipe. Reads it to its end, so that the writer never blocks.
pub fn tail(mut pipe: impl Read) -> String {
    let mut kept: Vec<u8> = Vec::new();
    let mut chunk = [0; 8192];
    while let Ok(n @ 1..) = pipe.read(&mut chunk) {
        kept.extend_from_slice(&chunk[..n]);
        let surplus = kept.len().saturating_sub(TAIL_BYTES);
        kept.drain(..surplus);
    }
    String::from_utf8_lossy(&kept).into_owned()
}

impl Ending {
    /// The outcome that the worker recorded; `None` if it recorded none.
    pub fn outcome(&self) -> Option<&Outcome> {
        match self {
            Ending::Recorded(record) => Some(&record.outcome),
            _ => None,
        }
    }
}
