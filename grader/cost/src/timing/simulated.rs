//! A machine whose time, cache and speed are simulated, for tests.

use super::{Clock, Contender};
use std::cell::Cell;

/// A machine that runs one piece of work at a time. Work on data that the piece before did not use
/// finds a cold cache and takes longer.
#[derive(Default)]
pub(crate) struct Machine {
    now: Cell<f64>,
    cached: Cell<Option<&'static str>>,
    /// By how much the machine becomes slower in a second, relative to its speed at the start.
    slowdown_per_s: f64,
}

/// Factor of the time on data that is not in the cache.
const COLD: f64 = 1.8;

impl Clock for Machine {
    fn seconds(&self) -> f64 {
        self.now.get()
    }
}

impl Machine {
    /// A machine whose work takes longer by this share of its first time in each second.
    pub(crate) fn that_slows_down(slowdown_per_s: f64) -> Machine {
        Machine {
            slowdown_per_s,
            ..Machine::default()
        }
    }

    /// Runs work on `data` that takes `seconds` with a warm cache at the machine's first speed.
    pub(crate) fn run(&self, data: &'static str, seconds: f64) {
        let is_warm = self.cached.replace(Some(data)) == Some(data);
        let cache = if is_warm { 1.0 } else { COLD };
        let speed = 1.0 + self.slowdown_per_s * self.now.get();
        self.now.set(self.now.get() + seconds * cache * speed);
    }

    /// Work of one unit in this process.
    pub(crate) fn here(&self, data: &'static str, seconds: f64) -> Contender<'_> {
        Contender::here(1, move |_| self.run(data, seconds))
    }

    /// Work of one unit in a process of its own, which warms its cache.
    pub(crate) fn elsewhere(&self, data: &'static str, seconds: f64) -> Contender<'_> {
        Contender::elsewhere(move |_| {
            self.run(data, seconds);
            let started = self.seconds();
            self.run(data, seconds);
            Ok(self.seconds() - started)
        })
    }
}
