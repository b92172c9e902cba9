//! What too many submissions have in common to be asked about one by one.

use super::owners::Owners;
use super::pairs::{SHARED_BY_FEW, Student};
use std::cmp::Reverse;
use std::collections::{BTreeMap, BTreeSet};
use submission::Untrusted;
use submission::code::passages::Passage;
use submission::code::source::Excerpt;

/// A passage, and who has it.
#[derive(Clone, Debug, PartialEq)]
pub struct Common {
    /// The stage.
    pub stage: String,
    /// Who has it, in the order of the class.
    pub names: Vec<Untrusted>,
    /// It in the code of the first.
    pub excerpt: Excerpt,
}

/// How many groups of students are looked at for each passage that may be shown. Two who hand in
/// everybody's code make thousands of groups, with their own long code in each.
const LOOKED_AT: usize = 20;

/// The passages that most students have in common, at most `most`, and how many groups of students
/// were not looked at.
pub fn common(students: &[Student], owners: &Owners<'_>, most: usize) -> (Vec<Common>, usize) {
    let mut groups: BTreeMap<(&str, Vec<usize>), BTreeSet<u64>> = BTreeMap::new();
    let of_many = owners
        .groups()
        .filter(|(_, group)| group.len() > SHARED_BY_FEW);
    for (stage, group) in of_many {
        let members = group.iter().map(|(_, i)| *i).collect();
        let hashes = groups.entry((stage, members)).or_default();
        hashes.insert(group[0].0);
    }
    let mut groups: Vec<_> = groups.into_iter().collect();
    groups.sort_by_key(|((_, group), _)| Reverse(group.len()));
    let mut common = Vec::new();
    let mut told: BTreeSet<(&str, u64)> = BTreeSet::new();
    let all = groups.len();
    for (looked_at, ((stage, group), hashes)) in groups.into_iter().enumerate() {
        if common.len() == most || looked_at == most * LOOKED_AT {
            return (common, all - looked_at);
        }
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
    (common, 0)
}
