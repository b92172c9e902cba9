//! Which crate may depend on which, and how much `grader part1` compiles.

use cargo_metadata::{DependencyKind, MetadataCommand};
use std::collections::{BTreeMap, BTreeSet};
use std::process::Command;

/// What each crate of ours may depend on (tests and benches apart). A crate that is not listed
/// fails the test.
const MAY_DEPEND_ON: &[(&str, &[&str])] = &[
    ("kit", &[]),
    ("raygen", &["kit"]),
    ("intersect", &["kit"]),
    ("bbox", &["kit"]),
    ("bvh", &["kit"]),
    ("direct", &["kit"]),
    ("global", &["kit"]),
    ("adaptive", &["kit"]),
    // The arithmetic of Part 6 at any width. A stage of Parts 1 to 5 computes with plain `f64`.
    ("lanes", &["kit"]),
    ("simd_bvh", &["kit", "lanes"]),
    ("simd_paths", &["kit", "lanes"]),
    // Its benchmarks use the stages, and nothing depends on it.
    ("book", &["base", "kit"]),
    ("meshes", &["kit"]),
    ("scenes", &["kit", "meshes"]),
    ("showcase", &["base", "kit", "meshes", "bvh"]),
    ("picture_files", &[]),
    (
        "pathtracer",
        &[
            // How a program prints, and shows how far it is.
            "base",
            "progress",
            "kit",
            "picture_files",
            "scenes",
            "raygen",
            "intersect",
            "bbox",
            "bvh",
            "direct",
            "global",
            "adaptive",
            "simd_bvh",
            "simd_paths",
        ],
    ),
    (
        "viewer",
        &[
            "base",
            "kit",
            "pathtracer",
            "picture_files",
            "scenes",
            "raygen",
            "intersect",
            "bbox",
            "judge",
            "oracle",
            "pictures",
            "wire",
            // What the stages answer to a case of a report.
            "driver",
            "worker",
        ],
    ),
    ("damage", &[]),
    ("timings", &[]),
    ("wire", &[]),
    ("sandbox", &[]),
    ("harness", &["kit", "sandbox", "wire"]),
    ("driver", &["harness", "kit", "meshes", "wire"]),
    (
        "worker",
        &[
            "driver",
            "kit",
            "wire",
            "harness",
            "raygen",
            "intersect",
            "bbox",
            "bvh",
            "direct",
            "global",
            "adaptive",
        ],
    ),
    ("kernels", &["kit", "lanes"]),
    ("statistics", &["kit"]),
    ("oracle", &["kit"]),
    ("judge", &["kit", "meshes", "oracle", "statistics", "wire"]),
    ("pictures", &["judge", "kit", "wire"]),
    ("base", &[]),
    (
        "grader",
        &["base", "kit", "judge", "oracle", "pictures", "wire"],
    ),
    ("pages", &["base", "pictures"]),
    (
        "preview",
        &[
            "base", "grader", "judge", "kit", "pictures", "scenes", "wire",
        ],
    ),
    ("plots", &["base", "pages", "pictures"]),
    // It links indicatif, which `grader part1` does not compile.
    ("progress", &["base"]),
    ("files", &["base"]),
    ("formats", &["base", "grader", "judge"]),
    (
        "submission",
        &["base", "files", "formats", "grader", "judge", "sandbox"],
    ),
    ("export", &["base", "files", "grader", "handout", "judge"]),
    (
        "look",
        &[
            "base", "kit", "grader", "judge", "oracle", "pages", "pictures", "wire",
        ],
    ),
    (
        "review",
        &[
            "base",
            "grader",
            "judge",
            "look",
            "pages",
            "pictures",
            "submission",
            "wire",
        ],
    ),
    ("handout", &["base", "files", "grader", "judge", "pictures"]),
    (
        "authoring",
        &[
            "base",
            "files",
            "kit",
            "grader",
            "handout",
            "judge",
            "pictures",
            "progress",
            "submission",
            "wire",
        ],
    ),
    (
        "class",
        &[
            "base",
            "files",
            "grader",
            "judge",
            "pages",
            "pictures",
            "submission",
        ],
    ),
    (
        "cost",
        &[
            "base", "kit", "grader", "judge", "kernels", "meshes", "oracle", "pages", "pictures",
            "plots", "progress", "wire",
        ],
    ),
    // It measures the stages side by side and judges nothing.
    (
        "speedup",
        &[
            "base",
            "kit",
            "intersect",
            "bbox",
            "bvh",
            "simd_bvh",
            "grader",
            "judge",
            "kernels",
            "meshes",
            "plots",
            "progress",
        ],
    ),
    ("golden", &[]),
    ("schemas", &[]),
];

#[test]
fn no_crate_depends_on_more_than_it_may() {
    let metadata = MetadataCommand::new()
        .no_deps()
        .exec()
        .expect("cargo metadata runs");
    let ours: BTreeSet<&str> = metadata
        .packages
        .iter()
        .map(|package| package.name.as_str())
        .collect();
    let may_depend_on: BTreeMap<&str, BTreeSet<&str>> = MAY_DEPEND_ON
        .iter()
        .map(|(name, known)| (*name, known.iter().copied().collect()))
        .collect();
    for package in &metadata.packages {
        let name = package.name.as_str();
        let allowed = may_depend_on
            .get(name)
            .unwrap_or_else(|| panic!("`{name}` is not listed in MAY_DEPEND_ON"));
        let normal = package
            .dependencies
            .iter()
            .filter(|dependency| dependency.kind == DependencyKind::Normal);
        for dependency in normal.filter(|dependency| ours.contains(dependency.name.as_str())) {
            assert!(
                allowed.contains(dependency.name.as_str()),
                "`{name}` may not depend on `{}`: a stage imports only `kit`, in Part 6 also `lanes`, and the crates that judge never link a stage",
                dependency.name
            );
        }
    }
}

/// Crates from the registry that `grader part1` may compile, on Linux: a student waits for them.
const REGISTRY_BUDGET: usize = 70;

/// The crates that cargo compiles for some packages, with the features that the arguments select:
/// ours have their folder in the text.
fn compiled(packages: &[&[&str]]) -> BTreeSet<String> {
    let trees = packages.iter().map(|package| tree(package, "{p}"));
    trees.flatten().collect()
}

/// The lines that `cargo tree` prints about the crates that are compiled for a package.
fn tree(package: &[&str], format: &str) -> BTreeSet<String> {
    let output = Command::new(env!("CARGO"))
        .args([
            "tree",
            // In CI, `CARGO_TERM_COLOR` may say otherwise.
            "--color",
            "never",
            "--prefix",
            "none",
            "--edges",
            "normal,build",
        ])
        .args(["--target", "x86_64-unknown-linux-gnu", "--format", format])
        .args(package)
        .output()
        .expect("cargo tree runs");
    assert!(
        output.status.success(),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
    let text = String::from_utf8(output.stdout).expect("package names are UTF-8");
    text.lines()
        .map(|line| line.trim_end_matches(" (*)").to_string())
        .collect()
}

/// What a student compiles for `grader part1`: the grader, and the worker with the stages of Part
/// 1.
const FIRST_BUILD: &[&[&str]] = &[
    &["--package", "grader"],
    &[
        "--package",
        "worker",
        "--no-default-features",
        "--features",
        "part1",
    ],
];

fn of_registry(compiled: &BTreeSet<String>) -> BTreeSet<&str> {
    let ours = |package: &&str| package.contains("(/");
    let all = compiled.iter().map(String::as_str);
    all.filter(|package| !ours(package)).collect()
}

#[test]
fn a_students_first_build_stays_within_its_budget() {
    let compiled = compiled(FIRST_BUILD);
    assert!(
        !compiled.iter().any(|package| package.starts_with("lanes ")),
        "`grader part1` compiles `lanes`, which only Part 6 and `grader cost` need"
    );
    let compiled = of_registry(&compiled);
    assert!(
        compiled.len() > 20,
        "cargo tree prints something else: {compiled:?}"
    );
    assert!(
        compiled.len() <= REGISTRY_BUDGET,
        "`grader part1` compiles {} crates from the registry, its budget is {REGISTRY_BUDGET}: {compiled:?}",
        compiled.len()
    );
    for forbidden in ["clap_derive", "image", "rayon-core"] {
        let name = format!("{forbidden} ");
        assert!(
            !compiled.iter().any(|package| package.starts_with(&name)),
            "`grader part1` compiles {forbidden}, which grading does not need"
        );
    }
}

/// The page of `grader look` costs a student no libraries but the one that writes pictures into it.
#[test]
fn look_compiles_nothing_that_the_first_report_did_not() {
    let first = compiled(FIRST_BUILD);
    let look = compiled(&[&["--package", "look"]]);
    let more: Vec<&str> = of_registry(&look)
        .difference(&of_registry(&first))
        .copied()
        .collect();
    assert!(
        more.len() <= 1 && more.iter().all(|package| package.starts_with("base64 ")),
        "`grader look` compiles {more:?}, which `grader part1` does not"
    );
}

/// A library with other features is another library to cargo, and all above it is compiled again:
/// the whole grader, if it is one of these.
#[test]
fn no_command_of_the_grader_compiles_the_grader_again() {
    let with_features = |package: &[&str]| tree(package, "{p} {f}");
    let grader = with_features(&["--package", "grader"]);
    for program in [
        "authoring",
        "class",
        "export",
        "formats",
        "handout",
        "look",
        "preview",
        "review",
        "submission",
    ] {
        let other = with_features(&["--package", program]);
        let again: Vec<&String> = grader.difference(&other).collect();
        assert!(
            again.is_empty(),
            "{program} has other features of {again:?}: name the libraries in grader/Cargo.toml"
        );
    }
    // This one does not link the grader, and is built beside it.
    let beside = with_features(&["--package", "grader", "--package", "book"]);
    let again: Vec<&String> = grader.difference(&beside).collect();
    assert!(again.is_empty(), "book has other features of {again:?}");
    let [_, part1] = FIRST_BUILD else {
        panic!("the grader and the worker")
    };
    let worker = with_features(part1);
    let name = |package: &str| package.split(" v").next().unwrap_or(package).to_string();
    let shared: BTreeSet<String> = worker.iter().map(|package| name(package)).collect();
    let of_worker = |package: &&String| shared.contains(&name(package));
    let again: Vec<&String> = grader.iter().filter(of_worker).collect();
    let again: Vec<&&String> = again.iter().filter(|of| !worker.contains(**of)).collect();
    assert!(
        shared.len() > 10 && again.is_empty(),
        "the worker has other features of {again:?}: name the libraries in grader/wire/Cargo.toml"
    );
}

/// `x - 1` at x = 0 panics in a stage. Generic functions, such as `raytrace_pixel`, are compiled
/// with the worker, and would wrap in silence without its own line. Where the library panics,
/// tables of lines lead to the student's line that called it (`harness::caller`).
#[test]
fn overflow_is_checked_and_lines_are_known_wherever_code_of_a_stage_is_compiled() {
    let root = concat!(env!("CARGO_MANIFEST_DIR"), "/..");
    let read = |file: &str| -> toml::Table {
        let text = std::fs::read_to_string(format!("{root}/{file}")).expect("a file");
        text.parse().expect("TOML")
    };
    let course = grader::course::Course::parse(&read("stages/course.toml").to_string());
    let course = course.expect("the course is valid");
    let manifest = read("Cargo.toml");
    let packages = &manifest["profile"]["release"]["package"];
    for package in course.stages().into_iter().chain(["worker"]) {
        let rules = &packages[package];
        assert_eq!(rules["overflow-checks"].as_bool(), Some(true), "{package}");
        let debug = rules["debug"].as_str();
        assert_eq!(debug, Some("line-tables-only"), "{package}");
    }
}
