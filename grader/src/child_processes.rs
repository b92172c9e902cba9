//! Programs that the grader runs: cargo, workers, renderers. None outlives it.

use std::io;
use std::process::{Child, Command, Output, Stdio};
use std::sync::Mutex;

/// Process ids of the programs that are running.
static RUNNING: Mutex<Vec<u32>> = Mutex::new(Vec::new());

/// Stands for a program that is running. When it is dropped the program is taken for ended.
#[derive(Debug)]
pub struct Running(u32);

impl Drop for Running {
    fn drop(&mut self) {
        if let Ok(mut running) = RUNNING.lock() {
            running.retain(|id| *id != self.0);
        }
    }
}

/// Starts a program that ends with the grader, and so does what it starts itself, such as a compiler. Keep the second
/// value until it has ended.
pub fn start(command: &mut Command) -> io::Result<(Child, Running)> {
    // A process group of its own can be ended as a whole. So Ctrl-C does not reach it but through the grader.
    #[cfg(unix)]
    std::os::unix::process::CommandExt::process_group(command, 0);
    let child = command.spawn()?;
    if let Ok(mut running) = RUNNING.lock() {
        running.push(child.id());
    }
    let running = Running(child.id());
    Ok((child, running))
}

/// Runs a program to its end, with nothing to read, and gives what it writes.
pub fn output(command: &mut Command) -> io::Result<Output> {
    command
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped());
    let (child, _running) = start(command)?;
    child.wait_with_output()
}

/// Ends all that is running.
pub fn end_all() {
    let running = RUNNING.lock().map(|running| running.clone());
    running.unwrap_or_default().into_iter().for_each(end);
}

/// Ends the program `id` and what it started.
fn end(id: u32) {
    // The standard library ends single processes only, and sending a signal by hand takes unsafe code.
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

    /// Longer than any machine takes to end two programs, shorter than the program sleeps.
    const PATIENCE: Duration = Duration::from_secs(60);

    #[test]
    fn a_program_ends_with_what_it_started() {
        let mut shell = Command::new("sh");
        shell
            .args(["-c", "sleep 1000 & echo started; wait"])
            .stdout(Stdio::piped());
        let (mut child, _running) = start(&mut shell).unwrap();
        let mut stdout = BufReader::new(child.stdout.take().unwrap());
        stdout.read_line(&mut String::new()).unwrap();
        end(child.id());
        assert!(!child.wait().unwrap().success());
        // The pipe ends when the sleeper, which has its other end too, has ended.
        let (sender, ended) = std::sync::mpsc::channel();
        std::thread::spawn(move || sender.send(stdout.read_line(&mut String::new())));
        assert_eq!(ended.recv_timeout(PATIENCE).unwrap().unwrap(), 0);
    }

    #[test]
    fn what_has_ended_is_forgotten() {
        let id = {
            let (mut child, _running) = start(&mut Command::new("true")).unwrap();
            assert!(RUNNING.lock().unwrap().contains(&child.id()));
            child.wait().unwrap();
            child.id()
        };
        assert!(!RUNNING.lock().unwrap().contains(&id));
    }
}
