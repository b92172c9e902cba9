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
    /// One tree, traversed with different values of pruning slack.
    pub by_slack: Vec<SlackRow>,
    /// Trees from different builders, with the same traversal.
    pub by_build: Vec<TreeRow>,
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
    /// Build time in seconds, median of the rounds.
    pub build_s: f64,
    /// Interquartile range of the build times of the rounds, in seconds.
    pub build_spread_s: f64,
    /// Number of nodes including leaves; unknown for the student's tree.
    pub nodes: Option<usize>,
    /// Time, tests and wrong hits of the traversal.
    pub trace: TraversalCost,
    /// Number of rays after which the time saved in tracing equals the additional build time,
    /// compared with the midpoint tree. 0 if neither build nor tracing is slower; `None` if it
    /// never happens.
    pub break_even_rays: Option<f64>,
}

/// Cost of closest-hit traversal of a tree, over many rays.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TraversalCost {
    /// Time per ray. Its ratio is to the time of the first row, instead of the textbook's kernel.
    pub time: Timing,
    /// Box tests per ray.
    pub box_tests: f64,
    /// Triangle tests per ray.
    pub prim_tests: f64,
    /// Number of rays that were compared with brute force: ordinary rays, and rays aimed at
    /// overlapping triangles in one plane.
    pub checked_rays: usize,
    /// Number of wrong hits per million checked rays: the closest hit has another `t` or another
    /// primitive than that of brute force with the same triangle test.
    pub wrong_per_million: f64,
}
