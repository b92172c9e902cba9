//! The program behind `grader review` and `grader bless`.

mod cli;

use cli::{bless, review};
use grader::cli::{end, sister};
use std::process::ExitCode;

fn main() -> ExitCode {
    let matches = sister([review::command(), bless::command()]).get_matches();
    end(|| match matches.subcommand() {
        Some(("bless", matches)) => bless::run(matches),
        Some((_, matches)) => review::run(matches),
        None => unreachable!("clap asks for a command"),
    })
}
