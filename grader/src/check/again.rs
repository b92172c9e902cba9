//! Grades the tasks again whose answers can have changed, and shows each task as soon as it is
//! certain what to show.

use super::finding::Finding;
use super::stored::{StoredFindings, only_with_others};
use crate::course::Task;
use base::GraderError;

/// A task of which to show what is wrong.
#[derive(Clone, Debug)]
pub struct Asked<'a> {
    /// The task.
    pub task: &'a Task,
    /// The code that it is graded with, as a hash; `None` if there is nothing to grade.
    pub code: Option<String>,
}

/// Who grades and who sees what is wrong.
pub trait Desk {
    /// Grades `tasks` in this order, and calls `done` after each.
    fn grade(&self, tasks: &[&Task], done: &mut Done<'_>) -> Result<(), GraderError>;

    /// Shows a task with what is wrong in it.
    fn show(&self, task: &Task, findings: &[Finding]) -> Result<(), GraderError>;

    /// Stores the findings: the next run may be the one after an editor ended this one.
    fn store(&self, findings: &StoredFindings) -> Result<(), GraderError>;
}

/// Gets each task that was graded, with what is wrong in it.
pub type Done<'a> = dyn FnMut(&Task, Vec<Finding>) -> Result<(), GraderError> + 'a;

/// Shows what is wrong in the tasks `asked`: at first in those that `stored` knows with their code,
/// then in each of the others when it is graded, and last where it depends on the other tasks. A
/// task in which a call did not end the last time is graded last. Returns whether nothing is wrong.
pub fn run(
    asked: &[Asked<'_>],
    stored: &mut StoredFindings,
    desk: &impl Desk,
) -> Result<bool, GraderError> {
    let code = |task: &Task| {
        let mut asked = asked.iter().filter(|asked| asked.task.key == task.key);
        asked.find_map(|asked| asked.code.clone())
    };
    let is_known = |asked: &&Asked<'_>| {
        let code = asked.code.as_ref();
        code.is_none_or(|code| stored.knows(&asked.task.key, code))
    };
    let (known, changed): (Vec<_>, Vec<_>) = asked.iter().partition(is_known);
    let mut waiting = Vec::new();
    for Asked { task, code } in known {
        let findings = code
            .as_ref()
            .map(|_| stored.of_task(&task.key))
            .unwrap_or_default();
        match only_with_others(findings) {
            true => waiting.push(*task),
            false => desk.show(task, findings)?,
        }
    }
    let mut changed: Vec<&Task> = changed.iter().map(|asked| asked.task).collect();
    let was_endless = |task: &&Task| stored.of_task(&task.key).iter().any(|of| of.is_endless);
    changed.sort_by_key(was_endless);
    if !changed.is_empty() {
        desk.grade(&changed, &mut |task, findings| {
            match only_with_others(&findings) {
                true => waiting.extend(changed.iter().find(|other| other.key == task.key)),
                false => desk.show(task, &findings)?,
            }
            stored.set(&task.key, &code(task).unwrap_or_default(), findings);
            desk.store(stored)
        })?;
    }
    let attempted: Vec<&str> = asked
        .iter()
        .filter(|asked| asked.code.is_some())
        .map(|asked| asked.task.key.as_str())
        .collect();
    let findings = stored.of_tasks(&attempted);
    for task in waiting {
        desk.show(
            task,
            findings.get(task.key.as_str()).copied().unwrap_or_default(),
        )?;
    }
    Ok(findings.is_empty())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::course::Course;
    use std::cell::RefCell;
    use std::collections::BTreeMap;

    /// Grades by a list of what is wrong, and notes what happens.
    #[derive(Default)]
    struct FakeDesk {
        wrong: BTreeMap<&'static str, Finding>,
        happened: RefCell<Vec<String>>,
    }

    impl Desk for FakeDesk {
        fn grade(&self, tasks: &[&Task], done: &mut Done<'_>) -> Result<(), GraderError> {
            for task in tasks {
                let graded = format!("grades {}", task.key);
                self.happened.borrow_mut().push(graded);
                done(
                    task,
                    self.wrong
                        .get(task.key.as_str())
                        .cloned()
                        .into_iter()
                        .collect(),
                )?;
            }
            Ok(())
        }

        fn show(&self, task: &Task, findings: &[Finding]) -> Result<(), GraderError> {
            let wrong = findings.first().map_or("right", |_| "wrong");
            let shown = format!("{} {wrong}", task.key);
            self.happened.borrow_mut().push(shown);
            Ok(())
        }

        fn store(&self, _: &StoredFindings) -> Result<(), GraderError> {
            Ok(())
        }
    }

    const TASKS: [&str; 4] = ["part1.task3", "part1.task4", "part2.task2", "part2.task3"];

    /// What happens if the tasks have these codes.
    fn happens(
        wrong: &[(&'static str, Finding)],
        codes: [&str; 4],
        stored: &mut StoredFindings,
    ) -> Vec<String> {
        let text = include_str!("../../../stages/course.toml");
        let course = Course::parse(text).expect("it is valid");
        let tasks = course.tasks().filter(|task| TASKS.contains(&&*task.key));
        let asked = tasks.zip(codes).map(|(task, code)| Asked {
            task,
            code: Some(code.to_owned()),
        });
        let desk = FakeDesk {
            wrong: wrong.iter().cloned().collect(),
            ..FakeDesk::default()
        };
        let asked: Vec<Asked<'_>> = asked.collect();
        run(&asked, stored, &desk).expect("it is graded");
        desk.happened.into_inner()
    }

    fn shown(happened: &[String]) -> Vec<&String> {
        let mut shown: Vec<&String> = happened
            .iter()
            .filter(|what| !what.starts_with("grades"))
            .collect();
        shown.sort();
        shown
    }

    #[test]
    fn only_changed_tasks_are_graded_and_the_same_is_shown_as_of_all() {
        let alone = || Finding::for_tests(false);
        let with_others = || Finding::for_tests(true);
        for wrong in [
            vec![("part1.task3", alone()), ("part2.task3", with_others())],
            vec![("part2.task3", with_others())],
            vec![("part1.task4", alone()), ("part2.task2", alone())],
        ] {
            let mut stored = StoredFindings::default();
            // Before the mistakes.
            happens(&[], ["0"; 4], &mut stored);
            let codes = ["1", "1", "1", "1"];
            let all = happens(&wrong, codes, &mut StoredFindings::default());
            happens(&wrong, codes, &mut stored);
            // Another stage changes and changes back.
            for code in ["2", "1"] {
                let some = happens(&wrong, ["1", "1", code, "1"], &mut stored);
                let graded = some.iter().filter(|what| what.starts_with("grades"));
                assert_eq!(Vec::from_iter(graded), ["grades part2.task2"]);
                assert_eq!(shown(&some), shown(&all));
            }
        }
    }

    #[test]
    fn what_is_known_is_shown_first_and_an_endless_loop_is_waited_for_last() {
        let mut endless = Finding::for_tests(false);
        endless.is_endless = true;
        let wrong = [
            ("part1.task3", endless),
            ("part2.task2", Finding::for_tests(false)),
        ];
        let mut stored = StoredFindings::default();
        happens(&wrong, ["1", "1", "1", "1"], &mut stored);
        let next = happens(&wrong, ["2", "2", "1", "1"], &mut stored);
        let expected = [
            "part2.task2 wrong",
            "part2.task3 right",
            "grades part1.task4",
            "part1.task4 right",
            "grades part1.task3",
            "part1.task3 wrong",
        ];
        assert_eq!(next, expected);
    }
}
