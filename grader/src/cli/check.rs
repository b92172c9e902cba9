//! The command `grader check`: what the compiler and the grader find, for an editor.

use super::grade::{GradedRun, hint, hint_argument};
use crate::build;
use crate::check::cargo_check::{self, Checked, Reader};
use crate::check::finding::Finding;
use crate::check::messages;
use crate::check::rustc_message::{Diagnostic, Envelope};
use crate::check::stored::StoredFindings;
use crate::course::sources::{self, SourceFile};
use crate::course::{Course, Task};
use crate::grade::{self, GradeRequest};
use crate::progress::next_task;
use crate::report::HintLevel;
use crate::report::terminal::stdout_has_colours;
use base::program::Exit;
use base::{GraderError, Workspace, out, outln};
use clap::{Arg, ArgAction, ArgMatches, Command};
use judge::cases;
use serde_json::json;
use std::collections::BTreeMap;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::path::Path;

/// The values of `--message-format`, as cargo calls them.
const FORMATS: [&str; 3] = ["human", "json", "json-diagnostic-rendered-ansi"];

pub(super) fn command() -> Command {
    Command::new("check")
        .about("For editors: compiles and grades what is written, and prints what is wrong as the compiler's warnings")
        .arg(
            Arg::new("what")
                .value_name("WHAT")
                .default_value("all")
                .help("A part, such as `part1`, or a task, such as `part1.task3`"),
        )
        .arg(
            Arg::new("message-format")
                .long("message-format")
                .value_name("FORMAT")
                .value_parser(FORMATS)
                .default_value(FORMATS[0])
                .help("How to print messages; `json` is the form of `cargo check`, which editors read"),
        )
        .arg(
            Arg::new("extra")
                .long("extra")
                .action(ArgAction::SetTrue)
                .help("Also show what extra credit lost, where every core case passes"),
        )
        .arg(hint_argument(HintLevel::Mistake))
}

/// What the options say.
struct CheckRequest<'a> {
    hint: HintLevel,
    extra: bool,
    /// The format of JSON; `None` for people.
    format: Option<&'a str>,
    colours: bool,
}

pub(super) fn run(matches: &ArgMatches) -> Result<Exit, GraderError> {
    let format = matches.get_one::<String>("message-format");
    let format = format
        .map(String::as_str)
        .filter(|format| *format != FORMATS[0]);
    let request = CheckRequest {
        hint: hint(matches),
        extra: matches.get_flag("extra"),
        format,
        colours: match format {
            Some(format) => format == FORMATS[2],
            None => stdout_has_colours(),
        },
    };
    let workspace = Workspace::above(Path::new("."))?;
    let course = Course::read(&workspace)?;
    let what: &String = matches.get_one("what").expect("it has a default");
    let tasks = course.select(what)?;
    let target = build::stages_target(workspace.root());
    let stages = grade::stages(&tasks);
    let reader = match format {
        Some(_) => Reader::Editor,
        None => Reader::Person,
    };
    let root = workspace.root();
    let checked = cargo_check::run(root, target.as_deref(), &stages, reader, request.colours)?;
    let nothing_wrong = report(&workspace, &course, &tasks, &checked, &request)?;
    if format.is_some() {
        let last = json!({"reason": "build-finished", "success": checked.compiles});
        outln!("{last}");
    }
    Ok(match checked.compiles && nothing_wrong {
        true => Exit::Passed,
        false => Exit::Failed,
    })
}

/// Grades the tasks that are written and whose code changed, and prints what is wrong in each task.
/// Returns whether nothing is.
fn report(
    workspace: &Workspace,
    course: &Course,
    tasks: &[&Task],
    checked: &Checked,
    request: &CheckRequest,
) -> Result<bool, GraderError> {
    let known = next_task::known(workspace, course)?;
    let mut files: BTreeMap<&str, Vec<SourceFile>> = BTreeMap::new();
    for stage in course.stages() {
        files.insert(stage, sources::read(workspace.root(), stage)?);
    }
    // What a handout contains the solution of is right.
    let is_given = |task: &Task| next_task::is_given(&known, task.part_key());
    let shown: Vec<&Task> = tasks
        .iter()
        .copied()
        .filter(|task| !is_given(task))
        .collect();
    let is_attempted = |task: &Task| {
        let open = sources::place(task, &files[task.stage.as_str()]).open;
        open.len() < task.holes.len() && checked.crates.contains_key(&task.stage)
    };
    let specs = cases::all(0);
    let codes: BTreeMap<&str, String> = shown
        .iter()
        .map(|task| {
            let of_task = specs.iter().filter(|spec| spec.task == task.key);
            let needs_all = of_task.into_iter().any(|spec| spec.needs_all_stages());
            let stage = task.stage.as_str();
            let used = files
                .iter()
                .filter(|(name, _)| needs_all || **name == stage);
            (
                task.key.as_str(),
                code_hash(workspace, request.extra, used.map(|(_, files)| files)),
            )
        })
        .collect();
    let mut stored = StoredFindings::read(workspace);
    let changed = shown
        .iter()
        .filter(|task| is_attempted(task) && !stored.knows(&task.key, &codes[task.key.as_str()]));
    let changed: Vec<&str> = changed.map(|task| task.key.as_str()).collect();
    if !changed.is_empty() {
        let what = changed.join(",");
        let run = GradedRun::new(workspace, &GradeRequest { what, seed: 0 }, false, true)?;
        for report in &run.graded.report.tasks {
            let key = report.result.key.as_str();
            let task = shown.iter().find(|task| task.key == key);
            let holes = task.map_or(&[][..], |task| &task.holes);
            let finding = Finding::of(report, holes, request.extra);
            stored.set(key, &codes[key], finding);
        }
        stored.write(workspace)?;
    }
    let attempted = shown.iter().filter(|task| is_attempted(task));
    let attempted: Vec<&str> = attempted.map(|task| task.key.as_str()).collect();
    let findings = stored.of_tasks(&attempted);
    for task in shown {
        let finding = findings.get(task.key.as_str()).copied();
        let files = &files[task.stage.as_str()];
        for message in messages(task, files, finding, request.hint, request.colours) {
            print(&message, &task.stage, checked, request)?;
        }
    }
    Ok(findings.is_empty())
}

/// A number that changes with the code that a task is graded with: the files of stages, the given
/// code that they call, and the grader itself.
fn code_hash<'a>(
    workspace: &Workspace,
    extra: bool,
    stages: impl Iterator<Item = &'a Vec<SourceFile>>,
) -> String {
    let mut hasher = DefaultHasher::new();
    let program = std::env::current_exe().and_then(|path| path.metadata()?.modified());
    (extra, program.ok()).hash(&mut hasher);
    let given = sources::read(workspace.root(), "kit").unwrap_or_default();
    sources::fingerprint(&given).hash(&mut hasher);
    stages.for_each(|files| sources::fingerprint(files).hash(&mut hasher));
    format!("{:016x}", hasher.finish())
}

/// Prints a message about a crate. One that does not compile has no name in cargo's messages, and
/// the compiler's errors are shown instead.
fn print(
    message: &Diagnostic,
    stage: &str,
    checked: &Checked,
    request: &CheckRequest,
) -> Result<(), GraderError> {
    if request.format.is_none() {
        out!("{}", message.rendered.as_deref().unwrap_or_default());
        return Ok(());
    }
    if let Some(of) = checked.crates.get(stage) {
        let line = serde_json::to_string(&Envelope::new(of, message))
            .map_err(|e| GraderError::new(format!("cannot write a message as JSON: {e}")))?;
        outln!("{line}");
    }
    Ok(())
}
