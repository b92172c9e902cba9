//! The results of `grader cost bvh`.

use super::report::Timing;
use serde::{Deserialize, Serialize};

/// Results for trees over one mesh.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TreeReport {
    /// Name of the mesh.
    pub mesh: String,
    /// Number of triangles.
    pub triangles: usize,
    /// The same tree, traversed with different values of pruning slack.
    pub by_slack: Vec<SlackRow>,
    /// The same traversal of trees from different builders.
    pub by_build: Vec<TreeRow>,
    /// Why there is no row for the student's tree, if there is none.
    pub student_missing: Option<String>,
}

/// One value of pruning slack.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SlackRow {
    /// Slack of the pruning: boxes are skipped if they start behind the closest hit so far by more
    /// than this number of units in the last place.
    pub slack_ulp: u32,
    /// Time, tests and wrong hits of the traversal.
    pub trace: TraversalCost,
}

/// One tree builder.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TreeRow {
    /// How a node is split.
    pub name: String,
    /// The publication.
    pub paper: String,
    /// Whether this is the student's builder.
    pub student: bool,
    /// Build time in seconds, median of the rounds.
    pub build_s: f64,
    /// Interquartile range of the rounds.
    pub build_spread_s: f64,
    /// Number of nodes including leaves; unknown for the student's tree.
    pub nodes: Option<usize>,
    /// Time, tests and wrong hits of the traversal.
    pub trace: TraversalCost,
    /// Number of rays after which the time saved in tracing equals the additional build time,
    /// compared with the midpoint tree; 0 if it is built faster, `None` if it never happens.
    pub break_even_rays: Option<f64>,
}

/// Cost of closest-hit traversal of a tree, over many rays.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TraversalCost {
    /// Time of one ray; "textbook" is the first row.
    pub time: Timing,
    /// Box tests per ray.
    pub box_tests: f64,
    /// Triangle tests per ray.
    pub prim_tests: f64,
    /// Number of rays that were compared with brute force: ordinary ones, and ones aimed at
    /// coplanar overlapping triangles.
    pub checked_rays: usize,
    /// Rays whose closest hit differs in `t` or primitive from that of brute force with the same
    /// triangle test.
    pub wrong_per_million: f64,
}
