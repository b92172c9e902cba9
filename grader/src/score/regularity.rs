//! What the wrong answers of a task have in common, where they match no known mistake: which fields
//! are wrong and which right, how they are wrong, and under which circumstances.

use crate::score::CaseResult;
use judge::Tier;
use judge::cases::Spec;
use judge::findings::{Aspect, Class, Fault, Finding};
use std::collections::{BTreeMap, BTreeSet};

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

/// What sentences begin with that are about core cases, where robust ones are wrong in other ways,
/// too.
pub(crate) const IN_CORE: &str = "in the core cases, ";

/// How the sentence ends that lists the wrong fields.
pub(crate) const OTHERS_RIGHT: &str = ", all other fields are right";

/// What a sentence begins with that a few wrong answers contradict.
pub(crate) const FEW_EXCEPTIONS: &str = "with few exceptions, ";

/// Sentences without a full stop, the most helpful first; none if nothing is regular. Each is true
/// of all cases of the run, or says of which: `report::claims` tests it.
pub fn of(task: &str, all: &[CaseResult], specs: &[Spec]) -> Vec<String> {
    let cases = that_count(all);
    let mut sentences = Vec::new();
    sentences.extend(fields(&cases, all));
    if let Some(aspect) = main_aspect(&cases) {
        let only = only_function(&cases);
        sentences.extend(only.map(|name| format!("only the answers of {name} are wrong")));
        sentences.extend(manner(&cases, aspect));
        sentences.extend(where_wrong(task, &cases, aspect, specs, only));
    }
    let counts = |case: &CaseResult| cases.iter().any(|other| other.name == case.name);
    let is_wrong = |case: &CaseResult| case.findings.iter().any(|finding| finding.wrong > 0);
    if all.iter().any(|case| is_wrong(case) && !counts(case)) {
        for sentence in &mut sentences {
            sentence.insert_str(0, IN_CORE);
        }
    }
    sentences
}

/// The sentences as one, without a full stop. What they all begin with stands once.
pub(crate) fn joined(sentences: &[String]) -> String {
    let mut joined = sentences.first().cloned().unwrap_or_default();
    for sentence in sentences.iter().skip(1) {
        let rest = sentence.strip_prefix(IN_CORE).unwrap_or(sentence);
        joined.push_str("; ");
        joined.push_str(rest);
    }
    joined
}

/// The core cases, or the robust ones if all core cases are right, that have answers and do not use
/// other tasks.
fn that_count(cases: &[CaseResult]) -> Vec<&CaseResult> {
    let crashed = |case: &CaseResult| case.tier == Tier::Core && case.crash.is_some();
    let core_crashed = cases.iter().any(crashed);
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
/// crash took away from one of `all` cases.
fn fields(cases: &[&CaseResult], all: &[CaseResult]) -> Option<String> {
    if all.iter().any(|case| case.crash.is_some()) {
        return None;
    }
    let wrong = wrong_by_aspect(cases.iter().copied());
    let (wrong, right): (Vec<_>, Vec<_>) = wrong.into_iter().partition(|(_, wrong)| *wrong > 0);
    let tells = !wrong.is_empty() && wrong.len() <= right.len();
    let verb = match wrong.as_slice() {
        [(aspect, _)] if !aspect.is_plural() => "is",
        _ => "are",
    };
    let labels: Vec<&str> = wrong.iter().map(|(aspect, _)| aspect.label()).collect();
    tells.then(|| format!("{} {verb} wrong{OTHERS_RIGHT}", labels.join(", ")))
}

/// The function whose answers alone are wrong, in tasks of several, or the path through it
/// (`ns_aa=1`).
fn only_function<'a>(cases: &[&'a CaseResult]) -> Option<&'a str> {
    let faults = cases.iter().flat_map(|case| &case.findings);
    let of_faults: BTreeSet<Option<&str>> = faults
        .flat_map(|finding| finding.faults.iter().map(|fault| fault.function))
        .collect();
    let names: Option<Vec<&str>> = of_faults.into_iter().collect();
    match names?.as_slice() {
        [name] => Some(name),
        _ => None,
    }
}

/// How the aspect is wrong, if it is nearly always wrong in the same way.
fn manner(cases: &[&CaseResult], aspect: Aspect) -> Option<String> {
    let mut classes: BTreeMap<Class, usize> = BTreeMap::new();
    let faults = about(cases, aspect).flat_map(|(_, finding)| &finding.faults);
    for Fault { class, .. } in faults {
        let class = match *class {
            Class::Off(power) if power <= SINGLE_PRECISION && HAS_A_SIZE.contains(&aspect) => {
                Class::Rounded
            }
            class => class,
        };
        *classes.entry(class).or_default() += 1;
    }
    let all: usize = classes.values().sum();
    let (class, same) = classes.into_iter().max_by_key(|(_, count)| *count)?;
    let regular = all >= FEWEST && same as f64 >= MOST * all as f64;
    let scope = if same < all { FEW_EXCEPTIONS } else { "" };
    let label = aspect.label();
    let manner = match class {
        _ if !regular => return None,
        Class::FalseHit | Class::FalseMiss => instead(aspect, class),
        Class::NotANumber => format!("{label}: every wrong answer is NaN"),
        Class::Infinite => format!("{label}: every wrong answer is infinite"),
        Class::Zero => format!("{label}: every wrong answer is 0"),
        Class::Negated => format!("{label}: right but for the sign"),
        Class::WrongSign => format!("{label}: every wrong answer has the wrong sign"),
        Class::Negative => format!("{label}: negative where 0 is right"),
        Class::OtherSide => format!("{label}: on the other side of the surface"),
        Class::WrongLength => format!("{label}: the right direction with a wrong length"),
        Class::Swapped => format!("{label}: the right numbers in the wrong order"),
        Class::Ratio(0) => format!("{label}: nearly right, less than a factor of 1.5 off"),
        Class::SlightlyLess => format!("{label}: too small, by less than a factor of 1.5"),
        Class::SlightlyMore => format!("{label}: too large, by less than a factor of 1.5"),
        Class::Ratio(power) => format!(
            "{label}: about {} times the right number",
            2.0_f64.powi(power.into())
        ),
        Class::Rounded => {
            let is_robust = |case: &&CaseResult| case.tier == Tier::Robust;
            let cause = match cases.iter().all(is_robust) {
                true => CANCELLATION,
                false => FEW_DIGITS,
            };
            format!("{label}: off by less than 1 part in 100,000: {cause}")
        }
        _ => return None,
    };
    Some(format!("{scope}{manner}"))
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
            "every wrong result is true instead of false",
            "every wrong result is false instead of true",
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
    task: &str,
    cases: &[&CaseResult],
    aspect: Aspect,
    specs: &[Spec],
    only: Option<&str>,
) -> Option<String> {
    // What `only_function` says already.
    let said = only.map(|path| path.replace('=', " is ").replace('>', " is above "));
    let mut wrong = 0;
    let mut others = 0;
    let mut counts: BTreeMap<&str, [usize; 2]> = BTreeMap::new();
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
            for circumstance in spec.circumstances(call as usize) {
                counts.entry(circumstance).or_default()[usize::from(!is_wrong)] += 1;
            }
        }
    }
    if wrong < FEWEST || others < FEWEST {
        return None;
    }
    let mut telling: Vec<(usize, &str)> = counts
        .into_iter()
        .filter(|(_, [of_wrong, of_others])| {
            *of_wrong == wrong && *of_others as f64 <= TELLING * others as f64
        })
        .filter(|(circumstance, _)| said.as_deref() != Some(circumstance))
        .map(|(circumstance, [_, of_others])| (of_others, circumstance))
        .collect();
    telling.sort_unstable();
    let telling: Vec<&str> = telling
        .iter()
        .take(CIRCUMSTANCES)
        .map(|(_, circumstance)| *circumstance)
        .collect();
    (!telling.is_empty()).then(|| format!("{ONLY_WHERE}{}", telling.join(" and ")))
}

/// How the sentence begins that lists what wrong answers have in common.
const ONLY_WHERE: &str = "wrong only where ";

/// Whether a sentence says that answers are wrong only where something holds that does not hold in
/// a wrong call with these `circumstances`; without any, nothing is known of the call.
pub(crate) fn is_refuted(sentence: &str, circumstances: &[&str]) -> bool {
    let sentence = sentence.strip_prefix(IN_CORE).unwrap_or(sentence);
    let Some(places) = sentence.strip_prefix(ONLY_WHERE) else {
        return false;
    };
    let others = circumstances
        .iter()
        .fold(places.to_owned(), |rest, holds| rest.replace(holds, ""));
    !circumstances.is_empty() && !matches!(others.as_str(), "" | " and ")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::workers::crash::{Crash, CrashKind};
    use judge::findings::Findings;

    const TASK: &str = "part1.task4";

    /// The sentences about all core cases of spheres, whose answers are wrong in these ways.
    fn sentences(wrong: impl Fn(&[&str]) -> Vec<(Aspect, Class)>) -> Vec<String> {
        let mut specs = judge::cases::of(TASK, 0);
        specs.retain(|spec| matches!(spec.work, wire::Work::Spheres(_)));
        let cases: Vec<CaseResult> = specs.iter().map(|spec| case(spec, &wrong)).collect();
        of(TASK, &cases, &specs)
    }

    fn case(spec: &Spec, wrong: impl Fn(&[&str]) -> Vec<(Aspect, Class)>) -> CaseResult {
        let mut findings = Findings::default();
        let calls = (0..).map(|call| spec.circumstances(call));
        for (call, here) in calls.take_while(|here| !here.is_empty()).enumerate() {
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
        let [positive, negative] = ["min_t is above 0", "min_t is below 0"];
        let says = format!("{IN_CORE}{ONLY_WHERE}{positive} and max_t is finite");
        assert!(is_refuted(&says, &[negative, "max_t is finite"]));
        assert!(!is_refuted(&says, &["max_t is finite", positive]));
        assert!(!is_refuted(&says, &[]));
        assert!(!is_refuted("where t is wrong, it is 0", &[negative]));
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
                "hit or miss is wrong, all other fields are right",
                "where hit or miss is wrong, there is a miss instead of a hit",
                "wrong only where the ray starts inside the sphere",
            ]
        );
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
        let says = fields(&[&case], std::slice::from_ref(&case));
        let expected = "bounding boxes are wrong, all other fields are right";
        assert_eq!(says.as_deref(), Some(expected));
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
            crash: Some(Crash {
                kind: CrashKind::Panic,
                call: Some(0),
            }),
            ..CaseResult::failed("head_on", Vec::new())
        };
        let core = [wrong("abreast", Tier::Core)];
        assert!(of(TASK, &core, &[])[0].contains("all other fields are right"));
        let both = [wrong("abreast", Tier::Core), crashed.clone()];
        assert!(!of(TASK, &both, &[])[0].contains("all other fields are right"));
        // What only robust cases show says nothing of f32, and nothing at all if core ones died.
        let robust = [wrong("far_away", Tier::Robust)];
        let says = of(TASK, &robust, &[]).join("; ");
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
        let sentences = of(TASK, &cases, &specs);
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
        assert_eq!(doubled[1], "t: about 2 times the right number");
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
        let said = "with few exceptions, t: about 2 times the right number";
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
