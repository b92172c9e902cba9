//! The table of speedups.

use crate::speedup::{Growth, Speedup, Speedups};
use comfy_table::{Cell, CellAlignment, Table, presets};
use std::fmt::Write;

/// What the tree saves, for people.
pub(crate) fn show(speedups: &Speedups) -> String {
    let mut text = String::new();
    if !speedups.rows.is_empty() {
        let _ = writeln!(
            text,
            "\nYour tree against your brute force (no points, only for you to see)"
        );
        let _ = writeln!(text, "{}", table(&speedups.rows));
        let sampled = |by: fn(u64, u64) -> u64| {
            speedups
                .rows
                .iter()
                .map(|row| row.brute_rays)
                .reduce(by)
                .unwrap_or(0)
        };
        let _ = writeln!(
            text,
            "* extrapolated from a sample: {} rays through the largest mesh, {} through the smallest, medians of interleaved rounds.",
            sampled(u64::min),
            sampled(u64::max),
        );
        text.push_str("  In brackets: the tests of the reference's tree. Its midpoint splits can be bettered.\n");
    }
    for growth in &speedups.growth {
        text.push_str(&growth_in_words(growth));
    }
    for row in speedups.rows.iter().filter(|row| row.differing_hits > 0) {
        let _ = writeln!(
            text,
            "On the {} mesh of {} triangles tree and brute force find different hits on {} of {} rays: see the cases of part2.task3.",
            row.mesh, row.triangles, row.differing_hits, row.brute_rays
        );
    }
    if let Some(why) = &speedups.missing {
        let _ = writeln!(text, "\nThe table of speedups is not complete: {why}.");
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
        "tree\nMrays/s",
        "speedup",
        "box tests\na ray",
        "primitive\ntests a ray",
    ]);
    for row in rows {
        let numbers = [
            row.triangles.to_string(),
            seconds(row.build_s),
            rate(row.brute_s),
            rate(row.tree_s),
            format!("{}x", figures(row.speedup)),
            format!("{:.1} ({:.1})", row.work.boxes, row.reference.boxes),
            format!("{:.1} ({:.1})", row.work.prims, row.reference.prims),
        ];
        let cells = numbers.map(|number| Cell::new(number).set_alignment(CellAlignment::Right));
        table.add_row([Cell::new(&row.mesh)].into_iter().chain(cells));
    }
    table
}

fn growth_in_words(growth: &Growth) -> String {
    let Growth {
        mesh,
        brute,
        tree,
        tests,
        build,
    } = growth;
    format!(
        "On the {mesh} mesh of n triangles a ray costs n^{brute:.2} by brute force and n^{tree:.2} through your tree (its tests: n^{tests:.2}); building takes n^{build:.2}.\n"
    )
}

fn seconds(s: f64) -> String {
    if s < 1.0 {
        format!("{} ms", figures(1e3 * s))
    } else {
        format!("{} s", figures(s))
    }
}

/// Millions of rays a second.
fn rate(seconds_a_ray: f64) -> String {
    figures(1e-6 / seconds_a_ray)
}

/// Three significant figures, as far as they stand before or just behind the point.
fn figures(x: f64) -> String {
    let decimals = (2.0 - x.abs().log10().floor()).clamp(0.0, 7.0);
    format!("{x:.*}", decimals as usize)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_three_figures() {
        assert_eq!(figures(1234.5), "1234");
        assert_eq!(figures(12.345), "12.3");
        assert_eq!(figures(0.012345), "0.0123");
        assert_eq!(seconds(0.0421), "42.1 ms");
        assert_eq!(rate(4e-7), "2.50");
    }

    #[test]
    fn a_table_that_is_not_complete_says_why() {
        let speedups = Speedups {
            missing: Some("it needs part1.task3 (Intersecting triangles)".into()),
            ..Speedups::default()
        };
        assert_eq!(
            show(&speedups),
            "\nThe table of speedups is not complete: it needs part1.task3 (Intersecting triangles).\n"
        );
    }
}
