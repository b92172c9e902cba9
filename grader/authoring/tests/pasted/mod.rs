//! What a handout contains is no solution: functions of its own sources, pasted into a stage and
//! called from the holes, earn nothing.
//!
//! [`items`] finds the functions with all that they need, [`glue`] calls them by their types. The
//! fast tests look at the text; the slow one compiles every attempt and grades it.

mod glue;
mod items;

use crate::handouts::handout;
use authoring::mutants::corpus::Mutant;
use authoring::mutants::run;
use base::Workspace;
use glue::{Hole, PRELUDE, calls, constants, conversions, qualified};
use grader::course::{Course, Task};
use items::{Function, Sources};
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use submission::file_tree::{self, Files};

fn workspace() -> Workspace {
    Workspace::above(Path::new(env!("CARGO_MANIFEST_DIR"))).expect("the grader is in the course")
}

fn course() -> Course {
    Course::read(&workspace()).expect("the course is valid")
}

/// The tasks whose truth is a formula, each with expressions of it and of other code that computes
/// the same, without blanks. What a handout has in their place are results.
const FORMULAS: &[(&str, &[&str])] = &[
    (
        "part1.task2",
        &[
            "(2.0*sensor[0]-1.0)*half_tan(camera.h_fov)",
            "(f64::from(x)+0.5)/w-1.0)*half_w",
            "c2w.x_axis*half_w",
        ],
    ),
    ("part2.task1", &["ids.sort_by_key(|&id|morton_code"]),
    (
        "part3.task1",
        &["rho/PI", "cosine/PI", "wi.abs()/PI", "FRAC_1_PI"],
    ),
    (
        "part4.task1",
        &[
            "(n-1.0)*(n+1.0)+cos*cos",
            "c*together-1.0",
            "-wo[0]/self.n",
            "[-wo[0],-wo[1],wo[2]]",
        ],
    ),
    (
        "part4.task2",
        &["goes_on(&path.steps[i-1])", "self.sent(path"],
    ),
    ("part4.task3", &["brightest.min(1.0)", "channel/chance"]),
    (
        "part5.task1",
        &[
            "n*wanted*wanted>=",
            "(variance/n).sqrt()/mean",
            "is_multiple_of(work.batch",
        ],
    ),
    ("part5.task2", &["samples.count()>=MIN_SAMPLES"]),
];

/// Whether the judge, the worker and what they use have the file. Stages are what students write,
/// or the reference of earlier parts.
fn is_graders(path: &Path) -> bool {
    path.starts_with("grader")
}

fn part_of(key: &str) -> u32 {
    let number = key
        .strip_prefix("part")
        .and_then(|rest| rest.split('.').next());
    number
        .and_then(|number| number.parse().ok())
        .expect("a key of a task")
}

fn without_blanks(contents: &[u8]) -> String {
    let text = String::from_utf8_lossy(contents);
    let code = text
        .lines()
        .map(|line| line.split("//").next().unwrap_or_default());
    code.flat_map(|line| line.chars().filter(|c| !c.is_whitespace()))
        .collect()
}

/// The Rust files of the judge and the worker, with their formulas.
fn full_sources() -> Files {
    let root = workspace().root().to_path_buf();
    let paths = file_tree::workspace_paths(&root).expect("they can be listed");
    let is_read = |path: &std::path::PathBuf| {
        is_graders(path)
            && path.iter().any(|name| name == "src")
            && path.extension().is_some_and(|e| e == "rs")
    };
    let of_grader = paths.into_iter().filter(is_read);
    of_grader
        .map(|path| {
            (
                path.clone(),
                file_tree::read(&root, &path).expect("it can be read"),
            )
        })
        .collect()
}

/// The formulas of the tasks from `part` on that `files` contain.
fn formulas_in(files: &Files, part: u32) -> BTreeSet<String> {
    let mut found = BTreeSet::new();
    let rust = files
        .iter()
        .filter(|(path, _)| is_graders(path) && path.extension().is_some_and(|e| e == "rs"));
    for (path, contents) in rust {
        // What draws plots computes areas of circles.
        if path.starts_with("grader/plots") || path.starts_with("grader/cost") {
            continue;
        }
        let code = without_blanks(contents);
        for (key, formulas) in FORMULAS.iter().filter(|(key, _)| part_of(key) >= part) {
            let here = formulas.iter().filter(|formula| code.contains(**formula));
            found.extend(here.map(|formula| format!("{key}: {formula} in {}", path.display())));
            // A result that passes through `record` was computed here.
            if code.contains(&format!("packed_truth::record(\"{key}\"")) {
                found.insert(format!("{key}: a recorded result in {}", path.display()));
            }
        }
    }
    found
}

#[test]
fn no_handout_contains_a_formula_of_its_tasks() {
    for part in 1..=5 {
        let found = formulas_in(&handout(part).files, part as u32);
        assert_eq!(found, BTreeSet::new(), "part {part}");
    }
}

/// The list follows the code: each formula is still in the full checkout.
#[test]
fn each_listed_formula_is_in_the_course() {
    let found = formulas_in(&full_sources(), 1);
    for (key, formulas) in FORMULAS {
        for formula in *formulas {
            let start = format!("{key}: {formula} in ");
            assert!(
                found.iter().any(|found| found.starts_with(&start)),
                "{start}"
            );
        }
        let recorded = format!("{key}: a recorded result");
        assert!(
            found.iter().any(|found| found.starts_with(&recorded)),
            "{key}"
        );
    }
}

#[test]
fn a_formula_that_is_put_back_is_found() {
    let path = "grader/judge/src/tasks/part5_task2/truth.rs";
    let mut files = handout(5).files.clone();
    let full = full_sources()
        .remove(Path::new(path))
        .expect("the file is there");
    files.insert(path.into(), full);
    let found = formulas_in(&files, 5);
    assert_eq!(found.len(), 2, "{found:?}");
}

/// The handouts of the tasks of a part have their results, those of later parts their formulas.
#[test]
fn a_handout_has_a_table_for_the_formulas_that_it_lacks() {
    let mut last = usize::MAX;
    for part in 1..=5 {
        let table = handout(part)
            .files
            .get(Path::new(judge::packed_truth::FILE));
        let bytes = table.expect("a table").len();
        assert!(
            bytes <= last && bytes < 1_000_000,
            "part {part}: {bytes} bytes"
        );
        last = bytes;
    }
    let file = |part: usize, path: &str| {
        let contents = handout(part)
            .files
            .get(Path::new(path))
            .expect("the file is there");
        without_blanks(contents)
    };
    let camera = "grader/judge/src/tasks/part1_task2/truth.rs";
    assert!(file(1, camera).contains("packed_truth::find"));
    assert!(file(2, camera).contains("half_tan(camera.h_fov)"));
}

/// The signature of a function of `task`.
fn hole_of(task: &Task, stage: &Sources, name: &str) -> Hole {
    let is_it = |function: &&Function| function.path == name;
    let function = stage
        .functions
        .iter()
        .find(is_it)
        .unwrap_or_else(|| panic!("{}: no {name}", task.key));
    Hole {
        name: name.to_string(),
        parameters: function.parameters.clone(),
        returns: function.returns.clone(),
    }
}

/// The stage of `task` as written by somebody who only pastes: `hole` calls a pasted function, the
/// other functions of the task are holes.
fn pasted_stage(task: &Task, holes: &[Hole], hole: &Hole, items: &str, call: &str) -> String {
    let mut text = String::from("use kit::*;\npub use base::*;\n");
    let signature = |hole: &Hole| {
        let each = hole
            .parameters
            .iter()
            .map(|(name, of)| format!("{name}: {}", qualified(of)));
        let generic = hole.parameters.iter().any(|(_, of)| of == "&mut W");
        let generic = if generic { "<W: kit::World>" } else { "" };
        let parameters = each.collect::<Vec<_>>().join(", ");
        format!("{generic}({parameters}) -> {}", qualified(&hole.returns))
    };
    for other in holes.iter().filter(|other| other.name != hole.name) {
        text.push_str(&format!(
            "pub fn {}{} {{ kit::hole!(\"{}\") }}\n",
            other.name,
            signature(other),
            task.key
        ));
    }
    text.push_str(&format!(
        "pub use pasted::the_hole as {};\npub mod pasted {{\n{PRELUDE}\n{}\n{items}\npub fn the_hole{} {{\n    {call}\n}}\n}}\n",
        hole.name,
        conversions(items),
        signature(hole),
    ));
    text
}

/// Every way to call a function of `sources` from a hole of `task`.
fn attempts(task: &Task, sources: &Sources, stage: &Sources) -> Vec<Mutant> {
    let holes: Vec<Hole> = task
        .holes
        .iter()
        .map(|name| hole_of(task, stage, name))
        .collect();
    let mut attempts = Vec::new();
    for hole in &holes {
        for function in &sources.functions {
            let calls = calls(hole, function, sources.has_unit_self(function));
            if calls.is_empty() {
                continue;
            }
            let Some(items) = sources.pasted(function) else {
                continue;
            };
            for (number, call) in calls.iter().enumerate() {
                attempts.push(Mutant {
                    mistakes: vec![format!(
                        "{} by {} of {}",
                        hole.name, function.path, function.file
                    )],
                    on: "pasted".into(),
                    how: number.to_string(),
                    code: Some(pasted_stage(task, &holes, hole, &items, call)),
                    ..Mutant::default()
                });
            }
        }
    }
    attempts
}

/// The functions of the stage of `task`, in the course's checkout.
fn stage_of(task: &Task) -> Sources {
    let root = workspace().root().to_path_buf();
    let folder = Path::new("stages").join(&task.stage).join("src");
    let paths = file_tree::workspace_paths(&root).expect("they can be listed");
    let of_stage = paths.into_iter().filter(|path| path.starts_with(&folder));
    let files: Files = of_stage
        .map(|path| {
            (
                path.clone(),
                file_tree::read(&root, &path).expect("it can be read"),
            )
        })
        .collect();
    Sources::of(&files, |_| true)
}

/// The names of the attempts at `task` that `sources` offer.
fn names(course: &Course, task: &str, sources: &Sources) -> BTreeSet<String> {
    let task = course
        .tasks()
        .find(|other| other.key == task)
        .expect("it is in the course");
    let attempts = attempts(task, sources, &stage_of(task)).into_iter();
    attempts
        .map(|attempt| attempt.mistakes[0].clone())
        .collect()
}

/// The attempt finds the formulas where they are: in the course's own checkout.
#[test]
fn the_attempt_finds_the_formulas_of_the_course() {
    let (course, sources) = (course(), Sources::of(&full_sources(), is_graders));
    for (task, attempt) in [
        (
            "part1.task2",
            "generate_ray by direction of grader/judge/src/tasks/part1_task2/truth.rs",
        ),
        (
            "part3.task1",
            "lambert_f by right of grader/judge/src/tasks/part3_task1/truth.rs",
        ),
        (
            "part3.task1",
            "lambert_pdf by right of grader/judge/src/tasks/part3_task1/truth.rs",
        ),
        (
            "part4.task1",
            "fresnel_dielectric by computed of grader/judge/src/tasks/part4_task1/truth.rs",
        ),
        (
            "part4.task1",
            "refract by computed of grader/judge/src/tasks/part4_task1/truth.rs",
        ),
        (
            "part4.task1",
            "glass_sample by right of grader/judge/src/tasks/part4_task1/truth.rs",
        ),
        (
            "part4.task3",
            "play_roulette by survival of grader/judge/src/tasks/part4_task3/truth.rs",
        ),
        (
            "part5.task1",
            "has_converged by is_narrow of grader/judge/src/tasks/part5_task1/truth.rs",
        ),
        (
            "part5.task2",
            "has_surely_converged by plain_decides of grader/judge/src/tasks/part5_task2/truth.rs",
        ),
    ] {
        let found = names(&course, task, &sources);
        assert!(found.contains(attempt), "{attempt}: {found:#?}");
    }
}

/// The tasks whose formulas have the form of a hole: pasted from the course's checkout, they earn.
const EARNS_WITH_ITS_FORMULA: [&str; 6] = [
    "part1.task2",
    "part3.task1",
    "part4.task1",
    "part4.task3",
    "part5.task1",
    "part5.task2",
];

/// Begins the names of attempts with a formula that handouts do not have.
const WITH_FORMULA: &str = "with its formula: ";

/// Begins the names of attempts that paste nothing.
const CONSTANT: &str = "a constant";

/// The attempts at each hole of `task` that return a constant.
fn constant_attempts(task: &Task, stage: &Sources) -> Vec<Mutant> {
    let holes: Vec<Hole> = task
        .holes
        .iter()
        .map(|name| hole_of(task, stage, name))
        .collect();
    let of_hole = |hole: &Hole| {
        let each = constants(hole).into_iter().enumerate();
        let attempts = each.map(|(number, value)| Mutant {
            mistakes: vec![format!("{} by {CONSTANT}", hole.name)],
            on: "pasted".into(),
            how: number.to_string(),
            code: Some(pasted_stage(task, &holes, hole, "", &value)),
            ..Mutant::default()
        });
        attempts.collect::<Vec<_>>()
    };
    holes.iter().flat_map(of_hole).collect()
}

/// The attempts at `task` on the sources of each handout that has its holes, and, to test the test,
/// on the file of the course with its formula.
fn all_attempts(task: &Task) -> Vec<Mutant> {
    let stage = stage_of(task);
    let mut all = constant_attempts(task, &stage);
    let mut texts = BTreeSet::new();
    for part in 1..=part_of(&task.key) as usize {
        let handout = handout(part);
        let is_read = |path: &Path| {
            !handout.reference_files.contains(path)
                && path.iter().any(|name| name == "src")
                && !path.starts_with(Path::new("stages").join(&task.stage))
        };
        let of_handout = attempts(task, &Sources::of(&handout.files, is_read), &stage);
        all.extend(
            of_handout
                .into_iter()
                .filter(|one| texts.insert(one.code.clone())),
        );
    }
    let folder = Path::new("grader/judge/src/tasks").join(task.key.replace('.', "_"));
    let is_formula = |path: &Path| {
        path == folder.join("truth.rs")
            || path.starts_with("grader/wire")
            || path.ends_with("tools/kinds/stopping.rs")
            || path.ends_with("tools/tier.rs")
    };
    let of_course = attempts(task, &Sources::of(&full_sources(), is_formula), &stage);
    let of_formula = of_course.into_iter().map(|mut attempt| {
        attempt.mistakes[0].insert_str(0, WITH_FORMULA);
        attempt
    });
    all.extend(of_formula.filter(|one| one.mistakes[0].contains("truth.rs")));
    all
}

/// Functions that may earn something, since they stand in the stub of a hole or are a small part of
/// what the task is about: the task, the function, and why.
const GIVEN: &[(&str, &str, &str)] = &[
    (
        "part2.task1",
        "Bvh::one_leaf of stages/kit/src/bvh.rs",
        "it is the stub: a tree of one leaf, with which all primitives are tested; it shows no idea of the task",
    ),
    (
        "part2.task2",
        "span of grader/judge/src/tools/questions/crosses.rs",
        "it is about rays along an axis: one division, without the three pairs of planes that the task is about",
    ),
];

/// Points are sums of shares of cases.
const ROUNDING: f64 = 1e-6;

/// Compiles and grades every attempt at every task of every handout, and prints what each earns.
/// `FIRSTLIGHT_TASK=part1.task2` is about one task.
#[test]
#[ignore = "compiles hundreds of attempts: minutes"]
fn functions_of_a_handout_earn_nothing() {
    let (workspace, course) = (workspace(), course());
    let only = std::env::var("FIRSTLIGHT_TASK").ok();
    let (mut earned, mut lacks) = (Vec::new(), Vec::new());
    for task in course.tasks() {
        let all = match &only {
            Some(only) if *only != task.key => continue,
            _ => all_attempts(task),
        };
        println!("{}: {} attempts", task.key, all.len());
        let graded = match all.is_empty() {
            true => Vec::new(),
            false => run::unlisted(&workspace, &course, task, all).expect("the reference compiles"),
        };
        // The glue alone earns something: an origin and a range beside a direction.
        let hole = |name: &str| {
            let name = name.strip_prefix(WITH_FORMULA).unwrap_or(name);
            name.split(' ').next().unwrap_or_default().to_string()
        };
        let mut for_nothing: BTreeMap<String, f64> = BTreeMap::new();
        for constant in graded
            .iter()
            .filter(|graded| graded.name.contains(CONSTANT))
        {
            let most = for_nothing.entry(hole(&constant.name)).or_default();
            *most = most.max(constant.result.score);
        }
        let mut formula_earns = false;
        for graded in graded
            .iter()
            .filter(|graded| !graded.name.contains(CONSTANT))
        {
            let result = &graded.result;
            let free = for_nothing
                .get(&hole(&graded.name))
                .copied()
                .unwrap_or_default();
            let row = format!(
                "{}: {:.2}+{:.2} by {} (a constant: {free:.2})",
                task.key, result.score, result.robust_score, graded.name
            );
            println!("  {row}");
            let earns = result.score > free + ROUNDING || result.robust_score > 0.0;
            match graded.name.starts_with(WITH_FORMULA) {
                true => formula_earns |= earns,
                false if earns => {
                    let is_given = |(key, function, _): &&(&str, &str, &str)| {
                        *key == task.key && graded.name.contains(function)
                    };
                    match GIVEN.iter().find(is_given) {
                        Some((_, _, why)) => println!("    given: {why}"),
                        None => earned.push(row),
                    }
                }
                false => {}
            }
        }
        if EARNS_WITH_ITS_FORMULA.contains(&task.key.as_str()) && !formula_earns {
            lacks.push(&task.key);
        }
    }
    assert!(earned.is_empty(), "{}", earned.join("\n"));
    assert!(
        lacks.is_empty(),
        "the formula itself earns nothing: {lacks:?}"
    );
}
