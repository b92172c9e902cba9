//! Marks and words that the teacher gives by hand: the file `OUT/by_hand.csv`, which the grader reads
//! each time it writes tables, and never writes.
//!
//! Points are *added* to what the code earned: to a task, or to the whole. So they stay what they
//! are when the class is graded again. They may be negative; no task and no mark gets less than 0,
//! and both may get more than their maximum. Late work keeps them whole.
//!
//! A line names a submission, as `gradebook.csv` does, and is about all who handed it in; or a team;
//! or a student, of a team only this one.

use crate::gradebook::table::points_text as points;
use crate::gradebook::table::text;
use crate::out::{Out, read_regular};
use crate::plan::Plan;
use crate::roster::join::Join;
use crate::roster::{Roster, Student};
use crate::row::{Row, Score, Status};
use crate::sheet::Sheet;
use base::GraderError;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::io::ErrorKind;
use submission::Untrusted;
use unicode_normalization::UnicodeNormalization;

/// The name of the file in `OUT`.
pub const FILE: &str = "by_hand.csv";

/// What one line gives.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Mark {
    /// The points that are added.
    pub points: Option<f64>,
    /// What the students read.
    pub words: Untrusted,
    /// Whether no mark is released until the teacher has decided.
    pub held_back: bool,
}

/// The marks of one submission or student, by the task; by the empty text that of the whole.
pub type Marks = BTreeMap<String, Mark>;

/// The marks of one student of a team.
#[derive(Clone, Debug, PartialEq)]
pub struct Member {
    /// The student's [`Student::key`].
    pub key: Untrusted,
    /// Who it is.
    pub name: Untrusted,
    /// The name of the team's submission.
    pub submission: Untrusted,
    /// The marks.
    pub marks: Marks,
}

/// All that is given by hand.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ByHand {
    /// The marks of submissions, by their names.
    pub submissions: BTreeMap<String, Marks>,
    /// Those of single students of a team, by their numbers in the roster.
    pub members: BTreeMap<usize, Member>,
    /// Lines about somebody without a submission that counts, as sentences.
    pub open: Vec<String>,
}

/// What a column is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Field {
    Submission,
    Student,
    Team,
    Task,
    Points,
    Words,
    HeldBack,
    /// For the teacher alone.
    Ignored,
}

/// The names of the columns, in small letters.
const COLUMNS: [(&str, Field); 13] = [
    ("submission", Field::Submission),
    ("id", Field::Submission),
    ("student", Field::Student),
    ("login", Field::Student),
    ("team", Field::Team),
    ("task", Field::Task),
    ("points", Field::Points),
    ("words", Field::Words),
    ("comment", Field::Words),
    ("held_back", Field::HeldBack),
    ("held back", Field::HeldBack),
    ("name", Field::Ignored),
    ("note", Field::Ignored),
];

/// Whose a line is.
enum Whose {
    Submission(usize),
    /// A student of a team, and the number of the submission.
    Member(usize, usize),
    /// Nobody's, for this reason.
    Open(String),
}

impl ByHand {
    /// Reads `OUT/by_hand.csv`, if there is one. Each error names the line.
    pub fn read(
        out: &Out,
        plan: &Plan,
        roster: Option<(&Roster, &Join)>,
    ) -> Result<ByHand, GraderError> {
        let path = out.join(FILE);
        // A link whose file is away for a moment, on a disk of the network, is no missing file: the
        // marks would be lost without a word.
        let found = path.symlink_metadata();
        if found.is_err_and(|e| e.kind() == ErrorKind::NotFound) {
            return Ok(ByHand::default());
        }
        let bytes = read_regular(&path).map_err(|e| GraderError::file("read", &path, e))?;
        ByHand::parse(&bytes, plan, roster)
            .map_err(|why| GraderError::new(format!("{}: {why}", path.display())))
    }

    fn parse(
        bytes: &[u8],
        plan: &Plan,
        roster: Option<(&Roster, &Join)>,
    ) -> Result<ByHand, String> {
        let sheet = Sheet::parse(bytes)?;
        let fields = fields(&sheet.columns)?;
        let mut by_hand = ByHand::default();
        let mut lines: BTreeMap<(String, String), usize> = BTreeMap::new();
        for (line, cells) in &sheet.lines {
            let value = |field: Field| {
                let mut all = fields
                    .iter()
                    .zip(cells)
                    .filter(|(other, _)| **other == field);
                all.next().map_or("", |(_, cell)| cell.as_str())
            };
            let in_line = |why: String| format!("line {line}: {why}");
            let mut more = cells.iter().skip(fields.len());
            if let Some(cell) = more.find(|cell| !cell.is_empty()) {
                return Err(in_line(format!(
                    "`{}` is in no column: put words with a comma or semicolon between quotation marks",
                    shown(cell)
                )));
            }
            let whose = [Field::Submission, Field::Student, Field::Team]
                .map(value)
                .map(|name| Some(name).filter(|name| !name.is_empty()));
            let whose = match whose {
                [Some(name), None, None] => of_submission(name, plan, roster),
                [None, Some(name), None] => of_student(name, roster),
                [None, None, Some(name)] => of_team(name, roster),
                [None, None, None] => {
                    Err("it names nobody: expected a submission, a student or a team".into())
                }
                _ => Err("it names more than one of submission, student and team: keep one".into()),
            };
            let whose = whose.map_err(in_line)?;
            let task = value(Field::Task);
            if !task.is_empty() && !plan.tasks.iter().any(|planned| planned.key == task) {
                let keys: Vec<&str> = plan.tasks.iter().map(|task| task.key.as_str()).collect();
                return Err(in_line(format!(
                    "no task {} is graded here: expected one of {}, or nothing for points of the whole",
                    shown(task),
                    keys.join(" ")
                )));
            }
            let mark = Mark {
                points: points_of(value(Field::Points), &sheet, plan).map_err(in_line)?,
                words: words_of(value(Field::Words)).into(),
                held_back: is_held_back(value(Field::HeldBack)).map_err(in_line)?,
            };
            let (key, marks) = match whose {
                Whose::Submission(i) => {
                    let name = plan.submissions[i].name.raw().to_string();
                    (name.clone(), by_hand.submissions.entry(name).or_default())
                }
                Whose::Member(student, i) => {
                    let who = roster.map(|(roster, _)| &roster.students[student]);
                    let member = by_hand.members.entry(student).or_insert_with(|| Member {
                        key: who.map(Student::key).cloned().unwrap_or_default(),
                        name: who.map(Student::label).cloned().unwrap_or_default(),
                        submission: plan.submissions[i].name.clone(),
                        marks: Marks::new(),
                    });
                    // No submission has such a name.
                    (format!("{student}\0"), &mut member.marks)
                }
                Whose::Open(_) if mark == Mark::default() => continue,
                Whose::Open(why) => {
                    by_hand
                        .open
                        .push(format!("line {line} of {FILE} counts for nothing: {why}"));
                    continue;
                }
            };
            if let Some(first) = lines.insert((key, task.to_string()), *line) {
                return Err(in_line(format!(
                    "line {first} is about the same students and the same task: write one line, with the sum of the points"
                )));
            }
            if mark != Mark::default() {
                marks.insert(task.to_string(), mark);
            }
        }
        by_hand.submissions.retain(|_, marks| !marks.is_empty());
        by_hand.members.retain(|_, member| !member.marks.is_empty());
        Ok(by_hand)
    }

    /// The students of a team with marks of their own, by the name of their submission.
    pub fn members_of<'a>(&'a self, submission: &'a Untrusted) -> impl Iterator<Item = &'a Member> {
        let members = self.members.values();
        members.filter(move |member| member.submission == *submission)
    }
}

/// What the columns are about.
fn fields(columns: &[String]) -> Result<Vec<Field>, String> {
    let mut fields = Vec::new();
    for column in columns {
        let name = column.to_lowercase();
        let known = COLUMNS.iter().find(|(known, _)| *known == name);
        match known {
            Some((_, field)) if *field == Field::Ignored || !fields.contains(field) => {
                fields.push(*field);
            }
            None if name.is_empty() => fields.push(Field::Ignored),
            _ => {
                let what = if known.is_some() {
                    "a second"
                } else {
                    "an unknown"
                };
                return Err(format!(
                    "{what} column `{}`: expected one of submission, student and team, and task, points, words, held_back; the columns name and note are not read",
                    shown(column)
                ));
            }
        }
    }
    let names_somebody = [Field::Submission, Field::Student, Field::Team];
    match fields.iter().any(|field| names_somebody.contains(field)) {
        true => Ok(fields),
        false => Err("no column says whose a line is: expected submission, student or team".into()),
    }
}

fn shown(text: &str) -> String {
    Untrusted::from(text).line()
}

/// Whether two names look the same: some systems store `ë` as one character, others as two.
fn is_same(a: &str, b: &str) -> bool {
    a == b || a.nfc().eq(b.nfc())
}

/// The submission with this name, as it is or as `gradebook.csv` shows it.
fn of_submission(
    name: &str,
    plan: &Plan,
    roster: Option<(&Roster, &Join)>,
) -> Result<Whose, String> {
    let is = |planned: &Untrusted| {
        is_same(planned.raw(), name) || is_same(text(&planned.line()).trim(), name)
    };
    let submissions = plan.submissions.iter().enumerate();
    let fitting: Vec<usize> = submissions
        .filter(|(_, planned)| is(&planned.name))
        .map(|(i, _)| i)
        .collect();
    let [i] = fitting[..] else {
        return Err(format!(
            "{} submission is called {}: expected an `id` of gradebook.csv",
            if fitting.is_empty() {
                "no"
            } else {
                "more than one"
            },
            shown(name)
        ));
    };
    let Some((_, join)) = roster else {
        return Ok(Whose::Submission(i));
    };
    if let Some(other) = join.replaced.get(&i) {
        let other = plan.submissions[*other].name.line();
        return Ok(Whose::Open(format!(
            "{} does not count, but {other} of the same team",
            shown(name)
        )));
    }
    // One of several that are equal.
    let counting = join.owners[i].and_then(|first| join.submissions[first]);
    Ok(Whose::Submission(counting.unwrap_or(i)))
}

/// A student, by an identifier or the name as the roster has it.
fn of_student(name: &str, roster: Option<(&Roster, &Join)>) -> Result<Whose, String> {
    let (roster, join) = roster.ok_or_else(|| needs_roster("student"))?;
    let is = |student: &Student| {
        let own = [
            &student.id,
            &student.login,
            &student.email,
            &student.number,
            &student.name,
        ];
        own.iter().any(|text| is_same(text.raw(), name))
    };
    let students: Vec<usize> = (0..roster.students.len())
        .filter(|i| is(&roster.students[*i]))
        .collect();
    let [student] = students[..] else {
        return Err(format!(
            "{} student of the roster has the identifier, login, address, number or name {}",
            if students.is_empty() {
                "no"
            } else {
                "more than one"
            },
            shown(name)
        ));
    };
    Ok(match join.submissions[student] {
        None => no_submission(name),
        Some(i)
            if join
                .submissions
                .iter()
                .filter(|other| **other == Some(i))
                .count()
                > 1 =>
        {
            Whose::Member(student, i)
        }
        Some(i) => Whose::Submission(i),
    })
}

fn of_team(name: &str, roster: Option<(&Roster, &Join)>) -> Result<Whose, String> {
    let (roster, join) = roster.ok_or_else(|| needs_roster("team"))?;
    let mut students = roster.students.iter();
    let team = name.to_lowercase();
    let found = students.position(|student| is_same(&student.team.raw().to_lowercase(), &team));
    let member = found.ok_or_else(|| format!("no team of the roster is called {}", shown(name)))?;
    let submission = join.submissions[member];
    Ok(submission.map_or_else(|| no_submission(name), Whose::Submission))
}

fn needs_roster(what: &str) -> String {
    format!(
        "it names a {what}, and there is no roster: add `--roster ROSTER`, or name the submission"
    )
}

fn no_submission(name: &str) -> Whose {
    Whose::Open(format!(
        "{} has no submission that counts; for points without one, make an empty folder of that name beside the submissions",
        shown(name)
    ))
}

/// Points: a number that is not larger than what is possible.
fn points_of(cell: &str, sheet: &Sheet, plan: &Plan) -> Result<Option<f64>, String> {
    if cell.is_empty() {
        return Ok(None);
    }
    let with_minus = cell.replace('\u{2212}', "-");
    let plain = match sheet.has_decimal_commas {
        true => with_minus.replacen(',', ".", 1),
        false => with_minus,
    };
    let [max, _] = plan.max_score();
    let number = plain
        .parse()
        .ok()
        .filter(|number: &f64| number.abs() <= max);
    number.map(Some).ok_or_else(|| {
        format!(
            "points {}: expected a number from -{max} to {max}, such as 2.5, which is added to the points of the code",
            shown(cell),
            max = points(max)
        )
    })
}

/// The words as one line.
fn words_of(cell: &str) -> String {
    cell.split_whitespace().collect::<Vec<_>>().join(" ")
}

fn is_held_back(cell: &str) -> Result<bool, String> {
    match cell.to_lowercase().as_str() {
        "yes" | "true" | "1" | "x" => Ok(true),
        "" | "no" | "false" | "0" => Ok(false),
        _ => Err(format!("held_back {}: expected yes or no", shown(cell))),
    }
}

/// Adds marks to a row.
pub fn apply(marks: &Marks, row: &mut Row) {
    let is_decided = marks.values().any(|mark| mark.points.is_some());
    let is_open = matches!(row.status, Status::Unreadable(_) | Status::Question(_));
    if is_decided && is_open && row.score.is_none() {
        row.score = Some(Score::default());
    }
    if let Some(score) = &mut row.score {
        let before = score.core;
        // The whole comes last: the empty text is the first.
        for (task, mark) in marks.iter().rev() {
            let given = mark.points.unwrap_or_default();
            if task.is_empty() {
                score.core = (score.core + given).max(0.0);
                continue;
            }
            let [core, _] = score.tasks.entry(task.clone()).or_default();
            let earned = std::mem::replace(core, (*core + given).max(0.0));
            score.core += *core - earned;
        }
        row.by_hand += score.core - before;
    }
    let sentences = marks
        .iter()
        .map(|(task, mark)| format!("by hand: {}", given(task, mark)));
    row.given.extend(sentences.map(Untrusted::from));
    let is_held_back = marks.values().any(|mark| mark.held_back);
    if is_held_back && !matches!(row.status, Status::Infrastructure(_)) {
        row.status = Status::HeldBack;
        row.score = None;
    }
}

/// A mark for people: `+2 points for part1.task3: the case asked too much`.
pub fn given(task: &str, mark: &Mark) -> String {
    let points = mark.points.map(|given| {
        let unit = if given.abs() == 1.0 {
            "point"
        } else {
            "points"
        };
        format!("{} {unit}", signed(given))
    });
    let about = (!task.is_empty()).then(|| format!("for {task}"));
    let what = points
        .into_iter()
        .chain(about)
        .collect::<Vec<_>>()
        .join(" ");
    let held_back = mark.held_back.then(|| "held back".to_string());
    let all = held_back.into_iter().chain([what, mark.words.line()]);
    let parts: Vec<String> = all.filter(|part| !part.is_empty()).collect();
    parts.join(": ")
}

/// Points with their sign: `+2`.
pub fn signed(given: f64) -> String {
    let sign = if given > 0.0 { "+" } else { "" };
    format!("{sign}{}", points(given))
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    const ROSTER: &[u8] =
        b"id,login,name,team\ns1,ada,Ada,red\ns2,bo,Bo,red\ns3,cy,Cy,\ns4,di,Di,blue\ns5,s1,Eve,\n";

    /// A class of the submissions `red`, `=x` and `cy`, graded with 10 core points in one task.
    fn plan() -> Plan {
        let names = ["red", "=x", "cy"];
        let submissions = names.map(|name| json!({ "name": name, "file": name, "unreadable": "" }));
        let plan = json!({
            "version": 2, "submissions": submissions,
            "settings": { "what": "part1", "seed": 7, "limits": "", "revision": null, "course": {} },
            "tasks": [{ "key": "part1.task1", "title": "", "stage": "raygen", "cases": [
                { "name": "a", "tier": "core", "points": 10.0 },
            ] }],
        });
        serde_json::from_value(plan).expect("a plan")
    }

    fn read(text: &str) -> Result<ByHand, String> {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("roster.csv");
        std::fs::write(&path, ROSTER).expect("a file");
        let roster = Roster::read(&path).expect("a roster");
        let join = Join::of_plan(&roster, &plan());
        ByHand::parse(text.as_bytes(), &plan(), Some((&roster, &join)))
    }

    /// What is given, as sentences after whom it is given to.
    fn sentences(by_hand: &ByHand) -> Vec<String> {
        let submissions = by_hand
            .submissions
            .iter()
            .map(|(name, marks)| (name.clone(), marks));
        let own = by_hand.members.values();
        let members = own.map(|member| (member.name.line(), &member.marks));
        let all = submissions.chain(members).flat_map(|(name, marks)| {
            let marks = marks.iter();
            marks.map(move |(task, mark)| format!("{name}: {}", given(task, mark)))
        });
        all.collect()
    }

    #[test]
    fn a_line_is_for_a_submission_a_team_or_one_student() {
        let by_hand = read(
            "submission,student,team,task,points,words,held_back,name\n\
             red,,,,1.5,all of them,,\n\
             ,,RED,part1.task1,-2,,no,\n\
             ,bo,,,-10,\"alone,\nsaid \"\"no\"\"\",x,Bo\n\
             ,s3,,,,,yes,\n\
             '=x,,,,0,,,\n\
             ,di,,,,,,\n",
        );
        let by_hand = by_hand.expect("a table");
        assert_eq!(
            sentences(&by_hand),
            [
                "=x: 0 points",
                "cy: held back",
                "red: +1.5 points: all of them",
                "red: -2 points for part1.task1",
                "Bo: held back: -10 points: alone, said \"no\"",
            ]
        );
        assert_eq!(by_hand.open, Vec::<String>::new());
        let without = read("team,points\nblue,2\n").expect("a table");
        assert!(
            without.open[0]
                .starts_with("line 2 of by_hand.csv counts for nothing: blue has no submission"),
            "{:?}",
            without.open
        );
    }

    #[test]
    fn tables_of_spreadsheets_are_read() {
        let plain = read("id,points,words\nred,-2.5,\"a; b\"\n").expect("a table");
        for text in [
            "\u{feff}id;points;words\r\nred;-2,5;\"a; b\"\r\n",
            "\u{feff}\"ID\"\t\"Points\"\t\"Words\"\r\n\"red\"\t\u{2212}2,5\ta; b\r\n\t\t\r\n",
        ] {
            assert_eq!(read(text).as_ref(), Ok(&plain), "{text}");
        }
    }

    #[test]
    fn names_that_look_the_same_are_the_same() {
        for (a, b) in [("Zoë", "Zoe\u{308}"), ("Zoe\u{308}", "Zoë"), ("x", "x")] {
            assert!(is_same(a, b), "{a} {b}");
        }
        assert!(!is_same("Zoë", "Zoe"));
    }

    #[test]
    fn each_mistake_is_named_with_its_line() {
        for (text, expected) in [
            (
                "id,points\nred,1\nrot,1\n",
                "line 3: no submission is called rot",
            ),
            (
                "login,points\n\nzoe,1\n",
                "line 3: no student of the roster has the identifier",
            ),
            (
                "login,points\ns1,1\n",
                "line 2: more than one student of the roster",
            ),
            (
                "team,points\ngreen,1\n",
                "line 2: no team of the roster is called green",
            ),
            ("id,points\n,1\n", "line 2: it names nobody"),
            (
                "id,team,points\nred,red,1\n",
                "line 2: it names more than one",
            ),
            (
                "id,points\nred,1\nred,2\n",
                "line 3: line 2 is about the same students",
            ),
            (
                "id,team\nred,\n,red\n",
                "line 3: line 2 is about the same students",
            ),
            (
                "student\nbo\nBo\n",
                "line 3: line 2 is about the same students",
            ),
            (
                "id,task\nred,part1.task9\n",
                "line 2: no task part1.task9 is graded here: expected one of part1.task1,",
            ),
            (
                "id,points\nred,10.5\n",
                "line 2: points 10.5: expected a number from -10 to 10",
            ),
            ("id,points\nred,nan\n", "line 2: points nan"),
            ("id,points\nred,\"1,5\"\n", "line 2: points 1,5"),
            ("id;points\nred;1,000,5\n", "line 2: points 1,000,5"),
            (
                "id,held_back\nred,maybe\n",
                "line 2: held_back maybe: expected yes or no",
            ),
            (
                "id,words\nred,good, but late\n",
                "line 2: `but late` is in no column",
            ),
            ("id,point\nred,1\n", "an unknown column `point`"),
            ("id,points,Points\nred,1,2\n", "a second column `Points`"),
            ("points\n1\n", "no column says whose a line is"),
            ("", "no column says whose a line is"),
        ] {
            let error = read(text).expect_err(text);
            assert!(error.starts_with(expected), "{text}: {error}");
        }
        let error = ByHand::parse(b"student\nbo\n", &plan(), None).expect_err("no roster");
        assert!(
            error.starts_with("line 2: it names a student, and there is no roster"),
            "{error}"
        );
    }

    #[cfg(unix)]
    #[test]
    fn a_link_without_its_file_loses_no_marks() {
        let folder = tempfile::tempdir().expect("a folder");
        let out = Out::create(folder.path()).expect("a folder");
        let read = || ByHand::read(&out, &plan(), None);
        assert_eq!(read().expect("no file"), ByHand::default());
        std::os::unix::fs::symlink("away.csv", out.join(FILE)).expect("a link");
        let error = read().expect_err("the file is away").to_string();
        assert!(error.contains(FILE), "{error}");
    }

    #[test]
    fn points_are_added_and_nothing_falls_below_zero() {
        let row = |status, core: Option<f64>| Row {
            name: "red".into(),
            owner: None,
            status,
            score: core.map(|core| Score {
                core,
                extra: 1.0,
                tasks: [("part1.task1".to_string(), [core, 1.0])].into(),
            }),
            notes: Vec::new(),
            doubts: Vec::new(),
            by_hand: 0.0,
            given: Vec::new(),
            graded: None,
        };
        let after = |text: &str, mut row: Row| {
            let by_hand = read(text).expect("a table");
            apply(&by_hand.submissions["red"], &mut row);
            let score = row.score.as_ref();
            let task = score.and_then(|score| Some(score.tasks.get("part1.task1")?[0]));
            (score.map(|score| score.core), task, row.by_hand, row.status)
        };
        let graded = |core| row(Status::Graded, Some(core));
        for (lines, core, task, by_hand) in [
            ("red,,2\n", 10.0, 8.0, 2.0),
            ("red,part1.task1,4\n", 12.0, 12.0, 4.0),
            ("red,part1.task1,-10\nred,,3\n", 3.0, 0.0, -5.0),
            ("red,,-9\n", 0.0, 8.0, -8.0),
        ] {
            let expected = (Some(core), Some(task), by_hand, Status::Graded);
            assert_eq!(
                after(&format!("id,task,points\n{lines}"), graded(8.0)),
                expected
            );
        }
        // What could not be read has the points that the teacher gives, a failure none.
        let unread = || row(Status::Unreadable("".into()), None);
        let (core, ..) = after("id,points\nred,6\n", unread());
        assert_eq!(core, Some(6.0));
        let (core, ..) = after("id,words\nred,where is it?\n", unread());
        assert_eq!(core, None);
        let failed = Status::Infrastructure("".into());
        let (core, _, _, status) =
            after("id,points,held_back\nred,6,x\n", row(failed.clone(), None));
        assert_eq!((core, status), (None, failed));
        let (core, _, _, status) = after("id,held_back\nred,x\n", graded(8.0));
        assert_eq!((core, status), (None, Status::HeldBack));
    }
}
