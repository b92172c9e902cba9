//! The process in which one submission is read, and its limits.

use super::content::{self, Content, Unreadable};
use super::intake::Revision;
use super::signals::{SIGKILL, signal};
use crate::entries::Entry;
use base::GraderError;
use base::Workspace;
use base::child_processes::{self, Watchdog};
use base::interrupt;
use grader::course::Course;
use std::io::{Read, Write};
use std::path::{Path, PathBuf};
use std::process::{Command, ExitStatus, Stdio};
use std::time::Duration;
use submission::containment::{Containment, Limits, Policy};
use submission::{Layout, shown};

/// The first argument of the process. It is not a command for people.
pub const COMMAND: &str = "read-submission";

/// The limits of a process that reads.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ReadingLimits {
    /// Processor time of each of its processes, in seconds. A whole project takes 0.1 s.
    pub cpu_seconds: u64,
    /// Elapsed time: the process is killed afterwards.
    pub elapsed: Duration,
    /// Address space of each of its processes, in megabytes.
    pub memory_mb: u64,
    /// What it may return, in bytes: somewhat more than may be unpacked.
    pub output: u64,
}

/// The limits that a class is read with.
pub const LIMITS: ReadingLimits = ReadingLimits {
    // On a slow machine git takes a minute for the longest list of files that is read.
    cpu_seconds: 300,
    elapsed: Duration::from_secs(3000),
    memory_mb: 1024,
    output: 80 << 20,
};

/// The largest file that may be written while reading, in megabytes.
const FILE_MB: u64 = 128;

/// How long the process may take to end after its last words.
const ENDING: Duration = Duration::from_secs(60);

/// Where programs and their libraries are, git among them.
const SYSTEM: [&str; 8] = [
    "/bin",
    "/lib",
    "/lib32",
    "/lib64",
    "/nix/store",
    "/opt",
    "/sbin",
    "/usr",
];

/// What git and the C library read: the time zone, which libraries there are.
const SETTINGS: [&str; 4] = [
    "/etc/ld.so.cache",
    "/etc/localtime",
    "/etc/timezone",
    "/dev/urandom",
];

/// Reads submissions.
#[derive(Clone, Debug)]
pub struct Reader {
    program: PathBuf,
    containment: Containment,
    course: PathBuf,
    limits: ReadingLimits,
}

impl Reader {
    /// A reader for submissions to the course `workspace`. `program` is the program `class`: it reads
    /// if [`COMMAND`] is its first argument.
    pub fn new(
        program: &Path,
        workspace: &Workspace,
        containment: Containment,
        limits: ReadingLimits,
    ) -> Reader {
        Reader {
            program: program.to_path_buf(),
            containment,
            course: workspace.root().to_path_buf(),
            limits,
        }
    }

    /// Reads `entry` of the folder `class`, as [`Reader::read`] does.
    pub fn read_entry(
        &self,
        class: &Path,
        entry: &Entry,
        revision: Option<&Revision>,
    ) -> Result<Content, Unreadable> {
        match entry.problem {
            Some(problem) => Err(Unreadable::Damaged(problem.to_string())),
            None => self.read(&class.join(&entry.file), revision),
        }
    }

    /// Reads the folder or file `path`, at a commit of it if there is a `revision`.
    pub fn read(&self, path: &Path, revision: Option<&Revision>) -> Result<Content, Unreadable> {
        let output = self.output(path, revision);
        decode(&output.map_err(|why| self.unless_the_machine_failed(why))?)
    }

    /// What the process printed that read it.
    fn output(&self, path: &Path, revision: Option<&Revision>) -> Result<Vec<u8>, Unreadable> {
        let temporary = interrupt::temp_folder()?;
        // The process has another current folder.
        let path = &std::path::absolute(path).map_err(|e| machine(&e))?;
        let mut command = self.command(path, temporary.path());
        command.arg(COMMAND).arg(&self.course).arg(path);
        if let Some(revision) = revision {
            let revision = serde_json::to_string(revision);
            command.arg(revision.map_err(|e| machine(&e))?);
        }
        command
            .stdin(Stdio::null())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped());
        let (mut child, running) = child_processes::start(&mut command).map_err(|e| machine(&e))?;
        let watchdog = Watchdog::start(&running, self.limits.elapsed);
        let stderr = child.stderr.take();
        let stderr =
            std::thread::spawn(move || stderr.map(child_processes::tail).unwrap_or_default());
        let mut output = Vec::new();
        let read = match child.stdout.take() {
            Some(stdout) => stdout.take(self.limits.output + 1).read_to_end(&mut output),
            None => Ok(0),
        };
        let is_flood = output.len() as u64 > self.limits.output;
        if is_flood {
            running.kill();
        }
        let is_late = watchdog.stop();
        let status = running.wait(&mut child, ENDING).map_err(|e| machine(&e))?;
        let status = self.containment.status_of_program(status);
        if !status.success() {
            running.kill(); // what it has started, such as git
        }
        let says = stderr.join().unwrap_or_default();
        read.map_err(|e| machine(&e))?;
        if is_flood {
            let most = self.limits.output >> 20;
            return Err(Unreadable::TooLarge(format!(
                "has more than {most} MB of source files: expected the folder stages, without build output"
            )));
        }
        if is_late {
            let most = self.limits.elapsed.as_secs();
            // Its processor time has a shorter limit: it waited.
            return Err(Unreadable::Machine(format!(
                "cannot read it within {most} seconds: does the disk or the network share answer?"
            )));
        }
        match status.success() {
            true => Ok(output),
            false => Err(self.why_ended(status, &says)),
        }
    }

    /// `why` the process returned nothing, if it can read the course's own stages: else the machine
    /// is the cause.
    fn unless_the_machine_failed(&self, why: Unreadable) -> Unreadable {
        let reads_the_course = || self.output(&self.course.join("stages"), None);
        match why {
            Unreadable::Machine(_) => why,
            _ => match reads_the_course() {
                Ok(_) => why,
                Err(same) => Unreadable::Machine(format!(
                    "nothing can be read here: the course's own folder stages {}",
                    same.why()
                )),
            },
        }
    }

    /// The command of the process, which may write to `temporary` alone. Its arguments are to be
    /// added.
    fn command(&self, path: &Path, temporary: &Path) -> Command {
        let system = SYSTEM.map(PathBuf::from).into_iter();
        let policy = Policy {
            // The course says which files the student was given.
            read: [path, &self.course]
                .map(Path::to_path_buf)
                .into_iter()
                .chain(SETTINGS.map(PathBuf::from))
                .collect(),
            run: system.chain([self.program.clone()]).collect(),
            write: vec![temporary.to_path_buf(), "/dev/null".into()],
            processes: true,
            limits: Limits {
                cpu_seconds: Some(self.limits.cpu_seconds),
                memory_mb: Some(self.limits.memory_mb),
                file_mb: Some(FILE_MB),
                ..Limits::default()
            },
            ..Policy::default()
        };
        let mut command = match self.containment.is_sandbox() {
            true => self.containment.command(&self.program, &policy),
            false => self.with_ulimit(),
        };
        command
            .env_clear()
            .envs(["PATH", "TZ"].into_iter().filter_map(|name| {
                let value = std::env::var_os(name)?;
                Some((name, value))
            }))
            .env("LC_ALL", "C")
            .env("HOME", temporary)
            .env("TMPDIR", temporary)
            .current_dir("/");
        command
    }

    /// The program under the limits that a shell can set.
    fn with_ulimit(&self) -> Command {
        if cfg!(not(unix)) {
            return Command::new(&self.program);
        }
        let kilobytes = self.limits.memory_mb << 10;
        let mut command = Command::new("sh");
        // macOS has no limit of the address space.
        // Only the soft limit ends a process with a signal of its own.
        let script =
            "ulimit -c 0; ulimit -S -t \"$1\"; ulimit -v \"$2\" 2> /dev/null; shift 2; exec \"$@\"";
        command
            .args(["-c", script, "sh"])
            .arg(self.limits.cpu_seconds.to_string())
            .arg(kilobytes.to_string())
            .arg(&self.program);
        command
    }

    /// Why a process ended that returned nothing.
    fn why_ended(&self, status: ExitStatus, says: &str) -> Unreadable {
        let ReadingLimits {
            cpu_seconds,
            memory_mb,
            ..
        } = self.limits;
        let is_said = |line: &&str| !line.trim().is_empty() && !line.starts_with("note: ");
        let last = says.lines().rfind(is_said);
        let last = shown(last.unwrap_or("it printed nothing").trim(), Layout::Line);
        // What is too large for the limits ends the allocator, not only the process.
        if says.contains("memory allocation of") {
            return Unreadable::TooLarge(format!(
                "cannot be read within {memory_mb} MB of memory: ask for an archive that was made anew"
            ));
        }
        match (signal(status), status.code()) {
            (Some(SIGXCPU), _) => Unreadable::TooLarge(format!(
                "cannot be read within {cpu_seconds} seconds of processor time: expected the folder stages, without build output"
            )),
            (Some(SIGKILL), _) => Unreadable::Machine(
                "cannot read it: the system killed the program that reads it. Did the memory of the machine run out?".into(),
            ),
            (Some(number), _) => Unreadable::Damaged(format!(
                "ends the program that reads it (signal {number}: {last}). Ask for an archive that was made anew"
            )),
            // A panic of Rust.
            (None, Some(101)) => Unreadable::Damaged(format!(
                "ends the program that reads it ({last}). Ask for an archive that was made anew"
            )),
            (None, _) => Unreadable::Machine(format!("cannot read it: {last} ({status})")),
        }
    }
}

/// The signal that ends a process whose processor time is used up.
const SIGXCPU: i32 = 24;

fn machine(e: &dyn std::fmt::Display) -> Unreadable {
    Unreadable::Machine(format!("cannot read it in a process of its own: {e}"))
}

/// Reads what the process returned.
fn decode(output: &[u8]) -> Result<Content, Unreadable> {
    let read = postcard::from_bytes(output);
    read.map_err(|e| machine(&format!("its answer has another form: {e}")))?
}

/// What the process does: reads the submission that its arguments name (the course, the path, and
/// perhaps the revision), and writes the result to standard output.
pub fn run(arguments: impl IntoIterator<Item = std::ffi::OsString>) -> Result<(), GraderError> {
    let expected = || GraderError::new(format!("expected {COMMAND} COURSE PATH [REVISION]"));
    let arguments: Vec<_> = arguments.into_iter().collect();
    let (course, path, revision) = match arguments.as_slice() {
        [course, path] => (course, path, None),
        [course, path, revision] => (course, path, revision.to_str()),
        _ => return Err(expected()),
    };
    let revision = revision
        .map(serde_json::from_str::<Revision>)
        .transpose()
        .map_err(|_| expected())?;
    // In the sandbox nothing beside the course can be read, nor the teacher's files of a term.
    let workspace = Workspace::above_as_it_is(Path::new(course))?;
    let course = Course::read(&workspace)?;
    let read = content::read(Path::new(path), &course, &workspace, revision.as_ref());
    let failed = |e: &dyn std::fmt::Display| GraderError::new(format!("cannot return it: {e}"));
    let bytes = postcard::to_allocvec(&read).map_err(|e| failed(&e))?;
    std::io::stdout().write_all(&bytes).map_err(|e| failed(&e))
}
