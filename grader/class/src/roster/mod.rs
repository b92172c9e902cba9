//! The roster of a class, as a course system exports it, and the marks as that system imports them.
//!
//! [`Roster::read`] reads the file, [`join`] finds out whose each submission is, [`table`] writes the
//! marks.

pub mod join;
pub mod table;

use crate::sheet::Sheet;
use base::GraderError;
use std::collections::BTreeMap;
use std::path::Path;
use submission::Untrusted;
use unicode_normalization::UnicodeNormalization;

/// The students of a class.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Roster {
    /// The students, in the order of the file.
    pub students: Vec<Student>,
    /// The most points that Moodle gives for the assignment, if the file says so.
    pub maximum: Option<f64>,
    /// The assignments of Canvas, by the names of their columns, and the most points of each.
    pub assignments: Vec<(Untrusted, f64)>,
    /// The numbers of Canvas's test students, who are no students of the class.
    pub test_students: Vec<Untrusted>,
}

/// A student of a roster. What the file does not say is empty.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Student {
    /// The whole name as the file has it: `Ada Lovelace` or `Lovelace, Ada`.
    pub name: Untrusted,
    /// The number that names bulk downloads: Canvas's `ID`, the number of Moodle's `Identifier`.
    pub number: Untrusted,
    /// The school's identifier: `SIS User ID`, `ID number`, `SID`, `id`.
    pub id: Untrusted,
    /// The name with which the student logs in, such as `SIS Login ID` or a GitHub user name.
    pub login: Untrusted,
    /// The address of e-mail.
    pub email: Untrusted,
    /// The section, as Canvas wants it back.
    pub section: Untrusted,
    /// When Moodle's mark was last changed, as Moodle wants it back.
    pub mark_changed: Untrusted,
    /// The teacher's own column `extension`: days, or another deadline.
    pub extension: Untrusted,
    /// The teacher's own column `handed_in`: when, if the submission does not say it.
    pub handed_in: Untrusted,
    /// The team with which the student hands in. Members of a team have equal texts here, however
    /// the file spells them.
    pub team: Untrusted,
}

impl Student {
    /// What tells the student from others: the first that is known of the school's identifier, the
    /// login, the address, the number and the name.
    pub fn key(&self) -> &Untrusted {
        let all = [&self.id, &self.login, &self.email, &self.number];
        let mut known = all.into_iter().filter(|text| !text.is_empty());
        known.next().unwrap_or(&self.name)
    }

    /// The name, or what else is known.
    pub fn label(&self) -> &Untrusted {
        match self.name.is_empty() {
            true => self.key(),
            false => &self.name,
        }
    }

    /// Whether both have an identifier of a student in common.
    fn is_same_as(&self, other: &Student) -> bool {
        let of_both = [
            (&self.number, &other.number),
            (&self.id, &other.id),
            (&self.login, &other.login),
        ];
        of_both.iter().any(|(a, b)| !a.is_empty() && a == b)
    }

    /// Whether both hand in together.
    pub fn is_teammate_of(&self, other: &Student) -> bool {
        !self.team.is_empty() && self.team == other.team
    }
}

/// What a column is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Field {
    Name,
    FirstName,
    LastName,
    Number,
    Identifier,
    Id,
    Login,
    Email,
    Section,
    MarkChanged,
    Maximum,
    Extension,
    HandedIn,
    Team,
}

/// The names of columns in the files of Canvas (gradebook, groups), Moodle (participants, grading
/// worksheet, grades), Gradescope (roster) and GitHub Classroom, and in a table of one's own. In
/// lower case.
const COLUMNS: [(&str, Field); 38] = [
    ("team", Field::Team),
    ("team name", Field::Team),
    ("team_name", Field::Team),
    ("group", Field::Team),
    ("group name", Field::Team),
    ("group_name", Field::Team),
    ("canvas_user_id", Field::Number),
    ("user_id", Field::Id),
    ("login_id", Field::Login),
    ("extension", Field::Extension),
    ("handed_in", Field::HandedIn),
    ("student", Field::Name),
    ("full name", Field::Name),
    ("name", Field::Name),
    ("first name", Field::FirstName),
    ("last name", Field::LastName),
    ("surname", Field::LastName),
    ("identifier", Field::Identifier),
    ("participant", Field::Identifier),
    ("sis user id", Field::Id),
    ("id number", Field::Id),
    ("sid", Field::Id),
    ("student id", Field::Id),
    ("sis login id", Field::Login),
    ("username", Field::Login),
    ("login", Field::Login),
    ("github_username", Field::Login),
    ("github username", Field::Login),
    ("email address", Field::Email),
    ("email", Field::Email),
    ("last modified (grade)", Field::MarkChanged),
    ("maximum grade", Field::Maximum),
    ("section", Field::Section),
    ("sections", Field::Section),
    ("roster identifier", Field::Id),
    ("roster_identifier", Field::Id),
    ("canvas id", Field::Number),
    ("participant number", Field::Number),
];

/// The column whose meaning depends on the system: Canvas's own number beside `SIS Login ID`, and
/// everywhere else the student's identifier.
const ID: &str = "id";

/// What Canvas writes into the second line, instead of a student.
const POINTS_POSSIBLE: &str = "Points Possible";

/// Whom Canvas adds to a class for teachers to see the page of a student.
const TEST_STUDENT: [&str; 2] = ["Student, Test", "Test Student"];

impl Roster {
    /// Reads a roster, CSV with a line of column names.
    pub fn read(path: &Path) -> Result<Roster, GraderError> {
        let bytes = std::fs::read(path).map_err(|e| GraderError::file("read", path, e))?;
        let in_file = |why: String| GraderError::new(format!("{}: {why}", path.display()));
        Roster::parse(&bytes).map_err(in_file)
    }

    fn parse(bytes: &[u8]) -> Result<Roster, String> {
        let sheet = Sheet::parse(bytes)?;
        let header = &sheet.columns;
        let names: Vec<String> = header.iter().map(|name| name.to_lowercase()).collect();
        let is_canvas = names.iter().any(|name| name == "sis login id");
        let fields = names.iter().map(|name| match name.as_str() {
            ID if is_canvas => Some(Field::Number),
            ID => Some(Field::Id),
            name => {
                let known = COLUMNS.iter().find(|(column, _)| *column == name);
                known.map(|(_, field)| *field)
            }
        });
        let fields: Vec<Option<Field>> = fields.collect();
        let has = |field| fields.contains(&Some(field));
        if !(has(Field::Name) || has(Field::LastName) || has(Field::Id) || has(Field::Login)) {
            return Err(format!(
                "no column names a student. Expected the export of Canvas (Student, ID, SIS User ID, SIS Login ID, Section), of Moodle (Identifier, Full name, Email address), of Gradescope (Name, SID, Email), or columns id and name; found {}",
                header
                    .iter()
                    .map(|name| Untrusted::from(name.as_str()).line())
                    .collect::<Vec<_>>()
                    .join(", ")
            ));
        }
        let mut students: Vec<Student> = Vec::new();
        let mut lines_of_students = Vec::new();
        let mut maximum = None;
        let mut assignments = Vec::new();
        let mut test_students = Vec::new();
        let mut teams = Teams::default();
        for (line, record) in &sheet.lines {
            let value = |field: Field| {
                let column = fields.iter().position(|other| *other == Some(field));
                let cell = column.and_then(|i| record.get(i));
                cell.map_or("", String::as_str)
            };
            let parts = [value(Field::FirstName), value(Field::LastName)];
            let name = match value(Field::Name) {
                "" => parts.join(" ").trim().to_string(),
                name => name.to_string(),
            };
            let identifier = value(Field::Identifier);
            // Moodle: `Participant 123456`, with a word of the reader's language.
            let digits = match identifier.rsplit_once(' ') {
                Some((_, digits)) if digits.bytes().all(|c| c.is_ascii_digit()) => digits,
                _ => "",
            };
            let mut student = Student {
                name: name.as_str().into(),
                number: match value(Field::Number) {
                    "" => digits.into(),
                    number => number.into(),
                },
                // GitHub Classroom calls the school's name of a student so.
                id: match value(Field::Id) {
                    "" if digits.is_empty() => identifier.into(),
                    id => id.into(),
                },
                login: value(Field::Login).into(),
                email: value(Field::Email).into(),
                section: value(Field::Section).into(),
                mark_changed: value(Field::MarkChanged).into(),
                extension: value(Field::Extension).into(),
                handed_in: value(Field::HandedIn).into(),
                team: Untrusted::default(),
            };
            let is_empty = [&student.name, &student.id, &student.login, &student.number]
                .iter()
                .all(|text| text.is_empty());
            if name == POINTS_POSSIBLE {
                assignments = header
                    .iter()
                    .zip(record)
                    .filter_map(|(name, points)| Some((name.as_str().into(), points.parse().ok()?)))
                    .collect();
            } else if is_canvas && is_test_student(&name) && student.id.is_empty() {
                test_students.push(student.number);
            } else if !is_empty {
                maximum = maximum.or_else(|| value(Field::Maximum).parse().ok());
                student.team = teams.of(*line, &student, value(Field::Team))?;
                let first = students.iter().position(|other| student.is_same_as(other));
                match first {
                    Some(i) if students[i] == student => {}
                    Some(i) => {
                        return Err(format!(
                            "line {line}: {} is in line {}, too, and the lines differ: keep one",
                            student.label().line(),
                            lines_of_students[i]
                        ));
                    }
                    None => {
                        students.push(student);
                        lines_of_students.push(*line);
                    }
                }
            }
        }
        if students.is_empty() {
            return Err("there is no student in it".into());
        }
        Ok(Roster {
            students,
            maximum,
            assignments,
            test_students,
        })
    }
}

/// Whether Canvas calls its test student so.
fn is_test_student(name: &str) -> bool {
    TEST_STUDENT.contains(&name)
}

/// The teams of a roster while it is read.
#[derive(Default)]
struct Teams {
    /// How each is spelt first, by its spelling in small letters.
    spelling: BTreeMap<String, Untrusted>,
    /// The line and team of each student so far, by whatever identifies the student.
    of_student: BTreeMap<(usize, Untrusted), (usize, Untrusted)>,
}

impl Teams {
    /// The team in a `cell` of a student's line. A student in two teams is an error.
    fn of(&mut self, line: usize, student: &Student, cell: &str) -> Result<Untrusted, String> {
        let in_two = |one: &str, other: &str| {
            Err(format!(
                "line {line}: {} is in the teams {one} and {other}. A student hands in with one team: keep that one",
                student.label().line()
            ))
        };
        let mut parts = cell
            .split(';')
            .map(str::trim)
            .filter(|part| !part.is_empty());
        let Some(team) = parts.next() else {
            return Ok(Untrusted::default());
        };
        let shown = |team: &str| Untrusted::from(team).line();
        if let Some(other) = parts.next() {
            return in_two(&shown(team), &shown(other));
        }
        let words: Vec<&str> = team.split_whitespace().collect();
        let key: String = words.join(" ").nfc().flat_map(char::to_lowercase).collect();
        let team = self
            .spelling
            .entry(key)
            .or_insert_with(|| team.into())
            .clone();
        let known = [&student.number, &student.id, &student.login, &student.email];
        for (i, known) in known
            .into_iter()
            .enumerate()
            .filter(|(_, known)| !known.is_empty())
        {
            let place = (i, known.clone());
            let (first, other) = self.of_student.entry(place).or_insert((line, team.clone()));
            if *other != team {
                return in_two(&team.line(), &format!("{} (line {first})", other.line()));
            }
        }
        Ok(team)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parse(text: &str) -> Vec<Student> {
        Roster::parse(text.as_bytes()).expect("a roster").students
    }

    #[test]
    fn the_exports_of_course_systems_are_read() {
        let canvas = Roster::parse(
            "\u{feff}Student,ID,SIS User ID,SIS Login ID,Section,Homework 1 (77)\r\n    Points Possible,,,,,80\r\n\"Hopper, Grace\",98765,s1,ghopper,\"CS 1, A\",\r\n\"Student, Test\",98766,,1f00aa,\"CS 1, A\",\r\nTest Student,98767,,1f00ab,B,\r\n".as_bytes(),
        );
        let canvas = canvas.expect("a roster");
        let numbers = canvas.test_students.iter().map(Untrusted::raw);
        assert_eq!(numbers.collect::<Vec<_>>(), ["98766", "98767"]);
        let [grace] = &canvas.students[..] else {
            panic!("{canvas:?}")
        };
        assert_eq!(grace.name, "Hopper, Grace");
        assert_eq!(
            [&grace.number, &grace.id, &grace.login].map(Untrusted::raw),
            ["98765", "s1", "ghopper"]
        );
        assert_eq!(grace.section, "CS 1, A");
        let moodle = parse(
            "Identifier,Full name,Email address,Status,Grade,Maximum Grade\nParticipant 123456,Ada Lovelace,ada@x,,,100\n",
        );
        assert_eq!(moodle[0].number, "123456");
        assert_eq!(moodle[0].email, "ada@x");
        let participants =
            parse("First name,Last name,ID number,Email address\nAda,Lovelace,s2,ada@x\n");
        assert_eq!(participants[0].name, "Ada Lovelace");
        assert_eq!(participants[0].id, "s2");
        let github = parse("identifier,github_username,github_id,name\ns3,alanturing,5,\n");
        assert_eq!(
            [&github[0].id, &github[0].login].map(Untrusted::raw),
            ["s3", "alanturing"]
        );
        assert_eq!(parse("id,name\nanna,Anna B\n")[0].id, "anna");
    }

    #[test]
    fn teams_are_read_as_course_systems_export_groups() {
        let teams = |text: &str| -> Vec<String> {
            let students = parse(text).into_iter();
            students.map(|student| student.team.line()).collect()
        };
        let canvas = "name,canvas_user_id,user_id,login_id,sections,group_name,canvas_group_id,group_id\n\
            Ada Lovelace,1,s1,ada,A,Red  Team,7,\nGrace Hopper,2,s2,grace,A,red team,7,\nAl Absent,3,s3,al,B,,,\n";
        assert_eq!(teams(canvas), ["Red  Team", "Red  Team", ""]);
        let ada = &parse(canvas)[0];
        assert_eq!(
            [&ada.number, &ada.id, &ada.login, &ada.section].map(Untrusted::raw),
            ["1", "s1", "ada", "A"]
        );
        assert_eq!(
            teams("id;team\r\nada;Red, green\r\nbo;C++\r\ncy;C#\r\n"),
            ["Red, green", "C++", "C#"]
        );
        for (text, expected) in [
            (
                "id,team\nada,red\nbo,red\n\nada,blue\n",
                "line 5: ada is in the teams blue and red (line 2)",
            ),
            (
                "id,name,team\nada,Ada,red;blue\n",
                "line 2: Ada is in the teams red and blue",
            ),
        ] {
            let error = Roster::parse(text.as_bytes()).expect_err(text);
            assert!(error.starts_with(expected), "{error}");
        }
        assert_eq!(teams("id,team\nada,red\nada,RED\n"), ["red"]);
    }

    #[test]
    fn a_student_is_in_one_line() {
        let twice = "id,name\nada,Ada\nbo,Bo\nada,Ada\n";
        assert_eq!(parse(twice).len(), 2);
        for other in ["ada,Ada L.,", "ada,Ada,blue", ",Ada,,ada@x"] {
            let text = format!("id,name,team,login\nada,Ada,,ada@x\n\n{other}\n");
            let error = Roster::parse(text.as_bytes()).expect_err(&text);
            assert!(error.starts_with("line 4: Ada"), "{error}");
            assert!(error.contains("is in line 2, too"), "{error}");
        }
    }

    #[test]
    fn what_is_no_roster_is_said() {
        for (text, expected) in [
            ("a,b\n1,2\n", "no column names a student"),
            ("id,name\n", "there is no student in it"),
        ] {
            let error = Roster::parse(text.as_bytes()).expect_err(text);
            assert!(error.contains(expected), "{error}");
        }
    }
}
