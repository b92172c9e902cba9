//! Checks the folder that a handout is written to.

use base::{GraderError, Workspace};
use std::path::{Component, Path};

/// Returns an error if a handout in `out` would overwrite files or be inside the course itself.
pub fn check(workspace: &Workspace, out: &Path) -> Result<(), GraderError> {
    let error = |why: &str| GraderError::new(format!("cannot write to {}: {why}", out.display()));
    if out.exists() && !out.is_dir() {
        return Err(error("it is a file. Name a folder that does not exist yet"));
    }
    if out.is_dir() {
        let mut entries = std::fs::read_dir(out).map_err(|e| GraderError::file("read", out, e))?;
        if entries.next().is_some() {
            return Err(error(
                "it is not empty. Name a folder that does not exist yet",
            ));
        }
    }
    if out
        .components()
        .next_back()
        .is_none_or(|last| !matches!(last, Component::Normal(_)))
    {
        return Err(error("expected the name of the folder itself, not `..`"));
    }
    let parent = out
        .parent()
        .filter(|parent| !parent.as_os_str().is_empty())
        .unwrap_or(Path::new("."));
    let parent = parent
        .canonicalize()
        .map_err(|_| error("its parent folder does not exist. Create it first"))?;
    let inside = parent.join(out.file_name().unwrap_or_default());
    if inside.starts_with(workspace.root()) && !inside.starts_with(workspace.root().join("target"))
    {
        return Err(error(
            "it is inside the course, so later handouts could contain it. Name a folder outside the course",
        ));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_new_folders_outside_the_course_are_accepted() {
        let folder = tempfile::tempdir().unwrap();
        let at = |path: &str| folder.path().join(path);
        for folder in ["course/stages", "course/target", "empty", "full/x"] {
            std::fs::create_dir_all(at(folder)).unwrap();
        }
        std::fs::write(at("course/stages/course.toml"), "").unwrap();
        std::fs::write(at("file"), "").unwrap();
        let workspace = Workspace::above(&at("course")).unwrap();
        for (out, why) in [
            ("file", "it is a file"),
            ("full", "not empty"),
            ("course/handout", "inside the course"),
            ("course/stages/new", "inside the course"),
            ("nowhere/new", "does not exist"),
            ("nothing/..", "the folder itself"),
        ] {
            let error = check(&workspace, &at(out)).unwrap_err().to_string();
            assert!(error.contains(why), "{out}: {error}");
        }
        for fine in ["empty", "new", "course/target/new"] {
            assert_eq!(check(&workspace, &at(fine)), Ok(()), "{fine}");
        }
    }
}
