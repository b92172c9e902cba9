//! The page of what submissions have in common, with the passages side by side.

use super::common::Common;
use super::pairs::{COMPARED, EXPECTED, LARGE_SHARE, PASTED, Pair, SHOWN, SharedStage, is_few};
use crate::pages::{expected_pairs, page as whole_page};
use maud::{Markup, html};
use std::collections::BTreeMap;
use submission::Untrusted;
use submission::code::passages::CERTAIN;
use submission::code::source::Excerpt;

/// The most pairs, passages of many and stages with the grader's code that are shown. Nobody asks
/// more students.
pub const LISTED: usize = 100;

/// What the page shows.
#[derive(Clone, Debug, Default)]
pub struct Contents {
    /// How many submissions were compared.
    pub students: usize,
    /// The submissions of which something could not be compared, and why.
    pub unread: Vec<(Untrusted, Untrusted)>,
    /// The strongest pairs.
    pub pairs: Vec<Pair>,
    /// How many pairs were found.
    pub found: usize,
    /// [`super::pairs::Pairs::not_compared`].
    pub not_compared: usize,
    /// The passages that many have.
    pub common: Vec<Common>,
    /// How many groups of students may have more of them.
    pub more_common: usize,
    /// Passages of the grader's code.
    pub pasted: Vec<Pair>,
    /// How many submissions have some.
    pub with_pasted: usize,
}

/// The page of `contents`.
pub fn page(contents: &Contents) -> String {
    let Contents {
        pairs,
        common,
        pasted,
        ..
    } = contents;
    let mut shown = Shown::default();
    let body = html! {
        h1 { "Code in common" }
        p {
            (contents.students) " submissions were compared, each stage by itself, without the text of the handout and without the textbook code that the course knows. Comments, blanks and names do not count: a passage is a run of at least " (CERTAIN) " equal tokens, about four lines."
        }
        p {
            "This is a question, not an accusation: two students may have one tutor, one book or one page on the web. Ask both to explain a line. A pair is listed if fewer than "
            (EXPECTED) " pairs of this class would have the same passages by chance, given how many others have each of them and each counted as a chance of its own, or if passages that few others have are "
            (percent(LARGE_SHARE)) " of the shorter code."
        }
        (left_out(contents))
        @if pairs.is_empty() { p { "No pair of submissions is listed." } }
        @for pair in pairs { (section(pair, &mut shown)) }
        @if !pasted.is_empty() {
            h2 { "Passages of the grader's own code" }
            p { "A handout contains the code that judges. These stages have at least " (PASTED) " equal tokens in a row, about eight lines, in common with it." }
            @if contents.with_pasted > pasted.len() {
                p { "The " (pasted.len()) " with the most are shown, of " (contents.with_pasted) " submissions." }
            }
            @for pair in pasted { (from_the_grader(pair, &mut shown)) }
        }
        @if !common.is_empty() {
            h2 { "Passages that many have" }
            p { "Each comes from a book, a lecture or a page rather than from one of them." }
            @if contents.more_common > 0 {
                p { "The " (common.len()) " that most have are shown; " (contents.more_common) " smaller groups of students were not looked at." }
            }
            @for common in common { (of_many(common, &mut shown)) }
        }
    };
    whole_page("Code in common", &body, None)
}

/// What is found and not shown, and where it is.
fn left_out(contents: &Contents) -> Markup {
    let shown = contents.pairs.len();
    html! {
        @if contents.found > shown {
            p {
                (contents.found) " pairs were found. The " (shown) " with the largest shares are shown, the other "
                (contents.found - shown) " are lines of " a href="alike.csv" { "alike.csv" } ", strongest first."
            }
        }
        @if !contents.unread.is_empty() {
            p { "Not compared:" }
            ul { @for (name, why) in &contents.unread { li { (name.line()) ": " (why.line()) } } }
        }
        @if contents.not_compared > 0 {
            p {
                "Only the " (COMPARED) " pairs with the most rare code in common were compared; "
                (contents.not_compared) " with less were not."
            }
        }
    }
}

fn section(pair: &Pair, shown: &mut Shown) -> Markup {
    html! {
        h2 { (pair.names[0].line()) " and " (pair.names[1].line()) }
        p.soft { "Pairs of this class expected to have all of this in common by chance: " (expected_pairs(pair.expected)) "." }
        @for stage in &pair.stages {
            h3 { (stage.stage) ": " (percent(stage.share)) " of the shorter code" }
            (passages(pair, stage, shown))
        }
    }
}

fn from_the_grader(pair: &Pair, shown: &mut Shown) -> Markup {
    html! {
        @for stage in &pair.stages {
            h3 { (pair.names[0].line()) ", " (stage.stage) }
            (passages(pair, stage, shown))
        }
    }
}

fn passages(pair: &Pair, stage: &SharedStage, shown: &mut Shown) -> Markup {
    html! {
        @for passage in &stage.passages {
            details.card open[is_few(passage.others + 2)] {
                summary {
                    (passage.tokens) " tokens, "
                    @if passage.has_same_names { "the same names" } @else { "other names" }
                    ", " (others(passage.others))
                }
                div.pair {
                    @for (name, excerpt) in pair.names.iter().zip(&passage.excerpts) {
                        (code(name, &stage.stage, excerpt, shown))
                    }
                }
            }
        }
        @if stage.more > 0 {
            p.soft { "The " (SHOWN) " longest passages are shown, and " (stage.more) " are not." }
        }
    }
}

fn of_many(common: &Common, shown: &mut Shown) -> Markup {
    let names: Vec<String> = common.names.iter().map(Untrusted::line).collect();
    html! {
        details.card {
            summary { (common.stage) ": " (common.names.len()) " submissions" }
            p { (names.join(", ")) }
            (code(&common.names[0], &common.stage, &common.excerpt, shown))
        }
    }
}

/// Where passages stand on the page: by student, stage, file and first and last line.
type Shown = BTreeMap<(Untrusted, String, Untrusted, [usize; 2]), usize>;

/// A passage; a link to it if another pair has it, too.
fn code(name: &Untrusted, stage: &str, excerpt: &Excerpt, shown: &mut Shown) -> Markup {
    let lines = [excerpt.lines.start, excerpt.lines.end - 1];
    let next = shown.len();
    let key = (name.clone(), stage.to_string(), excerpt.path.clone(), lines);
    let place = *shown.entry(key).or_insert(next);
    let anchor = format!("passage-{place}");
    html! {
        @if place == next {
            div id=(anchor) {
                p.soft { (name.line()) ", " (excerpt.path.line()) ", lines " (lines[0]) " to " (lines[1]) }
                pre { (excerpt.text.lines()) }
            }
        } @else {
            p.soft {
                (name.line()) ", " a href={ "#" (anchor) } { (excerpt.path.line()) ", lines " (lines[0]) " to " (lines[1]) }
                ": shown above"
            }
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
    format!("{:.0}\u{a0}%", 100.0 * share)
}
