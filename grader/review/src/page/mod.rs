//! The review as one HTML page.

mod pictures;
mod rows;
mod snapshots;
mod words;

use super::case::{Case, State};
use super::{Author, Review};
use grader::error::GraderError;
use judge::plural;
use pages::html::escape;
use std::fmt::Write;
use words::{count, differs, is_refuted, is_silent};

const TEMPLATE: &str = include_str!("page.html");
const STYLE: &str = include_str!("page.css");
const SCRIPT: &str = include_str!("page.js");

/// The page.
pub fn write(review: &Review, author: &Author) -> Result<String, GraderError> {
    // Those that changed come first.
    let (same, changed): (Vec<&Case>, Vec<&Case>) = review
        .cases
        .iter()
        .partition(|case| case.state == State::Same);
    let mut pictures = String::new();
    for case in changed.into_iter().chain(same) {
        if let Some(picture) = &case.picture {
            pictures.push_str(&pictures::article(case, picture)?);
        }
    }
    if pictures.is_empty() {
        pictures.push_str("<p>None of these cases makes a picture.</p>\n");
    }
    // What is ours first: what answers say may look like a placeholder.
    Ok(TEMPLATE
        .replace("<!-- style -->", STYLE)
        .replace("<!-- script -->", SCRIPT)
        .replace(
            "<!-- title -->",
            &escape(&format!("Review: {}", verdict(review))),
        )
        .replace("<!-- verdict -->", &header(review, author))
        .replace("<!-- overview -->", &overview(review))
        .replace("<!-- snapshots -->", &snapshots::section(review))
        .replace("<!-- pictures -->", &pictures))
}

/// The review in a sentence.
pub fn verdict(review: &Review) -> String {
    let cases: Vec<&Case> = review.cases.iter().collect();
    let all = plural(cases.len(), "case", "cases");
    let silent = count(&cases, is_silent);
    let mut said = match count(&cases, differs) {
        0 if silent == 0 => return format!("nothing changed in {all}"),
        0 => format!("nothing changed in {} of {all}", cases.len() - silent),
        changed => format!("{changed} of {all} changed"),
    };
    let refuted = count(&cases, is_refuted);
    if refuted > 0 {
        let _ = write!(said, "; the exact oracle refutes {refuted} of them");
    }
    if silent > 0 {
        let _ = write!(said, "; {silent} without an answer");
    }
    said
}

fn header(review: &Review, author: &Author) -> String {
    let who = match author {
        Author::Reference => "what the code of this workspace answers".to_string(),
        Author::Student(folder) => format!("what the stages in {} answer", escape(folder)),
    };
    let cases: Vec<&Case> = review.cases.iter().collect();
    let advice = match (count(&cases, differs), count(&cases, is_refuted)) {
        (0, _) => "",
        (_, 0) => {
            "<p class=\"good\">The exact oracle confirms every new answer: each difference is a choice, not a mistake.</p>\n"
        }
        _ => {
            "<p class=\"bad\">The exact oracle finds some of the new answers wrong: these are mistakes, not choices.</p>\n"
        }
    };
    let mut said = verdict(review);
    said[..1].make_ascii_uppercase();
    format!(
        "<p class=\"eyebrow\">First Light · review</p>\n<h1>{}</h1>\n{advice}<p class=\"about\">The goldens, which students are graded against, beside {who}. \
         A difference is named against the golden; the exact oracle, which knows neither, is asked apart.</p>\n",
        escape(&said)
    )
}

fn overview(review: &Review) -> String {
    let mut text = String::from(
        "<table>\n<thead><tr><th scope=\"col\">task</th><th scope=\"col\" class=\"number\">cases</th><th scope=\"col\" class=\"number\">changed</th>\
         <th scope=\"col\" class=\"number\">refuted</th><th scope=\"col\" class=\"number\">no answer</th><th scope=\"col\">look at</th></tr></thead>\n<tbody>\n",
    );
    for cases in review.cases.chunk_by(|a, b| a.task == b.task) {
        let cases: Vec<&Case> = cases.iter().collect();
        let links: Vec<String> = cases
            .iter()
            .filter(|case| differs(&case.state))
            .map(|case| {
                let name = escape(case.name);
                format!("<a href=\"#{}\">{name}</a>", escape(&case.path()))
            })
            .collect();
        let _ = writeln!(
            text,
            "<tr><th scope=\"row\"><code>{}</code></th><td class=\"number\">{}</td><td class=\"number\">{}</td><td class=\"number\">{}</td>\
             <td class=\"number\">{}</td><td>{}</td></tr>",
            escape(cases[0].task),
            cases.len(),
            count(&cases, differs),
            count(&cases, is_refuted),
            count(&cases, is_silent),
            links.join(", ")
        );
    }
    text + "</tbody>\n</table>\n"
}
