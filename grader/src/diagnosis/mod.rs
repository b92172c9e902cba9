//! Diagnosis: which typical mistake a student's wrong answers look like.
//!
//! `golden/signatures/TASK.bin` holds the signature of each known mistake; `grader mutants TASK
//! --bless` makes it from the mutants, `grader mutants TASK --stored` prints it. A student's
//! signature is compared with all of them.

pub(crate) mod constant;
mod constant_values;
mod fresh_cases;
pub(crate) mod mistake;
mod ruled_out;
mod several;
pub mod simplest;

pub use constant_values::Constants;
pub use mistake::{Certainty, Claim, Diagnosis, Known, Place};

use crate::score::regularity::{self, Regularity};
use crate::score::{CaseResult, Status, TaskResult};
use crate::signature::{Agreement, Signature, stored};
use base::{GraderError, Workspace, write_whole};
use fresh_cases::FreshCases;
use judge::cases::Spec;
use judge::findings::Aspect;
use mistake::SURE;
use ruled_out::is_ruled_out;
use std::cmp::Ordering;
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

/// So many wrong calls must agree before a name is likely: one call agrees with many mistakes.
const FEWEST_CALLS: usize = 2;

/// More guesses than these are no help: then no mistake is named.
pub const MOST_GUESSES: usize = 3;

/// What is said first where only extra credit is lost.
const EXTRA_CREDIT: &str = "this is extra credit, which correct textbook code loses, too; ";

/// From this likeness on, the report says that the answers look like those of the mistake.
const LIKELY: f64 = 0.7;

/// The known mistakes of a task; none if nothing is stored for it.
pub fn known(workspace: &Workspace, task: &str) -> Result<Vec<Known>, GraderError> {
    let path = path(workspace, task);
    if !path.is_file() {
        return Ok(Vec::new());
    }
    let bytes = std::fs::read(&path).map_err(|e| GraderError::file("read", &path, e))?;
    from_bytes(&bytes).map_err(|why| {
        let why = format!(
            "it is damaged: {why}. Restore it, from your handout or with `git checkout`; \
             authors make it with `cargo grader mutants {task} --bless`"
        );
        GraderError::file("understand", &path, why)
    })
}

/// Stores the known mistakes of a task.
pub fn store(workspace: &Workspace, task: &str, known: &[Known]) -> Result<(), GraderError> {
    let path = path(workspace, task);
    let folder = path.parent().unwrap_or(Path::new("."));
    std::fs::create_dir_all(folder).map_err(|e| GraderError::file("make", folder, e))?;
    let bytes = to_bytes(known).map_err(|why| GraderError::file("write", &path, why))?;
    write_whole(&path, &bytes)
}

/// Packs known mistakes, as they are stored. The error says what is too large.
pub fn to_bytes(known: &[Known]) -> Result<Vec<u8>, String> {
    stored::write(known)
}

/// Unpacks what [`to_bytes`] packed. The error says what is wrong with the bytes.
pub fn from_bytes(bytes: &[u8]) -> Result<Vec<Known>, String> {
    stored::read(bytes)
}

/// The file of a task's signatures, below the root folder of the workspace.
pub fn file_of(task: &str) -> PathBuf {
    format!("golden/signatures/{task}.bin").into()
}

/// Where the signatures of a task are stored.
fn path(workspace: &Workspace, task: &str) -> PathBuf {
    workspace.root().join(file_of(task))
}

/// The known mistakes that are most like `student`, best first: their names, the likeness, and
/// whether right answers contradict them. For authors who wonder about a diagnosis.
pub fn candidates(known: &[Known], student: &Signature) -> Vec<(Vec<String>, f64, bool)> {
    let mut all: Vec<(Vec<String>, f64, bool)> = within(known, student)
        .iter()
        .map(|InFunctions { known, .. }| {
            let likeness = student.agreement(&known.signature).likeness();
            let contradicted = student.contradicts(&known.signature);
            (known.mistakes.clone(), likeness, contradicted)
        })
        .collect();
    all.sort_by(|a, b| b.1.total_cmp(&a.1));
    all
}

/// Leaves out of the known mistakes the cases of which nothing is written yet, and of other cases
/// the aspects that only answers of functions have which are not written yet: a mistake in the
/// function that is written does not show there.
fn leave_out_unwritten(known: &mut [Known], cases: &[CaseResult]) {
    let is_unwritten = |case: &&CaseResult| case.status == Status::NotAttempted;
    let unwritten: BTreeSet<&str> = cases
        .iter()
        .filter(is_unwritten)
        .map(|case| case.name.as_str())
        .collect();
    let judged_in_part: BTreeMap<&str, BTreeSet<Aspect>> = cases
        .iter()
        .filter(|case| case.has_hole())
        .map(|case| {
            let findings = case.findings.iter();
            let aspects = findings.map(|finding| finding.aspect);
            (case.name.as_str(), aspects.collect())
        })
        .collect();
    if unwritten.is_empty() && judged_in_part.is_empty() {
        return;
    }
    for known in known {
        let signature = known.signature.without(&unwritten);
        known.signature = signature.in_aspects(&judged_in_part);
    }
}

/// What a report says of the wrong answers of a task: what explains them, and what they have in
/// common.
#[derive(Clone, Debug, Default)]
pub struct Explanation {
    /// What they look like.
    pub diagnosis: Option<Diagnosis>,
    /// What they have in common.
    pub regularities: Vec<Regularity>,
}

/// Explains the wrong answers of `result`, to questions that were made with `seed`: `cases` are its
/// cases with the questions that students have, and `wrong_where` the circumstances of wrong simple
/// calls. Where only cases fail that also run other tasks, nothing is explained.
pub fn explain(
    result: &TaskResult,
    cases: &[CaseResult],
    known: &[Known],
    (specs, seed): (&[Spec], u64),
    wrong_where: &[Vec<&str>],
) -> Explanation {
    if result.fails_only_with_neighbours() {
        return Explanation::default();
    }
    let fresh = FreshCases::of(&result.key, specs, seed);
    let mut known = known.to_vec();
    for known in &mut known {
        known.signature = fresh.removed_from(&known.signature);
    }
    leave_out_unwritten(&mut known, cases);
    let student = fresh.removed_from(&Signature::of(cases));
    let regularities = regularity::beside(&result.key, cases, specs, wrong_where);
    let guess = constant::or_known(cases, &known, &student).filter(|guess| {
        let of_task = (result.key.as_str(), specs);
        !is_ruled_out(guess, &known, &student, &regularities, of_task)
    });
    Explanation {
        diagnosis: guess.map(|guess| Diagnosis {
            places: places(&guess, &known, &student),
            ..guess
        }),
        regularities,
    }
}

/// Where wrong answers of `student` are those of a mistake that `guess` names.
fn places(guess: &Diagnosis, known: &[Known], student: &Signature) -> BTreeSet<Place> {
    let is_named = |known: &&Known| {
        let mut names = known.mistakes.iter();
        names.all(|name| guess.mistakes.contains(name))
    };
    let named = known.iter().filter(is_named);
    let mut places: BTreeSet<Place> = named
        .flat_map(|known| student.places_alike(&known.signature.as_seen_by(student)))
        .collect();
    if let Claim::Constant(constants) = &guess.claim {
        places.extend(constants.places());
    }
    places
}

/// What `student` looks like, if it looks like anything known.
pub fn diagnose(known: &[Known], student: &Signature) -> Option<Diagnosis> {
    let mut in_functions = within(known, student);
    in_functions.retain(|InFunctions { known, .. }| {
        !known.is_symptom || known.signature.shows_the_same(student)
    });
    let possible = in_functions
        .iter()
        .filter(|possible| !student.contradicts(&possible.known.signature));
    let mut ranked: Vec<Ranked> = possible.map(|one| Ranked::of(one, student)).collect();
    // What the report says next must not rule out a guess.
    ranked.retain(|one| one.agreement.likeness() >= SURE || !student.refutes(&one.known.signature));
    ranked.sort_by(Ranked::compare);
    let likeliest = *ranked.first()?;
    let likeness = likeliest.agreement.likeness();
    if let Some(pair) = several::two_at_once(&ranked, student) {
        return Some(pair);
    }
    let best = if likeness >= LIKELY {
        likeliest
    } else if let Some(alone) = alone_of_its_kind(&ranked, student) {
        alone
    } else {
        return several::one_of_several(&ranked, student);
    };
    let Named {
        mistakes,
        says,
        others,
        hint,
    } = with_twins(&ranked, &best)?;
    let best = best.known;
    let (equal, of) = student.calls_alike(&best.signature);
    // Correct textbook code loses extra credit, too, in many ways: there, only a mistake that has
    // the same answers everywhere has a name, and one call is no mistake.
    let is_extra = !student.has_core_faults();
    if is_extra && (of < FEWEST_CALLS || equal < of) {
        return None;
    }
    // A case that disagrees throughout makes a name uncertain. It does not veto it: tried on 199
    // mistakes that were not known, a veto took away eight names, all of them right.
    let is_doubtful = of < FEWEST_CALLS || student.disagrees_throughout(&best.signature);
    let certainty = match is_doubtful {
        true => Certainty::Perhaps,
        false => Certainty::of(likeness, student),
    };
    // Whoever overflows the stack does so for one of many reasons, if not where the mistake does.
    let is_partly = certainty == Certainty::Perhaps && equal < of;
    if is_partly && student.is_alike_in_crashes_only(&best.signature) {
        return None;
    }
    let claim = match certainty {
        Certainty::Perhaps if !is_extra => Claim::MostAlike,
        _ => Claim::Alike(student.evidence()),
    };
    let preface = match is_extra {
        true => EXTRA_CREDIT,
        false => "",
    };
    let answers = match claim {
        Claim::Alike(evidence) => evidence.says(&says, equal, of),
        _ => most_alike(&says, equal, of),
    };
    Some(Diagnosis {
        mistakes,
        says: format!("{preface}{answers}{others}"),
        description: says,
        hint,
        equal,
        of,
        certainty,
        claim,
        ..Diagnosis::default()
    })
}

/// The claim about answers that look most like those of code that `says` what, on `equal` of `of`
/// calls: the faults may be of the same kinds, and no answer the same.
fn most_alike(says: &str, equal: usize, of: usize) -> String {
    match equal {
        0 => format!("your answers have faults of the same kinds as those of code that {says}"),
        _ => format!(
            "your answers look most like those of code that {says}: on {equal} of {of} calls"
        ),
    }
}

/// The known mistakes, as a student shows them who is wrong in some functions only: a mistake that passes from
/// one function to others may be made in only one of them. Of two mistakes that look the same in
/// these functions, the one that affects only them comes first.
fn within(known: &[Known], student: &Signature) -> Vec<InFunctions> {
    let functions = &student.functions();
    let mut known: Vec<InFunctions> = known
        .iter()
        .map(|known| {
            let signature = known.signature.within(functions);
            InFunctions {
                elsewhere: known.signature.wrong() - signature.wrong(),
                known: Known {
                    signature: signature.as_seen_by(student),
                    ..known.clone()
                },
            }
        })
        .collect();
    known.sort_by_key(|known| known.elsewhere);
    known
}

/// A known mistake, restricted to some functions.
struct InFunctions {
    known: Known,
    /// The wrong values that it has in other functions.
    elsewhere: usize,
}

/// A known mistake, compared with a student's answers.
#[derive(Clone, Copy)]
struct Ranked<'a> {
    known: &'a Known,
    /// The wrong values that it would also have in functions whose answers are right.
    elsewhere: usize,
    agreement: Agreement,
    /// The likeness in robust cases.
    robust: f64,
}

impl Ranked<'_> {
    fn of<'a>(one: &'a InFunctions, student: &Signature) -> Ranked<'a> {
        let signature = &one.known.signature;
        Ranked {
            known: &one.known,
            elsewhere: one.elsewhere,
            agreement: student.agreement(signature),
            robust: student.robust_agreement(signature).likeness(),
        }
    }

    /// The likeliest first. Of equals, the one that needs the fewest assumptions: that it is made
    /// in one function and not in another needs one, and so does a second mistake.
    fn compare(&self, other: &Ranked) -> Ordering {
        let likeness = |of: &Ranked| of.agreement.likeness();
        let mistakes = |of: &Ranked| of.known.mistakes.len();
        likeness(other)
            .total_cmp(&likeness(self))
            .then(self.elsewhere.cmp(&other.elsewhere))
            .then(mistakes(self).cmp(&mistakes(other)))
            .then(other.robust.total_cmp(&self.robust))
    }

    /// Whether this mistake explains the answers of this run as well as the other: it has the same
    /// faults in the cases that count, and is no more contradicted by functions whose answers are
    /// right. Robust cases do not decide, because the formula around a mistake fails them, too.
    fn is_as_likely_as(&self, other: &Ranked) -> bool {
        self.known.signature.shows_the_same(&other.known.signature)
            && (self.elsewhere == 0 || other.elsewhere > 0)
    }
}

/// The mistake whose faults are of the same kinds as the student's. The cases in which they occur
/// may differ: a tree that is built in another way has its leaves elsewhere. `None` if two mistakes
/// have these kinds, or if the kind of a fault is not known.
fn alone_of_its_kind<'a>(ranked: &[Ranked<'a>], student: &Signature) -> Option<Ranked<'a>> {
    let kinds = student.kinds()?;
    let mut alike = ranked
        .iter()
        .filter(|one| one.known.signature.kinds().as_ref() == Some(&kinds));
    let first = alike.next()?;
    alike
        .all(|other| other.known.mistakes == first.known.mistakes)
        .then_some(*first)
}

/// What is said about a mistake and those that cannot be distinguished from it.
struct Named {
    /// The names of all of them.
    mistakes: Vec<String>,
    /// The end of the sentence about the mistake that fits best.
    says: String,
    /// The other guesses, each a clause of its own: what they say may be the opposite.
    others: String,
    /// The hints of all of them.
    hint: String,
}

/// What is said about `best` and those of `ranked` that cannot be distinguished from it. If they
/// are too many, those that the robust cases make less likely are left out; `None` if they are
/// still too many.
fn with_twins(ranked: &[Ranked], best: &Ranked) -> Option<Named> {
    let as_likely = ranked
        .iter()
        .filter(|twin| twin.known.mistakes.len() <= best.known.mistakes.len())
        .filter(|twin| twin.is_as_likely_as(best));
    let all: Vec<Ranked> = as_likely.copied().collect();
    let is_as_robust = |twin: &&Ranked| twin.robust >= best.robust;
    guesses(best, all.iter()).or_else(|| guesses(best, all.iter().filter(is_as_robust)))
}

/// What is said about `best` and its `twins`; `None` if they are too many.
fn guesses<'a>(best: &Ranked, twins: impl Iterator<Item = &'a Ranked<'a>>) -> Option<Named> {
    let mut named = Named {
        mistakes: best.known.mistakes.clone(),
        says: best.known.descriptions.join(", and "),
        others: String::new(),
        hint: best.known.hints.join(" "),
    };
    let mut guesses = 1;
    for Ranked { known: twin, .. } in twins {
        let is_new = |mistake: &&String| !named.mistakes.contains(mistake);
        let new: Vec<String> = twin.mistakes.iter().filter(is_new).cloned().collect();
        if !new.is_empty() {
            guesses += 1;
            named.mistakes.extend(new);
            let says = twin.descriptions.join(", and ");
            let other = format!("; the same is true of code that {says}");
            named.others.push_str(&other);
            let hint = twin.hints.join(" ");
            if !named.hint.contains(&hint) {
                named.hint = format!("{} Or: {hint}", named.hint);
            }
        }
    }
    (guesses <= MOST_GUESSES).then_some(named)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::signature::tests::signature;

    pub(super) fn known(name: &str, signature: Signature) -> Known {
        Known {
            mistakes: vec![name.into()],
            descriptions: vec![format!("does {name}")],
            hints: vec![format!("Not {name}.")],
            signature,
            is_symptom: false,
        }
    }

    #[test]
    fn answers_alike_on_no_call_are_not_said_to_look_alike() {
        assert!(!most_alike("culls", 0, 9).contains("on 0 of"));
        assert!(most_alike("culls", 5, 9).ends_with("code that culls: on 5 of 9 calls"));
    }

    #[test]
    fn indistinguishable_mistakes_are_both_named_with_their_hints() {
        let wrong = signature(&[("case t", "2 8*a")]);
        let all = [known("this", wrong.clone()), known("that", wrong.clone())];
        let diagnosis = diagnose(&all, &wrong).expect("the mistake is known");
        assert_eq!(diagnosis.mistakes, ["this", "that"]);
        assert_eq!(diagnosis.hint, "Not this. Or: Not that.");
        assert_eq!(
            diagnosis.says,
            "your answers equal those of code that does this: on 8 of 8 calls; \
             the same is true of code that does that"
        );
    }

    #[test]
    fn one_mistake_needs_fewer_assumptions_than_two() {
        let core = signature(&[("case t", "2 8*a")]);
        let student = core.clone().with_robust(signature(&[("extra t", "8*a")]));
        let one = known("one", core);
        let mut two = known("one", student.clone());
        two.mistakes.push("another".into());
        two.descriptions.push("does another".into());
        let diagnosis = diagnose(&[two, one], &student).expect("both are known");
        assert_eq!(diagnosis.mistakes, ["one"]);
    }

    #[test]
    fn more_than_three_guesses_are_no_name() {
        let wrong = signature(&[("case t", "2 8*a")]);
        let all: Vec<Known> = ["a", "b", "c", "d"]
            .map(|name| known(name, wrong.clone()))
            .into();
        assert!(diagnose(&all[..3], &wrong).is_some());
        assert_eq!(diagnose(&all, &wrong), None);
    }

    #[test]
    fn a_guess_that_right_answers_contradict_is_not_as_likely() {
        let of = |sides: &[&str]| {
            let sides: Vec<(&str, &str)> = sides.iter().map(|side| (*side, "9*a")).collect();
            signature(&sides)
        };
        let in_both = known("both", of(&["case t@one", "case t@two"]));
        let in_one = known("one", of(&["case t@one"]));
        let named = |all: &[Known]| {
            let diagnosis = diagnose(all, &of(&["case t@one"]));
            diagnosis.expect("it is known").mistakes
        };
        assert_eq!(named(&[in_both.clone(), in_one]), ["one"]);
        assert_eq!(named(&[in_both]), ["both"]);
    }

    #[test]
    fn cases_of_functions_that_are_not_written_yet_do_not_speak_against_a_mistake() {
        let written = ("test decision@test", "20*a");
        let unwritten = ("record decision@record", "80*a");
        let nearest = ("nearest decision", "80*a");
        let mut all = [known("this", signature(&[written, unwritten, nearest]))];
        let student = signature(&[written]);
        assert_eq!(diagnose(&all, &student), None);
        let not_attempted = CaseResult {
            status: Status::NotAttempted,
            ..CaseResult::failed("nearest", Vec::new())
        };
        let wrong = CaseResult::failed("test", Vec::new());
        leave_out_unwritten(&mut all, &[wrong, not_attempted]);
        let diagnosis = diagnose(&all, &student).expect("the mistake is known");
        assert_eq!((diagnosis.equal, diagnosis.of), (20, 20));
    }

    #[test]
    fn a_symptom_is_named_only_if_every_answer_agrees() {
        let symptom = Known {
            is_symptom: true,
            ..known("misses", signature(&[("case decision", "50*a")]))
        };
        let named = |codes| {
            let student = signature(&[("case decision", codes)]);
            diagnose(std::slice::from_ref(&symptom), &student).is_some()
        };
        assert!(named("50*a"));
        assert!(!named("1 49*a"));
    }

    #[test]
    fn one_wrong_call_makes_no_name_likely() {
        let certainty = |codes| {
            let student = signature(&[("case decision", codes)]);
            let all = [known("this", student.clone())];
            diagnose(&all, &student).map(|diagnosis| diagnosis.certainty)
        };
        assert_eq!(certainty("5 1*a"), Some(Certainty::Perhaps));
        assert_eq!(certainty("5 2*a"), Some(Certainty::Likely));
    }

    #[test]
    fn crashes_alone_are_no_guess() {
        let crashes = [("one crashed", "1*ffff"), ("two crashed", "1*ffff")];
        let [third, t] = [("three crashed", "1*ffff"), ("four t", "9*a")];
        let named = |mistake: &[(&str, &str)], student: &[(&str, &str)]| {
            let [mistake, student] = [mistake, student].map(|own| {
                let all = [&crashes[..], own].concat();
                signature(&all)
            });
            diagnose(&[known("this", mistake)], &student).map(|diagnosis| diagnosis.certainty)
        };
        assert!(named(&[third], &[third]).is_some() && named(&[], &[]).is_some());
        assert_eq!(named(&[], &[third, ("five crashed", "1*ffff")]), None);
        let nearly = named(&[t], &[("four t", "8*a 1*b")]);
        assert_eq!(nearly, Some(Certainty::Perhaps));
    }

    #[test]
    fn what_only_robust_cases_show_makes_no_name_likely() {
        let student = signature(&[("case decision", "9*a")]).into_robust();
        let all = [known("this", student.clone())];
        let diagnosis = diagnose(&all, &student).expect("the mistake is known");
        assert_eq!(diagnosis.certainty, Certainty::Perhaps);
        assert!(
            diagnosis.says.starts_with(EXTRA_CREDIT),
            "{}",
            diagnosis.says
        );
        // Textbook code that differs from the mistake in one call is not compared with it.
        let textbook = signature(&[("case decision", "9*a 1*b")]).into_robust();
        assert_eq!(diagnose(&all, &textbook), None);
    }

    #[test]
    fn one_call_of_extra_credit_has_no_name() {
        let named = |codes| {
            let student = signature(&[("case work", codes)]).into_robust();
            let all = [known("this", student.clone())];
            diagnose(&all, &student).is_some()
        };
        assert!(!named("5 1*a"));
        assert!(named("5 2*a"));
    }

    #[test]
    fn a_guess_that_a_right_case_or_field_rules_out_is_not_printed() {
        let mistake = known("this", signature(&[("one t", "40*a"), ("two t", "6*a")]));
        let is_named = |sides: &[(&str, &str)]| {
            diagnose(std::slice::from_ref(&mistake), &signature(sides)).is_some()
        };
        let one = ("one t", "40*a 4*b");
        assert!(is_named(&[one, ("two t", "1*b")]));
        assert!(!is_named(&[one]));
        // A crash hides what would be wrong in the case.
        assert!(is_named(&[one, ("two crashed", "1*ffff")]));
        let mistake = known(
            "this",
            signature(&[("one t", "90*a"), ("one normal", "6*a")]),
        );
        let student = signature(&[("one t", "80*a 10*b"), ("one position", "9*c")]);
        assert_eq!(diagnose(&[mistake], &student), None);
    }

    #[test]
    fn two_pairs_that_cannot_be_distinguished_are_both_named() {
        let together = signature(&[("case t", "9*c")]);
        let pair = |second: &str| Known {
            mistakes: vec!["this".into(), second.into()],
            ..known("this and another", together.clone())
        };
        let all = [
            known("this", signature(&[("case t", "9*a")])),
            pair("that"),
            pair("other"),
        ];
        let diagnosis = diagnose(&all, &together).expect("the pairs are known");
        assert_eq!(diagnosis.mistakes, ["this", "that", "other"]);
        assert!(diagnosis.says.contains("; the same is true of code"));
    }

    #[test]
    fn robust_cases_do_not_decide_between_mistakes() {
        let in_core = signature(&[("case t", "9*a")]);
        let with = |hard| in_core.clone().with_robust(signature(&[("hard t", hard)]));
        let all = [known("this", with("9*c")), known("that", with("9*b"))];
        let diagnosis = diagnose(&all, &with("9*b")).expect("both are known");
        assert_eq!(diagnosis.mistakes, ["that", "this"]);
    }

    #[test]
    fn a_case_that_disagrees_throughout_makes_a_name_less_certain() {
        let [weights, lights] = ["weights radiance", "lights radiance"];
        let all = [known(
            "this",
            signature(&[(weights, "500*a"), (lights, "6*a")]),
        )];
        let is_named = |codes| diagnose(&all, &signature(&[(weights, "500*a"), (lights, codes)]));
        let certainty = |codes| is_named(codes).map(|diagnosis| diagnosis.certainty);
        assert_eq!(certainty("6*a"), Some(Certainty::Likely));
        assert_eq!(certainty("1*a 5*b"), Some(Certainty::Likely));
        assert_eq!(certainty("6*b"), Some(Certainty::Perhaps));
        let several = is_named("400*b").expect("500 values agree");
        assert!(
            several.says.starts_with("500 of 900 wrong values"),
            "{}",
            several.says
        );
    }

    #[test]
    fn answers_that_differ_in_part_are_only_perhaps_a_mistake() {
        let [t, n, p] = ["case t", "case normal", "case position"].map(|side| (side, "10*a"));
        let all = [known(
            "this",
            signature(&[t, n, p, ("case barycentrics", "10*a")]),
        )];
        let certainty = |codes| {
            let diagnosis = diagnose(&all, &signature(&[t, n, p, ("case barycentrics", codes)]));
            diagnosis.expect("the mistake is known").certainty
        };
        assert_eq!(certainty("9*a 1*b"), Certainty::Likely);
        assert_eq!(certainty("6*a 4*b"), Certainty::Perhaps);
    }
}
