//! The libraries' answers: cases as files for their adapters, and the table of what they answered.

use super::case::{Answers, file_error};
use super::column::{COLUMNS, speed};
use super::outcome::value;
use super::row::{self, Cell, KEYS, Row};
use super::truth;
use base::{GraderError, shell_word};
use std::ffi::OsStr;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

/// The rows of the libraries, as `grader/world/run` measured them.
const STORED: &str = include_str!("libraries.tsv");

/// The stored rows.
///
/// # Errors
///
/// If the file does not fit the columns: it was stored before they changed.
pub fn stored() -> Result<Vec<Row>, GraderError> {
    row::from_tsv(STORED).map_err(|e| {
        GraderError::new(format!(
            "grader/cost/src/world/libraries.tsv: {e}; store the rows anew with grader/world/run"
        ))
    })
}

/// Writes all cases with their truth to `folder`, and the case that is timed.
///
/// # Errors
///
/// If a file cannot be written.
pub fn write_cases(folder: &Path, seed: u64, rays: usize) -> Result<(), GraderError> {
    let write = || {
        fs::create_dir_all(folder)?;
        for column in &COLUMNS {
            let case = column.case(seed, rays);
            case.write(&folder.join(column.name).with_extension("case"))?;
            truth::answers(&case).write(&truth_file(folder, column.name))?;
        }
        speed(seed, 2 * rays).write(&folder.join("speed.case"))
    };
    write().map_err(|e| at(folder, &e))
}

fn truth_file(cases: &Path, column: &str) -> PathBuf {
    cases.join(column).with_extension("truth")
}

/// Judges the answers in the folders of `answers` by the truth in `cases`: a row for each folder
/// with a file `about.tsv`, sorted by name.
///
/// # Errors
///
/// If a file cannot be read, a column has no case or truth, or a file is not what an adapter
/// writes: it has no answer or more than the case has rays, is of no column, or is beside an error
/// for the same column.
pub fn judge(cases: &Path, answers: &Path) -> Result<Vec<Row>, GraderError> {
    let mut folders = Vec::new();
    for entry in fs::read_dir(answers).map_err(|e| at(answers, &e))? {
        folders.push(entry.map_err(|e| at(answers, &e))?.path());
    }
    folders.sort();
    let each_truth = COLUMNS.iter().map(|column| {
        // No adapter answers a case that is not there.
        let case = cases.join(column.name).with_extension("case");
        fs::metadata(&case).map_err(|e| file_error(&case, e))?;
        Answers::read(&truth_file(cases, column.name))
    });
    let truths: Vec<Answers> = each_truth.collect::<io::Result<_>>().map_err(|e| {
        GraderError::new(format!(
            "{e}; `cargo grader cost world --cases {}` writes the cases of this version",
            shell_word(cases)
        ))
    })?;
    let rows = folders
        .iter()
        .filter(|folder| folder.join("about.tsv").is_file());
    rows.map(|folder| row_of(folder, &truths).map_err(|e| at(folder, &e)))
        .collect()
}

fn at(path: &Path, error: &io::Error) -> GraderError {
    GraderError::new(file_error(path, error).to_string())
}

fn row_of(folder: &Path, truths: &[Answers]) -> io::Result<Row> {
    let about_file = folder.join("about.tsv");
    let about = fs::read_to_string(&about_file).map_err(|e| file_error(&about_file, e))?;
    let key = |key: &str| {
        let mut lines = about.lines().filter_map(|line| line.split_once('\t'));
        let line = lines.find(|(name, _)| *name == key);
        line.map(|(_, value)| as_cell(value))
            .ok_or_else(|| io::Error::other(format!("about.tsv has no line `{key}`")))
    };
    let [library, version, interface, precision] = KEYS.map(key);
    let precision = row::precision_of(&precision?).ok_or_else(|| {
        io::Error::other("about.tsv: the precision is neither f32, f64 nor f32 in f64")
    })?;
    check_names(folder)?;
    let mut rays = 0;
    let mut cells = Vec::new();
    for (column, truth) in COLUMNS.iter().zip(truths) {
        let file = folder.join(column.name);
        let (error, answer) = (file.with_extension("error"), file.with_extension("answer"));
        cells.push(if error.is_file() {
            if answer.is_file() {
                let both = "is beside answers to the same rays: remove the older file";
                return Err(file_error(&error, both));
            }
            let text = fs::read_to_string(&error).map_err(|e| file_error(&error, e))?;
            Cell::Error(as_cell(&text))
        } else if answer.is_file() {
            let answers = Answers::read(&answer)?;
            let (found, most) = (answers.rays.len(), truth.rays.len());
            if !(1..=most).contains(&found) {
                return Err(file_error(
                    &answer,
                    format!("{found} answers, and the case has {most} rays: expected 1 to {most}"),
                ));
            }
            rays = rays.max(answers.rays.len());
            value(truth, &answers, column.measure, precision).map_or(Cell::None, Cell::Value)
        } else {
            Cell::None
        });
    }
    let name = folder.file_name().unwrap_or_default();
    Ok(Row {
        name: name.to_string_lossy().into_owned(),
        library: library?,
        version: version?,
        interface: interface?,
        precision,
        rays,
        million_rays: million_rays(folder, name)?,
        cells,
    })
}

/// The first line of a text, without what would end a cell of the table.
fn as_cell(text: &str) -> String {
    let line = text.trim().lines().next().unwrap_or_default();
    line.replace('\t', " ")
}

/// Every answer and error is of a column, or of the case that is timed.
fn check_names(folder: &Path) -> io::Result<()> {
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        let is_answer = path
            .extension()
            .is_some_and(|e| e == "answer" || e == "error");
        let is_of = |name: &str| path.file_stem().is_some_and(|stem| stem == name);
        let is_known = is_of("speed") || COLUMNS.iter().any(|column| is_of(column.name));
        if is_answer && !is_known {
            return Err(file_error(&path, "no case has this name"));
        }
    }
    Ok(())
}

/// The median of the speeds in all rounds, the folder itself and `round*` beside it, in millions of
/// rays a second.
fn million_rays(folder: &Path, name: &OsStr) -> io::Result<Option<f64>> {
    let mut files = vec![folder.join("speed.answer")];
    for entry in fs::read_dir(folder.parent().unwrap_or(folder))? {
        files.push(entry?.path().join(name).join("speed.answer"));
    }
    let mut speeds = Vec::new();
    for file in files.iter().filter(|file| file.is_file()) {
        let answers = Answers::read(file)?;
        let seconds = answers.seconds;
        if !(seconds > 0.0 && seconds.is_finite()) {
            let what = format!("{seconds} s of processor time: expected more than 0");
            return Err(file_error(file, what));
        }
        speeds.push(1e-6 * answers.rays.len() as f64 / seconds);
    }
    speeds.sort_by(f64::total_cmp);
    Ok(speeds.get(speeds.len() / 2).copied())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::world::RayAnswer;

    /// What is wrong with one answer in each column after `change` of the folder of the row.
    fn problem(change: impl Fn(&Path)) -> String {
        let folder = tempfile::tempdir().expect("a folder");
        let (cases, row) = (folder.path().join("cases"), folder.path().join("answers/a"));
        fs::create_dir_all(&row).expect("it is writable");
        write_cases(&cases, 1, 2).expect("it is writable");
        let about = "library\tA\nversion\t1\ninterface\tf\tg\nprecision\tf64\n";
        fs::write(row.join("about.tsv"), about).expect("it is writable");
        for column in &COLUMNS {
            write(&row, column.name, 1, 1.0);
        }
        write(&row, "speed", 4, 1.0);
        change(&row);
        match judge(&cases, row.parent().expect("it has one")) {
            Ok(rows) => {
                let read = row::from_tsv(&row::to_tsv(&rows));
                format!("{:?}", read.map(|rows| rows[0].cells[0].clone()))
            }
            Err(error) => error.to_string(),
        }
    }

    fn write(row: &Path, column: &str, count: usize, seconds: f64) {
        let rays = vec![RayAnswer::closest(None); count];
        let file = row.join(column).with_extension("answer");
        let answers = Answers { seconds, rays };
        answers.write(&file).expect("it is writable");
    }

    /// Cases of another version have other files.
    #[test]
    fn cases_that_are_not_whole_are_named() {
        for name in ["parity.truth", "parity.case", "beside.truth"] {
            let found = problem(|row| {
                let file = row.join("../../cases").join(name);
                fs::remove_file(file).expect("it exists");
            });
            assert!(found.contains(&format!("cases/{name}: ")), "{found}");
            assert!(found.contains("writes the cases of this"), "{found}");
        }
    }

    #[test]
    fn what_no_adapter_writes_is_refused() {
        assert_eq!(problem(|_| ()), "Ok(Value(1000000.0))");
        type Change = fn(&Path);
        let error = |row: &Path| row.join("round_edge.error");
        let cases: [(Change, &str); 6] = [
            (|row| write(row, "round_edge", 0, 1.0), "0 answers"),
            (|row| write(row, "round_edge", 3, 1.0), "expected 1 to 2"),
            (|row| write(row, "round_edges", 1, 1.0), "no case has this"),
            (|row| write(row, "speed", 4, 0.0), "expected more than 0"),
            (|row| write(row, "speed", 4, f64::NAN), "more than 0"),
            (
                |row| fs::write(row.join("round_edge.error"), "E: no\n").expect("writable"),
                "remove the older file",
            ),
        ];
        for (change, expected) in cases {
            let found = problem(change);
            assert!(found.contains(expected), "{found}");
        }
        let told = problem(|row| {
            fs::remove_file(row.join("round_edge.answer")).expect("it exists");
            fs::write(error(row), "E: a\tb\nat line 2\n").expect("it is writable");
        });
        assert_eq!(told, "Ok(Error(\"E: a b\"))");
    }
}
