//! The command `grader check`: what the compiler and the grader find, for an editor.

use super::grade::{self, hint, hint_argument};
use crate::build;
use crate::check::again::{self, Asked, Desk, Done};
use crate::check::cargo_check::{self, Checked, Reader};
use crate::check::finding::Finding;
use crate::check::messages;
use crate::check::rustc_message::{Diagnostic, Envelope};
use crate::check::stored::StoredFindings;
use crate::course::sources::{self, SourceFile};
use crate::course::{Course, Task};
use crate::grade::one_by_one::{self, is_whole};
use crate::grade::stages;
use crate::progress::{next_task, results};
use crate::report::terminal::stdout_has_colours;
use crate::report::{HintLevel, Report};
use base::program::Exit;
use base::{GraderError, Workspace, out, outln};
use clap::{Arg, ArgAction, ArgMatches, Command};
use judge::cases::{self, Spec};
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
    let stages = stages(&tasks);
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
    let files = sources::read_all(workspace.root(), course)?;
    let given = given_code(workspace)?;
    let code = |task: &Task| {
        let open = sources::place(task, &files[task.stage.as_str()]).open;
        let is_attempted = open.len() < task.holes.len();
        (is_attempted && checked.crates.contains_key(&task.stage)).then(|| {
            let whole_scenes = cases::of(&task.key, 0).iter().any(Spec::needs_all_stages);
            let linked = files.iter().filter(|(stage, _)| match whole_scenes {
                true => build::traces_scenes_with(&task.stage, stage),
                false => task.stage == **stage,
            });
            code_hash(given, request.extra, linked.map(|(_, files)| files))
        })
    };
    // What a handout contains the solution of is right.
    let is_given = |task: &Task| next_task::is_given(&known, task.part_key());
    // Gaps of all parts on the first day would be noise, unless somebody asks for their part.
    let is_for_later =
        |task: &Task| tasks.len() == known.len() && next_task::is_for_later(&known, task);
    let shown = tasks
        .iter()
        .copied()
        .filter(|task| !is_given(task) && !is_for_later(task));
    let asked: Vec<Asked<'_>> = shown
        .map(|task| Asked {
            task,
            code: code(task),
        })
        .collect();
    let editor = Editor {
        workspace,
        course,
        files: &files,
        checked,
        request,
    };
    again::run(&asked, &mut StoredFindings::read(workspace), &editor)
}

/// The editor whose user is shown what is wrong in the workspace.
struct Editor<'a> {
    workspace: &'a Workspace,
    course: &'a Course,
    /// The files of each stage.
    files: &'a BTreeMap<&'a str, Vec<SourceFile>>,
    checked: &'a Checked,
    request: &'a CheckRequest<'a>,
}

impl Desk for Editor<'_> {
    fn grade(&self, tasks: &[&Task], done: &mut Done<'_>) -> Result<(), GraderError> {
        let workspace = self.workspace;
        let fingerprints = results::of_files(self.course, self.files);
        let mut whole = Vec::new();
        one_by_one::in_place(workspace, self.course, tasks, |task, graded| {
            let files = &self.files[task.stage.as_str()];
            done(
                task,
                Finding::all(&graded, task, files, self.request.extra)?,
            )?;
            // The points of a part of the cases are not those of the task.
            whole.extend(is_whole(task, &graded.report).then_some(graded.report));
            Ok(())
        })?;
        grade::store(workspace, &mut Report::new(whole, None), &fingerprints)
    }

    fn show(&self, task: &Task, findings: &[Finding]) -> Result<(), GraderError> {
        let CheckRequest { hint, colours, .. } = *self.request;
        let files = &self.files[task.stage.as_str()];
        let messages = messages(task, files, findings, hint, colours);
        let mut messages = messages.iter();
        messages.try_for_each(|message| print(message, &task.stage, self.checked, self.request))
    }

    fn store(&self, findings: &StoredFindings) -> Result<(), GraderError> {
        findings.write(self.workspace)
    }
}

/// The files besides those of stages that decide what the answers are and what is said about them.
const GIVEN: [&str; 5] = [
    "stages/kit/src",
    "grader/harness/src",
    "grader/driver/src",
    "grader/worker/src",
    "scenes/meshes/src",
];

/// A number that changes with the given code that answers depend on, with the cases of the course
/// and with this program, which judges them.
fn given_code(workspace: &Workspace) -> Result<u64, GraderError> {
    let mut hasher = DefaultHasher::new();
    let program = std::env::current_exe().and_then(|path| path.metadata()?.modified());
    program.ok().hash(&mut hasher);
    let course = workspace.root().join("stages/course.toml");
    std::fs::read(course).ok().hash(&mut hasher);
    for folder in GIVEN {
        for path in sources::below(&workspace.root().join(folder))? {
            let text = std::fs::read(&path).map_err(|e| GraderError::file("read", &path, e))?;
            (path, text).hash(&mut hasher);
        }
    }
    Ok(hasher.finish())
}

/// A number that changes with the code that a task is graded with: the `given` code and the files
/// of the `stages` that are linked.
fn code_hash<'a>(
    given: u64,
    extra: bool,
    stages: impl Iterator<Item = &'a Vec<SourceFile>>,
) -> String {
    let mut hasher = DefaultHasher::new();
    (given, extra).hash(&mut hasher);
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
