//! Runs `grader class`.

use super::engines::{Shard, UnitCommand, missing};
use super::{alike, marks};
use crate::collect::{Class, OnUnreadable, Options, Status};
use crate::course_hash;
use crate::decisions::Decisions;
use crate::out::Out;
use crate::plan::{Plan, Settings};
use crate::progress::Progress;
use crate::reading::intake::Revision;
use crate::reading::{Reader, process};
use crate::{pool, regrade, tables, unit};
use base::program::Exit;
use base::{GraderError, Workspace, errln, out, outln, shell_word, write_whole};
use clap::ArgMatches;
use grader::course::Course;
use grader::grade::GradeRequest;
use grader::report::HintLevel;
use judge::plural;
use std::path::{Path, PathBuf};
use submission::Untrusted;
use submission::arguments::containment;
use submission::containment::Containment;
use submission::one::{GradingCourse, random_seed};

/// Runs the command.
pub fn run(matches: &ArgMatches) -> Result<Exit, GraderError> {
    let path = |name| matches.get_one::<PathBuf>(name).map(PathBuf::as_path);
    let out = path("out").ok_or_else(|| GraderError::new("expected --out OUT"))?;
    if matches.get_flag("collect") {
        return collect(matches, &existing(out)?);
    }
    let class =
        path("class").ok_or_else(|| GraderError::new("expected the folder of the class"))?;
    if !class.is_dir() {
        return Err(GraderError::new(format!(
            "{} is not a folder. Expected the folder of the class, with one submission in each entry",
            class.display()
        )));
    }
    let workspace = Workspace::above(path("course").unwrap_or(Path::new(".")))?;
    workspace.ensure_full("it does not contain the reference that a class is graded with")?;
    if let Some(key) = matches.get_one::<String>("unit") {
        // The pool has built it.
        let containment = match path("launcher") {
            Some(launcher) => Containment::with_launcher(&workspace, launcher.into())?,
            None => containment(matches, &workspace)?,
        };
        return grade_unit(
            matches,
            &existing(out)?,
            class,
            &workspace,
            containment,
            key,
        );
    }
    let out = &Out::create(out)?;
    if contains(class, out.path()) {
        return Err(GraderError::new(format!(
            "{} is inside the folder of the class, where it would be graded, too. Choose another folder for --out",
            out.path().display()
        )));
    }
    let regrades = matches.get_flag("regrade");
    let containment = containment(matches, &workspace)?;
    if matches.get_flag("alike") {
        let reader = reader(&workspace, &containment)?;
        return alike::run(
            &workspace,
            class,
            out,
            &reader,
            revision(matches).as_ref(),
            matches.get_one::<PathBuf>("roster").map(PathBuf::as_path),
            reading,
        );
    }
    let plan = plan(matches, &workspace, class, out, &containment)?;
    let unsandboxed = matches.get_flag("unsandboxed");
    let command = UnitCommand::new(workspace.root(), class, out, unsandboxed)?;
    let shard = matches.get_one::<Shard>("shard").copied();
    if shard.is_none() {
        // A mistake in the files of the teacher is said before hours of grading.
        decisions(matches, out, &plan)?;
    }
    let jobs = missing(&plan, shard, out);
    if matches.get_flag("list") {
        for (key, _) in jobs {
            outln!("{}", command.line(key)?);
        }
        return Ok(Exit::Passed);
    }
    if !jobs.is_empty() {
        // What all submissions share is built once, not by the first of each processor. What fails
        // on a machine that cannot grade is no score.
        let request = GradeRequest {
            what: plan.settings.what.clone(),
            seed: plan.settings.seed,
        };
        let launcher = containment.launcher().map(Path::to_path_buf);
        GradingCourse::open(&workspace, containment)?.ensure_that_it_grades(&request)?;
        if let Some(why) = plan.why_fewer(jobs.len(), |key| unit::is_stored(out, key)) {
            errln!("{why}");
        }
        let progress = Progress::start(jobs.len());
        pool::run(&jobs, at_once(matches), out, &progress, |key| {
            let mut command = command.of(key);
            command.arg("--of-pool");
            if let Some(launcher) = &launcher {
                command.arg("--launcher").arg(launcher);
            }
            command
        })?;
    }
    match shard {
        Some(_) => {
            let left = missing(&plan, shard, out).len();
            outln!(
                "{} units of this shard graded, {left} failed. When all shards are done, run `grader class --collect --out {}`",
                jobs.len() - left,
                shell_word(out.path())
            );
            match left {
                0 => Ok(Exit::Passed),
                _ => Err(run_again(left)),
            }
        }
        None if regrades => show_regrade(matches, out),
        None => write_tables(matches, out, plan),
    }
}

/// The folder `OUT` of an earlier run.
fn existing(out: &Path) -> Result<Out, GraderError> {
    match out.join("class.json").is_file() {
        true => Out::create(out),
        false => Err(GraderError::new(format!(
            "{} has no class.json: expected the folder that an earlier `grader class DIR --out` wrote",
            out.display()
        ))),
    }
}

fn contains(class: &Path, out: &Path) -> bool {
    class
        .canonicalize()
        .is_ok_and(|class| out.starts_with(class))
}

/// Makes the plan and stores it. With `--regrade` it is only proposed.
fn plan(
    matches: &ArgMatches,
    workspace: &Workspace,
    class: &Path,
    out: &Out,
    containment: &Containment,
) -> Result<Plan, GraderError> {
    let hashes = course_hash::of(workspace)?;
    let course = Course::read(workspace)?;
    let reader = reader(workspace, containment)?;
    let part = matches.get_one::<u32>("part");
    let revision = revision(matches);
    loop {
        let old = Plan::load(&out.plan())?;
        let known_seed = old.as_ref().map(|old| old.settings.seed);
        let seed = matches.get_one("seed").copied().or(known_seed);
        let settings = Settings {
            what: part.map_or_else(|| "all".to_string(), |part| format!("part{part}")),
            seed: seed.unwrap_or_else(random_seed),
            limits: limits(matches).to_string(),
            revision: revision.clone(),
            course: hashes.clone(),
        };
        let with_archives = matches.get_flag("with-archives");
        let wanted = Plan::make(class, &course, &reader, settings, with_archives, reading)?;
        let Some(old) = old else {
            if matches.get_flag("regrade") {
                return Err(GraderError::new(format!(
                    "nothing was graded in {} yet: run without `--regrade` first",
                    out.path().display()
                )));
            }
            match wanted.store_first(&out.plan())? {
                true => return Ok(wanted),
                false => continue, // another machine was first: its seed counts
            }
        };
        if matches.get_flag("regrade") {
            wanted.store(&out.proposed_plan())?;
            return Ok(wanted);
        }
        let differences = old.differences(&wanted);
        if !differences.is_empty() {
            return Err(GraderError::new(format!(
                "{} was graded with {}. `--regrade` grades again and shows what changes before it replaces anything; or choose another folder for --out",
                out.path().display(),
                differences.join(", and with ")
            )));
        }
        let (plan, kept) = old.extended(&wanted, |key| out.has(key));
        for kept in kept {
            errln!("{kept}: the old score stays until `--regrade`");
        }
        if plan != old {
            plan.store(&out.plan())?;
        }
        return Ok(plan);
    }
}

/// The commit of git clones that counts.
fn revision(matches: &ArgMatches) -> Option<Revision> {
    let before = matches.get_one::<Revision>("before").cloned();
    before.or_else(|| matches.get_one("commit").cloned().map(Revision::Commit))
}

/// Reads submissions with this program.
fn reader(workspace: &Workspace, containment: &Containment) -> Result<Reader, GraderError> {
    let program = std::env::current_exe();
    let program = program
        .map_err(|e| GraderError::new(format!("cannot find out which program this is: {e}")))?;
    let containment = containment.clone();
    Ok(Reader::new(
        &program,
        workspace,
        containment,
        process::LIMITS,
    ))
}

/// The limits on submissions that can be chosen. Those of time and memory are part of the course.
fn limits(matches: &ArgMatches) -> &'static str {
    match matches.get_flag("unsandboxed") {
        true => "without a sandbox",
        false => "in a sandbox",
    }
}

/// Prints which submission is read, now and then.
fn reading(i: usize, of: usize) {
    if i > 0 && i.is_multiple_of(50) {
        errln!("{i} of {of} submissions read");
    }
}

fn at_once(matches: &ArgMatches) -> usize {
    let processors = || std::thread::available_parallelism().map_or(1, usize::from);
    matches.get_one("jobs").copied().unwrap_or_else(processors)
}

/// Grades one unit, as a process of a pool or of another engine.
fn grade_unit(
    matches: &ArgMatches,
    out: &Out,
    class: &Path,
    workspace: &Workspace,
    containment: Containment,
    key: &str,
) -> Result<Exit, GraderError> {
    if matches.get_flag("of-pool") {
        pool::end_with_the_pool();
    }
    if unit::is_stored(out, key) {
        return Ok(Exit::Passed);
    }
    let plans = [Plan::load(&out.plan())?, Plan::load(&out.proposed_plan())?];
    let mut planned = plans.iter().flatten().filter_map(|plan| {
        let planned = plan.units().get(key).copied()?;
        Some((plan, planned))
    });
    let (plan, planned) = planned.next().ok_or_else(|| {
        GraderError::new(format!(
            "{} has no unit {key}: run `--list` again",
            out.path().display()
        ))
    })?;
    let reader = reader(workspace, &containment)?;
    let graded = GradingCourse::open(workspace, containment)
        .and_then(|course| unit::grade(plan, planned, class, &reader, &course, out));
    // It may name a file that was handed in.
    let graded = graded.map_err(|why| GraderError::new(Untrusted::from(why.to_string()).lines()));
    if let Err(why) = &graded {
        pool::store_failure(out, key, &why.to_string())?;
    }
    graded.map(|()| Exit::Passed)
}

fn collect(matches: &ArgMatches, out: &Out) -> Result<Exit, GraderError> {
    if matches.get_flag("regrade") {
        return show_regrade(matches, out);
    }
    let plan = Plan::load(&out.plan())?.ok_or_else(|| GraderError::new("class.json is gone"))?;
    write_tables(matches, out, plan)
}

/// Writes the tables and prints a summary.
fn write_tables(matches: &ArgMatches, out: &Out, plan: Plan) -> Result<Exit, GraderError> {
    let hint = matches.get_one::<String>("hint");
    let hint = hint.and_then(|level| {
        HintLevel::ALL
            .into_iter()
            .find(|hint| hint.number().to_string() == *level)
    });
    let hint = hint.unwrap_or(HintLevel::Findings);
    let decisions = decisions(matches, out, &plan)?;
    let options = decisions.options(&plan, options(matches));
    let class = tables::write(out, plan, hint, &options)?;
    outln!("{}", class.summary());
    for row in &class.rows {
        let what = match (&row.score, &row.status) {
            (None, Status::Question(_) | Status::Unreadable(_) | Status::HeldBack) => {
                "your decision"
            }
            (None, _) => "no score",
            _ if row.is_unread_zero() => "0 points",
            _ => continue,
        };
        outln!("{what}: {}: {}", row.name.line(), row.status);
    }
    let open = || class.rows.iter().filter(|row| row.score.is_none());
    if open().any(|row| matches!(row.status, Status::Question(_))) {
        outln!(
            "what is no clone has no commit times. `--with-archives` grades it as it lies there; otherwise ask for a clone"
        );
    }
    if open().any(|row| matches!(row.status, Status::Unreadable(_))) {
        outln!(
            "of what could not be read no code was graded, so it has no mark. Ask for it again, put it into the place of the old one and run again; or give it 0 points: `--zero-unreadable`"
        );
    }
    outln!(
        "seed {}; tables: {}",
        class.plan.settings.seed,
        out.join("{gradebook.csv,class.html,students/}").display()
    );
    for why in &decisions.by_hand.open {
        outln!("your decision: {why}");
    }
    let mut is_decided = decisions.by_hand.open.is_empty();
    if let Some((roster, join)) = &decisions.roster {
        for (i, other) in &join.replaced {
            let name = |i: usize| class.rows[i].name.line();
            outln!(
                "does not count: {}: the team handed in {} later",
                name(*i),
                name(*other)
            );
        }
        is_decided &= marks::write(matches, out, &class, roster, join, &decisions.by_hand)?;
    }
    decisions.show_changes(out, |change| outln!("{change}"))?;
    match class.not_graded() {
        0 => Ok(exit_of(class.is_complete() && is_decided)),
        left => Err(run_again(left)),
    }
}

/// That the grader has not done its work, whatever is to be decided besides.
fn run_again(left: usize) -> GraderError {
    let have = plural(left, "submission has", "submissions have");
    GraderError::new(format!(
        "{have} no score, because the grader failed or has not finished: run the same command again"
    ))
}

/// What the teacher decides in the files of the class.
fn decisions(matches: &ArgMatches, out: &Out, plan: &Plan) -> Result<Decisions, GraderError> {
    let roster = matches.get_one::<PathBuf>("roster");
    Decisions::read(out, plan, roster.map(PathBuf::as_path))
}

/// What the arguments say about rows.
fn options(matches: &ArgMatches) -> Options {
    Options {
        on_unreadable: match matches.get_flag("zero-unreadable") {
            true => OnUnreadable::Zero,
            false => OnUnreadable::Ask,
        },
        ..Options::default()
    }
}

/// Shows what the proposed plan changes; with `--yes` it replaces the old one.
fn show_regrade(matches: &ArgMatches, out: &Out) -> Result<Exit, GraderError> {
    let load = |path: PathBuf| {
        Plan::load(&path)?.ok_or_else(|| {
            GraderError::new(format!(
                "{} is missing: run `grader class DIR --out OUT --regrade` first",
                path.display()
            ))
        })
    };
    let read = |plan| Class::read(out, plan, &options(matches), |_, _, _, _| Ok(()));
    let old = read(load(out.plan())?)?;
    let new = read(load(out.proposed_plan())?)?;
    let by_hand = decisions(matches, out, &new.plan)?.by_hand;
    let changes = regrade::changes(&old, &new, &by_hand);
    write_whole(
        &out.join("regrade.csv"),
        regrade::to_csv(&changes)?.as_bytes(),
    )?;
    out!("{}", regrade::to_text(&changes, new.rows.len()));
    let failed = new.rows.iter().filter(|row| {
        let before = old.rows.iter().find(|old| old.name == row.name);
        // What a person has to decide on is in the list of changes.
        let has_failed = matches!(row.status, Status::Infrastructure(_));
        has_failed && before.is_some_and(|before| before.score.is_some())
    });
    let failed: Vec<String> = failed.map(|row| row.name.line()).collect();
    if !failed.is_empty() {
        return Err(GraderError::new(format!(
            "nothing is replaced: {} had a score and would have none. Run again",
            failed.join(", ")
        )));
    }
    if !changes.is_empty() && !matches.get_flag("yes") {
        outln!(
            "nothing is replaced yet. To replace the scores, add `--yes`. The list is {}",
            out.join("regrade.csv").display()
        );
        return Ok(Exit::Failed);
    }
    let (from, to) = (out.proposed_plan(), out.plan());
    std::fs::rename(&from, &to).map_err(|e| GraderError::file("rename", &from, e))?;
    write_tables(matches, out, new.plan)
}

fn exit_of(is_fine: bool) -> Exit {
    match is_fine {
        true => Exit::Passed,
        false => Exit::Failed,
    }
}
