//! How far the loading of a scene is.
//!
//! A stage's `construct_bvh` is one call that says nothing until it returns, and so is the reader of
//! scene files. So within a step the share is an estimate from the time that such a step usually takes;
//! it grows until the step ends, and never goes back.

use std::sync::Mutex;
use std::time::{Duration, Instant};

/// A step of loading.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LoadStep {
    /// Reading a file of this many bytes.
    Reading {
        /// Its size.
        bytes: u64,
    },
    /// Building one of several trees over the scene's primitives.
    Tree {
        /// Which one, from 1.
        number: u32,
        /// How many there are.
        of: u32,
        /// The number of primitives.
        primitives: usize,
    },
}

/// The share of reading in the whole.
const READING: f64 = 0.5;
/// Bytes of a scene file that are read in a second, about.
const BYTES_PER_SECOND: f64 = 40e6;
/// Primitives that a tree is built over in a second, about.
const PRIMITIVES_PER_SECOND: f64 = 1e6;

/// The progress of loading, which the loading thread writes and the window reads.
#[derive(Debug, Default)]
pub struct LoadProgress(Mutex<Option<(LoadStep, Instant)>>);

impl LoadProgress {
    /// A step starts.
    pub fn start(&self, step: LoadStep) {
        *self.0.lock().expect("no thread panics here") = Some((step, Instant::now()));
    }

    /// The step that is running and the share of everything that is done, from 0 to 1.
    pub fn now(&self) -> Option<(LoadStep, f64)> {
        let (step, since) = (*self.0.lock().expect("no thread panics here"))?;
        Some((step, share(step, since.elapsed())))
    }
}

/// The share of everything that is done after this time in a step.
fn share(step: LoadStep, time: Duration) -> f64 {
    let (before, width, usual) = match step {
        LoadStep::Reading { bytes } => (0.0, READING, bytes as f64 / BYTES_PER_SECOND),
        LoadStep::Tree {
            number,
            of,
            primitives,
        } => {
            let width = (1.0 - READING) / f64::from(of.max(1));
            let before = READING + width * f64::from(number.saturating_sub(1));
            (before, width, primitives as f64 / PRIMITIVES_PER_SECOND)
        }
    };
    // Half of the step after half of its usual time, three quarters after all of it, and so on: a step
    // that takes longer still moves.
    let times = time.as_secs_f64() / usual.max(1e-3);
    before + width * (1.0 - 0.25_f64.powf(times))
}

impl std::fmt::Display for LoadStep {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            LoadStep::Reading { bytes } => {
                write!(f, "reading {:.1} MB", *bytes as f64 / 1e6)
            }
            LoadStep::Tree {
                number,
                of,
                primitives,
            } => write!(f, "tree {number} of {of} over {primitives} primitives"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_share_grows_from_step_to_step() {
        let tree = |number| LoadStep::Tree {
            number,
            of: 2,
            primitives: 1_000_000,
        };
        let reading = LoadStep::Reading { bytes: 40_000_000 };
        let mut last = -1.0;
        for step in [reading, tree(1), tree(2)] {
            for seconds in [0.0, 0.5, 1.0, 10.0] {
                let now = share(step, Duration::from_secs_f64(seconds));
                assert!(now > last && now <= 1.0, "{step}: {now} after {last}");
                last = now - 1e-9;
            }
        }
        assert!((share(reading, Duration::from_secs(1)) - 0.75 * READING).abs() < 1e-12);
    }
}
