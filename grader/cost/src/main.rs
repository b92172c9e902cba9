//! `grader cost`: measures the time that accuracy costs.

use base::program::{Exit, check_folders_of, run_commands};
use base::{GraderError, Workspace, out, outln};
use clap::ArgMatches;
use cost::page::{page, plot};
use cost::report::Shape;
use cost::{CostRequest, SampleCounts, table, world};
use grader::cli::{Format, programs, seed_of};
use grader::report;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

fn main() -> ExitCode {
    run_commands([(programs::cost(), run)])
}

fn run(matches: &ArgMatches) -> Result<Exit, GraderError> {
    if let Some(cases) = matches.get_one::<PathBuf>("cases") {
        return exchange_with_adapters(matches, cases);
    }
    let workspace = Workspace::above(Path::new("."))?;
    let named: Vec<&String> = matches.get_many("what").unwrap_or_default().collect();
    let wants = |what: &str| named.is_empty() || named.iter().any(|name| *name == what);
    let shapes = Shape::ALL.into_iter().filter(|shape| {
        wants(match shape {
            Shape::Triangle => "triangle",
            Shape::Sphere => "sphere",
            Shape::Box => "box",
        })
    });
    let request = CostRequest {
        shapes: shapes.collect(),
        trees: wants("bvh"),
        pictures: wants("picture"),
        world: wants("world"),
        size: if matches.get_flag("quick") {
            SampleCounts::QUICK
        } else {
            SampleCounts::FULL
        },
        seed: seed_of(matches),
    };
    check_folders_of(matches, &["html", "svg"])?;
    let progress = progress::start("cost", request.parts());
    let format = Format::of(matches);
    let mut printed = table::Printed::default();
    // After each part, so that a run that is stopped has printed and written what it measured.
    let cost = cost::measure(Some(&workspace), &request, &mut |cost| {
        if format == Format::Table {
            progress::pause();
            out!("{}", printed.rest_of(cost));
        }
        if let Some(path) = matches.get_one::<PathBuf>("html") {
            base::write_whole(path, page(cost).as_bytes())?;
        }
        Ok(())
    })?;
    drop(progress);
    if let Some(path) = matches.get_one::<PathBuf>("svg") {
        let plot = plot(&cost).ok_or_else(|| {
            GraderError::new(
                "--svg: nothing to plot; name a shape (triangle, sphere, box), bvh or world",
            )
        })?;
        base::write_whole(path, plot.as_bytes())?;
    }
    match format {
        Format::Json => outln!("{}", report::json(&cost)?),
        Format::Table => out!("{}", printed.end_of(&cost)),
    }
    Ok(Exit::Passed)
}

/// Writes the hard cases for adapters of ray casters, or judges what they answered.
fn exchange_with_adapters(matches: &ArgMatches, cases: &Path) -> Result<Exit, GraderError> {
    match matches.get_one::<PathBuf>("answers") {
        Some(answers) => out!("{}", world::row::to_tsv(&world::judge(cases, answers)?)),
        None => {
            let rays = matches.get_one("rays").copied().unwrap_or_default();
            world::write_cases(cases, world::SEED, rays)?;
        }
    }
    Ok(Exit::Passed)
}
