//! Which cases have other inputs than those that the known mistakes were recorded with.

use crate::signature::Signature;
use judge::cases::{self, Spec};
use std::collections::BTreeSet;
use wire::file::work_to_bytes;

/// `grader mutants --bless` records the known mistakes with this seed.
const RECORDED_SEED: u64 = 0;

/// The cases of a task whose inputs depend on the seed. For another seed the wrong answers to them
/// cannot be compared with those of known mistakes, call by call.
#[derive(Clone, Debug, Default)]
pub(crate) struct FreshCases(BTreeSet<&'static str>);

impl FreshCases {
    /// Those of `task` among `specs`, which were made with `seed`.
    pub(crate) fn of(task: &str, specs: &[Spec], seed: u64) -> FreshCases {
        if seed == RECORDED_SEED {
            return FreshCases::default();
        }
        let recorded = cases::of(task, RECORDED_SEED);
        let is_fresh = |spec: &&Spec| {
            let before = recorded.iter().find(|before| before.name == spec.name);
            // As bytes, in which a NaN equals a NaN.
            let bytes = |spec: &Spec| work_to_bytes(&spec.work);
            before.is_none_or(|before| bytes(before) != bytes(spec))
        };
        let of_task = specs.iter().filter(|spec| spec.task == task);
        FreshCases(of_task.filter(is_fresh).map(|spec| spec.name).collect())
    }

    /// `signature` without these cases.
    pub(crate) fn removed_from(&self, signature: &Signature) -> Signature {
        signature.without(&self.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_inputs_that_the_seed_draws_are_fresh() {
        let names = |seed| FreshCases::of("part1.task3", &cases::all(seed), seed).0;
        assert!(names(RECORDED_SEED).is_empty());
        let fresh = names(7);
        assert!(fresh.contains("fresh_triangles"), "{fresh:?}");
        // It has a NaN, which differs from itself as a number.
        for fixed in ["front_face", "not_a_number", "picture_of_a_ring"] {
            assert!(!fresh.contains(fixed), "{fresh:?}");
        }
    }
}
