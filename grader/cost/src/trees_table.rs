//! Trees for people.

use super::table::{count, figures, nanoseconds, narrow, number, ratio};
use super::trees::{Trace, Trees};
use comfy_table::{Cell, Table};
use std::fmt::Write;

/// Both tables.
pub(super) fn show(trees: &Trees) -> String {
    let mut text = format!(
        "\nTrees over the {} mesh of {} triangles\n",
        trees.mesh, trees.triangles
    );
    let _ = writeln!(text, "{}\n{}", by_slack(trees), by_build(trees));
    if let Some(missing) = &trees.student_missing {
        let _ = writeln!(text, "No row of your own: {missing}.");
    }
    text.push_str(
        "Wrong: closest hits that differ from brute force, most of them asked for where triangles overlap in one plane.\n\
         Pays after: rays until the time saved is that spent on building, against the first tree.\n",
    );
    text
}

fn by_slack(trees: &Trees) -> Table {
    let header = ["pruned with a slack of".into()].into_iter().chain(heads());
    let mut table = narrow(header);
    for walk in &trees.by_slack {
        let name = match walk.slack_ulp {
            0 => "nothing".into(),
            ulp => format!("{ulp} ulp"),
        };
        table.add_row([Cell::new(name)].into_iter().chain(cells(&walk.trace)));
    }
    table
}

fn by_build(trees: &Trees) -> Table {
    let header = ["split at".into(), "build, ms".into(), "nodes".into()];
    let header = header.into_iter().chain(heads());
    let mut table = narrow(header.chain(["pays after".into()]));
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
        let pays = match tree.pays_after_rays {
            _ if i == 0 => String::new(),
            None => "never".into(),
            Some(0.0) => "at once".into(),
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

fn heads() -> impl Iterator<Item = String> {
    [
        "ns a ray",
        "of first's",
        "box tests",
        "triangle tests",
        "wrong/million",
    ]
    .into_iter()
    .map(String::from)
}

fn cells(trace: &Trace) -> [Cell; 5] {
    [
        nanoseconds(&trace.time),
        ratio(&trace.time),
        figures(trace.box_tests),
        figures(trace.prim_tests),
        count(trace.wrong_per_million),
    ]
    .map(number)
}
