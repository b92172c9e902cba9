//! Accuracy against time with its error, and the Pareto front of the kernels.

use super::front::front;
use super::kernel_name::name;
use super::pareto_caption::{caption, finding};
use crate::cells::plus_minus;
use crate::report::{KernelFamily, KernelRow, Precision, Shape};
use plots::canvas::{Canvas, Label, for_both_widths};
use plots::columns::Columns;
use plots::figure::Figure;
use plots::labels::Labels;
use plots::numbers::{percent, tick};
use plots::plot::{Axis, Plot};
use plots::scatter::{self, Point};
use plots::style::{INK, Marker, SeriesStyle};

const PLOT: [f64; 2] = [860.0, 470.0];
/// On a telephone, where markers have numbers and the names are below the plot.
const NARROW_PLOT: [f64; 2] = [300.0, 330.0];
/// Height of the legend below the plot, and of each further line of it on a telephone.
const KEY: f64 = 26.0;
const KEY_LINE: f64 = 16.0;
/// Distance of the names below the plot.
const NAME_LINE: f64 = 13.0;

/// Area in square points of the markers of a kernel that is never wrong and of one that is always
/// wrong.
const AREA: [f64; 2] = [26.0, 420.0];

/// Font size of the names beside markers.
const NAME: f64 = 9.5;

/// Draws the plot.
pub(crate) fn figure(family: &KernelFamily) -> Figure {
    let label = format!("Correct bits against time: {}", family.shape.name());
    let names_below = NAME_LINE * (family.rows.len() as f64 + 0.5);
    let key_below = KEY_LINE * key(family).len().div_ceil(3) as f64 + KEY;
    let broad = [PLOT[0], PLOT[1] + KEY];
    let narrow = [NARROW_PLOT[0], NARROW_PLOT[1] + names_below + key_below];
    let columns = columns(family);
    let drawing = for_both_widths(broad, narrow, &label, |canvas, size, is_narrow| {
        draw(canvas, family, &columns, is_narrow);
        if !is_narrow {
            let start = (60.0, PLOT[1] + 0.4 * KEY);
            return scatter::key(canvas, start, PLOT[0], key(family));
        }
        for (i, row) in fastest_first(family).into_iter().enumerate() {
            let y = NARROW_PLOT[1] + NAME_LINE * (i as f64 + 0.5);
            let label = label_of(row);
            canvas.text(
                &number(i),
                (20.0, y),
                Label {
                    anchor: Label::right(NAME).anchor,
                    ..label
                },
            );
            canvas.text(&text_of(row, &name(row)), (26.0, y), label);
        }
        let y = NARROW_PLOT[1] + names_below + 0.5 * KEY;
        scatter::key(canvas, (10.0, y), size[0], key(family))
    });
    let figure = Figure {
        finding: finding(family),
        drawing,
        caption: format!(
            "Further up is more accurate, further left is faster than the textbook's test, {}; bars reach from quartile to quartile of the \
             times, filled markers have {}, larger ones more, and no test is beaten on the dashed line, the Pareto front.",
            textbook(family),
            failures(family.shape)
        ),
        notes: caption(family),
        ..Figure::default()
    };
    columns.table(&family.rows, figure)
}

/// The numbers of a kernel.
fn columns(family: &KernelFamily) -> Columns<'_, KernelRow> {
    Columns::new("test", name)
        .and("of the textbook's time", |row| {
            plus_minus(&row.ranked_time().ratio, 2)
        })
        .and("ns", |row| plus_minus(&row.ranked_time().ns, 1))
        .and("correct bits", |row| {
            format!("{:.0}", row.mean_correct_bits().floor())
        })
        .and(failures(family.shape), |row| percent(failure_rate(row)))
}

/// Draws the plot. On a telephone its markers have numbers, the fastest kernel the first.
fn draw(canvas: &Canvas, family: &KernelFamily, columns: &Columns<'_, KernelRow>, is_narrow: bool) {
    let times = family
        .rows
        .iter()
        .map(|row| row.ranked_time().ratio)
        .flat_map(|ratio| [ratio.lower, ratio.upper]);
    let x_name = match is_narrow {
        false => format!("time / time of the textbook's test ({})", textbook(family)),
        true => "time / time of the textbook's test".into(),
    };
    let x = Axis::log(&x_name, times, tick);
    let ticks = (0..=5).map(|i| f64::from(10 * i));
    let name = "correct bits of t, mean of ray families";
    let y = Axis::linear(name, [0.0, 56.0], ticks, |v| v.to_string());
    let size = if is_narrow { NARROW_PLOT } else { PLOT };
    let plot = Plot::new(canvas, "correct bits against time", (0.0, 0.0), size, x, y);
    let corners = front_line(&plot, family);
    let mut labels = Labels::new(plot.inner());
    for ends in corners.windows(2) {
        let [from, to] = [ends[0], ends[1]].map(|(x, y)| plot.at(x, y));
        labels.keep_box_free([
            from.0.min(to.0) - 1.0,
            from.1.min(to.1) - 1.0,
            from.0.max(to.0) + 1.0,
            from.1.max(to.1) + 1.0,
        ]);
    }
    let rows = fastest_first(family).into_iter().enumerate();
    let points = rows.map(|(i, row)| {
        let ratio = row.ranked_time().ratio;
        Point {
            style: style_of(row),
            area: area(row),
            at: at(row),
            bar: Some([ratio.lower, ratio.upper]),
            name: match is_narrow {
                false => text_of(row, &row.name),
                true => number(i),
            },
            label: label_of(row),
            tip: columns.tip(row),
        }
    });
    scatter::draw(canvas, &plot, labels, &points.collect::<Vec<_>>())
}

/// The fastest first: the crowd is there, and they are what the plot is about.
fn fastest_first(family: &KernelFamily) -> Vec<&KernelRow> {
    let mut rows: Vec<&KernelRow> = family.rows.iter().collect();
    rows.sort_by(|a, b| at(a).0.total_cmp(&at(b).0));
    rows
}

/// The number of the `i`th marker and name.
fn number(i: usize) -> String {
    (i + 1).to_string()
}

/// How a kernel with this name is called in the plot.
fn text_of(row: &KernelRow, name: &str) -> String {
    match (row.student, row.textbook) {
        (true, _) => "yours".to_string(),
        (_, true) => format!("{name} (textbook)"),
        _ => name.to_string(),
    }
}

fn label_of(row: &KernelRow) -> Label {
    let label = Label::left(NAME).in_color(style_of(row).color);
    if row.student { label.bold() } else { label }
}

/// The test that times are compared with.
fn textbook(family: &KernelFamily) -> String {
    let textbook = family.rows.iter().find(|row| row.textbook);
    textbook.map_or("none".into(), name)
}

fn failures(shape: Shape) -> &'static str {
    match shape {
        Shape::Triangle => "leaks",
        Shape::Sphere | Shape::Box => "wrong decisions in the worst family",
    }
}

/// Returns the values that a kernel is drawn at.
fn at(row: &KernelRow) -> (f64, f64) {
    (row.ranked_time().ratio.median, row.mean_correct_bits())
}

/// Returns the fraction of leaks, or for spheres and boxes the fraction of wrong decisions in the
/// worst family of rays.
pub(super) fn failure_rate(row: &KernelRow) -> f64 {
    let wrong = row.by_ray_family.iter().map(|a| a.wrong_per_million());
    row.leaks_per_million.unwrap_or(wrong.fold(0.0, f64::max)) / 1e6
}

fn area(row: &KernelRow) -> f64 {
    AREA[0] + (AREA[1] - AREA[0]) * failure_rate(row).min(1.0)
}

/// Colour and shape show the precision; a hollow marker has no leaks or wrong decisions.
fn style_of(row: &KernelRow) -> SeriesStyle {
    let i = match row.precision {
        Precision::F64 => 0,
        Precision::F32 => 1,
        Precision::F32InF64 => 2,
    };
    match row.student {
        true => SeriesStyle::of(3).marked(Marker::Star, false),
        false => {
            let style = SeriesStyle::of(i);
            style.marked(style.marker, failure_rate(row) == 0.0)
        }
    }
}

/// Draws the front as a step function, through the fastest kernel of each step. Returns its
/// corners.
fn front_line(plot: &Plot, family: &KernelFamily) -> Vec<(f64, f64)> {
    let mut corners: Vec<(f64, f64)> = Vec::new();
    for step in front(&family.rows) {
        let Some(fastest) = step.first() else {
            continue;
        };
        let (x, y) = at(fastest);
        if let Some((_, before)) = corners.last().copied() {
            corners.push((x, before));
        }
        corners.push((x, y));
    }
    let style = SeriesStyle {
        color: INK,
        dashes: Some([4.0, 3.0]),
        ..SeriesStyle::of(0)
    };
    plot.line(style, &corners, 0.9);
    corners
}

/// The legend of the markers: style, area and meaning.
fn key(family: &KernelFamily) -> Vec<(SeriesStyle, f64, String)> {
    let failure = match family.shape {
        Shape::Triangle => "leaks",
        Shape::Sphere | Shape::Box => "wrong",
    };
    let precisions = [Precision::F64, Precision::F32, Precision::F32InF64];
    let mut entries: Vec<(SeriesStyle, f64, String)> = precisions
        .into_iter()
        .filter_map(|precision| {
            let mut rows = family.rows.iter();
            let row = rows.find(|row| row.precision == precision && !row.student)?;
            let style = SeriesStyle {
                hollow: true,
                ..style_of(row)
            };
            Some((style, AREA[0], precision.name().to_string()))
        })
        .collect();
    let black = |hollow| SeriesStyle {
        color: INK,
        hollow,
        ..SeriesStyle::of(0)
    };
    entries.push((black(true), AREA[0], format!("hollow: no {failure}")));
    for share in [0.1, 0.5] {
        let area = AREA[0] + share * (AREA[1] - AREA[0]);
        entries.push((
            black(false),
            area,
            format!("{:.0} % {failure}", 100.0 * share),
        ));
    }
    if let Some(yours) = family.rows.iter().find(|row| row.student) {
        entries.push((style_of(yours), AREA[0], "yours".into()));
    }
    entries
}
