//! The formats by their names.

use crate::{
    Outcome, Settings, actions, classroom50, gradescope, json, junit, markdown, prairielearn,
};
use base::GraderError;

/// A format of a course system.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// `results.json` of Gradescope.
    Gradescope,
    /// `result.json` of Classroom 50.
    Classroom50,
    /// `results.json` of PrairieLearn.
    PrairieLearn,
    /// JUnit XML, as Jenkins, GitLab and GitHub Actions read it.
    JUnit,
    /// The report of the grader, or `{"infrastructure": "..."}`.
    Json,
    /// Workflow commands of GitHub Actions, which annotate lines of the student's code.
    Actions,
    /// A summary for people.
    Markdown,
}

impl Format {
    /// All formats.
    pub const ALL: [Format; 7] = [
        Format::Gradescope,
        Format::Classroom50,
        Format::PrairieLearn,
        Format::JUnit,
        Format::Json,
        Format::Actions,
        Format::Markdown,
    ];

    /// Its name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Format::Gradescope => "gradescope",
            Format::Classroom50 => "classroom50",
            Format::PrairieLearn => "prairielearn",
            Format::JUnit => "junit",
            Format::Json => "json",
            Format::Actions => "actions",
            Format::Markdown => "markdown",
        }
    }

    /// The format with this name.
    pub fn named(name: &str) -> Option<Format> {
        Format::ALL.into_iter().find(|format| format.name() == name)
    }

    /// The text of the file about `outcome`, in this format.
    ///
    /// # Errors
    ///
    /// If `settings` lack what the format must contain, see [`Format::check`].
    pub fn write(self, outcome: &Outcome, settings: &Settings) -> Result<String, GraderError> {
        match self {
            Format::Gradescope => gradescope::write(outcome, settings),
            Format::Classroom50 => classroom50::write(outcome, settings),
            Format::PrairieLearn => prairielearn::write(outcome, settings),
            Format::JUnit => junit::write(outcome),
            Format::Json => json::write(outcome),
            Format::Actions => Ok(actions::write(outcome)),
            Format::Markdown => Ok(markdown::write(outcome)),
        }
    }

    /// Returns an error if `settings` lack what the format must contain, so that it is known before
    /// grading.
    pub fn check(self, settings: &Settings) -> Result<(), GraderError> {
        match self {
            Format::Classroom50 => settings
                .assignment
                .as_ref()
                .map(|_| ())
                .map_err(Clone::clone),
            _ => Ok(()),
        }
    }
}
