//! Grades units on this machine, several at a time: each in a process of its own, so that no
//! submission can stop another one.

use crate::out::Out;
use crate::plan::Planned;
use crate::progress::Progress;
use crate::unit;
use base::GraderError;
use base::child_processes;
use base::write_whole;
use std::collections::VecDeque;
use std::io;
use std::process::{Child, Command, ExitStatus, Stdio};
use std::sync::Mutex;
use std::time::{Duration, Instant};

/// How many times a unit is tried if the machine fails, not the submission.
pub const ATTEMPTS: u32 = 3;

/// After this time a process counts as failed. Everything in it has limits of its own, which are
/// shorter: a submission that uses them up has a score.
const LONGEST: Duration = Duration::from_secs(5 * 3600);

/// How often to look whether a process has ended.
const POLL: Duration = Duration::from_millis(20);

/// A unit to grade: its key, and the submission that it is graded for.
pub type Job<'a> = (&'a str, &'a Planned);

/// Grades `jobs`, `at_once` at a time, in processes that `command` makes. A unit that fails is
/// tried again later; the reason of its last failure is stored.
pub fn run(
    jobs: &[Job],
    at_once: usize,
    out: &Out,
    progress: &Progress,
    command: impl Fn(&str) -> Command + Sync,
) -> Result<(), GraderError> {
    let queue: Mutex<VecDeque<(Job, u32)>> = Mutex::new(jobs.iter().map(|job| (*job, 1)).collect());
    let next = || queue.lock().ok()?.pop_front();
    let work = || -> Result<(), GraderError> {
        while let Some(((key, planned), attempt)) = next() {
            let failure = grade(command(key)).or_else(|| {
                let is_stored = unit::is_stored(out, key);
                (!is_stored).then(|| "the process stored no result".to_string())
            });
            match failure {
                None => progress.done(planned, None),
                Some(why) if attempt < ATTEMPTS => {
                    progress.retry(planned, &why);
                    if let Ok(mut queue) = queue.lock() {
                        queue.push_back(((key, planned), attempt + 1));
                    }
                }
                Some(why) => {
                    store_failure(out, key, &why)?;
                    progress.done(planned, Some(&why));
                }
            }
        }
        Ok(())
    };
    std::thread::scope(|scope| {
        let threads: Vec<_> = (0..at_once.max(1)).map(|_| scope.spawn(work)).collect();
        let ended = threads.into_iter().map(|thread| {
            let ended = thread.join();
            ended.unwrap_or_else(|panic| std::panic::resume_unwind(panic))
        });
        ended.collect()
    })
}

/// Stores why a unit could not be graded.
pub fn store_failure(out: &Out, key: &str, why: &str) -> Result<(), GraderError> {
    write_whole(&out.failure(key), format!("{why}\n").as_bytes())
}

/// Runs a process to its end. Returns why it failed, if it did.
fn grade(mut command: Command) -> Option<String> {
    command
        // It ends when this pipe is closed: with this process, however that ends.
        .stdin(Stdio::piped())
        .stdout(Stdio::null())
        .stderr(Stdio::piped());
    let (mut child, _running) = match child_processes::start(&mut command) {
        Ok(started) => started,
        Err(e) => return Some(format!("cannot start a process: {e}")),
    };
    let pipe = child.stderr.take();
    let stderr = std::thread::spawn(move || pipe.map(child_processes::tail).unwrap_or_default());
    let ended = wait(&mut child);
    let said = stderr.join().unwrap_or_default();
    match ended {
        Ok(Some(status)) if status.success() => None,
        Ok(Some(status)) => Some(why_it_failed(status, &said)),
        Ok(None) => Some(format!(
            "it did not end within {} minutes",
            LONGEST.as_secs() / 60
        )),
        Err(e) => Some(format!("cannot wait for a process: {e}")),
    }
}

/// Why a process with this status failed that `said` this. One that was killed said nothing about it:
/// its last words are cargo's, about a lock for example.
fn why_it_failed(status: ExitStatus, said: &str) -> String {
    let said = error_in(said);
    match status.code() {
        Some(_) if !said.is_empty() => said.to_string(),
        Some(_) => format!("the process ended without a message ({status})"),
        None => {
            format!("the process was killed ({status}): did the memory of the machine run out?")
        }
    }
}

/// The error that a process printed last, without what cargo printed before it.
fn error_in(said: &str) -> &str {
    const ERROR: &str = "error: ";
    let starts = said
        .match_indices(ERROR)
        .map(|(at, _)| at)
        .filter(|at| *at == 0 || said[..*at].ends_with('\n'));
    let start = starts.last().map_or(0, |at| at + ERROR.len());
    said[start..].trim()
}

/// Waits for the end of a process; `None` if it took too long and was killed.
fn wait(child: &mut Child) -> io::Result<Option<ExitStatus>> {
    let deadline = Instant::now() + LONGEST;
    loop {
        if let Some(status) = child.try_wait()? {
            return Ok(Some(status));
        }
        if Instant::now() >= deadline {
            // Without its pipe it first ends what it has started.
            drop(child.stdin.take());
            std::thread::sleep(Duration::from_secs(2));
            child.kill()?;
            child.wait()?;
            return Ok(None);
        }
        std::thread::sleep(POLL);
    }
}

/// Ends this process and what it has started when its standard input is closed: the pool that
/// started it is gone.
pub fn end_with_the_pool() {
    std::thread::spawn(|| {
        let _ = io::copy(&mut io::stdin(), &mut io::sink());
        // The handler of this signal ends child processes and removes temporary files.
        let _ = Command::new("kill")
            .args(["-TERM", &std::process::id().to_string()])
            .status();
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[cfg(unix)]
    #[test]
    fn words_of_cargo_do_not_hide_that_a_process_was_killed() {
        use std::os::unix::process::ExitStatusExt;
        let why = |status, said| why_it_failed(ExitStatus::from_raw(status), said);
        let waiting = "    Blocking waiting for file lock on build directory\n";
        assert!(why(9, waiting).contains("signal: 9"));
        assert_eq!(why(1 << 8, "error: the disk is full\n"), "the disk is full");
        assert!(why(1 << 8, "").contains("exit status: 1"));
    }

    #[test]
    fn the_reason_is_the_last_error() {
        let said = "    Finished `release` profile\nerror: cannot write a: the disk is full\n";
        assert_eq!(error_in(said), "cannot write a: the disk is full");
        assert_eq!(
            error_in("error: a: error: b\nand more\n"),
            "a: error: b\nand more"
        );
        assert_eq!(error_in("  killed\n"), "killed");
    }
}
