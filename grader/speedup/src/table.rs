//! The results as text.

use crate::measure::{Ladder, RungCost};
use crate::rays::RayKind;
use crate::rung::RungKind;
use meshes::MeshKind;
use std::fmt::Write;

/// Explains the columns.
const LEGEND: &str = "\
Mrays/s: millions of rays per second on one thread, medians of rounds in turns.
Camera and bounce rays look for the closest hit, shadow rays for any. The tests
are those of a bounce ray. Bytes are those of the tree, for each triangle.
* is your code: `bvh` calls your tests of boxes and triangles; `simd_bvh` has its
own tests of eight at a time, and calls yours for triangles that are too close.
";

/// What follows the rows: how the time of a ray grows, and what the columns are.
pub fn summary(ladder: &Ladder) -> String {
    let mut text = String::new();
    for why in &ladder.missing {
        let _ = writeln!(text, "{why}.");
    }
    if ladder.rows.is_empty() {
        return text;
    }
    growth(ladder) + &ladder.agreement() + "\n" + &text + LEGEND
}

/// The columns: their widths are fixed, because rows are printed before the next ones are known.
const COLUMNS: [(&str, &str, usize); 9] = [
    ("triangles", "", 9),
    ("step", "", 11),
    ("build", "ms", 8),
    ("bytes", "", 6),
    ("camera", "Mrays/s", 8),
    ("bounce", "", 7),
    ("shadow", "", 7),
    ("box", "tests", 7),
    ("triangle", "tests", 10),
];

/// The lines above the rows.
pub fn head(mesh: MeshKind) -> String {
    let first = line(COLUMNS.map(|(name, _, _)| name.into()));
    let second = line(COLUMNS.map(|(_, unit, _)| unit.into()));
    format!("The {} mesh, one thread\n{first}{second}", mesh.name())
}

/// The rows of the largest mesh so far.
pub fn latest_rows(ladder: &Ladder) -> String {
    let largest = ladder.rows.last().map_or(0, |row| row.triangles);
    let rows = ladder.rows.iter().filter(|row| row.triangles == largest);
    let mut text = String::new();
    for (i, row) in rows.enumerate() {
        let size = if i == 0 {
            largest.to_string()
        } else {
            String::new()
        };
        text.push_str(&line(cells(row, size)));
    }
    text
}

/// Numbers are at the right of their columns, names at the left.
fn line(cells: [String; COLUMNS.len()]) -> String {
    let mut text = String::new();
    for (i, (cell, (_, _, width))) in cells.into_iter().zip(COLUMNS).enumerate() {
        let _ = match i {
            0 | 1 => write!(text, " {cell:<width$}"),
            _ => write!(text, " {cell:>width$}"),
        };
    }
    text.truncate(text.trim_end().len());
    text.push('\n');
    text
}

fn cells(row: &RungCost, size: String) -> [String; COLUMNS.len()] {
    let [camera, bounce, shadow] = row.rays.map(|rays| figures(1e-6 / rays.seconds));
    let tests = &row.rays[RayKind::Bounce as usize];
    let has_tree = row.kind != RungKind::BruteForce;
    let of_tree = |text: String| if has_tree { text } else { String::new() };
    [
        size,
        row.kind.name().into(),
        of_tree(format!("{:.1}", 1e3 * row.build_s)),
        of_tree(format!("{:.0}", row.bytes as f64 / row.triangles as f64)),
        camera,
        bounce,
        shadow,
        of_tree(figures(tests.box_tests)),
        figures(tests.prim_tests),
    ]
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

/// How the times of a ray and of a build grow with the number of triangles.
fn growth(ladder: &Ladder) -> String {
    let mut text = String::from(
        "\nWith ten times the triangles a ray (camera, bounce, shadow) and a build take this\nmany times the time, which grows as a power of their number n:\n",
    );
    for kind in RungKind::ALL {
        let rays = RayKind::ALL.map(|rays| ladder.slope(kind, rays));
        let all = || rays.into_iter().chain([ladder.build_slope(kind)]).flatten();
        let factors: String = all()
            .map(|k| format!(" {:5.2}", 10.0_f64.powf(k)))
            .collect();
        let powers: String = all().map(|k| format!(" n^{k:.2}")).collect();
        if !factors.is_empty() {
            let _ = writeln!(text, "  {:<12}{factors:<24}  {powers}", kind.name());
        }
    }
    text
}
