//! The table `alike.csv`: all pairs that were found, one line each, without the passages.

use super::pairs::{Found, Student};
use crate::gradebook::table::text;
use base::{GraderError, write_whole_by};
use std::path::Path;

const HEADER: [&str; 6] = ["first", "second", "share", "expected", "passages", "tokens"];

/// Writes the pairs `found` among `students` to the file `path`, line by line.
pub fn write(path: &Path, students: &[Student], found: &[Found]) -> Result<(), GraderError> {
    write_whole_by(path, |file| {
        let mut writer = csv::WriterBuilder::new()
            .terminator(csv::Terminator::CRLF)
            .from_writer(file);
        writer.write_record(HEADER)?;
        for pair in found {
            let [first, second] = pair.both.map(|i| text(&students[i].name.line()));
            writer.write_record([
                first,
                second,
                format!("{:.2}", pair.share),
                format!("{:.1e}", pair.expected),
                pair.passages.to_string(),
                pair.tokens.to_string(),
            ])?;
        }
        writer.flush()
    })
}
