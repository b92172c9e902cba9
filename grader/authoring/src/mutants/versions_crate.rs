//! Builds many versions of a stage as modules of one crate.
//!
//! Building one worker per mutant would take minutes. So all versions of a stage are modules of one
//! crate, and the environment variable [`VERSION_VARIABLE`] selects the one that its functions
//! call.

use super::corpus::Sources;
use base::{GraderError, Workspace};
use grader::build::{BuildOutcome, BuildRoot, CompileErrors, StageFunction, stage_functions};
use std::collections::BTreeSet;
use std::fmt::Write;
use std::fs::File;
use std::path::{Path, PathBuf};
use tempfile::TempPath;

/// The environment variable with the number of the version to run, counted from 0.
pub const VERSION_VARIABLE: &str = "FIRSTLIGHT_VERSION";

/// A stage and the versions that its crate contains, the reference first.
#[derive(Clone, Copy, Debug)]
pub struct StageVersions<'a> {
    stage: &'a str,
    versions: &'a [Sources],
    /// The number of other stages' versions before its own, references not counted. A number that
    /// is not that of a version here selects the reference.
    before: usize,
}

impl<'a> StageVersions<'a> {
    /// The only stage with versions.
    pub fn only(stage: &'a str, versions: &'a [Sources]) -> StageVersions<'a> {
        StageVersions {
            stage,
            versions,
            before: 0,
        }
    }

    /// The folder of its crate in the folder of `job`.
    ///
    /// Cargo names what it builds by the path of the package *inside* its workspace, and all jobs
    /// build in one target folder. If two jobs had the same path for a stage, cargo would take the
    /// versions of the job that was built last for those of the other.
    fn folder(&self, job: &str) -> String {
        format!("{job}-{}", self.stage)
    }
}

/// Builds a worker whose `stage` contains all `versions`. [`VERSION_VARIABLE`] selects one of them.
/// The other stages are the workspace's own.
pub fn worker(
    workspace: &Workspace,
    stage: &str,
    versions: &[Sources],
) -> Result<TempPath, GraderError> {
    worker_that_compiles(workspace, stage, &[StageVersions::only(stage, versions)])
}

/// As [`worker`], with versions of several stages in one worker, the reference first in each. The
/// number 0 selects the reference in all stages; the other versions are numbered from 1 through all
/// stages.
pub fn worker_of_stages(
    workspace: &Workspace,
    job: &str,
    stages: &[(&str, Vec<Sources>)],
) -> Result<TempPath, GraderError> {
    let mut before = 0;
    let stages: Vec<StageVersions<'_>> = stages
        .iter()
        .map(|(stage, versions)| {
            let stage = StageVersions {
                stage,
                versions,
                before,
            };
            before += versions.len().saturating_sub(1);
            stage
        })
        .collect();
    worker_that_compiles(workspace, job, &stages)
}

fn worker_that_compiles(
    workspace: &Workspace,
    job: &str,
    stages: &[StageVersions<'_>],
) -> Result<TempPath, GraderError> {
    match build(workspace, job, stages)? {
        Ok(program) => Ok(program),
        Err(errors) => Err(GraderError::new(format!(
            "the versions in {} do not compile: correct the mutant or variant that cargo names\n{}",
            job_folder(workspace, job).display(),
            errors.messages
        ))),
    }
}

/// As [`worker`], but versions that do not compile are replaced by the first one, which must
/// compile. Returns their numbers, too.
pub fn worker_of_those_that_compile(
    workspace: &Workspace,
    stage: &str,
    versions: &[Sources],
) -> Result<(TempPath, BTreeSet<usize>), GraderError> {
    let mut versions = versions.to_vec();
    let mut broken = BTreeSet::new();
    loop {
        let only = StageVersions::only(stage, &versions);
        let errors = match build(workspace, stage, &[only])? {
            Ok(program) => return Ok((program, broken)),
            Err(errors) => errors,
        };
        let named = versions_with_errors(&errors.messages, versions.len());
        if named.is_empty() || named.contains(&0) {
            return Err(GraderError::new(errors.messages));
        }
        for i in named {
            versions[i] = versions[0].clone();
            broken.insert(i);
        }
    }
}

/// The numbers of the versions whose files the compiler's messages name: `src/v12/mod.rs:3:5`.
fn versions_with_errors(messages: &str, versions: usize) -> BTreeSet<usize> {
    let places = messages.split("src/v").skip(1);
    let numbers = places.filter_map(|place| place.split_once('/')?.0.parse().ok());
    numbers.filter(|number| *number < versions).collect()
}

fn job_folder(workspace: &Workspace, job: &str) -> PathBuf {
    workspace.root().join("target/mutants/jobs").join(job)
}

/// Builds a worker of all `versions`. Runs at the same time build one after the other, and each
/// gets a copy of its own: the workers of all runs have the same name.
fn build(
    workspace: &Workspace,
    job: &str,
    stages: &[StageVersions<'_>],
) -> Result<Result<TempPath, CompileErrors>, GraderError> {
    let folder = workspace.root().join("target/mutants");
    let _lock = lock(&folder)?;
    let root = job_folder(workspace, job);
    for stage in stages {
        write_versions(&root.join(stage.folder(job)), stage)?;
    }
    write_workspace(workspace, job, stages)?;
    let target = workspace.root().join("target/mutants/target");
    let features = &["part1", "part2", "part3", "part4", "part5", "meshes"];
    let build_root = BuildRoot {
        root: &root,
        target: Some(&target),
        sealed: false,
        quiet: false,
        launcher: None,
    };
    match build_root.build_worker(features)? {
        BuildOutcome::Worker(worker) => Ok(Ok(own_copy(&worker.program, &folder)?)),
        BuildOutcome::DoesNotCompile(errors) => Ok(Err(errors)),
    }
}

/// Waits until no other run builds in `folder`. The lock ends with the returned file.
fn lock(folder: &Path) -> Result<File, GraderError> {
    let path = folder.join("lock");
    let failed = |e| GraderError::file("lock", &path, e);
    std::fs::create_dir_all(folder).map_err(failed)?;
    let file = File::create(&path).map_err(failed)?;
    file.lock().map_err(failed)?;
    Ok(file)
}

/// A copy of `program` in `folder`, which is deleted with the returned path.
fn own_copy(program: &Path, folder: &Path) -> Result<TempPath, GraderError> {
    let copy = tempfile::Builder::new()
        .prefix("worker-")
        .tempfile_in(folder);
    let copy = copy
        .map_err(|e| GraderError::file("write", folder, e))?
        .into_temp_path();
    std::fs::copy(program, &copy).map_err(|e| GraderError::file("copy", program, e))?;
    Ok(copy)
}

/// Writes the crate `stage` that contains all `versions` to `folder`, without its workspace.
/// [`VERSION_VARIABLE`] selects one of them when it runs.
pub fn write_versions(folder: &Path, versions: &StageVersions<'_>) -> Result<(), GraderError> {
    let StageVersions { stage, .. } = versions;
    // Files of earlier runs may stay, because no `mod` names them. Cargo rebuilds only what
    // changed.
    let src = folder.join("src");
    let manifest = format!(
        "[package]\nname = \"{stage}\"\nversion.workspace = true\nedition.workspace = true\n\n[dependencies]\nkit.workspace = true\n"
    );
    write(&folder.join("Cargo.toml"), &manifest)?;
    write(&src.join("lib.rs"), &library(versions))?;
    for (i, sources) in versions.versions.iter().enumerate() {
        for (path, text) in sources {
            let path = if path == Path::new("lib.rs") {
                Path::new("mod.rs")
            } else {
                path
            };
            write(
                &src.join(module(i)).join(path),
                &text.replace("crate::", &format!("crate::{}::", module(i))),
            )?;
        }
    }
    Ok(())
}

fn module(version: usize) -> String {
    format!("v{version}")
}

/// The `lib.rs` of the crate: each function of the stage calls the selected version.
fn library(versions: &StageVersions<'_>) -> String {
    let (all, before) = (versions.versions, versions.before);
    let versions = all.len();
    let mut text = String::from("#![allow(warnings)]\nuse kit::*;\n");
    for i in 0..versions {
        let _ = writeln!(text, "mod {};", module(i));
    }
    let _ = writeln!(
        text,
        "fn choice() -> usize {{\n    static VERSION_VARIABLE: std::sync::OnceLock<usize> = std::sync::OnceLock::new();\n    \
         *VERSION_VARIABLE.get_or_init(|| {{\n        \
         let number: usize = std::env::var(\"{VERSION_VARIABLE}\").unwrap().parse().unwrap();\n        \
         number.checked_sub({before}).filter(|version| *version < {versions}).unwrap_or(0)\n    }})\n}}"
    );
    let is_of_stage =
        |function: &StageFunction| all.first().is_some_and(|it| defines(it, function.name));
    for function in stage_functions().filter(is_of_stage) {
        let StageFunction {
            signature,
            name,
            arguments,
        } = function;
        let arguments = arguments.join(", ");
        // By its path: an argument may be called `choice`, too.
        let _ = writeln!(text, "{signature} {{\n    match crate::choice() {{");
        let own = all.iter().enumerate().skip(1);
        for (i, _) in own.filter(|(_, version)| defines(version, name)) {
            let _ = writeln!(text, "        {i} => {}::{name}({arguments}),", module(i));
        }
        let _ = writeln!(
            text,
            "        _ => {}::{name}({arguments}),\n    }}\n}}",
            module(0)
        );
    }
    text
}

/// Whether a version of a stage has the function `name`. One without `record_triangle` gets that of
/// the first version, which is the reference.
fn defines(sources: &Sources, name: &str) -> bool {
    let heads = [format!("pub fn {name}("), format!("pub fn {name}<")];
    let has_one = |text: &String| heads.iter().any(|head| text.contains(head));
    sources.values().any(has_one)
}

/// Writes the workspace of `job`: the versions' crates and the worker. Their dependencies are in
/// the course's workspace.
fn write_workspace(
    workspace: &Workspace,
    job: &str,
    stages: &[StageVersions<'_>],
) -> Result<(), GraderError> {
    let root = workspace.root();
    let job_root = job_folder(workspace, job);
    let path = root.join("Cargo.toml");
    let text = std::fs::read_to_string(&path).map_err(|e| GraderError::file("read", &path, e))?;
    let mut manifest: toml::Table = text
        .parse()
        .map_err(|e| GraderError::file("parse", &path, e))?;
    let no_table = || GraderError::file("use", &path, "it has no [workspace.dependencies]");
    let spec = manifest
        .get_mut("workspace")
        .and_then(toml::Value::as_table_mut)
        .ok_or_else(no_table)?;
    let hosts = stages.iter().map(|stage| stage.folder(job));
    let members: Vec<String> = hosts.chain(["worker".to_string()]).collect();
    spec.insert("members".into(), toml::Value::from(members));
    spec.remove("default-members");
    let dependencies = spec
        .get_mut("dependencies")
        .and_then(toml::Value::as_table_mut)
        .ok_or_else(no_table)?;
    for (name, dependency) in dependencies.iter_mut() {
        let Some(path) = dependency.get_mut("path") else {
            continue;
        };
        let host = stages.iter().find(|stage| stage.stage == name);
        let folder = match (host, path.as_str()) {
            (Some(host), _) => job_root.join(host.folder(job)),
            _ if name == "worker" => job_root.join("worker"),
            (None, Some(below)) => root.join(below),
            (None, None) => continue,
        };
        *path = toml::Value::from(folder.display().to_string());
    }
    // The profile is the students', because a slow algorithm must be as slow as theirs.
    if let Some(profiles) = manifest
        .get_mut("profile")
        .and_then(toml::Value::as_table_mut)
    {
        profiles.remove("dev");
        if let Some(release) = profiles
            .get_mut("release")
            .and_then(toml::Value::as_table_mut)
        {
            release.insert("debug".into(), false.into());
            // Most of these packages are not in this workspace, which cargo would warn about.
            release.remove("package");
        }
    }
    write(&job_root.join("Cargo.toml"), &manifest.to_string())?;
    copy(&root.join("Cargo.lock"), &job_root.join("Cargo.lock"))?;
    copy(
        &root.join("grader/worker/Cargo.toml"),
        &job_root.join("worker/Cargo.toml"),
    )?;
    copy_folder(
        &root.join("grader/worker/src"),
        &job_root.join("worker/src"),
    )
}

fn copy_folder(from: &Path, to: &Path) -> Result<(), GraderError> {
    let unread = |e| GraderError::file("read", from, e);
    for entry in std::fs::read_dir(from).map_err(unread)? {
        let entry = entry.map_err(unread)?;
        let (path, to) = (entry.path(), to.join(entry.file_name()));
        match path.is_dir() {
            true => copy_folder(&path, &to)?,
            false => copy(&path, &to)?,
        }
    }
    Ok(())
}

fn copy(from: &Path, to: &Path) -> Result<(), GraderError> {
    let text = std::fs::read_to_string(from).map_err(|e| GraderError::file("read", from, e))?;
    write(to, &text)
}

/// Writes a file and creates its parent folders. Does not write a file again that is up to date, so
/// that cargo does not rebuild it.
fn write(path: &Path, text: &str) -> Result<(), GraderError> {
    if std::fs::read_to_string(path).is_ok_and(|old| old == text) {
        return Ok(());
    }
    let folder = path.parent().unwrap_or(Path::new("."));
    let written = std::fs::create_dir_all(folder).and_then(|()| std::fs::write(path, text));
    written.map_err(|e| GraderError::file("write", path, e))
}
