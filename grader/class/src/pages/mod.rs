//! The pages about a class and about each student. Each is one file without scripts, and asks
//! nothing of any server.

pub mod class;
pub mod student;

pub use ::pages::html::escape;
use std::fmt::Write;

const STYLE: &str = include_str!("style.css");

/// A page with this title and body. The title is escaped here; the body is HTML.
fn page(title: &str, body: &str) -> String {
    let title = escape(title);
    format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src 'unsafe-inline'\">\n\
         <title>{title}</title>\n<style>\n{STYLE}</style>\n</head>\n<body>\n{body}</body>\n</html>\n"
    )
}

/// A list of sentences; nothing if there are none.
fn list(sentences: &[String]) -> String {
    if sentences.is_empty() {
        return String::new();
    }
    let mut html = String::from("<ul>");
    for sentence in sentences {
        let _ = write!(html, "<li>{}</li>", escape(sentence));
    }
    html + "</ul>\n"
}
