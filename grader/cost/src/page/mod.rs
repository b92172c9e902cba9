//! The HTML page of plots: `grader cost --html FILE`.
//!
//! Read `document` (the page), then the figures: `pareto` (with `front` and `pareto_caption`),
//! `heatmap` (with `heatmap_cell`), `cdf`, `leaks`, `trees`,
//! `exactness`, `convergence` (with
//! `convergence_caption`). The crate `plots` draws them.

mod cdf;
mod convergence;
mod convergence_caption;
mod document;
mod exactness;
mod front;
mod heatmap;
mod heatmap_cell;
mod kernel_name;
mod leaks;
mod pareto;
mod pareto_caption;
mod trees;

pub use document::{page, plot};
