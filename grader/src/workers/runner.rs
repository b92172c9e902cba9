//! Runs workers over cases, and finds which case ended a worker.

use crate::workers::asked::Asked;
use crate::workers::awake::Awake;
use crate::workers::channel::Channel;
use crate::workers::death::Death;
use crate::workers::launcher::{Launcher, WorkerLimits};
use crate::workers::printed::{self, Printed, WorkerOutput};
use crate::workers::records::{self, Records};
use crate::workers::task_time::TaskTimes;
use base::{GraderError, child_processes, interrupt};
use std::collections::HashMap;
use std::io::{self};
use std::path::{Path, PathBuf};
use std::process::{Command, ExitStatus};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc;
use std::time::Duration;
use wire::question::write_reply;
use wire::{Case, Outcome, Record, RecordFrame, Work};

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
        /// It slept or waited, and did not compute for so long.
        waited: bool,
    },
    /// The code printed without end.
    PrintedTooMuch {
        /// The call that was running, counted from 0.
        call: u32,
    },
    /// The code started too many threads.
    TooManyThreads {
        /// The call that was running, counted from 0.
        call: u32,
    },
    /// The cases of the task took too long together, this one or those before it.
    OutOfTime,
    /// The case ended the worker.
    Died {
        /// How.
        how: Death,
        /// The call that was running, counted from 0; `None` if it is not known.
        call: Option<u32>,
    },
    /// The worker's record is invalid; the text is a sentence that explains why.
    Malformed(String),
    /// Something changed what the worker counted; the text is a sentence that says how this shows.
    ChangedCounts(String),
    /// Not run, because smaller timings have timed out.
    Skipped,
    /// Not run, because another case of its task did not return ([`Patience::OneTimeout`]).
    NotRun,
}

/// What becomes of the other cases of a task in which code did not return.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Patience {
    /// They run, after some timeouts with a short time limit: each has points of its own.
    #[default]
    EachCase,
    /// They are not run: the first says that there is an endless loop.
    OneTimeout,
    /// As for [`Patience::OneTimeout`], and all have the short time limit: simple questions to code
    /// that is known to have an endless loop.
    OneShortTimeout,
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

/// The same for builds of ever larger trees, which take correct code a second.
const GROWTH_SHORT_LIMIT_MS: u64 = 10_000;

/// Memory in megabytes that a worker may allocate in addition to its cases. Correct code needs less
/// than 100. Code that never stops allocating must end before the machine has to swap.
const MEMORY_MB: u32 = 1024;

/// The same for workers that build trees over a million triangles and time them.
const TIMING_MEMORY_MB: u32 = 4096;

/// For this many cases of a task that end the worker, a second run finds out in which call.
const TRACED_DEATHS: u32 = 2;

/// A worker that is alive sends a frame each second (`harness/src/watch.rs`): after so long without
/// one it was stopped. A machine that is a hundred times as slow does not decide.
const SILENCE: Duration = Duration::from_secs(120);

/// After this many workers that sent nothing in time, no other is started for the remaining cases.
const MOST_STALLS: u32 = 2;

/// How long a worker may take to end after its last record.
const ENDING: Duration = Duration::from_secs(60);

/// The processor time of a worker is limited to so many times the limits of its cases, and
/// [`SPARE_CPU_SECONDS`]: the system's limit, should the worker's own fail.
const SPARE_CPU: u64 = 20;

/// The processor time of a worker beyond the limits of its cases, in seconds.
const SPARE_CPU_SECONDS: u64 = 600;

/// A worker to run.
#[derive(Clone, Debug)]
pub struct Worker {
    /// The program.
    pub program: PathBuf,
    /// Environment variables to set.
    pub environment: Vec<(&'static str, String)>,
    /// Starts it with few rights; `None` for the rights of this program.
    pub launcher: Option<Arc<dyn Launcher>>,
    /// Whether it goes on with a task after a timeout.
    pub patience: Patience,
}

impl From<PathBuf> for Worker {
    fn from(program: PathBuf) -> Worker {
        Worker {
            program,
            environment: Vec::new(),
            launcher: None,
            patience: Patience::default(),
        }
    }
}

impl Worker {
    /// When its cases have to have ended; `None` if there is no such limit.
    fn end(&self) -> Option<Awake> {
        self.launcher.as_ref()?.end()
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
    let mut times = TaskTimes::until(worker.end());
    let mut stalls = 0;
    let mut first = 0;
    loop {
        for (case, ending) in cases_to_run[first..].iter_mut().zip(&mut endings[first..]) {
            if times.is_over(case) {
                ending.get_or_insert(Ending::OutOfTime);
                continue;
            }
            let timeouts = timeouts.get(case.task.as_str()).copied().unwrap_or(0);
            if timeouts > 0 && worker.patience != Patience::EachCase {
                ending.get_or_insert(Ending::NotRun);
                continue;
            }
            if timeouts < TIMEOUTS_A_TASK && worker.patience != Patience::OneShortTimeout {
                continue;
            }
            match case.work {
                // Timings take longer for larger meshes: a short limit does not help.
                Work::Timing(_) => *ending = Some(Ending::Skipped),
                Work::BuildGrowth(_) => case.limit_ms = case.limit_ms.min(GROWTH_SHORT_LIMIT_MS),
                _ => case.limit_ms = case.limit_ms.min(SHORT_LIMIT_MS),
            }
        }
        while first < cases.len() && endings[first].is_some() {
            first += 1;
        }
        if first == cases.len() {
            break;
        }
        // A worker reads all cases before it starts: do not send the finished ones again.
        cases_to_run[..first]
            .iter_mut()
            .for_each(|case| case.work = Work::Stop(Vec::new()));
        let process = Process {
            worker,
            folder: folder.path(),
            cases: &cases_to_run,
        };
        let Finished {
            status,
            output,
            records: mut read,
            has_stalled,
        } = process.run(first, false, &mut times)?;
        printed.extend(output.cases);
        let next = cases.get(first + read.endings.len());
        if next.is_some_and(|case| has_stalled && times.is_over(case)) {
            read.endings.push(Ending::OutOfTime);
        } else if has_stalled {
            stalls += 1;
            let after = first + read.endings.len();
            read.endings.push(stalled(&cases[after], &read));
            if stalls == MOST_STALLS {
                let rest = cases[after + 1..]
                    .iter()
                    .map(|case| stalled(case, &Records::default()));
                read.endings.extend(rest);
            }
        } else if read.next_began {
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
            let limit_mb = memory_mb(&cases_to_run);
            let how = Death::before_the_start(status, &output.end, limit_mb);
            let Some(how) = how.filter(|_| worker.launcher.is_some()) else {
                return Err(GraderError::new(format!(
                    "the worker did not start ({status}): {}",
                    output.end.trim()
                )));
            };
            let rest = cases[first..].iter();
            read.endings
                .extend(rest.map(|_| Ending::Died { how, call: None }));
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
        times: &mut TaskTimes,
    ) -> Result<Finished, GraderError> {
        let program = &self.worker.program;
        let failed = |e| GraderError::file("start", program, e);
        // One pipe, so that the lines of stdout and stderr stay in their order.
        let (reader, stdout) = io::pipe().map_err(failed)?;
        let stderr = stdout.try_clone().map_err(failed)?;
        let (channel, stdin) = Channel::new(self.folder).map_err(failed)?;
        let environment = self.worker.environment.iter();
        let mut command = self.command(first);
        command
            // A backtrace shows the worker's functions, and floods the report.
            .env("RUST_BACKTRACE", "0")
            .envs(environment.map(|(name, value)| (name, value)))
            .arg(channel.records())
            .arg(first.to_string())
            .arg(memory_mb(self.cases).to_string())
            .args(write_calls.then_some("calls"))
            .args(self.is_sealed().then_some("sealed"))
            .current_dir(self.folder)
            .stdin(stdin)
            .stdout(stdout)
            .stderr(stderr);
        let (mut child, running) = child_processes::start(&mut command).map_err(failed)?;
        // It holds the other ends of the pipe and of the channel.
        drop(command);
        let has_ended = Arc::new(AtomicBool::new(false));
        let (tell, ended) = mpsc::channel();
        std::thread::scope(|scope| {
            let output = scope.spawn(|| {
                let output = printed::read(reader, self.cases);
                has_ended.store(true, Ordering::Release);
                output
            });
            scope.spawn(|| {
                let status = child.wait();
                // What the code started and left behind keeps the pipe and the channel open.
                running.kill();
                let _ = tell.send(status);
            });
            let (records, has_stalled) = self.receive(channel, first, &has_ended, times);
            if has_stalled || !records.is_in_order() {
                running.kill();
            }
            let status = ended.recv_timeout(ENDING).or_else(|_| {
                running.kill();
                ended.recv()
            });
            let status = status
                .map_err(io::Error::other)
                .flatten()
                .map_err(|e| GraderError::file("wait for", program, e));
            let output = output
                .join()
                .unwrap_or_else(|panic| std::panic::resume_unwind(panic));
            let status = status?;
            let launcher = self.worker.launcher.as_ref();
            Ok(Finished {
                status: launcher.map_or(status, |launcher| launcher.status_of_program(status)),
                output,
                records,
                has_stalled,
            })
        })
    }

    fn is_sealed(self) -> bool {
        let launcher = self.worker.launcher.as_ref();
        launcher.is_some_and(|launcher| launcher.seals())
    }

    /// The command that runs the worker, without its arguments.
    fn command(self, first: usize) -> Command {
        let program = &self.worker.program;
        let Some(launcher) = &self.worker.launcher else {
            return Command::new(program);
        };
        let limits = self.cases[first..]
            .iter()
            .map(|case| case.limit_ms)
            .fold(0, u64::saturating_add);
        launcher.worker(
            program,
            WorkerLimits {
                memory_mb: memory_mb(self.cases),
                cpu_seconds: (limits / 1000 * SPARE_CPU).saturating_add(SPARE_CPU_SECONDS),
            },
        )
    }

    /// Sends the cases and receives their records from number `first` on. Returns also whether the
    /// worker sent nothing in time.
    fn receive(
        self,
        channel: Channel,
        first: usize,
        has_ended: &Arc<AtomicBool>,
        times: &mut TaskTimes,
    ) -> (Records, bool) {
        let hides = self.is_sealed() && Channel::REPLIES;
        let (mut asked, hidden) = match hides {
            true => Asked::hide(self.cases),
            false => (Asked::none(self.cases), Vec::new()),
        };
        let to_send = if hides { &hidden } else { self.cases };
        let Ok(mut replies) = channel.send(to_send, asked.is_open()) else {
            // It has ended before it read them: its status says more.
            return (Records::default(), false);
        };
        let (mut frames, deadline) = channel.frames(has_ended);
        let mut is_over = false;
        let in_time = std::iter::from_fn(|| {
            deadline.set(match is_over {
                true => Duration::ZERO,
                false => SILENCE.min(times.left_of_all().unwrap_or(SILENCE)),
            });
            let frame = loop {
                match frames.next() {
                    Some(Ok(RecordFrame::Asking {
                        case,
                        call,
                        question,
                    })) => {
                        let reply = asked.reply(case, call, question);
                        let sent = reply.and_then(|reply| {
                            let out = replies.as_mut().ok_or("nobody replies")?;
                            write_reply(out, reply).map_err(|e| e.to_string())
                        });
                        if let Err(why) = sent {
                            break Some(Err(why));
                        }
                    }
                    Some(Ok(RecordFrame::Done(record))) => {
                        let checked = asked.check(&record);
                        break Some(checked.map(|()| RecordFrame::Done(record)));
                    }
                    frame => break frame,
                }
            };
            match &frame {
                Some(Ok(RecordFrame::Started { .. })) => times.start(),
                Some(Ok(RecordFrame::Spent { case, ms })) => {
                    if let Some(case) = self.cases.get(*case as usize) {
                        times.spend(case, Duration::from_millis(*ms));
                        is_over = times.is_over(case);
                    }
                }
                _ => {}
            }
            // Without an end that the case is to blame for.
            frame.filter(|frame| frame.is_ok() || !deadline.has_passed())
        });
        let mut records = records::read(in_time, self.cases, first);
        if let (Some(why), Some(last)) = (asked.why_changed(), records.endings.last_mut()) {
            *last = Ending::ChangedCounts(why.to_string());
        }
        let is_complete = first + records.endings.len() == self.cases.len();
        (records, !is_complete && deadline.has_passed())
    }

    /// Runs case number `case` again and returns the call in which it ends the worker; `None` if it
    /// does not end it again.
    fn call_that_ends(self, case: usize) -> Result<Option<u32>, GraderError> {
        let alone = Process {
            cases: &self.cases[..=case],
            ..self
        };
        let mut times = TaskTimes::until(self.worker.end());
        let records = alone.run(case, true, &mut times)?.records;
        Ok(records.call.filter(|_| records.next_began))
    }
}

/// A worker that has ended.
struct Finished {
    status: ExitStatus,
    output: WorkerOutput,
    records: Records,
    /// It sent nothing in time and was ended.
    has_stalled: bool,
}

/// The ending of a case whose worker did not even say that the time was over.
fn stalled(case: &Case, records: &Records) -> Ending {
    Ending::TimedOut {
        call: records.call.unwrap_or(0),
        limit_ms: case.limit_ms,
        waited: true,
    }
}

/// The memory that a worker for these cases may allocate, in megabytes.
pub(crate) fn memory_mb(cases: &[Case]) -> u32 {
    let is_timing = |case: &Case| matches!(case.work, Work::Timing(_) | Work::BuildGrowth(_));
    match cases.iter().any(is_timing) {
        true => TIMING_MEMORY_MB,
        false => MEMORY_MB,
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

#[cfg(all(test, unix))]
mod tests {
    use super::*;
    use std::os::unix::fs::PermissionsExt;

    /// Starts programs as they are, until the end.
    #[derive(Debug)]
    struct Until(Awake);

    impl Launcher for Until {
        fn cargo(&self) -> Command {
            Command::new("cargo")
        }

        fn worker(&self, program: &Path, _: WorkerLimits) -> Command {
            Command::new(program)
        }

        fn closes_files(&self) -> bool {
            false
        }

        fn seals(&self) -> bool {
            false
        }

        fn status_of_program(&self, status: ExitStatus) -> ExitStatus {
            status
        }

        fn end(&self) -> Option<Awake> {
            Some(self.0)
        }
    }

    /// The endings of `count` cases in a worker that is a shell script.
    fn endings(script: &str, count: usize) -> Result<Vec<Ending>, GraderError> {
        endings_until(None, script, count)
    }

    /// The same of a submission, which has `left`.
    fn endings_until(
        left: Option<Duration>,
        script: &str,
        count: usize,
    ) -> Result<Vec<Ending>, GraderError> {
        let folder = tempfile::tempdir().unwrap();
        let program = folder.path().join("worker");
        std::fs::write(&program, format!("#!/bin/sh\n{script}\n")).unwrap();
        std::fs::set_permissions(&program, std::fs::Permissions::from_mode(0o755)).unwrap();
        let case = Case {
            task: "part5.task1".into(),
            name: "a".into(),
            // Where the time of the submission is limited, no case ends before it, however slow
            // the machine is.
            limit_ms: left.map_or(10, |_| 3_600_000),
            work: Work::Stop(Vec::new()),
            order: Vec::new(),
        };
        let until = left.map(|left| Arc::new(Until(Awake::now() + left)) as Arc<dyn Launcher>);
        let worker = Worker {
            launcher: until,
            ..Worker::from(program)
        };
        Ok(run(&worker, &vec![case; count])?.endings)
    }

    /// What a worker writes when it begins the first case: the length of the frame, the key that it
    /// has read, the number of the frame, and the frame.
    const BEGINS: &str =
        r"head -c 16 > key; (printf '\2\0\0\0'; cat key; printf '\0\0\0\0\0\0\0\0\0\0') >&0";

    #[test]
    fn a_submission_that_waits_is_ended_with_all_its_cases() {
        let script = format!("{BEGINS}; exec sleep 1000");
        let ended = endings_until(Some(Duration::from_millis(500)), &script, 3).unwrap();
        assert_eq!(ended, vec![Ending::OutOfTime; 3]);
        // Without a limit, the same worker is only ended by the case.
        let begins = format!("{BEGINS}; exit 7");
        assert_eq!(endings(&begins, 1).unwrap(), [exits_with_7()]);
    }

    fn exits_with_7() -> Ending {
        Ending::Died {
            how: Death::Exit(7),
            call: None,
        }
    }

    #[test]
    fn nobody_waits_for_what_the_code_started_and_left_behind() {
        let script = format!("{BEGINS}; sleep 1000 <&0 & sleep 0.1; exit 7");
        assert_eq!(endings(&script, 1).unwrap(), [exits_with_7()]);
    }

    #[test]
    fn a_submission_that_is_too_large_to_start_fails_and_the_machine_does_not() {
        let most = Some(Duration::from_secs(600));
        let says = "cat > /dev/null; echo 'worker: cannot start a thread: no memory'; exit 2";
        let dies = Ending::Died {
            how: Death::TooLargeToStart { limit_mb: 1024 },
            call: None,
        };
        for script in ["cat > /dev/null; kill -SEGV $$", says] {
            assert_eq!(
                endings_until(most, script, 2).unwrap(),
                vec![dies.clone(); 2]
            );
            assert!(endings(script, 2).is_err());
        }
        let of_the_launcher = "cat > /dev/null; echo 'sandbox: no seccomp'; exit 125";
        assert!(endings_until(most, of_the_launcher, 2).is_err());
    }

    #[test]
    fn what_is_written_into_the_channel_without_the_key_fails_the_case() {
        let endings = endings(
            "cat > /dev/null; printf 'a record of thirty bytes and more' >&0",
            2,
        )
        .unwrap();
        let is_malformed = |ending: &Ending| matches!(ending, Ending::Malformed(why) if why.contains("something else than the worker"));
        assert_eq!(endings.len(), 2);
        assert!(endings.iter().all(is_malformed), "{endings:?}");
    }

    #[test]
    fn a_worker_that_says_nothing_did_not_start() {
        let why = endings("cat > /dev/null; echo out of order; exit 7", 1).unwrap_err();
        assert!(why.to_string().contains("did not start"), "{why}");
        assert!(why.to_string().contains("out of order"), "{why}");
    }

    #[test]
    #[ignore = "waits until a worker counts as stalled: two minutes"]
    fn a_worker_that_stops_itself_is_ended() {
        let endings = endings("kill -STOP $$", 1).unwrap();
        let late = Ending::TimedOut {
            call: 0,
            limit_ms: 10,
            waited: true,
        };
        assert_eq!(endings, [late]);
    }
}
