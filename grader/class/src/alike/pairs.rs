//! Which submissions of a class have passages in common, and how many would by chance.
//!
//! As in [`crate::likeness`], chance is estimated from the class. If `c` of the `n - 2` other
//! students have a passage as well, another student has it with probability
//! `(c + 1/2) / (n - 1)`; the passages of a pair count as independent, so `n (n - 1) / 2` times the
//! product of their probabilities is how many pairs would be expected to have all of them.

use std::cmp::Reverse;
use std::collections::{BTreeMap, BTreeSet};
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
const SHARED_BY_FEW: usize = 4;

/// A student, and the code of each stage that was handed in.
#[derive(Clone, Debug)]
pub struct Student {
    /// The name.
    pub name: Untrusted,
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
    /// The passages, in the order of the first student's code.
    pub passages: Vec<SharedPassage>,
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

impl Pair {
    /// The largest share of a stage.
    pub fn share(&self) -> f64 {
        self.stages
            .iter()
            .fold(0.0, |most, stage| stage.share.max(most))
    }
}

/// The pairs to look at, those with the largest shares first.
pub fn pairs(students: &[Student]) -> Vec<Pair> {
    let owners = owners(students);
    let mut candidates: BTreeSet<[usize; 2]> = BTreeSet::new();
    for owners in owners.values().filter(|owners| is_few(owners.len())) {
        let owners: Vec<usize> = owners.iter().copied().collect();
        for (i, a) in owners.iter().enumerate() {
            candidates.extend(owners[i + 1..].iter().map(|b| [*a, *b]));
        }
    }
    let all = candidates.into_iter().map(|both| {
        let [a, b] = both.map(|i| &students[i]);
        pair([a, b], students.len(), |stage, one, passage| {
            others(&owners, both, stage, one, passage)
        })
    });
    let mut listed: Vec<Pair> = all
        .filter(|pair| pair.expected < EXPECTED || pair.share() >= LARGE_SHARE)
        .collect();
    listed.sort_by(|a, b| {
        let share = b.share().total_cmp(&a.share());
        share
            .then(a.expected.total_cmp(&b.expected))
            .then(a.names.cmp(&b.names))
    });
    listed
}

/// The fewest tokens of a passage that looks pasted from the grader: the grader has so much code
/// that a shorter run may be equal by chance.
pub const PASTED: usize = 60;

/// The long passages that students have in common with the code of the grader, which is each stage
/// of `grader`. The students with the largest shares come first.
pub fn pasted(grader: &Student, students: &[Student]) -> Vec<Pair> {
    let with_passages = students.iter().filter_map(|student| {
        let mut pair = pair([student, grader], 2, |_, _, _| 0);
        for stage in &mut pair.stages {
            stage.passages.retain(|passage| passage.tokens >= PASTED);
        }
        pair.stages.retain(|stage| !stage.passages.is_empty());
        (!pair.stages.is_empty()).then_some(pair)
    });
    let mut pasted: Vec<Pair> = with_passages.collect();
    pasted.sort_by(|a, b| b.share().total_cmp(&a.share()).then(a.names.cmp(&b.names)));
    pasted
}

/// Who has each fingerprint of each stage.
type Owners<'a> = BTreeMap<(&'a str, u64), BTreeSet<usize>>;

fn owners(students: &[Student]) -> Owners<'_> {
    let mut owners = Owners::new();
    for (i, student) in students.iter().enumerate() {
        for (stage, source) in &student.stages {
            for hash in source.text.fingerprints() {
                owners.entry((stage, hash)).or_default().insert(i);
            }
        }
    }
    owners
}

fn is_few(owners: usize) -> bool {
    (2..=SHARED_BY_FEW).contains(&owners)
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
    let owners = hashes.filter_map(|hash| owners.get(&(stage, hash)));
    let of_both = owners.filter(|owners| both.iter().all(|i| owners.contains(i)));
    of_both.map(|owners| owners.len() - 2).min().unwrap_or(0)
}

/// What `a` and `b`, two of `students` students, have in common. `others` returns how many others
/// have a passage: its arguments are the stage, the code of `a` and the passage.
fn pair(
    [a, b]: [&Student; 2],
    students: usize,
    others: impl Fn(&str, &Source, &Passage) -> usize,
) -> Pair {
    let n = students as f64;
    let mut expected = n * (n - 1.0) / 2.0;
    let mut stages = Vec::new();
    for (stage, one) in &a.stages {
        let Some(other) = b.stages.get(stage) else {
            continue;
        };
        let mut passages = Vec::new();
        for passage in one.text.common(&other.text) {
            let others = others(stage, one, &passage);
            expected *= (others as f64 + 0.5) / (n - 1.0);
            passages.push(SharedPassage {
                excerpts: [
                    one.excerpt(passage.starts[0], passage.length),
                    other.excerpt(passage.starts[1], passage.length),
                ],
                tokens: passage.length,
                has_same_names: one.text.has_same_names(&other.text, &passage),
                others,
            });
        }
        let shorter = one.text.own().min(other.text.own());
        let rare = passages.iter().filter(|passage| is_few(passage.others + 2));
        let rare: usize = rare.map(|passage| passage.tokens).sum();
        let share = if shorter < SMALLEST {
            0.0
        } else {
            rare as f64 / shorter as f64
        };
        if !passages.is_empty() {
            stages.push(SharedStage {
                stage: stage.clone(),
                share: share.min(1.0),
                passages,
            });
        }
    }
    Pair {
        names: [a.name.clone(), b.name.clone()],
        stages,
        expected,
    }
}

/// Passages that too many students have to be asked about one by one.
#[derive(Clone, Debug, PartialEq)]
pub struct Common {
    /// The stage.
    pub stage: String,
    /// Who has them, in the order of the class.
    pub names: Vec<Untrusted>,
    /// One of them, in the code of the first.
    pub excerpt: Excerpt,
}

/// What many students have in common, the largest groups first.
pub fn common(students: &[Student]) -> Vec<Common> {
    let mut groups: BTreeMap<(&str, Vec<usize>), BTreeSet<u64>> = BTreeMap::new();
    for ((stage, hash), owners) in owners(students) {
        if owners.len() > SHARED_BY_FEW {
            let group = groups.entry((stage, owners.into_iter().collect()));
            group.or_default().insert(hash);
        }
    }
    let mut groups: Vec<_> = groups.into_iter().collect();
    groups.sort_by_key(|((_, group), _)| Reverse(group.len()));
    let mut common = Vec::new();
    let mut told: BTreeSet<(&str, u64)> = BTreeSet::new();
    for ((stage, group), hashes) in groups {
        let [first, second] = [group[0], group[1]].map(|i| &students[i].stages[stage]);
        let fingerprints = |passage: &Passage| -> Vec<u64> {
            let inside = first
                .text
                .fingerprints_in(passage.starts[0], passage.length);
            inside.collect()
        };
        let passages = first.text.common(&second.text).into_iter();
        let of_group = passages.filter(|passage| {
            fingerprints(passage)
                .iter()
                .any(|hash| hashes.contains(hash))
        });
        let Some(longest) = of_group.max_by_key(|passage| passage.length) else {
            continue;
        };
        // Where some of a group go on in the same way, the passage of the group is enough.
        let is_told = |hash: &u64| told.contains(&(stage, *hash));
        if !fingerprints(&longest).iter().any(is_told) {
            common.push(Common {
                stage: stage.to_string(),
                names: group.iter().map(|i| students[*i].name.clone()).collect(),
                excerpt: first.excerpt(longest.starts[0], longest.length),
            });
            told.extend(hashes.iter().map(|hash| (stage, *hash)));
        }
    }
    common
}
