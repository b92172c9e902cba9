//! The roster of a class, as a course system exports it, and the marks as that system imports them.
//!
//! [`Roster::read`] reads the file, [`join`] finds out whose each submission is, [`table`] writes the
//! marks.

pub mod join;
pub mod table;

use base::GraderError;
use std::path::Path;
use submission::Untrusted;

/// The students of a class.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Roster {
    /// The students, in the order of the file.
    pub students: Vec<Student>,
    /// The most points that Moodle gives for the assignment, if the file says so.
    pub maximum: Option<f64>,
    /// The assignments of Canvas, by the names of their columns, and the most points of each.
    pub assignments: Vec<(Untrusted, f64)>,
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
}

/// The names of columns in the files of Canvas (gradebook), Moodle (participants, grading worksheet,
/// grades), Gradescope (roster) and GitHub Classroom, and in a table of one's own. In lower case.
const COLUMNS: [(&str, Field); 29] = [
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
const TEST_STUDENT: &str = "Student, Test";

impl Roster {
    /// Reads a roster, CSV with a line of column names.
    pub fn read(path: &Path) -> Result<Roster, GraderError> {
        let bytes = std::fs::read(path).map_err(|e| GraderError::file("read", path, e))?;
        let in_file = |why: String| GraderError::new(format!("{}: {why}", path.display()));
        Roster::parse(&bytes).map_err(in_file)
    }

    fn parse(bytes: &[u8]) -> Result<Roster, String> {
        let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
        let mut reader = csv::ReaderBuilder::new()
            .flexible(true)
            .trim(csv::Trim::All)
            .from_reader(bytes);
        let header = reader.headers().map_err(|e| e.to_string())?.clone();
        let names: Vec<String> = header.iter().map(str::to_lowercase).collect();
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
                    .map(|name| Untrusted::from(name).line())
                    .collect::<Vec<_>>()
                    .join(", ")
            ));
        }
        let mut students = Vec::new();
        let mut maximum = None;
        let mut assignments = Vec::new();
        for record in reader.records() {
            let record = record.map_err(|e| e.to_string())?;
            let value = |field: Field| {
                let column = fields.iter().position(|other| *other == Some(field));
                column.and_then(|i| record.get(i)).unwrap_or_default()
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
            let student = Student {
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
            };
            let is_empty = [&student.name, &student.id, &student.login, &student.number]
                .iter()
                .all(|text| text.is_empty());
            if name == POINTS_POSSIBLE {
                assignments = header
                    .iter()
                    .zip(&record)
                    .filter_map(|(name, points)| Some((name.into(), points.parse().ok()?)))
                    .collect();
            } else if is_canvas && name == TEST_STUDENT && student.id.is_empty() {
                continue;
            } else if !is_empty {
                maximum = maximum.or_else(|| value(Field::Maximum).parse().ok());
                students.push(student);
            }
        }
        if students.is_empty() {
            return Err("there is no student in it".into());
        }
        Ok(Roster {
            students,
            maximum,
            assignments,
        })
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
        let canvas = parse(
            "\u{feff}Student,ID,SIS User ID,SIS Login ID,Section,Homework 1 (77)\r\n    Points Possible,,,,,80\r\n\"Hopper, Grace\",98765,s1,ghopper,\"CS 1, A\",\r\n\"Student, Test\",98766,,1f00aa,\"CS 1, A\",\r\n",
        );
        let [grace] = &canvas[..] else {
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
