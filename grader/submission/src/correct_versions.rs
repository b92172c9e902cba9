//! The correct versions of the course's stages, of which no check of submissions may complain.

use base::Workspace;
use files::file_tree::Files;
use grader::course::{Course, sources};
use std::path::{Path, PathBuf};

pub(crate) fn workspace() -> Workspace {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    Workspace::above(here).expect("this is the course")
}

/// The names of the stages that students write.
pub(crate) fn stages() -> Vec<String> {
    let course = Course::read(&workspace()).expect("the course is valid");
    course.stages().into_iter().map(str::to_string).collect()
}

/// The files of the reference's `stage`.
pub(crate) fn reference(stage: &str) -> Files {
    files_in(&format!("stages/{stage}/src"))
}

/// The files of all other correct versions of `stage`: each is a version.
pub(crate) fn variants(stage: &str) -> Files {
    files_in(&format!("grader/mutants/variants/{stage}"))
}

/// The files below a folder of the course, by their paths in it.
fn files_in(folder: &str) -> Files {
    let folder = workspace().root().join(folder);
    let paths = sources::below(&folder).expect("it can be read");
    let read = |path: PathBuf| {
        let text = std::fs::read(&path).expect("it can be read");
        let below = path.strip_prefix(&folder).expect("it is below");
        (below.to_path_buf(), text)
    };
    paths.into_iter().map(read).collect()
}
