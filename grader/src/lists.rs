//! Do `course.toml`, the grader's cases and the goldens list the same?

use crate::course::Course;
use crate::workspace::Workspace;
use judge::Tier;
use judge::cases::Spec;
use wire::Work;

/// Cases that are listed and not there, or there and worth nothing; goldens that are missing or left over.
pub fn find(workspace: &Workspace, course: &Course, specs: &[Spec]) -> Vec<String> {
    let mut complaints = Vec::new();
    for task in course.tasks() {
        for entry in &task.cases {
            if !specs.iter().any(|spec| spec.is(&task.key, &entry.name)) {
                complaints.push(format!(
                    "{}: course.toml lists the case `{}`, which the grader does not have",
                    task.key, entry.name
                ));
            }
        }
    }
    for spec in specs {
        let is_listed = |(key, name): (&str, &str)| spec.is(key, name);
        let mut listed = course.tasks().flat_map(|task| {
            task.cases
                .iter()
                .map(|case| (task.key.as_str(), case.name.as_str()))
        });
        if !listed.any(is_listed) {
            complaints.push(format!(
                "{}: the grader has the case `{}`, which course.toml gives no points",
                spec.task, spec.name
            ));
            continue;
        }
        complaints.extend(missing_golden(workspace, spec));
    }
    complaints
}

/// The golden that the case `spec` lacks, if it lacks one, in a sentence.
pub fn missing_golden(workspace: &Workspace, spec: &Spec) -> Option<String> {
    let snapshot = workspace.snapshot(spec.task, spec.name);
    let picture = workspace.golden_picture(spec.task, spec.name);
    let missing = if spec.picture.is_some() && !picture.is_file() {
        picture
    } else if !matches!(spec.work, Work::Timing(_)) && !snapshot.is_file() {
        snapshot
    } else {
        return None;
    };
    Some(format!(
        "{}: the case `{}` has no golden {}. `grader bless {}` writes it",
        spec.task,
        spec.name,
        missing
            .strip_prefix(workspace.root())
            .unwrap_or(&missing)
            .display(),
        spec.task
    ))
}

/// The course's points: core and robust.
pub fn points(course: &Course) -> [f64; 2] {
    [Tier::Core, Tier::Robust].map(|tier| course.tasks().map(|task| task.points(tier)).sum())
}

#[cfg(test)]
mod tests {
    use super::*;
    use judge::cases::all;
    use judge::expected::Decision;
    use judge::truths::expected;

    #[test]
    fn core_probes_are_decided() {
        let course =
            Course::parse(include_str!("../../stages/course.toml")).expect("the course is sound");
        let specs = all(0);
        let mut probed = 0;
        for task in course.tasks() {
            for entry in task.cases.iter().filter(|case| case.tier == Tier::Core) {
                let spec = specs.iter().find(|spec| spec.is(&task.key, &entry.name));
                let spec = spec.expect("every case of the course is there");
                let expected = expected(spec, Tier::Core);
                let count = |decision| expected.iter().filter(|e| e.decision() == decision).count();
                let (hits, open) = (count(Decision::Hit), count(Decision::Either));
                let name = format!("{} {}: {hits} hits, {open} open", task.key, entry.name);
                // Whoever always says miss must lose points, and nobody gets them for nothing.
                assert!(expected.is_empty() || hits > 0, "{name}");
                assert!(open * 50 <= expected.len(), "{name} of {}", expected.len());
                probed += expected.len();
            }
        }
        assert!(probed > 3000, "{probed}");
    }
}
