//! Judges what no case grades about a tree: whether its boxes are as small, and its cost as low, as
//! they can be expected to be.

use super::judge::{aabb, cost, tight_boxes};
use super::structure::walk;
use crate::tools::findings::{Aspect, Findings};
use crate::tools::recorded::TreeWork;
use wire::answer::BuildAnswer;
use wire::work::BuildWork;

/// A cost up to this many times the recorded one, which is rounded, is confirmed.
const COST_ROUNDING: f64 = 1.01;

/// Why a loose box is not judged.
const LOOSE: &str = "a box is larger than what it contains, which is allowed but slow";

/// Why the cost is not judged without a record.
const NO_RECORD: &str = "no cost is recorded for these boxes";

/// Why a cost above the recorded one is not judged.
const MORE_COST: &str = "the tree costs more than the recorded one, which is allowed within limits";

/// Confirms tight boxes and a cost that is not above the recorded one.
pub(super) fn build(
    findings: &mut Findings,
    work: &BuildWork,
    answer: &BuildAnswer,
    recorded: Option<TreeWork>,
) {
    let tree = &answer.tree;
    let Ok(walk) = walk(tree, work.bounds.len()) else {
        return;
    };
    let tight = tight_boxes(tree, &walk, &work.bounds);
    let mut boxes = walk.nodes(tree);
    if boxes.any(|(at, node)| aabb(&node.bounds) != tight[at]) {
        findings.never_judged(Aspect::Bounds, LOOSE);
    }
    match recorded {
        None => findings.never_judged(Aspect::Work, NO_RECORD),
        Some(recorded) if cost(tree, &walk, &tight) > COST_ROUNDING * recorded.cost => {
            findings.never_judged(Aspect::Work, MORE_COST);
        }
        Some(_) => {}
    }
}
