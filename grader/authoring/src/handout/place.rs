//! Where a handout may be written.

use grader::error::GraderError;
use grader::workspace::Workspace;
use std::path::{Component, Path};

/// Refuses a place for a handout where it would overwrite something or hide in the course's own tree.
pub fn check(workspace: &Workspace, out: &Path) -> Result<(), GraderError> {
    let refused = |why: &str| {
        GraderError::new(format!(
            "cannot put a handout into {}: {why}",
            out.display()
        ))
    };
    if out.exists() && !out.is_dir() {
        return Err(refused(
            "it is a file. Name a folder that does not exist yet",
        ));
    }
    if out.is_dir() {
        let mut entries = std::fs::read_dir(out).map_err(|e| GraderError::file("read", out, e))?;
        if entries.next().is_some() {
            return Err(refused(
                "it is not empty. Name a folder that does not exist yet",
            ));
        }
    }
    if out
        .components()
        .next_back()
        .is_none_or(|last| !matches!(last, Component::Normal(_)))
    {
        return Err(refused("name the folder itself, not one above it"));
    }
    let parent = out.parent().filter(|parent| !parent.as_os_str().is_empty());
    let parent = parent.unwrap_or(Path::new("."));
    let parent = parent
        .canonicalize()
        .map_err(|_| refused("the folder that it would stand in does not exist. Make it first"))?;
    let inside = parent.join(out.file_name().unwrap_or_default());
    if inside.starts_with(workspace.root()) && !inside.starts_with(workspace.root().join("target"))
    {
        return Err(refused(
            "that is inside the course itself, where it could be handed out with it. Name a folder outside",
        ));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_handout_goes_nowhere_but_into_a_new_folder_outside_the_course() {
        let folder = tempfile::tempdir().unwrap();
        let at = |path: &str| folder.path().join(path);
        for made in ["course/stages", "course/target", "empty", "full/x"] {
            std::fs::create_dir_all(at(made)).unwrap();
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
            ("nothing/..", "name the folder itself"),
        ] {
            let error = check(&workspace, &at(out)).unwrap_err().to_string();
            assert!(error.contains(why), "{out}: {error}");
        }
        for fine in ["empty", "new", "course/target/new"] {
            assert_eq!(check(&workspace, &at(fine)), Ok(()), "{fine}");
        }
    }
}
