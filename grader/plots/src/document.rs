//! A self-contained HTML page of figures.

use crate::style::COLOR_RULES;
use pages::PALETTE;
use pages::html::escape;
use std::fmt::Write;

/// The style of the page.
const STYLE: &str = include_str!("page.css");

/// Shows the texts of points.
const SCRIPT: &str = include_str!("tips.js");

/// A page: sections below a title.
#[derive(Clone, Debug, Default)]
pub struct Document {
    /// The title, as plain text.
    pub title: String,
    /// What the figures were measured on, as plain text.
    pub about: String,
    /// CSS rules beyond those of plots and tables.
    pub style: String,
    /// Titles, as plain text, and contents, as HTML.
    pub sections: Vec<(String, String)>,
}

impl Document {
    /// Formats the page. It has a list of the sections if there are several.
    pub fn html(&self) -> String {
        let title = escape(&self.title);
        let mut html = format!(
            "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
             <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
             <meta name=\"color-scheme\" content=\"light dark\">\n\
             <meta name=\"generator\" content=\"First Light {}\">\n<title>{title}</title>\n\
             <style>\n{PALETTE}{STYLE}{COLOR_RULES}{}</style>\n</head>\n<body>\n<h1>{title}</h1>\n<p class=\"machine\">{}</p>\n",
            base::VERSION,
            self.style,
            escape(&self.about)
        );
        if self.sections.len() > 1 {
            html.push_str("<nav>");
            for (i, (title, _)) in self.sections.iter().enumerate() {
                let _ = write!(html, "<a href=\"#s{i}\">{}</a>", escape(title));
            }
            html.push_str("</nav>\n");
        }
        for (i, (title, content)) in self.sections.iter().enumerate() {
            let _ = writeln!(html, "<h2 id=\"s{i}\">{}</h2>", escape(title));
            html.push_str(content);
        }
        let _ = write!(html, "<script>\n{SCRIPT}</script>\n</body>\n</html>\n");
        html
    }
}
