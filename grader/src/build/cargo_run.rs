//! Runs cargo and reads its messages: the program that it built, or what does not compile.

use crate::build::compile_errors::plain;
use crate::build::compile_warnings::Warnings;
use crate::build::{BuildLimit, CompileErrors, WORKER};
use base::child_processes::{self, Watchdog, tail};
use base::{GraderError, err};
use std::io::{BufRead, BufReader, Read};
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Duration;

/// Runs cargo to its end. Returns the path of the program that it built, or the compiler's errors.
/// `show` also prints the compiler's messages to stderr. If cargo is limited to `most_time`, a
/// compiler that crashes or exceeds a limit is an error of the code.
pub(crate) fn run_cargo(
    mut command: Command,
    package: &str,
    show: bool,
    most_time: Option<Duration>,
) -> Result<Result<PathBuf, CompileErrors>, GraderError> {
    let limited = most_time.is_some();
    let (mut child, running) = child_processes::start(&mut command).map_err(|e| {
        GraderError::new(format!(
            "cannot run cargo ({}): {e}. Is a Rust toolchain installed?",
            command.get_program().display()
        ))
    })?;
    let watchdog = most_time.map(|most| Watchdog::start(&running, most));
    let progress = child
        .stderr
        .take()
        .map(|pipe| std::thread::spawn(move || if show { pass_on(pipe) } else { tail(pipe) }));
    let stdout = child
        .stdout
        .take()
        .ok_or_else(|| GraderError::new("cannot read cargo's standard output"))?;
    let mut program = None;
    let mut errors = CompileErrors::default();
    let mut warnings = Warnings::default();
    let mut stdout = BufReader::new(stdout);
    while let Some(line) = read_line(&mut stdout)? {
        match Message::read(&line) {
            Some(Message::Program(path)) => program = Some(path),
            // The worker is no code of the student's.
            Some(Message::Warning { of_crate, .. }) if of_crate == WORKER => {}
            Some(Message::Warning { of_crate, says }) => warnings.add(&of_crate, says),
            None => {}
            Some(Message::Error {
                text,
                says,
                of_crate,
                has_place,
            }) => {
                if of_crate == WORKER && package == WORKER && has_place {
                    push_message(&mut errors.worker_messages, &text);
                } else {
                    if show {
                        err!("{text}");
                    }
                    push_message(&mut errors.messages, &text);
                }
                errors.add(&of_crate, says, has_place);
            }
        }
    }
    let killed = watchdog.is_some_and(Watchdog::stop);
    let status = match limited {
        true => running.wait(&mut child, ENDING),
        false => child.wait(),
    };
    let status = status.map_err(|e| GraderError::new(format!("cannot wait for cargo: {e}")))?;
    if show {
        err!("{}", warnings.summary());
    }
    let stderr = progress.map(|thread| thread.join().unwrap_or_default());
    let says = stderr.as_deref().unwrap_or(ABOVE);
    if limited && !status.success() {
        errors.add_crashes(says, killed);
    }
    match program {
        Some(program) if status.success() => Ok(Ok(program)),
        _ if killed || !errors.failed_crates.is_empty() => Ok(Err(errors)),
        // Not the fault of the code: a library is missing, for example, or a manifest is broken.
        _ => Err(GraderError::new(format!(
            "cargo could not build the package {package} in {} ({status}). {}",
            command
                .get_current_dir()
                .unwrap_or(Path::new("."))
                .display(),
            says.trim()
        ))),
    }
}

/// What an error says whose reason cargo has printed.
const ABOVE: &str = "Cargo's message is above.";

/// Prints what cargo does, line by line, but not that the worker does not compile: what this means
/// for the stage is printed instead.
fn pass_on(progress: impl Read) -> String {
    for line in BufReader::new(progress).split(b'\n').map_while(Result::ok) {
        let line = String::from_utf8_lossy(&line);
        if !is_of_the_worker(&plain(&line)) {
            err!("{line}\n");
        }
    }
    ABOVE.to_owned()
}

/// Whether cargo says that the worker has errors, or that it goes on with other crates.
fn is_of_the_worker(line: &str) -> bool {
    let has_errors =
        line.starts_with("error: could not compile `worker`") && line.contains(" due to ");
    has_errors || line.starts_with("warning: build failed, waiting")
}

/// How long cargo may run for a submission. Building one stage and the worker takes some seconds; on
/// a slow and busy machine, minutes. A compiler that does not end has a limit of processor time.
pub(crate) const MOST_TIME: Duration = Duration::from_secs(50 * 60);

/// How long cargo may take to end after its last message.
const ENDING: Duration = Duration::from_secs(60);

/// The longest message of cargo that is read, in bytes. Longer ones are skipped.
const MOST_OF_LINE: u64 = 4 << 20;

/// How much of the compiler's messages is kept.
const MOST_OF_MESSAGES: usize = 64 << 10;

/// Reads a line of cargo's output; `None` at the end. Of a line that is too long, nothing.
fn read_line(input: &mut impl BufRead) -> Result<Option<String>, GraderError> {
    let failed = |e| GraderError::new(format!("cannot read cargo's messages: {e}"));
    let mut bytes = Vec::new();
    let mut part = input.by_ref().take(MOST_OF_LINE);
    let length = part.read_until(b'\n', &mut bytes).map_err(failed)?;
    if length == 0 {
        return Ok(None);
    }
    if length as u64 == MOST_OF_LINE && bytes.last() != Some(&b'\n') {
        input.skip_until(b'\n').map_err(failed)?;
        bytes.clear();
    }
    Ok(Some(String::from_utf8_lossy(&bytes).into_owned()))
}

/// Appends a message of the compiler, as long as there are not too many.
fn push_message(messages: &mut String, text: &str) {
    if messages.len() >= MOST_OF_MESSAGES {
        return;
    }
    messages.push_str(text);
    if messages.len() >= MOST_OF_MESSAGES {
        let mut ends = (0..=MOST_OF_MESSAGES).rev();
        let end = ends.find(|end| messages.is_char_boundary(*end));
        messages.truncate(end.unwrap_or(0));
        messages.push_str("\n(The compiler's other messages are left out.)\n");
    }
}

impl CompileErrors {
    /// Adds an error of the compiler in a crate, which `says` this.
    pub(super) fn add(&mut self, of_crate: &str, says: String, has_place: bool) {
        self.failed_crates.insert(of_crate.to_owned());
        if has_place {
            self.wrong_crates.insert(of_crate.to_owned());
        } else {
            self.without_place.insert(of_crate.to_owned(), says);
        }
    }

    /// Adds the crates whose compiler ended without a message, which only cargo's last words
    /// `says` tell. `killed` says whether cargo was, because it took too long.
    fn add_crashes(&mut self, says: &str, killed: bool) {
        let crashed = says
            .split("could not compile `")
            .skip(1)
            .filter_map(|rest| rest.split_once('`'));
        for (name, why) in crashed {
            let is_new = self.failed_crates.insert(name.to_string());
            let limit = BuildLimit::of_compiler(why, says);
            if let (true, Some(limit)) = (is_new, limit) {
                self.limit = Some(limit);
                let text = format!("error: the compiler ended in `{name}`: {limit}\n");
                push_message(&mut self.messages, &text);
            } else if is_new {
                let text = format!("error: the compiler crashed in `{name}`\n");
                push_message(&mut self.messages, &text);
            }
        }
        if killed {
            self.limit = Some(BuildLimit::Time);
            let text = format!("error: building was ended: {}\n", BuildLimit::Time);
            push_message(&mut self.messages, &text);
        }
    }
}

impl BuildLimit {
    /// The limit that ended a compiler: `why` is cargo's sentence about it, `says` contains what
    /// it printed itself.
    fn of_compiler(why: &str, says: &str) -> Option<BuildLimit> {
        let signal = why
            .split_once("(signal: ")
            .and_then(|(_, rest)| rest.split([',', ')']).next());
        let no_memory = [
            "memory allocation of",
            "out of memory",
            "Cannot allocate memory",
        ];
        match signal {
            // SIGXCPU; the system kills a process that goes on.
            Some("24") => Some(BuildLimit::Time),
            // SIGXFSZ; the system kills a process for which there is no memory.
            Some("25" | "9") => Some(BuildLimit::Memory),
            _ if no_memory.iter().any(|words| says.contains(words)) => Some(BuildLimit::Memory),
            _ => None,
        }
    }
}

impl std::fmt::Display for BuildLimit {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            BuildLimit::Time => "it needs more time than a stage may take",
            BuildLimit::Memory => "it needs more memory than a stage may take",
        })
    }
}

/// The messages of cargo that matter here, read from its JSON output.
enum Message {
    /// A program was built, or was up to date.
    Program(PathBuf),
    /// A warning of the compiler about a crate: the place and its first sentence.
    Warning { of_crate: String, says: String },
    /// An error of the compiler in a crate: the whole text and its first sentence.
    Error {
        text: String,
        says: String,
        of_crate: String,
        /// Whether it is about a place of the code.
        has_place: bool,
    },
}

impl Message {
    fn read(line: &str) -> Option<Message> {
        let message: serde_json::Value = serde_json::from_str(line).ok()?;
        if let Some(program) = message.get("executable").and_then(|path| path.as_str()) {
            return Some(Message::Program(program.into()));
        }
        let diagnostic = message.get("message")?;
        let level = diagnostic.get("level")?.as_str()?;
        let text = with_true_advice(diagnostic.get("rendered")?.as_str()?);
        let of_crate = message.get("target")?.get("name")?.as_str()?.to_string();
        let says = diagnostic.get("message")?.as_str()?.to_string();
        let places = diagnostic.get("spans").and_then(|spans| spans.as_array());
        if !level.starts_with("error") {
            // Without a place it is the compiler's count of its messages.
            let lint = diagnostic["code"]["code"].as_str();
            let place = places?.first().filter(|_| lint != Some(ABOUT_DOCS))?;
            let (file, line) = (place["file_name"].as_str()?, &place["line_start"]);
            let says = format!("{file}:{line}: {says}");
            return Some(Message::Warning { of_crate, says });
        }
        Some(Message::Error {
            text,
            says,
            of_crate,
            has_place: places.is_some_and(|places| !places.is_empty()),
        })
    }
}

/// The lint that asks for documentation, which the functions that a student adds need not have.
const ABOUT_DOCS: &str = "missing_docs";

/// What the compiler's advice about crates that are not there begins and goes on with.
const ADVICE: [&str; 2] = ["if you wanted to use a crate named", "`cargo add "];

/// What is true instead.
const NO_OTHER_CRATES: &str =
    "a stage is built with the crates that the course's Cargo.toml lists, and with no others";

/// A message of the compiler, with true advice about crates that are not there.
fn with_true_advice(message: &str) -> String {
    let lines = message.split_inclusive('\n').map(|line| {
        let advice = line.find(ADVICE[0]).filter(|_| line.contains(ADVICE[1]));
        match advice {
            Some(start) => format!("{}{NO_OTHER_CRATES}\n", &line[..start]),
            None => line.to_owned(),
        }
    });
    lines.collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_that_are_too_long_are_skipped() {
        let long = "x".repeat(MOST_OF_LINE as usize + 7);
        let text = format!("a\n{long}\nb");
        let mut input = text.as_bytes();
        let mut lines = Vec::new();
        while let Some(line) = read_line(&mut input).unwrap() {
            lines.push(line);
        }
        assert_eq!(lines, ["a\n", "", "b"]);
    }

    fn read(rendered: &str, spans: serde_json::Value) -> (String, String, bool) {
        let line = serde_json::json!({
            "target": { "name": "bvh" },
            "message": { "level": "error", "message": "it", "rendered": rendered, "spans": spans },
        });
        match Message::read(&line.to_string()) {
            Some(Message::Error {
                text,
                of_crate,
                has_place,
                ..
            }) => (text, of_crate, has_place),
            _ => panic!("it is an error"),
        }
    }

    #[test]
    fn warnings_have_a_place_and_are_not_about_missing_documentation() {
        let told = |lint: &str, spans: serde_json::Value| {
            let line = serde_json::json!({
                "target": { "name": "bvh" },
                "message": {
                    "level": "warning", "message": "it", "rendered": "it", "spans": spans,
                    "code": { "code": lint },
                },
            });
            match Message::read(&line.to_string()) {
                Some(Message::Warning { says, .. }) => Some(says),
                _ => None,
            }
        };
        let place = serde_json::json!([{ "file_name": "a.rs", "line_start": 7 }]);
        let says = told("unused_variables", place.clone());
        assert_eq!(says.as_deref(), Some("a.rs:7: it"));
        assert_eq!(told("missing_docs", place), None);
        // The compiler's last words: how many messages there were.
        assert_eq!(told("", serde_json::json!([])), None);
    }

    #[test]
    fn only_errors_in_the_code_of_the_worker_are_not_passed_on() {
        let error = "error: could not compile `worker` (lib) due to 2 previous errors";
        assert!(is_of_the_worker(error));
        assert!(!is_of_the_worker(&error.replace("worker", "bvh")));
        assert!(!is_of_the_worker("error: could not compile `worker` (lib)"));
    }

    #[test]
    fn nobody_is_told_to_add_a_crate() {
        let rendered = "error: no `rand`\n  |\n  = help: if you wanted to use a crate named `rand`, use `cargo add rand` to add it to your `Cargo.toml`\n\n";
        let (text, ..) = read(rendered, serde_json::json!([{}]));
        let expected = format!("error: no `rand`\n  |\n  = help: {NO_OTHER_CRATES}\n\n");
        assert_eq!(text, expected);
    }

    #[test]
    fn an_error_at_no_place_of_the_code_is_the_machines() {
        let errors_of = |spans| {
            let (_, of_crate, has_place) = read("error: it", spans);
            let mut errors = CompileErrors::default();
            errors.add(&of_crate, "it".into(), has_place);
            errors
        };
        let in_code = errors_of(serde_json::json!([{}]));
        assert_eq!(in_code.ensure_of_the_code(), Ok(()));
        let no_place = errors_of(serde_json::json!([]));
        let why = no_place.ensure_of_the_code().unwrap_err().to_string();
        assert!(
            why.starts_with("this machine cannot build `bvh`: it."),
            "{why}"
        );
    }

    #[test]
    fn messages_are_kept_up_to_a_limit() {
        let mut messages = String::new();
        for _ in 0..10_000 {
            push_message(&mut messages, "error: é\n");
        }
        assert!(messages.len() < MOST_OF_MESSAGES + 100);
        assert!(messages.ends_with("other messages are left out.)\n"));
    }

    #[test]
    fn a_compiler_that_ends_without_a_message_is_an_error_of_its_crate() {
        let ended = |how: &str, before: &str| {
            let says = format!(
                "{before}error: could not compile `bvh` (lib)\n\nCaused by:\n  process didn't exit successfully: `rustc --crate-name bvh` ({how})\n"
            );
            let mut errors = CompileErrors::default();
            errors.add_crashes(&says, false);
            assert!(errors.failed_crates.contains("bvh"));
            errors.limit
        };
        let (time, memory) = (Some(BuildLimit::Time), Some(BuildLimit::Memory));
        assert_eq!(
            ended("signal: 24, SIGXCPU: CPU time limit exceeded", ""),
            time
        );
        assert_eq!(
            ended("signal: 25, SIGXFSZ: file size limit exceeded", ""),
            memory
        );
        assert_eq!(ended("signal: 9, SIGKILL: kill", ""), memory);
        let no_memory = "memory allocation of 77 bytes failed\n";
        assert_eq!(
            ended("signal: 6, SIGABRT: process abort signal", no_memory),
            memory
        );
        assert_eq!(
            ended("signal: 11, SIGSEGV: invalid memory reference", ""),
            None
        );
    }

    #[test]
    fn a_crate_with_a_message_of_the_compiler_is_not_a_crash() {
        let mut errors = CompileErrors::default();
        errors.failed_crates.insert("bvh".into());
        errors.add_crashes("error: could not compile `bvh` (lib) due to 1 error", false);
        assert_eq!((errors.messages.as_str(), errors.limit), ("", None));
        errors.add_crashes("", true);
        assert_eq!(errors.limit, Some(BuildLimit::Time));
    }
}
