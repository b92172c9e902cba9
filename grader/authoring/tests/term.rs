//! The folder of a term: what its files change, and what an update changes in it.

use authoring::check::book;
use authoring::term::build::build;
use authoring::term::new::new;
use authoring::term::update::Update;
use authoring::term::{own_case, own_mistakes};
use base::Workspace;
use base::term::COPY;
use grader::course::{Course, consistency};
use grader::diagnosis;
use handout::Handout;
use judge::{Tier, own_cases};
use std::fs;
use std::path::{Path, PathBuf};

fn first_light() -> Workspace {
    Workspace::above(Path::new(env!("CARGO_MANIFEST_DIR"))).expect("the grader is in the course")
}

/// A new term in a temporary folder.
fn term() -> (tempfile::TempDir, PathBuf) {
    let folder = tempfile::tempdir().expect("a folder");
    let root = folder
        .path()
        .canonicalize()
        .expect("it exists")
        .join("cs101");
    new(
        &first_light(),
        &root,
        "CS \"101\"",
        "Spring 2027",
        "https://example.org/f.git",
    )
    .expect("a term");
    (folder, root)
}

/// What students read of the rule in the comments of `course.toml`.
const LATE: &str = "Late work loses 10 % of its points for each day that begins after the deadline. The first 15 minutes \
                    are free. More than 5 days late it gets no points.";

/// Replaces a text in a file that contains it once.
fn edit(path: &Path, old: &str, new: &str) {
    let text = fs::read_to_string(path).expect("a file");
    assert_eq!(text.matches(old).count(), 1, "{old} in {}", path.display());
    fs::write(path, text.replace(old, new)).expect("it is writable");
}

fn copy_of(root: &Path) -> Workspace {
    Workspace::above(&root.join(COPY)).expect("it is built")
}

/// The error of a build with this text in place of the empty list `leave_out`.
fn error_with(root: &Path, settings: &str) -> String {
    let file = root.join("course.toml");
    let text = fs::read_to_string(&file).expect("a file");
    fs::write(&file, text.replacen("\nleave_out = []\n", settings, 1)).expect("it is writable");
    let error = build(&copy_as_it_is(root), root).expect_err("it is wrong");
    fs::write(&file, text).expect("it is writable");
    error.to_string()
}

fn copy_as_it_is(root: &Path) -> Workspace {
    Workspace::above_as_it_is(root).expect("there is a copy")
}

#[test]
fn the_files_of_a_term_change_course_book_and_handouts() {
    let (_folder, root) = term();
    assert_eq!(
        fs::read(copy_of(&root).root().join("stages/bbox/src/lib.rs")).expect("a file"),
        fs::read(first_light().root().join("stages/bbox/src/lib.rs")).expect("a file")
    );
    let file = root.join("course.toml");
    edit(
        &file,
        "\nleave_out = []\n",
        "\nleave_out = [\"part3\", \"part4\", \"part5\", \"part6\", \"part1.task4\", \"part1.task3/slivers\"]\n",
    );
    edit(
        &file,
        "# \"part1.task3/range\" = 5",
        "\"part1.task3/range\" = 5.5\n\"part1.task2/your_examples\" = 2",
    );
    edit(
        &file,
        "\ndates = []\n",
        "\ndates = [{ part = 1, due = 2027-02-15T23:59:00+01:00 }]\n",
    );
    edit(
        &file,
        "# [late]\n# grace_minutes = 15\n# percent_per_day = 10\n# most_days = 5\n",
        "[late]\ngrace_minutes = 15\npercent_per_day = 10\nmost_days = 5\n",
    );
    fs::write(root.join("front.md"), "Ask in room 7.\n").expect("it is writable");
    fs::create_dir(root.join("scenes")).expect("a folder");
    fs::write(root.join("scenes/ours.dae"), "<COLLADA/>").expect("it is writable");
    assert!(Workspace::above(&root).is_err(), "nothing is applied yet");
    build(&copy_as_it_is(&root), &root).expect("it is right");

    let workspace = copy_of(&root);
    let course = Course::read(&workspace).expect("a course");
    let task = course.select("part1.task3").expect("a task")[0];
    assert_eq!(
        [Tier::Core, Tier::Robust].map(|tier| task.points(tier)),
        [34.0, 15.0]
    );
    let cameras = course.select("part1.task2").expect("a task")[0];
    assert_eq!((task.examples, cameras.examples), (0.0, 2.0));
    let error = course
        .select("part1.task4")
        .expect_err("it is left out")
        .to_string();
    assert!(
        error.contains("this course leaves `part1.task4` out"),
        "{error}"
    );
    assert_eq!(course.parts.len(), 2);
    let specs = judge::cases::all(0);
    assert_eq!(consistency::problems(&workspace, &course, &specs), [""; 0]);
    assert_eq!(
        book::problems(&workspace, &course).expect("a book"),
        [""; 0]
    );
    let read = |path: &str| fs::read_to_string(workspace.root().join(path)).expect("a file");
    let front = read("stages/book/src/introduction.md");
    for words in [
        "**CS \"101\", Spring 2027**",
        "Ask in room 7.",
        "| 1 |  | 2027-02-15 23:59+01:00 |",
        LATE,
        "There are 6 tasks.",
    ] {
        assert!(front.contains(words), "{words}: {front}");
    }
    assert!(read("stages/book/src/part1/task4.md").contains("leaves the task out"));
    assert!(
        read("stages/book/src/part1/README.md")
            .contains("gives the code of: Intersecting spheres.*")
    );
    assert!(!read("stages/book/src/part2/README.md").contains("gives the code of"));

    let handout = Handout::carve(&workspace, 1).expect("a handout");
    let text = |path: &str| String::from_utf8_lossy(&handout.files[Path::new(path)]).into_owned();
    assert!(text("stages/intersect/src/triangle.rs").contains("hole!(\"part1.task3\""));
    let sphere = text("stages/intersect/src/sphere.rs");
    assert!(
        !sphere.contains("hole!") && !sphere.contains("SOLUTION"),
        "{sphere}"
    );
    assert!(
        !handout
            .removed
            .iter()
            .any(|removed| removed.key == "part4.task1")
    );
    assert!(text("README.md").contains("| 1 |  | 2027-02-15 23:59+01:00 |"));
    assert!(text("README.md").contains(LATE));
    assert!(handout.files.contains_key(Path::new("scenes/dae/ours.dae")));

    // What is taken back is as it was.
    fs::remove_dir_all(root.join("scenes")).expect("it is removable");
    edit(&file, "\"part1.task3/range\" = 5.5\n", "");
    build(&copy_as_it_is(&root), &root).expect("it is right");
    assert!(!workspace.root().join("scenes/dae/ours.dae").exists());
    let course = Course::read(&copy_of(&root)).expect("a course");
    assert_eq!(
        course.select("part1.task3").expect("a task")[0].points(Tier::Core),
        30.0
    );

    let chapter = "stages/book/src/part1/task1.md";
    fs::remove_file(workspace.root().join(chapter)).expect("it is removable");
    let problems = book::problems(&workspace, &course).expect("a book");
    assert_eq!(
        problems,
        [format!("{chapter}: the chapter of part1.task1 is missing")]
    );
}

/// Without a network or the tag, what `get-first-light` got before is kept.
#[test]
#[cfg(unix)]
fn a_clone_that_fails_takes_nothing_away() {
    let folder = tempfile::tempdir().expect("a folder");
    let root = folder.path();
    let script = include_str!("../src/term/new/get-first-light");
    fs::write(root.join("get-first-light"), script).expect("it is writable");
    let settings = "[first_light]\nversion = \"9.9.9\"\nsource = \"nowhere\"\n";
    fs::write(root.join("course.toml"), settings).expect("it is writable");
    fs::create_dir(root.join(COPY)).expect("a folder");
    let output = std::process::Command::new("sh")
        .arg(root.join("get-first-light"))
        .output()
        .expect("a shell");
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(!output.status.success(), "{errors}");
    assert!(
        errors.contains("cannot clone the tag v9.9.9 of nowhere"),
        "{errors}"
    );
    assert!(root.join(COPY).is_dir(), "{errors}");
}

#[test]
fn settings_that_mean_nothing_are_told() {
    let (_folder, root) = term();
    for (settings, expected) in [
        (
            "\nleave_out = [\"part9\"]\n",
            "`leave_out` names `part9`, which First Light does not have",
        ),
        (
            "\nleave_out = [\"part1.task3/rang\"]\n",
            "part1.task3 has no such case",
        ),
        (
            "\nleave_out = [\"part1.task3/front_face\"]\n",
            "this case shows the idea of part1.task3",
        ),
        (
            "\nleave_out = [\"part1\", \"part2\", \"part3\", \"part4\", \"part5\"]\n",
            "leaves no task",
        ),
        (
            "\npoints = { \"part1.task3/range\" = 0.1 }\n",
            "course.toml",
        ),
        ("\nleaveout = []\n", "unknown field `leaveout`"),
    ] {
        let error = error_with(&root, settings);
        assert!(error.contains(expected), "{settings}{error}");
    }
    fs::create_dir(root.join("stages")).expect("a folder");
    let error = error_with(&root, "\nleave_out = []\n");
    assert!(error.contains("a term cannot have own stages"), "{error}");
}

#[test]
fn a_mistake_of_the_teacher_is_listed_and_what_was_learnt_of_it_is_known() {
    let (_folder, root) = term();
    let list = root.join("mistakes/part1.task3.txt");
    fs::create_dir(root.join("mistakes")).expect("a folder");
    let text = "mistake our_culling: misses back faces\n  hint: Both faces are hit.\n  reference: a ~> b\n";
    fs::write(&list, text).expect("it is writable");
    build(&copy_as_it_is(&root), &root).expect("it is right");
    let workspace = copy_of(&root);
    let read = |path: &str| fs::read_to_string(workspace.root().join(path)).expect("a file");
    let of_task = "grader/mutants/part1.task3.txt";
    assert!(
        read(of_task)
            .contains("\nmistake our_culling: misses back faces (a mistake of this course)\n")
    );
    let before = diagnosis::known(&workspace, "part1.task3").expect("signatures");

    // As a check stores what it learnt.
    let mut ours = before[0].clone();
    ours.mistakes = vec!["our_culling".into()];
    let learnt = own_mistakes::learnt(text, &[ours]).expect("it is packed");
    fs::write(list.with_extension("bin"), &learnt).expect("it is writable");
    build(&copy_as_it_is(&root), &root).expect("it is right");
    let after = diagnosis::known(&workspace, "part1.task3").expect("signatures");
    assert_eq!(after.len(), before.len() + 1);
    assert_eq!(after.last().expect("ours").mistakes, ["our_culling"]);

    // With Notepad's mark, a space before a mistake and code that contains a line like one.
    let odd = "\u{feff} mistake our_culling: misses back faces\n  hint: Both faces are hit.\n  reference: a ~> b\nalso our_other: misses front faces\n  code:\n    mistake a: b\n";
    fs::write(&list, odd).expect("it is writable");
    build(&copy_as_it_is(&root), &root).expect("it is right");
    let marked = " mistake our_culling: misses back faces (a mistake of this course)\n";
    assert!(read(of_task).contains(marked), "{}", read(of_task));
    let also = "\nalso our_other: misses front faces (a mistake of this course)\n";
    assert!(read(of_task).contains(also), "{}", read(of_task));
    assert!(read(of_task).ends_with("\n    mistake a: b\n"));

    // What was learnt of another list does not count.
    fs::write(&list, text.replace("back", "front")).expect("it is writable");
    build(&copy_as_it_is(&root), &root).expect("it is right");
    let known = diagnosis::known(&workspace, "part1.task3").expect("signatures");
    assert_eq!(known, before);

    for (name, text, expected) in [
        ("part1.task3.txt", "mistake", "line 1: expected"),
        (
            "part1.task3.txt",
            "mistake culled: culls\n",
            "needs `mistake culled: what the code does`",
        ),
        ("part9.task1.txt", text, "First Light has no such task"),
        ("part1.task3.md", text, "expected mistakes/TASK.txt"),
    ] {
        fs::remove_dir_all(root.join("mistakes")).expect("it is removable");
        fs::create_dir(root.join("mistakes")).expect("a folder");
        fs::write(root.join("mistakes").join(name), text).expect("it is writable");
        let error = build(&copy_as_it_is(&root), &root).expect_err("it is wrong");
        assert!(error.to_string().contains(expected), "{error}");
    }
    fs::remove_dir_all(root.join("mistakes")).expect("it is removable");
    build(&copy_as_it_is(&root), &root).expect("it is right");
    assert!(!read(of_task).contains("our_culling"));
}

#[test]
fn a_case_of_the_teacher_is_listed_with_its_points_and_in_handouts() {
    let (_folder, root) = term();
    let specs = judge::cases::of("part1.task3", 0);
    let spec = specs
        .iter()
        .find(|spec| spec.name == "range")
        .expect("a case");
    let file = root.join("cases/part1.task3/near_the_end.toml");
    fs::create_dir_all(file.parent().expect("a folder")).expect("it is writable");
    let text = own_case::template(spec, Tier::Core)
        .expect("it can be written")
        .replace("points = 1.0", "points = 1.25");
    fs::write(&file, &text).expect("it is writable");
    build(&copy_as_it_is(&root), &root).expect("it is right");
    let workspace = copy_of(&root);
    let course = Course::read(&workspace).expect("a course");
    let task = course.select("part1.task3").expect("a task")[0];
    assert_eq!(task.points(Tier::Core), 31.25);
    assert_eq!(
        book::problems(&workspace, &course).expect("a book"),
        [""; 0]
    );
    let compiled = fs::read_to_string(workspace.root().join(own_cases::FILE)).expect("a file");
    assert!(
        compiled.contains("part1.task3\tnear_the_end\t"),
        "{compiled}"
    );
    assert_ne!(compiled, own_cases::COMPILED);
    let handout = Handout::carve(&workspace, 1).expect("a handout");
    assert_eq!(
        handout.files[Path::new(own_cases::FILE)],
        compiled.as_bytes()
    );

    // As long as it is not applied nothing works; without the file all is as it was.
    fs::write(&file, text.replace("1.25", "0.3")).expect("it is writable");
    assert!(Workspace::above(&root).is_err());
    let error = build(&copy_as_it_is(&root), &root)
        .expect_err("no quarters")
        .to_string();
    assert!(
        error.contains("near_the_end.toml: it has 0.3 points"),
        "{error}"
    );
    fs::remove_file(&file).expect("it exists");
    build(&copy_as_it_is(&root), &root).expect("it is right");
    let again = fs::read_to_string(root.join(COPY).join(own_cases::FILE)).expect("a file");
    assert_eq!(again, own_cases::COMPILED);
}

#[test]
fn an_update_keeps_the_points_that_were_given() {
    let (_folder, root) = term();
    // As if the term had been made with an older First Light: of other points, without a case.
    let list = root.join(COPY).join("stages/course.toml");
    edit(
        &list,
        "    { name = \"range\", tier = \"core\", points = 1.5 },\n    { name = \"range_ends\", tier = \"core\", points = 0.5 },\n    { name = \"edges_and_vertices\", tier = \"core\", points = 2 },\n",
        "    { name = \"range\", tier = \"core\", points = 2 },\n    { name = \"edges_and_vertices\", tier = \"core\", points = 2 },\n",
    );
    let update = Update::plan(&first_light(), &root, false).expect("an update");
    assert_eq!(
        update.kept_points,
        [
            "part1.task3/range: 2 points, and not 1.5",
            "part1.task3/range_ends, a new case with 0.5 points, is left out",
        ]
    );
    assert_eq!(update.lost_points, [""; 0]);
    assert_eq!(update.changes, []);
    let taken = Update::plan(&first_light(), &root, true).expect("an update");
    assert_eq!(taken.kept_points, [""; 0]);
    assert_eq!(
        taken.lost_points,
        ["part1.task3: divided among its cases in another way"]
    );
    let changes: Vec<&str> = taken
        .changes
        .iter()
        .map(|change| change.what.as_str())
        .collect();
    assert_eq!(
        changes,
        [
            "points: 2 core points -> 1.5 core points",
            "new: 0.5 core points"
        ]
    );
    drop(taken);

    update.carry_out().expect("it is written");
    let course = Course::read(&copy_of(&root)).expect("a course");
    let task = course.select("part1.task3").expect("a task")[0];
    let range = task
        .cases
        .iter()
        .find(|case| case.name == "range")
        .expect("a case");
    assert_eq!(range.points, 2.0);
    assert!(course.leaves_out("part1.task3", Some("range_ends")));
    // The teacher's word counts more than what was kept.
    edit(
        &root.join("course.toml"),
        "# \"part1.task3/range\" = 5",
        "\"part1.task3/range_ends\" = 1",
    );
    build(&copy_as_it_is(&root), &root).expect("it is right");
    let course = Course::read(&copy_of(&root)).expect("a course");
    assert!(!course.leaves_out("part1.task3", Some("range_ends")));
}
