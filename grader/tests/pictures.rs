//! Each task has a picture, and the text of its functions names the command that makes it.

use base::Workspace;
use grader::course::{Course, Task};
use std::path::Path;

fn course() -> (Workspace, Course) {
    let workspace = Workspace::above(Path::new(env!("CARGO_MANIFEST_DIR")))
        .expect("the grader is in a workspace");
    let course = Course::read(&workspace).expect("the course is sound");
    (workspace, course)
}

#[test]
fn each_task_has_a_golden_picture_of_its_size() {
    let (workspace, course) = course();
    let mut total = 0;
    for task in course.tasks() {
        let picture =
            judge::pictures::of(&task.key).unwrap_or_else(|| panic!("{} has no picture", task.key));
        assert_eq!(picture.task, task.key);
        assert_eq!(picture.panels.len(), picture.work.panels as usize);
        let [w, h] = picture.work.size;
        assert!(w >= 320 && h >= 240, "{} has {w} x {h} pixels", task.key);
        let path = workspace.golden_picture(&task.key, judge::pictures::NAME);
        let golden = pictures::png::read(&path).unwrap_or_else(|e| panic!("{}: {e}", task.key));
        assert_eq!(golden.size(), picture.size(), "{}", task.key);
        total += std::fs::metadata(&path).expect("it was read").len();
    }
    assert!(total < 1_000_000, "a handout has {total} bytes of pictures");
}

#[test]
fn the_text_of_each_function_ends_with_the_command_of_its_picture() {
    let (workspace, course) = course();
    for task in course.tasks() {
        for hole in &task.holes {
            let text = last_line_of_doc(&workspace, task, hole);
            let expected = format!("/// See it: `cargo grader picture {}`.", task.key);
            assert_eq!(text, expected, "{hole} of {}", task.key);
        }
    }
}

/// The last line of the doc comment of the function `hole`.
fn last_line_of_doc(workspace: &Workspace, task: &Task, hole: &str) -> String {
    let folder = workspace
        .root()
        .join("stages")
        .join(&task.stage)
        .join("src");
    let files = std::fs::read_dir(&folder).expect("the stage has sources");
    let texts = files.filter_map(|file| std::fs::read_to_string(file.ok()?.path()).ok());
    for text in texts {
        let signature = [format!("\npub fn {hole}("), format!("\npub fn {hole}<")];
        let Some(at) = signature.iter().find_map(|start| text.find(start)) else {
            continue;
        };
        let before = text[..at].lines().rev();
        let mut docs = before.filter(|line| line.starts_with("///"));
        return docs.next().unwrap_or_default().to_string();
    }
    panic!("no file below {} defines `{hole}`", folder.display())
}
