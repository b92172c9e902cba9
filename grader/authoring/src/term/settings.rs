//! What a teacher's files say: `course.toml`, and `kept.toml`, which `grader course update` writes.

use super::own_case::{self, OwnCase};
use super::own_mistakes::{self, OwnMistakes};
use base::GraderError;
use grader::course::term::{LateRule, PartDates, Term};
use serde::Deserialize;
use std::collections::BTreeMap;
use std::path::Path;

/// The name of the teacher's file.
pub const FILE: &str = "course.toml";

/// The name of the file with what an update kept as it was.
pub const KEPT: &str = "kept.toml";

/// Folders for what a term cannot change: a clear refusal is better than a file without effect.
const REFUSED: [(&str, &str); 2] = [("stages", "own stages"), ("golden", "own goldens")];

/// `course.toml` of a term.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Settings {
    /// The name of the course.
    pub name: String,
    /// When it is given.
    pub term: String,
    /// Parts, tasks and cases that are left out: `part5`, `part1.task2`, `part1.task3/slivers`.
    #[serde(default)]
    pub leave_out: Vec<String>,
    /// The version of First Light.
    pub first_light: Version,
    /// The dates of the parts.
    #[serde(default)]
    pub dates: Vec<PartDates>,
    /// What late work loses.
    pub late: Option<LateRule>,
    /// The points of cases, by names such as `part1.task3/range`.
    #[serde(default)]
    pub points: BTreeMap<String, f64>,
}

/// Which First Light a term uses.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Version {
    /// Its version.
    pub version: String,
    /// The git repository that it is cloned from.
    pub source: String,
}

/// `kept.toml` of a term.
#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Kept {
    /// What newer versions added, and the term does not ask.
    #[serde(default)]
    pub leave_out: Vec<String>,
    /// Points that newer versions changed.
    #[serde(default)]
    pub points: BTreeMap<String, f64>,
}

/// All that a term changes.
#[derive(Clone, Debug)]
pub struct Changes {
    /// The teacher's file.
    pub settings: Settings,
    /// What updates kept.
    pub kept: Kept,
    /// The teacher's words for the front page, in Markdown.
    pub front: String,
    /// The teacher's scenes: file names and contents.
    pub scenes: BTreeMap<String, Vec<u8>>,
    /// The teacher's cases, by names such as `part1.task3/thin_door`.
    pub cases: BTreeMap<String, OwnCase>,
    /// The teacher's mistakes, by the keys of their tasks.
    pub mistakes: BTreeMap<String, OwnMistakes>,
}

impl Changes {
    /// Reads the files in the folder of a term.
    pub fn read(folder: &Path) -> Result<Changes, GraderError> {
        for (name, what) in REFUSED {
            if folder.join(name).exists() {
                return Err(GraderError::new(format!(
                    "{} has a folder `{name}`, and a term cannot have {what}: they are Rust code, which is compiled, \
                     blessed and tested with the course. They belong to a First Light of your own, from which terms are \
                     made (\"Hosting the course\" says how): remove the folder here",
                    folder.display()
                )));
            }
        }
        let mut inputs = base::term::inputs(folder)?;
        let cases = own_case::read(&inputs, folder)?;
        let mistakes = own_mistakes::read(&inputs, folder)?;
        let mut text = |name: &str| -> Result<Option<String>, GraderError> {
            let Some(contents) = inputs.remove(Path::new(name)) else {
                return Ok(None);
            };
            let text = String::from_utf8(contents);
            let path = folder.join(name);
            text.map(Some)
                .map_err(|_| GraderError::file("read", &path, "it is not UTF-8 text"))
        };
        let in_file = |name: &str, e: toml::de::Error| {
            GraderError::new(format!("{}: {e}", folder.join(name).display()))
        };
        let settings = text(FILE)?.ok_or_else(|| {
            GraderError::new(format!(
                "{} has no {FILE}. `grader course new DIR` makes the folder of a term",
                folder.display()
            ))
        })?;
        let kept = text(KEPT)?.unwrap_or_default();
        let changes = Changes {
            settings: toml::from_str(&settings).map_err(|e| in_file(FILE, e))?,
            kept: toml::from_str(&kept).map_err(|e| in_file(KEPT, e))?,
            front: text("front.md")?.unwrap_or_default(),
            scenes: inputs
                .into_iter()
                .filter_map(|(path, contents)| {
                    let name = path.file_name()?.to_str()?.to_string();
                    path.starts_with(base::term::SCENES)
                        .then_some((name, contents))
                })
                .collect(),
            cases,
            mistakes,
        };
        changes
            .settings
            .as_term()
            .check()
            .map_err(|e| GraderError::new(format!("{}: {e}", folder.join(FILE).display())))?;
        Ok(changes)
    }

    /// The points of cases that differ from First Light's. What the teacher says counts more than
    /// what an update kept.
    pub fn points(&self) -> BTreeMap<&str, f64> {
        let all = self.kept.points.iter().chain(&self.settings.points);
        all.map(|(name, points)| (name.as_str(), *points)).collect()
    }

    /// What is left out. A case to which the teacher gives points is not.
    pub fn left_out(&self) -> Vec<&str> {
        let kept = self
            .kept
            .leave_out
            .iter()
            .filter(|name| !self.settings.points.contains_key(*name));
        let all = self.settings.leave_out.iter().chain(kept);
        all.map(String::as_str).collect()
    }
}

impl Settings {
    /// What students and reports read of it.
    pub fn as_term(&self) -> Term {
        Term {
            name: self.name.clone(),
            when: self.term.clone(),
            dates: self.dates.clone(),
            late: self.late,
        }
    }
}
