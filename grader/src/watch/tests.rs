//! Drives the loop with events that are given.

use super::*;
use crate::report::TaskReport;
use crate::score::{Status, TaskResult};
use std::collections::VecDeque;

/// A desk whose events are given, and which records what it is asked.
#[derive(Default)]
struct Script {
    events: VecDeque<Event>,
    /// The keys of the tasks that are complete when they are graded.
    complete: BTreeSet<String>,
    graded: Vec<String>,
    shown: Vec<String>,
    opened: Vec<PathBuf>,
    fails: bool,
}

impl Desk for Script {
    fn next_event(&mut self) -> Result<Event, GraderError> {
        Ok(self.events.pop_front().unwrap_or(Event::Closed))
    }

    fn grade(&mut self, what: &str) -> Result<(Report, Context), GraderError> {
        self.graded.push(what.to_owned());
        if self.fails {
            return Err(GraderError::new("cargo is missing"));
        }
        let course = course();
        let tasks = course.select(what)?.into_iter().map(|task| {
            let empty = TaskResult::new(task, Vec::new());
            let is_complete = self.complete.contains(&task.key);
            TaskReport::from(TaskResult {
                score: if is_complete { empty.max_score } else { 0.0 },
                status: match is_complete {
                    true => Status::Passed,
                    false => Status::NotAttempted,
                },
                ..empty
            })
        });
        let context = Context {
            what: what.to_owned(),
            ..Context::default()
        };
        Ok((Report::new(tasks.collect(), None), context))
    }

    fn next_open(
        &mut self,
        limit: Option<&str>,
        but: &[&Task],
    ) -> Result<Option<String>, GraderError> {
        let course = course();
        let mut open = course.tasks().filter(|task| {
            limit.is_none_or(|limit| is_selected(&task.key, limit))
                && !self.complete.contains(&task.key)
                && but.iter().all(|other| other.key != task.key)
        });
        Ok(open.next().map(|task| task.key.clone()))
    }

    fn needs_enter(&self) -> bool {
        true
    }

    fn open(&mut self, file: &Path) -> bool {
        self.opened.push(file.into());
        true
    }

    fn show(&mut self, text: &str) {
        self.shown.push(text.to_owned());
    }
}

fn course() -> Course {
    Course::parse(include_str!("../../../stages/course.toml")).expect("it is valid")
}

fn saved(stages: &[&str]) -> Event {
    Event::Saved(stages.iter().map(ToString::to_string).collect())
}

fn typed(line: &str) -> Event {
    Event::Typed(line.to_owned())
}

/// Runs the loop over `events` in `limit`.
fn play(script: &mut Script, limit: Option<&str>, events: &[Event]) -> Ended {
    script.events = events.iter().cloned().collect();
    let (hint, page) = (HintLevel::Findings, Page::default());
    let complete = BTreeSet::new();
    run(script, &course(), limit, hint, complete, page).expect("the script has no errors")
}

#[test]
fn a_saved_file_grades_the_tasks_of_its_stage_in_the_part() {
    let mut script = Script::default();
    let events = [saved(&["intersect"]), saved(&["bvh"]), saved(&["raygen"])];
    play(&mut script, Some("part1"), &events);
    assert_eq!(
        script.graded,
        [
            "part1.task1",
            "part1.task3,part1.task4",
            "part1.task1,part1.task2"
        ]
    );
    let mut script = Script::default();
    play(&mut script, Some("part1.task4"), &events);
    assert_eq!(script.graded, ["part1.task4", "part1.task4"]);
    let mut script = Script::default();
    play(&mut script, None, &[saved(&["bvh"])]);
    assert_eq!(script.graded, ["part1.task1", "part2.task1,part2.task3"]);
}

#[test]
fn keys_grade_again_go_on_and_quit() {
    let mut script = Script::default();
    let events = [typed(""), typed("n\n"), typed("q"), typed("")];
    play(&mut script, Some("part1"), &events);
    assert_eq!(script.graded, ["part1.task1", "part1.task1", "part1.task2"]);
}

#[test]
fn the_end_of_the_input_is_explained_and_that_by_a_key_is_not() {
    let mut script = Script::default();
    assert_eq!(play(&mut script, None, &[typed("q")]), Ended::ByKey);
    assert_eq!(Ended::ByKey.why(), None);
    assert_eq!(play(&mut script, None, &[typed("h")]), Ended::InputClosed);
    let why = Ended::InputClosed.why().expect("it is explained");
    assert!(why.contains("standard input was closed"), "{why}");
}

#[test]
fn keys_that_only_show_grade_nothing() {
    let mut script = Script::default();
    let events = [
        typed("h"),
        typed("h"),
        typed("h"),
        typed("c"),
        typed("p"),
        typed("x"),
    ];
    play(&mut script, None, &events);
    assert_eq!(script.graded.len(), 1);
    let last = |from_end: usize| &script.shown[script.shown.len() - 1 - from_end];
    assert!(last(0).contains("There is no key \"x\"."), "{}", last(0));
    assert!(
        last(1).contains("There is no picture of part1.task1."),
        "{}",
        last(1)
    );
    assert!(
        last(2).contains("The chapter of part1.task1: stages/book/src/part1/task1.md, opened"),
        "{}",
        last(2)
    );
    assert_eq!(script.opened, [Path::new("stages/book/src/part1/task1.md")]);
    assert!(last(3).contains("This is the last level."), "{}", last(3));
    assert!(!last(4).contains("This is the last level."), "{}", last(4));
}

#[test]
fn a_task_is_celebrated_when_it_becomes_complete_and_not_again() {
    let mut script = Script {
        complete: BTreeSet::from(["part1.task2".to_owned()]),
        ..Script::default()
    };
    play(&mut script, None, &[saved(&["raygen"]), saved(&["raygen"])]);
    let done = "Done, every core point: part1.task2.";
    let celebrations = script.shown.iter().filter(|text| text.contains(done));
    assert_eq!(celebrations.count(), 1, "{:?}", script.shown);
}

#[test]
fn an_error_is_shown_and_the_loop_goes_on() {
    let mut script = Script {
        fails: true,
        ..Script::default()
    };
    play(&mut script, None, &[saved(&["bvh"])]);
    assert_eq!(script.graded.len(), 2);
    let errors = script
        .shown
        .iter()
        .filter(|text| text.contains("error: cargo is missing"));
    assert_eq!(errors.count(), 2);
}

#[test]
fn every_screen_fits_the_terminal() {
    let mut script = Script::default();
    let stages = [
        "raygen",
        "intersect",
        "bbox",
        "bvh",
        "direct",
        "global",
        "adaptive",
    ];
    play(&mut script, None, &[saved(&stages), typed("c")]);
    for text in &script.shown {
        assert!(text.lines().count() <= 23, "{text}");
        assert!(
            text.lines().all(|line| line.chars().count() <= 80),
            "{text}"
        );
    }
}
