//! The numbers of a figure, column by column: the rows of its table, and what its points show.

use crate::figure::Figure;

/// What a column has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Words: names of rows, and what they are made of.
    Words,
    /// Numbers.
    Numbers,
}

/// The text of a row's cell, if it has one.
type CellOf<'a, T> = Box<dyn Fn(&T) -> Option<String> + 'a>;

/// A column: its head, and its cell in a row.
struct Column<'a, T> {
    kind: Kind,
    head: String,
    cell: CellOf<'a, T>,
}

/// The columns of a table whose rows are of `T`.
pub struct Columns<'a, T>(Vec<Column<'a, T>>);

/// Heads, each with the kind of its column, and rows of as many cells. A cell that a row does not
/// have is empty.
pub type Cells = (Vec<(Kind, String)>, Vec<Vec<String>>);

fn in_line(head: &str) -> String {
    head.replace('\n', " ")
}

impl<'a, T> Columns<'a, T> {
    /// The column with the names of the rows.
    pub fn new(head: &str, name: impl Fn(&T) -> String + 'a) -> Columns<'a, T> {
        Columns(Vec::new()).words(head, name)
    }

    /// Adds a column of words.
    #[must_use]
    pub fn words(self, head: &str, cell: impl Fn(&T) -> String + 'a) -> Columns<'a, T> {
        self.with(Kind::Words, head, move |row| Some(cell(row)))
    }

    /// Adds a column of numbers. Its head can be read behind a number: "correct bits". In narrow
    /// tables it has several lines.
    #[must_use]
    pub fn and(self, head: &str, cell: impl Fn(&T) -> String + 'a) -> Columns<'a, T> {
        self.with(Kind::Numbers, head, move |row| Some(cell(row)))
    }

    /// Adds a column of numbers that not every row has. Where none has, the column is left out.
    #[must_use]
    pub fn and_some(self, head: &str, cell: impl Fn(&T) -> Option<String> + 'a) -> Columns<'a, T> {
        self.with(Kind::Numbers, head, cell)
    }

    fn with(
        mut self,
        kind: Kind,
        head: &str,
        cell: impl Fn(&T) -> Option<String> + 'a,
    ) -> Columns<'a, T> {
        self.0.push(Column {
            kind,
            head: head.into(),
            cell: Box::new(cell),
        });
        self
    }

    /// Returns what the point of a row shows: its name and its numbers.
    pub fn tip(&self, row: &T) -> String {
        let of = |has_words: bool| {
            let columns = self.0.iter();
            columns.filter(move |column| (column.kind == Kind::Words) == has_words)
        };
        let words = of(true).filter_map(|column| (column.cell)(row));
        let numbers = of(false).filter_map(|column| {
            Some(format!("{} {}", (column.cell)(row)?, in_line(&column.head)))
        });
        let [words, numbers] =
            [words.collect(), numbers.collect()].map(|parts: Vec<_>| parts.join(", "));
        format!("{words}: {numbers}")
    }

    /// Returns the heads and the cells of `rows`.
    pub fn cells<'r>(&self, rows: impl IntoIterator<Item = &'r T>) -> Cells
    where
        T: 'r,
    {
        let rows: Vec<&T> = rows.into_iter().collect();
        let is_shown = |column: &&Column<T>| {
            let is_known = |row: &&T| (column.cell)(row).is_some();
            rows.is_empty() || rows.iter().any(is_known)
        };
        let shown: Vec<&Column<T>> = self.0.iter().filter(is_shown).collect();
        let cells = |row: &&T| {
            let cells = shown.iter().map(|column| (column.cell)(row));
            cells.map(Option::unwrap_or_default).collect()
        };
        let heads = shown
            .iter()
            .map(|column| (column.kind, column.head.clone()));
        (heads.collect(), rows.iter().map(cells).collect())
    }

    /// Returns `figure` with the table of `rows`.
    pub fn table<'r>(&self, rows: impl IntoIterator<Item = &'r T>, figure: Figure) -> Figure
    where
        T: 'r,
    {
        let (heads, rows) = self.cells(rows);
        Figure {
            head: heads.iter().map(|(_, head)| in_line(head)).collect(),
            rows,
            ..figure
        }
    }
}
