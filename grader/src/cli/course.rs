//! `grader course check`: does the course keep its word?

use super::Verdict;
use crate::check;
use crate::error::GraderError;
use crate::workspace::Workspace;
use clap::Subcommand;
use std::path::Path;

/// Looks after the course itself.
#[derive(Subcommand)]
pub(super) enum Course {
    /// Checks that the course holds together: lists, goldens, the reference's score, and every handout, built and graded.
    Check {
        /// Only what can be seen without building anything.
        #[arg(long)]
        quick: bool,
    },
}

impl Course {
    pub(super) fn run(&self) -> Result<Verdict, GraderError> {
        let Course::Check { quick } = self;
        let workspace = Workspace::above(Path::new("."))?;
        let complaints = check::course(&workspace, !quick, |doing| eprintln!("{doing}"))?;
        for complaint in &complaints {
            println!("{complaint}");
        }
        if complaints.is_empty() {
            println!("The course holds together.");
            return Ok(Verdict::Full);
        }
        match complaints.len() {
            1 => println!("1 complaint."),
            many => println!("{many} complaints."),
        }
        Ok(Verdict::Short)
    }
}
