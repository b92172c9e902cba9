//! A progress bar, if stderr is a terminal.

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use kit::film::Cell;
use std::io::{IsTerminal, stderr};
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

/// The progress of the rendering and the rate of rays.
pub(crate) struct Progress {
    bar: ProgressBar,
    start: Instant,
    rays: AtomicU64,
}

impl Progress {
    /// A bar for `pixels` pixels.
    pub(crate) fn new(pixels: u64) -> Progress {
        Progress {
            bar: bar(pixels),
            start: Instant::now(),
            rays: AtomicU64::new(0),
        }
    }

    /// Restarts the bar for the next pass. Rays keep counting.
    pub(crate) fn next_pass(&self) {
        self.bar.set_position(0);
    }

    /// Adds a finished tile, for which `rays` rays were traced.
    pub(crate) fn tile_done(&self, tile: Cell, rays: u64) {
        let rays = self.rays.fetch_add(rays, Ordering::Relaxed) + rays;
        self.bar.inc(tile.area());
        if !self.bar.is_hidden() {
            let seconds = self.start.elapsed().as_secs_f64().max(1e-9);
            let rate = rays as f64 / seconds / 1e6;
            self.bar.set_message(format!("{rate:.1} Mrays/s"));
        }
    }

    /// Removes the bar from the terminal.
    pub(crate) fn finish(&self) {
        self.bar.finish_and_clear();
    }
}

fn bar(pixels: u64) -> ProgressBar {
    if !stderr().is_terminal() {
        return ProgressBar::hidden();
    }
    let template = "Rendering {bar:40} {percent:>3}%  {msg}  {eta} left";
    let style = ProgressStyle::with_template(template).expect("the template is valid");
    let bar = ProgressBar::with_draw_target(Some(pixels), ProgressDrawTarget::stderr());
    bar.set_style(style);
    bar.enable_steady_tick(Duration::from_millis(200));
    bar
}
