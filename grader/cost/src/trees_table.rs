//! The results for trees as text tables.

use super::table::{count, figures, nanoseconds, narrow, number, ratio};
use super::trees::{TraversalCost, TreeReport};
use comfy_table::{Cell, Table};
use std::fmt::Write;

/// Formats both tables.
pub(super) fn show(trees: &TreeReport) -> String {
    let mut text = format!(
        "\nTrees over the {} mesh of {} triangles\n",
        trees.mesh, trees.triangles
    );
    let _ = writeln!(text, "{}\n{}", by_slack(trees), by_build(trees));
    if let Some(missing) = &trees.student_missing {
        let _ = writeln!(text, "Your code is not measured: {missing}.");
    }
    text.push_str(
        "Wrong: closest hits that differ from brute force; most checked rays are aimed at coplanar overlapping triangles.\n\
         Break-even: rays after which the tracing time saved equals the additional build time, against the first tree.\n",
    );
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
    let header = ["split".into(), "build, ms".into(), "nodes".into()];
    let header = header.into_iter().chain(headings());
    let mut table = narrow(header.chain(["break-even".into()]));
    for (i, tree) in trees.by_build.iter().enumerate() {
        let star = if tree.student { "* " } else { "" };
        let build = format!(
            "{:.1} ±{:.1}",
            1e3 * tree.build_s,
            1e3 * tree.build_spread_s
        );
        let nodes = tree.nodes.map_or(String::new(), |nodes| nodes.to_string());
        let name = Cell::new(format!("{star}{}", tree.name));
        let start = [name, number(build), number(nodes)];
        let pays = match tree.break_even_rays {
            _ if i == 0 => String::new(),
            None => "never".into(),
            Some(0.0) => "immediate".into(),
            Some(rays) => format!("{} rays", figures(rays)),
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

fn headings() -> impl Iterator<Item = String> {
    [
        "ns/ray",
        "vs. first",
        "box tests",
        "triangle tests",
        "wrong/million",
    ]
    .into_iter()
    .map(String::from)
}

fn cells(trace: &TraversalCost) -> [Cell; 5] {
    [
        nanoseconds(&trace.time),
        ratio(&trace.time),
        figures(trace.box_tests),
        figures(trace.prim_tests),
        count(trace.wrong_per_million),
    ]
    .map(number)
}
