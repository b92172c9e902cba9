//! Reads `stages/course.toml`: the list of parts, tasks, cases and points.

pub mod chapter;
pub mod consistency;
pub mod given;
pub mod moved_points;
pub mod packed;
pub mod sources;
pub mod term;

use base::{GraderError, Workspace};
use judge::Tier;
use judge::examples;
use judge::findings::Aspect;
use serde::Deserialize;
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use term::Term;

/// The course: its parts, tasks, cases and points.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Course {
    /// The conventions of the course, as sentences for students.
    pub conventions: Vec<String>,
    /// Keys of tasks whose functions are marked in the stages but that have no cases. Handouts
    /// also leave out their solutions.
    #[serde(default)]
    pub ungraded: Vec<String>,
    /// Files and folders that are a solution from the first line to the last, by the keys of the
    /// tasks. Handouts also leave them out.
    #[serde(default)]
    pub whole_solutions: BTreeMap<String, Vec<PathBuf>>,
    /// Tasks and cases that a teacher leaves out, such as `part1.task2` and
    /// `part1.task3/slivers`. The code of such a task is given.
    #[serde(default)]
    pub left_out: Vec<String>,
    /// The term in which a teacher gives the course.
    #[serde(default)]
    pub term: Option<Term>,
    /// The parts in order.
    #[serde(rename = "part")]
    pub parts: Vec<Part>,
}

/// One part: the tasks that students hand in together.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Part {
    /// Its number, counted from 1.
    pub number: u32,
    /// Its title.
    pub title: String,
    /// The tasks in order.
    #[serde(rename = "task")]
    pub tasks: Vec<Task>,
}

/// One task: some functions to write in one stage.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Task {
    /// The name of the task in all files and programs, such as `part1.task3`.
    pub key: String,
    /// Its title.
    pub title: String,
    /// The crate below `stages/` that has the functions.
    pub stage: String,
    /// The functions to write.
    pub holes: Vec<String>,
    /// Functions beyond the course that a handout lets students write, and that no case judges.
    #[serde(default)]
    pub not_judged: Vec<String>,
    /// What shows that a function has the idea of the task. One that is mostly wrong in any of
    /// them gets a quarter of its points.
    #[serde(default)]
    pub idea: Vec<Idea>,
    /// The points for a student's own examples of it, as extra credit.
    #[serde(default)]
    pub examples: f64,
    /// The cases that test it.
    pub cases: Vec<CaseEntry>,
}

/// The name of what a task's examples earn, among the results of its cases.
pub const YOUR_EXAMPLES: &str = "your_examples";

/// An aspect of the answers to one case.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Idea {
    /// The case.
    pub case: String,
    /// The aspect.
    pub aspect: Aspect,
    /// Another case that shows the idea: if the aspect is mostly right there, the idea is not
    /// missing.
    pub or_in: Option<String>,
    /// The only function of the task that the case calls; `None` if it calls all of them.
    pub function: Option<String>,
}

/// One case and its points.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CaseEntry {
    /// Its name, unique in its task.
    pub name: String,
    /// Whether its points are core or robust points.
    pub tier: Tier,
    /// The points that it is worth.
    pub points: f64,
    /// Another case, without which it gives no points: what it tests could be had by being wrong
    /// there.
    #[serde(default)]
    pub only_with: Option<String>,
}

impl Course {
    /// Reads the course of a workspace.
    pub fn read(workspace: &Workspace) -> Result<Course, GraderError> {
        let path = workspace.course_toml();
        let text =
            std::fs::read_to_string(&path).map_err(|e| GraderError::file("read", &path, e))?;
        let in_file = |e| GraderError::new(format!("{}: {e}", path.display()));
        let course = Course::parse(&text).map_err(in_file)?;
        for task in course.tasks() {
            let stage = workspace.root().join("stages").join(&task.stage);
            ensure(stage.is_dir(), || {
                let (key, stage) = (&task.key, &task.stage);
                format!("`{key}` names the stage `{stage}`, but there is no stages/{stage}")
            })
            .map_err(in_file)?;
        }
        Ok(course)
    }

    /// Parses the text of a `course.toml`. A list that contradicts itself is an error.
    pub fn parse(text: &str) -> Result<Course, GraderError> {
        let course: Course = toml::from_str(text).map_err(|e| GraderError::new(e.to_string()))?;
        course.check()?;
        Ok(course)
    }

    /// All tasks in order.
    pub fn tasks(&self) -> impl Iterator<Item = &Task> {
        self.parts.iter().flat_map(|part| &part.tasks)
    }

    /// The stages of its tasks, in the order of the course, each once.
    pub fn stages(&self) -> Vec<&str> {
        stages_of(self.tasks())
    }

    /// The tasks that `what` selects: `all`, a part such as `part2`, a task such as `part2.task3`,
    /// or several of these with commas between them.
    pub fn select(&self, what: &str) -> Result<Vec<&Task>, GraderError> {
        let mut chosen: Vec<&Task> = Vec::new();
        for what in what.split(',') {
            for task in self.select_one(what)? {
                if chosen.iter().all(|known| known.key != task.key) {
                    chosen.push(task);
                }
            }
        }
        Ok(chosen)
    }

    fn select_one(&self, what: &str) -> Result<Vec<&Task>, GraderError> {
        let chosen: Vec<&Task> = self
            .tasks()
            .filter(|task| is_selected(&task.key, what))
            .collect();
        if chosen.is_empty() {
            if let Some((key, case)) = what.split_once('/')
                && self.tasks().any(|task| task.key == key)
            {
                return Err(GraderError::new(format!(
                    "`{what}` names one case. To run it: `cargo grader {key} --case {case}`"
                )));
            }
            if self.left_out.iter().any(|key| is_selected(key, what)) {
                return Err(GraderError::new(format!(
                    "this course leaves `{what}` out: its code is given, and nothing of it is graded"
                )));
            }
            if let Some(part) = self.parts.iter().find(|part| part.matches_key(what)) {
                let keys: Vec<&str> = part.tasks.iter().map(|task| task.key.as_str()).collect();
                return Err(GraderError::new(format!(
                    "the course has no task `{what}`. The tasks of part {} are {}",
                    part.number,
                    keys.join(", ")
                )));
            }
            let parts: Vec<String> = self
                .parts
                .iter()
                .map(|part| format!("part{}", part.number))
                .collect();
            let is_ungraded = self.ungraded.iter().any(|key| is_selected(key, what));
            let problem = match is_ungraded {
                true => format!("`{what}` is extra credit without cases: nothing of it is graded"),
                false => format!("the course has no `{what}`"),
            };
            return Err(GraderError::new(format!(
                "{problem}. Expected `all`, a part ({}) or a task such as `{}`",
                parts.join(", "),
                self.tasks().next().map_or("part1.task1", |task| &task.key),
            )));
        }
        Ok(chosen)
    }

    /// The keys of all tasks with functions to write, graded or not, each with its part's number.
    pub fn holes(&self) -> impl Iterator<Item = (u32, &str)> {
        let graded = self.tasks().map(|task| task.key.as_str());
        let ungraded = self.ungraded.iter().map(String::as_str);
        graded
            .chain(ungraded)
            .filter_map(|key| Some((part_number(key)?, key)))
    }

    /// The task of which the file `path` is a solution from the first line to the last.
    pub fn whole_solution(&self, path: &Path) -> Option<&str> {
        let is_in = |folders: &Vec<PathBuf>| folders.iter().any(|folder| path.starts_with(folder));
        let mut lists = self.whole_solutions.iter();
        lists.find_map(|(key, folders)| is_in(folders).then_some(key.as_str()))
    }

    /// Whether a teacher leaves out the task `key`, or its case `case`.
    pub fn leaves_out(&self, key: &str, case: Option<&str>) -> bool {
        let is_case =
            |left_out: &str| case.is_some_and(|case| left_out.split_once('/') == Some((key, case)));
        self.left_out
            .iter()
            .any(|left_out| left_out == key || is_case(left_out))
    }

    /// The keys of the tasks that a teacher leaves out.
    pub fn tasks_left_out(&self) -> impl Iterator<Item = &str> {
        let keys = self.left_out.iter().map(String::as_str);
        keys.filter(|key| !key.contains('/'))
    }

    fn check(&self) -> Result<(), GraderError> {
        self.term.as_ref().map_or(Ok(()), Term::check)?;
        for key in self.tasks_left_out() {
            let is_listed = self.tasks().any(|task| task.key == key);
            ensure(part_number(key).is_some() && !is_listed, || {
                format!("`left_out` lists `{key}`: expected the key of a task that is not listed")
            })?;
        }
        for pair in self.parts.windows(2) {
            ensure(pair[0].number < pair[1].number, || {
                format!(
                    "part {} comes after part {}: expected the parts in ascending order",
                    pair[1].number, pair[0].number
                )
            })?;
        }
        for key in &self.ungraded {
            ensure(part_number(key).is_some(), || {
                format!("`ungraded` lists `{key}`: expected a key such as `part3.task1`")
            })?;
            ensure(self.tasks().all(|task| task.key != *key), || {
                format!("`{key}` is listed as a task and as `ungraded`: remove one of them")
            })?;
        }
        let mut keys = BTreeSet::new();
        for part in &self.parts {
            for task in &part.tasks {
                let prefix = format!("part{}.", part.number);
                ensure(task.key.starts_with(&prefix), || {
                    format!(
                        "task `{}` is in part {}: its key must begin with `{prefix}`",
                        task.key, part.number
                    )
                })?;
                ensure(keys.insert(&task.key), || {
                    format!("two tasks have the key `{}`", task.key)
                })?;
                task.check()?;
            }
        }
        ensure(!keys.is_empty(), || "the course has no task".to_string())
    }
}

/// The stages of `tasks`, in their order, each once.
pub fn stages_of<'a>(tasks: impl IntoIterator<Item = &'a Task>) -> Vec<&'a str> {
    let mut stages = Vec::new();
    for task in tasks {
        if !stages.contains(&task.stage.as_str()) {
            stages.push(task.stage.as_str());
        }
    }
    stages
}

impl Part {
    /// Whether a key such as `part1.task9` begins with this part's key.
    fn matches_key(&self, key: &str) -> bool {
        key.split_once('.')
            .is_some_and(|(part, _)| part == format!("part{}", self.number))
    }
}

/// Whether `what`, read as by [`Course::select`], selects the task `key`.
pub(crate) fn is_selected(key: &str, what: &str) -> bool {
    let part = key.split('.').next();
    what.split(',')
        .any(|what| what == "all" || what == key || Some(what) == part)
}

impl Task {
    /// The key of its part, such as `part1`.
    pub fn part_key(&self) -> &str {
        self.key.split('.').next().unwrap_or_default()
    }

    /// The sum of its core points or of its robust points, with those for a student's examples.
    pub fn points(&self, tier: Tier) -> f64 {
        let of_examples = self.entry_of_examples();
        sum_of(self.cases.iter().chain(&of_examples), tier)
    }

    /// The sum of the core points or of the robust points of its cases.
    pub fn points_of_cases(&self, tier: Tier) -> f64 {
        sum_of(&self.cases, tier)
    }

    /// What a student's examples are worth, in the form of a case; `None` without points.
    pub fn entry_of_examples(&self) -> Option<CaseEntry> {
        (self.examples > 0.0).then(|| CaseEntry {
            name: YOUR_EXAMPLES.into(),
            tier: Tier::Robust,
            points: self.examples,
            only_with: None,
        })
    }

    /// The names of the cases that show its idea.
    pub fn cases_of_idea(&self) -> impl Iterator<Item = &String> {
        let of_idea = self.idea.iter();
        of_idea.flat_map(|idea| std::iter::once(&idea.case).chain(&idea.or_in))
    }

    fn check(&self) -> Result<(), GraderError> {
        let mut names = BTreeSet::new();
        for case in &self.cases {
            ensure(names.insert(&case.name), || {
                format!("task `{}` lists the case `{}` twice", self.key, case.name)
            })?;
            ensure(case.points.is_finite() && case.points > 0.0, || {
                format!(
                    "case `{}` of `{}` has {} points: expected more than 0",
                    case.name, self.key, case.points
                )
            })?;
        }
        for case in &self.cases {
            let Some(other) = &case.only_with else {
                continue;
            };
            ensure(names.contains(other), || {
                let (key, name) = (&self.key, &case.name);
                format!(
                    "`only_with` of `{name}` in `{key}` names the case `{other}`, which the task does not have"
                )
            })?;
        }
        for case in self.cases_of_idea() {
            ensure(names.contains(case), || {
                let key = &self.key;
                format!("`idea` of `{key}` names the case `{case}`, which the task does not have")
            })?;
        }
        for function in self.idea.iter().filter_map(|idea| idea.function.as_ref()) {
            ensure(self.holes.contains(function), || {
                let key = &self.key;
                format!(
                    "`idea` of `{key}` names the function `{function}`, which is not one of its `holes`"
                )
            })?;
        }
        self.check_examples()?;
        ensure(self.points(Tier::Core) > 0.0, || {
            format!(
                "task `{}` has no core points: give at least one of its cases the tier core",
                self.key
            )
        })
    }

    fn check_examples(&self) -> Result<(), GraderError> {
        let (key, points) = (&self.key, self.examples);
        ensure(points.is_finite() && points >= 0.0, || {
            format!("the examples of `{key}` have {points} points: expected a number, at least 0")
        })?;
        let why_not = examples::why_not(key).filter(|_| points > 0.0);
        why_not.map_or(Ok(()), |why| {
            Err(GraderError::new(format!(
                "`{key}` has points for examples, which cannot be judged: {why}"
            )))
        })
    }
}

/// The sum of the points of one tier.
fn sum_of<'a>(cases: impl IntoIterator<Item = &'a CaseEntry>, tier: Tier) -> f64 {
    let of_tier = cases.into_iter().filter(|case| case.tier == tier);
    of_tier.fold(0.0, |sum, case| sum + case.points)
}

/// The number of the part in a task's key.
fn part_number(key: &str) -> Option<u32> {
    let (part, _) = key.strip_prefix("part")?.split_once(".task")?;
    part.parse().ok()
}

fn ensure(condition: bool, message: impl FnOnce() -> String) -> Result<(), GraderError> {
    if condition {
        Ok(())
    } else {
        Err(GraderError::new(message()))
    }
}

/// The workspace of this crate and its course, for tests.
#[cfg(test)]
pub(crate) fn of_this_checkout() -> (Workspace, Course) {
    let workspace = Workspace::above(std::path::Path::new(env!("CARGO_MANIFEST_DIR")))
        .expect("the grader is in a workspace");
    let course = Course::read(&workspace).expect("the course is valid");
    (workspace, course)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_list_selects_each_task_once() {
        let course =
            Course::parse(include_str!("../../../stages/course.toml")).expect("it is valid");
        let keys = |what: &str| -> Vec<&str> {
            let tasks = course.select(what).expect("they exist").into_iter();
            tasks.map(|task| task.key.as_str()).collect()
        };
        assert_eq!(
            keys("part1.task4,part1.task2"),
            ["part1.task4", "part1.task2"]
        );
        assert_eq!(keys("part3.task1,part3").len(), 3);
        assert!(course.select("part1.task1,").is_err());
    }

    #[test]
    fn the_error_for_a_case_has_the_command_that_runs_it() {
        let course =
            Course::parse(include_str!("../../../stages/course.toml")).expect("it is valid");
        let error = course
            .select("part1.task3/range")
            .expect_err("a case is no task");
        let command = "`cargo grader part1.task3 --case range`";
        assert!(error.to_string().ends_with(command), "{error}");
        let unknown = course
            .select("part1.task9/range")
            .expect_err("no such task");
        assert!(
            unknown.to_string().contains("The tasks of part 1"),
            "{unknown}"
        );
    }

    #[test]
    fn the_error_for_an_unknown_task_lists_the_tasks_of_its_part() {
        let course =
            Course::parse(include_str!("../../../stages/course.toml")).expect("it is valid");
        let error = |what: &str| course.select(what).unwrap_err().to_string();
        let tasks = error("part1.task9");
        assert!(tasks.contains("part1.task1, part1.task2"), "{tasks}");
        assert!(!tasks.contains("part2"), "{tasks}");
        let parts = error("part9");
        assert!(parts.contains("part1, part2"), "{parts}");
    }
}
