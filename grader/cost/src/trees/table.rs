//! The results for trees as text tables.

use super::{
    BreakEven, ExactnessRow, SlackRow, TraversalCost, TreeReport, TreeRow, WrongHits, in_a_million,
};
use crate::cells::{figures, nanoseconds, narrow, plus_minus, ratio};
use comfy_table::Table;
use plots::columns::Columns;
use plots::numbers::grouped;
use std::fmt::Write;

/// Explains the columns.
const LEGEND: &str = "\
Times are medians of interleaved rounds, each pass after an untimed one with the same rays; ± reaches the farther quartile;\n\
~ marks a tie. Wrong: hits that differ from brute force, for some of the timed rays and for crafted rays, which are aimed at\n\
triangles that overlap in one plane. Break-even: rays after which the tracing time saved equals the additional build time,\n\
against the first tree; in brackets for the quartiles of both times. Missed and wrong in a million: rays at random triangles\n\
and edges that pass through the surface, or hit where nothing is; the first row is exact, and is compared with brute force for some.\n\
Lost on a grid: of a million rays exactly at vertices, edges and diagonals of an integer terrain, compared with brute force.\n";

/// Formats both tables.
pub(crate) fn show(trees: &TreeReport) -> String {
    let mut text = format!(
        "\nTrees over the {} mesh of {} triangles\n",
        trees.mesh, trees.triangles
    );
    let by_build = narrow(&by_build("* "), &trees.by_build);
    let _ = writeln!(text, "{}\n{by_build}", by_slack(trees));
    if !trees.by_precision.is_empty() {
        let by_precision = narrow(&by_precision(), &trees.by_precision);
        let _ = writeln!(text, "{by_precision}");
    }
    if let Some(missing) = &trees.student_missing {
        let _ = writeln!(text, "Your code is not measured: {missing}.");
    }
    text.push_str(LEGEND);
    text
}

fn by_slack(trees: &TreeReport) -> Table {
    let name = |row: &SlackRow| match row.slack_ulp {
        0 => "none".into(),
        ulp => format!("{ulp} ulp"),
    };
    let columns = Columns::new("pruning slack", name);
    narrow(&traced(columns, |row| &row.trace), &trees.by_slack)
}

/// The columns of trees, where the name of the student's begins with `star`.
pub(crate) fn by_build(star: &'static str) -> Columns<'static, TreeRow> {
    let name = move |tree: &TreeRow| match tree.student {
        true => format!("{star}{}", tree.name),
        false => tree.name.clone(),
    };
    let columns = Columns::new("split", name)
        .and("ms to\nbuild", |tree| {
            plus_minus(&tree.build_s.scaled(1e3), 1)
        })
        .and_some("nodes", |tree| Some(tree.nodes?.to_string()));
    let columns = traced(columns, |tree| &tree.trace);
    columns.and_some("rays to\nbreak even", |tree| match tree.break_even {
        BreakEven::Base => None,
        BreakEven::Immediate => Some("immediate".into()),
        BreakEven::Never => Some("never".into()),
        BreakEven::WithinNoise => Some("within noise".into()),
        BreakEven::After {
            rays,
            at_least,
            at_most,
        } => Some(format!("{rays:.1e} [{at_least:.0e}, {at_most:.0e}]")),
    })
}

/// What exactness costs: the first tree with other tests, in other precisions, and other trees.
pub(crate) fn by_precision() -> Columns<'static, ExactnessRow> {
    Columns::new("split", |row: &ExactnessRow| row.split.clone())
        .words("triangles", |row| {
            format!("{} {}", row.triangle_test, row.precision.name())
        })
        .words("boxes", |row| row.box_test.clone())
        .and("ulp of\nslack", |row| row.slack_ulp.to_string())
        .and("Mrays/s", |row| plus_minus(&row.rate(), 2))
        .and("vs. exact", |row| ratio(&row.time))
        .and("missed in\na million", |row| {
            grouped(in_a_million(row.missed, row.rays))
        })
        .and("wrong in\na million", |row| {
            grouped(in_a_million(row.wrong, row.rays))
        })
        .and("lost on\na grid", |row| {
            grouped(row.grid_lost_per_million())
        })
}

/// Adds the columns of what tracing costs.
fn traced<T: 'static>(
    columns: Columns<'static, T>,
    trace: fn(&T) -> &TraversalCost,
) -> Columns<'static, T> {
    let cell = |of: fn(&TraversalCost) -> String| move |row: &T| of(trace(row));
    columns
        .and("ns/ray", cell(|trace| nanoseconds(&trace.time)))
        .and("vs. first", cell(|trace| ratio(&trace.time)))
        .and("box\ntests", cell(|trace| figures(trace.box_tests)))
        .and("triangle\ntests", cell(|trace| figures(trace.prim_tests)))
        .and("wrong of\ntimed rays", cell(|trace| wrong(trace.ordinary)))
        .and_some("wrong of\ncrafted rays", move |row| {
            trace(row).crafted.map(wrong)
        })
}

fn wrong(hits: WrongHits) -> String {
    format!("{}/{}", hits.wrong, hits.rays)
}
