//! The HTML page of plots: `grader cost --html FILE`.
//!
//! The page is self-contained: plots are inline SVG, pictures are embedded, and there are no
//! scripts. Every figure has a caption that is computed from the same numbers. The colours can be
//! distinguished by colour-blind readers; shapes, signs and dashes show the same information.
//!
//! Read `document` (the page), then the figures: `pareto` (with `front` and `pareto_caption`),
//! `heatmap`, `cdf`, `leaks`, `trees`, `convergence`; they are drawn with `plot`, `style` and
//! `canvas`. `formatting` formats numbers and lists.

mod canvas;
mod cdf;
mod convergence;
mod document;
mod formatting;
mod front;
mod heatmap;
mod leaks;
mod pareto;
mod pareto_caption;
mod plot;
mod style;
mod trees;

pub use document::page;
