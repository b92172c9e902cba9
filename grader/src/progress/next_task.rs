//! The next open task: what bare `grader` grades, and what a report of full marks ends with.

use crate::course::sources::{self, Place};
use crate::course::{Course, Task};
use crate::progress::results::{self, Results, TaskScore};
use base::{GraderError, Workspace};

/// What is known of a task without building anything.
#[derive(Clone, Debug, PartialEq)]
pub struct Known {
    /// Where it is written.
    pub place: Place,
    /// Its last result, if it was graded.
    pub last: Option<TaskScore>,
    /// Whether a file of its stage changed since then, or of a stage with which its cases trace
    /// whole scenes.
    pub changed: bool,
}

impl Known {
    /// The key of the task's part, such as `part1`.
    pub fn part_key(&self) -> &str {
        self.place.key.split('.').next().unwrap_or_default()
    }

    /// Whether the last result has every core point and its code is still the same.
    ///
    /// A task is [open](open()) unless this is known: if a function of it is still a hole, if it
    /// was never graded, if it lost points, or if code changed since that its answers depend on.
    pub fn is_complete(&self) -> bool {
        let full = self.last.as_ref().is_some_and(TaskScore::is_complete);
        full && !self.changed
    }

    /// Whether the task is written and was complete at its last report, perhaps before an edit.
    pub fn was_complete(&self) -> bool {
        let full = self.last.as_ref().is_some_and(TaskScore::is_complete);
        full && self.place.open.is_empty()
    }
}

/// What is known of all tasks of `course`, in order. Reads the stages' files and the stored
/// results, and builds nothing.
pub fn known(workspace: &Workspace, course: &Course) -> Result<Vec<Known>, GraderError> {
    let results = Results::read(workspace);
    let stages = sources::read_all(workspace.root(), course)?;
    let code = results::of_files(course, &stages);
    let known = course.tasks().map(|task| {
        let last = results.of(&task.key).cloned();
        Known {
            place: sources::place(task, &stages[task.stage.as_str()]),
            changed: last
                .as_ref()
                .is_some_and(|last| last.is_of_other_code(&code[&task.key])),
            last,
        }
    });
    Ok(known.collect())
}

/// The open tasks of `known`, in order.
pub fn open(known: &[Known]) -> impl Iterator<Item = &Known> {
    let is_open = |task: &&Known| !task.is_complete() && !is_given(known, task.part_key());
    known.iter().filter(is_open)
}

/// The open task of `known` to go on with, none of `but`: one that was not complete before comes
/// first, of these one of the same part as the last of `but`, and of these the first after it.
pub fn first_open<'a>(known: &'a [Known], but: &[&Task]) -> Option<&'a Place> {
    let position = |key: &str| known.iter().position(|task| task.place.key == key);
    let last = but.iter().filter_map(|task| position(&task.key)).max();
    let others = open(known).filter(|known| but.iter().all(|task| task.key != known.place.key));
    let part = last.map(|at| known[at].part_key());
    let next = others.min_by_key(|known| {
        let is_of_another_part = part.is_some_and(|part| part != known.part_key());
        let is_before = position(&known.place.key) < last;
        (known.was_complete(), is_of_another_part, is_before)
    });
    next.map(|known| &known.place)
}

/// The first open task of `course`, or its last task if none is open.
pub fn or_last<'a>(workspace: &Workspace, course: &'a Course) -> Result<&'a Task, GraderError> {
    let known = known(workspace, course)?;
    let first = first_open(&known, &[]);
    let task = first.and_then(|place| course.tasks().find(|task| task.key == place.key));
    task.or(course.tasks().last())
        .ok_or_else(|| GraderError::new("the course has no tasks"))
}

/// Whether `task` is for later: nothing of it is written, and it is of another part than the next
/// open task.
pub fn is_for_later(known: &[Known], task: &Task) -> bool {
    let of = |key: &str| known.iter().find(|known| known.place.key == key);
    let Some((task_known, next)) = of(&task.key).zip(first_open(known, &[])) else {
        return false;
    };
    let is_of_next_part =
        of(&next.key).is_some_and(|next| next.part_key() == task_known.part_key());
    !is_of_next_part && task_known.last.is_none() && task_known.place.open.len() == task.holes.len()
}

/// Whether the handout contains the course's own solution of a part: none of the part's tasks has a
/// hole or was ever graded, and a task of a later part has a hole. In the full course no task has
/// one, so none of its parts is given.
pub fn is_given(known: &[Known], part: &str) -> bool {
    let mut later = known
        .iter()
        .rev()
        .take_while(|task| task.part_key() != part);
    let mut of_part = known.iter().filter(|task| task.part_key() == part);
    of_part.all(|task| !task.place.has_hole && task.last.is_none())
        && later.any(|task| task.place.has_hole)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn known(key: &str, score: f64, changed: bool) -> Known {
        Known {
            place: Place {
                key: key.into(),
                title: String::new(),
                file: None,
                open: Vec::new(),
                has_hole: false,
            },
            last: (score >= 0.0).then(|| TaskScore::of(score, 5.0)),
            changed,
        }
    }

    #[test]
    fn a_task_is_open_until_its_present_code_has_every_point() {
        let first = |known: &[Known]| first_open(known, &[]).map(|place| place.key.clone());
        let full = || known("a", 5.0, false);
        assert_eq!(first(&[full()]), None);
        for open in [
            known("b", 4.9, false),
            known("b", 5.0, true),
            known("b", -1.0, false),
        ] {
            assert_eq!(first(&[full(), open]).as_deref(), Some("b"));
        }
    }

    #[test]
    fn a_task_whose_gaps_are_back_comes_before_what_nobody_began() {
        let mut reset = known("b", 5.0, true);
        reset.place.open = vec!["f".into()];
        let all = [known("a", 5.0, true), reset, known("c", -1.0, false)];
        let first = first_open(&all, &[]).map(|place| place.key.as_str());
        assert_eq!(first, Some("b"));
    }

    #[test]
    fn a_gap_of_the_same_part_comes_before_the_next_part() {
        let (_, course) = crate::course::of_this_checkout();
        let keys = ["part1.task2", "part1.task3", "part1.task4", "part2.task1"];
        let all = [5.0, 1.0, 5.0, 1.0].map(|score| known("", score, false));
        let mut all = all.to_vec();
        for (known, key) in all.iter_mut().zip(keys) {
            known.place.key = key.into();
        }
        let after = |key: &str| {
            let task = course.tasks().find(|task| task.key == key).expect("a task");
            first_open(&all, &[task]).map(|place| place.key.clone())
        };
        assert_eq!(after("part1.task4").as_deref(), Some("part1.task3"));
        assert_eq!(after("part1.task3").as_deref(), Some("part2.task1"));
    }

    #[test]
    fn what_nobody_began_of_other_parts_is_for_later() {
        let (_, course) = crate::course::of_this_checkout();
        let task = |key: &str| course.tasks().find(|task| task.key == key).expect("a task");
        let open = |key: &str| {
            let mut open = known(key, -1.0, false);
            open.place.open = task(key).holes.clone();
            open.place.has_hole = true;
            open
        };
        let mut all = ["part1.task3", "part1.task4", "part2.task2"].map(open);
        let later = |all: &[Known]| {
            let keys = all.iter().map(|known| known.place.key.clone());
            keys.filter(|key| is_for_later(all, task(key)))
                .collect::<Vec<_>>()
        };
        assert_eq!(later(&all), ["part2.task2"]);
        all[2].place.open.clear();
        assert_eq!(later(&all), [""; 0]);
    }

    #[test]
    fn parts_that_the_handout_solves_are_not_open() {
        let hole = |key: &str| {
            let mut hole = known(key, -1.0, false);
            hole.place.has_hole = true;
            hole
        };
        let ungraded = |key: &str| known(key, -1.0, false);
        let first = |known: &[Known]| first_open(known, &[]).map(|place| place.key.clone());
        let solved = [ungraded("part1.task1"), ungraded("part1.task2")];
        let [one, two] = solved.clone();
        assert_eq!(first(&solved).as_deref(), Some("part1.task1"));
        let later = [one.clone(), two.clone(), hole("part2.task1")];
        assert_eq!(first(&later).as_deref(), Some("part2.task1"));
        // Written by the student, who graded a part of it or left some of it.
        let graded = [
            one.clone(),
            known("part1.task2", 5.0, false),
            hole("part2.task1"),
        ];
        assert_eq!(first(&graded).as_deref(), Some("part1.task1"));
        let half = [one, hole("part1.task2"), hole("part2.task1")];
        assert_eq!(first(&half).as_deref(), Some("part1.task1"));
    }
}
