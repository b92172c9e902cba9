//! What a compiler may do that is given hostile code: run without end, take all memory, fill the
//! disk, print without end, die. No code here makes a compiler do so: a script stands for the
//! compiler. It does so where it compiles the stage that was handed in; where the limits are those
//! of another, or where the course's own stage is compiled to see whether the machine is at fault,
//! it compiles.

use crate::corpus::{Class, reference};
use files::file_tree::Files;
use grader::build::{BuildLimit, BuildOutcome};
use grader::workers::awake::Awake;
use std::os::unix::fs::PermissionsExt;
use std::path::{Path, PathBuf};
use std::time::Duration;
use submission::one::Outcome;

/// A way in which the compiler may end.
struct End {
    /// The part of the script.
    does: &'static str,
    limit: Option<BuildLimit>,
    says: &'static str,
}

/// The system ends what exceeds a limit with these signals; the compiler ends itself without memory.
const ENDS: [End; 5] = [
    End {
        does: "[ $(ulimit -t) != 300 ] || kill -XCPU $$",
        limit: Some(BuildLimit::Time),
        says: "more time than a stage may take",
    },
    End {
        does: "[ $(ulimit -v) != 4194304 ] || { echo memory allocation of 77 bytes failed >&2; kill -ABRT $$; }",
        limit: Some(BuildLimit::Memory),
        says: "more memory than a stage may take",
    },
    End {
        // Shells count files in blocks of 512 or 1024 bytes.
        does: "case $(ulimit -f) in 1048576 | 524288) kill -XFSZ $$ ;; esac",
        limit: Some(BuildLimit::Memory),
        says: "more memory than a stage may take",
    },
    End {
        does: "kill -SEGV $$",
        limit: None,
        says: "the compiler crashed in `intersect`",
    },
    End {
        // A line of 25 MB.
        does: "yes | head -c 25000000 | tr '\\n' ' ' >&2; exit 1",
        limit: None,
        says: "the compiler crashed in `intersect`",
    },
];

/// What the code of [`handed_in`] has and the course's own has not.
const MARK: &str = "HANDED_IN";

/// The reference's stage, marked.
fn handed_in() -> Files {
    let mut files = reference("intersect");
    let root = files
        .get_mut(Path::new("lib.rs"))
        .expect("the crate's root");
    root.extend(format!("\n/// A mark.\npub const {MARK}: bool = true;\n").bytes());
    files
}

/// A script in place of the compiler that does this where it compiles the marked stage.
fn compiler(folder: &Path, does: &str) -> PathBuf {
    let found = std::process::Command::new("rustc")
        .args(["--print", "sysroot"])
        .output()
        .expect("there is a compiler");
    let sysroot = String::from_utf8(found.stdout).expect("a path");
    let real = Path::new(sysroot.trim()).join("bin/rustc");
    let script = format!(
        "#!/bin/sh\nfor file; do case $file in *lib.rs) if grep -q {MARK} \"$file\"; then\n{does}\nfi ;; esac; done\nexec \"{}\" \"$@\"\n",
        real.display()
    );
    let path = folder.join("rustc");
    std::fs::write(&path, script).expect("it can be written");
    let rights = std::fs::Permissions::from_mode(0o755);
    std::fs::set_permissions(&path, rights).expect("it is ours");
    path
}

#[test]
#[ignore = "builds submissions: a minute"]
fn a_compiler_that_exceeds_a_limit_or_dies_is_the_end_of_its_submission() {
    let folder = tempfile::tempdir().expect("a folder");
    for End { does, limit, says } in ENDS {
        let class = Class::with_compiler(&compiler(folder.path(), does));
        let graded = class.grade(&handed_in(), 1).expect(does);
        let expected = limit.map_or(Outcome::DoesNotCompile, Outcome::OverLimit);
        assert_eq!(graded.outcome, expected, "{does}");
        let report = graded.report;
        assert!(
            report.compiler.contains(says),
            "{does}: {}",
            report.compiler
        );
        assert_eq!(report.scores.score, 0.0, "{does}");
    }
    let harmless = compiler(folder.path(), ":");
    Class::with_compiler(&harmless).still_grades_the_reference();
}

#[test]
#[ignore = "builds a submission: seconds"]
fn a_compiler_that_waits_is_ended() {
    let folder = tempfile::tempdir().expect("a folder");
    let class = Class::with_compiler(&compiler(folder.path(), "exec sleep 100000"));
    let end = Awake::now() + Duration::from_secs(3);
    let BuildOutcome::DoesNotCompile(errors) = class.build(&handed_in(), Some(end)) else {
        panic!("it compiles")
    };
    assert_eq!(errors.limit, Some(BuildLimit::Time));
}
