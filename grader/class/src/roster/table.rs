//! The marks of a class, in the form that a course system imports as it is.
//!
//! - Canvas matches no columns: it wants `Student`, `ID`, `SIS User ID`, `SIS Login ID`, `Section` and
//!   one column for the assignment, and makes an assignment of every other column
//!   (<https://community.canvaslms.com/t5/Instructor-Guide/How-do-I-import-grades-in-the-Gradebook/ta-p/807>).
//!   A line `Points Possible` follows the names of columns.
//! - Moodle's grading worksheet wants `Identifier`, `Grade` and `Last modified (grade)`, by which
//!   Moodle sees that a mark was changed since; `Feedback comments` is shown to the student
//!   (<https://docs.moodle.org/en/Offline_grading_worksheet>; `importgradeslib.php` in Moodle's
//!   `mod/assign/feedback/offline`). Without numbers of participants the import of grades matches
//!   `ID number` or `Email address` (<https://docs.moodle.org/en/Grade_import>).
//! - `csv` is the gradebook of the project, with the identifiers and names of the roster.
//!
//! A student without a mark is not in the file for Canvas or Moodle, so nothing changes there. An
//! empty cell would overwrite: in Canvas the old mark (`process_gradebook_upload.js`), in Moodle
//! the old comment. The gradebook has a row for each student.

use super::join::Join;
use super::{Roster, Student};
use crate::by_hand::{self, ByHand};
use crate::collect::{Class, Row, points};
use crate::gradebook::table::{self as gradebook, text};
use crate::late::Lateness;
use crate::plan::Plan;
use base::GraderError;
use submission::Untrusted;

/// A system that imports marks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum System {
    /// Canvas.
    Canvas,
    /// Moodle.
    Moodle,
    /// The gradebook of the project.
    Csv,
}

impl System {
    /// All systems.
    pub const ALL: [System; 3] = [System::Canvas, System::Moodle, System::Csv];

    /// Its name on the command line, and that of its file in `OUT`.
    pub fn name(self) -> &'static str {
        match self {
            System::Canvas => "canvas",
            System::Moodle => "moodle",
            System::Csv => "csv",
        }
    }

    /// The system with this name.
    pub fn named(name: &str) -> Option<System> {
        System::ALL.into_iter().find(|system| system.name() == name)
    }

    /// The name of its file in `OUT`.
    pub fn file(self) -> String {
        match self {
            System::Csv => "roster.csv".into(),
            system => format!("{}.csv", system.name()),
        }
    }
}

/// What is written besides the scores.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Marks {
    /// The system.
    pub system: System,
    /// The name of the assignment, for Canvas as its gradebook has it: `Part 1 (1234)`.
    pub assignment: String,
    /// Whether extra credit is added to the mark.
    pub add_extra: bool,
}

/// The row of each student: that of the submission, with what late work of this student loses and what
/// this student alone gets by hand. `None` without a submission.
pub fn rows(
    class: &Class,
    roster: &Roster,
    join: &Join,
    lateness: Option<&Lateness>,
    by_hand: &ByHand,
) -> Vec<Option<Row>> {
    let students = roster.students.iter().zip(&join.submissions).enumerate();
    let rows = students.map(|(i, (student, submission))| {
        let mut row = Row {
            graded: None,
            ..class.rows[(*submission)?].clone()
        };
        if !student.team.is_empty() {
            row.notes
                .push(format!("team {}", student.team.raw()).into());
        }
        if let Some(lateness) = lateness {
            lateness.apply(i, &mut row);
        }
        if let Some(member) = by_hand.members.get(&i) {
            by_hand::apply(&member.marks, &mut row);
        }
        Some(row)
    });
    rows.collect()
}

/// The table of the marks. `rows` are those of the students.
pub fn write(
    plan: &Plan,
    (roster, join): (&Roster, &Join),
    rows: &[Option<Row>],
    marks: &Marks,
) -> Result<String, GraderError> {
    let students = roster.students.iter().zip(rows);
    let students: Vec<(&Student, Option<&Row>)> = students
        .map(|(student, row)| (student, row.as_ref()))
        .collect();
    let marked = students.iter().filter_map(|(student, row)| {
        let row = (*row)?;
        let score = row.score.as_ref()?;
        let mark = points(match marks.add_extra {
            true => score.core + score.extra,
            false => score.core,
        });
        Some(Marked { student, row, mark })
    });
    let [max, _] = plan.max_score();
    let records = match marks.system {
        System::Canvas => canvas(marked, &marks.assignment, max),
        System::Moodle
            if students
                .iter()
                .all(|(student, _)| !student.number.is_empty()) =>
        {
            worksheet(marked, max)
        }
        System::Moodle => moodle_grades(marked, &marks.assignment),
        System::Csv => return gradebook_of(plan, &students, |i| join.has_several(roster, i)),
    };
    gradebook::table(&records)
}

/// A student with a mark.
struct Marked<'a> {
    student: &'a Student,
    row: &'a Row,
    mark: String,
}

fn canvas<'a>(
    marked: impl Iterator<Item = Marked<'a>>,
    assignment: &str,
    max: f64,
) -> Vec<Vec<String>> {
    let header = [
        "Student",
        "ID",
        "SIS User ID",
        "SIS Login ID",
        "Section",
        assignment,
    ];
    let possible = ["    Points Possible", "", "", "", "", &points(max)];
    let mut records = vec![
        header.map(str::to_string).to_vec(),
        possible.map(str::to_string).to_vec(),
    ];
    records.extend(marked.map(|Marked { student, mark, .. }| {
        let own = [
            &student.number,
            &student.id,
            &student.login,
            &student.section,
        ];
        let own = own.map(Untrusted::line).into_iter();
        [name(student)]
            .into_iter()
            .chain(own)
            .chain([mark])
            .collect()
    }));
    records
}

fn worksheet<'a>(marked: impl Iterator<Item = Marked<'a>>, max: f64) -> Vec<Vec<String>> {
    let header = [
        "Identifier",
        "Full name",
        "Email address",
        "Grade",
        "Maximum Grade",
        "Last modified (grade)",
        "Feedback comments",
    ];
    let mut records = vec![header.map(str::to_string).to_vec()];
    records.extend(marked.map(|Marked { student, row, mark }| {
        vec![
            format!("Participant {}", student.number.line()),
            name(student),
            text(&student.email.line()),
            mark,
            points(max),
            student.mark_changed.line(),
            text(&feedback(row)),
        ]
    }));
    records
}

/// What the student reads in Moodle.
fn feedback(row: &Row) -> String {
    let given = row.given.iter().map(Untrusted::line);
    let all = [row.status.label().to_string()].into_iter().chain(given);
    all.collect::<Vec<_>>().join("; ")
}

fn moodle_grades<'a>(
    marked: impl Iterator<Item = Marked<'a>>,
    assignment: &str,
) -> Vec<Vec<String>> {
    let header = ["ID number", "Email address", "Full name", assignment];
    let mut records = vec![header.map(str::to_string).to_vec()];
    records.extend(marked.map(|Marked { student, mark, .. }| {
        let own = [&student.id, &student.email].map(Untrusted::line);
        own.into_iter().chain([name(student), mark]).collect()
    }));
    records
}

/// The name, which a student may choose, as a spreadsheet shows it. No system finds the student by
/// it; the columns by which it does are as the roster has them.
fn name(student: &Student) -> String {
    text(&student.name.line())
}

/// The gradebook, with the identifiers and names of the roster. Students who handed in nothing, or
/// more than one submission, have no points.
fn gradebook_of(
    plan: &Plan,
    students: &[(&Student, Option<&Row>)],
    has_several: impl Fn(usize) -> bool,
) -> Result<String, GraderError> {
    let tasks: Vec<&str> = plan.tasks.iter().map(|task| task.key.as_str()).collect();
    let lines = students.iter().enumerate().map(|(i, (student, row))| {
        let without = || match has_several(i) {
            true => "handed in more than once",
            false => "not handed in",
        };
        let mut line = row
            .map(|row| crate::gradebook::line(row, &tasks))
            .unwrap_or_else(|| gradebook::Line {
                status: without().into(),
                ..gradebook::Line::default()
            });
        line.id = student.key().line();
        line.name = student.name.line();
        line
    });
    gradebook::write(&tasks, plan.max_score(), &lines.collect::<Vec<_>>())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::collect::{Score, Status};
    use serde_json::json;

    /// A class with these submissions and core points.
    fn class(rows: &[(&str, Option<f64>)]) -> Class {
        let plan = json!({
            "version": 2, "submissions": [],
            "settings": { "what": "part1", "seed": 7, "limits": "", "revision": null, "course": {} },
            "tasks": [{ "key": "part1.task1", "title": "", "stage": "raygen", "cases": [
                { "name": "a", "tier": "core", "points": 10.0 }, { "name": "b", "tier": "robust", "points": 2.0 },
            ] }],
        });
        let rows = rows.iter().map(|(name, core)| Row {
            name: (*name).into(),
            owner: None,
            status: match core {
                Some(_) => Status::Graded,
                None => Status::Infrastructure("the disk is full".into()),
            },
            score: core.map(|core| Score {
                core,
                extra: 1.5,
                tasks: [("part1.task1".to_string(), [core, 1.5])].into(),
            }),
            notes: Vec::new(),
            doubts: Vec::new(),
            by_hand: 0.0,
            given: Vec::new(),
            graded: None,
        });
        Class {
            plan: serde_json::from_value(plan).expect("a plan"),
            rows: rows.collect(),
        }
    }

    #[test]
    fn a_team_that_handed_in_twice_did_hand_in() {
        let student = |id: &str, team: &str| Student {
            id: id.into(),
            team: team.into(),
            ..Student::default()
        };
        let students = [("ada", "red"), ("bo", "red"), ("cy", "")];
        let roster = Roster {
            students: students.map(|(id, team)| student(id, team)).into(),
            ..Roster::default()
        };
        let class = class(&[("ada", Some(7.0)), ("bo", Some(9.0))]);
        let names: Vec<&str> = class.rows.iter().map(|row| row.name.raw()).collect();
        let join = Join::of(&roster, &names);
        let rows = rows(&class, &roster, &join, None, &ByHand::default());
        let marks = Marks {
            system: System::Csv,
            assignment: String::new(),
            add_extra: false,
        };
        let table = write(&class.plan, (&roster, &join), &rows, &marks).expect("a table");
        let status = |line: &str| line.split(',').nth(2).map(str::to_string);
        let found: Vec<String> = table.lines().skip(1).filter_map(status).collect();
        let twice = "handed in more than once";
        assert_eq!(found, [twice, twice, "not handed in"], "{table}");
    }

    /// The marks of a class, of a roster in the form of `system` and submissions as it names them.
    fn written(system: System, roster: &str, add_extra: bool) -> String {
        let class = class(&[
            ("Ada Lovelace_123_assignsubmission_file_", Some(7.25)),
            ("hoppergrace_LATE_98765_4567890_stages-2", Some(10.0)),
            ("turingalan_777_4567891_stages", None),
        ]);
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("roster.csv");
        std::fs::write(&path, roster).expect("a file");
        let roster = Roster::read(&path).expect("a roster");
        let names: Vec<&str> = class.rows.iter().map(|row| row.name.raw()).collect();
        let join = Join::of(&roster, &names);
        let marks = Marks {
            system,
            assignment: "Part 1 (1234)".into(),
            add_extra,
        };
        let rows = rows(&class, &roster, &join, None, &ByHand::default());
        write(&class.plan, (&roster, &join), &rows, &marks).expect("a table")
    }

    #[test]
    fn canvas_gets_its_own_columns_and_one_for_the_assignment() {
        let roster = "Student,ID,SIS User ID,SIS Login ID,Section,Quiz (9)\n    Points Possible,,,,,5\n\
            \"Hopper, Grace\",98765,s2,ghopper,\"CS, A\",4\n\"Turing, Alan\",777,s3,aturing,B,5\n\"Absent, Al\",5,s4,al,B,\n";
        assert_eq!(
            written(System::Canvas, roster, false),
            "Student,ID,SIS User ID,SIS Login ID,Section,Part 1 (1234)\r\n    Points Possible,,,,,10\r\n\
             \"Hopper, Grace\",98765,s2,ghopper,\"CS, A\",10\r\n"
        );
        assert!(written(System::Canvas, roster, true).contains("\"CS, A\",11.5\r\n"));
    }

    #[test]
    fn moodle_gets_its_worksheet_or_a_table_to_map() {
        let worksheet = "Identifier,Full name,Email address,Status,Grade,Maximum Grade,Last modified (grade),Feedback comments\n\
            Participant 123,Ada Lovelace,ada@x,Submitted,,10,\"Friday, 3 May 2027, 9:00 AM\",\n\
            Participant 124,Al Absent,al@x,No submission,,10,-,Where is it?\n";
        assert_eq!(
            written(System::Moodle, worksheet, false),
            "Identifier,Full name,Email address,Grade,Maximum Grade,Last modified (grade),Feedback comments\r\n\
             Participant 123,Ada Lovelace,ada@x,7.25,10,\"Friday, 3 May 2027, 9:00 AM\",graded\r\n"
        );
        let participants = "First name,Last name,ID number,Email address\nAda,Lovelace,s1,ada@x\n";
        assert_eq!(
            written(System::Moodle, participants, false),
            "ID number,Email address,Full name,Part 1 (1234)\r\ns1,ada@x,Ada Lovelace,7.25\r\n"
        );
    }

    #[test]
    fn a_name_is_no_formula() {
        for (system, header, line) in [
            (
                System::Canvas,
                "Student,ID,SIS User ID,SIS Login ID,Section",
                "=1+1,98765,s2,ghopper,A",
            ),
            (
                System::Moodle,
                "Full name,Identifier,Email address",
                "=1+1,Participant 123,=1@x",
            ),
            (
                System::Moodle,
                "Full name,Username,ID number",
                "=1+1,hoppergrace,s1",
            ),
        ] {
            let table = written(system, &format!("{header}\n{line}\n"), false);
            assert!(table.contains("'=1+1") && !table.contains(",=1"), "{table}");
        }
    }

    #[test]
    fn late_work_loses_its_share_and_questions_have_no_mark() {
        use crate::late::Lateness;
        let due = 1_802_732_340;
        let unit = |commit: serde_json::Value| json!({ "submission": "", "key": "", "notes": [], "commit": commit });
        let at = |seconds: i64, doubt: Option<&str>| json!({ "author": seconds, "committer": seconds, "doubt": doubt });
        let mut class = class(&[
            ("ada", Some(8.0)),
            ("bo", Some(10.0)),
            ("cy", Some(10.0)),
            ("di", Some(10.0)),
            ("ed_LATE_5_6_x", Some(10.0)),
        ]);
        let submissions = json!([
            { "name": "ada", "file": "ada", "unit": unit(at(due + 100_000, None)) },
            { "name": "bo", "file": "bo", "unit": unit(at(due + 100_000, None)) },
            { "name": "cy", "file": "cy", "unit": unit(at(due - 5, Some("written after it was committed"))) },
            { "name": "di", "file": "di", "unit": unit(json!(null)) },
            { "name": "ed_LATE_5_6_x", "file": "ed.zip", "unit": unit(json!(null)) },
        ]);
        class.plan.submissions = serde_json::from_value(submissions).expect("submissions");
        let term = json!({ "title": "T", "due": due, "late": { "grace_minutes": 5, "percent_per_day": 10.0, "most_days": null } });
        class.plan.term = Some(serde_json::from_value(term).expect("a term"));
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("roster.csv");
        let roster =
            "id,name,participant number,extension\nada,,1,\nbo,,2,3\ncy,,3,\ndi,,4,\ned,,5,\n";
        std::fs::write(&path, roster).expect("a file");
        let roster = Roster::read(&path).expect("a roster");
        let names: Vec<&str> = class.rows.iter().map(|row| row.name.raw()).collect();
        let join = Join::of(&roster, &names);
        assert_eq!(join.problems, []);
        let lateness = Lateness::of(&class, &roster, &join).expect("a rule");
        assert_eq!(lateness.late.keys().copied().collect::<Vec<_>>(), [0]);
        assert_eq!(
            lateness.questions.keys().copied().collect::<Vec<_>>(),
            [2, 4]
        );
        assert_eq!(lateness.untimed, 1);
        let marks = Marks {
            system: System::Csv,
            assignment: String::new(),
            add_extra: false,
        };
        let rows = rows(&class, &roster, &join, Some(&lateness), &ByHand::default());
        let written = write(&class.plan, (&roster, &join), &rows, &marks).expect("a table");
        let scores: Vec<&str> = written
            .lines()
            .skip(1)
            .filter_map(|line| line.split(',').nth(3))
            .collect();
        assert_eq!(scores, ["6.4", "10", "", "10", ""]);
        assert!(
            written.contains("2 days late, keeps 80 %: 8 points before"),
            "{written}"
        );
        class.plan.term = None;
        assert_eq!(Lateness::of(&class, &roster, &join), None);
    }

    #[test]
    fn the_gradebook_has_the_names_of_the_roster() {
        let written = written(
            System::Csv,
            "id,name\ns1,Ada Lovelace\ns9,Al Absent\n",
            false,
        );
        let lines: Vec<&str> = written.lines().skip(1).collect();
        assert_eq!(
            lines,
            [
                "s1,Ada Lovelace,graded,7.25,10,1.5,2,7.25,1.5,",
                "s9,Al Absent,not handed in,,10,,2,,,"
            ]
        );
    }
}
