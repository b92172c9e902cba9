//! The commands `grader course check`, which checks the course before it is handed out, `grader
//! course diff`, which compares it with another version, and those for the folder of a term:
//! `grader course new`, `case`, `build` and `update`.

use authoring::term::update::Update;
use authoring::term::{self, build, new, own_case, own_mistakes};
use authoring::{check, diff};
use base::program::Exit;
use base::{GraderError, VERSION, Workspace, errln, out, outln};
use clap::{Arg, ArgAction, ArgMatches, Command, value_parser};
use grader::cli::subprogram;
use grader::course::Course;
use handout::output_folder;
use judge::{cases, own_cases};
use std::path::{Path, PathBuf};
use std::sync::mpsc::{self, RecvTimeoutError, Sender};
use std::thread;
use std::time::{Duration, Instant};

/// After this time without output the program prints that it is still running.
const MAX_SILENCE: Duration = Duration::from_secs(20);

pub(crate) fn command() -> Command {
    let check = Command::new("check")
        .about("Checks the lists of cases and goldens, and the reference's score; then creates, builds and grades every handout")
        .arg(
            Arg::new("quick")
                .long("quick")
                .action(ArgAction::SetTrue)
                .help("Run only the checks that build nothing"),
        );
    let diff = Command::new("diff")
        .about(
            "Lists the cases, points and goldens that changed since another version of the course",
        )
        .arg(
            Arg::new("old")
                .value_name("OLD")
                .required(true)
                .value_parser(value_parser!(PathBuf))
                .help("The top folder of the older version: a checkout, or a handout"),
        );
    let folder = || {
        Arg::new("dir")
            .value_name("DIR")
            .value_parser(value_parser!(PathBuf))
    };
    let text =
        |name: &'static str, value: &'static str| Arg::new(name).long(name).value_name(value);
    let new = Command::new("new")
        .about("Makes the folder of a term: your name, dates, points and words, and this version of First Light")
        .arg(folder().required(true).help("A folder that does not exist yet"))
        .arg(text("name", "NAME").default_value("First Light").help("The name of your course"))
        .arg(text("term", "TERM").default_value("this term").help("When you give it, such as \"Spring 2027\""))
        .arg(text("source", "URL").help("The repository that others clone First Light from; by default that of this checkout"));
    let build = Command::new("build")
        .about("Applies the files of a term to its copy of First Light, .first-light")
        .arg(folder().help("The folder of the term; by default the current one"));
    let update = Command::new("update")
        .about("Shows what this version of First Light would change in a term; points that were given stay")
        .arg(folder().required(true).help("The folder of the term"))
        .arg(
            Arg::new("yes")
                .long("yes")
                .action(ArgAction::SetTrue)
                .help("Take this version"),
        )
        .arg(
            Arg::new("new-points")
                .long("new-points")
                .action(ArgAction::SetTrue)
                .help("Take its points, too, and its new tasks and cases"),
        );
    let case = Command::new("case")
        .about(
            "Prints a question such as a case asks as a file, from which you can make a case of your own",
        )
        .arg(
            Arg::new("case")
                .value_name("TASK/CASE")
                .required(true)
                .help("Such as part1.task3/range"),
        )
;
    Command::new("course")
        .about("For instructors: makes the course of a term, checks the course, compares it with another version")
        .subcommand_required(true)
        .subcommands([new, case, build, update, check, diff])
}

pub(crate) fn run(matches: &ArgMatches) -> Result<Exit, GraderError> {
    match matches.subcommand().expect("clap requires it") {
        ("new", matches) => run_new(matches),
        ("case", matches) => run_case(matches),
        ("build", matches) => run_build(matches),
        ("update", matches) => run_update(matches),
        ("check", matches) => run_check(matches),
        (_, matches) => run_diff(matches),
    }
}

fn run_new(matches: &ArgMatches) -> Result<Exit, GraderError> {
    let folder: &PathBuf = matches.get_one("dir").expect("clap requires it");
    let first_light = Workspace::above(Path::new("."))?;
    output_folder::check(&first_light, folder)?;
    let given = |name| matches.get_one::<String>(name).cloned();
    let source = given("source").unwrap_or_else(|| new::source_of(&first_light));
    let [name, when] = ["name", "term"].map(|name| given(name).expect("it has a default"));
    new::new(&first_light, folder, &name, &when, &source)?;
    outln!(
        "{} is your course. Write its dates and points into course.toml, and run `cargo grader course check --quick` there, \
         which builds the grader of this course, silently and once, in some minutes; README.md has the other commands",
        folder.display()
    );
    if !new::has_tag_of_version(&first_light) {
        outln!(
            "This checkout has no tag v{VERSION}: ./get-first-light and the workflows of the course clone it from `source`"
        );
    }
    if !source.contains("://") && !source.contains('@') {
        outln!(
            "Others get First Light from {source}, the `source` in course.toml: on another machine it has to be a URL"
        );
    }
    Ok(Exit::Passed)
}

/// The folder of the term that the command names, or the one around the current folder.
fn term_folder(matches: &ArgMatches) -> Result<PathBuf, GraderError> {
    let here = PathBuf::from(".");
    let start: &PathBuf = matches.get_one("dir").unwrap_or(&here);
    term::above(start)?.ok_or_else(|| {
        GraderError::new(format!(
            "{} is no folder of a term: it has no course.toml with `[first_light]`. `cargo grader course new DIR` makes one",
            start.display()
        ))
    })
}

fn run_case(matches: &ArgMatches) -> Result<Exit, GraderError> {
    let name: &String = matches.get_one("case").expect("clap requires it");
    // The shell has made the file of the new case, which is not applied yet.
    let course = Course::read(&Workspace::above_as_it_is(Path::new("."))?)?;
    let (key, case) = name.split_once('/').unwrap_or((name, ""));
    let specs = cases::of(key, cases::KNOWN_SEED);
    let spec = specs.iter().find(|spec| spec.name == case);
    let entry = course.tasks().find(|task| task.key == key);
    let entry = entry.and_then(|task| task.cases.iter().find(|entry| entry.name == case));
    let (spec, entry) = spec.zip(entry).ok_or_else(|| {
        GraderError::new(format!(
            "the course has no case `{name}`: expected one such as part1.task3/range; `cargo grader explain TASK` lists \
             those of a task"
        ))
    })?;
    out!("{}", own_case::template(spec, entry.tier)?);
    Ok(Exit::Passed)
}

fn run_build(matches: &ArgMatches) -> Result<Exit, GraderError> {
    let folder = term_folder(matches)?;
    build::build(&Workspace::above_as_it_is(Path::new("."))?, &folder)?;
    outln!("{} is built", folder.display());
    Ok(Exit::Passed)
}

fn run_update(matches: &ArgMatches) -> Result<Exit, GraderError> {
    let folder = term_folder(matches)?;
    let newer = Workspace::above_as_it_is(Path::new("."))?;
    let update = Update::plan(&newer, &folder, matches.get_flag("new-points"))?;
    out!("{}", update.to_text());
    if !matches.get_flag("yes") {
        outln!("\nNothing is changed yet. To take this version, add `--yes`.");
        return Ok(Exit::Failed);
    }
    update.carry_out()?;
    outln!(
        "\n{} uses First Light {} now",
        folder.display(),
        base::VERSION
    );
    Ok(Exit::Passed)
}

fn run_diff(matches: &ArgMatches) -> Result<Exit, GraderError> {
    let old: &PathBuf = matches.get_one("old").expect("clap requires it");
    let old = Workspace::of_any_version(old)?;
    let new = Workspace::above(Path::new("."))?;
    out!("{}", diff::table(&diff::changes(&old, &new)?, &old, &new));
    Ok(Exit::Passed)
}

/// The teacher's cases are compiled in. If this program was compiled before they changed, compiles
/// it again and lets the new one check the course.
fn check_with_own_cases(workspace: &Workspace) -> Result<Option<Exit>, GraderError> {
    let file = workspace.root().join(own_cases::FILE);
    let now = std::fs::read_to_string(&file).map_err(|e| GraderError::file("read", &file, e))?;
    if now == own_cases::COMPILED {
        return Ok(None);
    }
    errln!(
        "The cases of this course changed: compiling the grader with them, about a minute of processor time."
    );
    subprogram::run(
        env!("CARGO_PKG_NAME"),
        std::env::args_os().skip(1).collect(),
    )
    .map(Some)
}

fn run_check(matches: &ArgMatches) -> Result<Exit, GraderError> {
    let quick = matches.get_flag("quick");
    let term = term::above(Path::new("."))?;
    let apply =
        |folder: &PathBuf| build::build(&Workspace::above_as_it_is(Path::new("."))?, folder);
    term.as_ref().map(apply).transpose()?;
    let workspace = Workspace::above(Path::new("."))?;
    if let Some(exit) = check_with_own_cases(&workspace)? {
        return Ok(exit);
    }
    let mut problems = Vec::new();
    if let Some(folder) = &term {
        let learning = own_mistakes::learn(&workspace, folder)?;
        if learning.is_new {
            apply(folder)?;
        }
        problems = learning.problems;
    }
    let start = Instant::now();
    let print = |step: &str| errln!("[{:4} s] {step}", start.elapsed().as_secs());
    let (sender, receiver) = mpsc::channel();
    problems.extend(thread::scope(|scope| {
        scope.spawn(move || {
            while let Err(RecvTimeoutError::Timeout) = receiver.recv_timeout(MAX_SILENCE) {
                print("  ... still running");
            }
        });
        let problems = check::course(&workspace, !quick, print);
        // The other thread ends when the last sender is dropped.
        drop::<Sender<()>>(sender);
        problems
    })?);
    for problem in &problems {
        outln!("{problem}");
    }
    if problems.is_empty() {
        outln!(
            "The course has no problems ({} s).",
            start.elapsed().as_secs()
        );
        return Ok(Exit::Passed);
    }
    match problems.len() {
        1 => outln!("1 problem found."),
        many => outln!("{many} problems found."),
    }
    Ok(Exit::Failed)
}
