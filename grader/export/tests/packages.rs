//! What is exported for each course system.

use base::Workspace;
use export::archive;
use export::choices::Choices;
use export::systems::{ExportedFile, System};
use std::collections::BTreeSet;
use std::path::Path;
use std::process::Command;
use std::sync::OnceLock;

fn workspace() -> Workspace {
    Workspace::above(Path::new(env!("CARGO_MANIFEST_DIR"))).expect("this is the course")
}

fn choices() -> Choices {
    Choices {
        what: "part2".into(),
        title: "Bounding volumes".into(),
        part: 2,
        hint: "3".into(),
        visibility: "after_due_date".into(),
        add_extra: true,
        seed: Some(7),
        unsandboxed: true,
        public: false,
        course: Some("cs184/first-light".into()),
        reference: "v1".into(),
    }
}

/// What `system` gets for [`choices`]. It takes seconds, so it is made once.
fn files(system: System) -> &'static [ExportedFile] {
    static MADE: [OnceLock<Vec<ExportedFile>>; System::ALL.len()] =
        [const { OnceLock::new() }; System::ALL.len()];
    let at = System::ALL.iter().position(|other| *other == system);
    MADE[at.expect("it is one of them")].get_or_init(|| {
        let files = system.files(&workspace(), &choices());
        files.expect("it is exported")
    })
}

fn text<'a>(files: &'a [ExportedFile], path: &str) -> &'a str {
    let file = files.iter().find(|file| file.path == Path::new(path));
    std::str::from_utf8(&file.unwrap_or_else(|| panic!("no {path}")).contents).expect("UTF-8")
}

/// Names in braces that no value replaced.
fn unfilled(text: &str) -> Vec<&str> {
    let names = [
        "what",
        "title",
        "options",
        "packages",
        "stages",
        "toolchain",
        "course",
        "reference",
        "uuid",
        "unsandboxed",
        "contents",
        "prepare",
        "take_stages",
        "grade",
    ];
    let in_braces = |name: &&str| text.contains(&format!("{{{name}}}"));
    names.into_iter().filter(in_braces).collect()
}

#[test]
fn every_template_is_filled_with_what_was_chosen() {
    for system in System::ALL {
        for file in files(system) {
            let is_of_course = file
                .path
                .components()
                .any(|part| part.as_os_str() == "course");
            if let (false, Ok(text)) = (is_of_course, std::str::from_utf8(&file.contents)) {
                assert_eq!(
                    unfilled(text),
                    [""; 0],
                    "{system:?} {}",
                    file.path.display()
                );
                assert!(
                    !file.path.to_string_lossy().contains('{'),
                    "{:?}",
                    file.path
                );
            }
        }
    }
    let gradescope = files(System::Gradescope);
    let run = text(gradescope, "run_autograder");
    assert!(run.contains("part2 --submission"), "{run}");
    assert!(
        run.contains("--hint 3 --seed 7 --add-extra --unsandboxed --visibility after_due_date"),
        "{run}"
    );
    let classroom = files(System::Classroom50);
    assert!(text(classroom, "autograder.py").contains("COURSE = \"cs184/first-light\""));
    let actions = files(System::Actions);
    assert!(text(actions, "first-light.yml").contains("ref: v1"));
    let question = files(System::PrairieLearn);
    let info = text(question, "questions/first_light_part2/info.json");
    let info: serde_json::Value = serde_json::from_str(info).expect("it is JSON");
    assert_eq!(info["externalGradingOptions"]["enableNetworking"], false);
    assert_eq!(info["uuid"].as_str().map(str::len), Some(36));
}

#[test]
fn grading_in_a_students_repository_needs_the_repository_of_the_handout() {
    let choices = Choices {
        course: None,
        ..choices()
    };
    for system in System::ALL
        .into_iter()
        .filter(|system| system.needs_handout())
    {
        let exported = system.files(&workspace(), &choices);
        let error = exported.expect_err("it has no course").to_string();
        assert!(error.contains("expected `--course OWNER/NAME`"), "{error}");
    }
}

#[test]
fn only_systems_that_grade_in_a_container_get_solutions() {
    for system in System::ALL {
        let has_solution = files(system).iter().any(|file| {
            let text = String::from_utf8_lossy(&file.contents);
            text.contains("// BEGIN SOLUTION(part1.task3)")
        });
        assert_eq!(has_solution, !system.needs_handout(), "{system:?}");
    }
}

#[test]
fn a_public_image_has_no_solutions_and_all_that_students_have() {
    let choices = Choices {
        unsandboxed: false,
        public: true,
        ..choices()
    };
    let files = System::PrairieLearn
        .files(&workspace(), &choices)
        .expect("it is exported");
    for file in &files {
        let text = String::from_utf8_lossy(&file.contents);
        assert!(
            !text.contains("// BEGIN SOLUTION(part"),
            "{}",
            file.path.display()
        );
    }
    // References of earlier parts are handed out without markers, so their absence proves little.
    let triangle = text(&files, "image/course/stages/intersect/src/triangle.rs");
    assert!(
        triangle.contains("kit::hole!(\"part1.task3\""),
        "{triangle}"
    );
    // A handout's goldens and signatures are packed.
    let has = |path: &str| files.iter().any(|file| file.path == Path::new(path));
    assert!(has("image/course/golden/part2.task1.pack"));
    assert!(!has("image/course/golden/Cargo.toml"));
    let grade = text(&files, "image/grade.sh");
    assert_eq!(unfilled(grade), [""; 0]);
    assert!(!grade.contains("--submission"), "{grade}");
}

#[test]
fn the_zip_has_its_scripts_at_its_root_and_they_can_be_run() {
    let files = files(System::Gradescope);
    let bytes = archive::zip(files).expect("it is packed");
    assert_eq!(bytes, archive::zip(files).expect("it is packed again"));
    let mut zip = zip::ZipArchive::new(std::io::Cursor::new(bytes)).expect("it is a zip");
    for name in ["setup.sh", "run_autograder"] {
        let entry = zip.by_name(name).expect("it is at the root");
        assert_eq!(
            entry.unix_mode().map(|mode| mode & 0o777),
            Some(0o755),
            "{name}"
        );
    }
    let names: Vec<String> = zip
        .file_names()
        .map(|name| name.expect("names are UTF-8").into_owned())
        .collect();
    let tops: BTreeSet<&str> = names
        .iter()
        .filter_map(|name| name.split('/').next())
        .collect();
    assert_eq!(
        tops,
        BTreeSet::from(["course", "run_autograder", "setup.sh"])
    );
    for needed in [
        "course/stages/course.toml",
        "course/stages/bvh/src/lib.rs",
        "course/grader/submission/src/main.rs",
        "course/golden/signatures/part2.task1.bin",
    ] {
        assert!(names.iter().any(|name| name == needed), "no {needed}");
    }
    // Mistakes, pictures and tests are not needed for grading.
    for left_out in [
        "course/grader/mutants/",
        "course/scenes/pictures/",
        "course/golden/tests/",
    ] {
        assert!(
            !names.iter().any(|name| name.starts_with(left_out)),
            "{left_out}"
        );
    }
}

/// A shell or Python finds no mistake in the scripts.
#[cfg(unix)]
#[test]
fn scripts_have_no_mistakes_of_syntax() {
    let folder = tempfile::tempdir().expect("a folder");
    let check = |program: &str, arguments: &[&str], name: &str, text: &str| {
        let path = folder.path().join(name);
        std::fs::write(&path, text).expect("it is written");
        let Ok(output) = Command::new(program).args(arguments).arg(&path).output() else {
            return; // Not every machine has Python.
        };
        let stderr = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.success(), "{name}: {stderr}");
    };
    let gradescope = files(System::Gradescope);
    check("bash", &["-n"], "setup.sh", text(gradescope, "setup.sh"));
    check(
        "bash",
        &["-n"],
        "run_autograder",
        text(gradescope, "run_autograder"),
    );
    let prairielearn = files(System::PrairieLearn);
    check(
        "bash",
        &["-n"],
        "grade.sh",
        text(prairielearn, "image/grade.sh"),
    );
    let classroom = files(System::Classroom50);
    check(
        "python3",
        &["-m", "py_compile"],
        "autograder.py",
        text(classroom, "autograder.py"),
    );
}

/// The scripts of systems that grade in the student's repository take its stages. One that is
/// missing stays that of the handout: without `lib.rs` nothing would compile.
#[cfg(unix)]
#[test]
fn a_stage_that_is_missing_stays_that_of_the_handout() {
    let take = |program: &str, script: &str| {
        let folder = tempfile::tempdir().expect("a folder");
        let write = |path: &str, text: &str| {
            let path = folder.path().join(path);
            std::fs::create_dir_all(path.parent().expect("a folder")).expect("a folder");
            std::fs::write(path, text).expect("it is written");
        };
        for stage in ["raygen", "intersect", "bvh"] {
            write(&format!("course/stages/{stage}/src/lib.rs"), "given");
            write(&format!("course/stages/{stage}/src/given.rs"), "given");
        }
        write("student/stages/intersect/src/lib.rs", "written");
        write("student/stages/bvh/src/notes.txt", "no stage");
        let mut run = Command::new(program);
        run.args(["-c", script]).current_dir(folder.path());
        let Ok(run) = run.output() else {
            return; // Not every machine has Python.
        };
        assert!(
            run.status.success(),
            "{}",
            String::from_utf8_lossy(&run.stderr)
        );
        let read = |path: &str| {
            std::fs::read_to_string(folder.path().join("course/stages").join(path)).ok()
        };
        assert_eq!(
            read("raygen/src/lib.rs").as_deref(),
            Some("given"),
            "{program}"
        );
        assert_eq!(
            read("bvh/src/lib.rs").as_deref(),
            Some("given"),
            "{program}"
        );
        assert_eq!(
            read("intersect/src/lib.rs").as_deref(),
            Some("written"),
            "{program}"
        );
        assert_eq!(read("intersect/src/given.rs"), None, "{program}");
    };
    let workflow = text(files(System::Actions), "first-light.yml");
    let (_, script) = workflow.split_once("        run: |\n").expect("a script");
    let (script, _) = script.split_once("          done\n").expect("a loop");
    take("bash", &format!("set -e\n{script}\ndone"));
    let autograder = text(files(System::Classroom50), "autograder.py");
    let (functions, _) = autograder
        .split_once("def main()")
        .expect("the main function");
    take(
        "python3",
        &format!("{functions}\ntake_stages(Path('student'), Path('course'))"),
    );
}

#[test]
fn flags_that_a_system_does_not_use_change_none_of_its_files() {
    for system in [System::Actions, System::Classroom50] {
        assert_eq!(
            system.unused_flags(),
            ["public", "unsandboxed", "visibility"]
        );
        let others = Choices {
            unsandboxed: false,
            visibility: "hidden".into(),
            ..choices()
        };
        let others = system.files(&workspace(), &others).expect("it is exported");
        assert!(others == files(system), "{}", system.name());
    }
}

/// Builds the package as Gradescope does, and grades with it: takes minutes.
///
/// `cargo test -p export --test packages -- --ignored`
#[cfg(unix)]
#[test]
#[ignore = "builds the grader once more"]
fn the_package_grades_a_submission_without_a_network() {
    let folder = tempfile::tempdir().expect("a folder");
    let root = folder.path();
    let choices = Choices {
        what: "part1".into(),
        part: 1,
        unsandboxed: false,
        ..choices()
    };
    let files = System::Gradescope
        .files(&workspace(), &choices)
        .expect("it is exported");
    for file in &files {
        let path = root.join("source").join(&file.path);
        files::file_tree::write(&path, &file.contents).expect("it is written");
    }
    let script = |name: &str| {
        let status = Command::new("bash")
            .arg(root.join("source").join(name))
            .env("AUTOGRADER_ROOT", root)
            .current_dir(root)
            .status();
        status.expect("bash runs").code()
    };
    assert_eq!(script("setup.sh"), Some(0));
    let hand_in = |name: &str, text: &str| {
        let path = root.join("submission/stages/intersect/src").join(name);
        files::file_tree::write(&path, text.as_bytes()).expect("it is written");
    };
    let results = || -> serde_json::Value {
        let text = std::fs::read_to_string(root.join("results/results.json")).expect("results");
        serde_json::from_str(&text).expect("they are JSON")
    };
    hand_in("lib.rs", "fn broken() -> u8 {\n    \"no\"\n}\n");
    assert_eq!(script("run_autograder"), Some(0));
    let broken = results();
    assert_eq!(broken["score"], 0.0);
    let output = broken["output"].as_str().unwrap_or_default();
    assert!(output.contains("mismatched types"), "{output}");
    // A folder that is no submission is the student's to mend.
    std::fs::remove_dir_all(root.join("submission/stages")).expect("it is removed");
    assert_eq!(script("run_autograder"), Some(0));
    let output = results()["output"].to_string();
    assert!(output.contains("contains no stage"), "{output}");
}
