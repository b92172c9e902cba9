//! Who of a class has each fingerprint.

use super::pairs::Student;
use std::collections::{BTreeMap, BTreeSet};

/// The fingerprints of each stage, each with the number of a student who has it, sorted; of those
/// who hand in together the first one.
#[derive(Clone, Debug)]
pub struct Owners<'a>(BTreeMap<&'a str, Vec<(u64, usize)>>);

impl<'a> Owners<'a> {
    /// Those of a class.
    pub fn new(students: &'a [Student]) -> Owners<'a> {
        let mut stages: BTreeMap<&str, Vec<(u64, usize)>> = BTreeMap::new();
        for (i, student) in students.iter().enumerate() {
            for (stage, source) in &student.stages {
                let of_student = source.text.fingerprints().map(|hash| (hash, i));
                stages.entry(stage).or_default().extend(of_student);
            }
        }
        for all in stages.values_mut() {
            all.sort_unstable();
            let mut seen = BTreeSet::new();
            all.retain(|(hash, i)| {
                let owner = students[*i].owner;
                owner.is_none_or(|owner| seen.insert((*hash, owner)))
            });
        }
        Owners(stages)
    }

    /// Each fingerprint: its stage, and an entry for each student who has it.
    pub(super) fn groups(&self) -> impl Iterator<Item = (&'a str, &[(u64, usize)])> {
        self.0.iter().flat_map(|(stage, all)| {
            let groups = all.chunk_by(|(a, _), (b, _)| a == b);
            groups.map(|group| (*stage, group))
        })
    }

    /// The entries of one fingerprint.
    pub(super) fn of(&self, stage: &str, hash: u64) -> &[(u64, usize)] {
        let all: &[(u64, usize)] = self.0.get(stage).map_or(&[], Vec::as_slice);
        let start = all.partition_point(|(other, _)| *other < hash);
        let length = all[start..].partition_point(|(other, _)| *other == hash);
        &all[start..start + length]
    }
}
