//! A progress bar, if stderr is a terminal.

use indicatif::ProgressBar;
use pathtracer::TileDone;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

/// The progress of the rendering and the rate of rays.
pub(crate) struct Progress {
    bar: ProgressBar,
    start: Instant,
    rays: AtomicU64,
}

impl Progress {
    /// A bar for `samples` samples of all pixels together.
    pub(crate) fn new(samples: u64) -> Progress {
        Progress {
            bar: ::progress::bar("Rendering", samples),
            start: Instant::now(),
            rays: AtomicU64::new(0),
        }
    }

    /// The time since the start.
    pub(crate) fn elapsed(&self) -> Duration {
        self.start.elapsed()
    }

    /// Restarts the bar for another round of passes. Rays keep counting.
    pub(crate) fn next_round(&self) {
        self.bar.set_position(0);
    }

    /// Adds a finished tile.
    pub(crate) fn tile_done(&self, TileDone { samples, rays }: TileDone) {
        let rays = self.rays.fetch_add(rays, Ordering::Relaxed) + rays;
        self.bar.inc(samples);
        if !self.bar.is_hidden() {
            let seconds = self.start.elapsed().as_secs_f64().max(1e-9);
            let rate = rays as f64 / seconds / 1e6;
            self.bar.set_message(format!("{rate:.1} Mrays/s, "));
        }
    }

    /// Removes the bar from the terminal.
    pub(crate) fn finish(&self) {
        self.bar.finish_and_clear();
    }
}
