//! What students lost points by: the known mistakes of each task, grouped by idea. A mistake counts
//! only where it cost points.

use super::ideas::{self, Idea};
use crate::collect::{Class, Simplest, points};
use std::cmp::Reverse;
use std::collections::{BTreeMap, BTreeSet};

/// What points of a task were lost by.
#[derive(Debug)]
pub(super) struct TaskMistakes<'a> {
    /// The task's key.
    pub(super) task: &'a str,
    /// Its title.
    pub(super) title: &'a str,
    /// The ideas that were missing: that of the most students first.
    pub(super) ideas: Vec<IdeaMistakes<'a>>,
}

/// An idea, and the mistakes that show that it is missing.
#[derive(Debug)]
pub(super) struct IdeaMistakes<'a> {
    /// The idea.
    pub(super) idea: &'static Idea,
    /// The mistakes, the most frequent first.
    pub(super) mistakes: Vec<Mistake<'a>>,
}

/// A mistake of a task, and whose it is.
#[derive(Clone, Debug)]
pub(super) struct Mistake<'a> {
    /// Its names: several where answers cannot tell them apart; empty if nobody knows it.
    pub(super) name: String,
    /// What its code does.
    pub(super) about: String,
    /// The numbers of the rows, and whether the mistake is likely.
    pub(super) students: Vec<(usize, bool)>,
    /// The core points of the task that these students lost.
    pub(super) lost: f64,
    /// The shortest of the simplest calls that show it.
    pub(super) simplest: Option<&'a Simplest>,
}

impl IdeaMistakes<'_> {
    /// How many students there are.
    pub(super) fn students(&self) -> usize {
        self.mistakes
            .iter()
            .map(|mistake| mistake.students.len())
            .sum()
    }

    /// The points that they lost in the task, such as "6 points".
    pub(super) fn lost(&self) -> String {
        let lost = self
            .mistakes
            .iter()
            .fold(0.0, |sum, mistake| sum + mistake.lost);
        match points((lost * 4.0).round() / 4.0).as_str() {
            "1" => "1 point".to_string(),
            lost => format!("{lost} points"),
        }
    }

    /// The shortest of the simplest calls.
    pub(super) fn simplest(&self) -> Option<&Simplest> {
        let calls = self.mistakes.iter().filter_map(|mistake| mistake.simplest);
        calls.min_by_key(|call| call.length())
    }
}

/// The mistakes of each task, in the order of the plan.
pub(super) fn by_task(class: &Class) -> Vec<TaskMistakes<'_>> {
    let mut known: BTreeMap<(&str, Option<String>), Mistake> = BTreeMap::new();
    for (i, row) in class.rows.iter().enumerate() {
        let tasks = row.graded.iter().flat_map(|graded| &graded.tasks);
        for task in tasks.filter(|task| task.lost > 0.0) {
            let is_judged = ["failed", "crashed"].contains(&task.status.as_str());
            let (name, about, is_likely) = match &task.diagnosis {
                Some(diagnosis) => (
                    Some(diagnosis.mistakes.join(" or ")),
                    match diagnosis.description.as_str() {
                        "" => diagnosis.says.clone(),
                        description => format!("code that {description}"),
                    },
                    diagnosis.certainty == "likely",
                ),
                None if is_judged => (None, String::new(), false),
                None => continue,
            };
            let mistake = known.entry((&task.key, name.clone())).or_insert(Mistake {
                name: name.unwrap_or_default(),
                about,
                students: Vec::new(),
                lost: 0.0,
                simplest: None,
            });
            mistake.students.push((i, is_likely));
            mistake.lost += task.lost;
            let calls = mistake.simplest.into_iter().chain(&task.simplest);
            mistake.simplest = calls.min_by_key(|call| call.length());
        }
    }
    let tasks = class.plan.tasks.iter().map(|task| TaskMistakes {
        task: &task.key,
        title: &task.title,
        ideas: by_idea(&known, &task.key),
    });
    tasks.filter(|task| !task.ideas.is_empty()).collect()
}

fn by_idea<'a>(
    known: &BTreeMap<(&str, Option<String>), Mistake<'a>>,
    key: &str,
) -> Vec<IdeaMistakes<'a>> {
    let of_task = known.iter().filter(|((task, _), _)| *task == key);
    let mut by_idea: BTreeMap<&'static Idea, Vec<Mistake>> = BTreeMap::new();
    for (_, mistake) in of_task {
        let idea = match mistake.name.as_str() {
            "" => ideas::unnamed(),
            name => ideas::of(key, name, &mistake.about),
        };
        by_idea.entry(idea).or_default().push(mistake.clone());
    }
    let mut ideas: Vec<IdeaMistakes> = by_idea
        .into_iter()
        .map(|(idea, mut mistakes)| {
            // The sort is stable: equal ones stay in the order of their names.
            mistakes.sort_by_key(|mistake| Reverse(mistake.students.len()));
            IdeaMistakes { idea, mistakes }
        })
        .collect();
    ideas.sort_by_key(|idea| (idea.idea == ideas::unnamed(), Reverse(idea.students())));
    ideas
}

/// How many students lost points in the tasks.
pub(super) fn students(tasks: &[TaskMistakes<'_>]) -> usize {
    let ideas = tasks.iter().flat_map(|task| &task.ideas);
    let mistakes = ideas.flat_map(|idea| &idea.mistakes);
    let rows: BTreeSet<usize> = mistakes
        .flat_map(|mistake| mistake.students.iter().map(|(row, _)| *row))
        .collect();
    rows.len()
}
