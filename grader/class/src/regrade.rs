//! Old and new scores of a class whose course, seed or submissions have changed, and why they
//! differ.

use crate::by_hand::{ByHand, given};
use crate::collect::{Class, Row, points};
use crate::gradebook::table::{self as gradebook, text};
use crate::plan::{Plan, State};
use base::GraderError;
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;
use submission::Untrusted;

/// What changes for one student.
#[derive(Clone, Debug, PartialEq)]
pub struct Change {
    /// The student's name.
    pub name: Untrusted,
    /// The old and the new result: status and points.
    pub results: [String; 2],
    /// The tasks whose points change: key, old and new points, core and extra.
    pub tasks: Vec<(String, [f64; 2], [f64; 2])>,
    /// Why.
    pub why: Vec<String>,
    /// What was given by hand on top of the old points, and stays.
    pub by_hand: Vec<String>,
}

/// What changes between two gradings of a class. Both are without what is given by hand.
pub fn changes(old: &Class, new: &Class, by_hand: &ByHand) -> Vec<Change> {
    let settings = old.plan.differences(&new.plan);
    let rows = |class: &Class| -> BTreeMap<Untrusted, Row> {
        class
            .rows
            .iter()
            .map(|row| (row.name.clone(), row.clone()))
            .collect()
    };
    let (before, after) = (rows(old), rows(new));
    let names: BTreeSet<&Untrusted> = before.keys().chain(after.keys()).collect();
    let mut changes = Vec::new();
    for name in names {
        let (before, after) = (before.get(name), after.get(name));
        let tasks = changed_tasks(before, after);
        let results = [(before, old), (after, new)].map(|(row, class)| result(row, class));
        if results[0] == results[1] && tasks.is_empty() {
            continue;
        }
        let mut why: Vec<String> = Vec::new();
        match (submission(&old.plan, name), submission(&new.plan, name)) {
            (None, _) => why.push("handed in since".to_string()),
            (_, None) => why.push("no longer in the folder".to_string()),
            (a, b) if a != b => why.push("other files were handed in".to_string()),
            _ => {}
        }
        why.extend(settings.iter().cloned());
        if why.is_empty() {
            why.push("it was tried again".to_string());
        }
        changes.push(Change {
            name: name.clone(),
            results,
            tasks,
            why,
            by_hand: given_to(by_hand, name),
        });
    }
    changes
}

/// What a student handed in: the hash, or why it cannot be read.
fn submission<'a>(plan: &'a Plan, name: &Untrusted) -> Option<&'a str> {
    let planned = plan
        .submissions
        .iter()
        .find(|planned| planned.name == *name)?;
    Some(match &planned.state {
        State::Unit { submission, .. } => submission,
        State::TooLarge(why)
        | State::Unreadable(why)
        | State::NoClone(why)
        | State::NotRead(why) => why.raw(),
    })
}

/// What is given by hand to a submission and to single students of its team.
fn given_to(by_hand: &ByHand, name: &Untrusted) -> Vec<String> {
    let marks = by_hand.submissions.get(name.raw()).into_iter().flatten();
    let whole = marks.map(|(task, mark)| given(task, mark));
    let members = by_hand.members_of(name).flat_map(|member| {
        let marks = member.marks.iter();
        marks.map(|(task, mark)| format!("{}: {}", member.name.line(), given(task, mark)))
    });
    whole.chain(members).collect()
}

fn result(row: Option<&Row>, class: &Class) -> String {
    let Some(row) = row else {
        return "none".to_string();
    };
    match &row.score {
        Some(score) => {
            let [max_core, max_extra] = class.plan.max_score().map(points);
            let (core, extra) = (points(score.core), points(score.extra));
            format!(
                "{core} of {max_core} + {extra} of {max_extra}, {}",
                row.status.label()
            )
        }
        None => row.status.to_string(),
    }
}

fn changed_tasks(before: Option<&Row>, after: Option<&Row>) -> Vec<(String, [f64; 2], [f64; 2])> {
    let tasks = |row: Option<&Row>| {
        let score = row.and_then(|row| row.score.as_ref());
        score.map(|score| score.tasks.clone()).unwrap_or_default()
    };
    let (before, after) = (tasks(before), tasks(after));
    let keys: BTreeSet<&String> = before.keys().chain(after.keys()).collect();
    let points = keys.into_iter().map(|key| {
        let [a, b] = [&before, &after].map(|tasks| tasks.get(key).copied().unwrap_or_default());
        (key.clone(), a, b)
    });
    points.filter(|(_, a, b)| a != b).collect()
}

/// Formats the changes for people.
pub fn to_text(changes: &[Change], submissions: usize) -> String {
    let mut text = String::new();
    for change in changes {
        let [old, new] = &change.results;
        let _ = writeln!(text, "{}: {old} -> {new}", change.name.line());
        for (task, a, b) in &change.tasks {
            let of = |[core, extra]: &[f64; 2]| format!("{} + {}", points(*core), points(*extra));
            let _ = writeln!(text, "    {task}: {} -> {}", of(a), of(b));
        }
        for given in &change.by_hand {
            let _ = writeln!(text, "    by hand, and stays: {given}");
        }
    }
    let mut reasons: BTreeMap<&str, usize> = BTreeMap::new();
    for why in changes.iter().flat_map(|change| &change.why) {
        *reasons.entry(why).or_default() += 1;
    }
    let _ = writeln!(
        text,
        "{} of {submissions} submissions change",
        changes.len()
    );
    for (why, times) in reasons {
        let _ = writeln!(text, "  {times} of them: {why}");
    }
    text
}

/// Formats the changes as a table.
pub fn to_csv(changes: &[Change]) -> Result<String, GraderError> {
    let header = [
        "id",
        "task",
        "old score",
        "old extra",
        "new score",
        "new extra",
        "old",
        "new",
        "why",
        "by hand",
    ];
    let mut records = vec![header.map(str::to_string).to_vec()];
    for change in changes {
        let name = text(&change.name.line());
        let mut record = vec![String::new(); header.len()];
        record[0].clone_from(&name);
        record[6] = text(&change.results[0]);
        record[7] = text(&change.results[1]);
        record[8] = text(&change.why.join("; "));
        record[9] = text(&change.by_hand.join("; "));
        records.push(record);
        for (task, a, b) in &change.tasks {
            let mut record = vec![name.clone(), text(task)];
            record.extend([a[0], a[1], b[0], b[1]].map(points));
            record.resize(header.len(), String::new());
            records.push(record);
        }
    }
    gradebook::table(&records)
}
