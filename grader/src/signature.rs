//! Signatures: what a piece of code gets wrong, call by call, in a form that can be stored and compared.

use crate::course::Tier;
use crate::judge::tally::Class;
use crate::score::{CaseResult, Status};
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

/// By `case aspect`, or `case aspect name` for faults that have a name.
type Cases = BTreeMap<String, Codes>;

/// The codes of one aspect of one case. Stored as text: runs of `count*code`, hexadecimal, right answers left out as `count`.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(into = "String", try_from = "String")]
struct Codes(Vec<u16>);

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

/// The code of a case that ended without an answer: a panic, a timeout.
const CRASHED: u16 = u16::MAX;

impl Signature {
    /// The signature of a task's results.
    pub fn of(cases: &[CaseResult]) -> Signature {
        let of_tier = |tier: Tier| {
            let cases = cases.iter().filter(|case| case.tier == tier);
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

    /// The names of the faults by aspect, in whatever case; `None` if a fault has no name, or there is none.
    pub fn names(&self) -> Option<BTreeSet<&str>> {
        let names = self.cases().keys().map(|key| {
            let (_, aspect_and_name) = key.split_once(' ')?;
            aspect_and_name.contains(' ').then_some(aspect_and_name)
        });
        let names: Option<BTreeSet<&str>> = names.collect();
        names.filter(|names| !names.is_empty())
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

    /// How this signature agrees with that of code which makes two mistakes, `first` and `second`. Where both would
    /// show in one value either may; where one says miss or crashes, the other may not show at all.
    pub fn agreement_with_both(&self, first: &Signature, second: &Signature) -> Together {
        let mut together = Together::default();
        let of_tier = [self, first, second].map(|signature| match self.core.is_empty() {
            true => &signature.robust,
            false => &signature.core,
        });
        let names: BTreeSet<&String> = of_tier.iter().flat_map(|cases| cases.keys()).collect();
        for name in names {
            let [student, one, other] = of_tier.map(|cases| {
                let codes = cases.get(name);
                codes.map_or(&[][..], |codes| &codes.0)
            });
            let hidden_by = [of_tier[2], of_tier[1]].map(|cases| Hiding::of(cases, name));
            for call in 0..student.len().max(one.len()).max(other.len()) {
                let at = |codes: &[u16]| codes.get(call).copied().unwrap_or(0);
                let made = [at(one), at(other)];
                let seen = at(student);
                for i in [0, 1] {
                    if made[i] != 0 && made[1 - i] == 0 && !(seen == 0 && hidden_by[i].at(call)) {
                        together.alone[i].of += 1;
                        together.alone[i].shown += usize::from(seen == made[i]);
                    }
                }
                let explained = made.contains(&seen);
                together.equal += usize::from(seen != 0 && explained);
                together.either += usize::from(match (seen, made) {
                    (0, [0, 0]) => false,
                    (0, [_, 0]) => !hidden_by[0].at(call),
                    (0, [0, _]) => !hidden_by[1].at(call),
                    // Something else shows where both do: each spoils it for the other.
                    (_, [a, b]) => seen == 0 || explained || a == b || a == 0 || b == 0,
                });
            }
        }
        together
    }
}

/// How a signature agrees with those of two mistakes together.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Together {
    /// Values that are wrong as one of the two has them.
    pub equal: usize,
    /// Values that are wrong, or should be if both are made.
    pub either: usize,
    /// What the first and the second make wrong alone.
    pub alone: [Alone; 2],
}

/// Values that one of two mistakes alone makes wrong.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Alone {
    /// How many there are.
    pub of: usize,
    /// How many of them are wrong in that way.
    pub shown: usize,
}

impl Together {
    /// Share of all wrong values that are wrong in the same way.
    pub fn likeness(&self) -> f64 {
        self.equal as f64 / self.either.max(1) as f64
    }
}

/// What keeps another mistake from showing in an aspect of a case.
struct Hiding<'a> {
    crashed: bool,
    /// Calls decided wrongly: nothing else is judged there.
    decisions: &'a [u16],
}

impl Hiding<'_> {
    fn of<'a>(cases: &'a Cases, name: &str) -> Hiding<'a> {
        let case = name.split(' ').next().unwrap_or_default();
        let is_decision = name.ends_with(" Decision");
        let decisions = cases
            .get(&format!("{case} Decision"))
            .filter(|_| !is_decision);
        Hiding {
            crashed: cases.contains_key(&format!("{case} crashed")),
            decisions: decisions.map_or(&[], |codes| &codes.0),
        }
    }

    fn at(&self, call: usize) -> bool {
        self.crashed || self.decisions.get(call).is_some_and(|code| *code != 0)
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

/// The codes of a case, by `case aspect`; right aspects are left out.
fn codes_of(case: &CaseResult) -> Vec<(String, Codes)> {
    if let Status::Crashed(_) = case.status {
        return vec![(format!("{} crashed", case.name), Codes(vec![CRASHED]))];
    }
    let failed = case.findings.iter().filter(|finding| !finding.passed());
    // Where something is wrong, that is why other aspects never showed.
    let shows_nothing = case.findings.iter().all(|finding| finding.wrong == 0);
    failed
        .flat_map(|finding| {
            let mut kinds: BTreeMap<Option<&str>, Vec<(u32, Class)>> = BTreeMap::new();
            for &(call, class) in &finding.faults {
                let name = match class {
                    Class::Named(name) => Some(name),
                    _ => None,
                };
                kinds.entry(name).or_default().push((call, class));
            }
            if kinds.is_empty() && shows_nothing {
                kinds.entry(Some("never shown")).or_default();
            }
            kinds.into_iter().map(|(name, faults)| {
                let aspect = format!("{} {:?}", case.name, finding.aspect);
                let name = name.map_or(aspect.clone(), |name| format!("{aspect} {name}"));
                (name, Codes::of(&faults))
            })
        })
        .collect()
}

impl Codes {
    fn of(all: &[(u32, Class)]) -> Codes {
        let mut faults: BTreeMap<u32, Vec<Class>> = BTreeMap::new();
        for &(call, class) in all {
            faults.entry(call).or_default().push(class);
        }
        let calls = faults
            .last_key_value()
            .map_or(0, |(call, _)| *call as usize + 1);
        let mut codes = vec![0; calls];
        for (call, mut classes) in faults {
            classes.sort_unstable();
            classes.dedup();
            codes[call as usize] = digest(&classes);
        }
        if codes.is_empty() {
            codes.push(digest(&[]));
        }
        Codes(codes)
    }

    fn wrong(&self) -> usize {
        self.0.iter().filter(|code| **code != 0).count()
    }
}

/// FNV-1a over the names, folded to 16 bits; never 0 and never [`CRASHED`].
fn digest(classes: &[Class]) -> u16 {
    let text = format!("{classes:?}");
    let hash = text.bytes().fold(0xcbf2_9ce4_8422_2325_u64, |hash, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x100_0000_01b3)
    });
    let folded = hash ^ (hash >> 32);
    1 + ((folded ^ (folded >> 16)) & 0xffff) as u16 % (CRASHED - 1)
}

impl From<Codes> for String {
    fn from(codes: Codes) -> String {
        let mut text = Vec::new();
        for run in codes.0.chunk_by(|a, b| a == b) {
            text.push(match run[0] {
                0 => format!("{}", run.len()),
                code => format!("{}*{code:x}", run.len()),
            });
        }
        text.join(" ")
    }
}

impl TryFrom<String> for Codes {
    type Error = String;

    fn try_from(text: String) -> Result<Codes, String> {
        let mut codes = Vec::new();
        for run in text.split_whitespace() {
            let (count, code) = run.split_once('*').unwrap_or((run, "0"));
            let count: usize = count
                .parse()
                .map_err(|_| format!("`{run}` is not count*code"))?;
            let code =
                u16::from_str_radix(code, 16).map_err(|_| format!("`{run}` is not count*code"))?;
            codes.resize(codes.len() + count, code);
        }
        Ok(Codes(codes))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn signature(codes: &str) -> Signature {
        let codes = Codes::try_from(codes.to_string()).unwrap();
        Signature {
            core: [("case".to_string(), codes)].into(),
            robust: Cases::new(),
        }
    }

    #[test]
    fn codes_come_back_from_their_text() {
        let codes = Codes(vec![0, 0, 0xbeef, 0xbeef, 1, 0]);
        assert_eq!(String::from(codes.clone()), "2 2*beef 1*1 1");
        assert_eq!(Codes::try_from("2 2*beef 1*1 1".to_string()), Ok(codes));
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
    fn two_mistakes_explain_what_neither_does_alone() {
        let (first, second) = (signature("1 2*a 1*b"), signature("3 1*d 2*f"));
        let both = signature("1 2*a 1*c 2*f").agreement_with_both(&first, &second);
        let alone = |shown, of| Alone { of, shown };
        assert_eq!(
            both,
            Together {
                equal: 4,
                either: 4,
                alone: [alone(2, 2), alone(2, 2)]
            }
        );
        let not_made = signature("1 2*a 1*b").agreement_with_both(&first, &second);
        assert_eq!(not_made.alone[1], alone(0, 2));
        assert!(not_made.likeness() < 1.0);
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
    fn names_are_those_of_faults_in_whatever_case() {
        let of = |keys: &[&str]| Signature {
            core: keys
                .iter()
                .map(|key| (key.to_string(), Codes(vec![1])))
                .collect(),
            robust: Cases::new(),
        };
        let named = of(&["one LeafSize one too many", "two LeafSize one too many"]);
        assert_eq!(
            named.names(),
            Some(BTreeSet::from(["LeafSize one too many"]))
        );
        assert_eq!(of(&["one LeafSize one too many", "two Work"]).names(), None);
        assert_eq!(of(&[]).names(), None);
    }

    #[test]
    fn a_miss_hides_what_else_is_wrong() {
        let with_miss = |codes: &str| {
            let mut signature = signature(codes);
            let case = signature.core.remove("case").unwrap();
            signature.core.insert("case T".to_string(), case);
            signature
        };
        let mut miss = Signature::default();
        let decision = Codes::try_from("1 1*e".to_string()).unwrap();
        miss.core.insert("case Decision".to_string(), decision);
        let mut both = with_miss("1*a");
        both.core.extend(miss.core.clone());
        let together = both.agreement_with_both(&with_miss("2*a"), &miss);
        assert!((together.likeness() - 1.0).abs() < 1e-12);
    }
}
