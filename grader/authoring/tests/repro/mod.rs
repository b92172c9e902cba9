//! Tests the Rust tests in a report. For every case that has them, tests of several calls must pass
//! on the reference and, if the case is worth core points, on every correct variant. On code with a
//! mistake in it the test of a wrong answer must fail.
//!
//! All versions of a stage are modules of one crate, and all tests are compiled once for it.

mod mistakes;

use authoring::mutants::run::{Kind, versions};
use authoring::mutants::versions_crate::{StageVersions, VERSION_VARIABLE, write_versions};
use base::Workspace;
use grader::course::{Course, Task};
use judge::Tier;
use judge::cases::{self, Spec};
use judge::repro;
use mistakes::{REPRODUCTIONS, Reproduction};
use std::collections::BTreeMap;
use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::process::Command;

/// How many calls of a case are tested, evenly spread.
const CALLS: usize = 3;

/// A crate with all versions of a stage, and with tests.
struct StageJob {
    stage: String,
    /// The names of the versions; the first `correct` have no mistake.
    names: Vec<String>,
    correct: usize,
    /// For each mistake the test that must fail on it.
    failing: Vec<String>,
    /// The number of tests, and how many of them are about core points.
    tests: usize,
    core_tests: usize,
}

/// The name of the module with the tests of a task at a tier.
fn module(task: &str, tier: Tier) -> String {
    let tier = match tier {
        Tier::Core => "core",
        Tier::Robust => "robust",
    };
    format!("{tier}_{}", task.replace('.', "_"))
}

/// The tests of some calls of a case, by the number of the call.
fn tests_of(spec: &Spec, tier: Tier) -> BTreeMap<usize, String> {
    let calls = judge::calls(&spec.work);
    let mut tests = BTreeMap::new();
    for i in 0..CALLS {
        // Where a call has no test, because several answers are right, the next one may have one.
        let from = i * calls / CALLS;
        let until = calls.min(from + 50);
        let found = (from..until).find_map(|call| Some((call, repro::test(spec, tier, call)?)));
        tests.extend(found);
    }
    tests
}

/// Writes the crate of a stage.
fn write_job(workspace: &Workspace, stage: &str, tasks: &[&Task], folder: &Path) -> StageJob {
    let specs = cases::all(0);
    let mut modules: BTreeMap<String, BTreeMap<String, String>> = BTreeMap::new();
    for task in tasks {
        for entry in &task.cases {
            let spec = specs
                .iter()
                .find(|spec| spec.is(&task.key, &entry.name))
                .expect("the case is there");
            let tests = modules.entry(module(&task.key, entry.tier)).or_default();
            for (call, test) in tests_of(spec, entry.tier) {
                tests.insert(format!("{}_{call}", entry.name), test);
            }
        }
    }
    let of_stage: Vec<&Reproduction> = REPRODUCTIONS
        .iter()
        .filter(|reproduction| reproduction.stage == stage)
        .collect();
    let mut failing = Vec::new();
    for reproduction in &of_stage {
        let (call, test) = reproduction.test(&specs);
        let task = tasks.iter().find(|task| task.key == reproduction.task);
        let entries = task.into_iter().flat_map(|task| &task.cases);
        let mut tiers = entries.filter(|entry| entry.name == reproduction.case);
        let tier = tiers.next().expect("the case is listed").tier;
        let (module, name) = (
            module(reproduction.task, tier),
            format!("{}_{call}", reproduction.case),
        );
        failing.push(format!("{module}::{name}"));
        modules.entry(module).or_default().insert(name, test);
    }
    let mutants = of_stage.iter().map(|reproduction| reproduction.mutant());
    let (names, sources) = versions(workspace, tasks[0], mutants.collect()).expect("the edits fit");
    write_versions(folder, &StageVersions::only(stage, &sources))
        .expect("the folder can be written");
    let mut file = String::from("//! Tests of a report.\n");
    for (module, tests) in &modules {
        let _ = writeln!(file, "\nmod {module} {{");
        tests.values().for_each(|test| file.push_str(test));
        file.push_str("}\n");
    }
    write(&folder.join("tests/worst.rs"), &file);
    let is_correct = |(_, kind): &&(String, Kind)| matches!(kind, Kind::Correct);
    let of_core = modules.iter().filter(|(name, _)| name.starts_with("core_"));
    StageJob {
        stage: stage.into(),
        correct: names.iter().filter(is_correct).count(),
        names: names.into_iter().map(|(name, _)| name).collect(),
        failing,
        tests: modules.values().map(BTreeMap::len).sum(),
        core_tests: of_core.map(|(_, tests)| tests.len()).sum(),
    }
}

fn write(path: &Path, text: &str) {
    if std::fs::read_to_string(path).is_ok_and(|old| old == text) {
        return;
    }
    let folder = path.parent().expect("a file in a folder");
    std::fs::create_dir_all(folder).expect("the folder can be made");
    std::fs::write(path, text).expect("the file can be written");
}

/// Builds the tests of all stages. Returns the program of each.
fn build(root: &Path, job: &Path, jobs: &[StageJob]) -> BTreeMap<String, PathBuf> {
    let members: Vec<String> = jobs
        .iter()
        .map(|job| format!("\"{}\"", job.stage))
        .collect();
    // The stages are not optimised: the long lists of numbers in the tests of a pixel would take
    // ten times as long to compile.
    let manifest = format!(
        "[workspace]\nresolver = \"3\"\nmembers = [{}]\n\n[workspace.package]\nversion = \"0.1.0\"\nedition = \"2024\"\n\n\
         [workspace.dependencies]\nkit = {{ path = {} }}\n\n[profile.dev]\ndebug = false\n\n\
         [profile.dev.package.kit]\nopt-level = 1\n",
        members.join(", "),
        toml::Value::from(root.join("stages/kit").display().to_string())
    );
    write(&job.join("Cargo.toml"), &manifest);
    std::fs::copy(root.join("Cargo.lock"), job.join("Cargo.lock")).expect("it can be copied");
    let output = Command::new(env!("CARGO"))
        .current_dir(job)
        .args(["test", "--offline", "--no-run", "--test", "worst"])
        .args(["--message-format", "json-render-diagnostics"])
        .arg("--target-dir")
        .arg(root.join("target/repro/target"))
        // Tests in a student's stage must be documented.
        .env("RUSTFLAGS", "-W missing_docs")
        .output()
        .expect("cargo runs");
    let stderr = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{stderr}");
    assert!(!stderr.contains("tests/worst.rs:"), "a warning:\n{stderr}");
    let stdout = String::from_utf8_lossy(&output.stdout);
    let programs = stdout.lines().filter_map(|line| {
        let message: serde_json::Value = serde_json::from_str(line).ok()?;
        let program = PathBuf::from(message.get("executable")?.as_str()?);
        let manifest = PathBuf::from(message.get("manifest_path")?.as_str()?);
        let stage = manifest.parent()?.file_name()?.to_str()?.to_string();
        Some((stage, program))
    });
    programs.collect()
}

/// Runs tests on a version: those whose names contain `filter`, or with `exact` only that one.
/// Returns how many passed, and the output.
fn run(program: &Path, version: usize, filter: &str, exact: bool) -> (usize, String) {
    let output = Command::new(program)
        .arg(filter)
        .args(exact.then_some("--exact"))
        .env(VERSION_VARIABLE, version.to_string())
        .output()
        .expect("the test runs");
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    let passed = text
        .lines()
        .find_map(|line| line.strip_prefix("test result: ")?.split_once(". "))
        .and_then(|(_, counts)| counts.split(' ').next()?.parse().ok());
    (passed.unwrap_or(0), text)
}

#[test]
fn reported_tests_pass_on_correct_code_and_fail_on_the_mistake() {
    check_reported_tests("some", |stage| ["raygen", "bbox"].contains(&stage));
}

#[test]
#[ignore = "compiles the variants of all stages with the tests of reports: 16 s of CPU"]
fn reported_tests_of_every_stage_pass_on_correct_code_and_fail_on_the_mistake() {
    check_reported_tests("all", |_| true);
}

/// Builds and runs the tests of reports on all versions of the stages that are chosen, in a folder
/// with this name.
fn check_reported_tests(name: &str, is_chosen: impl Fn(&str) -> bool) {
    let workspace = Workspace::above(Path::new(env!("CARGO_MANIFEST_DIR"))).expect("the course");
    let course = Course::read(&workspace).expect("the list of tasks");
    let root = workspace.root();
    let folder = root.join("target/repro").join(name);
    let mut tasks: BTreeMap<&str, Vec<&Task>> = BTreeMap::new();
    for task in course.tasks().filter(|task| is_chosen(&task.stage)) {
        tasks.entry(&task.stage).or_default().push(task);
    }
    let jobs: Vec<StageJob> = tasks
        .iter()
        .map(|(stage, tasks)| write_job(&workspace, stage, tasks, &folder.join(stage)))
        .collect();
    let programs = build(root, &folder, &jobs);
    let mut wrong = Vec::new();
    for job in &jobs {
        let program = &programs[&job.stage];
        assert!(job.core_tests > 0, "{} has no tests", job.stage);
        for (version, name) in job.names.iter().enumerate() {
            let here = format!("{} {name}", job.stage);
            if version >= job.correct {
                let test = &job.failing[version - job.correct];
                let (passed, text) = run(program, version, test, true);
                if passed != 0 || !text.contains("1 failed") {
                    wrong.push(format!("{here}: {test} does not fail:\n{text}"));
                }
                continue;
            }
            // Extra credit is for the reference, not for every correct variant.
            let (filter, tests) = match version {
                0 => ("", job.tests),
                _ => ("core_", job.core_tests),
            };
            let (passed, text) = run(program, version, filter, false);
            if passed != tests {
                wrong.push(format!("{here}: {passed} of {tests} tests pass:\n{text}"));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn every_task_whose_calls_have_tests_has_a_mistake_that_fails_one() {
    let specs = cases::all(0);
    for spec in &specs {
        let is_covered = REPRODUCTIONS.iter().any(|known| known.task == spec.task);
        let has_tests = !tests_of(spec, Tier::Core).is_empty();
        assert!(is_covered || !has_tests, "{} {}", spec.task, spec.name);
    }
}
