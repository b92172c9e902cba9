//! How far a long command is, on stderr: a bar on a terminal, plain lines elsewhere.
//!
//! The program calls [`start`] and keeps the [`Command`]. Wherever the work is done, [`stage`]
//! begins a part of it, [`expect`] adds to the number of its steps and [`advance`] counts those
//! that are done; without a command they do nothing, as in tests. Before results are printed,
//! [`pause`] removes the bar. It is gone at the end and after Ctrl-C.
//!
//! [`bar`] is the bar alone, for a program that counts by itself.

mod lines;

use base::{errln, interrupt};
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use lines::Lines;
use std::io::{IsTerminal, stderr};
use std::sync::{Mutex, Once};
use std::time::{Duration, Instant};

/// How often a bar is drawn if nothing happens: its time goes on.
const TICK: Duration = Duration::from_millis(200);

/// A command in progress. Dropping it removes its bar.
#[derive(Debug)]
pub struct Command(());

impl Drop for Command {
    fn drop(&mut self) {
        with_running(|running| {
            if let Some(Running { bar, .. }) = running.take() {
                bar.finish_and_clear();
            }
        });
    }
}

/// The command in progress and its stage.
#[derive(Debug)]
struct Running {
    title: String,
    stages: usize,
    /// The number of the stage in progress, from 1.
    number: usize,
    bar: ProgressBar,
    /// Where there is no terminal.
    lines: Option<Lines>,
}

static RUNNING: Mutex<Option<Running>> = Mutex::new(None);

fn with_running<T>(change: impl FnOnce(&mut Option<Running>) -> T) -> T {
    let mut running = RUNNING.lock().unwrap_or_else(|broken| broken.into_inner());
    change(&mut running)
}

/// Starts to show the progress of a command with `stages` stages.
pub fn start(title: &str, stages: usize) -> Command {
    clear_on_interrupt();
    with_running(|running| {
        *running = Some(Running {
            title: title.to_owned(),
            stages,
            number: 0,
            bar: ProgressBar::hidden(),
            lines: None,
        });
    });
    Command(())
}

/// Begins the next stage of the command, which has no steps until [`expect`] adds some.
pub fn stage(name: &str) {
    with_running(|running| {
        let Some(running) = running else { return };
        running.bar.finish_and_clear();
        running.number += 1;
        let place = match running.stages {
            0 | 1 => running.title.clone(),
            stages => format!("{} {}/{stages}", running.title, running.number),
        };
        if stderr().is_terminal() {
            running.bar = bar(&format!("{place}: {name}"), 0);
        } else {
            let lines = Lines::new(format!("{place}: {name}"), Instant::now());
            errln!("{}", lines.title);
            running.lines = Some(lines);
        }
    });
}

/// Adds `steps` to the number of steps that the stage has.
pub fn expect(steps: u64) {
    with_running(|running| {
        let Some(running) = running else { return };
        if let Some(lines) = &mut running.lines {
            lines.steps += steps;
        }
        let known = running.bar.length().unwrap_or(0);
        if known == 0 {
            running.bar.set_style(style(BAR));
            running.bar.reset_eta();
        }
        running.bar.set_length(known + steps);
    });
}

/// Removes the bar until the next stage, so that results can be printed.
pub fn pause() {
    with_running(|running| {
        if let Some(running) = running {
            running.bar.finish_and_clear();
        }
    });
}

/// Counts `steps` steps of the stage as done.
pub fn advance(steps: u64) {
    with_running(|running| {
        let Some(running) = running else { return };
        running.bar.inc(steps);
        if let Some(line) = running
            .lines
            .as_mut()
            .and_then(|lines| lines.advance(steps, Instant::now()))
        {
            errln!("{line}");
        }
    });
}

/// A bar for `steps` steps on stderr, with a message after it and the time that is left; hidden
/// where stderr is no terminal. With 0 steps it only shows that the program works.
pub fn bar(title: &str, steps: u64) -> ProgressBar {
    if !stderr().is_terminal() {
        return ProgressBar::hidden();
    }
    clear_on_interrupt();
    let (template, length) = match steps {
        0 => (WITHOUT_STEPS, None),
        _ => (BAR, Some(steps)),
    };
    let bar = ProgressBar::with_draw_target(length, ProgressDrawTarget::stderr());
    bar.set_style(style(template));
    bar.set_prefix(title.to_owned());
    bar.enable_steady_tick(TICK);
    ALL.lock()
        .unwrap_or_else(|broken| broken.into_inner())
        .push(bar.clone());
    bar
}

/// What is shown of a stage with steps, and without.
const BAR: &str = "{prefix} {bar:30} {percent:>3}%  {msg}about {eta} left";
const WITHOUT_STEPS: &str = "{prefix}  {elapsed}";

fn style(template: &str) -> ProgressStyle {
    ProgressStyle::with_template(template).expect("the template is valid")
}

/// All bars, to remove them on Ctrl-C.
static ALL: Mutex<Vec<ProgressBar>> = Mutex::new(Vec::new());

/// Removes all bars. A program that handles Ctrl-C itself calls this before it ends.
pub fn clear() {
    // Another thread may hold the lock at the moment: then its bar is the one that stays.
    if let Ok(bars) = ALL.try_lock() {
        for bar in bars.iter().filter(|bar| !bar.is_finished()) {
            bar.finish_and_clear();
        }
    }
}

fn clear_on_interrupt() {
    static ONCE: Once = Once::new();
    ONCE.call_once(|| interrupt::at_interrupt(clear));
}
