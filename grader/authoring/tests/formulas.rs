//! Where truth is a formula in `f64`, a handout has its results and not the formula.

use crate::handouts::handout;
use base::Workspace;
use files::file_tree::{self, Files};
use std::collections::BTreeSet;
use std::ops::RangeInclusive;
use std::path::Path;

fn workspace() -> Workspace {
    Workspace::above(Path::new(env!("CARGO_MANIFEST_DIR"))).expect("the grader is in the course")
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
    ("part2.task1", &["ids.sort_by_cached_key(|&id|morton_code"]),
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

/// A formula outside its markers is in the handouts of all parts.
#[test]
fn no_handout_contains_a_formula_of_its_tasks() {
    handouts_have_results_and_no_formula(1..=2);
}

/// A formula within the markers of an earlier part is in the handouts of the parts between alone.
#[test]
#[ignore = "carves three more handouts: 15 s of CPU"]
fn no_later_handout_contains_a_formula_of_its_tasks() {
    handouts_have_results_and_no_formula(1..=5);
}

/// Each handout also has a table of results. Those of later parts have the formulas of earlier
/// ones.
fn handouts_have_results_and_no_formula(parts: RangeInclusive<usize>) {
    let mut last = usize::MAX;
    for part in parts {
        let files = &handout(part).files;
        let found = formulas_in(files, part as u32);
        assert_eq!(found, BTreeSet::new(), "part {part}");
        let table = files.get(Path::new(judge::packed_truth::FILE));
        let bytes = table.expect("a table").len();
        assert!(
            bytes <= last && bytes < 1_000_000,
            "part {part}: {bytes} bytes"
        );
        last = bytes;
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
    let mut files = handout(1).files.clone();
    let full = full_sources()
        .remove(Path::new(path))
        .expect("the file is there");
    files.insert(path.into(), full);
    let found = formulas_in(&files, 5);
    assert_eq!(found.len(), 2, "{found:?}");
}

#[test]
fn a_handout_has_stubs_for_the_formulas_that_it_lacks() {
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
