//! What `grader cost bvh` says.

use super::report::Timing;
use serde::{Deserialize, Serialize};

/// Trees over one mesh.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Trees {
    /// The mesh.
    pub mesh: String,
    /// Triangles in it.
    pub triangles: usize,
    /// The same tree, walked with more or less slack where nodes behind the closest hit are skipped.
    pub by_slack: Vec<Walk>,
    /// The same walk of trees that were built in different ways.
    pub by_build: Vec<Tree>,
    /// Why there is no tree of the student's, if there is none.
    pub student_missing: Option<String>,
}

/// One way to walk a tree.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Walk {
    /// Units in the last place by which the closest hit so far is taken to be farther away, when boxes are skipped.
    pub slack_ulp: u32,
    /// What it costs and gives.
    pub trace: Trace,
}

/// One way to build a tree.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Tree {
    /// Where a node is split.
    pub name: String,
    /// Where it is from.
    pub paper: String,
    /// Whether it is the student's own.
    pub student: bool,
    /// Seconds to build it, the median of the rounds.
    pub build_s: f64,
    /// Distance between the quartiles of the rounds.
    pub build_spread_s: f64,
    /// Nodes, leaves among them; not known of a student's.
    pub nodes: Option<usize>,
    /// What it costs and gives.
    pub trace: Trace,
    /// Rays after which building it has paid for itself against the midpoint tree; 0 if it is built faster, `None` if
    /// it never does.
    pub pays_after_rays: Option<f64>,
}

/// Closest hits of many rays through a tree.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Trace {
    /// Of one ray; "the textbook" is the first row.
    pub time: Timing,
    /// Box tests a ray.
    pub box_tests: f64,
    /// Triangle tests a ray.
    pub prim_tests: f64,
    /// Rays that were held against brute force: ordinary ones, and ones aimed where triangles overlap in one plane.
    pub checked_rays: usize,
    /// Rays whose closest hit differs from that of brute force with the same triangle test, in `t` or primitive.
    pub wrong_per_million: f64,
}
