//! A bar on a terminal; nothing where the output is kept in a file or a pipe.

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use kit::film::Cell;
use std::io::{IsTerminal, stderr};
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

/// How far the rendering is, and how fast.
pub(crate) struct Progress {
    bar: ProgressBar,
    start: Instant,
    rays: AtomicU64,
}

impl Progress {
    /// A bar that counts to `pixels`.
    pub(crate) fn new(pixels: u64) -> Progress {
        Progress {
            bar: bar(pixels),
            start: Instant::now(),
            rays: AtomicU64::new(0),
        }
    }

    /// Starts again, with the rays so far.
    pub(crate) fn next_round(&self) {
        self.bar.set_position(0);
    }

    /// A tile is done, which took so many rays.
    pub(crate) fn tile_done(&self, tile: Cell, rays: u64) {
        let rays = self.rays.fetch_add(rays, Ordering::Relaxed) + rays;
        self.bar.inc(tile.area());
        if !self.bar.is_hidden() {
            let seconds = self.start.elapsed().as_secs_f64().max(1e-9);
            let rate = rays as f64 / seconds / 1e6;
            self.bar.set_message(format!("{rate:.1} Mrays/s"));
        }
    }

    /// Takes the bar off the terminal.
    pub(crate) fn finish(&self) {
        self.bar.finish_and_clear();
    }
}

fn bar(pixels: u64) -> ProgressBar {
    if !stderr().is_terminal() {
        return ProgressBar::hidden();
    }
    let template = "Rendering {bar:40} {percent:>3}%  {msg}  {eta} left";
    let style = ProgressStyle::with_template(template).expect("the template is right");
    let bar = ProgressBar::with_draw_target(Some(pixels), ProgressDrawTarget::stderr());
    bar.set_style(style);
    bar.enable_steady_tick(Duration::from_millis(200));
    bar
}
