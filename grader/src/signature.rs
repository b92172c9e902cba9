//! Signatures: what a piece of code gets wrong, call by call, in a form that can be stored and compared.

use crate::course::Tier;
use crate::judge::tally::{Class, Finding};
use crate::score::{CaseResult, Status};
use serde::{Deserialize, Serialize};
use std::collections::{BTreeMap, BTreeSet};

/// For each aspect of each case the code of each call: 0 where the answer was right, else a digest of how it was
/// wrong. The same mistake gives the same codes whatever formula it is made in, and two mistakes in different aspects
/// do not hide each other.
///
/// Core and robust cases are apart: in robust ones formulas differ by themselves, so they only speak where all core
/// cases are right.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Signature {
    core: Cases,
    robust: Cases,
}

/// By `case aspect`.
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

    /// What is left of this signature on the calls where `other` is right.
    pub fn without(&self, other: &Signature) -> Signature {
        let mut rest = self.cases().clone();
        for (name, codes) in &mut rest {
            let Some(others) = other.cases().get(name) else {
                continue;
            };
            let pairs = codes.0.iter_mut().zip(&others.0);
            for (mine, _) in pairs.filter(|(_, theirs)| **theirs != 0) {
                *mine = 0;
            }
        }
        rest.retain(|_, codes| codes.wrong() > 0);
        Signature {
            core: rest,
            robust: Cases::new(),
        }
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
    failed
        .map(|finding| {
            let name = format!("{} {:?}", case.name, finding.aspect);
            (name, Codes::of(finding))
        })
        .collect()
}

impl Codes {
    fn of(finding: &Finding) -> Codes {
        let mut faults: BTreeMap<u32, Vec<Class>> = BTreeMap::new();
        for &(call, class) in &finding.faults {
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
            // It should have shown, and never did.
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
    fn what_another_signature_explains_can_be_taken_away() {
        assert_eq!(
            signature("1 2*a 1*b").without(&signature("1 2*f")).wrong(),
            1
        );
    }
}
