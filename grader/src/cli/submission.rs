//! `grader part2 --submission DIR` and `grader part2 --class DIR --out DIR`: grading what was handed in.

use super::{Format, Verdict};
use crate::course::Course;
use crate::error::GraderError;
use crate::grade::Order;
use crate::report;
use crate::report::table::{self, Hint};
use crate::submission::job::Job;
use crate::submission::{Judgement, class, read};
use crate::workspace::Workspace;
use clap::Args;
use std::fmt::Write;
use std::path::PathBuf;

/// Whose work to grade, if not the workspace's own.
#[derive(Args)]
pub(super) struct Submission {
    /// For instructors: grade the stages in DIR, each among the reference's other stages.
    #[arg(long, value_name = "DIR", conflicts_with = "class")]
    submission: Option<PathBuf>,
    /// For instructors: grade every folder in DIR as a submission.
    #[arg(long, value_name = "DIR", requires = "out")]
    class: Option<PathBuf>,
    /// Also grade all of a submission's stages linked together.
    #[arg(long)]
    together: bool,
    /// Where a class's reports and summary.csv go.
    #[arg(long, value_name = "DIR", requires = "class")]
    out: Option<PathBuf>,
}

/// Of many ignored files this many are named.
const IGNORED_NAMED: usize = 20;

impl Submission {
    /// Grades a submission or a class, if one is named.
    pub(super) fn run(
        &self,
        workspace: &Workspace,
        order: &Order,
        format: Format,
        hint: Hint,
    ) -> Result<Option<Verdict>, GraderError> {
        if let Some(folder) = &self.submission {
            let course = Course::read(workspace)?;
            course.select(&order.what)?;
            let submission = read::Submission::read(folder, &course, workspace.root())?;
            let job = Job::open(workspace)?;
            let judgement = Judgement::of(&submission, workspace, &job, order, self.together)?;
            let json = report::json(&judgement)?;
            report::write_whole(&workspace.root().join("report.json"), json.as_bytes())?;
            match format {
                Format::Json => println!("{json}"),
                Format::Table => print!("{}", show(&judgement, hint)),
            }
            return Ok(Some(if judgement.report.is_full() {
                Verdict::Full
            } else {
                Verdict::Short
            }));
        }
        if let (Some(folder), Some(out)) = (&self.class, &self.out) {
            let text = |judgement: &Judgement| show(judgement, hint);
            let summary = class::grade(workspace, folder, out, order, self.together, text)?;
            println!(
                "{} submissions graded: {}",
                summary.graded,
                out.join("summary.csv").display()
            );
            for refused in &summary.refused {
                println!("not graded: {refused}");
            }
            return Ok(Some(if summary.refused.is_empty() {
                Verdict::Full
            } else {
                Verdict::Short
            }));
        }
        if self.together {
            return Err(GraderError::new(
                "`--together` is for a submission: name it with `--submission DIR` or `--class DIR`",
            ));
        }
        Ok(None)
    }
}

/// A judgement for people.
fn show(judgement: &Judgement, hint: Hint) -> String {
    let mut text = String::new();
    if !judgement.ignored.is_empty() {
        let named = judgement.ignored.iter().take(IGNORED_NAMED);
        let _ = writeln!(
            text,
            "ignored, since a submission is stages/<stage>/src/**/*.rs alone:"
        );
        for name in named {
            let _ = writeln!(text, "  {name}");
        }
        let more = judgement.ignored.len().saturating_sub(IGNORED_NAMED);
        if more > 0 {
            let _ = writeln!(text, "  and {more} more");
        }
    }
    for stage in &judgement.missing {
        let _ = writeln!(text, "not handed in: stages/{stage}/src");
    }
    for place in &judgement.reaches_out {
        let _ = writeln!(
            text,
            "reaches for something outside its own code, so look at it: {place}"
        );
    }
    if !judgement.compiler.is_empty() {
        let _ = writeln!(text, "\n{}", judgement.compiler.trim_end());
    }
    if !judgement.printed.is_empty() {
        let _ = writeln!(
            text,
            "\nthe code printed:\n{}",
            judgement.printed.trim_end()
        );
    }
    let _ = writeln!(
        text,
        "\neach stage among the reference's:\n{}",
        table::show(&judgement.report, hint)
    );
    if let Some(together) = &judgement.together {
        let _ = writeln!(
            text,
            "all stages of the submission together:\n{}",
            table::show(together, hint)
        );
    }
    text
}
