//! What the commands share that ask questions: `grader predict` and `grader gym`.

use super::options;
use clap::builder::Resettable;
use clap::{Arg, ArgMatches};
use std::hash::{BuildHasher, RandomState};
use std::io::{BufRead, IsTerminal, StdinLock, stdin};

/// The option `--seed`, without which the questions differ each time.
pub(super) fn seed_argument() -> Arg {
    options::seed_argument()
        .value_name("N")
        .default_value(Resettable::Reset)
}

/// Reads the option that [`seed_argument`] defines; without it, draws a seed that is short to type.
pub(super) fn seed_of(matches: &ArgMatches) -> u64 {
    // The keys of a hasher are the operating system's random numbers.
    let drawn = || RandomState::new().hash_one(()) >> 40;
    matches.get_one("seed").copied().unwrap_or_else(drawn)
}

/// The standard input, to read answers from.
pub(super) struct AnswerInput {
    pub(super) lines: StdinLock<'static>,
    /// Whether a person types the answers.
    pub(super) is_terminal: bool,
}

impl AnswerInput {
    /// `None` if the standard input is no terminal and is empty.
    pub(super) fn of_stdin() -> Option<AnswerInput> {
        let mut lines = stdin().lock();
        let is_terminal = lines.is_terminal();
        let is_empty = !is_terminal && lines.fill_buf().is_ok_and(<[u8]>::is_empty);
        (!is_empty).then_some(AnswerInput { lines, is_terminal })
    }
}
