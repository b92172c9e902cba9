//! Writes the marks of a class for a course system: `--roster ROSTER --for SYSTEM`.

use crate::by_hand::ByHand;
use crate::collect::{Class, Row, Status, points};
use crate::late::Lateness;
use crate::out::Out;
use crate::roster::join::{Join, Problem};
use crate::roster::table::{self, Marks, System};
use crate::roster::{Roster, Student};
use base::{GraderError, outln, write_whole};
use clap::ArgMatches;

/// Writes the marks of the students in `roster`, whose submissions `join` knows, and prints what a
/// person has to decide. Returns whether there is nothing to decide.
pub(super) fn write(
    matches: &ArgMatches,
    out: &Out,
    class: &Class,
    roster: &Roster,
    join: &Join,
    by_hand: &ByHand,
) -> Result<bool, GraderError> {
    let system = matches
        .get_one::<String>("for")
        .and_then(|name| System::named(name));
    let Some(system) = system else {
        return Ok(true);
    };
    let given = matches.get_one::<String>("assignment").cloned();
    let marks = Marks {
        system,
        assignment: given.unwrap_or_else(|| format!("First Light {}", class.plan.settings.what)),
        add_extra: matches.get_flag("add-extra"),
    };
    let lateness = Lateness::of(class, roster, join);
    let rows = table::rows(class, roster, join, lateness.as_ref(), by_hand);
    let file = out.join(system.file());
    write_whole(
        &file,
        table::write(&class.plan, (roster, join), &rows, &marks)?.as_bytes(),
    )?;

    let [possible, _] = class.plan.max_score();
    if let Some(why) = about_maximum(&marks, roster, possible) {
        outln!("{why}");
    }
    let name = |i: usize| class.rows[i].name.line();
    let who = |student: usize| shown(&roster.students[student]);
    let mut is_decided = join.problems.is_empty();
    if let Some(lateness) = &lateness {
        for (i, (_, about)) in &lateness.late {
            outln!("late: {}: {about}", who(*i));
        }
        for (i, why) in &lateness.questions {
            outln!("no mark: {}: {why}", who(*i));
        }
        if lateness.untimed > 0 {
            outln!(
                "in time, as far as anybody knows: {} students without a commit time; of clones, `--before` or `--commit` takes it",
                lateness.untimed
            );
        }
        is_decided &= lateness.questions.is_empty();
    }
    for i in by_hand.members.keys() {
        if rows[*i]
            .as_ref()
            .is_some_and(|row| row.status == Status::HeldBack)
        {
            outln!("no mark: {}: held back", who(*i));
            is_decided = false;
        }
    }
    for (submission, problem) in &join.problems {
        outln!("no mark: {}: {}", name(*submission), about(roster, problem));
    }
    for submission in &join.of_test_student {
        outln!(
            "no student: {}: a teacher handed it in as Canvas's test student",
            name(*submission)
        );
    }
    let late: Vec<String> = join.late.iter().map(|i| name(*i)).collect();
    if !late.is_empty() && lateness.is_none() {
        outln!("late, as the course system says: {}", late.join(", "));
    }
    let absent: Vec<String> = (roster.students.iter().zip(&join.submissions))
        .enumerate()
        .filter(|(i, (_, submission))| submission.is_none() && !join.has_several(roster, *i))
        .map(|(_, (student, _))| shown(student))
        .collect();
    if !absent.is_empty() {
        outln!("no submission: {}", absent.join("; "));
    }
    let has_mark = |row: &Option<Row>| row.as_ref().is_some_and(|row| row.score.is_some());
    let missing = rows.iter().filter(|row| !has_mark(row));
    outln!(
        "marks: {}: {} students, {} without a mark from this folder",
        file.display(),
        roster.students.len(),
        missing.count()
    );
    Ok(is_decided)
}

/// What does not fit the assignment in the course system. Both take a mark as one of their own
/// maximum. Moodle leaves out what is larger without a word; Canvas makes a new assignment of a
/// column whose name it does not know.
fn about_maximum(marks: &Marks, roster: &Roster, possible: f64) -> Option<String> {
    let assignment = marks.assignment.as_str();
    let maximum = match marks.system {
        System::Csv => None,
        System::Moodle => roster.maximum,
        System::Canvas => {
            let mut all = roster.assignments.iter();
            let Some((_, maximum)) = all.find(|(name, _)| *name == assignment) else {
                let names: Vec<String> = roster
                    .assignments
                    .iter()
                    .map(|(name, _)| name.line())
                    .collect();
                return (!names.is_empty()).then(|| {
                    format!(
                        "the roster has no assignment `{assignment}`, and Canvas will make a new one; `--assignment` takes one of: {}",
                        names.join(", ")
                    )
                });
            };
            Some(*maximum)
        }
    };
    maximum.filter(|maximum| *maximum != possible).map(|maximum| {
        let larger = match marks.system {
            System::Moodle => ", which leaves out larger marks",
            _ => "",
        };
        format!(
            "{} points are possible, and the assignment has {} in the course system{larger}: change it there before you import",
            points(possible),
            points(maximum),
        )
    })
}

/// A student's name, and what else is known that tells the student from others.
fn shown(student: &Student) -> String {
    let team = match student.team.is_empty() {
        true => String::new(),
        false => format!(" of team {}", student.team.line()),
    };
    let (name, key) = (student.label(), student.key());
    match name == key {
        true => format!("{}{team}", name.line()),
        false => format!("{} ({}){team}", name.line(), key.line()),
    }
}

fn about(roster: &Roster, problem: &Problem) -> String {
    let student = |i: &usize| shown(&roster.students[*i]);
    match problem {
        Problem::Nobody => {
            "no student of the roster has this name or number. Rename it to the student's identifier".into()
        }
        Problem::Several(students) => {
            let students: Vec<String> = students.iter().map(student).collect();
            format!(
                "it may belong to {}. Rename it to the student's identifier",
                students.join(" or ")
            )
        }
        Problem::Again(of) => match roster.students[*of].team.line() {
            team if team.is_empty() => {
                format!("{} handed in more than one. Remove those that do not count", student(of))
            }
            team => format!(
                "the team {team} handed in more than one, and nobody knows which is the last in time. Remove those that do not count"
            ),
        },
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn who_handed_in_twice_did_hand_in() {
        let student = |id: &str| Student {
            id: id.into(),
            ..Student::default()
        };
        let roster = Roster {
            students: ["ada", "bo"].map(student).into(),
            ..Roster::default()
        };
        let join = Join::of(&roster, &["ada", "ADA"]);
        assert_eq!(join.submissions, [None, None]);
        assert_eq!([0, 1].map(|i| join.has_several(&roster, i)), [true, false]);
    }

    #[test]
    fn an_assignment_that_does_not_fit_is_named() {
        let canvas = Roster {
            assignments: vec![("Part 1 (12)".into(), 80.0), ("Quiz (9)".into(), 5.0)],
            ..Roster::default()
        };
        let moodle = Roster {
            maximum: Some(80.0),
            ..Roster::default()
        };
        let about = |system, roster: &Roster, assignment: &str, possible| {
            let marks = Marks {
                system,
                assignment: assignment.into(),
                add_extra: false,
            };
            about_maximum(&marks, roster, possible).unwrap_or_default()
        };
        for system in System::ALL {
            assert_eq!(about(system, &canvas, "Part 1 (12)", 80.0), "");
            assert_eq!(about(system, &moodle, "Part 1 (12)", 80.0), "");
        }
        assert_eq!(about(System::Csv, &moodle, "", 83.0), "");
        let other = about(System::Canvas, &canvas, "Part 1 (12)", 83.0);
        assert!(other.starts_with("83 points are possible, and the assignment has 80"));
        assert!(!other.contains("leaves out"), "{other}");
        assert!(about(System::Moodle, &moodle, "", 83.0).contains("leaves out larger marks"));
        let unknown = about(System::Canvas, &canvas, "Part 1", 80.0);
        assert!(
            unknown.ends_with("one of: Part 1 (12), Quiz (9)"),
            "{unknown}"
        );
    }
}
