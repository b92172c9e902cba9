//! A figure of the page: what it shows in a heading, the drawing, and its numbers.

use crate::numbers::capital;
use pages::html::escape;
use std::fmt::Write;

/// A figure. All texts but the drawing are plain text.
#[derive(Clone, Debug, Default)]
pub struct Figure {
    /// What the figure shows, as a heading: a finding, computed from the numbers.
    pub finding: String,
    /// The drawing, as HTML.
    pub drawing: String,
    /// One sentence: what is drawn.
    pub caption: String,
    /// More sentences, shown on demand.
    pub notes: String,
    /// The heads of the columns of the table, shown on demand.
    pub head: Vec<String>,
    /// The rows of the table; the first cell is the name of the row.
    pub rows: Vec<Vec<String>>,
}

impl Figure {
    /// Formats the figure with its heading.
    pub fn html(&self) -> String {
        let mut html = format!(
            "<h3>{}</h3>\n<figure>\n<div class=\"wide\" tabindex=\"0\">{}</div>\n<figcaption>{}</figcaption>\n</figure>\n",
            prose(&capital(&self.finding)),
            self.drawing,
            prose(&self.caption)
        );
        let _ = write!(
            html,
            "<details><summary>Numbers</summary>\n<p>{}</p>\n<div class=\"wide\" tabindex=\"0\"><table>\n<thead><tr>",
            prose(self.notes.trim_end())
        );
        let class = |column| match self.is_words(column) {
            true => " class=\"words\"",
            false => "",
        };
        for (i, head) in self.head.iter().enumerate() {
            let _ = write!(html, "<th scope=\"col\"{}>{}</th>", class(i), escape(head));
        }
        html.push_str("</tr></thead>\n<tbody>\n");
        for row in &self.rows {
            html.push_str("<tr>");
            for (i, cell) in row.iter().enumerate() {
                let _ = match i {
                    0 => write!(html, "<th scope=\"row\">{}</th>", escape(cell)),
                    _ => write!(html, "<td{}>{}</td>", class(i), escape(cell)),
                };
            }
            html.push_str("</tr>\n");
        }
        html + "</tbody></table></div></details>\n"
    }

    /// Whether a column holds words, which are aligned at the left, and not numbers.
    fn is_words(&self, column: usize) -> bool {
        let mut cells = self.rows.iter().filter_map(|row| row.get(column));
        cells.all(|cell| !cell.contains(|c: char| c.is_ascii_digit()))
    }
}

/// Formats plain text as HTML. No line breaks between a number and its percent sign.
pub fn prose(text: &str) -> String {
    escape(text).replace(" %", "\u{a0}%")
}
