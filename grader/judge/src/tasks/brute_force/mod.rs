//! Rays traced through a list of shapes: the cases of `part1.task3` and `part1.task4` with many
//! shapes.

mod judge;
pub(crate) mod pictures;
mod repro;

use crate::cases::Spec;
use crate::check::{Check, Content, same_length};
use crate::expected::Expected;
use crate::hits;
use crate::snapshot::lines::{self, each};
use crate::tally::{Aspect, Tally};
use crate::{Tier, convert, picture, truth};
use kit::Primitive;
use wire::answer::HitsAnswer;
use wire::work::{BruteForceWork, Xyz};

/// `intersect_triangle` and `intersect_sphere`, called with one ray for all shapes in order.
pub(crate) struct BruteForce;

impl Check for BruteForce {
    type Question = BruteForceWork;
    type Answer = HitsAnswer;

    const MAIN: &'static [Aspect] = &[Aspect::HitOrMiss, Aspect::T];

    fn calls(work: &BruteForceWork) -> usize {
        work.rays.len()
    }

    fn fits(work: &BruteForceWork, answer: &HitsAnswer) -> Result<(), String> {
        hits_fit(Self::calls(work), answer)
    }

    fn expected(work: &BruteForceWork, tier: Tier, enclosed: bool) -> Vec<Expected> {
        let scene = convert::scene(&work.triangles, &work.spheres);
        let shapes: Vec<Primitive<'_>> = scene.primitives().collect();
        let rays = work.rays.iter();
        rays.map(|ray| truth::first_of(tier, &shapes, &convert::ray(ray), enclosed))
            .collect()
    }

    fn judge(
        tally: &mut Tally,
        spec: &Spec,
        tier: Tier,
        work: &BruteForceWork,
        answer: &HitsAnswer,
    ) {
        let function = match work.triangles.is_empty() {
            true => "intersect_sphere",
            false => "intersect_triangle",
        };
        if !tally.is_written(function, &hits::OF_A_RECORD) {
            return;
        }
        tally.count_for(function);
        let expected = spec.expected_cache.of_shapes(spec, tier);
        judge::brute_force(tally, &work.rays, expected, answer);
    }

    fn judge_rest(
        tally: &mut Tally,
        spec: &Spec,
        tier: Tier,
        work: &BruteForceWork,
        answer: &HitsAnswer,
    ) {
        let expected = spec.expected_cache.of_shapes(spec, tier);
        judge::parameters(tally, &work.rays, expected, answer);
    }

    fn lines(work: &BruteForceWork, answer: &HitsAnswer) -> Option<Content> {
        let lines = each(&work.rays, &answer.hits, |ray, hit| {
            lines::hit(None, ray, hit.as_ref())
        });
        Some((Vec::new(), lines))
    }

    fn repro(tier: Tier, work: &BruteForceWork, call: usize) -> Option<String> {
        repro::first_of(tier, &work.triangles, &work.spheres, work.rays.get(call)?)
    }

    fn colours(answer: &HitsAnswer) -> Option<Vec<Xyz>> {
        let hits = answer.hits.iter().map(Option::as_ref);
        Some(hits.map(picture::hit).collect())
    }
}

/// Checks that there is a hit or a miss, and a `max_t`, for each of `rays` rays.
pub(super) fn hits_fit(rays: usize, answer: &HitsAnswer) -> Result<(), String> {
    same_length("hits or misses", answer.hits.len(), rays)?;
    same_length("max_t", answer.max_t.len(), rays)
}
