//! `grader cost`: what accuracy costs in time.

use super::{Format, Verdict};
use crate::cost::page::page;
use crate::cost::report::Shape;
use crate::cost::{self, Order, Size, table};
use crate::error::GraderError;
use crate::report;
use crate::workspace::Workspace;
use clap::{Args, ValueEnum};
use std::path::{Path, PathBuf};

/// What to compare and how to show it.
#[derive(Args)]
pub(super) struct Cost {
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
    #[arg(long, default_value_t = 0, value_parser = super::seed, allow_negative_numbers = true)]
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

impl Cost {
    pub(super) fn run(&self) -> Result<Verdict, GraderError> {
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
