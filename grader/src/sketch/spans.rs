//! Draws the boxes of a tree as intervals, one level below the other.

use super::model::{Ink, Layout, Sketch, Stroke};
use judge::shown::ShownSpans;

/// Draws intervals on a line; `None` if none is finite.
pub(super) fn spans(shown: &ShownSpans) -> Option<Sketch> {
    let mut strokes = Vec::new();
    let mut line = 0.0;
    for row in &shown.rows {
        let finite = row
            .iter()
            .filter(|span| span.ends.iter().all(|x| x.is_finite()));
        let mut is_empty = true;
        for span in finite {
            is_empty = false;
            let [from, to] = span.ends.map(|x| [x, line]);
            if from != to {
                strokes.push(Stroke::Line(Ink::Shape, [from, to]));
                strokes.extend([from, to].map(|end| Stroke::Mark(Ink::Shape, end)));
            }
            let middle = [0.5 * (from[0] + to[0]), line];
            strokes.push(Stroke::Name(middle, format!(" {} ", span.label)));
        }
        line -= f64::from(!is_empty);
    }
    if strokes.is_empty() {
        return None;
    }
    for (ink, t) in [(Ink::Expected, shown.expected), (Ink::Yours, shown.yours)] {
        strokes.extend(t.map(|t| Stroke::Mark(ink, [t, line])));
    }
    let caption = format!("along {}: {}", shown.along, shown.about);
    Some(Sketch::new(strokes, &caption, Layout::Rows))
}
