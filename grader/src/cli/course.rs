//! `grader course check`: does the course keep its word?

use super::Verdict;
use crate::cases;
use crate::course;
use crate::error::GraderError;
use crate::workspace::Workspace;
use clap::Subcommand;
use std::path::Path;

/// Looks after the course itself.
#[derive(Subcommand)]
pub(super) enum Course {
    /// Checks that the course holds together.
    Check,
}

impl Course {
    pub(super) fn run(&self) -> Result<Verdict, GraderError> {
        match self {
            Course::Check => check(),
        }
    }
}

fn check() -> Result<Verdict, GraderError> {
    let workspace = Workspace::above(Path::new("."))?;
    let course = course::Course::read(&workspace)?;
    let specs = cases::all(0);
    let mut complaints = Vec::new();
    for task in course.tasks() {
        for entry in &task.cases {
            if !specs
                .iter()
                .any(|spec| spec.task == task.key && spec.name == entry.name)
            {
                complaints.push(format!(
                    "{}: course.toml lists the case `{}`, which the grader does not have",
                    task.key, entry.name
                ));
            }
        }
    }
    for spec in &specs {
        if !course
            .tasks()
            .any(|task| task.key == spec.task && task.cases.iter().any(|e| e.name == spec.name))
        {
            complaints.push(format!(
                "{}: the grader has the case `{}`, which course.toml gives no points",
                spec.task, spec.name
            ));
        }
    }
    for complaint in &complaints {
        println!("{complaint}");
    }
    Ok(if complaints.is_empty() {
        println!("the course holds together");
        Verdict::Full
    } else {
        Verdict::Short
    })
}
