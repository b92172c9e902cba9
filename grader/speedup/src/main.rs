//! `grader speedup`: the ladder from brute force to a wide tree.

use base::program::{Exit, check_folders_of, run_commands};
use base::{GraderError, out, outln};
use clap::ArgMatches;
use grader::cli::{Format, programs, seed_of};
use grader::report;
use speedup::{LadderRequest, measure, page, table};
use std::path::PathBuf;
use std::process::ExitCode;

fn main() -> ExitCode {
    run_commands([(programs::speedup(), run)])
}

fn run(matches: &ArgMatches) -> Result<Exit, GraderError> {
    check_folders_of(matches, &["html", "svg"])?;
    let mesh: &String = matches.get_one("mesh").expect("a default value");
    let request = LadderRequest {
        mesh: mesh.parse().map_err(|why: String| GraderError::new(why))?,
        largest: *matches.get_one("largest").expect("a default value"),
        seed: seed_of(matches),
    };
    let format = Format::of(matches);
    if format == Format::Table {
        out!("{}", table::head(request.mesh));
    }
    let _progress = progress::start("speedup", request.sizes().count());
    // After each size, so that a run that is stopped has printed and written what it measured.
    let ladder = measure(&request, &mut |ladder| {
        progress::pause();
        if format == Format::Table {
            out!("{}", table::latest_rows(ladder));
        }
        if let Some(path) = matches.get_one::<PathBuf>("html") {
            base::write_whole(path, page::page(ladder).as_bytes())?;
        }
        if let Some(path) = matches.get_one::<PathBuf>("svg") {
            base::write_whole(path, page::plot(ladder).as_bytes())?;
        }
        Ok(())
    })?;
    match format {
        Format::Json => outln!("{}", report::json(&ladder)?),
        Format::Table => out!("\n{}", table::summary(&ladder)),
    }
    Ok(Exit::Passed)
}
