//! Rows of the table: one for each library and interface, and their form in a file.

use super::column::{COLUMNS, Measure};
use crate::precision::Precision;
use serde::{Deserialize, Serialize};
use std::fmt::{self, Display, Write};

/// What a cell of the table shows.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Cell {
    /// The number that the column measures.
    Value(f64),
    /// The library's own error: an answer, too.
    Error(String),
    /// The interface cannot be asked this.
    None,
}

/// A row: what a library answers through one of its interfaces.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// A name without blanks.
    pub name: String,
    /// The library.
    pub library: String,
    /// Its version.
    pub version: String,
    /// The function that was called.
    pub interface: String,
    /// The precision in which it computes.
    pub precision: Precision,
    /// Rays that were asked in each column, at most.
    pub rays: usize,
    /// Millions of rays in a second of processor time, if they were timed.
    pub million_rays: Option<f64>,
    /// A cell for each column.
    pub cells: Vec<Cell>,
}

/// What an adapter says of its row, in this order, one to a line: key, tabulator, value.
pub(super) const KEYS: [&str; 4] = ["library", "version", "interface", "precision"];

impl Row {
    /// The cell of the column `name`, if it is a number.
    pub fn value(&self, name: &str) -> Option<f64> {
        let at = COLUMNS.iter().position(|column| column.name == name)?;
        match self.cells.get(at)? {
            Cell::Value(value) => Some(*value),
            Cell::Error(_) | Cell::None => None,
        }
    }

    /// Whether it has an answer in every column in which a wrong one is a fault, and no wrong one.
    pub fn is_right(&self) -> bool {
        let columns = COLUMNS.iter().zip(&self.cells);
        columns
            .filter(|(column, _)| column.measure == Measure::Wrong)
            .all(|(_, cell)| *cell == Cell::Value(0.0))
    }

    /// Whether it is a library's, and not this project's or a textbook's code in its tree.
    pub fn is_of_a_library(&self) -> bool {
        !["First Light", "textbook code"].contains(&&*self.library)
    }

    /// The largest number of wrong answers in a million of any column; `None` without columns.
    pub fn worst(&self) -> Option<f64> {
        let wrong = COLUMNS
            .iter()
            .filter(|column| column.measure == Measure::Wrong);
        wrong
            .filter_map(|column| self.value(column.name))
            .reduce(f64::max)
    }
}

impl Display for Cell {
    /// As in the file.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Cell::Value(value) if value.fract() == 0.0 || *value > 100.0 => write!(f, "{value:.0}"),
            Cell::Value(value) => write!(f, "{value:.2}"),
            Cell::Error(error) => write!(f, "error: {error}"),
            Cell::None => f.write_char('-'),
        }
    }
}

/// The unit of a column, as in the head of the file.
fn unit(measure: Measure) -> &'static str {
    match measure {
        Measure::Wrong => "wrong_ppm",
        Measure::Found => "found_pct",
        Measure::Count => "wrong_count_pct",
        Measure::Ulps => "largest_error_ulp",
    }
}

/// The rows as a file: a head, then a line for each row, with tabulators.
pub fn to_tsv(rows: &[Row]) -> String {
    let mut text =
        String::from("row\tlibrary\tversion\tinterface\tprecision\trays\tmillion_rays_per_second");
    for column in &COLUMNS {
        let _ = write!(text, "\t{}_{}", column.name, unit(column.measure));
    }
    text.push('\n');
    for row in rows {
        let Row {
            name,
            library,
            version,
            interface,
            rays,
            ..
        } = row;
        let precision = row.precision.name();
        let speed = row
            .million_rays
            .map_or("-".into(), |speed| format!("{speed:.4}"));
        let _ = write!(
            text,
            "{name}\t{library}\t{version}\t{interface}\t{precision}\t{rays}\t{speed}"
        );
        for cell in &row.cells {
            let _ = write!(text, "\t{cell}");
        }
        text.push('\n');
    }
    text
}

/// Reads what [`to_tsv`] wrote.
///
/// # Errors
///
/// The first line that is not a row of it, with its number.
pub fn from_tsv(text: &str) -> Result<Vec<Row>, String> {
    let numbered = (1..).zip(text.lines()).skip(1);
    numbered
        .map(|(number, line)| {
            row_of(line).ok_or_else(|| format!("line {number}: expected a row of the table"))
        })
        .collect()
}

fn row_of(line: &str) -> Option<Row> {
    let fields: Vec<&str> = line.split('\t').collect();
    let [
        name,
        library,
        version,
        interface,
        precision,
        rays,
        speed,
        cells @ ..,
    ] = &fields[..]
    else {
        return None;
    };
    let cell = |text: &&str| match *text {
        "-" => Some(Cell::None),
        text => match text.strip_prefix("error: ") {
            Some(error) => Some(Cell::Error(error.into())),
            None => text.parse().ok().map(Cell::Value),
        },
    };
    let cells: Vec<Cell> = cells.iter().map(cell).collect::<Option<_>>()?;
    Some(Row {
        name: name.to_string(),
        library: library.to_string(),
        version: version.to_string(),
        interface: interface.to_string(),
        precision: precision_of(precision)?,
        rays: rays.parse().ok()?,
        million_rays: speed.parse().ok(),
        cells: (cells.len() == COLUMNS.len()).then_some(cells)?,
    })
}

/// The precision with this name.
pub(super) fn precision_of(name: &str) -> Option<Precision> {
    let all = [Precision::F32, Precision::F64, Precision::F32InF64];
    all.into_iter().find(|precision| precision.name() == name)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_survive_a_file() {
        let mut cells = vec![Cell::Value(12.5); COLUMNS.len() - 2];
        cells.extend([Cell::Error("RuntimeError: no".into()), Cell::None]);
        let row = Row {
            name: "a".into(),
            library: "A".into(),
            version: "1.0".into(),
            interface: "f(x)".into(),
            precision: Precision::F32InF64,
            rays: 20_000,
            million_rays: Some(1.25),
            cells,
        };
        let rows = [
            row.clone(),
            Row {
                million_rays: None,
                ..row
            },
        ];
        let text = to_tsv(&rows);
        assert_eq!(from_tsv(&text).as_deref(), Ok(&rows[..]));
        let damaged = text.replace("f64", "").replace("\t-\n", "\n");
        assert_eq!(
            from_tsv(&damaged),
            Err("line 2: expected a row of the table".into())
        );
    }
}
