//! The command line.

use crate::error::GraderError;
use crate::grade::{self, Order};
use crate::report;
use crate::workspace::Workspace;
use clap::{Parser, ValueEnum};
use std::path::Path;
use std::process::ExitCode;

/// Scores your ray tracer, stage by stage.
#[derive(Parser)]
#[command(
    name = "grader",
    version,
    after_help = "Exit code: 0 every core point, 1 points lost, 2 the grader or its input is at fault."
)]
struct Cli {
    /// What to grade: `all`, a part such as `part1`, or a task such as `part1.task3`.
    what: String,
    /// How to print the report.
    #[arg(long, value_enum, default_value_t = Format::Table)]
    format: Format,
    /// Seed of the fresh random probes.
    #[arg(long, default_value_t = 0)]
    seed: u64,
}

#[derive(Clone, Copy, PartialEq, ValueEnum)]
enum Format {
    Table,
    Json,
}

/// Runs the program.
pub fn main() -> ExitCode {
    match run(&Cli::parse()) {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::from(1),
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::from(2)
        }
    }
}

fn run(cli: &Cli) -> Result<bool, GraderError> {
    let workspace = Workspace::above(Path::new("."))?;
    let graded = grade::in_place(
        &workspace,
        &Order {
            what: cli.what.clone(),
            seed: cli.seed,
        },
    )?;
    let json = report::json(&graded.report)?;
    report::write_whole(&workspace.root().join("report.json"), json.as_bytes())?;
    match cli.format {
        Format::Json => println!("{json}"),
        Format::Table => {
            if !graded.printed.is_empty() {
                println!("your code printed:\n{}\n", graded.printed.trim_end());
            }
            print!("{}", report::table::show(&graded.report));
        }
    }
    Ok(graded.report.is_full())
}
