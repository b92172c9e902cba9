//! `grader part1`: grading the code in the workspace.

use super::{Format, Verdict};
use crate::error::GraderError;
use crate::grade::{self, GradeRequest};
use crate::report;
use crate::report::table::Hint;
use crate::workspace::Workspace;
use clap::Args;
use std::path::Path;

/// What to grade and how to show it.
#[derive(Args, Debug)]
pub struct GradeArguments {
    /// What to grade: `all`, a part such as `part1`, or a task such as `part1.task3`.
    what: String,
    /// What cannot be graded with it.
    #[arg(hide = true)]
    more: Vec<String>,
    /// How to print the report.
    #[arg(long, value_enum, default_value_t = Format::Table)]
    pub format: Format,
    /// Seed of the fresh random probes.
    #[arg(long, default_value_t = 0, value_parser = super::seed, allow_negative_numbers = true)]
    seed: u64,
    /// How much to give away: 1 what the cases that fail check, 2 also what is wrong, 3 also the worst ray, 4 also the mistake.
    #[arg(long, value_enum, default_value_t = Hint::Mistake)]
    pub hint: Hint,
    /// Leave out the table of speedups.
    #[arg(long)]
    no_times: bool,
}

impl GradeArguments {
    /// What is to be graded, or an error if it is more than one thing.
    pub fn request(&self) -> Result<GradeRequest, GraderError> {
        if let Some(second) = self.more.first() {
            return Err(GraderError::new(format!(
                "one at a time: `grader {}`, then `grader {second}`; or `grader all`",
                self.what
            )));
        }
        Ok(GradeRequest {
            what: self.what.clone(),
            seed: self.seed,
        })
    }

    pub(super) fn run(&self) -> Result<Verdict, GraderError> {
        let request = self.request()?;
        let workspace = Workspace::above(Path::new("."))?;
        let graded = grade::in_place(&workspace, &request, !self.no_times)?;
        let json = report::json(&graded.report)?;
        report::write_whole(&workspace.root().join("report.json"), json.as_bytes())?;
        match self.format {
            Format::Json => println!("{json}"),
            Format::Table => {
                if !graded.printed.is_empty() {
                    println!("your code printed:\n{}\n", graded.printed.trim_end());
                }
                print!("{}", report::table::show(&graded.report, self.hint));
            }
        }
        Ok(if graded.report.is_full() {
            Verdict::Full
        } else {
            Verdict::Short
        })
    }
}
