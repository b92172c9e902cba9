//! Writes the review as one HTML page.

mod case_text;
mod decision;
mod rows;
mod words;

use super::{Author, Review};
use case_text::{count, differs, is_open, is_refuted, is_silent, meaning};
use judge::plural;
use look::case::{Case, State};
use look::page::{pictures, whole};
use pages::html::escape;
use std::fmt::Write;

/// The largest number of calls that the page lists, shared by the cases without pictures.
const LISTED: usize = 160;

/// The smallest number of calls that it lists of a case.
const LISTED_OF_A_CASE: usize = 3;

/// Formats the page: first what changed, task by task, then the names of what did not.
pub fn write(review: &Review, author: &Author) -> String {
    let mut content = String::new();
    let changed = review.cases.iter().filter(|case| differs(&case.state));
    let listed = (LISTED / changed.count().max(1)).max(LISTED_OF_A_CASE);
    let is_reference = *author == Author::Reference;
    let is_changed = review.cases.iter().any(|case| differs(&case.state));
    if is_changed {
        content.push_str(decision::BAR);
    }
    content.push_str(&overview(review));
    for cases in review.cases.chunk_by(|a, b| a.task == b.task) {
        let changed: Vec<&Case> = cases.iter().filter(|case| differs(&case.state)).collect();
        if changed.is_empty() {
            continue;
        }
        let task = escape(cases[0].task);
        let _ = writeln!(
            content,
            "<section class=\"changed\" id=\"{task}\" data-changed=\"{}\">\n<h2>{task}: {} of {} changed</h2>",
            changed.len(),
            changed.len(),
            plural(cases.len(), "golden", "goldens"),
        );
        if let Some(diagnosis) = review.diagnoses.get(cases[0].task) {
            let _ = writeln!(
                content,
                "<p class=\"looks\"><strong>Looks like:</strong> {}, {} of {} calls.</p>",
                escape(&diagnosis.description),
                diagnosis.equal,
                diagnosis.of
            );
        }
        for case in changed {
            content.push_str(&article(case, listed, is_reference));
        }
        content.push_str("</section>\n");
    }
    content.push_str(&without_answers(review));
    content.push_str(&unchanged(review));
    if is_changed && is_reference {
        content.push_str(decision::SECTION);
    }
    let title = format!("Review: {}", summary(review));
    whole(
        ["", decision::SCRIPT],
        &title,
        &header(review, author),
        &content,
    )
}

/// A changed case; with `decide`, it can be accepted.
fn article(case: &Case, listed: usize, decide: bool) -> String {
    let id = escape(&case.path());
    let is_refuted = is_refuted(&case.state);
    let mut text = format!(
        "<article class=\"case picture\" id=\"{id}\" tabindex=\"-1\" data-task=\"{}\" data-case=\"{}\" data-meaning=\"{}\">\n\
         <div class=\"head\"><h3>{id}</h3>{}</div>\n{}",
        escape(case.task),
        escape(case.name),
        escape(&meaning(case)),
        match decide {
            true => decision::buttons(is_refuted),
            false => String::new(),
        },
        case_text::describe(case),
    );
    match &case.picture {
        Some(picture) => text.push_str(&pictures::panels(case, picture, &words::REVIEW)),
        None => text.push_str(&rows::rows(case, listed, &words::REVIEW)),
    }
    text + "</article>\n"
}

/// The cases without an answer, by the reason.
fn without_answers(review: &Review) -> String {
    let silent: Vec<&Case> = review
        .cases
        .iter()
        .filter(|case| is_silent(&case.state))
        .collect();
    let mut text = String::new();
    for of_reason in silent.chunk_by(|a, b| a.state == b.state) {
        if let State::Silent(why) = &of_reason[0].state {
            let names: Vec<String> = of_reason.iter().map(|case| escape(&case.path())).collect();
            let _ = writeln!(
                text,
                "<p class=\"bad\">No answer ({}): {}</p>",
                escape(why),
                names.join(", ")
            );
        }
    }
    text
}

/// The names of the unchanged cases, folded.
fn unchanged(review: &Review) -> String {
    let is_same = |case: &&Case| case.state == State::Same;
    let all = review.cases.iter().filter(is_same).count();
    if all == 0 {
        return String::new();
    }
    let mut text = format!(
        "<details class=\"unchanged\"><summary>{} unchanged</summary>\n",
        plural(all, "golden is", "goldens are")
    );
    for cases in review.cases.chunk_by(|a, b| a.task == b.task) {
        let same: Vec<String> = cases
            .iter()
            .filter(is_same)
            .map(|case| escape(case.name))
            .collect();
        if !same.is_empty() {
            let _ = writeln!(
                text,
                "<p><code>{}</code>: {}</p>",
                escape(cases[0].task),
                same.join(", ")
            );
        }
    }
    text + "</details>\n"
}

/// The result of the review in one sentence.
pub fn summary(review: &Review) -> String {
    let cases: Vec<&Case> = review.cases.iter().collect();
    let all = plural(cases.len(), "golden", "goldens");
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

/// The changed tasks with links to their changed cases.
fn overview(review: &Review) -> String {
    let mut text = String::from("<ul class=\"overview\">\n");
    for cases in review.cases.chunk_by(|a, b| a.task == b.task) {
        let cases: Vec<&Case> = cases.iter().collect();
        let changed = count(&cases, differs);
        if changed == 0 {
            continue;
        }
        let mut counts = vec![format!("{changed} of {} changed", cases.len())];
        let parts = [
            (count(&cases, is_refuted), "refuted"),
            (count(&cases, is_open), "not judged in some aspect"),
            (count(&cases, is_silent), "without an answer"),
        ];
        for (count, what) in parts {
            if count > 0 {
                counts.push(format!("{count} {what}"));
            }
        }
        let links = cases
            .iter()
            .filter(|case| differs(&case.state))
            .map(|case| {
                let class = if is_refuted(&case.state) { "bad" } else { "" };
                let (path, name) = (escape(&case.path()), escape(case.name));
                format!("<a class=\"{class}\" href=\"#{path}\">{name}</a>")
            });
        let _ = writeln!(
            text,
            "<li><a href=\"#{task}\"><code>{task}</code></a> {}: {}</li>",
            counts.join(", "),
            links.collect::<Vec<String>>().join(", "),
            task = escape(cases[0].task),
        );
    }
    text + "</ul>\n"
}
