//! The results of `grader cost bvh`, and their measurement.
//!
//! Read the types here, then `measure` (one run), `coplanar` (crafted rays), `exactness` (what
//! single precision loses), [`BreakEven`] and `table`.

mod break_even;
mod coplanar;
mod exactness;
mod measure;
pub(crate) mod table;

pub use break_even::BreakEven;
pub use exactness::ExactnessRow;
pub(crate) use exactness::in_a_million;
pub(crate) use measure::measure;

use crate::quartiles::Quartiles;
use crate::timing::Timing;
use serde::{Deserialize, Serialize};

/// Results for trees over one mesh.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TreeReport {
    /// Name of the mesh.
    pub mesh: String,
    /// Number of triangles.
    pub triangles: usize,
    /// One tree, traversed with different values of pruning slack.
    pub by_slack: Vec<SlackRow>,
    /// Trees from different builders, with the same traversal.
    pub by_build: Vec<TreeRow>,
    /// The first tree with different tests and precisions, the exact one first; then the other
    /// trees with its tests.
    pub by_precision: Vec<ExactnessRow>,
    /// Why there is no row for the student's tree, if there is none.
    pub student_missing: Option<String>,
}

/// Results for one value of pruning slack.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SlackRow {
    /// Pruning slack in units in the last place: a box is skipped if the ray enters it behind the
    /// closest hit so far by more than this.
    pub slack_ulp: u32,
    /// Time, tests and wrong hits of the traversal.
    pub trace: TraversalCost,
}

/// Results for one tree builder.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TreeRow {
    /// The rule that splits a node.
    pub name: String,
    /// The publication that describes the rule.
    pub paper: String,
    /// Whether this is the student's builder.
    pub student: bool,
    /// Build time in seconds, over the rounds.
    pub build_s: Quartiles,
    /// Number of nodes including leaves; unknown for the student's tree.
    pub nodes: Option<usize>,
    /// Time, tests and wrong hits of the traversal.
    pub trace: TraversalCost,
    /// When the time saved in tracing equals the additional build time, compared with the first
    /// tree.
    pub break_even: BreakEven,
}

/// Cost of closest-hit traversal of a tree, over many rays.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TraversalCost {
    /// Time per ray. Its ratio is to the time of the first row.
    pub time: Timing,
    /// Box tests per ray.
    pub box_tests: f64,
    /// Triangle tests per ray.
    pub prim_tests: f64,
    /// Wrong hits of the timed rays.
    pub ordinary: WrongHits,
    /// Wrong hits of rays that are aimed at overlapping triangles in one plane: they are crafted to
    /// be wrong without slack. `None` for the student's tree, which is traversed by the student's
    /// own code.
    pub crafted: Option<WrongHits>,
}

/// The result of a comparison with brute force. A hit is wrong if it has another `t` or another
/// primitive than that of brute force with the same triangle test.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct WrongHits {
    /// Number of rays that were compared.
    pub rays: usize,
    /// Number of wrong hits.
    pub wrong: usize,
}
