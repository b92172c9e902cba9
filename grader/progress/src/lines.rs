//! Progress as lines of text, for files and pipes.

use std::time::{Duration, Instant};

/// The least time between two lines.
const BETWEEN: Duration = Duration::from_secs(15);

/// The lines of one stage.
#[derive(Debug)]
pub(crate) struct Lines {
    pub(crate) title: String,
    pub(crate) steps: u64,
    done: u64,
    start: Instant,
    /// When the last line was printed.
    last: Instant,
}

impl Lines {
    pub(crate) fn new(title: String, now: Instant) -> Lines {
        Lines {
            title,
            steps: 0,
            done: 0,
            start: now,
            last: now,
        }
    }

    /// Counts steps. Returns a line if it is time for one.
    pub(crate) fn advance(&mut self, steps: u64, now: Instant) -> Option<String> {
        self.done += steps;
        let is_last = self.done >= self.steps;
        if is_last || now.duration_since(self.last) < BETWEEN {
            return None;
        }
        self.last = now;
        let spent = now.duration_since(self.start).as_secs_f64();
        let left = spent / self.done as f64 * (self.steps - self.done) as f64;
        let left = match left {
            left if left < 90.0 => format!("{left:.0} s"),
            left => format!("{:.0} min", left / 60.0),
        };
        let Lines {
            title, done, steps, ..
        } = self;
        Some(format!("{title}: {done} of {steps}, about {left} left"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_come_seldom_and_say_what_is_left() {
        let start = Instant::now();
        let after = |seconds| start + Duration::from_secs(seconds);
        let mut lines = Lines::new("cost 1/2: triangle".to_owned(), start);
        lines.steps = 40;
        assert_eq!(lines.advance(1, after(1)), None);
        assert_eq!(
            lines.advance(9, after(20)).as_deref(),
            Some("cost 1/2: triangle: 10 of 40, about 60 s left")
        );
        assert_eq!(lines.advance(1, after(30)), None);
        assert_eq!(
            lines.advance(1, after(600)).as_deref(),
            Some("cost 1/2: triangle: 12 of 40, about 23 min left")
        );
        // The results follow.
        assert_eq!(lines.advance(28, after(700)), None);
    }
}
