//! Grades tasks: builds the workers, runs the cases, judges the answers and adds up the points.

pub mod one_by_one;
pub mod picture;
pub mod speedup;

use crate::build::{BuildLimit, BuildRoot};
use crate::course::{Course, Task, stages_of};
use crate::diagnosis::{self, Explanation, simplest};
use crate::examples;
use crate::report::{Report, TaskReport};
use crate::score::{CaseResult, Status, TaskResult};
use crate::workers::crash::{Crash, CrashKind};
use crate::workers::printed::Printed;
use crate::workers::runner::Ending;
use crate::workers::stage_workers::StageWorkers;
use crate::workers::worker_set::WorkerSet;
use base::{GraderError, Workspace};
use judge::cases::{self, Spec};
use judge::packed_truth;
use judge::repro::{self, FailedCase};
use pictures::Image;
use std::path::PathBuf;
use wire::record::HoleCall;
use wire::{Answer, Outcome};

/// A request to grade tasks.
#[derive(Clone, Debug)]
pub struct GradeRequest {
    /// `all`, a part or a task.
    pub what: String,
    /// Seed of the random inputs of the cases, such as rays.
    pub seed: u64,
}

/// A report, with the output of the student's code and of the compiler.
#[derive(Clone, Debug)]
pub struct Graded {
    /// The scores.
    pub report: Report,
    /// The output of the student's code, case by case.
    pub printed: Vec<Printed>,
    /// The compiler's messages about stages that do not compile.
    pub compiler: String,
    /// The limit that the compiler exceeded, if it did.
    pub limit: Option<BuildLimit>,
    /// Whether the machine may be the cause of lost points: a build failed, or the system ended a
    /// worker.
    pub may_be_the_machine: bool,
    /// Pictures of tasks that lost core points, if they were asked for: PNG files of expected,
    /// yours and their difference, by the keys of the tasks.
    pub pictures: Vec<(String, Vec<u8>)>,
    /// The picture with light of the last complete task that has one, with its file below the
    /// workspace's root folder.
    pub lit: Option<(PathBuf, Image)>,
}

/// Grades the code in `workspace` in place. With `times` it also measures the speedups by the BVH,
/// if one of the tasks is about them. A `quiet` build prints nothing.
pub fn in_place(
    workspace: &Workspace,
    request: &GradeRequest,
    times: bool,
    quiet: bool,
) -> Result<Graded, GraderError> {
    let course = Course::read(workspace)?;
    let tasks = course.select(&request.what)?;
    let specs = specs(&tasks, request.seed)?;
    let times = times && speedup::applies_to(&tasks);
    let build_root = BuildRoot {
        quiet,
        ..BuildRoot::of(workspace)
    };
    let workers = workers(&build_root, &tasks, &specs, times)?;
    // The pictures are rendered on another processor, before the speedups are measured.
    let (run, pictures) = std::thread::scope(|scope| {
        let pictures = scope.spawn(|| picture::write_all(workspace, &course, &tasks, &workers));
        let run = run(&workers, &course, &tasks, &specs);
        let pictures = pictures
            .join()
            .unwrap_or_else(|panic| std::panic::resume_unwind(panic));
        (run, pictures)
    });
    let run = run?;
    let may_be_the_machine = may_be_the_machine(&workers, &run.results);
    let mut tasks = explain(
        workspace,
        &course,
        run.results,
        &specs,
        request.seed,
        &workers,
    )?;
    for (task, path) in pictures? {
        let report = tasks.iter_mut().find(|report| report.result.key == task);
        report
            .into_iter()
            .for_each(|report| report.picture = Some(path.clone()));
    }
    for report in &mut tasks {
        add_examples(workspace, &course, &mut report.result)?;
    }
    let is_complete = |task: &Task| {
        let mut results = tasks.iter().map(|report| &report.result);
        results.any(|of| of.key == task.key && of.is_complete())
    };
    let complete: Vec<&Task> = course
        .select(&request.what)?
        .into_iter()
        .filter(|task| is_complete(task))
        .collect();
    let lit = picture::write_lit(workspace, &course, &complete, &workers)?;
    let speedups = if times && speedup::is_attempted(&tasks) {
        Some(speedup::measure(&course, &workers.whole_scene)?)
    } else {
        None
    };
    Ok(Graded {
        report: Report::new(tasks, speedups),
        printed: run.printed,
        compiler: workers.compiler,
        limit: workers.limit,
        may_be_the_machine,
        pictures: Vec::new(),
        lit,
    })
}

/// Adds what the examples in the folder of a task's stage earn, if the course gives points for
/// them.
fn add_examples(
    workspace: &Workspace,
    course: &Course,
    result: &mut TaskResult,
) -> Result<(), GraderError> {
    let with_points = course.tasks().find(|task| task.key == result.key);
    let Some(task) = with_points.filter(|task| task.examples > 0.0) else {
        return Ok(());
    };
    let text = examples::read(workspace, task)?;
    result.add_examples(examples::case_of(task, text.as_deref()));
    Ok(())
}

/// Grades `tasks` with the code in `build_root`, without times. With `pictures` it also renders
/// those of tasks that lost core points.
pub fn at(
    workspace: &Workspace,
    course: &Course,
    tasks: &[&Task],
    seed: u64,
    build_root: &BuildRoot,
    pictures: bool,
) -> Result<Graded, GraderError> {
    let specs = specs(tasks, seed)?;
    let workers = workers(build_root, tasks, &specs, false)?;
    let run = run(&workers, course, tasks, &specs)?;
    let lost = |task: &&Task| {
        let result = run.results.iter().find(|result| result.key == task.key);
        result.is_some_and(|result| {
            result.score < result.max_score && result.status != Status::NotAttempted
        })
    };
    let may_be_the_machine = may_be_the_machine(&workers, &run.results);
    let mut sheets = Vec::new();
    for task in tasks.iter().copied().filter(|task| pictures && lost(task)) {
        let rendered = picture::render(workspace, course, task, &workers)?;
        if let Some(rendered) = rendered.filter(|rendered| rendered.yours.is_ok()) {
            let sheet = pictures::png::encode(&rendered.sheet());
            sheets.push((task.key.clone(), sheet));
        }
    }
    Ok(Graded {
        pictures: sheets,
        lit: None,
        report: Report::new(
            explain(workspace, course, run.results, &specs, seed, &workers)?,
            None,
        ),
        printed: run.printed,
        compiler: workers.compiler,
        limit: workers.limit,
        may_be_the_machine,
    })
}

/// Whether a build of `workers` failed, or the system ended one of them in the cases of `results`.
fn may_be_the_machine(workers: &WorkerSet, results: &[TaskResult]) -> bool {
    let mut cases = results.iter().flat_map(|result| &result.cases);
    let is_killed = |case: &CaseResult| {
        case.crash()
            .is_some_and(|crash| crash.kind == CrashKind::Killed)
    };
    workers.has_failed || cases.any(is_killed)
}

/// The cases of `tasks` for a seed. A handout refuses other seeds than 0: it has no right results
/// for them.
pub fn specs(tasks: &[&Task], seed: u64) -> Result<Vec<Spec>, GraderError> {
    match packed_truth::refusal(seed) {
        Some(why) => Err(GraderError::new(why)),
        None => Ok(of_tasks(tasks, seed)),
    }
}

/// The cases of `tasks`.
fn of_tasks(tasks: &[&Task], seed: u64) -> Vec<Spec> {
    let keys: Vec<&str> = tasks.iter().map(|task| task.key.as_str()).collect();
    cases::of_tasks(&keys, seed)
}

/// The scores of `tasks` with the code in `build_root`, without what explains them.
pub fn scores_at(
    course: &Course,
    tasks: &[&Task],
    seed: u64,
    build_root: &BuildRoot,
) -> Result<Vec<TaskResult>, GraderError> {
    let specs = of_tasks(tasks, seed);
    let workers = workers(build_root, tasks, &specs, false)?;
    Ok(run(&workers, course, tasks, &specs)?.results)
}

/// Builds the workers for `tasks`, including one for whole scenes if a case needs it or
/// `whole_scene` is set.
pub fn workers(
    build_root: &BuildRoot,
    tasks: &[&Task],
    specs: &[Spec],
    whole_scene: bool,
) -> Result<WorkerSet, GraderError> {
    let whole_scene = whole_scene
        || chosen(tasks, specs)?
            .iter()
            .any(|spec| spec.needs_all_stages());
    WorkerSet::build(build_root, &stages(tasks), whole_scene)
}

/// The names of the stages of `tasks`, sorted, each once.
pub fn stages<'a>(tasks: &[&'a Task]) -> Vec<&'a str> {
    let mut stages = stages_of(tasks.iter().copied());
    stages.sort_unstable();
    stages
}

/// The scores of some tasks, and the output of their code.
struct ScoredRun {
    results: Vec<TaskResult>,
    printed: Vec<Printed>,
}

/// Runs the cases of `tasks` in `workers` and scores them, stage by stage. The results are ordered
/// by key.
fn run(
    workers: &WorkerSet,
    course: &Course,
    tasks: &[&Task],
    specs: &[Spec],
) -> Result<ScoredRun, GraderError> {
    let mut run = ScoredRun {
        results: Vec::new(),
        printed: Vec::new(),
    };
    for stage in stages(tasks) {
        let of_stage: Vec<&Task> = tasks
            .iter()
            .copied()
            .filter(|task| task.stage == stage)
            .collect();
        let results = match workers.workers(stage) {
            None => of_stage.into_iter().map(does_not_compile).collect(),
            Some(workers) => grade_tasks(course, &of_stage, specs, &workers, &mut run.printed)?,
        };
        run.results.extend(results);
    }
    run.results.sort_by(|a, b| a.key.cmp(&b.key));
    Ok(run)
}

/// Adds to each result the mistake that explains it, the simplest call that shows it, and a test of
/// this call or of the worst answer. The `specs` were made with `seed`.
fn explain(
    workspace: &Workspace,
    course: &Course,
    results: Vec<TaskResult>,
    specs: &[Spec],
    seed: u64,
    workers: &WorkerSet,
) -> Result<Vec<TaskReport>, GraderError> {
    let not_judged = |result: &TaskResult| {
        let task = course.tasks().find(|task| task.key == result.key);
        task.map_or(Vec::new(), |task| task.not_judged.clone())
    };
    let explained = results.into_iter().map(|result| {
        let not_judged = not_judged(&result);
        if result.status == Status::Passed {
            return Ok(TaskReport {
                not_judged,
                ..TaskReport::from(result)
            });
        }
        let of_stage = workers.workers(&result.stage);
        let unmoved = match &of_stage {
            Some(workers) => without_moves(course, &result, specs, workers)?,
            None => None,
        };
        let cases = unmoved.as_ref().unwrap_or(&result.cases);
        let known = diagnosis::known(workspace, &result.key)?;
        let explained = |wrong_where: &[Vec<&str>]| {
            diagnosis::explain(&result, cases, &known, (specs, seed), wrong_where)
        };
        let (simplest, explanation) = match &of_stage {
            Some(workers) => simplest::with_explanation(workers, &result, specs, &explained)?,
            None => (None, explained(&[])),
        };
        let Explanation {
            diagnosis,
            regularities,
        } = explanation;
        let simplest_test = simplest.as_ref().and_then(|call| call.test.as_ref());
        let worst_as_test = match simplest_test {
            Some(test) => Some(repro::as_file(SIMPLEST, &result.key, test)),
            None => repro::worst(failed_cases(cases), specs, &result.key),
        };
        Ok(TaskReport {
            not_judged,
            diagnosis,
            regularities,
            simplest,
            worst_as_test,
            ..TaskReport::from(result)
        })
    });
    explained.collect()
}

/// The results of the cases of `result` with the questions that students have. Some mistakes depend
/// on the moves, such as a forgotten axis, and all are known by these answers; and these are the
/// calls that students can repeat. `None` if nothing was moved, if only moved questions fail, or if
/// code crashed: it may take as long again.
fn without_moves(
    course: &Course,
    result: &TaskResult,
    specs: &[Spec],
    workers: &StageWorkers,
) -> Result<Option<Vec<CaseResult>>, GraderError> {
    let of_task = specs.iter().filter(|spec| spec.task == result.key);
    let specs: Vec<Spec> = of_task.clone().map(Spec::unmoved).collect();
    let task = course.tasks().find(|task| task.key == result.key);
    let has_crashed = result.cases.iter().any(|case| case.crash().is_some());
    let is_moved = of_task.clone().any(Spec::is_moved) && !has_crashed;
    let (true, Some(task)) = (is_moved, task) else {
        return Ok(None);
    };
    let results = grade_tasks(course, &[task], &specs, workers, &mut Vec::new())?;
    let failed = |result: &TaskResult| result.status != Status::Passed;
    let unmoved = results.into_iter().next().filter(failed);
    Ok(unmoved.map(|result| result.cases))
}

/// Begins the comment of the test of a simplest call.
const SIMPLEST: &str = "A simple call that shows what is wrong with";

/// The cases that `course.toml` lists for `tasks`, in its order.
pub fn chosen<'a>(tasks: &[&Task], specs: &'a [Spec]) -> Result<Vec<&'a Spec>, GraderError> {
    let listed = tasks
        .iter()
        .flat_map(|task| task.cases.iter().map(|entry| (&task.key, &entry.name)));
    listed
        .map(|(task, name)| {
            let spec = specs.iter().find(|spec| spec.is(task, name));
            spec.ok_or_else(|| {
                GraderError::new(format!(
                    "course.toml lists the case `{name}` of `{task}`, which the grader does not have"
                ))
            })
        })
        .collect()
}

/// Runs the cases of `tasks` in `workers` and scores them.
pub fn grade_tasks(
    course: &Course,
    tasks: &[&Task],
    specs: &[Spec],
    workers: &StageWorkers,
    printed: &mut Vec<Printed>,
) -> Result<Vec<TaskResult>, GraderError> {
    let chosen = chosen(tasks, specs)?;
    let endings = workers.run(&chosen, printed)?;
    score_tasks(course, tasks, &chosen, &endings)
}

/// Scores the endings of the cases `chosen`, which are those of `tasks` in their order. The results
/// lack the cases that were not run.
pub fn score_tasks(
    course: &Course,
    tasks: &[&Task],
    chosen: &[&Spec],
    endings: &[Result<Ending, String>],
) -> Result<Vec<TaskResult>, GraderError> {
    let mut endings = chosen.iter().zip(endings);
    let mut results = Vec::new();
    for task in tasks {
        let mut case_results = Vec::new();
        for entry in &task.cases {
            let (spec, ending) = endings
                .next()
                .ok_or_else(|| GraderError::new("the worker returned no result for a case"))?;
            if matches!(ending, Ok(Ending::NotRun)) {
                continue;
            }
            let holes = named_in_order(task, holes(ending));
            let answer = answered(&task.key, ending, course)?;
            let (status, findings) = match &answer {
                Err(status) => (with_input(status.clone(), spec), Vec::new()),
                Ok(answer) => {
                    let called: Vec<String> =
                        holes.iter().map(|hole| hole.called.clone()).collect();
                    let findings = judge::judge_written(spec, entry.tier, answer, &called);
                    (Status::Passed, findings)
                }
            };
            let result = CaseResult::new(entry, spec.about, status, findings, &holes);
            let answer = answer.ok();
            case_results.push(CaseResult {
                with_neighbours: spec.needs_all_stages(),
                calls: judge::calls(&spec.work),
                answer_to_all: answer
                    .and_then(|answer| diagnosis::constant::answer_to_all(&spec.work, answer)),
                ..result
            });
        }
        results.push(TaskResult::new(task, case_results));
    }
    Ok(results)
}

/// Adds the input of the call that crashed to the status.
fn with_input(status: Status, spec: &Spec) -> Status {
    match status {
        Status::Crashed(crash) => Status::Crashed(Crash {
            input: crash.call.and_then(|call| spec.input(call as usize)),
            ..crash
        }),
        status => status,
    }
}

/// Names the function that each gap is in: of those whose calls ended there, the first of the task. A
/// seed draws the order of the calls, so the first that was called may be one that calls it.
fn named_in_order(task: &Task, holes: &[HoleCall]) -> Vec<HoleCall> {
    let named = holes.iter().map(|HoleCall { called, hole }| {
        let ended_there = |name: &str| holes.iter().any(|o| o.hole == *hole && o.called == name);
        let first = task.holes.iter().find(|name| ended_there(name));
        HoleCall {
            called: called.clone(),
            hole: first.filter(|_| ended_there(hole)).unwrap_or(hole).clone(),
        }
    });
    named.collect()
}

/// The functions of a case that have holes.
pub fn holes(ending: &Result<Ending, String>) -> &[HoleCall] {
    match ending {
        Ok(Ending::Recorded(record)) => &record.holes,
        _ => &[],
    }
}

/// The answer of a case of `task`, or the status of a case without an answer. The error of `ending`
/// names the stages without which the case could not run.
pub fn answered<'a>(
    task: &str,
    ending: &'a Result<Ending, String>,
    course: &Course,
) -> Result<Result<&'a Answer, Status>, GraderError> {
    let ending = match ending {
        Ok(ending) => ending,
        Err(broken) => {
            let needs = format!("{broken}, which does not compile");
            return Ok(Err(Status::Needs(needs)));
        }
    };
    let without = status_without_answer(task, ending, course)?;
    Ok(match (without, ending.outcome()) {
        (None, Some(Outcome::Answered(answer))) => Ok(answer),
        (status, _) => Err(status.unwrap_or(Status::Failed)),
    })
}

/// The cases of a task, with what is worst in them.
fn failed_cases(cases: &[CaseResult]) -> impl Iterator<Item = FailedCase<'_>> {
    cases.iter().map(|case| FailedCase {
        name: &case.name,
        tier: case.tier,
        findings: &case.findings,
        crashed_call: case.crash().and_then(|crash| crash.call),
    })
}

fn does_not_compile(task: &Task) -> TaskResult {
    let cases = task
        .cases
        .iter()
        .map(|entry| CaseResult::new(entry, "", Status::DoesNotCompile, Vec::new(), &[]));
    TaskResult::new(task, cases.collect())
}

/// The status of a case of `task` that ended without an answer; `None` if there is an answer.
fn status_without_answer(
    task: &str,
    ending: &Ending,
    course: &Course,
) -> Result<Option<Status>, GraderError> {
    if let Ending::Recorded(record) = ending
        && record.untouched.iter().any(|key| key == task)
    {
        return Ok(Some(Status::NotAttempted));
    }
    if let Some(crash) = Crash::of(ending) {
        return Ok(Some(Status::Crashed(crash)));
    }
    Ok(match ending.outcome() {
        Some(Outcome::NotAttempted { task: hole }) if hole == task => Some(Status::NotAttempted),
        Some(Outcome::NotAttempted { task: hole }) => {
            Some(match course.holes().any(|(_, key)| key == hole) {
                true => Status::Needs(hole.clone()),
                false => Status::Crashed(Crash {
                    how: format!(
                        "the worker's record names the hole {hole:?}, which is not in the course"
                    ),
                    ..Crash::default()
                }),
            })
        }
        Some(Outcome::Unable { reason }) => {
            return Err(GraderError::new(format!(
                "a case of {task} could not run: {reason}"
            )));
        }
        Some(_) => None,
        None => {
            return Err(GraderError::new(format!(
                "a case of {task} was skipped, but only timings may be skipped"
            )));
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_gap_is_in_the_first_function_of_the_task_that_ends_there() {
        let workspace = Workspace::above(std::path::Path::new(env!("CARGO_MANIFEST_DIR")));
        let read = Course::read(&workspace.expect("the grader is in the course"));
        let course = read.expect("the course is valid");
        let task = course.tasks().find(|task| task.key == "part4.task1");
        let holes = |all: [[&str; 2]; 3]| {
            all.map(|[called, hole]| HoleCall {
                called: called.into(),
                hole: hole.into(),
            })
        };
        // `glass_sample` was called first, and calls the function with the `todo!()`.
        let recorded = holes([
            ["glass_sample", "glass_sample"],
            ["fresnel_dielectric", "glass_sample"],
            ["mirror_sample", "reflect"],
        ]);
        let named = holes([
            ["glass_sample", "fresnel_dielectric"],
            ["fresnel_dielectric", "fresnel_dielectric"],
            ["mirror_sample", "reflect"],
        ]);
        assert_eq!(named_in_order(task.expect("it exists"), &recorded), named);
    }
}
