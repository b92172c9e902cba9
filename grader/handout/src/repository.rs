//! Makes a folder a git repository with one commit: the handout as it was received.

use std::path::Path;
use std::process::{Command, Stdio};

/// What became of it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Repository {
    /// It has one commit.
    Committed,
    /// It has one commit, by the course, because git knows no name of the user.
    WithoutName,
    /// There is none, for this reason.
    Missing(String),
}

/// The author of the commit where git knows no other.
const AUTHOR: [&str; 4] = [
    "-c",
    "user.name=First Light",
    "-c",
    "user.email=first-light@localhost",
];

/// Neither the user's hooks nor signatures: nobody is there to answer their questions.
const COMMIT: [&str; 7] = [
    "-c",
    "commit.gpgsign=false",
    "commit",
    "--quiet",
    "--no-verify",
    "--message",
    "The folder as grader start made it",
];

impl Repository {
    /// Makes the folder `out` a repository, with all files that are in it.
    pub fn create(out: &Path) -> Repository {
        Repository::create_with("git", out)
    }

    fn create_with(program: &str, out: &Path) -> Repository {
        let git = |arguments: &[&str]| run(program, out, arguments);
        // A rule of the user's own, such as to ignore `.vscode`, is about other projects.
        let added = git(&["init", "--quiet"]).and_then(|()| git(&["add", "--all", "--force"]));
        match added {
            Err(why) => Repository::Missing(why),
            Ok(()) if git(&COMMIT).is_ok() => Repository::Committed,
            Ok(()) => match git(&[&AUTHOR[..], &COMMIT].concat()) {
                Ok(()) => Repository::WithoutName,
                Err(why) => Repository::Missing(why),
            },
        }
    }

    /// A sentence about it.
    pub fn sentence(&self) -> String {
        match self {
            Repository::Committed => {
                "It is a git repository with one commit: `git diff` shows what you changed, `git checkout FILE` takes it \
                 back."
                    .into()
            }
            Repository::WithoutName => {
                "It is a git repository with one commit: `git diff` shows what you changed, `git checkout FILE` takes it \
                 back. Git knows no name for your own commits: `git config --global user.name NAME` and `user.email \
                 ADDRESS` set it."
                    .into()
            }
            Repository::Missing(why) => format!(
                "It is no git repository with a commit, so `git diff` and `git checkout FILE` do not work there: {why}"
            ),
        }
    }
}

/// Runs git in the folder `out`, with the variables of no other repository. The error says what
/// failed.
fn run(program: &str, out: &Path, arguments: &[&str]) -> Result<(), String> {
    let mut command = Command::new(program);
    for variable in ["GIT_DIR", "GIT_WORK_TREE", "GIT_INDEX_FILE"] {
        command.env_remove(variable);
    }
    let output = command
        .current_dir(out)
        .args(arguments)
        .stdin(Stdio::null())
        .output()
        .map_err(|e| format!("git cannot be run ({e})"))?;
    let says = String::from_utf8_lossy(&output.stderr);
    let last = says.lines().map(str::trim).rfind(|line| !line.is_empty());
    match output.status.success() {
        true => Ok(()),
        false => Err(format!(
            "git failed ({})",
            last.unwrap_or("without a message")
        )),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    #[test]
    fn everything_is_committed_even_what_is_ignored() {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join(".gitignore"), "a.rs\n").unwrap();
        fs::write(folder.path().join("a.rs"), "fn a() {}\n").unwrap();
        let repository = Repository::create(folder.path());
        assert_ne!(repository, Repository::Missing(String::new()));
        fs::write(folder.path().join("a.rs"), "").unwrap();
        run("git", folder.path(), &["checkout", "a.rs"]).expect("it was committed");
        let text = fs::read_to_string(folder.path().join("a.rs")).unwrap();
        assert_eq!(text, "fn a() {}\n");
    }

    #[test]
    fn without_git_the_sentence_says_so() {
        let folder = tempfile::tempdir().unwrap();
        let repository = Repository::create_with("no-such-program", folder.path());
        assert!(
            repository.sentence().contains("git cannot be run"),
            "{repository:?}"
        );
    }
}
