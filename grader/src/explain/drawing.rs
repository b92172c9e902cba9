//! What the calls of a case have in common, drawn.

use crate::report::wrap::one_line;
use crate::sketch::plot::{Plot, WIDTH};
use judge::plural;

/// Words and a drawing.
pub(super) struct Drawing {
    /// What follows the sentence about the inputs.
    pub(super) words: String,
    pub(super) lines: Vec<String>,
}

impl Drawing {
    /// A plot with sentences below it, each in one line.
    pub(super) fn new(plot: &Plot, below: &[&str]) -> Drawing {
        let mut lines = plot.lines();
        lines.extend(below.iter().map(|text| legend(text)));
        Drawing {
            words: String::new(),
            lines,
        }
    }

    /// Adds how many are not drawn, and where they are: "2 rays are outside the drawing".
    pub(super) fn without(mut self, count: usize, [one, many]: [&str; 2], place: &str) -> Drawing {
        if count > 0 {
            let things = plural(count, one, many);
            self.lines.push(legend(&format!("{things} {place}")));
        }
        self
    }
}

/// A line below a drawing.
fn legend(text: &str) -> String {
    one_line(&format!("  {text}"), WIDTH + 14)
}
