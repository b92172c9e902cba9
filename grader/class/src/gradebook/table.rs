//! The gradebook of a class: one line for each submission. RFC 4180.
//!
//! The columns are `id`, `name`, `status`, core points and extra credit with what is possible, both
//! for each task, and a note.

use base::GraderError;
use csv::{Terminator, WriterBuilder};
use submission::{Layout, shown};

/// The columns before those of the tasks.
const COLUMNS: [&str; 7] = [
    "id",
    "name",
    "status",
    "score",
    "max_score",
    "extra",
    "max_extra",
];

/// A submission. What is not known is empty; points of a submission without a score are empty, never
/// zero.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Line {
    /// The student's identifier in the course system.
    pub id: String,
    /// The student's name.
    pub name: String,
    /// How grading ended.
    pub status: String,
    /// Core and extra points.
    pub score: Option<[f64; 2]>,
    /// Core and extra points of each task, in the order of the columns.
    pub tasks: Vec<[f64; 2]>,
    /// What a person should know.
    pub note: String,
}

/// The table. `tasks` are the keys of the tasks, `max` the core and extra points possible.
pub fn write(tasks: &[&str], max: [f64; 2], lines: &[Line]) -> Result<String, GraderError> {
    let mut header: Vec<String> = COLUMNS.map(str::to_owned).to_vec();
    for task in tasks {
        header.extend([(*task).to_owned(), format!("{task} extra")]);
    }
    header.push("note".into());
    let mut records = vec![header];
    for line in lines {
        let number = |points: Option<f64>| points.map(points_text).unwrap_or_default();
        let score = |i: usize| number(line.score.map(|score| score[i]));
        let mut record = vec![
            text(&line.id),
            text(&line.name),
            text(&line.status),
            score(0),
            points_text(max[0]),
            score(1),
            points_text(max[1]),
        ];
        for i in 0..tasks.len() {
            let earned = line.score.and(line.tasks.get(i));
            record.extend([0, 1].map(|tier| number(earned.map(|earned| earned[tier]))));
        }
        record.push(text(&line.note));
        records.push(record);
    }
    table(&records)
}

/// A table of records. Their texts are to be [`text`] already.
pub fn table(records: &[Vec<String>]) -> Result<String, GraderError> {
    let failed = |e: &dyn std::fmt::Display| GraderError::new(format!("cannot write CSV: {e}"));
    let mut writer = WriterBuilder::new()
        .terminator(Terminator::CRLF)
        .from_writer(Vec::new());
    for record in records {
        writer.write_record(record).map_err(|e| failed(&e))?;
    }
    let bytes = writer.into_inner().map_err(|e| failed(&e))?;
    String::from_utf8(bytes).map_err(|e| failed(&e))
}

/// Points with at most three decimals.
pub fn points_text(points: f64) -> String {
    let text = format!("{points:.3}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    match text {
        "-0" => "0".to_string(),
        text => text.to_string(),
    }
}

/// Characters with which a spreadsheet begins a formula, also as wide and as small ones.
const FORMULA: [char; 12] = [
    '=', '+', '-', '@', '＝', '＋', '－', '＠', '﹦', '﹢', '﹣', '﹫',
];

/// A text as a field, shown as text that was handed in is. Where a spreadsheet would read a formula,
/// at the start, perhaps after blanks, or, where `;` divides columns, after one, it gets an
/// apostrophe in front.
pub fn text(text: &str) -> String {
    let shown = shown(text, Layout::Line);
    let parts = shown.split(';').map(|part| {
        let is_formula = part.trim_start().starts_with(FORMULA);
        let apostrophe = if is_formula { "'" } else { "" };
        format!("{apostrophe}{part}")
    });
    parts.collect::<Vec<_>>().join(";")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fields_are_quoted_and_formulas_defused() {
        for (field, written) in [
            ("anna", "anna"),
            ("a, \"b\"", "\"a, \"\"b\"\"\""),
            ("=1+1", "'=1+1"),
            ("@x", "'@x"),
            ("-2", "'-2"),
            ("+cmd|' /C calc'!A0", "'+cmd|' /C calc'!A0"),
            ("\t=1", "\\t=1"),
            (" =1", "' =1"),
            ("\u{3000}\u{a0}-1", "'\u{3000}\u{a0}-1"),
            ("＝1", "'＝1"),
            ("a; ＠b", "a;' ＠b"),
            (" a=1", " a=1"),
            ("a;=1", "a;'=1"),
            ("two\nlines", "two\\nlines"),
            ("\u{202e}evil\r", "\\u{202e}evil\\u{d}"),
        ] {
            let table = table(&[vec![text(field), "x".into()]]).expect("a table");
            assert_eq!(table, format!("{written},x\r\n"));
        }
    }

    #[test]
    fn a_line_without_a_score_has_no_points() {
        let line = Line {
            id: "anna".into(),
            status: "infrastructure".into(),
            note: "the disk is full".into(),
            ..Line::default()
        };
        let written = write(&["part1.task1"], [10.0, 2.5], &[line]).expect("a table");
        assert_eq!(
            written,
            "id,name,status,score,max_score,extra,max_extra,part1.task1,part1.task1 extra,note\r\n\
             anna,,infrastructure,,10,,2.5,,,the disk is full\r\n"
        );
    }

    #[test]
    fn points_have_no_needless_digits() {
        for (number, text) in [
            (80.0, "80"),
            (21.05, "21.05"),
            (1.0 / 3.0, "0.333"),
            (0.0, "0"),
            (-1e-9, "0"),
        ] {
            assert_eq!(points_text(number), text);
        }
    }
}
