//! Signatures: which answers of a piece of code are wrong, and how, call by call. They can be
//! stored and compared.
//!
//! A `SignatureKey` names a side of a case, the `Codes` describe what is wrong there. `stored` is
//! the form in which the known mistakes of a task are stored. `together` compares a signature with
//! those of two mistakes; `evidence` says how answers with the same codes are alike.

mod codes;
mod evidence;
mod key;
pub(crate) mod stored;
mod together;

use codes::{Codes, TELLING_KINDS, codes_of};
pub use evidence::Evidence;
pub use key::Side;
use key::SignatureKey;
use together::Hiding;
pub use together::{Alone, Together};

use crate::score::CaseResult;
use judge::Tier;
use judge::findings::{Aspect, Class, DirectionCounts};
use std::collections::{BTreeMap, BTreeSet};

/// For each side of each case a code for each call: 0 where the answer is right, else a digest of
/// how it is wrong. The same mistake gives the same codes, whatever formula contains it. Mistakes
/// in different aspects do not hide each other. Faults with their own name are stored separately
/// from the other faults of the aspect, so they do not hide each other either.
///
/// Core and robust cases are separate: different formulas differ in robust cases, so these count
/// only where all core cases are right.
#[derive(Clone, Debug, Default, Eq)]
pub struct Signature {
    core: Cases,
    robust: Cases,
    /// The distributions of directions that are wrong. Their codes are the same only if the counts
    /// are; see [`Signature::as_seen_by`].
    distributions: Distributions,
    /// Whether answers with these codes may differ. Of known mistakes it is not stored.
    is_rough: bool,
}

impl PartialEq for Signature {
    fn eq(&self, other: &Signature) -> bool {
        self.core == other.core
            && self.robust == other.robust
            && self.distributions == other.distributions
    }
}

/// The wrong distributions of a side, in the order in which they were judged.
type Distributions = BTreeMap<SignatureKey, Vec<DirectionCounts>>;

type Cases = BTreeMap<SignatureKey, Codes>;

/// A wrong answer of a signature.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct WrongCall {
    /// The case.
    pub case: String,
    /// The number of the call.
    pub call: u32,
    /// What is wrong.
    pub aspect: Aspect,
    /// How, if the code has only this class and this class tells it.
    pub class: Option<Class>,
}

/// The codes of a side of a case, call by call; none where every call is right.
fn codes_at<'a>(cases: &'a Cases, key: &SignatureKey) -> &'a [u16] {
    cases.get(key).map_or(&[], |codes| &codes.0)
}

/// How two signatures agree.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Agreement {
    /// Calls on which both are wrong in the same way.
    pub equal: usize,
    /// Calls on which both are wrong, in the same way or in different ways.
    pub both: usize,
    /// Calls on which the first is wrong.
    pub first: usize,
    /// Calls on which the second is wrong.
    pub second: usize,
}

/// A side of the answers is evidence against a mistake only if it holds at least this share of what
/// the mistake gets wrong.
const TELLING: f64 = 0.1;

/// A side of the answers is evidence against a mistake only if less than this share of the mistake
/// shows in it.
const SHOWN: f64 = 0.25;

/// A field or a case that is right rules a mistake out if the mistake makes at least so many of its
/// values wrong.
pub(crate) const REFUTING: usize = 5;

/// A case disagrees throughout only if at least so many of its values are wrong.
const DISAGREEING: usize = 5;

impl Signature {
    /// The signature of a task's results. Cases that also use other tasks do not count: the fault
    /// may be there.
    pub fn of(cases: &[CaseResult]) -> Signature {
        let of_tier = |tier: Tier| {
            let cases = cases
                .iter()
                .filter(|case| case.tier == tier && !case.with_neighbours);
            cases.flat_map(codes_of).collect()
        };
        let core: Cases = of_tier(Tier::Core);
        let counted = cases.iter().filter(|case| !case.with_neighbours);
        let mut that_count = counted
            .clone()
            .filter(|case| core.is_empty() || case.tier == Tier::Core);
        Signature {
            is_rough: that_count.any(codes::is_rough),
            robust: of_tier(Tier::Robust),
            distributions: counted.flat_map(codes::distributions_of).collect(),
            core,
        }
    }

    /// The signature of a mistake, to be compared with `student`: where a χ² test cannot tell a
    /// distribution of its directions from the student's, it has the student's code. Other random
    /// numbers change the counts, and with them the code.
    pub fn as_seen_by(&self, student: &Signature) -> Signature {
        let mut seen = self.clone();
        for (key, own) in &self.distributions {
            let theirs = student.distributions.get(key);
            let is_like = theirs.is_some_and(|theirs| {
                let mut pairs = own.iter().zip(theirs);
                own.len() == theirs.len() && pairs.all(|(own, theirs)| own.is_like(theirs))
            });
            let tiers = [
                (&mut seen.core, &student.core),
                (&mut seen.robust, &student.robust),
            ];
            for (cases, students) in tiers {
                if let (true, Some(codes), Some(theirs)) =
                    (is_like, cases.get_mut(key), students.get(key))
                {
                    codes.0[0] = theirs.0[0];
                }
            }
        }
        seen
    }

    /// Whether nothing was wrong.
    pub fn is_empty(&self) -> bool {
        self.core.is_empty() && self.robust.is_empty()
    }

    /// Whether a core case is wrong.
    pub fn has_core_faults(&self) -> bool {
        !self.core.is_empty()
    }

    /// The cases that count.
    fn cases(&self) -> &Cases {
        if self.core.is_empty() {
            &self.robust
        } else {
            &self.core
        }
    }

    /// Whether the two have the same faults in the cases that count.
    pub fn shows_the_same(&self, other: &Signature) -> bool {
        self.cases() == other.cases()
    }

    /// The number of wrong codes.
    pub fn wrong(&self) -> usize {
        self.cases().values().map(Codes::wrong).sum()
    }

    /// Calls that are wrong, with the aspect, and how, if that is known. `calls_of` says how many
    /// calls a case has. Left out are crashes, and calls of which only the neighbourhood is known:
    /// the first wrong one of a side in a large case.
    pub fn wrong_calls(&self, calls_of: &dyn Fn(&str) -> Option<usize>) -> Vec<WrongCall> {
        let mut wrong = Vec::new();
        for (key, codes) in self.cases() {
            let (Side::Aspect { aspect, .. }, Some(calls)) = (&key.side, calls_of(&key.case))
            else {
                continue;
            };
            let stride = codes::stride_of(calls);
            let places = (0_u32..)
                .zip(&codes.0)
                .filter(|(_, code)| **code != 0)
                .map(|(place, code)| (place * stride, code));
            let places = places
                .skip(usize::from(stride > 1))
                .filter(|(call, _)| (*call as usize) < calls);
            wrong.extend(places.map(|(call, code)| WrongCall {
                case: key.case.clone(),
                call,
                aspect: *aspect,
                class: TELLING_KINDS.get(code).copied(),
            }));
        }
        wrong
    }

    /// The signature without these cases.
    pub fn without(&self, cases: &BTreeSet<&str>) -> Signature {
        self.keys(|key| !cases.contains(key.case.as_str()))
    }

    /// The signature with, of each of these cases, these aspects alone.
    pub fn in_aspects(&self, cases: &BTreeMap<&str, BTreeSet<Aspect>>) -> Signature {
        self.keys(
            |key| match (cases.get(key.case.as_str()), key.side.place()) {
                (Some(aspects), Some((aspect, _))) => aspects.contains(&aspect),
                _ => true,
            },
        )
    }

    /// The part of the signature that does not follow from wrong fields of these functions: other
    /// functions, and hits and misses, without which no field is judged.
    pub fn elsewhere(&self, functions: &BTreeSet<&str>) -> Signature {
        self.keys(|key| {
            let function = key.side.function();
            let is_other = function.is_some_and(|function| !functions.contains(function));
            key.side.is_decision() || is_other
        })
    }

    /// The fields, and the functions that gave them, in which both are wrong in the same way on a
    /// call.
    pub fn places_alike(&self, other: &Signature) -> BTreeSet<(Aspect, Option<String>)> {
        let places = self.keys_alike(other).filter_map(|key| key.side.place());
        places
            .map(|(aspect, function)| (aspect, function.map(str::to_owned)))
            .collect()
    }

    /// Whether both only crash in the same cases, which code does for many reasons.
    pub fn is_alike_in_crashes_only(&self, other: &Signature) -> bool {
        let mut keys = self.keys_alike(other).peekable();
        keys.peek().is_some() && keys.all(|key| key.side.place().is_none())
    }

    fn keys_alike<'a>(&'a self, other: &'a Signature) -> impl Iterator<Item = &'a SignatureKey> {
        let keys = self.cases().iter().filter(|(key, codes)| {
            let others = codes_at(other.cases(), key).iter();
            let mut pairs = codes.0.iter().zip(others);
            pairs.any(|(a, b)| *a != 0 && a == b)
        });
        keys.map(|(key, _)| key)
    }

    /// The part of the signature whose keys satisfy `is_kept`.
    fn keys(&self, is_kept: impl Fn(&SignatureKey) -> bool) -> Signature {
        let of = |cases: &Cases| {
            let mut cases = cases.clone();
            cases.retain(|key, _| is_kept(key));
            cases
        };
        let mut distributions = self.distributions.clone();
        distributions.retain(|key, _| is_kept(key));
        Signature {
            core: of(&self.core),
            robust: of(&self.robust),
            distributions,
            is_rough: self.is_rough,
        }
    }

    /// A line for each side with a fault, such as `core one decision: 7 right, 4 3fa2`: seven right
    /// calls, then four with the code 3fa2. Two signatures have the same text only if they have the
    /// same faults in all cases.
    pub fn to_text(&self) -> String {
        let tiers = [("core", &self.core), ("robust", &self.robust)];
        let mut text = String::new();
        for (tier, cases) in tiers {
            for (key, codes) in cases {
                text.push_str(&format!("{tier} {key}: {codes}\n"));
            }
        }
        text
    }

    /// Counts the calls on which both are wrong, and those on which both are wrong in the same way.
    pub fn agreement(&self, other: &Signature) -> Agreement {
        Agreement::of(self.cases(), other.cases())
    }

    /// Whether the likeness to `other` is at least `least`, if alike distributions are the same.
    pub fn is_alike(&self, other: &Signature, least: f64) -> bool {
        self.agreement(&other.as_seen_by(self)).likeness() >= least
    }

    /// As [`Signature::agreement`], in the robust cases alone.
    pub fn robust_agreement(&self, other: &Signature) -> Agreement {
        Agreement::of(&self.robust, &other.robust)
    }

    /// Whether this code is right where `mistake` would make it wrong, so it cannot be this
    /// mistake: an aspect that contains at least `TELLING` of the mistake's wrong answers is right
    /// in most of those calls.
    pub fn contradicts(&self, mistake: &Signature) -> bool {
        let mut sides: BTreeMap<Option<(Aspect, Option<&str>)>, Alone> = BTreeMap::new();
        for (key, codes) in mistake.cases() {
            let mine = codes_at(self.cases(), key);
            let hidden = Hiding::of(self.cases(), key);
            let side = sides.entry(key.side.place()).or_default();
            let wrong = codes.0.iter().enumerate().filter(|(_, code)| **code != 0);
            for (call, _) in wrong.filter(|(call, _)| !hidden.at(*call)) {
                side.of += 1;
                side.shown += usize::from(mine.get(call).is_some_and(|mine| *mine != 0));
            }
        }
        let wrong = mistake.wrong() as f64;
        sides.values().any(|side| {
            side.of as f64 >= TELLING * wrong && (side.shown as f64) < SHOWN * side.of as f64
        })
    }

    /// Whether a report about this code shows that it is not `mistake`: a field, or a whole case, is
    /// right in all answers, and the mistake makes at least `REFUTING` of them wrong. Answers that a
    /// crash or a wrong hit or miss hides here are not counted.
    pub fn refutes(&self, mistake: &Signature) -> bool {
        let mine = self.cases();
        let is_wrong = |is_of: &dyn Fn(&SignatureKey) -> bool| mine.keys().any(is_of);
        let mut in_fields = BTreeMap::new();
        let mut in_cases = BTreeMap::new();
        for (key, codes) in mistake.cases() {
            let hidden = Hiding::of(mine, key);
            let wrong = codes.0.iter().enumerate().filter(|(_, code)| **code != 0);
            let shown = wrong.filter(|(call, _)| !hidden.at(*call)).count();
            *in_fields.entry(key.side.place()).or_insert(0) += shown;
            *in_cases.entry(&key.case).or_insert(0) += shown;
        }
        let enough = |wrong: &usize| *wrong >= REFUTING;
        in_fields
            .iter()
            .any(|(place, wrong)| enough(wrong) && !is_wrong(&|key| key.side.place() == *place))
            || in_cases
                .iter()
                .any(|(case, wrong)| enough(wrong) && !is_wrong(&|key| key.case == **case))
    }

    /// Whether a case disagrees with `mistake` throughout: at least `DISAGREEING` values of it are
    /// wrong here or there, and not one of them in the same way. A test of all calls together, such
    /// as that of a distribution, weighs as much as a case: it disagrees if it fails only here or
    /// only there. Where a hit is missed, or code crashes, nothing else can agree.
    pub fn disagrees_throughout(&self, mistake: &Signature) -> bool {
        let mut cases: BTreeMap<&str, Alone> = BTreeMap::new();
        let [mine, theirs] = [self, mistake].map(Signature::cases);
        let keys: BTreeSet<&SignatureKey> = mine.keys().chain(theirs.keys()).collect();
        for key in keys {
            let codes = [mine, theirs].map(|cases| codes_at(cases, key));
            let hidden = [mine, theirs].map(|cases| Hiding::of(cases, key));
            let is_of_all_calls = matches!(&key.side, Side::Aspect { aspect, fault: None, .. } if aspect.is_of_chance());
            if is_of_all_calls
                && codes.iter().any(|codes| codes.is_empty())
                && !hidden.iter().any(|hidden| hidden.at(0))
            {
                return true;
            }
            let case = cases.entry(&key.case).or_default();
            for call in 0..codes[0].len().max(codes[1].len()) {
                let [a, b] = codes.map(|codes| codes.get(call).copied().unwrap_or(0));
                let is_hidden = hidden.iter().any(|hidden| hidden.at(call));
                case.of += usize::from(a != b && !is_hidden || a == b && a != 0);
                case.shown += usize::from(a == b && a != 0);
            }
        }
        let disagrees = |case: &Alone| case.of >= DISAGREEING && case.shown == 0;
        cases.values().any(disagrees)
    }

    /// The functions that gave wrong answers, where cases call several.
    pub fn functions(&self) -> BTreeSet<&str> {
        self.cases()
            .keys()
            .filter_map(|key| key.side.function())
            .collect()
    }

    /// The part of the signature that would remain if only these functions made the mistake.
    pub fn within(&self, functions: &BTreeSet<&str>) -> Signature {
        self.keys(|key| {
            let function = key.side.function();
            function.is_none_or(|function| functions.contains(function))
        })
    }

    /// The signature without the functions whose faults are those of `base`: code that was made
    /// from `base` by an edit, and has the same faults there, does not make its mistake there.
    pub fn changed_from(&self, base: &Signature) -> Signature {
        let faults_in = |signature: &Signature, function: &str| {
            signature.keys(|key| key.side.function() == Some(function))
        };
        let sides = self.core.keys().chain(self.robust.keys());
        let functions = sides.filter_map(|key| key.side.function());
        let changed = functions
            .filter(|function| faults_in(self, function) != faults_in(base, function))
            .collect();
        self.within(&changed)
    }

    /// The kinds of faults on each side, over all cases and calls: the sides with a named fault,
    /// and the codes of classes that identify a mistake. `None` if there is no fault, or if a fault
    /// is of another class.
    pub fn kinds(&self) -> Option<BTreeSet<(&Side, u16)>> {
        let mut kinds = BTreeSet::new();
        for (SignatureKey { side, .. }, codes) in self.cases() {
            if let Side::Aspect { fault: Some(_), .. } = side {
                kinds.insert((side, 0));
                continue;
            }
            let codes: BTreeSet<u16> = codes.0.iter().copied().filter(|code| *code != 0).collect();
            // A distribution also identifies a mistake.
            let is_spread = matches!(side.place(), Some((Aspect::Spread, _)));
            let telling = |code| is_spread || TELLING_KINDS.contains_key(code);
            if !codes.iter().all(telling) {
                return None;
            }
            kinds.extend(codes.into_iter().map(|code| (side, code)));
        }
        (!kinds.is_empty()).then_some(kinds)
    }

    /// The number of calls on which both are wrong in the same way in every aspect, and the number
    /// on which at least one of the two is wrong.
    pub fn calls_alike(&self, other: &Signature) -> (usize, usize) {
        let mut calls: BTreeMap<(&str, usize), bool> = BTreeMap::new();
        let keys: BTreeSet<&SignatureKey> =
            self.cases().keys().chain(other.cases().keys()).collect();
        for key in keys {
            let [mine, theirs] = [self, other].map(|signature| codes_at(signature.cases(), key));
            for call in 0..mine.len().max(theirs.len()) {
                let [a, b] = [mine, theirs].map(|codes| codes.get(call).copied().unwrap_or(0));
                if a != 0 || b != 0 {
                    *calls.entry((&key.case, call)).or_insert(true) &= a == b;
                }
            }
        }
        (calls.values().filter(|alike| **alike).count(), calls.len())
    }
}

impl Agreement {
    fn of(cases: &Cases, others: &Cases) -> Agreement {
        let wrong = |cases: &Cases| cases.values().map(Codes::wrong).sum();
        let mut agreement = Agreement {
            first: wrong(cases),
            second: wrong(others),
            ..Agreement::default()
        };
        for (key, codes) in cases {
            let Some(others) = others.get(key) else {
                continue;
            };
            let pairs = codes.0.iter().zip(&others.0);
            for (a, b) in pairs.filter(|(a, b)| **a != 0 && **b != 0) {
                agreement.both += 1;
                agreement.equal += usize::from(a == b);
            }
        }
        agreement
    }

    /// Of the calls on which at least one of the two is wrong, the fraction on which both are wrong
    /// in the same way; 1 for equal signatures.
    pub fn likeness(&self) -> f64 {
        let either = self.first + self.second - self.both;
        if either == 0 {
            0.0
        } else {
            self.equal as f64 / either as f64
        }
    }
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;
    use codes::digest;
    use judge::findings::Class;

    fn key(text: &str) -> SignatureKey {
        SignatureKey::parse(text).expect("it is a key")
    }

    /// A signature whose core cases have these codes: `2 3*a` are two right calls and three with
    /// code 0xa.
    pub(crate) fn signature(sides: &[(&str, &str)]) -> Signature {
        let codes = |text: &str| -> Vec<u16> {
            let runs = text.split(' ').map(|run| {
                let (count, code) = run.split_once('*').unwrap_or((run, "0"));
                let code = u16::from_str_radix(code, 16).expect("a code");
                vec![code; count.parse().expect("a count")]
            });
            runs.flatten().collect()
        };
        let core = sides.iter();
        Signature {
            core: core
                .map(|(side, text)| (key(side), Codes(codes(text))))
                .collect(),
            ..Signature::default()
        }
    }

    impl Signature {
        /// The same faults in robust cases.
        pub(crate) fn into_robust(self) -> Signature {
            Signature {
                robust: self.core,
                ..Signature::default()
            }
        }

        /// With the core faults of another as its faults in robust cases.
        pub(crate) fn with_robust(self, robust: Signature) -> Signature {
            Signature {
                robust: robust.core,
                ..self
            }
        }
    }

    #[test]
    fn distributions_that_no_test_tells_apart_have_the_same_code() {
        let side = "case spread@sample";
        let of = |counts: [u16; 2], code| {
            let mut all = [0; judge::findings::COUNTS];
            all[..2].copy_from_slice(&counts);
            Signature {
                distributions: [(key(side), vec![DirectionCounts::from_counts(all)])].into(),
                ..signature(&[(side, code), ("case t", "1*7")])
            }
        };
        let student = of([1000, 1000], "1*a");
        let seen = |counts| of(counts, "1*b").as_seen_by(&student);
        assert!(seen([1020, 980]).shows_the_same(&student));
        assert!(!seen([1200, 800]).shows_the_same(&student));
        assert_eq!(seen([1200, 800]), of([1200, 800], "1*b"));
    }

    #[test]
    fn likeness_counts_calls_that_are_wrong_in_the_same_way() {
        let of = |codes| signature(&[("case t", codes)]);
        let agreement = of("1 2*a 1*b").agreement(&of("2 1*a 1*c 1*d"));
        assert_eq!(
            agreement,
            Agreement {
                equal: 1,
                both: 2,
                first: 3,
                second: 3
            }
        );
        assert!((agreement.likeness() - 0.25).abs() < 1e-12);
    }

    #[test]
    fn right_answers_contradict_a_mistake() {
        let mistake = signature(&[("case decision", "4 2*a"), ("case interval", "6*b")]);
        let same_interval = signature(&[("case interval", "6*b")]);
        assert!(same_interval.contradicts(&mistake));
        assert!(!mistake.contradicts(&same_interval));
        assert!(!mistake.contradicts(&mistake));
        // If a hit is missed, it is unknown whether its interval would be right.
        let misses = signature(&[("case decision", "6*e")]);
        assert!(!misses.contradicts(&same_interval));
    }

    #[test]
    fn a_mistake_shows_in_the_functions_that_make_it() {
        let of = |keys: &[&str]| {
            let sides: Vec<(&str, &str)> = keys.iter().map(|key| (*key, "1*1")).collect();
            signature(&sides)
        };
        let handed_on = of(&[
            "one decision@refract",
            "one t@refract",
            "one t@glass",
            "two t",
        ]);
        let in_refract = of(&["one decision@refract", "one t@refract", "two t"]);
        assert_eq!(in_refract.functions(), BTreeSet::from(["refract"]));
        assert_eq!(handed_on.within(&in_refract.functions()), in_refract);
        // A wrong hit or miss of one function hides nothing in another.
        let wrong_t = of(&["one t@glass"]);
        assert!(of(&["one decision@refract"]).contradicts(&wrong_t));
        assert!(!of(&["one decision@glass"]).contradicts(&wrong_t));
    }

    #[test]
    fn aspects_that_a_case_does_not_judge_are_left_out() {
        let whole = signature(&[("one t", "3*a"), ("one position", "3*b"), ("two t", "3*a")]);
        let judged = BTreeMap::from([("one", BTreeSet::from([Aspect::T]))]);
        let rest = signature(&[("one t", "3*a"), ("two t", "3*a")]);
        assert_eq!(whole.in_aspects(&judged), rest);
        assert_eq!(whole.in_aspects(&BTreeMap::new()), whole);
    }

    #[test]
    fn a_mistake_does_not_show_in_functions_that_an_edit_left_alone() {
        let base = signature(&[("one decision@refract", "2 1*a")]);
        let edited = signature(&[
            ("one decision@refract", "2 1*a"),
            ("one decision@reflect", "3*b"),
        ]);
        let reflect = signature(&[("one decision@reflect", "3*b")]);
        assert_eq!(edited.changed_from(&base), reflect);
        assert_eq!(edited.changed_from(&Signature::default()), edited);
        let also_wrong = signature(&[("one decision@refract", "1 2*a")]);
        assert_eq!(also_wrong.changed_from(&base), also_wrong);
    }

    #[test]
    fn kinds_are_those_of_faults_in_whatever_case_and_call() {
        let t = |start: &str, class| format!("{start}*{:x}", digest(&[class]));
        let of_t = |class| signature(&[("one t", &t("3", class))]);
        let one = [
            ("one leaf_size one too many", "1*1"),
            ("one t", &t("2 1", Class::Ratio(-1))),
        ];
        let two = [
            ("two leaf_size one too many", "4 1*7"),
            ("six t", &t("3", Class::Ratio(-1))),
        ];
        assert!(signature(&one).kinds().is_some());
        assert_eq!(signature(&one).kinds(), signature(&two).kinds());
        let [halved, doubled] = [-1, 1].map(|ratio| of_t(Class::Ratio(ratio)));
        assert_ne!(halved.kinds(), doubled.kinds());
        assert_eq!(of_t(Class::Off(3)).kinds(), None);
        assert_eq!(signature(&[]).kinds(), None);
    }
}
