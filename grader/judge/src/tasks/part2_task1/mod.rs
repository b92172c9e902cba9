//! `part2.task1`: building the tree.

mod call;
pub(crate) mod cases;
pub(crate) mod growth;
pub(crate) mod judge;
mod leaves;
mod lines;
mod repro;
mod rest;
mod simple;
mod structure;

use crate::tools::Tier;
use crate::tools::call_text::{few, point};
use crate::tools::check::{CaseContext, Check};
use crate::tools::findings::{Aspect, Findings};
use crate::tools::moves::{Move, Symmetries, most_if_ordinary};
use crate::tools::plural;
use crate::tools::recorded;
use crate::tools::shown::ShownCall;
use crate::tools::snapshot::Content;
use crate::tools::snapshot::number;
use kit::Aabb;
use wire::answer::BuildAnswer;
use wire::kind;
use wire::work::{BuildWork, Tree, Xyz};

/// For each node of a tree over primitives with the boxes `bounds`, the smallest box around the
/// primitives below it: what its box must contain. The error is a sentence: the first fault of a
/// tree whose nodes are not reached once each, or that does not hold each primitive once.
pub fn exact_boxes(tree: &Tree, bounds: &[[Xyz; 2]]) -> Result<Vec<Aabb>, String> {
    let walk = structure::walk(tree, bounds.len()).map_err(|fault| fault.message)?;
    Ok(judge::tight_boxes(tree, &walk, bounds))
}

impl Check for kind::Build {
    const MAIN: &'static [Aspect] = &[Aspect::Structure, Aspect::Bounds, Aspect::Work];

    fn calls(_: &BuildWork) -> usize {
        2
    }

    /// Any answer fits: the structure of the tree is judged.
    fn fits(_: &BuildWork, _: &BuildAnswer) -> Result<(), String> {
        Ok(())
    }

    const NOT_MOVED: &'static str = "there are no primitives";

    fn symmetries(work: &BuildWork) -> Symmetries {
        Symmetries {
            lengths: most_if_ordinary(4, work.bounds.iter().flatten().flatten().copied()),
            primitives: work.bounds.len(),
            ..Symmetries::default()
        }
    }

    fn moved(work: &BuildWork, by: &Move) -> BuildWork {
        let bounds = work.bounds.iter().map(|b| by.corners(*b));
        BuildWork {
            bounds: by.reordered(&bounds.collect::<Vec<_>>()),
            ..*work
        }
    }

    /// A number that no primitive has stays as it is.
    fn moved_back(answer: &BuildAnswer, back: &Move) -> BuildAnswer {
        let numbers = back.numbers();
        let number = |prim: &u32| numbers.get(*prim as usize).copied().unwrap_or(*prim);
        BuildAnswer {
            tree: Tree {
                nodes: back.nodes(&answer.tree.nodes),
                order: answer.tree.order.iter().map(number).collect(),
            },
            repeatable: answer.repeatable,
        }
    }

    fn judge(
        findings: &mut Findings,
        case: &CaseContext<'_>,
        _: Tier,
        work: &BuildWork,
        answer: &BuildAnswer,
    ) {
        let recorded = match simple::is_simple(work) {
            true => simple::recorded(work),
            false => recorded::tree(case.name),
        };
        judge::build(findings, &work.bounds, work.max_leaf_size, answer, recorded);
    }

    fn judge_rest(
        findings: &mut Findings,
        case: &CaseContext<'_>,
        _: Tier,
        work: &BuildWork,
        answer: &BuildAnswer,
    ) {
        rest::build(findings, work, answer, recorded::tree(case.name));
    }

    fn lines(_: &BuildWork, answer: &BuildAnswer) -> Option<Content> {
        let totals = vec![number("nodes", answer.tree.nodes.len() as f64)];
        Some((totals, lines::nodes(&answer.tree)))
    }

    fn input(work: &BuildWork, _: usize) -> Option<String> {
        let boxes = plural(work.bounds.len(), "box", "boxes");
        let corners = work.bounds.iter().map(|corners| {
            let [min, max] = corners.map(point);
            format!("{min} to {max}")
        });
        let listed = few(corners, ", ").filter(|listed| !listed.is_empty());
        let listed = listed.map_or_else(String::new, |listed| format!(": {listed}"));
        Some(format!(
            "{boxes}{listed}; max_leaf_size = {}",
            work.max_leaf_size
        ))
    }

    fn shown(
        work: &BuildWork,
        _: Tier,
        _: bool,
        _: usize,
        answer: Option<&BuildAnswer>,
    ) -> Option<ShownCall> {
        call::shown(work, &answer?.tree)
    }

    fn repro(_: Tier, work: &BuildWork, _: usize) -> Option<String> {
        repro::over(&work.bounds, work.max_leaf_size)
    }

    /// The test does not compute the cost of the tree.
    fn repro_shows(aspect: Aspect) -> bool {
        aspect != Aspect::Work
    }

    fn simple(_: &BuildWork) -> Vec<BuildWork> {
        simple::questions()
    }
}
