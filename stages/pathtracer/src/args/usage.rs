//! Errors in flags: clap's, with the advice that helps here.

use clap::builder::StyledStr;
use clap::error::{ContextKind, ContextValue, ErrorKind};
use clap::{Command, CommandFactory, Error};

/// Replaces clap's advice in an error about the flags of `A`.
///
/// - An unknown flag: clap advises to write it after `--`, which would make it the name of the
///   scene. That advice is removed; that of a flag with a similar name stays.
/// - A flag with too few values: what the flag means.
pub fn with_advice<A: CommandFactory>(mut error: Error) -> Error {
    match error.kind() {
        ErrorKind::UnknownArgument => {
            error.remove(ContextKind::Suggested);
        }
        ErrorKind::InvalidValue | ErrorKind::WrongNumberOfValues if has_too_few_values(&error) => {
            if let Some(meaning) = meaning(A::command(), &error) {
                let advice = vec![StyledStr::from(meaning)];
                error.insert(ContextKind::Suggested, ContextValue::StyledStrs(advice));
            }
        }
        _ => {}
    }
    error
}

/// Whether the error is about a missing value rather than a wrong one: then it contains no value.
fn has_too_few_values(error: &Error) -> bool {
    match error.get(ContextKind::InvalidValue) {
        Some(ContextValue::String(value)) => value.is_empty(),
        _ => true,
    }
}

/// The flag of the error, its values and its help, such as `-e, --environment <FILENAME>:
/// Environment map`.
fn meaning(mut command: Command, error: &Error) -> Option<String> {
    let Some(ContextValue::String(name)) = error.get(ContextKind::InvalidArg) else {
        return None;
    };
    // Until then a flag does not know its number of values, which is part of its name here.
    command.build();
    let flag = command
        .get_arguments()
        .find(|flag| flag.to_string() == *name)?;
    let short = flag
        .get_short()
        .map_or(String::new(), |short| format!("-{short}, "));
    Some(format!("{short}{name}: {}", flag.get_help()?))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::args::Args;
    use clap::Parser;

    fn message(flags: &str) -> String {
        let line = format!("pathtracer {flags}");
        let error = Args::try_parse_from(line.split(' ')).unwrap_err();
        with_advice::<Args>(error).to_string()
    }

    #[test]
    fn an_unknown_flag_is_not_advised_to_be_a_scene() {
        for flags in ["-z a.dae", "a.dae -z", "--foo"] {
            let text = message(flags);
            assert!(text.contains("unexpected argument '-"), "{text}");
            assert!(!text.contains("tip"), "{text}");
        }
        assert!(message("--sampels 4 a.dae").contains("a similar argument exists: '--samples'"));
    }

    #[test]
    fn a_flag_without_its_value_is_explained() {
        let meaning = "tip: -e, --environment <FILENAME>: Environment map (.exr or .hdr)";
        assert!(
            message("a.dae -e").contains(meaning),
            "{}",
            message("a.dae -e")
        );
        let meaning = "tip: -r, --resolution <W> <H>: Width and height of the picture";
        assert!(
            message("a.dae -r 8").contains(meaning),
            "{}",
            message("a.dae -r 8")
        );
        assert!(message("a.dae --time").contains("tip: --time <SECONDS>: Render passes"));
        // A value that is given has a message of its own.
        assert!(!message("-s abc a.dae").contains("tip"));
    }
}
