//! One page that shows what accuracy costs: `grader cost --html FILE`.
//!
//! The page needs nothing beside itself: plots are inline SVG, pictures are part of it, nothing moves and nothing is loaded.
//! Every figure has a paragraph below it that is computed from the numbers, as the figure is. Colours are told apart by the
//! colour-blind; what they say is said by shapes, signs and dashes, too.
//!
//! Read `document` (the page), then the figures: `pareto`, `heat`, `cdf`, `leaks`, `trees`, `convergence`; they are drawn
//! with `plot`, `look` and `canvas`.

mod canvas;
mod cdf;
mod convergence;
mod document;
mod heat;
mod leaks;
mod look;
mod pareto;
mod plot;
mod trees;
mod words;

pub use document::page;
