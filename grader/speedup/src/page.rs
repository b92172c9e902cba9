//! The HTML page of plots: `grader speedup --html FILE`.

use crate::measure::{Ladder, RungCost};
use crate::rays::RayKind;
use crate::rung::RungKind;
use plots::canvas::{Canvas, Label, file, for_both_widths};
use plots::columns::Columns;
use plots::document::Document;
use plots::figure::Figure;
use plots::line_names::{self, LineName};
use plots::numbers::{figures, grouped, rounded, tick};
use plots::plot::{Axis, Plot};
use plots::style::SeriesStyle;

/// Sizes in points: a plot with its names, and on a telephone.
const BROAD: [f64; 2] = [860.0, 380.0];
const NARROW: [f64; 2] = [310.0, 340.0];

/// Room for the names of lines, in both.
const NAMES: [f64; 2] = [170.0, 88.0];

/// Font size of the names.
const NAME: f64 = 9.5;

/// Area of the markers in square points.
const AREA: f64 = 30.0;

/// Returns the HTML page of the results.
pub fn page(ladder: &Ladder) -> String {
    let mut steps = String::new();
    for figure in [speed(ladder, "bounce rays"), tests(ladder), build(ladder)] {
        steps.push_str(&figure.html());
    }
    let missing: Vec<String> = ladder.missing.iter().map(|why| format!("{why}.")).collect();
    let document = Document {
        title: "From brute force to a wide tree".into(),
        about: format!(
            "The {} mesh, one thread. Times depend on the machine; tests and bytes do not. {} {}",
            ladder.mesh,
            ladder.agreement(),
            missing.join(" ")
        ),
        style: String::new(),
        sections: vec![("Steps".into(), steps)],
    };
    document.html()
}

/// Returns the plot of speed, with the finding as its title, as an SVG file.
pub fn plot(ladder: &Ladder) -> String {
    let figure = speed(ladder, &speed_finding(ladder));
    file(&figure.drawing)
}

/// Rays per second of each step. `title_of_plot` stands above it.
fn speed(ladder: &Ladder, title_of_plot: &str) -> Figure {
    let columns = Columns::new("step", title);
    let names = ["camera", "bounce", "shadow"].into_iter();
    let lines = Lines {
        title: title_of_plot,
        unit: "millions of rays per second",
        value: &|row| Some(rate(row, RayKind::Bounce)),
        note: &|kind| {
            let factor = ladder.tenfold(kind, RayKind::Bounce)?;
            Some(format!("tenfold mesh: {}× the time", figures(factor)))
        },
        columns: names
            .zip(RayKind::ALL)
            .fold(columns, |columns, (name, rays)| {
                let tenfold = format!("times the time of {name} rays on a tenfold mesh");
                columns
                    .and(&format!("Mrays/s, {name}"), move |row| {
                        figures(rate(row, rays))
                    })
                    .and(&tenfold, move |row| {
                        let factor = ladder.tenfold(row.kind, rays);
                        factor.map_or("–".into(), figures)
                    })
            }),
    };
    let figure = Figure {
        finding: speed_finding(ladder),
        drawing: lines.draw(ladder),
        caption: "Bounce rays start at the hits of camera rays in random directions. Further up is faster; the flatter a line, the less \
                  a larger mesh costs."
            .into(),
        notes: "Medians of rounds in turns. Camera and bounce rays look for the closest hit, shadow rays for any. Brute force traces few \
                rays on large meshes. A tenfold mesh has ten times the triangles; the factor is that over all sizes."
            .into(),
        ..Figure::default()
    };
    lines.columns.table(&ladder.rows, figure)
}

/// What the plot of speed shows: the gain of the fastest step, and its growth.
fn speed_finding(ladder: &Ladder) -> String {
    let largest = ladder.rows.iter().map(|row| row.triangles).max();
    let at_largest = |row: &&RungCost| Some(row.triangles) == largest;
    let seconds = |row: &RungCost| row.rays[RayKind::Bounce as usize].seconds;
    let rows = || ladder.rows.iter().filter(at_largest);
    let fastest = rows().min_by(|a, b| seconds(a).total_cmp(&seconds(b)));
    let brute = rows().find(|row| row.kind == RungKind::BruteForce);
    let (Some(fastest), Some(brute)) = (fastest, brute) else {
        return "Nothing was measured".into();
    };
    let mut text = format!(
        "At {} triangles, {} is {} times as fast as brute force",
        grouped(fastest.triangles as f64),
        name(fastest.kind),
        rounded(seconds(brute) / seconds(fastest))
    );
    if let Some(factor) = ladder.tenfold(fastest.kind, RayKind::Bounce) {
        text += &format!(
            "; a tenfold mesh costs it {} times the time",
            figures(factor)
        );
    }
    text
}

/// Tests of each step.
fn tests(ladder: &Ladder) -> Figure {
    let counts = |row: &RungCost| {
        let bounce = row.rays[RayKind::Bounce as usize];
        (bounce.box_tests, bounce.prim_tests)
    };
    let lines = Lines {
        title: "tests of a bounce ray",
        unit: "tests of boxes and triangles",
        value: &|row| Some(counts(row).0 + counts(row).1),
        note: &|_| None,
        columns: Columns::new("step", title)
            .and("boxes", move |row| figures(counts(row).0))
            .and("triangles", move |row| rounded(counts(row).1)),
    };
    let last = ladder
        .rows
        .iter()
        .rfind(|row| row.kind != RungKind::BruteForce);
    let finding = last.map_or("Nothing was measured".into(), |row| {
        format!(
            "At {} triangles, a ray in {} tests {} boxes and {} triangles",
            grouped(row.triangles as f64),
            name(row.kind),
            figures(counts(row).0),
            figures(counts(row).1)
        )
    });
    let figure = Figure {
        finding,
        drawing: lines.draw(ladder),
        caption: "Tests of boxes and triangles together, for each bounce ray. The wide tree tests eight boxes at a time, so its tests take less time."
            .into(),
        notes: "Each of the eight boxes of a node of the wide tree counts as a test.".into(),
        ..Figure::default()
    };
    lines.columns.table(&ladder.rows, figure)
}

/// Time and memory of each tree.
fn build(ladder: &Ladder) -> Figure {
    let has_tree = |row: &RungCost| row.kind != RungKind::BruteForce;
    let bytes = |row: &RungCost| row.bytes as f64 / row.triangles as f64;
    let lines = Lines {
        title: "building",
        unit: "milliseconds",
        value: &|row| has_tree(row).then_some(1e3 * row.build_s),
        note: &|kind| {
            let row = ladder.rows.iter().rfind(|row| row.kind == kind)?;
            let k = ladder.build_slope(kind);
            let power = k.map_or(String::new(), |k| format!("n^{k:.2}, "));
            Some(format!("{power}{:.0} bytes a triangle", bytes(row)))
        },
        columns: Columns::new("step", title)
            .and("ms to build", |row| figures(1e3 * row.build_s))
            .and("bytes a triangle", move |row| format!("{:.0}", bytes(row))),
    };
    let trees = || ladder.rows.iter().filter(|row| has_tree(row));
    let largest = trees().map(|row| row.triangles).max();
    let cheapest = trees()
        .filter(|row| Some(row.triangles) == largest)
        .min_by(|a, b| a.build_s.total_cmp(&b.build_s));
    let finding = cheapest.map_or("No tree was measured".into(), |row| {
        format!(
            "{} is built fastest: {} triangles in {} ms",
            name(row.kind),
            grouped(row.triangles as f64),
            rounded(1e3 * row.build_s)
        )
    });
    let figure = Figure {
        finding,
        drawing: lines.draw(ladder),
        caption: "The time to build each tree, the least of the rounds, and the power of the number n of triangles with which it grows."
            .into(),
        notes: "The bytes are those of the tree, without the triangles of the scene.".into(),
        ..Figure::default()
    };
    lines.columns.table(trees(), figure)
}

/// Millions of rays per second.
fn rate(row: &RungCost, rays: RayKind) -> f64 {
    1e-6 / row.rays[rays as usize].seconds
}

/// The name of a step in sentences.
fn name(kind: RungKind) -> &'static str {
    match kind {
        RungKind::BruteForce => "brute force",
        RungKind::Student => "your tree",
        RungKind::Sah => "the SAH tree",
        RungKind::Wide => "your wide tree",
    }
}

/// The name of a step at its line.
fn short_name(kind: RungKind) -> &'static str {
    name(kind).trim_start_matches("the ")
}

/// The name of a row of a table.
fn title(row: &RungCost) -> String {
    let triangles = grouped(row.triangles as f64);
    format!("{}, {triangles} triangles", short_name(row.kind))
}

/// A plot with a line for each step, over the number of triangles.
struct Lines<'a> {
    title: &'a str,
    unit: &'a str,
    /// The value of a row, if it has one.
    value: &'a dyn Fn(&RungCost) -> Option<f64>,
    /// A line below the name of a step.
    note: &'a dyn Fn(RungKind) -> Option<String>,
    /// The numbers of a row.
    columns: Columns<'a, RungCost>,
}

impl Lines<'_> {
    fn draw(&self, ladder: &Ladder) -> String {
        let label = format!("{} over the number of triangles: {}", self.unit, self.title);
        for_both_widths(BROAD, NARROW, &label, |canvas, size, is_narrow| {
            let size = [size[0] - NAMES[usize::from(is_narrow)], size[1]];
            self.draw_on(canvas, size, ladder, is_narrow)
        })
    }

    fn draw_on(&self, canvas: &Canvas, size: [f64; 2], ladder: &Ladder, is_narrow: bool) {
        let sizes = ladder.rows.iter().map(|row| row.triangles as f64);
        let values = ladder.rows.iter().filter_map(self.value);
        let x = Axis::log("triangles", sizes, tick);
        let y = Axis::log(self.unit, values, tick);
        let plot = Plot::new(canvas, self.title, (0.0, 0.0), size, x, y);
        let mut names = Vec::new();
        for (i, kind) in RungKind::ALL.into_iter().enumerate() {
            let style = SeriesStyle::of(i);
            let rows = ladder.rows.iter().filter(|row| row.kind == kind);
            let points: Vec<(&RungCost, (f64, f64))> = rows
                .filter_map(|row| Some((row, (row.triangles as f64, (self.value)(row)?))))
                .collect();
            let line: Vec<(f64, f64)> = points.iter().map(|point| point.1).collect();
            let Some(&end) = line.last() else {
                continue;
            };
            let is_yours = matches!(kind, RungKind::Student | RungKind::Wide);
            plot.line(style, &line, if is_yours { 2.2 } else { 1.4 });
            for (row, at) in points {
                plot.marker(style, at, AREA);
                canvas.tip(plot.at(at.0, at.1), 8.0, &self.columns.tip(row));
            }
            let note = (self.note)(kind).filter(|_| !is_narrow);
            names.push(LineName {
                end: plot.at(end.0, end.1),
                text: std::iter::once(short_name(kind).to_string())
                    .chain(note)
                    .collect(),
                label: Label::left(NAME).bold().in_color(style.color),
            });
        }
        line_names::draw(canvas, names)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::RayCost;

    /// Brute force takes ten times the time on ten times the triangles, the wide tree twice.
    fn ladder() -> Ladder {
        let row = |kind, triangles, seconds, build_s| RungCost {
            kind,
            triangles,
            build_s,
            bytes: 130 * triangles,
            rays: [RayCost {
                seconds,
                box_tests: 40.0,
                prim_tests: 12.0,
            }; 3],
            checked_rays: 8,
            differing_hits: 0,
            first_differing: None,
        };
        Ladder {
            mesh: "smooth".into(),
            rows: vec![
                row(RungKind::BruteForce, 1000, 1e-5, 0.0),
                row(RungKind::Wide, 1000, 1e-7, 1e-3),
                row(RungKind::BruteForce, 10_000, 1e-4, 0.0),
                row(RungKind::Wide, 10_000, 2e-7, 2e-2),
            ],
            missing: ["your tree is not measured: part2.task1 is a gap".to_string()].into(),
        }
    }

    #[test]
    fn headings_and_lines_say_what_was_measured() {
        let page = page(&ladder());
        for text in [
            "At 10,000 triangles, your wide tree is 500 times as fast as brute force; a tenfold mesh costs it 2.0 times the time",
            "At 10,000 triangles, a ray in your wide tree tests 40 boxes and 12 triangles",
            "Your wide tree is built fastest: 10,000 triangles in 20 ms",
            "tenfold mesh: 10× the time",
            "n^1.30, 130 bytes a triangle",
            "All steps find the hits of brute force, up to rounding of t, in 32 comparisons.",
            "part2.task1 is a gap.",
        ] {
            assert!(page.contains(text), "no {text:?}");
        }
        assert!(!page.contains("NaN") && !page.contains("inf "));
    }

    /// A faster step is higher, and a larger mesh farther right.
    #[test]
    fn points_are_at_their_sizes_and_speeds() {
        let file = plot(&ladder());
        let number = |element: &str, name: &str| -> f64 {
            let value = element
                .split(&format!(" {name}=\""))
                .nth(1)
                .expect(name)
                .split('"')
                .next()
                .expect("a quote");
            value.parse().expect("a number")
        };
        let points: Vec<(f64, f64)> = file
            .split("<circle class=\"tip\"")
            .skip(1)
            .map(|element| (number(element, "cx"), number(element, "cy")))
            .collect();
        let [brute, large_brute, wide, large_wide] = points[..] else {
            panic!("{points:?}");
        };
        assert!(
            brute.0 == wide.0 && large_brute.0 == large_wide.0,
            "{points:?}"
        );
        assert!(brute.0 < large_brute.0 && wide.1 < brute.1, "{points:?}");
        // Brute force loses a decade, the wide tree a factor of 2.
        let share = (large_wide.1 - wide.1) / (large_brute.1 - brute.1);
        assert!((share - 2.0_f64.log10()).abs() < 0.01, "{points:?}");
    }

    #[test]
    fn a_single_size_has_no_slope() {
        let mut ladder = ladder();
        ladder.rows.truncate(2);
        let page = page(&ladder);
        assert!(!page.contains("tenfold mesh costs") && !page.contains("NaN"));
    }
}
