//! The results for trees as text tables.

use super::{BreakEven, TraversalCost, TreeReport, WrongHits, in_a_million};
use crate::table::{count, figures, nanoseconds, narrow, number, plus_minus, ratio};
use comfy_table::{Cell, Table};
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
    let _ = writeln!(text, "{}\n{}", by_slack(trees), by_build(trees));
    if !trees.by_precision.is_empty() {
        let _ = writeln!(text, "{}", by_precision(trees));
    }
    if let Some(missing) = &trees.student_missing {
        let _ = writeln!(text, "Your code is not measured: {missing}.");
    }
    text.push_str(LEGEND);
    text
}

fn by_slack(trees: &TreeReport) -> Table {
    let header = ["pruning slack".into()].into_iter().chain(headings());
    let mut table = narrow(header);
    for row in &trees.by_slack {
        let name = match row.slack_ulp {
            0 => "none".into(),
            ulp => format!("{ulp} ulp"),
        };
        table.add_row([Cell::new(name)].into_iter().chain(cells(&row.trace)));
    }
    table
}

fn by_build(trees: &TreeReport) -> Table {
    let header = ["split".into(), "build, ms".into(), "nodes".into()]
        .into_iter()
        .chain(headings());
    let mut table = narrow(header.chain(["break-even, rays".into()]));
    for tree in &trees.by_build {
        let star = if tree.student { "* " } else { "" };
        let build = plus_minus(&tree.build_s.scaled(1e3), 1);
        let nodes = tree.nodes.map_or(String::new(), |nodes| nodes.to_string());
        let name = Cell::new(format!("{star}{}", tree.name));
        let start = [name, number(build), number(nodes)];
        let pays = match tree.break_even {
            BreakEven::Base => String::new(),
            BreakEven::Immediate => "immediate".into(),
            BreakEven::Never => "never".into(),
            BreakEven::WithinNoise => "within noise".into(),
            BreakEven::After {
                rays,
                at_least,
                at_most,
            } => {
                format!("{rays:.1e} [{at_least:.0e}, {at_most:.0e}]")
            }
        };
        table.add_row(
            start
                .into_iter()
                .chain(cells(&tree.trace))
                .chain([number(pays)]),
        );
    }
    table
}

/// What exactness costs: the first tree with other tests, in other precisions, and other trees.
fn by_precision(trees: &TreeReport) -> Table {
    let mut table = narrow([
        "split",
        "triangles",
        "boxes",
        "slack,\nulp",
        "ns/ray",
        "vs. exact",
        "missed in\na million",
        "wrong in\na million",
        "lost on\na grid",
    ]);
    for row in &trees.by_precision {
        let cells = [
            row.slack_ulp.to_string(),
            nanoseconds(&row.time),
            ratio(&row.time),
            count(in_a_million(row.missed, row.rays)),
            count(in_a_million(row.wrong, row.rays)),
            count(row.grid_lost_per_million()),
        ];
        let tests = [
            row.split.clone(),
            format!("{}, {}", row.triangle_test, row.precision.name()),
            row.box_test.clone(),
        ];
        let tests = tests.into_iter().map(Cell::new);
        table.add_row(tests.chain(cells.map(number)));
    }
    table
}

fn headings() -> impl Iterator<Item = String> {
    [
        "ns/ray",
        "vs. first",
        "box\ntests",
        "triangle\ntests",
        "wrong of\ntimed rays",
        "wrong of\ncrafted rays",
    ]
    .into_iter()
    .map(String::from)
}

fn cells(trace: &TraversalCost) -> [Cell; 6] {
    [
        nanoseconds(&trace.time),
        ratio(&trace.time),
        figures(trace.box_tests),
        figures(trace.prim_tests),
        wrong(trace.ordinary),
        trace.crafted.map_or(String::new(), wrong),
    ]
    .map(number)
}

fn wrong(hits: WrongHits) -> String {
    format!("{}/{}", hits.wrong, hits.rays)
}
