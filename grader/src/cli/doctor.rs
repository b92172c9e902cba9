//! The command `grader doctor`: what this machine lacks, and how to get it.

use super::offline;
use crate::report::terminal::Page;
use crate::report::wrap::wrap;
use base::program::Exit;
use base::{GraderError, Workspace, browser, interrupt, outln};
use clap::Command as CommandLine;
use std::path::Path;
use std::process::{Command, Stdio};

pub(super) fn command() -> CommandLine {
    CommandLine::new("doctor")
        .about("Says what this machine lacks for the course, and how to get it")
}

/// One thing that a machine has or lacks.
struct Finding {
    what: &'static str,
    state: State,
    /// What was found, or what to do.
    says: String,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum State {
    Good,
    /// Something works less well without it.
    Optional,
    /// Nothing can be graded without it.
    Missing,
}

impl Finding {
    fn new(what: &'static str, state: State, says: impl Into<String>) -> Finding {
        let says = says.into();
        Finding { what, state, says }
    }
}

/// Columns before the sentences: 8 for the mark and 11 for what it is about.
const INDENT: usize = 19;

pub(super) fn run() -> Result<Exit, GraderError> {
    let workspace = Workspace::above(Path::new("."))?;
    let findings = [
        toolchain(&workspace),
        linker()?,
        space(workspace.root()),
        libraries(&workspace),
        browser(),
        editor(workspace.root()),
    ];
    let page = Page::of_stdout();
    for Finding { what, state, says } in &findings {
        let mark = match state {
            State::Good => "ok",
            State::Optional => "note",
            State::Missing => "missing",
        };
        let lines = wrap(says, 0, page.width.saturating_sub(INDENT));
        for (at, line) in lines.iter().enumerate() {
            let [mark, what] = if at == 0 { [mark, *what] } else { [""; 2] };
            outln!("{mark:<8}{what:<11}{line}");
        }
    }
    let is_missing = findings
        .iter()
        .any(|finding| finding.state == State::Missing);
    Ok(if is_missing {
        Exit::Failed
    } else {
        Exit::Passed
    })
}

/// The first line that a program prints; `None` if it does not run.
fn first_line(program: &str, argument: &str) -> Option<String> {
    let output = Command::new(program).arg(argument).output().ok()?;
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    output.status.success().then_some(())?;
    Some(text.lines().next().unwrap_or_default().to_owned())
}

/// The version of Rust that the window needs.
const FOR_THE_WINDOW: [u32; 2] = [1, 95];

fn toolchain(workspace: &Workspace) -> Finding {
    let name = "toolchain";
    let manifest = std::fs::read_to_string(workspace.root().join("Cargo.toml")).unwrap_or_default();
    let needed = manifest
        .lines()
        .find_map(|line| line.strip_prefix("rust-version = "));
    let needed = needed.and_then(|text| version(text.trim_matches('"')));
    let Some(found) = first_line("rustc", "--version") else {
        let how = "there is no rustc: install Rust with https://rustup.rs";
        return Finding::new(name, State::Missing, how);
    };
    match version(found.trim_start_matches("rustc ")) {
        Some(have) if needed.is_some_and(|needed| have < needed) => {
            let how = format!("{found} is too old: run `rustup update stable`");
            Finding::new(name, State::Missing, how)
        }
        Some(have) if have < FOR_THE_WINDOW => {
            let [major, minor] = FOR_THE_WINDOW;
            let how = format!("{found}; the window needs {major}.{minor}: `rustup update stable`");
            Finding::new(name, State::Optional, how)
        }
        _ => Finding::new(name, State::Good, found),
    }
}

/// The first two numbers of a version such as "1.95.0 (5980761 2026-04-14)".
fn version(text: &str) -> Option<[u32; 2]> {
    let mut numbers = text.split('.');
    let mut next = || numbers.next()?.parse().ok();
    Some([next()?, next()?])
}

/// Compiles and links an empty program.
fn linker() -> Result<Finding, GraderError> {
    let folder = interrupt::temp_folder()?;
    let source = folder.path().join("empty.rs");
    std::fs::write(&source, "fn main() {}\n")
        .map_err(|e| GraderError::file("write", &source, e))?;
    let mut rustc = Command::new("rustc");
    rustc
        .current_dir(folder.path())
        .args(["--edition", "2024"])
        .arg(&source);
    let output = rustc.stdin(Stdio::null()).output();
    Ok(match output {
        Ok(output) if output.status.success() => {
            Finding::new("linker", State::Good, "an empty program compiles and links")
        }
        Ok(output) => {
            let says = String::from_utf8_lossy(&output.stderr).into_owned();
            let first = says.lines().next().unwrap_or("rustc failed").to_owned();
            Finding::new(
                "linker",
                State::Missing,
                format!("{first}: {}", how_to_link()),
            )
        }
        Err(e) => Finding::new("linker", State::Missing, format!("cannot run rustc: {e}")),
    })
}

/// How to get a linker.
fn how_to_link() -> &'static str {
    if cfg!(windows) {
        "install the Visual Studio Build Tools with \"Desktop development with C++\""
    } else if cfg!(target_os = "macos") {
        "run `xcode-select --install`"
    } else {
        "install a C compiler, such as `sudo apt install gcc` or `sudo dnf install gcc`"
    }
}

/// What a build of every program, the window included, takes, in MB.
const SPACE: u64 = 4000;

/// The free space of the disk that the project is on, as `df` prints it.
fn space(root: &Path) -> Finding {
    let output = Command::new("df").arg("-Pk").arg(root).output();
    let text = output.map(|output| String::from_utf8_lossy(&output.stdout).into_owned());
    let free = text.ok().and_then(|text| free_megabytes(&text));
    match free {
        None => {
            let says = format!("not known: grading and the window need {SPACE} MB");
            Finding::new("space", State::Optional, says)
        }
        Some(free) if free < SPACE => {
            let says = format!(
                "{free} MB are free: grading needs 1000 MB, everything with the window {SPACE} MB; \
                 `cargo clean` removes what was built"
            );
            Finding::new("space", State::Optional, says)
        }
        Some(free) => Finding::new("space", State::Good, format!("{free} MB are free")),
    }
}

/// The fourth column of the second line: what is available, in units of 1024 bytes.
fn free_megabytes(df: &str) -> Option<u64> {
    let mut columns = df.lines().nth(1)?.split_whitespace();
    let kilobytes: u64 = columns.nth(3)?.parse().ok()?;
    Some(kilobytes / 1024)
}

fn libraries(workspace: &Workspace) -> Finding {
    match offline::is_complete(workspace.root()) {
        true => Finding::new(
            "libraries",
            State::Good,
            "every command works without a network",
        ),
        false => Finding::new(
            "libraries",
            State::Optional,
            "some commands would download libraries: `cargo grader offline` does so for all of them",
        ),
    }
}

/// Browsers that are looked for where no page can be opened.
const BROWSERS: [&str; 5] = [
    "chromium",
    "chromium-browser",
    "google-chrome",
    "firefox",
    "epiphany",
];

fn browser() -> Finding {
    if browser::is_there() {
        return Finding::new("browser", State::Good, "pages and pictures are opened");
    }
    let folders: Vec<_> =
        std::env::split_paths(&std::env::var_os("PATH").unwrap_or_default()).collect();
    let is_there = |name: &&&str| folders.iter().any(|folder| folder.join(name).is_file());
    let found = match BROWSERS.iter().find(is_there) {
        Some(name) => format!(
            "{name} is installed, but this session has no screen or no `xdg-open` to open pages with"
        ),
        None => "none is found here".into(),
    };
    let says = format!(
        "{found}: open the pages yourself whose paths `cargo grader look` prints; \
         `cargo grader look --no-page` draws in the terminal"
    );
    Finding::new("browser", State::Optional, says)
}

/// Files that set up an editor, and the editor.
const EDITOR_FILES: [(&str, &str); 3] = [
    (".vscode/settings.json", "VS Code"),
    (".zed/settings.json", "Zed"),
    (".helix/languages.toml", "Helix"),
];

/// Whether an editor would show what `grader check` finds.
fn editor(root: &Path) -> Finding {
    let is_set_up = |path: &str| {
        let text = std::fs::read_to_string(root.join(path));
        text.is_ok_and(|text| text.contains("\"grader\"") && text.contains("\"check\""))
    };
    let editors: Vec<&str> = EDITOR_FILES
        .iter()
        .filter(|(path, _)| is_set_up(path))
        .map(|(_, name)| *name)
        .collect();
    let check = "set rust-analyzer's `check.overrideCommand` to [\"cargo\", \"grader\", \"check\", \"--message-format=json\"]";
    if editors.is_empty() {
        let how = format!("no editor is set up in this folder: {check}");
        return Finding::new("editor", State::Optional, how);
    }
    let editors = editors.join(", ");
    match first_line("rust-analyzer", "--version") {
        Some(version) => {
            let says = format!("{version}; {editors} are set up. In others, {check}");
            Finding::new("editor", State::Good, says)
        }
        None => {
            let says = format!(
                "{editors} are set up, but there is no rust-analyzer on the path: VS Code's and Zed's extensions \
                 bring one, for others `rustup component add rust-analyzer`"
            );
            Finding::new("editor", State::Optional, says)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn versions_are_compared_by_their_numbers() {
        assert_eq!(version("1.95.0 (5980761 2026-04-14)"), Some([1, 95]));
        assert!(version("1.100.0") > version("1.89"));
        assert_eq!(version("nightly"), None);
    }

    #[test]
    fn the_free_space_is_the_fourth_column() {
        let df = "Filesystem 1024-blocks Used Available Capacity Mounted on\n/dev/sda1 100000 60000 20480 60% /home\n";
        assert_eq!(free_megabytes(df), Some(20));
        assert_eq!(free_megabytes(""), None);
    }

    #[test]
    fn an_editor_is_set_up_by_its_file() {
        let folder = tempfile::tempdir().unwrap();
        let of = || editor(folder.path()).says;
        assert!(of().starts_with("no editor is set up"), "{}", of());
        std::fs::create_dir(folder.path().join(".zed")).unwrap();
        let settings = r#"{"overrideCommand": ["cargo", "grader", "check"]}"#;
        std::fs::write(folder.path().join(".zed/settings.json"), settings).unwrap();
        assert!(
            of().contains("Zed") && !of().contains("VS Code are"),
            "{}",
            of()
        );
    }
}
