//! Workers of many versions of a stage, built in a workspace as small as cargo takes.

use authoring::mutants::corpus::Sources;
use authoring::mutants::versions_crate::{VERSION_VARIABLE, worker, worker_of_stages};
use base::Workspace;
use std::path::{Path, PathBuf};
use std::process::Command;

/// A workspace with one stage, whose worker prints what the stage's function returns.
const FILES: [(&str, &str); 7] = [
    ("stages/course.toml", ""),
    ("Cargo.lock", "version = 4\n"),
    (
        "Cargo.toml",
        "[workspace]\nresolver = \"3\"\n[workspace.package]\nversion = \"0.1.0\"\nedition = \"2024\"\n\
         [workspace.dependencies]\nkit = { path = \"stages/kit\" }\nbbox = { path = \"stages/bbox\" }\n",
    ),
    (
        "stages/kit/Cargo.toml",
        "[package]\nname = \"kit\"\nedition = \"2024\"\n",
    ),
    (
        "stages/kit/src/lib.rs",
        "pub struct Aabb;\npub struct Ray;\npub type Interval = &'static str;\n",
    ),
    (
        "grader/worker/Cargo.toml",
        "[package]\nname = \"worker\"\nedition = \"2024\"\n\
         [features]\npart1 = []\npart2 = []\npart3 = []\npart4 = []\npart5 = []\nmeshes = []\n\
         [dependencies]\nkit.workspace = true\nbbox.workspace = true\n",
    ),
    (
        "grader/worker/src/main.rs",
        "fn main() { print!(\"{}\", bbox::intersect_bbox(&kit::Aabb, &kit::Ray).unwrap()); }\n",
    ),
];

/// The stage with a function that returns `text`.
fn version(text: &str) -> Sources {
    let code = format!(
        "use kit::*;\npub fn intersect_bbox(_: &Aabb, _: &Ray) -> Option<Interval> {{ Some({text:?}) }}\n"
    );
    [(PathBuf::from("lib.rs"), code)].into()
}

/// What `worker` prints with the version of this number.
fn says(worker: &Path, number: usize) -> String {
    let output = Command::new(worker)
        .env(VERSION_VARIABLE, number.to_string())
        .output()
        .expect("it runs");
    String::from_utf8(output.stdout).expect("it is UTF-8")
}

/// The jobs of a task and of all tasks have versions of the same stage, and the sources of the
/// first are older than the worker of the second.
#[test]
fn a_job_has_its_own_versions_after_another_job_was_built() {
    let folder = tempfile::tempdir().expect("a folder");
    for (path, text) in FILES {
        let path = folder.path().join(path);
        std::fs::create_dir_all(path.parent().expect("a folder")).expect("a folder");
        std::fs::write(path, text).expect("it is writable");
    }
    let workspace = Workspace::of_any_version(folder.path()).expect("a workspace");
    let of_task = ["reference", "a mistake", "another mistake"].map(version);
    let of_all = ["reference", "no solution"].map(version);
    for _ in 0..2 {
        let task = worker(&workspace, "bbox", &of_task).expect("it compiles");
        let said = [0, 1, 2].map(|number| says(&task, number));
        assert_eq!(said, ["reference", "a mistake", "another mistake"]);
        let stages = [("bbox", of_all.to_vec())];
        let all = worker_of_stages(&workspace, "all", &stages).expect("it compiles");
        let said = [0, 1].map(|number| says(&all, number));
        assert_eq!(said, ["reference", "no solution"]);
    }
}
