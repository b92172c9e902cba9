//! The page of the class.

use super::{OwnPage, distribution, expected_pairs, missing, page as whole_page, submissions};
use crate::collect::{Class, Row, Status, points};
use crate::likeness::{self, EXPECTED, Pair};
use maud::{Markup, html};
use submission::Untrusted;

/// The page. `page_names` are the file names of the students' pages, in the order of the rows;
/// `own_pages` are those of single students of teams.
pub fn page(class: &Class, page_names: &[String], own_pages: &[OwnPage<'_>]) -> String {
    let settings = &class.plan.settings;
    let body = html! {
        h1 { (class.title()) ": the class" }
        p { (class.summary()) ". " (middle(class)) }
        p.soft {
            "Random inputs: seed " (settings.seed) "."
            @if let Some(revision) = &settings.revision { " Graded: " (revision.to_string()) "." }
        }
        nav {
            @for (id, name) in [("points", "points"), ("mistakes", "mistakes"), ("pairs", "pairs to ask about"), ("submissions", "all submissions")] {
                a href=(format!("#{id}")) { (name) } " "
            }
        }
        (without_score(class))
        (distribution::all(class))
        (missing::section(class, page_names))
        (pairs(class))
        (submissions::section(class, page_names, own_pages))
    };
    whole_page(
        &format!("{}, the class", class.title()),
        &body,
        Some(submissions::SCRIPT),
    )
}

/// The mean and the median of the core points.
fn middle(class: &Class) -> String {
    let scores = class
        .rows
        .iter()
        .filter_map(|row| Some(row.score.as_ref()?.core));
    let mut scores: Vec<f64> = scores.collect();
    scores.sort_by(f64::total_cmp);
    if scores.is_empty() {
        return String::new();
    }
    let mean = scores.iter().sum::<f64>() / scores.len() as f64;
    let half = scores.len() / 2;
    let median = match scores.len() % 2 {
        0 => (scores[half - 1] + scores[half]) / 2.0,
        _ => scores[half],
    };
    format!(
        "Points: mean {mean:.1}, median {median:.1} of {}.",
        points(class.plan.max_score()[0])
    )
}

/// The submissions that a person has to look at.
fn without_score(class: &Class) -> Markup {
    let with =
        |is: fn(&Row) -> bool| -> Vec<&Row> { class.rows.iter().filter(|row| is(row)).collect() };
    let asked = with(|row| row.score.is_none() && !matches!(row.status, Status::Infrastructure(_)));
    let failed = with(|row| matches!(row.status, Status::Infrastructure(_)));
    let unreadable = with(Row::is_unread_zero);
    html! {
        (listed("Your decision: no score until then", &asked))
        (listed("No score: the machine failed", &failed))
        (listed("Could not be read: 0 points", &unreadable))
    }
}

/// A list of rows, each with what is wrong; empty if there are none.
fn listed(heading: &str, rows: &[&Row]) -> Markup {
    html! {
        @if !rows.is_empty() {
            h2 { (heading) }
            ul {
                @for row in rows {
                    li {
                        strong { (row.who().line()) } ": "
                        (row.status.detail().map_or_else(|| row.about(), Untrusted::line))
                    }
                }
            }
        }
    }
}

fn pairs(class: &Class) -> Markup {
    let pairs = likeness::pairs(class);
    let shared = likeness::shared_by_many(class);
    html! {
        h2 id="pairs" { "Pairs to ask about" }
        @for files in &shared {
            p {
                (files.names.len()) " submissions have the same files of " (files.stage)
                ". If they are not an example of the course, ask: "
                (files.names.iter().map(Untrusted::line).collect::<Vec<_>>().join(", ")) "."
            }
        }
        @if pairs.is_empty() {
            p {
                "No two submissions share more wrong answers than chance explains, nor"
                @if !shared.is_empty() { " other" } " files."
            }
        } @else {
            p {
                "These submissions have the same wrong answers, or the same files. This is a question, not an accusation: they may come from one group, one tutor or one page on the web. Ask both to explain a line. A pair is listed if fewer than "
                (EXPECTED)
                " pairs of this class would be expected to agree so by chance, given how often its students make each mistake, or if the files of a stage are equal."
            }
            div.scroll {
                table.pairs {
                    thead {
                        tr {
                            th { "who" }
                            th { "the same wrong answers" }
                            th { "the same files" }
                            th.number { "pairs expected" br; "by chance" }
                        }
                    }
                    tbody { @for pair in &pairs { (line(pair)) } }
                }
            }
        }
    }
}

fn line(pair: &Pair) -> Markup {
    let others = |others: usize| match others {
        0 => "nobody else has them".to_string(),
        1 => "one other student has them".to_string(),
        others => format!("{others} others have them"),
    };
    html! {
        tr {
            td.name { (pair.names[0].line()) br; (pair.names[1].line()) }
            td.note {
                @for (i, (task, count, same)) in pair.tasks.iter().enumerate() {
                    @if i > 0 { br; }
                    (task) ": " (count) " answers, " (others(*same))
                }
            }
            td data-name="the same files:" { (pair.stages.join(" ")) }
            td.number data-name="expected by chance:" { @if !pair.tasks.is_empty() { (expected_pairs(pair.expected)) } }
        }
    }
}
