//! The program behind `grader review` and `grader bless`.

mod cli;

use clap::{Parser, Subcommand};
use grader::cli::{EXIT_CODES, end};
use std::process::ExitCode;

/// Shows and accepts differences between the goldens and what the reference computes.
#[derive(Parser)]
#[command(name = "grader", version, after_help = EXIT_CODES)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// For reviewers: writes a page with every difference between the goldens and what the code computes now.
    Review(cli::review::Review),
    /// For instructors: accepts what the reference computes now as golden, after showing what that changes.
    Bless(cli::bless::Bless),
}

fn main() -> ExitCode {
    let cli = Cli::parse();
    end(|| match cli.command {
        Command::Review(review) => review.run(),
        Command::Bless(bless) => bless.run(),
    })
}
