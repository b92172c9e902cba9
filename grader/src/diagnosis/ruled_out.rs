//! Tests a guess against what the report says next: where all wrong answers are.

use super::mistake::{Diagnosis, Known};
use crate::score::regularity::{Regularity, Shared};
use crate::signature::{REFUTING, Signature};
use judge::cases::Spec;

/// Whether the sentences about what the wrong answers of `student` have in `common` rule out a
/// guess: however the mistake is made, it makes at least `REFUTING` answers wrong elsewhere than
/// where the sentences say that all wrong answers are. A likely mistake is no guess.
pub(super) fn is_ruled_out(
    guess: &Diagnosis,
    known: &[Known],
    student: &Signature,
    common: &[Regularity],
    (task, specs): (&str, &[Spec]),
) -> bool {
    let spec_of = |case: &str| specs.iter().find(|spec| spec.is(task, case));
    let is_elsewhere = |case: &str, call: u32| {
        // Where nothing is known of a call, it rules nothing out.
        let here = spec_of(case).and_then(|spec| spec.circumstances(call as usize));
        here.is_some_and(|here| {
            common.iter().any(|regularity| match &regularity.shared {
                Shared::Circumstances(places) => places.iter().any(|place| !here.contains(place)),
                _ => false,
            })
        })
    };
    let is_form = |known: &&Known| guess.mistakes.starts_with(&known.mistakes);
    let mut forms = known.iter().filter(is_form).peekable();
    !guess.is_likely()
        && forms.peek().is_some()
        && forms.all(|Known { signature, .. }| {
            let wrong = signature
                .within(&student.functions())
                .wrong_calls(&|case| spec_of(case).map(Spec::calls));
            let elsewhere = wrong
                .iter()
                .filter(|wrong| is_elsewhere(&wrong.case, wrong.call));
            elsewhere.count() >= REFUTING
        })
}

#[cfg(test)]
mod tests {
    use crate::diagnosis::tests::known;
    use crate::diagnosis::{Certainty, diagnose};
    use crate::score::regularity::{Regularity, Shared};
    use crate::signature::tests::signature;

    #[test]
    fn where_all_wrong_answers_are_rules_out_a_mistake_that_shows_elsewhere() {
        const TASK: &str = "part1.task4";
        let specs = judge::cases::of(TASK, 0);
        let inside = ("origin_inside t", "10*a");
        let ahead = ("head_on t", "10*a");
        let student = signature(&[("origin_inside t", "8*a 2*b")]);
        let common = [Regularity {
            in_core: false,
            shared: Shared::Circumstances(vec!["the ray starts inside the sphere"]),
        }];
        let is_ruled_out = |mistake: &[(&str, &str)], common: &[Regularity]| {
            let all = [known("this", signature(mistake))];
            let guess = diagnose(&[known("this", signature(&[inside]))], &student);
            let guess = guess.expect("eight of ten answers agree");
            assert_eq!(guess.certainty, Certainty::Perhaps);
            super::is_ruled_out(&guess, &all, &student, common, (TASK, &specs))
        };
        assert!(is_ruled_out(&[inside, ahead], &common));
        assert!(!is_ruled_out(&[inside], &common));
        assert!(!is_ruled_out(&[inside, ahead], &[]));
    }
}
