//! A plot of characters.

/// Columns of a plot of the size of an explanation.
pub(crate) const WIDTH: usize = 60;

/// Lines of such a plot. A character is about twice as high as it is wide.
pub(crate) const HEIGHT: usize = 16;

/// A plot of the rectangle from `min` to `max`, the second coordinate upward.
pub(crate) struct Plot {
    min: [f64; 2],
    max: [f64; 2],
    cells: Vec<Vec<char>>,
    /// Which cells have a letter of a word.
    lettered: Vec<Vec<bool>>,
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
            lettered: vec![vec![false; columns]; lines],
        }
    }

    /// The number of columns and of lines.
    fn size(&self) -> [usize; 2] {
        [self.cells.first().map_or(0, Vec::len), self.cells.len()]
    }

    /// The cell of a point: column and row from the top; `None` outside the plot.
    pub(super) fn cell(&self, point: [f64; 2]) -> Option<(usize, usize)> {
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

    /// Marks the place of an answer, in place of what is there. With the mark of another answer it
    /// becomes [`BOTH`].
    pub(super) fn mark_answer(&mut self, point: [f64; 2], mark: char) {
        if let Some((column, row)) = self.cell(point) {
            let cell = &mut self.cells[row][column];
            *cell = both(*cell, mark);
        }
    }

    /// Whether a sign is drawn, other than as a letter of a word.
    pub(super) fn has(&self, sign: char) -> bool {
        let rows = self.cells.iter().zip(&self.lettered);
        let mut cells = rows.flat_map(|(cells, lettered)| cells.iter().zip(lettered));
        cells.any(|(cell, lettered)| *cell == sign && !lettered)
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

    /// Draws the outline of a polygon.
    pub(crate) fn outline(&mut self, corners: &[[f64; 2]]) {
        let next = corners.iter().cycle().skip(1);
        for (from, to) in corners.iter().zip(next) {
            self.line(*from, *to);
        }
    }

    /// Draws the unit circle.
    pub(crate) fn unit_circle(&mut self) {
        let around = |step: u32| {
            let angle = f64::from(step) / 90.0 * std::f64::consts::TAU;
            [angle.cos(), angle.sin()]
        };
        self.outline(&(0..90).map(around).collect::<Vec<_>>());
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

    /// Writes a word beside a point, in place of lines but not of marks and of other words: on the
    /// wanted side if there is room, else on another one or in a row nearby. Returns whether there
    /// was room.
    pub(super) fn word(&mut self, at: [f64; 2], word: &str, side: Side) -> bool {
        let Some((column, row)) = self.cell(at) else {
            return false;
        };
        let letters: Vec<char> = word.chars().collect();
        let start = |side: Side| match side {
            Side::Behind => column + 2,
            Side::Before => column.saturating_sub(letters.len() + 1),
            Side::Around | Side::Within => column.saturating_sub(letters.len() / 2),
        };
        let sides = match side {
            Side::Behind => [Side::Behind, Side::Before, Side::Around],
            Side::Before => [Side::Before, Side::Behind, Side::Around],
            side => [side; 3],
        };
        let rows: &[isize] = match side {
            Side::Within => &[0],
            _ => &[0, 1, -1, 2, -2],
        };
        let shifts = [0, 1, -1, 2, -2, 3, -3, 4, -4, 5, -5, 6, -6];
        let places = rows.iter().flat_map(|down| {
            let starts = sides.map(start).into_iter();
            starts.flat_map(move |start| {
                shifts.map(|by| (row.checked_add_signed(*down), start.checked_add_signed(by)))
            })
        });
        let most = self.size()[0].saturating_sub(letters.len());
        let mut free = places.filter_map(|(row, start)| {
            let (row, start) = (row?, start?.min(most));
            self.is_free(row, start, letters.len())
                .then_some((row, start))
        });
        let Some((row, start)) = free.next() else {
            return false;
        };
        drop(free);
        for (place, letter) in (start..).zip(letters) {
            self.cells[row][place] = letter;
            self.lettered[row][place] = true;
        }
        true
    }

    /// Whether a word of this length covers no mark there, and touches no word.
    fn is_free(&self, row: usize, start: usize, length: usize) -> bool {
        let (Some(cells), Some(lettered)) = (self.cells.get(row), self.lettered.get(row)) else {
            return false;
        };
        let around = start.saturating_sub(1)..(start + length + 1).min(cells.len());
        !lettered[around].contains(&true)
            && cells
                .get(start..start + length)
                .is_some_and(|cells| !cells.iter().any(|cell| MARKS.contains(cell)))
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
    /// Around its point, and in no other row.
    Within,
}

/// The mark of a line.
const LINE: char = '.';

/// Marks that no word covers.
const MARKS: [char; 5] = ['o', 'x', BOTH, '@', '+'];

/// The mark of two answers in one cell.
pub(super) const BOTH: char = '*';

/// The mark of a cell that has one, after it gets the mark of an answer, too.
pub(super) fn both(before: char, mark: char) -> char {
    match (before, mark) {
        ('o', 'x') | ('x', 'o') | (BOTH, _) => BOTH,
        _ => mark,
    }
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

    #[test]
    fn only_two_answers_in_a_cell_are_both() {
        let mut plot = Plot::new([0.0, 0.0], [1.0, 1.0]);
        plot.set([0.0, 1.0], '@');
        plot.mark_answer([0.0, 1.0], 'o');
        assert!(plot.has('o') && !plot.has('@') && !plot.has(BOTH));
        plot.mark_answer([0.0, 1.0], 'x');
        assert!(plot.has(BOTH) && !plot.has('o'));
    }

    #[test]
    fn words_stand_beside_marks_and_other_words() {
        let mut plot = Plot::new([0.0, 0.0], [1.0, 1.0]);
        let at = [0.5, 0.5];
        plot.mark_answer(at, 'o');
        let words = ["expected normal", "your normal", "x o", "wi"];
        for word in words {
            assert!(plot.word(at, word, Side::Behind), "{word}");
        }
        let text = plot.lines().join("\n");
        assert!(words.iter().all(|word| text.contains(word)), "{text}");
        // Letters are no marks.
        assert!(plot.has('o') && !plot.has('x'));
        // In a full row there is no room.
        let full = "y".repeat(WIDTH);
        assert!(plot.word([0.5, 0.0], &full, Side::Within));
        assert!(!plot.word([0.5, 0.0], "z", Side::Within));
    }
}
