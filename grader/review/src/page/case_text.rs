//! Describes the state of cases as text.

use judge::whole::Counts;
use look::case::{Case, State};
use pages::html::escape;
use std::fmt::Write;

/// The number of cases whose state satisfies `is`.
pub(super) fn count(cases: &[&Case], is: impl Fn(&State) -> bool) -> usize {
    cases.iter().filter(|case| is(&case.state)).count()
}

pub(super) fn differs(state: &State) -> bool {
    matches!(state, State::Differs { .. })
}

pub(super) fn is_refuted(state: &State) -> bool {
    matches!(state, State::Differs { wrong, .. } if !wrong.is_empty())
}

/// Whether no new answer is wrong, but some are not judged in every aspect.
pub(super) fn is_open(state: &State) -> bool {
    matches!(
        state,
        State::Differs { wrong, not_judged, .. } if wrong.is_empty() && !not_judged.is_empty()
    )
}

pub(super) fn is_silent(state: &State) -> bool {
    matches!(state, State::Silent(_))
}

/// Formats what a case tests and how its answers changed.
pub(super) fn describe(case: &Case) -> String {
    let mut text = format!("<p class=\"about\">{}</p>\n", escape(case.about));
    match &case.state {
        State::Same => text.push_str("<p class=\"good\">Nothing changed.</p>\n"),
        State::Silent(why) => {
            let _ = writeln!(text, "<p class=\"bad\">No answer: {}.</p>", escape(why));
        }
        State::Differs {
            changes,
            calls,
            counts,
            wrong,
            not_judged,
            nearer,
            ..
        } => {
            let _ = writeln!(text, "<p><strong>{}</strong></p>", escape(&meaning(case)));
            if changes.hash && *calls == 0 {
                text.push_str(
                    "<p>No row shows the difference: only the hash of all answers does.</p>\n",
                );
            }
            if nearer.nearer + nearer.farther > 0 {
                let _ = writeln!(
                    text,
                    "<p>Nearer to the truth: {}, farther: {}.</p>",
                    nearer.nearer, nearer.farther
                );
            }
            if wrong.is_empty() && not_judged.is_empty() {
                text.push_str("<p class=\"good\">The exact oracle confirms the new answers.</p>\n");
            } else if *counts != Counts::default() {
                let _ = writeln!(
                    text,
                    "<p>By the exact oracle, of all answers: {counts}.</p>"
                );
            }
            for open in not_judged {
                let _ = writeln!(text, "<p class=\"open\">Not judged: {}</p>", escape(open));
            }
            for (i, wrong) in wrong.iter().enumerate() {
                // The first aspect has the fault that explains the most.
                if i == 1 {
                    text.push_str(
                        "<details class=\"more\"><summary>more that is wrong</summary>\n",
                    );
                }
                let _ = writeln!(
                    text,
                    "<p class=\"bad\">Wrong by the exact oracle: {}</p>",
                    escape(wrong)
                );
            }
            if wrong.len() > 1 {
                text.push_str("</details>\n");
            }
        }
    }
    text
}

/// Formats a change as `grader bless` prints it.
pub(super) fn meaning(case: &Case) -> String {
    let State::Differs {
        changes, pixels, ..
    } = &case.state
    else {
        return String::new();
    };
    let mut parts = Vec::new();
    if !changes.is_empty() {
        parts.push(changes.to_string());
    }
    if let Some(picture) = &case.picture {
        parts.push(format!(
            "{pixels} of {} pixels changed",
            picture.actual.pixels().len()
        ));
    }
    parts.join("; ")
}
