//! Reads the files of a commit of a git clone.
//!
//! The settings of a clone that somebody else made may start programs. So git never sees these
//! settings: it runs in a repository of our own, which has only copies of the files that name the
//! clone's commits, and reads the clone's objects.

use super::unpack::Unpacker;
use crate::reading::Unreadable;
use crate::reading::content::unreadable;
use crate::reading::signals;
use base::GraderError;
use base::child_processes;
use base::interrupt::{self, TempFolder};
use grader::course::sources;
use serde::{Deserialize, Serialize};
use std::collections::BTreeSet;
use std::fmt;
use std::io::{BufRead, BufReader, ErrorKind, Read, Write};
use std::path::{Path, PathBuf};
use std::process::{ChildStdout, Command, Stdio};
use std::time::{SystemTime, UNIX_EPOCH};
use submission::read::for_each_file;

/// Which commit of a clone counts.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Revision {
    /// The commit with this name: a hash, a tag or a branch.
    Commit(String),
    /// The last commit on the current branch that was made before this time. The time has the form
    /// `2026-11-20T23:59:59`, with or without a time zone.
    Before(String),
}

impl Revision {
    /// Reads the date of `--before`: `2026-11-20`, which means the end of that day, or a date with
    /// a time, with or without a time zone: `2026-11-20 18:00`, `2026-11-20T18:00:00Z`. Git itself
    /// would take any text for a date.
    pub fn before(text: &str) -> Result<Revision, String> {
        let expected = || {
            format!(
                "`{text}` is no date: expected such as 2026-11-20, \"2026-11-20 18:00\" or 2026-11-20T18:00:00+01:00"
            )
        };
        let text = text.trim().replacen(' ', "T", 1);
        let (date, time) = text.split_once('T').unwrap_or((&text, "23:59:59"));
        let (time, zone) = match time.find(['Z', '+', '-']) {
            Some(at) => time.split_at(at),
            None => (time, ""),
        };
        let fits = |text: &str, form: &str| {
            text.len() == form.len()
                && text.bytes().zip(form.bytes()).all(|(c, form)| match form {
                    b'0' => c.is_ascii_digit(),
                    form => c == form,
                })
        };
        let in_range = |text: &str, range: std::ops::RangeInclusive<u32>| {
            text.parse().is_ok_and(|number| range.contains(&number))
        };
        let is_date = fits(date, "0000-00-00")
            && in_range(&date[5..7], 1..=12)
            && in_range(&date[8..], 1..=31);
        let time = match time.len() {
            5 => format!("{time}:00"),
            _ => time.to_string(),
        };
        let is_time = fits(&time, "00:00:00")
            && in_range(&time[..2], 0..=23)
            && in_range(&time[3..5], 0..=59)
            && in_range(&time[6..], 0..=59);
        let is_zone = matches!(zone, "" | "Z")
            || ["+00:00", "-00:00", "+0000", "-0000"]
                .iter()
                .any(|form| fits(zone, form));
        match is_date && is_time && is_zone {
            true => Ok(Revision::Before(format!("{date}T{time}{zone}"))),
            false => Err(expected()),
        }
    }
}

impl fmt::Display for Revision {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Revision::Commit(name) => write!(f, "the commit {name}"),
            Revision::Before(time) => write!(f, "the last commit before {time}"),
        }
    }
}

/// The most bytes of `HEAD`, `packed-refs` or `shallow`, if the file is to be copied.
const MAX_LIST_OF_REFS: u64 = 4 << 20;

/// The most bytes of a file that names one commit, if it is to be copied.
const MAX_REF: u64 = 1 << 10;

/// The most bytes that are copied of all files that name a clone's commits.
const MAX_REFS: u64 = 16 << 20;

/// The least number of bytes that a file takes on a disk.
const BLOCK: u64 = 4 << 10;

/// The most bytes that are read of what git prints, such as the list of a commit's files.
const MAX_LIST: u64 = 32 << 20;

/// The most files and folders below `.git/objects`.
const MAX_GIT_FILES: usize = 200_000;

/// The most files and folders below `.git/refs`: each of these files is copied, and removed again.
const MAX_REF_FILES: usize = 10_000;

/// When a commit was made, in seconds since 1970, by the clock of the student's machine.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct CommitTimes {
    /// When the changes were written.
    pub author: i64,
    /// When they were committed. `--before` and deadlines go by this time.
    pub committer: i64,
    /// Why these times cannot be right; `None` if they can.
    pub doubt: Option<String>,
}

/// How far the clocks of two machines may be apart, in seconds.
const CLOCKS: i64 = 10 * 60;

impl CommitTimes {
    /// The times of a commit whose parents were committed at the times `parents`, read at the time
    /// `now`.
    fn new(author: i64, committer: i64, parents: &[i64], now: i64) -> CommitTimes {
        let is_earlier = parents
            .iter()
            .any(|parent| committer.saturating_add(CLOCKS) < *parent);
        let doubt = match author > committer.saturating_add(CLOCKS) {
            _ if is_earlier => Some("committed before the commit that it follows".to_string()),
            _ if committer > now + CLOCKS => Some("committed in the future".to_string()),
            true => Some("written after it was committed".to_string()),
            false => None,
        };
        CommitTimes {
            author,
            committer,
            doubt,
        }
    }
}

/// Unpacks the files of a commit of the clone in `folder`, and returns when it was made.
pub(super) fn unpack(
    folder: &Path,
    revision: &Revision,
    unpacker: &mut Unpacker,
) -> Result<CommitTimes, Unreadable> {
    let clone = clone_in(folder)?;
    let git = Git::of(&clone)?;
    let commit = match revision {
        Revision::Commit(name) => {
            let commit = format!("{name}^{{commit}}");
            let found = git.text(&["rev-parse", "--verify", "--end-of-options", &commit]);
            found.map_err(|_| {
                Unreadable::Damaged(format!(
                    "has no commit, tag or branch {name} in its history"
                ))
            })?
        }
        Revision::Before(time) => {
            let found = git
                .text(&["rev-list", "-1", &format!("--before={time}"), "HEAD", "--"])
                .map_err(|error| match error {
                    Unreadable::Damaged(why) if why.contains("bad revision 'HEAD'") => {
                        Unreadable::Damaged("is a clone without a commit".into())
                    }
                    error => error,
                })?;
            if found.is_empty() {
                return Err(Unreadable::Damaged(format!(
                    "has no commit before {time}: its first commit is later"
                )));
            }
            found
        }
    };
    let commit = commit.trim();
    git.unpack(commit, |_| true, unpacker)?;
    git.times(commit)
}

/// The source files in the clone `folder` that differ from those of its last commit; none if it is no
/// clone, if there is no git, or if git cannot read it.
pub(super) fn uncommitted(folder: &Path, unpacker: Unpacker) -> Vec<String> {
    let mut unpacker = unpacker;
    let is_source = |path: &Path| {
        let is_rust = path.extension().is_some_and(|extension| extension == "rs");
        is_rust && path.iter().any(|name| name == "src")
    };
    let unpacked = clone_in(folder).and_then(|clone| {
        Git::of(&clone)?.unpack("HEAD", is_source, &mut unpacker)?;
        Ok(clone)
    });
    let Ok(clone) = unpacked else {
        return Vec::new();
    };
    let (committed, _) = unpacker.finish();
    let top = clone.parent().filter(|_| clone.ends_with(".git"));
    let Some(top) = top else {
        return Vec::new(); // a clone without files
    };
    let mut names = BTreeSet::new();
    for folder in [committed.path(), top] {
        let all = for_each_file(folder, &mut |path| {
            let name = path.strip_prefix(folder).ok();
            names.extend(name.filter(|name| is_source(name)).map(PathBuf::from));
        });
        if !matches!(all, Ok(true)) {
            return Vec::new();
        }
    }
    // Git may have written other ends of lines.
    let text = |folder: &Path, name: &Path| {
        let text = small_file(&folder.join(name), MAX_COMPARED);
        text.map(|mut text| {
            text.retain(|byte| *byte != b'\r');
            text
        })
    };
    let differs = |name: &&PathBuf| text(committed.path(), name) != text(top, name);
    let names = names.iter().filter(differs);
    names.map(|name| sources::with_slashes(name)).collect()
}

/// Whether `folder` is a clone that has no files beside its history.
pub(super) fn is_without_files(folder: &Path, is_empty: bool) -> bool {
    clone_in(folder).is_ok_and(|clone| is_empty || clone == folder)
}

/// The most bytes of a file that is compared with the one in the last commit.
const MAX_COMPARED: u64 = 1 << 20;

/// The folder that has the `objects` of the clone in `folder`: `folder/.git`, `folder` itself, or
/// the `.git` of the only subfolder that has one.
fn clone_in(folder: &Path) -> Result<PathBuf, Unreadable> {
    // Links are not followed: they may lead to the clone of somebody else.
    let is_git = |path: &Path| {
        is_folder(path)
            && is_folder(&path.join("objects"))
            && is_folder(&path.join("refs"))
            && path
                .join("HEAD")
                .symlink_metadata()
                .is_ok_and(|kind| kind.is_file())
    };
    let candidates = [folder.join(".git"), folder.to_path_buf()];
    if let Some(found) = candidates.into_iter().find(|path| is_git(path)) {
        return Ok(found);
    }
    let mut below: Vec<PathBuf> = std::fs::read_dir(folder)
        .into_iter()
        .flatten()
        .flatten()
        .filter(|entry| entry.file_type().is_ok_and(|kind| kind.is_dir()))
        .map(|entry| entry.path().join(".git"))
        .filter(|path| is_git(path))
        .collect();
    match below.len() {
        1 => Ok(below.remove(0)),
        _ => Err(Unreadable::NoClone(
            "is no git clone: expected a folder .git in it, and no link, because a commit or a time was asked for".into(),
        )),
    }
}

/// Whether `path` is a folder, and no link to one.
fn is_folder(path: &Path) -> bool {
    path.symlink_metadata().is_ok_and(|kind| kind.is_dir())
}

/// Runs git on the objects of somebody else's clone.
struct Git {
    own: TempFolder,
    objects: PathBuf,
}

impl Git {
    /// Makes a repository without objects, and copies into it what names the clone's commits.
    fn of(clone: &Path) -> Result<Git, Unreadable> {
        let own = interrupt::temp_folder()?;
        let objects = clone.join("objects");
        let mut files = 0;
        check_plain(&objects, &mut files)?;
        if objects.join("info/alternates").exists() {
            return Err(Unreadable::Damaged(
                "is a clone that borrows objects from another one: refused. Ask for a full clone"
                    .into(),
            ));
        }
        let mut copied = 0;
        let mut write = |name: &str, text: &[u8]| {
            copied += (text.len() as u64).max(BLOCK);
            if copied > MAX_REFS {
                return Err(Unreadable::TooLarge(format!(
                    "has names of commits of more than {} MB: ask for a new clone",
                    MAX_REFS >> 20
                )));
            }
            let path = own.path().join(name);
            let folder = path.parent().unwrap_or(&path).to_path_buf();
            std::fs::create_dir_all(&folder)
                .and_then(|()| std::fs::write(&path, text))
                .map_err(|e| Unreadable::from(GraderError::file("write", &path, e)))
        };
        write(
            "config",
            b"[core]\n\trepositoryformatversion = 0\n\tbare = true\n",
        )?;
        for name in ["objects", "refs"] {
            let folder = own.path().join(name);
            std::fs::create_dir_all(&folder)
                .map_err(|e| Unreadable::from(GraderError::file("create", &folder, e)))?;
        }
        for name in ["HEAD", "packed-refs", "shallow"] {
            if let Some(text) = small_file(&clone.join(name), MAX_LIST_OF_REFS) {
                write(name, &text)?;
            }
        }
        let mut folders = vec![PathBuf::from("refs")];
        let mut names = 0;
        while let Some(folder) = folders.pop() {
            let Ok(entries) = std::fs::read_dir(clone.join(&folder)) else {
                continue;
            };
            for entry in entries.flatten() {
                let name = folder.join(entry.file_name());
                names += 1;
                if names > MAX_REF_FILES {
                    return Err(Unreadable::TooLarge(format!(
                        "has more than {MAX_REF_FILES} names of commits: ask for a new clone"
                    )));
                }
                if entry.file_type().is_ok_and(|kind| kind.is_dir()) {
                    folders.push(name);
                } else if let (Some(text), Some(name)) =
                    (small_file(&entry.path(), MAX_REF), name.to_str())
                {
                    write(name, &text)?;
                }
            }
        }
        Ok(Git { own, objects })
    }

    fn command(&self) -> Command {
        let mut command = Command::new("git");
        command
            .env_clear()
            .envs(std::env::var_os("PATH").map(|path| ("PATH", path)))
            .envs(std::env::var_os("TZ").map(|zone| ("TZ", zone)))
            .env("HOME", self.own.path())
            .env("GIT_DIR", self.own.path())
            .env("GIT_OBJECT_DIRECTORY", &self.objects)
            .env("GIT_CONFIG_NOSYSTEM", "1")
            .env("GIT_NO_REPLACE_OBJECTS", "1")
            .env("GIT_NO_LAZY_FETCH", "1")
            .env("GIT_ALLOW_PROTOCOL", "none")
            .env("GIT_TERMINAL_PROMPT", "0")
            .current_dir(self.own.path())
            .stdin(Stdio::null());
        command
    }

    /// Unpacks the files of `commit` whose paths are `wanted`.
    fn unpack(
        &self,
        commit: &str,
        wanted: impl Fn(&Path) -> bool,
        unpacker: &mut Unpacker,
    ) -> Result<(), Unreadable> {
        let listed = self.text(&["ls-tree", "-r", "-l", "-z", "--full-tree", commit])?;
        let mut blobs = Vec::new();
        for line in listed.split_terminator('\0') {
            let unusual =
                || Unreadable::Damaged("has a list of files that git did not write".into());
            let (about, name) = line.split_once('\t').ok_or_else(unusual)?;
            let [mode, _, hash, size] = about.split_whitespace().collect::<Vec<_>>()[..] else {
                return Err(unusual());
            };
            let Some(path) = unpacker.path(name)?.filter(|path| wanted(path)) else {
                continue;
            };
            match (mode, size.parse()) {
                ("100644" | "100755", Ok(size)) => {
                    if unpacker.wants(&path, size) {
                        blobs.push((path, hash.to_string()));
                    }
                }
                // Symbolic links and submodules.
                _ => unpacker.link(&path),
            }
        }
        self.write_blobs(&blobs, unpacker)
    }

    /// Runs git and returns what it prints.
    fn text(&self, arguments: &[&str]) -> Result<String, Unreadable> {
        let mut command = self.command();
        command
            .args(arguments)
            .stdout(Stdio::piped())
            .stderr(Stdio::piped());
        let mut child = command.spawn().map_err(cannot_run)?;
        let stderr = child.stderr.take();
        let stderr =
            std::thread::spawn(move || stderr.map(child_processes::tail).unwrap_or_default());
        let mut output = Vec::new();
        if let Some(stdout) = child.stdout.take() {
            // Even a small clone may have a long list: its folders may repeat the same folder.
            let read = stdout.take(MAX_LIST + 1).read_to_end(&mut output);
            read.map_err(|e| match e.kind() {
                ErrorKind::OutOfMemory => Unreadable::TooLarge(
                    "has a list of files for which the program that reads it has no memory: ask for a new clone"
                        .into(),
                ),
                _ => Unreadable::Machine(format!("cannot read what git prints: {e}")),
            })?;
        }
        if output.len() as u64 > MAX_LIST {
            let _ = child.kill(); // git may have ended
            let _ = child.wait();
            return Err(Unreadable::TooLarge(format!(
                "has a list of files of more than {} MB in its history",
                MAX_LIST >> 20
            )));
        }
        let status = child.wait().map_err(cannot_run)?;
        let says = stderr.join().unwrap_or_default();
        match signals::signal(status) {
            Some(signals::SIGKILL) => return Err(killed()),
            Some(_) => return Err(stopped()),
            None => {}
        }
        if !status.success() {
            // The name of the temporary folder changes with each run, and tables must not.
            let own = self.own.path().display().to_string();
            return Err(Unreadable::Damaged(format!(
                "is a clone that git cannot read: {}",
                says.trim().replace(&own, ".git")
            )));
        }
        String::from_utf8(output).map_err(|_| {
            Unreadable::Damaged("has a file whose name is not UTF-8: rename it".into())
        })
    }

    /// When `commit` was made. The times of parents that a shallow clone lacks are not known.
    fn times(&self, commit: &str) -> Result<CommitTimes, Unreadable> {
        let unusual = || Unreadable::Damaged("has a commit that git did not write".into());
        let numbers = |line: &str| -> Option<Vec<i64>> {
            line.split(' ').map(|number| number.parse().ok()).collect()
        };
        let lines = self.text(&["log", "-1", "--format=%at %ct", commit, "--"])?;
        let own = numbers(lines.trim()).ok_or_else(unusual)?;
        let [author, committer] = own[..] else {
            return Err(unusual());
        };
        // A clone may call itself shallow to hide the parents that it has.
        let parents = self.text(&[
            "--shallow-file",
            "",
            "log",
            "--no-walk",
            "--format=%ct",
            &format!("{commit}^@"),
            "--",
        ]);
        let parents: Vec<i64> = parents
            .unwrap_or_default()
            .lines()
            .filter_map(|line| line.parse().ok())
            .collect();
        let now = SystemTime::now().duration_since(UNIX_EPOCH);
        let now = now.map_or(0, |now| now.as_secs() as i64);
        Ok(CommitTimes::new(author, committer, &parents, now))
    }

    /// Writes the files `blobs`, each a path and the hash of the file's contents.
    fn write_blobs(
        &self,
        blobs: &[(PathBuf, String)],
        unpacker: &mut Unpacker,
    ) -> Result<(), Unreadable> {
        let mut command = self.command();
        command
            .args(["cat-file", "--batch"])
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::null());
        let mut child = command.spawn().map_err(cannot_run)?;
        let (stdin, stdout) = (child.stdin.take(), child.stdout.take());
        let (Some(mut stdin), Some(stdout)) = (stdin, stdout) else {
            return Err(cannot_run(std::io::Error::other("it has no pipes")));
        };
        let mut stdout = BufReader::new(stdout);
        let written = blobs.iter().try_for_each(|(path, hash)| {
            // One question at a time: neither pipe can be full while the other one is waited for.
            writeln!(stdin, "{hash}").map_err(|_| incomplete(path))?;
            write_blob(&mut stdout, path, unpacker)
        });
        drop(stdin);
        drop(stdout);
        let _ = child.wait(); // what git wrote was checked
        written
    }
}

/// Reads one answer of `git cat-file --batch`, `HASH blob SIZE` and contents; writes the contents.
fn write_blob(
    stdout: &mut BufReader<ChildStdout>,
    path: &Path,
    unpacker: &mut Unpacker,
) -> Result<(), Unreadable> {
    let mut header = String::new();
    stdout
        .read_line(&mut header)
        .map_err(|_| incomplete(path))?;
    let size = header
        .split_whitespace()
        .nth(2)
        .and_then(|size| size.parse().ok());
    let Some(size) = size else {
        return Err(incomplete(path));
    };
    unpacker.write(path, stdout.by_ref().take(size))?;
    let mut newline = [0];
    // If the clone's copy of the contents is cut, git ends in the middle of its answer.
    let is_whole = stdout.read_exact(&mut newline).is_ok() && newline == *b"\n";
    is_whole.then_some(()).ok_or_else(|| incomplete(path))
}

fn incomplete(path: &Path) -> Unreadable {
    Unreadable::Damaged(format!(
        "is an incomplete clone: the contents of {} are missing or cut",
        path.display()
    ))
}

/// The error where a signal ended git, which has limits of time and memory.
fn stopped() -> Unreadable {
    Unreadable::TooLarge(
        "is a clone that git cannot read within the limits of time and memory: ask for a new clone"
            .into(),
    )
}

/// The error where the system ended git, which no limit of ours does.
fn killed() -> Unreadable {
    Unreadable::Machine(
        "cannot read it: the system killed git. Did the memory of the machine run out?".into(),
    )
}

fn cannot_run(e: std::io::Error) -> Unreadable {
    GraderError::new(format!("cannot run git: {e}. Is it installed?")).into()
}

fn too_many_files() -> Unreadable {
    Unreadable::TooLarge(format!("has a history of more than {MAX_GIT_FILES} files"))
}

/// The contents of a regular file of at most `most` bytes.
fn small_file(path: &Path, most: u64) -> Option<Vec<u8>> {
    let kind = path.symlink_metadata().ok()?;
    (kind.is_file() && kind.len() <= most).then(|| std::fs::read(path).ok())?
}

/// Checks that there are only folders and regular files below `folder`: a link may lead to the
/// objects of somebody else.
fn check_plain(folder: &Path, files: &mut usize) -> Result<(), Unreadable> {
    let failed = |e: std::io::Error| {
        unreadable("read", folder, &e, || {
            "has a folder .git that cannot be read".into()
        })
    };
    if !is_folder(folder) {
        return Err(Unreadable::Damaged(
            "has a link in its folder .git: refused".into(),
        ));
    }
    for entry in std::fs::read_dir(folder).map_err(failed)? {
        let entry = entry.map_err(failed)?;
        *files += 1;
        if *files > MAX_GIT_FILES {
            return Err(too_many_files());
        }
        let kind = entry.file_type().map_err(failed)?;
        if kind.is_dir() {
            check_plain(&entry.path(), files)?;
        } else if !kind.is_file() {
            return Err(Unreadable::Damaged(format!(
                "has a link in its folder .git, {}: refused",
                entry.file_name().display()
            )));
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dates_are_read_strictly() {
        let before = |text| Revision::before(text).map(|revision| revision.to_string());
        let at = |time: &str| Ok(format!("the last commit before {time}"));
        assert_eq!(before("2026-11-20"), at("2026-11-20T23:59:59"));
        assert_eq!(before("2026-11-20 18:00"), at("2026-11-20T18:00:00"));
        assert_eq!(before("2026-11-20T18:00:01Z"), at("2026-11-20T18:00:01Z"));
        assert_eq!(
            before("2026-11-20 18:00-0130"),
            at("2026-11-20T18:00:00-0130")
        );
        for wrong in [
            "tomorrow",
            "20.11.2026",
            "2026-13-01",
            "2026-11-20 25:00",
            "2026-11-20T",
            "ä026-11-2",
        ] {
            assert!(before(wrong).is_err(), "{wrong}");
        }
    }
}
