//! Draws the boxes of a tree as intervals, one level below the other.

use super::model::{Ink, Layout, Sketch, Stroke};
use super::text::COLUMNS;
use super::words::Anchor;
use crate::report::wrap::columns;
use judge::shown::{ShownSpans, Span};

/// Draws intervals on a line; `None` if none is finite.
pub(super) fn spans(shown: &ShownSpans) -> Option<Sketch> {
    let mut strokes = Vec::new();
    let mut line = 0.0;
    let finite = |row: &[Span]| -> Vec<Span> {
        let spans = row
            .iter()
            .filter(|span| span.ends.iter().all(|x| x.is_finite()));
        spans.cloned().collect()
    };
    let ends = shown
        .rows
        .iter()
        .flat_map(|row| finite(row))
        .flat_map(|span| span.ends);
    let (min, max) = ends.fold((f64::INFINITY, f64::NEG_INFINITY), |(min, max), x| {
        (min.min(x), max.max(x))
    });
    let column = (max - min) / COLUMNS as f64;
    for row in &shown.rows {
        // A name that would cover another one goes to a line of its own, with its interval.
        let mut names: Vec<Vec<[f64; 2]>> = Vec::new();
        for span in finite(row) {
            let [from, to] = span.ends;
            let middle = 0.5 * (from + to);
            let half = 0.5 * column * (columns(&span.label) + 2) as f64;
            let name = [middle - half, middle + half];
            let is_free = |others: &Vec<[f64; 2]>| {
                others
                    .iter()
                    .all(|other| other[1] <= name[0] || name[1] <= other[0])
            };
            let below = names.iter().position(is_free).unwrap_or(names.len());
            match names.get_mut(below) {
                Some(others) => others.push(name),
                None => names.push(vec![name]),
            }
            let at = |x: f64| [x, line - below as f64];
            if from != to {
                strokes.push(Stroke::Line(Ink::Shape, [at(from), at(to)]));
                strokes.extend([from, to].map(|end| Stroke::Mark(Ink::Shape, at(end))));
            }
            let label = format!(" {} ", span.label);
            strokes.push(Stroke::Word(Anchor::Middle, at(middle), label));
        }
        line -= names.len() as f64;
    }
    if strokes.is_empty() {
        return None;
    }
    let yours = shown.yours.filter(|t| t.is_finite());
    for (ink, t) in [(Ink::Expected, shown.expected), (Ink::Yours, yours)] {
        strokes.extend(t.map(|t| Stroke::Mark(ink, [t, line])));
    }
    let beyond = match shown.yours.is_some() && yours.is_none() {
        true => "; your t is not finite",
        false => "",
    };
    let caption = format!("along {}: {}{beyond}", shown.along, shown.about);
    Some(Sketch::new(strokes, &caption, Layout::Rows))
}
