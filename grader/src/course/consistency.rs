//! Checks that `course.toml`, the grader's cases and the goldens agree with each other.

use crate::course::{Course, packed};
use base::Workspace;
use judge::Tier;
use judge::cases::Spec;
use wire::Work;

/// Lists what does not agree: cases in `course.toml` that the grader does not have, cases without
/// points, and missing goldens.
pub fn problems(workspace: &Workspace, course: &Course, specs: &[Spec]) -> Vec<String> {
    let mut problems = Vec::new();
    for task in course.tasks() {
        for entry in &task.cases {
            if !specs.iter().any(|spec| spec.is(&task.key, &entry.name)) {
                problems.push(format!(
                    "{}: course.toml lists the case `{}`, but the grader has no such case",
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
        if course.leaves_out(spec.task, Some(spec.name)) {
            continue;
        }
        if !listed.any(is_listed) {
            problems.push(format!(
                "{}: the grader has the case `{}`, but course.toml does not list it",
                spec.task, spec.name
            ));
            continue;
        }
        if !spec.is_own {
            problems.extend(missing_golden(workspace, spec));
        }
    }
    problems
}

/// A message about the golden file that the case `spec` needs and that does not exist, if any.
pub fn missing_golden(workspace: &Workspace, spec: &Spec) -> Option<String> {
    let snapshot = workspace.snapshot(spec.task, spec.name);
    let has_snapshot = matches!(
        packed::read_snapshot(workspace, spec.task, spec.name),
        Ok(Some(_))
    );
    let picture = workspace.golden_picture(spec.task, spec.name);
    let missing = if spec.picture.is_some() && !picture.is_file() {
        picture
    } else if !matches!(spec.work, Work::Timing(_)) && !has_snapshot {
        snapshot
    } else {
        return None;
    };
    Some(format!(
        "{}: the case `{}` has no golden {}. Run `grader bless {}` to write it",
        spec.task,
        spec.name,
        missing
            .strip_prefix(workspace.root())
            .unwrap_or(&missing)
            .display(),
        spec.task
    ))
}

/// The sum of the core points and the sum of the robust points of the course.
pub fn total_points(course: &Course) -> [f64; 2] {
    [Tier::Core, Tier::Robust].map(|tier| course.tasks().map(|task| task.points(tier)).sum())
}

#[cfg(test)]
mod tests {
    use super::*;
    use judge::cases::all;
    use judge::expected::HitOrMiss;

    #[test]
    fn core_cases_contain_hits_and_few_undecidable_probes() {
        let course = Course::parse(include_str!("../../../stages/course.toml"))
            .expect("the course is valid");
        let specs = all(0);
        let mut probes = 0;
        for task in course.tasks() {
            for entry in task.cases.iter().filter(|case| case.tier == Tier::Core) {
                let spec = specs
                    .iter()
                    .find(|spec| spec.is(&task.key, &entry.name))
                    .expect("the grader has every case of the course");
                let expected = spec.expected(Tier::Core);
                let count = |decision| expected.iter().filter(|e| e.decision() == decision).count();
                let (hits, undecidable) = (count(HitOrMiss::Hit), count(HitOrMiss::Either));
                let counts = format!(
                    "{} {}: {hits} hits and {undecidable} undecidable of {} probes",
                    task.key,
                    entry.name,
                    expected.len()
                );
                // Code that always returns a miss must lose points, and so must any constant
                // answer.
                assert!(expected.is_empty() || hits > 0, "{counts}");
                assert!(undecidable * 50 <= expected.len(), "{counts}");
                probes += expected.len();
            }
        }
        assert!(probes > 3000, "{probes} probes");
    }
}
