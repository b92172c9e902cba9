//! The cases of all tasks.
//!
//! `course.toml` lists the cases that count and their points; the folder of their task, in `tasks`,
//! defines them. Every case is the same on every machine; random cases depend on a seed alone, and
//! so do the moves of all others.

use super::own_cases;
use crate::tasks;

pub use crate::tools::questions::probes;
pub use crate::tools::recorded;
pub use crate::tools::spec::{KNOWN_SEED, PITFALL, Spec, checked};

/// All cases of all tasks.
pub fn all(seed: u64) -> Vec<Spec> {
    wanted(seed, |_| true)
}

/// All cases of one task; the others are not made.
pub fn of(task: &str, seed: u64) -> Vec<Spec> {
    of_tasks(&[task], seed)
}

/// All cases of the tasks with these keys; the others are not made.
pub fn of_tasks(tasks: &[&str], seed: u64) -> Vec<Spec> {
    wanted(seed, |key| tasks.contains(&key))
}

/// First Light's cases of the tasks whose keys `is_wanted`, then those of a teacher.
fn wanted(seed: u64, is_wanted: impl Fn(&str) -> bool) -> Vec<Spec> {
    let mut cases = tasks::cases(seed, &is_wanted);
    cases.extend(own_cases::cases(seed, is_wanted));
    cases
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tools::Tier;
    use crate::tools::aspects::chance::{MAX_TESTS, MIN_ESTIMATES};
    use crate::tools::aspects::independence::MIN_PAIRS;
    use crate::tools::shown::ShownCall;
    use crate::tools::truth::expected::HitOrMiss;
    use std::sync::LazyLock;
    use wire::Work;

    static SPECS: LazyLock<Vec<Spec>> = LazyLock::new(|| all(0));

    #[test]
    fn a_seed_changes_only_the_fresh_cases_of_part_1() {
        // As text, in which NaN equals itself.
        let text = |spec: &Spec| format!("{:?}", spec.work);
        let (again, all_1) = (all(0), all(1));
        for ((a, b), other) in SPECS.iter().zip(&again).zip(&all_1) {
            let name = format!("{} {}", a.task, a.name);
            assert!(text(a) == text(b), "{name}");
            if a.task.starts_with("part1") {
                assert_eq!(
                    text(a) != text(other),
                    a.name.starts_with("fresh"),
                    "{name}"
                );
            }
        }
    }

    #[test]
    fn the_cases_of_a_task_are_those_of_all_tasks_that_have_its_key() {
        let all = all(3);
        let tasks: std::collections::BTreeSet<&str> = all.iter().map(|spec| spec.task).collect();
        for task in tasks {
            let names = |specs: &[Spec]| -> Vec<String> {
                let of_task = specs.iter().filter(|spec| spec.task == task);
                of_task
                    .map(|spec| format!("{} {:?}", spec.name, spec.work))
                    .collect()
            };
            let own = of(task, 3);
            assert_eq!(names(&own).len(), own.len(), "{task}");
            assert!(names(&own) == names(&all), "{task}");
        }
    }

    #[test]
    fn pictures_have_an_answer_for_each_pixel() {
        for spec in SPECS.iter() {
            let Some([w, h]) = spec.picture else { continue };
            let answers = spec.calls();
            assert_eq!(answers, (w * h) as usize, "{} {}", spec.task, spec.name);
        }
    }

    #[test]
    fn what_is_checked_names_no_mistake() {
        for spec in SPECS.iter() {
            let shown = checked(spec.about);
            let name = format!("{} {}: {shown}", spec.task, spec.name);
            assert!(shown.len() > 10, "{name}");
            for word in ["itfall", "whoever", "instead", "epsilon"] {
                assert!(!shown.contains(word), "{name}");
            }
        }
    }

    #[test]
    fn names_are_unique_in_a_task() {
        let mut names: Vec<_> = SPECS.iter().map(|spec| (spec.task, spec.name)).collect();
        names.sort_unstable();
        let count = names.len();
        names.dedup();
        assert_eq!(names.len(), count);
    }

    #[test]
    fn a_run_makes_at_most_max_tests() {
        let by_chance = |spec: &Spec| match &spec.work {
            Work::Lambert(probes) => probes.len() >= MIN_ESTIMATES,
            Work::Direct(work) => work.points.len() >= MIN_ESTIMATES,
            Work::Specular(calls) => calls.len() >= MIN_ESTIMATES,
            Work::Roulette(work) => work.numbers.len() >= MIN_ESTIMATES,
            Work::Pixels(work) => work.ns_aa > 1 && work.calls().count() > MIN_PAIRS,
            Work::AdaptivePixels(pixels) => pixels.len() > MIN_PAIRS,
            _ => false,
        };
        // No case makes more than four statistical tests.
        let tests = 4 * SPECS.iter().filter(|spec| by_chance(spec)).count();
        assert!((20..=MAX_TESTS).contains(&tests), "{tests}");
    }

    #[test]
    fn a_single_call_is_that_call_of_the_case() {
        let text = |work: &wire::Work| format!("{work:?}");
        let mut cut = 0;
        for spec in SPECS.iter() {
            assert!(spec.only_call(spec.calls()).is_none(), "{}", spec.name);
            let Some(alone) = spec.only_call(spec.calls() - 1) else {
                continue;
            };
            cut += 1;
            assert_eq!(alone.calls(), 1, "{} {}", spec.task, spec.name);
            // The last call of what is left of it is itself.
            let again = alone.only_call(0).expect("it has a call");
            assert_eq!(text(&again.work), text(&alone.work));
            assert!(spec.calls() == 1 || text(&spec.work) != text(&alone.work));
        }
        assert!(cut > 100, "{cut}");
    }

    #[test]
    fn every_call_of_a_graded_case_has_an_input() {
        for spec in SPECS.iter() {
            let is_timed = matches!(spec.work, Work::BuildGrowth(_));
            let last = spec.input(spec.calls() - 1);
            assert_eq!(last.is_some(), !is_timed, "{} {}", spec.task, spec.name);
            let is_one_input = matches!(spec.work, Work::Build(_));
            assert_eq!(spec.input(usize::MAX - 1).is_some(), is_one_input);
        }
    }

    #[test]
    fn circumstances_are_those_of_the_call() {
        let spec = SPECS
            .iter()
            .find(|spec| spec.is("part2.task2", "origin_inside"))
            .expect("the case exists");
        let found = spec.circumstances(0).expect("it is known of boxes");
        assert!(
            found.contains(&"the ray starts inside the box"),
            "{found:?}"
        );
        assert!(!found.contains(&"the ray starts outside the box"));
        assert_eq!(spec.circumstances(spec.calls()), None);
    }

    #[test]
    fn rays_at_shapes_are_shown_with_their_expected_hits() {
        let mut rays = 0;
        for spec in SPECS.iter() {
            let Some(ShownCall::Ray(shown)) = spec.shown(Tier::Core, 0, None) else {
                continue;
            };
            rays += 1;
            let name = format!("{} {}", spec.task, spec.name);
            assert!(shown.yours.is_empty(), "{name}");
            assert!(shown.rows.iter().all(|row| !row.is_right), "{name}");
            if shown.decision == HitOrMiss::Hit {
                assert!(!shown.expected.is_empty(), "{name}");
            }
            assert!(spec.shown(Tier::Core, spec.calls(), None).is_none());
        }
        assert!(rays > 50, "{rays}");
    }
}
