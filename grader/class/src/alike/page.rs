//! The page of what submissions have in common, with the passages side by side.

use super::pairs::{Common, EXPECTED, LARGE_SHARE, PASTED, Pair, SharedPassage};
use crate::pages::{expected_pairs, page as whole_page};
use maud::{Markup, html};
use submission::Untrusted;
use submission::code::passages::CERTAIN;
use submission::code::source::Excerpt;

/// The page about `students` submissions. `pasted` are their passages from the grader's code.
pub fn page(students: usize, pairs: &[Pair], common: &[Common], pasted: &[Pair]) -> String {
    let body = html! {
        h1 { "Code in common" }
        p {
            (students) " submissions were compared, each stage by itself, without the text of the handout and without the textbook code that the course knows. Comments, blanks and names do not count: a passage is a run of at least " (CERTAIN) " equal tokens, about four lines."
        }
        p {
            "This is a question, not an accusation: two students may have one tutor, one book or one page on the web. Ask both to explain a line. A pair is listed if fewer than "
            (EXPECTED) " pairs of this class would have the same passages by chance, given how many others have each of them and each counted as a chance of its own, or if passages that few others have are "
            (percent(LARGE_SHARE)) " of the shorter code."
        }
        @if pairs.is_empty() { p { "No pair of submissions is listed." } }
        @for pair in pairs { (section(pair)) }
        @if !pasted.is_empty() {
            h2 { "Passages of the grader's own code" }
            p { "A handout contains the code that judges. These stages have at least " (PASTED) " equal tokens in a row, about eight lines, in common with it." }
            @for pair in pasted { (from_the_grader(pair)) }
        }
        @if !common.is_empty() {
            h2 { "Passages that many have" }
            p { "Each comes from a book, a lecture or a page rather than from one of them." }
            @for common in common { (of_many(common)) }
        }
    };
    whole_page("Code in common", &body, None)
}

fn section(pair: &Pair) -> Markup {
    html! {
        h2 { (pair.names[0].line()) " and " (pair.names[1].line()) }
        p.soft { "Pairs of this class expected to have all of this in common by chance: " (expected_pairs(pair.expected)) "." }
        @for stage in &pair.stages {
            h3 { (stage.stage) ": " (percent(stage.share)) " of the shorter code" }
            @for passage in &stage.passages { (side_by_side(pair, passage)) }
        }
    }
}

fn from_the_grader(pair: &Pair) -> Markup {
    html! {
        @for stage in &pair.stages {
            h3 { (pair.names[0].line()) ", " (stage.stage) }
            @for passage in &stage.passages { (side_by_side(pair, passage)) }
        }
    }
}

fn side_by_side(pair: &Pair, passage: &SharedPassage) -> Markup {
    html! {
        details.card open[passage.others == 0] {
            summary {
                (passage.tokens) " tokens, "
                @if passage.has_same_names { "the same names" } @else { "other names" }
                ", " (others(passage.others))
            }
            div.pair {
                @for (name, excerpt) in pair.names.iter().zip(&passage.excerpts) { (code(name, excerpt)) }
            }
        }
    }
}

fn of_many(common: &Common) -> Markup {
    let names: Vec<String> = common.names.iter().map(Untrusted::line).collect();
    html! {
        details.card {
            summary { (common.stage) ": " (common.names.len()) " submissions" }
            p { (names.join(", ")) }
            (code(&common.names[0], &common.excerpt))
        }
    }
}

fn code(name: &Untrusted, excerpt: &Excerpt) -> Markup {
    html! {
        div {
            p.soft { (name.line()) ", " (excerpt.path.line()) ", lines " (excerpt.lines.start) " to " (excerpt.lines.end - 1) }
            pre { (excerpt.text.lines()) }
        }
    }
}

fn others(others: usize) -> String {
    match others {
        0 => "nobody else has it".to_string(),
        1 => "one other student has it".to_string(),
        others => format!("{others} others have it"),
    }
}

fn percent(share: f64) -> String {
    format!("{:.0} %", 100.0 * share)
}
