//! Ctrl-C, or another wish that the grader ends: what it started and what was half written goes, and the program says so.

use crate::child_processes;
use crate::error::{GraderError, without_path};
use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

/// Folders and files that must not outlive the program.
static SCRATCH: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

/// How often to try to remove a folder that is being written to.
const REMOVALS: u32 = 20;

/// A folder that goes when it is dropped, and on Ctrl-C.
#[derive(Debug)]
pub struct Scratch(tempfile::TempDir);

impl Scratch {
    /// Where it is.
    pub fn path(&self) -> &Path {
        self.0.path()
    }
}

impl Drop for Scratch {
    fn drop(&mut self) {
        forget(self.0.path());
    }
}

/// A new folder among the system's temporary ones.
pub fn scratch() -> Result<Scratch, GraderError> {
    scratch_in(&std::env::temp_dir())
}

/// A new folder in `parent`: on the same disk as what is to replace it.
pub fn scratch_in(parent: &Path) -> Result<Scratch, GraderError> {
    let folder = tempfile::Builder::new()
        .prefix(".grader-")
        .tempdir_in(parent)
        .map_err(|e| GraderError::file("write to", parent, without_path(&e)))?;
    remember(folder.path());
    Ok(Scratch(folder))
}

/// A file that says that its maker is at work; goes when it is dropped, and on Ctrl-C.
#[derive(Debug)]
pub struct Claim(PathBuf);

impl Drop for Claim {
    fn drop(&mut self) {
        let _ = std::fs::remove_file(&self.0);
        forget(&self.0);
    }
}

/// Makes the file `path`, unless somebody else has.
pub fn claim(path: &Path) -> Result<Claim, GraderError> {
    let made = std::fs::File::create_new(path);
    made.map_err(|e| match e.kind() {
        std::io::ErrorKind::AlreadyExists => GraderError::new(format!(
            "another grader is at work here. Wait for it; if there is none (one may have been killed), remove {}",
            path.display()
        )),
        _ => GraderError::file("make", path, e),
    })?;
    remember(path);
    Ok(Claim(path.to_path_buf()))
}

fn remember(path: &Path) {
    if let Ok(mut scratch) = SCRATCH.lock() {
        scratch.push(path.to_path_buf());
    }
}

fn forget(path: &Path) {
    if let Ok(mut scratch) = SCRATCH.lock() {
        scratch.retain(|kept| kept != path);
    }
}

/// Whether Ctrl-C was pressed.
static PRESSED: AtomicBool = AtomicBool::new(false);

/// How long the handler may take to notice Ctrl-C, which programs that the grader started notice, too.
const MOMENT: Duration = Duration::from_millis(100);

/// Whether an error that came up is only the echo of Ctrl-C, such as a compiler that it ended. Then the handler is
/// about to end the program, and there is nothing to report.
pub fn is_the_cause() -> bool {
    std::thread::sleep(MOMENT);
    PRESSED.load(Ordering::SeqCst)
}

/// From now on Ctrl-C ends what was started, removes scratch folders and ends the program with exit code 2. So do the
/// signals TERM and HUP.
pub fn watch() {
    // Without a handler Ctrl-C still ends the program; only scratch folders stay.
    let _ = ctrlc::set_handler(|| {
        PRESSED.store(true, Ordering::SeqCst);
        child_processes::end_all();
        if let Ok(scratch) = SCRATCH.lock() {
            for path in scratch.iter() {
                // The program may be writing there still.
                for _ in 0..REMOVALS {
                    let removed =
                        std::fs::remove_file(path).or_else(|_| std::fs::remove_dir_all(path));
                    if removed.is_ok() {
                        break;
                    }
                }
            }
        }
        eprintln!("\ninterrupted: nothing half written is left");
        std::process::exit(2);
    });
}
