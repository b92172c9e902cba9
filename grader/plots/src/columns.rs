//! The numbers of a figure, column by column: the rows of its table, and what its points show.

use crate::figure::Figure;

/// A column: its head, and its cell in a row.
type Column<'a, T> = (String, Box<dyn Fn(&T) -> String + 'a>);

/// The columns of a table whose rows are of `T`.
pub struct Columns<'a, T> {
    name: Column<'a, T>,
    numbers: Vec<Column<'a, T>>,
}

impl<'a, T> Columns<'a, T> {
    /// The column with the names of the rows.
    pub fn new(head: &str, name: impl Fn(&T) -> String + 'a) -> Columns<'a, T> {
        Columns {
            name: (head.into(), Box::new(name)),
            numbers: Vec::new(),
        }
    }

    /// Adds a column of numbers. Its head can be read behind a number: "correct bits".
    #[must_use]
    pub fn and(mut self, head: &str, cell: impl Fn(&T) -> String + 'a) -> Columns<'a, T> {
        self.numbers.push((head.into(), Box::new(cell)));
        self
    }

    /// Returns what the point of a row shows: its name and its numbers.
    pub fn tip(&self, row: &T) -> String {
        let numbers = self.numbers.iter();
        let numbers: Vec<String> = numbers
            .map(|(head, cell)| format!("{} {head}", cell(row)))
            .collect();
        format!("{}: {}", (self.name.1)(row), numbers.join(", "))
    }

    /// Returns `figure` with the table of `rows`.
    pub fn table<'r>(&self, rows: impl IntoIterator<Item = &'r T>, figure: Figure) -> Figure
    where
        T: 'r,
    {
        let columns = || std::iter::once(&self.name).chain(&self.numbers);
        let cells = |row: &T| columns().map(|(_, cell)| cell(row)).collect();
        Figure {
            head: columns().map(|(head, _)| head.clone()).collect(),
            rows: rows.into_iter().map(cells).collect(),
            ..figure
        }
    }
}
