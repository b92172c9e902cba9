//! Finds out which stages were saved, by the modification times of their files.

use crate::course::sources;
use base::Workspace;
use std::collections::{BTreeMap, BTreeSet};
use std::path::PathBuf;
use std::time::SystemTime;

/// The state of a file: when it was modified, and its length.
type State = (Option<SystemTime>, u64);

/// The files of some stages, as they were when they were last looked at.
#[derive(Clone, Debug)]
pub struct WatchedFiles {
    workspace: Workspace,
    stages: BTreeMap<String, BTreeMap<PathBuf, State>>,
}

impl WatchedFiles {
    /// Watches the files of `stages`, as they are now.
    pub fn new(workspace: &Workspace, stages: &[&str]) -> WatchedFiles {
        let states = stages.iter().map(|stage| {
            let files = state(workspace, stage);
            ((*stage).to_owned(), files)
        });
        WatchedFiles {
            stages: states.collect(),
            workspace: workspace.clone(),
        }
    }

    /// The stages of which a file was saved, created or removed since the last call.
    pub fn saved(&mut self) -> BTreeSet<String> {
        let mut saved = BTreeSet::new();
        for (stage, before) in &mut self.stages {
            let now = state(&self.workspace, stage);
            if *before != now {
                *before = now;
                saved.insert(stage.clone());
            }
        }
        saved
    }
}

/// The states of the files of a stage. A file that an editor is just replacing is left out: it is
/// there the next time.
fn state(workspace: &Workspace, stage: &str) -> BTreeMap<PathBuf, State> {
    let paths = sources::paths(workspace.root(), stage).unwrap_or_default();
    let states = paths.into_iter().filter_map(|path| {
        let metadata = std::fs::metadata(&path).ok()?;
        Some((path, (metadata.modified().ok(), metadata.len())))
    });
    states.collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    #[test]
    fn a_saved_file_names_its_stage_once() {
        let folder = tempfile::tempdir().unwrap();
        let stages = folder.path().join("stages");
        for stage in ["bbox", "bvh"] {
            fs::create_dir_all(stages.join(stage).join("src")).unwrap();
            fs::write(stages.join(stage).join("src/lib.rs"), "//! Map.\n").unwrap();
        }
        fs::write(stages.join("course.toml"), "").unwrap();
        let workspace = Workspace::above(folder.path()).unwrap();
        let mut files = WatchedFiles::new(&workspace, &["bbox", "bvh"]);
        assert!(files.saved().is_empty());
        fs::write(stages.join("bvh/src/lib.rs"), "//! A map.\n").unwrap();
        assert_eq!(files.saved(), BTreeSet::from(["bvh".to_owned()]));
        assert!(files.saved().is_empty());
        fs::write(stages.join("bbox/src/new.rs"), "").unwrap();
        assert_eq!(files.saved(), BTreeSet::from(["bbox".to_owned()]));
        fs::remove_file(stages.join("bbox/src/new.rs")).unwrap();
        assert_eq!(files.saved(), BTreeSet::from(["bbox".to_owned()]));
    }
}
