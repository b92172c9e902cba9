//! `grader handout --part N --out DIR`.

use authoring::handout::{Handout, place};
use clap::Args;
use grader::cli::Verdict;
use grader::error::GraderError;
use grader::workspace::Workspace;
use std::path::{Path, PathBuf};

/// Which handout, and where to.
#[derive(Args)]
pub(crate) struct Arguments {
    /// The first part that the student writes; the reference of the parts before stays.
    #[arg(long, value_name = "N", value_parser = part, allow_negative_numbers = true)]
    part: u32,
    /// A new folder, outside the course.
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
}

fn part(value: &str) -> Result<u32, String> {
    grader::cli::whole_number(value, 1, u32::MAX)
        .map_err(|_| "give a part's number, such as 1".to_owned())
}

impl Arguments {
    pub(crate) fn run(&self) -> Result<Verdict, GraderError> {
        let workspace = Workspace::above(Path::new("."))?;
        place::check(&workspace, &self.out)?;
        let handout = Handout::carve(&workspace, self.part)?;
        handout.write(&self.out)?;
        println!(
            "{}: {} files, {} solutions carved out. A student starts with its README.md",
            self.out.display(),
            handout.files.len(),
            handout.taken.len()
        );
        Ok(Verdict::Full)
    }
}
