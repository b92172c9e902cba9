//! The table: a row for each library and interface, a column for each hard case.

use crate::case::Answers;
use crate::columns::{COLUMNS, Column, Measure};
use crate::judge::{Precision, judge};
use std::collections::BTreeMap;
use std::ffi::OsStr;
use std::fmt::Write;
use std::fs;
use std::io;
use std::path::Path;

/// The names of the cases: the columns and the one that is timed.
pub(crate) fn names() -> impl Iterator<Item = &'static str> {
    COLUMNS.iter().map(|column| column.name).chain(["speed"])
}

/// What a cell of the table shows.
enum Cell {
    /// The number of [`crate::judge::Outcome::value`].
    Value(f64),
    /// The library's own error: an answer, too.
    Error(String),
    /// The library has no interface for it.
    None,
}

/// A library's row.
struct Row {
    name: String,
    about: BTreeMap<String, String>,
    /// Answers in a second of processor time, in millions, where rays were timed.
    million_rays: Option<f64>,
    cells: Vec<Cell>,
}

/// All rows.
pub(crate) struct Table(Vec<Row>);

/// Judges each folder of `out` by the truth in `cases`.
pub(crate) fn read(cases: &Path, out: &Path) -> io::Result<Table> {
    let truths = COLUMNS
        .iter()
        .map(|column| Answers::read(&cases.join(column.name).with_extension("truth")));
    let truths: Vec<Answers> = truths.collect::<io::Result<_>>()?;
    let mut folders: Vec<_> = fs::read_dir(out)?
        .flatten()
        .map(|entry| entry.path())
        .collect();
    folders.sort();
    let rows = folders
        .iter()
        .filter(|folder| folder.join("about.tsv").is_file());
    let rows = rows.map(|folder| Row::read(folder, &truths));
    rows.collect::<io::Result<_>>().map(Table)
}

impl Row {
    fn read(folder: &Path, truths: &[Answers]) -> io::Result<Row> {
        let name = folder.file_name().unwrap_or_default().to_owned();
        let about = fs::read_to_string(folder.join("about.tsv"))?;
        let pairs = about.lines().filter_map(|line| line.split_once('\t'));
        let about: BTreeMap<String, String> = pairs
            .map(|(key, value)| (key.into(), value.into()))
            .collect();
        let precision = match about.get("precision").map(String::as_str) {
            Some("f64") => Precision::Double,
            _ => Precision::Single,
        };
        let cell = |(column, truth): (&Column, &Answers)| {
            let file = folder.join(column.name);
            if let Ok(error) = fs::read_to_string(file.with_extension("error")) {
                return Ok(Cell::Error(error.trim().to_string()));
            }
            match file.with_extension("answer") {
                path if !path.is_file() => Ok(Cell::None),
                path => {
                    let outcome = judge(truth, &Answers::read(&path)?, precision);
                    Ok(outcome
                        .value(column.measure)
                        .map_or(Cell::None, Cell::Value))
                }
            }
        };
        let cells = COLUMNS.iter().zip(truths).map(cell);
        Ok(Row {
            name: name.to_string_lossy().into_owned(),
            about,
            million_rays: speeds(folder, &name),
            cells: cells.collect::<io::Result<_>>()?,
        })
    }
}

/// The median of the speeds in all rounds, the folder itself and `round*` beside it, in millions of
/// rays per second.
fn speeds(folder: &Path, name: &OsStr) -> Option<f64> {
    let rounds = fs::read_dir(folder.parent()?).ok()?.flatten();
    let others = rounds.map(|round| round.path().join(name));
    let files = others
        .chain([folder.to_path_buf()])
        .map(|folder| folder.join("speed.answer"));
    let speed = |answers: Answers| 1e-6 * answers.hits.len() as f64 / answers.seconds;
    let mut speeds: Vec<f64> = files
        .filter_map(|file| Answers::read(&file).ok().map(speed))
        .collect();
    speeds.sort_by(f64::total_cmp);
    speeds.get(speeds.len() / 2).copied()
}

impl Table {
    /// The table as text with tabulators: a `-` where a library has no interface for a column.
    pub(crate) fn tsv(&self) -> String {
        let mut text =
            String::from("row\tlibrary\tversion\tinterface\tprecision\tmillion_rays_per_second");
        for column in &COLUMNS {
            let unit = match column.measure {
                Measure::Wrong => "wrong_ppm",
                Measure::Found => "found_pct",
                Measure::Count => "wrong_count_pct",
                Measure::Ulps => "largest_error_ulp",
            };
            let _ = write!(text, "\t{}_{unit}", column.name);
        }
        text.push('\n');
        for row in &self.0 {
            let about = |key: &str| row.about.get(key).map_or("", String::as_str);
            let keys = ["library", "version", "interface", "precision"];
            text += &row.name;
            text.push('\t');
            text += &keys.map(about).join("\t");
            let speed = row.million_rays.map(|speed| format!("{speed:.3}"));
            let _ = write!(text, "\t{}", speed.as_deref().unwrap_or("-"));
            for cell in &row.cells {
                let _ = match cell {
                    Cell::Value(value) if value.fract() == 0.0 || *value > 100.0 => {
                        write!(text, "\t{value:.0}")
                    }
                    Cell::Value(value) => write!(text, "\t{value:.2}"),
                    Cell::Error(error) => write!(text, "\terror: {error}"),
                    Cell::None => write!(text, "\t-"),
                };
            }
            text.push('\n');
        }
        text
    }
}
