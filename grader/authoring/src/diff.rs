//! Compares two versions of the course: what changed for a student who has the older one.

use base::{GraderError, Workspace};
use grader::course::{CaseEntry, Course, Task, packed};
use judge::Tier;
use std::collections::BTreeSet;
use std::fmt::Write;

/// One difference between two versions of the course.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Change {
    /// The key of the task.
    pub task: String,
    /// The name of the case; `None` if the change is about the task itself.
    pub case: Option<String>,
    /// What changed.
    pub what: String,
}

/// Lists what differs from `old` to `new`: tasks, cases, points and goldens, in the order of the
/// course. What was removed comes last in its task, removed tasks come last of all.
pub fn changes(old: &Workspace, new: &Workspace) -> Result<Vec<Change>, GraderError> {
    let (before, after) = (Course::read(old)?, Course::read(new)?);
    let mut changes = Vec::new();
    for task in after.tasks() {
        match before.tasks().find(|other| other.key == task.key) {
            Some(earlier) => changes.extend(changes_of_task(earlier, task, old, new)?),
            None => changes.push(of_task(task, format!("new: {}", points(&task.cases)))),
        }
    }
    let removed = before
        .tasks()
        .filter(|task| after.tasks().all(|other| other.key != task.key));
    changes.extend(removed.map(|task| of_task(task, format!("removed: {}", points(&task.cases)))));
    Ok(changes)
}

fn changes_of_task(
    before: &Task,
    after: &Task,
    old: &Workspace,
    new: &Workspace,
) -> Result<Vec<Change>, GraderError> {
    let mut changes = Vec::new();
    if before.title != after.title {
        changes.push(of_task(after, format!("title: was \"{}\"", before.title)));
    }
    let (was, is) = (functions(before), functions(after));
    if was != is {
        let what = format!("functions: {} -> {}", list(&was), list(&is));
        changes.push(of_task(after, what));
    }
    if picture(before, old) != picture(after, new) {
        changes.push(of_task(after, "golden picture changed".into()));
    }
    let of_case = |case: &CaseEntry, what: String| Change {
        task: after.key.clone(),
        case: Some(case.name.clone()),
        what,
    };
    for case in &after.cases {
        let Some(earlier) = before.cases.iter().find(|other| other.name == case.name) else {
            changes.push(of_case(case, format!("new: {}", worth(case))));
            continue;
        };
        if worth(earlier) != worth(case) {
            let what = format!("points: {} -> {}", worth(earlier), worth(case));
            changes.push(of_case(case, what));
        }
        let golden = |workspace| packed::read_snapshot(workspace, &after.key, &case.name);
        let what = golden_change(golden(old)?.as_deref(), golden(new)?.as_deref());
        changes.extend(what.map(|what| of_case(case, what)));
    }
    let removed = before
        .cases
        .iter()
        .filter(|case| after.cases.iter().all(|other| other.name != case.name));
    changes.extend(removed.map(|case| of_case(case, format!("removed: {}", worth(case)))));
    Ok(changes)
}

fn of_task(task: &Task, what: String) -> Change {
    Change {
        task: task.key.clone(),
        case: None,
        what,
    }
}

fn functions(task: &Task) -> BTreeSet<&str> {
    task.holes.iter().map(String::as_str).collect()
}

fn list(names: &BTreeSet<&str>) -> String {
    names.iter().copied().collect::<Vec<_>>().join(", ")
}

/// The golden picture of a task, if there is one.
fn picture(task: &Task, workspace: &Workspace) -> Option<Vec<u8>> {
    std::fs::read(workspace.golden_picture(&task.key, "task")).ok()
}

/// The points of a case, such as "2 core points".
fn worth(case: &CaseEntry) -> String {
    let tier = match case.tier {
        Tier::Core => "core",
        Tier::Robust => "robust",
    };
    let unit = if case.points == 1.0 {
        "point"
    } else {
        "points"
    };
    format!("{} {tier} {unit}", case.points)
}

/// The number of cases and the sums of their points.
fn points(cases: &[CaseEntry]) -> String {
    let sum = |tier: Tier| -> f64 {
        let of_tier = cases.iter().filter(|case| case.tier == tier);
        of_tier.fold(0.0, |sum, case| sum + case.points)
    };
    let unit = if cases.len() == 1 { "case" } else { "cases" };
    format!(
        "{} {unit}, {} core and {} robust points",
        cases.len(),
        sum(Tier::Core),
        sum(Tier::Robust)
    )
}

/// How a golden snapshot changed; `None` if it did not.
fn golden_change(before: Option<&str>, after: Option<&str>) -> Option<String> {
    match (before, after) {
        (before, after) if before == after => None,
        (Some(before), Some(after)) => {
            let (was, is): (Vec<&str>, Vec<&str>) =
                (before.lines().collect(), after.lines().collect());
            let same = was.iter().zip(&is).filter(|(a, b)| a == b).count();
            let lines = was.len().max(is.len());
            Some(format!("golden: {} of {lines} lines differ", lines - same))
        }
        (None, _) => Some("golden: new".into()),
        (_, None) => Some("golden: removed".into()),
    }
}

/// Formats the changes as a table, under a line with the two versions.
pub fn table(changes: &[Change], old: &Workspace, new: &Workspace) -> String {
    let version = |workspace: &Workspace| match workspace.version() {
        Some(version) => format!("version {version}"),
        None => "no version".into(),
    };
    let mut text = format!(
        "{} ({}) -> {} ({})\n",
        old.root().display(),
        version(old),
        new.root().display(),
        version(new)
    );
    if changes.is_empty() {
        text.push_str("No task, case, point or golden changed.\n");
        return text;
    }
    let rows: Vec<[&str; 3]> = changes
        .iter()
        .map(|change| {
            let case = change.case.as_deref().unwrap_or_default();
            [change.task.as_str(), case, change.what.as_str()]
        })
        .collect();
    let width = |column: usize| rows.iter().map(|row| row[column].len()).max().unwrap_or(0);
    let (task_width, case_width) = (width(0).max(4), width(1).max(4));
    let head = ["task", "case", "change"];
    for [task, case, what] in [&[head][..], &rows].concat() {
        let _ = writeln!(text, "{task:task_width$}  {case:case_width$}  {what}");
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;
    use std::path::Path;

    /// A version of the course with one task of stage `bbox`, its cases and a golden.
    fn version(root: &Path, version: &str, cases: &str, golden: &str) -> Workspace {
        fs::create_dir_all(root.join("stages/bbox")).unwrap();
        fs::create_dir_all(root.join("golden/part2.task1")).unwrap();
        fs::write(
            root.join("Cargo.toml"),
            format!("[workspace.package]\nversion = \"{version}\"\n"),
        )
        .unwrap();
        let course = format!(
            "conventions = []\n[[part]]\nnumber = 2\ntitle = \"B\"\n[[part.task]]\nkey = \"part2.task1\"\ntitle = \"T\"\nstage = \"bbox\"\nholes = [\"f\"]\ncases = [{cases}]\n"
        );
        fs::write(root.join("stages/course.toml"), course).unwrap();
        fs::write(root.join("golden/part2.task1/kept.snap"), golden).unwrap();
        Workspace::of_any_version(root).unwrap()
    }

    #[test]
    fn cases_points_and_goldens_that_changed_are_listed() {
        let folders = [(); 2].map(|()| tempfile::tempdir().unwrap());
        let old = version(
            folders[0].path(),
            "0.1.0",
            "{ name = \"kept\", tier = \"core\", points = 1 }, { name = \"gone\", tier = \"robust\", points = 2 }",
            "a\nb\n",
        );
        let new = version(
            folders[1].path(),
            "0.2.0",
            "{ name = \"kept\", tier = \"core\", points = 3 }, { name = \"fresh\", tier = \"core\", points = 1 }",
            "a\nc\nd\n",
        );
        let changes = changes(&old, &new).unwrap();
        let listed: Vec<(&str, &str)> = changes
            .iter()
            .map(|change| (change.case.as_deref().unwrap_or(""), change.what.as_str()))
            .collect();
        assert_eq!(
            listed,
            [
                ("kept", "points: 1 core point -> 3 core points"),
                ("kept", "golden: 2 of 3 lines differ"),
                ("fresh", "new: 1 core point"),
                ("gone", "removed: 2 robust points"),
            ]
        );
        let table = table(&changes, &old, &new);
        assert!(table.contains("(version 0.1.0) -> "), "{table}");
        assert!(table.contains("\ntask         case   change\n"), "{table}");
        assert!(
            table.contains("\npart2.task1  fresh  new: 1 core point\n"),
            "{table}"
        );
    }

    #[test]
    fn a_version_does_not_differ_from_itself() {
        let folder = tempfile::tempdir().unwrap();
        let case = "{ name = \"kept\", tier = \"core\", points = 1 }";
        let same = version(folder.path(), "0.1.0", case, "a\n");
        let changes = changes(&same, &same).unwrap();
        assert_eq!(changes, []);
        let table = table(&changes, &same, &same);
        assert!(table.ends_with("No task, case, point or golden changed.\n"));
    }
}
