//! `part1.task3`: triangles.

pub(crate) mod cases;
pub(crate) mod judge;
mod repro;

use crate::cases::Spec;
use crate::check::{Check, Content, one_each};
use crate::expected::Expected;
use crate::snapshot::lines::{self, each};
use crate::tally::{Aspect, Tally};
use crate::{Tier, convert, picture, truth};
use kit::Triangle;
use wire::answer::TriangleAnswer;
use wire::work::{TriangleWork, Xyz};

/// `test_triangle` and `intersect_triangle`, both called for each probe.
pub(crate) struct Triangles;

impl Check for Triangles {
    type Question = TriangleWork;
    type Answer = Vec<TriangleAnswer>;

    const MAIN: &'static [Aspect] = &[Aspect::HitOrMiss, Aspect::T];

    fn calls(work: &TriangleWork) -> usize {
        work.probes.len()
    }

    fn fits(work: &TriangleWork, answers: &Vec<TriangleAnswer>) -> Result<(), String> {
        one_each(Self::calls(work), answers)
    }

    fn expected(work: &TriangleWork, tier: Tier, _: bool) -> Vec<Expected> {
        let triangles: Vec<Triangle> = work.triangles.iter().map(convert::triangle).collect();
        let of = work.probes.iter().map(|probe| {
            let triangle = &triangles[probe.shape as usize];
            truth::triangle(tier, probe.shape, triangle, &convert::ray(&probe.ray))
        });
        of.collect()
    }

    fn judge(
        tally: &mut Tally,
        spec: &Spec,
        tier: Tier,
        work: &TriangleWork,
        answers: &Vec<TriangleAnswer>,
    ) {
        let expected = spec.expected_cache.of_shapes(spec, tier);
        judge::triangles(tally, &work.probes, expected, answers);
    }

    fn lines(work: &TriangleWork, answers: &Vec<TriangleAnswer>) -> Option<Content> {
        let lines = each(&work.probes, answers, |probe, answer| {
            lines::hit(Some(probe.shape), &probe.ray, answer.hit.as_ref())
        });
        Some((Vec::new(), lines))
    }

    fn repro(tier: Tier, work: &TriangleWork, call: usize) -> Option<String> {
        repro::triangle(tier, &work.triangles, work.probes.get(call)?)
    }

    fn colours(answers: &Vec<TriangleAnswer>) -> Option<Vec<Xyz>> {
        let hits = answers.iter().map(|answer| answer.hit.as_ref());
        Some(hits.map(picture::hit).collect())
    }
}
