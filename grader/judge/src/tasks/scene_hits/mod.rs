//! Rays traced through whole scenes with all of the student's stages: cases of `part2.task3`.

pub(crate) mod cases;
mod judge;
mod rest;

use super::brute_force::hits_fit;
use crate::cases::Spec;
use crate::check::{Check, Content};
use crate::snapshot::lines::{self, each, ray_at};
use crate::snapshot::{Fields, forms, number};
use crate::tally::{Aspect, Tally};
use crate::{Tier, picture};
use wire::answer::HitsAnswer;
use wire::work::{SceneWork, Xyz};

/// `intersect_bvh` or `occludes_bvh`, called for each ray in a world that calls `intersect_bbox`
/// and `intersect_*`.
pub(crate) struct SceneHits;

impl Check for SceneHits {
    type Question = SceneWork;
    type Answer = HitsAnswer;

    const MAIN: &'static [Aspect] = &[Aspect::HitOrMiss, Aspect::T, Aspect::Savings];

    const NEEDS_ALL_STAGES: bool = true;

    fn calls(work: &SceneWork) -> usize {
        work.rays.len()
    }

    fn fits(work: &SceneWork, answer: &HitsAnswer) -> Result<(), String> {
        hits_fit(Self::calls(work), answer)
    }

    fn judge(tally: &mut Tally, spec: &Spec, tier: Tier, work: &SceneWork, answer: &HitsAnswer) {
        let truths = spec.expected_cache.of_scene(&work.scene, &work.rays);
        judge::hits(tally, tier, truths, &work.rays, work.any_hit, answer);
        judge::savings(tally, work, answer);
    }

    fn judge_rest(
        tally: &mut Tally,
        spec: &Spec,
        tier: Tier,
        work: &SceneWork,
        answer: &HitsAnswer,
    ) {
        let truths = spec.expected_cache.of_scene(&work.scene, &work.rays);
        if work.any_hit {
            rest::decisions(tally, tier, truths);
        } else {
            let expected = spec
                .expected_cache
                .of_tier(tier, || rest::expected(work, tier));
            rest::records(tally, &work.rays, expected, truths, answer);
        }
        let needed = spec.expected_cache.tests(|| rest::needed_tests(work));
        rest::tests(tally, needed, answer);
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

    fn colours(answer: &HitsAnswer) -> Option<Vec<Xyz>> {
        let hits = answer.hits.iter().map(Option::as_ref);
        Some(hits.map(picture::hit).collect())
    }
}
