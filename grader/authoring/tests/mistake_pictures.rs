//! The pictures of mistakes in the book are those that `grader mutants all --pictures` makes.

use authoring::mutants::mistake_pictures::{self, Sheet};
use base::Workspace;
use grader::course::Course;
use grader::gym::mistake_sheet;
use pictures::{Image, png};
use std::fs;
use std::path::Path;

/// The largest size of a file. All of them are in every handout.
const LARGEST: usize = 10_240;

const COMMAND: &str = "run `grader mutants all --pictures` and look at what it makes";

fn workspace() -> Workspace {
    Workspace::above(Path::new(env!("CARGO_MANIFEST_DIR"))).expect("this is in the project")
}

fn course(workspace: &Workspace) -> Course {
    Course::read(workspace).expect("course.toml can be read")
}

/// Without rendering anything: the first picture of each file is the golden one.
#[test]
fn each_task_has_a_small_file_that_begins_with_the_golden_picture() {
    let workspace = workspace();
    let sheets = Sheet::all(&workspace).expect("the list can be read");
    let keys: Vec<&str> = sheets.iter().map(|sheet| sheet.task.as_str()).collect();
    let course = course(&workspace);
    let tasks: Vec<&str> = course.tasks().map(|task| task.key.as_str()).collect();
    assert_eq!(keys, tasks);
    for sheet in &sheets {
        let path = sheet.file(&workspace);
        let file = fs::read(&path).unwrap_or_else(|e| panic!("{}: {e}: {COMMAND}", path.display()));
        let bytes = file.len();
        assert!(bytes <= LARGEST, "{}: {bytes} bytes", path.display());
        let picture = png::decode(&file).expect("a picture");
        let golden_picture =
            mistake_pictures::golden(&workspace, &sheet.task).expect("a golden picture");
        let golden = sheet.tile(&golden_picture);
        let shown = |number| mistake_sheet::picture(&picture, number).expect("it is in the sheet");
        assert!(
            shown(0) == golden,
            "{} does not begin with the golden picture: {COMMAND}",
            path.display()
        );
        let large = sheet.large_file(&workspace);
        let large =
            png::read(&large).unwrap_or_else(|e| panic!("{}: {e}: {COMMAND}", large.display()));
        let panel = sheet.panel(&golden_picture);
        let [width, height] = panel.size();
        let first = Image::from_fn([width, height], |x, y| large.get(x, y));
        assert!(
            first == panel,
            "{}: the large picture: {COMMAND}",
            sheet.task
        );
        for number in 1..=sheet.mutants.len() {
            assert!(
                shown(number as u32) != golden,
                "{}: the picture of {} is the golden one",
                path.display(),
                sheet.mutants[number - 1]
            );
        }
    }
}

#[test]
#[ignore = "builds and renders about fifty mutants: a minute"]
fn the_pictures_are_those_of_the_mutants() {
    let workspace = workspace();
    let course = course(&workspace);
    let tasks: Vec<_> = course.tasks().collect();
    let rendered = mistake_pictures::render(&workspace, &course, &tasks);
    for (path, file) in rendered.expect("all mutants render their pictures") {
        let stored = fs::read(&path).unwrap_or_default();
        assert!(stored == file, "{}: {COMMAND}", path.display());
    }
}
