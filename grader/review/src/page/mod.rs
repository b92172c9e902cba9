//! Writes the review as one HTML page.

mod case_text;
pub(crate) mod pictures;
mod rows;
mod snapshots;
pub(crate) mod words;

use super::case::{Case, State};
use super::{Author, Review};
use case_text::{count, differs, is_open, is_refuted, is_silent};
use judge::plural;
use pages::html::escape;
use std::fmt::Write;

const TEMPLATE: &str = include_str!("page.html");
const STYLE: &str = include_str!("page.css");
const SCRIPT: &str = include_str!("page.js");

/// Formats the page.
pub fn write(review: &Review, author: &Author) -> String {
    // Changed cases come first.
    let (same, changed): (Vec<&Case>, Vec<&Case>) = review
        .cases
        .iter()
        .partition(|case| case.state == State::Same);
    let mut pictures = String::new();
    for case in changed.into_iter().chain(same) {
        if let Some(picture) = &case.picture {
            pictures.push_str(&pictures::article(
                case,
                picture,
                &case_text::describe(case),
                &words::REVIEW,
            ));
        }
    }
    if pictures.is_empty() {
        pictures.push_str("<p>None of these cases has a picture.</p>\n");
    }
    let content = format!(
        "{}<section aria-labelledby=\"pictures\">\n<h2 id=\"pictures\">Pictures</h2>\n{pictures}</section>\n\
         <section aria-labelledby=\"snapshots\">\n<h2 id=\"snapshots\">Snapshots</h2>\n{}</section>\n",
        overview(review),
        snapshots::section(review)
    );
    let title = format!("Review: {}", summary(review));
    whole("", &title, &header(review, author), &content)
}

/// A whole page: `title` is text, `header` and `content` are HTML. The rules of `own_style` come
/// after those that all pages share.
pub(crate) fn whole(own_style: &str, title: &str, header: &str, content: &str) -> String {
    // Inserts our own texts first, because the text of an answer may contain a placeholder.
    TEMPLATE
        .replace("<!-- style -->", &format!("{STYLE}{own_style}"))
        .replace("<!-- script -->", SCRIPT)
        .replace("<!-- title -->", &escape(title))
        .replace("<!-- header -->", header)
        .replace("<!-- content -->", content)
}

/// The result of the review in one sentence.
pub fn summary(review: &Review) -> String {
    let cases: Vec<&Case> = review.cases.iter().collect();
    let all = plural(cases.len(), "case", "cases");
    let silent = count(&cases, is_silent);
    let mut text = match count(&cases, differs) {
        0 if silent == 0 => return format!("nothing changed in {all}"),
        0 => format!("nothing changed in {} of {all}", cases.len() - silent),
        changed => format!("{changed} of {all} changed"),
    };
    let refuted = count(&cases, is_refuted);
    if refuted > 0 {
        let _ = write!(text, "; the exact oracle refutes {refuted} of them");
    }
    let open = count(&cases, is_open);
    if open > 0 {
        let _ = write!(
            text,
            "; the exact oracle does not judge all aspects of {open}"
        );
    }
    if silent > 0 {
        let _ = write!(text, "; {silent} without an answer");
    }
    text
}

fn header(review: &Review, author: &Author) -> String {
    let who = match author {
        Author::Reference => "the answers of the code in this workspace".to_string(),
        Author::Student(folder) => format!("the answers of the stages in {}", escape(folder)),
    };
    let cases: Vec<&Case> = review.cases.iter().collect();
    let [changed, refuted, open] =
        [differs, is_refuted, is_open].map(|is: fn(&State) -> bool| count(&cases, is));
    let advice = match (changed, refuted, open) {
        (0, ..) => "",
        (_, 0, 0) => {
            "<p class=\"good\">The exact oracle confirms every new answer: no difference is a mistake.</p>\n"
        }
        (_, 0, _) => {
            "<p class=\"open\">The exact oracle finds no new answer wrong, but it does not judge all their aspects: look at what is listed as not judged.</p>\n"
        }
        _ => {
            "<p class=\"bad\">The exact oracle finds that some of the new answers are wrong.</p>\n"
        }
    };
    let mut title = summary(review);
    title[..1].make_ascii_uppercase();
    format!(
        "<p class=\"eyebrow\">First Light · review</p>\n<h1>{}</h1>\n{advice}<p class=\"about\">This page compares the goldens, which students are graded against, with {who}. \
         The exact oracle checks the answers independently of the goldens.</p>\n",
        escape(&title)
    )
}

fn overview(review: &Review) -> String {
    let mut text = String::from(
        "<table>\n<thead><tr><th scope=\"col\">task</th><th scope=\"col\" class=\"number\">cases</th><th scope=\"col\" class=\"number\">changed</th>\
         <th scope=\"col\" class=\"number\">refuted</th><th scope=\"col\" class=\"number\">not judged</th><th scope=\"col\" class=\"number\">no answer</th><th scope=\"col\">changed cases</th></tr></thead>\n<tbody>\n",
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
            "<tr><th scope=\"row\"><code>{}</code></th><td class=\"number\">{}</td><td class=\"number\">{}</td><td class=\"number\">{}</td><td class=\"number\">{}</td>\
             <td class=\"number\">{}</td><td>{}</td></tr>",
            escape(cases[0].task),
            cases.len(),
            count(&cases, differs),
            count(&cases, is_refuted),
            count(&cases, is_open),
            count(&cases, is_silent),
            links.join(", ")
        );
    }
    text + "</tbody>\n</table>\n"
}
