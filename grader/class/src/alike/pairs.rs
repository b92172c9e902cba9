//! Which submissions of a class have passages in common, and how many would by chance.
//!
//! As in [`crate::likeness`], chance is estimated from the class. If `c` of the `n - 2` other
//! students have a passage as well, another student has it with probability
//! `(c + 1/2) / (n - 1)`; the passages of a pair count as independent, so `n (n - 1) / 2` times the
//! product of their probabilities is how many pairs would be expected to have all of them.

use super::owners::Owners;
use std::cmp::Reverse;
use std::collections::BTreeMap;
use submission::Untrusted;
use submission::code::passages::Passage;
use submission::code::source::{Excerpt, Source};

/// A pair is listed if fewer pairs of the class are expected to have its passages by chance.
pub use crate::likeness::EXPECTED;

/// A pair is listed, too, if passages that few others have are so much of the shorter code.
pub const LARGE_SHARE: f64 = 0.6;

/// Code of fewer tokens of one's own is not compared as a whole: there is one way to write it.
const SMALLEST: usize = 100;

/// Passages that more students have come from a book, a lecture or a page, not from each other.
pub(super) const SHARED_BY_FEW: usize = 4;

/// How many pairs are compared passage by passage: those with the most rare fingerprints in common.
/// A class of a thousand has half a million pairs.
pub const COMPARED: usize = 20_000;

/// The most passages of a pair in one stage that are shown: the longest.
pub const SHOWN: usize = 20;

/// A student, and the code of each stage that was handed in.
#[derive(Clone, Debug)]
pub struct Student {
    /// The name.
    pub name: Untrusted,
    /// The first in the roster of those who hand in together, if the roster knows whose it is.
    pub owner: Option<usize>,
    /// The code, by its stage.
    pub stages: BTreeMap<String, Source>,
}

/// What two students have in common in a stage.
#[derive(Clone, Debug, PartialEq)]
pub struct SharedStage {
    /// The stage.
    pub stage: String,
    /// Which part of the shorter code is in passages that at most four students have, 0 to 1.
    pub share: f64,
    /// The passages, in the order of the first student's code; of more than [`SHOWN`] the longest.
    pub passages: Vec<SharedPassage>,
    /// How many more there are.
    pub more: usize,
}

/// A passage that two students have in common.
#[derive(Clone, Debug, PartialEq)]
pub struct SharedPassage {
    /// It in the code of either.
    pub excerpts: [Excerpt; 2],
    /// The number of its tokens.
    pub tokens: usize,
    /// Whether the names are the same, too.
    pub has_same_names: bool,
    /// How many other students have it.
    pub others: usize,
}

/// Two students with common passages.
#[derive(Clone, Debug, PartialEq)]
pub struct Pair {
    /// Their names.
    pub names: [Untrusted; 2],
    /// Their stages with common passages.
    pub stages: Vec<SharedStage>,
    /// How many pairs of this class would have the same passages in common by chance.
    pub expected: f64,
}

/// How much two students have in common, without the passages: a class may have many such pairs.
#[derive(Clone, Debug, PartialEq)]
pub struct Found {
    /// The numbers of both in the class.
    pub both: [usize; 2],
    /// The largest share of a stage, as in [`SharedStage::share`].
    pub share: f64,
    /// As in [`Pair::expected`].
    pub expected: f64,
    /// The number of common passages.
    pub passages: usize,
    /// The number of their tokens.
    pub tokens: usize,
}

/// The pairs of a class.
#[derive(Clone, Debug, PartialEq)]
pub struct Pairs {
    /// Those to look at, with the largest shares first.
    pub listed: Vec<Found>,
    /// How many pairs have rare code in common and were not compared, because [`COMPARED`] pairs
    /// have more.
    pub not_compared: usize,
}

/// The pairs of `students`, whose fingerprints are `owners`. At most `compared` are compared.
pub fn pairs(students: &[Student], owners: &Owners<'_>, compared: usize) -> Pairs {
    let candidates = candidates(owners);
    let all = candidates.iter().take(compared).map(|both| {
        let common = compare_both(students, owners, *both);
        Found {
            both: *both,
            share: common.share(),
            expected: common.expected,
            passages: common.stages.iter().map(|stage| stage.passages.len()).sum(),
            tokens: common.stages.iter().map(CommonStage::tokens).sum(),
        }
    });
    let mut listed: Vec<Found> = all
        .filter(|found| found.expected < EXPECTED || found.share >= LARGE_SHARE)
        .collect();
    listed.sort_by(|a, b| {
        let share = b.share.total_cmp(&a.share);
        share
            .then(a.expected.total_cmp(&b.expected))
            .then(a.both.cmp(&b.both))
    });
    Pairs {
        listed,
        not_compared: candidates.len().saturating_sub(compared),
    }
}

/// A pair that [`pairs`] found, with its passages.
pub fn pair(students: &[Student], owners: &Owners<'_>, found: &Found) -> Pair {
    compare_both(students, owners, found.both).shown()
}

/// The pairs that have fingerprints of few in common, those with the most first.
fn candidates(owners: &Owners<'_>) -> Vec<[usize; 2]> {
    let mut all: Vec<[usize; 2]> = Vec::new();
    for (_, group) in owners.groups().filter(|(_, group)| is_few(group.len())) {
        for (i, (_, a)) in group.iter().enumerate() {
            all.extend(group[i + 1..].iter().map(|(_, b)| [*a, *b]));
        }
    }
    all.sort_unstable();
    let pairs = all.chunk_by(|a, b| a == b);
    let mut counted: Vec<(usize, [usize; 2])> = pairs.map(|pair| (pair.len(), pair[0])).collect();
    counted.sort_unstable_by_key(|(count, both)| (Reverse(*count), *both));
    counted.into_iter().map(|(_, both)| both).collect()
}

/// The fewest tokens of a passage that looks pasted from the grader: the grader has so much code
/// that a shorter run may be equal by chance.
pub const PASTED: usize = 60;

/// The long passages that students have in common with the code of the grader, which is each stage
/// of `grader`. The students with the largest shares come first; at most `most` are kept, and how
/// many there are is returned, too.
pub fn pasted(grader: &Student, students: &[Student], most: usize) -> (Vec<Pair>, usize) {
    let found = students.iter().enumerate().filter_map(|(i, student)| {
        let common = with_the_grader(student, grader);
        (!common.stages.is_empty()).then(|| (i, common.share()))
    });
    let mut found: Vec<(usize, f64)> = found.collect();
    let name = |i: usize| &students[i].name;
    found.sort_by(|(a, share_a), (b, share_b)| {
        share_b.total_cmp(share_a).then(name(*a).cmp(name(*b)))
    });
    let shown = found.iter().take(most);
    let shown = shown.map(|(i, _)| with_the_grader(&students[*i], grader).shown());
    (shown.collect(), found.len())
}

fn with_the_grader<'a>(student: &'a Student, grader: &'a Student) -> CommonCode<'a> {
    let mut common = compare([student, grader], 2, |_, _, _| 0);
    for stage in &mut common.stages {
        stage
            .passages
            .retain(|(passage, _)| passage.length >= PASTED);
    }
    common.stages.retain(|stage| !stage.passages.is_empty());
    common
}

pub(super) fn is_few(owners: usize) -> bool {
    (2..=SHARED_BY_FEW).contains(&owners)
}

/// The code that two students have in common.
struct CommonCode<'a> {
    students: [&'a Student; 2],
    stages: Vec<CommonStage<'a>>,
    expected: f64,
}

/// The same of one stage.
struct CommonStage<'a> {
    stage: &'a str,
    sources: [&'a Source; 2],
    /// The passages, and how many others have each.
    passages: Vec<(Passage, usize)>,
    share: f64,
}

impl CommonCode<'_> {
    fn share(&self) -> f64 {
        let shares = self.stages.iter().map(|stage| stage.share);
        shares.fold(0.0, f64::max)
    }

    fn shown(&self) -> Pair {
        Pair {
            names: self.students.map(|student| student.name.clone()),
            stages: self.stages.iter().map(CommonStage::shown).collect(),
            expected: self.expected,
        }
    }
}

impl CommonStage<'_> {
    fn tokens(&self) -> usize {
        let lengths = self.passages.iter().map(|(passage, _)| passage.length);
        lengths.sum()
    }

    fn shown(&self) -> SharedStage {
        let mut longest: Vec<&(Passage, usize)> = self.passages.iter().collect();
        longest.sort_by_key(|(passage, _)| (Reverse(passage.length), passage.starts));
        longest.truncate(SHOWN);
        longest.sort_by_key(|(passage, _)| passage.starts);
        let [one, other] = self.sources;
        let passages = longest.into_iter().map(|(passage, others)| SharedPassage {
            excerpts: [
                one.excerpt(passage.starts[0], passage.length),
                other.excerpt(passage.starts[1], passage.length),
            ],
            tokens: passage.length,
            has_same_names: one.text.has_same_names(&other.text, passage),
            others: *others,
        });
        SharedStage {
            stage: self.stage.to_string(),
            share: self.share,
            passages: passages.collect(),
            more: self.passages.len().saturating_sub(SHOWN),
        }
    }
}

fn compare_both<'a>(
    students: &'a [Student],
    owners: &Owners<'_>,
    both: [usize; 2],
) -> CommonCode<'a> {
    compare(
        both.map(|i| &students[i]),
        students.len(),
        |stage, one, passage| others(owners, both, stage, one, passage),
    )
}

/// How many students have a passage of `stage` besides the two students `both`. `one` is the code
/// of the first of them.
fn others(
    owners: &Owners<'_>,
    both: [usize; 2],
    stage: &str,
    one: &Source,
    passage: &Passage,
) -> usize {
    let [start, _] = passage.starts;
    let hashes = one.text.fingerprints_in(start, passage.length);
    // At the ends of a passage, the fingerprint of one is not that of the other.
    let owners = hashes.map(|hash| (hash, owners.of(stage, hash)));
    let of_both = owners.filter(|(hash, owners)| {
        both.iter()
            .all(|i| owners.binary_search(&(*hash, *i)).is_ok())
    });
    of_both
        .map(|(_, owners)| owners.len() - 2)
        .min()
        .unwrap_or(0)
}

/// What `a` and `b`, two of `students` students, have in common. `others` returns how many others
/// have a passage: its arguments are the stage, the code of `a` and the passage.
fn compare<'a>(
    [a, b]: [&'a Student; 2],
    students: usize,
    others: impl Fn(&str, &Source, &Passage) -> usize,
) -> CommonCode<'a> {
    let n = students as f64;
    let mut expected = n * (n - 1.0) / 2.0;
    let mut stages = Vec::new();
    for (stage, one) in &a.stages {
        let Some(other) = b.stages.get(stage) else {
            continue;
        };
        let common = one.text.common(&other.text).into_iter();
        let passages = common.map(|passage| {
            let others = others(stage, one, &passage);
            (passage, others)
        });
        let passages: Vec<(Passage, usize)> = passages.collect();
        for (_, others) in &passages {
            expected *= (*others as f64 + 0.5) / (n - 1.0);
        }
        let shorter = one.text.own().min(other.text.own());
        let rare: usize = passages
            .iter()
            .filter(|(_, others)| is_few(others + 2))
            .map(|(passage, _)| passage.length)
            .sum();
        let share = if shorter < SMALLEST {
            0.0
        } else {
            rare as f64 / shorter as f64
        };
        if !passages.is_empty() {
            stages.push(CommonStage {
                stage,
                sources: [one, other],
                passages,
                share: share.min(1.0),
            });
        }
    }
    CommonCode {
        students: [a, b],
        stages,
        expected,
    }
}
