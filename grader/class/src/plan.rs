//! What a class needs: the file `OUT/class.json`. It lists the submissions with the units that
//! give their scores. All machines that work on a class compute the same plan.

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

/// A task of the class, as the tables need it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PlannedTask {
    /// Its key, such as `part1.task3`.
    pub key: String,
    /// Its title.
    pub title: String,
    /// The crate below `stages/` with its functions.
    pub stage: String,
    /// Its cases. Points are computed from them when tables are made: a change of points runs no
    /// submission again.
    pub cases: Vec<PlannedCase>,
}

impl PlannedTask {
    fn of(task: &Task) -> PlannedTask {
        let of_examples = task.entry_of_examples();
        let cases = task.cases.iter().chain(&of_examples);
        let cases = cases.map(|case| PlannedCase {
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

    /// Points possible.
    pub fn max(&self, tier: Tier) -> f64 {
        let cases = self.cases.iter().filter(|case| case.tier == tier);
        cases.fold(0.0, |sum, case| sum + case.points)
    }
}

/// What the tables of a class need of a teacher's course.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PlannedTerm {
    /// Its name and when it is given.
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
    /// The term of the teacher's course, if it is given in one.
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
        notes: Vec<Untrusted>,
        /// When its commit was made, if it is one of a clone.
        #[serde(default)]
        commit: Option<CommitTimes>,
        /// Whether it is graded as it lies there, because it is no clone, although a commit or a
        /// time was asked for.
        #[serde(default)]
        as_it_lies: bool,
    },
    /// It is larger than a submission may be: the limit.
    TooLarge(Untrusted),
    /// It cannot be read: the reason.
    Unreadable(Untrusted),
    /// It is no clone, and a commit or a time was asked for: what was found. A person says whether
    /// it counts.
    NoClone(Untrusted),
    /// It could not be read, because the machine failed: the reason. The next run tries again.
    NotRead(Untrusted),
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

impl Plan {
    /// Reads every submission in the folder `class` and makes a plan. With `with_archives`, what is
    /// no clone counts as it lies there, even if a commit or a time is asked for.
    pub fn make(
        class: &Path,
        course: &Course,
        reader: &Reader,
        settings: Settings,
        with_archives: bool,
        mut progress: impl FnMut(usize, usize),
    ) -> Result<Plan, GraderError> {
        let tasks = course.select(&settings.what)?;
        let tasks = tasks.into_iter().map(PlannedTask::of).collect();
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
                    submission: read.hash,
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

    /// Writes the plan if there is none yet. Returns whether it did: of several machines that start
    /// at once one is first, and the others take its seed.
    pub fn store_first(&self, path: &Path) -> Result<bool, GraderError> {
        use std::io::Write;
        let failed = |e: &std::io::Error| GraderError::file("write", path, without_path(e));
        let folder = path.parent().unwrap_or(Path::new("."));
        let mut file = tempfile::Builder::new();
        // Temporary files are readable by their owner only, and a second teacher may share the folder.
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

    /// Core and extra points possible.
    pub fn max_score(&self) -> [f64; 2] {
        [Tier::Core, Tier::Robust].map(|tier| {
            let points = self.tasks.iter().map(|task| task.max(tier));
            points.fold(0.0, |sum, points| sum + points)
        })
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
    /// since; the second value names such submissions. What was only renamed has the new name.
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
