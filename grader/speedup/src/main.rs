//! `grader speedup`: the ladder from brute force to a wide tree.

use base::program::{
    Exit, arguments_of, check_folders_of, path_argument, run_to_exit_code, subprogram_command,
    whole_number,
};
use base::{GraderError, out, outln};
use clap::{Arg, ArgMatches, Command};
use grader::cli::{Format, seed_argument, seed_of};
use grader::report;
use meshes::MeshKind;
use speedup::{LadderRequest, measure, page, table};
use std::path::PathBuf;
use std::process::ExitCode;

fn command() -> Command {
    Command::new("speedup")
        .about("Measures what each step from brute force to a wide tree gains in speed")
        .arg(
            Arg::new("mesh")
                .value_parser(MeshKind::ALL.map(MeshKind::name))
                .default_value(MeshKind::Terrain.name())
                .help("The generated mesh"),
        )
        .arg(
            Arg::new("largest")
                .long("largest")
                .value_name("TRIANGLES")
                .value_parser(|value: &str| whole_number(value, 1000, 10_000_000_usize))
                .default_value("1000000")
                .help("The largest mesh; the others are powers of ten from 1000 on"),
        )
        .arg(Format::argument())
        .arg(path_argument("html", "FILE").help("Also write a self-contained HTML page of plots"))
        .arg(path_argument("svg", "FILE").help("Also write the plot of speed as an SVG file"))
        .arg(seed_argument())
}

fn main() -> ExitCode {
    let matches = arguments_of(subprogram_command([command()]));
    run_to_exit_code(|| match matches.subcommand() {
        Some((_, matches)) => run(matches),
        None => unreachable!("clap requires a subcommand"),
    })
}

fn run(matches: &ArgMatches) -> Result<Exit, GraderError> {
    check_folders_of(matches, &["html", "svg"])?;
    let mesh: &String = matches.get_one("mesh").expect("a default value");
    let ladder = measure(&LadderRequest {
        mesh: mesh.parse().map_err(|why: String| GraderError::new(why))?,
        largest: *matches.get_one("largest").expect("a default value"),
        seed: seed_of(matches),
    });
    if let Some(path) = matches.get_one::<PathBuf>("html") {
        base::write_whole(path, page::page(&ladder)?.as_bytes())?;
    }
    if let Some(path) = matches.get_one::<PathBuf>("svg") {
        base::write_whole(path, page::plot(&ladder)?.as_bytes())?;
    }
    match Format::of(matches) {
        Format::Json => outln!("{}", report::json(&ladder)?),
        Format::Table => out!("{}", table::show(&ladder)),
    }
    Ok(Exit::Passed)
}
