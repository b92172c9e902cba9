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
    let _ = writeln!(text, "{}", ladder.agreement());
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
    let mut text = String::from(
        "With ten times the triangles a ray takes this many times the time (camera,\nbounce, shadow), which grows as a power of their number n:\n",
    );
    for kind in RungKind::ALL {
        let all = |of: &dyn Fn(RayKind) -> Option<String>| -> Vec<String> {
            RayKind::ALL.into_iter().filter_map(of).collect()
        };
        let factors = all(&|rays| Some(format!("{:5.2}", ladder.tenfold(kind, rays)?)));
        let powers = all(&|rays| Some(format!("n^{:.2}", ladder.slope(kind, rays)?)));
        if !factors.is_empty() {
            let _ = writeln!(
                text,
                "  {:<12} {}   {}",
                kind.name(),
                factors.join(" "),
                powers.join(" ")
            );
        }
    }
    text
}
