//! The results as text.

use crate::measure::{Ladder, RungCost};
use crate::plot;
use crate::rays::RayKind;
use crate::rung::RungKind;
use comfy_table::{Cell, CellAlignment, Table, presets};
use std::fmt::Write;

/// Explains the columns.
const LEGEND: &str = "\
Mrays/s: millions of rays per second on one thread, medians of rounds in turns.
Camera and bounce rays look for the closest hit, shadow rays for any. The tests
are those of a bounce ray. Bytes are those of the tree, for each triangle.
* is your code: `bvh` and `simd_bvh`; both use your tests of boxes and triangles.
";

/// Formats the table, the plot, and how the time of a ray grows.
pub fn show(ladder: &Ladder) -> String {
    let mut text = format!("The {} mesh, one thread\n{}\n", ladder.mesh, table(ladder));
    text.push_str(&plot::show(ladder));
    text.push_str(&growth(ladder));
    let checked = ladder
        .rows
        .iter()
        .map(|row| row.checked_rays)
        .sum::<usize>();
    let differing = ladder
        .rows
        .iter()
        .map(|row| row.differing_hits)
        .sum::<usize>();
    let _ = match differing {
        0 => writeln!(
            text,
            "All steps find the hits of brute force, in {checked} comparisons."
        ),
        _ => writeln!(
            text,
            "{differing} of {checked} hits differ from those of brute force."
        ),
    };
    for why in &ladder.missing {
        let _ = writeln!(text, "{why}.");
    }
    text.push_str(LEGEND);
    text
}

fn table(ladder: &Ladder) -> Table {
    let mut table = Table::new();
    table.load_style(presets::NOTHING);
    table.set_header([
        "triangles",
        "step",
        "build\nms",
        "bytes",
        "camera\nMrays/s",
        "bounce",
        "shadow",
        "box\ntests",
        "triangle\ntests",
    ]);
    for (i, column) in table.column_iter_mut().enumerate() {
        column.set_padding((1, 0));
        if i > 1 {
            column.set_cell_alignment(CellAlignment::Right);
        }
    }
    let mut last = 0;
    for row in &ladder.rows {
        let size = if row.triangles == last {
            String::new()
        } else {
            row.triangles.to_string()
        };
        last = row.triangles;
        table.add_row(cells(row, size));
    }
    table
}

fn cells(row: &RungCost, size: String) -> Vec<Cell> {
    let bounce = &row.rays[RayKind::Bounce as usize];
    let has_tree = row.kind != RungKind::BruteForce;
    let tree = |text: String| if has_tree { text } else { String::new() };
    let mut cells = vec![
        size,
        row.kind.name().into(),
        tree(format!("{:.1}", 1e3 * row.build_s)),
        tree(format!("{:.0}", row.bytes as f64 / row.triangles as f64)),
    ];
    cells.extend(row.rays.iter().map(|rays| figures(1e-6 / rays.seconds)));
    cells.extend([tree(figures(bounce.box_tests)), figures(bounce.prim_tests)]);
    cells.into_iter().map(Cell::new).collect()
}

/// Two or three significant figures.
fn figures(x: f64) -> String {
    match x {
        _ if !x.is_finite() => "-".into(),
        0.0..0.001 => format!("{x:.1e}"),
        0.001..0.1 => format!("{x:.4}"),
        0.1..10.0 => format!("{x:.2}"),
        _ => format!("{x:.1}"),
    }
}

/// How the time of a ray grows with the number of triangles.
fn growth(ladder: &Ladder) -> String {
    let mut text =
        String::from("With n triangles, the time of a ray grows as (camera, bounce, shadow):\n");
    for kind in RungKind::ALL {
        let slopes: Vec<String> = RayKind::ALL
            .iter()
            .filter_map(|&rays| ladder.slope(kind, rays))
            .map(|slope| format!("n^{slope:.2}"))
            .collect();
        if !slopes.is_empty() {
            let _ = writeln!(text, "  {:<12} {}", kind.name(), slopes.join("  "));
        }
    }
    text
}
