//! Grades what a student handed in, without the student's own manifests, scripts and tests.
//!
//! [`read`] reads the source files of the stages and nothing else. [`clean_workspace`] puts them
//! into a clean copy of the course. [`SubmissionReport::of`] grades each stage together with the
//! reference's other stages, so that a mistake in one stage costs no points in another. On request
//! it also grades all of the student's stages together. The crate `class` grades many submissions.
//!
//! [`one::grade_one`] does all this for one folder.
//!
//! The code of a submission is not trusted. [`scan`] refuses what has no business in a stage;
//! [`containment`] chooses what keeps the rest from files, programs and networks while it is
//! compiled and while it runs; [`build_folder`] keeps one submission from the next.

pub mod arguments;
mod bubblewrap;
pub mod build_folder;
pub mod by_heart;
pub mod clean_workspace;
pub mod code;
pub mod containment;
mod control;
#[cfg(test)]
mod correct_versions;
mod given;
mod jail;
mod not_graded;
pub mod one;
pub mod read;
pub mod scan;
mod source_file;
mod toolchain;
mod untrusted;

pub use formats::{Layout, shown};
pub use untrusted::Untrusted;

use base::{GraderError, Workspace};
use clean_workspace::CleanWorkspace;
use files::file_tree::Files;
use grader::build::BuildLimit;
use grader::course::{Course, Task};
use grader::examples;
use grader::grade;
use grader::report::{Report, TaskReport};
use grader::score::{CaseResult, Status, TaskResult};
use grader::workers::awake::Awake;
use grader::workers::printed;
use one::Options;
use read::Submission;
use serde::Serialize;
use std::collections::BTreeMap;
use std::time::Duration;

/// The report about a submission.
#[derive(Clone, Debug, Serialize)]
pub struct SubmissionReport {
    /// The scores that count: each stage graded together with the reference's other stages.
    #[serde(flatten)]
    pub scores: Report,
    /// The scores of all of the student's stages together, on request.
    pub together: Option<Report>,
    /// Stages under test that were not handed in.
    pub missing: Vec<String>,
    /// Stages that were refused before they were compiled: a sentence for each place. Their tasks
    /// have the status of code that does not compile.
    pub refused_stages: BTreeMap<String, Vec<String>>,
    /// Files that are not graded, and are not as the student was given them.
    pub ignored: Vec<String>,
    /// Those of them that decide points in the student's own runs, such as `stages/kit`.
    pub changed_given: Vec<String>,
    /// The student's code that a person should look at, a sentence each.
    pub to_check: Vec<String>,
    /// A sentence for each task whose answers were learned by heart. It has no points.
    pub by_heart: Vec<String>,
    /// The seed of the random inputs: `--seed` with it repeats the run.
    pub seed: u64,
    /// How the code was contained while it was compiled and run: one line.
    pub containment: String,
    /// The limit that the compiler exceeded, if it did.
    #[serde(skip)]
    pub limit: Option<BuildLimit>,
    /// The compiler's messages about stages that do not compile.
    pub compiler: String,
    /// What the student's code printed, case by case.
    pub printed: String,
    /// Pictures of tasks that lost core points, if they were asked for: PNG files of expected,
    /// yours and their difference, by the keys of the tasks.
    #[serde(skip)]
    pub pictures: BTreeMap<String, Vec<u8>>,
}

impl SubmissionReport {
    /// A sentence about given files that were changed; `None` if none was.
    pub fn about_changed_given(&self) -> Option<String> {
        about_changed_given(&self.changed_given)
    }

    /// The ignored files that this sentence is not about: the student's own.
    pub fn other_ignored(&self) -> Vec<&str> {
        let is_said = |file: &&String| self.changed_given.contains(*file);
        let others = self.ignored.iter().filter(|file| !is_said(file));
        others.map(String::as_str).collect()
    }

    /// Grades `submission` in the clean workspace `clean`.
    pub fn of(
        submission: &Submission,
        workspace: &Workspace,
        clean: &CleanWorkspace,
        options: &Options,
    ) -> Result<SubmissionReport, GraderError> {
        let Options {
            request,
            together,
            pictures,
        } = options;
        let course = Course::read(workspace)?;
        let tasks = course.select(&request.what)?;
        let mut report = SubmissionReport {
            scores: Report::new(Vec::new(), None),
            together: None,
            missing: Vec::new(),
            refused_stages: BTreeMap::new(),
            ignored: names(&submission.ignored),
            changed_given: names(&submission.changed_given),
            to_check: submission.to_check.clone(),
            by_heart: Vec::new(),
            seed: request.seed,
            containment: clean.containment().to_string(),
            limit: None,
            compiler: String::new(),
            printed: String::new(),
            pictures: BTreeMap::new(),
        };
        let mut ungraded = Vec::new();
        let mut results = Vec::new();
        let mut graded_tasks = Vec::new();
        let end = end_of_all_stages();
        for stage in grade::stages(&tasks) {
            let of_stage = tasks.iter().copied().filter(|task| task.stage == stage);
            let Some(sources) = submission.stages.get(stage) else {
                report.missing.push(stage.to_string());
                ungraded.extend(of_stage.map(|task| no_points(task, &Status::NotAttempted)));
                continue;
            };
            let why = submission.why_not_built(stage);
            if !why.is_empty() {
                report.compiler.push_str(&why);
                if let Some(reasons) = submission.forbidden.get(stage) {
                    report
                        .refused_stages
                        .insert(stage.to_string(), reasons.clone());
                }
                ungraded.extend(of_stage.map(|task| no_points(task, &Status::DoesNotCompile)));
                continue;
            }
            let of_stage: Vec<&Task> = of_stage.collect();
            let (seed, pictures) = (request.seed, *pictures);
            let grade = || {
                let folder = clean.with_stages(&[(stage, sources)], end)?;
                let root = folder.build_root();
                let graded = grade::at(workspace, &course, &of_stage, seed, &root, pictures)?;
                Ok((folder, graded))
            };
            let (folder, graded) = control::unless_the_machine_failed(
                grade,
                |(_, graded)| graded.may_be_the_machine,
                || control::grade(workspace, clean, &course, &of_stage, seed),
            )?;
            let build_root = folder.build_root();
            report.pictures.extend(graded.pictures);
            report.limit = report.limit.or(graded.limit);
            let printed = printed::format(&graded.printed);
            report
                .compiler
                .push_str(&folder.for_report(&graded.compiler));
            report.printed.push_str(&folder.for_report(&printed));
            let mut judged = graded.report.tasks;
            if request.seed != by_heart::KNOWN_SEED {
                let has_table = scan::table(stage, sources).is_some();
                let said =
                    without_learned_points(&mut judged, &of_stage, has_table, seed, |tasks| {
                        grade::scores_at(&course, tasks, by_heart::KNOWN_SEED, &build_root)
                    })?;
                report.by_heart.extend(said);
                let learned = judged.iter().map(|task| &task.result);
                report
                    .to_check
                    .extend(learned.filter_map(by_heart::is_to_check));
            }
            results.extend(judged);
            graded_tasks.extend(of_stage);
        }
        let text = |stage: &str| submission.examples.get(stage).map(String::as_str);
        for graded in results.iter_mut().chain(&mut ungraded) {
            let task = tasks.iter().find(|task| task.key == graded.result.key);
            let case = task.and_then(|task| examples::case_of(task, text(&task.stage)));
            graded.result.add_examples(case);
        }
        report.scores = combine(results, &ungraded);
        if *together {
            let all = submission
                .stages
                .iter()
                .filter(|(stage, _)| submission.why_not_built(stage).is_empty());
            let all: Vec<(&str, &Files)> = all
                .map(|(stage, sources)| (stage.as_str(), sources))
                .collect();
            let (end, seed) = (end_of_all_stages(), request.seed);
            let grade = || {
                let folder = clean.with_stages(&all, end)?;
                let root = folder.build_root();
                grade::at(workspace, &course, &graded_tasks, seed, &root, false)
            };
            // Each stage alone was built, or had a control of its own.
            let first = graded_tasks.first().map(|task| &task.stage);
            let of_first: Vec<&Task> = (graded_tasks.iter().copied())
                .filter(|task| Some(&task.stage) == first)
                .collect();
            let graded = control::unless_the_machine_failed(
                grade,
                |graded| graded.may_be_the_machine,
                || control::grade(workspace, clean, &course, &of_first, seed),
            )?;
            report.together = Some(combine(graded.report.tasks, &ungraded));
        }
        Ok(report)
    }
}

/// Takes the points of the `tasks` whose answers were learned by heart, and returns a sentence for
/// each. `judged` are their results with `seed`, `known` grades tasks with the known one, and
/// `has_table` says whether the stage may contain a table of answers.
fn without_learned_points(
    judged: &mut [TaskReport],
    tasks: &[&Task],
    has_table: bool,
    seed: u64,
    known: impl FnOnce(&[&Task]) -> Result<Vec<TaskResult>, GraderError>,
) -> Result<Vec<String>, GraderError> {
    let suspicious: Vec<&Task> = judged
        .iter()
        .filter(|report| by_heart::is_suspicious(&report.result))
        .filter_map(|report| tasks.iter().find(|task| task.key == report.result.key))
        .copied()
        .collect();
    let known = match suspicious.is_empty() {
        true => Vec::new(),
        false => known(&suspicious)?,
    };
    let mut said = Vec::new();
    for report in judged {
        let key = report.result.key.as_str();
        let Some(task) = tasks.iter().find(|task| task.key == key) else {
            continue;
        };
        let known = known.iter().find(|known| known.key == key);
        let why = by_heart::why_learned(task, seed, &report.result, known, has_table);
        if let Some(why) = why {
            *report = no_points(task, &Status::Failed);
            said.push(why);
        }
    }
    Ok(said)
}

/// How long all stages of a submission may be built and run: some sixty times what honest code takes,
/// because a class may have a slow and busy machine. Code that waits as long as each case lets it
/// would otherwise take hours, and a class would give it up instead of grading it.
const MOST_TIME: Duration = Duration::from_secs(100 * 60);

/// The end of that time, if it begins now.
fn end_of_all_stages() -> Option<Awake> {
    Some(Awake::now() + MOST_TIME)
}

/// A sentence about stages that were refused before they were compiled; `None` if none was.
pub fn about_refused(stages: &BTreeMap<String, Vec<String>>) -> Option<String> {
    let names: Vec<&str> = stages.keys().map(String::as_str).collect();
    let mut reasons = stages.values().flatten();
    let first = reasons.next()?;
    let more = match reasons.count() {
        0 => String::new(),
        more => format!(" (and {more} more)"),
    };
    let names = names.join(" ");
    Some(format!(
        "refused before it was compiled: {names}: {first}{more}"
    ))
}

/// How many files [`about_changed_given`] names.
const NAMED: usize = 5;

/// A sentence about given files that were changed; `None` if there are none.
pub fn about_changed_given(files: &[String]) -> Option<String> {
    let named = files.get(..NAMED).unwrap_or(files).join(", ");
    let more = match files.len().saturating_sub(NAMED) {
        0 => String::new(),
        more => format!(" and {more} more"),
    };
    let count = files.len();
    (count > 0).then(|| {
        format!("given files were changed, and graded with the course's own instead: {named}{more}")
    })
}

fn names(paths: &[Untrusted]) -> Vec<String> {
    paths.iter().map(Untrusted::line).collect()
}

/// The scores of the tasks that were graded and of those that could not be, ordered by key.
fn combine(mut graded: Vec<TaskReport>, ungraded: &[TaskReport]) -> Report {
    graded.extend_from_slice(ungraded);
    graded.sort_by(|a, b| a.result.key.cmp(&b.result.key));
    Report::new(graded, None)
}

/// The result of a task whose cases all have this status and no points.
fn no_points(task: &Task, status: &Status) -> TaskReport {
    let cases = task
        .cases
        .iter()
        .map(|entry| CaseResult::new(entry, "", status.clone(), Vec::new(), &[]));
    TaskResult::new(task, cases.collect()).into()
}
