//! Judges what no case grades about a traversal: the number of tests of each ray.

use super::judge::{in_range, traced};
use crate::plural;
use crate::tools::aspects::hits::{SEVERAL_FIRST, show_ray};
use crate::tools::findings::{Aspect, Findings};
use crate::tools::truth::tree_tests::{MORE_TESTS, TOO_FEW_TESTS, Tests};
use wire::answer::TraverseAnswer;
use wire::work::ScriptedWorld;

/// Confirms the tests of a ray that are the fewest possible. How many more are too many depends on
/// the tree; the cases that grade work judge that over many rays.
pub(super) fn traverse(findings: &mut Findings, world: &ScriptedWorld, answers: &[TraverseAnswer]) {
    for (call, (scripted, answer)) in world.rays.iter().zip(answers).enumerate() {
        let tests = Tests {
            boxes: answer.box_tests.into(),
            prims: answer.prim_tests.into(),
        };
        let nearest = in_range(scripted).map(|(_, t)| t).reduce(f64::min);
        let fewest = traced(world, scripted, |ray| ray.fewest(nearest));
        if tests.boxes < fewest.boxes || tests.prims < fewest.prims {
            findings.not_judged(Aspect::Work, call, TOO_FEW_TESTS);
        } else if tests != fewest {
            findings.not_judged(Aspect::Work, call, MORE_TESTS);
        }
        // Of several primitives at the same t, the convention names the one for goldens.
        let first = in_range(scripted).find(|(_, t)| Some(*t) == nearest);
        if !world.any_hit && answer.hit.map(|(_, id)| id) != first.map(|(id, _)| id) {
            findings.not_judged(Aspect::Primitive, call, SEVERAL_FIRST);
        }
        let odd = answer.unknown_boxes + answer.repeated_prims;
        findings.judge(Aspect::Work, call, odd == 0, f64::from(odd), || {
            format!(
                "your result: {} of boxes that no node has, {} of a primitive for the second time. {}",
                plural(answer.unknown_boxes, "test", "tests"),
                answer.repeated_prims,
                show_ray(&scripted.ray)
            )
        });
    }
}
