//! A plot of characters.

use crate::report::wrap::one_line;

/// Columns of a plot of the size of an explanation.
pub(crate) const WIDTH: usize = 60;

/// Lines of such a plot. A character is about twice as high as it is wide.
pub(crate) const HEIGHT: usize = 16;

/// A plot of the rectangle from `min` to `max`, the second coordinate upward.
pub(crate) struct Plot {
    min: [f64; 2],
    max: [f64; 2],
    cells: Vec<Vec<char>>,
}

impl Plot {
    /// An empty plot of a rectangle, of the size of an explanation.
    pub(crate) fn new(min: [f64; 2], max: [f64; 2]) -> Plot {
        Plot::sized(min, max, [WIDTH, HEIGHT])
    }

    /// An empty plot of a rectangle with so many columns and lines.
    pub(super) fn sized(min: [f64; 2], max: [f64; 2], [columns, lines]: [usize; 2]) -> Plot {
        Plot {
            min,
            max,
            cells: vec![vec![' '; columns]; lines],
        }
    }

    /// The number of columns and of lines.
    fn size(&self) -> [usize; 2] {
        [self.cells.first().map_or(0, Vec::len), self.cells.len()]
    }

    /// The cell of a point: column and row from the top; `None` outside the plot.
    fn cell(&self, point: [f64; 2]) -> Option<(usize, usize)> {
        let share =
            [0, 1].map(|axis| (point[axis] - self.min[axis]) / (self.max[axis] - self.min[axis]));
        if !share.iter().all(|share| (0.0..=1.0).contains(share)) {
            return None;
        }
        let [x, y] = share;
        let [columns, lines] = self.size();
        let column = (x * (columns - 1) as f64).round() as usize;
        let row = ((1.0 - y) * (lines - 1) as f64).round() as usize;
        Some((column, row))
    }

    /// Marks a point. Returns whether it is inside the plot. A cell with another mark gets `*`.
    pub(crate) fn mark(&mut self, point: [f64; 2], mark: char) -> bool {
        let Some((column, row)) = self.cell(point) else {
            return false;
        };
        let cell = &mut self.cells[row][column];
        let is_free = *cell == ' ' || *cell == LINE || *cell == mark;
        *cell = if is_free { mark } else { '*' };
        true
    }

    /// Marks a point in place of what is there.
    pub(crate) fn set(&mut self, point: [f64; 2], mark: char) {
        if let Some((column, row)) = self.cell(point) {
            self.cells[row][column] = mark;
        }
    }

    /// Marks a point where nothing is drawn yet.
    pub(super) fn set_if_free(&mut self, point: [f64; 2], mark: char) {
        if let Some((column, row)) = self.cell(point)
            && self.cells[row][column] == ' '
        {
            self.cells[row][column] = mark;
        }
    }

    /// Draws the line between two points where nothing is drawn yet.
    pub(crate) fn line(&mut self, from: [f64; 2], to: [f64; 2]) {
        self.stroke(from, to, LINE);
    }

    /// As [`Plot::line`], with another mark.
    pub(super) fn stroke(&mut self, from: [f64; 2], to: [f64; 2], mark: char) {
        let steps = 4 * self.size()[0];
        for step in 0..=steps {
            let share = step as f64 / steps as f64;
            let point = [0, 1].map(|axis| from[axis] + share * (to[axis] - from[axis]));
            self.set_if_free(point, mark);
        }
    }

    /// Writes a word at a point, in place of lines but not of marks; what does not fit is left out.
    pub(super) fn word(&mut self, at: [f64; 2], word: &str, side: Side) {
        let Some((column, row)) = self.cell(at) else {
            return;
        };
        let length = word.chars().count();
        let most = self.size()[0].saturating_sub(length);
        let start = match side {
            Side::Behind => column + 2,
            Side::Before => column.saturating_sub(length + 1),
            Side::Around => column.saturating_sub(length / 2),
        };
        let start = start.min(most);
        for (cell, letter) in self.cells[row][start..].iter_mut().zip(word.chars()) {
            if !MARKS.contains(cell) {
                *cell = letter;
            }
        }
    }

    /// The lines of the plot, with a margin, without empty ones at the top and the bottom.
    pub(crate) fn lines(&self) -> Vec<String> {
        let is_empty = |row: &Vec<char>| row.iter().all(|cell| *cell == ' ');
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
        rows.map(|row| format!("    {}", row.iter().collect::<String>().trim_end()))
            .collect()
    }
}

/// Where a word is beside its point.
#[derive(Clone, Copy, Debug)]
pub(super) enum Side {
    Before,
    Around,
    Behind,
}

/// The mark of a line.
const LINE: char = '.';

/// Marks that no word covers.
const MARKS: [char; 5] = ['o', 'x', '*', '@', '+'];

/// A line below a plot.
pub(crate) fn legend(text: &str) -> String {
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
