//! The folder `OUT`: where the plan, the results of units and the tables are.

use base::GraderError;
use std::io;
use std::path::{Path, PathBuf};

/// The folder `OUT`.
#[derive(Clone, Debug)]
pub struct Out(PathBuf);

impl Out {
    /// Creates the folder, if there is none.
    pub fn create(path: &Path) -> Result<Out, GraderError> {
        for folder in [
            path.to_path_buf(),
            path.join("units"),
            path.join("failures"),
            path.join("pictures"),
        ] {
            std::fs::create_dir_all(&folder)
                .map_err(|e| GraderError::file("create", &folder, e))?;
        }
        let path = path
            .canonicalize()
            .map_err(|e| GraderError::file("open", path, e))?;
        Ok(Out(path))
    }

    /// The file or folder `name` in it.
    pub fn join(&self, name: impl AsRef<Path>) -> PathBuf {
        self.0.join(name)
    }

    /// Its path.
    pub fn path(&self) -> &Path {
        &self.0
    }

    /// The plan that the tables show.
    pub fn plan(&self) -> PathBuf {
        self.join("class.json")
    }

    /// The plan that a regrade would replace it by.
    pub fn proposed_plan(&self) -> PathBuf {
        self.join("regrade.json")
    }

    /// The result of a unit.
    pub fn unit(&self, key: &str) -> PathBuf {
        self.join(Path::new("units").join(format!("{key}.json")))
    }

    /// A picture of a unit, by the hash of its contents.
    pub fn picture(&self, name: &str) -> PathBuf {
        self.join(Path::new("pictures").join(format!("{name}.png")))
    }

    /// Why a unit could not be graded.
    pub fn failure(&self, key: &str) -> PathBuf {
        self.join(Path::new("failures").join(format!("{key}.txt")))
    }

    /// Whether there is a result of a unit. [`crate::unit::is_stored`] also looks into it.
    pub fn has(&self, key: &str) -> bool {
        self.unit(key).is_file()
    }
}

/// Reads a regular file. Opening a pipe would wait for a writer.
pub(crate) fn read_regular(path: &Path) -> io::Result<Vec<u8>> {
    match path.metadata()?.is_file() {
        true => std::fs::read(path),
        false => Err(io::Error::new(
            io::ErrorKind::InvalidInput,
            "it is no regular file: remove it",
        )),
    }
}
