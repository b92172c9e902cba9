//! The clean workspace that submissions are built in.

use crate::file_tree::{self, Files};
use crate::packages::{lock, manifest, members};
use grader::error::GraderError;
use grader::grade::BuildRoot;
use grader::interrupt::{self, LockFile};
use grader::workspace::Workspace;
use std::path::{Path, PathBuf};

/// A folder for one job after the other: what does not change between two of them is built once.
#[derive(Debug)]
pub struct Job {
    folder: PathBuf,
    target: PathBuf,
    /// The worker and all it imports, with every stage as the reference solves it. No tests, no goldens.
    trusted: Files,
    _lock: LockFile,
}

impl Job {
    /// Lays out the folder below `target/` of `workspace`. One grader at a time.
    pub fn open(workspace: &Workspace) -> Result<Job, GraderError> {
        let top = workspace.root().join("target/submissions");
        std::fs::create_dir_all(&top).map_err(|e| GraderError::file("make", &top, e))?;
        let target = top.join("target");
        if !target.is_dir() {
            // What cargo says about code that is not the caller's own is kept for the report.
            eprintln!(
                "Building the course for submissions: this first time it takes a few minutes."
            );
        }
        let lock = interrupt::lock(&top.join("in_use"))?;
        Ok(Job {
            folder: top.join("job"),
            target,
            trusted: trusted(workspace)?,
            _lock: lock,
        })
    }

    /// Puts the given stages in place of the reference's.
    pub fn with(&self, stages: &[(&str, &Files)]) -> Result<BuildRoot<'_>, GraderError> {
        let mut files = self.trusted.clone();
        for (stage, sources) in stages {
            let src = Path::new("stages").join(stage).join("src");
            files.retain(|path, _| !path.starts_with(&src));
            files.extend(
                sources
                    .iter()
                    .map(|(path, text)| (src.join(path), text.clone())),
            );
        }
        file_tree::make_equal(&self.folder, &files)?;
        Ok(BuildRoot {
            root: &self.folder,
            target: Some(&self.target),
            sealed: true,
        })
    }
}

fn trusted(workspace: &Workspace) -> Result<Files, GraderError> {
    let root = workspace.root();
    let members = members::read(root)?;
    let needed = members::closure(&members, &["worker"]);
    let left_out: Vec<PathBuf> = members
        .iter()
        .filter(|member| !needed.contains(member.name.as_str()))
        .map(|member| member.folder.clone())
        .collect();
    let mut files = Files::new();
    for path in file_tree::paths(root)? {
        let owner = members::owner(&members, &path);
        let is_manifest = path.file_name().is_some_and(|name| name == "Cargo.toml");
        let wanted = match owner {
            None => {
                path.starts_with(".cargo")
                    || path == Path::new("Cargo.lock")
                    || path == Path::new("Cargo.toml")
            }
            Some(owner) => {
                let inside = path.strip_prefix(&owner.folder).unwrap_or(&path);
                let is_test = inside
                    .iter()
                    .next()
                    .is_some_and(|name| members::TESTS.iter().any(|test| name == *test));
                needed.contains(owner.name.as_str()) && !is_test
            }
        };
        if !wanted {
            continue;
        }
        let mut contents = file_tree::read(root, &path)?;
        if is_manifest {
            let text = String::from_utf8_lossy(&contents);
            contents = match owner {
                None => manifest::of_workspace(&text, &left_out),
                Some(_) => manifest::without_tests(&text),
            }
            .into_bytes();
        }
        files.insert(path, contents);
    }
    lock::mend(&mut files)?;
    Ok(files)
}
