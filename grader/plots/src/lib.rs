//! Plots as SVG, and self-contained pages of them: those of `grader cost` and `grader speedup`.
//!
//! Plots are inline SVG, pictures are embedded, and nothing is loaded. The heading of every figure
//! is its finding, computed from the same numbers, which a table below it has. The colours can be
//! distinguished by colour-blind readers; shapes, signs and dashes show the same information.
//!
//! Read [`document`] (the page) and [`figure`] with [`columns`], then what figures are drawn with:
//! [`plot`], [`style`] and [`canvas`]; [`scatter`] draws points with names, which [`labels`]
//! places, [`line_names`] places those at the ends of lines. [`numbers`] formats numbers and lists.

pub mod canvas;
pub mod columns;
pub mod document;
pub mod figure;
pub mod labels;
pub mod line_names;
pub mod numbers;
pub mod plot;
pub mod scatter;
pub mod style;
