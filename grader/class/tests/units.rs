//! Units are graded once, wherever and however often a run is stopped, and the tables are the same
//! bytes.

use crate::fake_class::{Behaviour, FakeClass, HOSTILE};
use class::by_hand::ByHand;
use class::collect::{Class, OnUnreadable, Options};
use class::out::Out;
use class::plan::Plan;
use class::pool;
use class::progress::Progress;
use class::roster::join::Join;
use class::roster::table::{self, Marks, System};
use class::roster::{Roster, Student};
use class::unit;
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::Duration;
use tempfile::TempDir;

fn grade(class: &FakeClass, out: &Out, shard: usize, of: usize, behaviour: Behaviour) {
    let units = class.plan.units();
    let jobs: Vec<_> = units
        .into_iter()
        .skip(shard)
        .step_by(of)
        .filter(|(key, _)| !unit::is_stored(out, key))
        .collect();
    let progress = Progress::start(jobs.len());
    pool::run(&jobs, 3, out, &progress, |key| {
        class.command(out, key, behaviour)
    })
    .expect("graded");
}

/// A class of so many submissions, all graded, and its results; the folder is theirs.
fn graded(submissions: usize) -> (TempDir, FakeClass, Out) {
    let folder = tempfile::tempdir().expect("a folder");
    let class = FakeClass::new(folder.path(), submissions);
    let out = class.out("out");
    grade(&class, &out, 0, 1, Behaviour::Fine);
    (folder, class, out)
}

/// The table or page `path` of a folder of results.
fn text(tables: &BTreeMap<PathBuf, Vec<u8>>, path: &str) -> String {
    String::from_utf8(tables[Path::new(path)].clone()).expect("it is UTF-8")
}

/// The stored result of the unit `key`.
fn stored(out: &Out, key: &str) -> Value {
    let text = std::fs::read_to_string(out.unit(key)).expect("a unit");
    serde_json::from_str(&text).expect("JSON")
}

/// Stores `unit` as the result of the unit `key`.
fn store(out: &Out, key: &str, unit: &Value) {
    std::fs::write(out.unit(key), unit.to_string()).expect("a unit");
}

#[test]
fn shards_of_1_3_and_17_collect_to_the_same_bytes() {
    let folder = tempfile::tempdir().expect("a folder");
    let class = FakeClass::new(folder.path(), 40);
    let tables = [1, 3, 17].map(|of| {
        let out = class.out(&format!("out{of}"));
        for shard in (0..of).rev() {
            grade(&class, &out, shard, of, Behaviour::Fine);
        }
        class.tables(&out)
    });
    assert_eq!(tables[0].len(), 3 + 41);
    assert!(tables[0] == tables[1] && tables[1] == tables[2]);
    let gradebook = text(&tables[0], "gradebook.csv");
    assert!(
        gradebook.contains("\r\nstudent05,,graded,5,10,0,2,5,0,\r\n"),
        "{gradebook}"
    );
    assert!(
        gradebook.ends_with("zz,,could not be read,,10,,2,,,zz is empty\r\n"),
        "{gradebook}"
    );
}

/// The page of the class has the ideas that were missing, and who lost points by it; the page for a
/// lecture has the same and names nobody.
#[test]
fn mistakes_are_grouped_by_idea_and_a_lecture_names_nobody() {
    let folder = tempfile::tempdir().expect("a folder");
    let class = FakeClass::new(folder.path(), 40);
    let out = class.out("out");
    std::fs::write(out.picture("picture"), b"PNG").expect("a picture");
    grade(&class, &out, 0, 1, Behaviour::Fine);
    let tables = class.tables(&out);
    let text = |name: &str| text(&tables, name);
    let (page, lecture) = (text("class.html"), text("lecture.html"));
    for page in [&page, &lecture] {
        for words in [
            "how samples are drawn",
            "code that divides x by the height",
            "N = 0",
            "The derivation",
        ] {
            assert!(page.contains(words), "{words}: {page}");
        }
    }
    // 40 has no unit of its own; 10, 21 and 32 have full points.
    let section = page
        .split_once("how samples are drawn")
        .expect("an idea")
        .1
        .split_once("units and lengths")
        .expect("another idea")
        .0;
    assert!(
        section.contains(">student04<") && !section.contains(">student32<"),
        "{section}"
    );
    assert!(
        !lecture.contains("student") && !lecture.contains("zz"),
        "{lecture}"
    );
    let student = text("students/student04.html");
    assert!(student.contains("data:image/png;base64,UE5H"), "{student}");
    assert!(student.contains("N = 4"), "{student}");
    // The page opens with what is wrong: the call, drawn, and the picture. The table is below.
    let places =
        ["data:image/svg+xml", "data:image/png", "All tasks"].map(|part| student.find(part));
    assert!(
        places.is_sorted() && places[0].is_some(),
        "{places:?} {student}"
    );
    let full = text("students/student10.html");
    assert!(!full.contains("Some answers are wrong"), "{full}");
    let unfinished = text("students/student07.html");
    assert!(
        unfinished.contains("It reaches code that is not written yet."),
        "{unfinished}"
    );
}

/// Names of students and files, what their code prints, what the compiler says: nothing of it is
/// markup in a page, a formula or a new line in a table, or obeyed by a terminal.
#[test]
fn names_and_texts_are_shown_and_not_obeyed() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut class = FakeClass::new(folder.path(), 3);
    class.plan.submissions[0].name = HOSTILE.into();
    class.plan.submissions[3].file = format!("=1+1{HOSTILE}").into();
    let out = class.out("out");
    grade(&class, &out, 0, 1, Behaviour::Fine);
    let tables = class.tables(&out);
    for (path, bytes) in &tables {
        let text = String::from_utf8(bytes.clone()).expect("it is UTF-8");
        let shown = path.display();
        let text = text.replace("\r\n", "\n");
        let is_obeyed = |c: char| (c.is_control() && c != '\n') || c == '\u{202e}';
        assert!(!text.contains(is_obeyed), "{shown}: {text}");
        let is_page = path
            .extension()
            .is_some_and(|extension| extension == "html");
        assert!(!is_page || !text.contains("</p><script>"), "{shown}");
        assert!(!is_page || !text.contains("A <task>"), "{shown}");
        assert!(
            !text.contains("http:") && !text.contains("https:"),
            "{shown}"
        );
    }
    let gradebook = text(&tables, "gradebook.csv");
    assert_eq!(gradebook.lines().count(), 1 + 4, "{gradebook}");
    assert!(
        gradebook.contains("</p><script>\\u{1b}[2J\\u{d}\\u{202e}08"),
        "{gradebook}"
    );
    assert!(gradebook.contains(",'=1+1</p>"), "{gradebook}");
}

/// What could not be read is a question to the teacher. Until the teacher gives it 0 points, it has
/// no mark in a file for a course system.
#[test]
fn what_could_not_be_read_is_a_question_and_no_zero() {
    let (_folder, class, out) = graded(3);
    let roster = Roster {
        students: vec![Student {
            id: "zz".into(),
            ..Student::default()
        }],
        ..Roster::default()
    };
    let marks = Marks {
        system: System::Canvas,
        assignment: "Part 1".into(),
        add_extra: false,
    };
    for (on_unreadable, row, heading, page, mark) in [
        (
            OnUnreadable::Ask,
            "zz,,could not be read,,10,,2,,,zz is empty\r\n",
            "Your decision: no score until then",
            "No score yet.",
            "Points Possible,,,,,10\r\n",
        ),
        (
            OnUnreadable::Zero,
            "zz,,could not be read,0,10,0,2,0,0,zz is empty\r\n",
            "Could not be read: 0 points",
            "0 points",
            "\r\n,,zz,,,0\r\n",
        ),
    ] {
        let options = Options {
            on_unreadable,
            ..Options::default()
        };
        let tables = class.tables_with(&out, &options);
        let says = |path: &str, words: &str| {
            let text = text(&tables, path);
            assert!(text.contains(words), "{path}: {words}: {text}");
        };
        says("gradebook.csv", row);
        says("class.html", heading);
        says("students/zz.html", page);
        let read =
            Class::read(&out, class.plan.clone(), &options, |_, _, _, _| Ok(())).expect("a class");
        assert_eq!(read.is_complete(), on_unreadable == OnUnreadable::Zero);
        let names: Vec<&str> = read.rows.iter().map(|row| row.name.raw()).collect();
        let join = Join::of(&roster, &names);
        let rows = table::rows(&read, &roster, &join, None, &ByHand::default());
        let table = table::write(&read.plan, (&roster, &join), &rows, &marks).expect("a table");
        assert!(table.ends_with(mark), "{table}");
    }
}

/// Course systems name files by numbers; the teacher's pages name students. The keys of marks stay.
#[test]
fn with_a_roster_pages_say_whose_a_submission_is() {
    let (folder, _class, out) = graded(3);
    let roster = folder.path().join("roster.csv");
    let students = "name,login\n\"Lovelace, <i>Ada</i>\",student00\nBo,student01\n";
    std::fs::write(&roster, students).expect("a file");
    let output = Command::new(env!("CARGO_BIN_EXE_class"))
        .args(["class", "--collect", "--for", "csv", "--roster"])
        .args([&roster, Path::new("--out"), out.path()])
        .output()
        .expect("it runs");
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(1), "{said}");
    let read = |path: &str| std::fs::read_to_string(out.join(path)).expect("a page");
    let (page, student) = (read("class.html"), read("students/student00.html"));
    let link = r#"<a href="students/student00.html" title="student00">Lovelace, &lt;i&gt;Ada"#;
    assert!(page.contains(link), "{page}");
    assert!(
        page.contains(r#"title="student02">student02</a>"#),
        "{page}"
    );
    assert!(student.contains("<h1>Lovelace, &lt;i&gt;Ada"), "{student}");
    assert!(read("gradebook.csv").contains("\nstudent00,"));
}

/// A script may take the tables if every submission has a score, has to ask if something is to be
/// decided, and has to run again what the machine did not finish.
#[test]
fn the_exit_code_tells_a_question_from_a_failure() {
    let folder = tempfile::tempdir().expect("a folder");
    let class = FakeClass::new(folder.path(), 3);
    let out = class.out("out");
    let code = |flags: &[&str]| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_class"));
        command
            .args(["class", "--collect", "--out"])
            .arg(out.path());
        let output = command.args(flags).output().expect("it runs");
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        (output.status.code(), said)
    };
    let (failed, said) = code(&[]);
    assert_eq!(failed, Some(2), "{said}");
    assert!(
        said.starts_with("error: 3 submissions have no score"),
        "{said}"
    );
    grade(&class, &out, 0, 1, Behaviour::Fine);
    assert_eq!(code(&[]), (Some(1), String::new()));
    assert_eq!(code(&["--zero-unreadable"]), (Some(0), String::new()));
}

/// A result that a crash of the machine has cut is one row without a score, and graded again.
#[test]
fn a_cut_result_stops_no_table() {
    let (_folder, class, out) = graded(4);
    let whole = class.tables(&out);
    let path = out.unit(class.plan.submissions[1].key().expect("it has a unit"));
    let unit = std::fs::read(&path).expect("a unit");
    for kept in [0, 1, unit.len() / 2, unit.len() - 1] {
        std::fs::write(&path, &unit[..kept]).expect("it is cut");
        let tables = class.tables(&out);
        let gradebook = text(&tables, "gradebook.csv");
        let row = "student01,,infrastructure,,10,,2,,,the result units/";
        assert!(gradebook.contains(row), "{gradebook}");
        assert!(gradebook.contains("is damaged"), "{gradebook}");
        grade(&class, &out, 0, 1, Behaviour::Fine);
        assert!(class.tables(&out) == whole, "{kept} bytes were left");
    }
}

/// A result that was changed by hand is one row without a score, whatever it claims, and graded
/// again.
#[test]
fn a_changed_result_gives_no_points_that_do_not_exist() {
    let (_folder, class, out) = graded(4);
    let whole = class.tables(&out);
    let key = class.plan.submissions[1].key().expect("it has a unit");
    for claimed in [1e6, -1e308, 1.0000001] {
        let mut unit = stored(&out, key);
        unit["earned"]["part1.task1"]["a_case"] = claimed.into();
        store(&out, key, &unit);
        assert!(!unit::is_stored(&out, key), "{claimed}");
        let tables = class.tables(&out);
        let gradebook = text(&tables, "gradebook.csv");
        let row = "student01,,infrastructure,,10,,2,,,the result units/";
        assert!(gradebook.contains(row), "{gradebook}");
        assert!(
            gradebook.contains("is damaged (part1.task1/a_case earned"),
            "{gradebook}"
        );
        grade(&class, &out, 0, 1, Behaviour::Fine);
        assert!(class.tables(&out) == whole, "{claimed}");
    }
}

/// A pipe in the place of a result would be waited for without end.
#[cfg(unix)]
#[test]
fn a_pipe_in_the_place_of_a_result_is_not_waited_for() {
    let (_folder, class, out) = graded(4);
    let whole = class.tables(&out);
    let keys = [1, 2].map(|i| class.plan.submissions[i].key().expect("it has a unit"));
    for path in [out.unit(keys[0]), out.unit(keys[1]), out.failure(keys[1])] {
        let _ = std::fs::remove_file(&path);
        let made = Command::new("mkfifo").arg(&path).status();
        assert!(made.expect("mkfifo runs").success());
    }
    std::fs::remove_file(out.unit(keys[1])).expect("it is removed");
    let tables = class.tables(&out);
    let gradebook = text(&tables, "gradebook.csv");
    assert!(gradebook.contains("it is no regular file"), "{gradebook}");
    assert!(
        gradebook.contains("student02,,infrastructure,,10,,2,,,not graded yet"),
        "{gradebook}"
    );
    assert!(!unit::is_stored(&out, keys[0]));
    grade(&class, &out, 0, 1, Behaviour::Fine);
    assert!(class.tables(&out) == whole);
}

/// Who knows the seed knows every question of a second try.
#[test]
fn the_seed_is_for_the_instructor_alone() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut class = FakeClass::new(folder.path(), 4);
    class.plan.settings.seed = 1_234_567;
    let out = class.out("out");
    grade(&class, &out, 0, 1, Behaviour::Fine);
    for key in class.plan.units().into_keys() {
        let text = std::fs::read_to_string(out.unit(key))
            .expect("a unit")
            .replace("\"seed\":7", "\"seed\":1234567");
        assert!(text.contains("1234567"), "{text}");
        std::fs::write(out.unit(key), text).expect("a unit");
    }
    for (path, bytes) in class.tables(&out) {
        let names_seed = String::from_utf8_lossy(&bytes).contains("1234567");
        assert_eq!(
            names_seed,
            path.as_path() == Path::new("class.html"),
            "{}",
            path.display()
        );
    }
}

/// A sentence such as "which may be a table of answers" is a question to the instructor, not to the
/// student.
#[test]
fn what_to_look_at_is_for_the_instructor_alone() {
    let (_folder, class, out) = graded(4);
    for key in class.plan.units().into_keys() {
        let mut unit = stored(&out, key);
        unit["report"]["to_check"] = json!(["a table of answers"]);
        store(&out, key, &unit);
    }
    let tables = class.tables(&out);
    let says = |path: &str| text(&tables, path).contains("please look at a table of answers");
    assert!(says("gradebook.csv") && says("class.html"));
    assert!(!says("students/student01.html"));
}

/// Other points are other tables, and nothing is graded.
#[test]
fn a_change_of_points_grades_nothing() {
    let (_folder, mut class, out) = graded(8);
    let old = class.plan.clone();
    class.plan.tasks[0].cases[0].points = 30.0;
    assert_eq!(
        old.differences(&class.plan),
        ["other points of part1.task1"]
    );
    let tables = class.tables(&out);
    let gradebook = text(&tables, "gradebook.csv");
    assert!(
        gradebook.contains("student05,,graded,15,30,0,2,15,0,"),
        "{gradebook}"
    );
    let page = text(&tables, "students/student05.html");
    assert!(page.contains("15 of 30 points"), "{page}");
    // A case whose question was never asked is no zero.
    class.plan.tasks[0].cases[1].name = "a_new_case".into();
    let tables = class.tables(&out);
    let gradebook = text(&tables, "gradebook.csv");
    assert!(
        gradebook.contains("student05,,infrastructure,,30,"),
        "{gradebook}"
    );
    assert!(
        gradebook.contains("has no case a_new_case of part1.task1"),
        "{gradebook}"
    );
}

/// A second teacher reads and replaces the files of a shared folder.
#[cfg(unix)]
#[test]
fn files_of_a_class_have_the_usual_permissions() {
    use std::os::unix::fs::PermissionsExt;
    let folder = tempfile::tempdir().expect("a folder");
    let class = FakeClass::new(folder.path(), 2);
    let usual = folder.path().join("usual");
    std::fs::write(&usual, "").expect("a file");
    let mode = |path: &Path| {
        let metadata = path.metadata().expect("it exists");
        metadata.permissions().mode()
    };
    let first = folder.path().join("class.json");
    assert!(class.plan.store_first(&first).expect("it is written"));
    assert!(!class.plan.store_first(&first).expect("it is there"));
    assert_eq!(mode(&first), mode(&usual));
    assert_eq!(
        Plan::load(&first).expect("it is read"),
        Some(class.plan.clone())
    );
}

#[test]
fn a_stage_that_was_refused_is_not_said_to_be_broken() {
    let (_folder, class, out) = graded(3);
    let key = class.plan.submissions[0].key().expect("it has a unit");
    let mut unit = stored(&out, key);
    unit["outcome"] = "does_not_compile".into();
    unit["report"]["tasks"][0]["status"] = "does_not_compile".into();
    let table = |unit: &Value, path: &str| {
        store(&out, key, unit);
        text(&class.tables(&out), path)
    };
    let gradebook = |unit: &Value| table(unit, "gradebook.csv");
    let broken = gradebook(&unit);
    assert!(broken.contains("student00,,does not compile,"), "{broken}");
    assert!(broken.contains("does not compile: raygen"), "{broken}");
    let reasons = [
        "lib.rs:3: `unsafe` is not allowed",
        "lib.rs:9: `asm` is not allowed",
    ];
    unit["report"]["refused_stages"] = json!({ "raygen": reasons });
    let refused = gradebook(&unit);
    assert!(refused.contains("student00,,refused,"), "{refused}");
    let page = table(&unit, "students/student00.html");
    assert!(
        page.contains("Its stage was refused before it was compiled"),
        "{page}"
    );
    let note =
        "refused before it was compiled: raygen: lib.rs:3: `unsafe` is not allowed (and 1 more)";
    assert!(
        refused.contains(note) && !refused.contains("does not compile"),
        "{refused}"
    );
}

/// A file whose name is corrected takes its score along. A file without a score leaves nothing when
/// it is removed.
#[test]
fn a_new_name_keeps_the_score_and_a_removed_file_asks_no_more() {
    let folder = tempfile::tempdir().expect("a folder");
    let plan = FakeClass::new(folder.path(), 4).plan;
    let mut wanted = plan.clone();
    wanted
        .submissions
        .retain(|planned| !["student01", "zz"].contains(&planned.name.raw()));
    wanted.submissions[0].name = "ada".into();
    let (extended, kept) = plan.extended(&wanted, |_| true);
    let names = extended
        .submissions
        .iter()
        .map(|planned| planned.name.raw());
    let names: Vec<&str> = names.collect();
    assert_eq!(names, ["ada", "student01", "student02", "student03"]);
    assert_eq!(kept, ["student01 is no longer in the folder"]);
}

/// 4 submissions are 3 units, and another cannot be read.
#[test]
fn it_is_said_why_fewer_are_graded_than_were_handed_in() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut plan = FakeClass::new(folder.path(), 4).plan;
    assert_eq!(
        plan.why_fewer(3, |_| false).as_deref(),
        Some(
            "3 of 5 submissions to grade; the others: 1 equal to another and graded with it, 1 that cannot be read"
        )
    );
    let first = plan.submissions[0].key().expect("it has a unit");
    let resumed = plan
        .why_fewer(1, |key| key == first)
        .expect("not all are graded");
    assert!(
        resumed.contains("1 graded already, 1 of other shards"),
        "{resumed}"
    );
    plan.submissions.truncate(3);
    assert_eq!(plan.why_fewer(3, |_| false), None);
}

#[test]
fn only_failures_of_the_machine_are_tried_again() {
    let folder = tempfile::tempdir().expect("a folder");
    let class = FakeClass::new(folder.path(), 4);
    let tries = |out: &Out| -> Vec<usize> {
        let tries = class.plan.units().into_keys();
        let tries = tries.map(|key| {
            std::fs::read(out.join(format!("{key}.tries")))
                .expect("it was tried")
                .len()
        });
        tries.collect()
    };
    let out = class.out("fine");
    grade(&class, &out, 0, 1, Behaviour::Fine);
    assert_eq!(tries(&out), [1, 1, 1]);
    let complete = class.tables(&out);

    let out = class.out("twice");
    grade(&class, &out, 0, 1, Behaviour::FailsFirst(2));
    assert_eq!(tries(&out), [3, 3, 3]);
    assert!(class.tables(&out) == complete);

    let out = class.out("always");
    grade(&class, &out, 0, 1, Behaviour::FailsFirst(3));
    assert_eq!(tries(&out), [3, 3, 3]);
    let tables = class.tables(&out);
    let gradebook = text(&tables, "gradebook.csv");
    let expected = "student00,,infrastructure,,10,,2,,,the disk is full\r\n";
    assert!(gradebook.contains(expected), "{gradebook}");
    // The next run grades them, and nothing of the failure is left.
    grade(&class, &out, 0, 1, Behaviour::FailsFirst(3));
    assert!(class.tables(&out) == complete);
}

/// The class that the test below kills. It is the same test program, started with this variable.
const KILLED: &str = "FAKE_CLASS_TO_KILL";

/// How many submissions it has.
const SUBMISSIONS: usize = 24;

/// How many units a run stores before it is killed.
const OF_A_RUN: usize = 5;

#[test]
fn a_killed_run_goes_on_where_it_was() {
    if let Some(folder) = std::env::var_os(KILLED) {
        let class = FakeClass::new(&PathBuf::from(folder), SUBMISSIONS);
        let out = class.out("killed");
        grade(&class, &out, 0, 1, Behaviour::Only(OF_A_RUN));
        return;
    }
    let folder = tempfile::tempdir().expect("a folder");
    let class = FakeClass::new(folder.path(), SUBMISSIONS);
    let out = class.out("whole");
    grade(&class, &out, 0, 1, Behaviour::Fine);
    let whole = class.tables(&out);

    let out = class.out("killed");
    let stored = || {
        let keys = class.plan.units().into_keys();
        keys.filter(|key| out.has(key)).count()
    };
    for stored_before in [0, 1, 2].map(|runs| runs * OF_A_RUN) {
        assert_eq!(stored(), stored_before);
        let mut run = Command::new(std::env::current_exe().expect("this program"))
            .args(["--exact", "units::a_killed_run_goes_on_where_it_was"])
            .env(KILLED, folder.path())
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .expect("it starts");
        // The processes that it has started for the next units wait.
        while stored() < stored_before + OF_A_RUN {
            let ended = run.try_wait().expect("a child");
            assert_eq!(ended, None, "{} units", stored());
            std::thread::sleep(Duration::from_millis(3));
        }
        run.kill().expect("it is killed"); // SIGKILL
        run.wait().expect("it ends");
    }
    grade(&class, &out, 0, 1, Behaviour::Fine);
    assert!(class.tables(&out) == whole);
}
