//! Whose a submission is, by the name of its folder or archive. Course systems name bulk downloads:
//!
//! - Moodle: `Ada Lovelace_123456_assignsubmission_file_`: name, number of the participant
//! - Canvas: `hoppergrace_LATE_98765_4567890_stages-2.zip`: last and first name in small letters
//!   without spaces, perhaps `LATE`, number of the student, number of the submission, file
//! - GitHub Classroom: `part1-alanturing`: assignment, user name
//!
//! Without such a pattern the name is one of the student's own: identifier, login, e-mail, name.

use super::{Roster, Student};
use std::collections::BTreeMap;
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
    /// Its student handed in others, too.
    Again(usize),
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
}

impl Join {
    /// Joins the submissions with these names to the students of a roster.
    pub fn of(roster: &Roster, entries: &[&str]) -> Join {
        let mut of_student: Vec<Vec<usize>> = vec![Vec::new(); roster.students.len()];
        let mut join = Join::default();
        for (i, entry) in entries.iter().enumerate() {
            let clue = Clue::of(entry);
            if clue.is_late {
                join.late.push(i);
            }
            match fitting(roster, &clue).as_slice() {
                [] => join.problems.push((i, Problem::Nobody)),
                [student] => of_student[*student].push(i),
                several => join.problems.push((i, Problem::Several(several.to_vec()))),
            }
        }
        for (student, entries) in of_student.into_iter().enumerate() {
            join.submissions.push(match entries.as_slice() {
                [entry] => Some(*entry),
                several => {
                    let again = several
                        .iter()
                        .map(|entry| (*entry, Problem::Again(student)));
                    join.problems.extend(again);
                    None
                }
            });
        }
        join.problems.sort_by_key(|(entry, _)| *entry);
        join
    }

    /// The students' names, by those of their submissions, `entries`. Namesakes have the name of
    /// their submission after their own.
    pub fn owners(&self, roster: &Roster, entries: &[&str]) -> BTreeMap<String, Untrusted> {
        let mut namesakes: BTreeMap<String, usize> = BTreeMap::new();
        for student in &roster.students {
            *namesakes.entry(plain(student.name.raw())).or_default() += 1;
        }
        let students = roster.students.iter().zip(&self.submissions);
        students
            .filter(|(student, _)| !student.name.is_empty())
            .filter_map(|(student, entry)| {
                let entry = entries[(*entry)?];
                let name = match namesakes[&plain(student.name.raw())] {
                    1 => student.name.clone(),
                    _ => format!("{} ({entry})", student.name.raw()).into(),
                };
                Some((entry.to_string(), name))
            })
            .collect()
    }
}

/// The students who fit a clue. A number decides alone. An identifier does not decide against a
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
    let by_name = |student: &Student| orders(student.name.raw()).iter().any(|name| is(name));
    // GitHub Classroom: the assignment, a hyphen, the login. It counts beside a login that looks
    // like all of that, which another student may have chosen.
    let name = clue.name.to_lowercase();
    let by_suffix = |student: &Student| {
        let login = student.login.raw().to_lowercase();
        let start = name.strip_suffix(&login).filter(|_| !login.is_empty());
        start.is_some_and(|start| start.ends_with('-'))
    };
    those(&|student| by_identifier(student) || by_name(student) || !has_exact && by_suffix(student))
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
        let owners = join.owners(&roster(), &entries);
        let names: Vec<&str> = owners.values().map(Untrusted::raw).collect();
        assert_eq!(names, ["Ada Lovelace", "Kim Lee (kim1)", "Kim Lee (kim2)"]);
    }
}
