//! The command `grader part1`: grades the code in the workspace.

use super::{Format, case, picture, seed_argument, seed_of};
use crate::build::compile_errors;
use crate::course::given;
use crate::course::sources;
use crate::course::{Course, Task};
use crate::grade::{self, GradeRequest, Graded};
use crate::progress::next_task::{self, Known};
use crate::progress::results::{self, Fingerprints, Results};
use crate::report::screen::{self, Context};
use crate::report::terminal::Page;
use crate::report::{self, HintLevel, Report, Reveal, TaskReport, links, worst_test};
use crate::score::Status;
use crate::workers::printed;
use base::program::{Exit, path_argument, whole_number};
use base::{GraderError, Workspace, errln, out, outln};
use clap::{Arg, ArgAction, ArgMatches, Command};
use std::path::Path;

/// Adds to `command` the arguments for what to grade and how to print the report. `hint` is the
/// default of `--hint`.
pub fn arguments(command: Command, hint: HintLevel) -> Command {
    command
        .arg(
            Arg::new("what")
                .value_name("WHAT")
                .help("What to grade: `all`, a part such as `part1`, or a task such as `part1.task3`; without it, the next open task"),
        )
        .arg(Arg::new("more").num_args(..).hide(true))
        .arg(Format::argument_with_course_systems())
        .arg(seed_argument())
        .arg(hint_argument(hint))
        .arg(
            Arg::new("no-times")
                .long("no-times")
                .action(ArgAction::SetTrue)
                .help("Leave out the table of speedups"),
        )
}

/// The values of `--hint`.
const LEVELS: [&str; HintLevel::ALL.len()] = ["1", "2", "3", "4"];

/// The option `--hint` with this default.
pub(super) fn hint_argument(default: HintLevel) -> Arg {
    let levels = HintLevel::ALL.map(|level| format!("{} = {}", level.number(), level.adds()));
    Arg::new("hint")
        .long("hint")
        .value_name("LEVEL")
        .value_parser(LEVELS)
        .default_value(LEVELS[default.number() - 1])
        .help(format!(
            "How much to show; each level adds to the one before: {}",
            levels.join("; ")
        ))
}

/// The arguments for a student's own code only.
pub(super) fn student_arguments() -> [Arg; 4] {
    [
        Arg::new("long")
            .long("long")
            .action(ArgAction::SetTrue)
            .help("Print every failed case, not only what helps most"),
        Arg::new("extra")
            .long("extra")
            .action(ArgAction::SetTrue)
            .help("Also show what extra credit lost, once every core case passes"),
        Arg::new("case")
            .long("case")
            .value_name("CASE")
            .conflicts_with("format")
            .help("Run one case of a task, such as `part1.task3 --case range`, and print its wrong calls"),
        Arg::new("call")
            .long("call")
            .value_name("N")
            .requires("case")
            .value_parser(|value: &str| whole_number(value, 0, u32::MAX))
            .help("With --case: print this call of the case, counted from 0: input, answer, expected answer"),
    ]
}

/// The arguments for grading submissions instead of the workspace's own code.
pub fn submission_arguments() -> [Arg; 4] {
    [
        path_argument("submission", "DIR")
            .conflicts_with("class")
            .help("For instructors: grade the stages in DIR, each together with the reference's other stages"),
        path_argument("class", "DIR")
            .hide(true)
            .help("Moved to `grader class DIR --out OUT`"),
        Arg::new("together")
            .long("together")
            .action(ArgAction::SetTrue)
            .help("Also grade all stages of a submission linked together"),
        Arg::new("unsandboxed")
            .long("unsandboxed")
            .action(ArgAction::SetTrue)
            .help("Grade submissions where they cannot be contained: their code has all your rights"),
    ]
}

/// Whether any of the [`submission_arguments`] is present.
pub(super) fn is_for_submissions(matches: &ArgMatches) -> bool {
    let folders = ["submission", "class"];
    let flags = ["together", "unsandboxed"];
    flags.iter().any(|name| matches.get_flag(name))
        || folders.iter().any(|name| matches.contains_id(name))
}

/// Reads what to grade. Naming none, or more than one part or task, is an error.
pub fn request(matches: &ArgMatches) -> Result<GradeRequest, GraderError> {
    let what = matches
        .get_one::<String>("what")
        .ok_or_else(|| GraderError::new("expected a part or a task, such as `grader part1`"))?;
    if let Some(second) = matches.get_one::<String>("more") {
        return Err(GraderError::new(format!(
            "expected one part or task, found two. Run `grader {what}`, then `grader {second}`; or run `grader all`"
        )));
    }
    Ok(GradeRequest {
        what: what.clone(),
        seed: seed_of(matches),
    })
}

/// Reads how much the report reveals.
pub fn hint(matches: &ArgMatches) -> HintLevel {
    let level = matches.get_one::<String>("hint");
    let place = level.and_then(|level| LEVELS.iter().position(|known| known == level));
    place.map_or(HintLevel::Remedy, |place| HintLevel::ALL[place])
}

pub(super) fn run(matches: &ArgMatches) -> Result<Exit, GraderError> {
    let reveal = Reveal {
        hint: hint(matches),
        extra: matches.get_flag("extra"),
    };
    let times = !matches.get_flag("no-times");
    let (workspace, request, run) = if matches.contains_id("what") {
        let request = request(matches)?;
        let workspace = Workspace::above(Path::new("."))?;
        if let Some(name) = matches.get_one::<String>("case") {
            let call = matches.get_one("call").copied();
            return case::run(&workspace, &request, name, call);
        }
        let run = GradedRun::new(&workspace, &request, times, false)?;
        (workspace, request, run)
    } else if matches.contains_id("case") {
        return Err(GraderError::new(
            "expected the task of the case, such as `grader part1.task3 --case range`",
        ));
    } else {
        let workspace = Workspace::above(Path::new("."))?;
        let (request, run) = next_open_task(&workspace, seed_of(matches), times)?;
        (workspace, request, run)
    };
    let report = &run.graded.report;
    match Format::of(matches) {
        Format::Json => {
            outln!("{}", report::json(report)?);
            if let Some(sentence) = given::sentence(&given::changed(&workspace)?) {
                errln!("{sentence}");
            }
        }
        Format::Table if matches.get_flag("long") => {
            let printed = &run.graded.printed;
            if !printed.is_empty() {
                outln!("{}", printed::format(printed));
            }
            out!("{}", report::table::format_report(report, reveal));
            if let Some(sentence) = given::sentence(&given::changed(&workspace)?) {
                outln!("{sentence}");
            }
        }
        Format::Table => {
            let context = run.context(&workspace, &request.what)?;
            let page = Page::of_stdout();
            if let Some((_, lit)) = &run.graded.lit
                && report.is_full()
            {
                out!("{}", picture::in_terminal(lit).unwrap_or_default());
            }
            let text = screen::format_screen(report, &context, reveal, page);
            out!("{}", links::for_stdout(text, &workspace));
        }
    }
    Ok(if report.is_full() {
        Exit::Passed
    } else {
        Exit::Failed
    })
}

/// Grades the first open task. The open tasks of its stage are graded with it in one run, because
/// an edit of the stage opens all of them; the report is about the first that is not complete. If
/// all of them turn out to be complete, the next open tasks follow.
fn next_open_task(
    workspace: &Workspace,
    seed: u64,
    times: bool,
) -> Result<(GradeRequest, GradedRun), GraderError> {
    let course = Course::read(workspace)?;
    let mut graded: Vec<&str> = Vec::new();
    let mut complete: Vec<TaskReport> = Vec::new();
    loop {
        let known = next_task::known(workspace, &course)?;
        let open: Vec<&str> = next_task::open(&known)
            .map(|known| known.place.key.as_str())
            .collect();
        let open = course.tasks().filter(|task| {
            let key = task.key.as_str();
            open.contains(&key) && !graded.contains(&key)
        });
        let open: Vec<&Task> = open.collect();
        let of_stage = open.iter().filter(|task| task.stage == open[0].stage);
        let mut keys: Vec<&str> = of_stage.map(|task| task.key.as_str()).collect();
        let is_last = keys.is_empty();
        if is_last {
            // Everything is complete: so says the report of the last task.
            keys.extend(course.tasks().last().map(|task| task.key.as_str()));
        }
        let request = GradeRequest {
            what: keys.join(","),
            seed,
        };
        let mut run = GradedRun::new(workspace, &request, times, false)?;
        let report = &mut run.graded.report;
        if is_last {
            return Ok((request, run));
        }
        // The tasks that are complete now are told once: the next run leaves them out.
        let (full, incomplete): (Vec<_>, Vec<_>) =
            (report.tasks.drain(..)).partition(|task| task.result.is_complete());
        complete.extend(full);
        let broken = compile_errors::first_file(&run.graded.compiler);
        if let Some(task) = to_go_on_with(incomplete, &known, broken.as_deref()) {
            let what = task.result.key.clone();
            complete.push(task);
            let place = |task: &TaskReport| {
                let mut known = known.iter();
                known.position(|known| known.place.key == task.result.key)
            };
            complete.sort_by_key(place);
            *report = Report::new(complete, report.speedups.take());
            return Ok((GradeRequest { what, seed }, run));
        }
        graded.extend(keys);
    }
}

/// The first of the `incomplete` tasks of a stage. If the stage does not compile, all are, so that
/// of the `broken` file comes first, then one that was not complete before.
fn to_go_on_with(
    mut incomplete: Vec<TaskReport>,
    known: &[Known],
    broken: Option<&str>,
) -> Option<TaskReport> {
    let known = |task: &TaskReport| known.iter().find(|it| it.place.key == task.result.key);
    let is_in_broken_file = |task: &TaskReport| {
        let file = known(task).and_then(|known| known.place.file.as_deref());
        file.is_some() && file == broken
    };
    let was_complete = |task: &TaskReport| known(task).is_some_and(Known::was_complete);
    let at = match incomplete.first()?.result.status {
        Status::DoesNotCompile => (incomplete.iter().position(is_in_broken_file))
            .or_else(|| incomplete.iter().position(|task| !was_complete(task))),
        _ => None,
    };
    Some(incomplete.swap_remove(at.unwrap_or(0)))
}

/// Writes `report.json`, the results of its tasks, whose code had these fingerprints, and the
/// tests of their worst answers.
pub(super) fn store(
    workspace: &Workspace,
    report: &mut Report,
    fingerprints: &Fingerprints,
) -> Result<(), GraderError> {
    worst_test::write_all(workspace, report)?;
    let mut results = Results::read(workspace);
    results.merge(report, fingerprints);
    results.write(workspace)?;
    let json = report::json(report)?;
    base::write_whole(&workspace.root().join("report.json"), json.as_bytes())
}

/// A run whose results are stored.
#[derive(Clone, Debug)]
pub(crate) struct GradedRun {
    pub(crate) graded: Graded,
    course: Course,
    /// Whether nothing was printed while building.
    quiet: bool,
}

impl GradedRun {
    /// Grades the code in `workspace`. Writes `report.json`, the last results of the tasks and the
    /// tests of their worst answers. `quiet` prints nothing while building.
    pub(crate) fn new(
        workspace: &Workspace,
        request: &GradeRequest,
        times: bool,
        quiet: bool,
    ) -> Result<GradedRun, GraderError> {
        let course = Course::read(workspace)?;
        let fingerprints = results::fingerprints(workspace, &course)?;
        let mut graded = grade::in_place(workspace, request, times, quiet)?;
        store(workspace, &mut graded.report, &fingerprints)?;
        Ok(GradedRun {
            graded,
            course,
            quiet,
        })
    }

    /// The first error of the compiler, if its messages are longer than a page.
    fn first_error_out_of_sight(&self) -> Option<String> {
        let messages = &self.graded.compiler;
        let is_long = messages.lines().count() > Page::default().height;
        is_long.then(|| compile_errors::first_in_a_line(messages))?
    }

    /// What a screen says besides the report.
    pub(crate) fn context(
        &self,
        workspace: &Workspace,
        what: &str,
    ) -> Result<Context, GraderError> {
        let tasks = self.course.select(what)?;
        let places = tasks.iter().map(|task| {
            let files = sources::read(workspace.root(), &task.stage)?;
            Ok(sources::place(task, &files))
        });
        let known = next_task::known(workspace, &self.course)?;
        Ok(Context {
            what: what.to_owned(),
            places: places.collect::<Result<_, GraderError>>()?,
            next: next_task::first_open(&known, &tasks).cloned(),
            compiler: self.quiet.then(|| self.graded.compiler.clone()),
            first_error: self.first_error_out_of_sight(),
            broken_file: compile_errors::first_file(&self.graded.compiler),
            lit: self.graded.lit.as_ref().map(|(path, _)| path.clone()),
            printed: self.graded.printed.clone(),
            changed_given: given::changed(workspace)?,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::course::sources::Place;
    use crate::progress::results::TaskScore;
    use crate::score::TaskResult;

    /// The key of the task that a stage goes on with, whose tasks have these results; `scores` are
    /// those of the reports before, of at most 5.
    fn gone_on_with(status: Status, scores: [f64; 2], broken: Option<&str>) -> String {
        let keys = ["part1.task1", "part1.task2"];
        let known = keys.iter().zip(scores).map(|(key, score)| Known {
            place: Place {
                key: (*key).into(),
                title: String::new(),
                file: Some(format!("{key}.rs")),
                open: Vec::new(),
                has_hole: false,
            },
            last: Some(TaskScore::of(score, 5.0)),
            changed: true,
        });
        let reports = keys.map(|key| {
            TaskReport::from(TaskResult {
                key: key.into(),
                title: String::new(),
                score: 0.0,
                max_score: 5.0,
                robust_score: 0.0,
                robust_max_score: 0.0,
                status: status.clone(),
                stage: "raygen".into(),
                functions: Vec::new(),
                cases: Vec::new(),
            })
        });
        let task = to_go_on_with(reports.into(), &known.collect::<Vec<_>>(), broken);
        task.expect("one is incomplete").result.key
    }

    #[test]
    fn a_stage_that_does_not_compile_is_that_of_the_task_in_work() {
        let broken = Status::DoesNotCompile;
        let first = |scores| gone_on_with(broken.clone(), scores, None);
        assert_eq!(first([5.0, 1.0]), "part1.task2");
        assert_eq!(first([1.0, 1.0]), "part1.task1");
        assert_eq!(first([5.0, 5.0]), "part1.task1");
        let of_file = |file| gone_on_with(broken.clone(), [1.0, 1.0], Some(file));
        assert_eq!(of_file("part1.task2.rs"), "part1.task2");
        assert_eq!(of_file("lib.rs"), "part1.task1");
        // A wrong answer is that of its own task.
        let wrong = gone_on_with(Status::Failed, [5.0, 1.0], Some("part1.task2.rs"));
        assert_eq!(wrong, "part1.task1");
    }
}
