//! What a run prints while it grades: how many units are done, and the time that is left.

use crate::plan::Planned;
use base::{err, errln};
use std::io::{self, IsTerminal, Write};
use std::sync::Mutex;
use std::time::{Duration, Instant};
use submission::Untrusted;

/// The progress of a run. On a terminal it is one line that changes; elsewhere one line for each
/// unit.
#[derive(Debug)]
pub struct Progress {
    state: Mutex<State>,
    units: usize,
    is_terminal: bool,
}

#[derive(Debug)]
struct State {
    done: usize,
    failed: usize,
    started: Instant,
    /// The length of the line on the terminal.
    shown: usize,
}

/// A line on a terminal is not longer than this.
const COLUMNS: usize = 79;

/// The name of a submission for a terminal: a file of any name may have been handed in.
fn shown(planned: &Planned) -> String {
    planned.name.line()
}

impl Progress {
    /// The progress of a run over so many units, which begins now.
    pub fn start(units: usize) -> Progress {
        Progress {
            state: Mutex::new(State {
                done: 0,
                failed: 0,
                started: Instant::now(),
                shown: 0,
            }),
            units,
            is_terminal: io::stderr().is_terminal(),
        }
    }

    /// A unit is done, or has failed for the last time.
    pub(crate) fn done(&self, planned: &Planned, failure: Option<&str>) {
        let Ok(mut state) = self.state.lock() else {
            return;
        };
        state.done += 1;
        if let Some(why) = failure {
            state.failed += 1;
            self.print_line(
                &mut state,
                &format!("{}: infrastructure: {why}", shown(planned)),
            );
        }
        let left = time_left(state.started.elapsed(), state.done, self.units);
        let graded = graded(state.done, state.failed, self.units);
        let line = format!("{graded}{left}: {}", shown(planned));
        match self.is_terminal {
            true => show(&mut state, &line),
            false => errln!("{line}"),
        }
        if state.done == self.units && self.is_terminal {
            errln!();
        }
    }

    /// A unit has failed and will be tried again.
    pub(crate) fn retry(&self, planned: &Planned, why: &str) {
        if let Ok(mut state) = self.state.lock() {
            let line = format!(
                "{}: infrastructure, will be tried again: {why}",
                shown(planned)
            );
            self.print_line(&mut state, &line);
        }
    }

    /// The number of units that failed.
    pub fn failed(&self) -> usize {
        self.state.lock().map_or(0, |state| state.failed)
    }

    /// Prints a line that may quote what was handed in, such as the name of a file.
    fn print_line(&self, state: &mut State, line: &str) {
        if self.is_terminal {
            show(state, "");
            err!("\r");
        }
        errln!("{}", Untrusted::from(line).lines());
    }
}

/// How many of the `done` units were graded.
fn graded(done: usize, failed: usize, units: usize) -> String {
    match failed {
        0 => format!("{done} of {units} graded"),
        _ => format!("{} of {units} graded, {failed} failed", done - failed),
    }
}

/// Replaces the line on the terminal.
fn show(state: &mut State, line: &str) {
    let line: String = line
        .chars()
        .filter(|c| !c.is_control())
        .take(COLUMNS)
        .collect();
    let length = line.chars().count();
    err!("\r{line}{}", " ".repeat(state.shown.saturating_sub(length)));
    let _ = io::stderr().flush();
    state.shown = length;
}

/// The time left, from the mean of the units so far; nothing after the last one.
fn time_left(elapsed: Duration, done: usize, units: usize) -> String {
    let left = elapsed.as_secs_f64() / done as f64 * units.saturating_sub(done) as f64;
    match left.round() as u64 {
        _ if done >= units => String::new(),
        seconds @ 0..=99 => format!(", about {seconds} s left"),
        seconds @ 100..=7199 => format!(", about {} min left", seconds.div_ceil(60)),
        seconds => format!(", about {:.1} h left", seconds as f64 / 3600.0),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_failed_is_not_graded() {
        assert_eq!(graded(3, 0, 4), "3 of 4 graded");
        assert_eq!(graded(3, 2, 4), "1 of 4 graded, 2 failed");
    }

    #[test]
    fn the_time_left_follows_the_mean() {
        let left = |seconds, done, units| time_left(Duration::from_secs(seconds), done, units);
        assert_eq!(left(10, 1, 4), ", about 30 s left");
        assert_eq!(left(60, 10, 100), ", about 9 min left");
        assert_eq!(left(3600, 10, 100), ", about 9.0 h left");
        assert_eq!(left(60, 4, 4), "");
    }
}
