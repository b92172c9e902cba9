//! What a class needs: the file `OUT/class.json`. It lists the submissions with the units that
//! give their scores. All machines that work on a class compute the same plan.

use crate::course_hash::{self, CourseHash};
use crate::entries;
use crate::hash::{self, Hasher};
use crate::intake::{self, Opened, Revision, Unreadable};
use base::{GraderError, Workspace, without_path, write_whole};
use grader::course::Course;
use serde::{Deserialize, Serialize};
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use submission::read::Submission;

/// The version of the files in `OUT`.
const VERSION: u32 = 1;

/// What is graded, and how. All of it is part of the key of each unit.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Settings {
    /// `all`, a part or a task.
    pub what: String,
    /// The seed of the cases' random inputs.
    pub seed: u64,
    /// The limits on compiling and running, as far as they can be chosen.
    pub limits: String,
    /// The commit that counts, if submissions are git clones.
    pub revision: Option<Revision>,
    /// The hashes of the course.
    pub course: CourseHash,
}

/// A task of the class, as the tables need it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PlannedTask {
    /// Its key, such as `part1.task3`.
    pub key: String,
    /// Its title.
    pub title: String,
    /// The crate below `stages/` with its functions.
    pub stage: String,
    /// Core points possible.
    pub max_score: f64,
    /// Extra points possible.
    pub max_extra: f64,
}

/// The plan of a class.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Plan {
    version: u32,
    /// What is graded, and how.
    pub settings: Settings,
    /// The tasks, in the order of the course.
    pub tasks: Vec<PlannedTask>,
    /// The submissions, sorted by name.
    pub submissions: Vec<Planned>,
}

/// A submission in a plan.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Planned {
    /// The student's name in all tables.
    pub name: String,
    /// The name of the folder or archive in the folder of the class.
    pub file: String,
    /// Its unit, or why it has none.
    #[serde(flatten)]
    pub state: State,
}

/// Whether a submission can be read.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum State {
    /// It can.
    Unit {
        /// The hash of what was handed in.
        submission: String,
        /// The key of its unit.
        key: String,
        /// What was unusual about its form, as sentences.
        notes: Vec<String>,
    },
    /// It is larger than a submission may be: the limit.
    TooLarge(String),
    /// It cannot be read: the reason.
    Unreadable(String),
}

impl Planned {
    /// The key of its unit, if it has one.
    pub fn key(&self) -> Option<&str> {
        match &self.state {
            State::Unit { key, .. } => Some(key),
            _ => None,
        }
    }
}

/// A submission that was opened and read.
#[derive(Debug)]
pub struct ReadSubmission {
    /// Its files. They are removed when this is dropped.
    pub opened: Opened,
    /// Its hash.
    pub hash: String,
    /// The hashes of the source files of each stage.
    pub sources: BTreeMap<String, String>,
    /// What was unusual about its form, as sentences.
    pub notes: Vec<String>,
}

/// Opens and reads the submission `file` in the folder `class`.
pub fn read(
    class: &Path,
    file: &str,
    course: &Course,
    workspace: &Workspace,
    revision: Option<&Revision>,
) -> Result<ReadSubmission, Unreadable> {
    let opened = intake::open(&class.join(file), &course.stages(), revision)?;
    let submission = Submission::read(&opened.root, course, workspace.root());
    let submission = submission.map_err(|error| {
        // The folder may be a temporary one, with another name every time.
        let root = format!("{}/", opened.root.display());
        let why = error.to_string().replace(&root, "");
        Unreadable::Damaged(format!("cannot be used: {why}"))
    })?;
    let mut sources = BTreeMap::new();
    for (stage, files) in &submission.stages {
        let mut hasher = Hasher::default();
        for (path, text) in files {
            hasher.part(path.to_string_lossy().as_bytes()).part(text);
        }
        sources.insert(stage.clone(), hasher.finish());
    }
    let mut hasher = Hasher::default();
    for (stage, hash) in &sources {
        hasher.part(stage).part(hash);
    }
    hasher.part("ignored");
    for path in &submission.ignored {
        hasher.part(path.to_string_lossy().as_bytes());
    }
    let mut notes = opened.notes.clone();
    notes.extend(submission.notes);
    Ok(ReadSubmission {
        opened,
        hash: hasher.finish(),
        sources,
        notes,
    })
}

impl Plan {
    /// Reads every submission in the folder `class` and makes a plan.
    pub fn make(
        class: &Path,
        workspace: &Workspace,
        settings: Settings,
        mut progress: impl FnMut(usize, usize),
    ) -> Result<Plan, GraderError> {
        let course = Course::read(workspace)?;
        let tasks = course.select(&settings.what)?;
        let tasks = tasks.iter().map(|task| {
            use judge::Tier;
            let points = |tier| {
                let cases = task.cases.iter().filter(|case| case.tier == tier);
                cases.fold(0.0, |sum, case| sum + case.points)
            };
            PlannedTask {
                key: task.key.clone(),
                title: task.title.clone(),
                stage: task.stage.clone(),
                max_score: points(Tier::Core),
                max_extra: points(Tier::Robust),
            }
        });
        let tasks = tasks.collect();
        let entries = entries::list(class)?;
        let count = entries.len();
        let mut submissions = Vec::new();
        for (i, entry) in entries.into_iter().enumerate() {
            progress(i, count);
            let read = read(
                class,
                &entry.file,
                &course,
                workspace,
                settings.revision.as_ref(),
            );
            let state = match read {
                Ok(read) => State::Unit {
                    key: settings.key(&read.hash),
                    submission: read.hash,
                    notes: read.notes,
                },
                Err(Unreadable::TooLarge(why)) => State::TooLarge(why),
                Err(Unreadable::Damaged(why)) => State::Unreadable(why),
                Err(Unreadable::Machine(error)) => return Err(error),
            };
            submissions.push(Planned {
                name: entry.name,
                file: entry.file,
                state,
            });
        }
        Ok(Plan {
            version: VERSION,
            settings,
            tasks,
            submissions,
        })
    }

    /// Reads the plan in `path`; `None` if there is none.
    pub fn load(path: &Path) -> Result<Option<Plan>, GraderError> {
        let text = match std::fs::read_to_string(path) {
            Ok(text) => text,
            Err(e) if e.kind() == std::io::ErrorKind::NotFound => return Ok(None),
            Err(e) => return Err(GraderError::file("read", path, e)),
        };
        let plan: Plan = serde_json::from_str(&text).map_err(|e| {
            GraderError::new(format!(
                "{} is not a plan of this version of the grader: {e}. Choose another folder for --out",
                path.display()
            ))
        })?;
        match plan.version {
            VERSION => Ok(Some(plan)),
            version => Err(GraderError::new(format!(
                "{} has version {version}, expected {VERSION}. Choose another folder for --out",
                path.display()
            ))),
        }
    }

    /// Writes the plan, and replaces an earlier one.
    pub fn store(&self, path: &Path) -> Result<(), GraderError> {
        write_whole(path, self.to_json()?.as_bytes())
    }

    /// Writes the plan if there is none yet. Returns whether it did: of several machines that start
    /// at once one is first, and the others take its seed.
    pub fn store_first(&self, path: &Path) -> Result<bool, GraderError> {
        use std::io::Write;
        let failed = |e: &std::io::Error| GraderError::file("write", path, without_path(e));
        let folder = path.parent().unwrap_or(Path::new("."));
        let mut file = tempfile::NamedTempFile::new_in(folder).map_err(|e| failed(&e))?;
        file.write_all(self.to_json()?.as_bytes())
            .map_err(|e| failed(&e))?;
        match file.persist_noclobber(path) {
            Ok(_) => Ok(true),
            Err(e) if e.error.kind() == std::io::ErrorKind::AlreadyExists => Ok(false),
            Err(e) => Err(failed(&e.error)),
        }
    }

    fn to_json(&self) -> Result<String, GraderError> {
        Ok(grader::report::json(self)? + "\n")
    }

    /// The units of the class: for each key the first submission that it belongs to, sorted by key.
    pub fn units(&self) -> BTreeMap<&str, &Planned> {
        let mut units = BTreeMap::new();
        for planned in &self.submissions {
            if let Some(key) = planned.key() {
                units.entry(key).or_insert(planned);
            }
        }
        units
    }

    /// Why only `to_grade` units are graded of more submissions; `None` if each is graded.
    /// `is_stored` knows the units that are stored.
    pub fn why_fewer(&self, to_grade: usize, is_stored: impl Fn(&str) -> bool) -> Option<String> {
        let units = self.units();
        let with_unit = self
            .submissions
            .iter()
            .filter(|s| s.key().is_some())
            .count();
        let stored = units.keys().filter(|key| is_stored(key)).count();
        let reasons = [
            (
                with_unit - units.len(),
                "equal to another and graded with it",
            ),
            (self.submissions.len() - with_unit, "that cannot be read"),
            (stored, "graded already"),
            (
                units.len().saturating_sub(stored + to_grade),
                "of other shards",
            ),
        ];
        let reasons = reasons.into_iter().filter(|(count, _)| *count > 0);
        let reasons: Vec<String> = reasons
            .map(|(count, why)| format!("{count} {why}"))
            .collect();
        (!reasons.is_empty()).then(|| {
            let count = self.submissions.len();
            format!(
                "{to_grade} of {count} submissions to grade; the others: {}",
                reasons.join(", ")
            )
        })
    }

    /// This plan with what `wanted` has more, for the same settings. A submission that has a score
    /// (`is_stored` knows the units that are stored) keeps it, even if other files were handed in
    /// since; the second value names such submissions.
    pub fn extended(&self, wanted: &Plan, is_stored: impl Fn(&str) -> bool) -> (Plan, Vec<String>) {
        let mut kept = Vec::new();
        let old: BTreeMap<&str, &Planned> = self
            .submissions
            .iter()
            .map(|planned| (planned.name.as_str(), planned))
            .collect();
        let names: BTreeSet<&str> = wanted
            .submissions
            .iter()
            .map(|planned| planned.name.as_str())
            .collect();
        let mut submissions: Vec<Planned> = Vec::new();
        for new in &wanted.submissions {
            let keeps = old
                .get(new.name.as_str())
                .filter(|old| old.state != new.state && old.key().is_some_and(&is_stored));
            submissions.push(match keeps {
                Some(old) => {
                    kept.push(format!("{} has other files now", new.name));
                    (*old).clone()
                }
                None => new.clone(),
            });
        }
        for planned in self
            .submissions
            .iter()
            .filter(|planned| !names.contains(planned.name.as_str()))
        {
            kept.push(format!("{} is no longer in the folder", planned.name));
            submissions.push(planned.clone());
        }
        submissions.sort_by(|a, b| a.name.cmp(&b.name));
        let plan = Plan {
            submissions,
            ..wanted.clone()
        };
        (plan, kept)
    }
}

impl Settings {
    /// The key of the unit of a submission with this hash.
    pub fn key(&self, submission: &str) -> String {
        let course = course_hash::whole(&self.course);
        hash::of([
            submission,
            &course,
            &self.what,
            &self.seed.to_string(),
            &self.limits,
        ])
    }

    /// How `new` settings differ, as ends of the sentence "OUT was graded with ...".
    pub fn differences(&self, new: &Settings) -> Vec<String> {
        let mut all: Vec<String> = course_hash::differences(&self.course, &new.course)
            .into_iter()
            .map(|part| format!("another version of {part}"))
            .collect();
        if self.what != new.what {
            all.push(format!("{} instead of {}", self.what, new.what));
        }
        if self.seed != new.seed {
            all.push(format!("the seed {} instead of {}", self.seed, new.seed));
        }
        if self.limits != new.limits {
            all.push(format!(
                "other limits ({} instead of {})",
                self.limits, new.limits
            ));
        }
        if self.revision != new.revision {
            let name = |revision: &Option<Revision>| match revision {
                Some(revision) => revision.to_string(),
                None => "the files as they lie there".to_string(),
            };
            all.push(format!(
                "{} instead of {}",
                name(&self.revision),
                name(&new.revision)
            ));
        }
        all
    }
}
