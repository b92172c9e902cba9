//! The course as `stages/course.toml` lists it.

use crate::error::GraderError;
use crate::workspace::Workspace;
use judge::Tier;
use serde::Deserialize;
use std::collections::BTreeSet;

/// Parts, tasks, cases and points.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Course {
    /// What holds everywhere, in sentences for students.
    pub conventions: Vec<String>,
    /// Keys of tasks that have holes in the stages already, and no cases yet. Handouts carve them, too.
    #[serde(default)]
    pub ungraded: Vec<String>,
    /// The parts in order.
    #[serde(rename = "part")]
    pub parts: Vec<Part>,
}

/// One hand-in.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Part {
    /// Counted from 1.
    pub number: u32,
    /// For people.
    pub title: String,
    /// The tasks in order.
    #[serde(rename = "task")]
    pub tasks: Vec<Task>,
}

/// One thing to write.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Task {
    /// The one name of the task everywhere, such as `part1.task3`.
    pub key: String,
    /// For people.
    pub title: String,
    /// The crate below `stages/` that it is written in.
    pub stage: String,
    /// The functions to write.
    pub holes: Vec<String>,
    /// What it is checked with.
    pub cases: Vec<CaseEntry>,
}

/// One check and what it is worth.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CaseEntry {
    /// Name, unique in its task.
    pub name: String,
    /// Whose points it gives.
    pub tier: Tier,
    /// How many.
    pub points: f64,
}

impl Course {
    /// Reads the course of a workspace.
    pub fn read(workspace: &Workspace) -> Result<Course, GraderError> {
        let path = workspace.course_toml();
        let text =
            std::fs::read_to_string(&path).map_err(|e| GraderError::file("read", &path, e))?;
        let refused = |e| GraderError::new(format!("{}: {e}", path.display()));
        let course = Course::parse(&text).map_err(refused)?;
        for task in course.tasks() {
            let stage = workspace.root().join("stages").join(&task.stage);
            ensure(stage.is_dir(), || {
                let (key, stage) = (&task.key, &task.stage);
                format!("`{key}` is written in the stage `{stage}`, but there is no stages/{stage}")
            })
            .map_err(refused)?;
        }
        Ok(course)
    }

    /// Reads a course from the text of a `course.toml` and refuses one that contradicts itself.
    pub fn parse(text: &str) -> Result<Course, GraderError> {
        let course: Course = toml::from_str(text).map_err(|e| GraderError::new(e.to_string()))?;
        course.check()?;
        Ok(course)
    }

    /// All tasks in order.
    pub fn tasks(&self) -> impl Iterator<Item = &Task> {
        self.parts.iter().flat_map(|part| &part.tasks)
    }

    /// The stages that its tasks are written in, in the order of the course, each once.
    pub fn stages(&self) -> Vec<&str> {
        stages_of(self.tasks())
    }

    /// The tasks that `what` names: `all`, a part such as `part2`, or a task such as `part2.task3`.
    pub fn select(&self, what: &str) -> Result<Vec<&Task>, GraderError> {
        let chosen: Vec<&Task> = self
            .tasks()
            .filter(|task| what == "all" || task.key == what || task.part_key() == what)
            .collect();
        if chosen.is_empty() {
            if let Some(part) = self.parts.iter().find(|part| part.is_meant_by(what)) {
                let keys: Vec<&str> = part.tasks.iter().map(|task| task.key.as_str()).collect();
                return Err(GraderError::new(format!(
                    "the course has no `{what}`. The tasks of its part {} are {}",
                    part.number,
                    keys.join(", ")
                )));
            }
            let parts: Vec<String> = self
                .parts
                .iter()
                .map(|part| format!("part{}", part.number))
                .collect();
            return Err(GraderError::new(format!(
                "the course has no `{what}`. Say `all`, a part ({}) or a task such as `{}`",
                parts.join(", "),
                self.tasks().next().map_or("part1.task1", |task| &task.key),
            )));
        }
        Ok(chosen)
    }

    /// The keys of all tasks that have holes, graded or not, each with the number of its part.
    pub fn holes(&self) -> impl Iterator<Item = (u32, &str)> {
        let graded = self.tasks().map(|task| task.key.as_str());
        let ungraded = self.ungraded.iter().map(String::as_str);
        graded
            .chain(ungraded)
            .filter_map(|key| Some((part_of(key)?, key)))
    }

    fn check(&self) -> Result<(), GraderError> {
        for pair in self.parts.windows(2) {
            ensure(pair[0].number < pair[1].number, || {
                format!(
                    "part {} stands after part {}",
                    pair[1].number, pair[0].number
                )
            })?;
        }
        for key in &self.ungraded {
            ensure(part_of(key).is_some(), || {
                format!("`ungraded` lists `{key}`, which is no key such as `part3.task1`")
            })?;
            ensure(self.tasks().all(|task| task.key != *key), || {
                format!("`{key}` is a task, so it cannot be `ungraded`, too")
            })?;
        }
        let mut keys = BTreeSet::new();
        for part in &self.parts {
            for task in &part.tasks {
                let own = format!("part{}.", part.number);
                ensure(task.key.starts_with(&own), || {
                    format!(
                        "task `{}` stands in part {}: its key must begin with `{own}`",
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

/// The stages that `tasks` are written in, in their order, each once.
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
    /// Whether a key such as `part1.task9` asks for a task of this part.
    fn is_meant_by(&self, key: &str) -> bool {
        key.split_once('.')
            .is_some_and(|(part, _)| part == format!("part{}", self.number))
    }
}

impl Task {
    /// The part it belongs to, such as `part1`.
    pub fn part_key(&self) -> &str {
        self.key.split('.').next().unwrap_or_default()
    }

    /// The points of one purse.
    pub fn points(&self, tier: Tier) -> f64 {
        self.cases
            .iter()
            .filter(|case| case.tier == tier)
            .map(|case| case.points)
            .fold(0.0, |sum, points| sum + points)
    }

    fn check(&self) -> Result<(), GraderError> {
        let mut names = BTreeSet::new();
        for case in &self.cases {
            ensure(names.insert(&case.name), || {
                format!("task `{}` lists the case `{}` twice", self.key, case.name)
            })?;
            ensure(case.points.is_finite() && case.points > 0.0, || {
                format!(
                    "case `{}` of `{}` is worth {} points: it must be more than 0",
                    case.name, self.key, case.points
                )
            })?;
        }
        ensure(self.points(Tier::Core) > 0.0, || {
            format!(
                "task `{}` has no core points, so nobody could pass it",
                self.key
            )
        })
    }
}

/// The number of the part that a task's key begins with.
fn part_of(key: &str) -> Option<u32> {
    let (part, _) = key.strip_prefix("part")?.split_once(".task")?;
    part.parse().ok()
}

fn ensure(holds: bool, sentence: impl FnOnce() -> String) -> Result<(), GraderError> {
    if holds {
        Ok(())
    } else {
        Err(GraderError::new(sentence()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_task_that_is_not_there_is_answered_by_those_of_its_part() {
        let course = Course::parse(include_str!("../../stages/course.toml")).expect("it is sound");
        let told = |what: &str| course.select(what).unwrap_err().to_string();
        let tasks = told("part1.task9");
        assert!(tasks.contains("part1.task1, part1.task2"), "{tasks}");
        assert!(!tasks.contains("part2"), "{tasks}");
        let parts = told("part9");
        assert!(parts.contains("part1, part2"), "{parts}");
    }
}
