//! The distribution of the errors of `t`, compared with the forward error bound.

use super::kernel_name::name;
use crate::report::{Accuracy, KernelFamily, KernelRow, Precision, Quantiles, RayFamily};
use plots::canvas::{Label, for_both_widths};
use plots::columns::Columns;
use plots::figure::Figure;
use plots::numbers::{figures, list, rounded, tick};
use plots::plot::{Axis, Plot};
use plots::style::{self, BOUND, SeriesStyle};

const WIDTH: f64 = 860.0;
/// Size of each of the two plots, with the legend beside them.
const PLOT: [f64; 2] = [325.0, 330.0];
/// Size of each of the two plots on a telephone, one below the other, with the legend below them.
const NARROW_PLOT: [f64; 2] = [300.0, 270.0];
/// Distance of the lines of the legend.
const LINE: f64 = 14.0;

/// Smaller errors are drawn here.
const LEAST: f64 = 1e-18;

/// Draws the distributions.
pub(crate) fn figure(family: &KernelFamily) -> Figure {
    let hard = most_different(family);
    let label = format!("Distribution of errors of t: {}", family.shape.name());
    let shown: Vec<RayFamily> = [Some(RayFamily::Ordinary), hard]
        .into_iter()
        .flatten()
        .collect();
    let below = NARROW_PLOT[1] * shown.len() as f64;
    let entries = 2 + names(family).len();
    let narrow = [NARROW_PLOT[0], below + LINE * (entries as f64 + 1.0)];
    let drawing = for_both_widths([WIDTH, PLOT[1]], narrow, &label, |canvas, _, is_narrow| {
        for (i, rays) in shown.iter().enumerate() {
            let x = Axis::log("relative error of t", [LEAST, 1.0], tick);
            let ticks = (0..=4).map(|i| f64::from(i) / 4.0);
            let percent = |v| format!("{:.0} %", 100.0 * v);
            let y = Axis::linear("hits with at most this error", [0.0, 1.02], ticks, percent);
            let (corner, size) = match is_narrow {
                false => ((i as f64 * PLOT[0], 0.0), PLOT),
                true => ((0.0, i as f64 * NARROW_PLOT[1]), NARROW_PLOT),
            };
            let title = format!("rays: {}", rays.name());
            let plot = Plot::new(canvas, &title, corner, size, x, y);
            for precision in [Precision::F64, Precision::F32] {
                let mut rows = family.rows.iter().filter(|row| row.precision == precision);
                if let Some(bound) = rows
                    .find_map(|row| accuracy(row, *rays).filter(|a| !a.forward_bound.is_empty()))
                {
                    plot.line(bound_style(precision), &steps(&bound.forward_bound), 2.6);
                }
            }
            for row in &family.rows {
                if let Some(accuracy) = accuracy(row, *rays).filter(|a| !a.cdf.is_empty()) {
                    plot.line(style_of(family, row), &steps(&accuracy.cdf), width(row));
                }
            }
        }
        let (x, mut y) = match is_narrow {
            false => (2.0 * PLOT[0] + 12.0, 26.0),
            true => (12.0, below + LINE),
        };
        for precision in [Precision::F64, Precision::F32] {
            let style = bound_style(precision);
            style::line(canvas, style, &[(x, y), (x + 26.0, y)], 2.6);
            let text = format!("bound of {}", precision.name());
            canvas.text(&text, (x + 32.0, y), Label::left(9.0));
            y += LINE;
        }
        for named in names(family) {
            let rows = || family.rows.iter().filter(|row| row.name == named);
            if let Some(row) = rows().next() {
                style::line(
                    canvas,
                    style_of(family, row),
                    &[(x, y), (x + 26.0, y)],
                    width(row),
                );
                let precisions: Vec<&str> = rows().map(|row| row.precision.name()).collect();
                let text = format!("{named} ({})", precisions.join(", "));
                canvas.text(&text, (x + 32.0, y), Label::left(9.0));
                y += LINE;
            }
        }
    });
    type Quantile = (&'static str, fn(&Quantiles) -> f64);
    let quantiles: [Quantile; 3] = [
        ("median", |of| of.p50),
        ("99.9 %", |of| of.p999),
        ("largest", |of| of.max),
    ];
    let all = shown
        .iter()
        .flat_map(|rays| quantiles.map(|of| (*rays, of)));
    let columns = all.fold(Columns::new("test", name), |columns, (rays, (name, of))| {
        columns.and_some(&format!("{}: {name}", rays.name()), move |row| {
            Some(figures(of(&accuracy(row, rays)?.t?.relative)))
        })
    });
    let figure = Figure {
        finding: finding(family, hard),
        drawing,
        caption: "The share of hits whose relative error of t is at most the value on the axis; the thick grey lines are the forward error \
                  bounds of robust tests."
            .into(),
        notes: caption(family, hard),
        ..Figure::default()
    };
    columns.table(&family.rows, figure)
}

/// What the plot shows: by how much the best test is better than the worst on hard rays.
fn finding(family: &KernelFamily, hard: Option<RayFamily>) -> String {
    let both = hard.and_then(|rays| Some((rays, extremes(family, rays)?)));
    match both {
        Some((rays, [best, worst])) if worst.1 > 2.0 * best.1 => format!(
            "On the rays “{}”, {} is {} times as accurate as {}",
            rays.name(),
            name(best.0),
            rounded(worst.1 / best.1.max(LEAST)),
            name(worst.0)
        ),
        _ => "All tests have errors of t of the same size".into(),
    }
}

/// Returns the kernels' names without duplicates.
fn names(family: &KernelFamily) -> Vec<&str> {
    let mut names: Vec<&str> = Vec::new();
    for row in &family.rows {
        if !names.contains(&row.name.as_str()) {
            names.push(&row.name);
        }
    }
    names
}

/// Returns the style of a kernel's name. The precisions of a kernel share it; their lines are far
/// apart.
fn style_of(family: &KernelFamily, row: &KernelRow) -> SeriesStyle {
    let named = names(family).iter().position(|name| *name == row.name);
    SeriesStyle::of(named.unwrap_or(0))
}

fn width(row: &KernelRow) -> f64 {
    if row.student { 2.2 } else { 1.2 }
}

fn bound_style(precision: Precision) -> SeriesStyle {
    SeriesStyle {
        color: BOUND,
        dashes: (precision != Precision::F64).then_some([8.0, 4.0]),
        ..SeriesStyle::of(0)
    }
}

fn accuracy(row: &KernelRow, rays: RayFamily) -> Option<&Accuracy> {
    row.by_ray_family.iter().find(|a| a.family == rays)
}

/// Converts a distribution to a line that starts at a fraction of 0; errors of 0 are drawn at
/// [`LEAST`].
fn steps(distribution: &[(f64, f64)]) -> Vec<(f64, f64)> {
    let shown = distribution
        .iter()
        .map(|(error, share)| (error.max(LEAST), *share));
    let first = shown.clone().next().map(|(error, _)| (error, 0.0));
    let last = shown.clone().next_back().map(|(_, share)| (1.0, share));
    first.into_iter().chain(shown).chain(last).collect()
}

/// Returns the known kernels in f64 with the smallest and the largest median relative error on
/// these rays.
fn extremes(family: &KernelFamily, rays: RayFamily) -> Option<[(&KernelRow, f64); 2]> {
    let rows = family
        .rows
        .iter()
        .filter(|row| row.precision == Precision::F64 && !row.student);
    let mut errors: Vec<(&KernelRow, f64)> = rows
        .filter_map(|row| Some((row, accuracy(row, rays)?.t?.relative.p50)))
        .collect();
    errors.sort_by(|a, b| a.1.total_cmp(&b.1));
    Some([*errors.first()?, *errors.last()?])
}

/// Returns the family of rays on which the kernels differ most.
fn most_different(family: &KernelFamily) -> Option<RayFamily> {
    let distance = |rays: &RayFamily| {
        extremes(family, *rays).map_or(0.0, |[best, worst]| {
            (worst.1.max(LEAST) / best.1.max(LEAST)).ln()
        })
    };
    let hard = family.columns.iter().map(|column| column.family);
    // On the surface t is 0 up to rounding, so its relative error has no meaning.
    hard.filter(|rays| ![RayFamily::Ordinary, RayFamily::OnTheSurface].contains(rays))
        .max_by(|a, b| distance(a).total_cmp(&distance(b)))
}

/// Returns the caption, computed from the numbers.
fn caption(family: &KernelFamily, hard: Option<RayFamily>) -> String {
    let beyond = |row: &&KernelRow| {
        let rays = [Some(RayFamily::Ordinary), hard].into_iter().flatten();
        rays.filter_map(|rays| accuracy(row, rays))
            .any(|a| a.beyond_bound_per_million > 0.0)
    };
    let beyond: Vec<String> = family.rows.iter().filter(beyond).map(name).collect();
    if beyond.is_empty() {
        "No error exceeds the bound of its precision (thick grey lines), the forward error bound of a robust kernel.".to_string()
    } else {
        format!(
            "Some errors exceed the bound (thick grey lines), the forward error bound of a robust kernel, for {}.",
            list(&beyond)
        )
    }
}
