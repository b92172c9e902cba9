//! The workspace that submissions are built in: trusted files and the submission's sources.

use crate::file_tree::{self, Files};
use crate::packages::{lock, manifest, members};
use grader::compile::BuildRoot;
use grader::error::GraderError;
use grader::interrupt::{self, LockFile};
use grader::workspace::Workspace;
use std::path::{Path, PathBuf};

/// A workspace for building one submission after the other. Cargo rebuilds only what differs.
#[derive(Debug)]
pub struct CleanWorkspace {
    folder: PathBuf,
    target: PathBuf,
    /// The files of the worker and its dependencies, with the reference's stages. No tests, no
    /// goldens.
    trusted: Files,
    _lock: LockFile,
}

impl CleanWorkspace {
    /// Opens the clean workspace in the folder `target/` of `workspace`. Fails if another grader
    /// uses it.
    pub fn open(workspace: &Workspace) -> Result<CleanWorkspace, GraderError> {
        let top = workspace.root().join("target/submissions");
        std::fs::create_dir_all(&top).map_err(|e| GraderError::file("create", &top, e))?;
        let target = top.join("target");
        if !target.is_dir() {
            // A sealed build does not print cargo's progress.
            eprintln!("Building the course for submissions. The first time takes a few minutes.");
        }
        let lock = interrupt::lock(&top.join("in_use"))?;
        Ok(CleanWorkspace {
            folder: top.join("job"),
            target,
            trusted: trusted_files(workspace)?,
            _lock: lock,
        })
    }

    /// Writes the workspace with these stages in place of the reference's.
    pub fn with_stages(&self, stages: &[(&str, &Files)]) -> Result<BuildRoot<'_>, GraderError> {
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
        file_tree::sync_folder(&self.folder, &files)?;
        Ok(BuildRoot {
            root: &self.folder,
            target: Some(&self.target),
            sealed: true,
            quiet: true,
        })
    }
}

/// The files of the worker and of all crates that it depends on.
fn trusted_files(workspace: &Workspace) -> Result<Files, GraderError> {
    let root = workspace.root();
    let members = members::read(root)?;
    let needed = members::with_dependencies(&members, &["worker"]);
    let left_out: Vec<PathBuf> = members
        .iter()
        .filter(|member| !needed.contains(member.name.as_str()))
        .map(|member| member.folder.clone())
        .collect();
    let mut files = Files::new();
    for path in file_tree::workspace_paths(root)? {
        let owner = members::containing_member(&members, &path);
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
                    .is_some_and(|name| members::TEST_FOLDERS.iter().any(|test| name == *test));
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
                None => manifest::without_members(&text, &left_out),
                Some(_) => manifest::without_tests(&text),
            }
            .into_bytes();
        }
        files.insert(path, contents);
    }
    lock::remove_unused(&mut files)?;
    Ok(files)
}
