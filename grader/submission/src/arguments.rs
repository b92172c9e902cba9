//! What the arguments of a command ask of the grading of submissions.

use crate::containment::Containment;
use crate::one::random_seed;
use base::{GraderError, Workspace};
use clap::ArgMatches;
use clap::parser::ValueSource;
use grader::cli::grade::request;
use grader::grade::GradeRequest;

/// What to grade. Without `--seed`, with a seed that nobody knows.
pub fn seeded_request(matches: &ArgMatches) -> Result<GradeRequest, GraderError> {
    let mut request = request(matches)?;
    if draws_seed(matches) {
        request.seed = random_seed();
    }
    Ok(request)
}

/// Whether the seed is a new one, and not that of `--seed`.
pub fn draws_seed(matches: &ArgMatches) -> bool {
    matches.value_source("seed") == Some(ValueSource::DefaultValue)
}

/// How the code of submissions is contained: by the strongest means of this machine, or, with
/// `--unsandboxed`, not at all.
pub fn containment(
    matches: &ArgMatches,
    workspace: &Workspace,
) -> Result<Containment, GraderError> {
    Containment::choose(workspace, matches.get_flag("unsandboxed"))
}
