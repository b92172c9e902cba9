//! Formats the table of speedups.

use crate::grade::speedup::{Growth, Speedup, Speedups};
use base::digits;
use comfy_table::{Cell, CellAlignment, Table, presets};
use std::fmt::Write;

/// Formats the speedups for people: the table, the growth of the cost, and what is missing.
pub(crate) fn format_speedups(speedups: &Speedups) -> String {
    let mut text = String::new();
    if !speedups.rows.is_empty() {
        let _ = writeln!(
            text,
            "\nYour BVH compared with your brute force (for information only, no points)"
        );
        let _ = writeln!(text, "{}", table(&speedups.rows));
        let sample_size = |by: fn(u64, u64) -> u64| {
            speedups
                .rows
                .iter()
                .map(|row| row.brute_rays)
                .reduce(by)
                .unwrap_or(0)
        };
        let _ = writeln!(
            text,
            "* estimated from a sample of rays: {} for the largest mesh, {} for the smallest. Times are medians of interleaved rounds; ± reaches the farthest round.",
            sample_size(u64::min),
            sample_size(u64::max),
        );
        text.push_str("  In brackets: the number of tests with the reference's BVH. It splits at midpoints, so you can do better.\n");
    }
    for growth in &speedups.growth {
        text.push_str(&growth_sentence(growth));
    }
    for row in speedups.rows.iter().filter(|row| row.differing_hits > 0) {
        let _ = writeln!(
            text,
            "On the {} mesh of {} triangles your BVH and your brute force find different hits on {} of {} rays: see the cases of part2.task3.",
            row.mesh, row.triangles, row.differing_hits, row.brute_rays
        );
    }
    if let Some(why) = &speedups.missing {
        let _ = writeln!(text, "\nThe table of speedups is incomplete: {why}.");
    }
    text
}

fn table(rows: &[Speedup]) -> Table {
    let mut table = Table::new();
    table.load_style(presets::UTF8_BORDERS_ONLY).set_header([
        "mesh",
        "triangles",
        "build",
        "brute force*\nMrays/s",
        "BVH\nMrays/s",
        "speedup",
        "box tests\nper ray",
        "primitive\ntests per ray",
    ]);
    for row in rows {
        let numbers = [
            row.triangles.to_string(),
            seconds(row.build_s),
            rate(row.brute_s),
            rate(row.tree_s),
            speedup(row),
            format!("{:.1} ({:.1})", row.work.boxes, row.reference.boxes),
            format!("{:.1} ({:.1})", row.work.prims, row.reference.prims),
        ];
        let cells = numbers.map(|number| Cell::new(number).set_alignment(CellAlignment::Right));
        table.add_row([Cell::new(&row.mesh)].into_iter().chain(cells));
    }
    table
}

fn speedup(row: &Speedup) -> String {
    let [low, high] = row.speedup_range;
    let error = (row.speedup - low).max(high - row.speedup);
    let decimals = digits::decimals(row.speedup, 3).min(7);
    format!("{:.decimals$}x ±{error:.decimals$}", row.speedup)
}

fn growth_sentence(growth: &Growth) -> String {
    let Growth {
        mesh,
        brute,
        tree,
        tests,
        build,
    } = growth;
    format!(
        "On the {mesh} mesh of n triangles, the time per ray grows as n^{brute:.2} by brute force and as n^{tree:.2} with your BVH (its tests: n^{tests:.2}); the build time grows as n^{build:.2}.\n"
    )
}

fn seconds(s: f64) -> String {
    if s < 1.0 {
        format!("{} ms", three_digits(1e3 * s))
    } else {
        format!("{} s", three_digits(s))
    }
}

/// Millions of rays per second.
fn rate(seconds_per_ray: f64) -> String {
    three_digits(1e-6 / seconds_per_ray)
}

/// A number with three significant digits, but with all digits before the decimal point.
fn three_digits(x: f64) -> String {
    format!("{x:.*}", digits::decimals(x, 3).min(7))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_three_significant_digits() {
        assert_eq!(three_digits(1234.5), "1234");
        assert_eq!(three_digits(12.345), "12.3");
        assert_eq!(three_digits(0.012345), "0.0123");
        assert_eq!(seconds(0.0421), "42.1 ms");
        assert_eq!(rate(4e-7), "2.50");
    }

    #[test]
    fn an_incomplete_table_gives_the_reason() {
        let speedups = Speedups {
            missing: Some("it needs part1.task3 (Intersecting triangles)".into()),
            ..Speedups::default()
        };
        assert_eq!(
            format_speedups(&speedups),
            "\nThe table of speedups is incomplete: it needs part1.task3 (Intersecting triangles).\n"
        );
    }
}
