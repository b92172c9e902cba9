//! The list of files that are a solution from the first line to the last.

use base::GraderError;
use grader::course::Course;
use std::path::{Path, PathBuf};

/// Fails if the course lists solutions that are not among the `paths` of its files, whose task it
/// does not have, or that students hand in: who compares submissions with the course knows markers
/// only.
pub(super) fn check(course: &Course, paths: &[PathBuf]) -> Result<(), GraderError> {
    let keys: Vec<&str> = (course.holes().map(|(_, key)| key))
        .chain(course.tasks_left_out())
        .collect();
    let stages = course.stages();
    for (key, listed) in &course.whole_solutions {
        for path in listed {
            let in_stage = |stage: &&str| path.starts_with(Path::new("stages").join(stage));
            let problem = if !keys.contains(&key.as_str()) {
                "there is no such task"
            } else if !paths.iter().any(|file| file.starts_with(path)) {
                "there is no such file"
            } else if is_in_another_list(course, key, path) {
                "another task lists it, too, and one of the two would decide"
            } else if stages.iter().any(in_stage) {
                "students hand in its stage, where solutions stand between markers"
            } else {
                continue;
            };
            return Err(GraderError::new(format!(
                "`whole_solutions` of course.toml lists {} for {key}, but {problem}",
                path.display()
            )));
        }
    }
    Ok(())
}

/// Whether another list than that of the task `key` has `path`, a folder that it is in, or a file in
/// it.
fn is_in_another_list(course: &Course, key: &str, path: &Path) -> bool {
    let lists = course.whole_solutions.iter();
    let mut others = lists.filter(|(other, _)| *other != key);
    others.any(|(_, listed)| {
        let mut listed = listed.iter();
        listed.any(|other| other.starts_with(path) || path.starts_with(other))
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeMap;

    #[test]
    fn a_list_that_would_leave_a_solution_in_a_handout_is_an_error() {
        let text = include_str!("../../../stages/course.toml");
        let mut course = Course::parse(text).expect("it is valid");
        let paths = ["stages/lanes/src/mis.rs", "stages/direct/src/mis.rs"].map(PathBuf::from);
        let mut of = |key: &str, path: &str| {
            course.whole_solutions = BTreeMap::from([(key.to_string(), vec![path.into()])]);
            check(&course, &paths).err().map(|error| error.to_string())
        };
        assert_eq!(of("part6.task2", "stages/lanes/src"), None);
        for (key, path, problem) in [
            ("part6.task3", "stages/lanes/src", "no such task"),
            ("part6.task2", "stages/lanes/src/miss.rs", "no such file"),
            ("part3.task3", "stages/direct/src", "hand in its stage"),
        ] {
            let error = of(key, path).unwrap_or_default();
            assert!(error.contains(path) && error.contains(problem), "{error}");
        }
        let lists = [
            ("part1.task3", "stages/lanes/src"),
            ("part6.task2", "stages/lanes/src/mis.rs"),
        ];
        course.whole_solutions = lists
            .map(|(key, path)| (key.to_string(), vec![path.into()]))
            .into();
        let error = check(&course, &paths)
            .expect_err("in two lists")
            .to_string();
        assert!(error.contains("another task lists it"), "{error}");
    }
}
