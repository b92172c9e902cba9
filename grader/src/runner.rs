//! Runs workers over cases, and finds which case ended a worker.

use crate::child_processes;
use crate::error::GraderError;
use crate::interrupt;
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
    /// The case ended the worker; the text explains to the student how.
    Died(String),
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
    /// The end of its output to stdout and stderr.
    pub printed: String,
}

/// After this many timeouts of a task, its other cases get a short time limit: an endless loop
/// should not cost the student minutes.
const TIMEOUTS_A_TASK: u32 = 2;

/// The short time limit in milliseconds. Correct code needs a few milliseconds.
const SHORT_LIMIT_MS: u64 = 500;

/// Memory that a worker may allocate in addition to its cases.
const MEMORY_MB: u32 = 4096;

/// The file of records in a worker's folder.
const RECORDS: &str = "records";

/// How many bytes of the student's output are kept.
const PRINTED_BYTES: usize = 4096;

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
    let mut printed = String::new();
    let mut first = 0;
    while first < cases.len() {
        let status = one_worker(worker, folder.path(), &cases_to_run, first, &mut printed)?;
        let mut read = match FrameReader::open(&folder.path().join(RECORDS)) {
            Ok(frames) => records::read(frames, &cases_to_run, first),
            Err(e) => Records::unreadable(&e.to_string()),
        };
        if read.next_began {
            let ending = Ending::Died(death(status, &printed));
            read.endings.push(ending);
        } else if read.endings.is_empty() {
            return Err(GraderError::new(format!(
                "the worker did not start ({status}): {}",
                printed.trim()
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

/// Runs one worker to its end and appends its output to `printed`.
fn one_worker(
    worker: &Worker,
    folder: &Path,
    cases: &[Case],
    first: usize,
    printed: &mut String,
) -> Result<ExitStatus, GraderError> {
    let (cases_file, records) = (folder.join("cases"), folder.join(RECORDS));
    file::write_cases(&cases_file, cases)
        .map_err(|e| GraderError::file("write", &cases_file, e))?;
    // Nothing that an earlier worker wrote is read again.
    File::create(&records).map_err(|e| GraderError::file("write", &records, e))?;
    let mut command = Command::new(&worker.program);
    command
        .envs(worker.environment.iter().map(|(name, value)| (name, value)))
        .arg(&cases_file)
        .arg(&records)
        .arg(first.to_string())
        .arg(MEMORY_MB.to_string())
        .current_dir(folder)
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped());
    let (mut child, _running) = child_processes::start(&mut command)
        .map_err(|e| GraderError::file("start", &worker.program, e))?;
    let stdout = child
        .stdout
        .take()
        .map(|pipe| std::thread::spawn(move || tail(pipe)));
    let stderr = child
        .stderr
        .take()
        .map(|pipe| std::thread::spawn(move || tail(pipe)));
    let status = child
        .wait()
        .map_err(|e| GraderError::file("wait for", &worker.program, e))?;
    for reader in [stdout, stderr].into_iter().flatten() {
        printed.push_str(&reader.join().unwrap_or_default());
    }
    Ok(status)
}

/// The last bytes of a pipe. Reads it to its end, so that the writer never blocks.
pub fn tail(mut pipe: impl Read) -> String {
    let mut kept: Vec<u8> = Vec::new();
    let mut chunk = [0; 8192];
    while let Ok(n @ 1..) = pipe.read(&mut chunk) {
        kept.extend_from_slice(&chunk[..n]);
        let surplus = kept.len().saturating_sub(PRINTED_BYTES);
        kept.drain(..surplus);
    }
    String::from_utf8_lossy(&kept).into_owned()
}

/// A message for the student on how a worker died.
fn death(status: ExitStatus, printed: &str) -> String {
    if printed.contains("has overflowed its stack") {
        return "overflowed the stack: does a recursion not end?".into();
    }
    if printed.contains("memory allocation of") {
        return format!("tried to allocate more than {MEMORY_MB} MB of memory");
    }
    match status.code() {
        Some(code) => {
            format!("ended the whole program with exit code {code}: does it call `exit`?")
        }
        None => format!("ended the whole program ({status})"),
    }
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
