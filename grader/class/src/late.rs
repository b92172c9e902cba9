//! Late work: when something was handed in, and what it loses by the rule of the teacher's course.
//!
//! Points are what the code earned. The rule changes marks only, which [`crate::roster::table`]
//! writes: it needs the roster, which says who may hand in later.

use crate::gradebook::table::points_text as points;
use crate::plan::{PlannedTerm, State};
use crate::reading::intake::CommitTimes;
use crate::roster::join::Join;
use crate::roster::{Roster, Student};
use crate::row::{Class, Row};
use base::utc::Utc;
use grader::course::term::{LateRule, seconds_of_due};
use std::collections::BTreeMap;
use submission::Untrusted;
use toml::value::Datetime;

const DAY: i64 = 24 * 60 * 60;

/// What the rule does with the submissions of a class. Numbers are those of students: each member of
/// a team has an extension of its own.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Lateness {
    /// Late ones: the share of its points that each keeps, and why.
    pub late: BTreeMap<usize, (f64, String)>,
    /// Those that a person has to decide on, and why.
    pub questions: BTreeMap<usize, String>,
    /// How many have a score and no time, and are taken to be in time.
    pub untimed: usize,
}

impl Lateness {
    /// Applies the rule of the class; `None` if it has no deadline or no rule.
    pub fn of(class: &Class, roster: &Roster, join: &Join) -> Option<Lateness> {
        let term = class.plan.term.as_ref()?;
        let (due, rule) = (term.due?, term.late?);
        let mut lateness = Lateness::default();
        for (i, submission) in join.submissions.iter().enumerate() {
            let Some(submission) = *submission else {
                continue;
            };
            if !class.rows[submission].has_earned() {
                continue; // there are no points to take
            }
            let commit = match &class.plan.submissions[submission].state {
                State::Unit { commit, .. } => commit.as_ref(),
                _ => None,
            };
            let is_called_late = join.late.contains(&submission);
            let student = with_time_of_team(roster, i);
            match decide(&student, commit, is_called_late, due, &rule) {
                Ok(Some((0, _))) => {}
                Ok(Some((days, at))) => {
                    let share = share(&rule, days);
                    let about = format!("{}, {}", shown(at), about(days, share));
                    lateness.late.insert(i, (share, about));
                }
                Ok(None) => lateness.untimed += 1,
                Err(why) => {
                    lateness.questions.insert(i, why);
                }
            }
        }
        Some(lateness)
    }

    /// Leaves a student's row the points that late work keeps: the share is of what the code earned,
    /// not of points by hand. What a person has to decide on has none.
    pub fn apply(&self, student: usize, row: &mut Row) {
        if let Some((share, about)) = self.late.get(&student)
            && let Some(score) = &mut row.score
        {
            let earned = points(score.core);
            score.core = (share * (score.core - row.by_hand) + row.by_hand).max(0.0);
            score.extra *= share;
            let note = format!("{about}: {earned} points before");
            row.notes.push(note.into());
        }
        if self.questions.contains_key(&student) {
            row.score = None;
        }
    }
}

/// A student of the roster. Where the teacher wrote only with another member of the team when it
/// handed in, that is the time.
fn with_time_of_team(roster: &Roster, student: usize) -> Student {
    let mut student = roster.students[student].clone();
    if student.handed_in.is_empty() {
        let mut mates = roster.students.iter();
        let said = mates.find(|mate| mate.is_teammate_of(&student) && !mate.handed_in.is_empty());
        student.handed_in = said.map(|mate| mate.handed_in.clone()).unwrap_or_default();
    }
    student
}

/// Whether something that was handed in at a time is in time for a student; without a deadline
/// everything is.
pub(crate) fn is_in_time(at: i64, student: &Student, term: Option<&PlannedTerm>) -> bool {
    let of_class = term.and_then(|term| term.due);
    let due = of_class.map(|due| extended(due, &student.extension).unwrap_or(due));
    let rule = term.and_then(|term| term.late);
    let grace = rule.map_or(0, |rule| i64::from(rule.grace_minutes) * 60);
    due.is_none_or(|due| at <= due + grace)
}

/// How many days late a student's submission is, and when it was handed in; `None` if nobody knows
/// when. An error is a question to the teacher.
fn decide(
    student: &Student,
    commit: Option<&CommitTimes>,
    is_called_late: bool,
    due: i64,
    rule: &LateRule,
) -> Result<Option<(u32, i64)>, String> {
    let due = extended(due, &student.extension)?;
    let said = student.handed_in.raw();
    let at = match (commit, said) {
        // What the teacher writes counts more than what a student's clock said.
        (_, said) if !said.is_empty() => Some(time(said).ok_or_else(|| {
            format!(
                "its `handed_in` in the roster is {}: expected such as 2027-02-16T09:30:00+01:00",
                student.handed_in.line()
            )
        })?),
        (Some(commit), _) if commit.doubt.is_some() => {
            let doubt = commit.doubt.as_deref().unwrap_or_default();
            return Err(format!(
                "its commit says {}, and was {doubt}. Write when it was handed in into a column `handed_in` of the roster",
                both(commit)
            ));
        }
        (Some(commit), _) => Some(commit.committer),
        (None, _) => None,
    };
    match at {
        Some(at) => Ok(Some((days_late(at, due, rule), at))),
        None if is_called_late => Err(
            "the course system calls it late, and nobody knows how late. Write when it was handed in into a column \
             `handed_in` of the roster"
                .into(),
        ),
        None => Ok(None),
    }
}

/// The deadline of a student with an extension: a number of days, or another deadline.
fn extended(due: i64, extension: &Untrusted) -> Result<i64, String> {
    let text = extension.raw();
    if text.is_empty() {
        return Ok(due);
    }
    let days = text
        .parse::<u32>()
        .ok()
        .map(|days| due + i64::from(days) * DAY);
    days.or_else(|| time(text)).ok_or_else(|| {
        format!(
            "its `extension` in the roster is {}: expected a number of days, or a deadline such as 2027-02-20T23:59:00+01:00",
            extension.line()
        )
    })
}

/// A time in seconds since 1970. A day alone means its end in UTC; a time needs an offset.
fn time(text: &str) -> Option<i64> {
    let time: Datetime = text.parse().ok()?;
    let is_whole = time.time.is_none() || time.offset.is_some();
    seconds_of_due(&time).filter(|_| is_whole)
}

/// Each day that begins after the deadline counts, if the time of grace is over.
fn days_late(at: i64, due: i64, rule: &LateRule) -> u32 {
    if at <= due + i64::from(rule.grace_minutes) * 60 {
        return 0;
    }
    u32::try_from((at - due + DAY - 1) / DAY).unwrap_or(u32::MAX)
}

/// The share of its points that late work keeps.
fn share(rule: &LateRule, days: u32) -> f64 {
    match rule.most_days {
        Some(most) if days > most => 0.0,
        _ => (1.0 - rule.percent_per_day * f64::from(days) / 100.0).max(0.0),
    }
}

fn about(days: u32, share: f64) -> String {
    let days = match days {
        1 => "1 day".to_string(),
        days => format!("{days} days"),
    };
    format!("{days} late, keeps {} %", points(share * 100.0))
}

/// What a table says about the times of a commit: nothing if they are in time and agree.
pub fn note(commit: &CommitTimes, due: Option<i64>) -> Option<Untrusted> {
    let is_late = due.is_some_and(|due| commit.committer > due);
    let doubt = commit.doubt.as_ref();
    let what = match doubt {
        Some(doubt) => format!("its times cannot be right: it was {doubt}: "),
        None if is_late => "after the deadline: ".to_string(),
        None => return None,
    };
    Some(format!("{what}{}", both(commit)).into())
}

/// Both times of a commit.
fn both(commit: &CommitTimes) -> String {
    format!(
        "committed {}, written {}",
        shown(commit.committer),
        shown(commit.author)
    )
}

/// A time for people: `2027-02-15 22:59 UTC`.
fn shown(seconds: i64) -> String {
    let Utc {
        year,
        month,
        day,
        hour,
        minute,
        ..
    } = Utc::at(seconds);
    format!("{year:04}-{month:02}-{day:02} {hour:02}:{minute:02} UTC")
}

#[cfg(test)]
mod tests {
    use super::*;

    const DUE: i64 = 1_802_732_340; // 2027-02-15 22:59 UTC

    const RULE: LateRule = LateRule {
        grace_minutes: 15,
        percent_per_day: 30.0,
        most_days: Some(3),
    };

    fn student(extension: &str, handed_in: &str) -> Student {
        Student {
            extension: extension.into(),
            handed_in: handed_in.into(),
            ..Student::default()
        }
    }

    fn commit(committer: i64, doubt: Option<&str>) -> CommitTimes {
        CommitTimes {
            author: committer - 60,
            committer,
            doubt: doubt.map(str::to_string),
        }
    }

    #[test]
    fn times_are_shown_as_people_write_them() {
        for (seconds, text) in [
            (0, "1970-01-01 00:00 UTC"),
            (DUE, "2027-02-15 22:59 UTC"),
            (1_835_451_000, "2028-02-29 15:30 UTC"),
            (1_798_761_599, "2026-12-31 23:59 UTC"),
            (-1, "1969-12-31 23:59 UTC"),
        ] {
            assert_eq!(shown(seconds), text);
        }
    }

    #[test]
    fn each_day_that_begins_costs_its_share_after_the_grace() {
        for (after, days, kept) in [
            (-5, 0, 1.0),
            (0, 0, 1.0),
            (15 * 60, 0, 1.0),
            (15 * 60 + 1, 1, 0.7),
            (DAY, 1, 0.7),
            (DAY + 1, 2, 0.4),
            (3 * DAY, 3, 0.1),
            (3 * DAY + 1, 4, 0.0),
        ] {
            assert_eq!(days_late(DUE + after, DUE, &RULE), days, "{after}");
            assert!((share(&RULE, days) - kept).abs() < 1e-12, "{days}");
        }
        let unlimited = LateRule {
            most_days: None,
            ..RULE
        };
        assert_eq!(share(&unlimited, 9), 0.0);
    }

    #[test]
    fn extensions_and_the_teachers_word_count() {
        let late = commit(DUE + 2 * DAY, None);
        let decide = |student: &Student, commit| decide(student, commit, false, DUE, &RULE);
        assert_eq!(
            decide(&student("", ""), Some(&late)),
            Ok(Some((2, DUE + 2 * DAY)))
        );
        assert_eq!(
            decide(&student("2", ""), Some(&late)),
            Ok(Some((0, DUE + 2 * DAY)))
        );
        let until = student("2027-02-16 23:59:00+01:00", "");
        assert_eq!(decide(&until, Some(&late)), Ok(Some((1, DUE + 2 * DAY))));
        let said = student("", "2027-02-15T23:00:00+01:00");
        assert_eq!(decide(&said, Some(&late)), Ok(Some((0, DUE - 59 * 60))));
        assert_eq!(decide(&student("", ""), None), Ok(None));
        for wrong in [student("soon", ""), student("", "2027-02-15 23:00")] {
            assert!(decide(&wrong, Some(&late)).is_err());
        }
    }

    #[test]
    fn a_time_that_the_teacher_wrote_is_the_teams() {
        let member = |team: &str, handed_in: &str| Student {
            team: team.into(),
            ..student("", handed_in)
        };
        let students = [
            ("red", ""),
            ("red", "2027-02-15"),
            ("red", "2027-02-14"),
            ("", ""),
            ("", ""),
        ];
        let roster = Roster {
            students: students.map(|(team, at)| member(team, at)).to_vec(),
            ..Roster::default()
        };
        let times = (0..5).map(|i| with_time_of_team(&roster, i).handed_in.line());
        assert_eq!(
            times.collect::<Vec<_>>(),
            ["2027-02-15", "2027-02-15", "2027-02-14", "", ""]
        );
    }

    #[test]
    fn what_cannot_be_known_is_a_question() {
        let doubtful = commit(
            DUE - DAY,
            Some("committed before the commit that it follows"),
        );
        let error = decide(&student("", ""), Some(&doubtful), false, DUE, &RULE)
            .expect_err("the times are forged");
        assert!(
            error.contains("committed 2027-02-14 22:59 UTC, written 2027-02-14 22:58 UTC"),
            "{error}"
        );
        let said = student("", "2027-02-15");
        assert!(decide(&said, Some(&doubtful), false, DUE, &RULE).is_ok());
        let error = decide(&student("", ""), None, true, DUE, &RULE);
        assert!(
            error
                .expect_err("no time")
                .contains("nobody knows how late")
        );
    }

    #[test]
    fn only_late_and_doubtful_commits_have_a_note() {
        assert_eq!(note(&commit(DUE, None), Some(DUE)), None);
        assert_eq!(note(&commit(DUE + 1, None), None), None);
        let late = note(&commit(DUE + 60, None), Some(DUE)).expect("it is late");
        assert_eq!(
            late,
            "after the deadline: committed 2027-02-15 23:00 UTC, written 2027-02-15 22:59 UTC"
        );
    }
}
