//! The rows as a text table: columns of one kind together.

use super::row::{Cell, Row};
use super::{COLUMNS, Column, Measure, WorldReport};
use crate::cells::framed;
use comfy_table::presets;
use plots::columns::Columns;
use plots::numbers::{figures, grouped};
use std::fmt::Write;

/// The heads of the table, and the columns that each has the worst of.
const GROUPS: [(&str, &[&str]); 12] = [
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
    ("beside", &["beside"]),
    ("start,\n%", &["at_start"]),
    ("end,\n%", &["at_end"]),
    ("on it,\n%", &["on_surface"]),
    ("count,\n%", &["parity"]),
    ("t, ulp", &["inner"]),
];

/// Explains the columns.
const LEGEND: &str = "\
Wrong answers in a million, in the worst case of a kind: rays at edges and vertices; at an integer terrain, exactly at its\n\
vertices and edges; from far away; at small and large scales; at slivers and double triangles; not at a vertex that is NaN;\n\
just beside an open mesh, where a hit is wrong.\n\
Start, end, on it: how many rays find a hit at an end of their range or where they start. Count: wrong numbers of hits.\n\
t: the largest error in units in the last place of the row's precision. * marks your own code; - is what a library cannot do.\n";

/// Formats the rows, and what is wrong in the student's.
pub(crate) fn show(report: &WorldReport) -> String {
    let name = |row: &Row| match row.million_rays.is_none() && Some(row) == report.yours.as_ref() {
        true => format!("* {}", row.name),
        false => row.name.clone(),
    };
    let columns = Columns::new("", name)
        .words("precision", |row| row.precision.name().into())
        .and("Mrays/s", |row| {
            row.million_rays.map_or(String::new(), figures)
        });
    let columns = GROUPS.iter().fold(columns, |columns, (head, names)| {
        columns.and(head, |row| worst(row, names))
    });
    let mut table = framed(&columns, report.yours.iter().chain(&report.libraries));
    table.load_style(presets::NOTHING);
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
        let (sentence, wrong) = verdict(row, &report.libraries);
        let _ = writeln!(text, "{sentence}");
        for line in wrong {
            let _ = writeln!(text, "  {line}");
        }
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

/// What the student's row shows: a sentence, and a line for each case in which it is wrong.
pub(super) fn verdict(row: &Row, all: &[Row]) -> (String, Vec<String>) {
    let libraries = || all.iter().filter(|row| row.is_of_a_library());
    let interfaces = libraries().count();
    let is_judged = |(column, _): &(&Column, &Cell)| column.measure == Measure::Wrong;
    let cells = || COLUMNS.iter().zip(&row.cells).filter(is_judged);
    let wrong = cells().filter_map(|(column, cell)| {
        let what = match cell {
            Cell::Value(wrong) if *wrong > 0.0 => format!("{} of a million wrong", grouped(*wrong)),
            Cell::Error(error) => error.clone(),
            Cell::Value(_) | Cell::None => return None,
        };
        let right = libraries().filter(|row| row.value(column.name) == Some(0.0));
        let (right, title) = (right.count(), column.title);
        Some(format!(
            "{what}: {title} ({right} of {interfaces} interfaces have none)"
        ))
    });
    let wrong: Vec<String> = wrong.collect();
    let (cases, rays) = (cells().count(), grouped(row.rays as f64));
    let sentence = match wrong.len() {
        0 => {
            let right = libraries().filter(|row| row.is_right());
            let names: Vec<&str> = right.map(|row| &*row.name).collect();
            format!(
                "Your code has no wrong answer in {cases} cases of {rays} rays. Of {interfaces} interfaces of libraries \
                 {} have none either, some of them in fewer rays: {}.",
                names.len(),
                names.join(", ")
            )
        }
        count => format!("Your code is wrong in {count} of {cases} cases of {rays} rays."),
    };
    (sentence, wrong)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::world::{Case, measure};
    use kernels::brute_force;
    use kit::Ray;

    /// A report on code that is right but for the rays that `loses` selects.
    fn report(loses: fn(&Case, &Ray) -> bool) -> WorldReport {
        let report = measure(12, &mut |case| {
            let triangles = case.triangles();
            let found = |ray: &&Ray| !loses(case, ray);
            let hits = case.rays.iter().map(|ray| {
                let hit = Some(ray).filter(found);
                hit.and_then(|ray| brute_force(&triangles, ray))
            });
            Ok(hits.map(|hit| hit.map(|(t, _)| t)).collect())
        });
        let mut report = report.expect("it is measured");
        let few = ["blender", "bvh_f64", "embree3_robust", "first_light"];
        report.libraries.retain(|row| few.contains(&&*row.name));
        report
    }

    fn verdict_on(report: &WorldReport) -> (String, Vec<String>) {
        verdict(report.yours.as_ref().expect("a row"), &report.libraries)
    }

    /// A box test that multiplies by `1/d` loses rays in the planes of the boxes' faces.
    #[test]
    fn lost_cases_are_listed_with_the_libraries_that_lose_nothing_there() {
        let report = report(|case, ray| {
            let vertices = &case.mesh.positions;
            let in_a_plane = |axis| vertices.iter().any(|p| p[axis] == ray.o[axis]);
            (0..3).any(|axis| ray.d[axis] == 0.0 && in_a_plane(axis))
        });
        let (sentence, wrong) = verdict_on(&report);
        assert_eq!(sentence, "Your code is wrong in 3 of 20 cases of 12 rays.");
        let lost = ["at vertices", "at edges", "in a plane of box faces"].map(|title| {
            format!("1,000,000 of a million wrong: integer terrain, {title} (2 of 3 interfaces have none)")
        });
        assert_eq!(wrong, lost);
        assert!(show(&report).contains(&wrong[2]));
    }

    #[test]
    fn code_without_a_wrong_answer_stands_beside_the_libraries_without_one() {
        let (sentence, wrong) = verdict_on(&report(|_, _| false));
        assert_eq!(
            sentence,
            "Your code has no wrong answer in 20 cases of 12 rays. Of 3 interfaces of libraries 1 have none either, some of them in fewer rays: blender."
        );
        assert_eq!(wrong, [""; 0]);
    }
}
