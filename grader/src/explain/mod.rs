//! Explains a case: what it tests, in words and drawn.
//!
//! The drawings are made of the calls as [`ShownCall`] has them, with the exact results: `shapes`
//! draws triangles, spheres and boxes with the rays at them, `film` samples in a pixel and points
//! of a sensor, [`hemisphere`] lights above a point. Other kinds of work get a table of their first
//! calls.

mod drawing;
mod film;
pub mod hemisphere;
mod shapes;

use crate::course::{CaseEntry, Task};
use crate::report::table::number;
use crate::report::terminal::Page;
use crate::report::wrap::{columns, numbers_to_fit, wrap};
use drawing::Drawing;
use judge::Tier;
use judge::cases::{PITFALL, Spec, checked};
use judge::shown::{ShownCall, ShownRay};
use judge::snapshot::Snapshot;
use std::fmt::Write;

/// Lists the cases of a task with their points and what they test.
pub fn task(task: &Task, specs: &[Spec], page: Page) -> String {
    let mut text = format!("{}  {}\n", task.key, task.title);
    let longest = task.cases.iter().map(|case| columns(&case.name)).max();
    let width = longest.unwrap_or(0);
    for entry in &task.cases {
        let spec = specs.iter().find(|spec| spec.is(&task.key, &entry.name));
        let about = spec.map_or("", |spec| checked(spec.about));
        let name = format!("{}{}", entry.name, " ".repeat(width - columns(&entry.name)));
        let before = format!("  {name} {:>5}  ", points(entry));
        let indent = columns(&before);
        // Wrapping joins the columns of a table: the lines come without their margin.
        let room = page.width.saturating_sub(indent).max(MOST_NARROW);
        let lines = wrap(about, 0, room).join(&format!("\n{}", " ".repeat(indent)));
        let _ = writeln!(text, "{}", format!("{before}{lines}").trim_end());
    }
    let _ = writeln!(
        text,
        "  + is extra credit. One case: cargo grader explain {}/{}",
        task.key,
        task.cases.first().map_or("CASE", |case| &case.name)
    );
    text
}

/// Columns of a description, however narrow the page is.
const MOST_NARROW: usize = 24;

/// The points of a case, with a `+` for extra credit.
fn points(entry: &CaseEntry) -> String {
    let sign = match entry.tier {
        Tier::Core => "",
        Tier::Robust => "+",
    };
    format!("{sign}{}", number(entry.points))
}

/// Explains a case: what it tests, its pitfall, its points, its inputs in words and drawn. `golden`
/// are the reference's answers, if they are stored.
pub fn case(entry: &CaseEntry, spec: &Spec, golden: Option<&Snapshot>, page: Page) -> String {
    let kind = match entry.tier {
        Tier::Core => "core",
        Tier::Robust => "extra credit",
    };
    let amount = number(entry.points);
    let unit = if entry.points == 1.0 {
        "point"
    } else {
        "points"
    };
    let mut text = format!("{}/{}  {amount} {unit}, {kind}\n", spec.task, spec.name);
    let mut paragraph = |words: &str| {
        for line in wrap(words, 2, page.width) {
            let _ = writeln!(text, "{line}");
        }
    };
    paragraph(&format!("  {}", checked(spec.about)));
    if let Some((_, pitfall)) = spec.about.split_once(PITFALL) {
        paragraph(&format!("  Pitfall: {pitfall}"));
    }
    if let Some(other) = &entry.only_with {
        paragraph(&format!(
            "  It counts only if the case {other} passes, too."
        ));
    }
    let calls: Vec<ShownCall> = (0..spec.calls())
        .map_while(|call| spec.shown(entry.tier, call, None))
        .collect();
    let drawing = drawing(&calls);
    let overview = spec.overview();
    let (words, drawing) = match drawing {
        Some(Drawing { words, lines }) => (format!("{overview}{words}."), lines),
        None => first_calls(&overview, golden, page),
    };
    paragraph(&format!("  {words}"));
    for line in drawing {
        let _ = writeln!(text, "{}", line.trim_end());
    }
    text
}

/// The most calls in a table.
const FIRST_CALLS: usize = 6;

/// Draws all calls in one drawing; `None` if they have no common drawing.
fn drawing(calls: &[ShownCall]) -> Option<Drawing> {
    match calls.first()? {
        ShownCall::Ray(_) => {
            let rays: Vec<&ShownRay> = calls
                .iter()
                .filter_map(|call| match call {
                    ShownCall::Ray(ray) => Some(ray),
                    _ => None,
                })
                .collect();
            shapes::rays(&rays).or_else(|| film::sensor(&rays))
        }
        ShownCall::Pixel(pixel) => Some(film::pixel(pixel)),
        ShownCall::LitPoint(point) => Some(hemisphere::lit_point(point)),
        ShownCall::Directions(_) => {
            let pairs = calls.iter().filter_map(|call| match call {
                ShownCall::Directions(pair) => Some(pair),
                _ => None,
            });
            Some(hemisphere::directions(pairs))
        }
        // Each has a drawing of its own, which the report shows of the simplest call.
        ShownCall::Bounce(_) | ShownCall::Spans(_) | ShownCall::Path(_) => None,
    }
}

/// The first calls with the reference's answers, as the goldens have them.
fn first_calls(words: &str, golden: Option<&Snapshot>, page: Page) -> (String, Vec<String>) {
    let Some(golden) = golden else {
        return (format!("{words}."), Vec::new());
    };
    let full = golden.lines.iter().filter(|line| !line.question.is_empty());
    let mut lines = Vec::new();
    for line in full.take(FIRST_CALLS) {
        let asked = format!("  {:>4}  {}", line.call, line.asked());
        lines.push(numbers_to_fit(&asked, page.width));
        let answer = format!("        -> {}", line.answer_text());
        lines.push(numbers_to_fit(&answer, page.width));
    }
    (
        format!("{words}. The first, with the reference's answers:"),
        lines,
    )
}
