//! The HTML page of plots: `grader cost --html FILE`.
//!
//! The page is self-contained: plots are inline SVG, pictures are embedded, and there are no
//! scripts. The heading of every figure is its finding, computed from the same numbers, which a
//! table below it has. The colours can be distinguished by colour-blind readers; shapes, signs and
//! dashes show the same information.
//!
//! Read `document` (the page) and `figure`, then the figures: `pareto` (with `front` and
//! `pareto_caption`), `heatmap` (with `heatmap_cell`), `cdf`, `leaks`, `trees`, `convergence` (with
//! `convergence_caption`); they are drawn with `plot`, `style` and `canvas`; `labels` places names
//! beside points. `formatting` formats numbers and lists.

mod canvas;
mod cdf;
mod convergence;
mod convergence_caption;
mod document;
mod figure;
mod formatting;
mod front;
mod heatmap;
mod heatmap_cell;
mod labels;
mod leaks;
mod pareto;
mod pareto_caption;
mod plot;
mod style;
mod trees;

pub use document::{page, plot};
