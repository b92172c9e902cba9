//! The rows as a text table: columns of one kind together.

use super::row::{Cell, Row};
use super::{COLUMNS, Measure, WorldReport};
use comfy_table::{Cell as TableCell, CellAlignment, Table, presets};
use plots::numbers::{figures, grouped};
use std::fmt::Write;

/// The heads of the table, and the columns that each has the worst of.
const GROUPS: [(&str, &[&str]); 11] = [
    (
        "edges",
        &["round_edge", "round_vertex", "needle_edge", "needle_vertex"],
    ),
    (
        "grid",
        &[
            "grid_vertex",
            "grid_edge",
            "grid_diagonal",
            "grid_inside",
            "grid_slanted",
        ],
    ),
    ("far", &["far_1e4", "far_1e6", "far_1e8"]),
    (
        "scales",
        &["small", "large", "short_direction", "long_direction"],
    ),
    ("slivers,\ntwins", &["sliver", "duplicates"]),
    ("NaN", &["nan_vertex"]),
    ("start,\n%", &["at_start"]),
    ("end,\n%", &["at_end"]),
    ("on it,\n%", &["on_surface"]),
    ("count,\n%", &["parity"]),
    ("t, ulp", &["inner"]),
];

/// Explains the columns.
const LEGEND: &str = "\
Wrong answers in a million, in the worst case of a kind: rays at edges and vertices; at an integer terrain, exactly at its\n\
vertices and edges; from far away; at small and large scales; at slivers and double triangles; beside a vertex that is NaN.\n\
Start, end, on it: how many rays find a hit at an end of their range or where they start. Count: wrong numbers of hits.\n\
t: the largest error in units in the last place of the row's precision. * marks your own code; - is what a library cannot do.\n";

/// Formats the rows, and what is wrong in the student's.
pub(crate) fn show(report: &WorldReport) -> String {
    let mut table = Table::new();
    table.load_style(presets::NOTHING);
    let heads = ["", "precision", "Mrays/s"].into_iter();
    table.set_header(heads.chain(GROUPS.iter().map(|(head, _)| *head)));
    for row in report.yours.iter().chain(&report.libraries) {
        let star = if row.million_rays.is_none() && Some(row) == report.yours.as_ref() {
            "* "
        } else {
            ""
        };
        let speed = row.million_rays.map_or(String::new(), figures);
        let cells = GROUPS.iter().map(|(_, names)| worst(row, names));
        let right = |text: String| TableCell::new(text).set_alignment(CellAlignment::Right);
        let start =
            [format!("{star}{}", row.name), row.precision.name().into()].map(TableCell::new);
        table.add_row(
            start
                .into_iter()
                .chain([right(speed)])
                .chain(cells.map(right)),
        );
    }
    let mut text = String::from("\nWhat ray casters answer, judged by the exact oracle\n");
    for line in table.lines() {
        text += line.trim_end();
        text.push('\n');
    }
    if let Some(missing) = &report.missing {
        let _ = writeln!(text, "Your code is not measured: {missing}.");
    }
    text += LEGEND;
    if let Some(row) = &report.yours {
        text += &faults(row);
    }
    text
}

/// The worst cell of these columns: a row has errors, or the largest number, or the smallest where
/// hits are found.
fn worst(row: &Row, names: &[&str]) -> String {
    let all = COLUMNS.iter().zip(&row.cells);
    let cells: Vec<&Cell> = all
        .filter(|(column, _)| names.contains(&column.name))
        .map(|(_, cell)| cell)
        .collect();
    if cells.iter().any(|cell| matches!(cell, Cell::Error(_))) {
        return "error".into();
    }
    let values = names.iter().filter_map(|name| row.value(name));
    values.reduce(f64::max).map_or("-".into(), number)
}

fn number(value: f64) -> String {
    if value == 0.0 || value >= 100.0 {
        grouped(value)
    } else {
        figures(value)
    }
}

/// What is wrong in the student's row, case by case.
fn faults(row: &Row) -> String {
    let mut text = String::new();
    for (column, cell) in COLUMNS.iter().zip(&row.cells) {
        let _ = match (cell, column.measure) {
            (Cell::Value(wrong), Measure::Wrong) if *wrong > 0.0 => {
                writeln!(
                    text,
                    "  {} of a million wrong: {}",
                    grouped(*wrong),
                    column.title
                )
            }
            (Cell::Error(error), _) => writeln!(text, "  {error}: {}", column.title),
            _ => continue,
        };
    }
    match text.is_empty() {
        true => format!(
            "Yours has no wrong answer; {} rays in each case.\n",
            grouped(row.rays as f64)
        ),
        false => format!(
            "Yours, with {} rays in each case:\n{text}",
            grouped(row.rays as f64)
        ),
    }
}
