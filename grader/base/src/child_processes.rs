//! Starts the programs that the grader runs (cargo, workers, renderers) and ends them with it.

use std::ffi::OsString;
use std::io::{self, Read};
use std::process::{Child, Command, ExitStatus, Output, Stdio};
use std::sync::Mutex;
use std::sync::mpsc::{self, RecvTimeoutError, Sender};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

/// The ids of the processes that are running.
static RUNNING_IDS: Mutex<Vec<u32>> = Mutex::new(Vec::new());

/// Marks a process as running. Dropping it removes the process from the list of running ones.
#[derive(Debug)]
pub struct RunningProcess(u32);

/// How many bytes of a program's output [`tail`] keeps.
const TAIL_BYTES: usize = 4096;

/// The time between two looks at a process that is ending.
const POLL: Duration = Duration::from_millis(2);

impl RunningProcess {
    /// Ends the process and what it started, at once. Nothing can prevent it.
    pub fn kill(&self) {
        signal(self.0, "KILL");
    }

    /// Waits until `child`, which is this process, has ended. Kills it after `most`.
    pub fn wait(&self, child: &mut Child, most: Duration) -> io::Result<ExitStatus> {
        let started = Instant::now();
        while started.elapsed() < most {
            if let Some(status) = child.try_wait()? {
                return Ok(status);
            }
            std::thread::sleep(POLL);
        }
        self.kill();
        child.wait()
    }
}

/// Kills a process and what it started when it takes too long.
#[derive(Debug)]
pub struct Watchdog {
    stop: Sender<()>,
    has_killed: JoinHandle<bool>,
}

impl Watchdog {
    /// Watches a process, which may run for `most` from now on.
    pub fn start(process: &RunningProcess, most: Duration) -> Watchdog {
        let (stop, stopped) = mpsc::channel();
        let id = process.0;
        let has_killed = std::thread::spawn(move || {
            let late = stopped.recv_timeout(most) == Err(RecvTimeoutError::Timeout);
            if late {
                signal(id, "KILL");
            }
            late
        });
        Watchdog { stop, has_killed }
    }

    /// Stops watching. Returns whether the process was killed. Call it before the process is waited
    /// for: afterwards its id may be another one's.
    pub fn stop(self) -> bool {
        drop(self.stop);
        self.has_killed.join().unwrap_or(false)
    }
}

impl Drop for RunningProcess {
    fn drop(&mut self) {
        if let Ok(mut running) = RUNNING_IDS.lock() {
            running.retain(|id| *id != self.0);
        }
    }
}

/// Starts a program in a process group of its own. If the grader is interrupted, it ends the whole
/// group: the program and what the program started, such as a compiler.
///
/// Keep the second value until the program has ended.
pub fn start(command: &mut Command) -> io::Result<(Child, RunningProcess)> {
    // The terminal sends Ctrl-C to the grader's own group only: the grader ends this one itself.
    #[cfg(unix)]
    std::os::unix::process::CommandExt::process_group(command, 0);
    let child = command.spawn()?;
    if let Ok(mut running) = RUNNING_IDS.lock() {
        running.push(child.id());
    }
    let running = RunningProcess(child.id());
    Ok((child, running))
}

/// Runs a program to its end with an empty standard input and returns its output.
pub fn output(command: &mut Command) -> io::Result<Output> {
    command
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped());
    let (child, _running) = start(command)?;
    child.wait_with_output()
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

/// The cargo that runs the grader, or else the one on the path.
pub fn cargo() -> OsString {
    std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into())
}

/// Ends all running programs and what they started.
pub fn terminate_all() {
    let running = RUNNING_IDS.lock().map(|running| running.clone());
    running.unwrap_or_default().into_iter().for_each(terminate);
}

/// Asks the process group `id` to end: a program and what it started.
fn terminate(id: u32) {
    signal(id, "TERM");
}

/// Sends a signal to the process group `id`.
fn signal(id: u32, name: &str) {
    // The standard library can only end single processes, and sending a signal takes unsafe code.
    // Not every machine has a program `kill`, but every shell has the command.
    let _ = Command::new("sh")
        .args([
            "-c",
            "kill -s \"$1\" -- \"-$2\"",
            "sh",
            name,
            &id.to_string(),
        ])
        .stderr(Stdio::null())
        .status();
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;
    use std::io::{BufRead, BufReader};
    use std::time::Duration;

    /// Longer than any machine needs to end two programs, and shorter than the program's sleep.
    const TIMEOUT: Duration = Duration::from_secs(900);

    #[test]
    fn terminating_a_program_also_ends_its_children() {
        let mut shell = Command::new("sh");
        shell
            .args(["-c", "sleep 1000 & echo started; wait"])
            .stdout(Stdio::piped());
        let (mut child, _running) = start(&mut shell).unwrap();
        let mut stdout = BufReader::new(child.stdout.take().unwrap());
        stdout.read_line(&mut String::new()).unwrap();
        terminate(child.id());
        assert!(!child.wait().unwrap().success());
        // `sleep` holds the write end of the pipe, so the pipe closes only when `sleep` has ended.
        let (sender, ended) = std::sync::mpsc::channel();
        std::thread::spawn(move || sender.send(stdout.read_line(&mut String::new())));
        assert_eq!(ended.recv_timeout(TIMEOUT).unwrap().unwrap(), 0);
    }

    #[test]
    fn a_program_that_takes_too_long_is_killed_with_its_children() {
        let mut shell = Command::new("sh");
        // It ignores requests to end.
        shell
            .args(["-c", "trap '' TERM; sleep 1000 & echo started; wait"])
            .stdout(Stdio::piped());
        let (mut child, running) = start(&mut shell).unwrap();
        let mut stdout = BufReader::new(child.stdout.take().unwrap());
        stdout.read_line(&mut String::new()).unwrap();
        let watchdog = Watchdog::start(&running, Duration::from_millis(1));
        // The pipe closes when `sleep` has ended, too.
        assert_eq!(stdout.read_line(&mut String::new()).unwrap(), 0);
        assert!(watchdog.stop());
        assert!(!running.wait(&mut child, TIMEOUT).unwrap().success());

        let (mut child, running) = start(Command::new("sleep").arg("1000")).unwrap();
        let status = running.wait(&mut child, Duration::from_millis(1));
        assert!(!status.unwrap().success());
    }

    #[test]
    fn a_program_that_ends_in_time_is_not_killed() {
        let (mut child, running) = start(&mut Command::new("true")).unwrap();
        let watchdog = Watchdog::start(&running, TIMEOUT);
        assert!(!watchdog.stop());
        assert!(running.wait(&mut child, TIMEOUT).unwrap().success());
    }

    #[test]
    fn a_program_that_ended_is_removed_from_the_list() {
        let id = {
            let (mut child, _running) = start(&mut Command::new("true")).unwrap();
            assert!(RUNNING_IDS.lock().unwrap().contains(&child.id()));
            child.wait().unwrap();
            child.id()
        };
        assert!(!RUNNING_IDS.lock().unwrap().contains(&id));
    }
}
