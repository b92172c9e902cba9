//! The plan of a class, the file `OUT/class.json`: the submissions, each with the unit that gives
//! its score. All machines that work on a class compute the same plan.

use crate::course_hash::{self, CourseHash};
use crate::entries;
use crate::hash;
use crate::reading::intake::{CommitTimes, Revision};
use crate::reading::{Reader, Unreadable};
use base::write_whole;
use base::{GraderError, without_path};
use grader::course::term::LateRule;
use grader::course::{Course, Task};
use judge::Tier;
use serde::{Deserialize, Serialize};
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use submission::Untrusted;

/// The version of the files in `OUT`.
const VERSION: u32 = 2;

/// What is graded, and how. All of it but `revision` is part of the key of each unit.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Settings {
    /// `all`, a part or a task.
    pub what: String,
    /// The seed of the cases' random inputs.
    pub seed: u64,
    /// The limits on compiling and running, those that can be chosen.
    pub limits: String,
    /// The commit that counts, if submissions are git clones.
    pub revision: Option<Revision>,
    /// The hashes of the course.
    pub course: CourseHash,
}

/// A case of a task, and what it is worth.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PlannedCase {
    /// Its name.
    pub name: String,
    /// Whether its points are core points or extra credit.
    pub tier: Tier,
    /// Its points.
    pub points: f64,
}

/// What the tables of a class need of a task.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PlannedTask {
    /// Its key, such as `part1.task3`.
    pub key: String,
    /// Its title.
    pub title: String,
    /// The crate below `stages/` that has the task's functions.
    pub stage: String,
    /// Its cases. Points are computed from these when tables are made, so no submission runs again
    /// because points have changed.
    pub cases: Vec<PlannedCase>,
}

impl PlannedTask {
    fn of(task: &Task) -> PlannedTask {
        let of_examples = task.entry_of_examples();
        let cases = task
            .cases
            .iter()
            .chain(&of_examples)
            .map(|case| PlannedCase {
                name: case.name.clone(),
                tier: case.tier,
                points: case.points,
            });
        PlannedTask {
            key: task.key.clone(),
            title: task.title.clone(),
            stage: task.stage.clone(),
            cases: cases.collect(),
        }
    }

    /// The most points of this tier.
    pub fn max(&self, tier: Tier) -> f64 {
        let cases = self.cases.iter().filter(|case| case.tier == tier);
        cases.fold(0.0, |sum, case| sum + case.points)
    }
}

/// What the tables of a class need of a teacher's course.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PlannedTerm {
    /// The name of the course, and when the course is given.
    pub title: String,
    /// When what is graded is due, in seconds since 1970.
    pub due: Option<i64>,
    /// What late work loses.
    pub late: Option<LateRule>,
}

impl PlannedTerm {
    fn of(course: &Course, what: &str) -> Option<PlannedTerm> {
        let term = course.term.as_ref()?;
        let part = what.strip_prefix("part").and_then(|part| part.parse().ok());
        Some(PlannedTerm {
            title: term.title(),
            due: part.and_then(|part| term.due(part)),
            late: term.late,
        })
    }
}

/// The plan of a class.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Plan {
    version: u32,
    /// What is graded, and how.
    pub settings: Settings,
    /// The term in which the teacher's course is given, if there is one.
    #[serde(default)]
    pub term: Option<PlannedTerm>,
    /// The tasks, in the order of the course.
    pub tasks: Vec<PlannedTask>,
    /// The submissions, sorted by name.
    pub submissions: Vec<Planned>,
}

/// A submission in a plan.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Planned {
    /// The student's name in all tables.
    pub name: Untrusted,
    /// The name of the folder or archive in the folder of the class.
    pub file: Untrusted,
    /// The submission's unit, or why it has none.
    #[serde(flatten)]
    pub state: State,
}

/// Whether a submission can be read, and if not, why not.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum State {
    /// It can be read.
    Unit {
        /// The hash of the files that were handed in and are graded.
        submission: String,
        /// The key of its unit.
        key: String,
        /// What was unusual about the submission's form, as sentences.
        notes: Vec<Untrusted>,
        /// When the commit that counts was made, if the submission was read from a commit.
        #[serde(default)]
        commit: Option<CommitTimes>,
        /// Whether the files are graded as they lie there, although a commit or a time was asked
        /// for: the submission is no clone.
        #[serde(default)]
        as_it_lies: bool,
    },
    /// It is larger than a submission may be. The text names the limit.
    TooLarge(Untrusted),
    /// It cannot be read. The text says why.
    Unreadable(Untrusted),
    /// It is no clone, and a commit or a time was asked for. The text says what was found; a person
    /// decides whether the submission counts.
    NoClone(Untrusted),
    /// It was not read because the machine failed. The text says why; the next run tries again.
    NotRead(Untrusted),
}

impl Planned {
    /// The key of the submission's unit, if it has one.
    pub fn key(&self) -> Option<&str> {
        match &self.state {
            State::Unit { key, .. } => Some(key),
            _ => None,
        }
    }
}

impl Plan {
    /// Reads every submission in the folder `class` and makes a plan. With `with_archives`, a
    /// submission that is no clone counts as it lies there, even if a commit or time is asked for.
    pub fn make(
        class: &Path,
        course: &Course,
        reader: &Reader,
        settings: Settings,
        with_archives: bool,
        mut progress: impl FnMut(usize, usize),
    ) -> Result<Plan, GraderError> {
        let tasks = course
            .select(&settings.what)?
            .into_iter()
            .map(PlannedTask::of)
            .collect();
        let entries = entries::list(class)?;
        let count = entries.len();
        let mut submissions = Vec::new();
        for (i, entry) in entries.into_iter().enumerate() {
            progress(i, count);
            let mut read = reader.read_entry(class, &entry, settings.revision.as_ref());
            let as_it_lies = with_archives && matches!(read, Err(Unreadable::NoClone(_)));
            if as_it_lies {
                read = reader.read_entry(class, &entry, None);
            }
            let state = match read {
                Ok(read) => State::Unit {
                    key: settings.key(&read.hash),
                    submission: read.files,
                    notes: read.notes,
                    commit: read.commit,
                    as_it_lies,
                },
                Err(Unreadable::TooLarge(why)) => State::TooLarge(why.into()),
                Err(Unreadable::Damaged(why)) => State::Unreadable(why.into()),
                Err(Unreadable::NoClone(why)) => State::NoClone(why.into()),
                Err(Unreadable::Machine(why)) => State::NotRead(why.into()),
            };
            submissions.push(Planned {
                name: entry.name.into(),
                file: entry.file.into(),
                state,
            });
        }
        Ok(Plan {
            version: VERSION,
            term: PlannedTerm::of(course, &settings.what),
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

    /// Writes the plan if there is none yet. Returns whether it was written: if several machines
    /// start at once, one writes its plan first, and the others take the seed of that plan.
    pub fn store_first(&self, path: &Path) -> Result<bool, GraderError> {
        use std::io::Write;
        let failed = |e: &std::io::Error| GraderError::file("write", path, without_path(e));
        let folder = path.parent().unwrap_or(Path::new("."));
        let mut file = tempfile::Builder::new();
        // Else only its owner could read the file, and a second teacher may share the folder.
        #[cfg(unix)]
        file.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
        let mut file = file.tempfile_in(folder).map_err(|e| failed(&e))?;
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

    /// How `new` differs in what scores depend on, as ends of the sentence "OUT was graded with ...".
    pub fn differences(&self, new: &Plan) -> Vec<String> {
        let mut all = self.settings.differences(&new.settings);
        let old = |task: &PlannedTask| self.tasks.iter().find(|old| old.key == task.key);
        let changed = new
            .tasks
            .iter()
            .filter(|task| old(task).is_some_and(|old| old.cases != task.cases));
        let changed: Vec<&str> = changed.map(|task| task.key.as_str()).collect();
        if !changed.is_empty() {
            all.push(format!("other points of {}", changed.join(" ")));
        }
        all
    }

    /// The most core points and the most extra points.
    pub fn max_score(&self) -> [f64; 2] {
        [Tier::Core, Tier::Robust].map(|tier| {
            let points = self.tasks.iter().map(|task| task.max(tier));
            points.fold(0.0, |sum, points| sum + points)
        })
    }

    /// The units of the class, sorted by key: each key with the first submission that has it.
    pub fn units(&self) -> BTreeMap<&str, &Planned> {
        let mut units = BTreeMap::new();
        for planned in &self.submissions {
            if let Some(key) = planned.key() {
                units.entry(key).or_insert(planned);
            }
        }
        units
    }

    /// Why only `to_grade` units are graded although there are more submissions; `None` if each is
    /// graded. `is_stored` says whether the unit with a key is stored.
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
        let reasons: Vec<String> = reasons
            .into_iter()
            .filter(|(count, _)| *count > 0)
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

    /// The plan `wanted`, made with the settings of this plan, but a submission that has a score
    /// (`is_stored` says whether a unit is stored) keeps it, even if its files changed or are gone.
    /// The second value names such submissions. One that was only renamed has its new name.
    pub fn extended(&self, wanted: &Plan, is_stored: impl Fn(&str) -> bool) -> (Plan, Vec<String>) {
        let mut kept = Vec::new();
        let old: BTreeMap<&str, &Planned> = self
            .submissions
            .iter()
            .map(|planned| (planned.name.raw(), planned))
            .collect();
        let names: BTreeSet<&str> = wanted
            .submissions
            .iter()
            .map(|planned| planned.name.raw())
            .collect();
        let mut submissions: Vec<Planned> = Vec::new();
        for new in &wanted.submissions {
            let keeps = old
                .get(new.name.raw())
                .filter(|old| old.state != new.state && old.key().is_some_and(&is_stored));
            submissions.push(match keeps {
                Some(old) => {
                    kept.push(match &new.state {
                        State::NotRead(why) => format!("{}: {}", new.name.line(), why.line()),
                        _ => format!("{} has other files now", new.name.line()),
                    });
                    (*old).clone()
                }
                None => new.clone(),
            });
        }
        let new_keys: BTreeSet<&str> = wanted
            .submissions
            .iter()
            .filter(|planned| !old.contains_key(planned.name.raw()))
            .filter_map(Planned::key)
            .collect();
        let gone = self.submissions.iter().filter(|planned| {
            let has_score = planned
                .key()
                .is_some_and(|key| is_stored(key) && !new_keys.contains(key));
            has_score && !names.contains(planned.name.raw())
        });
        for planned in gone {
            kept.push(format!(
                "{} is no longer in the folder",
                planned.name.line()
            ));
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
    /// The key of the unit for a submission whose hash is `submission`.
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

    /// How the settings `new` differ from these, as ends of the sentence "OUT was graded with ...".
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
