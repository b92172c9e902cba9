//! Runs the program as a student does, in a copy of the course with a hole in it.

use crate::sizes::files;
use serde_json::Value;
use std::fs;
use std::io::{BufRead, BufReader, Write};
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::sync::mpsc::{self, Receiver};
use std::time::Duration;

/// The file with the hole.
pub(crate) const FILE: &str = "stages/raygen/src/pixel.rs";

/// Longer than any build takes.
const PATIENCE: Duration = Duration::from_secs(5000);

pub(crate) fn root() -> PathBuf {
    let grader = Path::new(env!("CARGO_MANIFEST_DIR"));
    grader.parent().expect("the grader is in the course").into()
}

/// Copies the files of the course, without most snapshots.
pub(crate) fn copy_course(to: &Path) {
    let is_needed = |path: &&PathBuf| {
        let text = path.to_string_lossy();
        !text.starts_with("golden/part")
            || path.starts_with("golden/part1.task1")
            || path.ends_with("task.png")
    };
    for path in files(&[""]).iter().filter(is_needed) {
        let target = to.join(path);
        fs::create_dir_all(target.parent().unwrap()).unwrap();
        let contents = fs::read(root().join(path)).unwrap();
        // Cargo builds again what has a new time.
        if fs::read(&target).ok().as_ref() != Some(&contents) {
            fs::write(&target, contents).unwrap();
        }
    }
}

fn grader(course: &Path, arguments: &[&str]) -> Command {
    let mut grader = Command::new(env!("CARGO_BIN_EXE_grader"));
    grader
        .current_dir(course)
        .args(arguments)
        // A worker that is not optimised is slower, but built in half the time.
        .env("CARGO_PROFILE_RELEASE_OPT_LEVEL", "0")
        // As CI sets it: warnings stay warnings.
        .env("RUSTFLAGS", "-D warnings")
        .env_remove("COLUMNS")
        .env_remove("CLICOLOR_FORCE");
    grader
}

fn run(course: &Path, arguments: &[&str]) -> (String, Output) {
    let output = grader(course, arguments).output().expect("it runs");
    let stdout = String::from_utf8_lossy(&output.stdout).into_owned();
    (stdout, output)
}

/// What `practice part1.task1` prints if `answers` are typed.
fn practice(course: &Path, answers: &str) -> String {
    let mut practice = grader(course, &["practice", "part1.task1", "--seed", "1"]);
    practice.stdin(Stdio::piped()).stdout(Stdio::piped());
    let mut child = practice.spawn().expect("it runs");
    let mut stdin = child.stdin.take().unwrap();
    stdin.write_all(answers.as_bytes()).unwrap();
    drop(stdin);
    let output = child.wait_with_output().expect("it ends");
    assert_eq!(output.status.code(), Some(0), "{output:?}");
    String::from_utf8_lossy(&output.stdout).into_owned()
}

/// Reads lines until one contains `text`; returns all of them.
fn read_until(lines: &Receiver<String>, text: &str) -> String {
    let mut seen = String::new();
    while !seen.contains(text) {
        let line = lines
            .recv_timeout(PATIENCE)
            .unwrap_or_else(|e| panic!("no {text:?} ({e}) in\n{seen}"));
        seen.push_str(&line);
        seen.push('\n');
    }
    seen
}

/// The names of the fields of a JSON object.
fn keys(object: &Value) -> Vec<&String> {
    object
        .as_object()
        .into_iter()
        .flat_map(serde_json::Map::keys)
        .collect()
}

#[test]
fn a_student_writes_a_task() {
    let course = root().join("target/student-loop/course");
    copy_course(&course);
    let _ = fs::remove_dir_all(course.join("target"));
    let solution = fs::read_to_string(root().join(FILE)).unwrap();
    let start = ") -> PixelEstimate {\n";
    let with = |code: &str| solution.replacen(start, &format!("{start}    {code}\n"), 1);
    let write = |text: &str| fs::write(course.join(FILE), text).unwrap();
    write(&with("kit::hole!(\"part1.task1\", x, y);"));

    // Nothing is graded, and nothing is built.
    let (status, output) = run(&course, &["status"]);
    assert!(output.status.success());
    let first = status.lines().next().expect("a line");
    assert!(
        first.contains("part1.task1") && first.contains("1 gap left"),
        "{status}"
    );
    assert!(first.ends_with("not graded yet"), "{status}");

    // Before the task is written, `practice` asks what to expect.
    let asked = practice(&course, "q\n");
    assert!(asked.contains("what do you expect?"), "{asked}");

    // Bare `grader` grades the next open task.
    let (bare, output) = run(&course, &[]);
    assert_eq!(output.status.code(), Some(1), "{output:?}");
    assert!(
        bare.contains("part1.task1") && bare.contains("not written yet"),
        "{bare}"
    );
    assert!(
        bare.contains("Open stages/raygen/src/pixel.rs and write `raytrace_pixel`."),
        "{bare}"
    );

    // It is watched: a wrong answer, then the right one.
    let mut watch = grader(&course, &["watch", "part1"]);
    watch.stdin(Stdio::piped()).stdout(Stdio::piped());
    let mut child = watch.spawn().expect("it runs");
    let stdout = BufReader::new(child.stdout.take().unwrap());
    let (sender, lines) = mpsc::channel();
    std::thread::spawn(move || {
        stdout.lines().map_while(Result::ok).for_each(|line| {
            let _ = sender.send(line);
        });
    });
    let mut stdin = child.stdin.take().unwrap();
    read_until(&lines, "keys, then Enter");
    write(&with(
        "println!(\"at {x}\"); if x == 3 { return PixelEstimate::default(); }",
    ));
    let wrong = read_until(&lines, "keys, then Enter");
    assert!(
        wrong.contains("part1.task1:") && wrong.contains("your result"),
        "{wrong}"
    );
    assert!(wrong.contains("your code printed"), "{wrong}");
    assert!(
        wrong.contains("cp target/first-light/part1_task1.rs"),
        "{wrong}"
    );
    write(&with("let nothing: u8 = \"text\";"));
    let broken = read_until(&lines, "keys, then Enter");
    assert!(
        broken.contains("does not compile, because of") && broken.contains("\n  error[E0308]"),
        "{broken}"
    );
    stdin.write_all(b"h\n").unwrap();
    read_until(&lines, "keys, then Enter");
    write(&solution);
    let done = read_until(&lines, "keys, then Enter");
    assert!(
        done.contains("Done, every core point: part1.task1"),
        "{done}"
    );
    assert!(
        done.contains("part1.task1 and part1.task2 are complete."),
        "{done}"
    );
    stdin.write_all(b"q\n").unwrap();
    assert!(child.wait().expect("it ends").success());

    // After it, `practice` shows mistakes; before them it judges the student's own examples.
    let asked = practice(&course, "q\n");
    assert!(
        asked.contains(" mistakes. Left is the right picture"),
        "{asked}"
    );
    assert!(!asked.contains("examples"), "{asked}");
    let examples = course.join("stages/raygen/examples.toml");
    let wrong = "[[pixel]]\nfilm = [2, 2]\npixel = [0, 0]\nexpected = [0.5, 0.5]\n";
    fs::write(&examples, wrong).unwrap();
    let asked = practice(&course, "q\n");
    let [judged, mistakes] = ["1 example", " mistakes. Left is"].map(|text| asked.find(text));
    assert!(judged.is_some() && judged < mistakes, "{asked}");
    fs::remove_file(examples).unwrap();

    // A run of one task keeps what is known of the others.
    let (status, _) = run(&course, &["status"]);
    assert_eq!(
        status.matches(" written     15/15\n").count(),
        2,
        "{status}"
    );
    assert!(status.contains("Next: part1.task3"), "{status}");

    // One call of one case.
    write(&with(
        "if x == 1 { println!(\"at {x}\"); return PixelEstimate::default(); }",
    ));
    let one = [
        "part1.task1",
        "--case",
        "center_of_each_pixel",
        "--call",
        "1",
    ];
    let (text, output) = run(&course, &one);
    assert_eq!(output.status.code(), Some(1), "{output:?}");
    for part in [
        "call 1 of ",
        "  input      ",
        "  yours      ",
        "  reference  ",
        "  verdict    wrong ",
    ] {
        assert!(text.contains(part), "no {part:?} in\n{text}");
    }
    // What the other calls print is left out.
    let printed = "part1.task1 center_of_each_pixel printed:\n    at 1\n";
    assert!(text.ends_with(printed), "{text}");
    let (list, _) = run(&course, &one[..3]);
    assert!(
        list.contains("\nwrong: ") && list.contains("--call 1\n"),
        "{list}"
    );

    // The edit opened both tasks of the stage. Both are graded, and the first that is not complete
    // is reported, after a line for each that is.
    let (bare, _) = run(&course, &[]);
    assert!(bare.starts_with("part1.task1 "), "{bare}");
    let complete = bare.lines().find(|line| line.starts_with("part1.task2 "));
    assert!(
        complete.is_some_and(|line| line.ends_with("complete")),
        "{bare}"
    );
    let (status, _) = run(&course, &["status"]);
    assert!(!status.contains("before edit"), "{status}");
    assert!(status.contains("Next: part1.task1"), "{status}");

    // An editor gets the compiler's messages and what is wrong, in the same form.
    write(&with(
        "let unused = 3; if x == 1 { return PixelEstimate::default(); }",
    ));
    let check = ["check", "part1.task1", "--message-format=json"];
    let messages = || -> Vec<Value> {
        let (text, _) = run(&course, &check);
        let lines = text.lines().map(serde_json::from_str);
        lines
            .collect::<Result<_, _>>()
            .unwrap_or_else(|e| panic!("{e} in\n{text}"))
    };
    let about = |messages: &[Value], code: &str| -> Value {
        let of_compiler = messages
            .iter()
            .filter(|line| line["reason"] == "compiler-message");
        let mut found = of_compiler.filter(|line| line["message"]["code"]["code"] == code);
        let none = || panic!("no message about {code} in {messages:#?}");
        found.next().cloned().unwrap_or_else(none)
    };
    let first = messages();
    let (ours, rustc) = (
        about(&first, "part1.task1"),
        about(&first, "unused_variables"),
    );
    assert_eq!(keys(&ours), keys(&rustc));
    let (message, of_rustc) = (&ours["message"], &rustc["message"]);
    assert_eq!(keys(message), keys(of_rustc));
    assert_eq!(keys(&message["spans"][0]), keys(&of_rustc["spans"][0]));
    let [line, of_line] = [message, of_rustc].map(|message| &message["spans"][0]["text"][0]);
    assert_eq!(keys(line), keys(of_line));
    for name in ["package_id", "manifest_path", "target"] {
        assert_eq!(ours[name], rustc[name], "{name}");
    }
    assert_eq!(message["level"], "warning");
    assert_eq!(message["spans"][0]["file_name"], FILE);
    let text = &message["spans"][0]["text"][0]["text"];
    assert!(
        text.as_str()
            .is_some_and(|text| text.contains("fn raytrace_pixel")),
        "{text}"
    );
    let simplest = message["children"][0]["message"]
        .as_str()
        .unwrap_or_default();
    assert!(simplest.starts_with("simplest case: "), "{message:#}");
    assert_eq!(
        first.last().map(|last| &last["reason"]),
        Some(&"build-finished".into())
    );
    // A person reads the same.
    let (text, output) = run(&course, &check[..2]);
    assert_eq!(output.status.code(), Some(1), "{output:?}");
    assert!(text.starts_with("warning[part1.task1]: "), "{text}");
    assert!(text.contains("  = note: simplest case: "), "{text}");
    let stderr = String::from_utf8_lossy(&output.stderr);
    assert!(stderr.contains("unused variable: `unused`"), "{stderr}");

    // What did not change is not graded again, and still told.
    let report = course.join("report.json");
    fs::remove_file(&report).unwrap();
    assert_eq!(about(&messages(), "part1.task1"), ours);
    assert!(!report.exists(), "it was graded again");
    // An edit of another stage changes nothing about it.
    let other = course.join("stages/bbox/src/lib.rs");
    let text = fs::read_to_string(&other).unwrap();
    fs::write(&other, format!("{text}\n// More.\n")).unwrap();
    assert_eq!(about(&messages(), "part1.task1"), ours);
    assert!(!report.exists(), "it was graded again");
    // The same is told if nothing is known.
    fs::remove_file(course.join("target/first-light/check.json")).unwrap();
    assert_eq!(about(&messages(), "part1.task1"), ours);
    assert!(report.exists(), "it was not graded again");
    write(&with("kit::hole!(\"part1.task1\", x, y);"));
    let gap = about(&messages(), "part1.task1");
    assert_eq!(gap["message"]["level"], "help");
    let says = gap["message"]["message"].as_str().unwrap_or_default();
    assert!(says.starts_with("not written yet: part1.task1 "), "{says}");

    // A call that ends the case does not hide the others.
    write(&with("if x == 0 { panic!(\"column 0\"); }"));
    let call = |call| run(&course, &[&one[..4], &[call]].concat()).0;
    let (panics, others) = (call("0"), call("1"));
    assert!(
        panics.contains("  yours      panicked at stages/raygen"),
        "{panics}"
    );
    assert!(
        panics.contains("  verdict    no answer to judge"),
        "{panics}"
    );
    assert!(others.contains("  verdict    right"), "{others}");

    // A changed signature is told in a few lines.
    write(
        &solution
            .replacen("    ns_aa: u32,", "    ns_aa: u64,", 1)
            .replace("f64::from(ns_aa)", "ns_aa as f64")
            .replace("samples: ns_aa", "samples: ns_aa as u32"),
    );
    let (text, output) = run(&course, &["part1.task1"]);
    assert!(
        text.contains("does not compile: the compiler's messages are above."),
        "{text}"
    );
    let stderr = String::from_utf8_lossy(&output.stderr);
    let told = "error: stages/raygen/src/pixel.rs: `raytrace_pixel` must have the signature\n    pub fn raytrace_pixel(";
    assert_eq!(stderr.matches(told).count(), 1, "{stderr}");
    assert!(!stderr.contains("grader/worker/src"), "{stderr}");
    the_report_of_the_readme(&course);
}

/// Triangles as a student writes them, with one of the conditions on the weights forgotten.
const ENDLESS_STRIPS: &str = "{
    let (e1, e2) = (tri.p1 - tri.p0, tri.p2 - tri.p0);
    let p = ray.d.cross(e2);
    let det = e1.dot(p);
    if det == 0.0 {
        return None;
    }
    let s = ray.o - tri.p0;
    let q = s.cross(e1);
    let (b1, b2) = (s.dot(p) / det, ray.d.dot(q) / det);
    let t = e2.dot(q) / det;
    let inside = b1 >= 0.0 && b2 >= 0.0 && b1 <= 1.0;
    (inside && t >= ray.min_t && t <= ray.max_t).then_some(TriangleHit { t, b1, b2 })";

/// README shows what the program prints.
fn the_report_of_the_readme(course: &Path) {
    let file = course.join("stages/intersect/src/triangle.rs");
    let text = fs::read_to_string(&file).unwrap();
    let head = "-> Option<TriangleHit> {";
    let start = text.find(head).expect("the function") + head.len() - 1;
    let end = start + text[start..].find("\n}").expect("its end");
    fs::write(
        &file,
        format!("{}{ENDLESS_STRIPS}{}", &text[..start], &text[end..]),
    )
    .unwrap();
    let (report, _) = run(course, &["part1.task3"]);
    let readme = fs::read_to_string(root().join("README.md")).unwrap();
    let (_, shown) = readme
        .split_once("$ cargo grader part1.task3\n")
        .expect("a report");
    let (shown, _) = shown.split_once("```").expect("its end");
    assert_eq!(shown, report, "README shows another report");
}

#[test]
fn a_case_is_explained_with_a_drawing() {
    let (text, output) = run(&root(), &["explain", "part1.task3/back_face"]);
    assert!(output.status.success());
    assert!(text.contains("1 point, core"), "{text}");
    assert!(
        text.contains("320 rays: 320 must hit. 0 come from the front, 320 from behind."),
        "{text}"
    );
    let drawing = text
        .lines()
        .filter(|line| line.contains("..") || line.contains("oo"));
    assert!(drawing.count() > 5, "{text}");
    let course = [
        "part1.task1/fresh_samples",
        "part1.task2/pinhole",
        "part1.task4/tangent",
    ];
    let more = [
        "part2.task2/behind",
        "part2.task1/strip_along_x",
        "part3.task2/square_lamp",
    ];
    for case in course.iter().chain(&more) {
        let (text, output) = run(&root(), &["explain", case]);
        assert!(output.status.success(), "{case}");
        assert!(text.lines().count() <= 24, "{case}\n{text}");
        assert!(
            text.lines().all(|line| line.chars().count() <= 80),
            "{case}\n{text}"
        );
    }
    let (list, _) = run(&root(), &["explain", "part1.task3"]);
    assert!(list.lines().count() > 28 && list.contains("+0.5"), "{list}");
    let (_, output) = run(&root(), &["explain", "part1.task3/no_such"]);
    assert_eq!(output.status.code(), Some(2));
    let stderr = String::from_utf8_lossy(&output.stderr);
    assert!(
        stderr.contains("has no case `no_such`. Its cases are front_face"),
        "{stderr}"
    );
}
