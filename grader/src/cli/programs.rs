//! The command lines of the programs beside the grader that students use.
//!
//! They are here and not in their programs, so that `--help` is printed, and a misspelt flag named,
//! before anything is built.

use super::picture::{NO_PAGE, task_argument};
use super::{Format, seed_argument};
use base::program::{path_argument, whole_number};
use clap::{Arg, ArgAction, Command};

/// What `grader cost` can compare: ray/shape tests, trees, real ray casters on hard cases, and
/// pictures rendered by the workspace's program.
pub const EXPERIMENTS: [&str; 6] = ["triangle", "sphere", "box", "bvh", "world", "picture"];

/// The command that draws the picture of a task and opens the page of what is wrong in it.
pub(super) const LOOK: &str = "look";

/// The names of the meshes of `grader speedup`, the default first.
pub const MESHES: [&str; 4] = ["terrain", "smooth", "knot", "needles"];

/// The command line of the program `name`, if students use it.
pub(super) fn of(name: &str) -> Option<Command> {
    match name {
        LOOK => Some(look()),
        "cost" => Some(cost()),
        "speedup" => Some(speedup()),
        _ => None,
    }
}

/// The command line of `grader look`.
pub fn look() -> Command {
    Command::new(LOOK)
        .about("Renders a task's picture with your code, beside the expected one, and opens a page of what is wrong in the task, drawn")
        .arg(task_argument())
        .arg(
            Arg::new(NO_PAGE)
                .long(NO_PAGE)
                .action(ArgAction::SetTrue)
                .help("Only draw the picture in the terminal, and write it to a file"),
        )
        .arg(
            Arg::new("no-open")
                .long("no-open")
                .action(ArgAction::SetTrue)
                .help("Write the page without opening it"),
        )
}

/// The command line of `grader cost`.
pub fn cost() -> Command {
    Command::new("cost")
        .about("Measures what accuracy costs in time: compares your kernels with well-known ones")
        .arg(
            Arg::new("what")
                .num_args(..)
                .value_parser(EXPERIMENTS)
                .help("What to compare; everything by default"),
        )
        .arg(Format::argument())
        .arg(
            path_argument("html", "FILE")
                .help("Also write a self-contained HTML page of plots"),
        )
        .arg(
            path_argument("svg", "FILE")
                .help("Also write one plot as an SVG file: accuracy against time of the first shape, or, for `bvh` alone, what exactness costs, and for `world` alone, what real ray casters answer"),
        )
        .arg(
            Arg::new("quick")
                .long("quick")
                .action(ArgAction::SetTrue)
                .help("Use few rays: less precise, finishes in seconds"),
        )
        .arg(seed_argument())
        .arg(
            path_argument("cases", "DIR")
                .help("Only write the hard cases of `world` with their exact answers, for adapters of ray casters (grader/world)"),
        )
        .arg(
            path_argument("answers", "DIR")
                .requires("cases")
                .help("Only judge what adapters answered to the cases of --cases, and print it as a table with tabulators"),
        )
        .arg(
            Arg::new("rays")
                .long("rays")
                .value_name("N")
                .requires("cases")
                .value_parser(|value: &str| whole_number(value, 64, 1_000_000_usize))
                .default_value("20000")
                .help("The number of rays in each case of --cases"),
        )
}

/// The command line of `grader speedup`.
pub fn speedup() -> Command {
    Command::new("speedup")
        .about("Measures what each step from brute force to a wide tree gains in speed, your own steps included")
        .arg(
            Arg::new("mesh")
                .value_parser(MESHES)
                .default_value(MESHES[0])
                .help("The generated mesh"),
        )
        .arg(
            Arg::new("largest")
                .long("largest")
                .value_name("TRIANGLES")
                .value_parser(|value: &str| whole_number(value, 1000, 10_000_000_usize))
                .default_value("1000000")
                .help("The size of the largest mesh; the smaller sizes are powers of ten from 1000 on"),
        )
        .arg(Format::argument())
        .arg(path_argument("html", "FILE").help("Also write a self-contained HTML page of plots"))
        .arg(path_argument("svg", "FILE").help("Also write the plot of speed as an SVG file"))
        .arg(seed_argument())
}
