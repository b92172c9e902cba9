//! Codes: what is wrong about one side of one case, call by call.

use super::key::{Side, SignatureKey};
use crate::score::CaseResult;
use crate::workers::crash::CrashKind;
use base::fnv;
use judge::findings::{BLACK_CHANNEL, Class, DirectionCounts, Fault};
use std::collections::{BTreeMap, HashMap};
use std::fmt;
use std::sync::LazyLock;

/// One code for each call that is compared: 0 if the answer is right, otherwise a digest of the
/// classes of its faults.
#[derive(Clone, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Codes(pub(super) Vec<u16>);

/// Of many answers to the same question, this many are compared, and the first wrong one if it
/// comes later.
const SAME_QUESTION: u32 = 200;

/// Of other cases, about this many calls are compared, evenly spread, and the first wrong one. More
/// calls do not distinguish more mistakes, but make the stored signatures large.
const MOST_CALLS: usize = 200;

/// One call in so many is compared. They are odd and not multiples of 5, so that the compared
/// pixels are in all columns of a picture.
const STRIDES: [u32; 7] = [1, 3, 7, 17, 51, 119, 357];

/// Which calls of a case with so many calls are compared: one in how many.
pub(super) fn stride_of(calls: usize) -> u32 {
    let is_enough = |stride: &u32| calls / *stride as usize <= MOST_CALLS;
    let enough = STRIDES.into_iter().find(is_enough);
    enough.unwrap_or(STRIDES[STRIDES.len() - 1])
}

/// The code of a case that panics.
pub(super) const CRASHED: u16 = u16::MAX;

/// The code of a case that does not end: whether it runs out of time, of stack or of memory depends
/// on how the code is written.
const ENDLESS: u16 = u16::MAX - 1;

/// The codes of a case; sides without a fault are left out.
pub(super) fn codes_of(case: &CaseResult) -> Vec<(SignatureKey, Codes)> {
    let key = |side| SignatureKey {
        case: case.name.clone(),
        side,
    };
    if let Some(crash) = case.crash() {
        let code = match crash.kind {
            CrashKind::Panic => CRASHED,
            CrashKind::Endless => ENDLESS,
            // No mistake of a formula ends the program.
            CrashKind::Ended | CrashKind::Killed => return Vec::new(),
        };
        return vec![(key(Side::Crash), Codes(vec![code]))];
    }
    let failed = case.findings.iter().filter(|finding| !finding.passed());
    // All answers that are judged by a statistical test are to the same question.
    let is_statistical = case
        .findings
        .iter()
        .any(|finding| finding.detectable.is_some());
    let compared = if is_statistical {
        SAME_QUESTION
    } else {
        u32::MAX
    };
    let stride = match is_statistical {
        true => 1,
        false => stride_of(case.calls),
    };
    // If some answers are wrong, that explains why other aspects have no answers to judge.
    let shows_nothing = case.findings.iter().all(|finding| finding.wrong == 0);
    let mut all = Vec::new();
    for finding in failed {
        let mut sides: BTreeMap<Side, Vec<(u32, Class)>> = BTreeMap::new();
        let side = |fault: Option<&Fault>| Side::Aspect {
            aspect: finding.aspect,
            function: fault.and_then(|fault| fault.function).map(str::to_string),
            fault: fault.and_then(|fault| match fault.class {
                Class::Named(name) => Some(name.to_string()),
                _ => None,
            }),
        };
        // The first wrong call of each side.
        let mut first: BTreeMap<Side, u32> = BTreeMap::new();
        for fault in &finding.faults {
            let side = side(Some(fault));
            let is_first = *first.entry(side.clone()).or_insert(fault.call) == fault.call;
            let is_compared = fault.call < compared && fault.call.is_multiple_of(stride);
            if is_compared || is_first {
                let faults = sides.entry(side).or_default();
                faults.push((fault.call / stride, fault.class));
            }
        }
        if sides.is_empty() && shows_nothing {
            sides.entry(side(None)).or_default();
        }
        let codes = sides.into_iter();
        all.extend(codes.map(|(side, faults)| (key(side), Codes::of(&faults))));
    }
    all
}

/// Whether a wrong answer of the case may differ from others with the same code.
pub(super) fn is_rough(case: &CaseResult) -> bool {
    let findings = case.findings.iter();
    findings.filter(|finding| !finding.passed()).any(|finding| {
        let mut faults = finding.faults.iter();
        finding.aspect.is_of_chance() || faults.any(|fault| fault.class.is_rough(finding.aspect))
    })
}

/// The wrong distributions of directions in a case, side by side.
pub(super) fn distributions_of(case: &CaseResult) -> Vec<(SignatureKey, Vec<DirectionCounts>)> {
    let mut sides: BTreeMap<SignatureKey, Vec<DirectionCounts>> = BTreeMap::new();
    for finding in &case.findings {
        for fault in &finding.faults {
            if let Class::Distribution(counts) = fault.class {
                let key = SignatureKey {
                    case: case.name.clone(),
                    side: Side::Aspect {
                        aspect: finding.aspect,
                        function: fault.function.map(str::to_string),
                        fault: None,
                    },
                };
                sides.entry(key).or_default().push(counts);
            }
        }
    }
    sides.into_iter().collect()
}

/// The codes of classes that identify a mistake on their own, such as the same wrong factor in
/// every answer. Other classes describe where the answer is wrong, or how large the error is, which
/// partly depends on random numbers.
pub(super) static TELLING_KINDS: LazyLock<HashMap<u16, Class>> = LazyLock::new(|| {
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
        Class::OtherSide,
        Class::SlightlyLess,
        Class::SlightlyMore,
        Class::WrongLength,
        Class::TooShort,
        Class::TooLong,
        Class::Swapped,
    ];
    let all = ratios.chain(greys).chain(others);
    all.map(|class| (digest(&[class]), class)).collect()
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

impl fmt::Display for Codes {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (i, run) in self.0.chunk_by(|a, b| a == b).enumerate() {
            let comma = if i == 0 { "" } else { ", " };
            write!(f, "{comma}{} ", run.len())?;
            match run[0] {
                0 => write!(f, "right")?,
                code => write!(f, "{code:04x}")?,
            }
        }
        Ok(())
    }
}

/// FNV-1a over the names, folded to 16 bits; never 0 and never [`CRASHED`].
pub(super) fn digest(classes: &[Class]) -> u16 {
    let text = format!("{classes:?}");
    let hash = text.bytes().fold(fnv::START, fnv::add);
    let folded = hash ^ (hash >> 32);
    1 + ((folded ^ (folded >> 16)) & 0xffff) as u16 % (CRASHED - 1)
}
