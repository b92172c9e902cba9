//! Codes: what is wrong about one aspect of one case, call by call.

use crate::score::{CaseResult, Status};
use judge::tally::{BLACK_CHANNEL, Class};
use serde::{Deserialize, Serialize};
use std::collections::{BTreeMap, HashSet};
use std::sync::LazyLock;

/// The codes of one aspect of one case. Stored as text: runs of `count*code`, hexadecimal, right answers left out as `count`.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(into = "String", try_from = "String")]
pub(super) struct Codes(pub(super) Vec<u16>);

/// Of many answers to the same question the first so many tell the mistake, and the first wrong one if it comes later.
const ENOUGH: u32 = 200;

/// The code of a case that ended without an answer: a panic, a timeout.
const CRASHED: u16 = u16::MAX;

/// The codes of a case, by `case aspect`; right aspects are left out.
pub(super) fn codes_of(case: &CaseResult) -> Vec<(String, Codes)> {
    if let Status::Crashed(_) = case.status {
        return vec![(format!("{} crashed", case.name), Codes(vec![CRASHED]))];
    }
    let failed = case.findings.iter().filter(|finding| !finding.passed());
    // Where many answers are judged by chance, they are all to the same question.
    let by_chance = case
        .findings
        .iter()
        .any(|finding| finding.detectable.is_some());
    let most = if by_chance { ENOUGH } else { u32::MAX };
    // Where something is wrong, that is why other aspects never showed.
    let shows_nothing = case.findings.iter().all(|finding| finding.wrong == 0);
    failed
        .flat_map(|finding| {
            type Kind<'a> = (Option<&'a str>, Option<&'a str>);
            let mut kinds: BTreeMap<Kind<'_>, Vec<(u32, Class)>> = BTreeMap::new();
            for fault in &finding.faults {
                let name = match fault.class {
                    Class::Named(name) => Some(name),
                    _ => None,
                };
                let kind = kinds.entry((fault.function, name)).or_default();
                if fault.call < most || kind.is_empty() {
                    kind.push((fault.call, fault.class));
                }
            }
            if kinds.is_empty() && shows_nothing {
                kinds.entry((None, Some("never shown"))).or_default();
            }
            kinds.into_iter().map(|((function, name), faults)| {
                let mut key = format!("{} {:?}", case.name, finding.aspect);
                if let Some(function) = function {
                    key = format!("{key}@{function}");
                }
                if let Some(name) = name {
                    key = format!("{key} {name}");
                }
                (key, Codes::of(&faults))
            })
        })
        .collect()
}

/// The codes of classes that say of themselves what kind of mistake it is: the same factor wherever it shows. Others
/// say where one shows, or how large it is with some chance in it.
pub(super) static TELLING_KINDS: LazyLock<HashSet<u16>> = LazyLock::new(|| {
    let ratios = (-99..=99).map(Class::Ratio);
    // Grey factors of colours, some of whose channels may be black.
    let greys = (-40..=40).flat_map(|ratio| {
        (0..7).map(move |black: u8| {
            let channel = |i: u8| match black >> i & 1 {
                0 => ratio,
                _ => BLACK_CHANNEL,
            };
            Class::Colour([0, 1, 2].map(channel))
        })
    });
    let others = [
        Class::NotANumber,
        Class::Infinite,
        Class::Zero,
        Class::Negated,
        Class::WrongLength,
        Class::Swapped,
    ];
    let all = ratios.chain(greys).chain(others);
    all.map(|class| digest(&[class])).collect()
});

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

    pub(super) fn wrong(&self) -> usize {
        self.0.iter().filter(|code| **code != 0).count()
    }
}

/// FNV-1a over the names, folded to 16 bits; never 0 and never [`CRASHED`].
pub(super) fn digest(classes: &[Class]) -> u16 {
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

    #[test]
    fn codes_come_back_from_their_text() {
        let codes = Codes(vec![0, 0, 0xbeef, 0xbeef, 1, 0]);
        assert_eq!(String::from(codes.clone()), "2 2*beef 1*1 1");
        assert_eq!(Codes::try_from("2 2*beef 1*1 1".to_string()), Ok(codes));
    }
}
