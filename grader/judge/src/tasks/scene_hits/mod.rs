//! Rays traced through whole scenes with all of the student's stages: cases of `part2.task3`.

mod call;
pub(crate) mod cases;
mod judge;
mod rest;

use crate::tools::call_text::ray_circumstances;
use crate::tools::check::{CaseContext, Check, hits_fit};
use crate::tools::findings::{Aspect, Findings};
use crate::tools::moves::{Move, Symmetries, most_if_ordinary, ray_numbers};
use crate::tools::snapshot::Content;
use crate::tools::snapshot::lines::{self, each, ray_at};
use crate::tools::snapshot::{Fields, forms, number};
use crate::tools::{Tier, colours};
use wire::answer::HitsAnswer;
use wire::kind;
use wire::work::{SceneWork, Xyz};

impl Check for kind::SceneHits {
    const MAIN: &'static [Aspect] = &[Aspect::HitOrMiss, Aspect::T, Aspect::Savings];

    const NEEDS_ALL_STAGES: bool = true;

    fn calls(work: &SceneWork) -> usize {
        work.rays.len()
    }

    fn fits(work: &SceneWork, answer: &HitsAnswer) -> Result<(), String> {
        hits_fit(Self::calls(work), answer)
    }

    /// The scene stays: its exact hits take long to compute.
    fn symmetries(work: &SceneWork) -> Symmetries {
        Symmetries {
            speeds: most_if_ordinary(4, work.rays.iter().flat_map(ray_numbers)),
            ..Symmetries::default()
        }
    }

    fn moved(work: &SceneWork, by: &Move) -> SceneWork {
        SceneWork {
            rays: work.rays.iter().map(|ray| by.ray(ray)).collect(),
            ..work.clone()
        }
    }

    fn moved_back(answer: &HitsAnswer, back: &Move) -> HitsAnswer {
        back.hits(answer)
    }

    fn judge(
        findings: &mut Findings,
        case: &CaseContext<'_>,
        tier: Tier,
        work: &SceneWork,
        answer: &HitsAnswer,
    ) {
        let truths = case.cache.of_scene(&work.scene, &work.rays);
        judge::hits(findings, tier, truths, &work.rays, work.any_hit, answer);
        judge::savings(findings, work, answer);
    }

    fn judge_rest(
        findings: &mut Findings,
        case: &CaseContext<'_>,
        tier: Tier,
        work: &SceneWork,
        answer: &HitsAnswer,
    ) {
        let truths = case.cache.of_scene(&work.scene, &work.rays);
        if work.any_hit {
            rest::decisions(findings, tier, truths);
        } else {
            let expected = case.expected(tier, || rest::expected(work, tier));
            rest::records(findings, &work.rays, expected, truths, answer);
        }
        let needed = case.cache.tests(|| rest::needed_tests(work));
        rest::tests(findings, needed, answer);
    }

    fn lines(work: &SceneWork, answer: &HitsAnswer) -> Option<Content> {
        let lines = each(&work.rays, &answer.hits, |ray, hit| {
            if !work.any_hit {
                return lines::hit(None, ray, hit.as_ref());
            }
            let blocked: Fields = hit.iter().map(|_| number("blocked", 1.0)).collect();
            forms(ray_at(None, ray), blocked.clone(), blocked)
        });
        let counts = vec![
            number("box_tests", answer.box_tests as f64),
            number("prim_tests", answer.prim_tests as f64),
        ];
        Some((counts, lines))
    }

    fn input(work: &SceneWork, call: usize) -> Option<String> {
        call::input(work, call)
    }

    fn circumstances(work: &SceneWork, call: usize) -> Option<Vec<&'static str>> {
        work.rays.get(call).map(ray_circumstances)
    }

    fn exact(work: &SceneWork, enclosed: bool, calls: &[u32]) -> Option<Vec<Fields>> {
        call::exact(work, enclosed, calls)
    }

    fn colours(answer: &HitsAnswer) -> Option<Vec<Xyz>> {
        let hits = answer.hits.iter().map(Option::as_ref);
        Some(hits.map(colours::hit).collect())
    }
}
