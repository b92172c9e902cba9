//! How slow the machine is now: a fixed piece of work, timed in turns with the student's code.
//!
//! A limit in seconds would end code on a slow machine that is within it on a fast one. So the
//! limits hold for a machine of known speed, and grow with the time that this work takes. It reads
//! memory as a walk through a tree does, since others may use the caches and the memory, too.

use crate::clock;
use std::hint::black_box;
use std::time::Duration;

/// How many numbers are read from: 2 MB.
const LENGTH: u32 = 1 << 19;

/// How many reads are one round.
const READS: u32 = 4096;

/// The processor time of a round on the machine whose seconds the limits are.
const ROUND: Duration = Duration::from_micros(400);

/// The limits grow by this at most.
const MOST: f64 = 100.0;

/// The work. A round goes on where the last one ended.
pub(crate) struct Control {
    /// Each number is the place of the next, and all of them are one cycle.
    next: Vec<u32>,
    place: u32,
}

impl Control {
    /// Writes the list.
    pub(crate) fn new() -> Control {
        // Hull and Dobell, "Random number generators", 1962: such a sequence has the full period.
        let after = |place: u32| place.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        Control {
            next: (0..LENGTH).map(|place| after(place) % LENGTH).collect(),
            place: 0,
        }
    }

    /// The processor time of a round.
    pub(crate) fn round(&mut self) -> Duration {
        let before = clock::time_of_this_thread();
        for _ in 0..READS {
            self.place = self.next.get(self.place as usize).copied().unwrap_or(0);
        }
        black_box(self.place);
        clock::time_of_this_thread().saturating_sub(before)
    }
}

/// The rounds that were timed beside a case.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Rounds {
    pub(crate) count: u32,
    taken: Duration,
}

impl Rounds {
    /// Adds a round that took so long.
    pub(crate) fn add(&mut self, taken: Duration) {
        self.count += 1;
        self.taken += taken;
    }

    /// How many times longer than [`ROUND`] they took on the mean; 1 on a faster machine.
    pub(crate) fn slowness(self) -> f64 {
        let usual = ROUND * self.count.max(1);
        (self.taken.as_secs_f64() / usual.as_secs_f64()).clamp(1.0, MOST)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_work_is_one_cycle() {
        let control = Control::new();
        let places = std::iter::successors(Some(0), |at| Some(control.next[*at as usize]));
        let length = places.skip(1).position(|at| at == 0).unwrap() + 1;
        assert_eq!(length as u32, LENGTH);
    }

    #[test]
    fn limits_grow_on_a_slow_machine_and_do_not_shrink_on_a_fast_one() {
        let of = |rounds: &[Duration]| {
            let mut sum = Rounds::default();
            rounds.iter().for_each(|taken| sum.add(*taken));
            sum.slowness()
        };
        assert_eq!(of(&[]), 1.0);
        assert_eq!(of(&[ROUND / 4; 3]), 1.0);
        assert_eq!(of(&[10 * ROUND; 5]), 10.0);
        assert_eq!(of(&[ROUND, 3 * ROUND]), 2.0);
        assert_eq!(of(&[1000 * ROUND]), MOST);
    }
}
