//! The pages about a class and about each student. Each is one file, and asks nothing of any server.
//!
//! All text goes through [`maud`], which escapes it for HTML. Text that was handed in is
//! [`Untrusted`], which it can only show by `line` or `lines`.

pub mod class;
mod distribution;
mod ideas;
mod legend;
mod missing;
mod mistakes;
pub mod student;
mod submissions;

pub use missing::lecture;

use crate::by_hand::Member;
use crate::row::Row;
use ::pages::PALETTE;
use ::pages::html::base64;
use maud::{DOCTYPE, Markup, PreEscaped, html};
use sha2::{Digest, Sha256};
use submission::Untrusted;

/// The page of a student of a team to whom something is given by hand alone.
#[derive(Clone, Copy, Debug)]
pub struct OwnPage<'a> {
    /// The student.
    pub member: &'a Member,
    /// The file name of the page.
    pub page: &'a str,
}

impl OwnPage<'_> {
    /// Whether it is of a student who handed in the submission of `row`.
    pub fn is_of(&self, row: &Row) -> bool {
        self.member.submission == row.name
    }
}

const STYLE: &str = include_str!("style.css");

/// A page with this title and body, and with a script of ours.
pub(crate) fn page(title: &str, body: &Markup, script: Option<&str>) -> String {
    // Only this script is run: nothing that a student wrote can be one.
    let allowed = script.map_or_else(String::new, |script| {
        let hash = base64(&Sha256::digest(script));
        format!("; script-src 'sha256-{hash}'")
    });
    let policy = format!("default-src 'none'; style-src 'unsafe-inline'; img-src data:{allowed}");
    let page = html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                meta http-equiv="Content-Security-Policy" content=(policy);
                title { (title) }
                style { (PreEscaped(PALETTE)) (PreEscaped(STYLE)) }
            }
            body {
                (body)
                @if let Some(script) = script { script { (PreEscaped(script)) } }
            }
        }
    };
    page.into_string() + "\n"
}

/// A list of sentences; nothing if there are none.
fn list(sentences: &[Untrusted]) -> Markup {
    html! {
        @if !sentences.is_empty() {
            ul { @for sentence in sentences { li { (sentence.line()) } } }
        }
    }
}

/// A small number of pairs, with two digits that count.
pub(crate) fn expected_pairs(pairs: f64) -> String {
    match pairs {
        1.0.. => format!("{pairs:.0}"),
        1e-6.. => {
            let digits = (-pairs.log10()).floor() as usize + 2;
            format!("{pairs:.digits$}")
        }
        _ => "less than 0.000001".to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn expected_pairs_have_two_digits_that_count() {
        let numbers = [29.2, 0.0999, 6.66e-5, 0.0].map(expected_pairs);
        assert_eq!(numbers, ["29", "0.100", "0.000067", "less than 0.000001"]);
    }
}
