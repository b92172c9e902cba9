//! Errors that end the program, their messages and exit codes.

use base::errln;
use kit::hole::Hole;
use pathtracer::args::ViewError;
use pathtracer::{EnvironmentFileError, OutputError};
use scenes::SceneError;
use std::any::Any;
use std::io::{IsTerminal, stderr};
use std::process::ExitCode;

/// Exit code if a stage is not written yet or panicked.
const STAGE_FAILED: u8 = 1;
/// Exit code for invalid input; `clap` uses the same for flags.
const BAD_INPUT: u8 = 2;

/// An error that ends the program without a picture.
#[derive(Debug)]
pub(crate) enum Failure {
    /// A flag or a picture file is invalid.
    Input(String),
    /// A scene or camera file cannot be read.
    Scene(SceneError),
    /// A stage is not written yet.
    Hole(Hole),
    /// A stage panicked. The panic hook has printed the message.
    Panic,
}

impl Failure {
    /// From the payload of a panic.
    pub(crate) fn from_panic(payload: Box<dyn Any + Send>) -> Failure {
        match payload.downcast::<Hole>() {
            Ok(hole) => Failure::Hole(*hole),
            Err(_) => Failure::Panic,
        }
    }

    /// Prints the error; returns the exit code. `mis` is whether the flag `--mis` was given.
    pub(crate) fn report(&self, mis: bool) -> ExitCode {
        match self {
            Failure::Input(why) => errln!("error: {why}"),
            Failure::Scene(why) if stderr().is_terminal() => errln!("{}", why.styled()),
            Failure::Scene(why) => errln!("{why}"),
            Failure::Hole(hole) => errln!("{hole}: {}", needed_for(hole, mis)),
            Failure::Panic => errln!("no picture was written: a stage panicked (see above)"),
        }
        ExitCode::from(match self {
            Failure::Input(_) | Failure::Scene(_) => BAD_INPUT,
            Failure::Hole(_) | Failure::Panic => STAGE_FAILED,
        })
    }
}

/// What the missing stage is needed for. With `--mis` direct light is estimated by another function
/// of its task than without.
fn needed_for(hole: &Hole, mis: bool) -> &'static str {
    if mis && hole.task == "part3.task3" {
        return "--mis needs `estimate_direct_lighting_mis`, in stages/direct/src/mis.rs; without --mis it is not called";
    }
    let needed_for_normals = ["part1.", "part2."];
    if needed_for_normals
        .iter()
        .any(|part| hole.task.starts_with(part))
    {
        "every picture needs it"
    } else {
        "light needs it; --shade normals renders without it"
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

impl From<ViewError> for Failure {
    fn from(why: ViewError) -> Failure {
        match why {
            ViewError::Flag(why) => Failure::Input(why),
            ViewError::File(why) => Failure::Scene(why),
        }
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

    /// Runs `stage` on a thread pool, as the program does.
    fn failure_of(stage: impl Fn() + Send + Sync) -> Failure {
        let threads = rayon::ThreadPoolBuilder::new().build().expect("threads");
        let run = catch_unwind(AssertUnwindSafe(|| threads.install(stage)));
        Failure::from_panic(run.expect_err("the stage does not return"))
    }

    #[test]
    fn a_hole_is_reported_with_its_key() {
        let Failure::Hole(hole) = failure_of(|| kit::hole!("part1.task3")) else {
            panic!("the failure is a hole");
        };
        assert_eq!(hole.to_string(), "part1.task3 is not written yet");
    }

    #[test]
    fn the_flag_mis_names_the_function_that_it_needs() {
        let hole = |task| Hole {
            task,
            function: "f",
        };
        let text = needed_for(&hole("part3.task3"), true);
        assert!(text.contains("`estimate_direct_lighting_mis`, in stages/direct/src/mis.rs"));
        let others = [("part3.task3", false), ("part3.task1", true)];
        for (task, mis) in others {
            assert!(needed_for(&hole(task), mis).starts_with("light needs it"));
        }
    }

    #[test]
    fn another_panic_is_a_panic() {
        assert!(matches!(failure_of(|| panic!("no")), Failure::Panic));
    }
}
