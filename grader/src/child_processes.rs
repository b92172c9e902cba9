//! Starts the programs that the grader runs (cargo, workers, renderers) and ends them with it.

use std::io;
use std::process::{Child, Command, Output, Stdio};
use std::sync::Mutex;

/// The ids of the processes that are running.
static RUNNING_IDS: Mutex<Vec<u32>> = Mutex::new(Vec::new());

/// Marks a process as running. Dropping it removes the process from the list of running ones.
#[derive(Debug)]
pub struct RunningProcess(u32);

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

/// Ends all running programs and what they started.
pub fn terminate_all() {
    let running = RUNNING_IDS.lock().map(|running| running.clone());
    running.unwrap_or_default().into_iter().for_each(terminate);
}

/// Ends the process group `id`: a program and what it started.
fn terminate(id: u32) {
    // The standard library can only end single processes, and sending a signal takes unsafe code.
    let _ = Command::new("kill")
        .args(["-TERM", "--", &format!("-{id}")])
        .stderr(Stdio::null())
        .status();
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;
    use std::io::{BufRead, BufReader};
    use std::time::Duration;

    /// Longer than any machine needs to end two programs, and shorter than the program's sleep.
    const TIMEOUT: Duration = Duration::from_secs(60);

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
