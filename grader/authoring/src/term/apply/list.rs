//! The list of parts, tasks, cases and points, `stages/course.toml`: with the changes of a term,
//! and everything else as it was, comments too.

use crate::term::own_case::OwnCase;
use crate::term::settings::Changes;
use base::GraderError;
use grader::course::term::Term;
use grader::course::{Course, Task, YOUR_EXAMPLES};
use judge::Tier;
use judge::examples;
use std::collections::BTreeSet;
use toml_edit::{ArrayOfTables, DocumentMut, InlineTable, Item, Table, Value};

/// The text of the list `original`, which is that of the course `before`, with `changes`.
pub(super) fn with_changes(
    original: &str,
    before: &Course,
    changes: &Changes,
) -> Result<String, GraderError> {
    let left_out = left_out(before, changes)?;
    check_points(before, changes)?;
    check_cases(changes)?;
    let mut list: DocumentMut = original
        .parse()
        .map_err(|e| GraderError::new(format!("stages/course.toml: {e}")))?;
    let points = changes.points();
    if let Some(parts) = list.get_mut("part").and_then(Item::as_array_of_tables_mut) {
        for part in parts.iter_mut() {
            let Some(tasks) = part.get_mut("task").and_then(Item::as_array_of_tables_mut) else {
                continue;
            };
            tasks.retain(|task| !left_out.contains(&text(task, "key")));
            for task in tasks.iter_mut() {
                let key = text(task, "key");
                let of_examples = format!("{key}/{YOUR_EXAMPLES}");
                if let Some(points) = points.get(of_examples.as_str()) {
                    task.insert("examples", Item::Value(number(*points)));
                }
                let Some(cases) = task.get_mut("cases").and_then(Item::as_array_mut) else {
                    continue;
                };
                cases.retain(|case| !left_out.contains(&name_of(&key, case)));
                for (name, case) in &changes.cases {
                    if let Some((_, name)) = name.split_once('/').filter(|(task, _)| *task == key) {
                        cases.push_formatted(entry_of(name, case));
                    }
                }
                for case in cases.iter_mut() {
                    let name = name_of(&key, case);
                    if let Some((points, case)) =
                        points.get(name.as_str()).zip(case.as_inline_table_mut())
                    {
                        set_points(case, *points);
                    }
                }
            }
        }
        let has_tasks = |part: &Table| {
            let tasks = part.get("task").and_then(Item::as_array_of_tables);
            tasks.is_some_and(|tasks: &ArrayOfTables| !tasks.is_empty())
        };
        parts.retain(has_tasks);
    }
    if let Some(ungraded) = list.get_mut("ungraded").and_then(Item::as_array_mut) {
        ungraded.retain(|key| key.as_str().is_none_or(|key| !left_out.contains(key)));
    }
    if !left_out.is_empty() {
        let names: toml_edit::Array = left_out.iter().map(String::as_str).collect();
        list.insert("left_out", Item::Value(names.into()));
    }
    list.insert("term", Item::Table(table_of(&changes.settings.as_term())));
    Ok(list.to_string())
}

/// The names of the tasks and cases that are left out: those of a part that is left out are listed
/// one by one.
fn left_out(before: &Course, changes: &Changes) -> Result<BTreeSet<String>, GraderError> {
    let mut names = BTreeSet::new();
    for name in changes.left_out() {
        if let Some((key, case)) = name.split_once('/') {
            let task = task(before, key, name)?;
            ensure(has_case(task, case), || {
                format!("`leave_out` names `{name}`, but {key} has no such case")
            })?;
            let shows_idea = task.cases_of_idea().any(|shown| shown == case);
            ensure(!shows_idea, || {
                format!(
                    "`leave_out` names `{name}`, but this case shows the idea of {key}: without it, code without the idea \
                     would get full points. Leave it in, with fewer points"
                )
            })?;
            names.insert(name.to_string());
            continue;
        }
        let holes = before.holes().map(|(_, key)| key);
        let is_part_of = |key: &str| key.split('.').next() == Some(name);
        let found: Vec<&str> = holes
            .filter(|key| *key == name || is_part_of(key))
            .collect();
        ensure(!found.is_empty(), || {
            format!(
                "`leave_out` names `{name}`, which First Light does not have. Expected a part such as `part5`, a task \
                 such as `part1.task2` or a case such as `part1.task3/slivers`"
            )
        })?;
        names.extend(found.into_iter().map(str::to_string));
    }
    let is_left = before.tasks().any(|task| !names.contains(&task.key));
    ensure(is_left, || "`leave_out` leaves no task".to_string())?;
    Ok(names)
}

/// Returns an error if `points` names a case that First Light does not have, or gives it no points.
fn check_points(before: &Course, changes: &Changes) -> Result<(), GraderError> {
    for (name, points) in changes.points() {
        let (key, case) = name.split_once('/').unwrap_or((name, ""));
        let of_course = task(before, key, name)?;
        let of_examples = case == YOUR_EXAMPLES;
        if let Some(why) = examples::why_not(key).filter(|_| of_examples) {
            return Err(GraderError::new(format!(
                "course.toml: `points` names `{name}`, but examples of {key} cannot be judged: {why}"
            )));
        }
        ensure(of_examples || has_case(of_course, case), || {
            format!(
                "`points` names `{name}`: expected a case such as `part1.task3/range`; `cargo grader explain {key}` lists \
                 those of {key}"
            )
        })?;
        ensure(are_quarters(points), || {
            format!(
                "`points` gives {points} to `{name}`: expected quarters of a point, and more than 0. To ask the case no \
                 more, name it in `leave_out`"
            )
        })?;
    }
    Ok(())
}

/// Returns an error if a case of the teacher has no points.
fn check_cases(changes: &Changes) -> Result<(), GraderError> {
    let unfit = |(_, case): &(&String, &OwnCase)| !are_quarters(case.points);
    match changes.cases.iter().find(unfit) {
        None => Ok(()),
        Some((name, OwnCase { points, .. })) => Err(GraderError::new(format!(
            "cases/{name}.toml: it has {points} points: expected quarters of a point, and more than 0"
        ))),
    }
}

/// Whether the sum of such points is exact, so that the same points are printed everywhere.
fn are_quarters(points: f64) -> bool {
    points > 0.0 && points < 1e6 && (points * 4.0).fract() == 0.0
}

fn task<'a>(course: &'a Course, key: &str, name: &str) -> Result<&'a Task, GraderError> {
    course.tasks().find(|task| task.key == key).ok_or_else(|| {
        GraderError::new(format!(
            "course.toml names `{name}`, but First Light has no task `{key}`"
        ))
    })
}

fn has_case(task: &Task, case: &str) -> bool {
    task.cases.iter().any(|entry| entry.name == case)
}

fn ensure(condition: bool, message: impl FnOnce() -> String) -> Result<(), GraderError> {
    match condition {
        true => Ok(()),
        false => Err(GraderError::new(format!("course.toml: {}", message()))),
    }
}

fn text(table: &Table, key: &str) -> String {
    let value = table.get(key).and_then(Item::as_str);
    value.unwrap_or_default().to_string()
}

/// The name of a case in the teacher's file, such as `part1.task3/range`.
fn name_of(task: &str, case: &Value) -> String {
    let table = case.as_inline_table();
    let name = table.and_then(|table| table.get("name")?.as_str());
    format!("{task}/{}", name.unwrap_or_default())
}

/// The entry of a teacher's case, on a line of its own.
fn entry_of(name: &str, case: &OwnCase) -> Value {
    let mut entry = InlineTable::new();
    let tier = match case.tier {
        Tier::Core => "core",
        Tier::Robust => "robust",
    };
    entry.insert("name", name.into());
    entry.insert("tier", tier.into());
    entry.insert("points", number(case.points));
    let mut entry = Value::from(entry);
    *entry.decor_mut() = toml_edit::Decor::new("\n    ", "");
    entry
}

/// Points as an integer, if they are one.
fn number(points: f64) -> Value {
    match points.fract() == 0.0 {
        true => Value::from(points as i64),
        false => Value::from(points),
    }
}

/// Sets the points of a case, and keeps the blanks around them.
fn set_points(case: &mut InlineTable, points: f64) {
    if let Some(value) = case.get_mut("points") {
        let decor = value.decor().clone();
        *value = number(points);
        *value.decor_mut() = decor;
    }
}

/// `[term]`, as `stages/course.toml` has it.
fn table_of(term: &Term) -> Table {
    let mut table = Table::new();
    table.insert("name", toml_edit::value(&term.name));
    table.insert("when", toml_edit::value(&term.when));
    let dates = term.dates.iter().map(|dates| {
        let mut entry = InlineTable::new();
        entry.insert("part", i64::from(dates.part).into());
        for (name, date) in [("opens", dates.opens), ("due", dates.due)] {
            if let Some(date) = date {
                entry.insert(name, date.into());
            }
        }
        Value::from(entry)
    });
    let dates: toml_edit::Array = dates.collect();
    table.insert("dates", toml_edit::value(dates));
    if let Some(late) = &term.late {
        let mut entry = InlineTable::new();
        entry.insert("grace_minutes", i64::from(late.grace_minutes).into());
        entry.insert("percent_per_day", late.percent_per_day.into());
        if let Some(days) = late.most_days {
            entry.insert("most_days", i64::from(days).into());
        }
        table.insert("late", toml_edit::value(entry));
    }
    table
}
