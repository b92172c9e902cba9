//! Signatures: what a piece of code gets wrong, call by call, in a form that can be stored and compared.

mod codes;
mod together;

use codes::{Codes, TELLING_KINDS, codes_of};
use together::Hiding;
pub use together::{Alone, Together};

use crate::score::CaseResult;
use judge::Tier;
use serde::{Deserialize, Serialize};
use std::collections::{BTreeMap, BTreeSet};

/// For each aspect of each case the code of each call: 0 where the answer was right, else a digest of how it was
/// wrong. The same mistake gives the same codes whatever formula it is made in, and two mistakes in different aspects
/// do not hide each other; nor do faults that have a name of their own, which stand beside the aspect's others.
///
/// Core and robust cases are apart: in robust ones formulas differ by themselves, so they only speak where all core
/// cases are right.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Signature {
    core: Cases,
    robust: Cases,
}

/// By `case aspect`, or `case aspect name` for faults that have a name; where a case calls several functions the
/// aspect is followed by `@function`.
type Cases = BTreeMap<String, Codes>;

/// How two signatures agree.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Agreement {
    /// Calls on which both are wrong in the same way.
    pub equal: usize,
    /// Calls on which both are wrong, in whatever way.
    pub both: usize,
    /// Calls on which the first is wrong.
    pub first: usize,
    /// Calls on which the second is wrong.
    pub second: usize,
}

/// A side of the answer tells against a mistake if it holds this share of what the mistake gets wrong,
const TELLING: f64 = 0.1;

/// and if less than this share of that is wrong.
const SHOWN: f64 = 0.25;

impl Signature {
    /// The signature of a task's results. Cases with neighbours do not speak: the fault may be theirs.
    pub fn of(cases: &[CaseResult]) -> Signature {
        let of_tier = |tier: Tier| {
            let cases = cases.iter();
            let cases = cases.filter(|case| case.tier == tier && !case.with_neighbours);
            cases.flat_map(codes_of).collect()
        };
        Signature {
            core: of_tier(Tier::Core),
            robust: of_tier(Tier::Robust),
        }
    }

    /// Whether nothing was wrong.
    pub fn is_empty(&self) -> bool {
        self.core.is_empty() && self.robust.is_empty()
    }

    /// The cases that speak.
    fn cases(&self) -> &Cases {
        if self.core.is_empty() {
            &self.robust
        } else {
            &self.core
        }
    }

    /// Whether nobody can tell the two by what speaks of them.
    pub fn shows_the_same(&self, other: &Signature) -> bool {
        self.cases() == other.cases()
    }

    /// On how many calls something was wrong.
    pub fn wrong(&self) -> usize {
        self.cases().values().map(Codes::wrong).sum()
    }

    /// On which calls both are wrong, and on which in the same way.
    pub fn agreement(&self, other: &Signature) -> Agreement {
        let mut agreement = Agreement {
            first: self.wrong(),
            second: other.wrong(),
            ..Agreement::default()
        };
        for (name, codes) in self.cases() {
            let Some(others) = other.cases().get(name) else {
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

    /// Whether this code is right where `mistake` would make it wrong: one side of the answer that the mistake has wrong,
    /// and not only now and then, is right in most of those calls.
    pub fn contradicts(&self, mistake: &Signature) -> bool {
        let mut sides: BTreeMap<&str, Alone> = BTreeMap::new();
        for (name, codes) in mistake.cases() {
            let mine = self.cases().get(name).map_or(&[][..], |mine| &mine.0);
            let hidden = Hiding::of(self.cases(), name);
            let aspect = name.split(' ').nth(1).unwrap_or_default();
            let side = sides.entry(aspect).or_default();
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

    /// The functions that gave wrong answers, where cases call several.
    pub fn functions(&self) -> BTreeSet<&str> {
        self.cases()
            .keys()
            .filter_map(|key| function(key))
            .collect()
    }

    /// What of this would show if of all functions only these made the mistake.
    pub fn within(&self, functions: &BTreeSet<&str>) -> Signature {
        let of = |cases: &Cases| {
            let mut cases = cases.clone();
            cases
                .retain(|key, _| function(key).is_none_or(|function| functions.contains(function)));
            cases
        };
        Signature {
            core: of(&self.core),
            robust: of(&self.robust),
        }
    }

    /// What kinds of faults there are, aspect by aspect, in whatever case and call: their names, and the codes of
    /// classes that say what kind of mistake it is. `None` if a fault is of another class, or there is none.
    pub fn kinds(&self) -> Option<BTreeSet<(&str, u16)>> {
        let mut kinds = BTreeSet::new();
        for (key, codes) in self.cases() {
            let (_, aspect_and_name) = key.split_once(' ')?;
            if aspect_and_name.contains(' ') {
                kinds.insert((aspect_and_name, 0));
                continue;
            }
            let codes: BTreeSet<u16> = codes.0.iter().copied().filter(|code| *code != 0).collect();
            // Where the middle of many directions lies tells, too.
            let telling = |code| aspect_and_name == "Spread" || TELLING_KINDS.contains(code);
            if !codes.iter().all(telling) {
                return None;
            }
            kinds.extend(codes.into_iter().map(|code| (aspect_and_name, code)));
        }
        (!kinds.is_empty()).then_some(kinds)
    }

    /// On how many calls both are wrong in the same way in every aspect, and on how many either is wrong.
    pub fn calls_alike(&self, other: &Signature) -> (usize, usize) {
        let mut calls: BTreeMap<(&str, usize), bool> = BTreeMap::new();
        let names: BTreeSet<&String> = self.cases().keys().chain(other.cases().keys()).collect();
        for name in names {
            let case = name.split(' ').next().unwrap_or_default();
            let code = |signature: &Signature, call: usize| -> u16 {
                let codes = signature.cases().get(name);
                codes
                    .and_then(|codes| codes.0.get(call).copied())
                    .unwrap_or(0)
            };
            let longest = |signature: &Signature| {
                signature.cases().get(name).map_or(0, |codes| codes.0.len())
            };
            for call in 0..longest(self).max(longest(other)) {
                let (mine, theirs) = (code(self, call), code(other, call));
                if mine != 0 || theirs != 0 {
                    *calls.entry((case, call)).or_insert(true) &= mine == theirs;
                }
            }
        }
        (calls.values().filter(|alike| **alike).count(), calls.len())
    }
}

impl Agreement {
    /// Share of all wrong calls, of either, that are wrong in the same way; 1 for equal signatures.
    pub fn likeness(&self) -> f64 {
        let either = self.first + self.second - self.both;
        if either == 0 {
            0.0
        } else {
            self.equal as f64 / either as f64
        }
    }
}

/// The function in a key.
fn function(key: &str) -> Option<&str> {
    let aspect = key.split(' ').nth(1)?;
    aspect.split_once('@').map(|(_, function)| function)
}

#[cfg(test)]
mod tests {
    use super::*;
    use codes::digest;
    use judge::tally::Class;

    pub(super) fn signature(codes: &str) -> Signature {
        let codes = Codes::try_from(codes.to_string()).unwrap();
        Signature {
            core: [("case".to_string(), codes)].into(),
            robust: Cases::new(),
        }
    }

    #[test]
    fn likeness_counts_calls_that_are_wrong_in_the_same_way() {
        let agreement = signature("1 2*a 1*b").agreement(&signature("2 1*a 1*c 1*d"));
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
    fn what_is_right_tells_against_a_mistake() {
        let of = |aspects: &[(&str, &str)]| Signature {
            core: aspects
                .iter()
                .map(|(aspect, codes)| {
                    let codes = Codes::try_from(codes.to_string()).unwrap();
                    (format!("case {aspect}"), codes)
                })
                .collect(),
            robust: Cases::new(),
        };
        let mistake = of(&[("Decision", "4 2*a"), ("Interval", "6*b")]);
        let same_interval = of(&[("Interval", "6*b")]);
        assert!(same_interval.contradicts(&mistake));
        assert!(!mistake.contradicts(&same_interval));
        assert!(!mistake.contradicts(&mistake));
        // Where a hit is missed nothing shows whether its interval would be right.
        let misses = of(&[("Decision", "6*e")]);
        assert!(!misses.contradicts(&same_interval));
    }

    #[test]
    fn a_mistake_shows_in_the_functions_that_make_it() {
        let of = |keys: &[&str]| Signature {
            core: keys
                .iter()
                .map(|key| (key.to_string(), Codes(vec![1])))
                .collect(),
            robust: Cases::new(),
        };
        let handed_on = of(&[
            "one Decision@refract",
            "one T@refract",
            "one T@glass",
            "two T",
        ]);
        let in_refract = of(&["one Decision@refract", "one T@refract", "two T"]);
        assert_eq!(in_refract.functions(), BTreeSet::from(["refract"]));
        assert_eq!(handed_on.within(&in_refract.functions()), in_refract);
        // What is decided wrongly in one function hides nothing in another.
        let wrong_t = of(&["one T@glass"]);
        assert!(of(&["one Decision@refract"]).contradicts(&wrong_t));
        assert!(!of(&["one Decision@glass"]).contradicts(&wrong_t));
    }

    #[test]
    fn kinds_are_those_of_faults_in_whatever_case_and_call() {
        let of = |keys: &[(&str, &str)]| Signature {
            core: keys
                .iter()
                .map(|(key, codes)| {
                    let codes = Codes::try_from(codes.to_string()).unwrap();
                    (key.to_string(), codes)
                })
                .collect(),
            robust: Cases::new(),
        };
        let halved = format!("2 1*{:x}", digest(&[Class::Ratio(-1)]));
        let one = of(&[("one LeafSize one too many", "1*1"), ("one T", &halved)]);
        let halved = format!("3*{:x}", digest(&[Class::Ratio(-1)]));
        let two = of(&[("two LeafSize one too many", "4 1*7"), ("six T", &halved)]);
        assert!(one.kinds().is_some());
        assert_eq!(one.kinds(), two.kinds());
        let doubled = format!("3*{:x}", digest(&[Class::Ratio(1)]));
        assert_ne!(
            of(&[("one T", &halved)]).kinds(),
            of(&[("one T", &doubled)]).kinds()
        );
        let sizes = format!("3*{:x}", digest(&[Class::Off(3)]));
        assert_eq!(of(&[("one T", &sizes)]).kinds(), None);
        assert_eq!(of(&[]).kinds(), None);
    }
}
