//! How long the picture of a moving view may take, so that the window keeps 60 frames a second.

use std::time::Duration;

/// The time budget of one traced picture.
///
/// A frame is more than its picture: the window's content is laid out, its textures are uploaded, and
/// without a graphics card the processor paints it, too. What all that takes differs between machines,
/// so the budget follows the measured frames: a late frame cuts it, frames in time let it grow slowly.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pace {
    budget: f64,
    /// The budget with which a frame was late; it is approached more slowly.
    late_at: f64,
}

/// 60 frames a second.
const FRAME: f64 = 1.0 / 60.0;
/// A frame that takes this many times as long is late.
const LATE: f64 = 1.08;
/// The smallest and the largest budget in seconds.
const BUDGETS: [f64; 2] = [0.0015, 0.013];
/// The budget at the start.
const FIRST: f64 = 0.006;
/// What a late frame leaves of the budget.
const CUT: f64 = 0.75;
/// What a frame in time adds, as a share; and near the budget with which a frame was late.
const GROWTH: [f64; 2] = [0.02, 0.001];
/// A frame after a longer time is the first one of a movement.
const PAUSE: f64 = 0.25;

impl Default for Pace {
    fn default() -> Pace {
        Pace {
            budget: FIRST,
            late_at: f64::INFINITY,
        }
    }
}

impl Pace {
    /// A frame of a moving view took this many seconds, from its start to the next one's.
    pub fn frame(&mut self, seconds: f64) {
        if seconds > PAUSE {
            return;
        }
        if seconds > LATE * FRAME {
            self.late_at = self.budget;
            // One frame can be late for another reason; a very late one says more.
            let excess = seconds - FRAME;
            let cut = (self.budget - excess).max(CUT * self.budget * CUT);
            self.budget = cut.min(CUT * self.budget);
        } else {
            let is_near = self.budget > 0.9 * self.late_at;
            self.budget *= 1.0 + GROWTH[usize::from(is_near)];
        }
        self.budget = self.budget.clamp(BUDGETS[0], BUDGETS[1]);
    }

    /// The time that a picture may take.
    pub fn budget(&self) -> Duration {
        Duration::from_secs_f64(self.budget)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The budgets of frames that take `other` seconds besides their picture.
    fn after(frames: usize, other: f64) -> (f64, usize) {
        let (mut pace, mut late) = (Pace::default(), 0);
        for _ in 0..frames {
            let seconds = (pace.budget + other).max(FRAME);
            late += usize::from(seconds > LATE * FRAME);
            pace.frame(seconds);
        }
        (pace.budget, late)
    }

    #[test]
    fn the_budget_is_what_the_rest_of_a_frame_leaves() {
        for other in [0.004, 0.008, 0.012] {
            let (budget, late) = after(600, other);
            assert!(budget + other < 1.1 * FRAME, "{other}: {budget}");
            assert!(budget + other > 0.6 * FRAME, "{other}: {budget}");
            assert!(late < 30, "{other}: {late} of 600 frames were late");
        }
    }

    #[test]
    fn a_slow_machine_still_gets_a_picture() {
        let (budget, _) = after(100, 0.05);
        assert_eq!(budget, BUDGETS[0]);
    }

    #[test]
    fn a_pause_is_no_late_frame() {
        let mut pace = Pace::default();
        pace.frame(2.0);
        assert_eq!(pace, Pace::default());
    }
}
