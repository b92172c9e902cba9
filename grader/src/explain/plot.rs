//! A plot of characters.

use crate::report::wrap::one_line;

/// Columns of a plot.
pub(super) const WIDTH: usize = 60;

/// Lines of a plot. A character is about twice as high as it is wide.
pub(super) const HEIGHT: usize = 16;

/// A plot of the rectangle from `min` to `max`, the second coordinate upward.
pub(super) struct Plot {
    min: [f64; 2],
    max: [f64; 2],
    cells: Vec<[char; WIDTH]>,
}

impl Plot {
    /// An empty plot of a rectangle.
    pub(super) fn new(min: [f64; 2], max: [f64; 2]) -> Plot {
        Plot {
            min,
            max,
            cells: vec![[' '; WIDTH]; HEIGHT],
        }
    }

    /// The cell of a point: column and row from the top; `None` outside the plot.
    fn cell(&self, point: [f64; 2]) -> Option<(usize, usize)> {
        let share =
            [0, 1].map(|axis| (point[axis] - self.min[axis]) / (self.max[axis] - self.min[axis]));
        if !share.iter().all(|share| (0.0..=1.0).contains(share)) {
            return None;
        }
        let [x, y] = share;
        let column = (x * (WIDTH - 1) as f64).round() as usize;
        let row = ((1.0 - y) * (HEIGHT - 1) as f64).round() as usize;
        Some((column, row))
    }

    /// Marks a point. Returns whether it is inside the plot. A cell with another mark gets `*`.
    pub(super) fn mark(&mut self, point: [f64; 2], mark: char) -> bool {
        let Some((column, row)) = self.cell(point) else {
            return false;
        };
        let cell = &mut self.cells[row][column];
        let is_free = *cell == ' ' || *cell == LINE || *cell == mark;
        *cell = if is_free { mark } else { '*' };
        true
    }

    /// Marks a point in place of what is there.
    pub(super) fn set(&mut self, point: [f64; 2], mark: char) {
        if let Some((column, row)) = self.cell(point) {
            self.cells[row][column] = mark;
        }
    }

    /// Draws the line between two points where nothing is drawn yet.
    pub(super) fn line(&mut self, from: [f64; 2], to: [f64; 2]) {
        let steps = 4 * WIDTH;
        for step in 0..=steps {
            let share = step as f64 / steps as f64;
            let point = [0, 1].map(|axis| from[axis] + share * (to[axis] - from[axis]));
            if let Some((column, row)) = self.cell(point)
                && self.cells[row][column] == ' '
            {
                self.cells[row][column] = LINE;
            }
        }
    }

    /// The lines of the plot, with a margin, without empty ones at the top and the bottom.
    pub(super) fn lines(&self) -> Vec<String> {
        let is_empty = |row: &[char; WIDTH]| row.iter().all(|cell| *cell == ' ');
        let first = self
            .cells
            .iter()
            .position(|row| !is_empty(row))
            .unwrap_or(0);
        let last = self
            .cells
            .iter()
            .rposition(|row| !is_empty(row))
            .unwrap_or(0);
        let rows = self.cells[first..=last].iter();
        rows.map(|row| format!("    {}", row.iter().collect::<String>()))
            .collect()
    }
}

/// The mark of a line.
const LINE: char = '.';

/// What the calls have in common, drawn.
pub(super) struct Drawing {
    /// What follows the sentence about the inputs.
    pub(super) words: String,
    pub(super) lines: Vec<String>,
}

/// A line below a plot.
pub(super) fn legend(text: &str) -> String {
    one_line(&format!("  {text}"), WIDTH + 14)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_are_where_they_belong() {
        let mut plot = Plot::new([0.0, 0.0], [1.0, 1.0]);
        plot.line([0.0, 0.0], [1.0, 0.0]);
        assert!(plot.mark([0.0, 0.0], 'o'));
        assert!(plot.mark([1.0, 1.0], 'x'));
        assert!(!plot.mark([1.1, 1.0], 'x'));
        assert!(!plot.mark([f64::NAN, 1.0], 'x'));
        let lines = plot.lines();
        assert!(lines[0].ends_with('x'), "{lines:?}");
        assert!(lines[HEIGHT - 1].trim().starts_with("o.."), "{lines:?}");
        plot.mark([1.0, 1.0], 'o');
        assert!(plot.lines()[0].ends_with('*'));
    }
}
