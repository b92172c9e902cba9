//! Handles Ctrl-C and similar signals: ends child processes and removes temporary files.

use crate::{GraderError, child_processes, errln, keys, without_path};
use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

/// Folders and files to remove when the program is interrupted.
static CLEANUP_PATHS: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

/// How many times to try to remove a folder that a program may still be writing to.
const REMOVAL_ATTEMPTS: u32 = 20;

/// A temporary folder. It is removed when this is dropped, and on Ctrl-C.
#[derive(Debug)]
pub struct TempFolder(tempfile::TempDir);

impl TempFolder {
    /// The path of the folder.
    pub fn path(&self) -> &Path {
        self.0.path()
    }
}

impl Drop for TempFolder {
    fn drop(&mut self) {
        unregister(self.0.path());
    }
}

/// Creates a temporary folder in the system's folder for them.
pub fn temp_folder() -> Result<TempFolder, GraderError> {
    temp_folder_in(&std::env::temp_dir())
}

/// Creates a temporary folder in `parent`. So it is on the same disk as files of `parent` and can
/// be renamed to one of them.
pub fn temp_folder_in(parent: &Path) -> Result<TempFolder, GraderError> {
    let folder = tempfile::Builder::new()
        .prefix(".grader-")
        .tempdir_in(parent)
        .map_err(|e| GraderError::file("write to", parent, without_path(&e)))?;
    register(folder.path());
    Ok(TempFolder(folder))
}

/// A lock file. It is removed when this is dropped, and on Ctrl-C.
#[derive(Debug)]
pub struct LockFile(PathBuf);

impl Drop for LockFile {
    fn drop(&mut self) {
        let _ = std::fs::remove_file(&self.0);
        unregister(&self.0);
    }
}

/// Creates the lock file `path`. Fails if it exists already.
pub fn lock(path: &Path) -> Result<LockFile, GraderError> {
    let created = std::fs::File::create_new(path);
    created.map_err(|e| match e.kind() {
        std::io::ErrorKind::AlreadyExists => GraderError::new(format!(
            "another grader is running here. Wait until it ends. If none is running (one may have been killed), remove {}",
            path.display()
        )),
        _ => GraderError::file("create", path, e),
    })?;
    register(path);
    Ok(LockFile(path.to_path_buf()))
}

fn register(path: &Path) {
    if let Ok(mut paths) = CLEANUP_PATHS.lock() {
        paths.push(path.to_path_buf());
    }
}

fn unregister(path: &Path) {
    if let Ok(mut paths) = CLEANUP_PATHS.lock() {
        paths.retain(|other| other != path);
    }
}

/// Whether Ctrl-C was pressed.
static INTERRUPTED: AtomicBool = AtomicBool::new(false);

/// How long the handler may take to start after Ctrl-C.
const HANDLER_DELAY: Duration = Duration::from_millis(100);

/// Whether the program was interrupted. If so, an error that came up is only a consequence, such as
/// a compiler that was ended, and need not be reported: the handler ends the program.
pub fn was_interrupted() -> bool {
    std::thread::sleep(HANDLER_DELAY);
    INTERRUPTED.load(Ordering::SeqCst)
}

/// What programs do on Ctrl-C besides `clean_up`.
static AT_INTERRUPT: Mutex<Vec<fn()>> = Mutex::new(Vec::new());

/// Calls `action` on Ctrl-C, before the program ends.
pub fn at_interrupt(action: fn()) {
    if let Ok(mut actions) = AT_INTERRUPT.lock() {
        actions.push(action);
    }
}

/// Installs the handler for Ctrl-C and the signals TERM and HUP. It ends child processes, removes
/// temporary folders and lock files, and ends the program with exit code 2.
pub fn install_handler() {
    // If this fails, Ctrl-C still ends the program, but temporary folders stay.
    let _ = ctrlc::set_handler(|| {
        INTERRUPTED.store(true, Ordering::SeqCst);
        if let Ok(actions) = AT_INTERRUPT.lock() {
            actions.iter().for_each(|action| action());
        }
        clean_up();
        errln!("\ninterrupted: temporary files were removed");
        std::process::exit(2);
    });
}

/// Puts the terminal back as it was, ends child processes and removes temporary folders and lock
/// files, before the program ends.
pub(crate) fn clean_up() {
    keys::restore_terminal();
    child_processes::terminate_all();
    if let Ok(paths) = CLEANUP_PATHS.lock() {
        for path in paths.iter() {
            // A program that is ending may still be writing to the folder.
            for _ in 0..REMOVAL_ATTEMPTS {
                let removed = std::fs::remove_file(path).or_else(|_| std::fs::remove_dir_all(path));
                if removed.is_ok() {
                    break;
                }
            }
        }
    }
}
