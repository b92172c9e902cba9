//! Runs the attempts and the spoilers in workers.

use crate::attempts::{self, Attempt};
use crate::spoilers::{self, Spoiler};
use base::Workspace;
use cap::Cap;
use grader::workers::awake::Awake;
use grader::workers::crash::Crash;
use grader::workers::launcher::{Launcher, WorkerLimits};
use grader::workers::runner::{self, Ending, Run, Worker};
use std::alloc::System;
use std::os::unix::fs::PermissionsExt;
use std::os::unix::net::UnixDatagram;
use std::path::Path;
use std::process::{Command, ExitCode, ExitStatus};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::time::Duration;
use submission::containment::Containment;
use wire::answer::TraverseAnswer;
use wire::work::ScriptedRay;
use wire::{Answer, Case, Record, Work};

#[global_allocator]
static MEMORY: Cap<System> = Cap::new(System, usize::MAX);

/// The time limit of code that ends, in milliseconds: a hundred times what it takes on a slow machine.
const LIMIT_MS: u64 = 600_000;

/// The same for code that never returns.
const SHORT_LIMIT_MS: u64 = 200;

/// With this variable, the spoilers run at every level, not only at the strongest.
const ALL_LEVELS: &str = "FIRSTLIGHT_ALL_LEVELS";

/// What a way out prints that leads out. A crash's sentence shows it.
const GOT_OUT: &str = "GOT OUT";

/// Starts workers as a level of containment does.
#[derive(Debug)]
struct Level(Containment);

impl Launcher for Level {
    fn cargo(&self) -> Command {
        Command::new("cargo")
    }

    fn worker(&self, program: &Path, limits: WorkerLimits) -> Command {
        self.0.worker(program, limits)
    }

    fn closes_files(&self) -> bool {
        self.0.closes_files()
    }

    fn seals(&self) -> bool {
        self.0.seals()
    }

    fn status_of_program(&self, status: ExitStatus) -> ExitStatus {
        self.0.status_of_program(status)
    }

    fn end(&self) -> Option<Awake> {
        None
    }
}

/// The worker's part. The name of a case is that of its code, after a `:` with a path for it.
fn run_case(index: u32, case: &Case) -> Record {
    let (name, path) = case.name.split_once(':').unwrap_or((&case.name, ""));
    harness::run(index, case, |work| {
        if let Work::Traverse(world) = work {
            return Ok(Answer::Traverse(world.rays.iter().map(one_test).collect()));
        }
        let all = attempts::ALL;
        let some = attempts::THROUGH_FILES_AND_NETWORKS;
        let (list, path) = match path.strip_prefix(ONLY_CLOSED) {
            Some(path) => (some, path),
            None => (all, path),
        };
        if let Some(attempt) = list.iter().find(|it| it.name == name) {
            let got_out = (attempt.got_out)(Path::new(path));
            assert!(!got_out, "{GOT_OUT}: {name}");
        }
        if let Some(spoiler) = spoilers::ALL.iter().find(|it| it.name == name) {
            (spoiler.code)();
        }
        Ok(Answer::Stop(Vec::new()))
    })
}

/// An answer that counts a test for which nobody was asked.
fn one_test(ray: &ScriptedRay) -> TraverseAnswer {
    TraverseAnswer {
        hit: None,
        ray_after: ray.ray,
        box_tests: 1,
        prim_tests: 0,
        prim_hits: 0,
        repeated_prims: 0,
        unknown_boxes: 0,
    }
}

/// Counts that are not those of the grader fail their case. The worker writes them, in place of code
/// that has changed them.
fn changed_counts_that_count(level: &Containment) -> Option<String> {
    let specs = judge::cases::of("part2.task3", 1);
    let is_scripted = |case: &Case| matches!(&case.work, Work::Traverse(_));
    let case = specs.iter().map(|spec| spec.case()).find(is_scripted);
    let run = run_cases(level, &[case.expect("it has scripted rays")]);
    let says = Crash::of(&run.endings[0]).unwrap_or_default().how;
    let is_found = says.starts_with("changed the grader's counts of its tests: in call");
    (!is_found).then(|| format!("{level}: changed counts: {:?}", run.endings))
}

pub(crate) fn main() -> ExitCode {
    let first = std::env::args().nth(1);
    if first.is_some_and(|first| first == "-") {
        return harness::main(&MEMORY, run_case);
    }
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let workspace = Workspace::above(&root).expect("this is the course");
    let strongest = Containment::choose(&workspace, false).expect("there is one");
    println!("{strongest}");
    let mut wrong = Vec::new();
    for level in strongest.levels() {
        if level.seals() {
            wrong.extend(attempts_that_lead_out(&level, attempts::ALL, ""));
        } else if level.closes_files() {
            let some = attempts::THROUGH_FILES_AND_NETWORKS;
            wrong.extend(attempts_that_lead_out(&level, some, ONLY_CLOSED));
        } else {
            continue;
        }
        println!("held: {level}");
    }
    if std::env::var_os(ALL_LEVELS).is_some() {
        let others = strongest.levels().into_iter().skip(1);
        for level in others.filter(Containment::seals) {
            wrong.extend(spoilers_that_spoil_more(&level));
        }
    }
    let filters = Arc::new(Filters::default());
    let watching = filters.watch();
    wrong.extend(spoilers_that_spoil_more(&strongest));
    filters.has_ended.store(true, Ordering::Relaxed);
    watching.join().expect("it watches");
    wrong.extend(changed_counts_that_count(&strongest));
    wrong.extend(filters.of_a_thread_that_is_not_sealed());
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    println!("test hostile_code_is_held ... ok");
    ExitCode::SUCCESS
}

/// What stands before the path of an attempt of the list for levels that deny no system calls.
const ONLY_CLOSED: &str = "only closed ";

/// Makes these attempts at a level, with a socket that listens outside and hears nothing. `mark`
/// stands before their paths.
fn attempts_that_lead_out(level: &Containment, attempts: &[Attempt], mark: &str) -> Vec<String> {
    let folder = tempfile::tempdir().expect("there is a folder");
    let open_to = |path: &Path, mode| {
        let rights = std::fs::Permissions::from_mode(mode);
        std::fs::set_permissions(path, rights).expect("it is ours");
    };
    open_to(folder.path(), 0o777);
    let path = folder.path().join("socket");
    let listener = UnixDatagram::bind(&path).expect("a socket can be bound");
    open_to(&path, 0o777);
    listener.set_nonblocking(true).expect("it can be set");
    let names: Vec<String> = attempts
        .iter()
        .map(|Attempt { name, .. }| *name)
        .map(|name| format!("{name}:{mark}{}", path.display()))
        .collect();
    let run = run(level, &names);
    let mut wrong = Vec::new();
    for (name, ending) in names.iter().zip(&run.endings) {
        let is_answered = Crash::of(ending).is_none() && matches!(ending, Ending::Recorded(_));
        if !is_answered {
            wrong.push(format!("{level}: {name}: {ending:?}"));
        }
    }
    if listener.recv(&mut [0; 64]).is_ok() {
        wrong.push(format!("{level}: the listener heard something"));
    }
    let left: Vec<_> = std::fs::read_dir(folder.path())
        .expect("it is ours")
        .collect();
    if left.len() != 1 {
        wrong.push(format!("{level}: {left:?}"));
    }
    wrong
}

/// The number of workers that run spoilers at once. Most spoilers only wait for their limit.
const WORKERS: usize = 4;

/// Runs all spoilers, with honest code between them.
fn spoilers_that_spoil_more(level: &Containment) -> Vec<String> {
    std::thread::scope(|scope| {
        // Not neighbours: those that wait for long stand together.
        let parts = (0..WORKERS).map(|first| spoilers::ALL.iter().skip(first).step_by(WORKERS));
        let runs: Vec<_> = parts
            .map(|part| scope.spawn(|| spoilers_of_a_worker(level, &Vec::from_iter(part))))
            .collect();
        let ends = runs.into_iter().map(|run| run.join().expect("it ends"));
        ends.flatten().collect()
    })
}

/// The same in one worker.
fn spoilers_of_a_worker(level: &Containment, spoilers: &[&Spoiler]) -> Vec<String> {
    let mut names = Vec::new();
    for Spoiler { name, .. } in spoilers {
        names.extend([name.to_string(), format!("honest code after: {name}")]);
    }
    let run = run(level, &names);
    let mut wrong = Vec::new();
    for (name, ending) in names.iter().zip(&run.endings) {
        let says = Crash::of(ending).map_or("answers".into(), |crash| crash.how);
        let spoiler = spoilers.iter().find(|it| it.name == name);
        let expected: &[&str] = spoiler.map_or(&["answers"], |spoiler| spoiler.says);
        if !expected.iter().any(|part| says.contains(part)) {
            wrong.push(format!(
                "{level}: {name}: {says}; expected one of {expected:?}"
            ));
        }
    }
    wrong
}

/// The time limit of a case. Code that waits has eight times as long.
fn limit_ms(name: &str) -> u64 {
    let spoiler = spoilers::ALL.iter().find(|it| it.name == name);
    let is_endless = spoiler.is_some_and(|it| it.says == ["did not return"]);
    match is_endless {
        true => SHORT_LIMIT_MS,
        false => LIMIT_MS,
    }
}

/// Runs cases of these names, each of a task of its own.
fn run(level: &Containment, names: &[String]) -> Run {
    let case = |name: &String| Case {
        task: name.clone(),
        name: name.clone(),
        limit_ms: limit_ms(name),
        work: Work::Stop(Vec::new()),
        order: Vec::new(),
    };
    let cases: Vec<Case> = names.iter().map(case).collect();
    run_cases(level, &cases)
}

/// Runs cases in a worker at this level.
fn run_cases(level: &Containment, cases: &[Case]) -> Run {
    let this_program = std::env::current_exe().expect("this program has a path");
    let launcher: Arc<dyn Launcher> = Arc::new(Level(level.clone()));
    let worker = Worker {
        launcher: Some(launcher),
        ..Worker::from(this_program)
    };
    runner::run(&worker, cases).expect("the worker runs")
}

/// How many filters of system calls the threads of workers have, as the system shows them outside.
#[derive(Default)]
struct Filters {
    /// The most that the main thread of a worker had.
    main: AtomicU64,
    /// The most that the student's thread had.
    student: AtomicU64,
    has_ended: AtomicBool,
}

impl Filters {
    /// Looks at the threads of this program's workers until it has ended.
    fn watch(self: &Arc<Self>) -> std::thread::JoinHandle<()> {
        let filters = self.clone();
        std::thread::spawn(move || {
            while !filters.has_ended.load(Ordering::Relaxed) {
                filters.look();
                std::thread::sleep(Duration::from_millis(20));
            }
        })
    }

    /// Looks at each child of this program. Any of them may end meanwhile.
    fn look(&self) {
        let this = std::process::id().to_string();
        let ids = std::fs::read_dir("/proc").into_iter().flatten().flatten();
        for id in ids.map(|entry| entry.path()) {
            let is_ours = status(&id, "PPid").is_some_and(|parent| parent == this);
            let tasks = is_ours
                .then(|| std::fs::read_dir(id.join("task")).ok())
                .flatten();
            for task in tasks
                .into_iter()
                .flatten()
                .flatten()
                .map(|task| task.path())
            {
                let count = status(&task, "Seccomp_filters");
                let count = count.and_then(|count| count.parse().ok()).unwrap_or(0);
                match status(&task, "Name").as_deref() {
                    Some("student") => self.student.fetch_max(count, Ordering::Relaxed),
                    _ if task.file_name() == id.file_name() => {
                        self.main.fetch_max(count, Ordering::Relaxed)
                    }
                    _ => continue,
                };
            }
        }
    }

    fn of_a_thread_that_is_not_sealed(&self) -> Option<String> {
        let [main, student] = [&self.main, &self.student].map(|it| it.load(Ordering::Relaxed));
        let is_sealed = student >= SEALED && main == student;
        (!is_sealed).then(|| {
            format!("filters: {student} of the student's thread, {main} of the main thread")
        })
    }
}

/// The launcher applies two filters, a thread that is sealed two more.
const SEALED: u64 = 4;

/// The value of a line of the file `status` in a folder of `/proc`.
fn status(folder: &Path, name: &str) -> Option<String> {
    let text = std::fs::read_to_string(folder.join("status")).ok()?;
    let mut lines = text.lines();
    let value = lines.find_map(|line| line.strip_prefix(name)?.strip_prefix(':'))?;
    Some(value.trim().to_string())
}
