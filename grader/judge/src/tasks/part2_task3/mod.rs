//! `part2.task3`: traversing the tree in scripted worlds, whose test results are given. Whole
//! scenes are in [`super::scene_hits`].

mod call;
pub(crate) mod cases;
pub(crate) mod judge;
mod repro;
pub(crate) mod rest;
mod simple;

use crate::tools::Tier;
use crate::tools::check::{CaseContext, Check, one_each};
use crate::tools::findings::{Aspect, Findings};
use crate::tools::moves::{Move, Symmetries, most_if_ordinary, ray_numbers};
use crate::tools::shown::ShownCall;
use crate::tools::snapshot::Content;
use crate::tools::snapshot::lines::{each, ray_at};
use crate::tools::snapshot::{Fields, forms, number};
use wire::answer::TraverseAnswer;
use wire::kind;
use wire::work::{ScriptedRay, ScriptedWorld, Tree};

impl Check for kind::Traverse {
    const MAIN: &'static [Aspect] = &[Aspect::HitOrMiss, Aspect::T, Aspect::Savings];

    fn calls(world: &ScriptedWorld) -> usize {
        world.rays.len()
    }

    fn fits(world: &ScriptedWorld, answers: &Vec<TraverseAnswer>) -> Result<(), String> {
        one_each(Self::calls(world), answers)
    }

    /// Lengths alone: the axes decide which child some traversals visit first.
    fn symmetries(world: &ScriptedWorld) -> Symmetries {
        let boxes = world.tree.nodes.iter().flat_map(|node| node.bounds);
        let rays = || world.rays.iter();
        let spans = rays().flat_map(|ray| ray.spans.iter().flatten().flatten());
        let prims = rays().flat_map(|ray| ray.prims.iter().flatten());
        let numbers = boxes.flatten().chain(spans.chain(prims).copied());
        Symmetries {
            lengths: most_if_ordinary(
                8,
                numbers.chain(rays().flat_map(|ray| ray_numbers(&ray.ray))),
            ),
            ..Symmetries::default()
        }
    }

    fn moved(world: &ScriptedWorld, by: &Move) -> ScriptedWorld {
        let rays = world.rays.iter().map(|ray| {
            let spans = ray
                .spans
                .iter()
                .map(|span| span.map(|ends| ends.map(|t| by.t(t))));
            let prims = ray.prims.iter().map(|t| t.map(|t| by.t(t)));
            ScriptedRay {
                ray: by.ray(&ray.ray),
                spans: spans.collect(),
                prims: prims.collect(),
                is_hidden: ray.is_hidden,
            }
        });
        ScriptedWorld {
            tree: Tree {
                nodes: by.nodes(&world.tree.nodes),
                order: world.tree.order.clone(),
            },
            any_hit: world.any_hit,
            rays: rays.collect(),
        }
    }

    fn moved_back(answers: &Vec<TraverseAnswer>, back: &Move) -> Vec<TraverseAnswer> {
        let each = answers.iter().map(|answer| TraverseAnswer {
            hit: answer.hit.map(|(t, prim)| (back.t(t), prim)),
            ray_after: back.ray(&answer.ray_after),
            ..*answer
        });
        each.collect()
    }

    fn judge(
        findings: &mut Findings,
        case: &CaseContext<'_>,
        _: Tier,
        world: &ScriptedWorld,
        answers: &Vec<TraverseAnswer>,
    ) {
        let counts_work = cases::counts_work(case.name);
        judge::traverse(findings, world, answers, counts_work);
    }

    fn judge_rest(
        findings: &mut Findings,
        _: &CaseContext<'_>,
        _: Tier,
        world: &ScriptedWorld,
        answers: &Vec<TraverseAnswer>,
    ) {
        rest::traverse(findings, world, answers);
    }

    fn lines(world: &ScriptedWorld, answers: &Vec<TraverseAnswer>) -> Option<Content> {
        let lines = each(&world.rays, answers, |scripted, answer| {
            let mut fields = Fields::new();
            if let Some((t, prim)) = answer.hit {
                fields.extend([number("t", t), number("prim", f64::from(prim))]);
            }
            fields.extend([
                number("box_tests", f64::from(answer.box_tests)),
                number("prim_tests", f64::from(answer.prim_tests)),
            ]);
            forms(ray_at(None, &scripted.ray), fields.clone(), fields)
        });
        Some((Vec::new(), lines))
    }

    fn input(work: &ScriptedWorld, call: usize) -> Option<String> {
        call::input(work, call)
    }

    fn circumstances(work: &ScriptedWorld, call: usize) -> Option<Vec<&'static str>> {
        call::circumstances(work, call)
    }

    fn shown(
        world: &ScriptedWorld,
        _: Tier,
        _: bool,
        call: usize,
        answers: Option<&Vec<TraverseAnswer>>,
    ) -> Option<ShownCall> {
        call::shown(world, call, answers)
    }

    fn repro(_: Tier, world: &ScriptedWorld, call: usize) -> Option<String> {
        repro::traversal(world, call)
    }

    /// The test does not count box and primitive tests.
    fn repro_shows(aspect: Aspect) -> bool {
        !matches!(aspect, Aspect::Work | Aspect::Savings)
    }

    fn simple(world: &ScriptedWorld) -> Vec<ScriptedWorld> {
        simple::questions(world.any_hit)
    }
}
