//! Whose a submission is, by the name of its folder or archive. Course systems name bulk downloads:
//!
//! - Moodle: `Ada Lovelace_123456_assignsubmission_file_`: name, number of the participant
//! - Canvas: `hoppergrace_LATE_98765_4567890_stages-2.zip`: last and first name in small letters
//!   without spaces, perhaps `LATE`, number of the student, number of the submission, file
//! - GitHub Classroom: `part1-alanturing`: assignment, user name
//!
//! Without such a pattern the name is one of the student's own: identifier, login, e-mail, name; or
//! that of a team.
//!
//! A team has one submission, whatever member or team it is named after. Of several that are equal
//! the first one counts. Of different clones, the one whose commit is the last before the deadline
//! (that of the member with the longest extension); if all are late, the last one. Else a person
//! decides.

use super::{Roster, Student, TEST_STUDENT};
use crate::late;
use crate::plan::{Plan, PlannedTerm, State};
use crate::reading::intake::CommitTimes;
use std::collections::{BTreeMap, BTreeSet};
use submission::Untrusted;
use unicode_normalization::UnicodeNormalization;
use unicode_normalization::char::is_combining_mark;

/// What the name of a submission says about who handed it in.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
struct Clue {
    /// The number in the course system.
    number: Option<String>,
    /// A name: it decides only if there is no number, or the roster has none.
    name: String,
    /// Whether the system says that it was late.
    is_late: bool,
}

/// What Moodle writes after the number of a participant.
const MOODLE: &str = "_assignsubmission_";

impl Clue {
    /// What `entry` says. Nothing, if it can be read in two ways: students choose the names of
    /// their files, and one may look like what another system writes, with somebody's number.
    fn of(entry: &str) -> Clue {
        match [Clue::of_moodle(entry), Clue::of_canvas(entry)] {
            [Readings::None, Readings::None] => Clue {
                name: entry.to_string(),
                ..Clue::default()
            },
            [Readings::One(clue), Readings::None] | [Readings::None, Readings::One(clue)] => clue,
            _ => Clue::default(),
        }
    }

    fn of_moodle(entry: &str) -> Readings {
        let clue = entry
            .split_once(MOODLE)
            .and_then(|(who, _)| who.rsplit_once('_'))
            .filter(|(_, number)| is_number(number));
        match (entry.matches(MOODLE).count(), clue) {
            (1, Some((name, number))) => Readings::One(Clue {
                number: Some(number.to_string()),
                name: name.to_string(),
                is_late: false,
            }),
            (0 | 1, _) => Readings::None,
            _ => Readings::Several,
        }
    }

    fn of_canvas(entry: &str) -> Readings {
        let mut parts: Vec<&str> = entry.split('_').collect();
        let name = parts.remove(0);
        let is_late = parts.first() == Some(&"LATE");
        let numbers_and_file = &parts[usize::from(is_late)..];
        let numbers = numbers_and_file.iter().take_while(|part| is_number(part));
        match numbers.count() {
            // The last part is the name of the file.
            2 if numbers_and_file.len() > 2 => Readings::One(Clue {
                number: Some(numbers_and_file[0].to_string()),
                name: name.to_string(),
                is_late,
            }),
            0..=2 => Readings::None,
            // The name may end in a number, or the name of the file begin with one.
            _ => Readings::Several,
        }
    }
}

/// In how many ways a name can be what one system writes.
enum Readings {
    None,
    One(Clue),
    Several,
}

fn is_number(text: &str) -> bool {
    !text.is_empty() && text.bytes().all(|c| c.is_ascii_digit())
}

/// Why nobody gets the score of a submission.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Problem {
    /// No student of the roster fits its name.
    Nobody,
    /// Several students fit its name.
    Several(Vec<usize>),
    /// Its student, or a team, of which this is the first member, handed in others, too.
    Again(usize),
}

/// What is known of a submission before it is graded.
#[derive(Clone, Copy, Debug)]
struct Entry<'a> {
    name: &'a str,
    /// The hash of its files.
    files: Option<&'a str>,
    /// The times of the commit that counts.
    commit: Option<&'a CommitTimes>,
}

/// Who handed in what. Numbers of students are those of the roster, numbers of submissions those of
/// the list of names.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Join {
    /// The submission of each student.
    pub submissions: Vec<Option<usize>>,
    /// Submissions that a person has to assign.
    pub problems: Vec<(usize, Problem)>,
    /// Submissions that the course system calls late.
    pub late: Vec<usize>,
    /// The first student, in the order of the roster, of those who handed in a submission.
    pub owners: Vec<Option<usize>>,
    /// Submissions of Canvas's test student, as whom a teacher sees the page of a student.
    pub of_test_student: Vec<usize>,
    /// Submissions of a team that do not count, each with the one that was handed in later.
    pub replaced: BTreeMap<usize, usize>,
}

impl Join {
    /// Joins submissions of which only the names are known to the students of a roster.
    pub fn of(roster: &Roster, names: &[&str]) -> Join {
        let entries = names.iter().map(|name| Entry {
            name,
            files: None,
            commit: None,
        });
        Join::new(roster, &entries.collect::<Vec<_>>(), None)
    }

    /// Whether the student number `i`, or a teammate, handed in more than once.
    pub fn has_several(&self, roster: &Roster, i: usize) -> bool {
        let student = &roster.students[i];
        let mut problems = self.problems.iter();
        problems.any(|(_, problem)| match problem {
            Problem::Again(of) => *of == i || roster.students[*of].is_teammate_of(student),
            _ => false,
        })
    }

    /// Joins the submissions of a plan to the students of a roster.
    pub fn of_plan(roster: &Roster, plan: &Plan) -> Join {
        let entries = plan.submissions.iter().map(|planned| {
            let (files, commit) = match &planned.state {
                State::Unit {
                    submission, commit, ..
                } => (Some(submission.as_str()), commit.as_ref()),
                _ => (None, None),
            };
            Entry {
                name: planned.name.raw(),
                files,
                commit,
            }
        });
        Join::new(roster, &entries.collect::<Vec<_>>(), plan.term.as_ref())
    }

    fn new(roster: &Roster, entries: &[Entry], term: Option<&PlannedTerm>) -> Join {
        let mut first_of_team: BTreeMap<&Untrusted, usize> = BTreeMap::new();
        let students = roster.students.iter().enumerate();
        let first_members: Vec<usize> = students
            .map(|(i, student)| match student.team.is_empty() {
                true => i,
                false => *first_of_team.entry(&student.team).or_insert(i),
            })
            .collect();
        let mut join = Join {
            owners: vec![None; entries.len()],
            ..Join::default()
        };
        let mut of_first: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
        for (i, entry) in entries.iter().enumerate() {
            let clue = Clue::of(entry.name);
            if clue.is_late {
                join.late.push(i);
            }
            let fitting = fitting(roster, &clue);
            let firsts: BTreeSet<usize> = fitting.iter().map(|s| first_members[*s]).collect();
            match firsts.len() {
                0 if is_of_test_student(roster, &clue) => join.of_test_student.push(i),
                0 => join.problems.push((i, Problem::Nobody)),
                1 => {
                    join.owners[i] = firsts.first().copied();
                    of_first
                        .entry(first_members[fitting[0]])
                        .or_default()
                        .push(i);
                }
                _ => join.problems.push((i, Problem::Several(fitting))),
            }
        }
        let mut counts: BTreeMap<usize, usize> = BTreeMap::new();
        for (first, submissions) in of_first {
            let student = &roster.students[first];
            match the_one_that_counts(roster, student, entries, &submissions, term) {
                Some(one) => {
                    counts.insert(first, one);
                    let others = submissions
                        .into_iter()
                        .filter(|i| *i != one && entries[*i].files != entries[one].files);
                    join.replaced.extend(others.map(|other| (other, one)));
                }
                None => {
                    let again = submissions.into_iter();
                    join.problems
                        .extend(again.map(|i| (i, Problem::Again(first))));
                }
            }
        }
        let submissions = first_members.iter().map(|first| counts.get(first).copied());
        join.submissions = submissions.collect();
        join.problems.sort_by_key(|(entry, _)| *entry);
        join
    }

    /// Whose each of the submissions `entries` is. Namesakes have the name of their submission after
    /// their own, teams their members.
    pub fn names(&self, roster: &Roster, entries: &[&str]) -> BTreeMap<String, Untrusted> {
        let mut namesakes: BTreeMap<String, usize> = BTreeMap::new();
        for student in &roster.students {
            *namesakes.entry(plain(student.name.raw())).or_default() += 1;
        }
        let owners = entries.iter().zip(&self.owners);
        owners
            .filter_map(|(entry, first)| {
                let student = &roster.students[(*first)?];
                let name = match namesakes[&plain(student.name.raw())] {
                    _ if !student.team.is_empty() => with_members(roster, student).into(),
                    _ if student.name.is_empty() => return None,
                    1 => student.name.clone(),
                    _ => format!("{} ({entry})", student.name.raw()).into(),
                };
                Some((entry.to_string(), name))
            })
            .collect()
    }
}

/// The name of a student's team and of its members.
pub fn with_members(roster: &Roster, student: &Student) -> String {
    let members = roster
        .students
        .iter()
        .filter(|other| other.is_teammate_of(student));
    let members: Vec<&str> = members.map(|member| member.label().raw()).collect();
    format!("{}: {}", student.team.raw(), members.join(", "))
}

/// Which of the submissions of a student and the student's team counts.
fn the_one_that_counts(
    roster: &Roster,
    student: &Student,
    entries: &[Entry],
    submissions: &[usize],
    term: Option<&PlannedTerm>,
) -> Option<usize> {
    let first = *submissions.first()?;
    let files = entries[first].files;
    let is_equal = |i: &usize| *i == first || files.is_some() && entries[*i].files == files;
    if submissions.iter().all(is_equal) {
        return Some(first);
    }
    if student.team.is_empty() {
        return None;
    }
    let mut timed = Vec::new();
    for i in submissions {
        let commit = entries[*i].commit.filter(|commit| commit.doubt.is_none())?;
        let members = roster
            .students
            .iter()
            .filter(|other| other.is_teammate_of(student));
        let in_time = members.map(|member| late::is_in_time(commit.committer, member, term));
        let is_in_time = in_time.reduce(|a, b| a || b).unwrap_or(true);
        timed.push(((is_in_time, commit.committer), *i));
    }
    let (last, _) = timed.iter().max()?;
    let mut of_last = timed
        .iter()
        .filter(|(time, _)| time == last)
        .map(|(_, i)| *i);
    let one = of_last.next()?;
    let same = |i: usize| entries[i].files == entries[one].files;
    of_last.all(same).then_some(one)
}

/// The students who fit a clue, or whose team fits it. A number decides alone. An identifier does not decide against a
/// name: students choose their logins, and one may be the name of somebody else.
fn fitting(roster: &Roster, clue: &Clue) -> Vec<usize> {
    let those = |fits: &dyn Fn(&Student) -> bool| -> Vec<usize> {
        let students = roster.students.iter().enumerate();
        students
            .filter(|(_, student)| fits(student))
            .map(|(i, _)| i)
            .collect()
    };
    let has_number = |student: &Student| !student.number.is_empty();
    if let Some(number) = &clue.number
        && roster.students.iter().any(has_number)
    {
        return those(&|student| student.number == number.as_str());
    }
    let own = plain(&clue.name);
    let is = |text: &str| !own.is_empty() && plain(text) == own;
    let identifiers = |student: &Student| -> Vec<String> {
        let local = student.email.raw().split('@').next().unwrap_or_default();
        let ids = [&student.id, &student.login, &student.email].map(|text| text.raw());
        ids.into_iter().chain([local]).map(str::to_string).collect()
    };
    let is_exact = |student: &Student| identifiers(student).contains(&clue.name);
    let has_exact = !clue.name.is_empty() && roster.students.iter().any(is_exact);
    let by_identifier = |student: &Student| match has_exact {
        true => is_exact(student),
        false => identifiers(student).iter().any(|id| is(id)),
    };
    let is_exact_team = |student: &Student| student.team == clue.name.as_str();
    let has_exact_team = !clue.name.is_empty() && roster.students.iter().any(is_exact_team);
    let by_team = |student: &Student| match has_exact_team {
        true => is_exact_team(student),
        false => is(student.team.raw()),
    };
    let by_name = |student: &Student| {
        by_team(student) || orders(student.name.raw()).iter().any(|name| is(name))
    };
    // GitHub Classroom: the assignment, a hyphen, the login or the team. It counts beside a login
    // that looks like all of that, which another student may have chosen.
    let name = clue.name.to_lowercase();
    let is_suffix = |text: &Untrusted| {
        let text = text.raw().to_lowercase().replace(' ', "-");
        let start = name.strip_suffix(&text).filter(|_| !text.is_empty());
        start.is_some_and(|start| start.ends_with('-'))
    };
    let by_suffix = |student: &Student| is_suffix(&student.login) || is_suffix(&student.team);
    those(&|student| by_identifier(student) || by_name(student) || !has_exact && by_suffix(student))
}

/// Whether a submission that fits nobody is that of Canvas's test student: the roster has its
/// number, or it has a number and that student's name, in either order.
fn is_of_test_student(roster: &Roster, clue: &Clue) -> bool {
    let Some(number) = &clue.number else {
        return false;
    };
    let own = plain(&clue.name);
    let mut names = TEST_STUDENT.iter();
    roster
        .test_students
        .iter()
        .any(|test| *test == number.as_str())
        || names.any(|name| plain(name) == own)
}

/// A name without spaces, signs and capital letters, as Canvas writes it. A letter with a mark is
/// one character, however it was written: macOS writes names of files as letters and marks.
fn plain(text: &str) -> String {
    text.nfc()
        .filter(|c| c.is_alphanumeric() || is_combining_mark(*c))
        .flat_map(char::to_lowercase)
        .collect()
}

/// A name with the first name first and with the last name first.
fn orders(name: &str) -> Vec<String> {
    match name.split_once(',') {
        Some((last, first)) => vec![format!("{last} {first}"), format!("{first} {last}")],
        None => match name.trim().rsplit_once(' ') {
            Some((first, last)) => vec![name.to_string(), format!("{last} {first}")],
            None => vec![name.to_string()],
        },
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn roster() -> Roster {
        let student = |name: &str, number: &str, id: &str, login: &str, email: &str| Student {
            name: name.into(),
            number: number.into(),
            id: id.into(),
            login: login.into(),
            email: email.into(),
            ..Student::default()
        };
        Roster {
            students: vec![
                student("Ada Lovelace", "123456", "s1", "ada", "ada@school"),
                student(
                    "Hopper, Grace",
                    "98765",
                    "s2",
                    "ghopper",
                    "grace.hopper@school",
                ),
                student("Alan Turing", "777", "s3", "alan-turing", ""),
                student("Kim Lee", "1", "s4", "kim1", ""),
                student("Kim Lee", "2", "s5", "kim2", ""),
            ],
            ..Roster::default()
        }
    }

    #[test]
    fn bulk_downloads_find_their_students() {
        for (entry, student) in [
            ("Ada Lovelace_123456_assignsubmission_file_", 0),
            ("Ada Lovelace_123456_assignsubmission_file", 0),
            ("hoppergrace_LATE_98765_4567890_stages-2", 1),
            ("hoppergrace_98765_4567890_stages", 1),
            ("Kim Lee_2_assignsubmission_file_", 4),
            ("part1-alan-turing", 2),
            ("S3", 2),
            ("grace.hopper", 1),
            ("Grace Hopper", 1),
            ("lovelace-ada", 0),
        ] {
            let join = Join::of(&roster(), &[entry]);
            let mut expected = vec![None; 5];
            expected[student] = Some(0);
            assert_eq!(join.submissions, expected, "{entry}: {:?}", join.problems);
            assert_eq!(join.late.len(), usize::from(entry.contains("LATE")));
        }
    }

    #[test]
    fn the_test_student_of_canvas_is_named() {
        let mut roster = roster();
        roster.test_students.push("98766".into());
        let entries = [
            "studenttest_98766_4_stages",
            "teststudent_LATE_5_6_x",
            "renamed_98766_4_x",
            // Nobody's: no name of Canvas, and another student.
            "Test Student",
            "testa_5_6_x",
        ];
        let join = Join::of(&roster, &entries);
        assert_eq!(join.of_test_student, [0, 1, 2]);
        assert_eq!(join.problems, [(3, Problem::Nobody), (4, Problem::Nobody)]);
        // A student whose name it is.
        roster.students[0].name = "Student, Test".into();
        roster.students[0].number = "5".into();
        let join = Join::of(&roster, &entries[1..2]);
        assert_eq!(join.submissions[0], Some(0));
        assert!(join.of_test_student.is_empty());
    }

    #[test]
    fn nothing_is_guessed() {
        let entries = ["Kim Lee", "nobody", "ada", "s1", "x_5_6_a", "part1-turing"];
        let join = Join::of(&roster(), &entries);
        assert_eq!(
            join.problems,
            [
                (0, Problem::Several(vec![3, 4])),
                (1, Problem::Nobody),
                (2, Problem::Again(0)),
                (3, Problem::Again(0)),
                (4, Problem::Nobody),
                (5, Problem::Nobody),
            ]
        );
        assert_eq!(join.submissions, [None; 5]);
    }

    /// A student who chooses a name, a login or the name of a file gets no mark of somebody else.
    #[test]
    fn a_chosen_name_takes_nobodys_mark() {
        let mut roster = roster();
        roster.students[3].login = "adalovelace".into();
        roster.students[4].login = "a.da".into();
        roster.students[2].login = "-".into();
        for (entry, problem) in [
            ("Ada Lovelace", Problem::Several(vec![0, 3])),
            (
                "X_98765_assignsubmission_file__777_assignsubmission_file_",
                Problem::Nobody,
            ),
            (
                "Alan Turing_777_assignsubmission_file_x_98765_assignsubmission_file_",
                Problem::Nobody,
            ),
            ("ada_111_4567002_98765_assignsubmission_", Problem::Nobody),
            (
                "turingalan_LATE_777_4567003_777_assignsubmission_",
                Problem::Nobody,
            ),
            ("x_777_98765_4567004_stages", Problem::Nobody),
            ("___", Problem::Nobody),
            ("A_DA", Problem::Several(vec![0, 4])),
        ] {
            assert_eq!(
                Join::of(&roster, &[entry]).problems,
                [(0, problem)],
                "{entry}"
            );
        }
        roster.students[4].login = "part1alanturing".into();
        roster.students[2].login = "alan-turing".into();
        let join = Join::of(&roster, &["part1-alan-turing"]);
        assert_eq!(join.problems, [(0, Problem::Several(vec![2, 4]))]);
        roster.students[4].login = "a.da".into();
        // Renamed to the identifier as the roster has it, it is one student's.
        for (entry, student) in [("ada", 0), ("a.da", 4)] {
            let join = Join::of(&roster, &[entry]);
            assert_eq!(join.submissions[student], Some(0), "{entry}");
        }
    }

    #[test]
    fn letters_and_marks_are_the_letters_that_they_make() {
        let mut roster = roster();
        roster.students[0].name = "Müller, Zoë".into();
        roster.students[1].name = "Muller, Zoe".into();
        for (entry, student) in [
            ("Zoe\u{308} Mu\u{308}ller", 0),
            ("Zoë Müller", 0),
            ("Zoe Muller", 1),
        ] {
            let join = Join::of(&roster, &[entry]);
            assert_eq!(join.submissions[student], Some(0), "{entry}: {join:?}");
        }
    }

    #[test]
    fn namesakes_are_told_apart() {
        let entries = ["kim1", "kim2", "ada"];
        let join = Join::of(&roster(), &entries);
        let owners = join.names(&roster(), &entries);
        let names: Vec<&str> = owners.values().map(Untrusted::raw).collect();
        assert_eq!(names, ["Ada Lovelace", "Kim Lee (kim1)", "Kim Lee (kim2)"]);
    }

    /// The roster with Ada and Grace as the team C++, and Alan alone as the team C#.
    fn teams() -> Roster {
        let mut roster = roster();
        for (student, team) in [
            (0, "C++"),
            (1, "C++"),
            (2, "C#"),
            (3, "Red Team"),
            (4, "Red Team"),
        ] {
            roster.students[student].team = team.into();
        }
        roster
    }

    #[test]
    fn a_teams_submission_is_each_members() {
        let [cpp, alone, red] = [[0, 1].as_slice(), &[2], &[3, 4]];
        for (entry, members) in [
            ("ada", cpp),
            ("Grace Hopper", cpp),
            ("hoppergrace_98765_4567890_stages", cpp),
            ("C++", cpp),
            ("C#", alone),
            ("red team", red),
            ("part1-red-team", red),
            ("part1-kim2", red),
            ("Kim Lee", red),
        ] {
            let join = Join::of(&teams(), &[entry]);
            let expected: Vec<_> = (0..5).map(|i| members.contains(&i).then_some(0)).collect();
            assert_eq!(join.submissions, expected, "{entry}: {:?}", join.problems);
        }
        let problem = |entry: &str| Join::of(&teams(), &[entry]).problems;
        assert_eq!(problem("c"), [(0, Problem::Several(vec![0, 1, 2]))]);
        let mut roster = teams();
        roster.students[2].team = "ada".into();
        let join = Join::of(&roster, &["ada"]);
        assert_eq!(join.problems, [(0, Problem::Several(vec![0, 2]))]);
        let join = Join::of(&teams(), &["ada", "ghopper", "kim1"]);
        assert_eq!(
            join.problems,
            [(0, Problem::Again(0)), (1, Problem::Again(0))]
        );
        assert_eq!(join.submissions, [None, None, None, Some(2), Some(2)]);
        let names = join.names(&teams(), &["ada", "ghopper", "kim1"]);
        assert_eq!(names["kim1"], "Red Team: Kim Lee, Kim Lee");
    }

    /// Of clones of one team, with the times of their commits, the last one in time counts.
    #[test]
    fn the_last_clone_before_the_deadline_counts() {
        let due = 1_000_000;
        let hour = 60 * 60;
        let clone = |after: i64| CommitTimes {
            author: due + after,
            committer: due + after,
            doubt: None,
        };
        let doubtful = CommitTimes {
            doubt: Some("committed in the future".into()),
            ..clone(-hour)
        };
        let term = PlannedTerm {
            title: String::new(),
            due: Some(due),
            late: None,
        };
        let join = |roster: &Roster, clones: [(&str, &CommitTimes); 2], term| {
            let named = [("ada", clones[0]), ("ghopper", clones[1])];
            let entries = named.map(|(name, (files, commit))| Entry {
                name,
                files: Some(files),
                commit: Some(commit),
            });
            Join::new(roster, &entries, term)
        };
        let mut extended = teams();
        extended.students[1].extension = "2".into();
        for (roster, clones, counts) in [
            (
                teams(),
                [("a", &clone(-2 * hour)), ("b", &clone(-hour))],
                Some(1),
            ),
            (
                teams(),
                [("a", &clone(-hour)), ("b", &clone(hour))],
                Some(0),
            ),
            (
                extended,
                [("a", &clone(-hour)), ("b", &clone(hour))],
                Some(1),
            ),
            (
                teams(),
                [("a", &clone(2 * hour)), ("b", &clone(hour))],
                Some(0),
            ),
            (teams(), [("a", &clone(hour)), ("b", &clone(hour))], None),
            (teams(), [("a", &clone(-2 * hour)), ("b", &doubtful)], None),
        ] {
            let join = join(&roster, clones, Some(&term));
            assert_eq!(join.submissions[..2], [counts; 2], "{clones:?}");
            assert_eq!(join.problems.len(), if counts.is_none() { 2 } else { 0 });
            let replaced: Vec<_> = join.replaced.into_iter().collect();
            assert_eq!(replaced, Vec::from_iter(counts.map(|one| (1 - one, one))));
        }
        let late = [("a", &clone(-hour)), ("b", &clone(hour))];
        assert_eq!(join(&teams(), late, None).submissions[0], Some(1));
        let equal = join(
            &teams(),
            [("a", &doubtful), ("a", &clone(hour))],
            Some(&term),
        );
        assert_eq!((equal.submissions[0], equal.replaced.len()), (Some(0), 0));
        let mut alone = teams();
        alone.students[0].team = "".into();
        alone.students[1].team = "".into();
        alone.students[1].login = "x".into();
        assert_eq!(join(&alone, late, None).submissions[0], Some(0));
    }
}
