//! Why there is no picture, as it is told.

use kit::hole::Hole;
use pathtracer::{EnvironmentFileError, OutputError};
use scenes::SceneError;
use std::any::Any;
use std::io::{IsTerminal, stderr};
use std::process::ExitCode;

/// Exit code when a stage is not written yet, or broke off.
const STAGE_FAILED: u8 = 1;
/// Exit code for input that cannot be used; `clap` has the same for flags.
const BAD_INPUT: u8 = 2;

/// What ends the program before there is a picture.
#[derive(Debug)]
pub(crate) enum Failure {
    /// A flag or a picture file cannot be used.
    Input(String),
    /// A scene or camera file cannot be read.
    Scene(SceneError),
    /// A stage is not written yet.
    Hole(Hole),
    /// A stage broke off, and its panic has been told.
    Panic,
}

impl Failure {
    /// From what a panic carries.
    pub(crate) fn of_panic(payload: Box<dyn Any + Send>) -> Failure {
        match payload.downcast::<Hole>() {
            Ok(hole) => Failure::Hole(*hole),
            Err(_) => Failure::Panic,
        }
    }

    /// Tells what happened; returns the program's exit code.
    pub(crate) fn report(&self) -> ExitCode {
        match self {
            Failure::Input(why) => eprintln!("error: {why}"),
            Failure::Scene(why) if stderr().is_terminal() => eprintln!("{}", why.styled()),
            Failure::Scene(why) => eprintln!("{why}"),
            Failure::Hole(hole) => eprintln!("{hole}: {}", way_around(hole)),
            Failure::Panic => eprintln!("no picture: a stage panicked, see above"),
        }
        ExitCode::from(match self {
            Failure::Input(_) | Failure::Scene(_) => BAD_INPUT,
            Failure::Hole(_) | Failure::Panic => STAGE_FAILED,
        })
    }
}

/// What to do about a hole, other than to write it.
fn way_around(hole: &Hole) -> &'static str {
    let needed_for_normals = ["part1.", "part2."];
    if needed_for_normals
        .iter()
        .any(|part| hole.task.starts_with(part))
    {
        "every picture needs it"
    } else {
        "light needs it; --shade normals shows the scene without"
    }
}

impl From<String> for Failure {
    fn from(why: String) -> Failure {
        Failure::Input(why)
    }
}

impl From<SceneError> for Failure {
    fn from(why: SceneError) -> Failure {
        Failure::Scene(why)
    }
}

impl From<EnvironmentFileError> for Failure {
    fn from(why: EnvironmentFileError) -> Failure {
        Failure::Input(why.to_string())
    }
}

impl From<OutputError> for Failure {
    fn from(why: OutputError) -> Failure {
        Failure::Input(why.to_string())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::panic::{AssertUnwindSafe, catch_unwind};

    /// As a stage runs: on another thread, below rayon.
    fn failure_of(stage: impl Fn() + Send + Sync) -> Failure {
        let threads = rayon::ThreadPoolBuilder::new().build().expect("threads");
        let run = catch_unwind(AssertUnwindSafe(|| threads.install(stage)));
        Failure::of_panic(run.expect_err("the stage does not return"))
    }

    #[test]
    fn a_hole_is_told_by_its_key() {
        let Failure::Hole(hole) = failure_of(|| kit::hole!("part1.task3")) else {
            panic!("a hole is known as one");
        };
        assert_eq!(hole.to_string(), "part1.task3 is not written yet");
    }

    #[test]
    fn another_panic_is_a_panic() {
        assert!(matches!(failure_of(|| panic!("no")), Failure::Panic));
    }
}
