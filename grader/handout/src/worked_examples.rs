//! `cargo test` in a handout: the worked examples of tasks that are not written yet are ignored, so
//! that they do not end it before the tests of what is written.

use files::file_tree::Files;
use files::manifest;
use grader::course::Task;
use std::path::{Path, PathBuf};

/// The build script of the stages that students write. It sets `open_task` for each task with a
/// gap.
const BUILD_SCRIPT: &str = include_str!("build_script.rs");

/// Its path in a handout. A build without tests leaves it out: `submission` removes the line.
const PATH: &str = "stages/open_tasks.rs";

/// The test of each stage that a handout contains although its functions may not be written.
pub(crate) const FILE: &str = "worked_example.rs";

/// Makes `cargo test` ignore the examples of these tasks while they are not written.
pub(crate) fn ignore_open<'a>(files: &mut Files, tasks: impl Iterator<Item = &'a Task>) {
    for task in tasks {
        let stage = Path::new("stages").join(&task.stage);
        let example: PathBuf = stage.join("tests").join(FILE);
        let Some(test) = files.get_mut(&example) else {
            continue;
        };
        let key = &task.key;
        let name = format!("#[test]\nfn {}_", key.replace('.', "_"));
        let ignored = format!(
            "#[cfg_attr(open_task = \"{key}\", ignore = \"{key} is not written yet\")]\n{name}"
        );
        *test = String::from_utf8_lossy(test)
            .replace(&name, &ignored)
            .into_bytes();
        if let Some(manifest) = files.get_mut(&stage.join("Cargo.toml")) {
            let text = String::from_utf8_lossy(manifest);
            *manifest = manifest::with_build_script(&text).into_bytes();
        }
        files.insert(PATH.into(), BUILD_SCRIPT.into());
    }
}

#[cfg(test)]
#[allow(dead_code, reason = "its main function is that of a build script")]
#[path = "build_script.rs"]
mod build_script;

#[cfg(test)]
mod tests {
    use super::*;
    use grader::course::Course;

    #[test]
    fn open_tasks_are_those_with_a_gap_in_the_code() {
        let text = "// kit::hole!(\"part1.task1\")\nkit::hole!(\n    \"part1.task2\",\n    x\n)\n\
                    kit::untouched!(\"part2.task1\");\nlet part1_task3 = \"part1.task3\";\n";
        assert_eq!(
            build_script::open_tasks(text),
            ["part1.task2", "part2.task1"]
        );
    }

    #[test]
    fn examples_of_open_tasks_alone_are_ignored() {
        let list = include_str!("../../../stages/course.toml");
        let course = Course::parse(list).expect("it is valid");
        let tasks = || course.tasks().filter(|task| task.key == "part1.task4");
        let path = PathBuf::from("stages/intersect/tests/worked_example.rs");
        let test = "#[test]\nfn part1_task3_a() {}\n\n#[test]\nfn part1_task4_b() {}\n";
        let mut files = Files::from([(path.clone(), test.into())]);
        ignore_open(&mut files, tasks());
        let ignored = "#[test]\nfn part1_task3_a() {}\n\n#[cfg_attr(open_task = \"part1.task4\", ignore = \
                       \"part1.task4 is not written yet\")]\n#[test]\nfn part1_task4_b() {}\n";
        assert_eq!(String::from_utf8_lossy(&files[&path]), ignored);
        assert!(files.contains_key(Path::new(PATH)));
    }
}
