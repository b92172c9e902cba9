//! The type of a case, and the tools to make cases that several tasks use.
//!
//! `course.toml` lists the cases that count and their points; the folder of their task, in `tasks`,
//! defines them. Every case is the same on every machine; random cases depend on a seed alone.

pub(crate) mod crosses;
pub mod probes;
pub mod recorded;
mod single_call;
pub(crate) mod tree_plan;

use crate::expected_cache::ExpectedCache;
use crate::tally::Aspect;
use crate::tasks;
use std::sync::Arc;
use wire::Work;

/// One case of one task.
#[derive(Clone, Debug)]
pub struct Spec {
    /// Key of the task.
    pub task: &'static str,
    /// Name, as in `course.toml`.
    pub name: &'static str,
    /// What is checked, in a sentence for students; after [`PITFALL`], what a naive formula does
    /// there. [`checked`] returns the part without the hint.
    pub about: &'static str,
    /// The work of the worker.
    pub work: Work,
    /// Width and height, if the answers are the pixels of a picture, row by row from the bottom
    /// left.
    pub picture: Option<[u32; 2]>,
    /// Whether the shapes enclose the origin of every ray, so that a miss is never right.
    pub enclosed: bool,
    /// The aspects that the case judges; empty for all aspects of its answers. So a mistake that
    /// shows in every case is reported only in the cases that are about it.
    pub about_aspects: &'static [Aspect],
    /// The main answers of the case, if they are not those of `Spec::is_main`'s rule.
    pub main_aspects: &'static [Aspect],
    /// The exact results, as far as they have been computed.
    pub(crate) expected_cache: Arc<ExpectedCache>,
}

/// Separates what a case checks from the mistake that its sentence names.
pub const PITFALL: &str = " Pitfall: ";

/// The part of the sentence `about` that names no mistake.
pub fn checked(about: &str) -> &str {
    about
        .split_once(PITFALL)
        .map_or(about, |(checked, _)| checked)
}

impl Spec {
    /// The case `name` of `task`, without a picture; `about` is for students.
    pub(crate) fn new(
        task: &'static str,
        name: &'static str,
        about: &'static str,
        work: Work,
    ) -> Spec {
        Spec {
            task,
            name,
            about,
            work,
            picture: None,
            enclosed: false,
            about_aspects: &[],
            main_aspects: &[],
            expected_cache: Arc::default(),
        }
    }

    /// The same case, judged on these aspects only.
    pub(crate) fn only(self, about_aspects: &'static [Aspect]) -> Spec {
        Spec {
            about_aspects,
            ..self
        }
    }

    /// The same case with these main answers.
    pub(crate) fn mainly(self, main_aspects: &'static [Aspect]) -> Spec {
        Spec {
            main_aspects,
            ..self
        }
    }

    /// Whether `aspect` is a main answer: if it is wrong, the case gives no points.
    ///
    /// Main are those of the aspects that the case is about that are main in all work of its kind,
    /// such as the positions of samples; if there are none, the first that the case is about.
    /// Wherever hit or miss is judged it is main, since without it nothing else means much.
    pub(crate) fn is_main(&self, aspect: Aspect) -> bool {
        if aspect == Aspect::HitOrMiss || !self.main_aspects.is_empty() {
            return aspect == Aspect::HitOrMiss || self.main_aspects.contains(&aspect);
        }
        let of_kind = tasks::check_of(&self.work).main();
        let about = self.about_aspects;
        match about.first() {
            Some(first) if about.iter().all(|aspect| !of_kind.contains(aspect)) => aspect == *first,
            _ => of_kind.contains(&aspect),
        }
    }

    /// Whether this is the case `name` of `task`.
    pub fn is(&self, task: &str, name: &str) -> bool {
        self.task == task && self.name == name
    }

    /// Whether the case traces rays through all intersection stages, not only the task's own stage.
    pub fn needs_all_stages(&self) -> bool {
        tasks::check_of(&self.work).needs_all_stages()
    }

    /// The case in the form that the worker gets.
    pub fn case(&self) -> wire::Case {
        wire::Case {
            task: self.task.into(),
            name: self.name.into(),
            limit_ms: tasks::check_of(&self.work).limit_ms(),
            work: self.work.clone(),
        }
    }
}

/// All cases of all tasks.
pub fn all(seed: u64) -> Vec<Spec> {
    tasks::cases(seed, |_| true)
}

/// All cases of one task; the others are not made.
pub fn of(task: &str, seed: u64) -> Vec<Spec> {
    tasks::cases(seed, |key| key == task)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_seed_changes_only_the_fresh_cases_of_part_1() {
        // As text, in which NaN equals itself.
        let text = |spec: &Spec| format!("{:?}", spec.work);
        let (all_0, again, all_1) = (all(0), all(0), all(1));
        for ((a, b), other) in all_0.iter().zip(&again).zip(&all_1) {
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
        for spec in all(0) {
            let Some([w, h]) = spec.picture else { continue };
            let answers = tasks::check_of(&spec.work).calls();
            assert_eq!(answers, (w * h) as usize, "{} {}", spec.task, spec.name);
        }
    }

    #[test]
    fn what_is_checked_names_no_mistake() {
        for spec in all(0) {
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
        let mut names: Vec<_> = all(0).iter().map(|spec| (spec.task, spec.name)).collect();
        names.sort_unstable();
        let count = names.len();
        names.dedup();
        assert_eq!(names.len(), count);
    }
}
