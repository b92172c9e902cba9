//! Draws whole numbers and orders for questions.

use kit::PixelSampler;

/// A sequence of numbers. It is the same for the same question and seed.
pub(crate) struct Draw(PixelSampler);

impl Draw {
    /// The numbers of `seed` for a question, which two numbers distinguish from others.
    pub(crate) fn of([x, y]: [u32; 2], seed: u64) -> Draw {
        Draw(PixelSampler::new(x, y, seed))
    }

    /// A whole number from 0 to `count - 1`.
    pub(crate) fn below(&mut self, count: usize) -> usize {
        let number = (self.0.get_sample().x * count as f64) as usize;
        number.min(count - 1)
    }

    /// A whole number from `low` to `high`.
    pub(crate) fn from(&mut self, low: i32, high: i32) -> i32 {
        low + self.below((high - low + 1) as usize) as i32
    }

    /// One of a list.
    pub(crate) fn one<T: Copy>(&mut self, list: &[T]) -> T {
        list[self.below(list.len())]
    }

    /// Puts a list in a random order, each with the same probability (Fisher and Yates).
    pub(crate) fn shuffle<T>(&mut self, list: &mut [T]) {
        for i in (1..list.len()).rev() {
            list.swap(i, self.below(i + 1));
        }
    }
}
