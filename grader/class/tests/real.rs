//! Grades a small class for real: compiles and runs it. Takes minutes, so it is not among the usual
//! tests: `cargo test -p class -- --ignored`.

use std::path::{Path, PathBuf};
use std::process::Command;

const STAGES: [&str; 2] = ["raygen", "intersect"];

/// Copies the reference's stages of Part 1 to `folder`.
fn hand_in(course: &Path, folder: &Path) {
    for stage in STAGES {
        let src = Path::new("stages").join(stage).join("src");
        std::fs::create_dir_all(folder.join(&src)).expect("a folder");
        for file in std::fs::read_dir(course.join(&src)).expect("a stage") {
            let file = file.expect("a file").path();
            let name = file.file_name().expect("a name");
            std::fs::copy(&file, folder.join(&src).join(name)).expect("a copy");
        }
    }
}

/// Runs `grader class` and returns its exit code and what it printed.
fn run(course: &Path, arguments: &[&str]) -> (Option<i32>, String) {
    let output = Command::new(env!("CARGO_BIN_EXE_class"))
        .arg("class")
        .args(arguments)
        .arg("--course")
        .arg(course)
        .output()
        .expect("it runs");
    let printed = [output.stdout, output.stderr].concat();
    (
        output.status.code(),
        String::from_utf8_lossy(&printed).into_owned(),
    )
}

#[test]
#[ignore = "compiles submissions: minutes"]
fn a_class_is_graded_once_and_again_only_on_request() {
    let course = Path::new(env!("CARGO_MANIFEST_DIR"))
        .ancestors()
        .nth(2)
        .expect("the course");
    let folder = tempfile::tempdir().expect("a folder");
    let path = |name: &str| -> PathBuf { folder.path().join(name) };
    hand_in(course, &path("class/anna/homework"));
    hand_in(course, &path("class/bo"));
    let broken = path("class/bo/stages/intersect/src/lib.rs");
    std::fs::write(&broken, "pub fn test_triangle(\r\n").expect("a file");
    std::fs::write(path("class/cleo.zip"), b"PK\x03\x04 and nothing more").expect("a file");
    let (class, out) = (path("class"), path("out"));
    let arguments = [
        class.to_str().expect("UTF-8"),
        "--out",
        out.to_str().expect("UTF-8"),
        "--part",
        "1",
    ];

    let (code, printed) = run(course, &arguments);
    assert_eq!(code, Some(1), "one is a question: {printed}");
    assert!(
        printed.contains("your decision: cleo: could not be read: cleo.zip is a damaged"),
        "{printed}"
    );
    let gradebook = std::fs::read_to_string(out.join("gradebook.csv")).expect("a gradebook");
    let rows: Vec<&str> = gradebook.lines().skip(1).collect();
    let starts = [
        "anna,,graded,80,80,31.5,31.5,15,1,15,2,30,16,20,12.5,",
        "bo,,graded,30,80,3,31.5,15,1,15,2,0,0,0,0,",
        "cleo,,could not be read,,80,,31.5,,,,,,,,,cleo.zip is a damaged",
    ];
    assert_eq!(rows.len(), starts.len());
    for (row, start) in rows.iter().zip(starts) {
        assert!(row.starts_with(start), "{gradebook}");
    }
    assert!(
        rows[0].contains("its files are in the folder homework"),
        "{gradebook}"
    );
    assert!(
        rows[1].contains("CRLF") && rows[1].contains("does not compile: intersect"),
        "{gradebook}"
    );

    // Nothing is graded again, and no score is replaced silently.
    hand_in(course, &path("class/bo"));
    let (_, printed) = run(course, &arguments);
    assert!(
        printed.contains("bo has other files now: the old score stays"),
        "{printed}"
    );
    assert_eq!(
        std::fs::read_to_string(out.join("gradebook.csv")).ok(),
        Some(gradebook.clone())
    );

    // Bo's new files are those of Anna, without the folder: the same unit.
    let (code, printed) = run(course, &[arguments.as_slice(), &["--regrade"]].concat());
    assert_eq!(code, Some(1), "{printed}");
    assert!(
        printed.contains("bo: 30 of 80 + 3 of 31.5, graded -> 80 of 80 + 31.5 of 31.5, graded"),
        "{printed}"
    );
    assert!(
        printed.contains("1 of them: other files were handed in"),
        "{printed}"
    );
    assert_eq!(
        std::fs::read_to_string(out.join("gradebook.csv")).ok(),
        Some(gradebook)
    );
    run(
        course,
        &[arguments.as_slice(), &["--regrade", "--yes"]].concat(),
    );
    let gradebook = std::fs::read_to_string(out.join("gradebook.csv")).expect("a gradebook");
    assert!(
        gradebook.contains("bo,,graded,80,80,31.5,31.5,"),
        "{gradebook}"
    );
}
