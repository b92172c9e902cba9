//! The table `gradebook.csv`: one line for each submission. `id` is the name of its folder or
//! archive.

use crate::collect::{Class, Row, points};
use std::fmt::Write;

/// Writes the table (RFC 4180). A submission without a score has empty cells, never a zero.
pub fn write(class: &Class) -> String {
    let mut table = String::from("id,status,score,max_score,extra,max_extra");
    for task in &class.plan.tasks {
        let _ = write!(table, ",{0},{0} extra", field(&task.key));
    }
    table.push_str(",note\r\n");
    for row in &class.rows {
        write_row(&mut table, class, row);
    }
    table
}

fn write_row(table: &mut String, class: &Class, row: &Row) {
    let [max_core, max_extra] = class.max_score().map(points);
    let _ = write!(table, "{},{}", field(&row.name), row.status.label());
    match &row.score {
        Some(score) => {
            let (core, extra) = (points(score.core), points(score.extra));
            let _ = write!(table, ",{core},{max_core},{extra},{max_extra}");
        }
        None => {
            let _ = write!(table, ",,{max_core},,{max_extra}");
        }
    }
    for task in &class.plan.tasks {
        let _ = match &row.score {
            Some(score) => {
                let earned = score.tasks.get(&task.key).copied().unwrap_or_default();
                let [core, extra] = earned.map(points);
                write!(table, ",{core},{extra}")
            }
            None => write!(table, ",,"),
        };
    }
    let notes = row
        .status
        .detail()
        .into_iter()
        .chain(row.notes.iter().map(String::as_str));
    let notes: Vec<&str> = notes.collect();
    let _ = write!(table, ",{}\r\n", field(&notes.join("; ")));
}

/// Characters with which a spreadsheet begins a formula. Some read on after a tab or a line end.
const FORMULA: [char; 6] = ['=', '+', '-', '@', '\t', '\r'];

/// Formats a text as a field. One that a spreadsheet would read as a formula gets an apostrophe in
/// front.
pub fn field(text: &str) -> String {
    let text = match text.starts_with(FORMULA) {
        true => format!("'{text}"),
        false => text.to_string(),
    };
    match text.contains([',', ';', '"', '\n', '\r', '\'']) {
        true => format!("\"{}\"", text.replace('"', "\"\"")),
        false => text,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fields_are_quoted_and_formulas_defused() {
        for (text, written) in [
            ("anna", "anna"),
            ("a, \"b\"", "\"a, \"\"b\"\"\""),
            ("=1+1", "\"'=1+1\""),
            ("@x", "\"'@x\""),
            ("-2", "\"'-2\""),
            ("+cmd|' /C calc'!A0", "\"'+cmd|' /C calc'!A0\""),
            ("\t=1", "\"'\t=1\""),
            ("two\nlines", "\"two\nlines\""),
        ] {
            assert_eq!(field(text), written);
        }
    }
}
