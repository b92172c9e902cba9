//! Measures the frames of an orbit in a real window.

use crate::command::Command;
use crate::session::{Mode, Session};
use kit::Vec2;
use std::fmt;
use std::time::{Duration, Instant};

/// An orbit whose frames are measured.
#[derive(Debug)]
pub struct OrbitBench {
    /// Frames that are still to come.
    left: usize,
    /// When the last frame started.
    last: Option<Instant>,
    frames: Vec<BenchFrame>,
}

/// One frame.
#[derive(Clone, Copy, Debug)]
struct BenchFrame {
    /// From the start of the frame to that of the next one.
    whole: Duration,
    /// The window's content: layout, and waiting for the traced picture.
    content: Duration,
    /// Traced pixels, and those of the view.
    pixels: (u32, u32),
}

/// Frames before the measurement: textures are made, the resolution finds its level.
const WARM_UP: usize = 30;

/// The share of the view's height that each frame rotates by.
const STEP: f64 = 0.004;

impl OrbitBench {
    /// A measurement of `frames` frames.
    pub fn new(frames: usize) -> OrbitBench {
        OrbitBench {
            left: frames + WARM_UP,
            last: None,
            frames: Vec::new(),
        }
    }

    /// A frame starts, and the one before took `content` for the window's content. Rotates the view.
    /// Returns whether the measurement is over.
    pub fn next(&mut self, session: &mut Session, content: Duration) -> bool {
        let Some(scene) = session.scene().cloned() else {
            return false;
        };
        if session.loading().is_some() || session.topology().is_none() {
            return false;
        }
        let now = Instant::now();
        if let (Some(last), Some(picture)) = (self.last, session.view.picture(&scene)) {
            let of_view = picture.request.size;
            self.frames.push(BenchFrame {
                whole: now - last,
                content,
                pixels: (picture.size.0 * picture.size.1, of_view.0 * of_view.1),
            });
            self.left = self.left.saturating_sub(1);
        }
        self.last = Some(now);
        if session.mode() == Mode::Edit {
            session.apply(Command::Orbit(Vec2::new(STEP, 0.0)));
        }
        self.left == 0
    }
}

impl fmt::Display for OrbitBench {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let frames = self.frames.get(WARM_UP..).unwrap_or_default();
        let count = frames.len().max(1);
        let sorted = |of: fn(&BenchFrame) -> Duration| {
            let mut times: Vec<f64> = frames.iter().map(|f| of(f).as_secs_f64() * 1e3).collect();
            times.sort_by(f64::total_cmp);
            times
        };
        let at = |times: &[f64], share: f64| {
            let last = times.len().saturating_sub(1);
            let i = (share * last as f64).round() as usize;
            times.get(i).copied().unwrap_or(0.0)
        };
        let whole = sorted(|frame| frame.whole);
        let content = sorted(|frame| frame.content);
        let rest = sorted(|frame| frame.whole.saturating_sub(frame.content));
        let seconds = whole.iter().sum::<f64>() / 1e3;
        let in_time = whole.iter().filter(|ms| **ms <= 1000.0 / 60.0).count();
        let share = |f: &BenchFrame| f64::from(f.pixels.0) / f64::from(f.pixels.1.max(1));
        let traced = frames.iter().map(share).sum::<f64>() / count as f64;
        writeln!(
            f,
            "{} frames in {seconds:.2} s: {:.1} frames/s; {in_time} within 16.7 ms",
            frames.len(),
            count as f64 / seconds
        )?;
        for (name, times) in [
            ("frame", &whole),
            ("content, with the traced picture", &content),
            ("painting and upload", &rest),
        ] {
            let [p50, p90, p99] = [0.5, 0.9, 0.99].map(|share| at(times, share));
            writeln!(
                f,
                "{name}: median {p50:.1} ms, 90 % {p90:.1} ms, 99 % {p99:.1} ms"
            )?;
        }
        write!(f, "traced: {:.1} % of the pixels", 100.0 * traced)
    }
}
