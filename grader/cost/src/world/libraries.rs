//! The libraries' answers: cases as files for their adapters, and the table of what they answered.

use super::case::Answers;
use super::column::{COLUMNS, speed};
use super::outcome::value;
use super::row::{self, Cell, KEYS, Row};
use super::truth;
use base::GraderError;
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
    write().map_err(|e: io::Error| GraderError::new(format!("{}: {e}", folder.display())))
}

fn truth_file(cases: &Path, column: &str) -> PathBuf {
    cases.join(column).with_extension("truth")
}

/// Judges the answers in the folders of `answers` by the truth in `cases`: a row for each folder
/// with a file `about.tsv`, sorted by name.
///
/// # Errors
///
/// If a file cannot be read, or is not what an adapter writes.
pub fn judge(cases: &Path, answers: &Path) -> Result<Vec<Row>, GraderError> {
    let mut folders = Vec::new();
    for entry in fs::read_dir(answers).map_err(|e| at(answers, &e))? {
        folders.push(entry.map_err(|e| at(answers, &e))?.path());
    }
    folders.sort();
    let truth = |name| Answers::read(&truth_file(cases, name));
    let truths: Vec<Answers> = COLUMNS
        .iter()
        .map(|column| truth(column.name))
        .collect::<Result<_, _>>()
        .map_err(|e| at(cases, &e))?;
    let rows = folders
        .iter()
        .filter(|folder| folder.join("about.tsv").is_file());
    rows.map(|folder| row_of(folder, &truths).map_err(|e| at(folder, &e)))
        .collect()
}

fn at(path: &Path, error: &io::Error) -> GraderError {
    GraderError::new(format!("{}: {error}", path.display()))
}

fn row_of(folder: &Path, truths: &[Answers]) -> io::Result<Row> {
    let about = fs::read_to_string(folder.join("about.tsv"))?;
    let key = |key: &str| {
        let mut lines = about.lines().filter_map(|line| line.split_once('\t'));
        let line = lines.find(|(name, _)| *name == key);
        line.map(|(_, value)| value.to_string())
            .ok_or_else(|| io::Error::other(format!("about.tsv has no line `{key}`")))
    };
    let [library, version, interface, precision] = KEYS.map(key);
    let precision = row::precision_of(&precision?).ok_or_else(|| {
        io::Error::other("about.tsv: the precision is neither f32, f64 nor f32 in f64")
    })?;
    let mut rays = 0;
    let mut cells = Vec::new();
    for (column, truth) in COLUMNS.iter().zip(truths) {
        let file = folder.join(column.name);
        let (error, answer) = (file.with_extension("error"), file.with_extension("answer"));
        cells.push(if error.is_file() {
            Cell::Error(fs::read_to_string(error)?.trim().replace('\t', " "))
        } else if answer.is_file() {
            let answers = Answers::read(&answer)?;
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
        speeds.push(1e-6 * answers.rays.len() as f64 / answers.seconds);
    }
    speeds.sort_by(f64::total_cmp);
    Ok(speeds.get(speeds.len() / 2).copied())
}
