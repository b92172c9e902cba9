//! What the wrong answers of a task have in common, where they match no known mistake: which fields
//! are wrong and which right, how they are wrong, and under which circumstances.

use crate::score::CaseResult;
use judge::Tier;
use judge::cases::Spec;
use judge::findings::{Aspect, Class, Fault, Finding};
use serde::{Serialize, Serializer};
use std::collections::{BTreeMap, BTreeSet};
use std::fmt;

/// This share of the wrong answers must be wrong in the same way to be said to be.
const MOST: f64 = 0.95;

/// A regularity needs at least this many wrong answers.
const FEWEST: usize = 4;

/// A circumstance is said only if at most this share of the other answers has it, too.
const TELLING: f64 = 0.6;

/// At most this many circumstances are said.
const CIRCUMSTANCES: usize = 2;

/// The cause of errors of a certain size, in the sentence about them.
pub(crate) const FEW_DIGITS: &str =
    "the precision of f32 (`as f32`, `f32` literals), or of a constant typed with few digits";

/// What errors of the size of rounding come from where only robust cases show them, in which
/// textbook formulas cancel.
const CANCELLATION: &str =
    "digits lost by cancellation, as the textbook formula loses them, or by single precision";

/// What the wrong answers of a task share. Printed, it is a sentence without a full stop.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Regularity {
    /// Whether it is said of the core cases only: robust ones are wrong in other ways, too.
    pub in_core: bool,
    /// What they share.
    pub shared: Shared,
}

/// What wrong answers share.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Shared {
    /// These fields are wrong, and all others are right.
    Fields {
        /// The fields that are wrong.
        wrong: Vec<Aspect>,
        /// Whether the others are judged wherever a right answer has them.
        all_judged: bool,
    },
    /// The function whose answers alone are wrong, or the path through it (`ns_aa=1`).
    Function(&'static str),
    /// An aspect is wrong in the same way.
    Manner {
        /// The aspect.
        aspect: Aspect,
        /// How it is wrong.
        class: Class,
        /// Whether a few wrong answers are wrong in other ways.
        has_exceptions: bool,
        /// Whether only robust cases show it.
        is_robust: bool,
    },
    /// The circumstances of all wrong calls.
    Circumstances(Vec<&'static str>),
}

impl Regularity {
    /// Whether errors have the size that single precision causes.
    pub(crate) fn is_of_few_digits(&self) -> bool {
        matches!(
            self.shared,
            Shared::Manner {
                class: Class::Rounded,
                is_robust: false,
                ..
            }
        )
    }
}

impl fmt::Display for Regularity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let scope = if self.in_core { IN_CORE } else { "" };
        write!(f, "{scope}{}", self.shared)
    }
}

impl Serialize for Regularity {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

impl fmt::Display for Shared {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Shared::Fields { wrong, all_judged } => {
                let verb = match wrong.as_slice() {
                    [aspect] if !aspect.is_plural() => "is",
                    _ => "are",
                };
                let each: Vec<&str> = wrong.iter().map(|aspect| aspect.label()).collect();
                let labels = each.join(", ");
                let others = match all_judged {
                    true => "all other fields",
                    false => "all other fields that could be judged",
                };
                write!(f, "{labels} {verb} wrong, {others} are right")
            }
            Shared::Function(name) => write!(f, "only the answers of {name} are wrong"),
            Shared::Manner {
                aspect,
                class,
                has_exceptions,
                is_robust,
            } => {
                let scope = match has_exceptions {
                    true => "with few exceptions, ",
                    false => "",
                };
                let manner = in_words(*aspect, *class, *is_robust).unwrap_or_default();
                write!(f, "{scope}{manner}")
            }
            Shared::Circumstances(places) => {
                write!(f, "wrong only where {}", places.join(" and "))
            }
        }
    }
}

/// What sentences begin with that are about core cases.
const IN_CORE: &str = "in the core cases, ";

/// What wrong answers share, the most helpful first; nothing if nothing is regular. Each is true of
/// all cases of the run, or says of which: `report::claims` tests it.
pub fn of(task: &str, all: &[CaseResult], specs: &[Spec]) -> Vec<Regularity> {
    let cases = that_count(all);
    let mut shared = Vec::new();
    shared.extend(fields(&cases, all));
    if let Some(aspect) = main_aspect(&cases) {
        let only = only_function(&cases).filter(|_| !all.iter().any(has_crashed));
        shared.extend(only.map(Shared::Function));
        shared.extend(manner(&cases, aspect));
        shared.extend(where_wrong((task, all), &cases, aspect, specs, only));
    }
    let counts = |case: &CaseResult| cases.iter().any(|other| other.name == case.name);
    let is_wrong = |case: &CaseResult| case.findings.iter().any(|finding| finding.wrong > 0);
    let in_core = all.iter().any(|case| is_wrong(case) && !counts(case));
    let each = shared.into_iter();
    each.map(|shared| Regularity { in_core, shared }).collect()
}

/// As [`of`], without what the circumstances of wrong simple calls refute.
pub fn beside(
    task: &str,
    all: &[CaseResult],
    specs: &[Spec],
    wrong_where: &[Vec<&str>],
) -> Vec<Regularity> {
    let mut regularities = of(task, all, specs);
    drop_refuted(&mut regularities, wrong_where);
    regularities
}

/// The sentences as one, without a full stop. What they all begin with stands once.
pub(crate) fn joined(regularities: &[Regularity]) -> String {
    let Some((first, others)) = regularities.split_first() else {
        return String::new();
    };
    let others = others.iter().map(|other| format!("; {}", other.shared));
    first.to_string() + &others.collect::<String>()
}

/// The core cases, or the robust ones if all core cases are right, that have answers and do not use
/// other tasks.
fn that_count(cases: &[CaseResult]) -> Vec<&CaseResult> {
    let core_crashed = cases.iter().any(has_crashed);
    let of_tier = |tier: Tier| -> Vec<&CaseResult> {
        let cases = cases
            .iter()
            .filter(|case| case.tier == tier && !case.with_neighbours);
        cases.filter(|case| !case.findings.is_empty()).collect()
    };
    let core = of_tier(Tier::Core);
    let is_right = |case: &&CaseResult| case.findings.iter().all(Finding::passed);
    match core.iter().all(is_right) && !core_crashed {
        true => of_tier(Tier::Robust),
        false => core,
    }
}

/// Whether the code crashed in a core case: nobody knows what it would have answered.
fn has_crashed(case: &CaseResult) -> bool {
    case.tier == Tier::Core && case.crash().is_some()
}

/// All findings of these cases about one aspect, with the name of the case.
fn about<'a>(
    cases: &'a [&CaseResult],
    aspect: Aspect,
) -> impl Iterator<Item = (&'a str, &'a Finding)> {
    let all = cases.iter().flat_map(|case| {
        let findings = case.findings.iter();
        findings.map(|finding| (case.name.as_str(), finding))
    });
    all.filter(move |(_, finding)| finding.aspect == aspect)
}

/// For each aspect, on how many calls it is wrong.
fn wrong_by_aspect<'a>(cases: impl IntoIterator<Item = &'a CaseResult>) -> BTreeMap<Aspect, u32> {
    let mut wrong = BTreeMap::new();
    for finding in cases.into_iter().flat_map(|case| &case.findings) {
        if finding.judged > 0 {
            *wrong.entry(finding.aspect).or_default() += finding.wrong;
        }
    }
    wrong
}

/// The aspect that explains most: hits and misses come first, because nothing else is judged where
/// they are wrong.
fn main_aspect(cases: &[&CaseResult]) -> Option<Aspect> {
    let wrong = wrong_by_aspect(cases.iter().copied());
    let most = wrong.values().copied().max()?;
    if most == 0 {
        return None;
    }
    let mut decisions = wrong.iter().filter(|(aspect, _)| aspect.is_decision());
    if let Some((decision, _)) = decisions.find(|(_, wrong)| 2 * **wrong >= most) {
        return Some(*decision);
    }
    let mut of_most = wrong.into_iter().filter(|(_, wrong)| *wrong == most);
    of_most.next().map(|(aspect, _)| aspect)
}

/// Which fields are always right, where some are. Nobody knows what is right in answers that a
/// crash took away from one of `all` cases, nor in hits that are missing nearly everywhere.
fn fields(cases: &[&CaseResult], all: &[CaseResult]) -> Option<Shared> {
    if all.iter().any(|case| case.crash().is_some()) {
        return None;
    }
    let findings = || cases.iter().flat_map(|case| &case.findings);
    let decided = findings().filter(|f| f.aspect.is_decision() && f.wrong > 0);
    let decisions: u32 = decided.map(|finding| finding.judged).sum();
    let mut fields: BTreeMap<Aspect, u32> = BTreeMap::new();
    for finding in findings().filter(|f| !f.aspect.is_decision() && f.aspect != Aspect::RayAfter) {
        *fields.entry(finding.aspect).or_default() += finding.judged;
    }
    let most = fields.into_values().max().unwrap_or_default();
    if decisions > 4 * most {
        return None;
    }
    let wrong = wrong_by_aspect(cases.iter().copied());
    let (wrong, right): (Vec<_>, Vec<_>) = wrong.into_iter().partition(|(_, wrong)| *wrong > 0);
    let tells = !wrong.is_empty() && wrong.len() <= right.len();
    let wrong: Vec<Aspect> = wrong.into_iter().map(|(aspect, _)| aspect).collect();
    let untested = |finding: &Finding| finding.expected > 0 && finding.judged == 0;
    let all_judged = !wrong.iter().any(|aspect| aspect.hides_others()) && !findings().any(untested);
    tells.then_some(Shared::Fields { wrong, all_judged })
}

/// The function whose answers alone are wrong, in tasks of several, or the path through it
/// (`ns_aa=1`).
fn only_function(cases: &[&CaseResult]) -> Option<&'static str> {
    let faults = cases.iter().flat_map(|case| &case.findings);
    let of_faults: BTreeSet<Option<&'static str>> = faults
        .flat_map(|finding| finding.faults.iter().map(|fault| fault.function))
        .collect();
    let names: Option<Vec<&'static str>> = of_faults.into_iter().collect();
    match names?.as_slice() {
        [name] => Some(name),
        _ => None,
    }
}

/// How the aspect is wrong, if it is nearly always wrong in the same way.
fn manner(cases: &[&CaseResult], aspect: Aspect) -> Option<Shared> {
    let mut classes: BTreeMap<Class, usize> = BTreeMap::new();
    let faults = about(cases, aspect).flat_map(|(_, finding)| &finding.faults);
    for Fault { class, .. } in faults {
        *classes.entry(told_class(aspect, *class)).or_default() += 1;
    }
    let all: usize = classes.values().sum();
    let (class, same) = classes.into_iter().max_by_key(|(_, count)| *count)?;
    let is_regular = all >= FEWEST && same as f64 >= MOST * all as f64;
    let is_robust = cases.iter().all(|case| case.tier == Tier::Robust);
    in_words(aspect, class, is_robust)?;
    is_regular.then_some(Shared::Manner {
        aspect,
        class,
        has_exceptions: same < all,
        is_robust,
    })
}

/// The class that is told of an error: small ones are those of rounding, and any other length of
/// the right direction is [`Class::TooShort`].
pub(crate) fn told_class(aspect: Aspect, class: Class) -> Class {
    match class {
        Class::Off(power) if power <= SINGLE_PRECISION && HAS_A_SIZE.contains(&aspect) => {
            Class::Rounded
        }
        Class::TooLong => Class::TooShort,
        class => class,
    }
}

/// The sentence about errors of a class; `None` if the class says nothing.
fn in_words(aspect: Aspect, class: Class, is_robust: bool) -> Option<String> {
    let label = aspect.label();
    Some(match class {
        Class::FalseHit | Class::FalseMiss => instead(aspect, class),
        Class::NotANumber => format!("{label}: every wrong answer is NaN"),
        Class::Infinite => format!("{label}: every wrong answer is infinite"),
        Class::Zero => format!("{label}: every wrong answer is 0"),
        Class::Negated => format!("{label}: right but for the sign"),
        Class::WrongSign => format!("{label}: every wrong answer has the wrong sign"),
        Class::Negative => format!("{label}: negative where 0 is right"),
        Class::OtherSide => format!("{label}: on the other side of the surface"),
        Class::TooShort => format!("{label}: the right direction with a wrong length"),
        Class::WrongLength => format!("{label}: not of unit length"),
        Class::Swapped => format!("{label}: the right numbers in the wrong order"),
        Class::Ratio(0) => format!("{label}: nearly right, less than a factor of 1.5 off"),
        Class::SlightlyLess => format!("{label}: too small, by less than a factor of 1.5"),
        Class::SlightlyMore => format!("{label}: too large, by less than a factor of 1.5"),
        Class::Ratio(power) => format!(
            "{label}: {} times the right number, up to a factor of 1.5",
            2.0_f64.powi(power.into())
        ),
        Class::Rounded => {
            let cause = match is_robust {
                true => CANCELLATION,
                false => FEW_DIGITS,
            };
            format!("{label}: off by less than 1 part in 100,000: {cause}")
        }
        _ => return None,
    })
}

/// The sentence about answers that have something where nothing is right ([`Class::FalseHit`]), or
/// the reverse.
fn instead(aspect: Aspect, class: Class) -> String {
    let [too_much, too_little] = match aspect {
        Aspect::SampleOrNone => [
            "where it is wrong whether there is a sample, there is one instead of None",
            "where it is wrong whether there is a sample, there is None instead of one",
        ],
        Aspect::HitOrMiss => [
            "where hit or miss is wrong, there is a hit instead of a miss",
            "where hit or miss is wrong, there is a miss instead of a hit",
        ],
        Aspect::Survival => [
            "where it is wrong whether a path continues, it continues instead of ending",
            "where it is wrong whether a path continues, it ends instead of continuing",
        ],
        Aspect::Stop => [
            "when to stop: every wrong result is true instead of false",
            "when to stop: every wrong result is false instead of true",
        ],
        aspect if COLOURS.contains(&aspect) => [
            "not black where black is right",
            "black where black is wrong",
        ],
        _ => ["not 0 where 0 is right", "0 where 0 is wrong"],
    };
    let sentence = if class == Class::FalseHit {
        too_much
    } else {
        too_little
    };
    match aspect {
        Aspect::HitOrMiss | Aspect::SampleOrNone | Aspect::Survival | Aspect::Stop => {
            sentence.into()
        }
        _ => format!("{}: {sentence}", aspect.label()),
    }
}

/// The aspects that are colours. Others are numbers.
const COLOURS: [Aspect; 3] = [Aspect::Radiance, Aspect::Bsdf, Aspect::Throughput];

/// The aspects whose class [`Class::Off`] gives the size of the error, in units of the answer.
const HAS_A_SIZE: [Aspect; 6] = [
    Aspect::Direction,
    Aspect::Barycentrics,
    Aspect::Position,
    Aspect::Normal,
    Aspect::GeometricNormal,
    Aspect::SampledDirection,
];

/// Errors of at most 2 to this power come from rounding or from typed constants.
const SINGLE_PRECISION: i8 = -17;

/// Under which circumstances answers are wrong, if all wrong ones share one that most others, in
/// which the aspect is right, do not have.
fn where_wrong(
    (task, all): (&str, &[CaseResult]),
    cases: &[&CaseResult],
    aspect: Aspect,
    specs: &[Spec],
    only: Option<&str>,
) -> Option<Shared> {
    // What `only_function` says already.
    let said = only.map(|path| path.replace('=', " is ").replace('>', " is above "));
    let mut wrong = 0;
    let mut others = 0;
    let mut counts: BTreeMap<&'static str, [usize; 2]> = BTreeMap::new();
    for case in cases {
        let spec = specs.iter().find(|spec| spec.is(task, &case.name))?;
        let of_calls = case
            .findings
            .iter()
            .filter(|finding| !finding.aspect.is_of_all_calls());
        let faults = of_calls.clone().flat_map(|finding| &finding.faults);
        let wrong_calls: BTreeSet<u32> = faults.map(|fault| fault.call).collect();
        let judged = of_calls
            .filter(|finding| finding.aspect == aspect)
            .flat_map(|finding| finding.judged_calls.iter().copied());
        for call in judged
            .chain(wrong_calls.iter().copied())
            .collect::<BTreeSet<u32>>()
        {
            let is_wrong = wrong_calls.contains(&call);
            wrong += usize::from(is_wrong);
            others += usize::from(!is_wrong);
            for circumstance in spec.circumstances(call as usize).unwrap_or_default() {
                counts.entry(circumstance).or_default()[usize::from(!is_wrong)] += 1;
            }
        }
    }
    if wrong < FEWEST || others < FEWEST {
        return None;
    }
    let mut telling: Vec<(usize, &'static str)> = counts
        .into_iter()
        .filter(|(_, [of_wrong, of_others])| {
            *of_wrong == wrong && *of_others as f64 <= TELLING * others as f64
        })
        .filter(|(circumstance, _)| said.as_deref() != Some(circumstance))
        .filter(|(circumstance, _)| {
            let tier = cases.first().map(|case| case.tier);
            let mut failed = all.iter().filter(|case| Some(case.tier) == tier);
            !failed.any(|case| fails_elsewhere((task, case), specs, circumstance))
        })
        .map(|(circumstance, [_, of_others])| (of_others, circumstance))
        .collect();
    telling.sort_unstable();
    let telling: Vec<&str> = telling
        .into_iter()
        .take(CIRCUMSTANCES)
        .map(|(_, circumstance)| circumstance)
        .collect();
    (!telling.is_empty()).then_some(Shared::Circumstances(telling))
}

/// Whether a case fails as a whole, in an aspect of all its answers or by a crash, although not all
/// of its calls have the circumstance: nobody knows which of them it fails for.
pub(crate) fn fails_elsewhere(
    (task, case): (&str, &CaseResult),
    specs: &[Spec],
    circumstance: &str,
) -> bool {
    let is_of_all = |finding: &Finding| finding.aspect.is_of_all_calls() && finding.wrong > 0;
    let fails = case.crash().is_some() || case.findings.iter().any(is_of_all);
    let spec = specs.iter().find(|spec| spec.is(task, &case.name));
    let has = |spec: &Spec, call| {
        let here = spec.circumstances(call).unwrap_or_default();
        here.contains(&circumstance)
    };
    fails
        && !case.with_neighbours
        && spec.is_some_and(|spec| !(0..spec.calls()).all(|call| has(spec, call)))
}

/// Drops the circumstances that a wrong call does not have, each given by its own, and what is left
/// without any: what all wrong answers of the cases share may be chance, or follow from the
/// scenes.
pub(crate) fn drop_refuted(regularities: &mut Vec<Regularity>, wrong_where: &[Vec<&str>]) {
    regularities.retain_mut(|regularity| match &mut regularity.shared {
        Shared::Circumstances(places) => {
            places.retain(|place| wrong_where.iter().all(|here| here.contains(place)));
            !places.is_empty()
        }
        _ => true,
    });
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::score::Status;
    use judge::findings::Findings;

    const TASK: &str = "part1.task4";

    /// The sentences about all core cases of spheres, whose answers are wrong in these ways.
    fn sentences(wrong: impl Fn(&[&str]) -> Vec<(Aspect, Class)>) -> Vec<String> {
        let mut specs = judge::cases::of(TASK, 0);
        specs.retain(|spec| matches!(spec.work, wire::Work::Spheres(_)));
        let cases: Vec<CaseResult> = specs.iter().map(|spec| case(spec, &wrong)).collect();
        in_words(of(TASK, &cases, &specs))
    }

    fn in_words(regularities: Vec<Regularity>) -> Vec<String> {
        regularities.iter().map(Regularity::to_string).collect()
    }

    fn case(spec: &Spec, wrong: impl Fn(&[&str]) -> Vec<(Aspect, Class)>) -> CaseResult {
        let mut findings = Findings::default();
        let calls = (0..).map(|call| spec.circumstances(call));
        for (call, here) in calls.map_while(|here| here).enumerate() {
            let wrong = wrong(&here);
            for aspect in [Aspect::HitOrMiss, Aspect::T, Aspect::Normal] {
                let class = wrong.iter().find(|(other, _)| *other == aspect);
                findings.judge_class(
                    aspect,
                    call,
                    class.map(|(_, class)| *class),
                    1.0,
                    String::new,
                );
            }
        }
        CaseResult::failed(spec.name, findings.into_vec())
    }

    #[test]
    fn a_wrong_call_refutes_where_answers_are_wrong() {
        let (low, high) = ("min_t is above 0", "max_t is finite");
        let left = |wrong_where: &[Vec<&str>]| {
            let mut all = vec![Regularity {
                in_core: true,
                shared: Shared::Circumstances(vec![low, high]),
            }];
            drop_refuted(&mut all, wrong_where);
            in_words(all)
        };
        let both = "in the core cases, wrong only where min_t is above 0 and max_t is finite";
        assert_eq!(left(&[]), [both]);
        assert_eq!(left(&[vec![high, low], vec![low, high]]), [both]);
        // Each circumstance is refuted by itself, by any of the wrong calls.
        let one = "in the core cases, wrong only where max_t is finite";
        assert_eq!(left(&[vec![low, high], vec![high]]), [one]);
        // A call in which nothing of what is known holds, such as that of a camera that is not
        // turned.
        assert_eq!(left(&[vec![]]), [""; 0]);
    }

    #[test]
    fn what_all_wrong_answers_share_is_said() {
        let inside = "the ray starts inside the sphere";
        let missed = sentences(|here| match here.contains(&inside) {
            true => vec![(Aspect::HitOrMiss, Class::FalseMiss)],
            false => vec![],
        });
        assert_eq!(
            missed,
            [
                "hit or miss is wrong, all other fields that could be judged are right",
                "where hit or miss is wrong, there is a miss instead of a hit",
                "wrong only where the ray starts inside the sphere",
            ]
        );
    }

    /// A case that fails as a whole refutes a circumstance that none of its calls has.
    #[test]
    fn a_case_that_fails_as_a_whole_is_among_the_wrong_answers() {
        let inside = "the ray starts inside the sphere";
        let mut specs = judge::cases::of(TASK, 0);
        specs.retain(|spec| matches!(spec.work, wire::Work::Spheres(_)));
        let wrong_inside = |here: &[&str]| match here.contains(&inside) {
            true => vec![(Aspect::HitOrMiss, Class::FalseMiss)],
            false => vec![],
        };
        let said = |also: &dyn Fn(&mut CaseResult)| {
            let mut cases: Vec<CaseResult> =
                specs.iter().map(|spec| case(spec, wrong_inside)).collect();
            for case in cases.iter_mut().filter(|case| case.name == "head_on") {
                also(case);
            }
            let sentences = in_words(of(TASK, &cases, &specs));
            sentences
                .iter()
                .any(|says| says.contains("wrong only where"))
        };
        let tests = |right: bool| {
            move |case: &mut CaseResult| {
                let mut findings = Findings::default();
                findings.judge(Aspect::Work, 0, right, 1.0, String::new);
                case.findings.extend(findings.into_vec());
            }
        };
        let crash = |case: &mut CaseResult| {
            case.status = Status::Crashed("panicked".into());
            case.findings.clear();
        };
        assert!(said(&tests(true)));
        assert!(!said(&tests(false)) && !said(&crash));
    }

    /// Of a broken tree, or of rays that are not traced, nothing else is known.
    #[test]
    fn only_what_was_judged_is_called_right() {
        let says = |wrong: Aspect, untested: Option<Aspect>| {
            let mut findings = Findings::default();
            for aspect in [wrong, Aspect::Radiance, Aspect::LeafSize] {
                let class = (aspect == wrong).then_some(Class::Wrong);
                findings.judge_class(aspect, 0, class, 1.0, String::new);
            }
            untested
                .into_iter()
                .for_each(|aspect| findings.expect(aspect));
            let case = CaseResult::failed("any", findings.into_vec());
            let says = fields(&[&case], std::slice::from_ref(&case)).expect("a sentence");
            says.to_string()
        };
        assert!(says(Aspect::Bounds, None).ends_with("all other fields are right"));
        let judged = "all other fields that could be judged are right";
        for wrong in [Aspect::Structure, Aspect::Rays, Aspect::Calls] {
            assert!(says(wrong, None).ends_with(judged), "{wrong:?}");
        }
        assert!(says(Aspect::Bounds, Some(Aspect::Work)).ends_with(judged));
    }

    #[test]
    fn only_lengths_of_right_directions_are_told_as_such() {
        let said = |class| in_words_of(Aspect::SampledDirection, class);
        let words = "sampled direction: not of unit length";
        assert_eq!(said(Class::WrongLength).as_deref(), Some(words));
        let words = "sampled direction: the right direction with a wrong length";
        for class in [Class::TooShort, Class::TooLong] {
            assert_eq!(said(class).as_deref(), Some(words));
        }
    }

    fn in_words_of(aspect: Aspect, class: Class) -> Option<String> {
        super::in_words(aspect, told_class(aspect, class), false)
    }

    #[test]
    fn one_field_whose_name_is_a_plural_has_the_verb_of_a_plural() {
        let mut findings = Findings::default();
        for (aspect, class) in [
            (Aspect::Bounds, Some(Class::Wrong)),
            (Aspect::LeafSize, None),
        ] {
            findings.judge_class(aspect, 0, class, 1.0, String::new);
        }
        let case = CaseResult::failed("boxes", findings.into_vec());
        let says = fields(&[&case], std::slice::from_ref(&case)).map(|says| says.to_string());
        let expected = "bounding boxes are wrong, all other fields are right";
        assert_eq!(says.as_deref(), Some(expected));
    }

    #[test]
    fn fields_of_hits_that_are_missing_are_not_called_right() {
        let said = |hits: usize| {
            let mut findings = Findings::default();
            for call in 0..10 {
                let missed = (call >= hits).then_some(Class::FalseMiss);
                findings.judge_class(Aspect::HitOrMiss, call, missed, 1.0, String::new);
                findings.judge_class(Aspect::RayAfter, call, None, 1.0, String::new);
                if call < hits {
                    findings.judge_class(Aspect::T, call, None, 1.0, String::new);
                }
            }
            let case = CaseResult::failed("hits", findings.into_vec());
            fields(&[&case], std::slice::from_ref(&case)).is_some()
        };
        assert_eq!([0, 1, 5].map(said), [false, false, true]);
    }

    #[test]
    fn tasks_without_hits_are_told_in_their_own_words() {
        let says = |aspect| instead(aspect, Class::FalseHit);
        assert!(says(Aspect::HitOrMiss).contains("a hit instead of a miss"));
        for aspect in [
            Aspect::SampleOrNone,
            Aspect::Radiance,
            Aspect::Pdf,
            Aspect::Survival,
            Aspect::Stop,
        ] {
            let says = says(aspect);
            assert!(!says.contains("hit") && !says.contains("miss"), "{says}");
        }
        // Other fields may be wrong in other ways.
        assert!(says(Aspect::Stop).starts_with("when to stop: "));
    }

    /// Nobody knows what would be right in the answers that a panic took away.
    #[test]
    fn after_a_crash_no_field_is_called_right() {
        let wrong = |name: &str, tier| {
            let mut findings = Findings::default();
            for call in 0..9 {
                findings.judge_class(Aspect::T, call, Some(Class::Rounded), 1.0, String::new);
                findings.judge_class(Aspect::HitOrMiss, call, None, 0.0, String::new);
                findings.judge_class(Aspect::Normal, call, None, 0.0, String::new);
            }
            CaseResult {
                tier,
                ..CaseResult::failed(name, findings.into_vec())
            }
        };
        let crashed = CaseResult {
            status: Status::Crashed("panicked".into()),
            ..CaseResult::failed("head_on", Vec::new())
        };
        let core = [wrong("abreast", Tier::Core)];
        assert!(in_words(of(TASK, &core, &[]))[0].contains("all other fields are right"));
        let both = [wrong("abreast", Tier::Core), crashed.clone()];
        assert!(!in_words(of(TASK, &both, &[]))[0].contains("all other fields are right"));
        // What only robust cases show says nothing of f32, and nothing at all if core ones died.
        let robust = [wrong("far_away", Tier::Robust)];
        let says = joined(&of(TASK, &robust, &[]));
        assert!(
            says.contains("cancellation") && !says.contains("f32"),
            "{says}"
        );
        assert!(of(TASK, &[wrong("far_away", Tier::Robust), crashed], &[]).is_empty());
    }

    #[test]
    fn a_path_that_only_one_circumstance_takes_is_said_once() {
        const TASK: &str = "part1.task1";
        let specs = judge::cases::of(TASK, 0);
        let pixels = specs.iter().filter_map(|spec| match &spec.work {
            wire::Work::Pixels(work) => Some((spec, work.ns_aa, work.pixels.len())),
            _ => None,
        });
        let cases = pixels.map(|(spec, ns_aa, calls)| {
            let mut findings = Findings::default();
            findings.answers_of(if ns_aa == 1 { "ns_aa=1" } else { "ns_aa>1" });
            for call in 0..calls {
                let class = (ns_aa == 1).then_some(Class::Named("off"));
                findings.judge_class(Aspect::Placement, call, class, 1.0, String::new);
            }
            CaseResult::failed(spec.name, findings.into_vec())
        });
        let cases: Vec<CaseResult> = cases.collect();
        let sentences = in_words(of(TASK, &cases, &specs));
        assert_eq!(sentences, ["only the answers of ns_aa=1 are wrong"]);
    }

    #[test]
    fn errors_of_rounding_are_told_whatever_their_size() {
        let sizes = std::cell::Cell::new(-30);
        let rounded = sentences(|_| {
            sizes.set(-20 - (sizes.get() + 21) % 9);
            vec![(Aspect::Normal, Class::Off(sizes.get()))]
        });
        assert!(rounded[1].contains("the precision of f32"), "{rounded:?}");
        let t = sentences(|_| vec![(Aspect::T, Class::of_number(1.0 + 3e-7, 1.0))]);
        assert!(t[1].contains("the precision of f32"), "{t:?}");
        let far = sentences(|_| vec![(Aspect::T, Class::of_number(1.0 + 3e-3, 1.0))]);
        assert!(!far[1].contains("f32"), "{far:?}");
    }

    #[test]
    fn a_factor_is_said_and_nothing_where_nothing_is_shared() {
        let doubled = sentences(|_| vec![(Aspect::T, Class::Ratio(1))]);
        assert_eq!(
            doubled[1],
            "t: 2 times the right number, up to a factor of 1.5"
        );
        let calls = std::cell::Cell::new(0);
        let nearly_always = sentences(|_| {
            calls.set(calls.get() + 1);
            let exception = calls.get() == 9;
            let class = if exception {
                Class::Zero
            } else {
                Class::Ratio(1)
            };
            vec![(Aspect::T, class)]
        });
        let said = "with few exceptions, t: 2 times the right number, up to a factor of 1.5";
        assert_eq!(nearly_always[1], said);
        let mixed = sentences(|_| {
            calls.set(calls.get() + 1);
            match calls.get() % 3 {
                0 => vec![(Aspect::T, Class::Zero), (Aspect::Normal, Class::Negated)],
                1 => vec![(Aspect::HitOrMiss, Class::FalseHit)],
                _ => vec![(Aspect::HitOrMiss, Class::FalseMiss)],
            }
        });
        assert_eq!(mixed, [""; 0]);
    }
}
