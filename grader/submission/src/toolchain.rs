//! The Rust toolchain that builds submissions, and the folders of the system that it needs.

use base::GraderError;
use base::child_processes;
use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::process::Command;

/// The toolchain of the person who grades, without the settings around it.
#[derive(Clone, Debug)]
pub(crate) struct Toolchain {
    /// Its own `cargo`, not the program of `rustup` that chooses one.
    pub(crate) cargo: PathBuf,
    /// Its own `rustc`.
    pub(crate) rustc: PathBuf,
    /// The output of `rustc -vV`: code that another version compiled is of no use to it.
    pub(crate) version: String,
    /// The folders with the compiler, the linker and their libraries.
    pub(crate) folders: Vec<PathBuf>,
    /// The folders in which programs such as the linker are searched.
    pub(crate) path: OsString,
}

/// Where systems have their programs and libraries. `/etc` and homes are not among them.
const SYSTEM_FOLDERS: [&str; 7] = [
    "/bin",
    "/lib",
    "/lib32",
    "/lib64",
    "/usr",
    "/nix/store",
    "/gnu/store",
];

/// The file that says where the system's libraries are.
pub(crate) const LIBRARY_CACHE: &str = "/etc/ld.so.cache";

impl Toolchain {
    /// Asks the toolchain of `workspace`.
    pub(crate) fn of(workspace: &Path) -> Result<Toolchain, GraderError> {
        let rustc = std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into());
        let ask = |arguments: &[&str]| {
            let output = Command::new(&rustc)
                .current_dir(workspace)
                .args(arguments)
                .output()
                .map_err(|e| GraderError::file("run", Path::new(&rustc), e))?;
            let text = String::from_utf8_lossy(&output.stdout).trim().to_string();
            match output.status.success() {
                true => Ok(text),
                false => Err(GraderError::new(format!(
                    "`rustc {}` fails: {}",
                    arguments.join(" "),
                    String::from_utf8_lossy(&output.stderr).trim()
                ))),
            }
        };
        let sysroot = PathBuf::from(ask(&["--print", "sysroot"])?);
        let own = |name: &str, other: OsString| {
            let own = sysroot.join("bin").join(name);
            match own.is_file() {
                true => own,
                false => PathBuf::from(other),
            }
        };
        let cargo = own("cargo", child_processes::cargo());
        let mut folders: Vec<PathBuf> = SYSTEM_FOLDERS.map(PathBuf::from).to_vec();
        folders.push(sysroot.clone());
        // Where programs are links into other folders, such as `/opt`, these are needed, too.
        let mut path = vec![sysroot.join("bin")];
        path.extend(["/usr/local/bin", "/usr/bin", "/bin"].map(PathBuf::from));
        if let Some(linker) = linker() {
            path.extend(linker.parent().map(Path::to_path_buf));
            let real = linker.canonicalize().ok();
            folders.extend(real.and_then(|real| Some(real.parent()?.to_path_buf())));
        }
        Ok(Toolchain {
            rustc: own("rustc", rustc.clone()),
            version: ask(&["-vV"])?,
            path: std::env::join_paths(path)
                .map_err(|e| GraderError::new(format!("a folder of programs: {e}")))?,
            cargo,
            folders,
        })
    }

    /// A sentence if `folder` is inside a folder that the compiler may read.
    pub(crate) fn exposes(&self, folder: &Path) -> Option<String> {
        let open = self.folders.iter().find(|open| folder.starts_with(open))?;
        Some(format!(
            "the course is in {}, and the compiler may read everything in {}: move the course elsewhere, for example to your home",
            folder.display(),
            open.display()
        ))
    }
}

/// The C compiler that links programs: the first one on the path.
fn linker() -> Option<PathBuf> {
    let path = std::env::var_os("PATH")?;
    let mut programs = std::env::split_paths(&path).map(|folder| folder.join("cc"));
    programs.find(|program| program.is_file())
}
