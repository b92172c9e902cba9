//! `grader cost`: what accuracy costs in time.

use clap::{Parser, ValueEnum};
use cost::page::page;
use cost::report::Shape;
use cost::{Order, Size, table};
use grader::cli::{self, Format, Verdict, end};
use grader::error::GraderError;
use grader::report;
use grader::workspace::Workspace;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// What to compare and how to show it.
#[derive(Parser)]
#[command(name = "grader cost", version, after_help = cli::EXIT_CODES)]
struct Cli {
    /// What to compare; everything if nothing is named.
    #[arg(value_enum)]
    what: Vec<What>,
    /// How to print the report.
    #[arg(long, value_enum, default_value_t = Format::Table)]
    format: Format,
    /// Also write a page with plots, which needs nothing beside itself.
    #[arg(long, value_name = "FILE")]
    html: Option<PathBuf>,
    /// Take few rays: rough, and done in seconds.
    #[arg(long)]
    quick: bool,
    /// What the rays are drawn from.
    #[arg(long, default_value_t = 0, value_parser = cli::seed, allow_negative_numbers = true)]
    seed: u64,
}

/// What can be compared.
#[derive(Clone, Copy, PartialEq, ValueEnum)]
enum What {
    /// Tests of rays against triangles.
    Triangle,
    /// Tests of rays against spheres.
    Sphere,
    /// Tests of rays against boxes.
    Box,
    /// Trees, and walks through them.
    Bvh,
    /// Pictures, by the program of the workspace.
    Picture,
}

impl Cli {
    fn run(&self) -> Result<Verdict, GraderError> {
        let workspace = Workspace::above(Path::new("."))?;
        let wants = |what: What| self.what.is_empty() || self.what.contains(&what);
        let shapes = Shape::ALL.into_iter().filter(|shape| {
            wants(match shape {
                Shape::Triangle => What::Triangle,
                Shape::Sphere => What::Sphere,
                Shape::Box => What::Box,
            })
        });
        let order = Order {
            shapes: shapes.collect(),
            trees: wants(What::Bvh),
            pictures: wants(What::Picture),
            size: if self.quick { Size::QUICK } else { Size::FULL },
            seed: self.seed,
        };
        let cost = cost::measure(Some(&workspace), &order)?;
        if let Some(path) = &self.html {
            report::write_whole(path, page(&cost)?.as_bytes())?;
        }
        match self.format {
            Format::Json => println!("{}", report::json(&cost)?),
            Format::Table => print!("{}", table::show(&cost)),
        }
        Ok(Verdict::Full)
    }
}

fn main() -> ExitCode {
    let cli = Cli::parse();
    end(|| cli.run())
}
