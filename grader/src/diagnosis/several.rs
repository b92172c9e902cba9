//! Diagnoses of code that makes several mistakes at once.

use super::{Certainty, Claim, Diagnosis, FEWEST_CALLS, Named, Ranked, SURE, with_twins};
use crate::signature::{Alone, Evidence, Signature};
use std::cmp::Reverse;

/// Two mistakes together must explain this share of the wrong values.
const TOGETHER: f64 = 0.8;

/// Of the wrong values that the first of two mistakes leaves, the second must explain this share.
const OF_THE_REST: f64 = 0.8;

/// Two mistakes together may leave at most this fraction of what the likeliest single mistake
/// leaves unexplained.
const LEFT: f64 = 0.5;

/// A mistake is one of two only if, of the values that it alone makes wrong, the student gets this
/// share wrong, too.
const MADE: f64 = 0.75;

/// A mistake is combined to pairs only if at least this fraction of its wrong answers are also the
/// student's.
const CANDIDATE: f64 = 0.2;

/// At most this many mistakes are combined to pairs, those that explain the most: a pair takes a
/// millisecond.
const MOST_CANDIDATES: usize = 32;

/// One of several mistakes shows in at least so many wrong values.
const FEWEST_OF_SEVERAL: usize = 5;

/// One of several mistakes shows in at least this share of the values that it makes wrong.
const SHOWN_OF_SEVERAL: f64 = 0.9;

/// One of several mistakes shows in at least this share of the student's wrong values.
const SHARE_OF_SEVERAL: f64 = 0.3;

/// Two mistakes of which the second explains what the first leaves. `ranked` begins with the
/// likeliest.
pub(super) fn two_at_once(ranked: &[Ranked], student: &Signature) -> Option<Diagnosis> {
    let likeliest = ranked.first()?;
    let alone = likeliest.agreement.likeness();
    if alone >= 1.0 || !student.has_core_faults() {
        return None;
    }
    let is_candidate = |one: &&Ranked| {
        let shares = one.agreement.equal as f64 >= CANDIDATE * one.agreement.second as f64;
        one.known.mistakes.len() == 1 && one.agreement.equal > 0 && shares
    };
    let mut candidates: Vec<Ranked> = ranked.iter().filter(is_candidate).copied().collect();
    candidates.sort_by_key(|one| Reverse(one.agreement.equal));
    candidates.truncate(MOST_CANDIDATES);
    let pairs = candidates.iter().enumerate().flat_map(|(i, first)| {
        // The one that explains more comes first.
        let others = candidates[i + 1..].iter();
        others.map(move |second| (first, second))
    });
    let wrong = student.wrong();
    // If one mistake explains nearly all wrong values, its formula may cause the rest, too. Then a
    // second is assumed only if both together explain everything.
    let is_nearly_all = alone >= SURE;
    let (first, second, together) = pairs
        .filter(|(first, second)| {
            !is_nearly_all || is_same(first, likeliest) || is_same(second, likeliest)
        })
        .filter(|(first, second)| !is_same(first, second) || is_in_two_functions(first, second))
        .map(|(first, second)| {
            let [one, other] = [first, second].map(|one| &one.known.signature);
            (first, second, student.agreement_with_both(one, other))
        })
        .filter(|(first, _, together)| {
            let is_made = |alone: &Alone| {
                alone.shown >= FEWEST_CALLS && alone.shown as f64 >= MADE * alone.of as f64
            };
            let rest = wrong - first.agreement.equal;
            let of_rest = together.equal - first.agreement.equal;
            together.alone.iter().all(is_made) && of_rest as f64 >= OF_THE_REST * rest as f64
        })
        .max_by(|a, b| {
            let likeness = a.2.likeness().total_cmp(&b.2.likeness());
            // One mistake, made twice, needs fewer assumptions than two; so does a mistake that is
            // made in every function that it would affect.
            let elsewhere =
                |(one, other, _): &(&Ranked, &Ranked, _)| one.elsewhere + other.elsewhere;
            likeness
                .then(is_same(a.0, a.1).cmp(&is_same(b.0, b.1)))
                .then(elsewhere(b).cmp(&elsewhere(a)))
        })?;
    let likeness = together.likeness();
    let explains = likeness >= TOGETHER && 1.0 - likeness <= LEFT * (1.0 - alone);
    let is_whole = together.alone.iter().all(|alone| alone.shown == alone.of) && likeness >= 1.0;
    if !explains || likeness <= alone || (is_nearly_all && !is_whole) {
        return None;
    }
    let by_first = first.agreement.equal;
    let by_second = together.equal - by_first;
    let second_explains = match together.equal == wrong {
        true => format!("the other {by_second}"),
        false => format!("{by_second} more"),
    };
    let is_one_mistake = is_same(first, second);
    let [mut first, second] = [with_twins(ranked, first)?, with_twins(ranked, second)?];
    let (preface, description) = match is_one_mistake {
        true => ("", format!("{}, in two functions", first.says)),
        false => (
            "two mistakes at once: ",
            format!("{}, and that {}", first.says, second.says),
        ),
    };
    if !is_one_mistake {
        first.mistakes.extend(second.mistakes);
        first.others.push_str(&second.others);
        if first.hint != second.hint {
            first.hint = format!("{} {}", first.hint, second.hint);
        }
    }
    Some(Diagnosis {
        mistakes: first.mistakes,
        says: format!(
            "{preface}your answers look like those of code that {description}: the first explains {by_first} of {wrong} wrong values, the second {second_explains}{}",
            first.others,
        ),
        description,
        hint: first.hint,
        equal: together.equal,
        of: together.either,
        certainty: Certainty::of(likeness, student),
        claim: Claim::Pair([by_first, by_second]),
        ..Diagnosis::default()
    })
}

/// One of several mistakes: nearly all wrong values of code that makes it are also the student's,
/// and wrong in the same way. The student has other wrong values, too: of another form of it, or of
/// another mistake.
pub(super) fn one_of_several(ranked: &[Ranked], student: &Signature) -> Option<Diagnosis> {
    if !student.has_core_faults() {
        return None;
    }
    let wrong = student.wrong();
    let (best, Alone { shown: equal, .. }) = ranked
        .iter()
        .filter(|one| one.known.mistakes.len() == 1)
        .filter(|one| !student.is_alike_in_crashes_only(&one.known.signature))
        .map(|one| (one, student.shows(&one.known.signature)))
        .filter(|(_, Alone { of, shown })| {
            *shown >= FEWEST_OF_SEVERAL
                && *shown as f64 >= SHOWN_OF_SEVERAL * *of as f64
                && *shown as f64 >= SHARE_OF_SEVERAL * wrong as f64
        })
        .max_by_key(|(one, Alone { of, shown })| (*shown, Reverse(*of), Reverse(one.elsewhere)))?;
    let Named {
        mistakes,
        says,
        others,
        hint,
    } = with_twins(ranked, best)?;
    let evidence = student.evidence();
    let are = match evidence {
        Evidence::Exact => "equal",
        _ => "are wrong in the same way as",
    };
    Some(Diagnosis {
        mistakes,
        says: format!(
            "{equal} of {wrong} wrong values {are} those of code that {says}{others}; the other {} do not fit: another form of it, or another mistake as well",
            wrong - equal
        ),
        description: says,
        hint,
        equal,
        of: wrong,
        certainty: Certainty::Perhaps,
        claim: Claim::OneOfSeveral(evidence),
        ..Diagnosis::default()
    })
}

/// Whether two versions make the same mistake.
fn is_same(first: &Ranked, second: &Ranked) -> bool {
    first.known.mistakes == second.known.mistakes
}

/// Whether two versions make their mistakes in different functions.
fn is_in_two_functions(first: &Ranked, second: &Ranked) -> bool {
    let [first, second] = [first, second].map(|one| one.known.signature.functions());
    !first.is_empty() && !second.is_empty() && first.is_disjoint(&second)
}

#[cfg(test)]
mod tests {
    use crate::diagnosis::tests::known;
    use crate::diagnosis::{Diagnosis, diagnose};
    use crate::signature::tests::signature;

    /// What is said of a student's wrong values where one mistake is known.
    fn diagnosis(mistake: &[(&str, &str)], student: &[(&str, &str)]) -> Option<Diagnosis> {
        diagnose(&[known("this", signature(mistake))], &signature(student))
    }

    #[test]
    fn a_second_mistake_explains_what_the_first_leaves() {
        let all = [
            known("first", signature(&[("case t", "90*a")])),
            known("second", signature(&[("case normal", "20*b")])),
        ];
        let of = |rest| {
            diagnose(
                &all,
                &signature(&[("case t", "90*a"), ("case normal", rest)]),
            )
        };
        let pair = of("20*b").expect("both are known");
        assert!(
            pair.says
                .ends_with("the first explains 90 of 110 wrong values, the second the other 20"),
            "{}",
            pair.says
        );
        assert_eq!(pair.mistakes, ["first", "second"]);
        // Half of the rest is not enough: a second mistake is not invented.
        let one = of("20*b 20*c").map(|diagnosis| diagnosis.mistakes);
        assert_ne!(one.as_deref().map(<[_]>::len), Some(2));
    }

    #[test]
    fn one_mistake_in_two_functions_is_not_told_as_two() {
        let in_one = ("case t@one", "90*a");
        let in_two = ("case t@two", "20*b");
        let all = [
            known("this", signature(&[in_one])),
            known("other", signature(&[in_two])),
            known("this", signature(&[in_two])),
        ];
        let diagnosis = diagnose(&all, &signature(&[in_one, in_two])).expect("it is known");
        assert_eq!(diagnosis.mistakes, ["this"]);
        assert!(
            diagnosis
                .says
                .contains("code that does this, in two functions: the first explains 90"),
            "{}",
            diagnosis.says
        );
    }

    #[test]
    fn a_mistake_is_one_of_several_if_all_that_it_makes_wrong_is_wrong_in_the_same_way() {
        let [pdf, f] = ["case pdf", "case bsdf"];
        let known = [(pdf, "10*a")];
        let one = diagnosis(&known, &[(pdf, "10*a"), (f, "20*b")]).expect("it is one of several");
        assert_eq!(
            one.says,
            "10 of 30 wrong values equal those of code that does this; the other 20 do not fit: \
             another form of it, or another mistake as well"
        );
        assert!(!one.is_likely());
        let others = [
            [(pdf, "8*a 2*c"), (f, "20*b")],
            [(pdf, "10*a"), (f, "30*b")],
        ];
        assert_eq!(
            others.map(|student| diagnosis(&known, &student)),
            [None, None]
        );
        assert_eq!(
            diagnosis(&[(pdf, "4*a")], &[(pdf, "4*a"), (f, "9*b")]),
            None
        );
    }

    #[test]
    fn where_one_mistake_explains_nearly_all_a_second_explains_the_whole_rest() {
        let all = [
            known("this", signature(&[("case t", "97*a")])),
            known("that", signature(&[("case normal", "3*b")])),
        ];
        let named = |rest| {
            let student = signature(&[("case t", "97*a"), ("case normal", rest)]);
            diagnose(&all, &student).expect("it is known").mistakes
        };
        assert_eq!(named("3*b"), ["this", "that"]);
        assert_eq!(named("3*c"), ["this"]);
        assert_eq!(named("2*b 1*c"), ["this"]);
    }

    #[test]
    fn a_miss_is_no_evidence_of_one_of_several_mistakes() {
        let miss = ("case decision", "10*a");
        assert_eq!(diagnosis(&[miss], &[miss, ("case t", "10 20*b")]), None);
    }
}
