//! The result of one unit, and how it is graded.

use crate::course_hash;
use crate::hash;
use crate::out::{Out, read_regular};
use crate::plan::{Plan, Planned, State};
use crate::reading::Reader;
use base::GraderError;
use base::write_whole;
use grader::grade::GradeRequest;
use grader::report::{self, TaskReport};
use grader::score::CaseResult;
use grader::signature::Signature;
use grader::workers::crash::CrashKind;
use judge::Tier;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::path::Path;
use std::time::Instant;
use submission::one::{self, GradingCourse, Options};

/// The result of one unit: the file `OUT/units/KEY.json`. A plan says which students it belongs to.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Unit {
    /// Its key: the hash of all that follows.
    pub key: String,
    /// The hash of the submission.
    pub submission: String,
    /// The hash of the course.
    pub course: String,
    /// What was graded.
    pub what: String,
    /// The seed of the cases' random inputs.
    pub seed: u64,
    /// How it ended.
    pub outcome: Outcome,
    /// The share of its points that each case of each task earned, before extra credit waits for core
    /// points. Points are computed from it when tables are made.
    pub earned: BTreeMap<String, BTreeMap<String, f64>>,
    /// The wrong answers of each task that has some, for comparison with other submissions.
    pub wrong_answers: BTreeMap<String, WrongAnswers>,
    /// The core cases of each task that did not end within their limits of time, memory and output.
    pub endless_cases: BTreeMap<String, Vec<String>>,
    /// Those of extra credit.
    #[serde(default)]
    pub endless_extra: BTreeMap<String, Vec<String>>,
    /// The hashes of the source files of each stage that was handed in.
    pub sources: BTreeMap<String, String>,
    /// The pictures of tasks that lost core points: the names of their files in `OUT/pictures`.
    #[serde(default)]
    pub pictures: BTreeMap<String, String>,
    /// How long it took.
    pub took: Took,
    /// The whole report about the submission, as `grader partN --submission DIR --format json`
    /// prints it.
    pub report: serde_json::Value,
}

/// How grading a submission ended. It has a score in every case.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Outcome {
    /// At least one of its stages was built, and its cases were judged.
    Graded,
    /// None of the stages that were handed in compiles.
    DoesNotCompile,
    /// Building it exceeded this limit.
    OverLimit(String),
}

/// The wrong answers of a task.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct WrongAnswers {
    /// A hash of which answers are wrong, and how.
    pub hash: String,
    /// How many of the answers that are compared are wrong.
    pub count: usize,
}

/// The time that a unit took. No table shows it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Took {
    /// Elapsed seconds.
    pub seconds: f64,
    /// Seconds of processor time, those of the compiler and of the student's code included; 0 where
    /// the system does not report it.
    pub cpu_seconds: f64,
}

/// Grades the submission `planned` of the class in the folder `class` and stores the result. An
/// error is the machine's, never the submission's.
pub fn grade(
    plan: &Plan,
    planned: &Planned,
    class: &Path,
    reader: &Reader,
    course: &GradingCourse,
    out: &Out,
) -> Result<(), GraderError> {
    let State::Unit {
        submission,
        key,
        as_it_lies,
        ..
    } = &planned.state
    else {
        return Err(GraderError::new(format!(
            "{} has nothing to grade",
            planned.name.line()
        )));
    };
    let started = Instant::now();
    let settings = &plan.settings;
    let revision = settings.revision.as_ref().filter(|_| !as_it_lies);
    let read = reader
        .read(&class.join(planned.file.raw()), revision)
        .map_err(|unreadable| GraderError::new(unreadable.why()))?;
    if read.files != *submission {
        return Err(GraderError::new(format!(
            "{} was changed while the class was graded: run again",
            planned.file.line()
        )));
    }
    let options = Options {
        request: GradeRequest {
            what: settings.what.clone(),
            seed: settings.seed,
        },
        together: false,
        pictures: true,
    };
    let graded = one::grade_read(course, &read.submission, &options)?;
    let earned = graded.report.scores.tasks.iter().map(|task| {
        let cases = task
            .result
            .cases
            .iter()
            .map(|case| (case.name.clone(), case.earned));
        (task.result.key.clone(), cases.collect())
    });
    let earned = earned.collect();
    let wrong_answers = graded.report.scores.tasks.iter().filter_map(|task| {
        let signature = Signature::of(&task.result.cases);
        let wrong = WrongAnswers {
            hash: hash::of([signature.to_text()]),
            count: signature.wrong(),
        };
        (!signature.is_empty()).then(|| (task.result.key.clone(), wrong))
    });
    let wrong_answers = wrong_answers.collect();
    let endless = |tier: Tier| {
        let of_task = |task: &TaskReport| {
            let is_endless = |case: &&CaseResult| {
                let kind = case.crash().map(|crash| crash.kind);
                case.tier == tier && kind == Some(CrashKind::Endless)
            };
            let over = task.result.cases.iter().filter(is_endless);
            let cases: Vec<String> = over.map(|case| case.name.clone()).collect();
            (!cases.is_empty()).then(|| (task.result.key.clone(), cases))
        };
        let tasks = graded.report.scores.tasks.iter();
        tasks.filter_map(of_task).collect()
    };
    let (endless_cases, endless_extra) = (endless(Tier::Core), endless(Tier::Robust));
    let mut pictures = BTreeMap::new();
    for (task, sheet) in &graded.report.pictures {
        // Equal pictures, of students who make the same mistake, are one file.
        let name = hash::of([sheet]);
        let file = out.picture(&name);
        if !file.is_file() {
            write_whole(&file, sheet)?;
        }
        pictures.insert(task.clone(), name);
    }
    let report = serde_json::to_value(&graded.report)
        .map_err(|e| GraderError::new(format!("cannot write the report as JSON: {e}")))?;
    let unit = Unit {
        key: key.clone(),
        submission: submission.clone(),
        course: course_hash::whole(&settings.course),
        what: settings.what.clone(),
        seed: settings.seed,
        outcome: match graded.outcome {
            one::Outcome::Graded => Outcome::Graded,
            one::Outcome::DoesNotCompile => Outcome::DoesNotCompile,
            one::Outcome::OverLimit(limit) => Outcome::OverLimit(limit.to_string()),
        },
        earned,
        wrong_answers,
        endless_cases,
        endless_extra,
        sources: read.sources,
        pictures,
        took: Took {
            seconds: started.elapsed().as_secs_f64(),
            cpu_seconds: cpu_seconds().unwrap_or_default(),
        },
        report,
    };
    write_whole(&out.unit(key), report::json(&unit)?.as_bytes())?;
    // Why it failed before is over.
    let _ = std::fs::remove_file(out.failure(key));
    Ok(())
}

/// The part of a unit that is looked at before a run, without its report.
#[derive(Deserialize)]
struct Checked {
    key: String,
    earned: BTreeMap<String, BTreeMap<String, f64>>,
}

impl Checked {
    /// What is wrong with it as the unit `key`.
    fn damage(&self, key: &str) -> Option<String> {
        if self.key != key {
            return Some("it is the result of another unit".into());
        }
        let mut cases = self
            .earned
            .iter()
            .flat_map(|(task, cases)| cases.iter().map(move |(case, earned)| (task, case, earned)));
        let (task, case, earned) = cases.find(|(_, _, earned)| !(0.0..=1.0).contains(*earned))?;
        Some(format!(
            "{task}/{case} earned {earned} of its points: expected 0 to 1"
        ))
    }
}

/// Whether the result of a unit is stored, and whole: a machine that crashed or whose disk was full
/// may have left a part of it.
pub fn is_stored(out: &Out, key: &str) -> bool {
    let text = read_regular(&out.unit(key));
    let unit = text.map(|text| serde_json::from_slice::<Checked>(&text));
    matches!(unit, Ok(Ok(unit)) if unit.damage(key).is_none())
}

/// Reads the result of a unit; `None` if it is not stored.
pub fn load(out: &Out, key: &str) -> Result<Option<Unit>, GraderError> {
    let path = out.unit(key);
    let text = match read_regular(&path) {
        Ok(text) => text,
        Err(e) if e.kind() == std::io::ErrorKind::NotFound => return Ok(None),
        Err(e) => return Err(GraderError::file("read", &path, e)),
    };
    let damaged = |why: &dyn std::fmt::Display| {
        GraderError::new(format!(
            "the result units/{key}.json is damaged ({why}). Run again: it is graded anew"
        ))
    };
    let checked: Checked = serde_json::from_slice(&text).map_err(|e| damaged(&e))?;
    if let Some(damage) = checked.damage(key) {
        return Err(damaged(&damage));
    }
    serde_json::from_slice(&text)
        .map(Some)
        .map_err(|e| damaged(&e))
}

/// The processor time of this process and of the processes that it has waited for, as Linux shows
/// it: fields 14 to 17 of `/proc/self/stat`, in hundredths of a second.
fn cpu_seconds() -> Option<f64> {
    let stat = std::fs::read_to_string("/proc/self/stat").ok()?;
    let (_, after_name) = stat.rsplit_once(") ")?;
    let ticks = after_name.split(' ').skip(11).take(4);
    let ticks = ticks.map(|ticks| ticks.parse::<u64>().ok());
    Some(ticks.sum::<Option<u64>>()? as f64 / 100.0)
}
